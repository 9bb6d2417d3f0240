"""Whether a drop changes anything at all: in a small world by search, on every layout by proof."""

from __future__ import annotations

from contextlib import AbstractContextManager, nullcontext
from dataclasses import dataclass
from typing import Any, get_type_hints

import z3

from kernel.centre import Centre
from models.world.state import Site, System
from proofs import solvers
from proofs.catalogue import INTERLOCKING, STEPS
from proofs.counterexample import stepped, unmet
from proofs.finite import World
from proofs.lift import Lifter, concretise, conjuncts
from proofs.lift.sources import Code
from proofs.lift.terms import same, to_z3
from proofs.mutated import Sources
from proofs.theories import theory_of
from proofs.transitions import event_types
from proofs.workbench import Part, Workbench


def is_the_same(one: System, other: System) -> bool:
    """Two states are equal; a block held for nobody may be listed or not, and so a point."""
    return (
        one.units == other.units
        and one.terminals == other.terminals
        and one.radio == other.radio
        and one.track == other.track
        and same_books(one.centre, other.centre)
        and holds_no_more(one.centre, other.centre)
        and holds_no_more(other.centre, one.centre)
    )


def same_books(one: Centre, other: Centre) -> bool:
    """The centre's memory is equal but for claims and locks."""
    return (
        one.epoch == other.epoch
        and one.newest == other.newest
        and one.accounted == other.accounted
        and one.runs == other.runs
        and one.lost_blocks == other.lost_blocks
        and one.lost_points == other.lost_points
        and one.terminal_life == other.terminal_life
        and one.supervised == other.supervised
        and one.statements == other.statements
    )


def holds_no_more(one: Centre, other: Centre) -> bool:
    """Every claim and lock of the one is in the other."""
    return all(
        run in other.claimed.get(block, frozenset()) for block in one.claimed for run in one.claimed[block]
    ) and all(
        point in other.locked and other.locked[point].get(run) == lies
        for point in one.locked
        for run, lies in one.locked[point].items()
    )


def are_equal(one: Any, other: Any) -> bool:
    """Two states of another theory are equal, field by field."""
    return one == other  # type: ignore[no-any-return]


@dataclass(frozen=True)
class Difference:
    """A state in which all invariants hold and an event that a function and its mutant take differently."""

    transition: str
    site: Site
    before: System
    event: dict[str, Any]
    after: System | None
    instead: System | None


def difference(world: World, transition: str, sources: Sources, milliseconds: int = 20_000) -> Difference | str:
    """Search a small world for a state in which the mutant does otherwise; say ``none`` or ``unknown``."""
    kinds = event_types(STEPS[transition])
    event = {name: (kind, world.scope.constant(kind, f"event.{name}")) for name, kind in kinds.items()}
    values = [value for _, value in event.values()]
    one = world.lifter.call(STEPS[transition], world.site, world.before, *values)
    other = Lifter(world.scope, sources).call(STEPS[transition], world.site, world.before, *values)
    equal = to_z3(world.lifter.formula(is_the_same, one, other))
    solver = world.solver(milliseconds)
    solver.add(z3.Not(equal), *world.pinned(event))
    answer = solver.check()
    if answer != z3.sat:
        return "none" if answer == z3.unsat else "unknown"
    model = solver.model()
    site = concretise(model, world.scope, world.site, Site)
    before = concretise(model, world.scope, world.before, System)
    given = {name: concretise(model, world.scope, value, kind) for name, (kind, value) in event.items()}
    assert not unmet(site, before)
    after = stepped(transition, site, before, given, {}).after
    instead = stepped(transition, site, before, given, sources).after
    return Difference(transition, site, before, given, after, instead)


@dataclass(frozen=True)
class Sameness:
    """What is left to prove that a mutant does just what the function does, on every layout."""

    transition: str
    goals: list[Any]


def sameness(
    bench: Workbench, row: str, sources: Sources, planted: AbstractContextManager[None] | None = None
) -> Sameness:
    """Lay out the claim that both versions of a transition come to the same state, conjunct by conjunct."""
    theory, name = theory_of(row)
    step = theory.steps[name]
    event = [bench.scope.constant(kind, f"event.{field}") for field, kind in event_types(step).items()]
    one = bench.lifter.call(step, bench.site, bench.before, *event)
    with planted or nullcontext():
        other = Lifter(bench.scope, sources).call(step, bench.site, bench.before, *event)
    if same(one, other):
        return Sameness(row, [])
    equal = is_the_same if theory is INTERLOCKING else are_equal
    return Sameness(row, conjuncts(bench.lifter.formula(equal, one, other)))


def of_the_function(bench: Workbench, function: Code, sources: Sources) -> Sameness:
    """Lay out the claim that both versions of a function give the same, whatever they are handed."""
    kinds = {name: kind for name, kind in get_type_hints(function).items() if name != "return"}
    handed = [bench.scope.constant(kind, f"handed.{name}") for name, kind in kinds.items()]
    one, other = bench.lifter.call(function, *handed), Lifter(bench.scope, sources).call(function, *handed)
    return Sameness(
        function.__name__, [] if same(one, other) else conjuncts(bench.lifter.formula(are_equal, one, other))
    )


def proved(bench: Workbench, claim: Sameness, hypotheses: list[str], rlimit: int = 8_000_000) -> bool:
    """Prove it from the axioms and invariants named, by Z3, or where Z3 is at a loss by cvc5.

    Z3 is asked in a context of its own: what it has been asked before in this process can lead it into numbers so
    long that no budget ends it.
    """
    available = {**bench.assumed, **bench.invariants}
    order = [formula for formulas in bench.always().values() for formula in formulas]
    given = [available[name] for name in hypotheses]
    for goal in claim.goals:
        apart = z3.Context()
        solver = z3.Solver(ctx=apart)
        solver.set("rlimit", rlimit)
        solver.add(*(formula.translate(apart) for formula in (*order, *given, z3.Not(goal))))
        answer = solver.check()
        if answer == z3.sat:
            return False
        part = Part({"named": given}, order, goal)
        if answer != z3.unsat and solvers.ask("cvc5", part, 0).answer != "unsat":
            return False
    return True
