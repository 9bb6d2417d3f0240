"""The world that shares nothing with the proof sees every hazard, finds every planted fault, and lets trains run."""

from __future__ import annotations

import ast
from dataclasses import replace
from pathlib import Path

import pytest

from kernel.names import Point, Position, Train
from tests.independent.world.cab import BOUNDS
from tests.independent.world.campaign import Tally, campaign, campaigns, happens_again, layouts, live, shrunk
from tests.independent.world.drawn import LAYOUTS, told
from tests.independent.world.hazards import COLLISION, FREED, POINT, TRACK_ENDS, UNHELD, Hazard
from tests.independent.world.kernel_calls import Board, Calls
from tests.independent.world.planted_faults import FAULTS as PLANTED
from tests.independent.world.planted_faults import (
    AnswersUnbraked,
    BrakeNotHeld,
    EvidenceAcrossTurns,
    EvidenceAhead,
    LifeConfirmed,
    NothingCompared,
    RunSetAhead,
    UnlockedUndetected,
)
from tests.independent.world.schedule import Schedule
from tests.independent.world.sight import Sight
from tests.independent.world.told import TAG_MM
from tests.independent.world.trains import LAID_MM, OVERHANG_MM, WINDOW_MM
from tests.independent.world.world import World

SHORT_STEPS = 1_500
SEEDS = range(2, 9)
"""Not every world gets a train moving: some stand where no route begins."""
LONG_STEPS = 5_000_000
MOST_REFUSED = 0.4
"""Of all steps at most so many change nothing."""
FOUND_WITHIN = 60_000
FOUND_FROM_THE_FIRST = 12_000_000
"""The rarest fault, evidence across changes of ends, comes about once in some two million steps of its habit."""
FAULTS: list[tuple[type[Calls], str, int, str | None]] = [
    (EvidenceAhead, "ring", 116, None),
    (EvidenceAcrossTurns, "line", 11501, "to and fro"),
    (BrakeNotHeld, "terminus", 1, None),
    (RunSetAhead, "ring", 1008, None),
    (NothingCompared, "crossover", 207, None),
    (LifeConfirmed, "line", 6, None),
    (AnswersUnbraked, "line", 9, None),
    (UnlockedUndetected, "station", 1177, None),
]
"""A fault, a layout that shows it, the first seed that does, and how the line is run there, if not in any way."""
HERE = Path(__file__).parent
TYPES = {"kernel.names", "kernel.layout", "kernel.maps", "kernel.standstill"}
"""What other files may import of the kernel: names, maps, the layout that it is told, and what sensors say."""


def imported(path: Path) -> set[str]:
    found = set()
    for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
        if isinstance(node, ast.Import):
            found |= {alias.name for alias in node.names}
        elif isinstance(node, ast.ImportFrom):
            found |= {
                f"{node.module}.{alias.name}" if node.module == "kernel" else str(node.module) for alias in node.names
            }
    return found


@pytest.mark.parametrize("path", [*HERE.glob("*.py")], ids=lambda path: path.name)
def test_the_kernel_is_called_in_one_file(path: Path) -> None:
    of_kernel = {name for name in imported(path) if name.split(".")[0] == "kernel"}
    if path.name not in ("cab.py", "kernel_calls.py", "planted_faults.py"):
        assert of_kernel <= TYPES | {"kernel.names.Stage"}


def test_a_second_tag_of_a_pair_is_read_beyond_its_boundary() -> None:
    assert TAG_MM > OVERHANG_MM + WINDOW_MM + LAID_MM


# ---- what this world sees


class NoBrake(Calls):
    """A brake that never comes on."""

    def supervise(self, board: Board, sight: Sight, demanded: bool, acknowledged: bool) -> bool:
        return False


class NoBrakeNorClaims(NoBrake):
    """The same, and nobody looks whose a block is."""

    def holders(self, centre: object, block: object) -> None:
        return None


def seen_with(kernel: type[Calls], layout: str, seeds: range = range(1, 40)) -> set[str]:
    """The kinds of hazard that trains come to which just run on."""
    kinds = set()
    for seed in seeds:
        world = World(told(layout, 2), kernel, 2, seed)
        try:
            for train in list(world.trains) * 30:
                world.happen(("move", train, 60, 0, seed))
        except Hazard as hazard:
            kinds.add(hazard.kind)
    return kinds


def test_trains_without_a_brake_come_to_the_end_of_track() -> None:
    assert TRACK_ENDS in seen_with(NoBrake, "line")


def test_trains_without_a_brake_come_together() -> None:
    assert seen_with(NoBrakeNorClaims, "ring") <= {COLLISION, TRACK_ENDS}
    assert COLLISION in seen_with(NoBrakeNorClaims, "ring")
    assert COLLISION in seen_with(NoBrakeNorClaims, "eight")


def test_trains_without_a_brake_come_to_points_that_lie_wrongly() -> None:
    assert POINT in seen_with(NoBrakeNorClaims, "scissors")


def standing_over_a_point() -> tuple[World, Train, Point]:
    for seed in range(1, 200):
        world = World(told("wye", 1), Calls, 1, seed)
        for train in world.trains.values():
            for point in train.body.points():
                return world, train.name, point
    raise AssertionError("no train stands over a point")


def test_a_point_that_moves_below_a_car_is_seen() -> None:
    world, _, point = standing_over_a_point()
    machine = world.terminals[point]
    other = next(Position(p) for p in ("normal", "reverse") if p != world.lies[point])
    assert not world.happen(("throw", point, other)), "a locked point does not move"
    run = world.calls.run_of(
        world.centre, Train("T1"), world.calls.life(world.trains[Train("T1")].board), next(iter(world.told.paths))
    )
    order = ("relayed order", point, run, other, machine.life)
    world.terminals[point] = world.calls.terminal_hears(machine, order, world.lies[point], True)
    with pytest.raises(Hazard, match=POINT):
        world.happen(("throw", point, other))


def told_of_standing(world: World) -> None:
    """Every train answers, and the centre takes its word."""
    for train in world.trains:
        for event in (("centre_challenges", train), ("train_says", train, "answered", None)):
            world.happen(event)
            world.happen(("deliver", world.air[-1], False))


def test_a_block_that_is_held_for_nobody_around_a_car_is_seen() -> None:
    world = World(told("line", 1), Calls, 1, 1)
    (train,) = world.trains.values()
    told_of_standing(world)
    block = next(iter(train.blocks))
    world.happen(("recover_block", block))
    world.calls.restart_board(train.board, train)
    life = world.calls.life(train.board)
    elsewhere = (
        "standing",
        "centre",
        train.name,
        life,
        world.centre.epoch,
        frozenset(world.told.layout.blocks - train.blocks),
    )
    world.air.append(elsewhere)
    with pytest.raises(Hazard, match=FREED):
        world.happen(("deliver", elsewhere, False))


def test_a_train_whose_unit_is_isolated_is_scotched_first() -> None:
    """Its brake may just have been put on, and have yet to respond."""
    world = World(told("line", 1), Calls, 1, 1)
    (train,) = world.trains.values()
    train.braked_cycles = 0
    assert world.happen(("isolate", train.name))
    assert train.braked_cycles > BOUNDS.response_cycles


# ---- what this world finds


def test_every_planted_fault_is_looked_for() -> None:
    assert {fault for fault, _, _, _ in FAULTS} == set(PLANTED)


@pytest.mark.parametrize(
    ("fault", "layout", "seed", "habit"), FAULTS, ids=lambda value: getattr(value, "__name__", None)
)
def test_every_planted_fault_is_found(fault: type[Calls], layout: str, seed: int, habit: str | None) -> None:
    tally = campaign(layout, fault, FOUND_WITHIN, seed, habit=habit)
    assert tally.found, f"{fault.__doc__} is not found within {FOUND_WITHIN} steps"
    assert tally.found[0].kind in (FREED, UNHELD, COLLISION, POINT)


@pytest.mark.parametrize("fault", [LifeConfirmed, AnswersUnbraked, pytest.param(RunSetAhead, marks=pytest.mark.slow)])
def test_a_hazard_is_seen_again_and_its_events_are_made_few(fault: type[Calls]) -> None:
    """One after two thousand events takes minutes."""
    ((layout, seed),) = [(layout, seed) for planted, layout, seed, _ in FAULTS if planted is fault]
    (found,) = campaign(layout, fault, FOUND_WITHIN, seed).found
    assert happens_again(found, fault, found.events) == found.kind
    few = shrunk(found, fault)
    assert len(few) < len(found.events)
    assert happens_again(found, fault, few) == found.kind
    assert all(happens_again(found, fault, few[:at] + few[at + 1 :]) != found.kind for at in range(len(few)))


@pytest.mark.parametrize("layout", layouts())
def test_a_layout_is_without_hazard(layout: str) -> None:
    tally = Tally()
    for seed in SEEDS:
        found = live(layout, Calls, seed, SHORT_STEPS, tally)
        assert found is None, f"seed {found.seed}: {found.text}"
    assert tally.refused <= MOST_REFUSED * tally.steps
    assert tally.moved_mm > 0


def test_a_train_nearly_as_long_as_its_ring_keeps_the_block_that_it_comes_round_into() -> None:
    """Its tail leaves a block while its head is in it already, from the other side."""
    world = World(replace(told("ring", 1), lengths_mm=(450_000, 480_000, 540_000)), Calls, 1, 128)
    schedule = Schedule(world, 128)
    for _ in range(SHORT_STEPS):
        world.happen(schedule.next())


@pytest.mark.slow
def test_every_layout_is_without_hazard_for_long() -> None:
    tallies = campaigns(layouts(), Calls, LONG_STEPS, 1, 2)
    assert {name: [found.text for found in tally.found] for name, tally in tallies.items() if tally.found} == {}
    assert all(tally.refused <= MOST_REFUSED * tally.steps for tally in tallies.values())


@pytest.mark.slow
@pytest.mark.parametrize(
    ("fault", "habit"),
    [(fault, habit) for fault, _, _, habit in FAULTS],
    ids=lambda value: getattr(value, "__name__", None),
)
def test_every_planted_fault_is_found_from_the_first_seed_on(fault: type[Calls], habit: str | None) -> None:
    tallies = campaigns(list(LAYOUTS), fault, FOUND_FROM_THE_FIRST, 1, 2, habit=habit)
    assert any(tally.found for tally in tallies.values())
