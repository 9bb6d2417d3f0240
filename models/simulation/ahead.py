"""What a route's list says of the track around a train: where blocks end, and where its tags lie (T1, T4).

All of it on the train's own kilometrage, which is its path on the rails.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Set
from dataclasses import dataclass

from kernel.layout import Layout
from kernel.maps import Map
from kernel.names import Block, Point, Position, Run, Tag
from models.concrete.rails import Piece, Rails
from models.concrete.train import OnRails
from models.layouts.track import Heading, Stop


@dataclass(frozen=True)
class Ahead:
    """The list of one run: where each block ends for a head that runs through it, where each tag lies, and its kind.

    ``begins_mm``: where the first of these blocks begins, or the train's path as far as it is remembered.
    ``arrives``: the last segment, and the end of it that the train then faces.
    """

    begins_mm: int
    ends_mm: Map[Block, int]
    tags_mm: Mapping[Tag, int]
    kinds: Mapping[Tag, int]
    arrives: Heading

    def bounds_mm(self, block: Block) -> tuple[int, int] | None:
        """Where a block of the list begins, which is where the one before it ends, and where it ends itself."""
        if block not in self.ends_mm:
            return None
        end_mm = self.ends_mm[block]
        before = [each for _, each in self.ends_mm.items() if each < end_mm]
        return max(before, default=self.begins_mm), end_mm


def ahead(
    layout: Layout, rails: Rails, train: OnRails, run: Run, lies: Map[Point, Position], kinds: Mapping[Tag, int]
) -> Ahead:
    """Survey a run whose points lie right, from where the train came into it, or from its front's block on.

    ``kinds``: what is written in each tag of the line.
    """
    wanted, destination = layout.claims[run.route], layout.destination[run.route]
    ends_mm: dict[Block, int] = {}
    tags_mm: dict[Tag, int] = {}
    begins_mm, arrives = train.front_mm, train.path[-1].heading
    for piece in _pieces(rails, train, wanted, lies):
        begins_mm, arrives = min(begins_mm, piece.from_mm), piece.heading
        block = rails.block[piece.heading[0]]
        out = rails.boundary(piece.heading) or isinstance(rails.segments.at[piece.heading], Stop)
        if block in wanted:
            tags_mm |= {tag: place for place, tag in rails.tags(piece)}
            if out:
                ends_mm[block] = piece.to_mm
        if out and block == destination:
            break
    return Ahead(begins_mm, ends_mm, tags_mm, {tag: kinds[tag] for tag in tags_mm}, arrives)


def block_begins_mm(rails: Rails, train: OnRails) -> int:
    """Where the block that the front is in begins on the train's path, or the path as far as it is remembered."""
    at = next(place for place, each in enumerate(train.path) if each.to_mm > train.front_mm)
    block = rails.block[train.path[at].heading[0]]
    while at > 0 and rails.block[train.path[at - 1].heading[0]] == block:
        at -= 1
    return train.path[at].from_mm


def _pieces(rails: Rails, train: OnRails, wanted: Set[Block], lies: Map[Point, Position]) -> Iterator[Piece]:
    """Track from where the train came into these blocks, or from its front, as far as it goes on."""
    front = next(place for place, each in enumerate(train.path) if each.to_mm > train.front_mm)
    first = front
    while first > 0 and rails.block[train.path[first - 1].heading[0]] in wanted:
        first -= 1
    yield from train.path[first:front]
    piece: Piece | None = train.path[front]
    while piece is not None:
        yield piece
        onward = rails.onward(piece.heading, lies)
        piece = None if onward is None else Piece(onward, piece.to_mm, piece.to_mm + rails.length_mm(onward))


def follows_the_way(layout: Layout, run: Run, ends_mm: Map[Block, int]) -> bool:
    """Whether a survey has the run's blocks in their order, from its start: not so of a train that faces back."""
    way, overlap = layout.way[run.route], layout.overlap[run.route]
    return layout.start[run.route] in ends_mm and all(
        block not in way or way[block] in overlap or (way[block] in ends_mm and end_mm < ends_mm[way[block]])
        for block, end_mm in ends_mm.items()
    )
