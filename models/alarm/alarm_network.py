"""A walk along the tracks of a network, from line to line where the register says that they join (A1).

From a join outwards, over other lines, as far as one likes: what it comes to is held against the register's ways.
Places and ways in µm; lines are any number, each with figures of its own.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

from kernel.alarm import limits
from kernel.alarm.least_ways import Equation, Join
from kernel.alarm.network import Connection, Way
from kernel.alarm.tone import Register
from kernel.maps import Map
from models.measures import UM_A_MM, apart


@dataclass(frozen=True)
class Tracks:
    """What does not change: the places that have two figures, as they were surveyed, and what is written else (A1)."""

    register: Register
    joins: Map[Join, Equation]


@dataclass(frozen=True)
class Walk:
    """One moment.

    ``ways``: the ways of the register that was loaded; ``is_accepted``: one was.  ``is_under_way``: the walk has begun.
    ``start_mm``: the figure, on the line from which it began, of the place where it did.
    ``at_um``, ``walked_um``: where it has got to, and how far it was.
    """

    ways: Map[Way, Connection]
    is_accepted: bool
    is_under_way: bool
    start_mm: int
    at_um: int
    walked_um: int


def load(site: Tracks, system: Walk, ways: Map[Way, Connection]) -> Walk:
    """A register is loaded, with whatever ways somebody worked out, if it may be used; then walks begin (A1)."""
    is_lawful = limits.is_lawful(replace(site.register, ways=ways), site.joins)
    loaded = replace(system, ways=ways, is_accepted=True, is_under_way=False)
    return loaded if is_lawful else system


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
    at_um = UM_A_MM * that_mm(place, is_turned)
    return replace(system, is_under_way=True, start_mm=this_mm(place, is_turned), at_um=at_um, walked_um=0)


def walk_on(site: Tracks, system: Walk, to_um: int) -> Walk:
    """It goes on along a line, either way; figures run as the track does."""
    return replace(system, at_um=to_um, walked_um=system.walked_um + apart(to_um, system.at_um))


def cross(site: Tracks, system: Walk, join: Join, is_turned: bool) -> Walk:
    """It goes over to another line; back where it began, on the line from which it did, it is over."""
    if not lines_join_where_it_is_written(site, system, join, is_turned):
        return system
    there_mm = that_mm(site.joins[join], is_turned)
    return replace(system, is_under_way=system.is_under_way and there_mm != system.start_mm, at_um=UM_A_MM * there_mm)


# ---- assumptions


def lines_join_where_it_is_written(site: Tracks, system: Walk, join: Join, is_turned: bool) -> bool:
    """Track leads from one line to another at places that have two figures on the register, and nowhere else (A1)."""
    return join in site.joins and system.at_um == UM_A_MM * this_mm(site.joins[join], is_turned)
