"""Places projected at right angles onto a line: on the line, nearest, exact, and refused beyond the bound (G1)."""

from __future__ import annotations

from fractions import Fraction
from math import isqrt

from hypothesis import given
from hypothesis import strategies as st

from kernel.tram.map_matching import Point, Stretch, apart_mm2, is_near, matched, part_of, projected

MM = st.integers(-(10**9), 10**9)
POINTS = st.builds(Point, MM, MM)
NEARBY = st.builds(Point, st.integers(-60, 60), st.integers(-60, 60))
LINE = (
    Stretch(Point(0, 0), Point(100_000, 0), 0, 100_000),
    Stretch(Point(100_000, 0), Point(100_000, 50_000), 100_000, 150_000),
)


def stretch(start: Point, end: Point, from_mm: int, way_mm: int) -> Stretch:
    """A stretch with a kilometrage."""
    return Stretch(start, end, from_mm, from_mm + way_mm)


STRETCHES = st.builds(stretch, POINTS, POINTS, MM, st.integers(0, 10**9))
SHORT = st.builds(stretch, NEARBY, NEARBY, MM, st.integers(0, 200))


def test_a_place_beside_the_line_is_put_at_right_angles() -> None:
    found = matched(LINE, Point(40_000, 14_000), 25_000)
    assert found is not None
    assert (found.kilometrage_mm, found.point, found.correction_mm2) == (40_000, Point(40_000, 0), 14_000**2)
    round_the_corner = matched(LINE, Point(103_000, 20_000), 25_000)
    assert round_the_corner is not None
    assert (round_the_corner.kilometrage_mm, round_the_corner.point) == (120_000, Point(100_000, 20_000))


def test_beyond_the_bound_there_is_no_place() -> None:
    assert matched(LINE, Point(40_000, 25_000), 25_000) is not None
    assert matched(LINE, Point(40_000, 25_001), 25_000) is None
    assert matched((), Point(0, 0), 25_000) is None


def test_beyond_its_ends_a_line_ends() -> None:
    before, behind = matched(LINE, Point(-3_000, 4_000), 5_000), matched(LINE, Point(100_000, 55_000), 5_000)
    assert before is not None
    assert behind is not None
    assert (before.kilometrage_mm, before.correction_mm2) == (0, 5_000**2)
    assert behind.kilometrage_mm == 150_000


def test_of_two_that_are_as_near_the_first_counts() -> None:
    found = matched(LINE, Point(100_000, 0), 1_000)
    assert found is not None
    assert found.kilometrage_mm == 100_000
    twice = (LINE[0], Stretch(Point(0, 0), Point(100_000, 0), 7, 8))
    again = matched(twice, Point(50_000, 1_000), 1_000)
    assert again is not None
    assert again.kilometrage_mm == 50_000


@given(STRETCHES, POINTS)
def test_what_is_projected_lies_on_the_stretch(on: Stretch, place: Point) -> None:
    """Within its box, its kilometrage within its own, and within 1 mm of the straight line each way."""
    found = projected(on, place)
    assert min(on.start.x_mm, on.end.x_mm) <= found.point.x_mm <= max(on.start.x_mm, on.end.x_mm)
    assert min(on.start.y_mm, on.end.y_mm) <= found.point.y_mm <= max(on.start.y_mm, on.end.y_mm)
    assert on.from_kilometrage_mm <= found.kilometrage_mm <= on.to_kilometrage_mm
    assert found.correction_mm2 == apart_mm2(place, found.point)


@given(STRETCHES, POINTS)
def test_it_is_the_foot_of_the_perpendicular_to_the_mm(on: Stretch, place: Point) -> None:
    """Reckoned here anew with fractions."""
    x, y = on.end.x_mm - on.start.x_mm, on.end.y_mm - on.start.y_mm
    length = x * x + y * y
    along = (place.x_mm - on.start.x_mm) * x + (place.y_mm - on.start.y_mm) * y
    share = min(Fraction(1), max(Fraction(0), Fraction(along, length))) if length else Fraction(0)
    found = projected(on, place)
    assert 0 <= on.start.x_mm + share * x - found.point.x_mm < 1
    assert 0 <= on.start.y_mm + share * y - found.point.y_mm < 1


@given(SHORT, NEARBY, st.fractions(0, 1))
def test_no_place_of_the_stretch_is_nearer_by_more_than_2_mm(on: Stretch, place: Point, share: Fraction) -> None:
    x = on.start.x_mm + share * (on.end.x_mm - on.start.x_mm)
    y = on.start.y_mm + share * (on.end.y_mm - on.start.y_mm)
    other = (place.x_mm - x) ** 2 + (place.y_mm - y) ** 2
    assert isqrt(projected(on, place).correction_mm2) <= isqrt(int(other)) + 2


@given(st.lists(STRETCHES, max_size=5), POINTS, st.integers(0, 10**10))
def test_a_match_is_within_the_bound_and_the_nearest(line: list[Stretch], place: Point, most_mm: int) -> None:
    found = matched(tuple(line), place, most_mm)
    each = [projected(on, place) for on in line]
    if found is None:
        assert not any(is_near(one, most_mm) for one in each)
    else:
        assert is_near(found, most_mm)
        assert found.correction_mm2 == min(one.correction_mm2 for one in each)


@given(POINTS, POINTS, MM)
def test_a_stretch_of_no_length_is_its_point(at: Point, place: Point, from_mm: int) -> None:
    found = projected(Stretch(at, at, from_mm, from_mm + 5), place)
    assert (found.point, found.kilometrage_mm) == (at, from_mm)


@given(MM, st.integers(0, 10**18), st.integers(0, 10**18))
def test_a_part_lies_between_nothing_and_the_whole(length: int, one: int, other: int) -> None:
    part, whole = min(one, other), max(one, other)
    assert min(0, length) <= part_of(length, part, whole) <= max(0, length)
