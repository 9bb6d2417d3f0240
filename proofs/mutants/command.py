"""`heisoku mutate`: what becomes of the proofs when a guard, a condition or an update is dropped."""

from __future__ import annotations

import time
from collections import Counter
from collections.abc import Callable, Mapping
from pathlib import Path
from typing import Annotated, Any, NoReturn

import typer
from rich.console import Console

from models.commands import (
    EVERY_CORE,
    Jobs,
    Json,
    Scheduler,
    console,
    pattern,
    print_line,
    progress,
    refuse,
    workers,
    writable,
)
from models.exit_codes import DOES_NOT_HOLD, HOLDS, UNDECIDED, WORDS
from proofs.records import about, write_json

KILLED, CLASSED, HOLE = "killed", "classed", "hole"
"""What a mutant may become.  There is no fourth: what is unknown kills nothing."""
COUNTEREXAMPLE = "counterexample"


def mutate(
    only: Annotated[
        str | None, typer.Option(metavar="PATTERN", help="Only mutants whose name matches.", show_default=False)
    ] = None,
    sample: Annotated[
        int | None,
        typer.Option(metavar="N", min=1, help="Only N of them, always the same.", show_default=False),
    ] = None,
    joints: Annotated[
        bool, typer.Option("--joints", help="Joints between machines, and assumptions below the theorem, instead.")
    ] = False,
    jobs: Jobs = EVERY_CORE,
    scheduler: Scheduler = None,
    json: Json = None,
) -> None:
    """Drop each guard, condition and update, one after the other: a proof or a witness must notice.

    The kernel's integers are changed as well: by one, by ten times, to 0, in their sign.
    A mutant is killed by a counterexample that is replayed in CPython, or by a witness that fails.  What survives
    stands in a class that is checked; anything else is a hole (1).

    With --joints each guarantee by which one machine discharges what another assumes is replaced by true, and by each
    other invariant, and each assumption below the theorem is dropped.  One that is not needed is 1, an open one 3.
    With --scheduler processes of other machines try them, if their sources, solvers and packages are the same.

    Examples:
    * `heisoku mutate --only braking --sample 8`
    * `heisoku mutate --joints --json out/joints.json`
    """
    from proofs import contents
    from proofs.mutants import joints as between
    from proofs.mutants.record import Trials
    from proofs.mutants.targets import mutants
    from proofs.mutants.trying import chosen, try_all

    pattern(only)
    writable(json)
    names = (between.chosen if joints else chosen)(only or "", sample)
    if not names:
        what = "joint and no assumption" if joints else "mutant"
        refuse(f"--only {only}: no {what} is named so; heisoku mutate --help")
    began = time.perf_counter()

    given, trials = {"only": only, "sample": sample, **about()}, Trials()
    if joints:
        with progress("tried") as step, workers(scheduler, jobs, contents.whole) as crew:
            tried = between.record(names, crew, telling(step))
        _end_with_joints(json, {**tried, **given})
    kept = len(trials.before.intersection(names))
    with progress("tried") as step, workers(scheduler, jobs, contents.whole) as crew:
        verdicts = try_all(names, crew, trials, telling(step))
    found = record(verdicts, len(mutants()), time.perf_counter() - began)
    if json:
        write_json(json, {**found, **given})
    print_record(console(), found)
    if kept:
        print_line(console(), f"{kept:,} of them as an earlier run kept them in {trials.file}: no evidence of today")
    raise typer.Exit(exit_code(found))


def _end_with_joints(json: Path | None, tried: Mapping[str, Any]) -> NoReturn:
    from proofs.mutants import joints as between

    if json:
        write_json(json, tried)
    between.print_record(console(), tried)
    raise typer.Exit(between.exit_code(tried))


def telling(step: Callable[[int, int, str], None]) -> Callable[[int, int, str, Mapping[str, Any]], None]:
    """Give what tells progress of each trial with its outcome."""
    return lambda done, of, name, verdict: step(done, of, f"{verdict['outcome']}: {name}"[:100])


def exit_code(found: Mapping[str, Any]) -> int:
    """0 if each is killed or classed, 1 with a hole, 3 if nothing was tried."""
    if not found["mutants"]:
        return UNDECIDED
    return DOES_NOT_HOLD if any(each["became"] == HOLE for each in found["mutants"]) else HOLDS


def record(verdicts: Mapping[str, Mapping[str, Any]], of: int, seconds: float) -> dict[str, Any]:
    """Give the trials as they are written to a file; ``of``: how many mutants there are."""
    from proofs.mutants.classes import table

    rows = [
        {
            "mutant": name,
            "theories": verdict["theories"],
            "became": HOLE if verdict["objection"] else CLASSED if verdict["class"] else KILLED,
            "outcome": verdict["outcome"],
            "by": verdict["by"],
            "finding": verdict["finding"],
            "searched": verdict["searched"],
            "class": verdict["class"],
            "why": table()[name].why if verdict["class"] else "",
            "objection": verdict["objection"],
            "seconds": verdict["seconds"],
        }
        for name, verdict in verdicts.items()
    ]
    whole = {"mutants": rows, "of": of, "seconds": round(seconds, 1)}
    return {"verdict": WORDS[exit_code(whole)], **whole, "kills": kills(rows)}


def kills(rows: list[dict[str, Any]]) -> dict[str, dict[str, int]]:
    """How many mutants each invariant of the theories tried kills; 0 stands for one that kills nothing."""
    from proofs.theories import THEORIES

    tried = {name for row in rows for name in row["theories"]}
    counts = {name: dict.fromkeys(THEORIES[name].invariants, 0) for name in THEORIES if name in tried}
    for row in rows:
        if row["outcome"] == COUNTEREXAMPLE:
            false = set(row["finding"].split(", "))
            for name in row["theories"]:
                for claim in false & counts[name].keys():
                    counts[name][claim] += 1
    return counts


def print_record(out: Console, found: Mapping[str, Any]) -> None:
    """Print the holes, what kills nothing, and the sum."""
    for each in found["mutants"]:
        if each["became"] == HOLE:
            print_line(out, f"hole: {each['mutant']}: {each['objection']}")
    for theory, counts in found["kills"].items() if len(found["mutants"]) == found["of"] else ():
        idle = [name for name, count in counts.items() if not count]
        if idle:
            print_line(out, f"{theory}: no mutant is killed by {', '.join(idle)}")
    became = Counter(each["became"] for each in found["mutants"])
    by = Counter(each["outcome"] for each in found["mutants"] if each["became"] == KILLED)
    classes = Counter(each["class"] for each in found["mutants"] if each["became"] == CLASSED)
    told = ", ".join(f"{became[word]:,} {word}" for word in (KILLED, CLASSED, HOLE))
    told += f" ({', '.join(f'{name} {count:,}' for name, count in [*by.items(), *classes.items()])})"
    print_line(out, f"{len(found['mutants']):,} of {found['of']:,} mutants: {told}: {found['verdict']}")
