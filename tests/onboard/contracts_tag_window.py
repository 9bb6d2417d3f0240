"""Contracts on the next tag's window for CrossHair (`make crosshair`): leading asserts assume, later ones claim."""

from __future__ import annotations

from kernel.onboard.tag_window import NONE_AWAITED, Verdict, WindowLimits, await_tag, in_window, judge, note_cycle
from kernel.onboard.way import Way

LIMITS = WindowLimits(tolerance_mm=1_513, width_mm=10_000, tail_width_mm=0)


def a_tag_in_its_place_is_taken(planned_mm: int, off_mm: int, behind_mm: int, ahead_mm: int) -> None:
    """Up to the width that is written (T5)."""
    assert 0 <= planned_mm < 2**28
    assert -1_513 <= off_mm <= 1_513
    assert 0 <= behind_mm <= 5_000
    assert 0 <= ahead_mm <= 5_000
    way_mm = planned_mm + off_mm
    assert in_window(LIMITS, await_tag(planned_mm, planned_mm), Way(True, way_mm - behind_mm, way_mm + ahead_mm))


def a_tag_far_from_its_place_is_refused(planned_mm: int, way_mm: int, behind_mm: int, ahead_mm: int) -> None:
    """By more than tolerance and error, here 10 m (T5)."""
    assert 0 <= planned_mm < 2**28
    assert way_mm < planned_mm - 11_513 or way_mm > planned_mm + 11_513
    assert 0 <= behind_mm <= 5_000
    assert 0 <= ahead_mm <= 5_000
    assert not in_window(LIMITS, await_tag(planned_mm, planned_mm), Way(True, way_mm - behind_mm, way_mm + ahead_mm))


def an_overdue_tag_stays_so(least_mm: int, most_mm: int, known: bool) -> None:
    """Whatever the odometry says later (T5)."""
    assert least_mm <= most_mm
    late = note_cycle(LIMITS, await_tag(100_000, 100_000), Way(True, 101_514, 101_514))
    assert late.passed
    assert note_cycle(LIMITS, late, Way(known, least_mm, most_mm)).passed


def without_a_way_no_tag_is_taken(least_mm: int, most_mm: int) -> None:
    """Nor with one that cannot be, or is known worse than is written (T5, T8)."""
    assert least_mm > most_mm or least_mm < -(10**9) or most_mm > 10**9 or most_mm - least_mm > 10_000
    way = Way(True, least_mm, most_mm)
    assert judge(LIMITS, await_tag(100_000, 100_000), way) == Verdict.UNKNOWN
    assert note_cycle(LIMITS, await_tag(100_000, 100_000), way).passed
    assert not note_cycle(LIMITS, NONE_AWAITED, way).passed
