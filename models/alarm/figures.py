"""Where kilometrage breaks on a day: the figures of places before and beyond it, and the register that has it (A1)."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

from kernel.alarm.least_ways import Equation, Join
from kernel.alarm.network import Connection, Way
from kernel.alarm.sections import NoUse, Section
from kernel.alarm.tone import Register
from kernel.maps import Map
from models.alarm.connections import connections
from models.alarm.faults import KIND
from models.alarm.line import KM, REGISTER
from models.compiled import compiled, packed

BROKEN = KIND["broken"]
THERE_MM = 200 * KM
"""The figure with which kilometrage begins anew; it grows from there, or falls, as the day has it."""
SECTIONS_MM = tuple((each.from_mm, each.to_mm) for _name, each in REGISTER.sections.items())


@compiled(forceinline=True)
def break_mm(day: Any) -> int:
    """Give where kilometrage breaks; below 0 where it does not, or would within a section that is not to be used."""
    at_mm = 1_000 * abs(day.size[BROKEN])
    for from_mm, to_mm in SECTIONS_MM:
        if from_mm <= at_mm <= to_mm:
            return -1
    return int(at_mm) if day.begin_s[BROKEN] >= 0 else -1


@compiled(forceinline=True)
def figure_mm(day: Any, there_mm: int) -> int:
    """Give the figure of a place."""
    at_mm = break_mm(day)
    if at_mm < 0 or there_mm <= at_mm:
        return int(there_mm)
    return int(THERE_MM + (there_mm - at_mm if day.size[BROKEN] > 0 else at_mm - there_mm))


@compiled(forceinline=True)
def is_beyond(written_mm: int) -> bool:
    """Tell whether a figure is of a place beyond the break."""
    return bool(written_mm > THERE_MM // 2)


@compiled(forceinline=True)
def place_mm(day: Any, written_mm: int) -> int:
    """Give the place of a figure."""
    return int(break_mm(day) + abs(written_mm - THERE_MM) if is_beyond(written_mm) else written_mm)


@compiled(forceinline=True)
def falls(day: Any, written_mm: int) -> bool:
    """Tell whether figures fall there where elsewhere they grow."""
    return bool(is_beyond(written_mm) and day.size[BROKEN] < 0)


def joins(day: Any) -> dict[Join, Equation]:
    """Give the places of the day's line that have two figures: where its kilometrage breaks, if it does (A1)."""
    at_mm = break_mm(day)
    return {} if at_mm < 0 else {Join("break"): Equation(at_mm, THERE_MM)}


def written(day: Any) -> Register:
    """Give what the register of the day says, in its figures: of the break, and of the sections beyond it (A1)."""
    ways = connections(REGISTER, joins(day))
    sections = {}
    for name, each in REGISTER.sections.items():
        from_mm, to_mm = sorted((figure_mm(day, each.from_mm), figure_mm(day, each.to_mm)))
        sections[name] = NoUse(each.reason, from_mm, to_mm, each.zone_mm)
    return replace(REGISTER, ways=ways, sections=sections)


def with_break(register: Any, day: Any) -> Any:
    """Give a register as compiled code has it, with the break of the day, if there is one (A1)."""
    if break_mm(day) < 0:
        return register
    ways, sections = written(day).ways, written(day).sections
    return register._replace(
        ways=packed({number: each for number, (_way, each) in enumerate(ways.items())}, Map[Way, Connection]),
        sections=packed(sections, Map[Section, NoUse]),
    )
