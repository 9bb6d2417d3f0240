"""A ceiling of speed: the train has promised to run no faster, and its brake keeps it to that (X2, T12, ours).

A train promises a ceiling to a crossing ahead (:mod:`kernel.crossing.promise`), and what is promised holds while the
brake responds, too.  So the brake is demanded while the train would still get no faster than the ceiling before it is
slowed.  The motors are cut off with the brake, and sooner than that responds: from then on the train gains speed on a
descent alone.

Whoever promises nothing to a crossing is held there to the greatest speed of its line, with what a driver may exceed it
by; that is its ceiling then.  Where there are no crossings it has none.
"""

from __future__ import annotations

from dataclasses import dataclass

from kernel.onboard.arithmetic import GREATEST_SPEED_MM_S, LONGEST_CYCLE_MS, smaller
from kernel.onboard.braking import BrakeBounds


@dataclass(frozen=True)
class Ceiling:
    """What the train keeps to (X2).

    ``most_mm_s``: it runs no faster.
    """

    most_mm_s: int


NONE = Ceiling(2_000_000_000)
"""Of a train that is on no line with crossings: faster than any."""


def gained_um_s(bounds: BrakeBounds) -> int:
    """Give what the train gains at the most until a brake that is commanded a cycle from now responds (T12)."""
    driven = LONGEST_CYCLE_MS * (bounds.cut_cycles + 1) * bounds.gains_mm_s2
    return driven + LONGEST_CYCLE_MS * (bounds.response_cycles - bounds.cut_cycles) * bounds.falls_mm_s2


def is_kept(bounds: BrakeBounds, ceiling: Ceiling, speed_most_mm_s: int) -> bool:
    """Tell whether a train that brakes a cycle from now gets no faster than the ceiling (X2, T12).

    ``speed_most_mm_s``: as fast as it may be (P1); below 0, or beyond 200 m/s, it is no speed.
    """
    if not 0 <= speed_most_mm_s <= smaller(ceiling.most_mm_s, GREATEST_SPEED_MM_S):
        return False
    return 1000 * speed_most_mm_s <= 1000 * smaller(ceiling.most_mm_s, NONE.most_mm_s) - gained_um_s(bounds)


def take(bounds: BrakeBounds, held: Ceiling, ceiling: Ceiling, speed_most_mm_s: int) -> Ceiling:
    """Take a ceiling: a higher one, or one that the brake can still keep; else the one that is held stays (X2)."""
    if ceiling.most_mm_s >= held.most_mm_s or is_kept(bounds, ceiling, speed_most_mm_s):
        return ceiling
    return held
