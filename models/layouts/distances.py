"""Running distances inside a block, between the tags at its ends (T1)."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from heapq import heappop, heappush

from kernel.names import Block, Tag
from models.layouts.blocks import Blocks, opposite
from models.layouts.track import Cut, Heading, Joint


@dataclass(frozen=True)
class Onward:
    """From one end of a block into it: ``next_mm`` to the next tag, 0 if there is none or there are several (T1).

    ``nearest_mm``: the shortest way to any detector or end of track; ``to_detector``: whether it is a detector.
    """

    next_mm: int
    nearest_mm: int
    to_detector: bool


def ways_in(blocks: Blocks, name: Callable[[str, Block], Tag]) -> dict[Tag, Onward]:
    """For each tag, the way on into its block."""
    found: dict[Tag, Onward] = {}
    for block, ends in blocks.ends.items():
        for heading in ends:
            end = blocks.segments.at[heading]
            if isinstance(end, Cut):
                found[name(end.mark, block)] = _onward(blocks, opposite(heading))
    return found


def next_tag_mm(ways: Mapping[Tag, Onward]) -> dict[Tag, int]:
    """For each tag, the running distance in mm to the next tag of its block, or 0 if it has none or several (T1)."""
    return {tag: way.next_mm for tag, way in ways.items()}


def _onward(blocks: Blocks, start: Heading) -> Onward:
    """The way in from one end of a block; ways that come together again count as several."""
    segments = blocks.segments
    reached: set[Heading] = set()
    nearest: tuple[int, bool] | None = None
    detectors_mm: list[int] = []
    meets = False
    todo = [(0, start)]
    while todo and (nearest is None or not (meets or len(detectors_mm) > 1)):
        so_far_mm, heading = heappop(todo)
        if heading in reached:
            meets = True
            continue
        reached.add(heading)
        segment = segments.segments[heading[0]]
        end_mm = so_far_mm + segment.to_mm - segment.from_mm
        end = segments.at[heading]
        if isinstance(end, Joint):
            for _, _, onward in segments.onward(end):
                heappush(todo, (end_mm, onward))
            continue
        detects = isinstance(end, Cut)
        nearest = min(nearest or (end_mm, detects), (end_mm, detects))
        detectors_mm += [end_mm] if detects else []
    nearest_mm, to_detector = nearest or (0, False)
    return Onward(detectors_mm[0] if len(detectors_mm) == 1 and not meets else 0, nearest_mm, to_detector)
