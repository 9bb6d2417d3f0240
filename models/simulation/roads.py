"""Where roads cross the line, from a file, and how far it is to them from anywhere, however the points lie (X1).

A table a road, named as it is called: ``["Mill Road"]`` with ``places``, one for each track that it crosses, by the
track's name in the layout file and the distance in m from where that track begins.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass
from heapq import heappop, heappush
from pathlib import Path
from typing import Any

from models.concrete.rails import Rails
from models.concrete.train import OnRails
from models.layouts.results import BadInput
from models.layouts.track import HIGH, LOW, Heading
from models.simulation.facing import onwards
from models.simulation.tables import number_of, tables_of

MOST_ROADS, MOST_PLACES = 99, 16


@dataclass(frozen=True)
class Road:
    """A level crossing: its name, and for each track that it crosses the segment and the mm from its low end."""

    name: str
    places: tuple[tuple[int, int], ...]


def read_roads(path: Path, rails: Rails) -> tuple[Road, ...]:
    """Read where roads cross the line.

    Raises:
        BadInput: the file cannot be read, or names no place of the layout.
    """
    given = tables_of(path)
    if len(given) > MOST_ROADS:
        raise BadInput(str(path), "file", f"has {len(given)} crossings", f"give at most {MOST_ROADS}")
    return tuple(_road(str(path), rails, name, value) for name, value in given.items())


def _road(file: str, rails: Rails, name: str, given: Any) -> Road:
    """One table of the file."""
    write = 'write places = [{ track = "…", at_m = 120.5 }]'
    if not isinstance(given, dict) or set(given) != {"places"} or not isinstance(given["places"], list):
        raise BadInput(file, f"'{name}'", "is not a table with a list 'places' alone", write)
    if not 1 <= len(given["places"]) <= MOST_PLACES:
        raise BadInput(file, f"'{name}.places'", "has no place, or too many", f"give 1 to {MOST_PLACES}")
    return Road(name, tuple(_place(file, rails, name, each, write) for each in given["places"]))


def _place(file: str, rails: Rails, name: str, given: Any, write: str) -> tuple[int, int]:
    """The segment of a place, and how far it is along it."""
    where = f"'{name}.places'"
    if not isinstance(given, dict) or set(given) != {"track", "at_m"}:
        raise BadInput(file, where, "an entry has other keys than 'track' and 'at_m'", write)
    track = given["track"]
    tracks = rails.segments.station.tracks
    if not isinstance(track, str) or track not in tracks:
        raise BadInput(file, where, f"{track!r} is no track of the layout", f"name one, as '{min(tracks)}'")
    at_m = number_of(file, f"'{name}.places.at_m'", given["at_m"])
    for index, segment in enumerate(rails.segments.segments):
        if segment.track == track and segment.from_mm < at_m * 1_000 < segment.to_mm:
            return index, round(at_m * 1_000) - segment.from_mm
    instead = f"give another place from 0 to {tracks[track] / 1_000:g} m"
    raise BadInput(file, where, f"at {at_m:g} m '{track}' ends, or is cut", instead)


class Ways:
    """How far it is to a road: shortest ways ahead from the end of every segment, over whichever points."""

    def __init__(self, rails: Rails, road: Road) -> None:
        self.rails = rails
        self.road = road
        self.at_mm: dict[Heading, list[int]] = {}
        for index, low_mm in road.places:
            self.at_mm.setdefault((index, HIGH), []).append(low_mm)
            self.at_mm.setdefault((index, LOW), []).append(rails.length_mm((index, LOW)) - low_mm)
        self.beyond_mm = self._measured()

    def _measured(self) -> Mapping[Heading, int]:
        """From the end of each segment that leads to the road, the shortest way on."""
        headings = [(index, side) for index in range(len(self.rails.segments.segments)) for side in (LOW, HIGH)]
        before: dict[Heading, list[Heading]] = {}
        for heading in headings:
            for onward in onwards(self.rails, heading):
                before.setdefault(onward, []).append(heading)
        found: dict[Heading, int] = {}
        todo = [(min(places), heading) for heading, places in sorted(self.at_mm.items())]
        todo.sort()
        while todo:
            way_mm, heading = heappop(todo)
            for each in before.get(heading, ()):
                if each not in found:
                    found[each] = way_mm
                    heappush(todo, (way_mm + self.rails.length_mm(each), each))
        return found

    def ahead_mm(self, train: OnRails, front_mm: float) -> float:
        """The shortest way of a train's front to the road, as it heads; infinite where none leads there."""
        piece = next((each for each in train.path if each.to_mm > front_mm), train.path[-1])
        run_mm = front_mm - piece.from_mm
        ways = [at - run_mm for at in self.at_mm.get(piece.heading, ()) if at > run_mm]
        if piece.heading in self.beyond_mm:
            ways.append(piece.to_mm - front_mm + self.beyond_mm[piece.heading])
        return min(ways, default=math.inf)

    def under(self, train: OnRails, front_mm: float) -> float | None:
        """Where along its path a train is over the road, if it is."""
        rear_mm = front_mm - (train.front_mm - train.rear_mm)
        for piece in train.path:
            for at in self.at_mm.get(piece.heading, ()):
                if rear_mm <= piece.from_mm + at <= front_mm:
                    return piece.from_mm + at
        return None
