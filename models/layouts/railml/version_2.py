"""Track as railML 2 tells it: tracks with their connections, and switches and crossings that stand upon them.

A switch stands on a track that runs on behind it, and names where its branch connects; a crossing names where
the other track connects on either side.  Each is cut out of its track, which becomes pieces from one to the next.
Positions are metres along a track.
"""

from __future__ import annotations

from bisect import bisect_left
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from itertools import pairwise

from models.layouts.findings import Findings
from models.layouts.railml.document import Document, Element, kind_of
from models.layouts.railml.marks import Marks
from models.layouts.railml.topology import LONGEST_M, MM_A_METRE, End, Topology
from models.layouts.track import HIGH, LOW, Junction, Kind, Mark

DIRECTIONS = {"up": HIGH, "down": LOW}
OTHER_COURSE = {"left": "right", "right": "left", "straight": "turning"}
MAIN = (None, "main", "combined")
"""Types of signal that routes begin and end at; the others speak of these or to shunting."""
DETECTORS = ("trainDetector", "trackCircuitBorder")
CROSSING = {"a1": LOW, "b1": HIGH}
KINDS: Mapping[str, tuple[tuple[tuple[str, str], ...], ...]] = {
    "simpleCrossing": ((("a1", "b1"), ("a2", "b2")),),
    "doubleSwitchCrossing": tuple(((a, b),) for a in ("a1", "a2") for b in ("b1", "b2")),
}
"""For each type of crossing the ways it opens, position by position."""


@dataclass
class Track:
    """A track: where it begins and ends in mm, and the places in between at which a switch or crossing cuts it."""

    name: str
    element: Element
    begin_mm: int
    end_mm: int
    cuts_mm: list[int] = field(default_factory=list)

    def pieces(self) -> list[tuple[str, int]]:
        """Its pieces with their lengths in mm."""
        edges = [self.begin_mm, *self.cuts_mm, self.end_mm]
        return [(self.piece(number), high - low) for number, (low, high) in enumerate(pairwise(edges))]

    def piece(self, number: int) -> str:
        """The name of a piece, which is the track's own where there is but one."""
        return f"{self.name}:{number + 1}" if self.cuts_mm else self.name

    def beside(self, at_mm: int) -> tuple[End, End]:
        """The ends of the pieces before and behind a place where the track is cut."""
        number = self.cuts_mm.index(at_mm)
        return (self.piece(number), HIGH), (self.piece(number + 1), LOW)

    def ends(self) -> tuple[End, End]:
        """Its own ends."""
        return (self.piece(0), LOW), (self.piece(len(self.cuts_mm)), HIGH)

    def place(self, name: str, at_mm: int, cuts: bool) -> Mark:
        """A mark on the piece that it lies on; where two meet, on the one before."""
        number = bisect_left(self.cuts_mm, at_mm)
        begin_mm = [self.begin_mm, *self.cuts_mm][number]
        return Mark(name, self.piece(number), at_mm - begin_mm, cuts)


def read_tracks(source: Document, findings: Findings) -> tuple[Topology, Marks]:
    """Track, junctions and marks.

    Raises:
        BadInput: a connection does not come back, or a switch or crossing is nothing that rails can be.
    """
    tracks = [
        _track(source, element) for element in source.all("track") if source.first("trackTopology", element) is not None
    ]
    if not tracks:
        raise source.bad(None, "has no track with a trackTopology", "give the infrastructure's tracks")
    lengths_mm = {name: length_mm for track in tracks for name, length_mm in track.pieces()}
    connections = Connections(source, tracks)
    junctions = {junction.name: junction for junction in connections.junctions()}
    return Topology(lengths_mm, junctions), _marks(source, tracks, findings)


def _track(source: Document, element: Element) -> Track:
    """A track with the places at which it is cut."""
    ends = [source.first(kind, element) for kind in ("trackBegin", "trackEnd")]
    if ends[0] is None or ends[1] is None:
        raise source.bad(element, "has no trackBegin or no trackEnd", "add it")
    begin_mm, end_mm = (_position_mm(source, end) for end in ends if end is not None)
    if begin_mm >= end_mm:
        raise source.bad(element, f"ends at {end_mm} mm and begins at {begin_mm} mm", "correct its positions")
    track = Track(source.attribute(element, "id"), element, begin_mm, end_mm)
    for crossed in _cutting(source, element):
        at_mm = _position_mm(source, crossed)
        if not begin_mm < at_mm < end_mm:
            raise source.bad(crossed, f"lies at {at_mm} mm, not within its track", "give a place between its ends")
        if at_mm in track.cuts_mm:
            raise source.bad(crossed, f"lies at {at_mm} mm, where another one does", "move one of the two")
        track.cuts_mm.append(at_mm)
    track.cuts_mm.sort()
    return track


def _cutting(source: Document, track: Element) -> Iterator[Element]:
    for connections in source.all("connections", track):
        for each in connections.iterchildren("{*}*"):
            if source.is_own(each) and kind_of(each) in ("switch", "crossing"):
                yield each


def _position_mm(source: Document, element: Element) -> int:
    return round(source.number(element, "pos", -LONGEST_M, LONGEST_M) * MM_A_METRE)


@dataclass(frozen=True)
class Leg:
    """Where a connection is: at the end of a track, or at a switch or crossing on the named side of it."""

    owner: Element
    end: End | None
    side: str = ""


class Connections:
    """Every connection of a document by its id, and what each makes with the one it refers to."""

    def __init__(self, source: Document, tracks: Sequence[Track]) -> None:
        self.source = source
        self.legs: dict[str, Leg] = {}
        self.refers: dict[str, str] = {}
        self.cut: list[tuple[Track, Element]] = []
        for track in tracks:
            for kind, end in zip(("trackBegin", "trackEnd"), track.ends(), strict=True):
                owner = source.first(kind, track.element)
                assert owner is not None
                for number, connection in enumerate(source.all("connection", owner)):
                    if number:
                        what = f"is a second connection of this end of track '{track.name}', where no switch stands"
                        raise source.bad(connection, what, "let a switch stand where tracks come together")
                    self._add(connection, Leg(owner, end))
            for crossed in _cutting(source, track.element):
                self.cut.append((track, crossed))
                for connection in source.all("connection", crossed):
                    self._add(connection, Leg(crossed, None, connection.get("orientation", "")))

    def _add(self, connection: Element, leg: Leg) -> None:
        name = self.source.attribute(connection, "id")
        self.legs[name], self.refers[name] = leg, self.source.attribute(connection, "ref")

    def _partner(self, connection: Element) -> tuple[str, Leg]:
        """The connection that one refers to, which refers back to it."""
        name = self.source.attribute(connection, "id")
        other = self.refers[name]
        if other not in self.legs:
            raise self.source.bad(connection, f"refers to '{other[:40]}', which is no connection", "correct it")
        if self.refers[other] != name:
            what = f"refers to '{other}', which refers to '{self.refers[other][:40]}'"
            raise self.source.bad(connection, what, "let the two refer to each other")
        return other, self.legs[other]

    def _met(self, connection: Element) -> End:
        """The end of track that a switch or crossing connects to."""
        other, leg = self._partner(connection)
        if leg.end is None:
            what = f"connects to '{other}' with no track between the two"
            raise self.source.bad(connection, what, "put a track between them")
        return leg.end

    def junctions(self) -> Iterator[Junction]:
        """Every joint of two tracks, every point and every crossing."""
        for name, leg in self.legs.items():
            if leg.end is not None:
                other, met = self._partner(self.source.by_id[name])
                if met.end is not None and name < other:
                    joint = Kind(("a", "b"), {"static": (("a", "b"),)})
                    yield Junction(f"{name} - {other}", joint, {"a": leg.end, "b": met.end})
                elif met.end is not None and name == other:
                    raise self.source.bad(self.source.by_id[name], "refers to itself", "correct it")
        done: set[str] = set()
        for track, crossed in self.cut:
            if self.source.attribute(crossed, "id") not in done:
                yield (
                    self._switch(track, crossed)
                    if kind_of(crossed) == "switch"
                    else self._crossing(track, crossed, done)
                )

    def _switch(self, track: Track, switch: Element) -> Junction:
        """A point: its tip is where the branch and the track come together."""
        connections = list(self.source.all("connection", switch))
        if len(connections) != 1:
            what = f"has {len(connections)} connections"
            raise self.source.bad(switch, what, "give the one of its branch; three-way points as two switches")
        before, behind = track.beside(_position_mm(self.source, switch))
        orientation = connections[0].get("orientation", "")
        if orientation not in ("outgoing", "incoming"):
            raise self.source.bad(connections[0], f"orientation is '{orientation[:40]}'", "give outgoing or incoming")
        tip, on = (before, behind) if orientation == "outgoing" else (behind, before)
        course = connections[0].get("course", "")
        if course in OTHER_COURSE and switch.get("trackContinueCourse") == course:
            what = f"its track goes on to the {course}, and so does its branch"
            raise self.source.bad(switch, what, "correct trackContinueCourse, or the course of its connection")
        branch, through = (course, OTHER_COURSE[course]) if course in OTHER_COURSE else ("branch", "through")
        kind = Kind(("tip", branch, through), {each: (("tip", each),) for each in (branch, through)})
        ports = {"tip": tip, branch: self._met(connections[0]), through: on}
        return Junction(self.source.attribute(switch, "id"), kind, ports)

    def _crossing(self, track: Track, crossing: Element, done: set[str]) -> Junction:
        """A crossing, told on one of its tracks or on both."""
        name = self.source.attribute(crossing, "id")
        ways = KINDS.get(crossing.get("type", "simpleCrossing"))
        if ways is None:
            what = f"is a {crossing.get('type', '')[:40]}: which of its legs it joins is not told"
            raise self.source.bad(crossing, what, "tell it as two switches and a simpleCrossing")
        before, behind = track.beside(_position_mm(self.source, crossing))
        connections = {each.get("orientation", ""): each for each in self.source.all("connection", crossing)}
        if set(connections) != {"incoming", "outgoing"}:
            raise self.source.bad(crossing, "has not one incoming and one outgoing connection", "give both")
        other = self._other_half(crossing, connections, done)
        across = other or tuple(self._met(connections[each]) for each in ("incoming", "outgoing"))
        kind = Kind(("a1", "b1", "a2", "b2"), {"-".join(sum(way, ())): way for way in ways})
        return Junction(name, kind, dict(zip(("a1", "b1", "a2", "b2"), (before, behind, *across), strict=True)))

    def _other_half(
        self, crossing: Element, connections: Mapping[str, Element], done: set[str]
    ) -> tuple[End, ...] | None:
        """The ends of the other track, where that tells the same crossing and both refer to each other.

        Raises:
            BadInput: it is a double slip, whose ways depend on which way round the other track runs.
        """
        first, second = (self._partner(connections[each])[1].owner for each in ("incoming", "outgoing"))
        if first is not second or kind_of(first) != "crossing" or first is crossing:
            return None
        if len(KINDS[crossing.get("type", "simpleCrossing")]) > 1:
            what = f"is told on its other track as '{self.source.attribute(first, 'id')}': which legs meet is not told"
            raise self.source.bad(crossing, what, "tell it on one track, the other in two that end there")
        track = next(track for track, crossed in self.cut if crossed is first)
        done.add(self.source.attribute(first, "id"))
        return track.beside(_position_mm(self.source, first))


# ---- marks


def _marks(source: Document, tracks: Sequence[Track], findings: Findings) -> Marks:
    """Detectors, main signals and ends of track."""
    found = Marks()
    for track in tracks:
        for kind in DETECTORS:
            for element in source.all(kind, track.element):
                _put(source, found, track, element)
                found.detectors.add(found.of[source.attribute(element, "id")])
    _signals(source, tracks, found, findings)
    for track in tracks:
        for kind, at_mm in (("trackBegin", track.begin_mm), ("trackEnd", track.end_mm)):
            end = source.first(kind, track.element)
            for stop in end.iterchildren("{*}*") if end is not None else ():
                if source.is_own(stop) and kind_of(stop) != "connection" and stop.get("id") is not None:
                    found.put(source, stop, track.place(source.attribute(stop, "id"), at_mm, cuts=False))
    return found


def _signals(source: Document, tracks: Sequence[Track], found: Marks, findings: Findings) -> None:
    """Main signals, each with the trains that it speaks to."""
    silent, other = [], []
    for track in tracks:
        for signal in source.all("signal", track.element):
            name = source.attribute(signal, "id")
            if signal.get("type") not in MAIN:
                other.append(name)
            elif signal.get("dir") not in DIRECTIONS:
                silent.append(name)
            else:
                _put(source, found, track, signal)
                found.signals.add(name)
                found.side[name] = DIRECTIONS[signal.get("dir", "")]
    if silent:
        findings.remark(
            silent, f"{len(silent)} signals say of no direction that they speak to: they are left out", "unread"
        )
    if other:
        findings.remark(other, f"{len(other)} signals are no main signals: no route begins or ends there")


def _put(source: Document, found: Marks, track: Track, element: Element) -> None:
    at_mm = _position_mm(source, element)
    if not track.begin_mm <= at_mm <= track.end_mm:
        raise source.bad(element, f"lies at {at_mm} mm, not on its track", "correct its position")
    found.put(source, element, track.place(source.attribute(element, "id"), at_mm, cuts=True))
