"""From blocks and followed routes to a :class:`Layout` and its :class:`Ground` (T1, T2, T4, T7, T9)."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from itertools import pairwise

from kernel.layout import Layout, TagRecords
from kernel.names import Block, Point, Position, Route, Tag, Train
from kernel.tag_list_text import with_tag_lists
from models.ground import Ground
from models.layouts.beside import Spare
from models.layouts.blocks import Blocks, demanded, exits, inward
from models.layouts.clearance import legs_of
from models.layouts.distances import Onward, next_tag_mm, ways_in
from models.layouts.findings import Findings
from models.layouts.following import Path
from models.layouts.geometry import (
    say_what_hangs_on_nothing,
    say_what_is_no_railway,
    say_what_is_too_short,
    say_what_looks_alike,
)
from models.layouts.granting import Granted, grant, hold_flank
from models.layouts.loops import say_what_is_too_long, shortest_loop
from models.layouts.numbers import LARGEST_BLOCK_NUMBER, number_blocks, records_for
from models.layouts.reading import escaped
from models.layouts.results import Imported, Places
from models.layouts.told import Told
from models.layouts.track import Cut, Heading

Neighbours = Mapping[Block, frozenset[Block]]
Opens = Mapping[Block, Mapping[Block, Mapping[Point, Position]]]


def assemble(blocks: Blocks, paths: Iterable[Path], told: Told, findings: Findings) -> Imported:
    """Everything that is known of a layout, from its track and the paths of its routes."""
    neighbours, opens = open_track(blocks)
    granted: list[Granted] = []
    spare = Spare(blocks)
    paths = list(paths)
    for path in paths:
        route = grant(blocks, path, spare, findings)
        if route is not None:
            hold_flank(route, path.wanted.flank, blocks, opens, findings)
            granted.append(route)
    tags = Tags.laid_at(blocks)
    ways = ways_in(blocks, tag_name)
    say_what_is_no_railway(blocks, ways, tags.block, findings)
    say_what_is_too_short(paths, findings)
    say_what_hangs_on_nothing(blocks, paths, findings)
    say_what_looks_alike(blocks, told, findings)
    loop = shortest_loop(blocks, told)
    say_what_is_too_long(loop, told.longest_train_mm, blocks.bounds, findings)
    layout = _layout(blocks, granted, told, tags)
    ground = _ground(blocks, granted, told, tags, neighbours, opens)
    if told.held is not None:
        wanted = {pair for route in granted for pair in unshielded(route, neighbours)}
        for block, target in sorted(told.held - wanted):
            text = f"no route needs block '{block}' to be held out of '{target}' by authority: needless"
            findings.remark((block, target), text)
    return Imported(
        told.name,
        told.kind,
        layout,
        ground,
        _records(blocks, layout, neighbours, tags, ways, findings),
        _places(blocks, granted, tags),
        tuple(findings.remarks),
        tuple(findings.violations),
        blocks.segments.station,
        told,
        {Route(route.name): route.beside for route in granted},
        legs_of(blocks, told),
        loop,
    )


def open_track(blocks: Blocks) -> tuple[Neighbours, Opens]:
    """Which blocks share a detector, and how facing points must lie to run from one to the other."""
    neighbours: dict[Block, frozenset[Block]] = {}
    opens: dict[Block, Mapping[Block, Mapping[Point, Position]]] = {}
    for block, ends in blocks.ends.items():
        out = {heading: other for heading in ends if (other := blocks.beyond(heading)) is not None}
        neighbours[block] = frozenset(out.values())
        opens[block] = {
            other: demanded(blocks, block, inward(blocks, block), {h for h in out if out[h] == other})
            for other in sorted(neighbours[block])
        }
    return neighbours, opens


@dataclass(frozen=True)
class Tags:
    """The tags as planned: two at each detector between two blocks (T2)."""

    block: Mapping[Tag, Block]
    partner: Mapping[Tag, Tag]
    mark: Mapping[Tag, str]

    @staticmethod
    def laid_at(blocks: Blocks) -> Tags:
        """Lay two tags at every detector."""
        block: dict[Tag, Block] = {}
        partner: dict[Tag, Tag] = {}
        mark: dict[Tag, str] = {}
        for (index, _), end in blocks.segments.at.items():
            if isinstance(end, Cut):
                here, there = blocks.of[index], blocks.of[end.beyond[0]]
                block[tag_name(end.mark, here)] = here
                mark[tag_name(end.mark, here)] = end.mark
                partner[tag_name(end.mark, here)] = tag_name(end.mark, there)
        return Tags(block, partner, mark)


def tag_name(mark: str, block: Block) -> Tag:
    """The tag at a detector, on the side of a block; no two have one name, whatever these are called."""
    return Tag(f"{escaped(mark)}@{block}")


def tags_in_order(route: Granted) -> list[Tag]:
    """The tags that a train reads on a route, up to the one behind the entry of its destination."""
    boundaries = route.boundaries[: len(route.covers)]
    return [tag_name(mark, side) for mark, before, behind in boundaries for side in (before, behind)]


def _layout(blocks: Blocks, granted: Sequence[Granted], told: Told, tags: Tags) -> Layout:
    """The relations that the kernel is told."""
    order = {Route(route.name): tags_in_order(route) for route in granted}
    by = {Route(route.name): route for route in granted}
    return with_tag_lists(
        Layout(
            fleet=frozenset(Train(train) for train in told.trains),
            blocks=frozenset(blocks.pieces),
            routes=frozenset(by),
            points=frozenset(blocks.stands_in),
            start={name: route.start for name, route in by.items()},
            destination={name: route.covers[-1] for name, route in by.items()},
            covers={name: frozenset(route.covers) for name, route in by.items()},
            overlap={name: frozenset(route.overlap) for name, route in by.items()},
            claims={name: frozenset(route.claims) for name, route in by.items()},
            way={name: route.way for name, route in by.items()},
            needs={name: route.needs for name, route in by.items()},
            released_with={name: route.released_with for name, route in by.items()},
            released_after={name: route.released_after for name, route in by.items()},
            fouls=told.fouls,
            stands_in=blocks.stands_in,
            points_in=dict(blocks.points_in),
            tag_in=tags.block,
            partner=tags.partner,
            first_tag={name: read[0] for name, read in order.items()},
            tag_list={},
            tag_after={name: dict(pairwise(read)) for name, read in order.items()},
        )
    )


def _ground(
    blocks: Blocks, granted: Sequence[Granted], told: Told, tags: Tags, neighbours: Neighbours, opens: Opens
) -> Ground:
    """The track as it is; nothing is mislaid at import, so tags lie as planned."""
    movements = Movements(blocks)
    leads: dict[Route, dict[Block, dict[Block, dict[Point, Position]]]] = {}
    turnout: dict[Route, dict[Block, dict[Block, Point]]] = {}
    held: dict[Block, set[Block]] = {}
    for block, target in told.held or ():
        held.setdefault(block, set()).add(target)
    for route in granted:
        name = Route(route.name)
        leads[name] = {
            block: {
                target: movements.demanded(block, route.entries[block], target)
                for target in movements.led_to(route.entries[block])
            }
            for block in route.way
        }
        turnout[name] = {block: turned_from(route, leads[name][block], route.way[block]) for block in route.way}
        if told.held is None:
            for block, target in unshielded(route, neighbours):
                held.setdefault(block, set()).add(target)
    return Ground(
        leads=leads,
        neighbours=neighbours,
        opens=opens,
        turnout=turnout,
        flank_point={Route(route.name): route.flank for route in granted},
        held_by_authority={block: frozenset(targets) for block, targets in held.items()},
        laid_in=dict(tags.block),
        laid_leaves={tag: {other: frozenset({tags.block[tag]})} for tag, other in tags.partner.items()},
    )


class Movements:
    """Where movements from given headings lead, remembered: routes share them."""

    def __init__(self, blocks: Blocks) -> None:
        self.blocks = blocks
        self.led: dict[tuple[Heading, ...], frozenset[Block]] = {}
        self.demands: dict[tuple[tuple[Heading, ...], Block], dict[Point, Position]] = {}

    def led_to(self, entries: Sequence[Heading]) -> frozenset[Block]:
        """The blocks that track leads to for some position of the points."""
        key = tuple(entries)
        if key not in self.led:
            self.led[key] = frozenset(exits(self.blocks, entries))
        return self.led[key]

    def demanded(self, block: Block, entries: Sequence[Heading], target: Block) -> dict[Point, Position]:
        """How points met facing must lie on every way from these entries of a block to a neighbour."""
        key = (tuple(entries), target)
        if key not in self.demands:
            goals = {heading for heading in self.blocks.ends[block] if self.blocks.beyond(heading) == target}
            self.demands[key] = demanded(self.blocks, block, entries, goals)
        return self.demands[key]


def turned_from(route: Granted, leads: Mapping[Block, Mapping[Point, Position]], onward: Block) -> dict[Block, Point]:
    """For each block that a route is not to be led to, the point it holds that turns it away."""
    found: dict[Block, Point] = {}
    for target in sorted(set(leads) - {onward}):
        turning = [p for p in sorted(leads[target]) if p in route.needs and route.needs[p] != leads[target][p]]
        if turning:
            found[target] = turning[0]
    return found


def unshielded(route: Granted, neighbours: Neighbours) -> Iterable[tuple[Block, Block]]:
    """The pairs (from outside, into the route) that share a boundary and that no point of the route closes."""
    claims = frozenset(route.claims)
    for target in route.claims[1:]:
        for block in neighbours[target] - claims:
            if target not in route.flank.get(block, {}):
                yield block, target


def _records(
    blocks: Blocks,
    layout: Layout,
    neighbours: Neighbours,
    tags: Tags,
    ways: Mapping[Tag, Onward],
    findings: Findings,
) -> TagRecords:
    """What is written in the tags; more blocks on a route than 8 bits tell apart is a violation."""
    nearby = [{block, *others} for block, others in neighbours.items()]
    numbers = number_blocks(layout.blocks, [*layout.claims.values(), *nearby])
    for block in sorted(numbers):
        if numbers[block] > LARGEST_BLOCK_NUMBER:
            text = f"block '{block}' gets number {numbers[block]} among its routes and neighbours: a tag holds 8 bits"
            findings.violation("block numbers fit their tags", blocks.bounds[block], text)
    turnouts = frozenset(block for block in layout.blocks if layout.points_in[block])
    return records_for(tags.block, numbers, next_tag_mm(ways), turnouts)


def _places(blocks: Blocks, granted: Sequence[Granted], tags: Tags) -> Places:
    """Where everything came from in the file."""
    segments = blocks.segments.segments
    return Places(
        blocks=blocks.bounds,
        routes={Route(route.name): (route.name,) for route in granted},
        points={point: (str(point),) for point in blocks.stands_in},
        tags={tag: (mark,) for tag, mark in tags.mark.items()},
        spans={
            block: tuple((segments[i].track, segments[i].from_mm, segments[i].to_mm) for i in piece)
            for block, piece in blocks.pieces.items()
        },
    )
