"""Rails as they lie, cut at boundaries into blocks, with a tag on each side of every boundary (T2)."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

from kernel.maps import Map
from kernel.names import Block, Point, Position, Tag
from models.layouts.measures import TAG_MM
from models.layouts.results import Imported
from models.layouts.track import HIGH, Cut, Heading, Joint, Segments, cut_into_segments


@dataclass(frozen=True)
class Piece:
    """A segment of track run through in one direction, as part of a path."""

    heading: Heading
    from_mm: int
    to_mm: int


class Rails:
    """The track of a layout file."""

    def __init__(self, imported: Imported) -> None:
        assert imported.station is not None, "an interlocking table has no track"
        self.segments: Segments = cut_into_segments(imported.station)
        spans = {span: block for block, found in imported.places.spans.items() for span in found}
        self.block = [spans[s.track, s.from_mm, s.to_mm] for s in self.segments.segments]
        self.tag_at: Mapping[tuple[str, Block], Tag] = {
            (imported.places.tags[tag][0], block): tag for tag, block in imported.layout.tag_in.items()
        }

    def length_mm(self, heading: Heading) -> int:
        """The length of a segment."""
        segment = self.segments.segments[heading[0]]
        return segment.to_mm - segment.from_mm

    def onward(self, heading: Heading, lies: Map[Point, Position]) -> Heading | None:
        """Where rails lead at the end of a segment, as the points lie; none at the end of track."""
        end = self.segments.at[heading]
        if isinstance(end, Cut):
            return end.beyond
        if not isinstance(end, Joint):
            return None
        kind = self.segments.station.junctions[end.junction].kind
        fixed = next(iter(kind.positions)) if len(kind.positions) == 1 else None
        position = fixed or lies[Point(end.junction)]
        ways = [heading for _, positions, heading in self.segments.onward(end) if position in positions]
        assert len(ways) <= 1, f"junction '{end.junction}' leads two ways"
        assert ways, f"junction '{end.junction}' is run into from the wrong side: it lies {position}"
        return ways[0]

    def boundary(self, heading: Heading) -> bool:
        """Whether a movement comes into another block at the end of this segment."""
        end = self.segments.at[heading]
        return isinstance(end, Cut) and self.block[end.beyond[0]] != self.block[heading[0]]

    def tags(self, piece: Piece) -> list[tuple[int, Tag]]:
        """The tags on a piece of a path, each with its place along the path."""
        index, end = piece.heading
        found = []
        for side in (end, 1 - end):
            mark = self.segments.at[index, side]
            if isinstance(mark, Cut) and (tag := self.tag_at.get((mark.mark, self.block[index]))) is not None:
                inside = min(TAG_MM, piece.to_mm - piece.from_mm)
                found.append((piece.to_mm - inside if side == end else piece.from_mm + inside, tag))
        return found

    def start_of(self, block: Block) -> Heading:
        """The longest segment of a block, run through towards its track's end."""
        return max(((i, HIGH) for i, other in enumerate(self.block) if other == block), key=self.length_mm)
