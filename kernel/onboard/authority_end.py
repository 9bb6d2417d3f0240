"""Where the authority ends, in mm: the joint between blocks and the brake (T4, T9, T12).

The authority is made of blocks, and the brake of millimetres.  The end of a block is on the list that the
unit was given, as a distance from tag to tag (T1); the end of authority is the nearest end, ahead of the
train, of a block that the head may not leave.  The overlap is kept free beyond it, and never counted in.
"""

from __future__ import annotations

from collections.abc import Mapping

from kernel.authority import may_leave
from kernel.layout import Layout
from kernel.names import Block, Run
from kernel.unit import Unit


def may_be_left(layout: Layout, unit: Unit, run: Run, block: Block) -> bool:
    """Tell whether the head may run on out of ``block``, into a block that is not overlap (T4, T9)."""
    target = layout.way[run.route].get(block) if run.route in layout.way else None
    return target is not None and target not in layout.overlap[run.route] and may_leave(layout, unit, run, block)


def ends_mm(
    layout: Layout, unit: Unit, run: Run, block_ends_mm: Mapping[Block, int], front_least_mm: int
) -> frozenset[int]:
    """Give the end of authority: one number, or none where no block of the list ends ahead (T12).

    ``block_ends_mm``: where each block of the route ends for a head that runs through it, less what the
    list may be wrong by.  ``front_least_mm``: the train's front is no less far than this (P7).
    """
    return frozenset(
        end_mm
        for block, end_mm in block_ends_mm.items()
        if end_mm >= front_least_mm
        and not may_be_left(layout, unit, run, block)
        and all(
            end_mm <= other_mm or other_mm < front_least_mm or may_be_left(layout, unit, run, other)
            for other, other_mm in block_ends_mm.items()
        )
    )
