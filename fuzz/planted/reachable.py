"""Which planted faults plain walks in CPython come upon: ``python -m fuzz.planted.reachable [--seconds 8]``.

A counterexample to induction need not be reachable.  What a numbered walk finds, the same walk finds
again; its number stands in ``reachable.toml``.  In the interlocking a walk begins where everything has
just started, so the fault is truly reachable.  Beside it a walk may begin in any state near a witness's in which
all that is claimed holds.
"""

from __future__ import annotations

import argparse
import json
import re
import sys
import time
import tomllib
from collections.abc import Iterable, Mapping
from functools import cache
from pathlib import Path
from random import Random
from typing import NamedTuple

from fuzz.failures.replaying import ERRORS
from fuzz.machines import beside, moves
from fuzz.machines.places import TINY
from fuzz.machines.watched import Broken
from fuzz.planted.draw import ROOT, Planted, described, planted
from fuzz.planted.killed import rows
from models.exit_codes import HOLDS
from proofs.catalogue import INTERLOCKING
from proofs.mutated import Sources

FILE = Path(__file__).with_name("reachable.toml")
HEAD = """# Planted faults that a walk in CPython comes upon, by theory: the number of the walk, what it broke.
# Written by `python -m fuzz.planted.reachable`.
"""
LAYOUTS = (TINY, *(ROOT / "layouts" / f"{name}.toml" for name in ("junction", "passing_station", "terminus")))
"""By name, and in this order: the number of a walk on record also says on which of them it goes."""
SECONDS = 8.0


class Shown(NamedTuple):
    """Where a fault shows itself: the number of the walk, and the first claim that is false then."""

    walk: int
    violated: str


@cache
def reachable(file: Path = FILE) -> Mapping[str, Mapping[str, Shown]]:
    """For each theory the faults that a walk has found, by name, with the walk and what it broke."""
    known = tomllib.loads(file.read_text(encoding="utf-8")) if file.exists() else {}
    return {theory: {name: Shown(*shown) for name, shown in found.items()} for theory, found in known.items()}


def broken_by(theory: str, sources: Sources, number: int) -> Broken | beside.BrokenClaim | None:
    """What the walk of a number breaks in a theory with a fault running; none if nothing."""
    try:
        if theory == INTERLOCKING.name:
            moves.numbered(number, sources, LAYOUTS)
        else:
            beside.walk(theory, sources, Random(number))
    except (Broken, beside.BrokenClaim) as broken:
        return broken
    except ERRORS:
        # In a state that the fault has led to, a move may find nothing to hold on to.
        return None
    return None


def first_walk(fault: Planted, seconds: float) -> Shown | None:
    """The first walk that comes upon a fault; none within the time given."""
    began, number, sources = time.perf_counter(), 0, planted(fault.name)
    while time.perf_counter() - began < seconds:
        broken = broken_by(fault.theory, sources, number)
        if broken is not None:
            return Shown(number, violated_by(broken)[0])
        number += 1
    return None


def violated_by(broken: Broken | beside.BrokenClaim) -> tuple[str, ...]:
    """The claims that a walk broke."""
    return broken.trace.violated if isinstance(broken, Broken) else broken.violated


def text_of(found: Mapping[str, Mapping[str, Shown]]) -> str:
    """The file's text."""
    tables = []
    for theory, walks in sorted(found.items()):
        lines = [f"{json.dumps(name)} = {json.dumps(list(shown))}" for name, shown in sorted(walks.items())]
        tables.append("\n".join(["", f"[{json.dumps(theory)}]", *lines, ""]))
    return HEAD + "".join(tables)


def main(given: Iterable[str] | None = None) -> int:
    """Try every fault of ``killed.toml`` that is asked for, and write down what is found."""
    parser = argparse.ArgumentParser(prog="python -m fuzz.planted.reachable", description=__doc__)
    parser.add_argument("--seconds", type=float, default=SECONDS, help=f"for each fault; {SECONDS:g}")
    parser.add_argument("--only", default="", metavar="PATTERN", help="a regular expression on the names of faults")
    parser.add_argument("--out", type=Path, default=FILE, help="the file to write; the one beside the code")
    asked = parser.parse_args(None if given is None else list(given))
    found = {theory: dict(walks) for theory, walks in reachable(asked.out).items()}
    names = [name for name in rows() if re.search(asked.only, name)]
    hits = 0
    for done, name in enumerate(names, 1):
        fault = described(name)
        shown = first_walk(fault, asked.seconds)
        hits += shown is not None
        found.setdefault(fault.theory, {}).pop(name, None)
        if shown is not None:
            found[fault.theory][name] = shown
        asked.out.write_text(text_of(found), encoding="utf-8")
        said = "not found" if shown is None else f"walk {shown.walk}, {shown.violated}"
        print(f"{done}/{len(names)} {said}: {name}", file=sys.stderr)
    print(f"{hits} of {len(names)} faults found by walks of {asked.seconds:g} s each: {asked.out}")
    return HOLDS


if __name__ == "__main__":
    raise SystemExit(main())
