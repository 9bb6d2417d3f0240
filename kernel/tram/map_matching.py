"""Where on its line a tram is, by a place in the plane: projected at right angles onto it (002, 3.1.1; G1).

A tram is on its line, and so the part of the error across the track is taken away; what is along it stays
(4.1).  The place told is the nearest on the line.  It counts only as far as it is known: beside it goes a range
of kilometrage outside of which the tram is nowhere, if the fix is off by no more than is written for where the tram is.
Where the line bends back beside itself, or a street canyon is near, the range is wide, and no place is told (ours).

The line is a row of stretches in mm of a plane grid, with the kilometrage of both ends of each.  All is exact in
whole numbers of any size; a projected point is rounded to the mm, so the correction is to within 2 mm.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

from kernel.onboard.arithmetic import larger, limited, magnitude, smaller


@dataclass(frozen=True)
class Point:
    """A place in the plane, in mm (G1)."""

    x_mm: int
    y_mm: int


@dataclass(frozen=True)
class Stretch:
    """A straight piece of the line, and its kilometrage, which grows evenly along it (G1).

    ``start``: where it begins.  ``east_mm``, ``north_mm``: so far on it ends.  ``length_mm``: its length in the plane,
    rounded up.  ``from_mm``: the kilometrage of its start.  ``grows_mm``: so much more is that of its end.
    ``error_mm``: so much a fix of a tram on it is off at most, along it and across it: with what the table is off the
    track, and the way until its place is told (ours).
    """

    start: Point
    east_mm: int
    north_mm: int
    length_mm: int
    from_mm: int
    grows_mm: int
    error_mm: int


@dataclass(frozen=True)
class MatchLimits:
    """What is written for a line: a place counts if its kilometrage is off by no more than ``most_mm`` (G1, ours).

    It is the error by which `stopping` is told that places err.
    """

    most_mm: int


@dataclass(frozen=True)
class Foot:
    """Where a perpendicular from a fix meets a stretch, or that drawn on beyond its ends (002, 3.1.1; G1).

    ``is_sound``: it is a stretch, with a length that is written no shorter and a kilometrage that grows (ours).
    ``is_beside``: the fix is no farther beside it than it errs.  ``along_mm2``: how far along the stretch the foot is,
    times its length; below 0 before its start.  ``least_mm2``, ``most_mm2``: the same, less and more by what the fix
    errs.  ``square_mm2``: the square of its length.
    """

    stretch: Stretch
    is_sound: bool
    is_beside: bool
    along_mm2: int
    least_mm2: int
    most_mm2: int
    square_mm2: int


@dataclass(frozen=True)
class Matched:
    """A place on the line: its kilometrage, the point, and the square of how far it was corrected (G1)."""

    kilometrage_mm: int
    point: Point
    correction_mm2: int


@dataclass(frozen=True)
class Range:
    """A range of kilometrage, both ends in it (G1, ours)."""

    from_mm: int
    to_mm: int


@dataclass(frozen=True)
class Found:
    """What the stretches of a line that were looked at so far say of a fix (G1, ours).

    ``place``: the fix.  ``is_sound``: each stretch is one.  ``nearest``: the nearest place on them.  ``within``: the
    tram is on none of them, or in this range.  Neither is there if the fix is farther from all than it errs.
    """

    place: Point
    is_sound: bool
    nearest: Matched | None
    within: Range | None


def nothing_found(place: Point) -> Found:
    """Begin with a fix: no stretch of the line was looked at (G1)."""
    return Found(place=place, is_sound=True, nearest=None, within=None)


def apart_mm2(one: Point, other: Point) -> int:
    """Give the square of the distance of two points (G1)."""
    x_mm, y_mm = one.x_mm - other.x_mm, one.y_mm - other.y_mm
    return x_mm * x_mm + y_mm * y_mm


def foot_on(stretch: Stretch, place: Point) -> Foot:
    """Give the foot of the perpendicular from a fix to a stretch; it errs along it as across it (002, 3.1.1; G1)."""
    x_mm, y_mm, length_mm = place.x_mm - stretch.start.x_mm, place.y_mm - stretch.start.y_mm, stretch.length_mm
    along_mm2 = x_mm * stretch.east_mm + y_mm * stretch.north_mm
    across_mm2 = y_mm * stretch.east_mm - x_mm * stretch.north_mm
    square_mm2 = stretch.east_mm * stretch.east_mm + stretch.north_mm * stretch.north_mm
    off_mm2 = stretch.error_mm * length_mm
    return Foot(
        stretch=stretch,
        is_sound=length_mm > 0 and 0 < square_mm2 <= length_mm * length_mm and stretch.grows_mm > 0,
        is_beside=magnitude(across_mm2) <= off_mm2,
        along_mm2=along_mm2,
        least_mm2=along_mm2 - off_mm2,
        most_mm2=along_mm2 + off_mm2,
        square_mm2=square_mm2,
    )


def part_of(length: int, part: int, whole: int) -> int:
    """Give a part of a length, rounded down; nothing of it where the whole is nothing (G1).

    ``part`` from 0 to ``whole``: so it lies between 0 and the length.
    """
    return length * part // whole if whole > 0 else 0


def projected(foot: Foot, place: Point) -> Matched:
    """Project a place onto a stretch; beyond its ends, onto the end (002, 3.1.1; G1)."""
    stretch, whole_mm2 = foot.stretch, foot.square_mm2
    part_mm2 = limited(foot.along_mm2, 0, whole_mm2)
    point = Point(
        stretch.start.x_mm + part_of(stretch.east_mm, part_mm2, whole_mm2),
        stretch.start.y_mm + part_of(stretch.north_mm, part_mm2, whole_mm2),
    )
    return Matched(stretch.from_mm + part_of(stretch.grows_mm, part_mm2, whole_mm2), point, apart_mm2(place, point))


def range_on(foot: Foot) -> Range | None:
    """Give where on a stretch a tram can be that has that fix, rounded outwards; none if it is not on it (G1, ours)."""
    stretch, whole_mm2 = foot.stretch, foot.square_mm2
    if not foot.is_beside or foot.most_mm2 < 0 or foot.least_mm2 > whole_mm2:
        return None
    return Range(
        stretch.from_mm + part_of(stretch.grows_mm, larger(0, foot.least_mm2), whole_mm2),
        stretch.from_mm + part_of(stretch.grows_mm, smaller(foot.most_mm2, whole_mm2), whole_mm2) + 1,
    )


def nearer(one: Matched | None, other: Matched, error_mm: int) -> Matched | None:
    """Give the nearer of two places, the first of two as near; one that is farther than a fix errs is none (G1)."""
    if other.correction_mm2 > error_mm * error_mm:
        return one
    return other if one is None or other.correction_mm2 < one.correction_mm2 else one


def either(one: Range | None, other: Range | None) -> Range | None:
    """Give the range that has both of two in it (G1)."""
    if one is None or other is None:
        return other if one is None else one
    return Range(smaller(one.from_mm, other.from_mm), larger(one.to_mm, other.to_mm))


def note_foot(found: Found, foot: Foot) -> Found:
    """Take in what one more stretch of the line says of the fix; what is no stretch spoils the table (G1)."""
    if not foot.is_sound:
        return replace(found, is_sound=False)
    return replace(
        found,
        nearest=nearer(found.nearest, projected(foot, found.place), foot.stretch.error_mm),
        within=either(found.within, range_on(foot)),
    )


def place_mm(limits: MatchLimits, found: Found) -> int | None:
    """Give the kilometrage of the nearest place, if it is near enough to wherever on the line the tram can be (G1)."""
    if not found.is_sound or found.nearest is None or found.within is None:
        return None
    at_mm, within = found.nearest.kilometrage_mm, found.within
    is_near = at_mm - within.from_mm <= limits.most_mm and within.to_mm - at_mm <= limits.most_mm
    return at_mm if is_near else None


def matched(line: tuple[Stretch, ...], place: Point) -> Found:
    """Look at every stretch of a line for a fix (002, 3.1.1; G1)."""
    found = nothing_found(place)
    for stretch in line:
        found = note_foot(found, foot_on(stretch, place))
    return found
