"""Declared conflicts against those that follow from what two routes share (T9)."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import combinations
from typing import TYPE_CHECKING

from models.layouts.findings import Findings

if TYPE_CHECKING:
    from models.layouts.table import TableRoute


def shared(first: TableRoute, second: TableRoute) -> tuple[list[str], list[str]]:
    """What makes two routes conflict: the elements, and each in words.

    Points wanted in different positions come first, then shared sections, then shared track
    outside of sections (two routes over a point in the same position meet there).
    """
    opposite = [p for p in first.points if second.points.get(p, first.points[p]) != first.points[p]]
    sections = [section for section in first.sections if section in second.sections]
    track = [] if sections else [piece for piece in first.path if piece in second.path]
    words = [f"point '{p}' ({first.points[p]} against {second.points[p]})" for p in opposite]
    words += [f"section '{section}'" for section in sections]
    words += [f"track '{piece}'" for piece in track]
    return [*opposite, *sections, *track], words


def compare_conflicts(routes: Sequence[TableRoute], findings: Findings) -> None:
    """Every pair: a conflict that follows must be declared by both; one that does not follow is needless."""
    for first, second in combinations(routes, 2):
        declared = [second.name in first.conflicts, first.name in second.conflicts]
        elements, words = shared(first, second)
        names = f"routes '{first.name}' and '{second.name}'"
        if words and not all(declared):
            silent = [route.name for route, told in zip((first, second), declared, strict=True) if not told]
            by = f"route '{silent[0]}' does not declare it" if len(silent) == 1 else "neither declares it"
            text = f"{names} conflict by {', '.join(words)}, and {by}"
            findings.violation("conflicts are declared", (first.name, second.name, *elements), text)
        elif not words and any(declared):
            text = f"{names} are declared to conflict but share neither path nor points: needless"
            findings.remark((first.name, second.name), text)
            if not all(declared):
                findings.remark((first.name, second.name), f"{names}: the conflict is declared by one of them only")
    for route in routes:
        if route.name in route.conflicts:
            findings.remark((route.name,), f"route '{route.name}' is declared to conflict with itself")
