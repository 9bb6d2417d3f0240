"""Whether the rows of a table agree on how its blocks are joined: through points, and where there is none.

A table draws no track, so that two rows may each be possible and both together not: what one point in one position
joins, and what lies at either end of plain track, is the same for every row.
"""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterable, Iterator, Mapping, Sequence
from typing import TYPE_CHECKING

from kernel.names import Block, Point, Position
from models.layouts.findings import Findings

if TYPE_CHECKING:
    from models.layouts.table_layout import Row

Way = tuple[Block | None, Block | None]
"""The blocks at either end of one, the lower end first; none where a route starts or ends in it."""


Lie = frozenset[tuple[Point, Position]]
"""How the points of a block lie."""


def compare_ways(rows: Sequence[Row], stands_in: Mapping[Point, Block], findings: Findings) -> None:
    """Every pair of rows over one block: positions, blocks joined by them, and blocks at the ends of plain track."""
    _agree(rows, stands_in, findings)
    _lead_one_way(rows, stands_in, findings)
    _merge(rows, stands_in, findings)


def named(names: Iterable[str]) -> str:
    """The names in words."""
    return ", ".join(f"'{name}'" for name in names) or "none"


def _over_points(
    rows: Sequence[Row], stands_in: Mapping[Point, Block]
) -> Iterator[tuple[str, Block | None, Block, Lie, Block | None]]:
    """Each row in a block with points: its name, the block before, that block, how its points lie, and behind.

    None: the row starts or ends there.
    """
    for row in rows:
        for before, block, behind in zip([None, *row.chain[:-1]], row.chain, [*row.covers, None], strict=True):
            lie = frozenset(need for need in row.needs.items() if stands_in[need[0]] == block)
            if lie:
                yield row.route.name, before, block, lie, behind


def _agree(rows: Sequence[Row], stands_in: Mapping[Point, Block], findings: Findings) -> None:
    """A point joins two blocks in the same position on every route; where rows differ, the fewest are wrong."""
    lies: dict[tuple[Point, frozenset[Block]], dict[Position, list[str]]] = defaultdict(lambda: defaultdict(list))
    for name, before, _, lie, behind in _over_points(rows, stands_in):
        pair = frozenset(filter(None, (before, behind)))
        for point, position in lie if len(pair) == 2 else ():
            lies[point, pair][position].append(name)
    for (point, pair), by_position in sorted(lies.items(), key=lambda item: (item[0][0], sorted(item[0][1]))):
        most = max(map(len, by_position.values()))
        doubted = [at for at in by_position if len(by_position[at]) < most] or list(by_position)
        for position in sorted(doubted) if len(by_position) > 1 else ():
            for route in by_position[position]:
                between = named(sorted(pair))
                text = f"route '{route}' wants point '{point}' in '{position}' between {between}; others do not"
                findings.violation("a point lies one way between two blocks", (route, point), text)


def _lead_one_way(rows: Sequence[Row], stands_in: Mapping[Point, Block], findings: Findings) -> None:
    """From one side, the points of a block in the same positions lead to one other side.

    A route that starts or ends there has but one side, which is that of a route through, or one of two in all.
    """
    beyond: dict[tuple[Block, Lie], dict[Block, set[Block]]] = defaultdict(lambda: defaultdict(set))
    over: dict[tuple[Block, Lie], set[str]] = defaultdict(set)
    for name, before, block, lie, behind in _over_points(rows, stands_in):
        over[block, lie].add(name)
        for one, other in ((before, behind), (behind, before)):
            if one is not None:
                beyond[block, lie][one].update(filter(None, (other,)))
    for (block, lie), found in sorted(beyond.items(), key=lambda item: (item[0][0], sorted(item[0][1]))):
        if len(found) < 3 or all(len(others) == 1 for others in found.values()):
            continue
        sides, routes, points = sorted(found), sorted(over[block, lie]), sorted(lie)
        at = ", ".join(f"'{point}' in '{position}'" for point, position in points)
        text = f"point {at} joins {named(sides)} (routes {named(routes)}): it leads one way"
        findings.violation("a point leads one way", (*routes, *(point for point, _ in points), *sides), text)


def _merge(rows: Sequence[Row], stands_in: Mapping[Point, Block], findings: Findings) -> None:
    """Where no point stands, each end of a block adjoins one other, or each way through it has two of its own."""
    ways: dict[Block, dict[Way, set[str]]] = defaultdict(lambda: defaultdict(set))
    upward = rows[0].route.orientation
    for row in rows:
        for before, block, behind in zip([None, *row.chain[:-1]], row.chain, [*row.covers, None], strict=True):
            way = (before, behind) if row.route.orientation == upward else (behind, before)
            if block not in stands_in.values():
                ways[block][way].add(row.route.name)
    for block, found in ways.items():
        for end in (0, 1):
            _meet_at(end, block, found, findings)


def _meet_at(end: int, block: Block, ways: Mapping[Way, set[str]], findings: Findings) -> None:
    """Several blocks at one end of plain track are a violation, unless each has a way of its own through it.

    A route that starts or ends there tells of no way through: it may be on either.
    """
    beside = {way[end] for way in ways} - {None}
    others = {way[1 - end] for way in ways}
    apart = None not in others and len(others) == len(ways) == len(beside) and not others & beside
    if len(beside) < 2 or apart:
        return
    routes = sorted({route for way, over in ways.items() if way[end] is not None for route in over})
    text = f"routes {named(routes)} run between '{block}' and {named(sorted(filter(None, beside)))}: no point"
    elements = (*routes, *sorted(filter(None, beside)), str(block))
    findings.violation("tracks merge at a point", elements, f"{text} stands there")
