"""Cars that walk at random over the raw track never leave what the imported route covers.

The track is the file's own; of the imported layout only ``start``, ``way`` and ``needs`` are used, so that
a wrong block, a wrong position or a missing point lets a car get where it must not be.
"""

from __future__ import annotations

import json
import random
from collections.abc import Mapping

import pytest

from kernel.layout import Layout
from kernel.names import Point, Position
from kernel.names import Route as RouteName
from models.layouts import load, load_text
from tests.independent import raw_railjson
from tests.independent.files import OTHERS, SAMPLES, Enumerated, enumerated, path_of
from tests.independent.made_up import made_up
from tests.independent.raw_graph import Network, Place, Route, Way
from tests.independent.raw_table import Enumerated as Table
from tests.independent.test_verdicts import every_file
from tests.independent.walk_of_cars import SEGMENT_MM, Astray, RawTrack, TableTrack, Walk, last_segment

WALKS_OF_A_ROUTE = 4
MOST_CARS = 6


def test_the_files_are_those_of_the_enumeration() -> None:
    assert len({*SAMPLES, *OTHERS}) == 10


@every_file
def test_cars_stay_within_what_the_route_covers(name: str) -> None:
    found, layout = enumerated(name), load(path_of(name)).layout
    assert layout.routes, "nothing to walk on"
    for route in sorted(layout.routes):
        for number in range(WALKS_OF_A_ROUTE):
            chance = random.Random(f"{name} {route} {number}")
            walk = prepared(found, layout, route, layout.needs[route], chance)
            walk.take()
            assert walk.seen == blocks_in_order(layout, route)
            assert set(walk.seen) == layout.claims[route]


@pytest.mark.parametrize("name", SAMPLES)
def test_a_point_lying_otherwise_leads_astray(name: str) -> None:
    """The walk would notice: a point on the path in its other position, and a car is elsewhere or stuck."""
    found, layout = enumerated(name), load(path_of(name)).layout
    noticed = 0
    for route in sorted(layout.routes):
        walked = found.routes[route]
        assert isinstance(walked, Route)
        for point, position in walked.passed.items():
            other = "reverse" if position == "normal" else "normal"
            needs = {**layout.needs[route], Point(point): Position(other)}
            walk = prepared(found, layout, route, needs, random.Random(f"{name} {route} {point}"))
            with pytest.raises(Astray):
                walk.take()
            noticed += 1
    assert noticed >= 10


@pytest.mark.parametrize("name", SAMPLES)
def test_a_point_not_held_leads_astray(name: str) -> None:
    """The same for a point met facing that the route does not hold: sooner or later it lies otherwise."""
    found, layout = enumerated(name), load(path_of(name)).layout
    for route in sorted(layout.routes):
        walked = found.routes[route]
        assert isinstance(walked, Route)
        for point in walked.faced:
            needs = {other: position for other, position in layout.needs[route].items() if other != point}
            assert any(is_led_astray(found, layout, route, needs, number) for number in range(64)), (route, point)


def is_led_astray(
    found: Enumerated, layout: Layout, route: RouteName, needs: Mapping[Point, Position], number: int
) -> bool:
    try:
        prepared(found, layout, route, needs, random.Random(f"{route} {number}")).take()
    except Astray:
        return True
    return False


def blocks_in_order(layout: Layout, route: RouteName) -> list[str]:
    blocks = [layout.start[route]]
    while blocks[-1] in layout.way[route]:
        blocks.append(layout.way[route][blocks[-1]])
    return list(blocks)


def prepared(
    found: Enumerated, layout: Layout, route: RouteName, needs: Mapping[Point, Position], chance: random.Random
) -> Walk:
    """A train of some cars, standing somewhere in the start block, about to run along the route."""
    blocks = blocks_in_order(layout, route)
    allowed = dict(zip(blocks, [*blocks[1:], None], strict=True))
    assert set(blocks) <= {layout.start[route]} | layout.covers[route] | layout.overlap[route]
    held = {str(point): str(position) for point, position in needs.items()}
    cars = chance.randint(1, MOST_CARS)
    walked = found.routes[route]
    if isinstance(found, Table):
        ahead_mm = sorted(chance.sample(range(SEGMENT_MM), cars))
        row = found.rows[route]
        places = [Place(last_segment(found, route), SEGMENT_MM - mm, 1) for mm in ahead_mm]
        until = ahead_mm[0] + SEGMENT_MM * len(row.segments)
        table = TableTrack(found, row.orientation, held, chance)
        run = [ahead_mm[0] - mm for mm in ahead_mm]
        walk = Walk(table, places, run, until, allowed, chance)
    else:
        assert isinstance(walked, Route)
        track = RawTrack(found.network, held, chance)
        mouth, room_mm = stand(found.network, walked, track)
        from_mouth = sorted(chance.sample(range(1, room_mm), cars), reverse=True)
        places = [track.go(mouth, mm)[0] for mm in from_mouth]
        until = room_mm - from_mouth[0] + walked.length_mm
        run = [mm - from_mouth[0] for mm in from_mouth]
        walk = Walk(track, places, run, until, allowed, chance, walked.end)
    walk.look(0, [layout.start[route]])
    return walk


def stand(network: Network, route: Route, track: RawTrack) -> tuple[Place, int]:
    """Where a train came into the start block, and how far from there it can stand; points behind it lie for it."""
    if route.from_end:
        return route.entry, route.spans[route.start][1]
    at = network.name_at(route.entry)
    ways = [way for way in network.ways(route.start) if way.out == at and fits(way, track.held)]
    way = track.chance.choice(ways)
    for passing in way.passed:
        if passing.junction in track.lies and not passing.facing:
            track.lies[passing.junction] = passing.position
    return way.mouth, network.way_mm(way)


def fits(way: Way, held: Mapping[str, str]) -> bool:
    """Whether a train could stand on this way with these points held.

    A slip has two positions for whichever leg a train comes by, and is faced from all of them.
    """
    return all(held.get(passing.junction, passing.position) == passing.position for passing in way.passed)


def test_cars_stay_within_routes_of_made_up_networks() -> None:
    """Slips, crossings and several points in a block, wherever the layout holds."""
    walked = 0
    for number in range(400):
        data = made_up(random.Random(number))
        found = raw_railjson.enumerate_data(data) if data else None
        if found is None or found.violations:
            continue
        layout = load_text("made_up.json", json.dumps(data)).layout
        for route in sorted(layout.routes):
            for again in range(WALKS_OF_A_ROUTE):
                chance = random.Random(f"{number} {route} {again}")
                prepared(found, layout, route, layout.needs[route], chance).take()
                walked += 1
    assert walked >= 100
