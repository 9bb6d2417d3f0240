"""Cars as points on the raw track, moved to and fro in mm; the track decides where they get to.

A needed point lies as the imported route wants it.  Any other lies at random, and is thrown for a car
only where the car could not pass it otherwise.
"""

from __future__ import annotations

import random
from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field
from itertools import pairwise
from typing import Protocol

from tests.independent.raw_graph import Closed, Network, Place, common
from tests.independent.raw_table import Enumerated as Table

SEGMENT_MM = 10_000
"""A table gives no lengths: each of its segments is taken to be so long."""


class Astray(Exception):
    """A car stands where the route does not cover, or cannot go on along it."""


class Track(Protocol):
    """Raw track with points lying some way."""

    def go(self, place: Place, mm: int) -> tuple[Place, list[str]]:
        """Move by so many mm, negative for back; the new place and every block touched on the way."""
        ...


@dataclass
class RawTrack:
    """Track of a file with tracks."""

    network: Network
    held: Mapping[str, str]
    chance: random.Random
    lies: dict[str, str] = field(init=False)

    def __post_init__(self) -> None:
        self.lies = {
            name: self.held.get(name) or self.chance.choice(sorted(junction.joins))
            for name, junction in self.network.junctions.items()
            if junction.moves
        }

    def _position(self, name: str, leg: str) -> str:
        """How the point lies for a car that comes by this leg."""
        ways = self.network.junctions[name].ways_from(leg)
        if self.lies[name] not in ways and name not in self.held:
            self.lies[name] = self.chance.choice(sorted(ways))
        return self.lies[name]

    def go(self, place: Place, mm: int) -> tuple[Place, list[str]]:
        if mm < 0:
            place, touched = self.go(place._replace(heading=-place.heading), -mm)
            return place._replace(heading=-place.heading), touched
        touched = []
        while True:
            low, high = self.network.sides(self.network.piece_ahead(place)) if mm else (place.mm, place.mm)
            if mm:
                touched.append(self.network.block_of[self.network.piece_ahead(place)])
            room = high - place.mm if place.heading > 0 else place.mm - low
            step = min(room, mm)
            place, mm = place._replace(mm=place.mm + step * place.heading), mm - step
            if mm == 0:
                return place, touched
            if place.mm in (0, self.network.lengths[place.track]) and step == room:
                place = self._past_end(place)

    def _past_end(self, place: Place) -> Place:
        at_end = place.mm == (self.network.lengths[place.track] if place.heading > 0 else 0)
        if not at_end:
            return place
        if (place.track, 1 if place.heading > 0 else 0) not in self.network.leg_at:
            raise Astray(f"track ends at {place}")
        over = self.network.cross(place, self._position)
        if isinstance(over, Closed):
            raise Astray(f"{over.junction} lies {over.position} against a car at {place}")
        return over.place


@dataclass
class TableTrack:
    """Track of a table, as far as the rows of one orientation tell it; a place's track is a segment."""

    table: Table
    orientation: str
    held: Mapping[str, str]
    chance: random.Random
    on: dict[str, dict[str, dict[str, str]]] = field(default_factory=dict)
    """Segment -> next segment -> what all rows with both want of the points standing in either."""
    back: dict[str, dict[str, dict[str, str]]] = field(default_factory=dict)

    def __post_init__(self) -> None:
        for row in self.table.rows.values():
            if row.orientation != self.orientation:
                continue
            way = [last_segment(self.table, row.name), *row.segments]
            for one, other in pairwise(way):
                near = {p: at for p, at in row.points.items() if self.table.stands_in[p] in (one, other)}
                for links, first, second in ((self.on, one, other), (self.back, other, one)):
                    known = links.setdefault(first, {}).setdefault(second, near)
                    links[first][second] = common(known, near)

    def block(self, segment: str) -> str:
        return self.table.block_of.get(segment, segment)

    def go(self, place: Place, mm: int) -> tuple[Place, list[str]]:
        segment, at, _ = place
        links, touched = self.on if mm > 0 else self.back, [self.block(segment)]
        at += mm
        while not 0 <= at <= SEGMENT_MM:
            open_to = [
                other
                for other, wanted in links.get(segment, {}).items()
                if all(self.held.get(point, position) == position for point, position in wanted.items())
            ]
            if not open_to:
                raise Astray(f"no way on from {segment} as {self.held}")
            segment = self.chance.choice(sorted(open_to))
            at += -SEGMENT_MM if mm > 0 else SEGMENT_MM
            touched.append(self.block(segment))
        return Place(segment, at, 1), touched


def last_segment(table: Table, route: str) -> str:
    """The segment that a train on a route stands in to begin with."""
    row = table.rows[route]
    ending = {
        other.segments[-1]
        for other in table.rows.values()
        if other.destination == row.source and other.orientation == row.orientation
    }
    return min(ending, default=table.routes[route].start)


@dataclass
class Walk:
    """Cars in order, the first one leading, and how far the leading one has to go."""

    track: Track
    cars: list[Place]
    run_mm: list[int]
    """How far each car is from where the first one began, negative behind it."""
    until_mm: int
    allowed: Mapping[str, str | None]
    """Block -> the next on the way; none for the last."""
    chance: random.Random
    end: Place | None = None
    """Where the leading car must be in the end, if that is known."""
    seen: list[str] = field(default_factory=list)
    """Blocks that the first car has been in, in order of first arrival."""

    def take(self) -> None:
        """Walk until the leading car has come to where the route ends; cars may fall behind and never follow."""
        stride = max(2, self.until_mm // 12)
        least = self.run_mm[-1]
        left_standing = self.chance.randint(1, len(self.cars))
        while self.run_mm[0] < self.until_mm:
            car = self.chance.randrange(len(self.cars))
            if car >= left_standing and self.chance.random() < 0.9:
                continue
            most = self.until_mm if car == 0 else self.run_mm[car - 1] - 1
            behind = least if car + 1 == len(self.cars) else self.run_mm[car + 1] + 1
            wish = self.run_mm[car] + self.chance.randint(-stride // 4, stride)
            self.move(car, min(max(wish, behind), most) - self.run_mm[car])
        if self.end not in (None, self.cars[0]):
            raise Astray(f"at {self.cars[0]} in the end, not at {self.end}")

    def move(self, car: int, mm: int) -> None:
        self.cars[car], touched = self.track.go(self.cars[car], mm)
        self.run_mm[car] += mm
        self.look(car, touched)

    def look(self, car: int, touched: Iterable[str]) -> None:
        for block in touched:
            if block not in self.allowed:
                raise Astray(f"car {car} is in {block}")
            if car == 0 and block not in self.seen:
                if self.seen and self.allowed[self.seen[-1]] != block:
                    raise Astray(f"from {self.seen[-1]} into {block}")
                self.seen.append(block)
