"""railML's routes, followed over the track: what the file says of their points is held against the way."""

from __future__ import annotations

from collections.abc import Callable, Collection, Iterator, Mapping, Sequence
from dataclasses import dataclass
from itertools import islice

from models.layouts.findings import Findings
from models.layouts.railml.document import Document, Element, kind_of
from models.layouts.railml.marks import Marks, signal_of
from models.layouts.told import Wanted
from models.layouts.track import Cut, Heading, Joint, Segments

MOST_WAYS = 64
"""From no signal are more routes derived; a station has fewer."""
MOST_STEPS = 20_000
"""So many pieces of track are looked at for a way; what has no end by then is refused."""
POSITIONS = ("facingSwitchInPosition", "trailingSwitchInPosition", "switchInPosition", "requiresSwitchInPosition")
DEPARTURE = ("switchPositionInDepartureTrack",)
POSITIONS_FIT = "a route's positions are of its points"

Ends = tuple[Element, Element, Element]
"""A route, and the elements on the track that it begins and ends at."""
Ending = Callable[[str, Heading], bool]
"""Whether a way ends at a mark, and at the heading by which it comes to it."""


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
    derived = list(_derived(source, segments, marks))
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
    every = (
        (start, way)
        for start, side in starts.items()
        for way in ways_from(source, route, segments, (start, side), lambda mark, _: mark in goals, given)
    )
    ways = list(islice(every, 2))
    if not ways:
        what = f"no way leads from '{first}' to '{last}'" + (" with its points so" if given else "")
        raise source.bad(route, what, "correct its ends, the direction of its entry, or its points")
    if len(ways) > 1:
        what = f"several ways lead from '{first}' to '{last}'"
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
            if point.get("belongsToParent") is not None:
                what = f"'{name}' is a part of slip '{point.get('belongsToParent')}': how parts lie is not read"
                raise source.bad(item, what, "name no position of it: it follows where one way leads over the slip")
            if junction is None or position not in junction.kind.positions:
                raise source.bad(item, f"'{name}' is no point that can lie '{position[:40]}'", "correct it")
            yield name, position


def _derived(source: Document, segments: Segments, marks: Marks) -> Iterator[Followed]:
    """From each signal every way to the next one that speaks to the same trains, or to the end of track.

    Where trains come to a signal over points that they trail, there is a route for each way that they come.

    Raises:
        BadInput: there are too many ways from a signal, so that some would be left out.
    """
    speaking = {(marks.of[signal], side) for signal, side in marks.side.items() if signal in marks.signals}

    def ends(mark: str, heading: Heading) -> bool:
        return (mark, heading[1]) in speaking or not segments.station.marks[mark].cuts

    for entry, side in sorted(speaking):
        if side not in segments.beside[entry]:
            continue
        ways = _all_ways(source, segments, (entry, side), ends)
        behind = [dict(way.positions) for way in _all_ways(source, segments, (entry, 1 - side), lambda *_: True)]
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


def _all_ways(source: Document, segments: Segments, start: tuple[str, int], ends: Ending) -> list[Way]:
    """Every way from a mark to one side."""
    signal = source.by_id.get(start[0])
    ways = list(islice(ways_from(source, signal, segments, start, ends, {}), MOST_WAYS + 1))
    if len(ways) > MOST_WAYS:
        what = f"has more than {MOST_WAYS} ways to one side: no routes are derived from so many"
        raise source.bad(signal, what, "let signals stand between its points, or give the routes")
    return ways


def ways_from(
    source: Document,
    told: Element | None,
    segments: Segments,
    start: tuple[str, int],
    ends: Ending,
    given: Mapping[str, str],
) -> Iterator[Way]:
    """Ways from a mark, to one side, to the first ones that end a way, over no track twice, points lying as given.

    A leg of a point from which no track leads to an end is not followed, so that the first two ways are found soon,
    however much track lies beyond.  ``told``: the route or overlap whose ways they are.

    Raises:
        BadInput: so much track has been looked at that how many ways there are is not known.
    """
    heading = segments.beside[start[0]].get(start[1])
    going: list[tuple[Heading, dict[str, str], tuple[str, ...], tuple[int, ...]]] = []
    going += [(heading, {}, (), ())] if heading is not None else []
    steps = 0
    while going:
        steps += 1
        if steps > MOST_STEPS:
            what = f"which ways lead on from '{start[0]}' is not known after {MOST_STEPS:,} pieces of track"
            raise source.bad(told, what, "name the position of each facing point")
        now, positions, passed, over = going.pop()
        mark, over = _mark_at(segments, now), (*over, now[0])
        if mark is not None and ends(mark, now):
            yield Way(mark, now, positions, passed, over)
            continue
        passed = passed if mark is None else (*passed, mark)
        onward = [
            (ahead, {**positions, **lies})
            for ahead, lies in _onward(segments, now, {**given, **positions})
            if ahead[0] not in over
        ]
        for ahead, lies in onward:
            if len(onward) == 1 or _comes_to_an_end(segments, ahead, ends, {**given, **lies}, over):
                going.append((ahead, lies, passed, over))


def _comes_to_an_end(
    segments: Segments, start: Heading, ends: Ending, lies: Mapping[str, str], over: Collection[int]
) -> bool:
    """Whether some track leads on to where a way ends, not over what it has been over, points lying as they do.

    A yes is not certain: such track may run over itself, or over a point that lies two ways.
    """
    met: set[Heading] = set()
    todo = [start]
    while todo:
        now = todo.pop()
        if now in met or now[0] in over:
            continue
        met.add(now)
        mark = _mark_at(segments, now)
        if mark is not None and ends(mark, now):
            return True
        todo += [ahead for ahead, _ in _onward(segments, now, lies)]
    return False


def _mark_at(segments: Segments, heading: Heading) -> str | None:
    """The mark that a heading runs to; none at a junction, or where track ends without one."""
    end = segments.at[heading]
    return None if isinstance(end, Joint) else end.mark


def _onward(segments: Segments, heading: Heading, lies: Mapping[str, str]) -> Iterator[tuple[Heading, dict[str, str]]]:
    """The headings behind a mark or a junction, points lying as they do; each with how a point there must lie."""
    match segments.at[heading]:
        case Cut(_, beyond):
            yield beyond, {}
        case Joint() as joint:
            point = segments.station.junctions[joint.junction]
            for _, choices, ahead in segments.onward(joint):
                if not point.is_point:
                    yield ahead, {}
                elif lies.get(point.name, choices[0]) == choices[0]:
                    yield ahead, {point.name: choices[0]}
