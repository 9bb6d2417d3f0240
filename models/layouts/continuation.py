"""Routes on from inside other routes, for a train that restarted there (T8, ours).

A unit that restarts inside a run has dropped its authority and holds only the blocks it stands
in.  Where they are covered blocks of a route it goes on from there to the same destination, by
a route of its own: the rest of the one it was on, beginning in the block its front stands in.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable, Mapping, Sequence, Set
from dataclasses import dataclass, replace
from typing import TypeVar

from kernel.layout import Layout
from kernel.names import Block, Point, Position, Route, Tag
from kernel.tag_list_text import with_tag_lists
from models import axioms
from models.ground import Ground

K = TypeVar("K")
V = TypeVar("V")

Leads = Mapping[Block, Mapping[Point, Position]]
"""For a block, where track leads from there, and how points met facing must lie for it."""


def with_continuations(layout: Layout, ground: Ground) -> tuple[Layout, Ground]:
    """The layout with a route on from each block that a route covers before its destination.

    A continuation claims and needs what the rest of its route does.  Of the points in the block
    it begins in it needs those that its route needs, in the same positions: so a train that
    stands there on another leg is refused and not led over points that lie against it.  There is
    none where it would break an axiom: where track leads into the rest of the route from a block
    that the whole route claims, or where trains that came another way would be led elsewhere; nor
    where the block it begins in holds another track that no needed point closes, or shares a second boundary with the
    block that the train came from or the one that it goes on to.
    """
    rests = [rest for route in sorted(layout.routes) for rest in _rests(layout, route)]
    wider, ground_wider = _layout(layout, rests), _ground(layout, ground, rests)
    sound = [
        rest for rest in rests if _holds(wider, ground_wider, rest.name) and _stands_on_its_track(layout, ground, rest)
    ]
    return with_tag_lists(_layout(layout, sound)), _ground(layout, ground, sound)


@dataclass(frozen=True)
class Rest:
    """What is left of a route for a train whose front stands in ``start``, having come from the block ``behind``.

    ``claims``: the blocks behind the start, overlap and all.  ``way``: from the start on.
    ``tags``: those still to be read, in order.
    """

    name: Route
    route: Route
    start: Block
    behind: Block
    claims: frozenset[Block]
    way: Mapping[Block, Block]
    tags: tuple[Tag, ...]


def _rests(layout: Layout, route: Route) -> Iterable[Rest]:
    """What is left of a route from each block it covers but the destination, in running order."""
    way = layout.way[route]
    behind, block = layout.start[route], way.get(layout.start[route])
    while block is not None and block != layout.destination[route]:
        onward = _onward(way, block)
        tags = _tags_from(layout, route, block)
        name = Route(f"{route} from {block}")
        if tags and name not in layout.routes:
            yield Rest(name, route, block, behind, frozenset(onward) - {block}, _only(way, frozenset(onward)), tags)
        behind, block = block, way.get(block)


def _onward(way: Mapping[Block, Block], block: Block) -> list[Block]:
    """A block and all that follow it on a way."""
    found = [block]
    while found[-1] in way:
        found.append(way[found[-1]])
    return found


def _tags_from(layout: Layout, route: Route, block: Block) -> tuple[Tag, ...]:
    """The tags of a route from the one at the end of a block on."""
    found: list[Tag] = []
    tag: Tag | None = layout.first_tag[route]
    after, target = layout.tag_after[route], layout.way[route][block]
    while tag is not None:
        if found or (layout.tag_in[tag] == block and layout.tag_in[layout.partner[tag]] == target):
            found.append(tag)
        tag = after.get(tag)
    return tuple(found)


def _needs(layout: Layout, rest: Rest) -> Mapping[Point, Position]:
    """The points the rest of a route needs: those released with it, and those in the block it begins in."""
    with_block = layout.released_with[rest.route]
    return {
        point: lies
        for point, lies in layout.needs[rest.route].items()
        if with_block[point] in rest.claims or layout.stands_in[point] == rest.start
    }


def _released_after(layout: Layout, rest: Rest) -> Mapping[Block, Block]:
    """The parts as they were; the start is released alone, as every start is."""
    return {**_only(layout.released_after[rest.route], rest.claims), rest.start: rest.start}


def _layout(layout: Layout, rests: Sequence[Rest]) -> Layout:
    """The layout with the rests of its routes as routes of their own."""
    needs = {rest.name: _needs(layout, rest) for rest in rests}
    return replace(
        layout,
        routes=layout.routes | {rest.name for rest in rests},
        start={**layout.start, **{rest.name: rest.start for rest in rests}},
        destination={**layout.destination, **{rest.name: layout.destination[rest.route] for rest in rests}},
        covers={**layout.covers, **{rest.name: rest.claims & layout.covers[rest.route] for rest in rests}},
        overlap={**layout.overlap, **{rest.name: layout.overlap[rest.route] for rest in rests}},
        claims={**layout.claims, **{rest.name: rest.claims | {rest.start} for rest in rests}},
        way={**layout.way, **{rest.name: rest.way for rest in rests}},
        needs={**layout.needs, **needs},
        released_with={
            **layout.released_with,
            **{rest.name: _only(layout.released_with[rest.route], needs[rest.name]) for rest in rests},
        },
        released_after={**layout.released_after, **{rest.name: _released_after(layout, rest) for rest in rests}},
        first_tag={**layout.first_tag, **{rest.name: rest.tags[0] for rest in rests}},
        tag_after={
            **layout.tag_after,
            **{rest.name: _only(layout.tag_after[rest.route], frozenset(rest.tags)) for rest in rests},
        },
    )


def _ground(layout: Layout, ground: Ground, rests: Sequence[Rest]) -> Ground:
    """Where track leads on the rest of each route; out of its start from wherever a route comes in."""
    leads, turnout, flank = dict(ground.leads), dict(ground.turnout), dict(ground.flank_point)
    ways_in = _ways_in(ground)
    for rest in rests:
        out = _out_of(ways_in, rest)
        leads[rest.name] = {**_only(ground.leads[rest.route], frozenset(rest.way)), rest.start: out}
        turnout[rest.name] = {
            **_only(ground.turnout.get(rest.route, {}), frozenset(rest.way)),
            rest.start: _turned(layout, rest, out),
        }
        flank[rest.name] = {
            block: _only(targets, rest.claims) for block, targets in ground.flank_point.get(rest.route, {}).items()
        }
    return replace(ground, leads=leads, turnout=turnout, flank_point=flank)


def _ways_in(ground: Ground) -> Mapping[tuple[Block, Block], list[Leads]]:
    """For a block and a neighbour track leads to, what each route says of track out of that block."""
    found: dict[tuple[Block, Block], list[Leads]] = {}
    for route in sorted(ground.leads):
        for block, targets in ground.leads[route].items():
            for target in targets:
                known = found.setdefault((block, target), [])
                if targets not in known:
                    known.append(targets)
    return found


def _out_of(ways_in: Mapping[tuple[Block, Block], list[Leads]], rest: Rest) -> Leads:
    """Where track leads from the start towards the next block, whichever route the train came in on.

    What the ways demand in common is demanded.
    """
    demands: dict[Block, Mapping[Point, Position]] = {}
    for leads in ways_in[rest.start, rest.way[rest.start]]:
        for target, lies in leads.items():
            common = demands.get(target, lies)
            demands[target] = {point: how for point, how in common.items() if lies.get(point) == how}
    return demands


def _turned(layout: Layout, rest: Rest, leads: Leads) -> Mapping[Block, Point]:
    """For each block the start does not lead on to, a point there that is held so that it turns the train away."""
    needs = layout.needs[rest.route]
    found: dict[Block, Point] = {}
    for target, demands in leads.items():
        turning = [p for p in sorted(demands) if layout.stands_in[p] == rest.start and needs.get(p) != demands[p]]
        if target != rest.way[rest.start] and turning:
            found[target] = turning[0]
    return found


def _holds(layout: Layout, ground: Ground, route: Route) -> bool:
    """Whether the axioms that a shortened route may break hold for it, and the way out of its start is its own."""
    alone = replace(layout, routes=frozenset({route}))
    start, needs = layout.start[route], layout.needs[route]
    lies = ground.leads[route][start][layout.way[route][start]]
    return (
        axioms.track_leads_along_the_way_or_is_turned(alone, ground)
        and axioms.a_flank_is_closed_or_held(alone, ground)
        and all(needs.get(point) == how for point, how in lies.items())
    )


def _stands_on_its_track(layout: Layout, ground: Ground, rest: Rest) -> bool:
    """Whether what is left of a route closes every way out of its start, but its own and the one it came by.

    Another track of that block would lead elsewhere a train that stands upon it (``models.layouts.standing``).  One
    that joins the same two blocks shares a boundary more with one of them, and no relation tells its points from those
    of the route's own.
    """
    needs, own = _needs(layout, rest), Counter((rest.behind, rest.way[rest.start]))
    boundaries = Counter(layout.tag_in[layout.partner[tag]] for tag in _tags_in(layout, rest.start))
    return all(boundaries[block] <= own[block] for block in own) and all(
        any(needs.get(point, at) != at for point, at in lies.items())
        for target, lies in ground.opens.get(rest.start, {}).items()
        if target not in (rest.behind, rest.way[rest.start])
    )


def _tags_in(layout: Layout, block: Block) -> Iterable[Tag]:
    return (tag for tag, lies_in in layout.tag_in.items() if lies_in == block)


def _only(whole: Mapping[K, V], keys: Set[K] | Mapping[K, object]) -> dict[K, V]:
    """The entries of a map with these keys."""
    return {key: value for key, value in whole.items() if key in keys}
