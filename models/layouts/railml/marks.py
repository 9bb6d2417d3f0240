"""Where blocks end: at train detection elements, and at signals that a route begins or ends at, or an overlap.

A train without track circuits is found at tags alone, so a signal that routes begin or end at, or that limits an
overlap, has a pair of tags of its own, unless a detector stands in the same place.  Track ends at buffer stops and
at borders that are open ends; it runs on over all others, such as those of stations, tariffs and countries.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field

from models.layouts.findings import Findings
from models.layouts.railml.document import Document, Element, kind_of
from models.layouts.railml.topology import LONGEST_M, Topology
from models.layouts.track import HIGH, LOW, Mark

DIRECTIONS = {"normal": HIGH, "reverse": LOW}
KINDS = ("trainDetectionElement", "signalIS", "bufferStop", "border")
"""What a mark can be."""


@dataclass
class Marks:
    """Marks by name; ``of``: for an element's id, the mark that stands in its place.

    ``side``: for a signal, the end of its net element that trains it speaks to run to.
    ``signals``: the signals; ``detectors``: marks that a detector stands at; ``parts``: those of them at
    which a route is released in parts, by the sections beside them.  ``border``: for each further mark of a border
    that several tracks end at, the border.
    """

    marks: dict[str, Mark] = field(default_factory=dict)
    of: dict[str, str] = field(default_factory=dict)
    side: dict[str, int] = field(default_factory=dict)
    signals: set[str] = field(default_factory=set)
    detectors: set[str] = field(default_factory=set)
    parts: set[str] = field(default_factory=set)
    border: dict[str, str] = field(default_factory=dict)
    _at: dict[tuple[str, int], str] = field(default_factory=dict)

    def standing(self, name: str) -> set[str]:
        """The marks that stand for an element: one, or those of a border at each track that it ends; none."""
        parts = [name, *(part for part, border in self.border.items() if border == name)]
        return {self.of[part] for part in parts if part in self.of}

    def element_of(self, mark: str) -> str:
        """What a mark goes by where elements are told: its own name, or that of the border that it is a part of."""
        return self.border.get(mark, mark)

    def put(self, source: Document, element: Element, mark: Mark, joint: tuple[str, int] | None = None) -> None:
        """Put an element in its place, where another one may stand already for it.

        ``joint``: the same place for all that stand at one joint, on whichever of its tracks.

        Raises:
            BadInput: track goes on behind one of the two and not behind the other.
        """
        first = self.of[mark.name] = self._at.setdefault(joint or (mark.track, mark.at_mm), mark.name)
        if first == mark.name:
            self.marks[mark.name] = mark
        elif self.marks[first].cuts != mark.cuts:
            what = f"lies at the same place as '{first}' ('{mark.track}', {mark.at_mm} mm)"
            raise source.bad(element, what, "move or remove one of the two")


def read_marks(source: Document, topology: Topology, signals: Mapping[str, Element], findings: Findings) -> Marks:
    """Read them; ``signals``: those that routes begin or end at, and that limit overlaps.

    A border over which track runs on is a mark if it is one of these, or if a section ends there.

    Raises:
        BadInput: one has no id, or lies nowhere.
    """
    found = Marks()
    of_sections = {source.attribute(each, "ref") for each in source.all("hasDemarcatingBorder")}
    for kind in KINDS:
        for element in source.all(kind):
            if kind == "signalIS" and element.get("id") not in signals:
                continue
            name = source.attribute(element, "id")
            spots = spots_of(source, topology, element)
            if not spots:
                if name in signals:
                    raise source.bad(element, "has no place on the track", "add its spotLocation")
                findings.remark([name], f"{kind} '{name}' has no place on the track: it is left out", "unread")
                continue
            places = [placed(source, topology, name, spot) for spot in spots]
            if kind == "border" and name not in {*signals, *of_sections} and not _is_end(topology, element, *places):
                continue
            for group in _parts(source, topology, element, spots):
                place = placed(source, topology, name, group[0])
                part = name if group[0] is spots[0] else _part_of(name, place[0])
                cuts = not _is_end(topology, element, place)
                found.put(source, element, Mark(part, *place, cuts), topology.joint(*place))
                compare_places(source, found.of[part], name, group, topology, findings)
                found.border |= {part: name} if part != name else {}
            if kind == "signalIS":
                found.signals.add(name)
            if kind == "trainDetectionElement" or name in of_sections:
                found.detectors.add(found.of[name])
            sides = _sides(source, topology, found.marks[found.of[name]], name, spots)
            if len(sides) == 1:
                found.side[name] = sides.pop()
            elif sides and kind == "signalIS":
                text = f"signal '{name}' is told to speak to trains of both directions: give each its own signal"
                findings.violation(ONE_WAY, (name,), text)
    return found


def _is_end(topology: Topology, element: Element, *places: tuple[str, int]) -> bool:
    """Whether track ends at an element: at a buffer stop, and at a border by its word, or if it does in any case.

    A border is no open end where it does not say so, as railML has it.
    """
    if kind_of(element) != "border":
        return kind_of(element) == "bufferStop"
    is_open = element.get("isOpenEnd", "false") not in ("false", "0")
    return is_open or any(topology.is_free_end(*place) for place in places)


def _parts(source: Document, topology: Topology, element: Element, spots: Sequence[Element]) -> list[list[Element]]:
    """The places of an element, those of a border that several tracks end at apart, track by track."""
    name, by_track = source.attribute(element, "id"), dict[str, list[Element]]()
    for spot in spots if kind_of(element) == "border" else ():
        track, at_mm = placed(source, topology, name, spot)
        if not topology.is_free_end(track, at_mm) or (track not in by_track and _part_of(name, track) in source.by_id):
            return [list(spots)]
        by_track.setdefault(track, []).append(spot)
    return list(by_track.values()) or [list(spots)]


def _part_of(border: str, track: str) -> str:
    """The name of a border where it ends one more track."""
    return f"{border} on {track}"


def _sides(source: Document, topology: Topology, mark: Mark, name: str, spots: Sequence[Element]) -> set[int]:
    """The sides of its mark that an element is told to speak to, where the mark stands; none if one place says both."""
    joint, sides = topology.joint(mark.track, mark.at_mm), set()
    for spot in spots:
        place, direction = placed(source, topology, name, spot), spot.get("applicationDirection", "")
        if topology.joint(*place) != joint:
            continue
        if direction == "both":
            return set()
        if direction in DIRECTIONS:
            sides.add(topology.side_from(*place, DIRECTIONS[direction], mark.track))
    return sides


def spots_of(source: Document, topology: Topology, element: Element) -> list[Element]:
    """Where an element lies: on net elements of the finest level, or, if on none of them, on the others."""
    spots = list(source.all("spotLocation", element))
    return [each for each in spots if each.get("netElementRef") in topology.lengths_mm] or spots


def compare_places(
    source: Document, mark: str, name: str, spots: Sequence[Element], topology: Topology, findings: Findings
) -> None:
    """A place that is told twice is one place; ``mark``: the mark that stands there.

    By share of the net element and by metres; and of an element with several places, all are one, or ends of track
    that meet at one junction.

    Raises:
        BadInput: it lies nowhere.
    """
    for spot in spots:
        _compare_metres(source, mark, name, spot, topology, findings)
    places = {placed(source, topology, name, spot) for spot in spots}
    junctions = {topology.joined_at.get(place) for place in places}
    if len(places) > 1 and (len(junctions) > 1 or None in junctions):
        told = ", ".join(f"'{track}' at {at_mm:,} mm" for track, at_mm in sorted(places))
        text = f"'{name}' lies in {len(places)} places: {told}; no junction joins them: correct its spotLocations"
        findings.violation(ONE_PLACE, (name,), text)


def _compare_metres(
    source: Document, mark: str, name: str, spot: Element, topology: Topology, findings: Findings
) -> None:
    """Where a place is told by share of the net element and by metres, the two must be one place."""
    if spot.get("intrinsicCoord") is None or spot.get("pos") is None:
        return
    length_m = topology.lengths_mm[placed(source, topology, name, spot)[0]] / 1_000
    pos_m = source.number(spot, "pos", -LONGEST_M, LONGEST_M)
    share_m = source.number(spot, "intrinsicCoord", 0.0, 1.0) * length_m
    if abs(pos_m - share_m) > max(SAME_PLACE_M, SAME_SHARE * length_m):
        text = f"'{name}' lies at {share_m:,.1f} m by its intrinsicCoord, and at {pos_m:,.1f} m by its pos"
        findings.violation(ONE_PLACE, list(dict.fromkeys((name, mark))), f"{text}: correct one of the two")


ONE_WAY = "a signal speaks to trains of one direction"
ONE_PLACE = "an element lies in one place"
SAME_PLACE_M = 1.0
SAME_SHARE = 0.0001
"""So far the two may be apart: as a share is written with four digits."""


def placed(source: Document, topology: Topology, name: str, spot: Element) -> tuple[str, int]:
    """The net element that something lies on, and where on it in mm.

    Raises:
        BadInput: it lies nowhere.
    """
    track = source.attribute(spot, "netElementRef")
    if track not in topology.lengths_mm:
        missing = "not of the finest level" if track in source.by_id else "not there"
        raise source.bad(source.by_id[name], f"lies on net element '{track[:40]}', which is {missing}", "correct it")
    length_mm = topology.lengths_mm[track]
    for attribute in ("intrinsicCoord", "pos"):
        if spot.get(attribute) is not None:
            most = 1.0 if attribute == "intrinsicCoord" else length_mm / 1000
            value = source.number(spot, attribute, 0.0, most)
            return track, round(value * (length_mm if attribute == "intrinsicCoord" else 1000))
    raise source.bad(source.by_id[name], "its spotLocation has neither intrinsicCoord nor pos", "say where it lies")


def signal_of(source: Document, element: Element) -> Element:
    """The element on the track that an interlocking's element, such as a ``signalIL``, refers to."""
    seen = set()
    while kind_of(element) not in KINDS:
        refers = source.first("refersTo", element)
        name = element.get("id")
        if refers is None or name in seen:
            raise source.bad(element, "refers to no signal, detector, buffer stop or border", "add its refersTo")
        seen.add(name)
        element = source.referred(refers)
    return element
