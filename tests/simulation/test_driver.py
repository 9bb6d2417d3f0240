"""A driver comes to rest by what the cab shows, however wide the range of his train's front is."""

from __future__ import annotations

from dataclasses import replace

from hypothesis import given
from hypothesis import strategies as st

from kernel.onboard import odometry
from models.rides.plan import PLAN
from models.simulation.driver import (
    BRAKES_MM_S2,
    CYCLE_S,
    LINE_MM_S,
    asked_mm_s2,
    gained_mm_s2,
    is_barred,
    margin_mm,
    shown_mm_s,
)

SLOWEST_MM_S2 = 150.0
"""A train that brakes more weakly than this on the whole, down to a stop, creeps."""


@given(
    behind_mm=st.integers(0, 40_000),
    wider_mm=st.integers(0, 10_000),
    speed_mm_s=st.floats(0, LINE_MM_S),
)
def test_a_driver_does_not_creep_towards_the_end_of_authority(behind_mm: int, wider_mm: int, speed_mm_s: float) -> None:
    """It starts far enough from its end to stop; then it comes to rest, in a time that fits its speed."""
    end_mm, front_mm, gained = 1_500_000, 0.0, 0.0
    motion = odometry.located(-wider_mm, behind_mm, 0)
    shown, reached_s, cycle = shown_mm_s(PLAN.brake, motion, end_mm, 0), 0.0, 0
    while cycle < 6_000:
        cycle += 1
        motion = replace(motion, front_least_mm=round(front_mm) - wider_mm, front_most_mm=round(front_mm) + behind_mm)
        shown = shown_mm_s(PLAN.brake, motion, end_mm, 0)
        asked = asked_mm_s2(speed_mm_s, end_mm - margin_mm(motion) - front_mm, shown)
        gained = gained_mm_s2(gained, asked, False)
        before, speed_mm_s = speed_mm_s, max(0.0, speed_mm_s + gained * CYCLE_S)
        front_mm += (before + speed_mm_s) / 2 * CYCLE_S
        if speed_mm_s >= 2_000:
            reached_s = cycle * CYCLE_S
        if speed_mm_s == 0.0 and asked == -BRAKES_MM_S2:
            break
    assert speed_mm_s == 0.0
    assert cycle * CYCLE_S - reached_s <= 2_000 / SLOWEST_MM_S2
    assert is_barred(shown) or end_mm - margin_mm(motion) - front_mm < 12_000
