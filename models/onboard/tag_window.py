"""Tags along a line, a train that runs from one to the next, and the window that it expects each in (T5).

Ways are in nm, as in ``models.onboard.odometry``, counted from any one place.  The train may run back as well.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

from kernel.onboard import tag_window as machine
from kernel.onboard.tag_window import Window, WindowLimits
from kernel.onboard.way import Way
from models.onboard.units import NM_A_MM

FARTHEST_PLANNED_MM = 268_435_455
"""The distance in a tag's record has 28 bits, in mm (T1)."""
FARTHEST_KNOWN_MM = 1_000_000_000
"""The odometry claims no range beyond 1,000 km from where it began."""


@dataclass(frozen=True)
class Stretch:
    """What does not change (T5, T16).

    ``limits``: as written.
    ``laying_mm``: how far from the plan the next tag may lie.
    ``read_mm``: how far from it the antenna may read it: the read window.
    """

    limits: WindowLimits
    laying_mm: int
    read_mm: int


@dataclass(frozen=True)
class Expecting:
    """One moment of a train between tags.

    ``window``: what the machine knows.  ``way_nm``: truly run since counting began, when it was asked last.
    The rest is history, since the next tag is awaited.
    ``late``, ``missed``: at the end of some cycle the train had truly come farther than planned by more
    than the tolerance; by more than tolerance and the widest range of the way that counts.
    ``lost``: the odometry claimed no range then, or a wider one.
    ``taken``: what the machine says of the tag that was read; ``in_place``: the tag lay where the plan says,
    within the error of laying, and the odometry knew the way; ``out_of_place``: it lay elsewhere, by
    more than tolerance, that width and read window together, or none was awaited.
    """

    window: Window
    way_nm: int
    late: bool
    missed: bool
    lost: bool
    taken: bool
    in_place: bool
    out_of_place: bool


# ---- premises


def the_tolerance_covers_laying_and_read_window(site: Stretch) -> bool:
    """The written tolerance is at least the error of laying and the antenna's read window together (T5, T16)."""
    return site.laying_mm + site.read_mm <= site.limits.tolerance_mm


def nothing_is_negative(site: Stretch) -> bool:
    """No error is below zero (T5)."""
    return site.laying_mm >= 0 and site.read_mm >= 0 and site.limits.width_mm >= 0


# ---- assumptions


def the_odometer_contains_the_way(way_nm: int, way: Way) -> bool:
    """A range that the odometry claims contains the way; what it proves of itself (P7)."""
    return not way.known or NM_A_MM * way.least_mm <= way_nm <= NM_A_MM * way.most_mm


def a_tag_is_read_in_the_read_window(site: Stretch, way_nm: int, lies_nm: int) -> bool:
    """An antenna reads a tag only while the tag is in its window, half of it before and behind (paper 000, 5; T16)."""
    return -NM_A_MM * site.read_mm <= way_nm - lies_nm <= NM_A_MM * site.read_mm


# ---- what happens


def run_a_cycle(site: Stretch, system: Expecting, way_nm: int, way: Way) -> Expecting:
    """The train runs on for a cycle, or back, or stands; the odometry tells the way (T5)."""
    if not the_odometer_contains_the_way(way_nm, way):
        return system
    over_nm = way_nm - NM_A_MM * (system.window.most_mm + site.limits.tolerance_mm)
    return replace(
        system,
        window=machine.note_cycle(site.limits, system.window, way),
        way_nm=way_nm,
        late=system.late or over_nm > 0,
        missed=system.missed or over_nm > NM_A_MM * site.limits.width_mm,
        lost=system.lost or not claims(site, way),
    )


def claims(site: Stretch, way: Way) -> bool:
    """Tell whether the odometry claims a range, within its own limits, no wider than is written."""
    return (
        way.known
        and way.least_mm >= -FARTHEST_KNOWN_MM
        and way.most_mm <= FARTHEST_KNOWN_MM
        and way.most_mm - way.least_mm <= site.limits.width_mm
    )


def read_a_tag(site: Stretch, system: Expecting, way_nm: int, way: Way, lies_nm: int) -> Expecting:
    """The antenna reads a tag, so far from where counting began: the next, a foreign one, or one laid wrong (T5)."""
    if not the_odometer_contains_the_way(way_nm, way):
        return system
    if not a_tag_is_read_in_the_read_window(site, way_nm, lies_nm):
        return system
    least_mm, most_mm = system.window.least_mm, system.window.most_mm
    unseen_mm = site.limits.tolerance_mm + site.limits.width_mm + site.read_mm
    return replace(
        system,
        taken=machine.in_window(site.limits, system.window, way),
        way_nm=way_nm,
        in_place=system.window.expected
        and claims(site, way)
        and 0 <= least_mm <= most_mm <= FARTHEST_PLANNED_MM
        and NM_A_MM * (least_mm - site.laying_mm) <= lies_nm <= NM_A_MM * (most_mm + site.laying_mm),
        out_of_place=not system.window.expected
        or lies_nm < NM_A_MM * (least_mm - unseen_mm)
        or lies_nm > NM_A_MM * (most_mm + unseen_mm),
    )


def expect_a_tag(site: Stretch, system: Expecting, way_nm: int, least_mm: int, most_mm: int) -> Expecting:
    """The plan tells how far it is to the next tag, from anywhere; anything, if the plan is wrong (T5)."""
    return replace(begun(system), window=machine.await_tag(least_mm, most_mm), way_nm=way_nm)


def expect_none(site: Stretch, system: Expecting) -> Expecting:
    """The list has no next tag, or is given back (T5)."""
    return replace(begun(system), window=machine.NONE_AWAITED)


def begun(system: Expecting) -> Expecting:
    """Begin the history anew."""
    return replace(system, late=False, missed=False, lost=False, in_place=False, out_of_place=False)
