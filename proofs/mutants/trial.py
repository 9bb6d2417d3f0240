"""One mutant on trial: a counterexample, a failing witness, or it survives.

The order is by price: a small world, the witnesses, a larger world.  Theories beside the interlocking
reckon with integers, and have one world, which is as large as integers are.
"""

from __future__ import annotations

import time
from collections.abc import Callable
from dataclasses import asdict, dataclass
from functools import cache
from typing import Any

import z3

from models.world.state import Site, System
from proofs.catalogue import INTERLOCKING, INVARIANTS
from proofs.counterexample import Unfaithful, search, unmet
from proofs.finite import LARGER, SMALL, Sizes, World
from proofs.lift import Lifter, Mismatch, OutsideSubset, concretise
from proofs.lift.terms import to_z3
from proofs.mutants import steps
from proofs.mutants.edits import Mutant
from proofs.mutants.onlookers import calls, failures
from proofs.mutants.steps import sites
from proofs.mutants.targets import called_by, of_interlocking, rows_of, theories_with
from proofs.mutated import Sources, running

NOT_LIFTED = (OutsideSubset, Mismatch, AttributeError, TypeError)
"""A mutant that no type checker would pass, such as ``None`` where a value must be: CPython alone judges it."""

MILLISECONDS = {"small": 20_000, "larger": 10_000, "integers": 3_000}
"""For one question of a small and of a larger world, and of integers; ``unknown`` kills nothing."""


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
    ready_for(mutant)
    with mutant.planted():
        for look in (_in("small"), _in_what_is_said, _in_integers, _by_witnesses, _in("larger")):
            found = look(mutant, sources, searched)
            if found is not None:
                outcome, by, finding = found
                return Verdict(outcome, by, finding, searched, round(time.perf_counter() - began, 2))
    return Verdict("survived", "", "", searched, round(time.perf_counter() - began, 2))


def ready_for(mutant: Mutant) -> None:
    """Note what the witnesses do as long as nothing is planted: it is noted once a process."""
    for theory in theories_with(mutant):
        if theory is INTERLOCKING:
            calls()
        else:
            sites(theory.name)


Found = tuple[str, str, str] | None
Look = Callable[[Mutant, Sources, dict[str, str]], Found]


def _in(size: str) -> Look:
    """Look for a counterexample in a world of this size."""

    def look(mutant: Mutant, sources: Sources, searched: dict[str, str]) -> Found:
        lift = cache(world.__wrapped__) if mutant.is_of_a_module else world
        for transition in filter(of_interlocking, rows_of(mutant)):
            try:
                answer = search(lift(size), transition, sources, MILLISECONDS[size])
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


def _in_what_is_said(mutant: Mutant, sources: Sources, searched: dict[str, str]) -> Found:
    """Look in a small world for a state that is as it should be, and of which the kernel with the drop says otherwise.

    A claim that asks the kernel for its word, as for whether a train may proceed, is a claim about that word.
    """
    if mutant.is_of_a_module or not all(function.__module__.startswith("kernel.") for function in mutant.functions):
        return None
    for name, claim in INVARIANTS.items():
        if not any(map(mutant.touches, called_by(claim))):
            continue
        small = world("small")
        solver = small.solver(MILLISECONDS["small"])
        try:
            solver.add(z3.Not(to_z3(Lifter(small.scope, sources).formula(claim, small.site, small.before))))
        except NOT_LIFTED as error:
            searched[name] = f"not lifted: {error}"
            continue
        searched[name] = str(solver.check())
        if searched[name] == "sat":
            model = solver.model()
            site = concretise(model, small.scope, small.site, Site)
            before = concretise(model, small.scope, small.before, System)
            with running(sources):
                holds = claim(site, before)
            if not holds and not unmet(site, before):
                return "counterexample", INTERLOCKING.name, name
    return None


def _in_integers(mutant: Mutant, sources: Sources, searched: dict[str, str]) -> Found:
    """Look for a counterexample in the theories beside the interlocking.

    What only a claim asks of a machine, and no step, is looked for in a single state.
    """
    steps_with_it = rows_of(mutant)
    lift = cache(steps.lifted_anew) if mutant.is_of_a_module else steps.lifted
    rows = [row for row in steps_with_it if not of_interlocking(row)]
    claimed = [] if steps_with_it else [theory.name for theory in theories_with(mutant)]
    for place in [*rows, *claimed]:
        try:
            if place in claimed:
                found, searched[place] = lift(place, None).search_claims(sources, MILLISECONDS["integers"])
            else:
                found, searched[place] = steps.search(place, sources, MILLISECONDS["integers"], lift)
        except Unfaithful as error:
            searched[place] = f"error of ours: {error}"
            continue
        except NOT_LIFTED as error:
            searched[place] = f"not lifted: {error}"
            continue
        if found is not None:
            return "counterexample", place, found.finding
    return None


def _by_witnesses(mutant: Mutant, sources: Sources, searched: dict[str, str]) -> Found:
    """Look for a witness that fails."""
    found = failures(mutant, sources)
    searched["witnesses"] = "fails" if found else "none"
    return ("witness", found[0].witness, found[0].message[:400]) if found else None
