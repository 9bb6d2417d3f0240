"""Compiled cycles of a train are CPython's: event by event, to the last bit of every train's place."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from typing import Any

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from kernel.onboard import computer as computing
from models.layouts import load
from models.simulation.beginning import Plan
from models.simulation.compiled import Compiled
from models.simulation.cycles import Cycling, Interpreted
from models.simulation.faults import Chosen, Setting
from models.simulation.sensors import DRAWN_CYCLES
from models.simulation.simulation import Simulation
from models.world.state import System
from tests.layouts.stations import SHARED, needs_shared
from tests.simulation.lines import HARD, SAMPLES, plan

ON_BOARD: Chosen = {
    name: Setting(40.0, setting.least, setting.most)
    for name, setting in HARD.items()
    if name in ("wheel_slip", "tachometer_silent", "inertial_silent", "line_broken", "stop_on_line", "train_parts")
}
"""What becomes of sensors, wheels and couplings, so often that hardly a minute is without."""
HARDER: Chosen = {**HARD, **ON_BOARD}


class Told:
    """A simulation that writes down each step of the world, and each second of every train."""

    def __init__(self, given: Plan, cycling: Cycling) -> None:
        self.steps: list[tuple[str, Mapping[str, Any]]] = []
        self.seconds: list[list[Any]] = []
        self.sim = Simulation(given, self._step, cycling)
        self.sim.run(self._second)

    def _step(self, step: str, event: Mapping[str, Any], system: System) -> None:
        del system
        self.steps.append((step, dict(event)))

    def _second(self, now: Simulation) -> None:
        self.seconds.append(
            [
                (
                    each.moving,
                    each.board.computer,
                    dict(each.board.lists),
                    each.sensors.kept,
                    each.on_rails.front_mm,
                    each.at_rest_cycles,
                )
                for each in now.vehicles.values()
            ]
        )


def assert_same(given: Plan) -> Told:
    """Run it by both; everything must be the same."""
    mine, other = Told(given, Compiled), Told(given, Interpreted)
    assert mine.steps == other.steps
    for one, two in zip(mine.seconds, other.seconds, strict=True):
        assert one == two
    assert mine.sim.diary.events == other.sim.diary.events
    assert mine.sim.oracles.checked == other.sim.oracles.checked
    assert mine.sim.oracles.found == other.sim.oracles.found
    assert mine.sim.links.outcomes == other.sim.links.outcomes
    return mine


@settings(max_examples=4, deadline=None)
@given(place=st.sampled_from(SAMPLES), seed=st.integers(0, 2**31 - 1), chosen=st.sampled_from((HARD, HARDER)))
def test_compiled_cycles_are_those_of_cpython(place: str, seed: int, chosen: Chosen) -> None:
    told = assert_same(plan(place, seed, hours=0.1, chosen=chosen))
    assert told.steps
    assert any(vehicle.way_mm > 0 for vehicle in told.sim.vehicles.values())


@needs_shared
def test_they_are_on_a_real_network() -> None:
    told = assert_same(Plan(load(SHARED / "osrd-small_infra.json"), 2, 20, 0.05, HARDER))
    assert sum(vehicle.way_mm for vehicle in told.sim.vehicles.values()) > 1_000_000


def test_what_an_oracle_finds_is_told_alike() -> None:
    """A train whose odometry has been made to claim another place is found out in the same cycle, in the same words."""

    def broken(cycling: Cycling) -> Simulation:
        sim = Simulation(plan("passing_station", trains=1, chosen={}, hours=0.2), None, cycling)
        vehicle = next(iter(sim.vehicles.values()))
        while vehicle.speed_mm_s < 10_000:
            sim.second()
        computer = vehicle.board.computer
        motion = computer.known.motion
        motion = replace(
            motion,
            front_least_mm=motion.front_least_mm - 50_000,
            front_most_mm=motion.front_most_mm - 50_000,
            anchor_least_mm=motion.anchor_least_mm - 50_000,
            anchor_most_mm=motion.anchor_most_mm - 50_000,
        )
        vehicle.board.computer = replace(computer, known=replace(computer.known, motion=motion))
        sim.run()
        return sim

    mine, other = broken(Compiled), broken(Interpreted)
    assert mine.oracles.found
    assert mine.oracles.found == other.oracles.found
    assert mine.oracles.checked == other.oracles.checked


def test_compiled_code_takes_up_a_computer_that_was_changed_beside_it() -> None:
    """What staff or orders have changed since the last cycle is what the next one begins with."""
    sim = Simulation(plan("passing_station", trains=1, chosen={}, hours=0.2), None, Compiled)
    vehicle = next(iter(sim.vehicles.values()))
    while vehicle.speed_mm_s < 10_000:
        sim.second()
    vehicle.board.hold()
    vehicle.look_again()
    vehicle.run = None
    sim.second()
    assert vehicle.board.brake.applied
    assert vehicle.moving.gained_mm_s2 < 0


@pytest.mark.parametrize("cycles", [1, 3, 10])
def test_the_noise_that_was_not_used_is_used_next(cycles: int) -> None:
    one, other = (next(iter(Simulation(plan("terminus", chosen={})).vehicles.values())).sensors for _ in range(2))
    drawn = []
    for _ in range(4):
        drawn += one.noise(10)[: 3 * cycles].tolist()
        one.ran(cycles, one.kept)
    assert drawn == other.noise(4 * cycles)[: 12 * cycles].tolist()


def test_the_noise_goes_on_where_what_was_drawn_ahead_ends() -> None:
    """Neither what is left over of it nor how much is drawn at once changes what comes."""
    one, other = (next(iter(Simulation(plan("terminus", chosen={})).vehicles.values())).sensors for _ in range(2))
    drawn = []
    for _ in range(DRAWN_CYCLES):
        drawn += one.noise(10)[:9].tolist()
        one.ran(3, one.kept)
    assert drawn == other.noise(3 * DRAWN_CYCLES)[: 9 * DRAWN_CYCLES].tolist()


def test_what_is_asked_each_second_is_what_the_whole_computer_says() -> None:
    """While it runs, and after somebody has put another computer in its place."""
    sim = Simulation(plan("passing_station", trains=1, chosen={}, hours=0.2), None, Compiled)
    vehicle = next(iter(sim.vehicles.values()))
    held, seen = vehicle.board.held, set()
    while vehicle.way_mm < 500_000:
        sim.second()
        if sim.now_s % 10 == 0:
            held.computer = computing.withhold_end(held.computer)
        told = held.motion, held.brake, held.broken, held.passed
        known = held.computer.known
        assert told == (known.motion, held.computer.brake, known.watch.broken, known.window.passed)
        seen.add(told)
    assert len(seen) > 20
