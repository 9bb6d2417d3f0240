"""A bent street with a way in each direction, and the unit of a tram on it: fixes that err, matched and held (G1, G2).

Nothing of models or proofs is in it but the kernel's public functions.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from itertools import pairwise
from math import ceil, cos, hypot, radians, sin
from random import Random

from kernel.tram import display as on_board
from kernel.tram import map_matching, stopping
from kernel.tram.display import Display
from kernel.tram.map_matching import MatchLimits, Point, Stretch
from kernel.tram.stopping import Fix, StopLimits, Stopping

Table = tuple[Stretch, ...]

FIX_ERROR_MM = 10_000
MATCH = MatchLimits(14_000)
NEAR = StopLimits(30_000, 58_000)
FIRST_MM, APART_MM = 100_000, 400_000
STRETCHES, STRETCH_MM = 4, 950_000
FAST_MM_S, FASTEST_MM_S = 8_000, 14_000


def stop_mm(stop: int) -> int:
    """Where a stop is along either way."""
    return FIRST_MM + APART_MM * stop


def table_of(corners: list[Point]) -> Table:
    """Survey a way from corner to corner: each stretch has the same kilometrage, whatever a rounded mm makes of it."""
    return tuple(
        Stretch(
            start,
            end.x_mm - start.x_mm,
            end.y_mm - start.y_mm,
            ceil(hypot(end.x_mm - start.x_mm, end.y_mm - start.y_mm)) + 1,
            number * STRETCH_MM,
            STRETCH_MM,
            FIX_ERROR_MM,
        )
        for number, (start, end) in enumerate(pairwise(corners))
    )


def drawn_street(chance: Random) -> tuple[Table, Table]:
    """Draw a street that bends at will, back beside itself and over itself too, and its two ways."""
    corners, bearing = [Point(0, 0)], 0.0
    for _ in range(STRETCHES):
        at = corners[-1]
        corners.append(Point(at.x_mm + round(STRETCH_MM * cos(bearing)), at.y_mm + round(STRETCH_MM * sin(bearing))))
        bearing += radians(chance.uniform(-175, 175))
    return table_of(corners), table_of(corners[::-1])


def fix_at(table: Table, place_mm: int, along_mm: float, across_mm: float) -> Point:
    """Where a fix lies that errs by so much along the stretch that the tram is on, and across it."""
    on = table[min(place_mm // STRETCH_MM, STRETCHES - 1)]
    share, whole = (place_mm - on.from_mm) / on.grows_mm, hypot(on.east_mm, on.north_mm)
    east, north = on.east_mm / whole, on.north_mm / whole
    return Point(
        round(on.start.x_mm + share * on.east_mm + along_mm * east - across_mm * north),
        round(on.start.y_mm + share * on.north_mm + along_mm * north + across_mm * east),
    )


@dataclass
class Unit:
    """What is on board: the way that the driver chose, the stop by the last fix, and what he is shown.

    ``fixed_s``: when that fix was taken, or none yet.  ``place_mm``: what it told.  ``starts_s``: dark until then.
    """

    chosen: int = -1
    stopping: Stopping = field(default_factory=lambda: stopping.begun(0))
    display: Display = field(default_factory=lambda: on_board.begun(0))
    fixed_s: int | None = None
    place_mm: int | None = None
    starts_s: int = 0


def unit_begun(way: int, stop: int, now_s: int, starts_s: int) -> Unit:
    """A unit begins a run, at the stop that is set, or starts anew: nobody sets one then, and it is the first."""
    return Unit(way, stopping.begun(stop), on_board.begun(1_000 * now_s), starts_s=starts_s)


def note(unit: Unit, table: Table, fix: Point, speed_mm_s: int, now_s: int) -> None:
    """Take a fix on board: match it, find the stop, and show what follows."""
    unit.place_mm = map_matching.place_mm(MATCH, map_matching.matched(table, fix))
    unit.fixed_s = now_s
    is_placed, stop = unit.place_mm is not None, unit.stopping.stop
    taken = Fix(is_placed, unit.place_mm or 0, True, speed_mm_s)
    unit.stopping = stopping.note_fix(NEAR, unit.stopping, stop_mm(stop), stop_mm(stop + 1), taken)
    unit.display = on_board.located(unit.display, is_placed, unit.stopping.stop, unit.stopping.stands)
