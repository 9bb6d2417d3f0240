"""Running distances inside a block, between the tags at its ends (T1)."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from heapq import heappop, heappush

from kernel.names import Block, Tag
from models.layouts.blocks import Blocks, opposite
from models.layouts.measures import SHORTEST_BLOCK_MM
from models.layouts.track import Cut, Heading, Joint


@dataclass(frozen=True)
class Onward:
    """From one end of a block into it: ``next_mm`` to the next tag, 0 if there is none or there are several (T1).

    ``detector_mm``, ``stop_mm``: the shortest way to a detector, and to an end of track; none if there is none, or if
    it is longer than matters to the tags of a block.
    """

    next_mm: int
    detector_mm: int | None
    stop_mm: int | None


def ways_in(blocks: Blocks, name: Callable[[str, Block], Tag]) -> dict[Tag, Onward]:
    """For each tag, the way on into its block."""
    found: dict[Tag, Onward] = {}
    for block, ends in blocks.ends.items():
        for heading in ends:
            end = blocks.segments.at[heading]
            if isinstance(end, Cut):
                tag, way = name(end.mark, block), _onward(blocks, opposite(heading))
                found[tag] = _shorter(found[tag], way) if tag in found else way
    return found


def _shorter(one: Onward, other: Onward) -> Onward:
    """Of a boundary that has one block on both sides, whose tags have one name, the shorter of both ways."""
    to_detector = [mm for mm in (one.detector_mm, other.detector_mm) if mm is not None]
    to_stop = [mm for mm in (one.stop_mm, other.stop_mm) if mm is not None]
    return Onward(other.next_mm, min(to_detector, default=None), min(to_stop, default=None))


def next_tag_mm(ways: Mapping[Tag, Onward]) -> dict[Tag, int]:
    """For each tag, the running distance in mm to the next tag of its block, or 0 if it has none or several (T1)."""
    return {tag: way.next_mm for tag, way in ways.items()}


def _onward(blocks: Blocks, start: Heading) -> Onward:
    """The way in from one end of a block, nearest first; ways that come together again count as several."""
    segments = blocks.segments
    reached: set[Heading] = set()
    stop_mm: int | None = None
    detectors_mm: list[int] = []
    meets = False
    todo = [(0, start)]
    while todo and not ((meets or len(detectors_mm) > 1) and todo[0][0] >= SHORTEST_BLOCK_MM):
        so_far_mm, heading = heappop(todo)
        if heading in reached:
            meets = True
            continue
        reached.add(heading)
        end_mm = so_far_mm + segments.segments[heading[0]].long_mm
        end = segments.at[heading]
        if isinstance(end, Joint):
            for _, _, onward in segments.onward(end):
                heappush(todo, (end_mm, onward))
        elif isinstance(end, Cut):
            detectors_mm.append(end_mm)
        else:
            stop_mm = end_mm if stop_mm is None else min(stop_mm, end_mm)
    next_mm = detectors_mm[0] if len(detectors_mm) == 1 and not meets else 0
    return Onward(next_mm, min(detectors_mm, default=None), stop_mm)
