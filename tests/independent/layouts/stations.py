"""Stations made up at random, in RailJSON: parallel lines with crossovers and diamonds, detectors anywhere."""

from __future__ import annotations

import random
from collections.abc import Collection
from typing import Any

from tests.independent.layouts.rails import ways_back
from tests.independent.raw_graph import Network, Place
from tests.independent.raw_railjson import network_of
from tests.independent.world.drawn import walks

MOST_ROUTES = 16
End = tuple[str, str]


def station(chance: random.Random) -> dict[str, Any]:
    """A station of two to four lines, joined at up to six places, and routes over one to three blocks."""
    lines = chance.randint(2, 4)
    open_ends: list[str] = [f"line{line}.0" for line in range(lines)]
    lengths = {name: chance.randint(150, 900) for name in open_ends}
    switches: list[dict[str, Any]] = []

    def onward(line: int) -> tuple[End, End]:
        """The line goes on in a new track: the end of the one so far, and the beginning of that."""
        before = open_ends[line]
        open_ends[line] = f"line{line}.{len(lengths)}"
        lengths[open_ends[line]] = chance.randint(30, 900)
        return (before, "END"), (open_ends[line], "BEGIN")

    def switch(kind: str, **ports: End) -> None:
        at = {port: {"track": track, "endpoint": end} for port, (track, end) in ports.items()}
        switches.append({"id": f"s{len(switches)}", "switch_type": kind, "ports": at, "group_change_delay": 0.0})

    for _ in range(chance.randint(1, 6)):
        line = chance.randrange(lines - 1)
        kind = chance.choice(("facing", "trailing", "facing", "trailing", "crossing", "double_slip_switch"))
        (one, one_on), (other, other_on) = onward(line), onward(line + 1)
        if kind in ("crossing", "double_slip_switch"):
            switch(kind, A1=one, B1=other_on, A2=other, B2=one_on)
            continue
        link = f"link{len(lengths)}"
        lengths[link] = chance.randint(30, 120)
        if kind == "facing":
            switch("point_switch", A=one, B1=one_on, B2=(link, "BEGIN"))
            switch("point_switch", A=other_on, B1=other, B2=(link, "END"))
        else:
            switch("point_switch", A=one_on, B1=one, B2=(link, "BEGIN"))
            switch("point_switch", A=other, B1=other_on, B2=(link, "END"))
    data: dict[str, Any] = {
        "version": "3.4.12",
        "track_sections": [{"id": name, "length": float(length)} for name, length in lengths.items()],
        "switches": switches,
        "detectors": [
            {"id": f"d.{name}.{number}", "track": name, "position": at}
            for name, length in lengths.items()
            for number, at in enumerate(_places(length, chance))
        ],
        "buffer_stops": [{"id": f"west{line}", "track": f"line{line}.0", "position": 0.0} for line in range(lines)]
        + [{"id": f"east{at}", "track": name, "position": float(lengths[name])} for at, name in enumerate(open_ends)],
        "signals": [],
        "extended_switch_types": [],
    }
    return data | {"routes": _routes(data, chance)}


def _places(length: int, chance: random.Random) -> list[float]:
    """Detectors at random, now and then close to the end of the track."""
    if chance.random() < 0.3:
        return []
    places = {round(chance.uniform(3.5, length - 3.5), 3) for _ in range(chance.choice((1, 1, 2)))}
    found = sorted({chance.choice((place, place, 3.5, length - 3.5)) for place in places})
    return found if len(found) < 2 or found[1] - found[0] >= 7 else found[:1]


def _routes(data: dict[str, Any], chance: random.Random) -> list[dict[str, Any]]:
    """Some of all routes from detectors, either way, over one to three blocks.

    Each says how the points lie that its train comes over to its entry, and mostly those beside as well.
    """
    network, found = network_of(data), []
    kinds = {stop["id"]: "BufferStop" for stop in data["buffer_stops"]}
    for detector in data["detectors"]:
        for heading in (1, -1):
            here = Place(*network.cut(detector["id"]), heading)
            for points, met in (each for blocks in (1, 2, 3) for each in walks(network, here, blocks)):
                found.append(
                    {
                        "id": "",
                        "entry_point": {"type": "Detector", "id": detector["id"]},
                        "entry_point_direction": "START_TO_STOP" if heading > 0 else "STOP_TO_START",
                        "exit_point": {"type": kinds.get(met[-1], "Detector"), "id": met[-1]},
                        "release_detectors": chance.sample(met[:-1], chance.randint(0, len(met) - 1)),
                        "switches_directions": {**_standing(network, here, chance), **points},
                    }
                )
    chosen = chance.sample(found, min(len(found), MOST_ROUTES))
    return [{**route, "id": f"r{number}"} for number, route in enumerate(chosen)]


def _standing(network: Network, entry: Place, chance: random.Random) -> dict[str, str]:
    """How the points of the block before an entry lie for a train that stands on a track of it."""
    there = network.points_in.get(network.block_of[network.piece_behind(entry)], ())
    beside = {point: chance.choice(sorted(network.junctions[point].joins)) for point in there if chance.random() < 0.8}
    backs = ways_back(network, entry)
    return beside | dict(chance.choice(backs).positions) if backs else beside


def without(data: dict[str, Any], names: Collection[str]) -> dict[str, Any]:
    """A station without some of its routes."""
    return {**data, "routes": [route for route in data["routes"] if route["id"] not in names]}
