"""First loop and cancellation on board: store, echo, permit, give back (T4, T9)."""

from __future__ import annotations

from dataclasses import replace

from kernel.layout import Layout
from kernel.names import Run
from kernel.unit import NO_BLOCKS, NO_EVIDENCE, Order, Unit


def take_offer(layout: Layout, unit: Unit, run: Run) -> Unit:
    """Store the tag list of a run; from now on the unit echoes it (first loop; T4).

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
                permitted=False,
                given_back=False,
                begun=False,
                stopped=False,
                expected=layout.first_tag.get(run.route),
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
                permitted=False,
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


def echoes(unit: Unit, run: Run) -> bool:
    """Tell whether the unit echoes the list of ``run`` (T4)."""
    return run in unit.orders


def take_permit(unit: Unit, run: Run) -> Unit:
    """Take the route-complete message, unless the run was given back (T4, T9)."""
    order = unit.orders.get(run)
    if order is None or order.given_back:
        return unit
    return replace(unit, orders=unit.orders | {run: replace(order, permitted=True)})


def give_back(unit: Unit, run: Run, stands_short: bool) -> Unit:
    """Give a run back that the centre asks for: only while standing short of it (接近鎖錠; T9).

    ``stands_short``: by odometer and tags the whole train stands still outside the run's blocks
    but for its start.
    """
    order = unit.orders.get(run)
    if order is None or order.begun or not stands_short:
        return unit
    return replace(unit, orders=unit.orders | {run: replace(order, given_back=True)})


def acknowledges_back(unit: Unit, run: Run) -> bool:
    """Tell whether the unit acknowledges that it has given ``run`` back (T9)."""
    order = unit.orders.get(run)
    return order is not None and order.given_back and not order.begun
