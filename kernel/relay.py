"""Orders to point terminals go through the train; on a turnout it suppresses throws (てっ査鎖錠; T10)."""

from __future__ import annotations

from kernel.names import Point, Position, Run
from kernel.tag_list import NO_POINTS, TagLists, TagPlan
from kernel.unit import Unit


def relays_order(plan: TagPlan, lists: TagLists, unit: Unit, run: Run, point: Point, position: Position) -> bool:
    """Tell whether the unit passes the order on that wants ``point`` in ``position`` (T10).

    Standing on the turnout block of the point it passes only what cannot throw it: an order
    for the position in which a run that the train is on already holds the point.
    """
    if run.life != unit.life:
        return False
    if point not in plan.stands_in or plan.stands_in[point] not in unit.occupied:
        return True
    return any(
        order.begun and order.tag_list is not None and lists.needs.get(order.tag_list, NO_POINTS).get(point) == position
        for _, order in unit.orders.items()
    )
