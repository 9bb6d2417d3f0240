"""Orders to point terminals go through the train; on a turnout it suppresses throws (てっ査鎖錠; T10)."""

from __future__ import annotations

from kernel.layout import Layout
from kernel.names import Point, Run
from kernel.unit import Unit


def relays_order(layout: Layout, unit: Unit, run: Run, point: Point) -> bool:
    """Tell whether the unit passes the order for ``point`` on (T10).

    Standing on the turnout block of the point it passes only what cannot throw it: an order
    for the position in which a run that the train is on already holds the point.
    """
    if run.life != unit.life or run.route not in layout.needs or point not in layout.needs[run.route]:
        return False
    if point not in layout.stands_in or layout.stands_in[point] not in unit.occupied:
        return True
    return any(
        order.begun
        and other.route in layout.needs
        and layout.needs[other.route].get(point) == layout.needs[run.route][point]
        for other, order in unit.orders.items()
    )
