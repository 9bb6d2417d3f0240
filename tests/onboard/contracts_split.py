"""Contracts on split detection for CrossHair (`make crosshair`): leading asserts assume, later ones claim."""

from __future__ import annotations

from dataclasses import replace

from kernel.onboard.split import (
    EMPTY,
    Acceleration,
    Readings,
    SplitLimits,
    is_intact,
    made_up,
    note_cycle,
)

LIMITS = SplitLimits(
    threshold_mm_s2=300, shock_mm_s2=3_000, disagreement_mm_s2=100, age_ms=300, gap_ms=500, lost_ms=3_000
)
WHOLE = replace(made_up(LIMITS), in_a_row=15, missed_ms=0)


def a_split_stays(arrived: bool, age_ms: int, valid: bool) -> None:
    """Whatever comes, found is found (P5)."""
    assert -1_000 <= age_ms <= 1_000
    readings = Readings(Acceleration(0, valid), arrived, Acceleration(0, True), Acceleration(0, True), age_ms)
    after = note_cycle(LIMITS, replace(WHOLE, split=True), readings)
    assert after.split
    assert not is_intact(LIMITS, after)


def what_does_not_come_in_time_is_not_counted(age_ms: int) -> None:
    """Too old, or from the future: not intact, and the window stays (P5)."""
    assert not 0 <= age_ms <= 300
    readings = Readings(Acceleration(900, True), True, Acceleration(0, True), Acceleration(0, True), age_ms)
    after = note_cycle(LIMITS, WHOLE, readings)
    assert not is_intact(LIMITS, after)
    assert after.differences_mm_s2 == EMPTY


def disagreeing_sensors_are_doubted(left: int, right: int) -> None:
    """Left and right more than the bound apart (P6)."""
    assert left - right > 100
    readings = Readings(Acceleration(0, True), True, Acceleration(left, True), Acceleration(right, True), 0)
    assert not is_intact(LIMITS, note_cycle(LIMITS, WHOLE, readings))


def a_shock_is_found(left: int) -> None:
    """Beyond the limit, either way, to the greatest number there is (P5)."""
    assert left > 3_000 or left < -3_000
    readings = Readings(Acceleration(0, True), True, Acceleration(left, True), Acceleration(0, False), 0)
    assert note_cycle(LIMITS, WHOLE, readings).split


def silence_is_counted(missed_ms: int) -> None:
    """A cycle without a telegram adds to the gap, and does not touch the window (P5)."""
    assert 0 <= missed_ms <= 5_000
    nothing = Readings(Acceleration(0, True), False, Acceleration(0, True), Acceleration(0, True), 0)
    after = note_cycle(LIMITS, replace(WHOLE, missed_ms=missed_ms), nothing)
    assert after.missed_ms == missed_ms + 100
    assert is_intact(LIMITS, after) == (missed_ms <= 400)
    assert after.lost == (missed_ms > 2_900)
