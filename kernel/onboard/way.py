"""A way or a place as the odometry knows it: a range that contains it (P7).

Ranges of readings: 10**9 mm forward and back; what is beyond is not known.
"""

from __future__ import annotations

from dataclasses import dataclass

GREATEST_MM = 10**9


@dataclass(frozen=True)
class Way:
    """A way run, or a place on the line's kilometrage (P7).

    ``known``: the odometry claims a range; if not, the rest says nothing.
    """

    known: bool
    least_mm: int
    most_mm: int


UNKNOWN = Way(known=False, least_mm=0, most_mm=0)


def is_known(way: Way) -> bool:
    """Tell whether a range is claimed, and can be one (P7)."""
    return way.known and -GREATEST_MM <= way.least_mm <= way.most_mm <= GREATEST_MM


def is_within_width(way: Way, width_mm: int) -> bool:
    """Tell whether a range is no wider than so much (P7)."""
    return way.most_mm - way.least_mm <= width_mm


def between(then: Way, now: Way) -> Way:
    """Give the way from a place to another (P7)."""
    return Way(
        known=is_known(then) and is_known(now),
        least_mm=now.least_mm - then.most_mm,
        most_mm=now.most_mm - then.least_mm,
    )
