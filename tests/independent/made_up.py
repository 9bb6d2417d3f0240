"""RailJSON made up at random: tracks joined by switches of every type, few detectors, routes walked at random.

Its blocks hold several points, slips and crossings, have one another for neighbour twice, and bend back
into themselves, as no published station does.
"""

from __future__ import annotations

import random
from typing import Any

from tests.independent.raw_graph import Closed, Cut, Network, Over, Place, Stop
from tests.independent.raw_railjson import BUILT_IN, network_of

TYPES = ("link", "point_switch", "point_switch", "point_switch", "crossing", "single_slip_switch", "double_slip_switch")


def made_up(chance: random.Random) -> dict[str, Any] | None:
    """A network with some routes; none if no walk came to an exit, or where no description says what is right.

    That is so of a block without any end, which has no name, and of movements that pass a switch again.
    """
    tracks = {f"t{number}": chance.randint(100, 900) for number in range(chance.randint(3, 9))}
    ends = [(track, end) for track in tracks for end in ("BEGIN", "END")]
    chance.shuffle(ends)
    data: dict[str, Any] = {
        "version": "3.4.12",
        "track_sections": [{"id": track, "length": float(length)} for track, length in tracks.items()],
        "switches": list(_switches(ends, chance)),
        "detectors": [],
        "buffer_stops": [
            {"id": f"bs.{track}.{end}", "track": track, "position": 0.0 if end == "BEGIN" else float(tracks[track])}
            for track, end in ends
            if chance.random() < 0.8
        ],
        "signals": [],
        "extended_switch_types": [],
        "routes": [],
    }
    for track, length in tracks.items():
        for number in range(chance.choice([0, 1, 1, 1, 2])):
            at = chance.randint(1, 49) if number == 0 else chance.randint(51, length - 1)
            if at <= 20 and at % 3:
                at += 20  # of those that a point may be foul of, two in three are moved away
            data["detectors"].append({"id": f"d.{track}.{number}", "track": track, "position": at + 0.5 * number - 0.5})
    _put_off_ends(data)
    network = network_of(data)
    if not all(network.ends(block) for block in network.blocks):
        return None
    if any(_passes_twice(network, place) for block in network.blocks for _, place in network.mouths(block)):
        return None
    walked = [_route(network, f"r{number}", data, chance) for number in range(8)]
    data["routes"] = [route for route in walked if route]
    return data if data["routes"] else None


def _passes_twice(network: Network, place: Place, passed: tuple[str, ...] = ()) -> bool:
    """Whether some movement inside a block passes a switch again."""
    low, high = network.sides(network.piece_ahead(place))
    far = place._replace(mm=high if place.heading > 0 else low)
    end = (far.track, 1 if far.heading > 0 else 0)
    if far.mm not in (0, network.lengths[far.track]) or end not in network.leg_at:
        return False
    switch, leg = network.leg_at[end]
    if switch in passed:
        return True
    for other in network.junctions[switch].ways_from(leg).values():
        track, which = network.junctions[switch].legs[other]
        beyond = Place(track, network.lengths[track] if which else 0, -1 if which else 1)
        if _passes_twice(network, beyond, (*passed, switch)):
            return True
    return False


def _put_off_ends(data: dict[str, Any]) -> None:
    data["detectors"] = [detector for detector in data["detectors"] if detector["position"] > 0]


def _switches(ends: list[tuple[str, str]], chance: random.Random) -> list[dict[str, Any]]:
    """Switches on some of the ends, which are taken from the list."""
    switches: list[dict[str, Any]] = []
    while len(ends) > 3:
        kind = chance.choice(TYPES)
        ports = sorted({port for pairs in BUILT_IN[kind].values() for pair in pairs for port in pair})
        if len(ports) > len(ends):
            break
        at = {port: dict(zip(("track", "endpoint"), ends.pop(), strict=True)) for port in ports}
        switches.append({"id": f"s{len(switches)}", "switch_type": kind, "ports": at, "group_change_delay": 0.0})
    return switches


def _route(network: Network, name: str, data: dict[str, Any], chance: random.Random) -> dict[str, Any] | None:
    """A walk over switches lying at random, from a detector or buffer stop to another."""
    stops = [(stop["id"], "BufferStop") for stop in data["buffer_stops"]]
    entries = stops + [(detector["id"], "Detector") for detector in data["detectors"]]
    if not entries:
        return None
    entry, kind = chance.choice(entries)
    if kind == "Detector":
        place = Place(*network.cut(entry), chance.choice([1, -1]))
    else:
        track, end = network.end(entry)
        place = Place(track, network.lengths[track] if end else 0, -1 if end else 1)
    lies: dict[str, str] = {}
    passed: dict[str, str] = {}
    met: list[tuple[str, dict[str, str]]] = []

    def position(switch: str, leg: str) -> str:
        ways = network.junctions[switch].ways_from(leg)
        return lies.setdefault(switch, chance.choice(sorted(ways)))

    for event in network.follow(place, position):
        if isinstance(event, Over) and (network.junctions[event.passing.junction].moves or chance.random() < 0.5):
            passed[event.passing.junction] = event.passing.position
        if isinstance(event, Closed) or (isinstance(event, Cut | Stop) and (not event.name or event.name == entry)):
            break
        if isinstance(event, Cut | Stop):
            if event.name in [before for before, _ in met]:
                break
            met.append((event.name, dict(passed)))
    if not met:
        return None
    index = chance.randrange(len(met))
    exit_id, directions = met[index]
    before = [name for name, _ in met[:index]]
    others = [detector["id"] for detector in data["detectors"]]
    release = chance.sample(before, chance.randint(0, len(before)))
    if chance.random() < 0.1 and others:
        release.append(chance.choice([other for other in others if other not in release] or others))
    return {
        "id": name,
        "entry_point": {"type": kind, "id": entry},
        "entry_point_direction": "START_TO_STOP" if place.heading > 0 else "STOP_TO_START",
        "exit_point": {"type": "BufferStop" if exit_id.startswith("bs") else "Detector", "id": exit_id},
        "release_detectors": release,
        "switches_directions": _standing(network, place, random.Random(f"{name} {entry}")) | directions,
    }


def _standing(network: Network, place: Place, chance: random.Random) -> dict[str, str]:
    """Mostly, how switches lie on a track that a train stands on before a detector; behind an end there is none."""
    on_track = dict(network.cuts.get(place.track, []))
    if place.mm not in on_track or chance.random() < 0.2:
        return {}
    ways = network.ways(network.block_of[network.piece_behind(place)])
    leading = [way for way in ways if way.out == on_track[place.mm]]
    passed = chance.choice(leading).passed if leading else ()
    return {each.junction: each.position for each in passed if network.junctions[each.junction].moves}
