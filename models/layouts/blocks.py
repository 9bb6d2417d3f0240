"""Blocks: the connected pieces of track that detectors cut (T2), and where movements in one lead.

All track of a piece, with all its points, is one block.  Every question here is asked of one
block at a time, so its cost is that of the block and not of the network.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property

from kernel.names import Block, Point, Position
from models.layouts.track import HIGH, LOW, Cut, Heading, Joint, Segments, Stop, WayOn


@dataclass(frozen=True)
class Blocks:
    """The blocks of a station.

    ``of``: the block of every segment.  ``ends``: for a block, the headings out of it, at
    detectors and at ends of track.  ``bounds``: the marks that bound it.  ``points_in``: its points.
    ``alike``: blocks whose names are told apart by a number alone, since one name was made for several.
    """

    segments: Segments
    of: Sequence[Block]
    pieces: Mapping[Block, tuple[int, ...]]
    ends: Mapping[Block, tuple[Heading, ...]]
    bounds: Mapping[Block, tuple[str, ...]]
    points_in: Mapping[Block, frozenset[Point]]
    alike: frozenset[Block] = frozenset()

    @cached_property
    def stands_in(self) -> Mapping[Point, Block]:
        """The block of each point."""
        return {point: block for block, points in self.points_in.items() for point in points}

    def beyond(self, heading: Heading) -> Block | None:
        """The block behind the detector that this heading runs to; none at the end of track."""
        end = self.segments.at[heading]
        return self.of[end.beyond[0]] if isinstance(end, Cut) else None


def find_blocks(segments: Segments, given: Mapping[int, str]) -> Blocks:
    """Join segments over junctions into blocks; ``given`` names the block of a segment.

    A crossing joins both of its tracks: they share the place where they cross.
    """
    root = list(range(len(segments.segments)))

    def find(index: int) -> int:
        while root[index] != index:
            root[index] = root[root[index]]
            index = root[index]
        return index

    for junction in segments.station.junctions.values():
        first, *others = (segments.leaving[end][0] for end in junction.ports.values())
        for other in others:
            root[find(first)] = find(other)
    pieces: dict[int, list[int]] = {}
    for index in range(len(root)):
        pieces.setdefault(find(index), []).append(index)
    return _named(segments, [tuple(piece) for piece in pieces.values()], given)


def _named(segments: Segments, pieces: list[tuple[int, ...]], given: Mapping[int, str]) -> Blocks:
    """Name each piece and collect what is in it."""
    of: list[Block] = [Block("")] * len(segments.segments)
    named: dict[Block, tuple[int, ...]] = {}
    ends: dict[Block, tuple[Heading, ...]] = {}
    bounds: dict[Block, tuple[str, ...]] = {}
    points: dict[Block, frozenset[Point]] = {}
    alike: set[Block] = set()
    for piece in pieces:
        out = tuple(
            heading for index in piece for heading in ((index, LOW), (index, HIGH)) if not _joins(segments, heading)
        )
        marks = sorted({mark for heading in out if (mark := _mark_at(segments, heading)) is not None})
        wanted = next((given[index] for index in piece if index in given), None)
        derived = "B:" + "+".join(marks or [segments.segments[piece[0]].track])
        block = _fresh(wanted or derived, named)
        if wanted is None and block != derived:
            alike |= {block, Block(derived)}
        named[block], ends[block], bounds[block] = piece, out, tuple(marks)
        for index in piece:
            of[index] = block
        joints = (segments.at[index, side] for index in piece for side in (LOW, HIGH))
        points[block] = frozenset(
            Point(end.junction)
            for end in joints
            if isinstance(end, Joint) and segments.station.junctions[end.junction].is_point
        )
    return Blocks(segments, of, named, ends, bounds, points, frozenset(alike))


def _joins(segments: Segments, heading: Heading) -> bool:
    return isinstance(segments.at[heading], Joint)


def _mark_at(segments: Segments, heading: Heading) -> str | None:
    end = segments.at[heading]
    return end.mark if isinstance(end, Cut | Stop) else None


def _fresh(name: str, taken: Mapping[Block, object]) -> Block:
    """The name, with ``#2``, ``#3`` … behind it where it is taken."""
    candidate, count = Block(name), 1
    while candidate in taken:
        count += 1
        candidate = Block(f"{name}#{count}")
    return candidate


def opposite(heading: Heading) -> Heading:
    """The same segment, the other way."""
    return heading[0], 1 - heading[1]


def walk(
    segments: Segments, starts: Iterable[Heading], may_take: Callable[[Joint, WayOn], bool] = lambda *_: True
) -> set[Heading]:
    """Every heading met by a movement inside one block from these on, by the ways over junctions that it may take."""
    met: set[Heading] = set()
    todo = list(starts)
    while todo:
        heading = todo.pop()
        if heading in met:
            continue
        met.add(heading)
        end = segments.at[heading]
        if isinstance(end, Joint):
            todo += [way[2] for way in segments.onward(end) if may_take(end, way)]
    return met


def _without(segments: Segments, point: Point, position: Position) -> Callable[[Joint, WayOn], bool]:
    """All ways but those over a point met facing that this position alone leads."""

    def may_take(joint: Joint, way: WayOn) -> bool:
        return (joint.junction, way[1]) != (point, (position,)) or len(segments.onward(joint)) < 2

    return may_take


def exits(blocks: Blocks, starts: Iterable[Heading]) -> set[Block]:
    """The blocks that movements from these headings are led to over all positions of points."""
    led = (blocks.beyond(heading) for heading in walk(blocks.segments, starts))
    return {block for block in led if block is not None}


def inward(blocks: Blocks, block: Block) -> list[Heading]:
    """The headings into a block from each of its ends."""
    return [opposite(heading) for heading in blocks.ends[block]]


def demanded(blocks: Blocks, block: Block, starts: Sequence[Heading], goals: set[Heading]) -> dict[Point, Position]:
    """The facing positions common to all movements in a block from ``starts`` to ``goals``.

    A position is common when no movement gets there without it.
    """
    found: dict[Point, Position] = {}
    if not goals & walk(blocks.segments, starts):
        return found
    for point in sorted(blocks.points_in[block]):
        for position in sorted(blocks.segments.station.junctions[point].kind.positions):
            without = _without(blocks.segments, point, Position(position))
            if not goals & walk(blocks.segments, starts, without):
                found[point] = Position(position)
    return found
