"""What rests on what, both ways, by the record of mutants: a drop that breaks an invariant is what it rests on.

A search ends with the first counterexample, so that an invariant may rest on more than is told here, never on less.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import Any

from proofs.theories import theory_of
from proofs.theory import EVERY_LOOKUP_IS_DEFINED


@dataclass(frozen=True)
class Drop:
    """A guard, condition or update that was dropped, and what came of that.

    ``breaks``: the invariants that do not hold without it, by ``theory.name``; a step that raises breaks that every
    lookup is defined.  ``fails``: the witness that fails, where no invariant was broken.  ``kept_as``: the class of a
    survivor, and ``why``.
    """

    function: str
    what: str
    over: str
    breaks: tuple[str, ...]
    fails: str
    kept_as: str
    why: str

    @property
    def carries(self) -> bool:
        """Whether an invariant rests on it."""
        return bool(self.breaks)


@dataclass(frozen=True)
class Resting:
    """All that was dropped."""

    drops: Sequence[Drop]

    @cached_property
    def by_function(self) -> Mapping[str, list[Drop]]:
        """What was dropped of each function."""
        found: dict[str, list[Drop]] = {}
        for each in self.drops:
            found.setdefault(each.function, []).append(each)
        return dict(sorted(found.items()))

    @cached_property
    def by_invariant(self) -> Mapping[str, list[Drop]]:
        """What each invariant rests on."""
        found: dict[str, list[Drop]] = {}
        for each in self.drops:
            for name in each.breaks:
                found.setdefault(name, []).append(each)
        return found

    @cached_property
    def idle(self) -> Sequence[Drop]:
        """Guards and updates on which no invariant rests."""
        return [each for each in self.drops if not each.carries]


def resting(rows: Sequence[Mapping[str, Any]]) -> Resting:
    """Read the rows of the record; in the order of their names."""
    return Resting(sorted((_drop(row) for row in rows), key=lambda each: (each.function, each.what)))


def _drop(row: Mapping[str, Any]) -> Drop:
    function, _, what = row["mutant"].partition(": ")
    found = row["outcome"] == "counterexample"
    return Drop(
        function,
        what,
        row["by"] if found else "",
        _broken(row["by"], row["finding"]) if found and row["became"] == "killed" else (),
        row["by"] if row["outcome"] == "witness" else "",
        row["class"],
        row["why"],
    )


def _broken(over: str, finding: str) -> tuple[str, ...]:
    """The invariants that a finding names; what is none of them is an error that the step raised."""
    theory, _ = theory_of(over)
    names = [name for name in finding.split(", ") if name in theory.invariants]
    return tuple(f"{theory.name}.{name}" for name in names or [EVERY_LOOKUP_IS_DEFINED])
