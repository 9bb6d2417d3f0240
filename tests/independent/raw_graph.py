"""Track as a plain graph, and walks over it: nothing here is of the project's own code.

A track has a length in mm and runs from its end 0 to its end 1.  Boundaries (``cuts``) lie on it,
junctions join ends of tracks, and an end that no junction joins is where track stops.  A block is what
boundaries do not cut apart.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping
from dataclasses import dataclass, field
from functools import cached_property, reduce
from itertools import pairwise
from typing import NamedTuple

End = tuple[str, int]
"""A track and which end of it: 0 or 1."""
Piece = tuple[str, int]
"""A track and the how-manyth stretch between boundaries of it."""


class Place(NamedTuple):
    """A place on a track, in mm, and which way one looks there: +1 towards end 1, -1 towards end 0."""

    track: str
    mm: int
    heading: int


class Passing(NamedTuple):
    """A junction as it is passed: by which leg in, in which position, and whether it could lead elsewhere."""

    junction: str
    leg: str
    position: str
    facing: bool


class Over(NamedTuple):
    """A walk passes a junction; ``place`` is where it goes on."""

    passing: Passing
    place: Place


class Cut(NamedTuple):
    """A walk comes to a boundary."""

    name: str
    place: Place


class Stop(NamedTuple):
    """A walk comes to where track ends; without a name where the file gives none."""

    name: str
    place: Place


class Closed(NamedTuple):
    """A walk comes to a junction that no position, or a wrong one, is given for."""

    junction: str
    leg: str
    position: str | None
    place: Place


class Ring(NamedTuple):
    """A walk comes back to where it was."""

    place: Place


Joins = Mapping[str, tuple[tuple[str, str], ...]]
"""Position -> the pairs of legs that it joins."""
Event = Over | Cut | Stop | Closed | Ring
Points = Callable[[str, str], str | None]
"""Junction and leg it is met at -> its position."""


@dataclass(frozen=True)
class Junction:
    """Legs, the track ends that they are, and the pairs of legs that each position joins."""

    name: str
    legs: Mapping[str, End]
    joins: Joins
    moves: bool

    def ways_from(self, leg: str) -> dict[str, str]:
        """Position -> the leg that is reached from this one; positions that close it are left out."""
        found: dict[str, str] = {}
        for position, pairs in self.joins.items():
            for one, other in pairs:
                if leg in (one, other):
                    found[position] = other if leg == one else one
        return found

    def faces(self, leg: str) -> bool:
        """Whether a vehicle that comes by this leg can be led to more than one other."""
        return len(set(self.ways_from(leg).values())) > 1


class Way(NamedTuple):
    """A way through a block: in at one mouth, out at another (``into`` is the block beyond, if there is one)."""

    mouth: Place
    out: str
    into: str | None
    passed: tuple[Passing, ...]

    @property
    def demands(self) -> dict[str, str]:
        """The positions of what is met facing."""
        return {passing.junction: passing.position for passing in self.passed if passing.facing}


@dataclass
class Network:
    """Tracks, boundaries, junctions, and names of track ends."""

    lengths: dict[str, int]
    cuts: dict[str, list[tuple[int, str]]] = field(default_factory=dict)
    junctions: dict[str, Junction] = field(default_factory=dict)
    stops: dict[End, str] = field(default_factory=dict)
    given: dict[tuple[str, int], str] = field(default_factory=dict)
    """Track and mm -> the name that the file gives the block there."""

    def __post_init__(self) -> None:
        for on_track in self.cuts.values():
            on_track.sort()
        for track, on_track in self.cuts.items():
            if any(not 0 < mm < self.lengths[track] for mm, _ in on_track):
                raise NotImplementedError(f"a boundary at an end of {track}")

    @cached_property
    def leg_at(self) -> dict[End, tuple[str, str]]:
        """Track end -> junction and leg."""
        return {end: (name, leg) for name, junction in self.junctions.items() for leg, end in junction.legs.items()}

    def cut(self, name: str) -> tuple[str, int]:
        """Where a boundary lies."""
        (found,) = [(track, mm) for track, on_track in self.cuts.items() for mm, other in on_track if other == name]
        return found

    def name_at(self, place: Place) -> str:
        """Which boundary lies there."""
        return next(name for mm, name in self.cuts[place.track] if mm == place.mm)

    def end(self, name: str) -> End:
        """Which track end has this name."""
        (found,) = [end for end, other in self.stops.items() if other == name]
        return found

    def piece_ahead(self, place: Place) -> Piece:
        """The stretch that one comes to from here."""
        on_track = self.cuts.get(place.track, [])
        if place.heading > 0:
            return place.track, sum(mm <= place.mm for mm, _ in on_track)
        return place.track, sum(mm < place.mm for mm, _ in on_track)

    def piece_behind(self, place: Place) -> Piece:
        """The stretch that one comes from."""
        return self.piece_ahead(Place(place.track, place.mm, -place.heading))

    def sides(self, piece: Piece) -> tuple[int, int]:
        """From where to where a stretch lies, in mm."""
        track, index = piece
        marks = [0, *(mm for mm, _ in self.cuts.get(track, [])), self.lengths[track]]
        return marks[index], marks[index + 1]

    @cached_property
    def blocks(self) -> dict[str, frozenset[Piece]]:
        """Name -> its stretches."""
        pieces = [(track, index) for track in self.lengths for index in range(len(self.cuts.get(track, [])) + 1)]
        left, named = set(pieces), dict[str, frozenset[Piece]]()
        for first in pieces:
            if first not in left:
                continue
            found, edge = {first}, [first]
            while edge:
                for piece in self._joined(edge.pop()) - found:
                    found.add(piece)
                    edge.append(piece)
            left -= found
            name = plain = self._name(found)
            copies = 1
            while name in named:
                copies += 1
                name = f"{plain}#{copies}"
            named[name] = frozenset(found)
        return named

    def _joined(self, piece: Piece) -> set[Piece]:
        track, index = piece
        ends = [0] if index == 0 else []
        if index == len(self.cuts.get(track, [])):
            ends.append(1)
        found: set[Piece] = set()
        for end in ends:
            if (track, end) in self.leg_at:
                junction = self.junctions[self.leg_at[track, end][0]]
                found |= {self.last_piece(other) for other in junction.legs.values()}
        return found

    def last_piece(self, end: End) -> Piece:
        """The stretch at a track end."""
        track, which = end
        return track, len(self.cuts.get(track, [])) if which else 0

    def _name(self, pieces: set[Piece]) -> str:
        for (track, mm), name in self.given.items():
            if any(piece[0] == track and self.sides(piece)[0] < mm < self.sides(piece)[1] for piece in pieces):
                return name
        return "B:" + "+".join(self._ends(pieces))

    def _ends(self, pieces: Iterable[Piece]) -> list[str]:
        names: set[str] = set()
        for track, index in pieces:
            low, high = self.sides((track, index))
            names |= {name for mm, name in self.cuts.get(track, []) if mm in (low, high)}
            names |= {
                self.stops[track, end]
                for end, touches in ((0, low == 0), (1, high == self.lengths[track]))
                if touches and (track, end) in self.stops
            }
        return sorted(names)

    def ends(self, block: str) -> list[str]:
        """The boundaries and named ends of track that a block lies between."""
        return self._ends(self.blocks[block])

    @cached_property
    def block_of(self) -> dict[Piece, str]:
        """Stretch -> block."""
        return {piece: name for name, pieces in self.blocks.items() for piece in pieces}

    @cached_property
    def points_in(self) -> dict[str, tuple[str, ...]]:
        """Block -> what moves in it."""
        found: dict[str, list[str]] = {}
        for name, junction in self.junctions.items():
            if junction.moves:
                (end, *_) = junction.legs.values()
                found.setdefault(self.block_of[self.last_piece(end)], []).append(name)
        return {block: tuple(sorted(points)) for block, points in found.items()}

    def follow(self, place: Place, points: Points) -> Iterator[Event]:
        """What one meets going on from a place, until track ends, a junction is closed or the walk repeats itself."""
        seen: set[tuple[str, int]] = set()
        track, mm, heading = place
        while True:
            on_track = self.cuts.get(track, [])
            ahead = [cut for cut in on_track if (cut[0] - mm) * heading > 0]
            for at, name in ahead if heading > 0 else reversed(ahead):
                yield Cut(name, Place(track, at, heading))
            if (track, heading) in seen:
                yield Ring(Place(track, mm, heading))
                return
            seen.add((track, heading))
            end = (track, 1 if heading > 0 else 0)
            here = Place(track, self.lengths[track] if heading > 0 else 0, heading)
            if end not in self.leg_at:
                yield Stop(self.stops.get(end, ""), here)
                return
            event = self.cross(here, points)
            yield event
            if isinstance(event, Closed):
                return
            track, mm, heading = event.place

    def cross(self, place: Place, points: Points) -> Over | Closed:
        """Pass the junction at a track end."""
        name, leg = self.leg_at[place.track, 1 if place.heading > 0 else 0]
        junction = self.junctions[name]
        ways = junction.ways_from(leg)
        position = points(name, leg) if junction.moves else next(iter(ways))
        if position is None or position not in ways:
            return Closed(name, leg, position, place)
        track, end = junction.legs[ways[position]]
        beyond = Place(track, self.lengths[track] if end else 0, -1 if end else 1)
        return Over(Passing(name, leg, position, junction.moves and junction.faces(leg)), beyond)

    def mouths(self, block: str) -> list[tuple[str, Place]]:
        """Where a block is entered: boundaries, and ends of track, each looking into it."""
        found: list[tuple[str, Place]] = []
        for track, index in sorted(self.blocks[block]):
            names = dict(self.cuts.get(track, []))
            for mm, heading, end in zip(self.sides((track, index)), (1, -1), (0, 1), strict=True):
                if mm in names:
                    found.append((names[mm], Place(track, mm, heading)))
                elif (track, end) not in self.leg_at:
                    found.append((self.stops.get((track, end), ""), Place(track, mm, heading)))
        return found

    def ways(self, block: str) -> list[Way]:
        """Every way through a block, over every position of its points."""
        known = self.__dict__.setdefault("_ways", {})
        if block not in known:
            known[block] = [way for _, mouth in self.mouths(block) for way in self._ways_on(mouth, mouth, (), ())]
        found: list[Way] = known[block]
        return found

    def _ways_on(
        self, mouth: Place, place: Place, passed: tuple[Passing, ...], seen: tuple[tuple[Piece, int], ...]
    ) -> Iterator[Way]:
        here = (self.piece_ahead(place), place.heading)
        if here in seen:
            return
        low, high = self.sides(here[0])
        far = place._replace(mm=high if place.heading > 0 else low)
        cut = dict(self.cuts.get(place.track, [])).get(far.mm)
        if cut is not None:
            yield Way(mouth, cut, self.block_of[self.piece_ahead(far)], passed)
            return
        end = (far.track, 1 if far.heading > 0 else 0)
        if end not in self.leg_at:
            yield Way(mouth, self.stops.get(end, ""), None, passed)
            return
        name, leg = self.leg_at[end]
        for position in sorted(self.junctions[name].ways_from(leg)):
            if any(before.junction == name and before.position != position for before in passed):
                continue
            over = self.cross(far, lambda _, __, position=position: position)  # type: ignore[misc]
            assert isinstance(over, Over)
            yield from self._ways_on(mouth, over.place, (*passed, over.passing), (*seen, here))

    def demands(self, block: str, into: str) -> dict[str, str] | None:
        """What every way from one block to another wants of the points that it meets facing; None: there is no way."""
        every = [way.demands for way in self.ways(block) if way.into == into]
        if not every:
            return None
        return reduce(common, every)

    def way_mm(self, way: Way) -> int:
        """How long a way through a block is."""
        positions = {passing.junction: passing.position for passing in way.passed}
        here, mm = way.mouth, 0
        for event in self.follow(way.mouth, lambda point, _: positions.get(point)):
            if isinstance(event, Over):
                track, end = self.junctions[event.passing.junction].legs[event.passing.leg]
                mm += abs((self.lengths[track] if end else 0) - here.mm)
                here = event.place
            else:
                return mm + abs(event.place.mm - here.mm)
        raise AssertionError("a way ends")

    @cached_property
    def neighbours(self) -> dict[str, frozenset[str]]:
        """Block -> the blocks that it shares a boundary with."""
        found: dict[str, set[str]] = {block: set() for block in self.blocks}
        for track, on_track in self.cuts.items():
            for mm, _ in on_track:
                one, other = (self.block_of[self.piece_ahead(Place(track, mm, heading))] for heading in (1, -1))
                if one != other:
                    found[one].add(other)
                    found[other].add(one)
        return {block: frozenset(others) for block, others in found.items()}


class Finding(NamedTuple):
    """What is wrong, or worth a remark, and with which elements of the file."""

    rule: str
    elements: tuple[str, ...]


@dataclass
class Route:
    """What a walk along a route finds."""

    name: str
    entry: Place
    start: str = ""
    covers: list[str] = field(default_factory=list)
    overlap: list[str] = field(default_factory=list)
    needs: dict[str, str] = field(default_factory=dict)
    released_after: dict[str, str] = field(default_factory=dict)
    spans: dict[str, tuple[int, int]] = field(default_factory=dict)
    """Covered block -> where it begins and ends on the way, in mm from where the route is entered."""
    inside: dict[str, int] = field(default_factory=dict)
    """Boundary strictly between entry and exit -> mm from where the route is entered."""
    exit: Place | None = None
    end: Place | None = None
    """Where its overlap ends; where it ends, if it has none."""
    from_end: bool = False
    """Whether it is entered where track ends."""
    length_mm: int = 0
    """From where it is entered to the end of its overlap; from the end of the first block if entered at an end."""
    comes_in: dict[str, Place] = field(default_factory=dict)
    """Block -> where the path comes into it."""
    stands: set[Place] = field(default_factory=set)
    """Where trains that may stand in its start block have come into that."""
    passed: dict[str, str] = field(default_factory=dict)
    """Points on the path, overlap included, as they must lie."""
    faced: set[str] = field(default_factory=set)
    """Those of them that are met facing."""

    @property
    def destination(self) -> str:
        return self.covers[-1]

    @property
    def claims(self) -> list[str]:
        return [self.start, *self.covers, *self.overlap]


def released(route: Route, at: list[str]) -> dict[str, str]:
    """Block -> the block that the tail has left when it is reported, with release at these boundaries."""
    found = {route.start: route.start, route.destination: route.destination}
    stops = sorted(route.inside[name] for name in at if name in route.inside)
    for block in route.covers[:-1]:
        after = [mm for mm in stops if mm >= route.spans[block][1]]
        until = after[0] if after else route.spans[route.destination][0]
        found[block] = next(other for other in route.covers if route.spans[other][1] == until)
    return found


def led_astray(network: Network, route: Route) -> list[Finding]:
    """Blocks that a train on the route may be led to although they are not the next: no held point turns it away."""
    found: list[Finding] = []
    claims = route.claims
    for block, following in pairwise(claims):
        for into, wanted in sorted(leads(network, route, block).items()):
            if into == following or any(route.needs.get(point, at) != at for point, at in wanted.items()):
                continue
            elements = {*network.ends(block), *network.ends(into), *(set(wanted) & set(route.needs))}
            found.append(Finding("track_leads_along_the_way_or_is_turned", (route.name, *sorted(elements))))
    return found


def leads(network: Network, route: Route, block: str) -> dict[str, dict[str, str]]:
    """The blocks that track leads to from a claimed block, running as the route does, however points lie.

    With each, what all ways there want of the points that they meet facing, from where the route comes in.
    """
    mouths = route.stands if block == route.start else {route.comes_in[block]}
    found: dict[str, dict[str, str]] = {}
    for way in network.ways(block):
        if way.mouth in mouths and way.into is not None:
            known = found.setdefault(way.into, way.demands)
            found[way.into] = common(known, way.demands)
    return found


def common(one: dict[str, str], other: dict[str, str]) -> dict[str, str]:
    """What both want alike."""
    return {point: position for point, position in one.items() if other.get(point) == position}


def bent_back(network: Network) -> list[Finding]:
    """Boundaries with the same block on either side: no two tags can lie there, one each side."""
    found: list[Finding] = []
    for track, on_track in network.cuts.items():
        for mm, name in on_track:
            one, other = (network.block_of[network.piece_ahead(Place(track, mm, heading))] for heading in (1, -1))
            if one == other:
                found.append(Finding("tags_of_a_boundary_are_partners", (name,)))
    return found
