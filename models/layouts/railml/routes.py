"""railML's routes, followed over the track: what the file says of their points is held against the way."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from itertools import islice

from models.layouts.findings import Findings
from models.layouts.railml.document import Document, Element, kind_of
from models.layouts.railml.marks import Marks, signal_of
from models.layouts.told import Wanted
from models.layouts.track import Cut, Heading, Joint, Segments, Stop

MOST_WAYS = 64
"""So many ways from a signal are looked at; a station has fewer."""
MOST_STEPS = 20_000
POSITIONS = ("facingSwitchInPosition", "trailingSwitchInPosition", "switchInPosition", "requiresSwitchInPosition")
DEPARTURE = ("switchPositionInDepartureTrack",)
POSITIONS_FIT = "a route's positions are of its points"

Ends = tuple[Element, Element, Element]
"""A route, and the elements on the track that it begins and ends at."""


@dataclass(frozen=True)
class Way:
    """A way over the track: the mark it ends at and its heading there, points, marks passed, segments run over."""

    to: str
    arrives: Heading
    positions: Mapping[str, str]
    passed: tuple[str, ...]
    segments: tuple[int, ...]


@dataclass(frozen=True)
class Followed:
    """A route with its way."""

    wanted: Wanted
    way: Way


def route_ends(source: Document) -> dict[str, Ends]:
    """Each route with the elements on the track that it begins and ends at.

    Raises:
        BadInput: one does not say them.
    """
    found = {}
    for route in source.all("route"):
        ends = []
        for kind in ("routeEntry", "routeExit"):
            end = source.first(kind, route)
            refers = None if end is None else source.first("refersTo", end)
            if refers is None:
                raise source.bad(route, f"has no {kind} that refers to anything", "add it")
            ends.append(signal_of(source, source.referred(refers)))
        found[source.attribute(route, "id")] = (route, ends[0], ends[1])
    return found


def follow(
    source: Document, segments: Segments, marks: Marks, routes: Mapping[str, Ends], findings: Findings
) -> list[Followed]:
    """The routes of the file; where it has none, from each signal to the next one that speaks to the same trains.

    Raises:
        BadInput: a route has no way over the track, or more than one; or there is nothing to derive one from.
    """
    if routes:
        return [_followed(source, segments, marks, ends, findings) for ends in routes.values()]
    derived = list(_derived(segments, marks))
    if not derived:
        raise source.bad(None, "has no routes, and no signals that they could be derived from", "give its routes")
    names = [each.wanted.name for each in derived]
    findings.remark(names, f"the file has no routes: {len(names)} are derived, from signal to signal", "derived")
    return derived


def _followed(source: Document, segments: Segments, marks: Marks, ends: Ends, findings: Findings) -> Followed:
    route, (first, last) = ends[0], (source.attribute(each, "id") for each in ends[1:])
    name = source.attribute(route, "id")
    given = positions_told(source, route, name, segments, findings)
    starts = {mark: _side(source, segments, marks, ends[1], mark) for mark in sorted(marks.standing(first))}
    goals = marks.standing(last)
    for element, standing in ((ends[1], starts), (ends[2], goals)):
        if not standing:
            raise source.bad(element, "has no place on the track", "add its spotLocation")
    ways = [
        (start, way)
        for start, side in starts.items()
        for way in ways_from(segments, start, side, lambda mark, _: mark in goals)
        if all(way.positions.get(point, position) == position for point, position in given.items())
    ]
    if not ways:
        what = f"no way leads from '{first}' to '{last}'" + (" with its points so" if given else "")
        raise source.bad(route, what, "correct its ends, the direction of its entry, or its points")
    if len(ways) > 1:
        what = f"{len(ways)} ways lead from '{first}' to '{last}'"
        raise source.bad(route, what, "name the position of each facing point")
    ((start, way),) = ways
    if marks.side.get(last, way.arrives[1]) != way.arrives[1]:
        text = f"route '{name}' ends at '{last}', which speaks to trains the other way"
        findings.remark([name, last], text, "derived")
    parts = tuple(mark for mark in way.passed if mark in marks.parts)
    departing = positions_told(source, route, name, segments, findings, DEPARTURE)
    positions, flank = {**departing, **way.positions}, {p: at for p, at in given.items() if p not in way.positions}
    against = {p: at for p, at in departing.items() if positions[p] != at or given.get(p, at) != at}
    for point, at in against.items():
        text = f"route '{name}' wants switch '{point}' in '{at}' in its departure track, and otherwise as well"
        findings.violation(POSITIONS_FIT, [name, point], text)
    wanted = Wanted(name, f"route '{name}'", start, starts[start], way.to, positions, parts, flank=flank)
    return Followed(wanted, way)


def _side(source: Document, segments: Segments, marks: Marks, entry: Element, mark: str) -> int:
    """The side of its entry that a route runs to."""
    name = source.attribute(entry, "id")
    if name in marks.side:
        return marks.side[name]
    sides = list(segments.beside[mark])
    if len(sides) > 1:
        raise source.bad(
            entry, "says of no one direction that it speaks to", "give applicationDirection normal or reverse"
        )
    return sides[0]


def positions_told(
    source: Document,
    told: Element,
    name: str,
    segments: Segments,
    findings: Findings,
    kinds: Sequence[str] = POSITIONS,
) -> dict[str, str]:
    """The positions that a route or an overlap names for points; those of its departure track are of another kind.

    A point that is named in two positions is a violation, and taken as not named.

    Raises:
        BadInput: it is no point, or has no such position.
    """
    found: dict[str, list[str]] = {}
    for point, at in _given_positions(source, told, segments, kinds):
        found.setdefault(point, []).append(at)
    for point, positions in found.items():
        if len(set(positions)) > 1:
            both = " and in ".join(f"'{at}'" for at in dict.fromkeys(positions))
            text = f"{kind_of(told)} '{name}' wants switch '{point}' in {both}: leave one of them"
            findings.violation(POSITIONS_FIT, [name, point], text)
    return {point: positions[0] for point, positions in found.items() if len(set(positions)) == 1}


def _given_positions(
    source: Document, told: Element, segments: Segments, kinds: Sequence[str]
) -> Iterator[tuple[str, str]]:
    for kind in kinds:
        for item in source.all(kind, told):
            refers = source.first("refersToSwitch", item)
            if refers is None:
                raise source.bad(item, "refers to no switch", "add its refersToSwitch")
            switch = source.referred(refers)
            physical = source.first("refersTo", switch)
            point = switch if physical is None else source.referred(physical)
            name, position = source.attribute(point, "id"), source.attribute(item, "inPosition")
            junction = segments.station.junctions.get(name)
            if junction is None or position not in junction.kind.positions:
                raise source.bad(item, f"'{name}' is no point that can lie '{position[:40]}'", "correct it")
            yield name, position


def _derived(segments: Segments, marks: Marks) -> Iterator[Followed]:
    """From each signal every way to the next one that speaks to the same trains, or to the end of track.

    Where trains come to a signal over points that they trail, there is a route for each way that they come.
    """
    speaking = {(marks.of[signal], side) for signal, side in marks.side.items() if signal in marks.signals}

    def ends(mark: str, heading: Heading) -> bool:
        return (mark, heading[1]) in speaking or not segments.station.marks[mark].cuts

    for entry, side in sorted(speaking):
        if side not in segments.beside[entry]:
            continue
        ways = ways_from(segments, entry, side, ends)
        behind = [dict(way.positions) for way in ways_from(segments, entry, 1 - side, lambda *_: True)]
        for way in ways:
            twin = sum(other.to == way.to for other in ways) > 1
            for standing in behind if len(behind) > 1 else [{}]:
                over = f" over {_listed(way.positions)}" if twin and way.positions else ""
                name = f"{entry} - {way.to}{over}" + (f" from {_listed(standing)}" if standing else "")
                parts = tuple(mark for mark in way.passed if mark in marks.parts)
                positions = {**standing, **way.positions}
                yield Followed(Wanted(name, f"derived route '{name}'", entry, side, way.to, positions, parts), way)


def _listed(positions: Mapping[str, str]) -> str:
    return ", ".join(f"{point} {position}" for point, position in sorted(positions.items()))


def ways_from(segments: Segments, mark: str, side: int, ends: Callable[[str, Heading], bool]) -> list[Way]:
    """Ways from a mark to the first ones that end a way, over no track twice; so many of them at most."""
    if side not in segments.beside[mark]:
        return []
    return list(islice(_ways(segments, segments.beside[mark][side], ends), MOST_WAYS))


def _ways(segments: Segments, heading: Heading, ends: Callable[[str, Heading], bool]) -> Iterator[Way]:
    steps = 0
    going: list[tuple[Heading, dict[str, str], tuple[str, ...], tuple[int, ...]]] = [(heading, {}, (), ())]
    while going and steps < MOST_STEPS:
        steps += 1
        now, positions, passed, over = going.pop()
        if now[0] in over:
            continue
        over = (*over, now[0])
        match segments.at[now]:
            case Cut(mark, beyond):
                if ends(mark, now):
                    yield Way(mark, now, positions, passed, over)
                else:
                    going.append((beyond, positions, (*passed, mark), over))
            case Stop(str() as mark):
                if ends(mark, now):
                    yield Way(mark, now, positions, passed, over)
            case Joint() as joint:
                point = segments.station.junctions[joint.junction]
                for _, choices, onward in segments.onward(joint):
                    lies = positions
                    if point.is_point:
                        if positions.get(point.name, choices[0]) != choices[0]:
                            continue
                        lies = {**positions, point.name: choices[0]}
                    going.append((onward, lies, passed, over))
