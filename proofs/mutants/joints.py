"""`heisoku mutate --joints`: is every joint between machines needed and right, and every assumption of nature needed?

Each guarantee that a composed theory goes on by is tried by :mod:`proofs.mutants.guarantees`, each assumption below
the theorem by :mod:`proofs.mutants.assumed`.  A joint that is tied by name alone has no obligation that could fall:
what can be tried of it is that its assumption is needed, and it is told as what it is.
"""

from __future__ import annotations

import re
import time
from collections import Counter
from collections.abc import Callable, Mapping, Sequence
from dataclasses import asdict
from functools import cache
from typing import Any

from rich.console import Console

from models.commands import print_line
from models.exit_codes import DOES_NOT_HOLD, HOLDS, UNDECIDED, WORDS
from models.processes import Workers, as_they_end
from proofs.joints import BY_NAME
from proofs.mutants import assumed, built_in, guarantees
from proofs.planted.changes import planted
from proofs.sampling import sampled

NEEDED, UNNEEDED, OPEN, BESIDE = "needed", "unneeded", "open", "beside"
"""What a guarantee or an assumption may be.  ``open``: neither a counterexample nor a proof was found; ``beside``: an
assumption of which it is said that the theorem does not rest on it, and proved."""
BECAME = {"refuted": NEEDED, "proved": UNNEEDED, "falls": NEEDED, "none": UNNEEDED}

Progress = Callable[[int, int, str, Mapping[str, Any]], object]


@cache
def uses() -> Mapping[str, guarantees.Use]:
    """Every use of a guarantee by its name."""
    return {each.name: each for each in guarantees.uses()}


def names() -> list[str]:
    """Everything that can be tried, in order: guarantees, then assumptions."""
    return [*uses(), *assumed.names()]


def chosen(only: str, sample: int | None) -> list[str]:
    """What to try."""
    return sampled([name for name in names() if re.search(only, name)], sample)


def trial(name: str) -> tuple[str, dict[str, Any]]:
    """Try one."""
    if name not in uses():
        told = assumed.tried(name)
        became = BECAME.get(told.became, OPEN)
        if became == UNNEEDED and name in assumed.beside_the_theorem():
            became = BESIDE
        return name, {"assumption": name, **asdict(told), "became": became}
    use, found = uses()[name], guarantees.tried(uses()[name])
    return name, {**asdict(use), **asdict(found), "became": became_of(found.without, found.open_with)}


def became_of(without: str, open_with: Sequence[str]) -> str:
    """What a guarantee is by what came of true, and of other invariants, in its place."""
    return OPEN if open_with else BECAME.get(without, OPEN)


def record(todo: Sequence[str], jobs: Workers, progress: Progress = lambda *_: None) -> dict[str, Any]:
    """Try all of these; what is written of it.

    Raises:
        ValueError: a text of ``built_in.toml`` is gone; so before anything is asked.
    """
    for each in (each for every in built_in.drops().values() for each in every):
        planted(each)
    began, found = time.perf_counter(), dict[str, dict[str, Any]]()
    for done, (name, told) in enumerate(as_they_end(trial, todo, jobs), 1):
        found[name] = told
        progress(done, len(todo), name, {"outcome": told["became"]})
    whole: dict[str, Any] = {
        "guarantees": [found[name] for name in todo if name in uses()],
        "assumptions": [found[name] for name in todo if name not in uses()],
        "of": {"guarantees": len(uses()), "assumptions": len(assumed.names())},
        "by_name": by_name(),
        "seconds": round(time.perf_counter() - began, 1),
    }
    return {"verdict": WORDS[exit_code(whole)], **whole}


def by_name() -> list[str]:
    """The assumptions that are tied by name alone."""
    return [link.assumption for link in assumed.whole().tied(BY_NAME)]


def exit_code(found: Mapping[str, Any]) -> int:
    """0 if each is needed, or beside the theorem as is said, 1 if one is not, 3 if one is open or nothing was tried."""
    became = {each["became"] for each in (*found["guarantees"], *found["assumptions"])}
    if UNNEEDED in became:
        return DOES_NOT_HOLD
    return UNDECIDED if OPEN in became or not became else HOLDS


def print_record(out: Console, found: Mapping[str, Any]) -> None:
    """Print what is not needed, what is open, what does as well as a guarantee, and the sums."""
    for each in found["guarantees"]:
        name = f"{each['row']} {each['column']}: {each['guarantee']}"
        if each["became"] == UNNEEDED:
            print_line(out, f"unneeded: {name}: proved without it; leave it out of the script")
        if each["became"] == OPEN:
            print_line(out, f"open: {name}: {', '.join(each['open_with']) or 'true'} in its place")
        if each["became"] != UNNEEDED and each["as_well"]:
            print_line(out, f"as well: {name}: {', '.join(each['as_well'])}")
    for each in found["assumptions"]:
        if each["became"] == UNNEEDED:
            print_line(out, f"unneeded: {each['assumption']}: nothing falls without it; it need not be assumed")
        if each["became"] == OPEN:
            print_line(out, f"open: {each['assumption']}: nothing was seen to fall without it")
        if each["became"] == BESIDE:
            print_line(out, f"beside: {each['assumption']}: the theorem does not rest on it, as is said of it")
    for what in ("guarantees", "assumptions"):
        print_line(out, f"{len(found[what]):,} of {found['of'][what]:,} {what}: {_counted(found[what])}")
    instead = sum(each["asked"] for each in found["guarantees"])
    as_well = sum(len(each["as_well"]) for each in found["guarantees"] if each["became"] != UNNEEDED)
    unknown = sum(len(each["open_with"]) for each in found["guarantees"])
    print_line(out, f"{instead:,} other invariants in their places: {as_well:,} do as well, {unknown:,} open")
    print_line(out, f"{len(found['by_name'])} joints tied by name alone: no obligation between their two sides")
    print_line(out, f"needed and right: {found['verdict']}")


def _counted(rows: Sequence[Mapping[str, Any]]) -> str:
    became = Counter(each["became"] for each in rows)
    return ", ".join(
        f"{became[word]:,} {word}" for word in (NEEDED, UNNEEDED, OPEN, BESIDE) if became[word] or word != BESIDE
    )
