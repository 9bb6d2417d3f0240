"""What a verdict rests on beside the axioms: what a file declares on its own word, and what was taken in its stead.

An axiom that names authority, or a position that nobody stated, is true of the layout as imported.  Whether it is true
of the railway nobody has looked at; so every verdict carries it, and ``--strict`` accepts only what is declared.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence

from kernel.layout import Layout
from kernel.names import Route
from models.layouts.measures import CLEARANCE_MM
from models.layouts.results import Imported, Rest, RestKind
from models.layouts.track import HIGH, LOW

Instances = Sequence[tuple[str, ...]]

WORDS: Mapping[RestKind, str] = {
    "authority": "pairs of blocks (from, into) kept apart by train protection alone",
    "clearance": "legs of points that no clearance is known of",
    "start": "points in start blocks, before the system first starts laid for the track that a train there stands on",
    "joint": "joints of track made by one name at two ends alone",
    "end": "ends of track that nothing is joined to and no buffer stop, border or open end is told of",
    "position": "points held in a position that nobody states",
    "derived": "routes, lengths or choices that the file does not tell and the import made",
    "unread": "elements of the file that are not read",
    "left out": "routes left out",
}


def rests_of(imported: Imported) -> tuple[Rest, ...]:
    """Everything that a verdict on a layout rests on, kind by kind; kinds of which there is nothing are left out."""
    told = imported.told
    listed = told is not None and told.held is not None
    laid, at_start = told.laid_at_start if told is not None else (), _laid_at_start(imported.layout)
    found: list[tuple[RestKind, bool, Instances]] = [
        ("authority", listed, _held(imported)),
        ("clearance", True, [(leg.point, leg.leg) for leg in imported.legs if _matters(leg.boundary, leg.clear_mm)]),
        ("clearance", False, _not_known(imported)),
        ("start", True, [each for each in at_start if each[0] in laid]),
        ("start", False, [each for each in at_start if each[0] not in laid]),
        ("joint", False, _by_name(imported)),
        ("end", False, list(_open_ends(imported))),
        ("position", False, list(_unstated(imported))),
        ("derived", False, _remarked(imported, "derived")),
        ("unread", False, _remarked(imported, "unread")),
        ("left out", False, _left_out(imported)),
    ]
    counted = (
        Rest(kind, declared, tuple(instances), _text(kind, declared, instances))
        for kind, declared, instances in found
        if instances
    )
    return (*counted, *_loop(imported))


def _text(kind: RestKind, declared: bool, instances: Instances) -> str:
    said = WORDS[kind].replace("no clearance is known of", "have their clearance told") if declared else WORDS[kind]
    by = ", as the file declares" if declared else ""
    return f"{len(instances):,} {said}{by}"


def _matters(boundary: str | None, clear_mm: int | None) -> bool:
    return boundary is not None and clear_mm is not None


def _held(imported: Imported) -> Instances:
    """The pairs that only a train's own protection keeps apart."""
    held = imported.ground.held_by_authority
    return [(block, target) for block in sorted(held) for target in sorted(held[block])]


def _not_known(imported: Imported) -> Instances:
    """The legs that end at a boundary and of which no clearance is told; where there is no track, the points."""
    if imported.station is None:
        return [(point,) for point in sorted(imported.layout.points)]
    return [
        (leg.point, leg.leg, leg.boundary) for leg in imported.legs if leg.boundary is not None and leg.clear_mm is None
    ]


def _laid_at_start(layout: Layout) -> Instances:
    """The points that a route needs in its start block: a train that stands there on another leg would be let go.

    The centre is told of blocks; in running no point below a train moves, before the first start staff lays it.
    """
    found = {
        (str(point), str(start))
        for route, start in layout.start.items()
        for point in layout.needs[route]
        if layout.stands_in[point] == start
    }
    return sorted(found)


def _loop(imported: Imported) -> Iterator[Rest]:
    """That no train is as long as the shortest loop; declared where the file tells how long its longest train is."""
    loop, told = imported.loop, imported.told
    if loop is None:
        return
    longest_mm = told.longest_train_mm if told is not None else None
    declared = longest_mm is not None and longest_mm < loop.long_mm and not loop.not_told
    way = "the shortest way of a train back to its rear, or foul of it, that no point bars"
    if not loop.blocks:
        way = "beyond which no way of a train back to its rear was looked for"
    text = f"trains shorter than {loop.long_mm / 1_000:,.3f} m, {way}{', as the file declares' if declared else ''}"
    legs = [f"'{leg}' of '{point}'" for point, leg in loop.not_told]
    if legs:
        text += f": of {', '.join(legs)} no clearance is told, {CLEARANCE_MM / 1_000:,.0f} m are taken"
    yield Rest("loop", declared, ((*loop.blocks, *map(" ".join, loop.not_told), f"{loop.long_mm} mm"),), text)


def _by_name(imported: Imported) -> Instances:
    """The joints that two ends of track make by having one name, in a file that lists no joints."""
    station, told = imported.station, imported.told
    if station is None or told is None or told.joints is None:
        return []
    names = (junction for junction in station.junctions.values() if len(junction.ports) == 2)
    return [
        (junction.name.removeprefix("joint "), *sorted(track for track, _ in junction.ports.values()))
        for junction in names
        if junction.name.removeprefix("joint ") not in told.joints
    ]


def _open_ends(imported: Imported) -> Iterator[tuple[str, ...]]:
    """The ends of track, by track and place, that the file neither joins to others nor says to be ends."""
    station = imported.station
    if station is None:
        return
    closed = {(mark.track, mark.at_mm) for mark in station.marks.values() if not mark.cuts}
    for track, length_mm in station.tracks.items():
        for side, at_mm in ((LOW, 0), (HIGH, length_mm)):
            if (track, side) not in station.joined and (track, at_mm) not in closed:
                yield track, f"{at_mm} mm"


def _unstated(imported: Imported) -> Iterator[tuple[str, ...]]:
    """The points in a route's blocks that keep nothing off its path, and of which its file states no position."""
    for wanted in imported.told.routes if imported.told is not None else ():
        for point, role in sorted(imported.beside.get(Route(wanted.name), {}).items()):
            if role == "spare" and point not in wanted.positions and point not in wanted.flank:
                yield str(point), wanted.name


def _remarked(imported: Imported, kind: RestKind) -> Instances:
    """What remarks say a verdict rests on, element by element."""
    named = [remark.elements or ("?",) for remark in imported.remarks if remark.rests == kind]
    return [(element,) for elements in named for element in elements]


def _left_out(imported: Imported) -> Instances:
    """The routes that the file states and the layout has not."""
    routes = imported.told.routes if imported.told is not None else ()
    return [(wanted.name,) for wanted in routes if Route(wanted.name) not in imported.layout.routes]
