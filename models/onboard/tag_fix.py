"""A train that runs over a tag within a cycle, and what its unit makes of the read (T2, P7).

Ways in nm and speeds in µm/s, as in ``models.onboard.odometry``.
"""

from __future__ import annotations

from dataclasses import dataclass

from kernel.onboard import tag_fix
from kernel.onboard.odometry import Loss, Motion
from kernel.onboard.tag_fix import Fix, TagLimits
from kernel.onboard.way import Way
from models.onboard.units import LONGEST_MS, NM_A_MM, UM_A_MM, larger, magnitude, smaller


@dataclass(frozen=True)
class Antenna:
    """What does not change: the limits as written; how far from its place a tag is laid, and from itself read (T2)."""

    limits: TagLimits
    laid_within_mm: int
    read_within_mm: int


@dataclass(frozen=True)
class Passing:
    """The last read of a train.

    ``located``: history: its odometry claimed its ranges when the cycle began and when it ended.
    ``read_at_nm``: where its front was then; ``front_nm``: and where it was when the cycle ended.
    ``place``, ``fix``: what the unit makes of it: where the front was, and where it is.
    """

    located: bool
    read_at_nm: int
    front_nm: int
    place: Way
    fix: Fix


# ---- premises


def the_error_covers_laying_and_read_window(site: Antenna) -> bool:
    """The error that is written covers how tags are laid, and from how far off they are read (T1, T2)."""
    return (
        site.laid_within_mm >= 0
        and site.read_within_mm >= 0
        and site.limits.error_mm >= site.laid_within_mm + site.read_within_mm
    )


# ---- assumptions


def the_range_contains_the_train(motion: Motion, front_nm: int, speed_um_s: int) -> bool:
    """The odometry's theorems: while it claims its ranges, front and speed are in them (P1, P7)."""
    return motion.loss != Loss.NONE or (
        NM_A_MM * motion.front_least_mm <= front_nm <= NM_A_MM * motion.front_most_mm
        and UM_A_MM * motion.speed_least_mm_s <= speed_um_s <= UM_A_MM * motion.speed_most_mm_s
    )


def the_way_follows_the_speed(from_nm: int, to_nm: int, speed_um_s: int, to_um_s: int) -> bool:
    """Within a part of a cycle the train runs no farther than at the greater speed; nor back (P1)."""
    return LONGEST_MS * smaller(
        0, smaller(speed_um_s, to_um_s)
    ) <= to_nm - from_nm and to_nm - from_nm <= LONGEST_MS * larger(0, larger(speed_um_s, to_um_s))


def a_tag_lies_where_it_is_listed(site: Antenna, place_mm: int, lies_nm: int) -> bool:
    """A tag is laid within the error of the place that the list has for it (T1)."""
    return magnitude(lies_nm - NM_A_MM * place_mm) <= NM_A_MM * site.laid_within_mm


def a_tag_is_read_in_the_read_window(site: Antenna, lies_nm: int, read_at_nm: int) -> bool:
    """An antenna reads a tag while it is no farther from it than its read window reaches (T2, T16)."""
    return magnitude(read_at_nm - NM_A_MM * site.limits.antenna_mm - lies_nm) <= NM_A_MM * site.read_within_mm


# ---- transitions


def read_a_tag(
    site: Antenna,
    system: Passing,
    before: Motion,
    after: Motion,
    from_nm: int,
    from_um_s: int,
    read_at_nm: int,
    front_nm: int,
    to_um_s: int,
    place_mm: int,
    lies_nm: int,
) -> Passing:
    """Within a cycle the head's antenna passes a tag that is listed at ``place_mm`` and lies at ``lies_nm`` (T2).

    ``before``, ``after``: the odometry at both ends of it, where the front is at ``from_nm`` and ``front_nm``.
    """
    if not the_range_contains_the_train(before, from_nm, from_um_s):
        return system
    if not the_range_contains_the_train(after, front_nm, to_um_s):
        return system
    if not the_way_follows_the_speed(read_at_nm, front_nm, from_um_s, to_um_s):
        return system
    if not a_tag_lies_where_it_is_listed(site, place_mm, lies_nm):
        return system
    if not a_tag_is_read_in_the_read_window(site, lies_nm, read_at_nm):
        return system
    return Passing(
        located=before.loss == Loss.NONE and after.loss == Loss.NONE,
        read_at_nm=read_at_nm,
        front_nm=front_nm,
        place=tag_fix.place_of_read(before, after),
        fix=tag_fix.fix_of(site.limits, before, after, place_mm),
    )
