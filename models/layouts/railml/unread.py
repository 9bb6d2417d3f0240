"""What stands in a railML file, may matter to safety, and is not read: told by id, and a verdict rests on it."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping

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
    **dict.fromkeys(("gaugeChange", "gaugeSection", "clearanceGaugeChange", "clearanceGaugeSection"), GUARDED),
    **dict.fromkeys(("loadingGauge", "axleWeightChange", "axleWeightSection", "meterLoadSection"), GUARDED),
    **dict.fromkeys(("gradientChange", "gradientCurve"), "the brake's bounds are taken to cover every slope"),
    **dict.fromkeys(("trackGauge", "horizontalCurve", "radiusChange"), GUARDED),
    "movableCrossing": "it is read as a crossing that does not move",
    "relatedMovableElement": "each point is held by the routes that need it, and not by one that moves with it",
    "linearCoordinate": "a place is taken by its coordinate along the net element alone, and not held against this",
    "hasPositionRestriction": "no route is kept from that position",
}
"""For each kind of element, in railML 2 or 3, what its being left out means."""
OUT_OF_USE: Mapping[str, Callable[[Element], bool]] = {
    "elementState": lambda state: state.get("value", "operational") != "operational",
    "state": lambda state: state.get("disabled", "false") not in ("false", "0"),
}
"""What says of the element that it stands in that this is not in use, in railML 3 and 2."""
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
    closed = [_named(each) for kind, out in OUT_OF_USE.items() for each in _holding(source, kind, out)]
    if closed:
        findings.remark(closed, f"{len(closed)} elements are not in use: routes run over them all the same", "unread")
    dated = [
        _named(each) for each in _holding(source, "isValid", lambda _: True) if kind_of(each) in {*READ, *NOT_READ}
    ]
    if dated:
        text = f"from when to when {len(dated)} elements are there is not read: routes run over them at any time"
        findings.remark(dated, text, "unread")
    one_way = [_named(each) for each in source.all("netRelation") if each.get("navigability") in ("AB", "BA")]
    if one_way:
        text = f"{len(one_way)} net relations are navigable one way alone: routes are taken both ways"
        findings.remark(one_way, text, "unread")
    foreign = [
        _named(element)
        for element in source.root.iter(etree.Element)
        if not source.is_own(element) and kind_of(element) in {*READ, *NOT_READ}
    ]
    if foreign:
        text = f"{len(foreign)} elements of another namespace than the document's are not read"
        findings.remark(foreign, text, "unread")


def _holding(source: Document, kind: str, out: Callable[[Element], bool]) -> Iterator[Element]:
    """The elements that one of a kind within them says are out of use."""
    for state in source.all(kind):
        holding = state.getparent()
        if holding is not None and out(state):
            yield holding


def _named(element: Element) -> str:
    """An element's id; without one, that of what it stands in, or its kind and line."""
    holding = element.getparent()
    around = None if holding is None else holding.get("id")
    return element.get("id") or around or f"{kind_of(element)} in line {element.sourceline}"
