"""Promises: nothing makes them vain, CPython keeps them along every witness, and what would break them is found."""

from __future__ import annotations

import ast
import copy
from collections.abc import Iterator, Mapping
from dataclasses import replace
from functools import cache
from itertools import product
from typing import Any

import pytest
import z3

from kernel.names import Tag
from kernel.onboard.odometry import Loss
from models.onboard.train_nature import Train, Whole
from models.world import at_the_centre, nature, on_board
from models.world.state import Site, System
from proofs import promised, scripts, solvers
from proofs.catalogue import INTERLOCKING, PROMISES, STEPS
from proofs.finite import SMALL, TACTICS
from proofs.grid import GridScope
from proofs.lift.sources import Code, definition_of
from proofs.mutants.targets import mutants
from proofs.onboard import train, train_service
from proofs.onboard.train_service import a_train_that_may_run_comes_to_its_end
from proofs.onboard.witnesses.one_train import END_MM, Ride
from proofs.promise import Measure, Promise, still_to_go, way_left
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


def values(promise: Promise, site: Site, system: System) -> Iterator[tuple[Any, ...]]:
    """What a promise can be about in a state."""
    centre, radio = system.centre, system.radio
    runs = {*centre.runs, *radio.offers, *radio.standing_runs}
    match tuple(promise.about):
        case ("run",):
            yield from product(runs)
        case ("run", "block"):
            yield from ((run, block) for block, holders in centre.claimed.items() for run in holders)
        case ("run", "car", "block", "target"):
            yield from (
                (run, car, block, site.layout.way[run.route][block])
                for run, block in system.track.leavable
                for car, at in system.track.at.items()
                if block in at
            )
        case ("run", "left", "entered") if promise.about["left"] is Tag:
            yield from ((run, *pair) for run in runs for pair in site.layout.tag_after.get(run.route, {}).items())
        case ("run", "left", "entered"):
            yield from (
                (run, evidence.left, evidence.entered)
                for _train, unit in system.units.items()
                for run, order in unit.orders.items()
                for _block, evidence in order.left.items()
            )
        case ("run", "left"):
            yield from (
                (run, unit.tail_read)
                for _train, unit in system.units.items()
                for run, order in unit.orders.items()
                if unit.tail_read is not None
            )
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
    for chosen in dict.fromkeys(
        chosen for system in states(scenario) for chosen in values(promise, scenario.site, system)
    ):
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


@pytest.mark.sampled(5)
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
        ("authority.may_proceed: or-operand order.begun", "start_rolling", "a_permitted_train_is_let_out_of_its_block"),
        ("authority.note_stopped: update stopped", "note_stopped", "a_train_in_its_destination_tells_it"),
        ("second_loop.advance: update expected", "head_reads", "a_head_is_known_beyond_the_boundary"),
        ("second_loop.advance: update begun", "head_reads", "a_head_is_known_beyond_the_boundary"),
        ("second_loop.enter: update entered", "head_reads", "a_head_is_known_beyond_the_boundary"),
        ("tail_evidence.note_tail_read: update left", "tail_reads", "a_tail_is_known_beyond_the_boundary"),
        ("tail_evidence.note_tail_read: update tail_read=read", "tail_reads", "a_tail_is_known_at_the_boundary"),
        ("recovery.recover_block: update lost_blocks", "recover_block", "a_lost_block_is_found"),
    ],
)
def test_a_kernel_that_forgets_or_does_not_act_breaks_a_promise(dropped: str, transition: str, promise: str) -> None:
    named = mutants()
    mutant = named.get(f"kernel.{dropped}")
    if mutant is None:
        (mutant,) = [one for name, one in named.items() if name.startswith(f"kernel.{dropped}")]
    assert refuted(bench().replacing(mutant.sources), transition, promise)


@pytest.mark.sampled(4)
@pytest.mark.parametrize(
    ("step", "promise"),
    [
        (at_the_centre.release_block, "a_left_block_is_freed"),
        (nature.start_rolling, "a_permitted_train_is_let_out_of_its_block"),
        (nature.car_moves, "a_head_gets_into_the_next_block"),
        (on_board.head_reads, "a_head_is_known_beyond_the_boundary"),
        (on_board.note_stopped, "a_train_in_its_destination_tells_it"),
        (on_board.tail_reads, "a_tail_is_known_at_the_boundary"),
        (on_board.tail_reads, "a_tail_is_known_beyond_the_boundary"),
    ],
)
def test_a_step_that_never_comes_breaks_a_promise(step: Code, promise: str) -> None:
    assert not refuted(bench(), step.__name__, promise)
    assert refuted(bench().replacing({step: doing_nothing(step)}), step.__name__, promise)


def doing_nothing(step: Code) -> ast.FunctionDef:
    """A transition that leaves the state as it is."""
    tree = copy.deepcopy(definition_of(step))
    tree.body = [ast.copy_location(ast.Return(ast.Name("system", ast.Load())), tree.body[-1])]
    return ast.fix_missing_locations(tree)


# ---- by a number of its own


class Promised(Ride):
    """A train that is asked after each step how far the promise is from its goal."""

    def __init__(self) -> None:
        """Begin before any step."""
        self.left: list[tuple[str, tuple[int, int] | None]] = []
        super().__init__()

    def step(self, name: str, **event: Any) -> Any:
        """Take it, and ask."""
        system = super().step(name, **event)
        self.left.append((name, way_left(TO_ITS_END, self.site, system, {"end_mm": END_MM})))
        return system


(TO_ITS_END,) = train.THEORY.promises.values()


def released() -> Promised:
    """A train that stands, held, with an end, which its driver lets go."""
    ride = Promised()
    for _ in range(20):
        ride.cycle(0)
    ride.step("take_end", end_mm=END_MM)
    ride.cycle(0, may_proceed=True)
    held = way_left(TO_ITS_END, ride.site, ride.system, {"end_mm": END_MM})
    ride.cycle(0, acknowledged=True)
    assert held == (2, 0)
    assert not ride.system.computer.brake.applied
    ride.left.clear()
    return ride


def test_a_train_that_runs_on_is_nearer_its_end_with_each_cycle_until_its_brake_stops_it_there() -> None:
    ride = released()
    ride.gather(5_000)
    while not ride.system.computer.brake.applied:
        ride.cycle(5_000)
    left = [way for _name, way in ride.left if way is not None]
    assert len(left) == len(ride.left)
    assert left == sorted(left, reverse=True)
    runs = [way for name, way in ride.left if name == "run_a_cycle"]
    assert len(runs) == len(set(runs)) > 100
    assert ride.left[-1][1] == (0, 0)
    assert train_service.is_near(ride.site, ride.system, END_MM)
    assert not train_service.has_a_cause(ride.site, ride.system)


def test_a_train_whose_orders_do_not_let_it_proceed_is_stopped_for_a_cause_that_has_a_name() -> None:
    ride = released()
    ride.gather(5_000)
    ride.run(5_000, may_proceed=False)
    assert ride.left[-1][1] == (0, 0)
    assert train_service.has_a_cause(ride.site, ride.system)
    assert not train_service.is_near(ride.site, ride.system, END_MM)


def the_same(site: Train, system: Whole, end_mm: int) -> int:
    """How far it would be for a train that gets nowhere."""
    return 1


def how_far_it_has_come(site: Train, system: Whole, end_mm: int) -> int:
    """How far a train is from where its kilometrage begins: less than 0 before."""
    return -system.front_nm


@pytest.mark.parametrize("rank", [None, the_same, how_far_it_has_come])
def test_what_is_no_number_of_a_way_is_not_proved(rank: Measure | None) -> None:
    held, free = TO_ITS_END.links
    assert are_proved(TO_ITS_END)
    assert not are_proved(replace(TO_ITS_END, links=(held, replace(free, rank=rank))))


def test_no_step_of_a_link_ends_in_what_is_no_goal() -> None:
    is_over = Promise(TO_ITS_END.links, its_brake_is_on_and_it_is_lost, a_train_that_may_run_comes_to_its_end)
    assert not are_proved(is_over)


def its_brake_is_on_and_it_is_lost(site: Train, system: Whole, end_mm: int) -> bool:
    """What no train comes to that nobody brakes amiss."""
    return system.computer.brake.applied and system.computer.known.motion.loss != Loss.NONE


def are_proved(given: Promise) -> bool:
    """Whether Z3 proves what a promise asks of the step of its links."""
    of = Workbench(replace(train.THEORY, promises={given.name: given}), named=False)
    names = scripts.hypotheses("train.run_a_cycle", TO_ITS_END.name)
    return all(
        solvers.ask("z3", part, 0).answer == "unsat" for part in promised.parts(of, "run_a_cycle", given.name, names)
    )
