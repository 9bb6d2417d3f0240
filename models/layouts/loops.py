"""Loops: how long a train must be to come back into a block that it has not left, over points as they lie (T2, ours).

What a train holds bars none of its own routes.  One that is as long as a ring, or as the lobe of a figure of eight,
may be let run into its own tail; a point that it would need in another position, and stands upon, is locked and bars
it.  No file knows its trains, so whoever admits them is told the length.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from heapq import heapify, heappop, heappush
from itertools import count, islice

from kernel.names import Block, Point, Position
from models.layouts.blocks import Blocks, opposite
from models.layouts.findings import Findings
from models.layouts.measures import SHORTEST_TRAIN_MM
from models.layouts.results import Loop
from models.layouts.track import Cut, Heading, Joint

Lies = frozenset[tuple[Point, Position]]
"""Points passed, and how they lay: one that is passed again lies the same."""
LOOKS, LOOKS_A_BLOCK = 20_000, 2
"""So many stretches are looked at in all, and for each block: time grows with the size of the layout alone."""
MOST_TRACKS = 1_000
"""So many tracks from one end of a block are looked at; of a block with more it is taken that no point bars."""
SHORTEST = "the longest train is a train"
LOOPS = "a train is shorter than its loop"


def shortest_loop(blocks: Blocks) -> Loop | None:
    """The shortest way out of a block and back into it that no point bars; none where track has no such way.

    Every block's ways are followed at once, nearest first, so that the first way back is the shortest.
    """
    segments, turn = blocks.segments, count()
    todo = [(0, next(turn), block, out, out, Lies()) for block, ends in blocks.ends.items() for out in ends]
    heapify(todo)
    known: dict[tuple[Block, Heading, Heading], list[Lies]] = {}
    left, found_mm, found = LOOKS + LOOKS_A_BLOCK * len(blocks.pieces), 0, set[Block]()
    while todo and not (found and todo[0][0] > found_mm):
        so_far_mm, _, block, out, heading, lies = heappop(todo)
        before = known.setdefault((block, out, heading), [])
        if any(fewer <= lies for fewer in before):
            continue
        if left <= 0 and not found:
            return Loop(so_far_mm, ())
        left -= 1
        before.append(lies)
        end, onward = segments.at[heading], list[tuple[Heading, Lies]]()
        if isinstance(end, Joint):
            onward += _over(blocks, end, lies)
        elif isinstance(end, Cut) and blocks.of[end.beyond[0]] == block != blocks.of[heading[0]]:
            if _is_open(blocks, out, end.beyond):
                found_mm = so_far_mm
                found.add(block)
        elif isinstance(end, Cut) and blocks.of[end.beyond[0]] != blocks.of[heading[0]]:
            onward.append((end.beyond, lies))
        for ahead, lie in onward:
            long_mm = segments.segments[ahead[0]].to_mm - segments.segments[ahead[0]].from_mm
            heappush(todo, (so_far_mm + long_mm, next(turn), block, out, ahead, lie))
    return Loop(found_mm, tuple(sorted(found))) if found else None


def _over(blocks: Blocks, joint: Joint, lies: Lies) -> Iterator[tuple[Heading, Lies]]:
    """The ways on over a junction, as it lay where it was passed before."""
    is_point, point = blocks.segments.station.junctions[joint.junction].is_point, Point(joint.junction)
    lay = dict(lies).get(point)
    for _, positions, onward in blocks.segments.onward(joint):
        if not is_point:
            yield onward, lies
        for position in map(Position, positions if is_point else ()):
            if lay is None or lay == position:
                yield onward, lies | {(point, position)}


def _is_open(blocks: Blocks, out: Heading, entered: Heading) -> bool:
    """Whether the points of a block can lie so that a train has left it there, and comes in here."""
    left = list(islice(_through(blocks, opposite(out)), MOST_TRACKS))
    into = list(islice(_through(blocks, entered), MOST_TRACKS))
    if MOST_TRACKS in (len(left), len(into)):
        return True
    return any(len(one | other) == len(dict(one | other)) for one in left for other in into)


def _through(blocks: Blocks, start: Heading) -> Iterator[Lies]:
    """How the points of a block may lie for each track from one of its ends to another."""
    todo = [(start, Lies())]
    while todo:
        heading, lay = todo.pop()
        end = blocks.segments.at[heading]
        if isinstance(end, Joint):
            todo += _over(blocks, end, lay)
        else:
            yield lay


def say_what_is_too_long(
    loop: Loop | None, longest_train_mm: int | None, bounds: Mapping[Block, tuple[str, ...]], findings: Findings
) -> None:
    """A fleet whose longest train, as the file tells it, is as long as a loop; or is shorter than any train."""
    if longest_train_mm is not None and longest_train_mm < SHORTEST_TRAIN_MM:
        text = f"the longest train is told to have {longest_train_mm:,} mm: no train is so short, is the unit right?"
        findings.violation(SHORTEST, (), text)
    if loop is None or longest_train_mm is None or longest_train_mm < loop.long_mm:
        return
    of = f"block '{loop.blocks[0]}' and back into it is" if loop.blocks else "a block and back is looked for up to"
    text = f"the longest train has {longest_train_mm:,} mm, and the way out of {of} {loop.long_mm:,} mm long"
    findings.violation(LOOPS, bounds[loop.blocks[0]] if loop.blocks else (), f"{text}: it may come upon its own tail")
