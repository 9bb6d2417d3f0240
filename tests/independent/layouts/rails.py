"""What trains run over: stretches of rail, and where two of them are too near to each other."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field
from functools import cached_property

from tests.independent.raw_graph import Closed, Cut, End, Network, Over, Passing, Place, Ring, Stop

Stretch = tuple[str, int, int]
"""A track, from and to in mm."""
Zone = tuple[str, str]
"""A junction, and the leg of it near which one is."""


@dataclass(frozen=True)
class Line:
    """A route as its file draws it: entered at ``entry``, ``positions`` of its points, ends at ``last``.

    ``until``: the mark at which its overlap ends; ``last`` where it has none.
    """

    name: str
    entry: Place
    positions: Mapping[str, str]
    last: str
    until: str


@dataclass
class Survey:
    """Rails and routes of one file.

    ``marks``: where each boundary of the file lies, by every name that it has there.  ``clear_mm``: how far beyond
    a point or crossing its legs foul each other.  ``faults``: what the file contradicts itself in.
    """

    network: Network
    lines: dict[str, Line]
    marks: dict[str, tuple[str, int]]
    clear_mm: int
    faults: list[str] = field(default_factory=list)
    declared: set[frozenset[str]] = field(default_factory=set)

    @cached_property
    def apart(self) -> dict[Zone, frozenset[Zone]]:
        """For each leg of a point or crossing those that no position joins it with."""
        found: dict[Zone, frozenset[Zone]] = {}
        for name, junction in self.network.junctions.items():
            for leg in junction.legs if len(junction.legs) > 2 else ():
                joined = {leg, *junction.ways_from(leg).values()}
                found[name, leg] = frozenset((name, other) for other in junction.legs if other not in joined)
        return found

    @cached_property
    def near(self) -> dict[str, list[tuple[int, int, Zone]]]:
        """For each track the stretches of it that are foul of another leg."""
        found: dict[str, list[tuple[int, int, Zone]]] = {track: [] for track in self.network.lengths}
        for zone in self.apart:
            for track, low, high in self._leg(self.network.junctions[zone[0]].legs[zone[1]]):
                found[track].append((low, high, zone))
        return found

    def _leg(self, end: End) -> Iterable[Stretch]:
        """A leg as far as it is foul, over plain joints."""
        left_mm = self.clear_mm
        while left_mm > 0:
            track, which = end
            length = self.network.lengths[track]
            run = min(left_mm, length)
            yield (track, length - run, length) if which else (track, 0, run)
            left_mm -= run
            joint = self.network.leg_at.get((track, 1 - which))
            junction = self.network.junctions[joint[0]] if joint else None
            if junction is None or joint is None or len(junction.legs) != 2:
                return
            (end,) = [other for leg, other in junction.legs.items() if leg != joint[1]]

    def swept(self, stretches: Iterable[Stretch]) -> Swept:
        """Rails that a train may stand on, with the legs that it is foul of."""
        rails: dict[str, list[tuple[int, int]]] = {}
        for track, low, high in stretches:
            if low < high:
                rails.setdefault(track, []).append((low, high))
        zones = {
            zone
            for track, parts in rails.items()
            for low, high in parts
            for from_mm, to_mm, zone in self.near[track]
            if from_mm < high and low < to_mm
        }
        return Swept(rails, frozenset(zones))

    def gauge(self, one: Swept, other: Swept) -> str | None:
        """What brings two trains within the loading gauge; nothing if they are clear of each other."""
        for track in one.rails.keys() & other.rails.keys():
            if any(low < to and since < high for low, high in one.rails[track] for since, to in other.rails[track]):
                return f"rails {track}"
        fouled = {zone[0] for zone in one.zones if self.apart[zone] & other.zones}
        return f"foul of {min(fouled)}" if fouled else None


@dataclass(frozen=True)
class Swept:
    """Rails that a train may stand on somewhere, and the legs of points and crossings that it may be near."""

    rails: Mapping[str, list[tuple[int, int]]]
    zones: frozenset[Zone]


@dataclass
class Way:
    """Where a train gets to from a place, by how points lie.

    ``stretches``: rails in running order.  ``marks``: each boundary passed, and how many of the stretches lie before
    it.  ``passed``: each point, with the same.  ``wrong``: why it goes no further, if it does not come to its end.
    """

    stretches: list[Stretch] = field(default_factory=list)
    marks: list[tuple[tuple[str, int], int]] = field(default_factory=list)
    names: list[str] = field(default_factory=list)
    places: list[Place] = field(default_factory=list)
    passed: list[tuple[Passing, int]] = field(default_factory=list)
    wrong: str | None = None
    at: Place | None = None

    def behind(self, mark: int) -> list[Stretch]:
        """The rails beyond a boundary that it passes."""
        return self.stretches[self.marks[mark][1] :]


def run(network: Network, place: Place, lies: Mapping[str, str], until: str) -> Way:
    """Run on from a place to a mark; a point that lies nowhere known, or against the train, stops it."""
    found, here = Way(), place

    def position(point: str, leg: str) -> str | None:
        return lies.get(point)

    for event in network.follow(place, position):
        if isinstance(event, Ring):
            found.wrong = "it runs in a circle"
            return found
        to_mm = event.place.mm
        if isinstance(event, Over):
            track, end = network.junctions[event.passing.junction].legs[event.passing.leg]
            to_mm = network.lengths[track] if end else 0
        found.stretches.append((here.track, min(here.mm, to_mm), max(here.mm, to_mm)))
        here = event.place
        found.at = here
        if isinstance(event, Over):
            if network.junctions[event.passing.junction].moves:
                found.passed.append((event.passing, len(found.stretches)))
        elif isinstance(event, Closed):
            faces = network.junctions[event.junction].faces(event.leg)
            how = "lies against it" if event.position else "is not held"
            found.wrong = f"point {event.junction}, met {'facing' if faces else 'trailing'}, {how}"
            return found
        elif isinstance(event, Cut | Stop):
            found.marks.append(((here.track, here.mm), len(found.stretches)))
            found.names.append(event.name)
            found.places.append(here)
            if event.name == until:
                return found
            if isinstance(event, Stop):
                found.wrong = f"it comes to the end of track at {event.name or here.track}"
                return found
    raise AssertionError("a run ends with a reason")


@dataclass(frozen=True)
class Back:
    """A way back from a boundary: the rails, the points passed over it, and where the next boundary or end is."""

    stretches: tuple[Stretch, ...]
    positions: tuple[tuple[str, str], ...]
    at: Place
    name: str


def ways_back(network: Network, entry: Place) -> list[Back]:
    """Every way from a boundary back to the next ones, over every position of the points between.

    The places found look the way that a train runs to the boundary.
    """
    found: list[Back] = []
    todo: list[tuple[Place, tuple[Stretch, ...], dict[str, str]]] = [(entry._replace(heading=-entry.heading), (), {})]
    while todo:
        place, stretches, lies = todo.pop()
        piece = network.piece_ahead(place)
        low, high = network.sides(piece)
        far = place._replace(mm=high if place.heading > 0 else low)
        stretches = (*stretches, (place.track, low, high))
        cut = dict(network.cuts.get(far.track, [])).get(far.mm)
        end = (far.track, 1 if far.heading > 0 else 0)
        if cut is not None or end not in network.leg_at:
            name = cut or network.stops.get(end, "")
            found.append(Back(stretches, tuple(lies.items()), far._replace(heading=-far.heading), name))
            continue
        point, leg = network.leg_at[end]
        for position in sorted(network.junctions[point].ways_from(leg)):
            if lies.get(point, position) != position or len(stretches) > len(network.lengths):
                continue
            over = network.cross(far, lambda _, __, at=position: at)  # type: ignore[misc]
            moves = network.junctions[point].moves
            if isinstance(over, Over):
                todo.append((over.place, stretches, {**lies, point: position} if moves else lies))
    return found
