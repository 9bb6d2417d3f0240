"""What stands in a railML file, may matter to safety, and is not read: told by id, and a verdict rests on it."""

from __future__ import annotations

from collections.abc import Mapping

from lxml import etree

from models.layouts.findings import Findings
from models.layouts.railml.document import Document, Element, kind_of

KEPT_OUT = "what it keeps off a route is held by nobody"
GUARDED = "whoever admits the line sees to it"
NOT_READ: Mapping[str, str] = {
    **dict.fromkeys(("derailerIS", "derailerIL", "derailer"), "no route proves that it lies off the rail"),
    **dict.fromkeys(("levelCrossingIS", "levelCrossingIL", "levelCrossing"), "no route asks whether it is closed"),
    **dict.fromkeys(("keyLockIS", "keyLockIL", "lock"), "no route proves that it is locked"),
    **dict.fromkeys(("tunnelGateIS", "tunnelGateIL", "movableBridge"), "no route proves that it is open to trains"),
    **dict.fromkeys(("restrictionArea", "restrictedArea", "weightLimit"), GUARDED),
    **dict.fromkeys(("speedSection", "speedChange"), "how fast a train may be follows from kinds of tags alone"),
    **dict.fromkeys(("trainProtectionElement", "atpDevice"), GUARDED),
    **dict.fromkeys(("workZone", "shuntingZone", "localOperationArea", "locallyControlledArea"), KEPT_OUT),
    **dict.fromkeys(("permissionZone", "dangerPoint", "genericDetector"), KEPT_OUT),
    **dict.fromkeys(("routeRelation", "combinedRoute"), "what they say is derived from the track, or not kept"),
    "movableCrossing": "it is read as a crossing that does not move",
    "hasPositionRestriction": "no route is kept from that position",
}
"""For each kind of element, in railML 2 or 3, what its being left out means."""
READ = (
    *("netElement", "netRelation", "switchIS", "crossing", "crossingIS", "switch", "track", "connection"),
    *("trainDetectionElement", "trainDetector", "trackCircuitBorder", "signalIS", "signal", "bufferStop", "border"),
    *("route", "overlap", "tvdSection", "conflictingRoute", "switchIL", "signalIL", "routeReleaseGroupRear"),
)


def say_what_is_not_read(source: Document, findings: Findings) -> None:
    """A remark for each kind that is not read, and one for what stands in another namespace than the document's."""
    for kind, means in NOT_READ.items():
        named = [_named(element) for element in source.all(kind)]
        if named:
            findings.remark(named, f"{len(named)} of {kind} are not read: {means}", "unread")
    foreign = [
        _named(element)
        for element in source.root.iter(etree.Element)
        if not source.is_own(element) and kind_of(element) in {*READ, *NOT_READ}
    ]
    if foreign:
        text = f"{len(foreign)} elements of another namespace than the document's are not read"
        findings.remark(foreign, text, "unread")


def _named(element: Element) -> str:
    """An element's id; without one, its kind and line."""
    return element.get("id") or f"{kind_of(element)} in line {element.sourceline}"
