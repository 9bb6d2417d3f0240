"""Contracts on the crossing's settings, arms and answers, for CrossHair: leading asserts assume, later ones claim."""

from __future__ import annotations

from kernel.crossing.arrival import ArrivalBounds, Followed
from kernel.crossing.crossing import (
    Crossing,
    Due,
    Settings,
    aged,
    are_lawful,
    arms_are_to_be_down,
    decide,
    due,
    have_one_warning_time,
    must_warn,
)

SETTINGS = Settings(
    cycle_ms=1_000,
    warning_cycles=40,
    bell_cycles=5,
    lowering_cycles=10,
    least_down_cycles=20,
    lifting_cycles=6,
    reopening_cycles=20,
    silence_cycles=2,
    start_cycles=44,
)
BOUNDS = ArrivalBounds(
    line_um=30_000_000,
    gain_um=1_000_000,
    cycle_ms=1_000,
    warning_cycles=40,
    silence_cycles=3,
    way_spread_mm=1,
    speed_spread_mm_s=1,
)


def crossing_of(warns: bool, warned_cycles: int) -> Crossing:
    """One that nobody is known to."""
    return Crossing({}, {}, {}, {}, {}, {}, 0, warns, warned_cycles)


def lawful_settings_leave_fifteen_seconds(warning_cycles: int, bell_cycles: int, lowering_cycles: int) -> None:
    """Of the warning time, when bell and lowering are over (X5)."""
    assert are_lawful(Settings(1_000, warning_cycles, bell_cycles, lowering_cycles, 15, 6, 40, 2, 99))
    assert warning_cycles - bell_cycles - lowering_cycles >= 15


def a_start_point_that_is_too_near_is_refused(start_cycles: int) -> None:
    """Warning time, silence, and two cycles (X3)."""
    assert start_cycles < 44
    assert not are_lawful(Settings(1_000, 40, 5, 10, 20, 6, 20, 2, start_cycles))


def no_bell_is_refused(bell_cycles: int) -> None:
    """The road clears in that time (X5)."""
    assert bell_cycles <= 0
    assert not are_lawful(Settings(1_000, 40, bell_cycles, 10, 20, 6, 20, 2, 44))


def another_warning_time_is_refused(warning_cycles: int, cycle_ms: int) -> None:
    """And another cycle (X2, X5)."""
    assert isinstance(warning_cycles, int)
    bounds = ArrivalBounds(30_000_000, 1_000_000, cycle_ms, warning_cycles, 3, 1, 1)
    assert have_one_warning_time(bounds, SETTINGS) == (warning_cycles == 40 and cycle_ms == 1_000)


def arms_wait_for_the_bell(warned_cycles: int, warns: bool) -> None:
    """And are up without a warning (X5)."""
    assert isinstance(warned_cycles, int)
    crossing = crossing_of(warns, warned_cycles)
    assert arms_are_to_be_down(SETTINGS, crossing) == (warns and warned_cycles >= 5)


def nobody_on_the_way_is_no_warning(warned_cycles: int, warns: bool) -> None:
    """While every terminal is heard (X4)."""
    assert warned_cycles >= 0
    assert decide(SETTINGS, crossing_of(warns, warned_cycles), {}) == Crossing({}, {}, {}, {}, {}, {}, 0, False, 0)


def a_warning_grows_older(warned_cycles: int, warns: bool) -> None:
    """By a cycle (X2)."""
    assert warned_cycles >= 0
    assert aged(crossing_of(warns, warned_cycles)).warned_cycles == (warned_cycles + 1 if warns else 0)


def nobody_is_must_not_be_warned_of(warned_cycles: int) -> None:
    """Whatever has been (X4)."""
    assert warned_cycles >= 0
    assert not must_warn(SETTINGS, crossing_of(True, warned_cycles))


def at_the_lines_speed_answers_are_by_way(way_um: int) -> None:
    """To the micrometre (X2, X4)."""
    assert 0 <= way_um <= 3_000_000_000
    answer = due(BOUNDS, Followed(way_um, 0, 30_000_000, 0, 0, 0, False), 20)
    assert (answer == Due.NOW) == (way_um <= 42 * 30_000_000)
    assert (answer == Due.FAR) == (way_um > 62 * 30_000_000)


def what_is_lost_is_due(way_um: int, age_cycles: int) -> None:
    """However far it was (X3)."""
    assert age_cycles > 3
    assert due(BOUNDS, Followed(way_um, 30_000_000, 30_000_000, age_cycles, 0, 0, False), 20) == Due.NOW
