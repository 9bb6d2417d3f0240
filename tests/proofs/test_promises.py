"""Promises: nothing makes them vain, CPython keeps them along every witness, and what would break them is found."""

from __future__ import annotations

import ast
import copy
from collections.abc import Iterator, Mapping
from functools import cache
from itertools import product
from typing import Any

import pytest
import z3

from models.world import at_the_centre
from models.world.state import System
from proofs import promised
from proofs.catalogue import INTERLOCKING, PROMISES, STEPS
from proofs.finite import SMALL, TACTICS
from proofs.grid import GridScope
from proofs.lift.sources import Code, definition_of
from proofs.mutants.targets import mutants
from proofs.promise import Promise, still_to_go
from proofs.witnesses.registry import replay
from proofs.witnesses.scenario import Scenario
from proofs.workbench import Workbench

Subject = Mapping[str, Any]


@cache
def played() -> Mapping[str, Scenario]:
    return replay()


def states(scenario: Scenario) -> list[System]:
    """Every state of a scenario that its steps led to."""
    return [taken.after for taken in scenario.taken if taken.accepted]


def values(promise: Promise, system: System) -> Iterator[tuple[Any, ...]]:
    """What a promise can be about in a state."""
    centre, radio = system.centre, system.radio
    runs = {*centre.runs, *radio.offers, *radio.standing_runs}
    match tuple(promise.about):
        case ("run",):
            yield from product(runs)
        case ("run", "block"):
            yield from ((run, block) for block, holders in centre.claimed.items() for run in holders)
        case ("run", "block", "left", "entered"):
            yield from (
                (run, block, evidence.left, evidence.entered)
                for _train, unit in system.units.items()
                for run, order in unit.orders.items()
                for block, evidence in order.left.items()
            )
        case ("train", "epoch"):
            yield from product(system.units, [centre.epoch])
        case ("train", "life", "epoch"):
            yield from ((train, unit.life, centre.epoch) for train, unit in system.units.items())
        case ("block",):
            yield from product(centre.lost_blocks)
        case ("point",):
            yield from product(centre.lost_points)
        case about:
            raise AssertionError(f"{promise.name}: nothing is known of {about}")


def subjects(promise: Promise, scenario: Scenario) -> Iterator[Subject]:
    """What a promise can be about in a scenario."""
    for chosen in dict.fromkeys(chosen for system in states(scenario) for chosen in values(promise, system)):
        yield dict(zip(promise.about, chosen, strict=True))


def walked(promise: Promise, scenario: Scenario) -> Iterator[tuple[Subject, int | None, int | None, str, Subject]]:
    """Each step of a scenario: how far the promise was from its goal before and after it."""
    for about in subjects(promise, scenario):
        before: int | None = None
        system: System | None = None
        for taken in scenario.taken:
            if taken.accepted:
                after = still_to_go(promise, scenario.site, taken.after, about)
                if system is not None:
                    yield about, before, after, taken.step, taken.event
                before, system = after, taken.after


@pytest.mark.parametrize("promise", PROMISES.values(), ids=PROMISES)
def test_no_step_of_a_witness_leads_away_from_the_goal_and_each_links_own_leads_on(promise: Promise) -> None:
    led: set[int] = set()
    for scenario in played().values():
        for about, before, after, step, event in walked(promise, scenario):
            if before:
                assert after is not None, (promise.name, about, step, event)
                assert after <= before, (promise.name, about, step, event)
                link = promise.links[len(promise.links) - before]
                if STEPS[step] is link.by and after < before and mine(about, event):
                    led.add(before)
    assert led == set(range(1, len(promise.links) + 1))


def mine(about: Subject, event: Subject) -> bool:
    """Whether an event is one of what the promise is about."""
    return all(about.get(name, value) == value for name, value in event.items())


@cache
def bench() -> Workbench:
    """All of it in a small world, what holds before a step lifted."""
    lifted = Workbench(INTERLOCKING, GridScope(SMALL))
    assert lifted.assumed
    assert lifted.invariants
    return lifted


def refuted(of: Workbench, transition: str, name: str) -> bool:
    """Whether a small world has a step that leads away from a promise's goal, or one of its own that does not help."""
    for part in promised.parts(of, transition, name, None):
        solver = z3.Then(*TACTICS).solver()
        for formulas in part.hypotheses.values():
            solver.add(*formulas)
        solver.add(*part.given, z3.Not(part.goal))
        if solver.check() == z3.sat:
            return True
    return False


@pytest.mark.parametrize(
    ("dropped", "transition", "promise"),
    [
        ("claims.end_claims: update claimed", "release_block", "a_left_block_is_freed"),
        ("claims.end_claims: update claimed", "release_overlap", "an_overlap_is_freed"),
        ("tail_evidence.note_tail_read: union order.left", "tail_reads", "a_left_block_is_freed"),
        ("first_loop.take_offer: union unit.orders", "take_offer", "a_proved_run_is_permitted"),
        ("route_setting.note_echo: update stage", "note_echo", "a_proved_run_is_permitted"),
        ("standing.answer: update answered", "answer", "a_train_answers"),
        ("recovery.account_for: update accounted", "note_standing", "a_train_that_answered_is_accounted_for"),
        ("recovery.recover_block: update lost_blocks", "recover_block", "a_lost_block_is_found"),
    ],
)
def test_a_kernel_that_forgets_or_does_not_act_breaks_a_promise(dropped: str, transition: str, promise: str) -> None:
    (mutant,) = [one for name, one in mutants().items() if name.startswith(f"kernel.{dropped}")]
    assert refuted(bench().replacing(mutant.sources), transition, promise)


def test_a_step_that_never_comes_breaks_a_promise() -> None:
    step = at_the_centre.release_block
    assert not refuted(bench(), step.__name__, "a_left_block_is_freed")
    assert refuted(bench().replacing({step: doing_nothing(step)}), step.__name__, "a_left_block_is_freed")


def doing_nothing(step: Code) -> ast.FunctionDef:
    """A transition that leaves the state as it is."""
    tree = copy.deepcopy(definition_of(step))
    tree.body = [ast.copy_location(ast.Return(ast.Name("system", ast.Load())), tree.body[-1])]
    return ast.fix_missing_locations(tree)
