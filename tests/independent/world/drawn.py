"""Ten small layouts drawn for this world, and three real ones where their folder is there; lengths in mm.

Each is raw track, in the rows that ``raw_native`` walks over.  Blocks are short and trains long, so that much happens.
Routes are all that can be walked: from each boundary, either way, over one block, two and three.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from functools import cache
from typing import Any

from tests.independent import files, raw_native, raw_railjson
from tests.independent.raw_graph import Closed, Cut, Network, Place, Stop
from tests.independent.world.told import Told, layout_of, path_of, records_of

FOULING_MM = 8_000
"""So far from a point or crossing the legs foul each other; where a boundary lies nearer, as far as that."""
Rows = dict[str, Any]
Stretch = tuple[str, int, int]


def track(one: str, other: str, length_m: int, **boundaries_m: int) -> Rows:
    """One track with its boundaries."""
    cuts = {name: at_m * 1000 for name, at_m in boundaries_m.items()}
    return {"from": one, "to": other, "length_mm": length_m * 1000, "boundaries": cuts}


def drawn(tracks: Mapping[str, Rows], points: Mapping[str, Rows] | None = None, **more: Any) -> Rows:
    """A whole layout."""
    return {"tracks": tracks, "points": points or {}, "held_by_authority": "rest", "routes": {}, **more}


POINT: Rows = {}
LAYOUTS: dict[str, Rows] = {
    "line": drawn({"a": track("west", "east", 600, ab=120, bc=240, cd=360, de=480)}),
    "ring": drawn(
        {
            "a": track("n1", "n2", 240, b23=120),
            "b": track("n2", "n1", 360, b34=60, b45=180, b52=300),
            "s": track("south", "north", 240, yx=120),
        },
        blocks={"B2": {"track": "a", "at_mm": 1_000}, "X": {"track": "s", "at_mm": 200_000}},
        fouling=[["B2", "X"]],
    ),
    "balloon": drawn(
        {
            "stem": track("end", "P.tip", 360, s1=120, s2=240, s3=340),
            "loop": track("P.normal", "P.reverse", 460, l1=20, l2=160, l3=300, l4=440),
        },
        {"P": POINT},
    ),
    "eight": drawn(
        {
            "l1": track("X.b1", "X.a2", 400, l1=20, l2=140, l3=260, l4=380),
            "l2": track("X.b2", "X.a1", 400, m1=20, m2=140, m3=260, m4=380),
        },
        {"X": {"kind": "crossing"}},
    ),
    "wye": drawn(
        {
            "a": track("a end", "A.tip", 200, a1=100, a2=180),
            "b": track("b end", "B.tip", 200, b1=100, b2=180),
            "c": track("c end", "C.tip", 200, c1=100, c2=180),
            "ab": track("A.normal", "B.reverse", 160, ab1=20, ab2=140),
            "bc": track("B.normal", "C.reverse", 160, bc1=20, bc2=140),
            "ca": track("C.normal", "A.reverse", 160, ca1=20, ca2=140),
        },
        {"A": POINT, "B": POINT, "C": POINT},
    ),
    "scissors": drawn(
        {
            "nw": track("north west", "NW.tip", 260, nw1=120, nw2=240),
            "ne": track("north east", "NE.tip", 260, ne1=120, ne2=240),
            "sw": track("south west", "SW.tip", 260, sw1=120, sw2=240),
            "se": track("south east", "SE.tip", 260, se1=120, se2=240),
            "n": track("NW.normal", "NE.normal", 60),
            "s": track("SW.normal", "SE.normal", 60),
            "d1": track("NW.reverse", "D.a1", 30),
            "d2": track("D.b1", "SE.reverse", 30),
            "d3": track("SW.reverse", "D.a2", 30),
            "d4": track("D.b2", "NE.reverse", 30),
        },
        {"NW": POINT, "NE": POINT, "SW": POINT, "SE": POINT, "D": {"kind": "crossing"}},
    ),
    "terminus": drawn(
        {
            "stem": track("west", "P.tip", 380, s1=120, s2=240, s3=360),
            "one": track("P.normal", "buffer 1", 170, p1=20),
            "two": track("P.reverse", "Q.tip", 40, p2=20),
            "three": track("Q.normal", "buffer 2", 170, p3=20),
            "four": track("Q.reverse", "buffer 3", 170, p4=20),
        },
        {"P": POINT, "Q": POINT},
    ),
    "crossover": drawn(
        {
            "uw": track("up west", "U.tip", 260, u1=120, u2=240),
            "ue": track("U.normal", "up east", 260, u3=20, u4=140),
            "dw": track("down west", "D.normal", 260, d1=120, d2=240),
            "de": track("D.tip", "down east", 260, d3=20, d4=140),
            "x": track("U.reverse", "D.reverse", 50, x=25),
        },
        {"U": POINT, "D": POINT},
    ),
    "short block": drawn(
        {
            "a": track("west", "P.tip", 410, ab=120, bc=145, cd=165, de=270, ef=390),
            "m": track("P.normal", "main", 160, mp=20),
            "l": track("P.reverse", "loop", 160, lp=20),
        },
        {"P": POINT},
    ),
    "station": drawn(
        {
            "w": track("west", "W.tip", 260, w1=120, w2=240),
            "m": track("W.normal", "E.normal", 200, m1=20, m2=180),
            "l": track("W.reverse", "F.tip", 160, l1=20, l2=140),
            "k": track("F.normal", "E.reverse", 40, k1=20),
            "y": track("F.reverse", "T.normal", 40, y1=20),
            "z": track("T.tip", "yard", 160, z1=20),
            "t": track("T.reverse", "trap", 30),
            "e": track("E.tip", "east", 260, e1=20, e2=140),
        },
        {"W": POINT, "E": POINT, "F": POINT, "T": POINT},
        flank={"T": "reverse"},
    ),
}
"""Lines that close on themselves, junctions, ends, a block shorter than every train, a station with a trap."""
REAL = ("osrd-small_infra.json", "osrd-overlapping_routes.json", "osrd-three_trains.json")
LENGTHS_MM = {"ring": (120_000, 390_000, 390_000), "line": (40_000, 140_000, 260_000)}
USUAL_LENGTHS_MM = (35_000, 90_000, 150_000, 260_000)
REAL_LENGTHS_MM = (80_000, 200_000, 600_000)


def walks(network: Network, here: Place, blocks: int) -> Iterator[tuple[dict[str, str], list[str]]]:
    """Every way on from a boundary over so many blocks: points as they must lie, and the boundaries met."""
    pending: list[dict[str, str]] = [{}]
    while pending:
        points = pending.pop()
        met: list[str] = []
        for event in network.follow(here, lambda point, _, lie=points: lie.get(point)):  # type: ignore[misc]
            if isinstance(event, Closed) and event.junction not in points:
                ways = network.junctions[event.junction].ways_from(event.leg)
                pending += [{**points, event.junction: position} for position in sorted(ways)]
                break
            if isinstance(event, Cut | Stop):
                met.append(event.name)
                if len(met) == blocks:
                    yield points, met
                    break


def with_routes(rows: Rows) -> Rows:
    """The layout with every route over one block, two and three, some with an overlap, some released at once."""
    network = raw_native.network_of(rows)
    crossed = {block for block, points in crossings_in(network).items() if points}
    routes: dict[str, Rows] = {}
    for cut, heading in ((cut, way) for cuts in network.cuts.values() for _, cut in cuts for way in (1, -1)):
        here = Place(*network.cut(cut), heading)
        if network.block_of[network.piece_behind(here)] in crossed:
            continue
        for blocks in (1, 2, 3):
            for points, met in walks(network, here, blocks):
                row = {
                    "from": cut,
                    "direction": "forward" if heading > 0 else "backward",
                    "to": met[-1],
                    "points": points,
                }
                name = (
                    f"{cut} {row['direction']} " + " ".join(met) + "".join(f" {p}{at[0]}" for p, at in points.items())
                )
                routes[name] = row if blocks != 2 else row | {"release_at": met[:-1]}
                if "flank" in rows and not rows["flank"].keys() & points:
                    routes[f"{name} flank"] = routes[name] | {"flank": rows["flank"]}
                if blocks > 1:
                    routes[f"{name} overlap"] = row | {"to": met[-2], "overlap_to": met[-1]}
    return rows | {"routes": routes}


def crossings_in(network: Network) -> dict[str, list[str]]:
    """Block -> crossings without blades: a train in such a block may stand on either track of it."""
    found: dict[str, list[str]] = {}
    for name, junction in network.junctions.items():
        if not junction.moves and len(junction.legs) > 2:
            (end, *_) = junction.legs.values()
            found.setdefault(network.block_of[network.last_piece(end)], []).append(name)
    return found


def fouling_of(network: Network, rows: Rows) -> tuple[tuple[Stretch, Stretch], ...]:
    """Where legs of points and crossings are too near to each other, and stretches said to foul."""
    found: list[tuple[Stretch, Stretch]] = []
    for junction in network.junctions.values():
        ways = {leg: set(junction.ways_from(leg).values()) for leg in junction.legs}
        legs = sorted(junction.legs)
        found += [
            (beside(network, junction.legs[one]), beside(network, junction.legs[other]))
            for one in legs
            for other in legs
            if one < other and other not in ways[one] and len(legs) > 2
        ]
    for one, other in rows.get("fouling", []):
        for first, index in sorted(network.blocks[one]):
            for second, at in sorted(network.blocks[other]):
                found.append(((first, *network.sides((first, index))), (second, *network.sides((second, at)))))
    return tuple(found)


def beside(network: Network, end: tuple[str, int]) -> Stretch:
    """The stretch of a leg that is too near to the others."""
    name, which = end
    low, high = network.sides(network.last_piece(end))
    return (name, max(low, high - FOULING_MM), high) if which else (name, low, min(high, low + FOULING_MM))


def sound(found: raw_native.Enumerated | raw_railjson.Enumerated) -> list[str]:
    """Routes against which the walk finds nothing, and which neither begin nor end in a crossing's block."""
    wrong = {finding.elements[0] for finding in found.violations}
    crossed = crossings_in(found.network)
    return [
        name
        for name, route in sorted(found.routes.items())
        if name not in wrong and route.start not in crossed and route.destination not in crossed
    ]


@cache
def told(name: str, trains: int) -> Told:
    """Survey a layout, and write down what the kernel is told of it."""
    if name in LAYOUTS:
        rows = with_routes(LAYOUTS[name])
        found: raw_native.Enumerated | raw_railjson.Enumerated = raw_native.enumerate_data(rows)
        fouls = frozenset(found.fouls) if isinstance(found, raw_native.Enumerated) else frozenset[tuple[str, str]]()
        lengths_mm, speed_mm_s = LENGTHS_MM.get(name, USUAL_LENGTHS_MM), 9_000
    else:
        rows, found = {}, raw_railjson.enumerate_file(files.FOLDER / name)
        fouls, lengths_mm, speed_mm_s = frozenset(), REAL_LENGTHS_MM, 30_000
    routes = {route: found.routes[route] for route in sound(found)}
    layout = layout_of(found.network, routes, fouls, trains)
    return Told(
        name,
        found.network,
        layout,
        records_of(layout),
        {route: path_of(found.network, routes[route]) for route in layout.routes},
        fouling_of(found.network, rows),
        lengths_mm,
        speed_mm_s,
    )
