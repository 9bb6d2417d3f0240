"""First loop and cancellation on board: store, echo, permit, recall, give back (T4, T9)."""

from __future__ import annotations

from dataclasses import replace

from kernel.names import Run, TagList
from kernel.standstill import Standstill, is_held
from kernel.tag_list import TagLists
from kernel.unit import NO_BLOCKS, NO_EVIDENCE, Order, Unit


def take_offer(lists: TagLists, unit: Unit, run: Run, tag_list: TagList) -> Unit:
    """Store what the centre has sent for a run, all of it; from now on the unit echoes that (first loop; T4).

    A list that comes again changes nothing: what the run has gone through must not be forgotten.
    The first order of a life is the one under which the train stands, so that its tail's
    evidence is noted for that one too.
    """
    if run.life != unit.life or run in unit.orders:
        return unit
    if not any(True for _ in unit.orders):
        return unit
    return replace(
        unit,
        orders=unit.orders
        | {
            run: Order(
                tag_list=tag_list,
                permitted=False,
                recalled=False,
                given_back=False,
                begun=False,
                stopped=False,
                expected=lists.first_tag.get(tag_list),
                entered=NO_BLOCKS,
                led_by=None,
                left=NO_EVIDENCE,
            )
        },
    )


def take_standing(unit: Unit, run: Run) -> Unit:
    """Store under which run the centre holds what this life answered, for the tail's evidence (T6, T8)."""
    if run.life != unit.life or run in unit.orders:
        return unit
    return replace(
        unit,
        orders=unit.orders
        | {
            run: Order(
                tag_list=None,
                permitted=False,
                recalled=False,
                given_back=True,
                begun=True,
                stopped=True,
                expected=None,
                entered=unit.standing_in,
                led_by=None,
                left=NO_EVIDENCE,
            )
        },
    )


def echoes(unit: Unit, run: Run, tag_list: TagList) -> bool:
    """Tell whether the unit sends back ``tag_list`` for ``run``: the very one that it keeps and will use (T4)."""
    order = unit.orders.get(run)
    return order is not None and order.tag_list == tag_list


def take_permit(unit: Unit, run: Run) -> Unit:
    """Take the route-complete message, unless the run was given back (T4, T9)."""
    order = unit.orders.get(run)
    if order is None or order.given_back:
        return unit
    return replace(unit, orders=unit.orders | {run: replace(order, permitted=True)})


def recall(unit: Unit, run: Run) -> Unit:
    """Note that the centre asks for a run: its blocks are authority no more, and the brake is asked for less (T9).

    Nothing is given back by that: the brake may not be able to hold the nearer end yet.
    """
    order = unit.orders.get(run)
    if order is None or order.begun:
        return unit
    return replace(unit, orders=unit.orders | {run: replace(order, recalled=True)})


def is_followed(lists: TagLists, unit: Unit, run: Run) -> bool:
    """Tell whether a later run starts in what ``run`` covers, and was not given back (T9)."""
    known = unit.orders.get(run)
    if known is None or known.tag_list is None or known.tag_list not in lists.covers:
        return False
    covered = lists.covers[known.tag_list]
    return any(
        run.serial < other.serial
        and not order.given_back
        and order.tag_list is not None
        and lists.start.get(order.tag_list) in covered
        for other, order in unit.orders.items()
    )


def give_back(lists: TagLists, unit: Unit, run: Run, at: Standstill, held_end_mm: int, start_end_mm: int) -> Unit:
    """Give a run back that was recalled, once the train stands and its brake keeps it out of it (接近鎖錠; T9, T12).

    ``held_end_mm``: the end of authority that the brake control holds.  ``start_end_mm``: where the block
    that the run starts in ends, on the same kilometrage.  A train that still moves might brake worse than its
    bounds, and beyond the place where it is to stop there may be no overlap any more; one whose front may be past
    that place has done so.  The runs that lead on from this one are given back first.
    """
    order = unit.orders.get(run)
    if order is None or not order.recalled or order.begun:
        return unit
    if not is_held(at) or held_end_mm > start_end_mm or at.front_most_mm > start_end_mm:
        return unit
    if is_followed(lists, unit, run):
        return unit
    return replace(unit, orders=unit.orders | {run: replace(order, given_back=True)})


def acknowledges_back(unit: Unit, run: Run) -> bool:
    """Tell whether the unit acknowledges that it has given ``run`` back (T9)."""
    order = unit.orders.get(run)
    return order is not None and order.given_back and not order.begun
