"""railML's overlaps: for each route the one that is told, followed from the route's exit to its end."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace

from models.layouts.findings import Findings
from models.layouts.railml.document import Document, Element
from models.layouts.railml.marks import Marks, signal_of
from models.layouts.railml.routes import Ends, Followed, Way, given_positions, ways_from
from models.layouts.railml.sections import demarcated
from models.layouts.track import Segments

LONGEST_M = 100_000


def with_overlaps(
    source: Document,
    segments: Segments,
    marks: Marks,
    routes: Mapping[str, Ends],
    followed: Sequence[Followed],
    findings: Findings,
) -> list[Followed]:
    """The routes with their overlaps, where the file tells any.

    An overlap is that of the routes it names, or of all that end at the element it names.  It ends at what limits
    it, else with its sections, else at the first mark that lies as far as it is long.

    Raises:
        BadInput: an overlap has no one way over the track, or does not say where it ends.
    """
    told: dict[str, list[Element]] = {}
    for overlap in source.all("overlap"):
        for route in _routes_of(source, overlap, routes):
            told.setdefault(route, []).append(overlap)
    found = []
    for each in followed:
        name = each.wanted.name
        overlaps = told.get(name, [])
        if len(overlaps) > 1:
            names = [source.attribute(overlap, "id") for overlap in overlaps]
            text = f"route '{name}' has {len(names)} overlaps to choose from: it always claims the first, '{names[0]}'"
            findings.remark([name, *names], text)
        found.append(_with(source, segments, marks, each, overlaps[0]) if overlaps else each)
    timed = sum(1 for _ in source.all("overlapRelease"))
    if timed:
        text = f"{timed} of overlapRelease are not read: an overlap is free once its train has told that it stands"
        findings.remark([], text)
    return found


def _routes_of(source: Document, overlap: Element, routes: Mapping[str, Ends]) -> list[str]:
    """The routes that an overlap belongs to."""
    named = [source.attribute(source.referred(each), "id") for each in source.all("activeForApproachRoute", overlap)]
    for name in named:
        if name not in routes:
            raise source.bad(overlap, f"is told for '{name[:40]}', which is no route", "correct the reference")
    asset = source.first("relatedToTrackAsset", overlap)
    if named or asset is None:
        return named
    exit_of = source.attribute(signal_of(source, source.referred(asset)), "id")
    return [name for name, (_, _, last) in routes.items() if source.attribute(last, "id") == exit_of]


def _with(source: Document, segments: Segments, marks: Marks, route: Followed, overlap: Element) -> Followed:
    """One route with its overlap."""
    given = dict(given_positions(source, overlap, segments))
    way = _way(source, segments, marks, route, overlap, given)
    positions = {**way.positions, **route.wanted.positions}
    flank = {**{point: at for point, at in given.items() if point not in positions}, **route.wanted.flank}
    return replace(route, wanted=replace(route.wanted, overlap=way.to, positions=positions, flank=flank))


def _way(
    source: Document, segments: Segments, marks: Marks, route: Followed, overlap: Element, given: Mapping[str, str]
) -> Way:
    """The one way from the exit of a route to the end of its overlap."""
    first, side = route.wanted.exit, route.way.arrives[1]
    if side not in segments.beside[first]:
        what = f"route '{route.wanted.name}' ends at '{first}', where track ends"
        raise source.bad(overlap, what, "take the overlap away")
    limits = {marks.of.get(source.attribute(each, "id"), "") for each in _limits(source, overlap)}
    bounds = demarcated(source, marks)
    listed = [source.attribute(source.referred(each), "id") for each in source.all("hasTvdSection", overlap)]
    if limits:
        ways = ways_from(segments, first, side, lambda mark, _: mark in limits)
    elif listed:
        once = [mark for name in listed for mark in bounds.get(name, ())]
        ways = ways_from(segments, first, side, lambda mark, _: once.count(mark) == 1)
    elif overlap.get("length") is not None:
        ways = _so_long(source, segments, first, side, overlap, given)
    else:
        raise source.bad(overlap, "says neither what limits it, nor its sections, nor its length", "add one of them")
    fitting = [way for way in ways if all(way.positions.get(point, at) == at for point, at in given.items())]
    if len(fitting) != 1:
        what = f"{len(fitting) or 'no'} ways lead from '{first}', the exit of route '{route.wanted.name}', to its end"
        raise source.bad(overlap, what, "correct its end, or name the position of each point")
    return fitting[0]


def _limits(source: Document, overlap: Element) -> list[Element]:
    return [signal_of(source, source.referred(each)) for each in source.all("isLimitedBy", overlap)]


def _so_long(
    source: Document, segments: Segments, mark: str, side: int, overlap: Element, given: Mapping[str, str]
) -> list[Way]:
    """The way to the first mark that lies as far as an overlap is long; to the end of track if that comes first."""
    length_mm = round(source.number(overlap, "length", 0.001, LONGEST_M) * 1_000)
    run_mm = 0
    positions: dict[str, str] = {}
    passed: tuple[str, ...] = ()
    over: tuple[int, ...] = ()
    while True:
        ways = ways_from(segments, mark, side, lambda *_: True)
        ways = [way for way in ways if all(way.positions.get(point, at) == at for point, at in given.items())]
        if len(ways) != 1:
            return ways
        (way,) = ways
        run_mm += sum(segments.segments[at].to_mm - segments.segments[at].from_mm for at in way.segments)
        positions, over = {**positions, **way.positions}, (*over, *way.segments)
        mark, side = way.to, way.arrives[1]
        if run_mm >= length_mm or side not in segments.beside[mark] or len(set(over)) < len(over):
            return [Way(mark, way.arrives, positions, passed, over)]
        passed = (*passed, mark)
