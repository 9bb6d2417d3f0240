"""What is written in the tags (T1): block numbers of 8 bits, distances in mm, and the kind of block."""

from __future__ import annotations

from collections.abc import Iterable, Mapping

from kernel.layout import TagRecords
from kernel.names import Block, Record, Tag
from kernel.tags import Kind

PLAIN, TURNOUT = "plain", "turnout"
LARGEST_BLOCK_NUMBER = 255
LONGEST_DISTANCE_MM = 2**28 - 1
"""The most that a tag's 28 bits can say."""


def number_blocks(blocks: Iterable[Block], together: Iterable[Iterable[Block]]) -> dict[Block, int]:
    """Numbers from 0, distinct within each of the groups ``together`` (a route's blocks, neighbours).

    A network has more blocks than 8 bits can tell apart: a number repeats where no group sees both.
    """
    groups_of: dict[Block, list[frozenset[Block]]] = {block: [] for block in blocks}
    for group in {frozenset(group) for group in together}:
        for block in group:
            groups_of[block].append(group)
    numbers: dict[Block, int] = {}
    for block in sorted(groups_of):
        taken = {numbers[other] for group in groups_of[block] for other in group if other in numbers}
        numbers[block] = next(number for number in range(len(numbers) + 1) if number not in taken)
    return numbers


def records_for(
    tag_in: Mapping[Tag, Block],
    numbers: Mapping[Block, int],
    distance_mm: Mapping[Tag, int],
    turnouts: frozenset[Block],
) -> TagRecords:
    """A record for each tag: kind, block number, distance in mm to the next tag of the same block."""
    return TagRecords(
        {
            tag: Record(f"{TURNOUT if block in turnouts else PLAIN}:{numbers[block]}:{distance_mm.get(tag, 0)}")
            for tag, block in tag_in.items()
        }
    )


def fields_of(record: Record) -> tuple[int, int, int]:
    """The kind's code, the block's number and the distance in mm that a record stands for (T1)."""
    word, number, distance_mm = record.split(":")
    return (Kind.TURNOUT if word == TURNOUT else Kind.PLAIN).value, int(number), int(distance_mm)
