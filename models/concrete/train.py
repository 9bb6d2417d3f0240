"""A train of cars on a path of rails, and what happens to it while it moves a distance (T2)."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from random import Random
from typing import Literal

from kernel.maps import Map
from kernel.names import Block, Car, Point, Position, Tag, Train
from models.concrete.rails import Piece, Rails
from models.layouts.blocks import opposite
from models.layouts.measures import ANTENNA_MM, WINDOW_MM
from models.layouts.track import Stop

CAR_MM = 20_000
"""The length of a car."""

Kind = Literal["enters", "leaves", "head reads", "tail reads"]
Key = tuple[Tag, int, bool]


@dataclass(frozen=True)
class Happening:
    """Something that happens once the train has moved ``after_mm`` more.

    ``order``: an axle enters before one leaves, and both before an antenna reads, at one distance.
    """

    after_mm: int
    order: int
    kind: Kind
    car: Car
    block: Block | None = None
    target: Block | None = None
    tag: Tag | None = None


@dataclass
class OnRails:
    """A train: its cars front to rear, its path, and how far along the path its front is.

    ``standing``: the cars left behind where it parted, with the blocks they are in.
    ``offsets``: for each passing of an antenna over a tag, where in its window it reads it.
    """

    name: Train
    cars: list[Car]
    path: list[Piece]
    front_mm: int
    random: Random
    standing: dict[Car, frozenset[Block]] = field(default_factory=dict)
    offsets: dict[Key, int] = field(default_factory=dict)

    @property
    def rear_mm(self) -> int:
        """How far along the path its rear is."""
        return self.front_mm - CAR_MM * len(self.cars)

    def ends(self, car: Car) -> tuple[int, int]:
        """Rear and front of a car along the path."""
        front = self.front_mm - CAR_MM * self.cars.index(car)
        return front - CAR_MM, front

    def blocks(self, rails: Rails) -> Mapping[Car, frozenset[Block]]:
        """The abstraction: the blocks each car is in; what its front touches counts, what its rear touches not."""
        found = dict(self.standing)
        for car in self.cars:
            rear, front = self.ends(car)
            found[car] = frozenset(
                rails.block[piece.heading[0]] for piece in self.path if front >= piece.from_mm and rear < piece.to_mm
            )
        return found

    def reach(self, rails: Rails, mm: int, lies: Map[Point, Position]) -> None:
        """Lengthen the path as the points lie, so that the train can move so far."""
        while self.path[-1].to_mm <= self.front_mm + mm:
            onward = rails.onward(self.path[-1].heading, lies)
            if onward is None:
                return
            begin = self.path[-1].to_mm
            self.path.append(Piece(onward, begin, begin + rails.length_mm(onward)))

    def look(self) -> None:
        """Forget what was seen of the path ahead: points there may lie otherwise by now."""
        self.path = [piece for piece in self.path if piece.from_mm <= self.front_mm]

    def room_mm(self, rails: Rails, block: Block, lies: Map[Point, Position]) -> int:
        """How far the front can go before it leaves a block that is ahead or around it."""
        self.look()
        while rails.block[self.path[-1].heading[0]] != block or not self._out(rails, self.path[-1]):
            before = len(self.path)
            self.reach(rails, self.path[-1].to_mm - self.front_mm, lies)
            assert len(self.path) > before, f"track ends before '{block}'"
        return self.path[-1].to_mm - self.front_mm

    def _out(self, rails: Rails, piece: Piece) -> bool:
        return rails.boundary(piece.heading) or isinstance(rails.segments.at[piece.heading], Stop)

    def happenings(self, rails: Rails, mm: int) -> Sequence[Happening]:
        """What happens on the next so many mm, in order."""
        found: list[Happening] = []
        for piece, after in zip(self.path, self.path[1:], strict=False):
            if rails.boundary(piece.heading):
                block, target = rails.block[piece.heading[0]], rails.block[after.heading[0]]
                for car in self.cars:
                    rear, front = self.ends(car)
                    found.append(Happening(piece.to_mm - front, 0, "enters", car, block, target))
                    found.append(Happening(piece.to_mm - rear, 1, "leaves", car, block))
        for at, piece in enumerate(self.path):
            for place, tag in rails.tags(piece):
                head, tail = self.front_mm - ANTENNA_MM, self.rear_mm + ANTENNA_MM
                here = place + self._offset((tag, at, True)) - head
                found.append(Happening(here, 2, "head reads", self.cars[0], tag=tag))
                here = place + self._offset((tag, at, False)) - tail
                found.append(Happening(here, 2, "tail reads", self.cars[-1], tag=tag))
        return sorted((h for h in found if 0 < h.after_mm <= mm), key=lambda h: (h.after_mm, h.order))

    def _offset(self, key: Key) -> int:
        """Where in its window an antenna reads a tag, this time."""
        if key not in self.offsets:
            self.offsets[key] = self.random.randint(-WINDOW_MM // 2, WINDOW_MM // 2)
        return self.offsets[key]

    def turn(self) -> None:
        """Change ends: the path is what the train stands on, the other way."""
        under = [piece for piece in self.path if piece.to_mm > self.rear_mm and piece.from_mm <= self.front_mm]
        top = under[-1].to_mm
        self.path, begin = [], 0
        for piece in reversed(under):
            length = piece.to_mm - piece.from_mm
            self.path.append(Piece(opposite(piece.heading), begin, begin + length))
            begin += length
        self.front_mm = top - self.rear_mm
        self.cars.reverse()
        self.offsets = {}

    def part(self, rails: Rails, cars: int) -> None:
        """The last so many cars stay where they are."""
        where = self.blocks(rails)
        for car in self.cars[-cars:]:
            self.standing[car] = where[car]
        del self.cars[-cars:]
