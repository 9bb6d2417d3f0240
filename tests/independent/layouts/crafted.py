"""Small layouts, each made for one question of where a train stands in its start block, or of a point beside a path."""

from __future__ import annotations

import json

TWO_LEGS = """
format = "heisoku-layout-1"
held_by_authority = "rest"
[tracks.line]
from = "west"
to = "P.tip"
length_mm = 1_000_000
boundaries = { W0 = 400_000, W = 900_000 }
[tracks.a]
from = "P.normal"
to = "stop a"
length_mm = 300_000
boundaries = { A = 100_000 }
[tracks.b]
from = "P.reverse"
to = "stop b"
length_mm = 300_000
boundaries = { B = 100_000 }
[points]
P = {}
[routes."to a"]
from = "W"
direction = "forward"
to = "A"
points = { P = "normal" }
[routes."on b"]
from = "B"
direction = "forward"
to = "stop b"
[routes."out from b"]
from = "W"
direction = "backward"
to = "W0"
points = { P = "reverse" }
"""
"""A block of three boundaries: from one leg a train is not to be let go as if it stood on the other."""

NO_TRACK = TWO_LEGS.replace('to = "stop b"\n[routes."out', 'to = "stop b"\npoints = { P = "normal" }\n[routes."out')
"""The point that a route names shuts the leg that it leaves its start over."""

BALLOON = """
format = "heisoku-layout-1"
held_by_authority = "rest"
[tracks.line]
from = "west"
to = "P.tip"
length_mm = 1_000_000
boundaries = { W0 = 400_000, W = 900_000 }
[tracks.a]
from = "P.normal"
to = "stop a"
length_mm = 300_000
[tracks.neck]
from = "P.reverse"
to = "Q.tip"
length_mm = 100_000
[tracks.loop]
from = "Q.normal"
to = "Q.reverse"
length_mm = 500_000
[points]
P = {}
Q = {}
[routes."out"]
from = "W"
direction = "backward"
to = "W0"
"""
"""One leg before the entry leads to the end of the block, the other round a loop and back."""

TRAP = """
format = "heisoku-layout-1"
held_by_authority = "rest"
[tracks.main_w]
from = "west"
to = "P.tip"
length_mm = 900_000
boundaries = { W = 800_000 }
[tracks.main_e]
from = "P.normal"
to = "east"
length_mm = 900_000
boundaries = { E = 100_000 }
[tracks.link]
from = "P.reverse"
to = "T.normal"
length_mm = 60_000
[tracks.siding]
from = "T.tip"
to = "buffer"
length_mm = 300_000
boundaries = { S = 20_000 }
[tracks.drag]
from = "T.reverse"
to = "D.tip"
length_mm = 30_000
[tracks.sand]
from = "D.normal"
to = "sand drag"
length_mm = 40_000
[tracks.wall]
from = "D.reverse"
to = "wall"
length_mm = 20_000
[points]
P = {}
T = {}
D = {}
[routes."main"]
from = "W"
direction = "forward"
to = "E"
points = { P = "normal" }
[routes."shunt in"]
from = "W"
direction = "forward"
to = "buffer"
points = { P = "reverse", T = "normal" }
"""
"""A trap between a siding and the main line, and behind it a point that shields nothing."""

NAMED = TRAP.replace('points = { P = "normal" }', 'points = { P = "normal", T = "normal", D = "reverse" }')
"""A route that names positions for both of them."""

FLANKED = TRAP.replace('points = { P = "normal" }', 'points = { P = "normal" }\nflank = { P = "normal", T = "normal" }')
"""A route whose flank names a point of its path as it lies, and the trap as it should not."""

AGAINST = TRAP.replace(
    'points = { P = "normal" }', 'points = { P = "normal", T = "reverse" }\nflank = { T = "normal" }'
)
"""A route whose flank wants a point otherwise than its points."""

TRACKS = {"west": 200, "east": 200, "north": 200, "south": 200}
DIAMOND = {
    "version": "3.4.12",
    "track_sections": [{"id": name, "length": length} for name, length in TRACKS.items()],
    "switches": [
        {
            "id": "X",
            "switch_type": "crossing",
            "ports": {
                port: {"track": track, "endpoint": "BEGIN"}
                for port, track in (("A1", "west"), ("B1", "east"), ("A2", "north"), ("B2", "south"))
            },
        }
    ],
    "detectors": [
        {"id": f"{name} {number}", "track": name, "position": 50.0 * number}
        for name in ("west", "east")
        for number in (1, 2)
    ],
    "buffer_stops": [{"id": "stop", "track": "north", "position": 200.0}],
    "routes": [
        {
            "id": "out",
            "entry_point": {"type": "Detector", "id": "east 1"},
            "entry_point_direction": "START_TO_STOP",
            "exit_point": {"type": "Detector", "id": "east 2"},
            "release_detectors": [],
            "switches_directions": {},
        }
    ],
}
"""A diamond in a start block, whose other track ends in a buffer stop and in nothing."""

CRAFTED = {
    "two legs.toml": TWO_LEGS,
    "no track.toml": NO_TRACK,
    "balloon.toml": BALLOON,
    "trap.toml": TRAP,
    "named.toml": NAMED,
    "flanked.toml": FLANKED,
    "against.toml": AGAINST,
    "diamond.json": json.dumps(DIAMOND),
}
"""All of them, as files."""
