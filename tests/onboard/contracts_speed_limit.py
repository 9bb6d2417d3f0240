"""Contracts on the speed limit for CrossHair (`make crosshair`): leading asserts assume, later ones claim."""

from __future__ import annotations

from kernel.onboard.speed_limit import (
    UNKNOWN,
    SpeedLimit,
    SpeedTable,
    is_overspeed,
    limit_mm_s,
    note_tag,
    permitted_mm_s,
)
from kernel.onboard.tag_kind import PLAIN


def no_restriction_is_exceeded(line: int, curve: int, turnout: int, in_curve: bool, at_turnout: bool) -> None:
    """What is permitted is one of the three, and none that applies is smaller (T12)."""
    assert isinstance(line, int)
    found = permitted_mm_s(SpeedTable(line, curve, turnout), in_curve, at_turnout)
    assert found in (line, curve, turnout)
    assert found <= line
    assert not in_curve or found <= curve
    assert not at_turnout or found <= turnout


def the_unknown_is_the_worst_case(line: int, curve: int, turnout: int, rear_mm: int) -> None:
    """Before the first tag, wherever the train is (T12)."""
    assert isinstance(line, int)
    table = SpeedTable(line, curve, turnout)
    assert limit_mm_s(table, UNKNOWN, rear_mm) == min(line, curve, turnout)


def a_restriction_ends_with_the_rear(until_mm: int, front_mm: int, rear_mm: int) -> None:
    """Of a turnout just left, and of a curve left before (T12)."""
    assert until_mm <= front_mm
    before = SpeedLimit(in_curve=False, at_turnout=True, curve_until_mm=until_mm, turnout_until_mm=0)
    after = note_tag(before, PLAIN, True, front_mm)
    limit = limit_mm_s(SpeedTable(30, 20, 10), after, rear_mm)
    assert (limit == 10) == (rear_mm <= front_mm)
    assert (limit == 30) == (rear_mm > front_mm)


def too_fast_is_found(speed_mm_s: int, rear_mm: int) -> None:
    """And what is no speed (T12)."""
    assert rear_mm > 0
    clear = SpeedLimit(in_curve=False, at_turnout=False, curve_until_mm=0, turnout_until_mm=0)
    assert is_overspeed(SpeedTable(30, 20, 10), clear, True, rear_mm, speed_mm_s) == (speed_mm_s < 0 or speed_mm_s > 30)


def without_a_range_any_speed_is_too_fast(speed_mm_s: int, rear_mm: int, front_mm: int) -> None:
    """And every tag leaves the track unknown (T8)."""
    assert isinstance(speed_mm_s, int)
    clear = SpeedLimit(in_curve=False, at_turnout=False, curve_until_mm=0, turnout_until_mm=0)
    assert is_overspeed(SpeedTable(30, 20, 10), clear, False, rear_mm, speed_mm_s)
    unknown = note_tag(clear, PLAIN, False, front_mm)
    assert unknown == SpeedLimit(in_curve=True, at_turnout=True, curve_until_mm=0, turnout_until_mm=0)
