"""What the driver of a tram is shown: held, or allowed to recover (G4, G5, G6).

The unit on board takes an order only where it stands, for that stop, while it is new.  It forgets all of
it as soon as it does not know where it is: a recovery that nobody ends would run on over the next stop.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

from kernel.tram.dispatching import DispatchLimits, Order


@dataclass(frozen=True)
class Display:
    """The unit's state.

    ``now_ms``: GPS time.  ``is_located``: it knows its place; ``stop``: the stop that it reached last;
    ``stands``: it stands there.  ``holds``, ``recovers``: what the driver is shown, by the order as at
    ``made_ms``; nothing older is taken.
    """

    now_ms: int
    is_located: bool
    stop: int
    stands: bool
    holds: bool
    recovers: bool
    made_ms: int


def begun(now_ms: int) -> Display:
    """Give the state in which a run begins: orders of the run before are too old (G6)."""
    return Display(now_ms=now_ms, is_located=False, stop=0, stands=False, holds=False, recovers=False, made_ms=now_ms)


def located(display: Display, is_located: bool, stop: int, stands: bool) -> Display:
    """Note the place: a recovery ends at the next stop, a hold where the tram moves, both where it is lost (G5, G6).

    A tram that comes to stand needs a new order, even at the stop that it has just begun to leave.
    """
    stays = is_located and stop == display.stop and (display.stands or not stands)
    return replace(
        display,
        is_located=is_located,
        stop=stop,
        stands=is_located and stands,
        holds=display.holds and stays and stands,
        recovers=display.recovers and stays,
    )


def older(limits: DispatchLimits, display: Display, elapsed_ms: int) -> Display:
    """Let time pass: at a stop an order that is not repeated lapses (G3, G6)."""
    now_ms = display.now_ms + elapsed_ms
    lapses = display.stands and now_ms - display.made_ms > limits.order_ms
    return replace(display, now_ms=now_ms, holds=display.holds and not lapses, recovers=display.recovers and not lapses)


def taken(limits: DispatchLimits, display: Display, order: Order) -> Display:
    """Take an order that is for this tram: only where it stands, for that stop, newer than the last, not old (G6).

    Nor one of the future: it would not lapse in time, and every later one would be older than it.
    """
    if not display.stands or order.stop != display.stop or order.made_ms <= display.made_ms:
        return display
    if not display.now_ms - limits.order_ms <= order.made_ms <= display.now_ms:
        return display
    return replace(display, holds=order.holds, recovers=order.recovers, made_ms=order.made_ms)
