"""Records as they are where everything holds, made from the sources; what solvers and trials answer is made up."""

from __future__ import annotations

import json
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any
from xml.sax.saxutils import quoteattr

from evidence.manifest import expected_runs, laying_out, making
from evidence.manifest.hashes import NAME, made
from evidence.manifest.laying_out import Cell, LaidOut
from evidence.records.reading import ABOUT, HEADING
from evidence.report.cored import RECORD as CORES
from fuzz.planted.canaries import canaries as planted
from models.days.systems import NAMES as SYSTEMS
from models.days.systems import system_of
from models.layouts import as_json, check, load
from models.reproduce import PAPERS
from models.rides.tally import ASSUMPTIONS, COLUMNS, MONITORS, VIOLATIONS
from models.sensors.faults import names as faults
from models.shipped import shipped
from proofs import canaries
from proofs.junit import write_junit
from proofs.mutants import assumed, trying
from proofs.mutants import command as mutating
from proofs.mutants import joints as between
from proofs.mutants.classes import table
from proofs.mutants.targets import mutants, theories_with
from proofs.records import Report, about
from proofs.solvers import BUDGET, version
from proofs.theories import is_transition, theory_of

Laid = Mapping[Cell, LaidOut]
Told = dict[str, Any]
GROUPS = ("claims", "assumptions", "monitors", "faults", "prices", "counts")


def proved(laid_out: Laid) -> Told:
    found = [
        {
            "transition": row,
            "invariant": column,
            "hypotheses": now.hypotheses,
            "axioms": now.axioms,
            "verdict": "proved",
            "solver": solver,
            "solver_version": version(solver),
            "seed": seed,
            "rlimit": BUDGET[solver],
            "rlimit_spent": 1_000,
            "seconds": 0.01,
            "smt2_sha256": now.digest,
            "source": {"file": now.source[0], "lines": list(now.source[1:])},
            "theory": theory_of(row)[0].name,
        }
        for (row, column), now in laid_out.items()
        for solver in BUDGET
        for seed in range(2)
    ]
    seen = [
        {
            "canary": each.name,
            "solver": solver,
            "solver_version": version(solver),
            "process": 1,
            "answer": "sat",
            "noticed": True,
        }
        for each in canaries.CANARIES
        for solver in BUDGET
    ]
    return {"verdict": "proved", "obligations": found, "canaries": seen, "offences": [], **about()}


def certified(laid_out: Laid) -> Told:
    found = [
        {
            "row": row,
            "column": column,
            "parts": now.parts,
            "answer": "checked",
            "steps": 9,
            "trusted": 0,
            "smt2_sha256": now.digest,
            "external": "",
        }
        for (row, column), now in laid_out.items()
    ]
    controls = [{"asked": each.name, "refused": True} for each in canaries.CANARIES]
    told = {"obligations": found, "of": len(laid_out), "controls": controls, "external": None}
    return {"verdict": "holds", **told, "only": None, "sample": None, **about()}


def mutated(sample: int | None) -> Told:
    rows = []
    for name in trying.chosen("", sample):
        entry = table().get(name)
        rows.append(
            {
                "mutant": name,
                "theories": [theory.name for theory in theories_with(mutants()[name])],
                "became": "classed" if entry else "killed",
                "outcome": "survived" if entry else "counterexample",
                "by": "",
                "finding": "",
                "searched": {},
                "class": entry.kind if entry else "",
                "why": entry.why if entry else "",
                "objection": "",
                "seconds": 0.1,
            }
        )
    told = {"verdict": "holds", "mutants": rows, "of": len(mutants()), "kills": mutating.kills(rows)}
    return {**told, "only": None, "sample": sample, **about()}


def cored(laid_out: Laid) -> Told:
    found = [
        {
            "transition": row,
            "invariant": column,
            "hypotheses": now.hypotheses,
            "guards": [],
            "updates": [],
            "parts": now.parts,
            "open": 0,
        }
        for (row, column), now in laid_out.items()
        if is_transition(row) and column in theory_of(row)[0].invariants
    ]
    return {"obligations": found, "guards": {}, "updates": {}, **about()}


def joined() -> Told:
    uses = [
        {"row": each.row, "column": each.column, "guarantee": each.guarantee, "became": "needed"}
        for each in between.uses().values()
    ]
    assumptions = [{"assumption": name, "became": "needed"} for name in assumed.names()]
    of = {"guarantees": len(uses), "assumptions": len(assumptions)}
    told = {"verdict": "holds", "guarantees": uses, "assumptions": assumptions, "of": of, "by_name": []}
    return {**told, "only": None, "sample": None, **about()}


def checked() -> Told:
    entries = []
    for path in sorted(shipped("layouts").glob("*.toml")):
        imported = load(path)
        entries.append({"file": f"layouts/{path.name}", **as_json(imported, check(imported))})
    return {"verdict": "holds", "layouts": json.loads(json.dumps(entries)), **about()}


def reproduced(paper: str) -> Told:
    told = json.loads(json.dumps({**making.reproduced(paper, 1, 1).record(), "runs": 1, **about()}))
    for row in told["rows"]:
        row["agrees"] = None if row["agrees"] is None else True
    return {**told, "verdict": "holds"}


def ridden(beyond: Sequence[str | None]) -> Told:
    one = {
        "rides": 100,
        "violations": dict.fromkeys(VIOLATIONS, 0),
        "assumptions": dict.fromkeys(ASSUMPTIONS, 0),
        "monitors": dict.fromkeys(MONITORS, 0),
        "violated": 0,
        "unexplained": 0,
        "sums": {**dict.fromkeys(COLUMNS, 0), "cycles": 100},
        "most": {**dict.fromkeys(COLUMNS, 0), "cycles": 1},
    }
    campaigns = [{"beyond": name, **one} for name in beyond]
    return {"seed": 1, "campaigns": campaigns, **about(), "command": "heisoku ride --rides 100"}


def lived(name: str) -> Told:
    system = system_of(name)
    column = {"all": 0, "most in a day": 0, "on days": 0}
    columns = {group: dict.fromkeys(getattr(system, group), column) for group in GROUPS}
    told = {"system": name, "seed": 1, "days": 5, "violated": 0, "unexplained": 0, "columns": columns}
    return {**told, **about(), "command": f"heisoku days {name} --days=5"}


def fuzzed() -> Told:
    sought = [
        {"kind": each.kind, "fault": each.name, "target": "walks", "batches": 1, "seconds": 1.0} for each in planted(1)
    ]
    starts = [{"at": "2026-01-01", "seed": 1, **about()}]
    target = {"batches": 8, "unfinished": 0, "traces": 40, "steps": 4_868, "failures": 0}
    told = {"verdict": "holds", "seeds": [1], "starts": starts, "targets": {"link": target, "walks": target}}
    return {**told, "left_out": [], "canaries": sought, "failures": []}


def tests(names: Sequence[str]) -> str:
    cases = []
    for name in names:
        place, _, test = name.partition("::")
        cases.append(f"<testcase classname={quoteattr(place)} name={quoteattr(test)}/>")
    said = f"<properties><property name={quoteattr(ABOUT)} value={quoteattr(json.dumps(about()))}/></properties>"
    return f'<testsuites><testsuite name="pytest">{said}{"".join(cases)}</testsuite></testsuites>'


def contracts() -> str:
    lines = [
        f"/a/{own}:{first}: info: Confirmed over all paths." for own, first, _ in expected_runs.contracts().values()
    ]
    return "\n".join([HEADING + json.dumps(about()), *lines, ""])


def write(folder: Path, laid_out: Laid, *, whole: bool) -> Path:
    """Write the records of all that is in ``laid_out``, with a manifest; ``whole``: of every other kind as well."""
    records = {
        "prove.json": proved(laid_out),
        "certificates.json": certified(laid_out),
        "mutate.json": mutated(None if whole else 40),
        "check.json": checked(),
        "ride.json": ridden([None]),
        "beyond.json": ridden(faults()),
        "fuzz.json": fuzzed(),
        CORES: cored(laid_out),
        "joints.json": joined(),
    }
    records |= {f"{paper}.json": reproduced(paper) for paper in (PAPERS if whole else ["000"])}
    records |= {f"days-{name}.json": lived(name) for name in SYSTEMS if whole}
    folder.mkdir()
    for name, record in records.items():
        (folder / name).write_text(json.dumps(record), "utf-8")
    told = records["prove.json"]
    write_junit(folder / "prove.xml", Report(told["obligations"], 1.0, 2.5, told["canaries"], told["offences"]))
    (folder / "test.xml").write_text(tests(expected_runs.collected() or []), "utf-8")
    (folder / "crosshair.txt").write_text(contracts(), "utf-8")
    bind(folder)
    return folder


def bind(folder: Path) -> None:
    """Make the manifest anew."""
    (folder / NAME).write_text(made(folder).text(), "utf-8")


def few() -> list[Cell]:
    """Obligations of two theories."""
    return [cell for cell in laying_out.cells() if theory_of(cell[0])[0].name in ("braking", "brake_watch")]
