"""Where kilometrage breaks on a day, or a branch leaves: figures beyond it, and the register that has it (A1)."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

from kernel.alarm.extents import End, Extent, Line
from kernel.alarm.least_ways import Equation, Join
from kernel.alarm.network import Connection, Opening, Way
from kernel.alarm.sections import NoUse, Section
from kernel.alarm.tone import Register
from kernel.maps import Map
from models.alarm.connections import connections
from models.alarm.faults import KIND
from models.alarm.line import KM, LENGTH_MM, REGISTER
from models.alarm.moving import end_m, joint_m
from models.alarm.routes import BRANCHES, junction_m
from models.compiled import compiled, packed

BROKEN, ADJOINED = KIND["broken"], KIND["adjoined"]
THERE_MM, BRANCH_MM = 200 * KM, 400 * KM
"""Figures with which kilometrage begins anew, beyond a break and on a branch; they grow from there, or fall, as the day
has it."""
SECTIONS_MM = tuple((each.from_mm, each.to_mm) for _name, each in REGISTER.sections.items())


@compiled(forceinline=True)
def junction_mm(day: Any) -> int:
    """Give where a branch leaves the line, in mm."""
    return int(1_000 * junction_m(day))


@compiled(forceinline=True)
def break_mm(day: Any) -> int:
    """Give where kilometrage breaks; below 0 where it does not, or would within a section that is not to be used.

    Where another line adjoins, figures are of that line from the line's end on.  Where there is a branch, is no break.
    """
    if day.begin_s[ADJOINED] >= 0:
        return int(LENGTH_MM)
    if day.begin_s[BRANCHES] >= 0:
        return -1
    at_mm = 1_000 * abs(day.size[BROKEN])
    for from_mm, to_mm in SECTIONS_MM:
        if from_mm <= at_mm <= to_mm:
            return -1
    return int(at_mm) if day.begin_s[BROKEN] >= 0 else -1


@compiled(forceinline=True)
def grows(day: Any) -> bool:
    """Tell whether figures beyond the break grow with those before it."""
    return bool(day.size[ADJOINED if day.begin_s[ADJOINED] >= 0 else BROKEN] > 0)


@compiled(forceinline=True)
def figure_mm(day: Any, there_mm: int, on_branch: bool) -> int:
    """Give the figure of a place of the line, or of the way from it to the branch."""
    joint_mm = junction_mm(day)
    if on_branch and there_mm > joint_mm:
        return int(BRANCH_MM + (there_mm - joint_mm if day.size[BRANCHES] > 0 else joint_mm - there_mm))
    at_mm = break_mm(day)
    if at_mm < 0 or there_mm <= at_mm:
        return int(there_mm)
    return int(THERE_MM + (there_mm - at_mm if grows(day) else at_mm - there_mm))


@compiled(forceinline=True)
def is_beyond(written_mm: int) -> bool:
    """Tell whether a figure is of a place beyond the break."""
    return bool(THERE_MM // 2 < written_mm <= (THERE_MM + BRANCH_MM) // 2)


@compiled(forceinline=True)
def is_a_branchs(written_mm: int) -> bool:
    """Tell whether a figure is of a place on the branch."""
    return bool(written_mm > (THERE_MM + BRANCH_MM) // 2)


@compiled(forceinline=True)
def place_mm(day: Any, written_mm: int) -> int:
    """Give the place of a figure."""
    if is_a_branchs(written_mm):
        return int(junction_mm(day) + abs(written_mm - BRANCH_MM))
    return int(break_mm(day) + abs(written_mm - THERE_MM) if is_beyond(written_mm) else written_mm)


@compiled(forceinline=True)
def falls(day: Any, written_mm: int) -> bool:
    """Tell whether figures fall there where elsewhere they grow."""
    if is_a_branchs(written_mm):
        return bool(day.size[BRANCHES] < 0)
    return bool(is_beyond(written_mm) and not grows(day))


def joins(day: Any) -> dict[Join, Equation]:
    """Give the places of the day that have two figures: where kilometrage breaks, and where a branch leaves (A1)."""
    at_mm, found = break_mm(day), {}
    if at_mm >= 0:
        found[Join("break")] = Equation(at_mm, THERE_MM)
    if day.begin_s[BRANCHES] >= 0:
        found[Join("branch")] = Equation(junction_mm(day), BRANCH_MM)
    return found


def openings(day: Any) -> dict[int, int]:
    """Give the openings of the day, by number: where an unregistered line joins, and the end of the next line (A1)."""
    place_m, found = joint_m(day), {}
    if place_m >= 0:
        found[0] = figure_mm(day, int(1_000 * place_m), False)
    if day.begin_s[ADJOINED] >= 0:
        found[1] = figure_mm(day, int(1_000 * end_m(day, False)), False)
    return found


def lines(day: Any) -> dict[Line, Extent]:
    """Give from where to where the figures of the day run: of the line, of what is beyond a break, of a branch (A1)."""
    at_mm, last_mm = break_mm(day), int(1_000 * end_m(day, False))
    last = End.OPENING if day.begin_s[ADJOINED] >= 0 else End.BUFFER_STOP
    if at_mm < 0:
        found = {Line("line"): Extent(0, last_mm, End.BUFFER_STOP, last)}
    else:
        found = {
            Line("line"): Extent(0, at_mm, End.BUFFER_STOP, End.JOIN),
            Line("beyond"): from_join(THERE_MM, figure_mm(day, last_mm, False), last),
        }
    if day.begin_s[BRANCHES] >= 0:
        branch_mm = figure_mm(day, int(1_000 * end_m(day, True)), True)
        found[Line("branch")] = from_join(BRANCH_MM, branch_mm, End.BUFFER_STOP)
    return found


def from_join(join_mm: int, last_mm: int, last: End) -> Extent:
    """Give the extent of a line from a join to its other end, whichever way its figures grow."""
    if join_mm <= last_mm:
        return Extent(join_mm, last_mm, End.JOIN, last)
    return Extent(last_mm, join_mm, last, End.JOIN)


def written(day: Any) -> Register:
    """Give what the register of the day says, in its figures: joins, openings, and the sections beyond a break (A1)."""
    ways = connections(REGISTER, joins(day))
    sections = {}
    for name, each in REGISTER.sections.items():
        from_mm, to_mm = sorted((figure_mm(day, each.from_mm, False), figure_mm(day, each.to_mm, False)))
        sections[name] = NoUse(each.reason, from_mm, to_mm, each.zone_mm)
    opened = {Opening(f"{number}"): place_mm for number, place_mm in openings(day).items()}
    return replace(REGISTER, ways=ways, sections=sections, openings=opened)


def with_joins(register: Any, day: Any) -> Any:
    """Give a register as compiled code has it, with the joins of the day, if it has any (A1)."""
    if not joins(day):
        return register
    ways, sections = written(day).ways, written(day).sections
    return register._replace(
        ways=packed({number: each for number, (_way, each) in enumerate(ways.items())}, Map[Way, Connection]),
        sections=packed(sections, Map[Section, NoUse]),
    )
