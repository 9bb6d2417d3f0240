"""Conflicts that a railML file declares, held against those that the centre keeps apart (T9)."""

from __future__ import annotations

from dataclasses import replace

from kernel.names import Route
from models.layouts.conflict_pairs import Conflicts
from models.layouts.railml.document import Document
from models.layouts.results import Imported, Remark, Violation

SHOWN = 10


def compare_declared(source: Document, imported: Imported) -> Imported:
    """The layout, with a violation for each declared conflict that follows from nothing that two routes share.

    The centre does not keep such routes apart.  Conflicts that follow and are not declared it keeps apart all the
    same: that is a remark.

    Raises:
        BadInput: a conflict is declared with what is no route.
    """
    declared = _declared(source)
    if not declared:
        return imported
    conflicts, routes = Conflicts(imported.layout), imported.layout.routes
    following = set(conflicts.pairs())
    violations = [
        Violation("declared conflicts follow", pair, f"routes '{pair[0]}' and '{pair[1]}' {WHY}")
        for pair in sorted(declared - following)
        if pair[0] in routes and pair[1] in routes
    ]
    silent = sorted(following - declared)
    shown = "; ".join(f"'{one}' and '{other}'" for one, other in silent[:SHOWN])
    text = f"{len(silent)} pairs of routes conflict and are not declared to: {shown}{' …' * (len(silent) > SHOWN)}"
    remarks = [Remark(tuple(dict.fromkeys(name for pair in silent[:SHOWN] for name in pair)), text)] if silent else []
    return replace(imported, violations=(*imported.violations, *violations), remarks=(*imported.remarks, *remarks))


WHY = "are declared to conflict, but share no block, no fouling block and no point: nothing keeps them apart"


def _declared(source: Document) -> set[tuple[Route, Route]]:
    """The pairs that are declared, each once."""
    known = {source.attribute(route, "id") for route in source.all("route")}
    found: set[tuple[Route, Route]] = set()
    for each in source.all("conflictingRoute"):
        named = [
            [source.attribute(source.referred(route), "id") for route in source.all(kind, each)]
            for kind in ("refersToRoute", "conflictsWithRoute")
        ]
        for name in (*named[0], *named[1]):
            if name not in known:
                raise source.bad(each, f"names '{name[:40]}', which is no route", "correct the reference")
        if len(named[0]) != 1 or not named[1]:
            raise source.bad(each, "does not say which route conflicts with which", "add its routes")
        found |= {(Route(min(named[0][0], other)), Route(max(named[0][0], other))) for other in named[1]}
    return {pair for pair in found if pair[0] != pair[1]}
