"""What the centre, the units and the terminals know of a layout.

Every field is a finite relation.  The kernel looks things up in it and nowhere else;
``models.axioms`` says what a layout must satisfy for the proof to speak of it.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

from kernel.names import Block, Point, Position, Record, Route, Serial, Tag, TagList, Train


@dataclass(frozen=True)
class Layout:
    """Blocks, routes, points and the plan of tags, as the system was told (T1, T4, T7, T9).

    ``fleet``: every train that may be on the line.
    ``start``: the block a route begins in; the train stands there, or will.
    ``destination``: the last block a route covers.
    ``covers``: the blocks from behind the start to the destination, both directions alike.
    ``overlap``: blocks beyond the destination kept free while the train may still slip (過走余裕).
    ``claims``: start, covers and overlap together.
    ``way``: for each claimed block the one that follows on the route; none for the last.
    ``needs``: the points a route needs and how they must lie: in its path, in its overlap,
    in its start block ahead of the train, and for flank protection.
    ``released_with``: the claimed block that a needed point is released with.
    ``released_after``: a block is reported only once the tail has left this one too (T7);
    the block itself where it is released alone.
    ``fouls``: blocks that a train in this block also obstructs.
    ``stands_in``: the block that a point stands in; ``points_in``: the same, by block.
    ``tag_in``, ``partner``: the block a tag is planned in; the other tag of its boundary (T2).
    ``tag_after``: the tag to be read next on a route after this one (T5).
    ``first_tag``: the tag to be read first on a route (T5).
    ``tag_list``: what the first loop carries to the train for a route (T4).
    ``last_serial``: the largest run number that counters and telegrams can hold; it is never
    granted, so that no number wraps (T10).
    """

    fleet: frozenset[Train]
    blocks: frozenset[Block]
    routes: frozenset[Route]
    points: frozenset[Point]
    start: Mapping[Route, Block]
    destination: Mapping[Route, Block]
    covers: Mapping[Route, frozenset[Block]]
    overlap: Mapping[Route, frozenset[Block]]
    claims: Mapping[Route, frozenset[Block]]
    way: Mapping[Route, Mapping[Block, Block]]
    needs: Mapping[Route, Mapping[Point, Position]]
    released_with: Mapping[Route, Mapping[Point, Block]]
    released_after: Mapping[Route, Mapping[Block, Block]]
    fouls: Mapping[Block, frozenset[Block]]
    stands_in: Mapping[Point, Block]
    points_in: Mapping[Block, frozenset[Point]]
    tag_in: Mapping[Tag, Block]
    partner: Mapping[Tag, Tag]
    first_tag: Mapping[Route, Tag]
    tag_after: Mapping[Route, Mapping[Tag, Tag]]
    tag_list: Mapping[Route, TagList]
    last_serial: Serial = Serial(2**63 - 1)


@dataclass(frozen=True)
class TagRecords:
    """What is written in every tag; the centre alone has it, no message carries it out (T6)."""

    record: Mapping[Tag, Record]
