"""Loops: how long a train must be to come back to where it has not left, over points as they lie (T2, ours).

It comes back into a block, or into one that fouls it, or over a junction within the block that it stands on.

What a train holds bars its own routes beyond their start alone.  One that is as long as the lobe of a figure of eight
before the flat crossing that its route starts at, or as a loop within one block, may be let run into its own tail; a
point that it would need in another position, and stands upon, is locked and bars it.  No file knows its trains, so
whoever admits them is told the length.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from heapq import heapify, heappop, heappush
from itertools import count, islice

from kernel.names import Block, Point, Position
from models.layouts.blocks import Blocks, opposite
from models.layouts.findings import Findings
from models.layouts.measures import CLEARANCE_MM, SHORTEST_TRAIN_MM
from models.layouts.results import Loop
from models.layouts.told import Told
from models.layouts.track import Cut, Heading, Joint, Junction

Lies = frozenset[tuple[Point, Position]]
"""Points passed, and how they lay: one that is passed again lies the same."""
LOOKS, LOOKS_A_BLOCK = 20_000, 2
"""So many stretches are looked at in all, and for each block: time grows with the size of the layout alone."""
MOST_TRACKS = 1_000
"""So many tracks from one end of a block are looked at; of a block with more it is taken that no point bars."""
SHORTEST = "the longest train is a train"
LOOPS = "a train is shorter than its loop"


def shortest_loop(blocks: Blocks, told: Told) -> Loop | None:
    """The shortest way on which a train comes back to its own rear that no point bars; none where track has no such.

    It leads out of a block and back into it, or into one that it fouls, or over a junction twice within one block.
    """
    loops = (_out_and_back(blocks, told.fouls), _over_itself(blocks, told.clear_mm))
    found = [loop for loop in loops if loop is not None]
    long_mm = min((loop.long_mm for loop in found), default=0)
    shortest = [loop for loop in found if loop.long_mm == long_mm]
    names = {block for loop in shortest for block in loop.blocks}
    legs = {leg for loop in shortest for leg in loop.not_told}
    return Loop(long_mm, tuple(sorted(names)), tuple(sorted(legs))) if found else None


def _out_and_back(blocks: Blocks, fouls: Mapping[Block, frozenset[Block]]) -> Loop | None:
    """The shortest way out of a block and back into it, or into one that it fouls.

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
        elif isinstance(end, Cut) and _comes_foul(blocks, fouls.get(block, frozenset()) | {block}, heading, end, lies):
            found_mm = so_far_mm
            found.add(block)
        elif isinstance(end, Cut) and blocks.of[end.beyond[0]] != blocks.of[heading[0]]:
            onward.append((end.beyond, lies))
        for ahead, lie in onward:
            heappush(todo, (so_far_mm + _long_mm(blocks, ahead), next(turn), block, out, ahead, lie))
    return Loop(found_mm, tuple(sorted(found))) if found else None


def _comes_foul(blocks: Blocks, closed: frozenset[Block], heading: Heading, end: Cut, lies: Lies) -> bool:
    """Whether a train that runs to a boundary comes foul of its own rear behind it, from a block not foul of it.

    From one that is it comes in line: a point's block fouls those behind boundaries that lie near on its legs.
    """
    if blocks.of[heading[0]] in closed or blocks.of[end.beyond[0]] not in closed:
        return False
    ways = list(islice(_through(blocks, end.beyond), MOST_TRACKS))
    return len(ways) == MOST_TRACKS or any(len(way | lies) == len(dict(way | lies)) for way in ways)


def _over_itself(blocks: Blocks, clear_mm: Mapping[tuple[str, str], int]) -> Loop | None:
    """The shortest way from a junction back to it within one block, from where its legs are clear of each other.

    Between legs that a position joins, as round a ring, it is as long as it is from the junction to the junction.
    """
    turn = count()
    todo = [
        (_long_mm(blocks, ahead), next(turn), junction, port, ahead, lies)
        for junction in blocks.segments.station.junctions.values()
        if len(junction.ports) > 2
        for port, end in junction.ports.items()
        for ahead in [blocks.segments.leaving[end]]
        for lies in _leaving(junction, port)
    ]
    heapify(todo)
    known: dict[tuple[str, str, Heading], list[Lies]] = {}
    left, found = LOOKS + LOOKS_A_BLOCK * len(blocks.pieces), dict[Block, int]()
    not_told: dict[tuple[Block, int], set[tuple[str, str]]] = {}
    less_mm = 2 * max([CLEARANCE_MM, *clear_mm.values()])
    while todo and not (found and todo[0][0] > min(found.values()) + less_mm):
        so_far_mm, _, junction, port, heading, lies = heappop(todo)
        before = known.setdefault((junction.name, port, heading), [])
        if any(fewer <= lies for fewer in before):
            continue
        if left <= 0 and not found:
            return Loop(max(so_far_mm - less_mm, 0), ())
        left -= 1
        before.append(lies)
        end = blocks.segments.at[heading]
        onward = list(_over(blocks, end, lies)) if isinstance(end, Joint) else []
        if isinstance(end, Joint) and end.junction == junction.name:
            legs = () if junction.kind.joined(port, end.port) else (port, end.port)
            long_mm = so_far_mm - sum(clear_mm.get((junction.name, leg), CLEARANCE_MM) for leg in legs)
            block = blocks.of[heading[0]]
            if onward:
                found[block] = min(found.get(block, so_far_mm), max(long_mm, 0))
                untold = {(junction.name, leg) for leg in legs} - clear_mm.keys()
                not_told.setdefault((block, max(long_mm, 0)), set()).update(untold)
            continue
        for ahead, lie in onward:
            heappush(todo, (so_far_mm + _long_mm(blocks, ahead), next(turn), junction, port, ahead, lie))
    least_mm = min(found.values(), default=0)
    least = tuple(block for block in found if found[block] == least_mm)
    legs_not_told = {leg for block in least for leg in not_told[block, least_mm]}
    return Loop(least_mm, least, tuple(sorted(legs_not_told))) if found else None


def _leaving(junction: Junction, port: str) -> list[Lies]:
    """How a junction may lie under a train that has left it by a port."""
    if not junction.is_point:
        return [Lies()]
    positions = {position for ways in junction.kind.ways(port).values() for position in ways}
    return [Lies({(Point(junction.name), Position(position))}) for position in sorted(positions)]


def _long_mm(blocks: Blocks, heading: Heading) -> int:
    return blocks.segments.segments[heading[0]].long_mm


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
    of = f"from block '{loop.blocks[0]}' back to it, or foul of it, is" if loop.blocks else "back is looked for up to"
    text = f"the longest train has {longest_train_mm:,} mm, and the way {of} {loop.long_mm:,} mm long"
    findings.violation(LOOPS, bounds[loop.blocks[0]] if loop.blocks else (), f"{text}: it may come upon its own tail")
