"""What a train's machines claim, held against the truth at the end of a cycle: by CPython, or in compiled cycles."""

from __future__ import annotations

from kernel.onboard.odometry import Motion

TOLERANCE_MM = 1.0
"""A position is known to the whole millimetre."""


def in_range(motion: Motion, front_mm: float, speed_mm_s: float) -> bool:
    """Whether front and speed are in the ranges that the odometry claims (P1, P7)."""
    return (
        motion.front_least_mm - TOLERANCE_MM <= front_mm <= motion.front_most_mm + TOLERANCE_MM
        and motion.speed_least_mm_s - TOLERANCE_MM <= speed_mm_s <= motion.speed_most_mm_s + TOLERANCE_MM
    )


def inside(end_mm: int, listed: bool, front_mm: float) -> bool:
    """Whether the head is not past the end of authority, where lists say it (T12)."""
    return front_mm <= end_mm + TOLERANCE_MM or not listed
