"""Change of ends: the driver chooses the direction, so which cab leads; what was read before says nothing more (T2)."""

from __future__ import annotations

from dataclasses import replace

from kernel.names import Cab
from kernel.tag_list import TagLists
from kernel.unit import Order, Unit


def from_its_first_tag(lists: TagLists, order: Order) -> Order:
    """Expect the first tag of a run again, unless the run has begun: whoever leads now has not read it (T5)."""
    if order.begun or order.tag_list is None:
        return order
    return replace(order, expected=lists.first_tag.get(order.tag_list), led_by=None)


def change_ends(lists: TagLists, unit: Unit, cab: Cab) -> Unit:
    """Take ``cab`` for the head, every other cab for the tail (T2).

    The tail's last read is forgotten: it was made on the way in the other direction, so it and
    the next one would not prove that the tail has left a block.  The head's is forgotten too,
    since the other head may read the same tag anew, and with it how far it had come towards a run.
    """
    if unit.leading == cab:
        return unit
    return replace(
        unit,
        leading=cab,
        head_tag=None,
        tail_read=None,
        orders={run: from_its_first_tag(lists, order) for run, order in unit.orders.items()},
    )
