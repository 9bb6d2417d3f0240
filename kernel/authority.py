"""How far the unit lets the train go: its part of the contract with the brake (T4, T5, T9)."""

from __future__ import annotations

from dataclasses import replace

from kernel.names import Block, Run, TagList
from kernel.standstill import Standstill, is_held_between
from kernel.tag_list import NO_WAY, TagLists
from kernel.unit import Order, Unit


def may_proceed(unit: Unit, run: Run) -> bool:
    """Tell whether the train may move under ``run``: permitted, not wanted back, second loop closed (T4, T5, T9).

    A recall takes the authority away at once, long before the run is given back; but a train that has
    begun the run keeps it.  A train runs by its runs in the order in which they were granted (:func:`is_overtaken`).
    Once it has told that it stands in its destination it draws up no more: the overlap may be another train's by then.
    """
    order = unit.orders.get(run)
    return (
        order is not None
        and order.permitted
        and not order.given_back
        and not order.stopped
        and (order.begun or not order.recalled)
        and not is_overtaken(unit, run)
        and not unit.loop_open
    )


def is_overtaken(unit: Unit, run: Run) -> bool:
    """Tell whether a later run has begun: an older one is not begun, nor gone on under, any more (T2, T9).

    The unit takes it from the order of the runs whether its head has gone on out of a block.
    """
    return any(other.serial > run.serial and order.begun for other, order in unit.orders.items())


def may_leave(lists: TagLists, unit: Unit, run: Run, block: Block) -> bool:
    """Tell whether the end of authority lies beyond ``block``, so that a head in it may go on (T4, T12).

    It lies beyond while the way goes on, out of and into blocks that the tail has not left in
    this run, and never in the overlap, which is for a train that brakes too late.
    """
    order = unit.orders.get(run)
    if order is None or order.tag_list is None:
        return False
    target = lists.way.get(order.tag_list, NO_WAY).get(block)
    return (
        target is not None
        and may_proceed(unit, run)
        and block not in order.left
        and target not in order.left
        and not is_overlap(lists, order.tag_list, target)
    )


def is_overlap(lists: TagLists, tag_list: TagList, block: Block) -> bool:
    """Tell whether a list has ``block`` in its overlap; of a list whose overlap is unknown any block may be (T9)."""
    return block in lists.overlap.get(tag_list, frozenset({block}))


def ends_in(lists: TagLists, tag_list: TagList, block: Block) -> bool:
    """Tell whether the way of a list goes on from ``block`` into its overlap alone, or not at all (T9)."""
    beyond = lists.way.get(tag_list, NO_WAY).get(block)
    return beyond is None or is_overlap(lists, tag_list, beyond)


def has_arrived(lists: TagLists, order: Order) -> bool:
    """Tell whether the head has come to the end of a run's way, by its own tags under this run (T9).

    A train that stands in its destination before it has run there needs the overlap yet.
    """
    tag_list = order.tag_list
    return tag_list is not None and any(ends_in(lists, tag_list, block) for block in order.entered)


def note_stopped(lists: TagLists, unit: Unit, run: Run, at: Standstill, begin_mm: int, end_mm: int) -> Unit:
    """End the run's permission to move once the train has come to its destination, and is held in it (T9).

    ``begin_mm``, ``end_mm``: where the destination of ``run`` begins and ends, by its tag list.
    What the train tells frees the overlap.  One that still moves, or that no brake holds, might need it.
    The cab that led into the destination is the one whose front counts: of a train that has changed ends that may
    stand in the destination, and its other end in the overlap.
    """
    order = unit.orders.get(run)
    if order is None or not is_held_between(at, begin_mm, end_mm) or not may_proceed(unit, run):
        return unit
    if order.led_by != unit.leading or not has_arrived(lists, order):
        return unit
    return replace(unit, orders=unit.orders | {run: replace(order, stopped=True)})


def tells_stopped(unit: Unit, run: Run) -> bool:
    """Tell whether the unit tells the centre that it stands in the destination of ``run`` (T9)."""
    order = unit.orders.get(run)
    return order is not None and order.stopped and not order.given_back
