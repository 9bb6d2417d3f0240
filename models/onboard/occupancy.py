"""Where blocks are millimetres of rail: trains that the interlocking keeps apart do not touch (T1, T4, T9).

The interlocking's proof is of cars and blocks.  Here every millimetre of rail lies in a block, and a train covers some
of them; what the interlocking's theorems say of blocks is asked of every movement.  A head that stands exactly at the
end of a block is still in that block, as in :mod:`models.onboard.joint`.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import NewType

from kernel.maps import Map
from kernel.names import Block, Car, Point, Train
from kernel.terminal import Terminal
from models.world.state import Site
from models.world.truth import (
    no_block_holds_two_trains,
    no_fouling_blocks_hold_two_trains,
    no_point_under_a_car_is_unlocked,
)

Place = NewType("Place", str)
"""One millimetre of rail, named over the whole line."""


@dataclass(frozen=True)
class Rails:
    """What does not change: the site of the interlocking, and where things lie (T1).

    ``lies_in``: for each millimetre of rail the block that it lies in.
    ``point_at``: for each point the millimetres of its blades and crossing.
    """

    site: Site
    lies_in: Map[Place, Block]
    point_at: Map[Point, frozenset[Place]]


@dataclass(frozen=True)
class Occupied:
    """One moment.

    ``at``, ``terminals``: the blocks that each car is in, and what each point's terminal knows, as the interlocking's
    world has them.
    ``covers``: the millimetres of rail that each train stands on or over, from its rear to its head.
    """

    at: Map[Car, frozenset[Block]]
    terminals: Map[Point, Terminal]
    covers: Map[Train, frozenset[Place]]


# ---- premises


def a_point_stands_in_the_blocks_that_list_it(site: Rails) -> bool:
    """Blades and crossing of a point lie in blocks that have the point in them (T10)."""
    return all(
        place in site.lies_in and point in site.site.layout.points_in.get(site.lies_in[place], frozenset())
        for point in site.point_at
        for place in site.point_at[point]
    )


# ---- assumptions


def a_train_is_in_the_blocks_that_it_covers(
    site: Rails, at: Map[Car, frozenset[Block]], covers: Map[Train, frozenset[Place]]
) -> bool:
    """Over each millimetre that a train covers there is a car of it, which is in the block that this lies in (T1)."""
    return all(
        place in site.lies_in
        and any(site.site.formation.train_of.get(car) == train and site.lies_in[place] in at[car] for car in at)
        for train in covers
        for place in covers[train]
    )


def no_block_is_under_two_trains(site: Rails, at: Map[Car, frozenset[Block]]) -> bool:
    """The interlocking's theorem, `no_two_trains_in_a_block` (T4, T9)."""
    return no_block_holds_two_trains(site.site, at)


def no_fouling_blocks_are_under_two_trains(site: Rails, at: Map[Car, frozenset[Block]]) -> bool:
    """The interlocking's theorem, `no_two_trains_in_fouling_blocks` (T9)."""
    return no_fouling_blocks_hold_two_trains(site.site, at)


def no_point_is_unlocked_under_a_train(
    site: Rails, at: Map[Car, frozenset[Block]], terminals: Map[Point, Terminal]
) -> bool:
    """The interlocking's theorem, `no_point_moves_under_a_train` (T10)."""
    return no_point_under_a_car_is_unlocked(site.site, at, terminals)


# ---- transitions


def trains_move(
    site: Rails,
    system: Occupied,
    at: Map[Car, frozenset[Block]],
    terminals: Map[Point, Terminal],
    covers: Map[Train, frozenset[Place]],
) -> Occupied:
    """Trains run, stand and part, points are thrown and locked, as the interlocking's world lets them (T9, T10)."""
    if not a_train_is_in_the_blocks_that_it_covers(site, at, covers):
        return system
    if not no_block_is_under_two_trains(site, at):
        return system
    if not no_fouling_blocks_are_under_two_trains(site, at):
        return system
    if not no_point_is_unlocked_under_a_train(site, at, terminals):
        return system
    return Occupied(at=at, terminals=terminals, covers=covers)
