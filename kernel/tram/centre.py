"""The centre: all trams of a way, and the orders that follow from what they told (G4, G5, G6).

Every tram is told to the centre before it comes onto the way: one that it does not know could be
anywhere (ours).  In what order trams run is said then, and no report turns it round (002, 3.1.2).
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import NamedTuple, NewType

from kernel.maps import Map
from kernel.tram import dispatching as machine
from kernel.tram.dispatching import DispatchLimits, Hand, Known, Order, Report, View
from kernel.tram.display import Display, taken

Tram = NewType("Tram", str)
"""A tram by its vehicle number (table 1)."""


class Command(NamedTuple):
    """An order as it is sent, with the tram that it is for (table 1; G3)."""

    tram: Tram
    stop: int
    holds: bool
    recovers: bool
    made_ms: int


@dataclass(frozen=True)
class Centre:
    """All that the centre decides from.

    ``now_ms``: GPS time.  ``trams``: what is known of each.  ``left_ms``: when each was told to have left a stop.
    """

    now_ms: int
    trams: Map[Tram, Known]
    left_ms: Map[tuple[Tram, int], int]


def later(centre: Centre, elapsed_ms: int) -> Centre:
    """Let time pass (G3)."""
    return replace(centre, now_ms=centre.now_ms + elapsed_ms)


def may_come(centre: Centre, tram: Tram, turn: int, stop: int, leaves_at: int) -> bool:
    """Tell whether a tram may be taken up in this turn: none behind it may yet run faster to that place (G5, ours)."""
    return not any(
        other != tram and known.turn >= turn and machine.may_recover_over(known, stop, leaves_at)
        for other, known in centre.trams.items()
    )


def note_coming(centre: Centre, tram: Tram, turn: int, stop: int, leaves_at: int) -> Centre:
    """Take up a tram that is to come onto the way, if it may (G5, ours)."""
    if not may_come(centre, tram, turn, stop, leaves_at):
        return centre
    return replace(centre, trams=centre.trams | {tram: machine.coming(centre.now_ms, turn, stop, leaves_at)})


def note_report(centre: Centre, tram: Tram, report: Report) -> Centre:
    """Take a tram's report, if it counts; one of a tram that is not known does not (G2, G3, G6)."""
    if tram not in centre.trams or not machine.counts(centre.now_ms, centre.trams[tram], report):
        return centre
    known = centre.trams[tram]
    left_ms = (
        centre.left_ms | {(tram, machine.stop_left(report)): report.made_ms}
        if machine.tells_a_departure(known, report)
        else centre.left_ms
    )
    return replace(centre, trams=centre.trams | {tram: machine.reported(known, report)}, left_ms=left_ms)


# ---- the order for a tram


def is_clear(centre: Centre, tram: Tram, own: Known) -> bool:
    """Tell whether no tram may be before the next stop, or at it (G5)."""
    return all(other == tram or not machine.may_be_in_the_way(own, known) for other, known in centre.trams.items())


def is_present(limits: DispatchLimits, centre: Centre, tram: Tram, own: Known) -> bool:
    """Tell whether a tram is known to be before the next stop (G4)."""
    return any(
        other != tram and machine.is_seen_in_the_way(limits, centre.now_ms, own, known)
        for other, known in centre.trams.items()
    )


def left_within(centre: Centre, own: Known, limit_ms: int) -> bool:
    """Tell whether a tram, on this run, left this stop less long ago: so it is ahead (G4, G5)."""
    return any(
        (other, own.stop) in centre.left_ms
        and machine.is_known_since(known, centre.left_ms[other, own.stop])
        and centre.now_ms - centre.left_ms[other, own.stop] < limit_ms
        for other, known in centre.trams.items()
    )


def is_near_behind(limits: DispatchLimits, centre: Centre, tram: Tram, own: Known, known: Known) -> bool:
    """Tell whether a tram behind is near, as far as is known: this one has not left its next stop long ago (G4)."""
    stop = known.stop + 1
    return (tram, stop) not in centre.left_ms or not (
        machine.is_known_since(own, centre.left_ms[tram, stop])
        and centre.now_ms - centre.left_ms[tram, stop] > limits.behind_hold_ms
    )


def behind_is_far(limits: DispatchLimits, centre: Centre, tram: Tram, own: Known) -> bool:
    """Tell whether there are trams behind, and all of them are far (G4)."""
    return any(not machine.is_ahead(own, known) for _other, known in centre.trams.items()) and all(
        machine.is_ahead(own, known) or not is_near_behind(limits, centre, tram, own, known)
        for _other, known in centre.trams.items()
    )


def view(limits: DispatchLimits, centre: Centre, tram: Tram, own: Known) -> View:
    """Give what a decision rests on (G4, G5)."""
    return View(
        is_clear=is_clear(centre, tram, own),
        is_present=is_present(limits, centre, tram, own),
        ahead_is_far=not left_within(centre, own, limits.recovery_ms),
        ahead_is_near=left_within(centre, own, limits.ahead_hold_ms),
        behind_is_far=behind_is_far(limits, centre, tram, own),
    )


def order(limits: DispatchLimits, centre: Centre, tram: Tram, hand: Hand) -> Order:
    """Give the order for a tram; none for one that is not known (G4, G5, G6)."""
    if tram not in centre.trams:
        return Order(stop=0, holds=False, recovers=False, made_ms=centre.now_ms)
    own = centre.trams[tram]
    return machine.decided(limits, centre.now_ms, own, view(limits, centre, tram, own), hand)


def note_ordered(centre: Centre, tram: Tram, made: Order) -> Centre:
    """Note an order that goes out (G5)."""
    if tram not in centre.trams:
        return centre
    return replace(centre, trams=centre.trams | {tram: machine.ordered(centre.trams[tram], made)})


def order_in(command: Command) -> Order:
    """Give the order in a command (G3)."""
    return Order(stop=command.stop, holds=command.holds, recovers=command.recovers, made_ms=command.made_ms)


def received(limits: DispatchLimits, tram: Tram, display: Display, command: Command) -> Display:
    """Take a command on board, if it is for this tram (G3, G6)."""
    if command.tram != tram:
        return display
    return taken(limits, display, order_in(command))
