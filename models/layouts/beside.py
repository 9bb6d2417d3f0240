"""Points beside the path of a route, in blocks that it claims: they lie so that nothing comes onto it there (T9)."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field

from kernel.names import Block, Point, Position
from models.layouts.blocks import Blocks, opposite
from models.layouts.track import Cut, Heading, Joint

Lies = Mapping[Point, Position]


@dataclass(frozen=True)
class Beside:
    """A point beside the path: how it is to lie, and whether another position would open a way onto the path."""

    position: Position
    closing: frozenset[Position]
    is_trap: bool


@dataclass
class Spare:
    """How the points beside a path lie, remembered: routes share blocks and ways through them."""

    blocks: Blocks
    known: dict[tuple[Heading, frozenset[tuple[Point, Position]]], dict[Point, Beside]] = field(default_factory=dict)

    def of(self, block: Block, entry: Heading, lies: Lies) -> Mapping[Point, Beside]:
        """The points of a block that a path which comes in there does not pass; ``lies``: those that it does."""
        beside = self.blocks.points_in[block] - lies.keys()
        if not beside:
            return {}
        key = entry, frozenset(lies.items())
        if key not in self.known:
            path = _Path.through(self.blocks, entry, lies)
            self.known[key] = {point: self._beside(path, block, point) for point in beside}
        return self.known[key]

    def _beside(self, path: _Path, block: Block, point: Point) -> Beside:
        """The position that leads away from the path whatever comes to the point from outside.

        Where several do, or none, one is as good as another: it is the one that joins more track up to the next mark,
        or longer tracks; the first by name if they are alike in that too.
        """
        junction = self.blocks.segments.station.junctions[point]
        outside = [opposite(h) for h in self.blocks.ends[block] if isinstance(self.blocks.segments.at[h], Cut)]
        faced = [end for end in path.met_from(outside)[0] if end.junction == point]
        closing = [
            at
            for at in map(Position, sorted(junction.kind.positions))
            if not path.met_from(
                onward for end in faced for _, lies, onward in self.blocks.segments.onward(end) if at in lies
            )[1]
        ]
        every = [Position(at) for at in junction.kind.positions]
        best = min(closing or every, key=lambda at: (*self._less_track(point, at), at))
        return Beside(best, frozenset(closing), 0 < len(closing) < len(every))

    def _less_track(self, point: Point, position: Position) -> tuple[int, int]:
        """The track up to the next mark or point that a position joins, and whole tracks; less comes later."""
        segments, junction = self.blocks.segments, self.blocks.segments.station.junctions[point]
        ports = {port for pair in junction.kind.positions[position] for port in pair}
        joined = [segments.segments[segments.leaving[junction.ports[port]][0]] for port in ports]
        tracks_mm = sum(segments.station.tracks[each.track] for each in joined)
        return -sum(each.long_mm for each in joined), -tracks_mm


@dataclass(frozen=True)
class _Path:
    """The part of a path within one block."""

    blocks: Blocks
    segments: frozenset[int]
    junctions: frozenset[str]

    @staticmethod
    def through(blocks: Blocks, entry: Heading, lies: Lies) -> _Path:
        """From where it comes into the block to where it leaves it, or track ends."""
        segments, junctions, heading = {entry[0]}, set[str](), entry
        while isinstance(end := blocks.segments.at[heading], Joint):
            at = lies.get(Point(end.junction))
            heading = next(onward for _, open_in, onward in blocks.segments.onward(end) if at is None or at in open_in)
            segments.add(heading[0])
            junctions.add(end.junction)
        return _Path(blocks, frozenset(segments), frozenset(junctions))

    def met_from(self, starts: Iterable[Heading]) -> tuple[list[Joint], bool]:
        """What movements from these headings meet facing before the path, and whether they come to it at all.

        A point that lies against a movement stops none: a runaway goes through it.
        """
        faced: list[Joint] = []
        comes, met, todo = False, set[Heading](), list(starts)
        while todo:
            heading = todo.pop()
            if heading[0] in self.segments:
                comes = True
                continue
            if heading in met:
                continue
            met.add(heading)
            end = self.blocks.segments.at[heading]
            if not isinstance(end, Joint):
                continue
            if end.junction in self.junctions:
                comes = True
                continue
            ways = [onward for _, _, onward in self.blocks.segments.onward(end)]
            faced += [end] if len(ways) > 1 else []
            todo += ways
        return faced, comes
