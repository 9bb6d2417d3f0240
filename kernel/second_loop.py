"""Second loop: every tag the head reads is the expected one, in its window, or the train brakes (T5)."""

from __future__ import annotations

from dataclasses import replace

from kernel.layout import Layout
from kernel.names import Block, Cab, Read, Run, Tag
from kernel.unit import Order, Unit


def open_loop(unit: Unit) -> Unit:
    """Open the second loop for the rest of this life: brake; what is occupied stays occupied (T5, T8)."""
    return replace(unit, loop_open=True)


def expects(order: Order, cab: Cab, tag: Tag) -> bool:
    """Tell whether a permitted run that was not given back expects ``tag`` next, read by ``cab`` (T5).

    A run that one cab has begun to lead is not led on by another.
    """
    return (
        order.permitted
        and not order.given_back
        and order.expected == tag
        and (order.led_by is None or order.led_by == cab)
    )


def tail_read_still_good(layout: Layout, unit: Unit, tag: Tag) -> Read | None:
    """Give the tail's last read, unless the head passes that boundary now: the tail then comes to it anew (T2)."""
    before = unit.tail_read
    if before is None or before.tag == tag or layout.partner.get(before.tag) == tag:
        return None
    return before


def advance(layout: Layout, run: Run, order: Order, cab: Cab, tag: Tag) -> Order:
    """Take the expected tag for read: with the second one the run has begun; the next is expected (T5)."""
    return replace(
        order,
        begun=order.begun or layout.first_tag.get(run.route) != tag,
        expected=layout.tag_after[run.route].get(tag) if run.route in layout.tag_after else None,
        led_by=cab,
    )


def enter(layout: Layout, run: Run, order: Order, block: Block) -> Order:
    """Note that the head is in ``block``, if that is a block of a run that has begun, beyond its start (T2)."""
    if not order.begun or run.route not in layout.claims or block not in layout.claims[run.route]:
        return order
    if layout.start.get(run.route) == block:
        return order
    return replace(order, entered=order.entered | {block})


def note_head_read(layout: Layout, unit: Unit, cab: Cab, tag: Tag, in_window: bool) -> Unit:
    """Compare what the head read with the lists of the first loop, in order (T2, T5).

    ``in_window``: the running distance since the last tag lies within what the tags allow, so
    the tag is neither early nor late.  The same tag read again at once is one reading.  What a
    cab reads that does not lead is the tail's.
    """
    if unit.leading != cab:
        return unit
    tail_read = tail_read_still_good(layout, unit, tag)
    if unit.head_tag == tag:
        return replace(unit, tail_read=tail_read)
    if not in_window or not any(expects(order, cab, tag) for _, order in unit.orders.items()):
        return open_loop(unit)
    block = layout.tag_in.get(tag)
    advanced = {
        run: advance(layout, run, order, cab, tag) if expects(order, cab, tag) else order
        for run, order in unit.orders.items()
    }
    if block is None:
        return replace(unit, head_tag=tag, tail_read=tail_read, orders=advanced)
    return replace(
        unit,
        head_tag=tag,
        tail_read=tail_read,
        occupied=unit.occupied | {block},
        orders={run: enter(layout, run, order, block) for run, order in advanced.items()},
    )


def note_window_passed(unit: Unit) -> Unit:
    """Open the loop when the next tag is overdue by running distance (T5)."""
    return open_loop(unit)
