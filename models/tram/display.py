"""What one driver is shown, whatever orders come through the air: of any time, for any stop, by anybody (G3, G6)."""

from __future__ import annotations

from dataclasses import dataclass, replace

from kernel.tram import display as machine
from kernel.tram.dispatching import DispatchLimits, Order
from kernel.tram.display import Display


@dataclass(frozen=True)
class Cab:
    """What does not change: the limits of the line (G3)."""

    limits: DispatchLimits


@dataclass(frozen=True)
class Shown:
    """One moment: GPS time, the unit's state, and a history: when the unit took its last order."""

    now_ms: int
    display: Display
    taken_ms: int


def time_runs_forward(elapsed_ms: int) -> bool:
    """GPS time does not go back (G3)."""
    return elapsed_ms >= 0


def pass_time(site: Cab, system: Shown, elapsed_ms: int) -> Shown:
    """Let time pass."""
    if not time_runs_forward(elapsed_ms):
        return system
    return replace(
        system,
        now_ms=system.now_ms + elapsed_ms,
        display=machine.older(site.limits, system.display, elapsed_ms),
    )


def take_place(site: Cab, system: Shown, is_located: bool, told_stop: int, stands: bool) -> Shown:
    """The unit finds its place, loses it, or sees the tram stand or move."""
    return replace(system, display=machine.located(system.display, is_located, told_stop, stands))


def hear(site: Cab, system: Shown, order: Order) -> Shown:
    """An order comes that names this tram: of another time too, from a centre whose clock is wrong."""
    display = machine.taken(site.limits, system.display, order)
    return replace(system, display=display, taken_ms=system.now_ms if display != system.display else system.taken_ms)


def restart(site: Cab, system: Shown) -> Shown:
    """The unit starts anew."""
    return replace(system, display=machine.begun(system.display.now_ms))
