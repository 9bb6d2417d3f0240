"""railML's overlaps: for each route the one that is told, followed from the route's exit to its end."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import replace
from itertools import islice

from models.layouts.findings import Findings
from models.layouts.railml.document import Document, Element
from models.layouts.railml.marks import SAME_PLACE_M, Marks, signal_of
from models.layouts.railml.routes import POSITIONS_FIT, Followed, Way, positions_told, ways_from
from models.layouts.railml.sections import demarcated, segments_of
from models.layouts.track import Heading, Segments

LONGEST_M = 100_000
FITS = "there is as much track as an overlap is long"
OF_A_ROUTE = "an overlap belongs to a route"


def with_overlaps(
    source: Document,
    segments: Segments,
    marks: Marks,
    followed: Sequence[Followed],
    findings: Findings,
) -> list[Followed]:
    """The routes with their overlaps, where the file tells any.

    An overlap is that of the routes it names, or of all that end where the element stands that it names; one of no
    route is a violation.  It ends at what limits it, else with its sections, else at the first mark that lies as far
    as it is long; where it is told to be longer than the way to its end, the file contradicts itself.

    Raises:
        BadInput: an overlap has no one way over the track, or does not say where it ends.
    """
    told: dict[str, list[Element]] = {}
    for overlap in source.all("overlap"):
        for route in _routes_of(source, overlap, marks, followed, findings):
            told.setdefault(route, []).append(overlap)
    found = []
    for each in followed:
        name = each.wanted.name
        overlaps = told.get(name, [])
        if len(overlaps) > 1:
            names = [source.attribute(overlap, "id") for overlap in overlaps]
            text = f"route '{name}' has {len(names)} overlaps to choose from: it always claims the first, '{names[0]}'"
            findings.remark([name, *names], text)
        found.append(_with(source, segments, marks, each, overlaps[0], findings) if overlaps else each)
    timed = sum(1 for _ in source.all("overlapRelease"))
    if timed:
        text = f"{timed} of overlapRelease are not read: an overlap is free once its train has told that it stands"
        findings.remark([], text)
    return found


def _routes_of(
    source: Document, overlap: Element, marks: Marks, followed: Sequence[Followed], findings: Findings
) -> list[str]:
    """The routes that an overlap belongs to."""
    routes = {each.wanted.name for each in followed}
    named = [source.attribute(source.referred(each), "id") for each in source.all("activeForApproachRoute", overlap)]
    for name in named:
        if name not in routes:
            raise source.bad(overlap, f"is told for '{name[:40]}', which is no route", "correct the reference")
    if named:
        return named
    own, related = source.attribute(overlap, "id"), source.first("relatedToTrackAsset", overlap)
    asset = None if related is None else source.attribute(signal_of(source, source.referred(related)), "id")
    found = [each.wanted.name for each in followed if asset is not None and _ends_at(marks, each, asset)]
    if not found:
        why = "it names neither a route nor what it lies behind" if asset is None else f"no route ends at '{asset}'"
        text = f"overlap '{own}' belongs to no route, and none claims it: {why}: give its activeForApproachRoute"
        findings.violation(OF_A_ROUTE, [own] if asset is None else [own, asset], text)
    return found


def _ends_at(marks: Marks, route: Followed, asset: str) -> bool:
    """Whether a route ends where an element stands, and runs the way that this speaks to, if it says which."""
    side = route.way.arrives[1]
    return route.wanted.exit in marks.standing(asset) and marks.side.get(asset, side) == side


def _with(
    source: Document, segments: Segments, marks: Marks, route: Followed, overlap: Element, findings: Findings
) -> Followed:
    """One route with its overlap."""
    name, wanted = source.attribute(overlap, "id"), route.wanted
    given = positions_told(source, overlap, name, segments, findings)
    way = _way(source, segments, marks, route, overlap, given)
    _compare_length(source, segments, route, overlap, way, findings)
    before = {**wanted.flank, **wanted.positions}
    for point, at in {**given, **way.positions}.items():
        if before.get(point, at) != at:
            text = f"overlap '{name}' wants switch '{point}' in '{at}', its route '{wanted.name}' in '{before[point]}'"
            findings.violation(POSITIONS_FIT, (wanted.name, name, point), f"{text}: correct one of the two")
    positions = {**way.positions, **wanted.positions}
    flank = {**{point: at for point, at in given.items() if point not in positions}, **wanted.flank}
    return replace(route, wanted=replace(wanted, overlap=way.to, positions=positions, flank=flank))


def _way(
    source: Document, segments: Segments, marks: Marks, route: Followed, overlap: Element, given: Mapping[str, str]
) -> Way:
    """The one way from the exit of a route to the end of its overlap."""
    first, side = route.wanted.exit, route.way.arrives[1]
    if side not in segments.beside[first]:
        what = f"route '{route.wanted.name}' ends at '{first}', where track ends"
        raise source.bad(overlap, what, "take the overlap away")
    limits = [each for element in limits_of(source, overlap) for each in marks.standing(element.get("id", ""))]
    if source.first("isLimitedBy", overlap) is not None:
        ways = ways_from(source, overlap, segments, (first, side), lambda mark, _: mark in limits, given)
    elif _sections(source, overlap):
        ways = _over_sections(source, segments, marks, (first, side), overlap, given)
    elif overlap.get("length") is not None:
        ways = _so_long(source, segments, (first, side), overlap, given)
    else:
        raise source.bad(overlap, "says neither what limits it, nor its sections, nor its length", "add one of them")
    found = list(islice(ways, 2))
    if len(found) != 1:
        lead = f"{'several' if found else 'no'} ways lead from '{first}', the exit of route '{route.wanted.name}',"
        raise source.bad(overlap, f"{lead} to its end", "correct its end, or name the position of each point")
    return found[0]


def limits_of(source: Document, overlap: Element) -> list[Element]:
    """The elements on the track that limit an overlap.

    Raises:
        BadInput: one is not there, or stands for none on the track.
    """
    return [signal_of(source, source.referred(each)) for each in source.all("isLimitedBy", overlap)]


def _over_sections(
    source: Document,
    segments: Segments,
    marks: Marks,
    start: tuple[str, int],
    overlap: Element,
    given: Mapping[str, str],
) -> Iterator[Way]:
    """The ways that leave the last of the sections of an overlap, having run through all of them."""
    listed = _sections(source, overlap)
    bounds, track = demarcated(source, marks), segments_of(source, segments, marks)
    once = [each for name in listed for each in bounds.get(name, ())]
    inside = frozenset[int]().union(*(track.get(name, ()) for name in listed))

    def ends(mark: str, heading: Heading) -> bool:
        return heading[0] in inside and once.count(marks.element_of(mark)) == 1

    for way in ways_from(source, overlap, segments, start, ends, given):
        if all(track[name] & set(way.segments) for name in listed if track.get(name)):
            yield way


def _sections(source: Document, overlap: Element) -> list[str]:
    """The sections that an overlap lists."""
    return [source.attribute(source.referred(each), "id") for each in source.all("hasTvdSection", overlap)]


def _compare_length(
    source: Document, segments: Segments, route: Followed, overlap: Element, way: Way, findings: Findings
) -> None:
    """An overlap that is told to be longer than the way to its end is a violation.

    Where its end is told as well, by limits or sections, the two may be as far apart as one place told twice.
    """
    if overlap.get("length") is None:
        return
    name, told_mm = source.attribute(overlap, "id"), round(source.number(overlap, "length", 0.001, LONGEST_M) * 1_000)
    long_mm = _long_mm(segments, way)
    ended = bool(limits_of(source, overlap)) or source.first("hasTvdSection", overlap) is not None
    if long_mm < told_mm - (SAME_PLACE_M * 1_000 if ended else 0):
        text = (
            f"overlap '{name}' of route '{route.wanted.name}' is told to be {told_mm:,} mm long, and from its exit "
            f"'{route.wanted.exit}' to '{way.to}' there are {long_mm:,} mm: correct its length or end, or move the exit"
        )
        findings.violation(FITS, (route.wanted.name, name, way.to), text)


def _long_mm(segments: Segments, way: Way) -> int:
    return sum(segments.segments[at].long_mm for at in way.segments)


def _so_long(
    source: Document, segments: Segments, start: tuple[str, int], overlap: Element, given: Mapping[str, str]
) -> Iterator[Way]:
    """The way to the first mark that lies as far as an overlap is long; to the end of track if that comes first.

    Where several lead on from a mark before, the first two to the next one.
    """
    mark, side = start
    length_mm = round(source.number(overlap, "length", 0.001, LONGEST_M) * 1_000)
    run_mm = 0
    positions: dict[str, str] = {}
    passed: tuple[str, ...] = ()
    over: tuple[int, ...] = ()
    while True:
        ways = list(islice(ways_from(source, overlap, segments, (mark, side), lambda *_: True, given), 2))
        if len(ways) != 1:
            return iter(ways)
        (way,) = ways
        run_mm += _long_mm(segments, way)
        positions, over = {**positions, **way.positions}, (*over, *way.segments)
        mark, side = way.to, way.arrives[1]
        if run_mm >= length_mm or side not in segments.beside[mark] or len(set(over)) < len(over):
            return iter([Way(mark, way.arrives, positions, passed, over)])
        passed = (*passed, mark)
