"""The two small stations that witnesses play on, in the native format, and where trains stand on them."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from functools import cache

from kernel.names import Block, Car, Point, Position, Route, Train
from models.layouts.continuation import with_continuations
from models.layouts.loading import load_text
from models.layouts.results import Imported
from models.world.formations import directions, formation
from models.world.start import site_as_told, start
from models.world.state import Site, System

NORMAL, REVERSE = Position("normal"), Position("reverse")

PASSING_PLACE = """
# west end --[west]--A--[throat: P1]--B1--[one]--C1--[outlet: P2]--D--[east]-- east end
#                          +--B2--[two]--C2--+
# yard end --[yard west]--Y1--[yard gate]--Y2--[yard east]-- yard stop
format = "heisoku-layout-1"
name = "Passing place"
trains = ["T1", "T2"]
held_by_authority = "rest"
# A wagon in the yard gate stands too close to the outlet.
fouling = [["yard gate", "outlet"]]

[tracks.west]
from = "west end"
to = "P1.tip"
length_mm = 500_000
boundaries = { A = 440_000 }
[tracks.one]
from = "P1.normal"
to = "P2.normal"
length_mm = 300_000
boundaries = { B1 = 50_000, C1 = 250_000 }
[tracks.two]
from = "P1.reverse"
to = "P2.reverse"
length_mm = 300_000
boundaries = { B2 = 50_000, C2 = 250_000 }
[tracks.east]
from = "P2.tip"
to = "east end"
length_mm = 500_000
boundaries = { D = 60_000 }
[tracks.yard]
from = "yard end"
to = "yard stop"
length_mm = 600_000
boundaries = { Y1 = 200_000, Y2 = 400_000 }

[points]
P1 = {}
P2 = {}

[blocks]
"west" = { track = "west", at_mm = 100_000 }
"throat" = { track = "west", at_mm = 460_000 }
"one" = { track = "one", at_mm = 100_000 }
"two" = { track = "two", at_mm = 100_000 }
"outlet" = { track = "east", at_mm = 10_000 }
"east" = { track = "east", at_mm = 100_000 }
"yard west" = { track = "yard", at_mm = 100_000 }
"yard gate" = { track = "yard", at_mm = 300_000 }
"yard east" = { track = "yard", at_mm = 500_000 }

# Into one with an overlap, released in parts; into two without, or with the far point as its flank.
[routes."west to one"]
from = "A"
direction = "forward"
to = "C1"
points = { P1 = "normal", P2 = "normal" }
overlap_to = "D"
release_at = ["B1"]
[routes."west to two"]
from = "A"
direction = "forward"
to = "C2"
points = { P1 = "reverse" }
release_at = ["B2"]
[routes."west to two, shielded"]
from = "A"
direction = "forward"
to = "C2"
points = { P1 = "reverse" }
flank = { P2 = "normal" }
release_at = ["B2"]
[routes."east to one"]
from = "D"
direction = "backward"
to = "B1"
points = { P2 = "normal" }
[routes."east to two"]
from = "D"
direction = "backward"
to = "B2"
points = { P2 = "reverse" }
[routes."one to east"]
from = "C1"
direction = "forward"
to = "east end"
points = { P2 = "normal" }
release_at = ["D"]
[routes."two to east"]
from = "C2"
direction = "forward"
to = "east end"
points = { P2 = "reverse" }
release_at = ["D"]
[routes."one to west"]
from = "B1"
direction = "backward"
to = "west end"
points = { P1 = "normal" }
[routes."two to west"]
from = "B2"
direction = "backward"
to = "west end"
points = { P1 = "reverse" }
# Through, released as one part up to the outlet's end.
[routes."west to east"]
from = "A"
direction = "forward"
to = "east end"
points = { P1 = "normal", P2 = "normal" }
release_at = ["D"]
[routes."yard out"]
from = "Y1"
direction = "forward"
to = "Y2"
"""

PASSED_IN_PARTS = PASSING_PLACE.replace(
    """points = { P1 = "normal", P2 = "normal" }
release_at = ["D"]""",
    """points = { P1 = "normal", P2 = "normal" }
release_at = ["B1", "C1", "D"]""",
)
"""The same, its way through released block by block."""

TERMINUS = """
# line end --[line]--A--[throat: K]--S1--[platform 1]--]
#                          +--S2--[platform 2]--]
format = "heisoku-layout-1"
name = "Terminus"
trains = ["T1", "T2"]
held_by_authority = "rest"

[tracks.line]
from = "line end"
to = "K.tip"
length_mm = 500_000
boundaries = { A = 440_000 }
[tracks.platform1]
from = "K.normal"
to = "stop 1"
length_mm = 300_000
boundaries = { S1 = 50_000 }
[tracks.platform2]
from = "K.reverse"
to = "stop 2"
length_mm = 300_000
boundaries = { S2 = 50_000 }

[points]
K = {}

[blocks]
"line" = { track = "line", at_mm = 100_000 }
"throat" = { track = "line", at_mm = 460_000 }
"platform 1" = { track = "platform1", at_mm = 100_000 }
"platform 2" = { track = "platform2", at_mm = 100_000 }

[routes."arrive 1"]
from = "A"
direction = "forward"
to = "stop 1"
points = { K = "normal" }
release_at = ["S1"]
[routes."arrive 2"]
from = "A"
direction = "forward"
to = "stop 2"
points = { K = "reverse" }
release_at = ["S2"]
[routes."depart 1"]
from = "stop 1"
direction = "backward"
to = "line end"
points = { K = "normal" }
[routes."depart 2"]
from = "stop 2"
direction = "backward"
to = "line end"
points = { K = "reverse" }
"""

RING = """
# --b52--[b2]--b23--[b3]--b34--[b4]--b45--[b5]--b52-- round again; [x] lies too close to [b2]
format = "heisoku-layout-1"
name = "Ring"
trains = ["T1", "T2"]
held_by_authority = "rest"
fouling = [["b2", "x"]]

[tracks.a]
from = "n1"
to = "n2"
length_mm = 800_000
boundaries = { b23 = 400_000 }
[tracks.b]
from = "n2"
to = "n3"
length_mm = 800_000
boundaries = { b34 = 400_000 }
[tracks.c]
from = "n3"
to = "n4"
length_mm = 800_000
boundaries = { b45 = 400_000 }
[tracks.d]
from = "n4"
to = "n1"
length_mm = 800_000
boundaries = { b52 = 400_000 }
[tracks.siding]
from = "south stop"
to = "north stop"
length_mm = 800_000
boundaries = { yx = 400_000 }

[blocks]
"b2" = { track = "a", at_mm = 10_000 }
"b3" = { track = "b", at_mm = 10_000 }
"b4" = { track = "c", at_mm = 10_000 }
"b5" = { track = "d", at_mm = 10_000 }
"y" = { track = "siding", at_mm = 10_000 }
"x" = { track = "siding", at_mm = 500_000 }

[routes."round"]
from = "b34"
direction = "forward"
to = "b23"
release_at = ["b45", "b52"]
[routes."on"]
from = "b23"
direction = "forward"
to = "b34"
[routes."next"]
from = "b34"
direction = "forward"
to = "b45"
[routes."back"]
from = "b23"
direction = "backward"
to = "b52"
[routes."y to x"]
from = "yx"
direction = "forward"
to = "north stop"
[routes."x to y"]
from = "yx"
direction = "backward"
to = "south stop"
"""

EIGHT = RING.replace('"Ring"', '"Figure of eight"').replace('["b2", "x"]', '["b2", "x"], ["b3", "b5"]')
"""The same loop laid so that it crosses itself on the level, where b3 and b5 are; [x] beside [b2] as before."""

PLAIN_LINE = """
# north end --[north]--A--[middle]--B--[south]-- south end
format = "heisoku-layout-1"
name = "Plain line"
trains = ["T1", "T2"]
held_by_authority = "rest"

[tracks.line]
from = "north end"
to = "south end"
length_mm = 1_500_000
boundaries = { A = 500_000, B = 1_000_000 }
[tracks.elsewhere]
from = "first stop"
to = "last stop"
length_mm = 800_000
boundaries = { E = 400_000 }

[blocks]
"north" = { track = "line", at_mm = 100_000 }
"middle" = { track = "line", at_mm = 600_000 }
"south" = { track = "line", at_mm = 1_100_000 }
"here" = { track = "elsewhere", at_mm = 100_000 }
"there" = { track = "elsewhere", at_mm = 500_000 }

[routes."north to middle"]
from = "A"
direction = "forward"
to = "B"
[routes."middle to south"]
from = "B"
direction = "forward"
to = "south end"
[routes."middle to north"]
from = "A"
direction = "backward"
to = "north end"
[routes."south to middle"]
from = "B"
direction = "backward"
to = "A"
"""

WEST, THROAT, ONE, TWO = Block("west"), Block("throat"), Block("one"), Block("two")
OUTLET, EAST = Block("outlet"), Block("east")
YARD_WEST, YARD_GATE, YARD_EAST = Block("yard west"), Block("yard gate"), Block("yard east")
P1, P2 = Point("P1"), Point("P2")
NORTH, MIDDLE, SOUTH, HERE = map(Block, ("north", "middle", "south", "here"))
LINE, PLATFORM_1, PLATFORM_2 = Block("line"), Block("platform 1"), Block("platform 2")
K = Point("K")

T1, T2 = Train("T1"), Train("T2")
A1, A2, B1 = Car("a1"), Car("a2"), Car("b1")
CARS: Mapping[Train, Sequence[Car]] = {T1: (A1, A2), T2: (B1,)}
"""Eastwards, and arriving, a1 leads a2."""
FACING_EAST = {A1: frozenset({WEST}), A2: frozenset({WEST})}
"""The first train in the block in the west; where the second is is said besides."""

WEST_TO_ONE, WEST_TO_TWO = Route("west to one"), Route("west to two")
WEST_TO_TWO_SHIELDED = Route("west to two, shielded")
EAST_TO_ONE, EAST_TO_TWO = Route("east to one"), Route("east to two")
ONE_TO_EAST, TWO_TO_EAST = Route("one to east"), Route("two to east")
ONE_TO_WEST, TWO_TO_WEST = Route("one to west"), Route("two to west")
WEST_TO_ONE_ON, TWO_TO_WEST_ON = Route("west to one from throat"), Route("two to west from throat")
"""For trains that restarted in the throat."""
WEST_TO_EAST = Route("west to east")
YARD_OUT = Route("yard out")
ARRIVE_1, DEPART_1, DEPART_2 = Route("arrive 1"), Route("depart 1"), Route("depart 2")
ROUND = Route("round")
NORTH_TO_MIDDLE, MIDDLE_TO_SOUTH = Route("north to middle"), Route("middle to south")
MIDDLE_TO_NORTH = Route("middle to north")
LEADS: Mapping[str, Route] = {
    PASSING_PLACE: WEST_TO_ONE,
    PASSED_IN_PARTS: WEST_TO_ONE,
    TERMINUS: ARRIVE_1,
    RING: ROUND,
    EIGHT: ROUND,
    PLAIN_LINE: NORTH_TO_MIDDLE,
}
"""A route of each station in which a1 leads."""


@cache
def imported(text: str) -> Imported:
    """A station of this file, read."""
    station = load_text("a station of the witnesses", text)
    assert not station.violations, station.violations
    return station


def site_of(text: str, cars: Mapping[Train, Sequence[Car]] = CARS) -> Site:
    """The station with its two trains, or with others."""
    station = imported(text)
    layout, ground = with_continuations(station.layout, station.ground)
    along = directions(layout, ground)
    leading = along[LEADS[text]]
    return site_as_told(
        layout=layout,
        records=station.records,
        ground=ground,
        formation=formation(cars, lambda route: along.get(route, leading) == leading),
    )


def standing_at(site: Site, at: Mapping[Car, frozenset[Block]], lies: Mapping[Point, Position]) -> System:
    """Everything just started, the cars and points as given; points not named lie normal."""
    return start(site, at, {point: lies.get(point, NORMAL) for point in site.layout.points})
