"""Trains: cars on an axis, an antenna below each end, a driver in one of two cabs, and what is on board.

A place on a train's axis, counted in the direction it runs in, is ``way`` times the place on the axis.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field

from kernel.maps import Map
from kernel.names import Block, Cab, Point, Position, Route, Tag, Train
from tests.independent.raw_graph import Place
from tests.independent.world.kernel_calls import Board
from tests.independent.world.rails import Body, Rails, ahead

OVERHANG_MM = 3_000
"""From an end of the train to the antenna there."""
WINDOW_MM = 300
"""So far before or behind its middle a tag is read."""
LAID_MM = 200
"""So far from the plan a tag may lie; with overhang and window less than ``TAG_MM``."""
ODOMETER_MM = 400
"""So far the odometer may be wrong, either way."""
LOOKS_AHEAD = 4
"""A run's entry is found within so many boundaries."""

LONG_CYCLES = 1_000
"""A brake that has been on for so many cycles holds."""

Happening = tuple[int, int, str, Tag | None]
"""Where the front is then, which in a row, and what happens: a boundary, a tag, the end of what is laid."""


def in_order(happening: Happening) -> tuple[int, int]:
    """By where the front is, and then by row."""
    return happening[0], happening[1]


@dataclass
class OnRails:
    """One train, with whatever it has left behind."""

    name: Train
    rails: Rails
    body: Body
    cars_mm: list[int]
    board: Board
    lies: Mapping[Point, Position]
    way: int = 1
    speed_mm_s: int = 0
    braked_cycles: int = LONG_CYCLES
    odometer_mm: int = 0
    parted_cycles: int = 0
    """Since it parted: cycles until the line's silence is noticed on board."""
    isolated: bool = False
    demanded: bool = False
    rest: list[Body] = field(default_factory=list)
    happenings: list[Happening] = field(default_factory=list)
    errors_mm: tuple[int, int] = (0, 0)
    _seen: tuple[int, int, int] = (0, 0, 0)
    _here: Place | None = None
    _ahead: list[tuple[Place, int]] = field(default_factory=list)
    thrown: int = 0
    """So many times a point has been thrown: what was seen ahead may be so no more."""

    # ---- as the machines on board may know it (sight.Sight)

    @property
    def at_rest(self) -> bool:
        return self.speed_mm_s == 0

    def wait_braked(self) -> None:
        """Its brake comes to hold it while it stands."""
        self.braked_cycles = LONG_CYCLES

    @property
    def whole(self) -> bool:
        return not self.rest

    @property
    def blocks(self) -> frozenset[Block]:
        found = self.body.blocks()
        for body in self.rest:
            found |= body.blocks()
        return found

    @property
    def place(self) -> int:
        """Where its front is, in the direction it runs in."""
        return self.body.high if self.way > 0 else -self.body.low

    @property
    def front_mm(self) -> tuple[int, int]:
        return self.place - self.errors_mm[0], self.place + self.errors_mm[1]

    @property
    def length_mm(self) -> int:
        return self.body.high - self.body.low

    @property
    def front_block(self) -> Block:
        self._look_ahead()
        assert self._here is not None
        track, mm, heading = self._here
        return next(
            block
            for low, high, block in self.rails.stretches[track]
            if (low < mm <= high if heading > 0 else low <= mm < high)
        )

    @property
    def front_block_end_mm(self) -> int:
        self._look_ahead()
        return self.place + self._ahead[0][1]

    def ends_mm(self, route: Route) -> tuple[int, Map[Block, int]] | None:
        self._look_ahead()
        assert self._here is not None
        path = self.rails.told.paths[route]
        place_mm = path.place_mm(self._here.track, self._here.heading, self._here.mm)
        if place_mm is not None and place_mm > 0:
            entry = self.place - place_mm
            begins = entry - self._back_mm(path.entry)
        else:
            found = [at for at, (place, _) in enumerate(self._ahead) if place == path.entry]
            if not found:
                return None
            entry = self.place + self._ahead[found[0]][1]
            back_mm = self._back_mm(self._here) if found[0] == 0 else -self._ahead[found[0] - 1][1]
            begins = self.place - back_mm
        return begins, {block: entry + end for block, end in path.ends_mm.items()}

    def _back_mm(self, place: Place) -> int:
        """How far behind a place the block before it begins, as points lie."""
        back = ahead(self.rails, Place(place.track, place.mm, -place.heading), self.lies, 2)
        return next((mm for _, mm in back if mm > 0), 0)

    def _look_ahead(self) -> None:
        key = self.place, self.way, self.thrown
        if key != self._seen or self._here is None:
            self._seen = key
            self._here = self.body.place(self.body.high if self.way > 0 else self.body.low, self.way)
            self._ahead = ahead(self.rails, self._here, self.lies, LOOKS_AHEAD)

    # ---- cabs and antennas

    @property
    def head_cab(self) -> Cab:
        return Cab(f"{self.name} {'A' if self.way > 0 else 'B'}")

    @property
    def tail_cab(self) -> Cab:
        return Cab(f"{self.name} {'B' if self.way > 0 else 'A'}")

    def look(self, draw: Callable[[int], int]) -> None:
        """Work out what lies on the way of front, rear and antennas, as far as track is laid."""
        found: list[Happening] = []
        now, length = self.place, self.length_mm
        for low, high, track, plus in self.body.pieces:
            for mm, _, tag in self.rails.marks[track]:
                at = self.way * (low + mm if plus > 0 else high - mm)
                if tag is None:
                    found.append((at, len(found), "front", None))
                    found.append((at + length, len(found), "rear", None))
                    continue
                at += draw(2 * (WINDOW_MM + LAID_MM) + 1) - WINDOW_MM - LAID_MM
                found.append((at + OVERHANG_MM, len(found), "head", tag))
                if self.whole:
                    found.append((at + length - OVERHANG_MM, len(found), "tail", tag))
        found.append((self.way * self.body.end_mm(self.way), len(found), "end", None))
        ahead_of_it = (each for each in found if each[0] > now or each[2] == "end")
        self.happenings = sorted(ahead_of_it, key=in_order, reverse=True)

    def await_overdue(self, mm: int) -> None:
        """A tag that the head has missed is found to be overdue so much farther on."""
        self.happenings = sorted([*self.happenings, (self.place + mm, -1, "overdue", None)], key=in_order, reverse=True)

    def go(self, to_mm: int) -> None:
        """Put the front there."""
        by = to_mm - self.place
        self.odometer_mm += by
        self.body.low += self.way * by
        self.body.high += self.way * by
