"""Interlocking tables: routes with their path, sections, points and declared conflicts, and no track plan.

Blocks are the sections, and the pieces of path that belong to no section: those are the track of
the points between sections.  Which piece of path belongs to which section is read off the table as
a whole: they are the pieces that come with it.

A route starts in the last block of the routes of its orientation that end at its source signal;
where there is none, in the block that routes the other way run into over the same leg.
Several such blocks, or none where the route leaves over points, are a violation; at a section where
the table begins the route starts in a block ``before <signal>`` of its own.  Track is known only as far as
routes run over it: from one block lead those that follow it on some route which came the same way.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable, Mapping, Sequence, Set
from dataclasses import dataclass, replace
from typing import Any

from jsonschema import Draft202012Validator

from models.layouts.alike import read, say_what_is_alike
from models.layouts.conflicts import compare_conflicts
from models.layouts.findings import Findings
from models.layouts.reading import by_name, identifier, validate
from models.layouts.results import BadInput, Imported
from models.layouts.table_layout import assemble_table, homes
from models.layouts.table_ways import named

_NAMED = {"type": "array", "items": {"type": "object", "required": ["id"], "properties": {"id": {"type": "string"}}}}
_POSITIONED = {
    "type": "array",
    "items": {
        "type": "object",
        "required": ["id", "position"],
        "properties": {"id": {"type": "string"}, "position": {"type": "string"}},
    },
}
_ROUTE = {
    "type": "object",
    "required": ["id", "source", "destination", "orientation", "path", "sections", "points", "conflicts"],
    "properties": {
        **{name: {"type": "string"} for name in ("id", "source", "destination", "orientation")},
        "path": _NAMED,
        "sections": _NAMED,
        "points": _POSITIONED,
        "conflicts": _NAMED,
    },
}
_VALIDATOR = Draft202012Validator(
    {
        "type": "object",
        "required": ["interlocking-table"],
        "properties": {
            "interlocking-table": {"type": "array", "items": _ROUTE},
            "fouling": {
                "type": "array",
                "items": {
                    "type": "array",
                    "items": {"type": "string"},
                    "minItems": 2,
                    "maxItems": 2,
                    "uniqueItems": True,
                },
            },
        },
    }
)


@dataclass(frozen=True)
class TableRoute:
    """One row of an interlocking table; ``path`` holds pieces of track in running order, and no signals."""

    name: str
    source: str
    destination: str
    orientation: str
    path: tuple[str, ...]
    sections: tuple[str, ...]
    points: Mapping[str, str]
    conflicts: frozenset[str]


def import_table(file: str, data: Any, trains: tuple[str, ...]) -> Imported:
    """The layout in an interlocking table.

    :raises BadInput: the data is no table, refers to what is not there, or has no routes.
    """
    validate(file, data, _VALIDATOR)
    routes = read_routes(file, data["interlocking-table"])
    findings = Findings("point")
    _say_what_is_not_read(data, findings)
    _say_which_ways(routes.values(), findings)
    _say_how_points_lie(routes.values(), findings)
    home, unclear = homes(list(routes.values()))
    for sections, pieces in unclear.items():
        text = f"{named(pieces)} always come with sections {named(sections)}: nothing tells which lies in which"
        findings.remark(pieces, text, "derived")
    whose = {name: sections for sections, pieces in unclear.items() for name in pieces}
    fouls = _fouling(file, data.get("fouling", ()), routes.values(), home, whose)
    compare_conflicts(list(routes.values()), fouls, findings)
    for what, each in (
        ("routes", lambda route: [route.name]),
        ("signals", lambda route: [route.source, route.destination]),
        ("pieces and sections", lambda route: [*route.path, *route.sections]),
        ("points", lambda route: route.points),
        ("ways to run", lambda route: [route.orientation]),
    ):
        names = (name for route in routes.values() for name in each(route))
        say_what_is_alike(what, dict.fromkeys(names), findings)
    return assemble_table(file, list(routes.values()), home, fouls, trains, findings)


def _say_what_is_not_read(data: Mapping[str, Any], findings: Findings) -> None:
    """A remark for whatever else stands in the table or in a row, such as a level crossing."""
    for field in sorted(set(data) - {"interlocking-table", "fouling"}):
        findings.remark((field,), f"{field} is not read: no route knows of it", "unread")
    told: dict[str, list[str]] = {}
    for row in data["interlocking-table"]:
        for field in sorted(field for field in set(row) - set(_ROUTE["properties"]) - WITHOUT_EFFECT if row[field]):
            told.setdefault(field, []).append(row["id"])
    for field, rows in sorted(told.items()):
        findings.remark(rows, f"{field} of {len(rows)} routes is not read: what it asks is asked by nobody", "unread")


WITHOUT_EFFECT = frozenset(("length", "signals"))
"""Of a row: track is held by the block, and what signals show follows from the routes that are set."""


def _say_which_ways(routes: Iterable[TableRoute], findings: Findings) -> None:
    """Track has two ways to run: a third word is one of these, and nobody knows which."""
    first: dict[str, str] = {}
    for route in routes:
        first.setdefault(route.orientation, route.name)
    if len(first) > 2:
        words = ", ".join(f"'{word}' (route '{name}')" for word, name in first.items())
        findings.violation(
            "routes run one way or the other", tuple(first.values()), f"{len(first)} ways to run: {words}"
        )


def _say_how_points_lie(routes: Iterable[TableRoute], findings: Findings) -> None:
    """A point lies one way or the other: a third word is one of these, and so is one that is read like another.

    Case alone is compared as well, since of a letter that is drawn as a Latin one the other case may not be.
    """
    first: dict[str, dict[str, str]] = {}
    for route in routes:
        for point, position in route.points.items():
            first.setdefault(point, {}).setdefault(position, route.name)
    for point, found in first.items():
        alike = any(len(set(map(key, found))) < len(found) for key in (read, str.casefold))
        if len(found) > 2 or alike:
            shown = ascii if alike else repr
            words = ", ".join(f"{shown(word)} (route '{name}')" for word, name in found.items())
            text = f"point '{point}' is told to lie {words}: give one word for each of its two positions"
            findings.violation("a point lies one way or the other", (point, *found.values()), text)


def _fouling(
    file: str,
    pairs: Iterable[list[str]],
    routes: Iterable[TableRoute],
    home: Mapping[str, str],
    unclear: Mapping[str, Sequence[str]],
) -> dict[str, frozenset[str]]:
    """The sections and pieces that a train in each also obstructs, both ways: what a table does not draw."""
    known = {name for route in routes for name in (*route.path, *route.sections)}
    sections = {name for route in routes for name in route.sections}
    found: dict[str, frozenset[str]] = {}
    for index, pair in enumerate(pairs):
        for name, other in (pair, reversed(pair)):
            if name not in known:
                what = f"no route runs over track '{name}'"
                raise BadInput(file, f"fouling[{index}]", what, "correct the name: a section, or a piece of path")
            if name in sections and home.get(name, name) != name:
                what = f"'{name}' is a section, and a piece of section '{home[name]}'"
                raise BadInput(file, f"fouling[{index}]", what, "give one of the two another name")
            if name in unclear and name not in sections:
                what = f"'{name}' may lie in section {' or '.join(unclear[name])}: no route tells in which"
                raise BadInput(file, f"fouling[{index}]", what, "give the section")
            found[name] = found.get(name, frozenset()) | {other}
    return found


def read_routes(file: str, rows: list[Mapping[str, Any]]) -> dict[str, TableRoute]:
    """The rows by route, with every declared conflict resolved."""
    named = by_name(file, "interlocking-table", rows)
    if not named:
        raise BadInput(file, "interlocking-table", "has no routes: nothing to check", "give the routes")
    routes = {name: _read_route(file, name, row) for name, row in named.items()}
    for name, route in routes.items():
        for other in sorted(route.conflicts - set(routes)):
            what = f"there is no route '{other}'"
            raise BadInput(file, f"route '{name}' conflicts", what, "correct the reference or add the route")
    signals = {signal for route in routes.values() for signal in (route.source, route.destination)}
    _refuse_names_of_two(file, list(routes.values()), signals)
    return {name: _on_track(file, route, signals) for name, route in routes.items()}


def _refuse_names_of_two(file: str, routes: Sequence[TableRoute], signals: Set[str]) -> None:
    """What has the name of a signal, or of a block that the import makes, would be taken for that."""
    made = {f"before {signal}": f"a block at signal '{signal}'" for signal in signals}
    made |= {f"at {point}": f"a block at point '{point}'" for route in routes for point in route.points}
    standing = dict.fromkeys(signals, "a signal")
    for route in routes:
        for field, names, others in (
            ("path", route.path, made),
            ("sections", route.sections, {**made, **standing}),
            ("points", route.points, standing),
        ):
            for name in (name for name in names if name in others):
                what = f"'{name}' is the name of {others[name]} too"
                raise BadInput(file, f"route '{route.name}' {field}", what, "give one of the two another name")


def _on_track(file: str, route: TableRoute, signals: Set[str]) -> TableRoute:
    """The row without the signals that its path passes: two routes that pass one signal share no track by that."""
    path = tuple(piece for piece in route.path if piece not in signals)
    if not path:
        place, what = f"route '{route.name}' path", "holds signals alone: the route leads over no track"
        raise BadInput(file, place, what, "give the pieces of track that it runs over")
    return replace(route, path=path)


def _read_route(file: str, name: str, row: Mapping[str, Any]) -> TableRoute:
    """One row; nothing in its lists may stand twice."""
    place = f"route '{name}'"
    lists: dict[str, list[str]] = {}
    for field in ("path", "sections", "points", "conflicts"):
        ids = [identifier(file, f"{place} {field}", item["id"]) for item in row[field]]
        twice = next((item for item, count in Counter(ids).items() if count > 1), None)
        if twice is not None:
            why = "the path runs in a loop" if field == "path" else "keep one of the two"
            raise BadInput(file, f"{place} {field}", f"lists '{twice}' twice", why)
        lists[field] = ids
    if not lists["path"] or not lists["sections"]:
        empty = "path" if not lists["path"] else "sections"
        raise BadInput(file, f"{place} {empty}", "is empty: the route leads through nothing", "give what it runs over")
    return TableRoute(
        name=name,
        source=identifier(file, f"{place} source", row["source"]),
        destination=identifier(file, f"{place} destination", row["destination"]),
        orientation=identifier(file, f"{place} orientation", row["orientation"]),
        path=tuple(lists["path"]),
        sections=tuple(lists["sections"]),
        points={item["id"]: identifier(file, f"{place} points", item["position"]) for item in row["points"]},
        conflicts=frozenset(lists["conflicts"]),
    )
