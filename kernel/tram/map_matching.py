"""Where on its line a tram is, by a place in the plane: projected at right angles onto it (002, 3.1.1; G1).

A tram is on its line, and so the part of the error across the track is taken away; what is along it stays
(4.1).  A place farther from the line than ``most_mm`` is none: there the fix is wrong, or it is another
line's.  The line is a row of points in mm of a plane grid, with the kilometrage of each.  All is exact in
whole numbers of any size; a projected point is rounded to the mm, so the correction is to within 2 mm.
"""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True)
class Point:
    """A place in the plane, in mm (G1)."""

    x_mm: int
    y_mm: int


@dataclass(frozen=True)
class Stretch:
    """A straight piece of the line from one point to another, and the kilometrage of both (G1).

    ``to_kilometrage_mm`` is not below ``from_kilometrage_mm``.
    """

    start: Point
    end: Point
    from_kilometrage_mm: int
    to_kilometrage_mm: int


@dataclass(frozen=True)
class Matched:
    """A place on the line: its kilometrage, the point, and the square of how far it was corrected (G1)."""

    kilometrage_mm: int
    point: Point
    correction_mm2: int


def apart_mm2(one: Point, other: Point) -> int:
    """Give the square of the distance of two points (G1)."""
    x_mm, y_mm = one.x_mm - other.x_mm, one.y_mm - other.y_mm
    return x_mm * x_mm + y_mm * y_mm


def part_of(length: int, part: int, whole: int) -> int:
    """Give a part of a length, rounded down; nothing of it where the whole is nothing (G1).

    ``part`` from 0 to ``whole``: so it lies between 0 and the length.
    """
    return length * part // whole if whole > 0 else 0


def foot_mm2(stretch: Stretch, place: Point) -> int:
    """Give how far along a stretch the foot of the perpendicular is, times its length; limited to its ends (G1)."""
    length_mm2 = apart_mm2(stretch.start, stretch.end)
    along_mm2 = (place.x_mm - stretch.start.x_mm) * (stretch.end.x_mm - stretch.start.x_mm) + (
        place.y_mm - stretch.start.y_mm
    ) * (stretch.end.y_mm - stretch.start.y_mm)
    if along_mm2 < 0:
        return 0
    return along_mm2 if along_mm2 < length_mm2 else length_mm2


def projected(stretch: Stretch, place: Point) -> Matched:
    """Project a place at right angles onto a stretch; beyond its ends, onto the end (002, 3.1.1; G1)."""
    length_mm2 = apart_mm2(stretch.start, stretch.end)
    foot = foot_mm2(stretch, place)
    point = Point(
        stretch.start.x_mm + part_of(stretch.end.x_mm - stretch.start.x_mm, foot, length_mm2),
        stretch.start.y_mm + part_of(stretch.end.y_mm - stretch.start.y_mm, foot, length_mm2),
    )
    kilometrage_mm = stretch.from_kilometrage_mm + part_of(
        stretch.to_kilometrage_mm - stretch.from_kilometrage_mm, foot, length_mm2
    )
    return Matched(kilometrage_mm, point, apart_mm2(place, point))


def is_near(matched: Matched, most_mm: int) -> bool:
    """Tell whether a correction is no longer than allowed (G1)."""
    return matched.correction_mm2 <= most_mm * most_mm


def matched(line: tuple[Stretch, ...], place: Point, most_mm: int) -> Matched | None:
    """Give the nearest place on the line, the first of several; none if it is too far away (G1, ours)."""
    nearest: Matched | None = None
    for stretch in line:
        found = projected(stretch, place)
        if is_near(found, most_mm) and (nearest is None or found.correction_mm2 < nearest.correction_mm2):
            nearest = found
    return nearest
