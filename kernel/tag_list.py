"""What a unit works with: the lists that the first loop has carried to it, and its own plan of tags (T2, T4).

The centre's layout never is on board.  A list is opaque to the machines: two of them are equal or not, and what
one says is looked up here.  So a unit can use nothing of a route that the centre has not compared.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

from kernel.maps import Map
from kernel.names import Block, Point, Position, Tag, TagList


@dataclass(frozen=True)
class TagLists:
    """What lists say; each field as in :class:`kernel.layout.Layout`, by list and not by route (T4)."""

    start: Mapping[TagList, Block]
    covers: Mapping[TagList, frozenset[Block]]
    overlap: Mapping[TagList, frozenset[Block]]
    claims: Mapping[TagList, frozenset[Block]]
    way: Mapping[TagList, Mapping[Block, Block]]
    needs: Mapping[TagList, Mapping[Point, Position]]
    released_after: Mapping[TagList, Mapping[Block, Block]]
    first_tag: Mapping[TagList, Tag]
    tag_after: Mapping[TagList, Mapping[Tag, Tag]]


@dataclass(frozen=True)
class TagPlan:
    """Where the line's tags lie, as a unit has it for itself; of no route in particular (T1, T2).

    ``tag_in``, ``partner``: the block a tag is planned in; the other tag of its boundary.
    ``stands_in``: the block that a point stands in.
    """

    tag_in: Mapping[Tag, Block]
    partner: Mapping[Tag, Tag]
    stands_in: Mapping[Point, Block]


NO_POINTS: Map[Point, Position] = {}
"""What a list needs of which nothing is known."""
NO_WAY: Map[Block, Block] = {}
"""The way of a list of which nothing is known."""
NO_TAGS: Map[Tag, Tag] = {}
"""The order of the tags of a list of which nothing is known."""
NO_PARTS: Map[Block, Block] = {}
"""Where nothing is known of it every block is released alone."""
