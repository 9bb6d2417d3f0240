"""What one followed route grants: blocks, points and how they must lie, and its release (T4, T7, T9, T10)."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field

from kernel.names import Block, Point, Position
from models.layouts.blocks import Blocks, inward, opposite, towards, walk
from models.layouts.findings import Findings
from models.layouts.following import Path
from models.layouts.track import Cut, Heading

Boundary = tuple[str, Block, Block]
"""A detector between two blocks, in running order."""


@dataclass
class Granted:
    """One route as the kernel is to know it.

    ``entries``: for each claimed block, the headings a movement may begin it with.
    ``boundaries``: the detectors between claimed blocks in running order, with those blocks.
    """

    name: str
    start: Block
    covers: list[Block]
    overlap: list[Block]
    entries: dict[Block, list[Heading]] = field(default_factory=dict)
    boundaries: list[Boundary] = field(default_factory=list)
    needs: dict[Point, Position] = field(default_factory=dict)
    released_with: dict[Point, Block] = field(default_factory=dict)
    released_after: dict[Block, Block] = field(default_factory=dict)
    flank: dict[Block, dict[Block, Point]] = field(default_factory=dict)

    @property
    def claims(self) -> list[Block]:
        """Start, covers and overlap in running order."""
        return [self.start, *self.covers, *self.overlap]

    @property
    def way(self) -> dict[Block, Block]:
        """Each claimed block but the last, and the next."""
        return dict(zip(self.claims, self.claims[1:], strict=False))


def grant(blocks: Blocks, path: Path, findings: Findings) -> Granted | None:
    """The route as granted; none, with a remark or a violation, where there is nothing to grant."""
    name, chain = path.wanted.name, [*path.blocks, *path.overlap]
    _say_what_does_not_release(path, findings)
    _say_what_is_off_the_path(path, findings)
    if len(path.blocks) < 2:
        findings.remark((name,), f"route '{name}' ends in the block it starts in: it grants nothing and is left out")
        return None
    twice = sorted({block for block in chain if chain.count(block) > 1})
    for block in twice:
        text = f"route '{name}' comes into block '{block}' twice"
        findings.violation("a route passes a block once", (name, *blocks.bounds[block]), text)
    if twice:
        return None
    crossed = path.crossed + path.beyond
    granted = Granted(name, path.blocks[0], path.blocks[1:], path.overlap)
    granted.boundaries = [(mark, chain[at], chain[at + 1]) for at, (mark, _) in enumerate(crossed)]
    granted.entries = {blocks.of[heading[0]]: [heading] for _, heading in crossed}
    _begin_in_start(blocks, path, granted, findings)
    for block in chain[1:]:
        for point in sorted(blocks.points_in[block]):
            passed = path.points.get(block, {}).get(point)
            granted.needs[point] = passed if passed is not None else spare_position(blocks, point)
            granted.released_with[point] = block
    _release(path, granted)
    return granted


def spare_position(blocks: Blocks, point: Point) -> Position:
    """How a point lies that a route claims and does not pass: the first position by name, for every route."""
    return Position(min(blocks.segments.station.junctions[point].kind.positions))


def _begin_in_start(blocks: Blocks, path: Path, granted: Granted, findings: Findings) -> None:
    """Where a train in the start block may begin, and the points it meets on the way out."""
    start = granted.start
    if path.from_stop:
        granted.entries[start] = [path.entered]
        demands = dict(path.points.get(start, {}))
    else:
        goal = _out_of_start(blocks, path)
        others = [heading for heading in inward(blocks, start) if opposite(heading) != goal]
        granted.entries[start] = [h for h in others if goal in walk(blocks.segments, [h])]
        demands = _start_demands(blocks, granted, goal, findings)
    for point, position in demands.items():
        granted.needs[point] = position
        granted.released_with[point] = start


def _out_of_start(blocks: Blocks, path: Path) -> Heading:
    """The heading out of the start block, at the first detector crossed."""
    behind = blocks.segments.at[opposite(path.crossed[0][1])]
    assert isinstance(behind, Cut)
    return opposite(behind.beyond)


def _start_demands(blocks: Blocks, granted: Granted, goal: Heading, findings: Findings) -> dict[Point, Position]:
    """The points that a train in the start block meets facing before the entry, as they must lie.

    Each lies so that it leads there from every leg that it is met at: the first such position by name.
    """
    leading: dict[Point, dict[str, set[str]]] = {}
    for (junction, port, _), positions in towards(blocks.segments, granted.entries[granted.start], goal).items():
        leading.setdefault(Point(junction), {}).setdefault(port, set()).update(positions)
    found: dict[Point, Position] = {}
    for point, by_port in sorted(leading.items()):
        agreed = set.intersection(*by_port.values())
        found[point] = Position(min(agreed or set.union(*by_port.values())))
        if not agreed:
            wanted = ", ".join(f"from {port} '{min(positions)}'" for port, positions in sorted(by_port.items()))
            text = (
                f"route '{granted.name}': no position of {findings.point_word} '{point}' leads out of its start block "
                f"'{granted.start}' from every side: {wanted}"
            )
            findings.violation("a start block leads out one way", (granted.name, point), text)
    return found


def _release(path: Path, granted: Granted) -> None:
    """Up to where each block is released: in parts at release detectors, the rest on arrival."""
    listed = set(path.wanted.release)
    ends = [mark for mark, _, _ in granted.boundaries[1 : len(granted.covers)]]
    until = granted.covers[-2] if len(granted.covers) > 1 else granted.covers[-1]
    for block, mark in reversed(list(zip(granted.covers[:-1], ends, strict=True))):
        until = block if mark in listed else until
        granted.released_after[block] = until
    for alone in (granted.start, granted.covers[-1], *granted.overlap):
        granted.released_after[alone] = alone


def _say_what_does_not_release(path: Path, findings: Findings) -> None:
    """A release detector that the route does not pass between its entry and its exit."""
    name = path.wanted.name
    inner = {mark for mark, _ in path.crossed[0 if path.from_stop else 1 :]}
    for mark in sorted(set(path.wanted.release) - inner):
        if mark == path.wanted.exit:
            findings.remark((name, mark), f"route '{name}' lists its exit '{mark}' as a release detector: needless")
        else:
            where = "is its entry" if mark == path.wanted.entry else "does not lie on its path"
            text = f"route '{name}': release detector '{mark}' {where}"
            findings.violation("a release detector lies within its route", (name, mark), text)


def _say_what_is_off_the_path(path: Path, findings: Findings) -> None:
    """A position given for a junction that the route does not pass."""
    name = path.wanted.name
    for junction in sorted(set(path.wanted.positions) - path.junctions):
        text = f"route '{name}' gives a position for {findings.point_word} '{junction}', which is not on its path"
        findings.violation("a route's positions are of its points", (name, junction), text)


def hold_flank(
    granted: Granted,
    flank: Mapping[str, str],
    blocks: Blocks,
    opens: Mapping[Block, Mapping[Block, Mapping[Point, Position]]],
    findings: Findings,
) -> None:
    """Hold points off the path so that no vehicle comes from the side; each is released with what it shields."""
    for junction, wanted in sorted(flank.items()):
        point, position = Point(junction), Position(wanted)
        beside = blocks.stands_in[point]
        if beside in granted.claims:
            if granted.needs.get(point) != position:
                point_text = f"{findings.point_word} '{point}' in '{position}'"
                text = f"route '{granted.name}' wants flank {point_text} but claims its block"
                findings.violation("a flank point lies off its route", (granted.name, junction), text)
            continue
        shielded = [
            block
            for block in granted.claims[1:]
            if opens.get(beside, {}).get(block, {}).get(point, position) != position
        ]
        if not shielded:
            point_text = f"{findings.point_word} '{point}' in '{position}'"
            text = f"route '{granted.name}': {point_text} keeps nothing out of its blocks"
            findings.violation("a flank point shields its route", (granted.name, junction), text)
            continue
        granted.needs[point], granted.released_with[point] = position, shielded[0]
        granted.flank.setdefault(beside, {})[shielded[0]] = point
