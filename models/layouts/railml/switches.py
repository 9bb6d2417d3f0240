"""railML's ``switchIL``, held against the ``switchIS`` it refers to, and what it tells of the point's clearance."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from itertools import combinations, product

from kernel.names import Block
from models.layouts.blocks import Blocks, walk
from models.layouts.findings import Findings
from models.layouts.railml.document import Document, Element, kind_of
from models.layouts.railml.marks import Marks, compare_places, placed, signal_of, spots_of
from models.layouts.railml.topology import Topology
from models.layouts.track import HIGH, Cut, Junction

BRANCHES = {"left": "branchLeft", "right": "branchRight"}
AGREE = "a switch has one left and one right branch"
ONE_MARKER = "a leg is clear from one place on"
FOULS = "a detector that fouls a point lies at its block"


@dataclass(frozen=True)
class Clearance:
    """What a file tells of its points' clearance: for a leg, its fouling point in mm; blocks that foul each other."""

    clear_mm: Mapping[tuple[str, str], int]
    fouls: Mapping[Block, frozenset[Block]]


def _switches(source: Document, topology: Topology) -> Iterator[tuple[Element, Junction]]:
    """Each ``switchIL`` with the point that it is on the track; that of a part of a slip with the whole."""
    for switch in source.all("switchIL"):
        refers = source.first("refersTo", switch)
        name = "" if refers is None else source.attribute(source.referred(refers), "id")
        name = topology.parts.get(name, name)
        if name in topology.junctions:
            yield switch, topology.junctions[name]


def compare_branches(source: Document, topology: Topology, findings: Findings) -> None:
    """Remark on branches that cannot be compared; those that contradict the point's on the track are a violation.

    Raises:
        BadInput: a branch refers to what is not there.
    """
    for switch, point in _switches(source, topology):
        name = source.attribute(switch, "id")
        elements = {
            side: _beyond(point, side) for side in BRANCHES if len(point.ports) == 3 and side in point.kind.positions
        }
        for side, word in BRANCHES.items():
            branch = source.first(word, switch)
            if branch is None or branch.get("ref") is None:
                continue
            told = _net_elements(source, source.referred(branch))
            if len(elements) < 2 or not told or set(elements.values()) <= told:
                findings.remark([name, point.name], f"switchIL '{name}': its {word} is not compared", "unread")
            elif elements[side] not in told:
                text = (
                    f"switchIL '{name}' has '{branch.get('ref')}' as its {word}, and switch '{point.name}' has "
                    f"'{elements[side]}': a route that wants it {side} is led elsewhere"
                )
                findings.violation(AGREE, (point.name, name), text)


def _beyond(point: Junction, side: str) -> str:
    """The net element that a point leads to in a position, seen from its tip."""
    (ways,) = point.kind.positions[side]
    shared = set.intersection(*(set(way) for each in point.kind.positions.values() for way in each))
    (port,) = set(ways) - shared
    return point.ports[port][0]


def _net_elements(source: Document, element: Element) -> set[str]:
    """The net elements that a branch stands for: one itself, or those of a track."""
    if kind_of(element) == "netElement":
        return {source.attribute(element, "id")}
    parts = source.all("associatedNetElement", element) if kind_of(element) == "track" else ()
    return {source.attribute(part, "netElementRef") for part in parts}


def read_clearance(source: Document, topology: Topology, marks: Marks, blocks: Blocks, findings: Findings) -> Clearance:
    """The fouling points that are marked, and the detectors that are said to lie before them.

    A leg that is marked in two places is a violation, and taken to be clear from the farther one.

    Raises:
        BadInput: one refers to what is not there, or lies nowhere.
    """
    clear_mm: dict[tuple[str, str], int] = {}
    fouls: dict[Block, frozenset[Block]] = {}
    compared: set[str] = set()
    for switch, point in _switches(source, topology):
        for item in source.all("hasGaugeClearanceMarker", switch):
            marker = signal_of(source, source.referred(item))
            name = source.attribute(marker, "id")
            if name not in marks.of and name not in compared:
                compare_places(source, name, name, spots_of(source, topology, marker), topology, findings)
            compared.add(name)
            found = _along(source, topology, point, marker)
            if found is None:
                text = f"clearance marker '{name}' does not lie on a leg of switch '{point.name}': it is not read"
                findings.remark([point.name, name], text, "unread")
            else:
                _note_clear(clear_mm, point.name, found, name, findings)
        fouling: list[str] = []
        for item in source.all("hasFoulingTrainDetectors", switch):
            detector = source.attribute(signal_of(source, source.referred(item)), "id")
            _foul(point, detector, marks, blocks, fouls, findings)
            fouling.append(marks.of.get(detector, detector))
        _foul_beside(point, fouling, blocks, fouls)
    return Clearance(clear_mm, fouls)


def _note_clear(
    clear_mm: dict[tuple[str, str], int], point: str, marked: tuple[str, int], marker: str, findings: Findings
) -> None:
    """Note where a leg is clear, which no other marker tells otherwise."""
    leg, at_mm = marked[0], max(marked[1], 1)
    before_mm = clear_mm.get((point, leg), at_mm)
    if before_mm != at_mm:
        text = (
            f"clearance marker '{marker}' lies {at_mm:,} mm behind switch '{point}' on its leg '{leg}', another one "
            f"{before_mm:,} mm: leave the one from which the leg is clear"
        )
        findings.violation(ONE_MARKER, (point, marker), text)
    clear_mm[point, leg] = max(before_mm, at_mm)


def _along(source: Document, topology: Topology, point: Junction, marker: Element) -> tuple[str, int] | None:
    """The leg that a marker lies on, and how far from the point."""
    spots = spots_of(source, topology, marker)
    if not spots:
        raise source.bad(marker, "has no place on the track", "add its spotLocation")
    track, at_mm = placed(source, topology, source.attribute(marker, "id"), spots[0])
    for port, (element, side) in point.ports.items():
        if element == track:
            return port, topology.lengths_mm[track] - at_mm if side == HIGH else at_mm
    return None


def _foul(
    point: Junction,
    detector: str,
    marks: Marks,
    blocks: Blocks,
    fouls: dict[Block, frozenset[Block]],
    findings: Findings,
) -> None:
    """The block behind a detector that proves nothing of a point's or crossing's clearance fouls its block."""
    mark = marks.of.get(detector)
    own = _block_of(blocks, point)
    sides = blocks.segments.beside.get(mark or "", {}).values()
    beside = {blocks.of[heading[0]] for heading in sides}
    if own not in beside:
        text = f"detector '{detector}' is said to foul switch '{point.name}', and does not bound its block"
        findings.violation(FOULS, (point.name, detector), text)
    for other in beside - {own} if own in beside else ():
        _bar(fouls, own, other)


def _block_of(blocks: Blocks, point: Junction) -> Block:
    """The block that all track at a point or crossing is."""
    return blocks.of[blocks.segments.leaving[next(iter(point.ports.values()))][0]]


def _bar(fouls: dict[Block, frozenset[Block]], one: Block, other: Block) -> None:
    """Two blocks foul each other."""
    fouls[one] = fouls.get(one, frozenset()) | {other}
    fouls[other] = fouls.get(other, frozenset()) | {one}


def _foul_beside(point: Junction, detectors: list[str], blocks: Blocks, fouls: dict[Block, frozenset[Block]]) -> None:
    """The blocks behind two detectors that foul one point, on legs that no position joins, foul each other."""
    own = _block_of(blocks, point)
    behind = {leg: _behind(blocks, point, leg, detectors) - {own} for leg in point.ports}
    for leg, other in combinations(point.ports, 2):
        if not point.kind.joined(leg, other):
            for one, beside in product(behind[leg], behind[other]):
                if one != beside:
                    _bar(fouls, one, beside)


def _behind(blocks: Blocks, point: Junction, leg: str, detectors: list[str]) -> set[Block]:
    """The blocks behind the detectors, of these, that a movement from a point along a leg comes to in its block."""
    start = blocks.segments.leaving[point.ports[leg]]
    met = walk(blocks.segments, [start], lambda joint, _: joint.junction != point.name)
    ends = (blocks.segments.at[heading] for heading in met)
    return {blocks.of[end.beyond[0]] for end in ends if isinstance(end, Cut) and end.mark in detectors}
