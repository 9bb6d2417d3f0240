"""railML 3 surveyed with the standard library's XML alone: net elements as rails, signals and detectors upon them."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from itertools import pairwise
from math import hypot, isclose
from xml.etree import ElementTree

from tests.independent.layouts.rails import Line, Survey, run
from tests.independent.raw_graph import Closed, Cut, End, Junction, Network, Over, Place, Stop

CLEAR_MM = 20_000
Element = ElementTree.Element


class Document:
    """Elements of the document's own namespace; others say nothing."""

    def __init__(self, text: str) -> None:
        self.root = ElementTree.fromstring(text.encode())
        self.space = self.root.tag.rpartition("}")[0] + "}"
        self.by_id = {each.get("id", ""): each for each in self.root.iter() if each.tag.startswith(self.space)}

    def all(self, kind: str, inside: Element | None = None) -> list[Element]:
        return list((self.root if inside is None else inside).iter(self.space + kind))

    def on_track(self, element: Element) -> str:
        """The id of what an element of the interlocking is on the track."""
        while not self.all("spotLocation", element):
            (refers, *_) = self.all("refersTo", element)
            element = self.by_id[refers.get("ref", "")]
        return element.get("id", "")


def survey(text: str) -> Survey:
    """The rails and routes of a document that has both."""
    source = Document(text)
    lengths = {name: _length_mm(source, element) for name, element in _elements(source).items()}
    faults: list[str] = []
    junctions = _junctions(source, lengths, faults)
    spots, stops = _spots(source, lengths, faults)
    cuts: dict[str, list[tuple[int, str]]] = {}
    marks: dict[str, tuple[str, int]] = {}
    for name, (track, mm, _) in spots.items():
        if (track, mm) not in marks.values():
            cuts.setdefault(track, []).append((mm, name))
        marks[name] = (track, mm)
    network = Network(lengths, cuts, junctions, stops)
    found = Survey(network, {}, marks | {name: _at(network, end) for end, name in stops.items()}, CLEAR_MM, faults)
    for route in source.all("route"):
        found.lines |= _line(source, found, spots, route)
    return found


def _at(network: Network, end: End) -> tuple[str, int]:
    return end[0], network.lengths[end[0]] if end[1] else 0


def _elements(source: Document) -> dict[str, Element]:
    micro = {
        each.get("ref", "")
        for level in source.all("level")
        if level.get("descriptionLevel") == "Micro"
        for each in source.all("networkResource", level)
    }
    every = {each.get("id", ""): each for each in source.all("netElement")}
    return {name: each for name, each in every.items() if not micro or name in micro}


def _length_mm(source: Document, element: Element) -> int:
    """Its own, else its track's if it is all of that, else the drawing's."""
    if element.get("length"):
        return round(float(element.get("length", "")) * 1000)
    for track in source.all("track"):
        parts, lengths = source.all("associatedNetElement", track), source.all("length", track)
        if lengths and [part.get("netElementRef") for part in parts] == [element.get("id")]:
            return round(float(lengths[0].get("value", "")) * 1000)
    drawn = [
        (float(each.get("x", "")), float(each.get("y", ""))) for each in source.all("geometricCoordinate", element)
    ]
    return round(sum(hypot(b[0] - a[0], b[1] - a[1]) for a, b in pairwise(drawn)) * 1000)


def _ends(source: Document, relation: Element) -> tuple[End, End]:
    one, other = (
        (source.all(f"element{side}", relation)[0].get("ref", ""), round(float(relation.get(f"positionOn{side}", ""))))
        for side in "AB"
    )
    return one, other


def _junctions(source: Document, lengths: Mapping[str, int], faults: list[str]) -> dict[str, Junction]:
    """Joints by relation, and points by the switch that names their branches."""
    found: dict[str, Junction] = {}
    named: set[str] = set()
    for switch in source.all("switchIS"):
        name, joins, legs = switch.get("id", ""), {}, {}
        for word in ("left", "right"):
            (branch,) = source.all(f"{word}Branch", switch)
            named.add(branch.get("netRelationRef", ""))
            legs[word] = set(_ends(source, source.by_id[branch.get("netRelationRef", "")]))
        (tip,) = legs["left"] & legs["right"]
        at = {"tip": tip} | {word: next(iter(ends - {tip})) for word, ends in legs.items()}
        for told in source.all("switchIL"):
            if source.all("refersTo", told)[0].get("ref") == name:
                for word in ("left", "right"):
                    refs = [each.get("ref") for each in source.all(f"branch{word.title()}", told)]
                    if refs and refs[0] != at[word][0]:
                        faults.append(f"{told.get('id')}: its {word} branch is not that of {name}")
        joins = {word: (("tip", word),) for word in ("left", "right")}
        found[name] = Junction(name, at, joins, moves=True)
    taken = {end for junction in found.values() for end in junction.legs.values()}
    for relation in source.all("netRelation"):
        one, other = _ends(source, relation)
        if relation.get("navigability") != "None" and {one[0], other[0]} <= set(lengths) and not {one, other} & taken:
            name = relation.get("id", "")
            found[name] = Junction(name, {"a": one, "b": other}, {"": (("a", "b"),)}, moves=False)
            taken |= {one, other}
    return found


Spots = dict[str, tuple[str, int, int]]
"""Name -> track, mm, and the direction in which trains are spoken to, 0 for both."""


def _spots(source: Document, lengths: Mapping[str, int], faults: list[str]) -> tuple[Spots, dict[End, str]]:
    """Where blocks end: detectors, signals of routes, what limits overlaps or ends sections; and ends of track.

    Track ends at a border that is an open end, and at one that stands where it does anyway.
    """
    ends = [each for kind in ("routeEntry", "routeExit") for each in source.all(kind)]
    wanted = {source.on_track(each) for each in ends}
    wanted |= {source.on_track(source.by_id[each.get("ref", "")]) for each in source.all("isLimitedBy")}
    wanted |= {each.get("ref", "") for each in source.all("hasDemarcatingBorder")}
    joined = {end for relation in source.all("netRelation") for end in _ends(source, relation)}
    found: Spots = {}
    stops: dict[End, str] = {}
    for kind in ("trainDetectionElement", "signalIS", "bufferStop", "border"):
        for element in source.all(kind):
            name, spots = element.get("id", ""), source.all("spotLocation", element)
            if not spots or (kind == "signalIS" and name not in wanted):
                continue
            spot, track = spots[0], spots[0].get("netElementRef", "")
            mm = [round(float(spot.get("intrinsicCoord", "")) * lengths[track])] if spot.get("intrinsicCoord") else []
            mm += [round(float(spot.get("pos", "")) * 1000)] if spot.get("pos") else []
            if not isclose(mm[0], mm[-1], abs_tol=1_000):
                faults.append(f"{name}: pos and intrinsicCoord are {abs(mm[0] - mm[-1])} mm apart")
            free = {(track, which) for which, at in ((0, 0), (1, lengths[track])) if mm[0] == at} - joined
            open_end = element.get("isOpenEnd") in ("true", "1")
            if kind == "border" and not (free or open_end or name in wanted):
                continue
            if kind == "bufferStop" or (kind == "border" and (free or open_end)):
                stops[track, 0 if mm[0] == 0 else 1] = name
            else:
                heading = {"normal": 1, "reverse": -1}.get(spot.get("applicationDirection", ""), 0)
                found[name] = (track, mm[0], heading)
    return found, stops


def _line(source: Document, found: Survey, spots: Spots, route: Element) -> dict[str, Line]:
    """A route: the only way from its entry to its exit with the points that it names."""
    name, network = route.get("id", ""), found.network
    first, last = (source.on_track(source.all(kind, route)[0]) for kind in ("routeEntry", "routeExit"))
    given = {}
    for kind in ("facingSwitchInPosition", "trailingSwitchInPosition", "switchInPosition"):
        for item in source.all(kind, route):
            switch = source.by_id[source.all("refersToSwitch", item)[0].get("ref", "")]
            refers = source.all("refersTo", switch)
            given[refers[0].get("ref", "") if refers else switch.get("id", "")] = item.get("inPosition", "")
    entry = Place(*spots[first])
    exits = {here for here, at in found.marks.items() if at == found.marks[last]}
    lines = [
        Line(name, entry, points, mark, mark)
        for points, mark in _ways(network, entry, exits, given)
        if all(points.get(point, at) == at for point, at in given.items())
    ]
    return {name: lines[0]} if len(lines) == 1 else {}


def overlaps(text: str) -> dict[str, tuple[tuple[str, int], int]]:
    """Route -> where its overlap ends, and how long that is: the first boundary that limits it or lies so far on.

    Of sections, and where a point that is not told leads two ways, nothing is said.
    """
    source, surveyed = Document(text), survey(text)
    found: dict[str, tuple[tuple[str, int], int]] = {}
    for overlap in source.all("overlap"):
        limits = {source.on_track(source.by_id[each.get("ref", "")]) for each in source.all("isLimitedBy", overlap)}
        least_mm = round(float(overlap.get("length", "0")) * 1_000)
        ends = {surveyed.marks[name] for name in limits}
        named = [each.get("ref", "") for each in source.all("activeForApproachRoute", overlap)]
        for route in named if ends or least_mm else ():
            line = surveyed.lines[route]
            arrived = run(surveyed.network, line.entry, line.positions, line.last).at
            end = None if arrived is None else _end_of(surveyed.network, arrived, line.positions, ends, least_mm)
            if end is not None:
                found.setdefault(route, end)
    return found


def _end_of(
    network: Network, start: Place, lies: Mapping[str, str], ends: set[tuple[str, int]], least_mm: int
) -> tuple[tuple[str, int], int] | None:
    here, run_mm = start, 0

    def position(point: str, leg: str) -> str | None:
        ways = network.junctions[point].ways_from(leg)
        return lies.get(point, None if len(ways) > 1 else next(iter(ways)))

    for event in network.follow(start, position):
        if isinstance(event, Over):
            track, which = network.junctions[event.passing.junction].legs[event.passing.leg]
            run_mm += abs((network.lengths[track] if which else 0) - here.mm)
        elif isinstance(event, Cut | Stop):
            run_mm += abs(event.place.mm - here.mm)
            at = (event.place.track, event.place.mm)
            if isinstance(event, Stop) or (at in ends if ends else run_mm >= least_mm):
                return at, run_mm
        else:
            return None
        here = event.place
    return None


def _ways(
    network: Network, entry: Place, exits: set[str], given: Mapping[str, str]
) -> Iterator[tuple[dict[str, str], str]]:
    """Every way to one of the marks: points as they must lie, and which."""
    todo: list[dict[str, str]] = [{}]
    while todo:
        lies = todo.pop()
        for event in network.follow(entry, lambda point, _, known=lies: known.get(point)):  # type: ignore[misc]
            if isinstance(event, Cut | Stop) and event.name in exits:
                yield lies, event.name
                break
            if isinstance(event, Closed):
                if event.junction not in lies:
                    ways = network.junctions[event.junction].ways_from(event.leg)
                    todo += [{**lies, event.junction: at} for at in sorted(ways)]
                break
            assert isinstance(event, Cut | Stop | Over) or event
