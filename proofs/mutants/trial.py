"""One mutant on trial: a finite counterexample, a failing witness, or it survives.

The order is by price: a small world, the witnesses, a larger world.
"""

from __future__ import annotations

import time
from collections.abc import Callable
from dataclasses import asdict, dataclass
from functools import cache
from typing import Any

from proofs.counterexample import Unfaithful, search
from proofs.finite import LARGER, SMALL, Sizes, World
from proofs.lift import Mismatch, OutsideSubset
from proofs.mutants.edits import Mutant
from proofs.mutants.onlookers import failures
from proofs.mutants.targets import transitions_of
from proofs.mutated import Sources

NOT_LIFTED = (OutsideSubset, Mismatch, AttributeError, TypeError)
"""A mutant that no type checker would pass, such as ``None`` where a value must be: CPython alone judges it."""

MILLISECONDS = {"small": 20_000, "larger": 10_000}
"""For one question of a small and of a larger world; ``unknown`` kills nothing."""


@dataclass(frozen=True)
class Verdict:
    """What became of a mutant: ``counterexample``, ``witness`` or ``survived``.

    ``by``: the transition, or the witness.  ``finding``: the invariants that are false after the
    step, what it raised, or what the witness says.  ``searched``: how far the search came.
    """

    outcome: str
    by: str
    finding: str
    searched: dict[str, str]
    seconds: float

    def record(self) -> dict[str, Any]:
        """The verdict as it is written to the record."""
        return asdict(self)


@cache
def world(size: str) -> World:
    """The small or the larger world, lifted once a process."""
    sizes: Sizes = SMALL if size == "small" else LARGER
    lifted = World(sizes)
    assert lifted.preconditions
    return lifted


def tried(mutant: Mutant) -> Verdict:
    """Try one mutant."""
    return tried_with(mutant, mutant.sources)


def tried_with(mutant: Mutant, sources: Sources) -> Verdict:
    """Try a mutant, perhaps with others beside it."""
    began = time.perf_counter()
    searched: dict[str, str] = {}
    for look in (_in("small"), _by_witnesses, _in("larger")):
        found = look(mutant, sources, searched)
        if found is not None:
            outcome, by, finding = found
            return Verdict(outcome, by, finding, searched, round(time.perf_counter() - began, 2))
    return Verdict("survived", "", "", searched, round(time.perf_counter() - began, 2))


Found = tuple[str, str, str] | None
Look = Callable[[Mutant, Sources, dict[str, str]], Found]


def _in(size: str) -> Look:
    """Look for a counterexample in a world of this size."""

    def look(mutant: Mutant, sources: Sources, searched: dict[str, str]) -> Found:
        for transition in transitions_of(mutant.function):
            try:
                answer = search(world(size), transition, sources, MILLISECONDS[size])
            except Unfaithful as error:
                searched[f"{transition}, {size}"] = f"error of ours: {error}"
                continue
            except NOT_LIFTED as error:
                searched[f"{transition}, {size}"] = f"not lifted: {error}"
                continue
            searched[f"{transition}, {size}"] = answer.verdict
            if answer.found is not None:
                return "counterexample", transition, answer.found.finding
        return None

    return look


def _by_witnesses(mutant: Mutant, sources: Sources, searched: dict[str, str]) -> Found:
    """Look for a witness that fails."""
    found = failures(mutant.function, sources)
    searched["witnesses"] = "fails" if found else "none"
    return ("witness", found[0].witness, found[0].message[:400]) if found else None
