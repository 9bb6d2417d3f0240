"""railML's interlocking read again, by the plain tree: branches, clearances, fouling, conflicts, what is unread."""

from __future__ import annotations

import xml.etree.ElementTree as Tree
from collections.abc import Mapping
from dataclasses import dataclass, field
from itertools import pairwise

UNREAD = {
    *("derailerIS", "derailerIL", "derailer", "levelCrossingIS", "levelCrossingIL", "levelCrossing", "keyLockIS"),
    *("keyLockIL", "lock", "tunnelGateIS", "tunnelGateIL", "movableBridge", "restrictionArea", "restrictedArea"),
    *("weightLimit", "speedSection", "speedChange", "trainProtectionElement", "atpDevice", "workZone"),
    *("shuntingZone", "localOperationArea", "locallyControlledArea", "permissionZone", "dangerPoint"),
    *("genericDetector", "routeRelation", "combinedRoute", "movableCrossing", "hasPositionRestriction"),
}
SAFETY = {
    *UNREAD,
    *("netElement", "netRelation", "switchIS", "crossing", "crossingIS", "switch", "track", "connection", "border"),
    *("trainDetectionElement", "trainDetector", "trackCircuitBorder", "signalIS", "signal", "bufferStop", "route"),
    *("overlap", "tvdSection", "conflictingRoute", "switchIL", "signalIL", "routeReleaseGroupRear"),
}


@dataclass
class Judged:
    """What follows from a file: ids that nobody reads, violations, clearances of legs, and conflicts as declared.

    ``legs``: (point, net element of the leg) -> mm.  ``fouling``: (point, detector).
    """

    unread: set[str] = field(default_factory=set)
    wrong: set[tuple[str, ...]] = field(default_factory=set)
    legs: dict[tuple[str, str], int] = field(default_factory=dict)
    fouling: set[tuple[str, str]] = field(default_factory=set)
    conflicts: set[tuple[str, str]] = field(default_factory=set)


def judged(text: str) -> Judged:
    """The file by its tree; of railML 2 only what is not read."""
    root = Tree.fromstring(text.encode())
    space = root.tag.partition("}")[0] + "}" if "}" in root.tag else ""
    found = Judged()
    by_id = {each.get("id"): each for each in root.iter() if each.get("id")}
    for element in root.iter():
        kind = element.tag.rpartition("}")[2]
        own = element.tag == space + kind
        if (own and kind in UNREAD) or (not own and kind in SAFETY):
            found.unread.add(element.get("id") or kind)
    for switch in root.iter(f"{space}switchIL"):
        refers = switch.find(f"{space}refersTo")
        point = by_id.get(refers.get("ref")) if refers is not None else None
        if point is not None and point.tag == f"{space}switchIS":
            _switch(found, switch, point, by_id, space)
    for row in root.iter(f"{space}conflictingRoute"):
        one = row.find(f"{space}refersToRoute")
        for other in row.iter(f"{space}conflictsWithRoute"):
            pair = sorted((str(one.get("ref")) if one is not None else "", str(other.get("ref"))))
            found.conflicts |= {(low, high) for low, high in pairwise(pair) if low != high}
    return found


def _switch(
    found: Judged, switch: Tree.Element, point: Tree.Element, by_id: Mapping[str | None, Tree.Element], space: str
) -> None:
    """A switch of the interlocking against that of the track."""
    name, il = str(point.get("id")), str(switch.get("id"))
    sides: dict[str, set[str]] = {}
    for side in ("left", "right"):
        branch = point.find(f"{space}{side}Branch")
        relation = by_id.get(branch.get("netRelationRef")) if branch is not None else None
        if relation is not None:
            sides[side] = {str(each.get("ref")) for each in relation if each.tag.rpartition("}")[2][:-1] == "element"}
    legs = {side: (sides[side] - sides[other]).pop() for side, other in (("left", "right"), ("right", "left"))}
    for side, leg in legs.items():
        branch = switch.find(f"{space}branch{side.title()}")
        if branch is None or branch.get("ref") is None:
            continue
        element = by_id[branch.get("ref")]
        is_track = element.tag == f"{space}track"
        told = {str(each.get("netElementRef")) for each in element.iter(f"{space}associatedNetElement")}
        told = told if is_track else {str(element.get("id"))} if element.tag == f"{space}netElement" else set()
        if not told or set(legs.values()) <= told:
            found.unread |= {il, name}
        elif leg not in told:
            found.wrong.add((name, il))
    tip = (sides["left"] & sides["right"]).pop()
    for item in switch.iter(f"{space}hasGaugeClearanceMarker"):
        marker = by_id[item.get("ref")]
        spot = next(marker.iter(f"{space}spotLocation"))
        element_id = str(spot.get("netElementRef"))
        if element_id not in (*legs.values(), tip):
            found.unread |= {name, str(marker.get("id"))}
            continue
        long_mm = round(float(str(by_id[element_id].get("length"))) * 1_000)
        at_mm = round(float(str(spot.get("intrinsicCoord"))) * long_mm)
        found.legs[name, element_id] = max(at_mm if _begins_at(name, element_id, by_id, space) else long_mm - at_mm, 1)
    found.fouling |= {(name, str(each.get("ref"))) for each in switch.iter(f"{space}hasFoulingTrainDetectors")}


def _begins_at(point: str, element: str, by_id: Mapping[str | None, Tree.Element], space: str) -> bool:
    """Whether a leg of a point is the beginning of its net element, by the relations of its branches."""
    for side in ("left", "right"):
        branch = by_id[point].find(f"{space}{side}Branch")
        relation = by_id[branch.get("netRelationRef")] if branch is not None else None
        for end in "AB" if relation is not None else "":
            there = relation.find(f"{space}element{end}") if relation is not None else None
            if there is not None and there.get("ref") == element:
                return relation is not None and relation.get(f"positionOn{end}") == "0"
    return True
