"""Records as they are where everything holds, made from the sources; what solvers and trials answer is made up."""

from __future__ import annotations

import gzip
import hashlib
import json
from collections.abc import Mapping, Sequence
from dataclasses import asdict, replace
from itertools import count
from pathlib import Path
from typing import Any
from xml.sax.saxutils import quoteattr

from evidence.manifest import expected_campaign, expected_runs, laying_out, making
from evidence.manifest.hashes import NAME, made
from evidence.manifest.laying_out import Cell, LaidOut
from evidence.records.reading import ABOUT, HEADING
from evidence.report.cored import RECORD as CORES
from fuzz.campaign.session import ON_LAYOUTS
from fuzz.planted.canaries import canaries as planted
from models.days.systems import NAMES as SYSTEMS
from models.days.systems import system_of
from models.layouts import as_json, check, load
from models.reproduce import PAPERS
from models.reproduce.tables import Row, table_as_text
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
from proofs.run import NOTHING_TO_ASK
from proofs.solvers import BUDGET, version
from proofs.theories import is_transition, theory_of

Laid = Mapping[Cell, LaidOut]
Told = dict[str, Any]
PROOF = b"(assume @p1 false)\n(step @p2 :rule contra)\n"
"""What stands for cvc5's proof of each part."""
TABLES, A_PROOF = "000/000_tables.txt", "proofs/braking.init/head_stays_inside_authority.1.cpc.gz"
GROUPS = ("claims", "assumptions", "monitors", "faults", "prices", "counts")


def by(command: str) -> Told:
    """How a record was made, by a command."""
    return {**about(), "command": command}


def digest_of(proof: bytes) -> str:
    return hashlib.sha256(proof).hexdigest()


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
            **({} if now.parts else {"note": NOTHING_TO_ASK}),
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
    took = {"lifting_seconds": 1.0, "wall_seconds": 2.5}
    told = {"verdict": "proved", "obligations": found, "canaries": seen, "offences": [], **took}
    return {**told, **by("heisoku prove --solver both --seeds 2 --json out/prove.json")}


def certified(laid_out: Laid) -> Told:
    found = [
        {
            "row": row,
            "column": column,
            "parts": now.parts,
            "answer": "checked",
            "steps": 9 * now.parts,
            "trusted": 0,
            "smt2_sha256": now.digest,
            "external": "",
            "proofs": [digest_of(PROOF)] * now.parts,
            "size": len(PROOF) * now.parts,
        }
        for (row, column), now in laid_out.items()
    ]
    controls = [{"asked": each.name, "refused": True} for each in canaries.CANARIES]
    told = {"obligations": found, "of": len(laid_out), "controls": controls, "external": None}
    return {"verdict": "holds", **told, "only": None, "sample": None, **by("heisoku certify --keep out/proofs")}


def with_classed() -> int:
    """The least sample of mutants, from 40 on, that has some that stand in a class."""
    return next(size for size in count(40) if any(name in table() for name in trying.chosen("", size)))


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
                "by": "" if entry else "a step",
                "finding": "" if entry else "a claim",
                "searched": {},
                "class": entry.kind if entry else "",
                "why": entry.why if entry else "",
                "objection": "",
                "seconds": 0.1,
            }
        )
    told = {"verdict": "holds", "mutants": rows, "of": len(mutants()), "kills": mutating.kills(rows)}
    command = "heisoku mutate" if sample is None else f"heisoku mutate --sample {sample}"
    return {**told, "only": None, "sample": sample, **by(command)}


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
    nothing: dict[str, list[str]] = {str(each["transition"]): [] for each in found}
    return {"obligations": found, "guards": nothing, "updates": nothing, **by("cores.py --json out/cores.json")}


def joined() -> Told:
    uses = [
        {**asdict(each), "became": "needed", "without": "refuted", "open_with": []} for each in between.uses().values()
    ]
    assumptions = [{"assumption": name, "became": "needed"} for name in assumed.names()]
    of = {"guarantees": len(uses), "assumptions": len(assumptions)}
    told = {"verdict": "holds", "guarantees": uses, "assumptions": assumptions, "of": of, "by_name": between.by_name()}
    return {**told, "only": None, "sample": None, **by("heisoku mutate --joints")}


def checked() -> Told:
    entries = []
    for path in sorted(shipped("layouts").glob("*.toml")):
        imported = load(path)
        entries.append({"file": f"layouts/{path.name}", **as_json(imported, check(imported))})
    command = " ".join(["heisoku check", *(str(each["file"]) for each in entries)])
    return {"verdict": "holds", "layouts": json.loads(json.dumps(entries)), **by(command)}


def reproduced(paper: str) -> Told:
    said = by(f"heisoku reproduce {paper} --runs 1 -o out/{paper}")
    told = json.loads(json.dumps({**making.reproduced(paper, 1, 1).record(), "runs": 1, **said}))
    for row in told["rows"]:
        row["agrees"] = None if row["agrees"] is None else True
    return {**told, "verdict": "holds"}


def tables(paper: str, told: Told) -> str:
    """What stands beside the pictures of a paper."""
    rows = tuple(Row(**row) for row in told["rows"])
    return table_as_text(replace(making.reproduced(paper, 1, 1), rows=rows))


def ridden(beyond: Sequence[str | None]) -> Told:
    one = {
        "rides": 100,
        "long": 0,
        "violations": dict.fromkeys(VIOLATIONS, 0),
        "assumptions": dict.fromkeys(ASSUMPTIONS, 0),
        "monitors": dict.fromkeys(MONITORS, 0),
        "violated": 0,
        "unexplained": 0,
        "unnoticed": 0,
        "bound": 0.03,
        "sums": {**dict.fromkeys(COLUMNS, 0), "cycles": 100},
        "most": {**dict.fromkeys(COLUMNS, 0), "cycles": 1},
    }
    campaigns = [{"beyond": name, **one} for name in beyond]
    command = "heisoku ride --rides 100" if None in beyond else "heisoku ride --rides 100 --beyond each"
    return {"seed": 1, "campaigns": campaigns, **by(command)}


def lived(name: str) -> Told:
    system = system_of(name)
    column = {"all": 0, "most in a day": 0, "on days": 0}
    columns = {group: dict.fromkeys(getattr(system, group), column) for group in GROUPS}
    told = {"system": name, "seed": 1, "days": 5, "hours": 5 * system.hours, "bound": 0.6, "beyond": {}}
    return {**told, "violated": 0, "unexplained": 0, "columns": columns, **by(f"heisoku days {name} --days=5")}


def fuzzed() -> Told:
    sought = [
        {"kind": each.kind, "fault": each.name, "target": "walks", "batches": 1, "seconds": 1.0} for each in planted(1)
    ]
    command = " ".join(["heisoku fuzz layouts/ring.toml", *(f"--target {each}" for each in expected_campaign.WHOLE)])
    starts = [{"at": "2026-01-01", "seed": 1, **by(command)}]
    target = {"batches": 8, "unfinished": 0, "traces": 40, "steps": 4_868, "failures": 0}
    targets = {f"{each}:ring.toml" if each in ON_LAYOUTS else each: target for each in expected_campaign.WHOLE}
    told = {"verdict": "holds", "seeds": [1], "starts": starts, "targets": targets}
    return {**told, "left_out": [], "canaries": sought, "failures": []}


def tests(names: Sequence[str]) -> str:
    cases = []
    for name in names:
        place, _, test = name.partition("::")
        cases.append(f"<testcase classname={quoteattr(place)} name={quoteattr(test)}/>")
    how = quoteattr(json.dumps(by("__main__.py -q")))
    said = f"<properties><property name={quoteattr(ABOUT)} value={how}/></properties>"
    return f'<testsuites><testsuite name="pytest">{said}{"".join(cases)}</testsuite></testsuites>'


def contracts() -> str:
    lines = [
        f"/a/{own}:{first}: info: Confirmed over all paths." for own, first, _ in expected_runs.contracts().values()
    ]
    return "\n".join([HEADING + json.dumps(by("make crosshair")), *lines, ""])


def write(folder: Path, laid_out: Laid, *, whole: bool) -> Path:
    """Write the records of all that is in ``laid_out``, with a manifest; ``whole``: of every other kind as well."""
    records = {
        "prove.json": proved(laid_out),
        "certificates.json": certified(laid_out),
        "mutate.json": mutated(None if whole else with_classed()),
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
    (folder / TABLES).parent.mkdir()
    (folder / TABLES).write_text(tables("000", records["000.json"]), "utf-8")
    (folder / A_PROOF).parent.mkdir(parents=True)
    (folder / A_PROOF).write_bytes(gzip.compress(PROOF, mtime=0))
    bind(folder)
    return folder


def bind(folder: Path) -> None:
    """Make the manifest anew."""
    (folder / NAME).write_text(made(folder).text(), "utf-8")


def few() -> list[Cell]:
    """Obligations of two theories."""
    return [cell for cell in laying_out.cells() if theory_of(cell[0])[0].name in ("braking", "brake_watch")]
