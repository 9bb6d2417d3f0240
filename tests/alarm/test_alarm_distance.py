"""The distance to a train at its edges, and in drawn runs beside the truth (A1, A3)."""

from __future__ import annotations

from collections.abc import Callable
from random import Random

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from kernel.alarm import distance as machine
from kernel.alarm.distance import (
    GREATEST_AGE_MS,
    GREATEST_PLACE_MM,
    UM_A_MM,
    AlarmBounds,
    Direction,
    TrainFix,
    WorkerFix,
)
from models.alarm.alarm_distance import Line, gap_um
from proofs.alarm.witnesses.alarm_distance import WITNESSES, WORKER_MM, Watch

DOWN, UP = Direction.DOWN, Direction.UP
PLACES = st.integers(-GREATEST_PLACE_MM, GREATEST_PLACE_MM)
AGES = st.integers(0, GREATEST_AGE_MS)
LINES = st.builds(
    AlarmBounds,
    train_mm_s=st.integers(1, 60_000),
    worker_mm_s=st.integers(0, 3_000),
    length_mm=st.integers(0, 400_000),
    train_error_mm=st.integers(0, 50_000),
    worker_error_mm=st.integers(0, 50_000),
    turning_ms=st.integers(0, 60_000),
)


@pytest.mark.parametrize("witness", WITNESSES)
def test_witness(witness: Callable[[], None]) -> None:
    assert witness.__doc__
    witness()


@settings(max_examples=40, deadline=None)
@given(LINES, st.integers(0, 2**32))
def test_in_drawn_runs_no_train_is_nearer_than_reckoned(bounds: AlarmBounds, seed: int) -> None:
    """Trains run and turn, workers walk, reports come late; every invariant is looked at after each step."""
    chance = Random(seed)
    reach_mm = chance.randrange(bounds.length_mm + 1)
    site = Line(bounds, below_mm=bounds.length_mm - reach_mm, above_mm=reach_mm)
    watch = Watch(WORKER_MM + chance.randrange(-3_000_000, 3_000_000), site)
    ran_since_ms = 0
    for _ in range(80):
        before, elapsed_ms = watch.system, chance.choice((0, 1, 1_000, 5_000, 30_000))
        turns = ran_since_ms > bounds.turning_ms and chance.random() < 0.3
        heading = {DOWN: UP, UP: DOWN}[before.heading] if turns else before.heading
        way_um = chance.choice((0, 1, bounds.train_mm_s // 2, bounds.train_mm_s)) * elapsed_ms
        walk_um = chance.choice((-1, 0, 1)) * bounds.worker_mm_s * elapsed_ms
        to_um = before.antenna_um + (way_um if heading == DOWN else -way_um)
        worker_to_um = before.worker_um + walk_um
        watch.step("run_on", elapsed_ms=elapsed_ms, to_um=to_um, heading=heading, worker_to_um=worker_to_um)
        assert watch.system.antenna_um == to_um or turns
        ran_since_ms = 0 if watch.system.heading != before.heading else ran_since_ms + elapsed_ms
        if chance.random() < 0.5:
            here_um, off_mm = watch.system.antenna_um, chance.randint(-bounds.train_error_mm, bounds.train_error_mm)
            fix = TrainFix((here_um + UM_A_MM * off_mm) // UM_A_MM, 0, watch.system.heading, chance.random() < 0.8)
            watch.step("take_train_fix", fix=fix, at_um=here_um)
            assert watch.system.train == fix or here_um % UM_A_MM
        if chance.random() < 0.5:
            own = WorkerFix(watch.system.worker_um // UM_A_MM, 0)
            watch.step("take_worker_fix", fix=own, at_um=UM_A_MM * own.place_mm)
        train, worker = watch.system.train, watch.system.worker
        if machine.is_fix(train.place_mm, train.age_ms) and machine.is_fix(worker.place_mm, worker.age_ms):
            gap = gap_um(site, watch.system.antenna_um, watch.system.worker_um)
            assert machine.nearest_um(bounds, train, worker) <= gap


@given(LINES, PLACES, PLACES, AGES, AGES)
def test_older_is_never_farther(bounds: AlarmBounds, place_mm: int, own_mm: int, age_ms: int, own_ms: int) -> None:
    train, worker = TrainFix(place_mm, age_ms, DOWN, True), WorkerFix(own_mm, own_ms)
    if age_ms < GREATEST_AGE_MS and own_ms < GREATEST_AGE_MS:
        near_um = machine.nearest_um(bounds, train, worker)
        assert machine.nearest_um(bounds, machine.older_train(train, 1), worker) == near_um - bounds.train_mm_s
        assert machine.nearest_um(bounds, train, machine.older_worker(worker, 1)) == near_um - bounds.worker_mm_s


@given(LINES, PLACES, PLACES, AGES)
def test_up_and_down_are_alike(bounds: AlarmBounds, place_mm: int, own_mm: int, age_ms: int) -> None:
    """The line seen from its other end."""
    for heading, other in ((DOWN, UP), (UP, DOWN), (Direction.UNKNOWN, Direction.UNKNOWN)):
        one = TrainFix(place_mm, age_ms, heading, True), WorkerFix(own_mm, 0)
        turned = TrainFix(-place_mm, age_ms, other, True), WorkerFix(-own_mm, 0)
        assert machine.nearest_um(bounds, *one) == machine.nearest_um(bounds, *turned)
        assert machine.is_departing(bounds, *one) == machine.is_departing(bounds, *turned)


@given(LINES, PLACES, PLACES, AGES)
def test_at_most_one_way_leads_away(bounds: AlarmBounds, place_mm: int, own_mm: int, age_ms: int) -> None:
    worker = WorkerFix(own_mm, 0)
    ways = [machine.is_departing(bounds, TrainFix(place_mm, age_ms, heading, True), worker) for heading in Direction]
    assert sum(ways) <= 1
    assert not ways[list(Direction).index(Direction.UNKNOWN)]
