"""railML's TVD sections, held against the track: what demarcates one, and which a route runs through."""

from __future__ import annotations

from collections.abc import Collection, Iterator, Mapping, Sequence
from dataclasses import replace

import networkx

from models.layouts.findings import Findings
from models.layouts.railml.document import Document
from models.layouts.railml.marks import Marks
from models.layouts.railml.routes import Followed
from models.layouts.track import Cut, Segments, Stop

MATCH = "sections are pieces of track, and a route's are those that it runs through"
DEMARCATING = ("hasDemarcatingTraindetector", "hasDemarcatingBufferstop", "hasDemarcatingBorder")


def note_parts(source: Document, marks: Marks, findings: Findings) -> None:
    """Note the detectors of sections that say after what delay a part of a route is released.

    Raises:
        BadInput: a section is demarcated by what is not there.
    """
    delayed = []
    for section, bounds in demarcated(source, marks).items():
        if source.by_id[section].get("partialRouteReleaseDelay") is not None:
            marks.parts |= bounds & marks.detectors
            delayed.append(section)
    if delayed:
        text = f"{len(delayed)} sections say after what delay they are released: it is by the tail's tags, not by time"
        findings.remark(delayed, text)


def with_groups(source: Document, marks: Marks, routes: Sequence[Followed]) -> list[Followed]:
    """The routes, those that name release groups released up to the end of each of these.

    Raises:
        BadInput: a group or a section that is named is not there.
    """
    told = demarcated(source, marks)
    found = []
    for route in routes:
        groups = []
        if route.wanted.name in source.by_id:
            groups = [source.referred(each) for each in source.all("hasReleaseGroup", source.by_id[route.wanted.name])]
        ends = []
        for group in groups:
            listed = [source.attribute(source.referred(each), "id") for each in source.all("hasTvdSection", group)]
            once = [mark for section in listed for mark in told.get(section, ())]
            ends += [mark for mark in route.way.passed if once.count(mark) == 1][-1:]
        release = tuple(dict.fromkeys(ends)) if groups else route.wanted.release
        found.append(replace(route, wanted=replace(route.wanted, release=release)))
    return found


def compare_sections(
    source: Document, segments: Segments, marks: Marks, routes: Sequence[Followed], findings: Findings
) -> None:
    """Sections that no piece of track is, and routes that name others than they run through, are violations.

    A route that names none contradicts nothing; one that has an overlap may name that's as well.
    """
    told = demarcated(source, marks)
    of: dict[int, frozenset[str]] = {}
    matched: set[str] = set()
    for inside, around in _regions(segments, marks):
        names = frozenset(section for section, bounds in told.items() if bounds == around)
        if names:
            of.update(dict.fromkeys(inside, names))
            matched |= names
        if len(names) > 1:
            text = f"sections {_listed(names)} are demarcated alike: it is one piece of track"
            findings.remark(sorted(names), text)
    for section in sorted(told.keys() - matched):
        text = f"no piece of track lies between what demarcates section '{section}': {_listed(told[section])}"
        findings.violation(MATCH, (section, *sorted(told[section])), text)
    for route in routes:
        name = route.wanted.name
        if name not in source.by_id or not told:
            continue
        listed = source.all("hasTvdSection", source.by_id[name])
        named = {source.attribute(source.referred(each), "id") for each in listed}
        run = {of[each] for each in route.way.segments if each in of}
        missed = any(not named & alike for alike in run)
        others = named - frozenset().union(*run)
        if not missed and not others:
            continue
        through = "; ".join(sorted(" or ".join(sorted(alike)) for alike in run)) or "none"
        text = f"route '{name}' names the sections {_listed(named)}, and runs through {through}"
        odd = sorted(others | frozenset().union(*(alike for alike in run if not named & alike)))
        if not named or (not missed and route.wanted.overlap is not None):
            findings.remark([name, *odd], text)
        else:
            findings.violation(MATCH, [name, *odd], text)


def _listed(names: Collection[str]) -> str:
    return ", ".join(sorted(names)) or "none"


def segments_of(source: Document, segments: Segments, marks: Marks) -> Mapping[str, frozenset[int]]:
    """For each section the track between what demarcates it, as segments; none where no piece of track is that."""
    regions = list(_regions(segments, marks))
    return {
        section: frozenset(each for inside, around in regions if around == bounds for each in inside)
        for section, bounds in demarcated(source, marks).items()
    }


def demarcated(source: Document, marks: Marks) -> Mapping[str, frozenset[str]]:
    """For each section the marks that demarcate it, as far as they have a place.

    Raises:
        BadInput: it is demarcated by what is not there.
    """
    found = {}
    for section in source.all("tvdSection"):
        bounds = [source.referred(each) for kind in DEMARCATING for each in source.all(kind, section)]
        names = [source.attribute(each, "id") for each in bounds]
        found[source.attribute(section, "id")] = frozenset(marks.of.get(name, name) for name in names)
    return found


def _regions(segments: Segments, marks: Marks) -> Iterator[tuple[frozenset[int], frozenset[str]]]:
    """The pieces of track between detectors, with the detectors and the ends of track around each."""
    graph: networkx.Graph[int] = networkx.Graph()
    graph.add_nodes_from(range(len(segments.segments)))
    around: dict[int, set[str]] = {each: set() for each in graph}
    for heading, end in segments.at.items():
        match end:
            case Cut(mark, beyond) if mark not in marks.detectors:
                graph.add_edge(heading[0], beyond[0])
            case Cut(mark, _) | Stop(str() as mark):
                around[heading[0]].add(marks.element_of(mark))
    for junction in segments.station.junctions.values():
        first, *others = (segments.leaving[end][0] for end in junction.ports.values())
        graph.add_edges_from((first, other) for other in others)
    for inside in networkx.connected_components(graph):
        yield frozenset(inside), frozenset(mark for each in inside for mark in around[each])
