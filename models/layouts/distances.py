"""Running distances inside a block, between the tags at its ends (T1)."""

from __future__ import annotations

from collections.abc import Callable

from kernel.names import Block, Tag
from models.layouts.blocks import Blocks, opposite
from models.layouts.track import Cut, Heading, Joint


def next_tag_mm(blocks: Blocks, name: Callable[[str, Block], Tag]) -> dict[Tag, int]:
    """For each tag, the running distance in mm to the next tag of its block, or 0 if it has none or several (T1)."""
    found: dict[Tag, int] = {}
    for block, ends in blocks.ends.items():
        for heading in ends:
            end = blocks.segments.at[heading]
            if isinstance(end, Cut):
                found[name(end.mark, block)] = _next_mm(blocks, opposite(heading))
    return found


def _next_mm(blocks: Blocks, start: Heading) -> int:
    """The distance in mm from one end of a block to the detector a movement comes to, if there is but one way."""
    segments = blocks.segments
    reached: set[Heading] = set()
    detectors_mm: list[int] = []
    todo = [(0, start)]
    while todo:
        so_far_mm, heading = todo.pop()
        if heading in reached:
            return 0
        reached.add(heading)
        segment = segments.segments[heading[0]]
        end_mm = so_far_mm + segment.to_mm - segment.from_mm
        end = segments.at[heading]
        if isinstance(end, Cut):
            detectors_mm.append(end_mm)
        if isinstance(end, Joint):
            todo += [(end_mm, onward) for _, _, onward in segments.onward(end)]
    return detectors_mm[0] if len(detectors_mm) == 1 else 0
