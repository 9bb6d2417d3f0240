"""RailJSON: the format of track, switches, detectors and routes of the OSRD project.

Two dialects are read, told apart by their fields: ``switches`` with ``switches_directions``, and
the later ``track_nodes`` with ``track_nodes_directions``.  Positions are metres in the file.
"""

from __future__ import annotations

from collections.abc import Collection, Mapping
from typing import Any

from jsonschema import Draft202012Validator

from models.layouts.alike import read
from models.layouts.assemble import assemble
from models.layouts.blocks import find_blocks
from models.layouts.findings import Findings
from models.layouts.following import Follower
from models.layouts.numbers import LONGEST_DISTANCE_MM
from models.layouts.reading import by_name, identifier, validate
from models.layouts.results import BadInput, Imported
from models.layouts.told import Told, Wanted
from models.layouts.track import HIGH, LOW, Junction, Kind, Mark, Station, cut_into_segments

KINDS: Mapping[str, Kind] = {
    "link": Kind(("A", "B"), {"STATIC": (("A", "B"),)}),
    "point_switch": Kind(("A", "B1", "B2"), {"A_B1": (("A", "B1"),), "A_B2": (("A", "B2"),)}),
    "crossing": Kind(("A1", "B1", "A2", "B2"), {"STATIC": (("A1", "B1"), ("A2", "B2"))}),
    "single_slip_switch": Kind(
        ("A1", "B1", "A2", "B2"), {"STATIC": (("A1", "B1"), ("A2", "B2")), "A1_B2": (("A1", "B2"),)}
    ),
    "double_slip_switch": Kind(
        ("A1", "B1", "A2", "B2"),
        {
            "A1_B1": (("A1", "B1"),),
            "A1_B2": (("A1", "B2"),),
            "A2_B1": (("A2", "B1"),),
            "A2_B2": (("A2", "B2"),),
        },
    ),
}
SIDES = {"BEGIN": LOW, "END": HIGH}
DIRECTIONS = {"STOP_TO_START": LOW, "START_TO_STOP": HIGH}

_TEXT = {"type": "string"}
_NUMBER = {"type": "number"}
_TEXTS = {"type": "object", "additionalProperties": _TEXT}


def _object(**fields: object) -> dict[str, object]:
    return {"type": "object", "required": list(fields), "properties": fields}


def _list(item: object) -> dict[str, object]:
    return {"type": "array", "items": item}


def _schema(switches: str, switch_type: str, directions: str, extended: str) -> dict[str, Any]:
    """The schema of one dialect: only what is read, and all of that."""
    mark = _object(id=_TEXT, track=_TEXT, position=_NUMBER)
    port = _object(track=_TEXT, endpoint={"enum": list(SIDES)})
    passage = _object(src=_TEXT, dst=_TEXT)
    switch = _object(id=_TEXT, ports={"type": "object", "additionalProperties": port}, **{switch_type: _TEXT})
    end = _object(type={"enum": ["Detector", "BufferStop"]}, id=_TEXT)
    route = _object(
        id=_TEXT,
        entry_point=end,
        exit_point=end,
        entry_point_direction={"enum": list(DIRECTIONS)},
        release_detectors=_list(_TEXT),
        **{directions: _TEXTS},
    )
    kind = _object(id=_TEXT, ports=_list(_TEXT), groups={"type": "object", "additionalProperties": _list(passage)})
    whole: dict[str, Any] = _object(
        track_sections=_list(_object(id=_TEXT, length=_NUMBER)),
        detectors=_list(mark),
        buffer_stops=_list(mark),
        routes=_list(route),
        **{switches: _list(switch)},
    )
    whole["properties"][extended] = _list(kind)
    return whole


class Dialect:
    """The field names of one version of the format."""

    def __init__(self, switch: str, plural: str) -> None:
        self.switches, self.switch_type = plural, f"{switch}_type"
        self.directions, self.extended = f"{plural}_directions", f"extended_{switch}_types"
        schema = _schema(self.switches, self.switch_type, self.directions, self.extended)
        self.validator = Draft202012Validator(schema)
        self.fields = {
            listed: set(of["items"]["properties"])
            for listed, of in schema["properties"].items()
            if listed != self.extended
        }
        """List -> the fields of its items that are read."""


SWITCHES = Dialect("switch", "switches")
TRACK_NODES = Dialect("track_node", "track_nodes")


def import_railjson(file: str, data: Any, trains: tuple[str, ...]) -> Imported:
    """The layout in RailJSON data.

    :raises BadInput: the data is no layout, refers to what is not there, or has no routes.
    """
    dialect = TRACK_NODES if isinstance(data, dict) and "track_nodes" in data else SWITCHES
    validate(file, data, dialect.validator)
    reader = Reader(file, data, dialect)
    station = reader.station()
    routes = tuple(reader.routes(station))
    findings = Findings("switch")
    say_what_is_not_read(data, dialect, findings)
    blocks = find_blocks(cut_into_segments(station), {})
    follower = Follower(blocks, file, findings)
    paths = [path for route in routes if (path := follower.follow(route)) is not None]
    return assemble(blocks, paths, Told(file, "RailJSON", trains, routes), findings)


def say_what_is_not_read(data: Mapping[str, Any], dialect: Dialect, findings: Findings) -> None:
    """A remark for what else the file lists, and for each field of what is read that is not and may matter."""
    read = {dialect.switches, dialect.extended, "track_sections", "detectors", "buffer_stops", "routes"}
    for listed in sorted(set(data) - read - WITHOUT_EFFECT):
        items = data[listed]
        ids = [each.get("id") if isinstance(each, dict) else None for each in items] if isinstance(items, list) else []
        names = [f"{listed}[{at}]" if name is None else str(name) for at, name in enumerate(ids)]
        if items:
            names = names or [listed]
            findings.remark(names, f"{len(names)} of {listed} are not read: no route knows of them", "unread")

    for listed, known in dialect.fields.items():
        told: dict[str, list[str]] = {}
        for item in data[listed]:
            for field in sorted(field for field in set(item) - known - DRAWN if item[field]):
                told.setdefault(field, []).append(item["id"])
        for field, named in sorted(told.items()):
            text = f"{field} of {len(named)} of {listed} are not read: whatever they ask of trains, no route does"
            findings.remark(named, text, "unread")


DRAWN = frozenset(("name", "geo", "sch", "extensions", "group_change_delay"))
"""Of an item, what it is called, how it is drawn, and how long a point moves, as its contacts prove."""
WITHOUT_EFFECT = frozenset(
    ("version", "operational_points", "signals", "electrifications", "neutral_sections", "catenaries", "dead_sections")
)
"""What keeps no two trains apart here: names, traction, and signals, since routes begin and end at detectors."""


class Reader:
    """Turns validated RailJSON into a station and its routes, resolving every reference."""

    def __init__(self, file: str, data: Mapping[str, Any], dialect: Dialect) -> None:
        self.file = file
        self.data = data
        self.dialect = dialect

    def bad(self, place: str, what: str, what_to_do: str) -> BadInput:
        """The error for this file."""
        return BadInput(self.file, place, what, what_to_do)

    def station(self) -> Station:
        """Track, switches, detectors and buffer stops."""
        tracks = {
            name: self._length_mm(f"track_sections '{name}'", item["length"])
            for name, item in by_name(self.file, "track_sections", self.data["track_sections"]).items()
        }
        kinds = {**KINDS, **self._extended()}
        junctions: dict[str, Junction] = {}
        taken: dict[tuple[str, int], str] = {}
        for name, item in by_name(self.file, self.dialect.switches, self.data[self.dialect.switches]).items():
            junctions[name] = self._junction(name, item, kinds, tracks)
            for port, end in junctions[name].ports.items():
                if end in taken:
                    what = f"port {port}: this end of track '{end[0]}' is already at switch '{taken[end]}'"
                    raise self.bad(f"{self.dialect.switches} '{name}'", what, "join each end of track once")
                taken[end] = name
        return Station(tracks, junctions, self._marks(tracks))

    def _length_mm(self, place: str, length_m: float) -> int:
        """A track's length in mm."""
        if not 0.001 <= length_m <= LONGEST_DISTANCE_MM / 1000:
            what = f"length {length_m!r:.40} m is out of range"
            raise self.bad(place, what, f"give 0.001 to {LONGEST_DISTANCE_MM / 1000} m (a tag's 28 bits in mm)")
        return round(length_m * 1000)

    def _extended(self) -> dict[str, Kind]:
        """Kinds of switch that the file defines itself."""
        found: dict[str, Kind] = {}
        for name, item in by_name(self.file, self.dialect.extended, self.data.get(self.dialect.extended, [])).items():
            place = f"{self.dialect.extended} '{name}'"
            if name in KINDS:
                raise self.bad(place, "has the id of a type that every file has", "give it another id")
            self._told_apart(place, "ports", item["ports"])
            self._told_apart(place, "groups", item["groups"])
            for group, passages in item["groups"].items():
                used = [port for passage in passages for port in (passage["src"], passage["dst"])]
                if not set(used) <= set(item["ports"]) or len(used) != len(set(used)):
                    raise self.bad(place, f"group '{group}' names a port it has not, or one twice", "correct the group")
            if not item["groups"]:
                raise self.bad(place, "has no groups", "give the connections of its ports")
            if len(set(item["ports"])) < 2:
                raise self.bad(place, "has fewer than two ports: nothing runs over it", "give the ports that it joins")
            joined = {way[end] for ways in item["groups"].values() for way in ways for end in ("src", "dst")}
            idle = sorted(set(item["ports"]) - joined)
            if idle:
                what = f"port '{idle[0]}' is in no group: no position leads there"
                raise self.bad(place, what, "add the group, or take the port away")
            groups = {group: tuple((p["src"], p["dst"]) for p in ways) for group, ways in item["groups"].items()}
            found[name] = Kind(tuple(item["ports"]), groups)
        return found

    def _told_apart(self, place: str, what: str, names: Collection[str]) -> None:
        """Refuse names of one type's ports or groups that are read alike: a switch would lie in either for both."""
        by_read: dict[str, str] = {}
        for name in names:
            other = by_read.setdefault(read(identifier(self.file, f"{place} {what}", name)), name)
            if other != name:
                raise self.bad(place, f"{what} {other!a} and {name!a} read alike", "rename one of the two")

    def _junction(
        self, name: str, item: Mapping[str, Any], kinds: Mapping[str, Kind], tracks: Mapping[str, int]
    ) -> Junction:
        """One switch, with every port at an end of a known track."""
        place = f"{self.dialect.switches} '{name}'"
        kind = kinds.get(item[self.dialect.switch_type])
        if kind is None:
            what = f"{self.dialect.switch_type} '{item[self.dialect.switch_type]}' is unknown"
            raise self.bad(place, what, f"use one of {', '.join(kinds)}")
        for port in kind.ports:
            if port not in item["ports"]:
                raise self.bad(place, f"has no port {port}", "give the track end that meets it")
        for port, end in item["ports"].items():
            if port not in kind.ports:
                known = ", ".join(kind.ports)
                raise self.bad(place, f"has a port {port} that its type has not", f"its ports are {known}")
            self._known(f"{place} port {port}", "track section", end["track"], tracks)
        return Junction(name, kind, {p: (end["track"], SIDES[end["endpoint"]]) for p, end in item["ports"].items()})

    def _known(self, place: str, what: str, name: str, known: Mapping[str, object]) -> None:
        if name not in known:
            raise self.bad(place, f"there is no {what} '{name}'", "correct the reference or add what it names")

    def _marks(self, tracks: Mapping[str, int]) -> dict[str, Mark]:
        """Detectors and buffer stops, each on a track and none at the place of another."""
        marks: dict[str, Mark] = {}
        at: dict[tuple[str, int], str] = {}
        for listed, cuts in (("detectors", True), ("buffer_stops", False)):
            for name, item in by_name(self.file, listed, self.data[listed]).items():
                place = f"{listed} '{name}'"
                self._known(place, "track section", item["track"], tracks)
                if name in marks:
                    raise self.bad(place, "has the id of a detector", "rename one of the two")
                mark = Mark(name, item["track"], self._position_mm(place, item, tracks[item["track"]]), cuts)
                other = at.setdefault((mark.track, mark.at_mm), name)
                if other != name:
                    what = f"lies at the same place as '{other}' (track '{mark.track}', {mark.at_mm} mm)"
                    raise self.bad(place, what, "move or remove one of the two")
                marks[name] = mark
        return marks

    def _position_mm(self, place: str, item: Mapping[str, Any], length_mm: int) -> int:
        """A position on a track in mm."""
        position_m: float = item["position"]
        if not 0 <= position_m <= length_mm / 1000:
            what = f"position {position_m!r:.40} m is not on track '{item['track']}' (0 to {length_mm / 1000} m)"
            raise self.bad(place, what, "give metres from the track's beginning")
        return min(round(position_m * 1000), length_mm)

    def routes(self, station: Station) -> list[Wanted]:
        """The routes, with every reference known."""
        routes = by_name(self.file, "routes", self.data["routes"])
        if not routes:
            raise self.bad("routes", "has no routes: nothing to check", "give the routes of the layout")
        return [self._route(name, item, station) for name, item in routes.items()]

    def _route(self, name: str, item: Mapping[str, Any], station: Station) -> Wanted:
        place = f"routes '{name}'"
        for field in ("entry_point", "exit_point"):
            end = item[field]
            cuts = end["type"] == "Detector"
            if end["id"] not in station.marks or station.marks[end["id"]].cuts != cuts:
                self._known(f"{place} {field}", "detector" if cuts else "buffer stop", end["id"], {})
        for detector in item["release_detectors"]:
            if detector not in station.marks or not station.marks[detector].cuts:
                self._known(f"{place} release_detectors", "detector", detector, {})
        for switch in item[self.dialect.directions]:
            self._known(f"{place} {self.dialect.directions}", "switch", switch, station.junctions)
        return Wanted(
            name=identifier(self.file, place, name),
            place=place,
            entry=item["entry_point"]["id"],
            side=DIRECTIONS[item["entry_point_direction"]],
            exit=item["exit_point"]["id"],
            positions=item[self.dialect.directions],
            release=tuple(item["release_detectors"]),
        )
