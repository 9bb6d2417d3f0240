"""Native files with a danger each in where a route leads, and in how near boundaries lie over several points."""

from __future__ import annotations

from tests.independent.layouts.danger import danger_of

HEAD = """
format = "heisoku-layout-1"
held_by_authority = "rest"
joints = []
"""
JOINED = HEAD.replace("[]", '["j"]')
ONE_WRONG = f"""{JOINED}
[tracks]
line = {{ from = "west", to = "R.tip", length_mm = 900_000, boundaries = {{ W = 300_000, V = 800_000 }} }}
yard = {{ from = "R.reverse", to = "stop r", length_mm = 300_000 }}
mid = {{ from = "R.normal", to = "P.tip", length_mm = 300_000 }}
a = {{ from = "P.normal", to = "Q.normal", length_mm = 300_000 }}
b = {{ from = "P.reverse", to = "Q.reverse", length_mm = 300_000 }}
more = {{ from = "Q.tip", to = "j", length_mm = 300_000 }}
yet = {{ from = "j", to = "S.normal", length_mm = 300_000 }}
side = {{ from = "stop s", to = "S.reverse", length_mm = 300_000, boundaries = {{ Z = 200_000 }} }}
out = {{ from = "S.tip", to = "east", length_mm = 900_000, boundaries = {{ E = 300_000 }} }}
[points]
R = {{}}
P = {{}}
Q = {{}}
S = {{}}
[routes.in]
from = "W"
direction = "forward"
to = "E"
points = {{ R = "normal", P = "normal", Q = "reverse", S = "normal" }}
"""
TWO_WRONG = ONE_WRONG.replace('S = "normal"', 'S = "reverse"')
IN_THE_OVERLAP = ONE_WRONG.replace('to = "E"', 'to = "V"\noverlap_to = "E"')
ON_A_RING = ONE_WRONG.replace('line = { from = "west"', 'line = { from = "R.reverse"').replace(
    'yard = { from = "R.reverse"', 'yard = { from = "stop q"'
)
NOT_THERE = ON_A_RING.replace('to = "E"', 'to = "Z"')
LED_RIGHT = ONE_WRONG.replace('Q = "reverse", S', 'Q = "normal", S')
OVER_FOUR_POINTS = f"""{HEAD}
[tracks]
x = {{ from = "west", to = "P1.tip", length_mm = 900_000, boundaries = {{ X0 = 300_000, X = 897_287 }} }}
y = {{ from = "P4.tip", to = "east", length_mm = 900_000, boundaries = {{ Y = 2_713 }} }}
a1 = {{ from = "P1.normal", to = "stop a1", length_mm = 900_000, boundaries = {{ A1 = 500_000 }} }}
a2 = {{ from = "P2.normal", to = "stop a2", length_mm = 900_000, boundaries = {{ A2 = 500_000 }} }}
a3 = {{ from = "P3.normal", to = "stop a3", length_mm = 900_000, boundaries = {{ A3 = 500_000 }} }}
a4 = {{ from = "P4.normal", to = "stop a4", length_mm = 900_000, boundaries = {{ A4 = 500_000 }} }}
link1 = {{ from = "P1.reverse", to = "P2.tip", length_mm = 100 }}
link2 = {{ from = "P2.reverse", to = "P3.reverse", length_mm = 100 }}
link3 = {{ from = "P3.tip", to = "P4.reverse", length_mm = 100 }}
[points]
P1 = {{}}
P2 = {{}}
P3 = {{}}
P4 = {{}}
[routes]
in = {{ from = "X0", direction = "forward", to = "X" }}
"""
BENT_ROUND = f"""{HEAD}
[tracks]
a = {{ from = "Q.normal", to = "P.tip", length_mm = 500_000, boundaries = {{ X = 498_500 }} }}
b = {{ from = "P.normal", to = "Q.reverse", length_mm = 500_000, boundaries = {{ Y = 1_500 }} }}
c = {{ from = "P.reverse", to = "R.normal", length_mm = 400_000 }}
d = {{ from = "Q.tip", to = "R.tip", length_mm = 400_000 }}
e = {{ from = "R.reverse", to = "east", length_mm = 900_000, boundaries = {{ E = 300_000, F = 800_000 }} }}
[points]
P = {{}}
Q = {{}}
R = {{}}
[routes]
out = {{ from = "E", direction = "forward", to = "F" }}
"""
BENT_BY_A_STOP = f"""{HEAD}
[tracks]
a = {{ from = "Q.tip", to = "P.tip", length_mm = 500_000, boundaries = {{ X = 499_000 }} }}
b = {{ from = "P.normal", to = "wall", length_mm = 1_000 }}
c = {{ from = "P.reverse", to = "Q.normal", length_mm = 400_000 }}
d = {{ from = "Q.reverse", to = "far wall", length_mm = 400_000 }}
e = {{ from = "west", to = "east", length_mm = 900_000, boundaries = {{ E = 300_000, F = 800_000 }} }}
[points]
P = {{}}
Q = {{}}
[routes]
out = {{ from = "E", direction = "forward", to = "F" }}
"""
BENT_INTO_A_STOP = f"""{HEAD}
[tracks]
ring = {{ from = "P.normal", to = "P.reverse", length_mm = 500_000, boundaries = {{ X = 200_000 }} }}
neck = {{ from = "P.tip", to = "wall", length_mm = 400_000 }}
e = {{ from = "west", to = "east", length_mm = 900_000, boundaries = {{ E = 300_000, F = 800_000 }} }}
[points]
P = {{}}
[routes]
out = {{ from = "E", direction = "forward", to = "F" }}
"""
BOTH_LEGS_ONTO_THE_PATH = f"""{HEAD}
[tracks]
main_w = {{ from = "west", to = "P.tip", length_mm = 900_000, boundaries = {{ W = 300_000, V = 800_000 }} }}
mid = {{ from = "P.normal", to = "Q.normal", length_mm = 400_000 }}
main_e = {{ from = "Q.tip", to = "east", length_mm = 900_000, boundaries = {{ E = 100_000 }} }}
link = {{ from = "T.normal", to = "P.reverse", length_mm = 60_000 }}
other = {{ from = "T.reverse", to = "Q.reverse", length_mm = 80_000 }}
siding = {{ from = "T.tip", to = "buffer", length_mm = 300_000, boundaries = {{ S = 30_000 }} }}
[points]
P = {{}}
Q = {{}}
T = {{}}
[routes]
main = {{ from = "V", direction = "forward", to = "E", points = {{ P = "normal", Q = "normal" }} }}
"""
PRETZEL = """
[tracks]
w = { from = "west", to = "X.a1", length_mm = 900_000, boundaries = { W = 800_000 } }
loop = { from = "X.b1", to = "X.a2", length_mm = 200_000 }
e = { from = "X.b2", to = "east", length_mm = 900_000, boundaries = { E = 100_000, F = 800_000 } }
"""
"""The track of a line that crosses itself."""
THROUGH = """
[routes]
in = { from = "W", direction = "forward", to = "F" }
"""
TWO_PRETZELS = f"""{HEAD}longest_train_mm = 170_000
{PRETZEL}
w2 = {{ from = "west 2", to = "Y.a1", length_mm = 900_000, boundaries = {{ W2 = 800_000 }} }}
loop2 = {{ from = "Y.b1", to = "Y.a2", length_mm = 260_000 }}
e2 = {{ from = "Y.b2", to = "east 2", length_mm = 900_000, boundaries = {{ E2 = 100_000, F2 = 800_000 }} }}
[points]
X = {{ kind = "crossing", clear_mm = {{ a1 = 10_000, b1 = 10_000, a2 = 10_000, b2 = 10_000 }} }}
Y = {{ kind = "crossing", clear_mm = {{ a1 = 45_000, b1 = 45_000, a2 = 45_000, b2 = 45_000 }} }}
{THROUGH}
"in 2" = {{ from = "W2", direction = "forward", to = "F2" }}
"""
AS_LONG = TWO_PRETZELS.replace("260_000", "270_000").replace("170_000", "180_000")
BESIDE_A_RING = f"""{HEAD}longest_train_mm = 125_000
{PRETZEL}
ring = {{ from = "P.normal", to = "P.tip", length_mm = 900_000, boundaries = {{ A = 100_000, B = 800_000 }} }}
side = {{ from = "P.reverse", to = "buffer", length_mm = 900_000, boundaries = {{ S = 100_000 }} }}
[points]
X = {{ kind = "crossing", clear_mm = {{ a1 = 40_000, b1 = 40_000, a2 = 35_000, b2 = 40_000 }} }}
P = {{}}
{THROUGH}
round = {{ from = "A", direction = "forward", to = "B" }}
"""
HALF_TOLD = f"""{HEAD}longest_train_mm = 159_000
{PRETZEL}
[points]
X = {{ kind = "crossing", clear_mm = {{ a1 = 45_000, b2 = 45_000 }} }}
{THROUGH}
"""
"""Of the two legs of its loop no clearance is told."""
TWO_TRACKS_BETWEEN_TWO_BLOCKS = f"""{HEAD}[tracks]
w = {{ from = "west", to = "P.tip", length_mm = 900_000, boundaries = {{ W = 300_000, V = 800_000 }} }}
n1 = {{ from = "P.normal", to = "U.tip", length_mm = 900_000, boundaries = {{ A1 = 100_000 }} }}
n2 = {{ from = "U.normal", to = "Q.normal", length_mm = 900_000, boundaries = {{ B1 = 800_000 }} }}
s1 = {{ from = "P.reverse", to = "Y.normal", length_mm = 900_000, boundaries = {{ A2 = 100_000 }} }}
s2 = {{ from = "Y.tip", to = "Q.reverse", length_mm = 900_000, boundaries = {{ B2 = 800_000 }} }}
x = {{ from = "U.reverse", to = "Y.reverse", length_mm = 40_000 }}
e = {{ from = "Q.tip", to = "east", length_mm = 900_000, boundaries = {{ E = 100_000, F = 600_000 }} }}
[points]
P = {{}}
U = {{}}
Y = {{}}
Q = {{}}
[routes.north]
from = "V"
direction = "forward"
to = "F"
points = {{ P = "normal", U = "normal", Y = "normal", Q = "normal" }}
[routes.south]
from = "V"
direction = "forward"
to = "F"
points = {{ P = "reverse", U = "normal", Y = "normal", Q = "reverse" }}
"""
"""A crossover joins two tracks in one block; a train that restarts there may stand on either."""
TWO_WAYS_IN = f"""{HEAD}[tracks]
a = {{ from = "west a", to = "R.tip", length_mm = 900_000, boundaries = {{ A0 = 300_000, A = 800_000 }} }}
b = {{ from = "west b", to = "S.reverse", length_mm = 900_000, boundaries = {{ B0 = 300_000, B = 800_000 }} }}
m = {{ from = "R.normal", to = "S.normal", length_mm = 300_000 }}
d = {{ from = "R.reverse", to = "stop d", length_mm = 600_000, boundaries = {{ D = 100_000 }} }}
c = {{ from = "S.tip", to = "east", length_mm = 900_000, boundaries = {{ C = 100_000, E = 600_000 }} }}
[points]
R = {{}}
S = {{}}
[routes]
a = {{ from = "A0", direction = "forward", to = "E", points = {{ R = "normal", S = "normal" }} }}
b = {{ from = "B0", direction = "forward", to = "E", points = {{ S = "reverse" }} }}
"""
"""Two lines come together in a block: a train that comes by one of them faces a point, by the other it does not."""
HELD = '[["B:S+buffer", "B:E+S+V"], ["B:E+east", "B:E+S+V"]]'


def line_of(boundaries: int) -> str:
    """A line with so many boundaries, 100 m apart, and one route over all of it but its end."""
    marks = [f"B{number:03}" for number in range(boundaries)]
    told = ", ".join(f"{mark} = {100_000 * at}" for at, mark in enumerate(marks, 1))
    line = f'from = "west", to = "east", length_mm = {100_000 * (boundaries + 1)}, boundaries = {{ {told} }}'
    return f'''{HEAD}
[tracks]
line = {{ {line} }}
[routes]
all = {{ from = "{marks[0]}", direction = "forward", to = "{marks[-1]}" }}
'''


NUMBERS = 256
"""So many blocks 8 bits tell apart."""

DANGEROUS_ROUTES = {
    "one point wrong.toml": danger_of(
        ONE_WRONG,
        "a route runs against a point, since one before it lies wrong: a train would be led elsewhere there",
        "point 'Q': route 'in' arrives at its port normal, closed by 'reverse', having passed 'P' normal",
        *("in", "Q", "P"),
    ),
    "two points wrong.toml": danger_of(
        TWO_WRONG,
        "the same, and no point alone is to blame: a further one lies wrong as well",
        "point 'Q': route 'in' arrives at its port normal, closed by 'reverse', having passed 'R' normal, 'P' normal",
        *("in", "Q", "P", "R"),
    ),
    "wrong in the overlap.toml": danger_of(
        IN_THE_OVERLAP,
        "an overlap runs against a point, since one before it lies wrong",
        "point 'Q': route 'in' arrives at its port normal, closed by 'reverse', having passed 'P' normal",
        *("in", "Q", "P"),
    ),
    "one point wrong on a ring.toml": danger_of(
        ON_A_RING,
        "the same, from a ring: by the other position of the first point a train would run round for ever",
        "point 'Q': route 'in' arrives at its port normal, closed by 'reverse', having passed 'P' normal",
        *("in", "Q", "P"),
    ),
    "exit that is not there.toml": danger_of(
        NOT_THERE,
        "no track leads from a route's entry to its exit, however points lie",
        "track does not lead there, however the points lie",
    ),
    "over four points.toml": danger_of(
        OVER_FOUR_POINTS,
        "two boundaries 5.726 m apart over four points, behind each a farther boundary: their tags come too close",
        "is 5,726 mm from boundary to boundary",
        *("X", "Y"),
    ),
    "bent round.toml": danger_of(
        BENT_ROUND,
        "two boundaries 3 m apart, a loop brings both of their far sides together: their tags come too close",
        "is 3,000 mm from boundary to boundary",
        *("X", "Y"),
    ),
    "bent by a stop.toml": danger_of(
        BENT_BY_A_STOP,
        "a boundary with a loop round to its other side, and an end of track 2 m behind it, where its tag does not fit",
        "is 2,000 mm from its boundary to the end of track",
        "X",
    ),
    "bent into a stop.toml": danger_of(
        BENT_INTO_A_STOP,
        "one boundary on a loop that leads to an end of track: a train behind it is in the block before it",
        "tags_of_a_boundary_are_partners",
        "X",
    ),
    "two pretzels.toml": danger_of(
        TWO_PRETZELS,
        "two lines cross themselves, and the longer loop is the shorter one from where its legs are clear",
        "back to it, or foul of it, is 170,000 mm long",
        *("E2", "W2"),
    ),
    "two pretzels as long.toml": danger_of(
        AS_LONG,
        "two lines cross themselves, and their loops are of one length from where their legs are clear",
        "back to it, or foul of it, is 180,000 mm long",
        *("E", "W"),
    ),
    "pretzel beside a ring.toml": danger_of(
        BESIDE_A_RING,
        "a line crosses itself within one block, and elsewhere there is a ring that is much longer",
        "back to it, or foul of it, is 125,000 mm long",
        *("E", "W"),
    ),
    "more numbers than a tag has.toml": danger_of(
        line_of(NUMBERS + 1),
        "a route over more blocks than 8 bits tell apart: a train would be taken to be in another block",
        "a tag holds 8 bits",
        f"B{NUMBERS:03}",
    ),
}
"""Every file with what must be said of it."""

ROUTES_THAT_HOLD = {
    "led right.toml": LED_RIGHT,
    "both legs onto the path.toml": BOTH_LEGS_ONTO_THE_PATH,
    "names made of boundaries.toml": BOTH_LEGS_ONTO_THE_PATH.replace('"rest"', HELD),
    "all numbers that a tag has.toml": line_of(NUMBERS),
    "legs of a loop half told.toml": HALF_TOLD,
    "two tracks between two blocks.toml": TWO_TRACKS_BETWEEN_TWO_BLOCKS,
    "two ways into a block.toml": TWO_WAYS_IN,
}
"""The same without their dangers."""
