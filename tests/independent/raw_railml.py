"""railML's interlocking read again, by the plain tree: branches, clearances, fouling, conflicts, what is unread."""

from __future__ import annotations

import xml.etree.ElementTree as Tree
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field
from itertools import pairwise

from tests.independent import raw_railml_2

UNREAD = {
    *("derailerIS", "derailerIL", "derailer", "levelCrossingIS", "levelCrossingIL", "levelCrossing", "keyLockIS"),
    *("keyLockIL", "lock", "tunnelGateIS", "tunnelGateIL", "movableBridge", "restrictionArea", "restrictedArea"),
    *("weightLimit", "speedSection", "speedChange", "trainProtectionElement", "atpDevice", "workZone"),
    *("shuntingZone", "localOperationArea", "locallyControlledArea", "permissionZone", "dangerPoint"),
    *("genericDetector", "routeRelation", "combinedRoute", "movableCrossing", "hasPositionRestriction"),
    *("gaugeChange", "gaugeSection", "clearanceGaugeChange", "clearanceGaugeSection", "loadingGauge"),
    *("axleWeightChange", "axleWeightSection", "meterLoadSection", "gradientChange", "gradientCurve"),
    *("trackGauge", "horizontalCurve", "radiusChange", "relatedMovableElement"),
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

    ``legs``: (point, net element of the leg) -> mm.  ``fouling``: (point, detector).  ``no_main``: signals of railML 2
    at which no route begins.
    """

    unread: set[str] = field(default_factory=set)
    wrong: set[tuple[str, ...]] = field(default_factory=set)
    legs: dict[tuple[str, str], int] = field(default_factory=dict)
    fouling: set[tuple[str, str]] = field(default_factory=set)
    conflicts: set[tuple[str, str]] = field(default_factory=set)
    no_main: set[str] = field(default_factory=set)


def judged(text: str) -> Judged:
    """The file by its tree; of railML 2 only what is not read."""
    root = Tree.fromstring(text.encode())
    space = root.tag.partition("}")[0] + "}" if "}" in root.tag else ""
    found = Judged()
    by_id = {each.get("id"): each for each in root.iter() if each.get("id")}
    found.unread |= set(_unread(root, space))
    for signal in root.iter(f"{space}signal") if is_version_2(text) else ():
        if signal.get("type", "main") not in ("main", "combined"):
            found.no_main.add(str(signal.get("id")))
        elif signal.get("dir") not in ("up", "down"):
            found.unread.add(str(signal.get("id")))
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


def _unread(root: Tree.Element, space: str) -> Iterator[str]:
    """What is not read: by its kind, by its namespace, by its one way, or because it is out of use."""
    for element in root.iter():
        kind = element.tag.rpartition("}")[2]
        own, name = element.tag == space + kind, element.get("id") or kind
        if (own and kind in UNREAD) or (not own and kind in SAFETY):
            yield name
        if kind == "netRelation" and element.get("navigability") in ("AB", "BA"):
            yield name
        for state in element:
            if state.tag == f"{space}elementState" and state.get("value") not in (None, "operational"):
                yield name
            if state.tag == f"{space}state" and state.get("disabled") in ("true", "1"):
                yield name


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


VERSIONS = {f"2.{minor}" for minor in range(6)} | {"3.1", "3.2", "3.3"}
REFERENCES = ("ref", "netElementRef", "netRelationRef")


def is_version_2(text: str) -> bool:
    """Whether a document tells track by tracks that connect."""
    return Tree.fromstring(text.encode()).get("version", "").startswith("2")


def broken(text: str) -> str | None:
    """What makes a text no railML document, or nothing of rails: told of the first such thing; nothing if none is.

    Of version 3 only what holds of all its elements is asked; of version 2 its tracks are read.
    """
    try:
        root = Tree.fromstring(text.encode())
    except Tree.ParseError:
        return "no XML"
    space = root.tag.partition("}")[0] + "}" if "}" in root.tag else ""
    if root.tag.rpartition("}")[2].lower() != "railml" or root.get("version") not in VERSIONS:
        return "no railML of a version that is read"
    if "<!ENTITY" in text:
        return "an entity"
    own = [each for each in root.iter() if each.tag.startswith(space)]
    ids = [str(each.get("id")) for each in own if each.get("id") is not None]
    if "" in ids or len(set(ids)) < len(ids):
        return "an id that is empty or stands twice"
    if is_version_2(text):
        try:
            raw_railml_2.data_of(text)
        except raw_railml_2.Broken as fault:
            return str(fault)
        return None
    for each in own:
        kind = each.tag.removeprefix(space)
        if any(each.get(name) not in (None, *ids) for name in REFERENCES):
            return f"{each.get('id')}: refers to nothing"
        if kind == "netElement" and not _between(each.get("length"), 0.001, 1_000_000):
            return f"{each.get('id')}: length"
        if kind == "spotLocation" and not _between(each.get("intrinsicCoord", "0"), 0, 1):
            return f"{each.get('id')}: intrinsicCoord"
        if kind in ("leftBranch", "rightBranch") and each.get("netRelationRef") is None:
            return "a branch of nothing"
    return _torn_apart(own, space)


def _torn_apart(own: list[Tree.Element], space: str) -> str | None:
    """A switch or crossing whose ends of track do not all meet, by the relations, or are two alone."""
    ends: dict[str, set[tuple[str | None, str | None]]] = {}
    for each in own:
        if each.tag == f"{space}netRelation":
            sides = ((side, each.find(f"{space}element{side}")) for side in "AB")
            ends[str(each.get("id"))] = {
                (there.get("ref"), each.get(f"positionOn{side}")) for side, there in sides if there is not None
            }
    for each in own:
        named = [str(branch.get("netRelationRef")) for branch in each if branch.tag.endswith("Branch")]
        if each.tag.removeprefix(space) not in ("switchIS", "crossing", "crossingIS") or not named:
            continue
        met = set(ends.get(named[0], ()))
        while more := {end for other in ends.values() if other & met for end in other} - met:
            met |= more
        if len(met) < 3 or not all(ends.get(name, set()) <= met for name in named):
            return f"{each.get('id')}: its ends of track do not meet"
    return None


def _between(text: str | None, least: float, most: float) -> bool:
    try:
        return text is not None and least <= float(text) <= most
    except ValueError:
        return False
