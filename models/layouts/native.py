"""The native layout format: TOML written by hand; ``layouts/README.md`` describes it."""

from __future__ import annotations

from collections.abc import Collection, Mapping
from typing import Any

from kernel.names import Block
from models.layouts.alike import read
from models.layouts.assemble import assemble
from models.layouts.blocks import Blocks, find_blocks
from models.layouts.findings import Findings
from models.layouts.following import Follower
from models.layouts.native_schema import VALIDATOR
from models.layouts.reading import identifier, validate
from models.layouts.results import BadInput, Imported
from models.layouts.told import Told, Wanted
from models.layouts.track import HIGH, LOW, Junction, Kind, Mark, Segments, Station, cut_into_segments

SLIP_LEGS = ("a1", "b1", "a2", "b2")
KINDS: Mapping[str, Kind] = {
    "turnout": Kind(("tip", "normal", "reverse"), {"normal": (("tip", "normal"),), "reverse": (("tip", "reverse"),)}),
    "crossing": Kind(SLIP_LEGS, {"fixed": (("a1", "b1"), ("a2", "b2"))}),
    "single slip": Kind(SLIP_LEGS, {"straight": (("a1", "b1"), ("a2", "b2")), "a1-b2": (("a1", "b2"),)}),
    "double slip": Kind(
        SLIP_LEGS,
        {f"{a}-{b}": ((a, b),) for a in ("a1", "a2") for b in ("b1", "b2")},
    ),
}
LEGS = frozenset(leg for kind in KINDS.values() for leg in kind.ports)
JOINTS = "two ends of track meet at each joint"
DIRECTIONS = {"backward": LOW, "forward": HIGH}


def import_native(file: str, data: Any, trains: tuple[str, ...]) -> Imported:
    """The layout in native data; its own fleet goes before ``trains``.

    :raises BadInput: the data is no layout, refers to what is not there, or has no routes.
    """
    validate(file, data, VALIDATOR)
    for train in data.get("trains", ()):
        identifier(file, "trains", train)
    reader = NativeReader(file, data)
    station = reader.station()
    segments = cut_into_segments(station)
    names = reader.block_names(segments)
    blocks = find_blocks(segments, names)
    for segment, block_name in names.items():
        if blocks.of[segment] != block_name:
            what = f"names the block that is '{blocks.of[segment]}' already: no boundary lies between them"
            raise BadInput(file, f"blocks.{block_name}", what, "name each block once")
    findings = Findings("point")
    follower = Follower(blocks, file, findings)
    routes = tuple(reader.routes(station))
    paths = [path for wanted in routes if (path := follower.follow(wanted)) is not None]
    fleet, fouls = tuple(data.get("trains", trains)), reader.fouling(blocks)
    reader.compare_joints(station, findings)
    joints = frozenset(data.get("joints", ()))
    told = Told(
        *(file, "native", fleet, routes, fouls, reader.held(blocks), data.get("name"), reader.clear_mm(station)),
        joints=joints,
        laid_at_start=reader.laid_at_start(),
        longest_train_mm=data.get("longest_train_mm"),
    )
    return assemble(blocks, paths, told, findings)


class NativeReader:
    """Turns validated native data into a station and its routes, resolving every reference."""

    def __init__(self, file: str, data: Mapping[str, Any]) -> None:
        self.file = file
        self.data = data

    def bad(self, place: str, what: str, what_to_do: str) -> BadInput:
        """The error for this file."""
        return BadInput(self.file, place, what, what_to_do)

    def station(self) -> Station:
        """Track, points, boundaries and ends of track."""
        tracks = {self._name("tracks", name): int(track["length_mm"]) for name, track in self.data["tracks"].items()}
        points = self.data.get("points", {})
        kinds = {self._name("points", name): KINDS[p.get("kind", "turnout")] for name, p in points.items()}
        nodes: dict[str, list[tuple[str, int]]] = {}
        for name, track in self.data["tracks"].items():
            nodes.setdefault(track["from"], []).append((name, LOW))
            nodes.setdefault(track["to"], []).append((name, HIGH))
        legs: dict[str, dict[str, tuple[str, int]]] = {point: {} for point in kinds}
        junctions: dict[str, Junction] = {}
        marks = self._boundaries()
        for node, ends in nodes.items():
            point, _, leg = node.rpartition(".")
            if point in kinds:
                legs[point][leg] = self._leg(point, leg, kinds[point], ends)
            elif leg in LEGS:
                raise self.bad(f"tracks.{ends[0][0]}", f"there is no point '{point}'", "add it under points")
            else:
                self._plain_node(node, ends, tracks, junctions, marks)
        for point, kind in kinds.items():
            if point in junctions:
                raise self.bad(f"points.{point}", f"a node where two tracks join has the name '{point}'", "rename it")
            for leg in kind.ports:
                if leg not in legs[point]:
                    what = f"leg '{leg}' meets no track"
                    raise self.bad(f"points.{point}", what, f"let a track begin or end at '{point}.{leg}'")
            junctions[point] = Junction(point, kind, legs[point])
        return Station(tracks, junctions, marks)

    def _name(self, table: str, name: str) -> str:
        return identifier(self.file, f"{table}.{name}", name)

    def _leg(self, point: str, leg: str, kind: Kind, ends: list[tuple[str, int]]) -> tuple[str, int]:
        """The one track end at a point's leg."""
        if leg not in kind.ports:
            raise self.bad(f"points.{point}", f"has no leg '{leg}'", f"its legs are {', '.join(kind.ports)}")
        if len(ends) > 1:
            met = " and ".join(f"'{track}'" for track, _ in ends)
            raise self.bad(f"points.{point}", f"leg '{leg}' meets tracks {met}", "let one track end there")
        return ends[0]

    def _plain_node(
        self,
        node: str,
        ends: list[tuple[str, int]],
        tracks: Mapping[str, int],
        junctions: dict[str, Junction],
        marks: dict[str, Mark],
    ) -> None:
        """A node that is no leg: where two tracks meet it is a joint, where one ends it is an end of track."""
        place = f"tracks.{ends[0][0]}"
        name = self._name("tracks", node)
        if len(ends) > 2:
            met = ", ".join(f"'{track}'" for track, _ in ends)
            raise self.bad(place, f"node '{node}' joins {len(ends)} ends of track ({met})", "use a point to join three")
        if len(ends) == 2:
            joint = Kind(("a", "b"), {"fixed": (("a", "b"),)})
            junctions[f"joint {node}"] = Junction(f"joint {node}", joint, {"a": ends[0], "b": ends[1]})
            return
        (track, side) = ends[0]
        if name in marks:
            raise self.bad(place, f"end of track '{node}' has the name of a boundary", "rename one of the two")
        marks[name] = Mark(name, track, tracks[track] if side == HIGH else 0, cuts=False)

    def compare_joints(self, station: Station, findings: Findings) -> None:
        """Hold the joints that are listed, if any are, against the names at which two ends of track meet.

        An end of track whose name is read like that of another end, or of a joint, was to be joined there.
        """
        points = self.data.get("points", {})
        made = {name.removeprefix("joint ") for name in station.junctions if name not in points}
        ends = {name for name, mark in station.marks.items() if not mark.cuts}
        by_read: dict[str, list[str]] = {}
        for name in sorted(made | ends):
            by_read.setdefault(read(name), []).append(name)
        for alike in by_read.values():
            if len(alike) > 1 and not ends.isdisjoint(alike):
                names = " and ".join(f"'{name}'" for name in alike)
                findings.violation(JOINTS, alike, f"track ends at {names}, which read alike: is it one joint?")
        if "joints" not in self.data:
            return
        listed = set(self.data["joints"])
        for name in sorted(made - listed):
            findings.violation(JOINTS, (name,), f"two ends of track are called '{name}', which is no listed joint")
        for name in sorted(listed - made):
            findings.violation(JOINTS, (name,), f"no two ends of track meet at the listed joint '{name}'")

    def clear_mm(self, station: Station) -> dict[tuple[str, str], int]:
        """For each leg whose clearance is given, that."""
        found: dict[tuple[str, str], int] = {}
        for point, entry in self.data.get("points", {}).items():
            for leg, clear_mm in entry.get("clear_mm", {}).items():
                self._known(f"points.{point}.clear_mm", "leg", leg, station.junctions[point].kind.ports)
                found[point, leg] = int(clear_mm)
        return found

    def laid_at_start(self) -> frozenset[str]:
        """The points that staff lay before the first start, where a train stands at them."""
        known = self.data.get("points", {})
        return frozenset(
            self._known("laid_at_start", "point", point, known) for point in self.data.get("laid_at_start", ())
        )

    def _boundaries(self) -> dict[str, Mark]:
        """The boundaries on all tracks."""
        marks: dict[str, Mark] = {}
        for track, entries in self.data["tracks"].items():
            taken: dict[int, str] = {}
            for name, at_mm in entries.get("boundaries", {}).items():
                place = f"tracks.{track}.boundaries.{name}"
                identifier(self.file, place, name)
                if name in marks:
                    raise self.bad(place, f"boundary '{name}' is also on track '{marks[name].track}'", "rename one")
                if not 0 < at_mm < entries["length_mm"]:
                    what = f"{at_mm} mm is not within the track (0 to {entries['length_mm']} mm, ends excluded)"
                    raise self.bad(place, what, "move the boundary")
                if at_mm in taken:
                    raise self.bad(place, f"lies at the same place as '{taken[at_mm]}'", "move one of the two")
                taken[at_mm] = name
                marks[name] = Mark(name, track, int(at_mm), cuts=True)
        return marks

    def block_names(self, segments: Segments) -> dict[int, str]:
        """The names given to blocks, by a segment of each."""
        given: dict[int, str] = {}
        for name, place in self.data.get("blocks", {}).items():
            self._name("blocks", name)
            self._known(f"blocks.{name}", "track", place["track"], segments.station.tracks)
            first, last = segments.leaving[place["track"], LOW][0], segments.leaving[place["track"], HIGH][0]
            inside = [
                index
                for index in range(first, last + 1)
                if segments.segments[index].from_mm <= place["at_mm"] <= segments.segments[index].to_mm
            ]
            if len(inside) != 1:
                where = "is at a boundary" if inside else "is beyond the end of the track"
                raise self.bad(f"blocks.{name}", f"{place['at_mm']} mm {where}", "give a place inside the block")
            if inside[0] in given:
                what = f"names the block that is '{given[inside[0]]}' already: no boundary lies between them"
                raise self.bad(f"blocks.{name}", what, "name each block once")
            given[inside[0]] = name
        return given

    def _known(self, place: str, what: str, name: str, known: Collection[str]) -> str:
        if name not in known:
            raise self.bad(place, f"there is no {what} '{name}'", "correct the name or add what it names")
        return name

    def routes(self, station: Station) -> list[Wanted]:
        """The routes, with every reference known."""
        if not self.data["routes"]:
            raise self.bad("routes", "has no routes: nothing to check", "give the routes of the layout")
        return [self._route(name, route, station) for name, route in self.data["routes"].items()]

    def _route(self, name: str, route: Mapping[str, Any], station: Station) -> Wanted:
        place = f"routes.{name}"
        for field in ("from", "to", "overlap_to"):
            if field in route:
                self._known(f"{place}.{field}", "boundary or end of track", route[field], station.marks)
        for boundary in route.get("release_at", []):
            if boundary not in station.marks or not station.marks[boundary].cuts:
                self._known(f"{place}.release_at", "boundary", boundary, ())
        for field in ("points", "flank"):
            for point, position in route.get(field, {}).items():
                self._known(f"{place}.{field}", "point", point, self.data.get("points", {}))
                if field == "flank":
                    known = station.junctions[point].kind.positions
                    self._known(f"{place}.flank.{point}", f"position (of {', '.join(known)})", position, known)
        return Wanted(
            name=self._name("routes", name),
            place=place,
            entry=route["from"],
            side=DIRECTIONS[route["direction"]],
            exit=route["to"],
            positions=route.get("points", {}),
            release=tuple(route.get("release_at", [])),
            overlap=route.get("overlap_to"),
            flank=route.get("flank", {}),
        )

    def _pairs(self, field: str, blocks: Blocks) -> list[tuple[Block, Block]]:
        """Pairs of known blocks."""
        found: list[tuple[Block, Block]] = []
        for index, (first, second) in enumerate(self.data.get(field, [])):
            for name in (first, second):
                self._known(f"{field}[{index}]", "block", name, blocks.pieces)
                if name in blocks.alike:
                    what = f"'{name}' is made of the names of boundaries, and so is that of another block"
                    raise self.bad(f"{field}[{index}]", what, "give the block a name of its own under blocks")
            found.append((Block(first), Block(second)))
        return found

    def fouling(self, blocks: Blocks) -> dict[Block, frozenset[Block]]:
        """The blocks that a train in each block also obstructs, both ways."""
        found: dict[Block, frozenset[Block]] = {}
        for first, second in self._pairs("fouling", blocks):
            for block, other in ((first, second), (second, first)):
                found[block] = found.get(block, frozenset()) | {other}
        return found

    def held(self, blocks: Blocks) -> frozenset[tuple[Block, Block]] | None:
        """The pairs that train protection alone keeps apart; none for 'rest'."""
        if self.data.get("held_by_authority") == "rest":
            return None
        return frozenset(self._pairs("held_by_authority", blocks))
