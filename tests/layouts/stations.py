"""Layouts made here for tests: in RailJSON and as an interlocking table."""

from __future__ import annotations

import os
from itertools import combinations
from pathlib import Path
from typing import Any

import pytest

ROOT = Path(__file__).resolve().parents[2]
SAMPLES = sorted((ROOT / "layouts").glob("*.toml"))
SHARED = Path(os.environ.get("HEISOKU_LAYOUTS", ROOT.parent / "shared" / "layouts"))
REAL_FILES = sorted(path for path in SHARED.glob("*.*") if path.suffix != ".md")
needs_shared = pytest.mark.skipif(
    not SHARED.is_dir(), reason=f"{SHARED} is absent: it holds layouts from public repositories (HEISOKU_LAYOUTS)"
)
Data = dict[str, Any]
LEGS = {"tip": "A", "normal": "B1", "reverse": "B2"}
GROUPS = {"normal": "A_B1", "reverse": "A_B2"}


def railjson_of(native: Data, later: bool = False) -> Data:
    """Native data with turnouts only, as RailJSON in the earlier or the later dialect; no overlap, no flank."""
    switches: dict[str, Data] = {}
    nodes: dict[str, list[tuple[str, str]]] = {}
    marks: dict[str, Data] = {}
    for name, track in native["tracks"].items():
        nodes.setdefault(track["from"], []).append((name, "BEGIN"))
        nodes.setdefault(track["to"], []).append((name, "END"))
        for mark, at_mm in track.get("boundaries", {}).items():
            marks[mark] = {"id": mark, "track": name, "position": at_mm / 1000}
    stops: list[Data] = []
    for node, ends in nodes.items():
        point, _, leg = node.rpartition(".")
        ports = [{"track": track, "endpoint": side} for track, side in ends]
        if point in native.get("points", {}):
            switch = switches.setdefault(point, {"id": point, "switch_type": "point_switch", "ports": {}})
            switch["ports"][LEGS[leg]] = ports[0]
        elif len(ends) == 2:
            switches[node] = {"id": node, "switch_type": "link", "ports": {"A": ports[0], "B": ports[1]}}
        else:
            track, side = ends[0]
            at_mm = native["tracks"][track]["length_mm"] if side == "END" else 0
            stops.append({"id": node, "track": track, "position": at_mm / 1000})
    data = {
        "version": "3.4.12",
        "track_sections": [{"id": n, "length": t["length_mm"] / 1000} for n, t in native["tracks"].items()],
        "switches": list(switches.values()),
        "detectors": list(marks.values()),
        "buffer_stops": stops,
        "routes": [_railjson_route(name, route, marks) for name, route in native["routes"].items()],
    }
    return _later(data) if later else data


def _railjson_route(name: str, route: Data, marks: dict[str, Data]) -> Data:
    def end(mark: str) -> Data:
        return {"type": "Detector" if mark in marks else "BufferStop", "id": mark}

    return {
        "id": name,
        "entry_point": end(route["from"]),
        "entry_point_direction": "START_TO_STOP" if route["direction"] == "forward" else "STOP_TO_START",
        "exit_point": end(route["to"]),
        "release_detectors": route.get("release_at", []),
        "switches_directions": {point: GROUPS[at] for point, at in route.get("points", {}).items()},
    }


def _later(data: Data) -> Data:
    """The same with the later field names."""
    data["version"] = "6"
    data["track_nodes"] = data.pop("switches")
    for node in data["track_nodes"]:
        node["track_node_type"] = node.pop("switch_type")
    for route in data["routes"]:
        route["track_nodes_directions"] = route.pop("switches_directions")
    return data


def plain_station() -> Data:
    """Native data: two tracks between two points, lines at either side; no overlap, no flank."""

    def route(entry: str, direction: str, leave: str, points: dict[str, str], release: list[str]) -> Data:
        return {"from": entry, "direction": direction, "to": leave, "points": points, "release_at": release}

    tracks = {
        "w": ("west", "P.tip", {"a": 400_000, "b": 900_000}),
        "t1": ("P.normal", "Q.normal", {"c": 100_000, "d": 900_000}),
        "t2": ("P.reverse", "Q.reverse", {"e": 100_000, "f": 900_000}),
        "x": ("Q.tip", "y", {"g": 100_000}),
        "z": ("y", "east", {"h": 500_000}),
    }
    routes = {
        "a-d": route("a", "forward", "d", {"P": "normal"}, ["b", "c"]),
        "a-f": route("a", "forward", "f", {"P": "reverse"}, ["b", "e"]),
        "d-h": route("d", "forward", "h", {"Q": "normal"}, ["g"]),
        "f-h": route("f", "forward", "h", {"Q": "reverse"}, []),
        "h-c": route("h", "backward", "c", {"Q": "normal"}, ["g", "d"]),
        "h-e": route("h", "backward", "e", {"Q": "reverse"}, ["g"]),
        "c-a": route("c", "backward", "a", {"P": "normal"}, ["b"]),
        "e-a": route("e", "backward", "a", {"P": "reverse"}, []),
        "east-h": route("east", "backward", "g", {}, []),
        "west-b": route("west", "forward", "b", {}, []),
    }
    return {
        "format": "heisoku-layout-1",
        "held_by_authority": "rest",
        "tracks": {
            name: {"from": begin, "to": end, "length_mm": 1_000_000, "boundaries": marks}
            for name, (begin, end, marks) in tracks.items()
        },
        "points": {"P": {}, "Q": {}},
        "routes": routes,
    }


def table_rows() -> list[Data]:
    """An interlocking table of a passing station: sections w, t1, t2, e; points p, q with track sp, sq."""
    rows: list[Data] = []
    for track, at in (("t1", "normal"), ("t2", "reverse")):
        for side, line, point, piece in (("W", "w", "p", "sp"), ("E", "e", "q", "sq")):
            east = side == "W"
            arrive = (f"home{side}", f"out{'E' if east else 'W'}{track}", "down" if east else "up")
            leave = (f"out{side}{track}", f"line{side}", "up" if east else "down")
            rows.append(_row(f"{side}-{track}", arrive, [piece, f"{track}a", f"{track}b"], [track], {point: at}))
            rows.append(_row(f"{track}-{side}", leave, [piece, f"{line}a", f"{line}b"], [line], {point: at}))
    rows.append(_row("in W", ("farW", "homeW", "down"), ["wa", "wb"], ["w"], {}))
    rows.append(_row("in E", ("farE", "homeE", "up"), ["ea", "eb"], ["e"], {}))
    for first, second in combinations(rows, 2):
        opposite = any(first["_at"][p] != second["_at"].get(p, first["_at"][p]) for p in first["_at"])
        if opposite or first["_over"] & second["_over"]:
            first["conflicts"].append({"id": second["id"]})
            second["conflicts"].append({"id": first["id"]})
    return [{key: value for key, value in row.items() if not key.startswith("_")} for row in rows]


def _row(name: str, ends: tuple[str, str, str], path: list[str], sections: list[str], points: dict[str, str]) -> Data:
    source, destination, orientation = ends
    return {
        "id": name,
        "source": source,
        "destination": destination,
        "orientation": orientation,
        "path": [{"id": piece} for piece in path],
        "sections": [{"id": section} for section in sections],
        "points": [{"id": point, "position": at} for point, at in points.items()],
        "conflicts": [],
        "_over": set(path),
        "_at": points,
    }
