"""From where to where each line's figures run, and what is at its ends: asked when a register is loaded (A1; ours).

A figure says of which line it is only if no two lines have it.  Two that both begin with 0 where they join are the
ordinary slip: each place there has one figure, so nobody writes an equation, no way leads over from line to line, and
a train on the one that runs up to the worker on the other is taken to depart from him.

So each line, or each unbroken piece of its kilometrage, is written with its two ends.  Lines join, and track leads off
the register, where some line ends; so at each end stands an equation, or an opening, or else buffer stops.
"""

from __future__ import annotations

from dataclasses import dataclass
from enum import Enum
from typing import NewType

from kernel.alarm.least_ways import Equation, Join
from kernel.alarm.tone import Register
from kernel.maps import Map
from kernel.onboard.arithmetic import larger

Line = NewType("Line", str)
"""The name of a line, or of an unbroken piece of its kilometrage (A1)."""


class End(Enum):
    """What is at an end of a line (A1)."""

    JOIN = 0
    """Another line, or the next piece of its own: the place has two figures."""
    OPENING = 1
    """Track that the register does not have."""
    BUFFER_STOP = 2
    """No track."""


@dataclass(frozen=True)
class Extent:
    """The lowest and the highest figure of a line, and what is at either end (A1)."""

    from_mm: int
    to_mm: int
    from_end: End
    to_end: End


def reach_mm(register: Register) -> int:
    """Give how far beyond a place what is told of it may lie, or agree with it, by whichever source (A1, A2)."""
    bounds = register.bounds
    told_mm = larger(larger(bounds.train_error_mm, bounds.worker_error_mm), register.display_error_mm)
    return larger(told_mm, register.tolerance_mm)


def ends_before(register: Register, one: Extent, other: Extent) -> bool:
    """Tell whether a line begins after another, or ends as far before it as what is told of both may lie beyond (A1).

    Nearer, a fix just beyond the end of one would be in a section of the other, or agree with the display there.
    """
    return other.from_mm < one.from_mm or one.to_mm + 2 * reach_mm(register) < other.from_mm


def is_joined(joins: Map[Join, Equation], place_mm: int) -> bool:
    """Tell whether a figure has an equation with another one (A1)."""
    return any(
        place.one_mm != place.other_mm and (place_mm == place.one_mm or place_mm == place.other_mm)
        for _join, place in joins.items()
    )


def is_open(register: Register, place_mm: int) -> bool:
    """Tell whether a figure is that of an opening (A1)."""
    return any(open_mm == place_mm for _opening, open_mm in register.openings.items())


def is_end_as_written(register: Register, joins: Map[Join, Equation], end: End, place_mm: int) -> bool:
    """Tell whether the register has the join or the opening that is written to be at an end of a line (A1)."""
    if end == End.BUFFER_STOP:
        return True
    return is_joined(joins, place_mm) if end == End.JOIN else is_open(register, place_mm)


def are_surveyed(register: Register, joins: Map[Join, Equation], lines: Map[Line, Extent]) -> bool:
    """Tell whether each line has figures of its own, the lower one first, and both ends as written (A1)."""
    return all(
        extent.from_mm <= extent.to_mm
        and is_end_as_written(register, joins, extent.from_end, extent.from_mm)
        and is_end_as_written(register, joins, extent.to_end, extent.to_mm)
        for _line, extent in lines.items()
    ) and all(
        line == other or ends_before(register, extent, beside)
        for line, extent in lines.items()
        for other, beside in lines.items()
    )


def is_on(extent: Extent, from_mm: int, to_mm: int) -> bool:
    """Tell whether a line has the figures from one to another (A1)."""
    return extent.from_mm <= from_mm and to_mm <= extent.to_mm


def is_at_buffer_stops(extent: Extent, place_mm: int) -> bool:
    """Tell whether a place is where a line ends, and its track too, as is written (A1)."""
    return (place_mm == extent.from_mm and extent.from_end == End.BUFFER_STOP) or (
        place_mm == extent.to_mm and extent.to_end == End.BUFFER_STOP
    )


def leads_on(lines: Map[Line, Extent], place_mm: int) -> bool:
    """Tell whether track may lead off some line at a figure: it has that, and no buffer stops there (A1)."""
    return any(
        is_on(extent, place_mm, place_mm) and not is_at_buffer_stops(extent, place_mm)
        for _line, extent in lines.items()
    )


def has_joins_on_lines(joins: Map[Join, Equation], lines: Map[Line, Extent]) -> bool:
    """Tell whether lines have both figures of each equation; one beyond the end of its line joins nothing (A1)."""
    return all(leads_on(lines, place.one_mm) and leads_on(lines, place.other_mm) for _join, place in joins.items())


def lies_on_one(lines: Map[Line, Extent], from_mm: int, to_mm: int) -> bool:
    """Tell whether some line has the figures from one to another (A1)."""
    return any(is_on(extent, from_mm, to_mm) for _line, extent in lines.items())


def has_all_on_lines(register: Register, lines: Map[Line, Extent]) -> bool:
    """Tell whether lines have all other figures of a register: else they were written of another place (A1, A4).

    As with the hundreds of kilometres left off: an opening or a section is missing then where it ought to be, and a
    connection excuses a fix that jumps.  No section lies on two lines.  Of no line nothing is known.
    """
    return (
        any(is_on(extent, extent.from_mm, extent.to_mm) for _line, extent in lines.items())
        and all(leads_on(lines, open_mm) for _opening, open_mm in register.openings.items())
        and all(lies_on_one(lines, section.from_mm, section.to_mm) for _name, section in register.sections.items())
        and all(
            lies_on_one(lines, connection.from_mm, connection.from_mm)
            and lies_on_one(lines, connection.to_mm, connection.to_mm)
            for _way, connection in register.ways.items()
        )
    )
