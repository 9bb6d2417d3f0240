"""What a verdict rests on, counted again over the plain graph; what a file tells of itself is believed."""

from __future__ import annotations

from collections.abc import Collection, Iterator, Mapping, Set
from heapq import heapify, heappop, heappush
from itertools import count

from models.layouts.told import Told, Wanted
from tests.independent.raw_graph import End, Network, Place, Route, Way
from tests.independent.raw_measures import CLEAR_MM, legs
from tests.independent.raw_points import closing_positions, far_end

Rests = dict[tuple[str, bool], set[tuple[str, ...]]]
"""Kind, whether the file declares it -> the instances."""
MOST_STEPS = 3_000
"""A loop that is not found within so many steps is not compared."""


def rests_again(
    network: Network, routes: Mapping[str, Route], told: Told, named: Mapping[tuple[str, str], str | None]
) -> Rests:
    """Authority, clearances, points at the first start, joints, ends of track and routes left out.

    ``named``: of boundaries equally near behind a leg, the one that is told.
    """
    stated = {wanted.name: wanted for wanted in told.routes}
    held = {(str(one), str(other)) for one, other in told.held or ()}
    if told.held is None:
        held = {pair for name, route in routes.items() for pair in _held(network, route, stated[name])}
    fouls = {str(block): {str(other) for other in others} for block, others in told.fouls.items()}
    nearest = {(point, leg): [cut for mm, cut in cuts if mm == cuts[0][0]] for point, leg, cuts in legs(network, fouls)}
    cleared = [(*leg, next((cut for cut in cuts if cut == named.get(leg)), cuts[0])) for leg, cuts in nearest.items()]
    start = {
        (point, route.start)
        for route in routes.values()
        for point in route.needs
        if point in network.points_in.get(route.start, ())
    }
    found: Rests = {
        ("authority", told.held is not None): {*held},
        ("clearance", True): {(point, leg) for point, leg, _ in cleared if (point, leg) in told.clear_mm},
        ("clearance", False): {each for each in cleared if each[:2] not in told.clear_mm},
        ("start", True): {each for each in start if each[0] in told.laid_at_start},
        ("start", False): {each for each in start if each[0] not in told.laid_at_start},
        ("joint", False): set(_joints(network, told)),
        ("end", False): set(_open_ends(network)),
        ("position", False): {
            (point, name)
            for name, route in routes.items()
            for point in _spare(network, route)
            if point not in stated[name].positions and point not in stated[name].flank
        },
        ("left out", False): {(name,) for name in stated if name not in routes},
    }
    return {kind: instances for kind, instances in found.items() if instances}


def _spare(network: Network, route: Route) -> list[str]:
    """The points beside the path that close it in every position, or in none."""
    beside = [
        (block, point)
        for block in route.claims[1:]
        for point in network.points_in.get(block, ())
        if point not in route.passed
    ]
    return [
        point
        for block, point in beside
        if len(closing_positions(network, route, block, point)) in (0, len(network.junctions[point].joins))
    ]


def _joints(network: Network, told: Told) -> list[tuple[str, ...]]:
    plain = {name: junction for name, junction in network.junctions.items() if len(junction.legs) == 2}
    if told.joints is None:
        return []
    named = {
        name.removeprefix("joint "): sorted(track for track, _ in each.legs.values()) for name, each in plain.items()
    }
    return [(name, *tracks) for name, tracks in named.items() if name not in told.joints]


def _open_ends(network: Network) -> Iterator[tuple[str, str]]:
    """The ends of track that no junction joins, and at which nothing stands that ends track."""
    known = {*network.stops, *(end for junction in network.junctions.values() for end in junction.legs.values())}
    for track, long_mm in network.lengths.items():
        yield from ((track, f"{mm} mm") for end, mm in ((0, 0), (1, long_mm)) if (track, end) not in known)


def _held(network: Network, route: Route, stated: Wanted) -> Set[tuple[str, str]]:
    """The pairs that no flank point keeps apart; one that shields several blocks counts for the last alone."""
    claims = route.claims
    open_ = {
        (block, target): wanted
        for target in claims[1:]
        for block in network.neighbours[target] - set(claims)
        if (wanted := network.demands(block, target)) is not None
    }
    shut = set()
    for point, position in stated.flank.items():
        there = [
            t
            for t in claims[1:]
            for (b, to), wanted in open_.items()
            if to == t and wanted.get(point, position) != position and point in network.points_in.get(b, ())
        ]
        beside = next((b for b in network.points_in if point in network.points_in[b]), "")
        last = [target for target in there if target in route.covers][-1:] or there[-1:]
        shut |= {(beside, target) for target in last}
    return open_.keys() - shut


Loops = tuple[int, frozenset[str], frozenset[str]] | str | None
"""How long the shortest are, the blocks they begin in, the legs of unknown clearance; a text if it is given up."""


def shortest_loops(
    network: Network, told_mm: Mapping[tuple[str, str], int], fouls: Mapping[str, Collection[str]]
) -> Loops:
    """The shortest ways back to where a train has not left: between blocks, or over a junction within one."""
    both = _between_blocks(network, fouls), _over_a_junction(network, told_mm)
    if "given up" in both:
        return "given up"
    found = [each for each in both if isinstance(each, tuple)]
    least_mm = min((mm for mm, _, _ in found), default=0)
    blocks = frozenset[str]().union(*(blocks for mm, blocks, _ in found if mm == least_mm))
    return (least_mm, blocks, frozenset().union(*(legs for mm, _, legs in found if mm == least_mm))) if found else None


def _between_blocks(network: Network, fouls: Mapping[str, Collection[str]]) -> Loops:
    """The shortest ways out of a block and back into it or one that it fouls, way by way through whole blocks."""
    ways = {block: list(network.ways(block)) for block in network.blocks}
    ends: dict[Place, list[Way]] = {}
    for each in ways.values():
        for way in each:
            if way.into is not None:
                ends.setdefault(far_end(network, way), []).append(way)
    turn, seen, found_mm, found = count(), set(), None, set[str]()
    todo = [
        (0, next(turn), block, out, out, str(way.into), frozenset[tuple[str, str]]())
        for block, each in ways.items()
        for out, way in {far_end(network, way): way for way in each if way.into not in (None, block)}.items()
    ]
    heapify(todo)
    while todo and (found_mm is None or todo[0][0] == found_mm):
        mm, _, block, out, place, here, lies = heappop(todo)
        if (block, out, place, lies) in seen:
            continue
        seen.add((block, out, place, lies))
        if len(seen) > MOST_STEPS:
            return "given up"
        into = [way for way in ways[here] if way.mouth == place]
        lays = [moved(network, left) for left in ends[out]] if here == block else [dict(lies)]
        own = {block, *fouls.get(block, ())}
        in_line = here != block and (here not in own or network.block_of[network.piece_behind(place)] in own)
        if not in_line and any(_agree(lay, moved(network, way)) for lay in lays for way in into):
            found_mm = mm
            found.add(block)
            continue
        if here == block:
            continue
        for way in into:
            passed = moved(network, way)
            if way.into is not None and way.into != here and _agree(dict(lies), passed):
                beyond = (far_end(network, way), way.into, lies | set(passed.items()))
                heappush(todo, (mm + network.way_mm(way), next(turn), block, out, *beyond))
    return None if found_mm is None else (found_mm, frozenset(found), frozenset())


def _over_a_junction(network: Network, told_mm: Mapping[tuple[str, str], int]) -> Loops:
    """The shortest ways from a junction back to it that meet no boundary, less what two legs are not apart on."""
    found: dict[str, dict[int, set[str]]] = {}
    steps = 0
    for name, junction in network.junctions.items():
        for leg, end in junction.legs.items() if len(junction.legs) > 2 else ():
            lies = [{name: at} if junction.moves else {} for at in junction.ways_from(leg)]
            todo = [(0, end, lay, frozenset[End]()) for lay in lies]
            while todo:
                mm, (track, which), lay, seen = todo.pop()
                steps += 1
                if steps > MOST_STEPS:
                    return "given up"
                far = (track, 1 - which)
                if network.cuts.get(track) or far not in network.leg_at or (track, which) in seen:
                    continue
                mm += network.lengths[track]
                met, by = network.leg_at[far]
                over = network.junctions[met]
                onward = [
                    (at, other) for at, other in over.ways_from(by).items() if not over.moves or lay.get(met, at) == at
                ]
                if met != name:
                    lays = [(lay | ({met: at} if over.moves else {}), over.legs[other]) for at, other in onward]
                    todo += [(mm, after, then, seen | {(track, which)}) for then, after in lays]
                elif onward:
                    apart = by not in junction.ways_from(leg).values()
                    less_mm = sum(told_mm.get((name, each), CLEAR_MM) for each in (leg, by)) if apart else 0
                    taken = {f"{name} {each}" for each in (leg, by) if apart and (name, each) not in told_mm}
                    block = network.block_of[network.last_piece(end)]
                    found.setdefault(block, {}).setdefault(max(mm - less_mm, 0), set()).update(taken)
    least_mm = min(map(min, found.values()), default=None)
    least = {block: legs[least_mm] for block, legs in found.items() if least_mm in legs}
    return None if least_mm is None else (least_mm, frozenset(least), frozenset().union(*least.values()))


def moved(network: Network, way: Way) -> dict[str, str]:
    """How the points of a way lie."""
    return {each.junction: each.position for each in way.passed if network.junctions[each.junction].moves}


def _agree(one: Mapping[str, str], other: Mapping[str, str]) -> bool:
    return all(other.get(point, at) == at for point, at in one.items())
