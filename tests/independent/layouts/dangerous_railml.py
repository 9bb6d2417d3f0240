"""railML 3 files with a danger each (:mod:`dangerous`)."""

from __future__ import annotations

from tests.independent.layouts.danger import UNREAD, danger_of


def railml(relations: str, spots: str, functional: str = "", assets: str = "", networks: str = "") -> str:
    """Four net elements of 500 m, what relates them, and routes from A to B and from C to D."""
    elements = "".join(f'<netElement id="{name}" length="500"/>' for name in "wens")
    routes = "".join(
        f'<route id="{one}{other}"><routeEntry id="{one}e"><refersTo ref="{one}"/></routeEntry>'
        f'<routeExit id="{other}x"><refersTo ref="{other}"/></routeExit></route>'
        for one, other in ("AB", "CD")
    )
    return (
        '<railML xmlns="https://www.railml.org/schemas/3.1" version="3.1"><infrastructure><topology>'
        f"<networks>{networks}</networks>"
        f"<netElements>{elements}</netElements><netRelations>{relations}</netRelations></topology>"
        f"<functionalInfrastructure>{functional}{spots}</functionalInfrastructure></infrastructure>"
        f"<interlocking><assetsForIL>{routes}{assets}</assetsForIL></interlocking></railML>"
    )


def relation(name: str, one: str, other: str, way: str = "Both") -> str:
    """The end of one net element meets the beginning of another."""
    ends = f'<elementA ref="{one}"/><elementB ref="{other}"/>'
    return f'<netRelation id="{name}" positionOnA="1" positionOnB="0" navigability="{way}">{ends}</netRelation>'


def spot(name: str, track: str, share: str, more: str = "") -> str:
    """A signal and a detector in one place."""
    place = f'netElementRef="{track}" intrinsicCoord="{share}"'
    return (
        f'<signalIS id="{name}">{more}<spotLocation {place} applicationDirection="normal"/></signalIS>'
        f'<trainDetectionElement id="{name} tags">{more}<spotLocation {place}/></trainDetectionElement>'
    )


BOTH = relation("we", "w", "e") + relation("ns", "n", "s")
SPOTS = spot("A", "w", "0.8") + spot("B", "e", "0.2") + spot("C", "n", "0.8") + spot("D", "s", "0.2")
ELSEWHERE = '<spotLocation netElementRef="w" intrinsicCoord="0.95" applicationDirection="normal"/>'
CROSSES = '<crossing id="X"><straightBranch netRelationRef="we"/>{}</crossing>'
CLOSED = """<track id="T"><elementState value="closed"/><linearLocation><associatedNetElement netElementRef="e"/>
</linearLocation></track>"""
TURNOUT = (
    relation("we", "w", "e")
    + relation("ws", "w", "s")
    + relation("es", "e", "s", "None").replace('positionOnA="1"', 'positionOnA="0"')
)
ON_LEGS = spot("A", "w", "0.4") + spot("B", "w", "0.8") + spot("C", "e", "0.2") + spot("D", "e", "0.8")
SWITCHES = """<switchIS id="P"><leftBranch netRelationRef="we"/><rightBranch netRelationRef="ws"/></switchIS>"""
AGAIN = """<switchIS id="R"><leftBranch netRelationRef="ws"/><rightBranch netRelationRef="we"/></switchIS>"""
AT_END = '<spotLocation netElementRef="{}" intrinsicCoord="1.0" applicationDirection="normal"/>'
BORDER = '<border id="edge" isOpenEnd="true"><spotLocation netElementRef="s" intrinsicCoord="0.0"/></border>'
MARKERS = "".join(
    f'<signalIS id="{name}"><spotLocation netElementRef="e" intrinsicCoord="{share}"/></signalIS>'
    for name, share in (("far", "0.16"), ("near", "0.1"))
)
BUFFER = """<bufferStop id="wall"><spotLocation netElementRef="e" intrinsicCoord="1.0"/></bufferStop>
</functionalInfrastructure>"""
COUPLED = '<switchIL id="il"><refersTo ref="P"/><relatedMovableElement ref="il"/></switchIL>'
MARKED = """<switchIL id="il"><refersTo ref="P"/><hasGaugeClearanceMarker ref="far"/>
<hasGaugeClearanceMarker ref="near"/></switchIL>"""
CURVED = '<trackGauge id="broad" value="1524"/><horizontalCurve id="bend" radius="60"/>'
SHORT_OF_IT = '<overlap id="o" length="300.001"><activeForApproachRoute ref="CD"/></overlap>'
OVERLAP = '<overlap id="o" length="{}">{}</overlap>'
OF_AB = '<activeForApproachRoute ref="AB"/><isLimitedBy ref="C"/>'
TURNS = '<{0} inPosition="{1}"><refersToSwitch ref="P"/></{0}>'
OVER_P = spot("A", "w", "0.8") + spot("B", "e", "0.2") + spot("C", "e", "0.6") + spot("D", "e", "0.8")
LIMITS_P = OVERLAP.format("1", OF_AB + TURNS.format("requiresSwitchInPosition", "right"))
MARKER = '<signalIS id="mark">{}</signalIS>'
ONE_MARKER = '<switchIL id="il"><refersTo ref="P"/><hasGaugeClearanceMarker ref="mark"/></switchIL>'
ON_E = '<spotLocation netElementRef="e" intrinsicCoord="0.06"{}/>'
LONG_TRACK = """<track id="T"><linearLocation><associatedNetElement netElementRef="e"{}/></linearLocation>
<length value="{}" type="{}"/></track>"""
CROSSING = BOTH + relation("wn", "w", "n", "None").replace('positionOnB="0"', 'positionOnB="1"')
FOULED = '<switchIL id="il"><refersTo ref="X"/><hasFoulingTrainDetectors ref="{}"/></switchIL>'
BACK = '<spotLocation netElementRef="{}" intrinsicCoord="{}" applicationDirection="{}"/>'
HEAD_ON = relation("we", "w", "e").replace('positionOnB="0"', 'positionOnB="1"') + relation("ns", "n", "s")
ROUND = BOTH + relation("ew", "e", "w")
ON_RING = spot("A", "w", "0.2") + spot("B", "w", "0.6") + spot("G", "e", "0.5") + spot("C", "n", "0.8")


def level(*names: str) -> str:
    """A network whose level Micro lists these."""
    listed = "".join(f'<networkResource ref="{name}"/>' for name in names)
    return f'<network><level descriptionLevel="Micro">{listed}</level></network>'


LINES_END = '<border id="edge">' + BACK.format("w", "0.0", "both") + BACK.format("n", "{}", "both") + "</border>"

DANGEROUS_RAILML = {
    "crossing apart.railml": danger_of(
        railml(BOTH, SPOTS, CROSSES.format('<turningBranch netRelationRef="ns"/>')),
        "two lines cross on the level; a crossing names both, no relation says that they meet: trains collide",
        "two ends of track meet here, and none of another track",
    ),
    "crossing of one.railml": danger_of(
        railml(BOTH, SPOTS, CROSSES.format("")),
        "the same, and the crossing names one of the lines alone",
        "two ends of track meet here, and none of another track",
    ),
    "one way.railml": danger_of(
        railml(relation("we", "w", "e", "BA") + relation("ns", "n", "s"), SPOTS),
        "track may be run over one way alone, and the route runs the other",
        "navigable one way",
        "we",
    ),
    "two places.railml": danger_of(
        railml(BOTH, SPOTS.replace(spot("B", "e", "0.2"), spot("B", "e", "0.2", ELSEWHERE))),
        "a signal and its detector lie in two places, 125 m apart: a train stands behind the wrong one",
        "an element lies in one place",
        "B",
    ),
    "ends apart.railml": danger_of(
        railml(BOTH, SPOTS.replace(spot("B", "e", "0.2"), spot("B", "e", "1.0", AT_END.format("w")))),
        "a signal and its detector lie at two ends of track that do not meet, 500 m apart",
        "no junction joins them",
        "B",
    ),
    "border at a switch.railml": danger_of(
        railml(TURNOUT, ON_LEGS, SWITCHES + BORDER),
        "a border stands at the switch, with track behind it: a train there is foul of the other leg",
        "no track goes on behind a buffer stop at a joint",
        *("edge", "s", "P"),
    ),
    "overlap too long.railml": danger_of(
        railml(
            TURNOUT, ON_LEGS.replace('"e" intrinsicCoord="0.8"', '"e" intrinsicCoord="0.4"'), SWITCHES, SHORT_OF_IT
        ).replace("</functionalInfrastructure>", BUFFER),
        "an overlap is told to be longer than the track behind the exit: a train slips through the buffer stop",
        "there is as much track as an overlap is long",
        *("CD", "o", "wall"),
    ),
    "overlap of nothing.railml": danger_of(
        railml(TURNOUT, ON_LEGS, SWITCHES, OVERLAP.format("30", "")),
        "an overlap names no route, and is claimed by none",
        "an overlap belongs to a route",
        "o",
    ),
    "overlap of no exit.railml": danger_of(
        railml(TURNOUT, ON_LEGS, SWITCHES, OVERLAP.format("30", '<relatedToTrackAsset ref="C tags"/>')),
        "an overlap is told for a place where no route ends, and is claimed by none",
        "an overlap belongs to a route",
        *("o", "C tags"),
    ),
    "overlap of a detector.railml": danger_of(
        railml(TURNOUT, ON_LEGS, SWITCHES, OVERLAP.format("150", '<relatedToTrackAsset ref="D tags"/>')).replace(
            "</functionalInfrastructure>", BUFFER
        ),
        "an overlap is told for the detector in the exit's place, and is longer than the track behind it",
        "there is as much track as an overlap is long",
        *("CD", "o", "wall"),
    ),
    "overlap beyond its limit.railml": danger_of(
        railml(TURNOUT, ON_LEGS, SWITCHES, OVERLAP.format("300", OF_AB)),
        "an overlap of 300 m is limited 200 m behind the exit: a train slips 100 m beyond what is claimed",
        "there is as much track as an overlap is long",
        *("AB", "o", "C tags"),
    ),
    "overlap against its route.railml": danger_of(
        railml(TURNOUT, OVER_P, SWITCHES, LIMITS_P),
        "an overlap wants a point right that its route runs over to the left",
        "overlap 'o' wants switch 'P' in 'right'",
        *("AB", "o", "P"),
    ),
    "two positions.railml": danger_of(
        railml(TURNOUT, OVER_P, SWITCHES).replace(
            '<routeEntry id="Ae">',
            TURNS.format("facingSwitchInPosition", "right")
            + TURNS.format("switchInPosition", "left")
            + '<routeEntry id="Ae">',
        ),
        "a route wants one point right and left",
        "in 'right' and in 'left'",
        *("AB", "P"),
    ),
    "marker told twice.railml": danger_of(
        railml(TURNOUT, ON_LEGS, SWITCHES + MARKER.format(ON_E.format(' pos="90"')), ONE_MARKER),
        "a leg is told to be clear from 30 m on and from 90 m on: a train would stand foul",
        "an element lies in one place",
        "mark",
    ),
    "marker in two places.railml": danger_of(
        railml(
            TURNOUT, ON_LEGS, SWITCHES + MARKER.format(ON_E.format("") + ON_E.format("").replace("6", "8")), ONE_MARKER
        ),
        "a clearance marker lies in two places on one leg",
        "an element lies in one place",
        "mark",
    ),
    "track shorter.railml": danger_of(
        railml(BOTH, SPOTS, LONG_TRACK.format("", "50", "physical")),
        "a net element is told to be 500 m long, and its track 50 m",
        "a net element has one length",
        *("e", "T"),
    ),
    "track of a part.railml": danger_of(
        railml(BOTH, SPOTS, LONG_TRACK.format(' posBegin="0" posEnd="50"', "50", "physical")),
        "the only track over a net element of 500 m runs over 50 m of it",
        "the only one there, runs over",
        *("e", "T"),
    ),
    "crossing fouled from afar.railml": danger_of(
        railml(CROSSING, SPOTS + spot("E", "w", "0.2"), CROSSES.format(""), FOULED.format("E tags")),
        "a detector is told to foul a crossing from which it lies a block away",
        "does not bound its block",
        *("X", "E tags"),
    ),
    "both ways round.railml": danger_of(
        railml(ROUND, ON_RING + spot("D", "s", "0.2")).replace(
            '<signalIS id="A">', '<signalIS id="A">' + BACK.format("w", "0.2", "reverse")
        ),
        "the entry of a route on a ring speaks to trains of both directions: the route may run either way round",
        "says of no one direction",
    ),
    "exit both ways.railml": danger_of(
        railml(BOTH, SPOTS).replace('<signalIS id="B">', '<signalIS id="B">' + BACK.format("e", "0.2", "reverse")),
        "a signal that a route ends at is told to speak to trains of both directions",
        "a signal speaks to trains of one direction",
        "B",
    ),
    "both ways at a joint.railml": danger_of(
        railml(
            HEAD_ON, spot("B", "e", "1.0", BACK.format("w", "1.0", "normal")) + SPOTS.replace(spot("B", "e", "0.2"), "")
        ),
        "the ends of two tracks meet, and a signal there speaks to trains that leave each of them",
        "a signal speaks to trains of one direction",
        "B",
    ),
    "border within a track.railml": danger_of(
        railml(BOTH, SPOTS, LINES_END.format("0.1")),
        "a border lies at the end of one track, and within another one",
        "an element lies in one place",
        "edge",
    ),
    "two networks.railml": danger_of(
        railml(BOTH, SPOTS, networks=level("w", "e", "n")),
        "a relation leads on from known track to an element that no level Micro lists",
        "which is on no level Micro",
    ),
    "on no level.railml": danger_of(
        railml(BOTH, SPOTS, networks=level(*"wens")).replace(
            "<netElements>", '<netElements><netElement id="z" length="5"/>'
        ),
        "track of which no level says that it is there is not read",
        "not read",
        "z",
    ),
    "two markers.railml": danger_of(
        railml(TURNOUT, ON_LEGS, SWITCHES + MARKERS, MARKED),
        "two markers say of one leg where it is clear: the nearer would let a train stand foul",
        "a leg is clear from one place on",
        *("P", "near"),
    ),
    "two switches.railml": danger_of(
        railml(TURNOUT, ON_LEGS, SWITCHES + AGAIN),
        "two switches are told of one place, with left and right the other way round",
        "is a branch of switchIS 'P' as well",
    ),
    "coupled.railml": danger_of(
        railml(TURNOUT, ON_LEGS, SWITCHES, COUPLED),
        "a switch moves with another one, and is thrown under a train when that is",
        UNREAD,
        "il",
    ),
    "gauges and curves.railml": danger_of(
        railml(BOTH, SPOTS, CURVED),
        "the gauge of track, and a curve of 60 m",
        UNREAD,
        *("broad", "bend"),
    ),
    "not yet there.railml": danger_of(
        railml(BOTH, SPOTS, CLOSED.replace('<elementState value="closed"/>', '<isValid from="2999-01-01"/>')),
        "the track that a route runs over is not yet there",
        "from when to when",
        "T",
    ),
    "closed.railml": danger_of(
        railml(BOTH, SPOTS, CLOSED),
        "the track that a route runs over is closed",
        "not in use",
        "T",
    ),
}
"""Every file with what must be said of it."""

ONE_SIGN = SPOTS.replace(spot("B", "e", "0.2"), "{}") + spot("F", "e", "0.5")
AT_W, AT_E = BACK.format("w", "1.0", "normal"), BACK.format("e", "{}", "{}")
APART = '<signalIS id="B">{}</signalIS><trainDetectionElement id="B tags">{}</trainDetectionElement>'
SECTIONS = "".join(
    f'<tvdSection id="{border}{detector}"><hasDemarcatingBorder ref="{border}"/>'
    f'<hasDemarcatingTraindetector ref="{detector} tags"/></tvdSection>'
    for border, detector in (("edge", "A"), ("edge", "C"))
)
RAILML_THAT_HOLD = {
    "border of two tracks.railml": railml(BOTH, SPOTS, LINES_END.format("0.0"), SECTIONS),
    "two lines.railml": railml(BOTH, SPOTS),
    "joint on both tracks.railml": railml(BOTH, ONE_SIGN.format(APART.format(AT_E.format("0.0", "normal"), AT_W))),
    "tracks that meet head on.railml": railml(
        HEAD_ON, ONE_SIGN.format(APART.format(AT_E.format("1.0", "reverse") + AT_W, AT_W))
    ),
}
"""Files that look much like these and hold."""
