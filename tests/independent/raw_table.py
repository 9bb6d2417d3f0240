"""An interlocking table read with ``yaml`` alone, and its routes followed from row to row.

A table knows track only by the segments that its rows list.  Which segments a section is made of, and
on which one a point stands, is not written in it; both follow from the rows, because a section's own
segments are those listed by exactly the rows that list the section, and so for points.  Several sections of the same
rows have theirs in running order.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import yaml

from tests.independent.raw_graph import Finding
from tests.independent.raw_names import as_drawn


@dataclass
class Row:
    """One route as the table has it."""

    name: str
    source: str
    destination: str
    orientation: str
    segments: list[str]
    sections: list[str]
    points: dict[str, str]
    conflicts: set[str]


@dataclass
class TableRoute:
    """What follows for one route.  A block is a section, or a segment that no section has."""

    name: str
    start: str
    covers: list[str]
    needs: dict[str, str]
    released_after: dict[str, str]
    overlap: list[str] = field(default_factory=list)
    """None: a table has no overlaps."""

    @property
    def destination(self) -> str:
        return self.covers[-1]

    @property
    def claims(self) -> list[str]:
        return [self.start, *self.covers]


@dataclass
class Enumerated:
    """What the walk over one file finds."""

    rows: dict[str, Row]
    block_of: dict[str, str]
    """Segment -> section, or itself."""
    stands_in: dict[str, str]
    """Point -> block."""
    routes: dict[str, TableRoute] = field(default_factory=dict)
    violations: list[Finding] = field(default_factory=list)
    remarks: list[Finding] = field(default_factory=list)
    fouling: list[tuple[str, str]] = field(default_factory=list)
    """Sections or segments, a train on either of which obstructs the other."""


def _ids(items: list[dict[str, Any]]) -> list[str]:
    return [str(item["id"]) for item in items]


def rows_of(data: dict[str, Any]) -> dict[str, Row]:
    """Route -> its row; signals are taken out of the path."""
    table = data["interlocking-table"]
    signals = {signal for row in table for signal in (*_ids(row.get("signals", [])), row["source"], row["destination"])}
    return {
        str(row["id"]): Row(
            str(row["id"]),
            row["source"],
            row["destination"],
            row["orientation"],
            [item for item in _ids(row["path"]) if item not in signals],
            _ids(row["sections"]),
            {str(point["id"]): point["position"] for point in row["points"]},
            set(_ids(row["conflicts"])),
        )
        for row in table
    }


def enumerate_file(path: Path) -> Enumerated:
    return enumerate_data(yaml.safe_load(path.read_text(encoding="utf-8")))


def enumerate_data(data: dict[str, Any]) -> Enumerated:
    rows = rows_of(data)
    listed = {segment: _listing(rows, "segments", segment) for row in rows.values() for segment in row.segments}
    of_section = {section: _listing(rows, "sections", section) for row in rows.values() for section in row.sections}
    of_point = {point: _listing(rows, "points", point) for row in rows.values() for point in row.points}
    block_of: dict[str, str] = {}
    for segment, by in listed.items():
        sections = [section for section, names in of_section.items() if names == by]
        place = [other for other, names in listed.items() if names == by].index(segment)
        block_of[segment] = sections[min(place, len(sections) - 1)] if sections else segment
    bare = [segment for segment in listed if block_of[segment] == segment]
    stands_in: dict[str, str] = {}
    for point, by in of_point.items():
        under = {
            segment: (-len(by & listed[segment]), len(listed[segment])) for segment in bare if by & listed[segment]
        }
        stands_in[point] = min(under, key=lambda segment: under[segment], default=f"at {point}")
    found = Enumerated(rows, block_of, stands_in, fouling=[(str(a), str(b)) for a, b in data.get("fouling", [])])
    for row in rows.values():
        _follow(found, row)
    for row in rows.values():
        _look_astray(found, row)
    first = {row.orientation: row.name for row in reversed(rows.values())}
    if len(first) > 2:
        found.violations.append(Finding("routes run one way or the other", tuple(first.values())))
    _compare_words(found)
    _compare_positions(found)
    _look_where_nothing_detects(found)
    _look_at_ends(found)
    _compare_conflicts(found)
    return found


def _listing(rows: dict[str, Row], what: str, item: str) -> frozenset[str]:
    """The rows that list an item."""
    return frozenset(name for name, row in rows.items() if item in getattr(row, what))


def _blocks(found: Enumerated, row: Row) -> list[str]:
    """The blocks of a row's path, in order; passed twice is listed twice."""
    blocks: list[str] = []
    for segment in row.segments:
        if not blocks or blocks[-1] != found.block_of[segment]:
            blocks.append(found.block_of[segment])
    return blocks


def _start(found: Enumerated, row: Row) -> str:
    """The last block of the rows of its orientation that end at its source."""
    before = {
        _blocks(found, other)[-1]
        for other in found.rows.values()
        if other.destination == row.source and other.orientation == row.orientation
    }
    if len(before) > 1:
        found.violations.append(Finding("a signal stands at one section", (row.source, *sorted(before))))
    if before:
        return min(before)
    known = _facing(found, row)
    mine = next(each for each in found.rows.values() if each.source == row.source)
    edge = _blocks(found, mine)[0] in {section for each in found.rows.values() for section in each.sections}
    if len(known) > 1 or not (known or edge):
        found.violations.append(Finding("a route starts in a known block", (row.source, *sorted(known))))
    return min(known, default=f"before {row.source}")


def _facing(found: Enumerated, row: Row) -> set[str]:
    """What rows run into that come back along the beginning of rows from this source, or come from on their way."""
    known: set[str] = set()
    for mine in (each for each in found.rows.values() if each.source == row.source):
        way = _blocks(found, mine)
        for other in found.rows.values():
            back = _blocks(found, other)
            if other.orientation == mine.orientation:
                back = back[::-1]
            if way[0] not in back[:-1]:
                continue
            place = back.index(way[0])
            if place and len(way) > 1 and back[place - 1] != way[1]:
                continue
            first = next(iter(mine.points), None)
            if first is None or other.points.get(first, mine.points[first]) == mine.points[first]:
                known |= {back[place + 1]} - set(way)
    return known


def _follow(found: Enumerated, row: Row) -> None:
    blocks = _blocks(found, row)
    sections = [block for block in blocks if block in {s for r in found.rows.values() for s in r.sections}]
    if sections != row.sections:
        found.violations.append(Finding("sections are those of the path", (row.name,)))
    for block in dict.fromkeys(blocks):
        if blocks.count(block) > 1:
            found.violations.append(Finding("a route passes a block once", (row.name, block)))
    start = _start(found, row)
    if start in blocks:
        found.violations.append(Finding("a_route_claims_start_covers_and_overlap", (row.name, start)))
    released = {start: start, blocks[-1]: blocks[-1]} | dict.fromkeys(blocks[:-1], blocks[-2] if blocks[1:] else "")
    found.routes[row.name] = TableRoute(row.name, start, blocks, dict(row.points), released)
    standing = {point for point, block in found.stands_in.items() if block in (start, *blocks)}
    for point in sorted(standing - set(row.points)):
        found.violations.append(Finding("a route is led over its points", (row.name, point)))
        if found.stands_in[point] in blocks:
            place = row.name, point, found.stands_in[point]
            found.violations.append(Finding("every_point_in_a_route_is_needed", place))
    for point in sorted(set(row.points) - standing):
        found.violations.append(Finding("a route's positions are of its points", (row.name, point)))


def _onwards(found: Enumerated, orientation: str) -> dict[tuple[str, str], list[tuple[str, dict[str, str]]]]:
    """Block and next block, as rows of an orientation have them -> where each came from, how the points lie there."""
    wanted: dict[tuple[str, str], list[tuple[str, dict[str, str]]]] = {}
    for route in found.routes.values():
        row = found.rows[route.name]
        way = ["", route.start, *route.covers]
        for came, block, following in zip(way, way[1:], way[2:], strict=False):
            here = {point: position for point, position in row.points.items() if found.stands_in[point] == block}
            if row.orientation == orientation:
                wanted.setdefault((block, following), []).append((came, here))
    return wanted


def _look_astray(found: Enumerated, row: Row) -> None:
    """Blocks that rows which came the same way go on to, and no point that all rows there want turns this one away."""
    route = found.routes[row.name]
    every = _onwards(found, row.orientation)
    way = ["", route.start, *route.covers]
    for came, block, following in zip(way, way[1:], way[2:], strict=False):
        for (of, into), rows in sorted(every.items()):
            astray = of == block and into != following and (not came or any(other in ("", came) for other, _ in rows))
            wanted = {point: at for point, at in rows[0][1].items() if all(here.get(point) == at for _, here in rows)}
            if astray and not any(route.needs.get(point, at) != at for point, at in wanted.items()):
                found.violations.append(Finding("track_leads_along_the_way_or_is_turned", (row.name, block, into)))


def _compare_words(found: Enumerated) -> None:
    """Routes that meet at one signal and not in one block, and a point with more words than positions."""
    for row in found.rows.values():
        first, against = _blocks(found, row)[0], [r for r in found.rows.values() if r.destination == row.source]
        ends = {_blocks(found, other)[-1] for other in against if other.orientation != row.orientation}
        if ends and first not in ends:
            found.violations.append(Finding("a signal stands at one place", (row.source, row.name, first, *ends)))
    for point in found.stands_in:
        rows = {row.points[point]: row.name for row in reversed(found.rows.values()) if point in row.points}
        spelt = [{word.lower() for word in rows}, {as_drawn(word).lower() for word in rows}]
        if len(rows) > 2 or min(map(len, spelt)) < len(rows):
            found.violations.append(Finding("a point lies one way or the other", (point, *rows.values())))


def _compare_positions(found: Enumerated) -> None:
    """Rows that run between the same two blocks over a point want it alike; the odd ones out are named."""
    wanted: dict[tuple[str, frozenset[str]], dict[str, set[str]]] = {}
    for route in found.routes.values():
        way = [route.start, *route.covers]
        for before, block, after in zip(way, way[1:], way[2:], strict=False):
            for point, position in found.rows[route.name].points.items():
                if found.stands_in[point] == block:
                    by = wanted.setdefault((point, frozenset((before, after))), {})
                    by.setdefault(position, set()).add(route.name)
    odd: set[tuple[str, str]] = set()
    for (point, _), by in wanted.items():
        most = max(len(routes) for routes in by.values())
        few = [routes for routes in by.values() if len(routes) < most] or list(by.values())
        odd |= {(route, point) for routes in few for route in routes if len(by) > 1}
    found.violations += [Finding("a point lies one way between two blocks", one) for one in sorted(odd)]


def _look_where_nothing_detects(found: Enumerated) -> None:
    """A segment of no section on which no point stands, with every row over it."""
    for segment in sorted(
        {one for one, block in found.block_of.items() if one == block} - set(found.stands_in.values())
    ):
        over = [row.name for row in found.rows.values() if segment in row.segments]
        found.violations.append(Finding("track lies in a section or at a point", (segment, *over)))


def _look_at_ends(found: Enumerated) -> None:
    """What adjoins each end of a block, with its points lying one way or without any: what several rows may not tell.

    The ends of a block are left and right of a train of the first row's orientation.
    """
    ways: dict[tuple[str, tuple[str, ...]], set[tuple[str, str, str]]] = {}
    orientation = next(iter(found.rows.values())).orientation
    for route in found.routes.values():
        way, points = ["", route.start, *route.covers, ""], found.rows[route.name].points
        for left, block, right in zip(way, way[1:], way[2:], strict=False):
            lying = tuple(sorted(f"{point} {at}" for point, at in points.items() if found.stands_in[point] == block))
            ends = (left, right) if found.rows[route.name].orientation == orientation else (right, left)
            if lying or block not in found.stands_in.values():
                ways.setdefault((block, lying), set()).add((*ends, route.name))
    for (block, lying), told in ways.items():
        standing = [point for point, under in found.stands_in.items() if under == block]
        if lying:
            _lie_one_way(found, standing, told)
        else:
            _adjoin(found, block, told)


def _lie_one_way(found: Enumerated, points: list[str], told: set[tuple[str, str, str]]) -> None:
    """Points that lie the same join two blocks, or pairs of blocks of which none has one that another has."""
    beyond: dict[str, set[str]] = {}
    for left, right, _ in told:
        for one, other in ((left, right), (right, left)):
            if one:
                beyond.setdefault(one, set()).update({other} - {""})
    if len(beyond) > 2 and any(len(others) != 1 for others in beyond.values()):
        named = sorted({name for *_, name in told})
        found.violations.append(Finding("a point leads one way", (*named, *points, *sorted(beyond))))


def _adjoin(found: Enumerated, block: str, told: set[tuple[str, str, str]]) -> None:
    """Plain track adjoins one block at an end, or two tracks through it are apart and no row starts or ends there."""
    for end in (0, 1):
        beside = sorted({ends[end] for ends in told} - {""})
        ways = {(left, right) for left, right, _ in told}
        beyond = [right if end == 0 else left for left, right in ways]
        twice = {left for left, _ in ways} & {right for _, right in ways} - {""}
        if len(beside) > 1 and (twice or "" in beyond or len(set(beyond)) < len(beyond) or len(beside) < len(beyond)):
            named = sorted({ends[2] for ends in told if ends[end]})
            found.violations.append(Finding("tracks merge at a point", (*named, *beside, block)))


def fouling_blocks(found: Enumerated) -> set[tuple[str, str]]:
    """The blocks that foul each other, each pair both ways."""
    pairs = {(found.block_of.get(one, one), found.block_of.get(other, other)) for one, other in found.fouling}
    return {pair for one, other in pairs if one != other for pair in ((one, other), (other, one))}


def shared(found: Enumerated, one: str, other: str) -> tuple[list[str], list[str], list[str]]:
    """What two routes share: points wanted in different positions, sections or, sharing none, track outside them.

    What the table tells to foul each other comes last.
    """
    first, second = found.rows[one], found.rows[other]
    points = sorted(p for p in first.points if second.points.get(p, first.points[p]) != first.points[p])
    sections = sorted(set(first.sections) & set(second.sections))
    track = set(first.segments) & set(second.segments)
    bare = sorted(segment for segment in track if found.block_of[segment] == segment)
    over, there = {*first.segments, *first.sections}, {*second.segments, *second.sections}
    foul = [(a, b) for pair in found.fouling for a, b in (pair, pair[::-1]) if a in over and b in there]
    return points, sections, [*(bare if not sections else []), *(name for pair in foul for name in pair)]


def _compare_conflicts(found: Enumerated) -> None:
    names = list(found.rows)
    for place, one in enumerate(names):
        for other in names[place + 1 :]:
            points, sections, track = shared(found, one, other)
            declared = (other in found.rows[one].conflicts, one in found.rows[other].conflicts)
            if (points or sections or track) and not all(declared):
                found.violations.append(Finding("conflicts are declared", (one, other, *points, *sections, *track)))
            elif not (points or sections or track) and any(declared):
                found.violations.append(Finding("declared conflicts follow", (one, other)))
                if not all(declared):
                    found.remarks.append(Finding("conflict declared by one only", (one, other)))
