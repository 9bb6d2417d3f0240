"""`heisoku mutate`: what becomes of the proofs when a guard, a condition or an update is dropped."""

from __future__ import annotations

import os
import re
import sys
import time
from collections import Counter
from collections.abc import Mapping
from pathlib import Path
from typing import Annotated, Any, NoReturn

import typer
from rich.console import Console

from proofs.records import BAD_INPUT, DOES_NOT_HOLD, HOLDS, UNDECIDED, commit, versions, write_json

KILLED, CLASSED, HOLE = "killed", "classed", "hole"
"""What a mutant may become.  There is no fourth: what is unknown kills nothing."""
WORDS = {HOLDS: "holds", DOES_NOT_HOLD: "does not hold"}
COUNTEREXAMPLE = "counterexample"


def mutate(
    only: Annotated[
        str | None, typer.Option(metavar="PATTERN", help="Only mutants whose name matches.", show_default=False)
    ] = None,
    sample: Annotated[
        int | None,
        typer.Option(metavar="N", min=1, help="Only N of them, always the same.", show_default=False),
    ] = None,
    jobs: Annotated[int, typer.Option(metavar="N", min=1, help="Processes to use.")] = os.cpu_count() or 1,
    json: Annotated[
        Path | None, typer.Option("--json", metavar="F", help="Write the record there.", show_default=False)
    ] = None,
) -> None:
    """Drop each guard, condition and update, one after the other: a proof or a witness must notice.

    A mutant is killed by a counterexample that is replayed in CPython, or by a witness that fails.  What survives
    stands in a class that is checked; anything else is a hole (1).

    Examples:
    * `heisoku mutate --only braking --sample 8`
    """
    from proofs.mutants.record import Trials
    from proofs.mutants.targets import mutants
    from proofs.mutants.trying import chosen, try_all

    try:
        re.compile(only or "")
    except re.error as error:
        _refuse(f"--only {only}: not a pattern ({error}); give a part of a name")
    if json is not None and (json.is_dir() or not _there(json).is_dir() or not os.access(_there(json), os.W_OK)):
        _refuse(f"{json}: cannot be written; name another file")
    names = chosen(only or "", sample)
    if not names:
        _refuse(f"--only {only}: no mutant is named so; python -m proofs.mutants --help")
    began = time.perf_counter()

    def progress(done: int, of: int, name: str, verdict: Mapping[str, Any]) -> None:
        if sys.stderr.isatty():
            print(f"{done}/{of} {verdict['outcome']:14} {name[:90]}", file=sys.stderr)

    verdicts = try_all(names, jobs, Trials(), progress)
    found = record(verdicts, len(mutants()), time.perf_counter() - began)
    if json:
        write_json(json, {**found, "only": only, "sample": sample, "versions": versions(), "commit": commit()})
    print_record(Console(width=None if sys.stdout.isatty() else 120), found)
    raise typer.Exit(exit_code(found))


def _refuse(line: str) -> NoReturn:
    print("".join(char if char.isprintable() else " " for char in line), file=sys.stderr)
    raise typer.Exit(BAD_INPUT)


def _there(path: Path) -> Path:
    """What is there of the way to a path."""
    return next(folder for folder in path.absolute().parents if folder.exists())


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
    return {"verdict": WORDS[exit_code(whole)] if rows else "undecided", **whole, "kills": kills(rows)}


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
            _line(out, f"hole: {each['mutant']}: {each['objection']}")
    for theory, counts in found["kills"].items() if len(found["mutants"]) == found["of"] else ():
        idle = [name for name, count in counts.items() if not count]
        if idle:
            _line(out, f"{theory}: no mutant is killed by {', '.join(idle)}")
    became = Counter(each["became"] for each in found["mutants"])
    by = Counter(each["outcome"] for each in found["mutants"] if each["became"] == KILLED)
    classes = Counter(each["class"] for each in found["mutants"] if each["became"] == CLASSED)
    told = ", ".join(f"{became[word]:,} {word}" for word in (KILLED, CLASSED, HOLE))
    told += f" ({', '.join(f'{name} {count:,}' for name, count in [*by.items(), *classes.items()])})"
    _line(out, f"{len(found['mutants']):,} of {found['of']:,} mutants: {told}: {found['verdict']}")


def _line(out: Console, text: str) -> None:
    out.print(text, markup=False, highlight=False, soft_wrap=True)
