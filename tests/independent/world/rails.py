"""Bodies on rails: an interval in mm on an axis of its own, and the tracks that the axis lies on.

The axis is laid as the body comes to new track, past points as they lie then, and taken up behind it.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import NamedTuple

from kernel.names import Block, Point, Position, Tag
from tests.independent.raw_graph import Place
from tests.independent.world.told import TAG_MM, Told, tag_at

BETWEEN = Position("between")
"""How a point lies that is on its way: no leg leads anywhere."""
Lies = Mapping[Point, Position]
Zone = tuple[int, int]
"""A pair of fouling stretches, and which of the two."""


class Piece(NamedTuple):
    """One track on the axis from ``low`` to ``high``; ``plus``: 1 if its mm grow along the axis, else -1."""

    low: int
    high: int
    track: str
    plus: int


class Mark(NamedTuple):
    """Something on a track, ``mm`` from its end 0: a boundary, or a tag."""

    mm: int
    cut: str
    tag: Tag | None


@dataclass
class Rails:
    """All tracks, what lies on them, and what joins them."""

    told: Told

    def __post_init__(self) -> None:
        network = self.told.network
        self.lengths = network.lengths
        self.marks: dict[str, list[Mark]] = {}
        self.stretches: dict[str, list[tuple[int, int, Block]]] = {}
        for track in network.lengths:
            self.marks[track] = []
            for mm, name in network.cuts.get(track, []):
                before, behind = (network.block_of[network.piece_ahead(Place(track, mm, way))] for way in (-1, 1))
                self.marks[track].append(Mark(mm - TAG_MM, name, tag_at(name, before)))
                self.marks[track].append(Mark(mm, name, None))
                self.marks[track].append(Mark(mm + TAG_MM, name, tag_at(name, behind)))
            pieces = [(track, index) for index in range(len(network.cuts.get(track, [])) + 1)]
            self.stretches[track] = [(*network.sides(piece), Block(network.block_of[piece])) for piece in pieces]
        self.zones: dict[str, list[tuple[int, int, Zone]]] = {track: [] for track in network.lengths}
        for index, pair in enumerate(self.told.fouling):
            for side, (track, low, high) in enumerate(pair):
                self.zones[track].append((low, high, (index, side)))

    def beyond(self, track: str, end: int, lies: Lies) -> tuple[str, int, str | None] | None:
        """The track and end that this end leads to, and the point passed; nothing if track ends or is closed."""
        at = self.told.network.leg_at.get((track, end))
        if at is None:
            return None
        junction = self.told.network.junctions[at[0]]
        ways = junction.ways_from(at[1])
        leg = ways.get(lies[Point(junction.name)]) if junction.moves else next(iter(ways.values()))
        if leg is None:
            return None
        onward, which = junction.legs[leg]
        return onward, which, junction.name if junction.moves else None

    def met_at(self, track: str, end: int) -> Point | None:
        """The point at a track end."""
        at = self.told.network.leg_at.get((track, end))
        return Point(at[0]) if at is not None and self.told.network.junctions[at[0]].moves else None


@dataclass
class Body:
    """Coupled cars: from ``low`` to ``high`` on their axis, over ``pieces`` in the order of the axis."""

    rails: Rails
    low: int
    high: int
    pieces: list[Piece]

    def intervals(self) -> list[tuple[str, int, int]]:
        """Which mm of which tracks it stands on."""
        found = []
        for low, high, track, plus in self.pieces:
            one, other = max(low, self.low), min(high, self.high)
            if one < other:
                found.append((track, one - low, other - low) if plus > 0 else (track, high - other, high - one))
        return found

    def blocks(self) -> frozenset[Block]:
        """The blocks that any of it is in."""
        return frozenset(
            block
            for track, low, high in self.intervals()
            for from_mm, to_mm, block in self.rails.stretches[track]
            if from_mm < high and low < to_mm
        )

    def zones(self) -> set[Zone]:
        """The fouling stretches that any of it is in."""
        return {
            zone
            for track, low, high in self.intervals()
            for from_mm, to_mm, zone in self.rails.zones[track]
            if from_mm < high and low < to_mm
        }

    def points(self) -> set[Point]:
        """The points that it stands over: it is on both sides of the blades."""
        found = set()
        for piece in self.pieces:
            for at, end in ((piece.low, 0 if piece.plus > 0 else 1), (piece.high, 1 if piece.plus > 0 else 0)):
                if self.low < at < self.high:
                    point = self.rails.met_at(piece.track, end)
                    if point is not None:
                        found.add(point)
        return found

    def place(self, at: int, way: int) -> Place:
        """The place on rails of a place on the axis, looking along it or back."""
        for low, high, track, plus in self.pieces:
            if (low < at <= high) if way > 0 else (low <= at < high):
                return Place(track, at - low if plus > 0 else high - at, plus * way)
        raise AssertionError(f"{at} is on no piece of {self.pieces}")

    def lay(self, way: int, lies: Lies) -> bool:
        """Lay one more track at an end of the axis, as points lie; whether there is one."""
        last = self.pieces[-1] if way > 0 else self.pieces[0]
        onward = self.rails.beyond(last.track, 1 if last.plus == way else 0, lies)
        if onward is None:
            return False
        track, end, _ = onward
        length, plus = self.rails.lengths[track], way if end == 0 else -way
        if way > 0:
            self.pieces.append(Piece(last.high, last.high + length, track, plus))
        else:
            self.pieces.insert(0, Piece(last.low - length, last.low, track, plus))
        return True

    def take_up(self) -> None:
        """Forget the track that it no longer stands on."""
        self.pieces = [piece for piece in self.pieces if piece.low < self.high and self.low < piece.high]

    def take_up_behind(self, way: int) -> None:
        """Forget the track that its rear has left."""
        if way > 0:
            self.pieces = [piece for piece in self.pieces if self.low < piece.high]
        else:
            self.pieces = [piece for piece in self.pieces if piece.low < self.high]

    def end_mm(self, way: int) -> int:
        """Where the axis laid so far ends."""
        return self.pieces[-1].high if way > 0 else self.pieces[0].low


def ahead(rails: Rails, place: Place, lies: Lies, boundaries: int) -> list[tuple[Place, int]]:
    """The boundaries met going on from a place as points lie, and how far each is; track ends count as one."""
    found: list[tuple[Place, int]] = []
    track, mm, heading = place
    run_mm = 0
    for _ in range(4 * boundaries):
        for at, _, tag in rails.marks[track] if heading > 0 else reversed(rails.marks[track]):
            if tag is None and (at - mm) * heading >= 0:
                found.append((Place(track, at, heading), run_mm + abs(at - mm)))
        length = rails.lengths[track]
        run_mm += length - mm if heading > 0 else mm
        onward = rails.beyond(track, 1 if heading > 0 else 0, lies)
        if onward is None or len(found) >= boundaries:
            found.append((Place(track, length if heading > 0 else 0, heading), run_mm))
            break
        track, end, _ = onward
        mm, heading = (0, 1) if end == 0 else (rails.lengths[track], -1)
    return found
