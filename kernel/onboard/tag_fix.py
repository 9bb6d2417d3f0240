"""Where the front was when an antenna read something, and what a tag says of where it is now (T2, P7).

An antenna reads between two cycles of the odometry, which knows front and speed at their ends alone.  Since
then the train has run on, by what it can run in a cycle at the greater of the two speeds.
"""

from __future__ import annotations

from dataclasses import dataclass

from kernel.onboard.arithmetic import LONGEST_CYCLE_MS, divided_up, larger, smaller
from kernel.onboard.odometry import Motion, is_located
from kernel.onboard.way import Way


@dataclass(frozen=True)
class TagLimits:
    """What is written of antenna and tags; each is 0 or more (T1, T2).

    ``antenna_mm``: so far behind the front the head's antenna is.
    ``error_mm``: a tag is read within so much of the place that it is listed at: laying, and the read window.
    """

    antenna_mm: int
    error_mm: int


@dataclass(frozen=True)
class Fix:
    """Where the front is, by a tag (P7)."""

    least_mm: int
    most_mm: int


def ran_mm(before: Motion, after: Motion) -> int:
    """Give how far the train may have run forward within the cycle between two states of the odometry (P7)."""
    return divided_up(LONGEST_CYCLE_MS * larger(0, larger(before.speed_most_mm_s, after.speed_most_mm_s)), 1000)


def ran_back_mm(before: Motion, after: Motion) -> int:
    """Give how far it may have rolled back (P7)."""
    return divided_up(-LONGEST_CYCLE_MS * smaller(0, smaller(before.speed_least_mm_s, after.speed_least_mm_s)), 1000)


def place_of_read(before: Motion, after: Motion) -> Way:
    """Give where the front was when something was read within the cycle that has ended (P7)."""
    return Way(
        known=is_located(before) and is_located(after),
        least_mm=after.front_least_mm - ran_mm(before, after),
        most_mm=after.front_most_mm + ran_back_mm(before, after),
    )


def fix_of(limits: TagLimits, before: Motion, after: Motion, place_mm: int) -> Fix:
    """Give where the front is now that the head's antenna has read a tag listed at ``place_mm`` (T2, P7).

    It says something only where the odometry claims its ranges, before and after.
    """
    front_mm = place_mm + limits.antenna_mm
    return Fix(
        least_mm=front_mm - limits.error_mm - ran_back_mm(before, after),
        most_mm=front_mm + limits.error_mm + ran_mm(before, after),
    )
