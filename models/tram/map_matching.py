"""A tram somewhere on a line of any shape, fixes of it in the plane that err, and the table of the line (G1)."""

from __future__ import annotations

from dataclasses import dataclass, replace
from math import isqrt

from kernel.tram import map_matching as machine
from kernel.tram.map_matching import Foot, Found, MatchLimits, Point, Stretch
from models.measures import UM_A_MM, apart


@dataclass(frozen=True)
class Survey:
    """What does not change: what is written for the line."""

    limits: MatchLimits


@dataclass(frozen=True)
class Fixing:
    """One moment.

    ``own``: the stretch that the tram is on.  ``part_um``: so much its kilometrage is beyond that of the start.
    ``length_mm``: how long that stretch is in the plane, rounded up.
    ``is_fixed``: a fix was taken there.  ``found``: what was found so far of the last one.  ``foot``: its foot on the
    stretch that is looked at, or an earlier one's.  ``is_new``: that was looked at since the last fix.  ``own_taken``:
    that of the tram's own stretch was taken in.  ``told_mm``: the place that the unit told by it,
    or none.
    """

    own: Stretch
    part_um: int
    length_mm: int
    is_fixed: bool
    found: Found
    foot: Foot
    is_new: bool
    own_taken: bool
    told_mm: int | None


def is_its_length(own: Stretch, length_mm: int) -> bool:
    """Tell whether that is how long a stretch is in the plane, rounded up to the mm."""
    square_mm2 = own.east_mm * own.east_mm + own.north_mm * own.north_mm
    return (length_mm - 1) * (length_mm - 1) < square_mm2 <= length_mm * length_mm


def the_tram_is_on_its_line(own: Stretch, part_um: int, length_mm: int) -> bool:
    """The tram is on a stretch of its line, of some length, between the ends of its kilometrage (G1)."""
    return 0 <= part_um <= UM_A_MM * own.grows_mm and is_its_length(own, length_mm)


def a_fix_is_within_its_error(own: Stretch, part_um: int, length_mm: int, place: Point) -> bool:
    """Along its stretch, and across it, a fix is no farther than that stretch's error from where the tram is (G1, G7).

    That is where it is as the place is told: the way since the receiver took the fix is part of the error.

    The tram is as far along the stretch as its kilometrage.  All is times the stretch's length, and along it times its
    kilometrage in µm too, so nothing is divided.
    """
    x_mm, y_mm = place.x_mm - own.start.x_mm, place.y_mm - own.start.y_mm
    at = part_um * (own.east_mm * own.east_mm + own.north_mm * own.north_mm)
    fixed_at = UM_A_MM * own.grows_mm * (x_mm * own.east_mm + y_mm * own.north_mm)
    most = own.error_mm * length_mm
    return apart(fixed_at, at) <= UM_A_MM * own.grows_mm * most and (
        apart(y_mm * own.east_mm, x_mm * own.north_mm) <= most
    )


def the_table_has_the_line(system: Fixing) -> bool:
    """The unit's table has every stretch of the line (G1)."""
    return system.own_taken


def run_on(site: Survey, system: Fixing, own: Stretch, part_um: int, length_mm: int) -> Fixing:
    """The tram is there now, on a stretch of that length; there is no fix of it yet."""
    if not the_tram_is_on_its_line(own, part_um, length_mm):
        return system
    return replace(system, own=own, part_um=part_um, length_mm=length_mm, is_fixed=False)


def take_fix(site: Survey, system: Fixing, place: Point) -> Fixing:
    """The unit takes a fix; nothing was looked at yet."""
    if not a_fix_is_within_its_error(system.own, system.part_um, system.length_mm, place):
        return system
    return replace(
        system, is_fixed=True, found=machine.nothing_found(place), is_new=False, own_taken=False, told_mm=None
    )


def look_at(site: Survey, system: Fixing, stretch: Stretch) -> Fixing:
    """The unit looks at a stretch of its table, in any order, once or again."""
    return replace(system, foot=machine.foot_on(stretch, system.found.place), is_new=True)


def take_in(site: Survey, system: Fixing) -> Fixing:
    """It takes in what that stretch says of the fix."""
    return replace(
        system,
        found=machine.note_foot(system.found, system.foot),
        own_taken=system.own_taken or (system.is_new and system.foot.stretch == system.own),
    )


def tell(site: Survey, system: Fixing) -> Fixing:
    """The unit has looked at the whole table, and tells of a place or of none."""
    if not the_table_has_the_line(system):
        return system
    return replace(system, told_mm=machine.place_mm(site.limits, system.found))


def stretch_between(start: Point, end: Point, from_mm: int, to_mm: int, error_mm: int) -> Stretch:
    """Enter a stretch into a table by its two points and their kilometrage (G1)."""
    east_mm, north_mm = end.x_mm - start.x_mm, end.y_mm - start.y_mm
    square_mm2 = east_mm * east_mm + north_mm * north_mm
    length_mm = isqrt(square_mm2 - 1) + 1 if square_mm2 > 0 else 0
    return Stretch(start, east_mm, north_mm, length_mm, from_mm, to_mm - from_mm, error_mm)
