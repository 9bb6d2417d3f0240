"""An interlocking table surveyed: segments as rails of a nominal length, joined as rows run over them.

Rows of one orientation run over a segment the same way, rows of the other orientation against it.  The end of a
segment that two others adjoin is a point's: the one that stands there by :mod:`raw_table`, or one that the table
does not name.
"""

from __future__ import annotations

from collections.abc import Mapping
from itertools import pairwise
from typing import Any

from tests.independent.layouts.rails import Line, Survey
from tests.independent.raw_graph import End, Joins, Junction, Network, Place

SEGMENT_MM = 10_000
"""A table gives no lengths."""
Rows = list[dict[str, Any]]


def survey(data: Mapping[str, Any]) -> Survey:
    """The rails and routes of a table."""
    rows: Rows = [dict(row) for row in data["interlocking-table"]]
    signals = {name for row in rows for name in (row["source"], row["destination"])}
    for row in rows:
        row["id"] = str(row["id"])
        row["over"] = [each["id"] for each in row["path"] if each["id"] not in signals]
        row["lies"] = {str(each["id"]): each["position"] for each in row["points"]}
    first = min(row["orientation"] for row in rows)
    ways = {row["id"]: _directed(row, first) for row in rows}
    adjoins: dict[End, set[End]] = {}
    for row in rows:
        for one, other in pairwise(ways[row["id"]]):
            adjoins.setdefault(_out(one), set()).add(_in(other))
            adjoins.setdefault(_in(other), set()).add(_out(one))
    outside = {_in(ways[row["id"]][0]): (f"before {row['source']}", 1) for row in rows}
    outside = {end: before for end, before in outside.items() if end not in adjoins}
    for end, before in outside.items():
        adjoins[end] = {before}
        adjoins.setdefault(before, set()).add(end)
    links = _links(adjoins)
    section = _sections(rows)
    junctions, faults = _junctions(rows, ways, adjoins, links)
    cuts: dict[str, list[tuple[int, str]]] = {}
    for end, others in sorted(adjoins.items()):
        other = min(others)
        if section.get(end[0], end[0]) == section.get(other[0], other[0]) or len(others) > 1:
            continue
        if len(adjoins[other]) == 1 and (end[0] not in section, end) > (other[0] not in section, other):
            continue
        cuts.setdefault(end[0], []).append((SEGMENT_MM - 1 if end[1] else 1, _mark(end)))
    cuts |= {link: [(1, _mark((link, 0)))] for link, _ in links.values()}
    segments = {name for row in rows for name in row["over"]} | {
        name for name, _ in (*outside.values(), *links.values())
    }
    stops = {
        (name, at): _mark((name, at))
        for name in segments
        for at in (0, 1)
        if (name, at) not in adjoins and (name, at) not in links.values()
    }
    network = Network(dict.fromkeys(sorted(segments), SEGMENT_MM), cuts, junctions, stops)
    found = Survey(network, {}, {name: (t, mm) for t, each in cuts.items() for mm, name in each}, 0, faults)
    for row in rows:
        way = ways[row["id"]]
        entry, last = _entry(network, adjoins, way[0], row["lies"]), _mark(_out(way[-1]))
        if entry is None:
            faults.append(f"route {row['id']}: where it starts cannot be told")
        else:
            found.lines[row["id"]] = Line(row["id"], entry, row["lies"], last, last)
        found.declared |= {frozenset((row["id"], str(other["id"]))) for other in row["conflicts"]}
    return found


def _links(adjoins: Mapping[End, set[End]]) -> dict[tuple[End, End], End]:
    """Where two points lie back to back, a rail between them: for the end of each and the other's, its end there."""
    found: dict[tuple[End, End], End] = {}
    for end, others in sorted(adjoins.items()):
        for other in sorted(others):
            if end < other and len(others) > 1 and len(adjoins[other]) > 1:
                link = f"{_mark(end)} - {_mark(other)}"
                found |= {(end, other): (link, 0), (other, end): (link, 1)}
    return found


def _directed(row: Mapping[str, Any], first: str) -> list[tuple[str, int]]:
    return [(name, 1 if row["orientation"] == first else -1) for name in row["over"]]


def _out(directed: tuple[str, int]) -> End:
    return directed[0], 1 if directed[1] > 0 else 0


def _in(directed: tuple[str, int]) -> End:
    return directed[0], 0 if directed[1] > 0 else 1


def _mark(end: End) -> str:
    return f"{end[0]}/{end[1]}"


def _sections(rows: Rows) -> dict[str, str]:
    """Segment -> the section that exactly the rows over it list; of several each has its own, in running order."""
    by_section: dict[str, set[str]] = {}
    over: dict[str, set[str]] = {}
    for row in rows:
        for section in row["sections"]:
            by_section.setdefault(section["id"], set()).add(row["id"])
        for name in row["over"]:
            over.setdefault(name, set()).add(row["id"])
    found: dict[str, str] = {}
    for name, by in over.items():
        sections = [section for section, listing in by_section.items() if listing == by]
        place = [other for other, rows_over in over.items() if rows_over == by].index(name)
        found |= {name: sections[min(place, len(sections) - 1)]} if sections else {}
    return found


def _junctions(
    rows: Rows,
    ways: Mapping[str, list[tuple[str, int]]],
    adjoins: Mapping[End, set[End]],
    links: Mapping[tuple[End, End], End],
) -> tuple[dict[str, Junction], list[str]]:
    """Joints of two ends, and points where two adjoin one: by the row's points, the one that tells the legs apart."""
    found: dict[str, Junction] = {}
    faults: list[str] = []
    for end, others in sorted(adjoins.items()):
        if len(others) == 1:
            (other,) = others
            if len(adjoins[other]) == 1 and end < other:
                found[f"joint {_mark(end)}"] = Junction("", {"a": end, "b": other}, {"": (("a", "b"),)}, moves=False)
            continue
        point, legs = _telling(rows, ways, end, len(others))
        if not legs:
            faults.append(f"{_mark(end)}: tracks merge, and no point is told")
        name, legs = point or f"point at {_mark(end)}", legs or {_mark(other): other for other in sorted(others)}
        legs = {at: links.get((end, other), other) for at, other in legs.items()}
        joins: Joins = {at: (("tip", at),) for at in legs}
        found[name] = Junction(name, {"tip": end, **legs}, joins, moves=True)
    return found, faults


def _telling(rows: Rows, ways: Mapping[str, list[tuple[str, int]]], end: End, many: int) -> tuple[str, dict[str, End]]:
    """The point at an end: every row over it has it, and its position says which leg; of several the rarest."""
    lies: dict[str, dict[str, set[End]]] = {}
    over: list[dict[str, str]] = []
    for row in rows:
        for one, other in pairwise(ways[row["id"]]):
            pair = {_out(one), _in(other)}
            if end in pair:
                over.append(row["lies"])
                for point, at in row["lies"].items():
                    lies.setdefault(point, {}).setdefault(at, set()).update(pair - {end})
    telling = [
        point
        for point, by in lies.items()
        if len(by) == many and all(len(legs) == 1 for legs in by.values()) and all(point in row for row in over)
    ]
    name = min(telling, key=lambda point: (sum(point in row["lies"] for row in rows), point), default="")
    return name, {at: next(iter(by)) for at, by in lies.get(name, {}).items()}


def _entry(
    network: Network, adjoins: Mapping[End, set[End]], first: tuple[str, int], lies: Mapping[str, str]
) -> Place | None:
    """The boundary that a route is entered at: back from its first segment, over the leg that its point lies for."""
    end = _in(first)
    if end not in adjoins:
        return None
    name, leg = network.leg_at[end]
    junction = network.junctions[name]
    ways = junction.ways_from(leg)
    at = lies.get(name) if junction.moves else ""
    if at not in ways:
        return None
    track, which = junction.legs[ways[at]]
    for segment, heading in ((track, 1 if which else -1), (first[0], first[1])):
        marks = [
            mm
            for mm, mark in network.cuts.get(segment, [])
            if mark in (_mark((track, 0)), _mark((track, which)), _mark(end))
        ]
        if marks:
            return Place(segment, marks[0], heading)
    return None
