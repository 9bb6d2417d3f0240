"""Contracts on the distance for CrossHair (`make crosshair`): leading asserts assume, later ones claim."""

from __future__ import annotations

from kernel.alarm.distance import (
    GREATEST_AGE_MS,
    Direction,
    TrainFix,
    WorkerFix,
    is_departing,
    nearest_um,
    older_ms,
)
from models.alarm.line import BOUNDS

WORKER = WorkerFix(place_mm=0, age_ms=0)


def what_is_no_place_may_be_at_the_worker(place_mm: int, age_ms: int) -> None:
    """Beyond 1000 km (A1)."""
    assert place_mm > 10**9
    assert nearest_um(BOUNDS, TrainFix(place_mm, age_ms, Direction.DOWN, True), WORKER) == 0


def what_is_no_age_may_be_at_the_worker(place_mm: int, age_ms: int) -> None:
    """Negative: a clock went back (A1)."""
    assert age_ms < 0
    assert nearest_um(BOUNDS, TrainFix(place_mm, age_ms, Direction.DOWN, True), WORKER) == 0


def an_age_never_falls(age_ms: int, elapsed_ms: int) -> None:
    """Whatever the clock says, an age within the ranges does not get less (A1)."""
    assert 0 <= age_ms <= GREATEST_AGE_MS
    assert older_ms(age_ms, elapsed_ms) >= age_ms


def what_is_too_old_stays_so(age_ms: int, elapsed_ms: int) -> None:
    """Until the next report (A1)."""
    assert age_ms > GREATEST_AGE_MS
    assert older_ms(age_ms, elapsed_ms) > GREATEST_AGE_MS


def the_deductions_are_made(place_mm: int, age_ms: int) -> None:
    """Length, both errors, and 27 m for each second (A1)."""
    assert 0 <= place_mm <= 10**9
    assert 0 <= age_ms <= GREATEST_AGE_MS
    fix = TrainFix(place_mm, age_ms, Direction.UNKNOWN, False)
    assert nearest_um(BOUNDS, fix, WORKER) == 1_000 * (place_mm - 95_000) - 27_000 * age_ms


def what_stands_approaches(place_mm: int, age_ms: int, running: bool) -> None:
    """And so does what runs towards the worker (A3)."""
    assert place_mm >= 0
    towards = TrainFix(place_mm, age_ms, Direction.UP, running)
    stands = TrainFix(place_mm, age_ms, Direction.DOWN, False)
    unknown = TrainFix(place_mm, age_ms, Direction.UNKNOWN, running)
    assert not is_departing(BOUNDS, towards, WORKER)
    assert not is_departing(BOUNDS, stands, WORKER)
    assert not is_departing(BOUNDS, unknown, WORKER)


def past_is_past_by_a_hundred_metres(place_mm: int) -> None:
    """From the rear, by new fixes (A3)."""
    assert 0 <= place_mm <= 10**9
    assert is_departing(BOUNDS, TrainFix(place_mm, 0, Direction.DOWN, True), WORKER) == (place_mm >= 195_000)
