"""Single edits that make a good layout wrong, and the element each must be found by.

Every edit says why the result cannot be right.  The reasons rest on two facts of the base layouts
(checked in ``test_corruptions.py``): they have no rings, and a route's exit lies on one track that
is reached over points each of which joins a leg only in one position.
"""

from __future__ import annotations

import copy
import random
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from typing import Any

from tests.independent import raw_native

Data = dict[str, Any]


@dataclass(frozen=True)
class Corruption:
    """A layout with one edit: what was done, why that is wrong, which elements must be named (any of them)."""

    edit: str
    why: str
    data: Data
    named: tuple[str, ...]


Maker = Callable[[Data, random.Random], Corruption | None]


def _route(data: Data, chance: random.Random, **wanted: bool) -> tuple[str, Data] | None:
    fields = [field for field, has in wanted.items() if has]
    fitting = [(name, route) for name, route in data["routes"].items() if all(route.get(f) for f in fields)]
    return chance.choice(fitting) if fitting else None


def flip_position(data: Data, chance: random.Random) -> Corruption | None:
    chosen = _route(data, chance, points=True)
    if chosen is None:
        return None
    name, route = chosen
    point = chance.choice(sorted(route["points"]))
    flipped = {"normal": "reverse", "reverse": "normal"}
    if route["points"][point] not in flipped:
        return None
    route["points"][point] = flipped[route["points"][point]]
    why = "met facing it leads to another leg, and the way back is closed by the next point; met trailing it is closed"
    return Corruption(f"{name}: {point} flipped", why, data, (point,))


def drop_position(data: Data, chance: random.Random) -> Corruption | None:
    chosen = _route(data, chance, points=True)
    if chosen is None:
        return None
    name, route = chosen
    point = chance.choice(sorted(route["points"]))
    del route["points"][point]
    return Corruption(f"{name}: no position for {point}", "the route passes it", data, (point,))


def unknown_position(data: Data, chance: random.Random) -> Corruption | None:
    chosen = _route(data, chance, points=True)
    if chosen is None:
        return None
    name, route = chosen
    point = chance.choice(sorted(route["points"]))
    route["points"][point] = "sideways"
    return Corruption(f"{name}: {point} sideways", "no point has that position", data, (point,))


def stray_position(data: Data, chance: random.Random) -> Corruption | None:
    name, route = chance.choice(sorted(data["routes"].items()))
    walked = raw_native.enumerate_data(data)
    there = {point for block in walked.routes[name].claims for point in walked.network.points_in.get(block, ())}
    stray = sorted(set(data.get("points", ())) - there - set(route.get("flank", {})))
    if not stray:
        return None
    point = chance.choice(stray)
    route["points"] = route.get("points", {}) | {point: "normal"}
    why = "a route has no business with a point outside of its blocks that is not its flank"
    return Corruption(f"{name}: stray {point}", why, data, (point,))


def release_outside(data: Data, chance: random.Random) -> Corruption | None:
    name, route = chance.choice(sorted(data["routes"].items()))
    back = "down" if route["direction"] == "forward" else "up"
    behind = _behind(data, route)
    if not behind:
        return None
    boundary = chance.choice(behind)
    route["release_at"] = [*route.get("release_at", []), boundary]
    why = f"it lies on the entry's track on the side the route leaves ({back}), or is the entry"
    return Corruption(f"{name}: released at {boundary}", why, data, (boundary,))


def _entry_track(data: Data, route: Data) -> tuple[str, int] | None:
    for track, entries in data["tracks"].items():
        if route["from"] in entries.get("boundaries", {}):
            return track, entries["boundaries"][route["from"]]
    return None


def _behind(data: Data, route: Data) -> list[str]:
    """The boundaries of the entry's track that a route has behind it, the entry too."""
    entry = _entry_track(data, route)
    if entry is None:
        return []
    track, at_mm = entry
    forward = route["direction"] == "forward"
    marks = data["tracks"][track]["boundaries"].items()
    return sorted(mark for mark, mm in marks if (mm <= at_mm if forward else mm >= at_mm))


def exit_behind(data: Data, chance: random.Random) -> Corruption | None:
    chosen = _route(data, chance)
    assert chosen is not None
    name, route = chosen
    behind = [mark for mark in _behind(data, route) if mark != route["from"]]
    if not behind:
        return None
    route["to"] = chance.choice(behind)
    return Corruption(f"{name}: exit {route['to']}", "it lies behind the entry and there are no rings", data, (name,))


def turn_round(data: Data, chance: random.Random) -> Corruption | None:
    name, route = chance.choice(sorted(data["routes"].items()))
    route["direction"] = {"forward": "backward", "backward": "forward"}[route["direction"]]
    return Corruption(f"{name}: turned round", "it runs away from its exit and there are no rings", data, (name,))


def move_off_track(data: Data, chance: random.Random) -> Corruption | None:
    track = chance.choice(sorted(t for t, entries in data["tracks"].items() if entries.get("boundaries")))
    boundary = chance.choice(sorted(data["tracks"][track]["boundaries"]))
    data["tracks"][track]["boundaries"][boundary] = data["tracks"][track]["length_mm"] + chance.randint(1, 5_000_000)
    return Corruption(f"{boundary} beyond {track}", "it lies beyond the track's end", data, (boundary,))


def move_behind_entry(data: Data, chance: random.Random) -> Corruption | None:
    """A route's exit moved onto the entry's track, behind the entry."""
    _, route = chance.choice(sorted(data["routes"].items()))
    entry = _entry_track(data, route)
    home = next((t for t, e in data["tracks"].items() if route["to"] in e.get("boundaries", {})), None)
    if entry is None or home is None:
        return None
    track, at_mm = entry
    del data["tracks"][home]["boundaries"][route["to"]]
    length_mm, marks = data["tracks"][track]["length_mm"], data["tracks"][track]["boundaries"]
    low, high = (0, at_mm) if route["direction"] == "forward" else (at_mm, length_mm)
    marks[route["to"]] = next(
        mm for mm in iter(lambda: chance.randrange(low + 1, high), None) if mm not in marks.values()
    )
    why = "the route runs away from where its exit lies now, and there are no rings"
    named = (*_ending_at(data, route["to"]), *(b for b, at in data.get("blocks", {}).items() if at["track"] == home))
    return Corruption(f"{route['to']} moved behind {route['from']}", why, data, named)


def _ending_at(data: Data, mark: str) -> Iterator[str]:
    """The mark itself and every route that names it."""
    yield mark
    for name, route in data["routes"].items():
        if mark in (route["from"], route["to"], route.get("overlap_to"), *route.get("release_at", [])):
            yield name


def same_place(data: Data, chance: random.Random) -> Corruption | None:
    fitting = sorted(t for t, entries in data["tracks"].items() if len(entries.get("boundaries", {})) > 1)
    if not fitting:
        return None
    marks = data["tracks"][chance.choice(fitting)]["boundaries"]
    first, second = chance.sample(sorted(marks), 2)
    marks[second] = marks[first]
    return Corruption(f"{second} on {first}", "there is nothing between the two", data, (first, second))


def shorten(data: Data, chance: random.Random) -> Corruption | None:
    track = chance.choice(sorted(t for t, entries in data["tracks"].items() if entries.get("boundaries")))
    marks = data["tracks"][track]["boundaries"]
    last = max(marks, key=lambda mark: marks[mark])
    data["tracks"][track]["length_mm"] = marks[last] - chance.randint(1, marks[last] - 1)
    return Corruption(f"{track} shortened", "a boundary lies beyond its end now", data, tuple(marks))


def nowhere(data: Data, chance: random.Random) -> Corruption | None:
    name, route = chance.choice(sorted(data["routes"].items()))
    field = chance.choice(["from", "to"])
    route[field] = "nowhere"
    return Corruption(f"{name}: {field} nowhere", "there is no such boundary", data, ("nowhere",))


def unjoin(data: Data, chance: random.Random) -> Corruption | None:
    """A leg of a point left without track."""
    if not data.get("points"):
        return None
    point = chance.choice(sorted(data["points"]))
    for track, entries in data["tracks"].items():
        for end in ("from", "to"):
            if entries[end].rpartition(".")[0] == point:
                entries[end] = f"new end of {track}"
                return Corruption(f"{track} off {point}", "a leg of the point meets no track", data, (point,))
    return None


def drop_flank(data: Data, chance: random.Random) -> Corruption | None:
    chosen = _route(data, chance, flank=True)
    if chosen is None or data.get("held_by_authority") == "rest":
        return None
    name, route = chosen
    point = chance.choice(sorted(route["flank"]))
    del route["flank"][point]
    why = "every flank point of the sample shields a pair of blocks that is not held by authority"
    return Corruption(f"{name}: flank {point} dropped", why, data, (name,))


def flip_flank(data: Data, chance: random.Random) -> Corruption | None:
    chosen = _route(data, chance, flank=True)
    if chosen is None:
        return None
    name, route = chosen
    point = chance.choice(sorted(route["flank"]))
    route["flank"][point] = {"normal": "reverse", "reverse": "normal"}[route["flank"][point]]
    return Corruption(f"{name}: flank {point} flipped", "it leads into the route now", data, (point,))


def drop_held(data: Data, chance: random.Random) -> Corruption | None:
    held = data.get("held_by_authority")
    if not isinstance(held, list):
        return None
    block, into = held.pop(chance.randrange(len(held)))
    why = "some route of the sample claims the second and not the first, and no point lies between"
    return Corruption(f"{block} into {into} no longer held", why, data, (block, into))


def foul_itself(data: Data, chance: random.Random) -> Corruption | None:
    if not data.get("blocks"):
        return None
    block = chance.choice(sorted(data["blocks"]))
    data["fouling"] = [*data.get("fouling", []), [block, block]]
    return Corruption(f"{block} fouls itself", "no block obstructs itself", data, (block,))


MAKERS: tuple[Maker, ...] = (
    flip_position,
    drop_position,
    unknown_position,
    stray_position,
    release_outside,
    exit_behind,
    turn_round,
    move_off_track,
    move_behind_entry,
    same_place,
    shorten,
    nowhere,
    unjoin,
    drop_flank,
    flip_flank,
    drop_held,
    foul_itself,
)


def corruptions(base: Data, count: int, seed: int) -> Iterator[Corruption]:
    """So many corruptions of a layout, every maker in turn; the same for the same seed."""
    chance = random.Random(seed)
    made, turn = 0, 0
    while made < count:
        corruption = MAKERS[turn % len(MAKERS)](copy.deepcopy(base), chance)
        turn += 1
        if corruption is not None:
            made += 1
            yield corruption


def drop_conflict(rows: list[Data], chance: random.Random, both: bool) -> tuple[list[Data], tuple[str, str]]:
    """A table with one declared conflict taken out, of one route or of both, and the two routes.

    Every conflict of the table follows from what the two routes share, so it is missed.
    """
    rows = copy.deepcopy(rows)
    row = chance.choice([row for row in rows if row["conflicts"]])
    other = chance.choice(row["conflicts"])["id"]
    partner = next(candidate for candidate in rows if candidate["id"] == other)
    row["conflicts"] = [entry for entry in row["conflicts"] if entry["id"] != other]
    if both:
        partner["conflicts"] = [entry for entry in partner["conflicts"] if entry["id"] != row["id"]]
    return rows, (row["id"], other)
