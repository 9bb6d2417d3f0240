"""Where in its start block the train of a route stands: the one track that its points tell from the others (T9)."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field

from kernel.names import Block, Point, Position
from models.layouts.blocks import Blocks, opposite, walk
from models.layouts.findings import Findings
from models.layouts.following import Path
from models.layouts.track import Cut, Heading, Joint, Stop, WayOn

SAID = "a route says where its train stands"
APART = "the tracks of a start block are told apart"


@dataclass
class Standing:
    """A track of the start block, from one end of it to the boundary that the route leaves it over.

    ``entries``: the headings that a train comes onto it by; also those of any other track of the block that no needed
    point closes.  ``needs``: its points, so that it alone is open.
    """

    entries: list[Heading]
    needs: dict[Point, Position] = field(default_factory=dict)


def standing(blocks: Blocks, path: Path, named: Mapping[Point, Position], findings: Findings) -> Standing:
    """The track that the train of a route stands on, with a violation where the layout does not tell which it is.

    Every point between where the train may stand and the first boundary is needed: one that it faces leads it there,
    one that it trails lies for the leg that it comes from.  ``named``: positions that the route gives for points of
    the block that are not on its path.
    """
    out = _out(blocks, path)
    if path.from_stop:
        found, rear = Standing([path.entered], dict(path.points.get(path.blocks[0], {}))), opposite(path.entered)
    else:
        found, back = Standing([]), _back(blocks, path, out, named, findings)
        if back is None:
            return found
        rear, found.needs = back
        found.entries = [opposite(rear)]
    found.needs = {**named, **found.needs}
    for one, other in _other_tracks(blocks, path.blocks[0], (out, rear), found.needs):
        found.entries += [opposite(one), opposite(other)]
        ends = [_place(blocks, each) for each in (one, other)]
        text = (
            f"route '{path.wanted.name}' starts in block '{path.blocks[0]}', where a train may as well stand between "
            f"'{ends[0]}' and '{ends[1]}': no {findings.point_word} that the route needs closes that track"
        )
        findings.violation(APART, (path.wanted.name, *dict.fromkeys(ends)), text)
    return found


def _out(blocks: Blocks, path: Path) -> Heading:
    """The heading out of the start block, at the first detector crossed."""
    behind = blocks.segments.at[opposite(path.crossed[0][1])]
    assert isinstance(behind, Cut)
    return opposite(behind.beyond)


def _back(
    blocks: Blocks, path: Path, out: Heading, named: Mapping[Point, Position], findings: Findings
) -> tuple[Heading, dict[Point, Position]] | None:
    """The other end of the track that leads out there, and its points; none, with a violation, where there are more.

    Points that lie fixed join ends of track two by two, so that no way comes back to where it has been.
    """
    segments, name, start = blocks.segments, path.wanted.name, path.blocks[0]
    lies: dict[Point, Position] = {}
    heading = opposite(out)
    while isinstance(end := segments.at[heading], Joint):
        point, is_point = Point(end.junction), segments.station.junctions[end.junction].is_point
        given = lies.get(point, named.get(point)) if is_point else None
        ways = [(at, onward) for _, at, onward in segments.onward(end) if given is None or given in at]
        if len(ways) > 1:
            ways = [(at, onward) for at, onward in ways if _open_to(blocks, onward, named) - {out}]
        if len(ways) > 1:
            text = (
                f"route '{name}' comes over {findings.point_word} '{point}' in its start block '{start}' from more "
                f"than one side, and gives no position for it"
            )
            findings.violation(SAID, (name, point), text)
            return None
        if not ways:
            over = f", its points lying as it says: {', '.join(sorted(named))}" if named else ""
            text = f"route '{name}' starts in block '{start}', through which no track leads to where it leaves it{over}"
            findings.violation(SAID, (name, *sorted(named)), text)
            return None
        if is_point:
            lies[point] = Position(given or min(ways[0][0]))
        heading = ways[0][1]
    return heading, lies


def _other_tracks(
    blocks: Blocks, block: Block, own: tuple[Heading, Heading], needs: Mapping[Point, Position]
) -> list[tuple[Heading, Heading]]:
    """Other tracks from end to end of a block that are open with these points so, each once."""
    found: dict[frozenset[Heading], tuple[Heading, Heading]] = {}
    for one in blocks.ends[block]:
        if one not in own:
            for other in sorted(_open_to(blocks, opposite(one), needs) - set(own)):
                found.setdefault(frozenset((one, other)), (one, other))
    return list(found.values())


def _open_to(blocks: Blocks, start: Heading, needs: Mapping[Point, Position]) -> set[Heading]:
    """The ends of a block that are come to with these points so and the others in any position."""

    def may_take(joint: Joint, way: WayOn) -> bool:
        lies = needs.get(Point(joint.junction))
        return lies is None or lies in way[1]

    met = walk(blocks.segments, [start], may_take)
    return {heading for heading in met if not isinstance(blocks.segments.at[heading], Joint)}


def _place(blocks: Blocks, heading: Heading) -> str:
    """What stands at an end of a block; the track where nothing does."""
    end = blocks.segments.at[heading]
    assert isinstance(end, Cut | Stop)
    return end.mark or blocks.segments.segments[heading[0]].track
