"""Whether a register has every way from line to line, and none too long: asked when it is loaded (A1; ours).

A register's connections are worked out from the places that have two figures.  One that is missing, or longer than the
track, would put a train farther from a worker than it is.  So a register counts only if its connections pass here: each
place with two figures is one of no length, and whichever of them leads to such a place goes on from its other figure,
no farther than that.  Then no way along the track is shorter than the least that the connections give.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import NewType

from kernel.alarm.distance import UM_A_MM
from kernel.alarm.network import Connection
from kernel.alarm.tone import CAUTION_MM, Register
from kernel.maps import Map
from kernel.onboard.arithmetic import larger, magnitude

Join = NewType("Join", str)
"""The name of a place that has two figures: where lines join, or kilometrage breaks (A1)."""


@dataclass(frozen=True)
class Equation:
    """The two figures of one place; on a line that breaks both are of that line (A1)."""

    one_mm: int
    other_mm: int


def far_um(register: Register) -> int:
    """Give how long a way may be that the register need not have (A1).

    3000 m, a train's length, what it and the worker run while what is told of them is fresh, and by how much either may
    be told too far, by whichever source: what is told may lie beyond one more join than what is.
    """
    bounds, fresh = register.bounds, register.fresh
    run_um = bounds.train_mm_s * larger(fresh.fix_ms, fresh.display_ms) + bounds.worker_mm_s * fresh.worker_ms
    error_mm = larger(bounds.train_error_mm, register.display_error_mm) + bounds.worker_error_mm
    return UM_A_MM * (CAUTION_MM + bounds.length_mm + error_mm) + run_um


def to_figure_mm(connection: Connection, place_mm: int) -> int:
    """Give how far it is from a figure to where a connection ends, over it (A1)."""
    return magnitude(connection.from_mm - place_mm) + connection.between_mm


def leads(register: Register, to_mm: int, from_mm: int, within_mm: int) -> bool:
    """Tell whether a connection leads to a figure from another, and no farther than that (A1)."""
    return any(
        connection.to_mm == to_mm and to_figure_mm(connection, from_mm) <= within_mm
        for _way, connection in register.ways.items()
    )


def goes_on(register: Register, connection: Connection, here_mm: int, there_mm: int) -> bool:
    """Tell whether where a connection has a place's one figure another has its other one, unless that is far (A1).

    Or is where both end: what leads back to that place, from the line on which it lies, is no way from elsewhere.
    """
    way_mm = to_figure_mm(connection, here_mm)
    return (
        there_mm == connection.to_mm
        or UM_A_MM * way_mm > far_um(register)
        or leads(register, connection.to_mm, there_mm, way_mm)
    )


def has_least_ways(register: Register, joins: Map[Join, Equation]) -> bool:
    """Tell whether no way from line to line is shorter than the least by the register's connections (A1)."""
    return all(
        leads(register, place.one_mm, place.other_mm, 0) and leads(register, place.other_mm, place.one_mm, 0)
        for _join, place in joins.items()
    ) and all(
        goes_on(register, connection, place.one_mm, place.other_mm)
        and goes_on(register, connection, place.other_mm, place.one_mm)
        for _way, connection in register.ways.items()
        for _join, place in joins.items()
    )
