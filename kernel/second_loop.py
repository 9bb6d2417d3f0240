"""Second loop: every tag the head reads is the expected one, in its window, or the train brakes (T5)."""

from __future__ import annotations

from dataclasses import replace

from kernel.layout import Layout
from kernel.names import Cab, Tag
from kernel.unit import Unit


def open_loops(unit: Unit) -> Unit:
    """Open the second loop of every run: brake; what is occupied stays occupied (T5, T8)."""
    return replace(unit, orders={run: replace(order, loop_closed=False) for run, order in unit.orders.items()})


def is_expected(unit: Unit, tag: Tag) -> bool:
    """Tell whether a permitted run that was not given back expects ``tag`` next at the head (T5)."""
    return any(order.permitted and not order.given_back and order.expected == tag for _, order in unit.orders.items())


def note_head_read(layout: Layout, unit: Unit, cab: Cab, tag: Tag, in_window: bool) -> Unit:
    """Compare what the head read with the lists of the first loop, in order (T2, T5).

    ``in_window``: the running distance since the last tag lies within what the tags allow, so
    the tag is neither early nor late.  The same tag read again at once by the same cab is one
    reading; after a change of ends the other cab reads it anew.
    """
    if unit.head_tag == tag and unit.head_cab == cab:
        return unit
    if not in_window or not is_expected(unit, tag):
        return open_loops(unit)
    entered = layout.tag_in.get(tag)
    return replace(
        unit,
        head_tag=tag,
        head_cab=cab,
        occupied=unit.occupied if entered is None else unit.occupied | {entered},
        orders={
            run: replace(
                order,
                begun=order.begun or layout.first_tag.get(run.route) != tag,
                expected=layout.tag_after[run.route].get(tag) if run.route in layout.tag_after else None,
            )
            if order.permitted and not order.given_back and order.expected == tag
            else order
            for run, order in unit.orders.items()
        },
    )


def note_window_passed(unit: Unit) -> Unit:
    """Open the loop when the next tag is overdue by running distance (T5)."""
    return open_loops(unit)
