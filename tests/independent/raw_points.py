"""How points lie that a route does not pass: in its start block behind its entry, and beside its path."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping

from tests.independent.raw_graph import Cut, Finding, Network, Over, Piece, Place, Route, Stop, Way


def named_beside(network: Network, route: Route, given: Mapping[str, str], crossed: Iterable[str]) -> dict[str, str]:
    """The positions that a route gives for points of its blocks that it does not pass."""
    there = {point for block in route.claims for point in network.points_in.get(block, ())} - set(crossed)
    return {point: at for point, at in given.items() if point in there and at in network.junctions[point].joins}


def lay_points(network: Network, route: Route, named: Mapping[str, str]) -> list[Finding]:
    """Write down what a route needs in its blocks, and where its train may stand; what is not told is found."""
    for block in route.claims[1:]:
        spare = [point for point in network.points_in.get(block, ()) if point not in route.passed]
        route.needs |= {point: named.get(point) or beside(network, route, block, point) for point in spare}
    in_start = set(network.points_in.get(route.start, ()))
    route.needs |= {p: at for p, at in route.passed.items() if p not in in_start or route.from_end}
    here = {point: at for point, at in named.items() if point in in_start}
    own, clash = _own_track(network, route, here)
    if own is None:
        return [] if clash is None else [clash]
    route.needs |= here | _lies(network, own)
    ends = {own.mouth, turned(far_end(network, own))}
    found: list[Finding] = []
    for way in network.ways(route.start):
        far = turned(far_end(network, way))
        if not {way.mouth, far} & ends and _fits(way, {p: route.needs[p] for p in in_start & set(route.needs)}):
            route.stands |= {way.mouth, far}
            names = [_name(network, route.start, place) for place in (way.mouth, far)]
            found.append(Finding("the tracks of a start block are told apart", (route.name, *names)))
    route.stands |= {own.mouth}
    return found


def _own_track(network: Network, route: Route, here: Mapping[str, str]) -> tuple[Way | None, Finding | None]:
    """The only way through the start block to where the route leaves it; else what is not told."""
    if route.from_end:
        ways = [way for way in network.ways(route.start) if way.mouth == route.entry and _fits(way, route.passed)]
        return next(way for way in ways if way.into == route.covers[0]), None
    leaving = network.name_at(route.entry)
    ways = [way for way in network.ways(route.start) if way.out == leaving and _fits(way, here)]
    back = {tuple((each.junction, each.leg) for each in reversed(way.passed)): way for way in reversed(ways)}
    if len(back) == 1:
        (own,) = back.values()
        return own, None
    rule = "a route says where its train stands"
    for legs in zip(*back, strict=False):
        if len(set(legs)) > 1:
            return None, Finding(rule, (route.name, legs[0][0]))
    return None, Finding(rule, (route.name, *here))


def _lies(network: Network, way: Way) -> dict[str, str]:
    return {each.junction: each.position for each in way.passed if network.junctions[each.junction].moves}


def _fits(way: Way, lies: Mapping[str, str]) -> bool:
    """Whether a way is open with points so."""
    return all(lies.get(passing.junction, passing.position) == passing.position for passing in way.passed)


def far_end(network: Network, way: Way) -> Place:
    """Where a way comes to the other end of its block."""
    positions = _lies(network, way)
    for event in network.follow(way.mouth, lambda point, _: positions.get(point)):
        if isinstance(event, Cut | Stop):
            return event.place
    raise AssertionError("a way ends")


def turned(place: Place) -> Place:
    """The same place, looking the other way."""
    return place._replace(heading=-place.heading)


def _name(network: Network, block: str, mouth: Place) -> str:
    """A boundary or end of track; the track, if that has no name."""
    return next(name for name, place in network.mouths(block) if place == mouth) or mouth.track


def beside(network: Network, route: Route, block: str, point: str) -> str:
    """How a point beside the path lies: so that what comes to it from outside does not come to the path."""
    joins = network.junctions[point].joins
    closing = closing_positions(network, route, block, point)
    return min(closing or sorted(joins), key=lambda position: (_less_track(network, point, position), position))


def closing_positions(network: Network, route: Route, block: str, point: str) -> list[str]:
    """The positions of a point beside the path in which what comes to it from outside does not come to the path."""
    pieces, junctions = _path(network, route, block)
    outside = [place for name, place in network.mouths(block) if name in dict(_cuts(network, place))]
    faced = {leg for junction, leg in _rolls(network, outside, pieces, junctions) if junction == point}
    joins = network.junctions[point].joins
    closing = []
    for position in sorted(joins):
        ways = [network.junctions[point].ways_from(leg) for leg in sorted(faced)]
        led = [network.junctions[point].legs[way[position]] for way in ways if position in way]
        away = [Place(track, network.lengths[track] if end else 0, -1 if end else 1) for track, end in led]
        if ("", "") not in set(_rolls(network, away, pieces, junctions)):
            closing.append(position)
    return closing


def _cuts(network: Network, place: Place) -> Iterator[tuple[str, int]]:
    return ((name, mm) for mm, name in network.cuts.get(place.track, []) if mm == place.mm)


def _path(network: Network, route: Route, block: str) -> tuple[set[Piece], set[str]]:
    """The stretches and junctions that a route runs over within a block."""
    pieces, junctions = {network.piece_ahead(route.comes_in[block])}, set[str]()
    for event in network.follow(route.comes_in[block], lambda at, _: route.passed.get(at)):
        if not isinstance(event, Over):
            break
        junctions.add(event.passing.junction)
        pieces.add(network.piece_ahead(event.place))
    return pieces, junctions


def _rolls(
    network: Network, places: Iterable[Place], pieces: set[Piece], junctions: set[str]
) -> Iterator[tuple[str, str]]:
    """The points, each with its leg, that vehicles face which roll in there; empty names where they meet the path."""
    todo, seen = list(places), set[tuple[Piece, int]]()
    while todo:
        place = todo.pop()
        piece = network.piece_ahead(place)
        if piece in pieces:
            yield "", ""
            continue
        if (piece, place.heading) in seen:
            continue
        seen.add((piece, place.heading))
        far = place._replace(mm=network.sides(piece)[1 if place.heading > 0 else 0])
        end = (far.track, 1 if far.heading > 0 else 0)
        if far.mm in {mm for mm, _ in network.cuts.get(far.track, [])} or end not in network.leg_at:
            continue
        name, leg = network.leg_at[end]
        if name in junctions:
            yield "", ""
            continue
        junction = network.junctions[name]
        if junction.faces(leg):
            yield name, leg
        for position in junction.ways_from(leg):
            over = network.cross(far, lambda _, __, at=position: at)  # type: ignore[misc]
            assert isinstance(over, Over)
            todo.append(over.place)


def _less_track(network: Network, point: str, position: str) -> tuple[int, int]:
    """The track up to the next boundary or junction that a position joins, and whole tracks; less comes later."""
    junction = network.junctions[point]
    legs = {leg for pair in junction.joins[position] for leg in pair}
    sides = [network.sides(network.last_piece(junction.legs[leg])) for leg in legs]
    return -sum(high - low for low, high in sides), -sum(network.lengths[junction.legs[leg][0]] for leg in legs)
