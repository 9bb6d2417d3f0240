"""Track and junctions from railML's topology: net elements, and how their ends are related.

Ends of net elements that are related, navigable or not, meet in one place.  What can be run from which to
which makes it a joint, a point, a crossing or a slip; a ``switchIS`` or ``crossing`` that refers to one of
the relations gives its name.  Of a slip that is told with its parts (``belongsToParent``) the whole gives it.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from functools import cached_property
from itertools import pairwise
from math import hypot
from string import digits

import networkx

from models.layouts.findings import Findings
from models.layouts.numbers import LONGEST_DISTANCE_MM
from models.layouts.railml.document import Document, Element, kind_of
from models.layouts.track import HIGH, LOW, Junction, Kind

End = tuple[str, int]
"""A net element, and the end of it (``LOW`` or ``HIGH``)."""
MM_A_METRE = 1_000
SHORTEST_M, LONGEST_M = 0.001, LONGEST_DISTANCE_MM / MM_A_METRE
BY_POSITION = {0.0: LOW, 1.0: HIGH}
FARTHEST_M = 1e9
TOLERANCE = 0.01
"""By so much of it a length may differ from the drawing's, or from its track's, before that is worth a word."""
WHOLE = {"Begin": 0, "End": 1}
"""The two ends of a stretch of net element, by the shares of it that are all of it."""
ONE_LENGTH = "a net element has one length"


@dataclass(frozen=True)
class Topology:
    """Lengths of the net elements in mm, and where their ends meet; for each part of a slip, that."""

    lengths_mm: Mapping[str, int]
    junctions: Mapping[str, Junction]
    parts: Mapping[str, str] = field(default_factory=dict)

    @cached_property
    def joined_at(self) -> Mapping[tuple[str, int], str]:
        """For each end of track that is joined, by net element and mm, the junction there."""
        return {
            (end[0], self._at_mm(end)): name
            for name, junction in self.junctions.items()
            for end in junction.ports.values()
        }

    @cached_property
    def _meets(self) -> Mapping[tuple[str, int], tuple[End, End]]:
        """For each end of track at a plain joint, by net element and mm, the two ends that meet there."""
        found: dict[tuple[str, int], tuple[End, End]] = {}
        for junction in self.junctions.values():
            if len(junction.ports) == 2:
                one, other = sorted(junction.ports.values())
                found |= {(end[0], self._at_mm(end)): (one, other) for end in (one, other)}
        return found

    def is_free_end(self, track: str, at_mm: int) -> bool:
        """Whether a place is an end of track that is joined to no other."""
        return at_mm in (0, self.lengths_mm[track]) and (track, at_mm) not in self.joined_at

    def joint(self, track: str, at_mm: int) -> tuple[str, int]:
        """A place, told alike by each of the two ends of track that meet there."""
        ends = self._meets.get((track, at_mm))
        return (track, at_mm) if ends is None else (ends[0][0], self._at_mm(ends[0]))

    def side_from(self, track: str, at_mm: int, side: int, seen: str) -> int:
        """The side of a place that is told on one track, by the track of the mark that stands there.

        Where these are two, they meet there.
        """
        if seen == track:
            return side
        one, other = self._meets[track, at_mm]
        return 1 - side if one[1] == other[1] else side

    def _at_mm(self, end: End) -> int:
        return self.lengths_mm[end[0]] if end[1] == HIGH else 0


@dataclass(frozen=True)
class Over:
    """A track that runs over a net element, what says so, and whether it runs over no other."""

    track: Element
    part: Element
    alone: bool


@dataclass(frozen=True)
class Meeting:
    """A place in which ends meet: the relations there, and the pairs that can be run."""

    ends: tuple[End, ...]
    relations: tuple[str, ...]
    ways: tuple[tuple[End, End], ...]


@dataclass(frozen=True)
class Named:
    """What names a place: a switch or a crossing, and the relation of each branch by railML's word for it."""

    element: Element
    branches: Mapping[str, str] = field(default_factory=dict)


def read_topology(source: Document, findings: Findings) -> Topology:
    """Read it.

    Raises:
        BadInput: there is none, an end is related to none, or a place is nothing that rails can be.
    """
    micro = _micro(source, findings)
    tracks = _tracks_over(source)
    lengths_mm = {name: _length_mm(source, name, tracks.get(name, ()), findings) for name in micro}
    parts = _slip_parts(source)
    named = _named(source, parts)
    junctions: dict[str, Junction] = {}
    for meeting in _meetings(source, lengths_mm):
        junction = _junction(source, meeting, named, findings)
        if junction.name in junctions:
            what = "its relations are of two places, which no relation joins"
            raise source.bad(source.by_id[junction.name], what, "relate all ends of track that meet there")
        junctions[junction.name] = junction
    for relation, names in named.items():
        if names.element.get("id") not in junctions:
            raise source.bad(names.element, f"its relation '{relation}' joins no ends here", "correct the topology")
    return Topology(lengths_mm, junctions, parts)


def _micro(source: Document, findings: Findings) -> list[str]:
    """The net elements of the finest level, whichever networks have one; without any, all that collect no others.

    One that no level lists, and that collects no others, is track of which nothing is known: a verdict rests on it.
    """
    every = {source.attribute(each, "id"): each for each in source.all("netElement")}
    least = [name for name, each in every.items() if source.first("elementPart", each) is None]
    levels = list(source.all("level"))
    fine = [level for level in levels if level.get("descriptionLevel") == "Micro"]
    found = [name for level in fine for name in _listed(source, level) if name in every] if fine else least
    known = {*found, *(name for level in levels for name in _listed(source, level))}
    unlisted = [name for name in least if name not in known]
    if unlisted:
        text = f"{len(unlisted)} net elements are on no level: they are not read, list them on the level Micro"
        findings.remark(unlisted, text, "unread")
    if not found:
        raise source.bad(None, "has no netElement: there is no track", "give the topology at the level Micro")
    _refuse_track_twice(source, found)
    return list(dict.fromkeys(found))


def _refuse_track_twice(source: Document, micro: Iterable[str]) -> None:
    """Of the net elements of the finest level none collects another, and no two collect one and the same.

    Raises:
        BadInput: two do; trains on the one would be on the rails of the other.
    """
    whole: dict[str, str] = {}
    for name in micro:
        for part in sorted(_collected(source, name)):
            other = whole.setdefault(part, name)
            if other != name:
                what = f"has the track of '{part}', which '{other}' of the level Micro has as well"
                raise source.bad(source.by_id[name], what, "list there what collects others, or its parts")


def _collected(source: Document, name: str) -> set[str]:
    """A net element, what it collects, and what that collects."""
    found: set[str] = set()
    todo = [source.by_id[name]]
    while todo:
        element = todo.pop()
        part = source.attribute(element, "id")
        if part not in found:
            found.add(part)
            todo += [source.referred(each) for each in source.all("elementPart", element)]
    return found


def _listed(source: Document, level: Element) -> Iterator[str]:
    return (source.attribute(each, "ref") for each in source.all("networkResource", level))


# ---- lengths


def _length_mm(source: Document, name: str, tracks: Sequence[Over], findings: Findings) -> int:
    """A net element's length: its own, else the track's that is all of it, else that of its drawing."""
    element = source.by_id[name]
    drawn_m = _drawn_m(source, element)
    if element.get("length") is not None:
        told_m: float | None = source.number(element, "length", SHORTEST_M, LONGEST_M)
    else:
        told_m = _of_track_m(source, tracks)
    if told_m is not None:
        _compare_track(source, name, told_m, tracks, findings)
        if drawn_m is not None and abs(drawn_m - told_m) > TOLERANCE * told_m:
            text = f"net element '{name}' is {told_m:g} m long, and drawn {drawn_m:.1f} long"
            findings.remark([name], text, "derived")
        return round(told_m * MM_A_METRE)
    if drawn_m is None:
        raise source.bad(element, "has no length, and no track or coordinates that give one", "add the length")
    if not SHORTEST_M <= drawn_m <= LONGEST_M:
        raise source.bad(element, f"its length is {drawn_m!r:.40} m", f"give {SHORTEST_M} to {LONGEST_M} m")
    text = f"net element '{name}' has no length: that of its drawing is taken, {drawn_m:.3f}"
    findings.remark([name], text, "derived")
    return round(drawn_m * MM_A_METRE)


def _drawn_m(source: Document, element: Element) -> float | None:
    """The way along the drawing of a net element, in what its coordinates are given in."""
    points = [
        (source.number(each, "x", -FARTHEST_M, FARTHEST_M), source.number(each, "y", -FARTHEST_M, FARTHEST_M))
        for each in source.all("geometricCoordinate", element)
        if each.get("x") is not None
    ]
    return sum(hypot(b[0] - a[0], b[1] - a[1]) for a, b in pairwise(points)) if len(points) > 1 else None


def _tracks_over(source: Document) -> Mapping[str, list[Over]]:
    """For each net element, the tracks that run over it."""
    found: dict[str, list[Over]] = {}
    for track in source.all("track"):
        parts = list(source.all("associatedNetElement", track))
        for part in parts:
            found.setdefault(part.get("netElementRef", ""), []).append(Over(track, part, len(parts) == 1))
    return found


def _of_track_m(source: Document, tracks: Sequence[Over]) -> float | None:
    """The length of the track that is this net element and no other."""
    lengths = (source.first("length", over.track) for over in tracks if over.alone)
    length = next((each for each in lengths if each is not None), None)
    return None if length is None else source.number(length, "value", SHORTEST_M, LONGEST_M)


def _compare_track(source: Document, name: str, told_m: float, tracks: Sequence[Over], findings: Findings) -> None:
    """A track that is a net element and no other is as long as this, and the only one there runs over all of it.

    A usable length is shorter; so is a track that is told to begin or end within the net element.
    """
    for over in tracks:
        track, length = over.track.get("id"), source.first("length", over.track)
        named = [name] if track is None else [name, track]
        span_m = _span_m(source, over)
        shares = ((over.part, f"intrinsicCoord{end}", whole) for end, whole in WHOLE.items())
        within = any(part.get(at) is not None and source.number(part, at, 0, 1) != whole for part, at, whole in shares)
        if span_m is not None:
            if len(tracks) == 1 and abs(span_m - told_m) > TOLERANCE * told_m:
                run = f"track '{track}', the only one there, runs over {span_m:g} m of it"
                findings.remark(named, f"net element '{name}' is {told_m:g} m long, and {run}", "derived")
        elif over.alone and not within and length is not None and length.get("type", "physical") == "physical":
            track_m = source.number(length, "value", SHORTEST_M, LONGEST_M)
            if abs(track_m - told_m) > TOLERANCE * told_m:
                text = f"net element '{name}' is {told_m:g} m long, and track '{track}', which is all of it, is"
                findings.violation(ONE_LENGTH, named, f"{text} {track_m:g} m long: correct one of the two")


def _span_m(source: Document, over: Over) -> float | None:
    """How much of a net element a track is told to run over, if that is told in metres."""
    if any(over.part.get(f"pos{end}") is None for end in WHOLE):
        return None
    begin_m, end_m = (source.number(over.part, f"pos{end}", -FARTHEST_M, FARTHEST_M) for end in WHOLE)
    return abs(end_m - begin_m)


# ---- places


def _meetings(source: Document, known: Mapping[str, int]) -> Iterator[Meeting]:
    """Every place in which ends meet."""
    graph: networkx.Graph[End] = networkx.Graph()
    for relation in source.all("netRelation"):
        one, other = (_end(source, relation, each) for each in ("A", "B"))
        strange = [end[0] for end in (one, other) if end[0] not in known]
        if len(strange) == 1:
            what = f"relates track to '{strange[0]}', which is on no level Micro: what comes from there is not known"
            raise source.bad(relation, what, "list both its elements on the level Micro, or neither")
        if strange:
            continue
        if one == other:
            raise source.bad(relation, "relates an end to itself", "correct its elements or positions")
        navigable = source.attribute(relation, "navigability") != "None"
        ran = navigable or graph.get_edge_data(one, other, {}).get("ran", False)
        graph.add_edge(one, other, ran=ran)
        graph.edges[one, other].setdefault("names", []).append(source.attribute(relation, "id"))
    for ends in sorted(sorted(each) for each in networkx.connected_components(graph)):
        inside = graph.subgraph(ends)
        related = list(inside.edges(data=True))
        relations = sorted(name for _, _, found in related for name in found["names"])
        ways = sorted((min(one, other), max(one, other)) for one, other, found in related if found["ran"])
        yield Meeting(tuple(ends), tuple(relations), tuple(ways))


def _end(source: Document, relation: Element, side: str) -> End:
    referring = source.first(f"element{side}", relation)
    if referring is None:
        raise source.bad(relation, f"has no element{side}", "add it")
    source.referred(referring)
    position = source.number(relation, f"positionOn{side}", 0, 1)
    if position not in BY_POSITION:
        raise source.bad(relation, f"positionOn{side} is {position:g}: no end", "give 0 or 1")
    return source.attribute(referring, "ref"), BY_POSITION[position]


def _named(source: Document, parts: Mapping[str, str]) -> dict[str, Named]:
    """For each relation that is a branch of a switch or crossing, that; of a slip told with its parts the whole.

    Raises:
        BadInput: it is a branch of two, or of a part and not of the whole.
    """
    found: dict[str, Named] = {}
    of_parts: list[tuple[str, Named]] = []
    for relation, named in _branching(source):
        if named.element.get("id") in parts:
            of_parts.append((relation, named))
            continue
        other = found.setdefault(relation, named).element
        if other is not named.element:
            taken = f"{kind_of(other)} '{source.attribute(other, 'id')}'"
            what = f"its relation '{relation}' is a branch of {taken} as well"
            raise source.bad(named.element, what, "let one element name each place, or correct its branches")
    for relation, named in of_parts:
        slip = parts[source.attribute(named.element, "id")]
        if relation not in found or found[relation].element.get("id") != slip:
            what = f"is a part of '{slip}', which its relation '{relation}' is no branch of"
            raise source.bad(named.element, what, "tell the slip as a whole, with all its branches, beside its parts")
    return found


def _slip_parts(source: Document) -> dict[str, str]:
    """For each switch that is told as a part of another one, a slip, that."""
    switches = ((switch, switch.get("belongsToParent")) for switch in source.all("switchIS"))
    return {source.attribute(switch, "id"): parent for switch, parent in switches if parent is not None}


def _branching(source: Document) -> Iterator[tuple[str, Named]]:
    """Each branch of a switch or crossing, by its relation."""
    for kind in ("switchIS", "crossing", "crossingIS"):
        for element in source.all(kind):
            branches = {
                f"{word}{number}": source.attribute(branch, "netRelationRef")
                for word in ("left", "right", "straight", "turning")
                for number, branch in enumerate(source.all(f"{word}Branch", element))
                if branch.get("netRelationRef") is not None
            }
            if len(branches) == 0:
                raise source.bad(element, "has no branch that refers to a net relation", "add its branches")
            for branch, relation in branches.items():
                if relation not in source.by_id:
                    what = f"its {branch.rstrip(digits)} branch refers to '{relation}', which is not there"
                    raise source.bad(element, what, "correct the reference or add the relation")
                yield relation, Named(element, branches)


def _junction(source: Document, meeting: Meeting, named: Mapping[str, Named], findings: Findings) -> Junction:
    """What rails make of a place."""
    by = next((named[name] for name in meeting.relations if name in named), None)
    element = source.by_id[meeting.relations[0]] if by is None else by.element
    name = source.attribute(element, "id")
    ports = {f"end{at}": end for at, end in enumerate(meeting.ends)}
    port_of = {end: port for port, end in ports.items()}
    ways = [(port_of[one], port_of[other]) for one, other in meeting.ways]
    kind = _kind(source, element, ways, by, port_of)
    if by is not None and len(ports) < 3:
        what = "two ends of track meet here, and none of another track"
        raise source.bad(element, what, "relate all ends of track that meet there")
    if kind is None:
        what = f"{len(ports)} ends of track meet here, and {len(ways)} ways lead from one to another"
        raise source.bad(element, f"{what}: no joint, point, crossing or slip has that", "correct the relations")
    if by is None and len(kind.positions) > 1:
        text = f"relation '{name}' is at a point that no switch names: it goes by the relation's id"
        findings.remark([name], text, "derived")
    return Junction(name, kind, ports)


def _kind(
    source: Document, element: Element, ways: list[tuple[str, str]], by: Named | None, port_of: Mapping[End, str]
) -> Kind | None:
    """The kind of a junction, by which ends lead to which; positions of a point are railML's words.

    Four ends that are no crossing lead from one side to the other, as over a slip or a three-way point.
    """
    ports = tuple(port_of.values())
    met = [port for way in ways for port in way]
    if len(ports) == len(met) and len(set(met)) == len(met):
        return Kind(ports, {"static": tuple(ways)})
    if len(ports) == 3 and len(ways) == 2:
        sides = _sides(source, by, ways, port_of) or {"branch1": ways[0], "branch2": ways[1]}
        if set(sides.values()) != set(ways):
            raise source.bad(element, "its branches are not the ways over this point", "correct its branches")
        return Kind(ports, {side: (way,) for side, way in sides.items()})
    if len(ports) == 4 and all(port in met for port in ports) and networkx.is_bipartite(networkx.Graph(ways)):
        return Kind(ports, {f"{one}_{other}": ((one, other),) for one, other in ways})
    return None


def _sides(
    source: Document, by: Named | None, ways: list[tuple[str, str]], port_of: Mapping[End, str]
) -> dict[str, tuple[str, str]]:
    """For the left and the right branch of a switch, the way over it."""
    found = {}
    for branch, relation in {} if by is None else dict(by.branches).items():
        element = source.by_id[relation]
        ends = [_end(source, element, each) for each in ("A", "B")]
        pair = [port_of[end] for end in ends if end in port_of]
        way = next((each for each in ways if set(each) == set(pair)), None)
        if way is not None:
            found[branch.rstrip(digits)] = way
    return found
