"""Layout files with a danger each, written down before they were ever checked, and what must be said of it.

Every one was let pass once, or refused for another reason than its danger, but those that stand here for comparison.
"""

from __future__ import annotations

import json
from typing import Any

from tests.independent.layouts.crafted import NEAR, RING
from tests.independent.layouts.danger import UNREAD, danger_of
from tests.independent.layouts.dangerous_tables import DANGEROUS_TABLES
from tests.independent.layouts.railml_2_pieces import HALF, LINE, TRACKS, changed, crossing

# ---- RailJSON

EMPTY: dict[str, Any] = {
    "version": "3.4.12",
    "switches": [],
    "extended_switch_types": [],
    "signals": [],
    "buffer_stops": [],
}


def railjson(marks: dict[str, tuple[str, float]], routes: list[tuple[str, str, str]], **more: Any) -> str:
    """Tracks of 900 m with detectors; routes along their tracks from one detector to another, without points."""
    tracks = dict.fromkeys(track for track, _ in marks.values())
    ends = {name: {"type": "Detector", "id": name} for name in marks}
    stops = {stop["id"]: {"type": "BufferStop", "id": stop["id"]} for stop in more.get("buffer_stops", [])}
    told = [
        {
            "id": name,
            "entry_point": ends[entry],
            "exit_point": {**stops, **ends}[last],
            "entry_point_direction": "START_TO_STOP",
            "release_detectors": [],
            "switches_directions": {},
        }
        for name, entry, last in routes
    ]
    data = {
        **EMPTY,
        "track_sections": [{"id": track, "length": 900.0} for track in tracks],
        "detectors": [{"id": name, "track": track, "position": at} for name, (track, at) in marks.items()],
        "routes": told,
    }
    return json.dumps({**data, **more})


def switch(kind: str, **ports: tuple[str, str]) -> dict[str, Any]:
    """One switch, of a type of the file's own."""
    ends = {port: {"track": track, "endpoint": end} for port, (track, end) in ports.items()}
    return {"id": "X", "switch_type": kind, "ports": ends, "group_change_delay": 0.0}


def kind(name: str, *ways: tuple[str, str], ports: str) -> list[dict[str, Any]]:
    """A type of switch with one group."""
    groups = {"G": [{"src": one, "dst": other} for one, other in ways]}
    return [{"id": name, "ports": ports.split(), "groups": groups}]


LINE_OF_FOUR = {"A": ("t", 100.0), "B": ("t", 300.0), "C": ("t", 600.0), "D": ("t", 800.0)}
STOPS = [{"id": "middle", "track": "t", "position": 450.0}]
CURVES = [{"radius": 90.0, "begin": 300.0, "end": 500.0}]
STEEP = {
    "id": "t",
    "length": 900.0,
    "curves": CURVES,
    "loading_gauge_limits": [{"category": "G1", "begin": 100.0, "end": 800.0}],
    "slopes": [{"gradient": -45.0, "begin": 300.0, "end": 800.0}],
}
ONE_WAY = {"id": "B", "track": "t", "position": 300.0, "applicable_directions": "STOP_TO_START"}
STUB = railjson(
    {"W": ("w", 800.0), "E": ("e", 100.0), "S": ("s", 100.0)},
    [("main", "W", "E")],
    extended_switch_types=kind("stub", ("A", "B"), ports="A B C"),
    switches=[switch("stub", A=("w", "END"), B=("e", "BEGIN"), C=("s", "BEGIN"))],
)
ANEW = railjson(
    {"W": ("w", 800.0), "E": ("e", 100.0), "N": ("n", 800.0), "S": ("s", 100.0)},
    [("w to s", "W", "S"), ("n to e", "N", "E")],
    extended_switch_types=kind("crossing", ("A1", "B2"), ("A2", "B1"), ports="A1 B1 A2 B2"),
    switches=[switch("crossing", A1=("w", "END"), B1=("e", "BEGIN"), A2=("n", "END"), B2=("s", "BEGIN"))],
)
CD = [{"id": name, "track": "t", "position": at} for name, (_, at) in LINE_OF_FOUR.items() if name != "B"]


BEYOND = [{"id": "stop", "track": "s", "position": 1.0}]
MIDDLE = [{"id": "stop", "track": "e", "position": 0.0}]

# ---- native

NAMES_ALIKE = """
format = "heisoku-layout-1"
held_by_authority = "rest"
fouling = [["B:a+b+c", "B:u+v"]]
[tracks]
one = { from = "w1", to = "e1", length_mm = 900_000, boundaries = { "a" = 300_000, "b+c" = 600_000 } }
two = { from = "w2", to = "e2", length_mm = 900_000, boundaries = { "a+b" = 300_000, "c" = 600_000 } }
three = { from = "w3", to = "e3", length_mm = 900_000, boundaries = { u = 300_000, v = 600_000 } }
[routes]
one = { from = "a", direction = "forward", to = "b+c" }
two = { from = "a+b", direction = "forward", to = "c" }
three = { from = "u", direction = "forward", to = "v" }
"""

# ---- railML 3


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
GAUGES = """<trackElements><gaugeChanges><gaugeChange id="gauge" pos="1500" value="1067"/></gaugeChanges>
<axleWeightChanges><axleWeightChange id="weight" pos="10"/></axleWeightChanges></trackElements><ocsElements>"""
TURNOUT = (
    relation("we", "w", "e")
    + relation("ws", "w", "s")
    + relation("es", "e", "s", "None").replace('positionOnA="1"', 'positionOnA="0"')
)
ON_LEGS = spot("A", "w", "0.4") + spot("B", "w", "0.8") + spot("C", "e", "0.2") + spot("D", "e", "0.8")
SWITCHES = """<switchIS id="P"><leftBranch netRelationRef="we"/><rightBranch netRelationRef="ws"/></switchIS>"""
AGAIN = """<switchIS id="R"><leftBranch netRelationRef="ws"/><rightBranch netRelationRef="we"/></switchIS>"""
AT_END = '<spotLocation netElementRef="{}" intrinsicCoord="1.0" applicationDirection="normal"/>'
BORDER = '<border id="edge"><spotLocation netElementRef="s" intrinsicCoord="0.0"/></border>'
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


def level(*names: str) -> str:
    """A network whose level Micro lists these."""
    listed = "".join(f'<networkResource ref="{name}"/>' for name in names)
    return f'<network><level descriptionLevel="Micro">{listed}</level></network>'


OFF = '<track id="T0"><state disabled="true"/>'

DANGERS = DANGEROUS_TABLES | {
    "no train.toml": danger_of(
        RING.replace("699_999", "1"),
        "the longest train is told to have 1 mm, so every train is longer, and the ring of 700 m lets one meet itself",
        "the longest train is a train",
    ),
    "clear at once.toml": danger_of(
        NEAR.replace("reverse = 7_000, normal = 6_000", "reverse = 1, normal = 1").replace("S = 7_000", "S = 500"),
        "both legs are told to be clear 1 mm from the point, where no two tracks are: a train behind S is foul",
        "a leg is told to be clear where tracks are apart",
        *("Q", "reverse"),
    ),
    "stop midway.json": danger_of(
        railjson(LINE_OF_FOUR, [("r", "A", "middle")], buffer_stops=STOPS),
        "a buffer stop stands in the middle of a track that goes on with detectors: trains meet at it from both sides",
        "where the file has track go on",
        *("middle", "t"),
    ),
    "stop at a joint.json": danger_of(
        railjson(
            {"W": ("w", 300.0), "E": ("e", 300.0), "F": ("e", 600.0)},
            [("r", "W", "stop"), ("s", "E", "F")],
            buffer_stops=MIDDLE,
            switches=[switch("link", A=("w", "END"), B=("e", "BEGIN"))],
        ),
        "a buffer stop stands exactly where two tracks are joined: trains meet at it from both sides",
        "no track goes on behind a buffer stop at a joint",
        *("stop", "e", "X"),
    ),
    "stop on a leg.json": danger_of(
        railjson(
            {"W": ("w", 800.0), "E": ("e", 100.0), "S": ("s", 100.0), "T": ("s", 600.0)},
            [("r", "S", "T")],
            buffer_stops=BEYOND,
            switches=[switch("point_switch", A=("w", "END"), B1=("e", "BEGIN"), B2=("s", "BEGIN"))],
        ),
        "behind a buffer stop 1 m from a switch track goes on: a train behind it is foul of the other leg",
        "boundary 'stop' lies 1,000 mm behind 'X'",
        *("X", "stop"),
    ),
    "names alike.toml": danger_of(
        NAMES_ALIKE,
        "blocks between a and b+c and between a+b and c get one name: the second does not foul what it was meant to",
        "is made of the names of boundaries, and so is that of another block",
    ),
    "stub.json": danger_of(
        STUB,
        "a leg of a switch is joined in no position: what rolls from there runs onto closed rails",
        "port 'C' is in no group",
    ),
    "crossing anew.json": danger_of(
        ANEW,
        "the file makes another thing of the type called crossing: what reads as two lines across is two curves",
        "has the id of a type that every file has",
    ),
    "steep.json": danger_of(
        railjson(LINE_OF_FOUR, [("r", "A", "C")], track_sections=[STEEP]),
        "45 per mille down to the exit, through a curve of 90 m, with a loading gauge limit: nothing knows of it",
        UNREAD,
        "t",
    ),
    "detector one way.json": danger_of(
        railjson(LINE_OF_FOUR, [("r", "A", "B")], detectors=[ONE_WAY, *CD]),
        "a detector counts trains of one direction alone, and bounds blocks for both",
        UNREAD,
        "B",
    ),
    "end joined twice.railml": danger_of(
        changed(TRACKS, [('id="y-A" ref="y-B"/>', 'id="y-A" ref="y-B"/><connection id="z-A" ref="z-B"/>'), LINE]),
        "two tracks are joined to one end of a third without a switch: they merge unseen",
        "second connection",
    ),
    "both to the right.railml": danger_of(
        changed(TRACKS, [('<switch id="P"', '<switch id="P" trackContinueCourse="right"')]),
        "track and branch go on to the right at one switch: one of its positions has the other's name",
        "and so does its branch",
    ),
    "gauge.railml": danger_of(
        changed(TRACKS, [("<ocsElements>", GAUGES)]),
        "the gauge changes within a route, and what axles the track carries",
        UNREAD,
        *("gauge", "weight"),
    ),
    "curve.railml": danger_of(
        changed(
            TRACKS,
            [("<ocsElements>", '<trackElements><radiusChange id="bend" radius="60"/></trackElements><ocsElements>')],
        ),
        "a curve of 60 m within a route",
        UNREAD,
        "bend",
    ),
    "slip told twice.railml": danger_of(
        crossing("doubleSwitchCrossing", "y1", "y2", HALF),
        "a double slip is told on both of its tracks: which way round these run, and so which legs meet, is not told",
        "which legs meet is not told",
    ),
    "disabled.railml": danger_of(
        changed(TRACKS, [('<track id="T0">', OFF)]),
        "the track is out of use, and routes run over it",
        "not in use",
        "T0",
    ),
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
        "the only one there, runs over 50 m of it",
        *("e", "T"),
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
