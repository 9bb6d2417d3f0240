"""A folder of records made up for tests: everything holds, unless a test spoils it."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

from evidence.catalogue import Evidence, catalogue
from evidence.records.reading import read
from evidence.records.showing import Shown, cells_of, shown
from proofs.theories import THEORIES

COMMIT = "0123456789abcdef0123456789abcdef01234567"
VERSIONS = {"python": "3.11.0", "z3-solver": "5.4.0", "cvc5": "1.4.2", "heisoku": "0.1.0"}
OF = {"commit": COMMIT, "versions": VERSIONS}

PROVED = ("braking", "split")
"""The theories of the sample; there are more, and of the others nothing is asked."""


def known() -> dict[str, Evidence]:
    """The evidence that the sample has records of."""
    return {
        name: each
        for name, each in catalogue().items()
        if not name.startswith(("prove:", "witness:")) or name.split(":")[1].split(".")[0] in PROVED
    }


def answer(row: str, column: str, solver: str) -> dict[str, Any]:
    return {
        "transition": row,
        "invariant": column,
        "hypotheses": [column],
        "axioms": [],
        "verdict": "proved",
        "solver": solver,
        "solver_version": "1.2.3",
        "seed": 0,
        "rlimit": 4_000_000,
        "rlimit_spent": 12_345,
        "seconds": 0.25,
        "smt2_sha256": "0" * 64,
        "source": {"file": "proofs/onboard/braking.py", "lines": [10, 14]},
        "theory": "braking",
    }


def proved() -> dict[str, Any]:
    cells = [cell for name in PROVED for claim in THEORIES[name].invariants for cell in cells_of(THEORIES[name], claim)]
    seen = {"canary": "a row × a claim", "solver": "z3", "solver_version": "1", "answer": "sat", "noticed": True}
    return {
        "verdict": "proved",
        "obligations": [answer(*cell, solver) for cell in cells for solver in ("z3", "cvc5")],
        "lifting_seconds": 1.0,
        "wall_seconds": 10.0,
        "canaries": [seen],
        **OF,
    }


def checked() -> dict[str, Any]:
    def entry(name: str) -> dict[str, Any]:
        return {
            "file": f"layouts/{name}",
            "layout": f"layouts/{name}",
            "format": "native",
            "verdict": "holds",
            "exit_code": 0,
            "counts": {"blocks": 3, "routes": 2, "points": 1, "tags": 8},
            "checked": {"a_destination_is_covered": 18},
            "violations": [],
            "remarks": [],
        }

    names = ("figure_of_eight", "junction", "passing_station", "ring", "terminus")
    return {"verdict": "holds", "layouts": [entry(f"{name}.toml") for name in names]}


def ridden(beyond: str | None) -> dict[str, Any]:
    one = {
        "beyond": beyond,
        "rides": 100_000,
        "long": 90_000,
        "violations": {"front_outside": 0},
        "assumptions": {"wheel_broken": 0},
        "monitors": {"untrusted": 7},
        "violated": 0,
        "unexplained": 0,
        "unnoticed": 0,
        "bound": 3e-05,
        "sums": {"cycles": 1_000, "way_mm": 2_000, "faults": 3},
        "most": {"cycles": 10, "way_mm": 20, "faults": 2},
    }
    return {"seed": 1, "plan": "Plan()", "faults": {}, "campaigns": [one], **OF}


def lived(system: str) -> dict[str, Any]:
    column = {"what": "a train unseen", "all": 0, "most in a day": 0, "on days": 0}
    groups = ("claims", "assumptions", "monitors", "faults", "prices", "counts")
    return {
        "system": system,
        "seed": 1,
        "days": 200,
        "hours": 3200.0,
        "violated": 0,
        "unexplained": 0,
        "bound": 0.015,
        "columns": {group: {"unseen": column} for group in groups},
        **OF,
    }


def reproduced(paper: str) -> dict[str, Any]:
    row = {"what": "share of fixes", "where": "4.3.1", "paper": "94.3 %", "ours": "95 %", "agrees": True}
    return {
        "paper": paper,
        "verdict": "holds",
        "seed": 1,
        "rows": [{**row, "criterion": "intervals overlap"}],
        "sensitivities": [],
        "parameters": {"seed": "1, since one must begin"},
        "counts": {"runs": 10},
        "pictures": [],
        **OF,
    }


def fuzzed() -> dict[str, Any]:
    target = {"batches": 8, "traces": 40, "steps": 4_868, "states": 100, "failures": 0, "unfinished": 0, "counts": {}}
    canary = {"name": "a guard dropped", "target": "link"}
    return {
        "verdict": "holds",
        "identity": {"format": "heisoku campaign 1"},
        "seeds": [1],
        "starts": [{"at": "2026-01-01", "seed": 1, **OF}],
        "targets": {"link": target},
        "left_out": [],
        "canaries": [canary],
        "failures": [],
    }


def mutated() -> dict[str, Any]:
    mutant = {
        "mutant": "kernel.onboard.braking.supervise: or-operand not safe",
        "theories": ["braking"],
        "became": "killed",
        "outcome": "counterexample",
        "by": "braking.run_a_cycle",
        "finding": "head_stays_inside_authority",
        "searched": {},
        "class": "",
        "why": "",
        "objection": "",
        "seconds": 0.1,
    }
    classed = {**mutant, "mutant": "kernel.claims.end_claims: guard", "became": "classed", "class": "service"}
    kills = {"braking": dict.fromkeys(THEORIES["braking"].invariants, 0) | {"head_stays_inside_authority": 1}}
    return {"verdict": "holds", "mutants": [mutant, classed], "of": 2, "seconds": 1.0, "kills": kills, **OF}


def certified() -> dict[str, Any]:
    one = {"row": "braking.init", "column": "the_bounds", "parts": 1, "steps": 9, "trusted": 0, "answer": "checked"}
    found = [{**one, "smt2_sha256": "0" * 64, "external": ""}]
    control = {"asked": "a row × a contradiction", "refused": True}
    return {"verdict": "holds", "obligations": found, "of": 1, "controls": [control], "external": None, **OF}


def tests() -> str:
    cases = [f'<testcase classname="tests.onboard.test_theories" name="test_it[{name}]"/>' for name in THEORIES]
    cases += ['<testcase classname="tests.proofs.test_witnesses" name="test_a_witness_goes_as_it_says[one]"/>']
    return f'<testsuites><testsuite name="pytest">{"".join(cases)}</testsuite></testsuites>'


def write(folder: Path) -> Path:
    """Write one record of each kind; what holds of each is no more than what stands in it."""
    folder.mkdir(parents=True, exist_ok=True)
    records: dict[str, dict[str, Any]] = {"prove.json": proved(), "check.json": checked(), "mutate.json": mutated()}
    records |= {"certificates.json": certified()}
    records |= {"ride.json": ridden(None), "beyond.json": ridden("diameter_ppm"), "fuzz.json": fuzzed()}
    for each in catalogue().values():
        kind, _, which = each.name.partition(":")
        if kind == "days":
            records[each.record] = lived(which)
        elif kind == "reproduce":
            records[each.record] = reproduced(which)
    for name, record in records.items():
        (folder / name).write_text(json.dumps(record), "utf-8")
    (folder / "test.xml").write_text(tests(), "utf-8")
    (folder / "crosshair.txt").write_text("tests/contracts_tags.py:12: info: Confirmed over all paths.\n", "utf-8")
    return folder


def came_to(folder: Path, commit: str | None = COMMIT) -> dict[str, Shown]:
    """What all evidence comes to by a folder."""
    return dict(shown(known(), read(folder, frozenset(each.record for each in known().values())), commit))


def change(path: Path, **values: Any) -> None:
    """Change a record."""
    path.write_text(json.dumps({**json.loads(path.read_text("utf-8")), **values}), "utf-8")
