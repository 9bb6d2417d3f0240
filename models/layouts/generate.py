"""Networks of any size for benchmarks and tests: a long single line of passing stations.

Each station has two to four tracks behind a ladder of points at either end.  Trains arrive from
both sides in every track, with the throat beyond as overlap, and depart to both sides.
"""

from __future__ import annotations

import json
import random
from collections.abc import Mapping
from typing import Any

from models.layouts.native import import_native
from models.layouts.native_schema import FORMAT
from models.layouts.results import Imported

Data = dict[str, Any]


def generate(routes: int, seed: int = 0) -> Imported:
    """A network with this many routes, imported."""
    return import_native(f"generated-{routes}-{seed}", network(routes, seed), ())


def network(routes: int, seed: int = 0) -> Data:
    """A network with this many routes, as native data; the same for the same seed."""
    assert routes > 0, "a network has routes"
    chance = random.Random(seed)
    data: Data = {
        "format": FORMAT,
        "name": f"generated network of {routes} routes",
        "trains": [f"T{number}" for number in range(1, 9)],
        "held_by_authority": "rest",
        "tracks": {},
        "points": {},
        "routes": {},
    }
    station = 0
    while len(data["routes"]) < routes:
        _station(data, station, chance)
        station += 1
    _line(data, station, chance)
    data["routes"] = dict(list(data["routes"].items())[:routes])
    return data


def _line(data: Data, number: int, chance: random.Random) -> None:
    """The single line west of a station (or east of the last), with a boundary at each end."""
    west = f"s{number - 1} E" if number else "west end"
    last = "points" in data and f"s{number} W0" not in data["points"]
    length_mm = chance.randrange(2_000_000, 9_000_000)
    data["tracks"][f"line {number}"] = {
        "from": f"s{number - 1} E0.tip" if number else west,
        "to": "east end" if last else f"s{number} W0.tip",
        "length_mm": length_mm,
        "boundaries": {f"l{number}a": 50_000, f"l{number}b": length_mm - 50_000},
    }


def _station(data: Data, number: int, chance: random.Random) -> None:
    """One station with the line to its west, and its routes."""
    tracks = chance.randint(2, 4)
    for side in "WE":
        for rung in range(tracks - 1):
            data["points"][f"s{number} {side}{rung}"] = {}
    _line(data, number, chance)
    for side in "WE":
        for rung in range(tracks - 2):
            name = f"s{number} {side}{rung}-{rung + 1}"
            ends = [f"s{number} {side}{rung}.reverse", f"s{number} {side}{rung + 1}.tip"]
            begin, end = ends if side == "W" else ends[::-1]
            data["tracks"][name] = {"from": begin, "to": end, "length_mm": chance.randrange(20_000, 40_000)}
    for track in range(tracks):
        length_mm = chance.randrange(300_000, 700_000)
        data["tracks"][f"s{number} {track}"] = {
            "from": f"s{number} {_leg('W', track, tracks)}",
            "to": f"s{number} {_leg('E', track, tracks)}",
            "length_mm": length_mm,
            "boundaries": {f"s{number} {track}w": 40_000, f"s{number} {track}e": length_mm - 40_000},
        }
    for track in range(tracks):
        _routes(data["routes"], number, track, tracks)


def _leg(side: str, track: int, tracks: int) -> str:
    """The leg of a ladder that a track hangs on."""
    return f"{side}{track}.normal" if track < tracks - 1 else f"{side}{tracks - 2}.reverse"


def _ladder(number: int, side: str, track: int, tracks: int) -> dict[str, str]:
    """How the points of a ladder lie for a track."""
    rungs = range(min(track + 1, tracks - 1))
    return {f"s{number} {side}{rung}": "normal" if rung == track else "reverse" for rung in rungs}


def _routes(routes: Data, number: int, track: int, tracks: int) -> None:
    """The four routes of one station track: in and out, from and to either side."""
    west, east = _ladder(number, "W", track, tracks), _ladder(number, "E", track, tracks)
    name, home, far_home = f"s{number} {track}", f"l{number}b", f"l{number + 1}a"
    routes[f"{name} from west"] = {
        "from": home,
        "direction": "forward",
        "to": f"{name}e",
        "points": west | east,
        "overlap_to": far_home,
        "release_at": [f"{name}w"],
    }
    routes[f"{name} to west"] = {"from": f"{name}w", "direction": "backward", "to": f"l{number}a", "points": west}
    routes[f"{name} from east"] = {
        "from": far_home,
        "direction": "backward",
        "to": f"{name}w",
        "points": west | east,
        "overlap_to": home,
    }
    routes[f"{name} to east"] = {
        "from": f"{name}e",
        "direction": "forward",
        "to": f"l{number + 1}b",
        "points": east,
        "release_at": [far_home],
    }


def as_toml(data: Mapping[str, Any]) -> str:
    """Native data as TOML text; tables of tables become sections, everything else stands inline."""
    lines = [f"{_key(key)} = {_value(value)}" for key, value in data.items() if not isinstance(value, Mapping)]
    for table, entries in data.items():
        if isinstance(entries, Mapping):
            lines += ["", f"[{_key(table)}]"]
            lines += [f"{_key(key)} = {_value(value)}" for key, value in entries.items()]
    return "\n".join(lines) + "\n"


def _key(key: str) -> str:
    return json.dumps(key, ensure_ascii=False)


def _value(value: Any) -> str:
    if isinstance(value, Mapping):
        return "{ " + ", ".join(f"{_key(key)} = {_value(item)}" for key, item in value.items()) + " }"
    if isinstance(value, list | tuple):
        return "[" + ", ".join(_value(item) for item in value) + "]"
    return json.dumps(value, ensure_ascii=False)
