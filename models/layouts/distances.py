"""Running distances inside a block, between the tags at its ends (T1)."""

from __future__ import annotations

import heapq
from collections.abc import Callable

from kernel.names import Block, Tag
from models.layouts.blocks import Blocks, opposite
from models.layouts.track import Cut, Heading, Joint


def next_tag_mm(blocks: Blocks, name: Callable[[str, Block], Tag]) -> dict[Tag, int]:
    """For each tag, the running distance in mm to the nearest other tag of its block, or 0 if it has none."""
    found: dict[Tag, int] = {}
    for block, ends in blocks.ends.items():
        for heading in ends:
            end = blocks.segments.at[heading]
            if isinstance(end, Cut):
                found[name(end.mark, block)] = _nearest_mm(blocks, opposite(heading))
    return found


def _nearest_mm(blocks: Blocks, start: Heading) -> int:
    """The distance in mm from one end of a block to the nearest detector a movement comes to."""
    segments = blocks.segments
    reached: set[Heading] = set()
    todo = [(0, start)]
    while todo:
        so_far_mm, heading = heapq.heappop(todo)
        if heading in reached:
            continue
        reached.add(heading)
        segment = segments.segments[heading[0]]
        end_mm = so_far_mm + segment.to_mm - segment.from_mm
        end = segments.at[heading]
        if isinstance(end, Cut):
            return end_mm
        if isinstance(end, Joint):
            for _, _, onward in segments.onward(end):
                heapq.heappush(todo, (end_mm, onward))
    return 0
