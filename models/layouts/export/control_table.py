"""The control table: what each route sets, locks, keeps clear and releases, as a signalling engineer reviews it."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

from kernel.layout import Layout
from kernel.names import Block, Point, Position, Route, Tag
from models.layouts.conflict_pairs import Conflicts
from models.layouts.results import Imported

Lies = tuple[Point, Position]


@dataclass(frozen=True)
class Row:
    """One route.

    ``entry``, ``exit``: the boundary or signal it is entered and left at; where the file tells none, those of its
    first tag and of its destination's.  ``covers``, ``overlap``: blocks in running order.  ``points``: those of its
    path, start and overlap with it; ``traps``: those in its blocks that lie so that nothing comes onto the path, and
    would let it in another position; ``spare``: those there that lie somehow; ``flank``: those outside, each with the
    block that it shields.
    ``authority``: the pairs (from outside, into the route) that train protection alone keeps apart.
    ``released``: blocks that come free together, once the tail has left the last of them.
    ``tags``: in the order in which they are read; the list of the first loop (T4).
    """

    route: Route
    entry: str
    exit: str
    start: Block
    covers: tuple[Block, ...]
    points: tuple[Lies, ...]
    traps: tuple[Lies, ...]
    spare: tuple[Lies, ...]
    flank: tuple[tuple[Lies, Block], ...]
    overlap: tuple[Block, ...]
    authority: tuple[tuple[Block, Block], ...]
    conflicts: tuple[Route, ...]
    released: tuple[tuple[Block, ...], ...]
    tags: tuple[Tag, ...]


def control_table(imported: Imported, conflicts: Conflicts) -> Iterator[Row]:
    """The rows, by the routes' order in the file where it tells one, else by name."""
    layout = imported.layout
    told = {Route(each.name): each for each in imported.told.routes} if imported.told is not None else {}
    order = [route for route in told if route in layout.routes] or sorted(layout.routes)
    for route in order:
        claimed = in_order(layout, route)
        covers = tuple(block for block in claimed if block in layout.covers[route])
        needs, role = layout.needs[route], imported.beside.get(route, {})
        inside = [(point, needs[point]) for point in _along(layout, claimed) if point in needs]
        beside = {point for point in needs if layout.stands_in[point] not in layout.claims[route]}
        tags = tuple(read_in_order(layout, route))
        last = imported.places.tags[tags[-1]][0]
        yield Row(
            route=route,
            entry=told[route].entry if route in told else imported.places.tags[tags[0]][0],
            exit=told[route].exit if route in told else last,
            start=layout.start[route],
            covers=covers,
            points=tuple(lies for lies in inside if lies[0] not in role),
            traps=tuple(lies for lies in inside if role.get(lies[0]) == "trap"),
            spare=tuple(lies for lies in inside if role.get(lies[0]) == "spare"),
            flank=tuple(((p, needs[p]), layout.released_with[route][p]) for p in sorted(beside)),
            overlap=tuple(block for block in claimed if block in layout.overlap[route]),
            authority=tuple(_by_authority(imported, route, claimed)),
            conflicts=tuple(conflicts.of(route)),
            released=tuple(_released(layout, route, claimed)),
            tags=tags,
        )


def in_order(layout: Layout, route: Route) -> list[Block]:
    """The blocks that a route claims, in running order."""
    found = [layout.start[route]]
    while found[-1] in layout.way[route]:
        found.append(layout.way[route][found[-1]])
    return found


def read_in_order(layout: Layout, route: Route) -> Iterator[Tag]:
    """The tags of a route in the order in which they are read."""
    tag: Tag | None = layout.first_tag[route]
    while tag is not None:
        yield tag
        tag = layout.tag_after[route].get(tag)


def _by_authority(imported: Imported, route: Route, claimed: Sequence[Block]) -> Iterator[tuple[Block, Block]]:
    """The pairs that no point of the route keeps apart, in its running order."""
    ground = imported.ground
    flank = ground.flank_point.get(route, {})
    for target in claimed[1:]:
        for block in sorted(ground.neighbours.get(target, frozenset()).difference(claimed)):
            if target in ground.held_by_authority.get(block, frozenset()) and target not in flank.get(block, {}):
                yield block, target


def _along(layout: Layout, blocks: Sequence[Block]) -> Iterator[Point]:
    """The points in blocks, block by block, by name in each."""
    for block in blocks:
        yield from sorted(layout.points_in.get(block, frozenset()))


def _released(layout: Layout, route: Route, claimed: Sequence[Block]) -> Iterator[tuple[Block, ...]]:
    """Blocks that come free together, in running order; the overlap is freed apart from it."""
    after = layout.released_after[route]
    together: dict[Block, list[Block]] = {}
    for block in claimed:
        if block not in layout.overlap[route]:
            together.setdefault(after[block], []).append(block)
    yield from map(tuple, together.values())
