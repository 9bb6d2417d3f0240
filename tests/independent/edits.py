"""Single edits of raw layouts, most of which make a good one wrong; each says what it did."""

from __future__ import annotations

import random
from collections.abc import Callable, Sequence
from typing import Any

Data = dict[str, Any]
Edit = Callable[[Data, random.Random], str | None]
OTHER = {"normal": "reverse", "reverse": "normal"}


def _directed(data: Data, chance: random.Random) -> tuple[Data, str] | None:
    """A route and a point that it gives a direction for."""
    points = {switch["id"] for switch in data["switches"] if switch["switch_type"] not in ("link", "crossing")}
    given = [(row, point) for row in data["routes"] for point in row["switches_directions"] if point in points]
    return chance.choice(given) if given else None


def turn_direction(data: Data, chance: random.Random) -> str | None:
    chosen = _directed(data, chance)
    if chosen is None:
        return None
    row, point = chosen
    known = {"A_B1": "A_B2", "A_B2": "A_B1", "A1_B1": "A1_B2", "A1_B2": "A2_B2", "A2_B2": "A2_B1", "A2_B1": "A1_B1"}
    row["switches_directions"][point] = known[row["switches_directions"][point]]
    return f"{row['id']}: {point} turned"


def unknown_direction(data: Data, chance: random.Random) -> str | None:
    chosen = _directed(data, chance)
    if chosen is None:
        return None
    row, point = chosen
    row["switches_directions"][point] = "A_B9"
    return f"{row['id']}: {point} to a direction that it has not"


def no_direction(data: Data, chance: random.Random) -> str | None:
    chosen = _directed(data, chance)
    if chosen is None:
        return None
    row, point = chosen
    del row["switches_directions"][point]
    return f"{row['id']}: no direction for {point}"


def stray_direction(data: Data, chance: random.Random) -> str | None:
    row, switch = chance.choice(data["routes"]), chance.choice(data["switches"])
    if switch["id"] in row["switches_directions"] or switch["switch_type"] in ("link", "crossing"):
        return None
    row["switches_directions"][switch["id"]] = "A_B1" if switch["switch_type"] == "point_switch" else "A1_B1"
    return f"{row['id']}: direction for {switch['id']} too"


def another_release(data: Data, chance: random.Random) -> str | None:
    row = chance.choice(data["routes"])
    others = [detector["id"] for detector in data["detectors"] if detector["id"] not in row["release_detectors"]]
    if not others:
        return None
    detector = chance.choice(others)
    row["release_detectors"] = [*row["release_detectors"], detector]
    return f"{row['id']}: released at {detector} too"


def fewer_releases(data: Data, chance: random.Random) -> str | None:
    rows = [row for row in data["routes"] if row["release_detectors"]]
    if not rows:
        return None
    row = chance.choice(rows)
    gone = row["release_detectors"].pop(chance.randrange(len(row["release_detectors"])))
    chance.shuffle(row["release_detectors"])
    return f"{row['id']}: not released at {gone}"


def no_detector(data: Data, chance: random.Random) -> str | None:
    """A detector away, and with it the routes that begin or end there: two blocks become one."""
    if not data["detectors"]:
        return None
    gone = chance.choice(data["detectors"])
    data["detectors"].remove(gone)
    ends = ("entry_point", "exit_point")
    data["routes"] = [row for row in data["routes"] if gone["id"] not in [row[end]["id"] for end in ends]]
    for row in data["routes"]:
        row["release_detectors"] = [name for name in row["release_detectors"] if name != gone["id"]]
    return f"no detector {gone['id']}" if data["routes"] else None


def ports_exchanged(data: Data, chance: random.Random) -> str | None:
    ports = (switch := chance.choice(data["switches"]))["ports"]
    one, other = chance.sample(sorted(ports), 2)
    ports[one], ports[other] = ports[other], ports[one]
    return f"{switch['id']}: {one} and {other} exchanged"


def another_type(data: Data, chance: random.Random) -> str | None:
    four = ("crossing", "double_slip_switch", "single_slip_switch")
    switches = [switch for switch in data["switches"] if switch["switch_type"] in four]
    if not switches:
        return None
    switch = chance.choice(switches)
    switch["switch_type"] = chance.choice([kind for kind in four if kind != switch["switch_type"]])
    return f"{switch['id']}: a {switch['switch_type']}"


RAILJSON: Sequence[Edit] = (
    turn_direction,
    unknown_direction,
    no_direction,
    stray_direction,
    another_release,
    fewer_releases,
    no_detector,
    no_detector,
    ports_exchanged,
    another_type,
)


def _route(data: Data, chance: random.Random, has: str | None = None) -> tuple[str, Data] | None:
    rows = [(name, row) for name, row in data["routes"].items() if has is None or row.get(has)]
    return chance.choice(rows) if rows else None


def turn_point(data: Data, chance: random.Random) -> str | None:
    chosen = _route(data, chance, "points")
    if chosen is None:
        return None
    name, row = chosen
    point = chance.choice(sorted(row["points"]))
    row["points"][point] = OTHER[row["points"][point]]
    return f"{name}: {point} turned"


def stray_point(data: Data, chance: random.Random) -> str | None:
    name, row = chance.choice(sorted(data["routes"].items()))
    points = sorted(
        point for point, of in data["points"].items() if "kind" not in of and point not in row.get("points", {})
    )
    if not points:
        return None
    row.setdefault("points", {})[point := chance.choice(points)] = "normal"
    return f"{name}: position for {point} too"


def no_flank(data: Data, chance: random.Random) -> str | None:
    chosen = _route(data, chance, "flank")
    if chosen is None:
        return None
    name, row = chosen
    del row["flank"][point := chance.choice(sorted(row["flank"]))]
    return f"{name}: no flank {point}"


def another_flank(data: Data, chance: random.Random) -> str | None:
    name, row = chance.choice(sorted(data["routes"].items()))
    point = chance.choice(sorted(point for point, of in data["points"].items() if "kind" not in of))
    row.setdefault("flank", {})[point] = chance.choice(["normal", "reverse"])
    return f"{name}: flank {point} {row['flank'][point]}"


def no_overlap(data: Data, chance: random.Random) -> str | None:
    chosen = _route(data, chance, "overlap_to")
    if chosen is None:
        return None
    name, row = chosen
    del row["overlap_to"]
    return f"{name}: no overlap"


def not_held(data: Data, chance: random.Random) -> str | None:
    held = data["held_by_authority"]
    if held == "rest":
        data["held_by_authority"] = []
        return "nothing held by authority"
    return f"not held by authority: {held.pop(chance.randrange(len(held)))}" if held else None


def another_release_at(data: Data, chance: random.Random) -> str | None:
    name, row = chance.choice(sorted(data["routes"].items()))
    every = sorted(boundary for track in data["tracks"].values() for boundary in track.get("boundaries", {}))
    boundary = chance.choice(every)
    if boundary in row.get("release_at", []):
        return None
    row["release_at"] = [*row.get("release_at", []), boundary]
    return f"{name}: released at {boundary} too"


NATIVE: Sequence[Edit] = (
    turn_point,
    stray_point,
    no_flank,
    another_flank,
    no_overlap,
    not_held,
    another_release_at,
)


def conflict_not_declared(data: Data, chance: random.Random) -> str | None:
    row = chance.choice(data["interlocking-table"])
    gone = row["conflicts"].pop(chance.randrange(len(row["conflicts"])))
    return f"{row['id']}: no conflict with {gone['id']}"


def needless_conflict(data: Data, chance: random.Random) -> str | None:
    row, other = chance.sample(data["interlocking-table"], 2)
    if {"id": other["id"]} in row["conflicts"]:
        return None
    row["conflicts"].append({"id": other["id"]})
    return f"{row['id']}: conflict with {other['id']} too"


def turn_point_of_row(data: Data, chance: random.Random) -> str | None:
    row = chance.choice(data["interlocking-table"])
    point = chance.choice(row["points"])
    point["position"] = OTHER[point["position"]]
    return f"{row['id']}: {point['id']} turned"


def no_point_of_row(data: Data, chance: random.Random) -> str | None:
    row = chance.choice(data["interlocking-table"])
    gone = row["points"].pop(chance.randrange(len(row["points"])))
    return f"{row['id']}: no {gone['id']}"


def no_row(data: Data, chance: random.Random) -> str | None:
    gone = chance.choice(data["interlocking-table"])
    data["interlocking-table"].remove(gone)
    for row in data["interlocking-table"]:
        row["conflicts"] = [other for other in row["conflicts"] if other["id"] != gone["id"]]
    return f"no {gone['id']}"


TABLE: Sequence[Edit] = (conflict_not_declared, needless_conflict, turn_point_of_row, no_point_of_row, no_row)
