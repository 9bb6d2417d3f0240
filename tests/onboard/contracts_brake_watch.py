"""Contracts on the watch on the brake for CrossHair (`make crosshair`): leading asserts assume, later ones claim."""

from __future__ import annotations

from kernel.onboard.brake_watch import BrakeWatch, note_cycle, watching
from kernel.onboard.braking import BrakeBounds

BOUNDS = BrakeBounds(
    gains_mm_s2=1_200, slows_mm_s2=700, response_cycles=15, standstill_mm_s=25, cut_cycles=5, falls_mm_s2=200
)


def an_accusation_stays(speed_mm_s: int, cycles: int, applied: bool) -> None:
    """Whatever comes (T12)."""
    assert 0 <= cycles <= 15
    assert -1_000_000 <= speed_mm_s <= 1_000_000
    assert note_cycle(BOUNDS, BrakeWatch(20_000, cycles, True), applied, True, speed_mm_s, speed_mm_s).broken


def motors_may_gain_as_much_as_written(gained_mm_s: int, applied: bool) -> None:
    """And no more, while the brake has not responded: 1,200 mm/s² in the longest cycle, 102 ms (T12)."""
    assert -20_000 <= gained_mm_s <= 20_000
    speed_mm_s = 20_000 + gained_mm_s
    assert note_cycle(BOUNDS, watching(20_000), applied, True, speed_mm_s, speed_mm_s).broken == (gained_mm_s > 123)


def the_brake_must_slow_as_guaranteed(slowed_mm_s: int) -> None:
    """Once it has responded: 700 mm/s² in the shortest cycle, 98 ms (T12)."""
    assert -20_000 <= slowed_mm_s <= 20_000
    speed_mm_s = 20_000 - slowed_mm_s
    after = note_cycle(BOUNDS, BrakeWatch(20_000, 15, False), True, True, speed_mm_s, speed_mm_s)
    assert after.broken == (slowed_mm_s < 68)
    assert after.cycles == 15


def the_limit_is_no_more_than_measured(least_mm_s: int, most_mm_s: int, applied: bool) -> None:
    """And no more than the bounds allow (T12)."""
    assert -1_000_000 <= least_mm_s <= most_mm_s <= 1_000_000
    after = note_cycle(BOUNDS, watching(20_000), applied, True, least_mm_s, most_mm_s)
    assert 0 <= after.limit_mm_s <= max(0, most_mm_s)
    assert after.limit_mm_s <= 20_123


def a_released_brake_responds_anew(cycles: int, known: bool) -> None:
    """From the next command on (T12)."""
    assert 0 <= cycles <= 15
    assert note_cycle(BOUNDS, BrakeWatch(20_000, cycles, False), False, known, 0, 0).cycles == 0


def an_unknown_speed_accuses_nobody(least_mm_s: int, most_mm_s: int, applied: bool) -> None:
    """Whatever the numbers are (T12, P7)."""
    assert -1_000_000 <= least_mm_s <= most_mm_s <= 1_000_000
    after = note_cycle(BOUNDS, watching(20_000), applied, False, least_mm_s, most_mm_s)
    assert not after.broken
    assert after.limit_mm_s == 20_123
