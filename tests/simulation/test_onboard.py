"""What the machines on board of a simulated train say of it where it has rolled back."""

from __future__ import annotations

from dataclasses import replace
from random import Random

import pytest

from kernel.onboard import computer
from kernel.onboard.way import Way
from kernel.standstill import is_braked
from models.rides.plan import PLAN
from models.simulation.cycles import Ran
from models.simulation.onboard import OnBoard, on_board
from models.simulation.sensors import Errors, Sensors
from models.simulation.simulation import Simulation
from models.simulation.vehicle import Line, Vehicle
from models.simulator.play import Play
from tests.simulation.lines import plan


def test_a_tail_that_has_rolled_back_too_far_counts_no_more() -> None:
    board = on_board(120_000, 500_000)
    spacing, motion = replace(board.computer.spacing, checked=True), board.computer.known.motion
    board.computer = replace(board.computer, spacing=spacing, before=motion)
    assert board.line(True).fits
    known = board.computer.known
    rolled = replace(known, movement=replace(known.movement, reversed=True))
    board.computer = replace(board.computer, known=rolled)
    assert not board.line(True).fits


AT_REST_CYCLES = 2 * PLAN.brake.response_cycles
"""After so many the brake has brought a train to rest that was located when they began."""


def standing(board: OnBoard, cycles: int) -> None:
    """So many cycles pass at rest."""
    sensors = Sensors(Random(1), Errors(0.0, 0.0, 0.0))
    for _ in range(cycles):
        board.decide(True, False)
        board.computer = computer.sense(board.limits, board.computer, *sensors.read(0.0, 0.0, 0.0))


def test_a_brake_holds_the_train_once_it_has_stopped_what_may_have_been_gained_before_its_response() -> None:
    """A train that has just been located may have begun to run by as much as its sensors let it, until then."""
    board = on_board(120_000, 500_000)
    standing(board, PLAN.brake.response_cycles)
    assert is_braked(board.standstill)
    assert not board.hold()
    standing(board, AT_REST_CYCLES - PLAN.brake.response_cycles)
    assert board.hold()


def test_a_train_is_located_anew_only_while_its_brake_holds_it() -> None:
    """And has brought it to rest.  What was found of a faulty brake stays."""
    board = on_board(120_000, 500_000)
    standing(board, AT_REST_CYCLES)
    known = board.computer.known
    found = replace(board.computer, known=replace(known, watch=replace(known.watch, broken=True)))
    new = replace(found, known=replace(found.known, watch=replace(found.known.watch, cycles=0)))
    assert computer.locate(board.limits, new, 900_000, 901_000) == new
    fast = replace(found, known=replace(found.known, watch=replace(found.known.watch, limit_mm_s=20_000)))
    assert computer.locate(board.limits, fast, 900_000, 901_000) == fast
    anew = computer.locate(board.limits, found, 900_000, 901_000)
    assert computer.place(anew) == Way(True, 900_000, 901_000)
    assert anew.known.watch.broken
    assert anew.brake.applied


def test_a_false_tail_stays_one_until_staff_finds_the_train_whole() -> None:
    """A change of ends, or being located anew, does not put it right."""
    board = on_board(120_000, 500_000)
    standing(board, AT_REST_CYCLES)
    board.computer = replace(board.computer, spacing=replace(board.computer.spacing, checked=True, broken=True))
    board.locate(900_000, 901_000)
    assert board.computer.spacing.broken
    board.made_up()
    assert not board.computer.spacing.broken


def test_the_brake_is_asked_where_the_train_is_and_not_where_it_was(monkeypatch: pytest.MonkeyPatch) -> None:
    """While the train stands still between two cycles its orders are read, and the brake is decided on."""
    asked, decided = list[bool](), list[bool]()

    def is_there(vehicle: Vehicle) -> bool:
        place = vehicle.board.place
        return not place.known or place.least_mm - 1 <= vehicle.front_mm <= place.most_mm + 1

    def demanded(vehicle: Vehicle, play: Play) -> bool:
        asked.append(is_there(vehicle))
        return asks(vehicle, play)

    def cycles(vehicle: Vehicle, line: Line, most: int) -> Ran:
        decided.append(is_there(vehicle))
        return goes(vehicle, line, min(most, 1))

    asks, goes = Vehicle.demanded, Vehicle.cycles
    monkeypatch.setattr(Vehicle, "demanded", demanded)
    monkeypatch.setattr(Vehicle, "cycles", cycles)
    Simulation(plan("passing_station", seed=3, chosen={})).run()
    assert len(asked) > 1_000
    assert all(asked)
    assert all(decided)


def test_the_list_of_a_run_that_is_given_back_is_dropped() -> None:
    """Its points may lie for another run from then on, so that it is true of the track no longer (T9)."""
    sim = Simulation(plan("passing_station"))
    while not (listed := [train for train, each in sim.vehicles.items() if each.board.lists]):
        sim.second()
    board, unit = sim.vehicles[listed[0]].board, sim.play.system.units[listed[0]]
    (run,) = board.lists
    board.follow(unit)
    assert set(board.lists) == {run}
    board.follow(replace(unit, orders=unit.orders | {run: replace(unit.orders[run], given_back=True)}))
    assert not board.lists
    assert board.brake.withheld
