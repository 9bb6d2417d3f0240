"""Tail evidence on board: both tags of a boundary, in order, by the tail antenna alone (T2, T6, T7)."""

from __future__ import annotations

from dataclasses import replace

from kernel.names import Block, Cab, Read, Run
from kernel.second_loop import open_loop
from kernel.standstill import ThroughLine, reaches_tail
from kernel.tag_list import NO_PARTS, NO_TAGS, NO_WAY, TagLists, TagPlan
from kernel.unit import Evidence, Order, Unit


def has_been_in(lists: TagLists, order: Order, block: Block) -> bool:
    """Tell whether the train has been in ``block`` under a run: it began there, or its head has entered it (T2).

    On a ring the block that the tail leaves may be one that the run has yet to come to.
    """
    return order.begun and (
        block in order.entered or (order.tag_list is not None and lists.start.get(order.tag_list) == block)
    )


def has_gone_on(lists: TagLists, unit: Unit, run: Run, block: Block, over: Evidence) -> bool:
    """Tell whether the head has gone on out of ``block`` over that boundary, under this run or a later one (T2).

    On a ring the head may have come round into the block that the tail is just leaving; and where a block has two
    tracks, it may have gone on from the other one, over another boundary.  What the other cab led does not count.
    """
    return any(
        other.serial >= run.serial
        and order.begun
        and order.led_by == unit.leading
        and order.tag_list is not None
        and lists.way.get(order.tag_list, NO_WAY).get(block) in order.entered
        and lists.tag_after.get(order.tag_list, NO_TAGS).get(over.left.tag) == over.entered.tag
        for other, order in unit.orders.items()
    )


def backs_out(lists: TagLists, unit: Unit, order: Order, block: Block) -> bool:
    """Tell whether the train backs out of ``block`` as the farthest that it is still in of a run's way (T2).

    What led it there is its tail now: where its head had gone on, the tail comes back from there first.
    """
    if order.tag_list is None or order.led_by == unit.leading:
        return False
    beyond = lists.way.get(order.tag_list, NO_WAY).get(block)
    return beyond not in order.entered or beyond in order.left


def has_left(lists: TagLists, unit: Unit, run: Run, order: Order, block: Block, over: Evidence) -> bool:
    """Tell whether a tail that gets out of ``block`` over that boundary leaves it for a run (T2, T6).

    The head was there, and went on over it, or the train backs out.  A train that stood there has told so.
    """
    return has_been_in(lists, order, block) and (
        order.tag_list is None or backs_out(lists, unit, order, block) or has_gone_on(lists, unit, run, block, over)
    )


def has_come_round(lists: TagLists, unit: Unit, block: Block, over: Evidence) -> bool:
    """Tell whether the head may be in the ``block`` that the tail leaves: it came there, and has not gone on (T2)."""
    return any(
        block in order.entered and not has_left(lists, unit, run, order, block, over)
        for run, order in unit.orders.items()
    )


def note_tail_read(plan: TagPlan, lists: TagLists, unit: Unit, cab: Cab, line: ThroughLine, read: Read) -> Unit:
    """Note what the tail antenna read; the second tag of a pair proves the exit from the first's block (T2).

    A partial or reversed pair, the cab that leads or a line that does not reach the tail prove nothing (T3).  A tag
    in a block that the train is not in opens the second loop (T5).
    """
    if unit.leading is None or unit.leading == cab:
        return unit
    if not reaches_tail(line):
        return replace(unit, tail_read=None)
    entered = plan.tag_in.get(read.tag)
    if entered is None or entered not in unit.occupied:
        return open_loop(replace(unit, tail_read=None))
    before = unit.tail_read
    if before is None or unit.loop_open or plan.partner.get(before.tag) != read.tag:
        return replace(unit, tail_read=read)
    block = plan.tag_in.get(before.tag)
    if block is None:
        return replace(unit, tail_read=read)
    over = Evidence(left=before, entered=read)
    return replace(
        unit,
        tail_read=read,
        occupied=unit.occupied if has_come_round(lists, unit, block, over) else unit.occupied - {block},
        orders={
            run: replace(order, left=order.left | {block: over})
            if has_left(lists, unit, run, order, block, over)
            else order
            for run, order in unit.orders.items()
        },
    )


def reports_left(lists: TagLists, unit: Unit, run: Run, block: Block, left: Read, entered: Read) -> bool:
    """Tell whether the unit reports that its tail has left ``block``, and by which reads (third loop; T6, T7).

    A block is reported once the tail has left the end of its part too.
    """
    order = unit.orders.get(run)
    if order is None:
        return False
    evidence = order.left.get(block)
    if evidence is None or evidence.left != left or evidence.entered != entered:
        return False
    if order.tag_list is None:
        return True
    return lists.released_after.get(order.tag_list, NO_PARTS).get(block, block) in order.left
