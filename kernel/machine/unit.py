"""A unit and the centre, as one machine of the unit: what it takes, what it passes on, and what it says (T4, T8, T9).

What its antennas read and what its brake control tells is in `kernel.second_loop`, `kernel.tail_evidence` and
`kernel.authority`.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass

from kernel import authority, first_loop, relay, standing, tail_evidence
from kernel.machine.messages import (
    Challenge,
    Echo,
    FromUnit,
    GivenBack,
    Isolation,
    Offer,
    Permit,
    PointEnquiry,
    PointOrder,
    Recall,
    Standing,
    StandingRun,
    Stopped,
    TailReport,
    ToTerminal,
    ToUnit,
)
from kernel.names import Block, Run, Train, UnitLife
from kernel.restarts import restart_unit
from kernel.standstill import Standstill, ThroughLine
from kernel.tag_list import TagLists, TagPlan
from kernel.unit import NO_BLOCKS, NO_ORDERS, Unit

NEVER_STARTED = UnitLife(0)
"""The lasting memory of a unit before its first start."""


@dataclass(frozen=True)
class Place:
    """What the computer on board knows of a train at the moment at which it is told something (P7, T2, T8).

    ``blocks``: by the tags at both ends, all the blocks that the train may be in.  ``at``: front, speed and brake.
    ``line``: the way to the tail.  ``asks_anew``: the driver has asked for the train to be located anew.
    """

    blocks: frozenset[Block]
    at: Standstill
    line: ThroughLine
    asks_anew: bool


def start(written: UnitLife) -> Unit:
    """Begin with the count of lives that lasting memory holds, and nothing else (T8)."""
    before = Unit(
        life=written,
        answered=None,
        standing_in=NO_BLOCKS,
        isolated_in=None,
        orders=NO_ORDERS,
        loop_open=False,
        leading=None,
        head_tag=None,
        tail_read=None,
        occupied=NO_BLOCKS,
    )
    return restart_unit(before, UnitLife(written + 1))


def next_life(unit: Unit) -> UnitLife:
    """Give the life that begins when this one ends (T8)."""
    return UnitLife(unit.life + 1)


def answer(lists: TagLists, unit: Unit, told: ToUnit | Isolation, place: Place) -> Unit:
    """Take what the centre says, or the person who isolates the unit (T4, T8, T9).

    What is for a terminal changes nothing on board.
    A challenge that this life has answered is answered again only for the driver: repeated by the radio, it would
    take from the train what the centre has granted it since.
    """
    match told:
        case Challenge(epoch):
            if standing.tells_standing(unit, epoch) and not place.asks_anew:
                return unit
            return standing.answer(unit, epoch, next_life(unit), place.blocks, place.at, place.line)
        case Offer(run, tag_list):
            return first_loop.take_offer(lists, unit, run, tag_list)
        case Permit(run):
            return first_loop.take_permit(unit, run)
        case Recall(run):
            return first_loop.recall(unit, run)
        case StandingRun(run):
            return first_loop.take_standing(unit, run)
        case Isolation(epoch):
            return standing.isolate(unit, epoch, next_life(unit))
        case PointOrder() | PointEnquiry():
            return unit


def passes_on(plan: TagPlan, lists: TagLists, unit: Unit, told: ToUnit) -> tuple[ToTerminal, ...]:
    """Give what the unit passes on to a terminal: not what would throw the point below it (T10)."""
    match told:
        case PointOrder(run, point, position, _):
            return (told,) if relay.relays_order(plan, lists, unit, run, point, position) else ()
        case PointEnquiry():
            return (told,)
        case _:
            return ()


def says(lists: TagLists, unit: Unit, written: UnitLife, train: Train, runs: Iterable[Run]) -> tuple[FromUnit, ...]:
    """Give all that the unit has to say of itself and of these runs; nothing before its life is written down (T4, T8).

    ``runs``: all that it has orders for, or those of them that the centre is known not to have forgotten.
    """
    if written != unit.life:
        return ()
    stands = () if unit.answered is None else (Standing(train, unit.life, unit.answered, unit.standing_in),)
    return (*stands, *(said for run in runs for said in says_of(lists, unit, run)))


def says_of(lists: TagLists, unit: Unit, run: Run) -> tuple[FromUnit, ...]:
    """Give what the unit says of a run: its list, that it is given back, and what the tail has left (T4, T6, T9)."""
    order = unit.orders.get(run)
    if order is None:
        return ()
    echo = () if order.tag_list is None else (Echo(run, order.tag_list),)
    back = (GivenBack(run),) if first_loop.acknowledges_back(unit, run) else ()
    reports = tuple(
        TailReport(run, block, over.left, over.entered)
        for block, over in order.left.items()
        if tail_evidence.reports_left(lists, unit, run, block, over.left, over.entered)
    )
    stop = (Stopped(run),) if authority.tells_stopped(unit, run) else ()
    return (*echo, *back, *reports, *stop)
