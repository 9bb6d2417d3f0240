"""What a route's list says of the track ahead of a train: where blocks end, and where its tags lie (T1, T4).

All of it on the train's own kilometrage, which is its path on the rails.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

from kernel.layout import Layout
from kernel.maps import Map
from kernel.names import Block, Point, Position, Run, Tag
from models.concrete.rails import Piece, Rails
from models.concrete.train import OnRails
from models.layouts.track import Heading, Stop


@dataclass(frozen=True)
class Ahead:
    """The list of one run: where each block ends for a head that runs through it, and where each tag lies.

    ``arrives``: the last segment, and the end of it that the train then faces.
    """

    ends_mm: Mapping[Block, int]
    tags_mm: Mapping[Tag, int]
    arrives: Heading


def ahead(layout: Layout, rails: Rails, train: OnRails, run: Run, lies: Map[Point, Position]) -> Ahead:
    """Survey a run whose points lie right, from the block that the train's front is in."""
    wanted, destination = layout.claims[run.route], layout.destination[run.route]
    ends_mm: dict[Block, int] = {}
    tags_mm: dict[Tag, int] = {}
    piece: Piece | None = next(each for each in train.path if each.to_mm > train.front_mm)
    arrives = train.path[-1].heading
    while piece is not None:
        arrives = piece.heading
        block = rails.block[piece.heading[0]]
        out = rails.boundary(piece.heading) or isinstance(rails.segments.at[piece.heading], Stop)
        if block in wanted:
            tags_mm |= {tag: place for place, tag in rails.tags(piece)}
            if out:
                ends_mm[block] = piece.to_mm
        if out and block == destination:
            break
        onward = rails.onward(piece.heading, lies)
        piece = None if onward is None else Piece(onward, piece.to_mm, piece.to_mm + rails.length_mm(onward))
    return Ahead(ends_mm, tags_mm, arrives)
