"""The track as it is, beside what the system was told of it.

The kernel never sees a :class:`Ground`.  A layout file is imported into a pair of
:class:`kernel.layout.Layout` and :class:`Ground`; ``models.axioms`` relates the two.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

from kernel.layout import Layout
from kernel.names import Block, Point, Position, Route, Tag


@dataclass(frozen=True)
class Ground:
    """Where track leads, what closes it, and where tags really lie.

    ``leads``: for a route and a block it claims, every block that track leads to from there
    in the running direction of the route, for some position of the points (the block on the
    route's way among them), and how the points that this movement meets facing must lie for it
    (the demands common to all ways from where the route comes in; in its start block from every track that a train may
    stand on with the points there as the route needs them, see ``models.layouts.standing``).
    ``neighbours``: for a block, every block that it shares a boundary with.
    ``opens``: track from the first block to the second is open only if these points lie so
    (points that the movement meets facing; the demands common to all ways from one to the other).
    ``turnout``: for a route, a block on it and a neighbour off its way, the point that the route
    holds so that its train is not led there.
    ``flank_point``: for a route, a neighbour block outside it and a block it covers, the point
    that the route holds so that no vehicle comes from there.
    ``held_by_authority``: block pairs (from, into) with no such point: what stands in the first
    is kept out of the second by its own train's protection alone.
    ``laid_in``: the block that a tag really lies in.
    ``laid_leaves``: for a tag and the tag read after it, as they lie, the blocks that a tail has
    left when its antenna has read both in this order (T2).
    """

    leads: Mapping[Route, Mapping[Block, Mapping[Block, Mapping[Point, Position]]]]
    neighbours: Mapping[Block, frozenset[Block]]
    opens: Mapping[Block, Mapping[Block, Mapping[Point, Position]]]
    turnout: Mapping[Route, Mapping[Block, Mapping[Block, Point]]]
    flank_point: Mapping[Route, Mapping[Block, Mapping[Block, Point]]]
    held_by_authority: Mapping[Block, frozenset[Block]]
    laid_in: Mapping[Tag, Block]
    laid_leaves: Mapping[Tag, Mapping[Tag, frozenset[Block]]]


def turns_away(layout: Layout, ground: Ground, route: Route, block: Block, target: Block) -> bool:
    """Tell whether a route holds a point in ``block`` so that its train is not led into ``target`` (T9)."""
    point = ground.turnout.get(route, {}).get(block, {}).get(target)
    return (
        point is not None
        and point in layout.needs[route]
        and layout.stands_in[point] == block
        and point in ground.leads.get(route, {}).get(block, {}).get(target, {})
        and ground.leads[route][block][target][point] != layout.needs[route][point]
    )


def covers_flank(layout: Layout, ground: Ground, route: Route, block: Block, target: Block) -> bool:
    """Tell whether a route holds a point, as long as ``target``, so that nothing comes there from ``block`` (T9)."""
    point = ground.flank_point.get(route, {}).get(block, {}).get(target)
    return (
        point is not None
        and point in layout.needs[route]
        and layout.released_with[route][point] == target
        and point in ground.opens.get(block, {}).get(target, {})
        and ground.opens[block][target][point] != layout.needs[route][point]
    )
