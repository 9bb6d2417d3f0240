"""Contracts on the watch on reverse movement for CrossHair (`make crosshair`): leading asserts assume."""

from __future__ import annotations

from kernel.onboard.odometry import Readings
from kernel.onboard.reverse_movement import LOCATED, Movement, ReverseLimits, note_cycle

LIMITS = ReverseLimits(roll_back_mm=2_000)


def it_is_found_beyond_the_limit(way_mm: int) -> None:
    """And not before (T5)."""
    assert -1_000_000 <= way_mm <= 1_000_000
    after = note_cycle(LIMITS, Movement(50_000, False), Readings(100, True, 0, way_mm, True, 0))
    assert after.reversed == (way_mm < 48_000)
    assert after.furthest_mm >= 50_000
    assert after.furthest_mm >= way_mm


def what_was_found_stays(way_mm: int, valid: bool) -> None:
    """Wherever the train goes (T5)."""
    assert isinstance(way_mm, int)
    assert note_cycle(LIMITS, Movement(50_000, True), Readings(100, valid, 0, way_mm, True, 0)).reversed


def the_first_reading_finds_nothing(way_mm: int) -> None:
    """Wherever counting began (T8)."""
    assert -(10**12) <= way_mm <= 10**12
    after = note_cycle(LIMITS, LOCATED, Readings(100, True, 0, way_mm, True, 0))
    assert after == Movement(way_mm, False)
