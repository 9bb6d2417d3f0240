"""The native format read with ``tomllib`` alone, and its routes walked over the tracks of the file."""

from __future__ import annotations

import tomllib
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from tests.independent.raw_graph import (
    Closed,
    Cut,
    End,
    Finding,
    Joins,
    Junction,
    Network,
    Over,
    Place,
    Route,
    Stop,
    bent_back,
    led_astray,
    released,
)
from tests.independent.raw_points import lay_points, named_beside

KINDS: dict[str, Joins] = {
    "turnout": {"normal": (("tip", "normal"),), "reverse": (("tip", "reverse"),)},
    "crossing": {"": (("a1", "b1"), ("a2", "b2"))},
    "single slip": {"straight": (("a1", "b1"), ("a2", "b2")), "a1-b2": (("a1", "b2"),)},
    "double slip": {
        "a1-b1": (("a1", "b1"),),
        "a1-b2": (("a1", "b2"),),
        "a2-b1": (("a2", "b1"),),
        "a2-b2": (("a2", "b2"),),
    },
}
"""Kind -> position -> the legs that it joins."""

SLIPS_MM = 9_990
"""From 0.7 m/s motors pull for 1.5 s at 1.5 m/s², 2.737 m; from 2.95 m/s the brake takes 7.253 m at 0.6 m/s²."""


@dataclass
class Enumerated:
    """What the walk over one file finds."""

    network: Network
    held: list[tuple[str, str]] | None
    fouls: set[tuple[str, str]] = field(default_factory=set)
    routes: dict[str, Route] = field(default_factory=dict)
    violations: list[Finding] = field(default_factory=list)
    remarks: list[Finding] = field(default_factory=list)


def enumerate_file(path: Path) -> Enumerated:
    with path.open("rb") as file:
        return enumerate_data(tomllib.load(file))


def enumerate_data(data: dict[str, Any]) -> Enumerated:
    network = network_of(data)
    held = data.get("held_by_authority", [])
    found = Enumerated(network, None if held == "rest" else [(one, other) for one, other in held])
    for one, other in data.get("fouling", []):
        found.fouls |= {(one, other), (other, one)}
    for name, row in data["routes"].items():
        _Walk(found, name, row).take()
    found.violations += bent_back(found.network)
    return found


def network_of(data: dict[str, Any]) -> Network:
    """Tracks, boundaries, points and named blocks of the file."""
    lengths = {name: track["length_mm"] for name, track in data["tracks"].items()}
    cuts = {
        name: [(mm, boundary) for boundary, mm in track.get("boundaries", {}).items()]
        for name, track in data["tracks"].items()
    }
    nodes: dict[str, list[End]] = {}
    for name, track in data["tracks"].items():
        nodes.setdefault(track["from"], []).append((name, 0))
        nodes.setdefault(track["to"], []).append((name, 1))
    junctions: dict[str, Junction] = {}
    for name, row in data.get("points", {}).items():
        joins = KINDS[row.get("kind", "turnout")]
        legs = {}
        for leg in {leg for pairs in joins.values() for pair in pairs for leg in pair}:
            (legs[leg],) = nodes.pop(f"{name}.{leg}")
        junctions[name] = Junction(name, legs, joins, moves=len(joins) > 1)
    stops = {}
    for node, ends in nodes.items():
        if len(ends) == 1:
            stops[ends[0]] = node
        else:
            one, other = ends
            junctions[f"joint {node}"] = Junction(
                f"joint {node}", {"one": one, "other": other}, {"": (("one", "other"),)}, moves=False
            )
    given = {(row["track"], row["at_mm"]): name for name, row in data.get("blocks", {}).items()}
    return Network(lengths, cuts, junctions, stops, given)


class _Walk:
    """One route, followed from its entry to the end of its overlap."""

    def __init__(self, found: Enumerated, name: str, row: dict[str, Any]) -> None:
        self.found, self.network, self.row = found, found.network, row
        heading = 1 if row["direction"] == "forward" else -1
        ends = {end for end, other in self.network.stops.items() if other == row["from"]}
        if ends:
            ((track, end),) = ends
            entry = Place(track, self.network.lengths[track] if end else 0, heading)
        else:
            entry = Place(*self.network.cut(row["from"]), heading)
        self.route = Route(name, entry, from_end=bool(ends))
        self.points: dict[str, str] = row.get("points", {})

    def violates(self, rule: str, *elements: str) -> None:
        self.found.violations.append(Finding(rule, (self.route.name, *elements)))

    def take(self) -> None:
        """Follow the route; keep what is found."""
        row, route, network = self.row, self.route, self.network
        path = self._path()
        if path is None:
            return
        passed, names = path
        if route.from_end:
            route.start, *route.covers = route.covers
        else:
            route.start = network.block_of[network.piece_behind(route.entry)]
        if route.overlap:
            from_mm = route.spans[route.covers[-1] if route.covers else route.start][1]
            from_mm -= route.spans[route.start][1] if route.from_end else 0
            if route.length_mm - from_mm < SLIPS_MM:
                self.violates("an overlap is longer than a train slips", row["to"], row["overlap_to"])
        way = names if route.from_end else [route.start, *names]
        named = named_beside(network, route, self.points, passed)
        for point in self.points:
            if point not in passed and point not in named:
                self.violates("a route's positions are of its points", point)
        twice = sorted({block for block in way if way.count(block) > 1})
        for block in twice:
            self.violates("a route passes a block once", *network.ends(block))
        if twice:
            return
        flank = named_beside(network, route, row.get("flank", {}), passed)
        self.found.violations += lay_points(network, route, flank | named)
        for boundary in row.get("release_at", []):
            if boundary == row["to"]:
                self.found.remarks.append(Finding("releases at its exit", (route.name, boundary)))
            elif boundary not in route.inside:
                self.violates("a release detector lies within its route", boundary)
        route.released_after = released(route, row.get("release_at", []))
        self._flank()
        self.found.routes[route.name] = route
        self.found.violations += led_astray(network, route)

    def _path(self) -> tuple[dict[str, str], list[str]] | None:
        """Walk; the points passed, as they must lie, and the blocks; nothing if it does not come to its end."""
        route, passed, names = self.route, dict[str, str](), list[str]()
        here, run_mm, since = route.entry, 0, 0
        came_in = route.entry
        until = self.row.get("overlap_to", self.row["to"])
        for event in self.network.follow(route.entry, lambda point, _: self.points.get(point)):
            if isinstance(event, Over):
                track, end = self.network.junctions[event.passing.junction].legs[event.passing.leg]
                run_mm += abs((self.network.lengths[track] if end else 0) - here.mm)
                if self.network.junctions[event.passing.junction].moves:
                    passed[event.passing.junction] = event.passing.position
                    route.faced |= {event.passing.junction} if event.passing.facing else set()
            elif isinstance(event, Cut | Stop):
                run_mm += abs(event.place.mm - here.mm)
                block = self.network.block_of[self.network.piece_behind(event.place)]
                names.append(block)
                if route.exit is None:
                    route.covers.append(block)
                    route.spans[block] = (since, run_mm)
                else:
                    route.overlap.append(block)
                since = run_mm
                route.comes_in[block], came_in = came_in, event.place
                if event.name == self.row["to"]:
                    route.exit = event.place
                elif route.exit is None:
                    route.inside[event.name] = run_mm
                if event.name == until:
                    route.length_mm = run_mm - (route.spans[names[0]][1] if route.from_end else 0)
                    route.passed, route.end = passed, event.place
                    return passed, names
            elif isinstance(event, Closed):
                self.violates("a route is led over its points", event.junction)
                return None
            else:
                break
            here = event.place
        self.violates("a route comes to its exit", until)
        return None

    def _flank(self) -> None:
        """Flank points keep vehicles out; where no point does, authority must."""
        route, network = self.route, self.network
        flank: dict[str, str] = self.row.get("flank", {})
        shields: set[str] = set()
        for target in route.covers + route.overlap:
            for block in sorted(network.neighbours[target] - set(route.claims)):
                wanted = network.demands(block, target)
                if wanted is None:
                    continue
                closing = {point for point in flank if wanted.get(point, flank[point]) != flank[point]}
                shields |= closing
                if not closing and self.found.held is not None and (block, target) not in self.found.held:
                    self.violates("a_flank_is_closed_or_held", *network.ends(block), *network.ends(target))
        claimed = {point for block in route.claims for point in network.points_in.get(block, ())}
        for point, position in flank.items():
            if point in claimed and route.needs.get(point) != position:
                self.violates("a flank point lies off its route", point)
            elif point not in claimed and point not in shields:
                self.violates("a flank point shields its route", point)
            elif point not in claimed:
                route.needs[point] = position
