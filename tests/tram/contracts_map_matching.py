"""Contracts on map matching, for CrossHair (`make crosshair`): leading asserts assume, later ones claim.

On a line along the grid: products of unknowns are beyond the solver; ``test_map_matching.py`` has the rest.
"""

from __future__ import annotations

from kernel.tram.map_matching import Point, Stretch, foot_on, matched, projected

EAST = Stretch(
    Point(0, 0), east_mm=100_000, north_mm=0, length_mm=100_000, from_mm=0, grows_mm=100_000, error_mm=25_000
)


def a_place_beside_is_put_at_right_angles(x_mm: int, y_mm: int) -> None:
    """Its own abscissa, and no ordinate (002, 3.1.1; G1)."""
    assert 0 <= x_mm <= 100_000
    assert isinstance(y_mm, int)
    found = projected(foot_on(EAST, Point(x_mm, y_mm)), Point(x_mm, y_mm))
    assert found.kilometrage_mm == x_mm
    assert found.point == Point(x_mm, 0)


def a_place_beyond_is_put_at_the_end(x_mm: int) -> None:
    """Neither end is passed (G1)."""
    assert isinstance(x_mm, int)
    found = projected(foot_on(EAST, Point(x_mm, 0)), Point(x_mm, 0))
    assert 0 <= found.kilometrage_mm <= 100_000


def what_is_too_far_away_is_no_place(x_mm: int) -> None:
    """Along, as across (G1)."""
    assert isinstance(x_mm, int)
    found = matched((EAST,), Point(x_mm, 0))
    assert (found.nearest is None) == (not -25_000 <= x_mm <= 125_000)
    assert (found.within is None) == (found.nearest is None)
