"""RailJSON read with ``json`` alone, and its routes walked over the tracks of the file."""

from __future__ import annotations

import json
from dataclasses import dataclass, field
from decimal import Decimal
from pathlib import Path
from typing import Any

from tests.independent.raw_graph import (
    Closed,
    Cut,
    Event,
    Finding,
    Joins,
    Junction,
    Network,
    Over,
    Place,
    Ring,
    Route,
    Stop,
    bent_back,
    led_astray,
    released,
)
from tests.independent.raw_points import lay_points, named_beside

BUILT_IN: dict[str, Joins] = {
    "link": {"STATIC": (("A", "B"),)},
    "point_switch": {"A_B1": (("A", "B1"),), "A_B2": (("A", "B2"),)},
    "crossing": {"STATIC": (("A1", "B1"), ("A2", "B2"))},
    "single_slip_switch": {"STATIC": (("A1", "B1"), ("A2", "B2")), "A1_B2": (("A1", "B2"),)},
    "double_slip_switch": {
        "A1_B1": (("A1", "B1"),),
        "A1_B2": (("A1", "B2"),),
        "A2_B1": (("A2", "B1"),),
        "A2_B2": (("A2", "B2"),),
    },
}
"""Switch type -> group -> the ports that it joins."""


@dataclass
class Enumerated:
    """What the walk over one file finds."""

    network: Network
    routes: dict[str, Route] = field(default_factory=dict)
    violations: list[Finding] = field(default_factory=list)
    remarks: list[Finding] = field(default_factory=list)


def mm(metres: Any) -> int:
    """Metres as the file writes them, in whole mm."""
    return round(Decimal(str(metres)) * 1000)


def enumerate_file(path: Path) -> Enumerated:
    return enumerate_data(json.loads(path.read_text(encoding="utf-8")))


def enumerate_data(data: dict[str, Any]) -> Enumerated:
    found = Enumerated(network_of(data))
    for row in data["routes"]:
        _Walk(found, row).take()
    found.violations += bent_back(found.network)
    return found


def broken(data: dict[str, Any]) -> str | None:
    """A type of switch that has the id of a built-in one, or a port that it joins in no position."""
    for kind in data.get("extended_switch_types", []):
        joined = {pair[end] for pairs in kind["groups"].values() for pair in pairs for end in ("src", "dst")}
        if kind["id"] in BUILT_IN or set(kind["ports"]) - joined:
            return f"{kind['id']}: no type"
    return None


def network_of(data: dict[str, Any]) -> Network:
    """Tracks, detectors, buffer stops and switches of the file."""
    lengths = {track["id"]: mm(track["length"]) for track in data["track_sections"]}
    cuts: dict[str, list[tuple[int, str]]] = {}
    for detector in data["detectors"]:
        cuts.setdefault(detector["track"], []).append((mm(detector["position"]), detector["id"]))
    stops = {}
    for stop in data["buffer_stops"]:
        at = mm(stop["position"])
        if at not in (0, lengths[stop["track"]]):
            raise NotImplementedError(f"buffer stop {stop['id']} not at an end of its track")
        stops[stop["track"], 0 if at == 0 else 1] = stop["id"]
    types = dict(BUILT_IN)
    for kind in data.get("extended_switch_types", []) + data.get("extended_track_node_types", []):
        types[kind["id"]] = {
            group: tuple((pair["src"], pair["dst"]) for pair in pairs) for group, pairs in kind["groups"].items()
        }
    junctions = {}
    for switch in data.get("switches", []) + data.get("track_nodes", []):
        joins = types[switch.get("switch_type") or switch["track_node_type"]]
        legs = {port: (end["track"], {"BEGIN": 0, "END": 1}[end["endpoint"]]) for port, end in switch["ports"].items()}
        junctions[switch["id"]] = Junction(switch["id"], legs, joins, moves=len(joins) > 1)
    return Network(lengths, cuts, junctions, stops)


class _Walk:
    """One route, followed from its entry to its exit."""

    def __init__(self, found: Enumerated, row: dict[str, Any]) -> None:
        self.found, self.row, self.network = found, row, found.network
        self.directions: dict[str, str] = row.get("switches_directions") or row.get("track_nodes_directions") or {}
        heading = 1 if row["entry_point_direction"] == "START_TO_STOP" else -1
        entry = row["entry_point"]
        if entry["type"] == "BufferStop":
            track, end = self.network.end(entry["id"])
            at = self.network.lengths[track] if end else 0
        else:
            track, at = self.network.cut(entry["id"])
        self.route = Route(row["id"], Place(track, at, heading), from_end=entry["type"] == "BufferStop")
        self.run_mm = 0
        self.here = self.came_in = self.route.entry
        self.blocks: list[tuple[str, int, int]] = []
        self.since = 0

    def violates(self, rule: str, *elements: str) -> None:
        self.found.violations.append(Finding(rule, (self.route.name, *elements)))

    def block_ahead(self, place: Place) -> str:
        return self.network.block_of[self.network.piece_ahead(place)]

    def take(self) -> None:
        """Follow the route; keep what is found."""
        if not self._to_exit():
            return
        route, row = self.route, self.row
        names = [name for name, _, _ in self.blocks]
        if route.from_end:
            route.start, route.covers = names[0], names[1:]
        else:
            before = self.network.piece_behind(route.entry)
            route.start, route.covers = self.network.block_of[before], names
        named = named_beside(self.network, route, self.directions, self.crossed)
        for switch in self.directions:
            if switch not in self.crossed and switch not in named:
                self.violates("a route's positions are of its points", switch)
        route.length_mm = self.run_mm - (self.blocks[0][2] if route.from_end else 0)
        route.spans = {name: (low, high) for name, low, high in self.blocks}
        self._release(row["release_detectors"])
        if self._twice(names):
            return
        if not route.covers:
            self.found.remarks.append(Finding("grants nothing", (route.name,)))
            return
        route.released_after = released(route, row["release_detectors"])
        self.found.violations += lay_points(self.network, route, named)
        self.found.routes[route.name] = route
        self.found.violations += led_astray(self.network, route)

    def _to_exit(self) -> bool:
        """Walk; whether the exit was come to."""
        self.crossed: set[str] = set()
        exit_id = self.row["exit_point"]["id"]
        for event in self.network.follow(self.route.entry, lambda switch, _: self.directions.get(switch)):
            self.run_mm += abs(event.place.mm - self.here.mm) if not isinstance(event, Over | Ring) else 0
            if isinstance(event, Over):
                name, leg, position, _ = event.passing
                end = self.network.junctions[name].legs[leg]
                self.run_mm += abs((self.network.lengths[end[0]] if end[1] else 0) - self.here.mm)
                self.crossed.add(name)
                if self.network.junctions[name].moves:
                    self.route.passed[name] = position
                    self.route.faced |= {name} if event.passing.facing else set()
            elif self._comes_to(event, exit_id):
                return True
            elif not isinstance(event, Cut):
                return False
            self.here = event.place
        raise AssertionError("a walk ends with a reason")

    def _comes_to(self, event: Event, exit_id: str) -> bool:
        """At a boundary or end of track: whether it is the exit."""
        if isinstance(event, Closed):
            self.violates("a route is led over its points", event.junction)
            return False
        if isinstance(event, Ring):
            self.violates("a route comes to its exit", exit_id)
            return False
        assert isinstance(event, Cut | Stop)
        block = self.network.block_of[self.network.piece_behind(event.place)]
        self.blocks.append((block, self.since, self.run_mm))
        self.since = self.run_mm
        self.route.comes_in.setdefault(block, self.came_in)
        self.came_in = event.place
        if event.name == exit_id:
            self.route.exit = self.route.end = event.place
            return True
        if isinstance(event, Stop):
            self.violates("a route comes to its exit", exit_id)
        else:
            self.route.inside[event.name] = self.run_mm
        return False

    def _release(self, detectors: list[str]) -> None:
        for name in detectors:
            if name == self.row["exit_point"]["id"]:
                self.found.remarks.append(Finding("releases at its exit", (self.route.name, name)))
            elif name not in self.route.inside:
                self.violates("a release detector lies within its route", name)

    def _twice(self, names: list[str]) -> bool:
        """Whether it comes into a block again; what such a route needs says nothing then."""
        way = names if self.route.from_end else [self.route.start, *names]
        twice = sorted({block for block in way if way.count(block) > 1})
        for block in twice:
            self.violates("a route passes a block once", *self.network.ends(block))
        return bool(twice)
