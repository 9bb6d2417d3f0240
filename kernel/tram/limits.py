"""Whether what is written for a line and its trams may be used: asked before a centre or a unit is (G2 to G5)."""

from __future__ import annotations

from kernel.tram.dispatching import DispatchLimits
from kernel.tram.stopping import StopLimits


def are_lawful(limits: DispatchLimits) -> bool:
    """Tell whether a line may be run by these limits; if not, its centre is not put into service (G3 to G5)."""
    return (
        limits.ahead_hold_ms >= 0
        and limits.behind_hold_ms >= 0
        and limits.longest_hold_ms >= 0
        and limits.recovery_ms >= 0
        and limits.fresh_ms >= 0
        and limits.order_ms >= 0
        and limits.coming_ms >= 0
    )


def are_lawful_at_stops(limits: StopLimits, error_mm: int) -> bool:
    """Tell whether a unit may run by these limits where places err by so much; if not, it is not put to use (G2).

    Near a stop is at least as far as that: else a tram could be told beyond one that it has not come to.  A place is
    held for what one error to one side, and one to the other, make of it.
    """
    return 0 <= error_mm <= limits.near_mm and limits.near_mm + 2 * error_mm <= limits.held_mm


def are_told_apart(limits: StopLimits, error_mm: int, apart_mm: int) -> bool:
    """Tell whether a way may be run whose stops are that far apart at the least; if not, it is not put to use (G2).

    A tram that is held at a stop may be so far beyond it, and one is told at the next so far before that: who has come
    to a later stop is ahead of who stands at this one.
    """
    return limits.held_mm + limits.near_mm + 2 * error_mm < apart_mm
