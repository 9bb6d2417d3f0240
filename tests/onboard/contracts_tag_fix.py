"""Contracts on the fix of a tag for CrossHair (`make crosshair`): leading asserts assume."""

from __future__ import annotations

from dataclasses import replace

from kernel.onboard.odometry import located
from kernel.onboard.tag_fix import TagLimits, fix_of, place_of_read, ran_back_mm, ran_mm

LIMITS = TagLimits(antenna_mm=2_000, error_mm=300)
AT_REST = located(0, 0, 0)


def it_runs_forward_or_back_or_both(slowest_mm_s: int, fastest_mm_s: int) -> None:
    """By the longest lawful cycle, 102 ms, at the speed that it may have (P7)."""
    assert -200_000 <= slowest_mm_s <= fastest_mm_s <= 200_000
    after = replace(AT_REST, speed_least_mm_s=slowest_mm_s, speed_most_mm_s=fastest_mm_s)
    assert 0 <= 1000 * ran_mm(AT_REST, after) - 102 * max(0, fastest_mm_s) < 1000
    assert 0 <= 1000 * ran_back_mm(AT_REST, after) + 102 * min(0, slowest_mm_s) < 1000


def a_train_at_rest_is_where_it_was_read(place_mm: int) -> None:
    """Its fix is as wide as the error (P7)."""
    assert -(10**9) <= place_mm <= 10**9
    fix = fix_of(LIMITS, AT_REST, AT_REST, place_mm)
    assert (fix.least_mm, fix.most_mm) == (place_mm + 1_700, place_mm + 2_300)
    assert place_of_read(AT_REST, AT_REST).least_mm == place_of_read(AT_REST, AT_REST).most_mm == 0
