"""Declared conflicts against those that follow from what two routes share (T9)."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterator, Mapping, Sequence
from typing import TYPE_CHECKING

from models.layouts.findings import Findings

if TYPE_CHECKING:
    from models.layouts.table import TableRoute


Fouls = Mapping[str, frozenset[str]]
"""For a section or piece of path, those that a train there also obstructs."""


def shared(first: TableRoute, second: TableRoute, fouls: Fouls) -> tuple[list[str], list[str]]:
    """What makes two routes conflict: the elements, and each in words.

    Points wanted in different positions come first, then shared sections, then shared track outside of sections (two
    routes over a point in the same position meet there), then what the table tells to foul each other.
    """
    opposite = [p for p in first.points if second.points.get(p, first.points[p]) != first.points[p]]
    sections = [section for section in first.sections if section in second.sections]
    track = [] if sections else [piece for piece in first.path if piece in second.path]
    words = [f"point '{p}' ({first.points[p]} against {second.points[p]})" for p in opposite]
    words += [f"section '{section}'" for section in sections]
    words += [f"track '{piece}'" for piece in track]
    over = {name for _, name in _runs_over(second)}
    names = sorted({name for _, name in _runs_over(first)})
    fouled = [(name, other) for name in names for other in sorted(fouls.get(name, frozenset()) & over)]
    words += [f"'{name}' fouling '{other}'" for name, other in fouled]
    return [*opposite, *sections, *track, *(name for pair in fouled for name in pair)], words


MOST_TOLD = 10_000
"""So many pairs are told one by one; a table in which more are wrong is wrong as a whole."""


def compare_conflicts(routes: Sequence[TableRoute], fouls: Fouls, findings: Findings) -> None:
    """Every pair: a conflict that follows must be declared by both, and one that is declared must follow."""
    following, (declares, declared) = _following(routes, fouls), _declared(routes)
    told = missed = needless = 0
    for at, first in enumerate(routes):
        missing = (following[at] & ~(declares[at] & declared[at])) >> at + 1
        idle = ((declares[at] | declared[at]) & ~following[at]) >> at + 1
        if told < MOST_TOLD:
            for other in _bits(missing | idle, at + 1):
                told += 1
                _tell(first, routes[other], fouls, findings)
        else:
            missed, needless = missed + missing.bit_count(), needless + idle.bit_count()
    if missed:
        text = f"{missed:,} more pairs of routes conflict and do not declare it"
        findings.violation("conflicts are declared", (), text)
    if needless:
        text = f"{needless:,} more conflicts are declared that follow from nothing: nothing keeps the routes apart"
        findings.violation("declared conflicts follow", (), text)
    for route in routes:
        if route.name in route.conflicts:
            findings.remark((route.name,), f"route '{route.name}' is declared to conflict with itself")


def _tell(first: TableRoute, second: TableRoute, fouls: Fouls, findings: Findings) -> None:
    """What is wrong with one pair."""
    declared = [second.name in first.conflicts, first.name in second.conflicts]
    elements, words = shared(first, second, fouls)
    names = f"routes '{first.name}' and '{second.name}'"
    if words:
        silent = [route.name for route, told in zip((first, second), declared, strict=True) if not told]
        by = f"route '{silent[0]}' does not declare it" if len(silent) == 1 else "neither declares it"
        text = f"{names} conflict by {', '.join(words)}, and {by}"
        findings.violation("conflicts are declared", (first.name, second.name, *elements), text)
    else:
        text = f"{names} are declared to conflict but share neither path nor points: nothing keeps them apart"
        findings.violation("declared conflicts follow", (first.name, second.name), text)
        if not all(declared):
            findings.remark((first.name, second.name), f"{names}: the conflict is declared by one of them only")


def _following(routes: Sequence[TableRoute], fouls: Fouls) -> list[int]:
    """For each route the others it shares something with, as the bits of an integer."""
    over: dict[tuple[str, str], int] = defaultdict(int)
    lying: dict[tuple[str, str], int] = defaultdict(int)
    for at, route in enumerate(routes):
        for name in _runs_over(route):
            over[name] |= 1 << at
        for point in route.points.items():
            over["point", point[0]] |= 1 << at
            lying[point] |= 1 << at
    found = []
    for route in routes:
        bits = 0
        for kind, over_it in _runs_over(route):
            bits |= over[kind, over_it]
            for other in fouls.get(over_it, frozenset()):
                bits |= over["section", other] | over["path", other]
        for point in route.points.items():
            bits |= over["point", point[0]] & ~lying[point]
        found.append(bits)
    return found


def _runs_over(route: TableRoute) -> list[tuple[str, str]]:
    return [("section", name) for name in route.sections] + [("path", name) for name in route.path]


def _declared(routes: Sequence[TableRoute]) -> tuple[list[int], list[int]]:
    """For each route the others it declares a conflict with, and those that declare one with it, as bits."""
    number = {route.name: at for at, route in enumerate(routes)}
    declares, declared = [0] * len(routes), [0] * len(routes)
    for at, route in enumerate(routes):
        for other in route.conflicts:
            declares[at] |= 1 << number[other]
            declared[number[other]] |= 1 << at
    return declares, declared


def _bits(value: int, first: int) -> Iterator[int]:
    """The places of the bits that are set, lowest first, counted from ``first``."""
    for at, digit in enumerate(reversed(f"{value:b}"), first):
        if digit == "1":
            yield at
