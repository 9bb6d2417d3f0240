"""Second loop: every tag the head reads is the expected one, in its window, or the train brakes (T5)."""

from __future__ import annotations

from dataclasses import replace

from kernel.authority import is_overtaken
from kernel.names import Block, Cab, Read, Run, Tag
from kernel.tag_list import TagLists, TagPlan
from kernel.unit import Order, Unit


def open_loop(unit: Unit) -> Unit:
    """Open the second loop for the rest of this life: brake; what is occupied stays occupied (T5, T8)."""
    return replace(unit, loop_open=True)


def expects(lists: TagLists, unit: Unit, run: Run, order: Order, cab: Cab, tag: Tag) -> bool:
    """Tell whether a permitted run that was not given back expects ``tag`` next, read by ``cab`` (T5).

    A run begins with both tags at the end of its start block, one right after the other, and is
    led by one cab throughout.  One that a later run has overtaken is past.
    """
    if order.tag_list is None:
        return False
    first = lists.first_tag.get(order.tag_list)
    return (
        order.permitted
        and not order.given_back
        and order.expected == tag
        and (tag == first or order.begun or unit.head_tag == first)
        and (order.led_by is None or order.led_by == cab)
        and not is_overtaken(unit, run)
    )


def is_next(lists: TagLists, unit: Unit, run: Run, order: Order, cab: Cab, tag: Tag) -> bool:
    """Tell whether ``tag`` is the next one of ``run``, and not only where another ends (T5).

    A run back, permitted before the train has arrived, begins with the tag that the way in ends with.
    """
    return expects(lists, unit, run, order, cab, tag) and (
        order.led_by is not None
        or all(
            on_the_way.led_by is None or not expects(lists, unit, other, on_the_way, cab, tag)
            for other, on_the_way in unit.orders.items()
        )
    )


def tail_read_still_good(plan: TagPlan, unit: Unit, tag: Tag) -> Read | None:
    """Give the tail's last read, unless the head passes that boundary now: the tail then comes to it anew (T2)."""
    before = unit.tail_read
    if before is None or before.tag == tag or plan.partner.get(before.tag) == tag:
        return None
    return before


def advance(lists: TagLists, order: Order, cab: Cab, tag: Tag) -> Order:
    """Take the expected tag for read: with the second one the run has begun; the next is expected (T5)."""
    if order.tag_list is None:
        return order
    return replace(
        order,
        begun=order.begun or lists.first_tag.get(order.tag_list) != tag,
        expected=lists.tag_after[order.tag_list].get(tag) if order.tag_list in lists.tag_after else None,
        led_by=cab,
    )


def enter(lists: TagLists, order: Order, cab: Cab, block: Block) -> Order:
    """Note that the head is in ``block``, if a run has begun that claims it beyond its start, led by this cab (T2)."""
    if not order.begun or order.led_by != cab or order.tag_list is None:
        return order
    if order.tag_list not in lists.claims or block not in lists.claims[order.tag_list]:
        return order
    if lists.start.get(order.tag_list) == block:
        return order
    return replace(order, entered=order.entered | {block})


def note_head_read(plan: TagPlan, lists: TagLists, unit: Unit, cab: Cab, tag: Tag, in_window: bool) -> Unit:
    """Compare what the head read with the lists of the first loop, in order (T2, T5).

    ``in_window``: the running distance since the last tag lies within what the tags allow, so
    the tag is neither early nor late.  The same tag read again at once is one reading.  What a
    cab reads that does not lead is the tail's.
    """
    if unit.leading != cab:
        return unit
    tail_read = tail_read_still_good(plan, unit, tag)
    if unit.head_tag == tag or unit.loop_open:
        return replace(unit, tail_read=tail_read)
    if not in_window or not any(expects(lists, unit, run, order, cab, tag) for run, order in unit.orders.items()):
        return open_loop(unit)
    block = plan.tag_in.get(tag)
    advanced = {
        run: advance(lists, order, cab, tag) if is_next(lists, unit, run, order, cab, tag) else order
        for run, order in unit.orders.items()
    }
    if block is None:
        return replace(unit, head_tag=tag, tail_read=tail_read, orders=advanced)
    return replace(
        unit,
        head_tag=tag,
        tail_read=tail_read,
        occupied=unit.occupied | {block},
        orders={run: enter(lists, order, cab, block) for run, order in advanced.items()},
    )


def note_window_passed(unit: Unit) -> Unit:
    """Open the loop when the next tag is overdue by running distance (T5)."""
    return open_loop(unit)
