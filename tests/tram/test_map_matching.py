"""Places projected at right angles onto a line: on the line, nearest, exact, and refused beyond the bound (G1)."""

from __future__ import annotations

from dataclasses import replace
from fractions import Fraction
from math import isqrt

from hypothesis import assume, given
from hypothesis import strategies as st

from kernel.tram.map_matching import (
    Found,
    Matched,
    MatchLimits,
    Point,
    Stretch,
    apart_mm2,
    foot_on,
    matched,
    part_of,
    place_mm,
)
from kernel.tram.map_matching import projected as projected_from
from models.tram.map_matching import stretch_between

MM = st.integers(-(10**9), 10**9)
POINTS = st.builds(Point, MM, MM)
NEARBY = st.builds(Point, st.integers(-60, 60), st.integers(-60, 60))
ERROR_MM = 25_000
LINE = (
    stretch_between(Point(0, 0), Point(100_000, 0), 0, 100_000, ERROR_MM),
    stretch_between(Point(100_000, 0), Point(100_000, 50_000), 100_000, 150_000, ERROR_MM),
)


def stretch(start: Point, end: Point, from_mm: int, way_mm: int) -> Stretch:
    """A stretch with a kilometrage."""
    return stretch_between(start, end, from_mm, from_mm + way_mm, ERROR_MM)


STRETCHES = st.builds(stretch, POINTS, POINTS, MM, st.integers(1, 10**9)).filter(lambda on: on.length_mm > 0)
SHORT = st.builds(stretch, NEARBY, NEARBY, MM, st.integers(1, 200)).filter(lambda on: on.length_mm > 0)


def projected(on: Stretch, place: Point) -> Matched:
    """Project a place onto a stretch."""
    return projected_from(foot_on(on, place), place)


def nearest(line: tuple[Stretch, ...], place: Point, error_mm: int = 25_000) -> Matched | None:
    """The nearest place on a line."""
    return matched(tuple(replace(on, error_mm=error_mm) for on in line), place).nearest


def test_a_place_beside_the_line_is_put_at_right_angles() -> None:
    found = nearest(LINE, Point(40_000, 14_000))
    assert found is not None
    assert (found.kilometrage_mm, found.point, found.correction_mm2) == (40_000, Point(40_000, 0), 14_000**2)
    round_the_corner = nearest(LINE, Point(103_000, 20_000))
    assert round_the_corner is not None
    assert (round_the_corner.kilometrage_mm, round_the_corner.point) == (120_000, Point(100_000, 20_000))


def test_beyond_the_bound_there_is_no_place() -> None:
    assert nearest(LINE, Point(40_000, 25_000)) is not None
    assert nearest(LINE, Point(40_000, 25_001)) is None
    assert matched((), Point(0, 0)) == Found(Point(0, 0), True, None, None)


def test_beyond_its_ends_a_line_ends() -> None:
    before, behind = nearest(LINE, Point(-3_000, 4_000), 5_000), nearest(LINE, Point(100_000, 55_000), 5_000)
    assert before is not None
    assert behind is not None
    assert (before.kilometrage_mm, before.correction_mm2) == (0, 5_000**2)
    assert behind.kilometrage_mm == 150_000


def test_of_two_that_are_as_near_the_first_counts() -> None:
    found = nearest(LINE, Point(100_000, 0), 1_000)
    assert found is not None
    assert found.kilometrage_mm == 100_000
    twice = (LINE[0], stretch_between(Point(0, 0), Point(100_000, 0), 7, 8, ERROR_MM))
    again = nearest(twice, Point(50_000, 1_000), 1_000)
    assert again is not None
    assert again.kilometrage_mm == 50_000


@given(STRETCHES, POINTS)
def test_what_is_projected_lies_on_the_stretch(on: Stretch, place: Point) -> None:
    """Within its box, its kilometrage within its own, and within 1 mm of the straight line each way."""
    found, end = projected(on, place), Point(on.start.x_mm + on.east_mm, on.start.y_mm + on.north_mm)
    assert min(on.start.x_mm, end.x_mm) <= found.point.x_mm <= max(on.start.x_mm, end.x_mm)
    assert min(on.start.y_mm, end.y_mm) <= found.point.y_mm <= max(on.start.y_mm, end.y_mm)
    assert 0 <= found.kilometrage_mm - on.from_mm <= on.grows_mm
    assert found.correction_mm2 == apart_mm2(place, found.point)


@given(STRETCHES, POINTS)
def test_it_is_the_foot_of_the_perpendicular_to_the_mm(on: Stretch, place: Point) -> None:
    """Reckoned here anew with fractions."""
    length = on.east_mm**2 + on.north_mm**2
    along = (place.x_mm - on.start.x_mm) * on.east_mm + (place.y_mm - on.start.y_mm) * on.north_mm
    share = min(Fraction(1), max(Fraction(0), Fraction(along, length)))
    found = projected(on, place)
    assert 0 <= on.start.x_mm + share * on.east_mm - found.point.x_mm < 1
    assert 0 <= on.start.y_mm + share * on.north_mm - found.point.y_mm < 1


@given(SHORT, NEARBY, st.fractions(0, 1))
def test_no_place_of_the_stretch_is_nearer_by_more_than_2_mm(on: Stretch, place: Point, share: Fraction) -> None:
    x, y = on.start.x_mm + share * on.east_mm, on.start.y_mm + share * on.north_mm
    other = (place.x_mm - x) ** 2 + (place.y_mm - y) ** 2
    assert isqrt(projected(on, place).correction_mm2) <= isqrt(int(other)) + 2


@given(st.lists(STRETCHES, max_size=5), POINTS, st.integers(0, 10**10))
def test_a_match_is_within_the_bound_and_the_nearest(line: list[Stretch], place: Point, error_mm: int) -> None:
    found = nearest(tuple(line), place, error_mm)
    each = [projected(on, place).correction_mm2 for on in line]
    if found is None:
        assert not any(correction_mm2 <= error_mm**2 for correction_mm2 in each)
    else:
        assert found.correction_mm2 == min(each) <= error_mm**2


BENDS = st.lists(
    st.tuples(st.integers(-400, 400), st.integers(-400, 400), st.integers(1, 900), st.integers(0, 120)),
    min_size=1,
    max_size=6,
)


def bent(start: Point, on: list[tuple[int, int, int, int]]) -> tuple[Stretch, ...]:
    """A line from one place to the next, wherever that leads it; each piece of some length."""
    line: list[Stretch] = []
    at, from_mm = start, 0
    for east_mm, north_mm, grows_mm, error_mm in on:
        end = Point(at.x_mm + east_mm, at.y_mm + north_mm)
        if end != at:
            line.append(stretch_between(at, end, from_mm, from_mm + grows_mm, error_mm))
            at, from_mm = end, from_mm + grows_mm
    return tuple(line)


@given(BENDS, st.data())
def test_the_tram_is_in_the_range_on_a_line_of_any_shape(
    on: list[tuple[int, int, int, int]], data: st.DataObject
) -> None:
    """Wherever on it, and however the fix errs by no more than that; a place that counts is off by no more (G1)."""
    line = bent(Point(0, 0), on)
    assume(line)
    own, share = data.draw(st.sampled_from(line)), data.draw(st.fractions(0, 1))
    x, y = own.start.x_mm + share * own.east_mm, own.start.y_mm + share * own.north_mm
    place = Point(round(x) + data.draw(st.integers(-120, 120)), round(y) + data.draw(st.integers(-120, 120)))
    assume((place.x_mm - x) ** 2 + (place.y_mm - y) ** 2 <= own.error_mm**2)
    limits = MatchLimits(data.draw(st.integers(0, 600)))
    found, at_mm = matched(line, place), own.from_mm + share * own.grows_mm
    assert found.within is not None
    assert found.within.from_mm <= at_mm <= found.within.to_mm
    counted_mm = place_mm(limits, found)
    if counted_mm is not None:
        assert found.nearest is not None
        assert counted_mm == found.nearest.kilometrage_mm
        assert abs(counted_mm - at_mm) <= limits.most_mm


@given(POINTS, MM, st.integers(0, 10**9))
def test_what_has_no_length_is_no_stretch(at: Point, from_mm: int, grows_mm: int) -> None:
    assert not foot_on(stretch_between(at, at, from_mm, from_mm + grows_mm, ERROR_MM), at).is_sound
    assert not matched((*LINE, stretch_between(at, at, from_mm, from_mm + grows_mm, ERROR_MM)), Point(0, 0)).is_sound


@given(STRETCHES)
def test_a_length_is_rounded_up(on: Stretch) -> None:
    assert (on.length_mm - 1) ** 2 < on.east_mm**2 + on.north_mm**2 <= on.length_mm**2
    assert foot_on(on, Point(0, 0)).is_sound
    assert not foot_on(replace(on, length_mm=on.length_mm - 1), Point(0, 0)).is_sound


@given(MM, st.integers(0, 10**18), st.integers(0, 10**18))
def test_a_part_lies_between_nothing_and_the_whole(length: int, one: int, other: int) -> None:
    part, whole = min(one, other), max(one, other)
    assert min(0, length) <= part_of(length, part, whole) <= max(0, length)
