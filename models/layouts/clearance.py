"""Clearance: how near to a point a train may stand on one leg without being foul of the other (T2, T9)."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from heapq import heappop, heappush
from itertools import combinations, groupby, product

from kernel.names import Block
from models.layouts.blocks import Blocks
from models.layouts.measures import LEAST_CLEARANCE_MM
from models.layouts.results import Leg, Violation
from models.layouts.told import Told
from models.layouts.track import Cut, Heading, Joint, Junction, Station, Stop


def legs_of(blocks: Blocks, told: Told) -> tuple[Leg, ...]:
    """Every leg of the points and crossings that some way over them does not use, with its nearest boundary."""
    return tuple(_legs(blocks, told))


def _legs(blocks: Blocks, told: Told) -> Iterator[Leg]:
    for junction in blocks.segments.station.junctions.values():
        if len(junction.ports) < 3:
            continue
        for port, end in junction.ports.items():
            if any(port not in way for ways in junction.kind.positions.values() for way in ways):
                at_mm, boundary, passed = _nearest(blocks, told, junction, blocks.segments.leaving[end])
                yield Leg(junction.name, port, boundary, at_mm, told.clear_mm.get((junction.name, port)), passed)


Passed = tuple[int, str, Block]
"""How far a boundary lies from a point, its name, and the block behind it."""


def _nearest(
    blocks: Blocks, told: Told, junction: Junction, start: Heading
) -> tuple[int, str | None, tuple[Passed, ...]]:
    """How far it is to the nearest boundary behind which a train keeps nobody off the point, its name; those before it.

    A train in the point's own block keeps others off, and so does one in a block that the point's block is told to
    foul: the way goes on through these.
    """
    passed: list[Passed] = []
    own = blocks.of[start[0]]
    closed = told.fouls.get(own, frozenset()) | {own}
    met: set[Heading] = set()
    todo = [(_long_mm(blocks, start), start)]
    while todo:
        end_mm, heading = heappop(todo)
        if heading in met:
            continue
        met.add(heading)
        end, onward = blocks.segments.at[heading], list[Heading]()
        if not isinstance(end, Joint):
            behind = _behind(blocks, heading)
            if behind is not None and blocks.of[behind[0]] not in closed:
                return end_mm, end.mark, tuple(passed)
            if behind is not None:
                passed.append((end_mm, str(end.mark), blocks.of[behind[0]]))
            onward = [behind] if behind is not None else []
        elif end.junction != junction.name:
            onward = [beyond for _, _, beyond in blocks.segments.onward(end)]
        for beyond in onward:
            heappush(todo, (end_mm + _long_mm(blocks, beyond), beyond))
    return 0, None, tuple(passed)


def _behind(blocks: Blocks, heading: Heading) -> Heading | None:
    """The heading behind the mark that one runs to; none where track ends, and not only at a buffer stop."""
    match blocks.segments.at[heading]:
        case Cut(_, beyond):
            return beyond
        case Stop(str() as mark):
            return blocks.segments.beside[mark].get(heading[1])
    return None


def _long_mm(blocks: Blocks, heading: Heading) -> int:
    return blocks.segments.segments[heading[0]].long_mm


def foul_legs(legs: tuple[Leg, ...], clearance_mm: int) -> Iterator[Violation]:
    """The legs on which a train may stand foul of the other: by what is told, else by what a leg must have.

    What is told must be what tracks can have.
    """
    for leg in legs:
        least_mm = clearance_mm if leg.clear_mm is None else leg.clear_mm
        if leg.clear_mm is not None and leg.clear_mm < LEAST_CLEARANCE_MM:
            text = f"'{leg.point}' is told to be clear {leg.clear_mm:,} mm along its leg '{leg.leg}'"
            apart = f"{text}: tracks that part are not, nearer than {LEAST_CLEARANCE_MM:,} mm"
            yield Violation(APART, (leg.point, leg.leg), apart)
        if leg.boundary is not None and leg.at_mm < least_mm:
            where = f"boundary '{leg.boundary}' lies {leg.at_mm:,} mm behind '{leg.point}' on its leg '{leg.leg}'"
            known = "where nothing is told it must be" if leg.clear_mm is None else "it is clear from"
            text = f"{where}: a train behind it is foul of the other leg ({known} {least_mm:,} mm)"
            yield Violation(RULE, (leg.point, leg.boundary), text)


def trains_side_by_side(
    legs: tuple[Leg, ...], station: Station | None, fouls: Mapping[Block, frozenset[Block]], clearance_mm: int
) -> Iterator[Violation]:
    """The boundaries on two legs that no position joins, passed over where these are not apart, with trains at both.

    That the point's block fouls each of the blocks behind them keeps neither off the other.
    """
    if station is None:
        return
    for one, other in (pair for _, its in groupby(legs, lambda leg: leg.point) for pair in combinations(its, 2)):
        if station.junctions[one.point].kind.joined(one.leg, other.leg):
            continue
        for (near_mm, near, block), (far_mm, far, beside) in product(
            _not_apart(one, clearance_mm), _not_apart(other, clearance_mm)
        ):
            if block != beside and beside not in fouls.get(block, ()):
                text = (
                    f"boundary '{near}' lies {near_mm:,} mm behind '{one.point}' on its leg '{one.leg}' and "
                    f"'{far}' {far_mm:,} mm on its leg '{other.leg}', where neither is clear of the other: "
                    f"trains behind both stand side by side; tell blocks '{block}' and '{beside}' to foul each other"
                )
                yield Violation(BESIDE, (one.point, near, far), text)


def _not_apart(leg: Leg, clearance_mm: int) -> list[Passed]:
    """The boundaries of a leg behind which a train stands that is not clear of the other leg."""
    least_mm = clearance_mm if leg.clear_mm is None else leg.clear_mm
    return [passed for passed in leg.passed if passed[0] < least_mm]


BESIDE = "trains behind two legs of a point are clear of each other"
APART = "a leg is told to be clear where tracks are apart"
RULE = "a train behind a boundary is clear of the point"
