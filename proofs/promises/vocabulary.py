"""Words that several promises share."""

from __future__ import annotations

from kernel.names import Block, Run, Train, UnitLife
from kernel.unit import Order
from models.world.state import System


def lives(system: System, train: Train, life: UnitLife) -> bool:
    """The train's unit is in this life; a restart ends it for good (T8)."""
    unit = system.units.get(train)
    return unit is not None and unit.life == life


def order_of(system: System, run: Run) -> Order | None:
    """What the train's unit knows of the run, in the life that the run was granted to."""
    unit = system.units.get(run.train)
    return None if unit is None or unit.life != run.life else unit.orders.get(run)


def holds(system: System, run: Run, block: Block) -> bool:
    """The centre holds the block for the run."""
    return run in system.centre.claimed.get(block, frozenset())


def can_be_told(system: System, run: Run) -> bool:
    """The unit is in the life that the run was granted to, and knows under which run it stands."""
    unit = system.units.get(run.train)
    return unit is not None and unit.life == run.life and any(True for _ in unit.orders)


def has_no_authority_left(system: System, run: Run) -> bool:
    """The unit may not proceed under the run any more, by the causes that there are (T4, T5, T9).

    It restarts, its second loop is open, the run was asked back before it was begun, or given back, or a later one
    has begun.
    """
    unit, order = system.units.get(run.train), order_of(system, run)
    return (
        unit is None
        or order is None
        or unit.loop_open
        or order.given_back
        or (order.recalled and not order.begun)
        or any(other.serial > run.serial and later.begun for other, later in unit.orders.items())
    )
