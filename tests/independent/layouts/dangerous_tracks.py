"""Tracks with a danger each: trains side by side behind one point."""

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

DANGEROUS_TRACKS = {
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
    "side by side.toml": SIDE_BY_SIDE.replace("fouling = [", 'fouling = [["M block", "N block"], '),
    "clear of each other.toml": SIDE_BY_SIDE.replace("N = 10_000", "N = 45_000").replace(', ["Q", "N block"]', ""),
    "side by side at a diamond.toml": OVER_A_DIAMOND.replace("fouling = [", 'fouling = [["A1", "A2"], '),
}
"""The same without their dangers."""
