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

NEAR = """
format = "heisoku-layout-1"
held_by_authority = "rest"
[tracks]
line = { from = "west", to = "P.tip", length_mm = 900_000, boundaries = { W = 500_000, V = 800_000 } }
link = { from = "P.normal", to = "Q.tip", length_mm = 12_000 }
far = { from = "Q.normal", to = "east", length_mm = 900_000, boundaries = { E = 100_000 } }
near = { from = "Q.reverse", to = "south", length_mm = 900_000, boundaries = { S = 7_000 } }
yard = { from = "P.reverse", to = "yard", length_mm = 900_000, boundaries = { Y = 20_000 } }
[points]
P = {}
Q = { clear_mm = { reverse = 7_000, normal = 6_000 } }
[routes]
in = { from = "V", direction = "forward", to = "E", points = { P = "normal", Q = "normal" } }
"""
"""A boundary nearer to a point than what is clear, behind another point that is told to be clear of it."""

NAMES = """
format = "heisoku-layout-1"
held_by_authority = "rest"
joints = ["n"]
[tracks]
"A-1" = { from = "w", to = "n", length_mm = 900_000, boundaries = { "A" = 100_000, "А" = 300_000, "a" = 500_000 } }
["tracks"."A‑1"]
from = "n"
to = "e"
length_mm = 900_000
boundaries = { "二" = 100_000, "ニ" = 300_000, "C  1" = 600_000, "C 1" = 700_000 }
[routes]
r = { from = "A", direction = "forward", to = "a" }
"r " = { from = "二", direction = "forward", to = "ニ" }
"""
"""Names that look alike, of tracks, boundaries and routes."""

SHORT = """
format = "heisoku-layout-1"
held_by_authority = "rest"
[tracks.line]
from = "w"
to = "e"
length_mm = 900_000
boundaries = { A = 2_712, B = 9_051, C = 15_389, D = 400_000, E = 409_989, F = 600_000, G = 609_990, H = 897_287 }
[routes]
one = { from = "C", direction = "forward", to = "D", overlap_to = "E" }
two = { from = "E", direction = "forward", to = "F", overlap_to = "G" }
stop = { from = "w", direction = "forward", to = "B", overlap_to = "C" }
"""
"""Blocks and overlaps just as long as they must be, and a millimetre shorter."""

LONG = """
format = "heisoku-layout-1"
held_by_authority = "rest"
[tracks]
one = { from = "w", to = "n", length_mm = 268_435_455, boundaries = { A = 100_000 } }
two = { from = "n", to = "m", length_mm = 300_000, boundaries = { B = 100_000, C = 250_000 } }
on = { from = "m", to = "e", length_mm = 268_435_455, boundaries = { D = 268_385_456 } }
[routes]
far = { from = "A", direction = "forward", to = "B" }
as_far = { from = "C", direction = "forward", to = "D" }
"""
"""Between two tags as many millimetres as 28 bits hold, and one more, at either end of a joint that one name makes."""

KILOMETRES = """
format = "heisoku-layout-1"
held_by_authority = "rest"
tracks.line = { from = "w", to = "e", length_mm = 19_999, boundaries = { A = 5_000, B = 15_000 } }
routes.r = { from = "A", direction = "forward", to = "B" }
"""
METRES = KILOMETRES.replace("19_999", "20_000").replace("tracks.line", "longest_train_mm = 15_000\ntracks.line")

RING = """
format = "heisoku-layout-1"
held_by_authority = []
longest_train_mm = 699_999
laid_at_start = ["Q"]
[tracks]
ring = { from = "P.normal", to = "Q.normal", length_mm = 1_000_000, boundaries = { A = 100_000, B = 900_000 } }
side = { from = "P.reverse", to = "Q.reverse", length_mm = 1_000_000, boundaries = { S = 100_000, R = 900_000 } }
back = { from = "Q.tip", to = "P.tip", length_mm = 500_000, boundaries = { C = 100_000, D = 400_000 } }
[points]
P = {}
Q = {}
[routes]
r = { from = "C", direction = "forward", to = "B", points = { P = "normal", Q = "normal" } }
s = { from = "A", direction = "backward", to = "C", points = { P = "normal" } }
"""
"""A ring whose points lie the same each time round; what stands beside it is held off by nothing."""
NO_TRAIN = RING.replace("699_999", "4_999")
SMALL_TRAIN = RING.replace("699_999", "5_000")
TOO_CLEAR = NEAR.replace("reverse = 7_000, normal = 6_000", "reverse = 2_475, normal = 2_474, tip = 1")
SHORTER = RING.replace("699_999", "700_000").replace("= []", '= "rest"')
TURN = """
format = "heisoku-layout-1"
held_by_authority = "rest"
[tracks]
line = { from = "west", to = "P.tip", length_mm = 900_000, boundaries = { W = 300_000, V = 800_000 } }
turn = { from = "P.normal", to = "P.reverse", length_mm = 900_000, boundaries = { X = 200_000, Y = 700_000 } }
[points]
P = {}
[routes]
in = { from = "V", direction = "forward", to = "Y", points = { P = "normal" } }
out = { from = "Y", direction = "forward", to = "W", points = { P = "reverse" } }
"""
"""A balloon whose point would have to lie both ways at once under a train that meets itself: no loop."""
PRETZEL = """
format = "heisoku-layout-1"
held_by_authority = "rest"
longest_train_mm = 699_999
[tracks]
w = { from = "west", to = "X.a1", length_mm = 900_000, boundaries = { W = 800_000 } }
loop = { from = "X.b1", to = "X.a2", length_mm = 900_000, boundaries = { L1 = 100_000, L2 = 800_000 } }
e = { from = "X.b2", to = "east", length_mm = 900_000, boundaries = { E = 100_000 } }
alone = { from = "x", to = "y", length_mm = 900_000, boundaries = { Z = 100_000 } }
[points]
X = { kind = "crossing" }
[routes]
in = { from = "W", direction = "forward", to = "L2" }
out = { from = "L2", direction = "forward", to = "E" }
"""
"""A line that crosses itself on the level, its trains told to be a millimetre shorter than the loop; track apart."""

ONE_NAME = """
format = "heisoku-layout-1"
held_by_authority = []
[tracks]
w = { from = "west", to = "P.normal", length_mm = 900_000, boundaries = { W = 300_000, X = 800_000 } }
s = { from = "buffer", to = "P.reverse", length_mm = 300_000, boundaries = { S = 200_000 } }
e = { from = "P.tip", to = "east", length_mm = 900_000, boundaries = { E = 200_000 } }
[points]
P = {}
[blocks]
in = { track = "e", at_mm = 850_000 }
[routes]
in = { from = "W", direction = "forward", to = "X", overlap_to = "E", points = { P = "normal" } }
out = { from = "S", direction = "forward", to = "east", points = { P = "reverse" } }
"""
"""A route and a block of one name; an overlap over a point that nothing is kept off from beside."""

CRAFTED = {
    "one name.toml": ONE_NAME,
    "two legs.toml": TWO_LEGS,
    "no track.toml": NO_TRACK,
    "balloon.toml": BALLOON,
    "trap.toml": TRAP,
    "named.toml": NAMED,
    "flanked.toml": FLANKED,
    "against.toml": AGAINST,
    "diamond.json": json.dumps(DIAMOND),
    "near.toml": NEAR,
    "names.toml": NAMES,
    "short.toml": SHORT,
    "long.toml": LONG,
    "kilometres.toml": KILOMETRES,
    "metres.toml": METRES,
    "ring.toml": RING,
    "shorter.toml": SHORTER,
    "no train.toml": NO_TRAIN,
    "small train.toml": SMALL_TRAIN,
    "too clear.toml": TOO_CLEAR,
    "pretzel.toml": PRETZEL,
    "turn.toml": TURN,
}
"""All of them, as files."""
