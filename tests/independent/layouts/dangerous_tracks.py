"""Tracks with a danger each: trains side by side at a point, a train that meets its own rear, tags in points."""

from __future__ import annotations

from tests.independent.layouts.danger import danger_of

SIDE_BY_SIDE = """
format = "heisoku-layout-1"
held_by_authority = "rest"
joints = []
fouling = [["Q", "M block"], ["Q", "N block"]]
[tracks]
line = { from = "west", to = "P.tip", length_mm = 900_000, boundaries = { W = 300_000, V = 800_000 } }
m = { from = "P.normal", to = "stop m", length_mm = 900_000, boundaries = { M = 10_000, M2 = 500_000 } }
n = { from = "P.reverse", to = "stop n", length_mm = 900_000, boundaries = { N = 10_000, N2 = 500_000 } }
[points]
P = { clear_mm = { normal = 45_000, reverse = 45_000 } }
[blocks]
Q = { track = "m", at_mm = 5_000 }
"M block" = { track = "m", at_mm = 100_000 }
"N block" = { track = "n", at_mm = 100_000 }
[routes]
"up to N" = { from = "N2", direction = "backward", to = "N" }
"up to M" = { from = "M2", direction = "backward", to = "M" }
"""
ONE_BEHIND_BOTH = """
format = "heisoku-layout-1"
held_by_authority = "rest"
joints = []
fouling = [["Q", "loop"]]
[tracks]
line = { from = "west", to = "P.tip", length_mm = 900_000, boundaries = { W = 300_000, V = 800_000 } }
loop = { from = "P.normal", to = "P.reverse", length_mm = 900_000, boundaries = { M = 10_000, N = 890_000 } }
[points]
P = { clear_mm = { normal = 45_000, reverse = 45_000 } }
[blocks]
Q = { track = "line", at_mm = 850_000 }
loop = { track = "loop", at_mm = 400_000 }
[routes]
in = { from = "W", direction = "forward", to = "V" }
"""
OVER_A_DIAMOND = """
format = "heisoku-layout-1"
held_by_authority = "rest"
joints = []
fouling = [["X0", "A1"], ["X0", "A2"]]
[tracks]
a1 = { from = "w1", to = "X.a1", length_mm = 900_000, boundaries = { far1 = 300_000, near1 = 890_000 } }
b1 = { from = "X.b1", to = "e1", length_mm = 900_000, boundaries = { out1 = 50_000 } }
a2 = { from = "w2", to = "X.a2", length_mm = 900_000, boundaries = { far2 = 300_000, near2 = 890_000 } }
b2 = { from = "X.b2", to = "e2", length_mm = 900_000, boundaries = { out2 = 50_000 } }
[points]
X = { kind = "crossing", clear_mm = { a1 = 45_000, b1 = 45_000, a2 = 45_000, b2 = 45_000 } }
[blocks]
X0 = { track = "b1", at_mm = 5_000 }
A1 = { track = "a1", at_mm = 500_000 }
A2 = { track = "a2", at_mm = 500_000 }
[routes]
in1 = { from = "far1", direction = "forward", to = "near1" }
in2 = { from = "far2", direction = "forward", to = "near2" }
"""
PRETZEL = """
format = "heisoku-layout-1"
held_by_authority = "rest"
joints = []
longest_train_mm = 125_000
[tracks]
w = { from = "west", to = "X.a1", length_mm = 900_000, boundaries = { W = 800_000 } }
loop = { from = "X.b1", to = "X.a2", length_mm = 200_000 }
e = { from = "X.b2", to = "east", length_mm = 900_000, boundaries = { E = 100_000, F = 800_000 } }
[points]
X = { kind = "crossing", clear_mm = { a1 = 40_000, b1 = 40_000, a2 = 35_000, b2 = 40_000 } }
[routes]
in = { from = "W", direction = "forward", to = "F" }
"""
RING_IN_A_BLOCK = """
format = "heisoku-layout-1"
held_by_authority = "rest"
joints = []
longest_train_mm = 600_000
[tracks]
w = { from = "west", to = "P.reverse", length_mm = 900_000, boundaries = { V = 300_000, W = 800_000 } }
through = { from = "P.tip", to = "Q.tip", length_mm = 300_000 }
ring = { from = "Q.normal", to = "P.normal", length_mm = 300_000 }
e = { from = "Q.reverse", to = "east", length_mm = 900_000, boundaries = { E = 100_000, F = 800_000 } }
[points]
P = {}
Q = {}
[routes]
through = { from = "W", direction = "forward", to = "F", points = { P = "reverse", Q = "reverse" } }
"""
OVER_AND_UNDER = """
format = "heisoku-layout-1"
held_by_authority = "rest"
joints = []
longest_train_mm = 200_000
fouling = [["over", "under"], ["before", "over"]]
[tracks.t]
from = "west"
to = "east"
length_mm = 3_000_000
boundaries = { A = 500_000, B = 900_000, C = 1_000_000, D = 1_200_000, E = 1_300_000, F = 2_500_000 }
[blocks]
before = { track = "t", at_mm = 600_000 }
over = { track = "t", at_mm = 950_000 }
under = { track = "t", at_mm = 1_250_000 }
[routes]
in = { from = "A", direction = "forward", to = "F" }
"""
AT_THE_TIPS = """
format = "heisoku-layout-1"
held_by_authority = "rest"
joints = ["mid"]
[tracks]
line = { from = "west", to = "mid", length_mm = 899_000, boundaries = { W = 300_000, V = 898_288 } }
more = { from = "mid", to = "P.tip", length_mm = 2_000 }
a = { from = "P.normal", to = "stop a", length_mm = 300_000, boundaries = { A = 100_000 } }
b = { from = "P.reverse", to = "stop b", length_mm = 300_000, boundaries = { B = 100_000 } }
[points]
P = { clear_mm = { normal = 45_000, reverse = 45_000 } }
[routes]
"to a" = { from = "W", direction = "forward", to = "A", points = { P = "normal" } }
"to b" = { from = "W", direction = "forward", to = "B", points = { P = "reverse" } }
"""
TIP_TO_TIP = """
format = "heisoku-layout-1"
held_by_authority = "rest"
joints = []
[tracks]
x = { from = "west", to = "P.normal", length_mm = 900_000, boundaries = { X0 = 300_000, X = 897_000 } }
w = { from = "south", to = "P.reverse", length_mm = 900_000, boundaries = { W = 800_000 } }
link = { from = "P.tip", to = "Q.tip", length_mm = 338 }
y = { from = "Q.normal", to = "east", length_mm = 900_000, boundaries = { Y = 3_000 } }
z = { from = "Q.reverse", to = "north", length_mm = 900_000, boundaries = { Z = 100_000 } }
[points]
P = {}
Q = {}
[routes]
in = { from = "X0", direction = "forward", to = "X" }
"""
ENDS_AT_A_POINT = """
format = "heisoku-layout-1"
held_by_authority = "rest"
joints = []
[tracks]
line = { from = "west", to = "P.tip", length_mm = 900_000, boundaries = { W = 300_000, V = 899_000 } }
a = { from = "P.normal", to = "stop a", length_mm = 1_712 }
b = { from = "P.reverse", to = "stop b", length_mm = 300_000 }
[points]
P = {}
[routes]
in = { from = "W", direction = "forward", to = "V" }
"""

DANGEROUS_TRACKS = {
    "end of no visible difference.toml": danger_of(
        SIDE_BY_SIDE.replace("stop n", "stop m\ufe0f"),
        "two ends of track have names that differ by what nobody sees: were they meant to be joined?",
        "it holds U+FE0F, which nobody sees",
    ),
    "joint of no visible difference.toml": danger_of(
        SIDE_BY_SIDE.replace("stop n", "west\u2800").replace('"west"', '"west\u2800"'),
        "two ends of track are joined by a name that holds what nobody sees",
        "it holds U+2800, which nobody sees",
    ),
    "tip to tip.toml": danger_of(
        TIP_TO_TIP,
        "two boundaries 6.338 m apart over two points, each with others far away: their tags come too close",
        "is 6,338 mm from boundary to boundary",
        *("X", "Y"),
    ),
    "ends at a point.toml": danger_of(
        ENDS_AT_A_POINT,
        "behind a boundary one leg of a point ends after 2.712 m, where its tag does not fit, the other goes on",
        "is 2,712 mm from its boundary to the end of track",
        "V",
    ),
    "at the tips.toml": danger_of(
        AT_THE_TIPS,
        "a boundary lies 2.712 m before the tips: its tag, a millimetre farther on, lies on one leg alone",
        "a boundary's tags lie clear of points and crossings",
        *("V", "P"),
    ),
    "pretzel in a block.toml": danger_of(
        PRETZEL,
        "a line crosses itself within one block: a train of 125 m has its rear on one leg, its front by another",
        "from block 'B:E+W' back to it, or foul of it, is 125,000 mm long",
        *("E", "W"),
    ),
    "ring in a block.toml": danger_of(
        RING_IN_A_BLOCK,
        "two points lead round a ring of 600 m, lying as they lay: a train as long as that meets its rear",
        "from block 'B:E+W' back to it, or foul of it, is 600,000 mm long",
        *("E", "W"),
    ),
    "over and under.toml": danger_of(
        OVER_AND_UNDER,
        "a line comes foul of itself 200 m on, as the file tells: a train as long as that runs into itself",
        "from block 'over' back to it, or foul of it, is 200,000 mm long",
        *("B", "C"),
    ),
    "side by side.toml": danger_of(
        SIDE_BY_SIDE,
        "behind one turnout trains stand on both legs where these are not apart: each fouls the point's block alone",
        "trains behind two legs of a point are clear of each other",
        *("P", "M", "N"),
    ),
    "side by side at a diamond.toml": danger_of(
        OVER_A_DIAMOND,
        "before a diamond trains stand on both lines where these are not apart: each fouls the diamond's block alone",
        "trains behind two legs of a point are clear of each other",
        *("X", "near1", "near2"),
    ),
}
"""Every file with what must be said of it."""

TRACKS_THAT_HOLD = {
    "at the tips.toml": AT_THE_TIPS.replace("898_288", "898_287"),
    "side by side.toml": SIDE_BY_SIDE.replace("fouling = [", 'fouling = [["M block", "N block"], '),
    "pretzel in a block.toml": PRETZEL.replace("125_000", "124_999"),
    "ring in a block.toml": RING_IN_A_BLOCK.replace("mm = 600_000\n[", "mm = 599_999\n["),
    "over and under.toml": OVER_AND_UNDER.replace("= 200_000\nf", "= 199_999\nf"),
    "clear of each other.toml": SIDE_BY_SIDE.replace("N = 10_000", "N = 45_000").replace(', ["Q", "N block"]', ""),
    "one of them clear.toml": SIDE_BY_SIDE.replace("N = 10_000", "N = 45_000"),
    "one block behind both.toml": ONE_BEHIND_BOTH,
    "side by side at a diamond.toml": OVER_A_DIAMOND.replace("fouling = [", 'fouling = [["A1", "A2"], '),
}
"""The same without their dangers."""
