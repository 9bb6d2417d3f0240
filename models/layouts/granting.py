"""What one followed route grants: blocks, points and how they must lie, and its release (T4, T7, T9, T10)."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field

from kernel.names import Block, Point, Position
from models.layouts.beside import Spare
from models.layouts.blocks import Blocks
from models.layouts.findings import Findings
from models.layouts.following import Path
from models.layouts.results import BesidePath
from models.layouts.standing import standing
from models.layouts.track import Heading

Boundary = tuple[str, Block, Block]
"""A detector between two blocks, in running order."""


@dataclass
class Granted:
    """One route as the kernel is to know it.

    ``entries``: for each claimed block, the headings a movement may begin it with.
    ``boundaries``: the detectors between claimed blocks in running order, with those blocks.
    ``beside``: points beside its path in claimed blocks, and what they are to it.
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
    beside: dict[Point, BesidePath] = field(default_factory=dict)

    @property
    def claims(self) -> list[Block]:
        """Start, covers and overlap in running order."""
        return [self.start, *self.covers, *self.overlap]

    @property
    def way(self) -> dict[Block, Block]:
        """Each claimed block but the last, and the next."""
        return dict(zip(self.claims, self.claims[1:], strict=False))


def grant(blocks: Blocks, path: Path, spare: Spare, findings: Findings) -> Granted | None:
    """The route as granted; none, with a remark or a violation, where there is nothing to grant."""
    name, chain = path.wanted.name, [*path.blocks, *path.overlap]
    _say_what_does_not_release(path, findings)
    named = _named_beside(blocks, path, findings)
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
    there = {point: at for point, at in named.items() if blocks.stands_in[point] == granted.start}
    stands = standing(blocks, path, there, findings)
    granted.entries[granted.start] = stands.entries
    for point, position in sorted(stands.needs.items()):
        granted.needs[point], granted.released_with[point] = position, granted.start
    for block in chain[1:]:
        granted.needs |= path.points.get(block, {})
        _lay_beside(granted, block, spare, path, named, findings)
        granted.released_with |= dict.fromkeys(blocks.points_in[block], block)
    _release(path, granted)
    return granted


def _lay_beside(
    granted: Granted, block: Block, spare: Spare, path: Path, named: Mapping[Point, Position], findings: Findings
) -> None:
    """The points of a claimed block that the path does not pass, as the route names them, else as they close it."""
    for point, beside in sorted(spare.of(block, granted.entries[block][0], path.points.get(block, {})).items()):
        given = named.get(point)
        granted.needs[point] = given or beside.position
        granted.beside[point] = "trap" if beside.is_trap else "spare"
        if beside.is_trap and granted.needs[point] not in beside.closing:
            closed = ", ".join(f"'{at}'" for at in sorted(beside.closing))
            text = (
                f"route '{granted.name}' names {findings.point_word} '{point}' in '{given}', which opens a way onto it"
            )
            findings.remark((granted.name, point), f"{text}: {closed} closes it")


def _named_beside(blocks: Blocks, path: Path, findings: Findings) -> dict[Point, Position]:
    """The positions that a route names for points that it does not pass: those of its flank, and in its blocks.

    A position for any other junction is a violation.
    """
    name, claims = path.wanted.name, {*path.blocks, *path.overlap}
    found: dict[Point, Position] = {}
    for junction in sorted(set(path.wanted.positions) - path.junctions):
        position = path.wanted.positions[junction]
        what = f"route '{name}' gives a position for {findings.point_word} '{junction}', which"
        if blocks.stands_in.get(Point(junction)) not in claims:
            text = f"{what} is not on its path nor in its blocks"
        elif position not in blocks.segments.station.junctions[junction].kind.positions:
            text = f"{what} cannot lie in '{position}'"
        else:
            found[Point(junction)] = Position(position)
            continue
        findings.violation("a route's positions are of its points", (name, junction), text)
    return {**{Point(point): Position(at) for point, at in path.wanted.flank.items()}, **found}


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


def hold_flank(
    granted: Granted,
    flank: Mapping[str, str],
    blocks: Blocks,
    opens: Mapping[Block, Mapping[Block, Mapping[Point, Position]]],
    findings: Findings,
) -> None:
    """Hold points off the path so that no vehicle comes from the side; each is released with what it shields.

    Of several covered blocks that one shields it is released with the last, so that it is held as long as any of them;
    with an overlap only where it shields nothing else.
    """
    for junction, wanted in sorted(flank.items()):
        point, position = Point(junction), Position(wanted)
        beside = blocks.stands_in[point]
        if beside in granted.claims:
            if granted.needs.get(point) != position:
                point_text = f"{findings.point_word} '{point}' in '{position}'"
                text = f"route '{granted.name}' wants flank {point_text} but needs it in another position"
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
        last = [block for block in shielded if block in granted.covers][-1:] or shielded[-1:]
        granted.needs[point], granted.released_with[point] = position, last[0]
        granted.flank.setdefault(beside, {})[last[0]] = point
