"""Where the train stands: a unit's answer to the centre's challenge, and what it shows once isolated (T8, ours)."""

from __future__ import annotations

from kernel.names import Block, Epoch, UnitLife
from kernel.standstill import Standstill, ThroughLine, is_whole, stays_held
from kernel.unit import NO_BLOCKS, NO_ORDERS, Unit


def answer(
    unit: Unit, epoch: Epoch, life: UnitLife, blocks: frozenset[Block], at: Standstill, line: ThroughLine
) -> Unit:
    """Answer the challenge of ``epoch``: drop every authority, begin a new life, tell where the train stands (T8).

    ``blocks``: by the tags at both ends, all the blocks that the train may be in.
    The brake holds the train by then: what has just been given away cannot be run into while a brake responds.  It is
    withheld besides: an end that was taken before, or an order that was looked at before, releases it no more.
    What a life has said stays true, since it cannot move before the centre has taken it.  A challenge that has been
    answered (:func:`tells_standing`) is answered again only for the driver, who asks to be located anew: so a train
    at rest gives back whatever it can neither run under nor give back one by one.
    """
    if not stays_held(at) or not is_whole(line) or life <= unit.life:
        return unit
    return Unit(
        life=life,
        answered=epoch,
        standing_in=blocks,
        isolated_in=None,
        orders=NO_ORDERS,
        loop_open=False,
        leading=unit.leading,
        head_tag=None,
        tail_read=None,
        occupied=blocks,
    )


def tells_standing(unit: Unit, epoch: Epoch) -> bool:
    """Tell whether the unit sends what it answered in ``epoch`` (T8)."""
    return unit.answered == epoch


def isolate(unit: Unit, epoch: Epoch, life: UnitLife) -> Unit:
    """Isolate the unit: it drops every authority and begins a new life, in the epoch that the signaller names (T8)."""
    if life <= unit.life:
        return unit
    return Unit(
        life=life,
        answered=None,
        standing_in=NO_BLOCKS,
        isolated_in=epoch,
        orders=NO_ORDERS,
        loop_open=False,
        leading=None,
        head_tag=None,
        tail_read=None,
        occupied=NO_BLOCKS,
    )


def shows(unit: Unit, epoch: Epoch, life: UnitLife) -> bool:
    """Tell whether this is the life that an isolated unit shows, and the epoch (T8)."""
    return unit.life == life and unit.isolated_in == epoch
