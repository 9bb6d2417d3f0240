"""What the kernel is told of raw track: blocks, routes, points and tags, written down from a walk over the tracks.

Nothing here is of the project's own importer.  A :class:`Path` is the way of one route over the rails, in mm.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from itertools import pairwise

from kernel.layout import Layout, TagRecords
from kernel.names import Block, Point, Position, Record, Route, Tag, Train
from tests.independent.raw_graph import Cut, Network, Over, Place, Stop
from tests.independent.raw_graph import Route as Walked

TAG_MM = 4_000
"""So far from its boundary each tag lies: more than overhang, half the window and the error of laying together."""


@dataclass
class Path:
    """The way of one route; places on it count from the end of its start block.

    ``pieces``: track and heading -> from where to where it is run over, and the place of the first on the way.
    ``entry``: the end of the start block.
    """

    entry: Place
    ends_mm: dict[Block, int] = field(default_factory=dict)
    pieces: dict[tuple[str, int], list[tuple[int, int, int]]] = field(default_factory=dict)

    def place_mm(self, track: str, heading: int, mm: int) -> int | None:
        """Where on the way this place is, looked at in the way's direction."""
        for from_mm, to_mm, at_mm in self.pieces.get((track, heading), ()):
            if (from_mm < mm <= to_mm) if heading > 0 else (to_mm <= mm < from_mm):
                return at_mm + (mm - from_mm) * heading
        return None


@dataclass(frozen=True)
class Told:
    """One layout: the raw track, what the kernel is told of it, and the ways of its routes.

    ``fouling``: stretches beside each other, (track, from, to) and the like; two trains must not be in both.
    """

    name: str
    network: Network
    layout: Layout
    records: TagRecords
    paths: Mapping[Route, Path]
    fouling: tuple[tuple[tuple[str, int, int], tuple[str, int, int]], ...]
    lengths_mm: tuple[int, ...]
    speed_mm_s: int


def path_of(network: Network, route: Walked) -> Path:
    """Walk along a route to the end of its overlap."""
    pieces: list[tuple[str, int, int, int, int]] = []
    ends: list[tuple[Place, int]] = [] if route.from_end else [(route.entry, 0)]
    here, run_mm = route.entry, 0
    for event in network.follow(route.entry, lambda point, _: route.passed.get(point)):
        if isinstance(event, Over):
            track, end = network.junctions[event.passing.junction].legs[event.passing.leg]
            to_mm = network.lengths[track] if end else 0
        else:
            assert isinstance(event, Cut | Stop)
            to_mm = event.place.mm
        pieces.append((here.track, here.heading, here.mm, to_mm, run_mm))
        run_mm += abs(to_mm - here.mm)
        here = event.place
        if isinstance(event, Cut | Stop):
            ends.append((event.place, run_mm))
            if event.place == route.end:
                break
    first_mm = ends[0][1]
    path = Path(ends[0][0])
    for (_, at_mm), block in zip(ends, route.claims, strict=True):
        path.ends_mm[Block(block)] = at_mm - first_mm
    for track, heading, from_mm, to_mm, at_mm in pieces:
        path.pieces.setdefault((track, heading), []).append((from_mm, to_mm, at_mm - first_mm))
    return path


def tag_at(cut: str, block: str) -> Tag:
    """Name the tag beside a boundary, on the side of a block."""
    return Tag(f"{cut}@{block}")


def tags_of(network: Network) -> tuple[dict[Tag, Block], dict[Tag, Tag]]:
    """Two tags at each boundary between two blocks."""
    tag_in: dict[Tag, Block] = {}
    partner: dict[Tag, Tag] = {}
    for track, on_track in network.cuts.items():
        for mm, name in on_track:
            before, behind = (network.block_of[network.piece_ahead(Place(track, mm, heading))] for heading in (-1, 1))
            one, other = tag_at(name, before), tag_at(name, behind)
            tag_in |= {one: Block(before), other: Block(behind)}
            partner |= {one: other, other: one}
    return tag_in, partner


def list_of(network: Network, route: Walked) -> list[Tag]:
    """The tags that a head reads on a route, up to the one behind the entry of the destination."""
    names: list[str] = [] if route.from_end else [network.name_at(route.entry)]
    for event in network.follow(route.entry, lambda point, _: route.passed.get(point)):
        if isinstance(event, Cut):
            names.append(event.name)
        if isinstance(event, Cut | Stop) and event.place == route.exit:
            break
    blocks = [route.start, *route.covers]
    return [tag_at(name, block) for name, pair in zip(names, pairwise(blocks), strict=False) for block in pair]


def layout_of(network: Network, routes: Mapping[str, Walked], fouls: frozenset[tuple[str, str]], trains: int) -> Layout:
    """All relations that the kernel looks up."""
    by = {Route(name): route for name, route in sorted(routes.items())}
    tag_in, partner = tags_of(network)
    lists = {name: list_of(network, route) for name, route in by.items()}
    points_in = {Block(block): frozenset(map(Point, network.points_in.get(block, ()))) for block in network.blocks}
    stands_in = {point: block for block, points in points_in.items() for point in points}
    claims = {name: frozenset(map(Block, route.claims)) for name, route in by.items()}
    return Layout(
        fleet=frozenset(Train(f"T{number}") for number in range(1, trains + 1)),
        blocks=frozenset(map(Block, network.blocks)),
        routes=frozenset(by),
        points=frozenset(stands_in),
        start={name: Block(route.start) for name, route in by.items()},
        destination={name: Block(route.destination) for name, route in by.items()},
        covers={name: frozenset(map(Block, route.covers)) for name, route in by.items()},
        overlap={name: frozenset(map(Block, route.overlap)) for name, route in by.items()},
        claims=claims,
        way={name: {Block(a): Block(b) for a, b in pairwise(route.claims)} for name, route in by.items()},
        needs={name: {Point(p): Position(at) for p, at in route.needs.items()} for name, route in by.items()},
        released_with={
            name: {
                Point(p): stands_in[Point(p)] if stands_in[Point(p)] in claims[name] else Block(route.destination)
                for p in route.needs
            }
            for name, route in by.items()
        },
        released_after={
            name: {Block(a): Block(b) for a, b in route.released_after.items()}
            | {Block(a): Block(a) for a in route.overlap}
            for name, route in by.items()
        },
        fouls={
            block: frozenset(Block(b) for a, b in sorted(fouls | {(y, x) for x, y in fouls}) if a == block)
            for block in map(Block, network.blocks)
        },
        stands_in=stands_in,
        points_in=points_in,
        tag_in=tag_in,
        partner=partner,
        first_tag={name: tags[0] for name, tags in lists.items()},
        tag_list={},
        tag_after={name: dict(pairwise(tags)) for name, tags in lists.items()},
    )


def records_of(layout: Layout) -> TagRecords:
    """What is written in each tag."""
    return TagRecords({tag: Record(f"written in {tag}") for tag in layout.tag_in})
