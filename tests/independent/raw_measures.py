"""How near boundaries lie to points and to each other, by walks over the plain graph along every way."""

from __future__ import annotations

from collections.abc import Collection, Iterator, Mapping
from itertools import combinations, product

from tests.independent.raw_graph import End, Network, Place

CLEAR_MM = 20_000
"""No turnout of more than 57 m radius is clear sooner: the square root of 2 times 3.5 m times that."""
CROSSED_MM = 2_475
"""At right angles, 3.5 m apart: that divided by the square root of two."""
ROOM_MM, LAST_MM = 6_339, 2_713
"""For two tags and for one: 2 m of overhang, a window of 513 mm and 200 mm of laying for each; between two a window
of 513 mm and the laying of both."""
LONGEST_MM, VEHICLE_MM = 2**28 - 1, 20_000
"""A tag has 28 bits; no vehicle is shorter, so that no file has shorter tracks alone."""
Measured = tuple[str, tuple[str, ...]]


def measured(
    network: Network, told_mm: Mapping[tuple[str, str], int], fouls: Mapping[str, Collection[str]]
) -> Iterator[Measured]:
    """Rule and elements of each boundary that lies too near, and each block that is too short.

    ``told_mm``: the clearance of a leg where the file tells it.  ``fouls``: blocks that bar each other.
    """
    for block in network.blocks:
        for name, mouth in network.mouths(block):
            if not name or not _is_cut(network, mouth):
                continue
            ways = _ways_to(network, mouth, {}, ())
            if [far_mm > LONGEST_MM for far_mm, cut, _ in ways if cut is not None] == [True]:
                yield "a distance fits its tag", tuple(network.ends(block))
            for far_mm, cut, _ in ways:
                if far_mm < (LAST_MM if cut is None else ROOM_MM):
                    yield "a block has room for its tags", tuple(network.ends(block))
    yield from _tags_in_points(network)
    for point, leg, cuts in legs(network, fouls):
        if cuts[0][0] < told_mm.get((point, leg), CLEAR_MM):
            yield "a train behind a boundary is clear of the point", tuple(sorted((point, cuts[0][1])))
    yield from _side_by_side(network, told_mm, fouls)
    for (point, leg), clear_mm in told_mm.items():
        if point in network.junctions and clear_mm < CROSSED_MM and _is_left_out(network, point, leg):
            yield "a leg is told to be clear where tracks are apart", tuple(sorted({point, leg}))
    if any(network.cuts.values()) and max(network.lengths.values()) < VEHICLE_MM:
        yield "a track is as long as a vehicle", tuple(network.lengths)


def legs(network: Network, fouls: Mapping[str, Collection[str]]) -> Iterator[tuple[str, str, list[tuple[int, str]]]]:
    """Each leg of a point that some way over it does not use, with the boundaries that a train stands behind."""
    for point, junction in network.junctions.items():
        for leg, end in junction.legs.items() if len(junction.legs) > 2 else ():
            if all(leg in pair for pairs in junction.joins.values() for pair in pairs):
                continue
            own = network.block_of[network.last_piece(end)]
            closed = {own, *fouls.get(own, ())}
            found = _ways_to(network, _inward(network, end), {point: leg}, closed)
            cuts = sorted((far_mm, cut) for far_mm, cut, _ in found if cut is not None)
            if cuts:
                yield point, leg, cuts


def _tags_in_points(network: Network) -> Iterator[Measured]:
    """Boundaries with a point or crossing on either side before the place of the tag there."""
    for track, on_track in network.cuts.items():
        for at, name in on_track:
            points = {_point_within(network, Place(track, at, heading), LAST_MM) for heading in (1, -1)}
            for point in points - {""}:
                yield "a boundary's tags lie clear of points and crossings", tuple(sorted({name, point}))


def _point_within(network: Network, place: Place, most_mm: int) -> str:
    """The first thing with three legs or four that is nearer than that, no other boundary between; "" if none is."""
    left_mm = most_mm
    while True:
        far = place._replace(mm=network.lengths[place.track] if place.heading > 0 else 0)
        between = any((mm - place.mm) * place.heading > 0 for mm, _ in network.cuts.get(place.track, []))
        left_mm -= abs(far.mm - place.mm)
        met, leg = network.leg_at.get((far.track, 1 if far.heading > 0 else 0), ("", ""))
        if between or left_mm <= 0 or not met:
            return ""
        if len(network.junctions[met].legs) > 2:
            return met
        (other,) = network.junctions[met].ways_from(leg).values()
        place = _inward(network, network.junctions[met].legs[other])


def _side_by_side(
    network: Network, told_mm: Mapping[tuple[str, str], int], fouls: Mapping[str, Collection[str]]
) -> Iterator[Measured]:
    """Boundaries on two legs, no way leading from one leg to the other, so near that trains behind both touch.

    What lies behind the first boundary at which nothing bars the point is told of elsewhere.
    """
    first_mm = {(point, leg): cuts[0][0] for point, leg, cuts in legs(network, fouls)}
    for point, junction in network.junctions.items():
        joined = {frozenset(pair) for pairs in junction.joins.values() for pair in pairs}
        near: dict[str, list[tuple[str, str]]] = {}
        for leg, end in junction.legs.items() if len(junction.legs) > 2 else ():
            own = network.block_of[network.last_piece(end)]
            mm = min(told_mm.get((point, leg), CLEAR_MM), first_mm.get((point, leg), LONGEST_MM))
            found = _cuts_within(network, _inward(network, end), point, mm)
            near[leg] = [(cut, block) for cut, block in found if block == own or block in fouls.get(own, ())]
        for one, other in combinations(near, 2):
            for (cut, block), (far, beside) in product(near[one], near[other]):
                if frozenset((one, other)) not in joined and block != beside and beside not in fouls.get(block, ()):
                    yield "trains behind two legs of a point are clear of each other", tuple(sorted((point, cut, far)))


def _cuts_within(network: Network, start: Place, point: str, most_mm: int) -> Iterator[tuple[str, str]]:
    """Each boundary nearer than that, and the block behind it, on every way that does not pass the point again."""
    todo = [(0, start)]
    while todo:
        so_far_mm, place = todo.pop()
        for at, name in network.cuts.get(place.track, []):
            if (at - place.mm) * place.heading > 0 and so_far_mm + abs(at - place.mm) < most_mm:
                yield name, network.block_of[network.piece_ahead(Place(place.track, at, place.heading))]
        end = (place.track, 1 if place.heading > 0 else 0)
        far_mm = so_far_mm + abs((network.lengths[place.track] if place.heading > 0 else 0) - place.mm)
        name, leg = network.leg_at.get(end, ("", ""))
        if far_mm < most_mm and name not in ("", point):
            junction = network.junctions[name]
            onward = set(junction.ways_from(leg).values())
            todo += [(far_mm, _inward(network, junction.legs[other])) for other in onward]


def _is_left_out(network: Network, point: str, leg: str) -> bool:
    """Whether a vehicle can pass a point and stay off a leg of it."""
    junction = network.junctions[point]
    ways = [pair for pairs in junction.joins.values() for pair in pairs]
    return len(junction.legs) > 2 and any(leg not in pair for pair in ways)


def _is_cut(network: Network, place: Place) -> bool:
    return any(mm == place.mm for mm, _ in network.cuts.get(place.track, []))


def _inward(network: Network, end: End) -> Place:
    track, which = end
    return Place(track, network.lengths[track] if which else 0, -1 if which else 1)


def _ways_to(
    network: Network, start: Place, barred: Mapping[str, str], closed: Collection[str]
) -> list[tuple[int, str | None, str]]:
    """Every way on to a boundary behind which a block is not closed, or to an end of track: how far, which, where."""
    found: list[tuple[int, str | None, str]] = []
    todo: list[tuple[int, Place, frozenset[tuple[str, str]]]] = [(0, start, frozenset())]
    while todo:
        so_far_mm, place, seen = todo.pop()
        ahead = [cut for cut in network.cuts.get(place.track, []) if (cut[0] - place.mm) * place.heading > 0]
        block = ""
        for at, name in ahead if place.heading > 0 else reversed(ahead):
            block = network.block_of[network.piece_ahead(Place(place.track, at, place.heading))]
            if block not in closed:
                found.append((so_far_mm + abs(at - place.mm), name, block))
                break
        else:
            end = (place.track, 1 if place.heading > 0 else 0)
            far_mm = so_far_mm + abs((network.lengths[place.track] if place.heading > 0 else 0) - place.mm)
            if end not in network.leg_at:
                found.append((far_mm, None, block))
                continue
            name, leg = network.leg_at[end]
            if (name, leg) in seen or name in barred:
                continue
            for other in set(network.junctions[name].ways_from(leg).values()):
                beyond = _inward(network, network.junctions[name].legs[other])
                todo.append((far_mm, beyond, seen | {(name, leg)}))
    return found
