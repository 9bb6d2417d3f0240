"""A simulated line: the same seed gives the same record, nothing is broken, and every train is accounted for."""

from __future__ import annotations

import json
from collections.abc import Mapping
from dataclasses import replace
from typing import Any

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from kernel.names import Epoch, Run, Train
from models.layouts import BadInput, load
from models.simulation.beginning import Plan
from models.simulation.each_fault import each, left_locked
from models.simulation.faults import BY_NAME, NO_FAULT, Chosen, Setting
from models.simulation.oracles import ORACLES
from models.simulation.phases import Phase
from models.simulation.simulation import Simulation
from models.simulator.play import WORLD
from models.world.state import Site, System
from tests.layouts.stations import SHARED, needs_shared
from tests.simulation.lines import HARD, ROADS, SAMPLES, plan, simulated


def text(given: Plan) -> str:
    return json.dumps(simulated(given).record())


def test_the_same_seed_gives_the_same_record_to_the_byte() -> None:
    for roads in ((), ROADS["passing_station"]):
        assert text(plan("passing_station", roads=roads)) == text(plan("passing_station", roads=roads))
    assert text(plan("passing_station")) != text(plan("passing_station", seed=2))


@settings(max_examples=6, deadline=None)
@given(place=st.sampled_from(SAMPLES), seed=st.integers(0, 2**31 - 1))
def test_nothing_is_broken_by_many_faults_and_every_train_is_accounted_for(place: str, seed: int) -> None:
    found = simulated(plan(place, seed, hours=0.15, chosen=HARD))
    assert found.holds, found.broken
    assert [account.train for account in found.accounts] == ["T01", "T02", "T03"]
    for account in found.accounts:
        assert account.blocks
        assert account.text
        assert account.trips_done <= account.trips
    for name in set(ORACLES) - {"no_point_moves_under_a_train", "the_world_allows_what_happens"}:
        assert name in found.sim.oracles.checked
    assert len(found.judged) > 50
    assert min(found.judged.values()) > 10


def test_a_timetable_comes_to_its_end_without_faults() -> None:
    found = simulated(plan("junction", trains=2, hours=2.0, chosen=NO_FAULT, trips=1))
    assert found.holds
    assert found.sim.ended
    assert not found.deadlocks
    assert {account.ended for account in found.accounts if account.trips} == {"arrived"}
    assert found.sim.now_s < 2 * 3_600
    assert found.sim.diary.steps["release_block"] > 0
    assert not list(left_locked(found.sim))


def test_a_timetable_that_does_not_end_in_time_does_not_hold() -> None:
    found = simulated(plan("junction", trains=2, hours=0.02, chosen=NO_FAULT, trips=1))
    assert not found.broken
    assert not found.sim.ended
    assert not found.holds


def releases_too_much(site: Site, system: System, run: Run, **event: Any) -> System:
    """A planted fault of the centre: when a car gets on, every block of its run is freed."""
    after = WORLD["car_moves"](site, system, run=run, **event)
    if after is system:
        return after
    freed = {block: runs - {run} for block, runs in after.centre.claimed.items()}
    return replace(after, centre=replace(after.centre, claimed=freed))


def test_the_oracles_see_a_centre_that_releases_too_much() -> None:
    sim = Simulation(plan("passing_station", chosen=NO_FAULT))
    steps: Mapping[str, Any] = {**WORLD, "car_moves": releases_too_much}
    sim.play.steps = steps
    sim.run()
    assert sim.now_s < 360
    broken = {each.oracle for each in sim.oracles.found}
    assert broken & {"trains_stay_in_what_is_secured", "nothing_is_released_around_a_train"}


PARTS: Chosen = {"train_parts": Setting(0.0, 0, 0, tuple(range(60, 400, 5)))}


def test_a_train_that_parts_stops_and_is_stated_by_two_persons() -> None:
    sim = Simulation(plan("passing_station", trains=1, hours=0.6, chosen=PARTS))
    service = next(iter(sim.services.values()))
    while service.phase is not Phase.STATED and sim.now_s < 2_000:
        sim.second()
    assert not sim.oracles.found
    assert sim.diary.faults["train_parts"] == 1
    assert sim.diary.steps["note_statement_confirmed"] == 1
    assert all(sim.play.system.centre.claimed[block] for block in service.under)


def test_a_train_that_has_parted_is_taken_off_and_holds_nothing_any_more() -> None:
    """Nor after a restart of the centre, for which it is stated anew that it is nowhere."""
    sim = Simulation(plan("passing_station", trains=1, hours=3.0, chosen=PARTS))
    service = next(iter(sim.services.values()))
    while service.phase is not Phase.OFF and sim.now_s < 9_000:
        sim.second()
    assert service.phase is Phase.OFF
    assert not service.under
    assert not any(runs for _, runs in sim.play.system.centre.claimed.items())
    sim.play.take("restart_centre", epoch=Epoch(sim.play.system.centre.epoch + 1))
    assert sim.play.system.centre.lost_blocks
    for _ in range(1_200):
        sim.second()
    assert service.phase is Phase.OFF
    assert not sim.play.system.centre.lost_blocks
    assert not any(runs for _, runs in sim.play.system.centre.claimed.items())
    assert not sim.oracles.found


def test_others_go_on_over_the_place_of_a_train_that_was_taken_off() -> None:
    """All of them stand in its way until then, on a line with one track between two stations."""
    sim = Simulation(plan("passing_station", seed=3, trains=3, hours=6.0, chosen=PARTS))
    while not any(each.phase is Phase.OFF for each in sim.services.values()) and sim.now_s < 12_000:
        sim.second()
    done = {train: each.done for train, each in sim.services.items()}
    for _ in range(6_000):
        sim.second()
    off = [train for train, each in sim.services.items() if each.phase is Phase.OFF]
    assert off
    assert any(each.done > done[train] for train, each in sim.services.items())
    assert not sim.oracles.found


@pytest.mark.parametrize("place", ["ring", "figure_of_eight"])
def test_long_trains_run_round_and_back_over_three_blocks(place: str) -> None:
    sim = Simulation(plan(place, seed=4, trains=2, hours=0.5, chosen=HARD, cars=12))
    most = 0

    def look(now: Simulation) -> None:
        nonlocal most
        at = now.play.system.track.at
        for vehicle in now.vehicles.values():
            rails = vehicle.on_rails
            most = max(most, len(frozenset().union(*(at[car] for car in (*rails.cars, *rails.standing)))))

    sim.run(look)
    assert not sim.oracles.found
    assert most >= 4
    assert sum(vehicle.way_mm for vehicle in sim.vehicles.values()) > 5_000_000


def test_a_centre_that_restarts_finds_everything_again() -> None:
    sim = Simulation(
        plan("passing_station", trains=2, hours=0.2, chosen={"centre_restart": Setting(0.0, 0, 0, (120.0,))})
    )
    sim.run()
    assert not sim.oracles.found
    assert sim.play.system.centre.epoch == 2
    assert not sim.play.system.centre.lost_blocks
    assert not sim.play.system.centre.lost_points


def test_each_fault_alone_leaves_a_lawful_way_out() -> None:
    chosen = {name: Setting(1.0, BY_NAME[name].least, BY_NAME[name].most) for name in ("line_broken", "train_parts")}
    rows = each(plan("passing_station", trains=2, hours=0.5, chosen=chosen))
    assert [row.fault for row in rows] == ["none", "line_broken", "train_parts"]
    assert all(row.holds and not row.broken for row in rows)
    assert rows[0].came == 0
    assert rows[0].held == "nothing"
    assert rows[1].came > 0
    assert rows[1].longest_s > 0
    assert rows[2].came > 0
    assert "stopped" in rows[2].at_the_end
    assert all(row.way_out for row in rows)


@pytest.mark.parametrize("trains", [30])
def test_more_trains_than_have_room_are_refused(trains: int) -> None:
    with pytest.raises(BadInput, match="can stand apart"):
        Simulation(plan("terminus", trains=trains))


@needs_shared
def test_twenty_trains_run_on_a_real_network() -> None:
    found = simulated(Plan(load(SHARED / "osrd-small_infra.json"), 2, 20, 0.1, HARD))
    assert found.holds, found.broken
    assert len(found.accounts) == 20
    assert sum(account.way_mm for account in found.accounts) > 5_000_000


@needs_shared
def test_a_layout_without_track_is_refused() -> None:
    with pytest.raises(BadInput, match="no track"):
        Simulation(Plan(load(SHARED / "swtbahn-lite.yml"), 1, 1, 0.1, NO_FAULT))


@needs_shared
def test_a_timetable_that_locks_itself_is_told_as_such() -> None:
    found = simulated(Plan(load(SHARED / "osrd-one_line.json"), 3, 6, 1.5, NO_FAULT, 2))
    assert not found.broken
    assert found.sim.ended or (found.deadlocks and found.timetable_to_blame)


@pytest.mark.parametrize("found", ["split", "lost"])
def test_staff_finds_a_whole_train_whole_and_it_runs_on(found: str) -> None:
    """Its tail was not heard for too long, or it was taken for split; at rest staff looks, and its tail is heard."""
    simulation = Simulation(plan("passing_station", trains=1, chosen=NO_FAULT, trips=2, hours=1.0))
    vehicle = simulation.vehicles[Train("T01")]
    while not vehicle.speed_mm_s:
        simulation.second()
    computer = vehicle.board.computer
    wholeness = replace(computer.known.wholeness, split=found == "split", lost=found == "lost")
    vehicle.board.computer = replace(computer, known=replace(computer.known, wholeness=wholeness))
    simulation.run()
    assert vehicle.board.intact
    assert simulation.ended
