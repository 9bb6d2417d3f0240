"""Track as a graph: sections of track, the junctions that join their ends, and marks upon them.

A *mark* is a detector (which cuts track into blocks) or a buffer stop (which ends it).  Marks cut
every track into *segments*; a :data:`Heading` is a segment and the end of it one is running to.
Lengths and positions are whole millimetres from a track's beginning.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from functools import cached_property
from itertools import pairwise

LOW, HIGH = 0, 1
"""The two ends of a segment: towards the track's beginning, towards its end."""

Heading = tuple[int, int]
"""A segment's index and the end of it (``LOW`` or ``HIGH``) that a movement runs to."""


@dataclass(frozen=True)
class Kind:
    """A kind of junction: its ports, and which of them each position joins.

    A junction with one position does not move; with more it is a point.
    """

    ports: tuple[str, ...]
    positions: Mapping[str, tuple[tuple[str, str], ...]]

    def ways(self, port: str) -> dict[str, tuple[str, ...]]:
        """For each port that can be reached from this one, the positions that join the two."""
        found: dict[str, tuple[str, ...]] = {}
        for position in sorted(self.positions):
            for first, second in self.positions[position]:
                if port in (first, second):
                    other = second if port == first else first
                    found[other] = (*found.get(other, ()), position)
        return found

    def joined(self, port: str, other: str) -> bool:
        """Whether some position joins these two."""
        return other in self.ways(port)


@dataclass(frozen=True)
class Junction:
    """A junction as laid: each port meets one end (``LOW`` or ``HIGH``) of a track."""

    name: str
    kind: Kind
    ports: Mapping[str, tuple[str, int]]

    @property
    def is_point(self) -> bool:
        """Whether it can lie in more than one position."""
        return len(self.kind.positions) > 1


@dataclass(frozen=True)
class Mark:
    """A detector (``cuts``) or a buffer stop on a track, ``at_mm`` from its beginning."""

    name: str
    track: str
    at_mm: int
    cuts: bool


@dataclass(frozen=True)
class Station:
    """The track of a layout: lengths in mm, junctions, marks."""

    tracks: Mapping[str, int]
    junctions: Mapping[str, Junction]
    marks: Mapping[str, Mark]

    @cached_property
    def joined(self) -> Mapping[tuple[str, int], Joint]:
        """For each end of track that a junction joins, that and its port there."""
        return {end: Joint(name, port) for name, j in self.junctions.items() for port, end in j.ports.items()}


@dataclass(frozen=True)
class Segment:
    """A stretch of one track between neighbouring marks or track ends, in mm."""

    track: str
    from_mm: int
    to_mm: int

    @property
    def long_mm(self) -> int:
        """How long it is."""
        return self.to_mm - self.from_mm


@dataclass(frozen=True)
class Cut:
    """A segment ends at a detector; ``beyond`` is the heading of a movement that passes it."""

    mark: str
    beyond: Heading


@dataclass(frozen=True)
class Joint:
    """A segment ends at a port of a junction."""

    junction: str
    port: str


@dataclass(frozen=True)
class Stop:
    """A segment ends for good: at a buffer stop or, ``mark`` being none, where the track ends."""

    mark: str | None


End = Cut | Joint | Stop


WayOn = tuple[str, tuple[str, ...], Heading]
"""A way on over a junction: the port reached, the positions that lead there, the heading behind."""


@dataclass(frozen=True)
class Segments:
    """A station cut at its marks.

    ``at``: the end that each heading runs to.  ``leaving``: the heading of a movement that leaves
    a track's end inwards.  ``beside``: for a mark, the headings away from it, by side.
    ``ways_on``: what was asked of :meth:`onward` before; a search asks it of the same joints many times.
    """

    station: Station
    segments: Sequence[Segment]
    at: Mapping[Heading, End]
    leaving: Mapping[tuple[str, int], Heading]
    beside: Mapping[str, Mapping[int, Heading]]
    ways_on: dict[tuple[str, str], tuple[WayOn, ...]] = field(default_factory=dict, compare=False, repr=False)

    def onward(self, joint: Joint) -> tuple[WayOn, ...]:
        """Every way on from a joint."""
        known = self.ways_on.get((joint.junction, joint.port))
        if known is None:
            junction = self.station.junctions[joint.junction]
            known = self.ways_on[joint.junction, joint.port] = tuple(
                (port, positions, self.leaving[junction.ports[port]])
                for port, positions in junction.kind.ways(joint.port).items()
            )
        return known


def cut_into_segments(station: Station) -> Segments:
    """Cut every track at its marks; a mark at a free end of track ends it instead."""
    on_track: dict[str, list[Mark]] = {track: [] for track in station.tracks}
    for mark in station.marks.values():
        on_track[mark.track].append(mark)
    segments: list[Segment] = []
    at: dict[Heading, End] = {}
    leaving: dict[tuple[str, int], Heading] = {}
    beside: dict[str, Mapping[int, Heading]] = {}
    for track, length_mm in station.tracks.items():
        marks = sorted(on_track[track], key=lambda mark: mark.at_mm)
        low: End = station.joined.get((track, LOW), Stop(None))
        high: End = station.joined.get((track, HIGH), Stop(None))
        first = len(segments)
        if marks and marks[0].at_mm == 0 and isinstance(low, Stop):
            low = Stop(marks[0].name)
            beside[marks.pop(0).name] = {HIGH: (first, HIGH)}
        last_mark = None
        if marks and marks[-1].at_mm == length_mm and isinstance(high, Stop):
            last_mark = marks.pop()
            high = Stop(last_mark.name)
        edges = [0, *(mark.at_mm for mark in marks), length_mm]
        segments += [Segment(track, begin, end) for begin, end in pairwise(edges)]
        at[first, LOW] = low
        for index, mark in enumerate(marks, start=first):
            at[index, HIGH] = Cut(mark.name, (index + 1, HIGH)) if mark.cuts else Stop(mark.name)
            at[index + 1, LOW] = Cut(mark.name, (index, LOW)) if mark.cuts else Stop(mark.name)
            beside[mark.name] = {LOW: (index, LOW), HIGH: (index + 1, HIGH)}
        last = len(segments) - 1
        at[last, HIGH] = high
        if last_mark is not None:
            beside[last_mark.name] = {LOW: (last, LOW)}
        leaving[track, LOW] = (first, HIGH)
        leaving[track, HIGH] = (last, LOW)
    return Segments(station, segments, at, leaving, beside)
