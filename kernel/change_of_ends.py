"""Change of ends: the driver chooses the direction, so which cab leads; what was read before says nothing more (T2)."""

from __future__ import annotations

from dataclasses import replace

from kernel.names import Cab
from kernel.unit import Unit


def change_ends(unit: Unit, cab: Cab) -> Unit:
    """Take ``cab`` for the head, every other cab for the tail (T2).

    The tail's last read is forgotten: it was made on the way in the other direction, so it and
    the next one would not prove that the tail has left a block.  The head's is forgotten too,
    since the other head may read the same tag anew.
    """
    if unit.leading == cab:
        return unit
    return replace(unit, leading=cab, head_tag=None, tail_read=None)
