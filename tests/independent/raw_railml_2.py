"""railML 2 read with the standard library's XML alone, as the track sections, switches and routes of RailJSON.

Switches and crossings stand upon tracks; a track is taken apart there.  What lies at the very end of a piece of track
is taken to lie a millimetre inside.  railML 2 has no routes: there is one from each main signal to the next that speaks
to the same trains, over every way and for every way that trains come.
"""

from __future__ import annotations

import xml.etree.ElementTree as Tree
from collections.abc import Callable, Iterator
from itertools import pairwise
from typing import Any

from tests.independent.raw_graph import Network, Place
from tests.independent.raw_railjson import network_of

WAYS = {"up": 1, "down": -1}
LEGS = ("A1", "B1", "A2", "B2")
CROSSINGS: dict[str, dict[str, tuple[tuple[str, str], ...]]] = {
    "simpleCrossing": {"a1-b1-a2-b2": (("a1", "b1"), ("a2", "b2"))},
    "doubleSwitchCrossing": {f"{a}-{b}": ((a, b),) for a in ("a1", "a2") for b in ("b1", "b2")},
}
End = tuple[str, str]


class Broken(ValueError):
    """What makes a file no layout."""


def data_of(text: str) -> dict[str, Any]:
    """A railML 2 document as RailJSON data.

    Raises:
        Broken: it is no track.
    """
    return _Reader(Tree.fromstring(text.encode())).data()


class _Reader:
    def __init__(self, root: Tree.Element) -> None:
        self.space = root.tag.partition("}")[0] + "}" if "}" in root.tag else ""
        self.tracks = [track for track in self.all(root, "track") if self.all(track, "trackTopology")]
        self.sections: dict[str, int] = {}
        self.at: dict[str, End | Tree.Element] = {}
        self.refers: dict[str, str] = {}
        self.joined: set[End] = set()
        self.spots: dict[str, list[tuple[int, Tree.Element]]] = {}
        for track in self.tracks:
            self._take_apart(track)
        if not self.tracks:
            raise Broken("no tracks")

    def all(self, inside: Tree.Element, *kinds: str) -> list[Tree.Element]:
        """Elements of the document's own namespace, in its order."""
        return [each for each in inside.iter() if each.tag in {self.space + kind for kind in kinds}]

    def mm(self, element: Tree.Element) -> int:
        try:
            metres = float(element.get("pos", ""))
        except ValueError:
            raise Broken(f"{element.get('id')}: pos") from None
        if not abs(metres) <= 1_000_000:
            raise Broken(f"{element.get('id')}: pos")
        return round(metres * 1_000)

    def ends_of(self, track: Tree.Element) -> tuple[Tree.Element, Tree.Element]:
        begin, end = self.all(track, "trackBegin"), self.all(track, "trackEnd")
        if not begin or not end or self.mm(begin[0]) >= self.mm(end[0]) or not track.get("id"):
            raise Broken(f"track {track.get('id')}")
        return begin[0], end[0]

    def _take_apart(self, track: Tree.Element) -> None:
        name, (begin, end) = str(track.get("id")), self.ends_of(track)
        standing = [
            each for there in self.all(track, "connections") for each in there if each in self.all(there, *STAND)
        ]
        places = sorted((self.mm(each), number) for number, each in enumerate(standing))
        edges = [self.mm(begin), *(mm for mm, _ in places), self.mm(end)]
        if any(low >= high for low, high in pairwise(edges)):
            raise Broken(f"track {name}: what stands upon it lies in one place, or beyond its ends")
        self.spots[name] = [(mm, standing[number]) for mm, number in places]
        for number, (low, high) in enumerate(pairwise(edges)):
            self.sections[self.piece(name, number)] = high - low
        for owner, place in (
            (begin, (self.piece(name, 0), "BEGIN")),
            (end, (self.piece(name, len(standing)), "END")),
        ):
            for each in self.all(owner, "connection"):
                self._connect(each, place)
        for owner in standing:
            for each in self.all(owner, "connection"):
                self._connect(each, owner)

    def _connect(self, connection: Tree.Element, where: End | Tree.Element) -> None:
        name, other = connection.get("id"), connection.get("ref")
        if name is None or other is None or other == name:
            raise Broken(f"connection {name}")
        self.at[name], self.refers[name] = where, other

    def piece(self, track: str, number: int) -> str:
        return f"{track}:{number + 1}" if self.spots.get(track, ()) else track

    def met(self, connection: Tree.Element) -> End | Tree.Element:
        """What a connection leads to; the two refer to each other."""
        name = str(connection.get("id"))
        other = self.refers[name]
        if self.refers.get(other) != name:
            raise Broken(f"connection {name}")
        return self.at[other]

    def end_met(self, connection: Tree.Element) -> End:
        met = self.met(connection)
        if not isinstance(met, tuple):
            raise Broken(f"{connection.get('id')}: no track between")
        return met

    def data(self) -> dict[str, Any]:
        """All of it."""
        found: dict[str, Any] = {
            "track_sections": [{"id": name, "length": mm / 1_000} for name, mm in self.sections.items()],
            "switches": [],
            "extended_switch_types": [],
            "detectors": [],
            "buffer_stops": [],
            "signals": [],
        }
        for name, other in sorted(self.refers.items()):
            if self.refers.get(other) != name:
                raise Broken(f"connection {name}")
            here, there = self.at[name], self.at[other]
            if name < other and isinstance(here, tuple) and isinstance(there, tuple):
                self._junction(found, f"{name} - {other}", {"static": (("a", "b"),)}, {"a": here, "b": there})
        done: set[str] = set()
        for track, standing in self.spots.items():
            for number, (_, each) in enumerate(standing):
                sides = (self.piece(track, number), "END"), (self.piece(track, number + 1), "BEGIN")
                if each.tag == self.space + "switch":
                    self._switch(found, each, *sides)
                elif str(each.get("id")) not in done:
                    self._crossing(found, each, *sides, done)
        speaking = self._marks(found)
        found["routes"] = list(_routes(network_of(found), speaking))
        if not found["routes"]:
            raise Broken("no signals to derive routes from")
        return found

    def _junction(self, found: dict[str, Any], name: str, joins: dict[str, Any], legs: dict[str, End]) -> None:
        groups = {at: [{"src": one, "dst": other} for one, other in pairs] for at, pairs in joins.items()}
        found["extended_switch_types"].append({"id": name, "groups": groups})
        if len(set(legs.values())) < len(legs) or self.joined & set(legs.values()):
            raise Broken(f"{name}: an end of track is joined twice")
        self.joined |= set(legs.values())
        ports = {leg: {"track": track, "endpoint": end} for leg, (track, end) in legs.items()}
        found["switches"].append({"id": name, "switch_type": name, "ports": ports})

    def _switch(self, found: dict[str, Any], switch: Tree.Element, before: End, behind: End) -> None:
        connections = self.all(switch, "connection")
        if len(connections) != 1 or connections[0].get("orientation") not in ("outgoing", "incoming"):
            raise Broken(f"switch {switch.get('id')}")
        (branch,) = connections
        if branch.get("orientation") == "incoming":
            before, behind = behind, before
        words = {"left": ("left", "right"), "right": ("right", "left"), "straight": ("straight", "turning")}
        if branch.get("course") in words and switch.get("trackContinueCourse") == branch.get("course"):
            raise Broken(f"switch {switch.get('id')}")
        side, on = words.get(branch.get("course", ""), ("branch", "through"))
        joins = {side: (("tip", side),), on: (("tip", on),)}
        self._junction(found, _id(switch), joins, {"tip": before, side: self.end_met(branch), on: behind})

    def _crossing(
        self, found: dict[str, Any], crossing: Tree.Element, before: End, behind: End, done: set[str]
    ) -> None:
        joins = CROSSINGS.get(crossing.get("type", "simpleCrossing"))
        by = {each.get("orientation"): each for each in self.all(crossing, "connection")}
        if joins is None or set(by) != {"incoming", "outgoing"}:
            raise Broken(f"crossing {crossing.get('id')}")
        into, out = (self.met(by[each]) for each in ("incoming", "outgoing"))
        halves = [
            ((self.piece(track, number), "END"), (self.piece(track, number + 1), "BEGIN"))
            for track, standing in self.spots.items()
            for number, (_, each) in enumerate(standing)
            if each is into and into is out and each is not crossing and each.tag == self.space + "crossing"
        ]
        if halves and len(joins) > 1:
            raise Broken(f"crossing {crossing.get('id')}: which legs a double slip joins, told on both, is not told")
        done |= {_id(into) for _ in halves if not isinstance(into, tuple)}
        across = halves[0] if halves else (self.end_met(by["incoming"]), self.end_met(by["outgoing"]))
        legs = dict(zip(("a1", "b1", "a2", "b2"), (before, behind, *across), strict=True))
        self._junction(found, _id(crossing), joins, legs)

    def _marks(self, found: dict[str, Any]) -> set[tuple[str, int]]:
        """Boundaries and named ends; the first element in a place names it.  Which signals speak, and whither."""
        named: dict[tuple[str, int], str] = {}
        for track in self.tracks:
            for kind in ("trainDetector", "trackCircuitBorder"):
                for element in self.all(track, kind):
                    named.setdefault(self._place(element, track), _id(element))
        speaking = set()
        for track in self.tracks:
            for signal in self.all(track, "signal"):
                if signal.get("type", "main") in ("main", "combined") and signal.get("dir") in WAYS:
                    name = named.setdefault(self._place(signal, track), _id(signal))
                    speaking.add((name, WAYS[str(signal.get("dir"))]))
        for (piece, mm), name in named.items():
            inside = min(max(mm, 1), self.sections[piece] - 1)
            found["detectors"].append({"id": name, "track": piece, "position": inside / 1_000})
        for track in self.tracks:
            last = self.piece(str(track.get("id")), len(self.spots[str(track.get("id"))]))
            places = ((self.piece(str(track.get("id")), 0), 0), (last, self.sections[last]))
            for owner, (piece, mm) in zip(self.ends_of(track), places, strict=True):
                stops = [each for each in owner if each.tag.startswith(self.space) and each.get("id")]
                for each in stops[:1] if stops and stops[0].tag != self.space + "connection" else ():
                    if (piece, mm) in named:
                        raise Broken(f"{_id(each)}: track ends and goes on there")
                    found["buffer_stops"].append({"id": _id(each), "track": piece, "position": mm / 1_000})
        return speaking

    def _place(self, element: Tree.Element, track: Tree.Element) -> tuple[str, int]:
        """The piece that something lies on, and where on it; where two meet, on the one before."""
        begin, end = (self.mm(each) for each in self.ends_of(track))
        mm, standing = self.mm(element), [at for at, _ in self.spots[str(track.get("id"))]]
        if not begin <= mm <= end:
            raise Broken(f"{_id(element)}: not on its track")
        number = sum(at < mm for at in standing)
        return self.piece(str(track.get("id")), number), mm - [begin, *standing][number]


STAND = ("switch", "crossing")


def _id(element: Tree.Element) -> str:
    if not element.get("id"):
        raise Broken("an element without an id")
    return str(element.get("id"))


# ---- routes


def _routes(network: Network, speaking: set[tuple[str, int]]) -> Iterator[dict[str, Any]]:
    """From every signal to the next one that speaks to the same trains, or to a named end of track."""

    def ends(name: str, heading: int) -> bool:
        return (name, heading) in speaking

    for entry, heading in sorted(speaking, key=lambda each: (each[0], each[1] > 0)):
        track, mm = network.cut(entry)
        onward = list(_ways(network, Place(track, mm, heading), ends))
        back = [lies for _, lies in _ways(network, Place(track, mm, -heading), lambda *_: True)]
        for name, lies in onward:
            twin = [other for other, _ in onward].count(name) > 1
            for standing in back if len(back) > 1 else [{}]:
                over = f" over {_listed(lies)}" if twin and lies else ""
                yield {
                    "id": f"{entry} - {name}{over}" + (f" from {_listed(standing)}" if standing else ""),
                    "entry_point": {"type": "Detector", "id": entry},
                    "entry_point_direction": "START_TO_STOP" if heading > 0 else "STOP_TO_START",
                    "exit_point": {"type": "BufferStop" if name in network.stops.values() else "Detector", "id": name},
                    "release_detectors": [],
                    "switches_directions": {**standing, **lies},
                }


def _listed(lies: dict[str, str]) -> str:
    return ", ".join(f"{point} {at}" for point, at in sorted(lies.items()))


def _ways(network: Network, place: Place, ends: Callable[[str, int], bool]) -> Iterator[tuple[str, dict[str, str]]]:
    """Every way to the first boundary that ends it, or to a named end of track, over no rail twice."""
    todo: list[tuple[Place, dict[str, str], frozenset[tuple[str, int]]]] = [(place, {}, frozenset())]
    while todo:
        here, lies, over = todo.pop()
        piece = network.piece_ahead(here)
        if piece in over:
            continue
        over |= {piece}
        low, high = network.sides(piece)
        far = here._replace(mm=high if here.heading > 0 else low)
        cut = dict(network.cuts.get(far.track, [])).get(far.mm)
        end = (far.track, 1 if far.heading > 0 else 0)
        if cut is not None and ends(cut, far.heading):
            yield cut, lies
        elif cut is not None:
            todo.append((far, lies, over))
        elif end in network.stops:
            yield network.stops[end], lies
        elif end in network.leg_at:
            name, leg = network.leg_at[end]
            junction = network.junctions[name]
            for at, other in junction.ways_from(leg).items():
                if lies.get(name, at) == at:
                    track, which = junction.legs[other]
                    beyond = Place(track, network.lengths[track] if which else 0, -1 if which else 1)
                    todo.append((beyond, {**lies, name: at} if junction.moves else lies, over))
