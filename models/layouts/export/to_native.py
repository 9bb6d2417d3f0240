"""A layout of any format that has track, as native data."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import Any

from models.layouts.blocks import find_blocks
from models.layouts.export.kinds import Fit, fit
from models.layouts.export.unsayable import Unsayable
from models.layouts.native import DIRECTIONS, KINDS, LEGS, NativeReader
from models.layouts.native_schema import FORMAT
from models.layouts.results import Imported
from models.layouts.told import Wanted
from models.layouts.track import HIGH, LOW, Kind, Mark, Station, cut_into_segments

Data = dict[str, Any]
JOINT: Mapping[str, Kind] = {"joint": Kind(("a", "b"), {"fixed": (("a", "b"),)})}
SIDES = {side: word for word, side in DIRECTIONS.items()}


def native_data(imported: Imported) -> Data:
    """The layout as native data; read again it is the same, but for the words of its formats.

    Positions of points get the native words, and track that ended without a mark gets one.

    Raises:
        Unsayable: the native format has no words for it.
    """
    station, told = imported.station, imported.told
    if station is None or told is None:
        raise Unsayable(f"an {imported.kind} has no track plan")
    writer = Writer(station)
    data: Data = {"format": FORMAT}
    if told.title is not None:
        data["name"] = told.title
    fouling = {tuple(sorted((block, other))) for block, others in told.fouls.items() for other in others}
    data |= {
        "trains": list(told.trains),
        "held_by_authority": "rest" if told.held is None else sorted(map(list, told.held)),
        "fouling": sorted(map(list, fouling)),
        "laid_at_start": sorted(told.laid_at_start),
        "longest_train_mm": told.longest_train_mm,
        "joints": writer.joints() if told.joints is None else sorted(told.joints),
        "tracks": writer.tracks(),
        "points": writer.points_told(told.clear_mm),
    }
    data["blocks"] = _named_blocks(imported, data)
    data["routes"] = {route.name: writer.route(route) for route in told.routes}
    return {key: value for key, value in data.items() if value or key in ("tracks", "routes", "held_by_authority")}


def _named_blocks(imported: Imported, data: Data) -> Data:
    """Names for the blocks that the native format would call otherwise."""
    segments = cut_into_segments(NativeReader(imported.name, data).station())
    names = {span: block for block, spans in imported.places.spans.items() for span in spans}
    found: Data = {}
    for block, piece in find_blocks(segments, {}).pieces.items():
        spans = [(each.track, each.from_mm, each.to_mm) for each in (segments.segments[at] for at in piece)]
        name = names[spans[0]]
        if name != block:
            track, from_mm, to_mm = max(spans, key=lambda span: span[2] - span[1])
            if to_mm - from_mm < 2:
                raise Unsayable(f"block '{name}' is too short to be named")
            found[name] = {"track": track, "at_mm": (from_mm + to_mm) // 2}
    return found


class Writer:
    """Tells a station's track and routes in native words."""

    def __init__(self, station: Station) -> None:
        self.station = station
        fits = {name: _fitted(name, junction.kind) for name, junction in station.junctions.items()}
        self.points = {name: found for name, found in fits.items() if found.name != "joint"}
        self.renamed: dict[str, str] = {}
        self.taken = set(station.marks)
        self.nodes = dict(self._joined())

    def _joined(self) -> Iterator[tuple[tuple[str, int], str]]:
        """The node that each joined end of track lies at: a leg, or a joint under its own name."""
        for name, junction in self.station.junctions.items():
            legs = self.points[name].port if name in self.points else None
            joint = "" if legs else self._fresh(name.removeprefix("joint "))
            for port, end in junction.ports.items():
                yield end, f"{name}.{legs[port]}" if legs else joint

    def _fresh(self, name: str) -> str:
        """A name for a node that is none of a leg, a mark or another node."""
        plain = f"{name} node" if name.rpartition(".")[2] in LEGS else name
        found, count = plain, 1
        while found in self.taken:
            count += 1
            found = f"{plain} #{count}"
        self.taken.add(found)
        return found

    def points_told(self, clear_mm: Mapping[tuple[str, str], int]) -> Data:
        """The points and crossings, each with its kind and the clearance of its legs as far as told."""
        found: Data = {name: {} if fit.name == "turnout" else {"kind": fit.name} for name, fit in self.points.items()}
        for (name, port), mm in clear_mm.items():
            found[name].setdefault("clear_mm", {})[self.points[name].port[port]] = mm
        return found

    def joints(self) -> list[str]:
        """The nodes at which two ends of track are joined."""
        junctions = {name: junction for name, junction in self.station.junctions.items() if name not in self.points}
        return sorted(self.nodes[next(iter(junction.ports.values()))] for junction in junctions.values())

    def tracks(self) -> Data:
        """Every track with the names of its ends and its boundaries."""
        nodes = dict(self.nodes)
        boundaries: dict[str, dict[str, int]] = {track: {} for track in self.station.tracks}
        for mark in self.station.marks.values():
            at_end = mark.at_mm in (0, self.station.tracks[mark.track])
            end = mark.track, LOW if mark.at_mm == 0 else HIGH
            if at_end and end not in nodes:
                leg = mark.name.rpartition(".")[2] in LEGS
                nodes[end] = self.renamed[mark.name] = self._fresh(mark.name) if leg else mark.name
            elif at_end or not mark.cuts:
                raise Unsayable(_misplaced(mark, at_end))
            else:
                boundaries[mark.track][mark.name] = mark.at_mm
        found: Data = {}
        for track, length_mm in self.station.tracks.items():
            for end, word in (((track, LOW), "begin"), ((track, HIGH), "end")):
                if end not in nodes:
                    nodes[end] = self._fresh(f"{word} of {track}")
            found[track] = {"from": nodes[track, LOW], "to": nodes[track, HIGH], "length_mm": length_mm}
            if boundaries[track]:
                found[track]["boundaries"] = boundaries[track]
        return found

    def route(self, route: Wanted) -> Data:
        """A route as stated."""
        told = {
            "points": self._positions(route.positions),
            "overlap_to": None if route.overlap is None else self.renamed.get(route.overlap, route.overlap),
            "flank": self._positions(route.flank),
            "release_at": list(route.release),
        }
        first, last = (self.renamed.get(mark, mark) for mark in (route.entry, route.exit))
        ends = {"from": first, "direction": SIDES[route.side], "to": last}
        return {**ends, **{key: value for key, value in told.items() if value}}

    def _positions(self, given: Mapping[str, str]) -> dict[str, str]:
        """Positions in the native words; one that a point has not stays as it is, and a joint has none."""
        return {name: self.points[name].position.get(at, at) for name, at in given.items() if name in self.points}


def _fitted(name: str, kind: Kind) -> Fit:
    found = fit(kind, JOINT) or fit(kind, KINDS)
    if found is None:
        raise Unsayable(f"'{name}' joins {len(kind.ports)} ends of track in {len(kind.positions)} positions")
    return found


def _misplaced(mark: Mark, at_end: bool) -> str:
    what = "boundary" if mark.cuts else "buffer stop"
    where = "where another track begins" if at_end else "with track behind it"
    return f"{what} '{mark.name}' lies {where}, on track '{mark.track}' at {mark.at_mm} mm"
