"""Where attacks are played on a layout, whichever it is: a way there and back, a way on, and a loop if it has one.

What an attack needs is looked for in the layout, so that the same attack is played on a station made for it
and on one that nobody here drew.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import cache
from itertools import pairwise

from kernel.layout import Layout
from kernel.names import Block, Cab, Car, Point, Position, Route, Run, Serial, UnitLife
from models.world.start import start
from models.world.state import Site, System
from proofs.witnesses.stations import A1, A2, B1, EIGHT, RING, T1, site_of


@dataclass(frozen=True)
class Loop:
    """Track on which a train that always goes forward comes back to where it was.

    ``round``: a route out of a block.  ``home``: on from where that ends, into the block where it began.
    ``rival``: a route of the other train, into the block in which ``round`` ends or too close to it, and free of
    the rest once the first train has come as far as ``past``.
    """

    round: Route
    home: Route
    rival: Route
    past: Block


@dataclass(frozen=True)
class Line:
    """A layout, and where the two trains of an attack run on it.

    ``out``: a route; ``back``: the same way back; ``on``: on from where ``out`` ends, in its direction.
    ``elsewhere``: a block away from all three, where the other train stands.
    """

    name: str
    site: Site
    out: Route
    back: Route
    on: Route
    elsewhere: Block
    loop: Loop | None

    def blocks(self, route: Route) -> Sequence[Block]:
        """The blocks of a route in their order, its overlap left out."""
        return along(self.site.layout, route)

    def standing(self, at: Mapping[Car, frozenset[Block]]) -> System:
        """Everything just started with the cars there, and points as the ways of the attacks need them."""
        layout = self.site.layout
        lies: dict[Point, Position] = {}
        ways = (self.out, self.on, *((self.loop.round, self.loop.home) if self.loop else ()), *sorted(layout.routes))
        for route in ways:
            for point, position in layout.needs[route].items():
                lies.setdefault(point, position)
        return start(self.site, at, {point: lies.get(point, Position("normal")) for point in layout.points})

    def in_the_open(self) -> System:
        """The first train stands where ``out`` begins."""
        home = frozenset({self.site.layout.start[self.out]})
        return self.standing({A1: home, A2: home, B1: frozenset({self.elsewhere})})

    def on_the_loop(self) -> System:
        """The first train stands where the way round begins, and the other where the rival's way does."""
        assert self.loop is not None
        layout = self.site.layout
        here = frozenset({layout.start[self.loop.round]})
        return self.standing({A1: here, A2: here, B1: frozenset({layout.start[self.loop.rival]})})

    def astride_the_loop(self) -> System:
        """The same with its front there, and its rear over what lies before it, back to where the way round ends."""
        assert self.loop is not None
        behind = self.blocks(self.loop.home)
        front, rear = in_order(self.site, self.loop.round)
        away = frozenset({self.site.layout.start[self.loop.rival]})
        return self.standing({front: frozenset({behind[-1]}), rear: frozenset(behind[:-1]), B1: away})


def along(layout: Layout, route: Route) -> list[Block]:
    """The blocks of a route in their order, its overlap left out."""
    way = layout.way[route]
    blocks = [layout.start[route]]
    while blocks[-1] != layout.destination[route]:
        blocks.append(way[blocks[-1]])
    return blocks


def in_order(site: Site, route: Route) -> tuple[Car, Car]:
    """Front and rear of the first train on a route."""
    ahead = site.formation.ahead[_run(route)]
    front, rear = sorted((A1, A2), key=lambda car: len(ahead[car]))
    return front, rear


def line_of(name: str, site: Site) -> Line:
    """Where the attacks are played on a site.

    :raises LookupError: it has no way there and back with a way on.
    """
    loop = next(_loops(site), None)
    for out, back, on in _there_and_back(site):
        away = _away_from(site, out, back, on)
        if away is not None:
            return Line(name, site, out, back, on, away, loop)
    raise LookupError(f"{name} has no way there and back with a way on")


def _there_and_back(site: Site) -> Iterator[tuple[Route, Route, Route]]:
    """A route, the same way back, and one on from its end; points lie for all the same.

    Routes of the file come before those on from inside of them, and short ones before long ones.
    """
    layout, leads = site.layout, _leads(site)
    ways = {route: along(layout, route) for route in layout.routes}
    found = [
        (out, back, on)
        for out, there in ways.items()
        for back in layout.routes
        if ways[back] == there[::-1] and leads(back) != leads(out)
        for on in layout.routes
        if ways[on][0] == there[-1] and ways[on][1] != there[-2] and leads(on) == leads(out)
        if _agree(layout, out, back, on)
    ]

    def key(each: tuple[Route, Route, Route]) -> tuple[int, int, tuple[Route, Route, Route]]:
        inside = [route for route in each if route.endswith(f" from {layout.start[route]}")]
        return len(inside), sum(len(ways[route]) for route in each), each

    yield from sorted(found, key=key)


def _away_from(site: Site, *routes: Route) -> Block | None:
    """A block that is not of these routes, nor too close to them, and has no points."""
    layout = site.layout
    taken = frozenset(block for route in routes for block in layout.claims[route])
    near = taken | frozenset(beside for block in taken for beside in layout.fouls.get(block, frozenset()))
    return next((block for block in sorted(layout.blocks - near) if not layout.points_in[block]), None)


def _loops(site: Site) -> Iterator[Loop]:
    """Every way round in two routes, with a rival for the block that the first ends in, the shortest first."""
    layout, leads = site.layout, _leads(site)
    ways = {route: along(layout, route) for route in layout.routes}
    rounds = sorted(
        (len(way) + len(ways[home]), first, home)
        for first, way in ways.items()
        for home in layout.routes
        if ways[home][0] == way[-1] and ways[home][-1] == way[0] and leads(home) == leads(first)
        if ways[home][1] != way[-2] and ways[home][-2] != way[1] and len(way) > 3
        if _agree(layout, first, home)
        and not any(layout.stands_in[point] in ways[home] for point in layout.needs[first])
    )
    for _, first, home in rounds:
        for rival in sorted(layout.routes):
            past = _past(layout, ways, first, home, rival)
            if past is not None:
                yield Loop(first, home, rival, past)


def _past(layout: Layout, ways: Mapping[Route, list[Block]], first: Route, home: Route, rival: Route) -> Block | None:
    """How far round a train must have come for the rival's route to want nothing of it but where it will end."""
    way, wanted = ways[first], layout.claims[rival]
    near = wanted | frozenset(beside for block in wanted for beside in layout.fouls.get(block, frozenset()))
    if way[-1] not in near or layout.start[rival] in {*way, *ways[home], *layout.fouls.get(way[-1], frozenset())}:
        return None
    for come in range(1, len(way) - 1):
        if not near & (frozenset(way[:-1]) - frozenset(released(layout, first, way[:come]))):
            return way[come]
    return None


def released(layout: Layout, route: Route, left: Sequence[Block]) -> Sequence[Block]:
    """What of a route is released when the tail has left these blocks: each with the end of its part."""
    return [block for block in left if layout.released_after[route][block] in left]


def _agree(layout: Layout, *routes: Route) -> bool:
    """Whether routes need no point in two positions."""
    needs = [layout.needs[route] for route in routes]
    return all(one.get(point, lies) == lies for other in needs for point, lies in other.items() for one in needs)


def _leads(site: Site) -> Callable[[Route], Cab]:
    """The cab of the first train that leads on a route."""
    return lambda route: site.formation.front[_run(route)]


def _run(route: Route) -> Run:
    """A run of the first train on a route, no particular one."""
    return Run(Serial(0), T1, UnitLife(0), route)


def boundaries(blocks: Sequence[Block]) -> Sequence[tuple[Block, Block]]:
    """Each two neighbouring blocks."""
    return list(pairwise(blocks))


LINES: Mapping[str, str] = {"a_ring": RING, "a_figure_of_eight": EIGHT}
"""The stations that each attack is played on, by their names in those of the witnesses."""


@cache
def line_on(name: str) -> Line:
    """One of these stations."""
    return line_of(name, site_of(LINES[name]))
