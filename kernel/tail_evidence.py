"""Tail evidence on board: both tags of a boundary, in order, by the tail antenna alone (T2, T6, T7)."""

from __future__ import annotations

from dataclasses import replace

from kernel.layout import Layout
from kernel.names import Antenna, Block, Cab, Read, Run
from kernel.unit import Evidence, Unit


def note_tail_read(layout: Layout, unit: Unit, antenna: Antenna, cab: Cab, healthy: bool, read: Read) -> Unit:
    """Note what the tail antenna read; the second tag of a pair proves the exit from the first's block (T2).

    ``healthy``: the through line reaches the tail, so that the antenna is the train's last (T2, T3).
    A partial or reversed pair, another antenna or a broken line prove nothing; nor do two reads
    of which a change of ends lies between, so that two cabs made them.
    """
    if antenna != Antenna.TAIL:
        return unit
    if not healthy:
        return replace(unit, tail_read=None)
    before = unit.tail_read
    if before is None or unit.tail_cab != cab or layout.partner.get(before.tag) != read.tag:
        return replace(unit, tail_read=read, tail_cab=cab)
    block = layout.tag_in.get(before.tag)
    if block is None:
        return replace(unit, tail_read=read, tail_cab=cab)
    return replace(
        unit,
        tail_read=read,
        tail_cab=cab,
        occupied=unit.occupied - {block},
        orders={
            run: replace(order, left=order.left | {block: Evidence(left=before, entered=read)})
            if order.begun and order.loop_closed
            else order
            for run, order in unit.orders.items()
        },
    )


def reports_left(layout: Layout, unit: Unit, run: Run, block: Block, left: Read, entered: Read) -> bool:
    """Tell whether the unit reports that its tail has left ``block``, and by which reads (third loop; T6, T7).

    A block is reported once the tail has left the end of its part too.
    """
    order = unit.orders.get(run)
    if order is None:
        return False
    evidence = order.left.get(block)
    if evidence is None or evidence.left != left or evidence.entered != entered:
        return False
    after = layout.released_after[run.route].get(block) if run.route in layout.released_after else None
    return after is None or after in order.left
