"""Layout files with a danger each, written down before they were ever checked, and what must be said of it.

Every one was let pass once, or refused for another reason than its danger, but those that stand here for comparison.
"""

from __future__ import annotations

import json
from typing import Any

from tests.independent.layouts.crafted import NEAR, RING
from tests.independent.layouts.danger import UNREAD, danger_of
from tests.independent.layouts.dangerous_interlocking import DANGEROUS_INTERLOCKING
from tests.independent.layouts.dangerous_places import DANGEROUS_PLACES
from tests.independent.layouts.dangerous_railml import DANGEROUS_RAILML
from tests.independent.layouts.dangerous_routes import DANGEROUS_ROUTES
from tests.independent.layouts.dangerous_tables import DANGEROUS_TABLES
from tests.independent.layouts.dangerous_tracks import DANGEROUS_TRACKS
from tests.independent.layouts.dangerous_ways import DANGEROUS_WAYS
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


def groups(*names: str) -> list[dict[str, Any]]:
    """A type of switch with two groups, from A to B and from A to C."""
    ways = {name: [{"src": "A", "dst": leg}] for name, leg in zip(names, "BC", strict=True)}
    return [{"id": "own", "ports": ["A", "B", "C"], "groups": ways}]


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
AT_END = [{"id": "stop", "track": "t", "position": 900.0}]
AT_STOP = '"release_detectors": ["stop"]'
ONE_SWITCH = {"W": ("w", 800.0), "E": ("e", 100.0), "S": ("s", 100.0)}, [("main", "W", "E")]
SWITCHED = switch("own", A=("w", "END"), B=("e", "BEGIN"), C=("s", "BEGIN"))
NO_PORTS = [{"id": "odd", "ports": [], "groups": {"G": []}}]
NO_GROUPS = [{"id": "empty", "ports": [], "groups": {}}]
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

ONE_POINT = """
format = "heisoku-layout-1"
held_by_authority = "rest"
joints = []
[tracks]
w = { from = "west", to = "P.tip", length_mm = 900_000, boundaries = { W = 300_000, V = 800_000 } }
e = { from = "P.normal", to = "east", length_mm = 900_000, boundaries = { E = 100_000 } }
s = { from = "P.reverse", to = "south", length_mm = 900_000, boundaries = { S = 100_000 } }
[points]
P = {}
[blocks]
before = { track = "w", at_mm = 300_001 }
[routes]
in = { from = "W", direction = "forward", to = "E", points = { P = "normal" }, release_at = ["V"] }
out = { from = "V", direction = "backward", to = "W", points = { P = "normal" }, flank = {} }
"""

# ---- railML 2

GAUGES = """<trackElements><gaugeChanges><gaugeChange id="gauge" pos="1500" value="1067"/></gaugeChanges>
<axleWeightChanges><axleWeightChange id="weight" pos="10"/></axleWeightChanges></trackElements><ocsElements>"""
OFF = '<track id="T0"><state disabled="true"/>'

OTHERS = {
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
            [
                (
                    "<ocsElements>",
                    '<trackElements><radiusChange id="bend" radius="60"/></trackElements><ocsElements>',
                )
            ],
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
    "derailers.json": danger_of(
        railjson(LINE_OF_FOUR, [("r", "A", "B")], derailers=[{"id": "der"}, {}, "odd"], locks={"l": {"on": "t"}}),
        "derailers lie on the track, and locks that are no list: nothing knows of them",
        UNREAD,
        *("der", "derailers[1]", "derailers[2]", "locks"),
    ),
    "type without groups.json": danger_of(
        railjson(LINE_OF_FOUR, [("r", "A", "B")], extended_switch_types=NO_GROUPS),
        "a type of switch has no position at all",
        "has no groups",
    ),
    "groups alike.json": danger_of(
        railjson(*ONE_SWITCH, extended_switch_types=groups("plus", "plu\u0455"), switches=[SWITCHED]),
        "two positions of a switch have names that look the same: who lays it for one route reads the other's",
        "groups 'plus' and 'plu\\u0455' read alike",
    ),
    "type without ports.json": danger_of(
        railjson(LINE_OF_FOUR, [("r", "A", "B")], extended_switch_types=NO_PORTS, switches=[switch("odd")]),
        "a type of switch joins nothing: whatever stands there on the track is left out",
        "has fewer than two ports",
    ),
    "port of another.json": danger_of(
        railjson(LINE_OF_FOUR, [("r", "A", "B")], extended_switch_types=kind("odd", ("A", "C"), ports="A B")),
        "a type of switch joins a port that it has not: what lies there is not known",
        "names a port it has not, or one twice",
    ),
    "port twice.json": danger_of(
        railjson(
            LINE_OF_FOUR, [("r", "A", "B")], extended_switch_types=kind("odd", ("A", "B"), ("A", "C"), ports="A B C")
        ),
        "a type of switch joins a port with two others at once",
        "names a port it has not, or one twice",
    ),
    "stop for a detector.json": danger_of(
        railjson(LINE_OF_FOUR, [("r", "A", "D")], buffer_stops=AT_END).replace(
            '"exit_point": {"type": "Detector", "id": "D"}', '"exit_point": {"type": "Detector", "id": "stop"}'
        ),
        "a route ends at a detector of the name of a buffer stop: where it ends is not told",
        "there is no detector 'stop'",
    ),
    "exit that is gone.json": danger_of(
        railjson(LINE_OF_FOUR, [("r", "A", "D")]).replace(
            '"type": "Detector", "id": "D"', '"type": "Detector", "id": "Z"'
        ),
        "a route ends at a detector that is not there",
        "there is no detector 'Z'",
    ),
    "released at a stop.json": danger_of(
        railjson(LINE_OF_FOUR, [("r", "A", "D")], buffer_stops=AT_END).replace('"release_detectors": []', AT_STOP),
        "a route is released at a buffer stop",
        "there is no detector 'stop'",
    ),
    "released at nothing.json": danger_of(
        railjson(LINE_OF_FOUR, [("r", "A", "D")]).replace('"release_detectors": []', AT_STOP),
        "a route is released at a detector that is not there",
        "there is no detector 'stop'",
    ),
    "boundary at the beginning.toml": danger_of(
        ONE_POINT.replace("E = 100_000", "E = 0"),
        "a boundary lies at the very tips of a point: its tag is on which leg",
        "0 mm is not within the track",
    ),
    "boundary at the end.toml": danger_of(
        ONE_POINT.replace("V = 800_000", "V = 900_000"),
        "a boundary lies at the very tips of a point, before it",
        "900000 mm is not within the track",
    ),
    "block at a boundary.toml": danger_of(
        ONE_POINT.replace("300_001", "300_000"),
        "a block is named at the boundary of two: what is told of it may be of the other",
        "300000 mm is at a boundary",
    ),
    "released at the end.toml": danger_of(
        ONE_POINT.replace('["V"]', '["east"]'),
        "a route is released at an end of track",
        "there is no boundary 'east'",
    ),
    "released nowhere.toml": danger_of(
        ONE_POINT.replace('["V"]', '["Z"]'),
        "a route is released at a boundary that is not there",
        "there is no boundary 'Z'",
    ),
    "flank of no position.toml": danger_of(
        ONE_POINT.replace("flank = {}", 'flank = { P = "closed" }'),
        "the flank of a route wants a point in a position that it has not",
        "there is no position (of normal, reverse) 'closed'",
    ),
}
OTHERS_THAT_HOLD = {
    "type of its own.json": railjson(
        {"W": ("w", 800.0), "E": ("e", 100.0)},
        [("r", "W", "E")],
        extended_switch_types=kind("plain", ("A", "B"), ports="A B"),
        switches=[switch("plain", A=("w", "END"), B=("e", "BEGIN"))],
    ),
    "one point.toml": ONE_POINT,
}
"""Files that look much like these and hold."""
DANGERS = {
    **(DANGEROUS_TABLES | DANGEROUS_TRACKS | DANGEROUS_ROUTES),
    **(DANGEROUS_RAILML | DANGEROUS_INTERLOCKING | DANGEROUS_PLACES | DANGEROUS_WAYS | OTHERS),
}
"""Every file with what must be said of it."""
