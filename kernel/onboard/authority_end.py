"""Where the authority ends, in mm: the joint between blocks and the brake (T4, T9, T12).

The authority is made of blocks, and the brake of millimetres.  The end of a block is on the list that the
unit was given, as a distance from tag to tag (T1).  There is one end for the train, whatever number of runs
it has been given: the nearest end, ahead of it, of a block that no order lets the head leave.  Where
the head may be outside of what one order covers there is none, and the train brakes.  The overlap is kept free
beyond the end, and never counted in.
"""

from __future__ import annotations

from kernel.authority import may_leave, may_proceed
from kernel.maps import Map
from kernel.names import Block, Run
from kernel.onboard import braking
from kernel.onboard.arithmetic import smaller
from kernel.onboard.braking import Brake, BrakeBounds
from kernel.onboard.odometry import Motion, is_located
from kernel.tag_list import TagLists
from kernel.unit import Unit


def is_open(lists: TagLists, unit: Unit, block_ends_mm: Map[Run, Map[Block, int]], block: Block, end_mm: int) -> bool:
    """Tell whether some order lets the head run on out of ``block`` where that ends at ``end_mm`` (T4).

    On a loop one block may lie ahead twice, and an order for the first time is none for the second.
    """
    return any(block_ends_mm[run].get(block) == end_mm and may_leave(lists, unit, run, block) for run in block_ends_mm)


def covers_the_head(begins_mm: int, block_ends_mm: Map[Block, int], front_least_mm: int, to_mm: int) -> bool:
    """Tell whether a list covers the track from before the front up to ``to_mm``, so that no block is missed (T4)."""
    return begins_mm <= front_least_mm and any(to_mm <= end_mm for _, end_mm in block_ends_mm.items())


def ends_mm(
    lists: TagLists,
    unit: Unit,
    begins_mm: Map[Run, int],
    block_ends_mm: Map[Run, Map[Block, int]],
    front_least_mm: int,
    front_most_mm: int,
) -> frozenset[int]:
    """Give the end of the train's authority: one number, or none where its head may be on track of no order (T12).

    ``begins_mm``: for each run where the block that it starts in begins.  ``block_ends_mm``: for each run
    where its blocks end for a head that runs through them, as listed, all on one kilometrage of the train.
    ``front_least_mm``, ``front_most_mm``: its front is between them, on that kilometrage (P7): what a list may be
    wrong by widens this range, and shortens no end, or a block would count as passed that the head is still in.
    """
    return frozenset(
        end_mm
        for run in block_ends_mm
        for block, end_mm in block_ends_mm[run].items()
        if end_mm >= front_least_mm
        and not is_open(lists, unit, block_ends_mm, block, end_mm)
        and all(
            end_mm <= other_mm or other_mm < front_least_mm or is_open(lists, unit, block_ends_mm, beside, other_mm)
            for other in block_ends_mm
            for beside, other_mm in block_ends_mm[other].items()
        )
        and any(
            covers_the_head(begins_mm[over], block_ends_mm[over], front_least_mm, smaller(front_most_mm, end_mm))
            for over in begins_mm
            if over in block_ends_mm
        )
    )


def is_stopped(unit: Unit, block_ends_mm: Map[Run, Map[Block, int]]) -> bool:
    """Tell whether the train is to stand: none of the runs that the unit has lists of lets it move (T4, T5).

    A host gives the lists of the runs that the leading cab leads: a run back would count here like any other.
    """
    return not any(may_proceed(unit, run) for run in block_ends_mm)


def obey(
    lists: TagLists,
    unit: Unit,
    begins_mm: Map[Run, int],
    block_ends_mm: Map[Run, Map[Block, int]],
    bounds: BrakeBounds,
    brake: Brake,
    motion: Motion,
) -> frozenset[Brake]:
    """Give what the brake becomes by all that the unit knows: one state, asked for in every cycle (T4, T9, T12).

    ``motion``: the odometry's.  While that claims no range nobody knows whether the train can still stop before a
    nearer end: none is taken, and so no run is given back by it.
    """
    if not is_located(motion):
        return frozenset({braking.withhold_end(brake)})
    wanted_mm = ends_mm(lists, unit, begins_mm, block_ends_mm, motion.front_least_mm, motion.front_most_mm)
    if not any(True for _ in wanted_mm):
        return frozenset({braking.withhold_end(brake)})
    taken = frozenset(
        braking.take_end(bounds, brake, motion.front_most_mm, motion.speed_most_mm_s, end_mm) for end_mm in wanted_mm
    )
    if is_stopped(unit, block_ends_mm):
        return frozenset(braking.withhold_end(each) for each in taken)
    return taken
