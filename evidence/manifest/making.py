"""Makes what is recorded again, from the sources and seeds, and says whether it comes to the same."""

from __future__ import annotations

import json
from collections.abc import Mapping, Sequence
from dataclasses import asdict, dataclass
from functools import cache
from pathlib import Path
from typing import Any

from evidence.manifest.forms import FORM
from fuzz.failures.command import Replayed, replay_file
from models.days.campaign import outcome as outcome_of
from models.days.kept import KeptDays
from models.days.report import record
from models.days.systems import system_of
from models.layouts import BadInput, as_json, load
from models.layouts import check as check_layout
from models.reproduce import PAPERS
from models.reproduce.tables import Reproduction
from models.rides import report
from models.rides.campaign import ride_all
from models.rides.tally import outcome
from models.shipped import shipped
from proofs import run, scripts
from proofs.certificates.checking import certified
from proofs.mutants.plays import ERRORS, witnesses
from proofs.mutants.targets import mutants
from proofs.mutants.trial import tried
from proofs.witnesses.registry import WITNESSES
from proofs.witnesses.scenario import STEPS


@dataclass(frozen=True)
class Result:
    """What came of making something again: whether it is as recorded, and in words."""

    same: bool
    says: str


def prove(told: Mapping[str, Any]) -> Result:
    """Lay the obligation out from the sources, and put it to the same solver."""
    row, column = told["transition"], told["invariant"]
    asked = run.parts(row, column)
    now = run.settle(row, column, told["solver"], told["seed"], asked, run.digest_of(asked))
    if now["smt2_sha256"] != told["smt2_sha256"]:
        return Result(False, "the sources give another text than the one recorded")
    if list(scripts.hypotheses(row, column)) != list(told["hypotheses"]):
        return Result(False, "its proof names other hypotheses")
    if now["verdict"] != told["verdict"]:
        return Result(False, f"recorded as {told['verdict']}, and now {now['verdict']}")
    return Result(True, f"{now['verdict']}, the same text")


def ask_again(some: Sequence[tuple[tuple[str, str], str]]) -> list[Result]:
    """Put a few obligations to Z3, each with the verdict recorded."""
    found = []
    for (row, column), verdict in some:
        try:
            now = run.settle(row, column, "z3", 0, run.parts(row, column), "")["verdict"]
        except FORM as error:
            found.append(Result(False, f"{row} × {column}: cannot be made from its record: {error!r}"))
            continue
        found.append(Result(now == verdict, f"{row} × {column}: recorded as {verdict}, and now {now}"))
    return found


def play(theory: str, name: str) -> Result:
    """Play a witness."""
    try:
        if theory == "interlocking":
            WITNESSES[name](STEPS)
        else:
            witnesses(theory)[name]()
    except ERRORS as error:
        return Result(False, f"fails: {error}")
    return Result(True, "goes as it says")


def check(told: Mapping[str, Any]) -> Result:
    """Check a layout."""
    try:
        imported = load(shipped(told["file"]))
    except BadInput as bad:
        return Result(told["verdict"] == "bad input", str(bad))
    given = {key: told[key] for key in ("clearance_mm", "strict") if key in told}
    now = as_json(imported, check_layout(imported, **given))
    differ = [key for key in now if key != "layout" and now[key] != told.get(key)]
    if differ:
        return Result(False, f"another {', '.join(differ)} than recorded")
    return Result(True, f"{told['verdict']}, {sum(told['checked'].values()):,} instances of axioms")


def ride(seed: int, told: Mapping[str, Any]) -> Result:
    """Ride a campaign."""
    name = told["beyond"] or ""
    rows = ride_all(seed, told["rides"], 1, [name])[name]
    campaigns = report.record(seed, {name: outcome(rows)})["campaigns"]
    assert isinstance(campaigns, list)
    differ = [key for key, value in campaigns[0].items() if value != told.get(key)]
    if differ:
        return Result(False, f"another {', '.join(differ)} than recorded")
    return Result(True, f"{told['violated']} rides with a claim broken, {told['sums']['cycles']:,} cycles")


def sums(told: Mapping[str, Any], kept: Path | None) -> Result:
    """Sum the days up again: those that are kept, or all of them simulated anew."""
    system, days = system_of(told["system"]), range(told["days"])
    rows = KeptDays(kept, system, told["seed"]).rows(days) if kept else system.simulate(told["seed"], days)
    if rows is None:
        return Result(False, "not each of the days is kept")
    now = json.loads(json.dumps(record(told["seed"], outcome_of(system, rows))))
    differ = [key for key, value in now.items() if value != told.get(key)]
    if differ:
        return Result(False, f"another {', '.join(differ)} than recorded")
    return Result(True, f"{told['violated']:,} with a claim broken, {len(system.columns)} sums")


def live(told: Mapping[str, Any], kept: Path, day: int) -> Result:
    """Live one day."""
    system = system_of(told["system"])
    rows = KeptDays(kept, system, told["seed"]).rows(range(day, day + 1))
    now = system.simulate(told["seed"], range(day, day + 1))
    if rows is None or (rows != now).any():
        return Result(False, "is not as it is kept")
    return Result(True, f"{len(system.columns)} figures as kept")


@cache
def reproduced(paper: str, seed: int, runs: int) -> Reproduction:
    """A paper reproduced, once a process; a figure of it costs as much as all."""
    return PAPERS[paper].reproduce(seed, runs, lambda *_: None)


def reproduce(paper: str, told: Mapping[str, Any]) -> Result:
    """Reproduce a paper, with all that its record says."""
    now = json.loads(json.dumps(reproduced(paper, told["seed"], told["runs"]).record()))
    rows = [
        f"{key} of {row['what']}"
        for row, recorded in zip(now["rows"], told["rows"], strict=True)
        for key in row
        if row[key] != recorded.get(key)
    ]
    differ = rows + [key for key, value in now.items() if key != "rows" and value != told.get(key)]
    if differ:
        return Result(False, f"another {', '.join(differ)} than recorded")
    return Result(True, f"{len(now['rows'])} rows: {now['verdict']}")


def certify(told: Mapping[str, Any]) -> Result:
    """Have an obligation proved and checked step by step."""
    now = asdict(certified((told["row"], told["column"])))
    differ = [key for key in ("parts", "answer", "steps", "trusted", "smt2_sha256") if now[key] != told[key]]
    if differ:
        return Result(False, f"another {', '.join(differ)} than recorded")
    return Result(True, f"{now['answer']}, {now['steps']:,} steps")


def mutate(told: Mapping[str, Any]) -> Result:
    """Try a mutant."""
    mutant = mutants().get(told["mutant"])
    if mutant is None:
        return Result(False, "there is no such mutant")
    now = tried(mutant)
    if now.outcome != told["outcome"]:
        return Result(False, f"recorded as {told['outcome']}, and now {now.outcome}")
    return Result(True, f"{now.outcome} {now.by}".strip())


def replay(folder: Path, told: Mapping[str, Any]) -> Result:
    """Replay a trace."""
    path = Path(told["trace"])
    try:
        found = replay_file(path if path.is_absolute() else folder.parent / path, False, lambda *_: None)
    except BadInput as bad:
        return Result(False, str(bad))
    again = found.found.reproduced if isinstance(found, Replayed) else bool(found.found.violated)
    return Result(again, "violated again" if again else "nothing is violated now")
