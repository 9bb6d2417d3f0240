"""A train that keeps to a ceiling of speed: what its brake control reckoned with when it last could (X2, T12)."""

from __future__ import annotations

from dataclasses import dataclass, replace

from kernel.onboard import ceiling
from kernel.onboard.braking import BrakeBounds
from models.onboard.units import UM_A_MM


@dataclass(frozen=True)
class Keeping:
    """One moment.

    ``cut_cycles``: until the motors are cut off, once the brake is commanded; ``falling_cycles``: from then on until
    the brake responds.
    ``worst_um_s``: history: how fast the train may get until then, by the last decision that the brake may be off, or
    by the last ceiling that was taken.
    """

    cut_cycles: int
    falling_cycles: int
    worst_um_s: int


AT_REST = Keeping(cut_cycles=0, falling_cycles=0, worst_um_s=0)
"""Of a train that stands, held by its brake."""


def begun(bounds: BrakeBounds, speed_most_mm_s: int) -> Keeping:
    """The brake may be commanded a cycle from now: note by which reckoning the ceiling is kept (T12)."""
    return Keeping(
        cut_cycles=bounds.cut_cycles,
        falling_cycles=bounds.response_cycles - bounds.cut_cycles,
        worst_um_s=UM_A_MM * speed_most_mm_s + ceiling.gained_um_s(bounds),
    )


def held(keeping: Keeping) -> Keeping:
    """The brake is on for a cycle (T12)."""
    if keeping.cut_cycles > 0:
        return replace(keeping, cut_cycles=keeping.cut_cycles - 1)
    if keeping.falling_cycles > 0:
        return replace(keeping, falling_cycles=keeping.falling_cycles - 1)
    return keeping


def response_cycles(keeping: Keeping) -> int:
    """Give how long the brake takes to respond (T12)."""
    return keeping.cut_cycles + keeping.falling_cycles
