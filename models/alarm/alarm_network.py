"""A walk along the tracks of a network, from line to line where the register says that they join (A1).

From a join outwards, over other lines, as far as one likes: what it comes to is held against the register's ways, and
against the figures that are written for its lines.  It may leave a line by an end, onto whatever track goes on there.
Places and ways in µm; lines are any number.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

from kernel.alarm import limits
from kernel.alarm.extents import End, Extent, Line
from kernel.alarm.least_ways import Equation, Join
from kernel.alarm.network import Connection, Way
from kernel.alarm.tone import Register
from kernel.maps import Map
from models.alarm.along import is_by_figures
from models.measures import UM_A_MM, apart, greater, lesser


@dataclass(frozen=True)
class Tracks:
    """What does not change: the places that have two figures, as they were surveyed, and what is written else (A1).

    ``lines``: the figures of both ends of each line, and what is there.
    """

    register: Register
    joins: Map[Join, Equation]
    lines: Map[Line, Extent]


@dataclass(frozen=True)
class Walk:
    """One moment.

    ``ways``: the ways of the register that was loaded; ``is_accepted``: one was.  ``is_under_way``: the walk has begun.
    ``start_mm``: the figure, on the line from which it began, of the place where it did.
    ``at_um``, ``walked_um``: where it has got to, and how far it was.
    ``has_left``: it has left there the line on which it was, by an end of it, and is over.
    """

    ways: Map[Way, Connection]
    is_accepted: bool
    is_under_way: bool
    start_mm: int
    at_um: int
    walked_um: int
    has_left: bool


def load(site: Tracks, system: Walk, ways: Map[Way, Connection]) -> Walk:
    """A register is loaded, with whatever ways somebody worked out, if it may be used; then walks begin (A1).

    If it may not, there is none: who keeps the one from before has loaded nothing.
    """
    is_lawful = limits.is_lawful(replace(site.register, ways=ways), site.joins, site.lines)
    return replace(system, ways=ways, is_accepted=is_lawful, is_under_way=False, has_left=False)


def this_mm(place: Equation, is_turned: bool) -> int:
    """Give the figure of a join on the line from which one comes."""
    return place.other_mm if is_turned else place.one_mm


def that_mm(place: Equation, is_turned: bool) -> int:
    """Give the figure of a join on the line to which one goes."""
    return place.one_mm if is_turned else place.other_mm


def begin(site: Tracks, system: Walk, join: Join, is_turned: bool) -> Walk:
    """A walk begins where lines join, onto the other line."""
    if join not in site.joins:
        return system
    place = site.joins[join]
    start_mm, at_um = this_mm(place, is_turned), UM_A_MM * that_mm(place, is_turned)
    return replace(system, is_under_way=True, start_mm=start_mm, at_um=at_um, walked_um=0, has_left=False)


def walk_on(site: Tracks, system: Walk, to_um: int) -> Walk:
    """It goes on along a line, either way; figures run as the track does."""
    if not system.is_under_way or not a_line_has_the_figures_between_its_ends(site, system, to_um):
        return system
    return replace(system, at_um=to_um, walked_um=system.walked_um + apart(to_um, system.at_um))


def cross(site: Tracks, system: Walk, join: Join, is_turned: bool) -> Walk:
    """It goes over to another line; back where it began, on the line from which it did, it is over."""
    if not system.is_under_way or not lines_join_where_it_is_written(site, system, join, is_turned):
        return system
    there_mm = that_mm(site.joins[join], is_turned)
    return replace(system, is_under_way=there_mm != system.start_mm, at_um=UM_A_MM * there_mm)


def leave(site: Tracks, system: Walk, line: Line) -> Walk:
    """It leaves a line by an end, onto whatever track goes on there."""
    if not track_ends_at_buffer_stops(site, system, line):
        return system
    return replace(system, is_under_way=False, has_left=True)


# ---- assumptions


def lines_join_where_it_is_written(site: Tracks, system: Walk, join: Join, is_turned: bool) -> bool:
    """Track leads from line to line at places that have two figures on the register, and at ends of lines (A1)."""
    return join in site.joins and system.at_um == UM_A_MM * this_mm(site.joins[join], is_turned)


def a_line_has_the_figures_between_its_ends(site: Tracks, system: Walk, to_um: int) -> bool:
    """Along a line one has the figures between those of its ends, whichever was written first, and no other (A1)."""
    return any(is_on(extent, system.at_um) and is_on(extent, to_um) for _line, extent in site.lines.items())


def is_on(extent: Extent, at_um: int) -> bool:
    """Tell whether a place is on a line, by its ends."""
    lowest_mm, highest_mm = lesser(extent.from_mm, extent.to_mm), greater(extent.from_mm, extent.to_mm)
    return is_by_figures(lowest_mm, highest_mm, at_um, 0)


def track_ends_at_buffer_stops(site: Tracks, system: Walk, line: Line) -> bool:
    """Track goes on beyond an end of a line only where it is not written that buffer stops are (A1)."""
    return line in site.lines and (
        (goes_on(site.lines[line].from_end) and system.at_um == UM_A_MM * site.lines[line].from_mm)
        or (goes_on(site.lines[line].to_end) and system.at_um == UM_A_MM * site.lines[line].to_mm)
    )


def goes_on(end: End) -> bool:
    """Tell whether it is written of an end that track goes on."""
    return end != End.BUFFER_STOP
