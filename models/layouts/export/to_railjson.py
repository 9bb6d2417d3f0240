"""A layout of any format that has track, as RailJSON; what that format has no words for is told apart."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import Any

from kernel.layout import Layout
from kernel.names import Point, Route
from models.layouts.export.kinds import Fit, fit
from models.layouts.export.unsayable import Unsayable
from models.layouts.railjson import DIRECTIONS, KINDS, SIDES
from models.layouts.results import Imported
from models.layouts.told import Wanted
from models.layouts.track import Kind, Mark

Data = dict[str, Any]
VERSION = "3.4.12"
"""Of the dialect with switches, which is the older one."""
WORD_OF_SIDE = {side: word for word, side in SIDES.items()}
DIRECTION = {side: word for word, side in DIRECTIONS.items()}
MM_A_METRE = 1_000


def railjson_data(imported: Imported) -> Data:
    """The layout as RailJSON data; read again it is the same, but for :func:`left_out` and the words of its formats.

    A junction that RailJSON knows gets its words for positions; another one is told as a type of the file's own.

    Raises:
        Unsayable: it has no track plan.
    """
    station, told = imported.station, imported.told
    if station is None or told is None:
        raise Unsayable(f"an {imported.kind} has no track plan")
    own: list[Kind] = []
    fits: dict[str, Fit] = {}
    for name, junction in station.junctions.items():
        fits[name] = fit(junction.kind, KINDS) or _of_its_own(junction.kind, own)
    switches = [
        {
            "id": name,
            "switch_type": fits[name].name,
            "ports": {
                fits[name].port[port]: {"track": track, "endpoint": WORD_OF_SIDE[side]}
                for port, (track, side) in junction.ports.items()
            },
        }
        for name, junction in station.junctions.items()
    ]
    marks = list(station.marks.values())
    return {
        "version": VERSION,
        "track_sections": [{"id": name, "length": mm / MM_A_METRE} for name, mm in station.tracks.items()],
        "extended_switch_types": [_type(number, kind) for number, kind in enumerate(own)],
        "switches": switches,
        "detectors": [_mark(mark) for mark in marks if mark.cuts],
        "buffer_stops": [_mark(mark) for mark in marks if not mark.cuts],
        "routes": [_route(route, station.marks, fits, imported.layout) for route in told.routes],
    }


def left_out(imported: Imported) -> Iterator[str]:
    """What RailJSON has no words for, in words and numbers."""
    told = imported.told
    if told is None or imported.kind == "RailJSON":
        return
    for what, count in (
        ("overlaps", sum(route.overlap is not None for route in told.routes)),
        ("routes' flank points", sum(bool(route.flank) for route in told.routes)),
        ("fouling blocks", len(told.fouls)),
        ("legs' clearances", len(told.clear_mm)),
        ("pairs held by authority", len(told.held or ())),
        ("trains", len(told.trains) if imported.kind == "native" else 0),
        ("names of blocks", sum(not block.startswith("B:") for block in imported.layout.blocks)),
    ):
        if count:
            yield f"{count} {what}"


def _of_its_own(kind: Kind, own: list[Kind]) -> Fit:
    if kind not in own:
        own.append(kind)
    return Fit(_type_name(own.index(kind)), {port: port for port in kind.ports}, {at: at for at in kind.positions})


def _type_name(number: int) -> str:
    return f"type_{number + 1}"


def _type(number: int, kind: Kind) -> Data:
    groups = {at: [{"src": one, "dst": other} for one, other in ways] for at, ways in kind.positions.items()}
    return {"id": _type_name(number), "ports": list(kind.ports), "groups": groups}


def _mark(mark: Mark) -> Data:
    return {"id": mark.name, "track": mark.track, "position": mark.at_mm / MM_A_METRE}


def _route(route: Wanted, marks: Mapping[str, Mark], fits: Mapping[str, Fit], layout: Layout) -> Data:
    def end(name: str) -> Data:
        return {"type": "Detector" if marks[name].cuts else "BufferStop", "id": name}

    passed = route.positions
    if route.overlap is not None:
        before = layout.claims.get(Route(route.name), layout.blocks) - layout.overlap.get(
            Route(route.name), frozenset()
        )
        passed = {name: at for name, at in passed.items() if layout.stands_in.get(Point(name)) in before}
    return {
        "id": route.name,
        "entry_point": end(route.entry),
        "entry_point_direction": DIRECTION[route.side],
        "exit_point": end(route.exit),
        "release_detectors": list(route.release),
        "switches_directions": {name: fits[name].position.get(at, at) for name, at in passed.items()},
    }
