"""The same layout in a mirror and under other names: left and right exchanged, tracks turned round, names shuffled."""

from __future__ import annotations

import copy
import json
import random
import re
import tomllib
from collections import Counter
from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import yaml

from kernel.names import Point, Route
from models.layouts import Imported, check, load_text
from models.layouts.conflict_pairs import Conflicts
from models.layouts.generate import as_toml

Data = dict[str, Any]
RAILJSON_WORDS = {"B1": "B2", "B2": "B1", "A_B1": "A_B2", "A_B2": "A_B1"}
NATIVE_WORDS = {"normal": "reverse", "reverse": "normal"}
TURNED = {"START_TO_STOP": "STOP_TO_START", "STOP_TO_START": "START_TO_STOP", "BEGIN": "END", "END": "BEGIN"}


@dataclass(frozen=True)
class Mirrored:
    """The text of a mirrored layout; ``names``: what each name has become; ``words``: the same of positions.

    ``lengths_mm``: of the tracks that were turned round.
    """

    text: str
    names: Mapping[str, str]
    words: Mapping[str, str]
    lengths_mm: Mapping[str, int]


def mirrored(name: str, text: str, chance: random.Random) -> Mirrored:
    """A layout file of any format in a mirror."""
    match Path(name).suffix:
        case ".json":
            return _railjson(json.loads(text), chance)
        case ".toml":
            return _native(tomllib.loads(text), chance)
        case ".yml":
            return _table(yaml.safe_load(text), chance)
    return _railml(text, chance)


def _shuffled(names: Iterable[str], chance: random.Random) -> dict[str, str]:
    """A new name for each; their order is another one."""
    olds = sorted(set(names))
    news = [f"n{number}" for number in range(len(olds))]
    chance.shuffle(news)
    return dict(zip(olds, news, strict=True))


def _railjson(data: Data, chance: random.Random) -> Mirrored:
    kinds = ("track_sections", "switches", "track_nodes", "detectors", "buffer_stops", "routes")
    names = _shuffled((item["id"] for kind in kinds for item in data.get(kind, ())), chance)
    lengths = {track["id"]: track["length"] for track in data["track_sections"]}
    data = {kind: copy.deepcopy(value) for kind, value in data.items() if kind in (*kinds, "version") or "ext" in kind}
    turnouts = {s["id"] for s in data.get("switches", []) if s["switch_type"] == "point_switch"}
    turnouts |= {s["id"] for s in data.get("track_nodes", []) if s["track_node_type"] == "point_switch"}
    for switch in data.get("switches", []) + data.get("track_nodes", []):
        words = RAILJSON_WORDS if switch["id"] in turnouts else {}
        switch["ports"] = {
            words.get(port, port): {"track": names[end["track"]], "endpoint": TURNED[end["endpoint"]]}
            for port, end in switch["ports"].items()
        }
    for mark in data["detectors"] + data["buffer_stops"]:
        mark["position"] = round(lengths[mark["track"]] - mark["position"], 6)
        mark["track"] = names[mark["track"]]
    for route in data["routes"]:
        for field in ("switches_directions", "track_nodes_directions"):
            if field in route:
                route[field] = {
                    names.get(p, p): RAILJSON_WORDS.get(at, at) if p in turnouts else at
                    for p, at in route[field].items()
                }
        route["entry_point_direction"] = TURNED[route["entry_point_direction"]]
        route["entry_point"]["id"], route["exit_point"]["id"] = (
            names.get(route[end]["id"], route[end]["id"]) for end in ("entry_point", "exit_point")
        )
        route["release_detectors"] = [names.get(each, each) for each in route["release_detectors"]]
    for kind in kinds:
        for item in data.get(kind, ()):
            item["id"] = names[item["id"]]
        chance.shuffle(data.get(kind, []))
    lengths_mm = {track: round(length * 1000) for track, length in lengths.items()}
    return Mirrored(json.dumps(data), names, RAILJSON_WORDS, lengths_mm)


def _native(data: Data, chance: random.Random) -> Mirrored:
    tracks, points, routes = data["tracks"], data.get("points", {}), data["routes"]
    legs = {f"{point}.{leg}" for point in points for leg in ("tip", "normal", "reverse", "a1", "a2", "b1", "b2")}
    nodes = {track[end] for track in tracks.values() for end in ("from", "to")} - legs
    marks = [mark for track in tracks.values() for mark in track.get("boundaries", {})]
    names = _shuffled([*tracks, *points, *routes, *nodes, *marks, *data.get("blocks", {})], chance)
    names |= {leg: ".".join((names[leg.rpartition(".")[0]], _word(leg.rpartition(".")[2]))) for leg in legs}
    turned = {
        names[name]: {
            "from": names[track["to"]],
            "to": names[track["from"]],
            "length_mm": track["length_mm"],
            "boundaries": {names[mark]: track["length_mm"] - mm for mark, mm in track.get("boundaries", {}).items()},
        }
        for name, track in tracks.items()
    }
    pairs = {
        field: [[names.get(one, one) for one in pair] for pair in data[field]]
        for field in ("fouling", "held_by_authority")
        if isinstance(data.get(field), list)
    }
    found: Data = {
        **{field: data[field] for field in ("format", "trains", "held_by_authority") if field in data},
        **pairs,
        "tracks": _reordered(turned, chance),
        "points": {names[point]: told for point, told in points.items()},
        "blocks": {
            names[block]: {
                "track": names[place["track"]],
                "at_mm": tracks[place["track"]]["length_mm"] - place["at_mm"],
            }
            for block, place in data.get("blocks", {}).items()
        },
        "routes": _reordered({names[name]: _native_route(route, names) for name, route in routes.items()}, chance),
    }
    lengths_mm = {name: track["length_mm"] for name, track in tracks.items()}
    return Mirrored(
        as_toml({key: value for key, value in found.items() if value != {}}), names, NATIVE_WORDS, lengths_mm
    )


def _word(word: str) -> str:
    return NATIVE_WORDS.get(word, word)


def _native_route(route: Data, names: Mapping[str, str]) -> Data:
    found: Data = {
        **route,
        **{field: names[route[field]] for field in ("from", "to", "overlap_to") if field in route},
        "direction": {"forward": "backward", "backward": "forward"}[route["direction"]],
    }
    for field in ("points", "flank"):
        if field in route:
            found[field] = {names[point]: _word(at) for point, at in route[field].items()}
    if "release_at" in route:
        found["release_at"] = [names[mark] for mark in route["release_at"]]
    return found


def _reordered(items: Data, chance: random.Random) -> Data:
    keys = list(items)
    chance.shuffle(keys)
    return {key: items[key] for key in keys}


def _table(data: Data, chance: random.Random) -> Mirrored:
    rows = data["interlocking-table"]
    listed = ("path", "sections", "points", "signals")
    names = _shuffled(
        [
            *(row[field] for row in rows for field in ("source", "destination")),
            *(str(item["id"]) for row in rows for field in listed for item in row.get(field) or ()),
            *(str(row["id"]) for row in rows),
        ],
        chance,
    )
    positions = sorted({point["position"] for row in rows for point in row["points"]})
    words: dict[str, str] = dict(zip(positions, reversed(positions), strict=True))
    ways = sorted({row["orientation"] for row in rows})
    turned: dict[str, str] = dict(zip(ways, reversed(ways), strict=True))
    found = [
        {
            "id": names[str(row["id"])],
            "source": names[row["source"]],
            "destination": names[row["destination"]],
            "orientation": turned[row["orientation"]],
            **{field: [{"id": names[str(item["id"])]} for item in row[field]] for field in ("path", "sections")},
            "points": [{"id": names[p["id"]], "position": words[p["position"]]} for p in row["points"]],
            "conflicts": [{"id": names.get(str(c["id"]), str(c["id"]))} for c in row["conflicts"]],
        }
        for row in rows
    ]
    chance.shuffle(found)
    return Mirrored(yaml.safe_dump({**data, "interlocking-table": found}, sort_keys=False), names, words, {})


def _railml(text: str, chance: random.Random) -> Mirrored:
    """Ids and words of XML; tracks keep their direction."""
    names = _shuffled(re.findall(r'\bid="([^"]*)"', text), chance)

    def put(found: re.Match[str]) -> str:
        return f'{found[1]}="{names.get(found[2], found[2])}"'

    text = re.sub(r'\b(id|ref|\w+Ref)="([^"]*)"', put, text)
    text = re.sub(
        r"left|right|Left|Right", lambda f: {"l": "right", "r": "left", "L": "Right", "R": "Left"}[f[0][0]], text
    )
    return Mirrored(text, names, {"left": "right", "right": "left"}, {})


# ---- the two beside each other


def differences(name: str, text: str, chance: random.Random) -> list[str]:
    """In what a layout's verdict, tables and conflicts differ from those of its mirror image."""
    glass = mirrored(name, text, chance)
    one, other = load_text(name, text), load_text(name, glass.text)
    blocks = _blocks(one, other, glass)
    if blocks is None:
        return ["blocks"]
    ours, theirs = _told(one, glass, blocks), _told(other, None, {})
    return [what for what in ours if ours[what] != theirs[what]]


def _blocks(one: Imported, other: Imported, glass: Mirrored) -> dict[str, str] | None:
    """What each block has become: by the track of it, or by its name where there is no track."""
    if not one.places.spans:
        return {
            block: "before " * block.startswith("before ") + glass.names.get(block.removeprefix("before "), block)
            for block in one.layout.blocks
        }

    def turned(track: str, low: int, high: int) -> tuple[str, int, int]:
        whole = glass.lengths_mm.get(track)
        return (glass.names[track], low, high) if whole is None else (glass.names[track], whole - high, whole - low)

    there = {frozenset(spans): str(block) for block, spans in other.places.spans.items()}
    here = {str(block): frozenset(turned(*span) for span in spans) for block, spans in one.places.spans.items()}
    if set(here.values()) != set(there):
        return None
    return {block: there[spans] for block, spans in here.items()}


def _told(imported: Imported, glass: Mirrored | None, blocks: Mapping[str, str]) -> dict[str, object]:
    """What is compared, in the names of the mirror image."""
    layout, result = imported.layout, check(imported)
    names = glass.names if glass else {}
    junctions = imported.station.junctions if imported.station is not None else {}

    def named(name: str) -> str:
        return names.get(name, name)

    def block(name: str) -> str:
        return blocks.get(name, name)

    def either(point: str, route: str) -> bool:
        """A spare point with two legs on tracks of one length: nothing but its name says how it lies."""
        ports = junctions[point].ports.values() if point in junctions else ()
        lengths = [imported.station.tracks[track] for track, _ in ports] if imported.station is not None else []
        return imported.beside.get(Route(route), {}).get(Point(point)) == "spare" and len(set(lengths)) < len(lengths)

    def lies(point: str, at: str) -> str:
        turns = glass is not None and (point not in junctions or len(junctions[point].ports) == 3)
        return glass.words.get(at, at) if glass is not None and turns else at

    return {
        "verdict": result.verdict,
        "violations": Counter((v.axiom, frozenset(map(named, v.elements))) for v in result.violations),
        "needs": {
            named(r): {named(p): lies(p, at) for p, at in n.items() if not either(p, r)}
            for r, n in layout.needs.items()
        },
        "beside": {named(r): {named(p): role for p, role in b.items()} for r, b in imported.beside.items()},
        "released with": {
            named(r): {named(p): block(b) for p, b in with_.items()} for r, with_ in layout.released_with.items()
        },
        "released after": {
            named(r): {block(b): block(c) for b, c in after.items()} for r, after in layout.released_after.items()
        },
        "ways": {named(r): {block(b): block(c) for b, c in way.items()} for r, way in layout.way.items()},
        "overlaps": {named(r): {block(b) for b in overlap} for r, overlap in layout.overlap.items()},
        "conflicts": {frozenset(map(named, pair)) for pair in Conflicts(layout).pairs()},
    }
