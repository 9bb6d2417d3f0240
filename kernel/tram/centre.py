"""The centre: all trams of a way, and the orders that follow from what they told (G4, G5, G6).

A tram comes onto the way after the centre has confirmed it.  Whether others are ahead is told by reports alone:
neither the timetable nor a destination clears a way (ours).  After a start the centre knows nothing; the way is
clear of what it does not know as far as a tram has run that came at the first stop since.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import NamedTuple, NewType

from kernel.maps import Map
from kernel.onboard.arithmetic import larger
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

    ``now_ms``: GPS time.  ``opens_ms``: no tram comes after that by a confirmation from before the start.
    ``cleared``: the mark up to which no tram is that the centre does not know.
    ``trams``: what is known of each.  ``left_ms``: when each was told to have left a stop.
    ``shown``: pairs of trams, the first of which is shown to be ahead of the other.
    ``elsewhere_ms``: when a tram has told from elsewhere last: another way, its depot.
    """

    now_ms: int
    opens_ms: int
    cleared: int
    trams: Map[Tram, Known]
    left_ms: Map[tuple[Tram, int], int]
    shown: frozenset[tuple[Tram, Tram]]
    elsewhere_ms: Map[Tram, int]


def restarted(limits: DispatchLimits, centre: Centre, now_ms: int) -> Centre:
    """Give the state after a start: nothing of it survives; trams may be anywhere, others still come (G6, ours)."""
    return Centre(
        now_ms=now_ms,
        opens_ms=now_ms + limits.coming_ms,
        cleared=machine.NOTHING_CLEARED,
        trams={},
        left_ms={},
        shown=frozenset(),
        elsewhere_ms={},
    )


def later(centre: Centre, elapsed_ms: int) -> Centre:
    """Let time pass (G3)."""
    return replace(centre, now_ms=centre.now_ms + elapsed_ms)


def may_come(centre: Centre, tram: Tram, stop: int) -> bool:
    """Tell whether a tram may be confirmed: it is not on the way, and none behind may run faster to there (G5, ours).

    That it is not on the way it has told itself, from elsewhere.  At the first stop it comes behind all others.
    """
    if tram in centre.trams or tram not in centre.elsewhere_ms or stop < machine.FIRST_STOP:
        return False
    return stop == machine.FIRST_STOP or (
        centre.cleared > machine.mark(stop, True)
        and not any(machine.may_recover_over(known, stop) for _other, known in centre.trams.items())
    )


def note_coming(centre: Centre, tram: Tram, stop: int, leaves_at: int) -> Centre:
    """Take up a tram that is to come onto the way at a stop, if it may (G5, ours)."""
    if not may_come(centre, tram, stop):
        return centre
    ahead = {(other, tram) for other, known in centre.trams.items() if machine.is_before_who_comes(known, stop)}
    return replace(
        centre,
        trams=centre.trams | {tram: machine.coming(centre.now_ms, stop, leaves_at)},
        shown=centre.shown | ahead,
    )


def without(centre: Centre, tram: Tram, made_ms: int) -> Centre:
    """Forget a tram's run, which has ended (G5, ours)."""
    return replace(
        centre,
        trams={other: known for other, known in centre.trams.items() if other != tram},
        shown=frozenset((ahead, behind) for ahead, behind in centre.shown if tram not in (ahead, behind)),
        elsewhere_ms=centre.elsewhere_ms | {tram: made_ms},
    )


def note_elsewhere(centre: Centre, tram: Tram, is_away: bool, made_ms: int) -> Centre:
    """Take what a tram tells from elsewhere: its run has ended, if it was under way before (G5, ours).

    ``is_away``: it has left a stop of the other way, or is in its depot.  Who has not may stand at a platform of this
    way, where its driver has chosen the way back, or a wrong one.
    """
    if not is_away or not centre.opens_ms < made_ms <= centre.now_ms:
        return centre
    if tram in centre.trams and not machine.is_off(centre.trams[tram], made_ms):
        return centre
    return without(centre, tram, made_ms)


def note_taken_off(centre: Centre, tram: Tram) -> Centre:
    """Take a person's word that a tram is off the way, where its radio does not tell (G5, ours).

    Of one that the centre does not know too, or one without radio could never be confirmed; after a start not before
    confirmations from before that have lapsed.
    """
    return without(centre, tram, centre.now_ms) if centre.opens_ms < centre.now_ms else centre


def note_begun(centre: Centre, tram: Tram, known: Known, report: Report) -> Centre:
    """Take from a report that does not count that the unit has begun since its tram was confirmed, if so (G2)."""
    if not machine.begins(centre.now_ms, known, report):
        return centre
    return replace(centre, trams=centre.trams | {tram: machine.begun(known, report)})


def note_report(centre: Centre, tram: Tram, report: Report) -> Centre:
    """Take a tram's report, if it counts; one of a tram that is not known does not (G2, G3, G6).

    The way is cleared by what tells that a stop was left, and by nothing else: who has left this way, or has not come
    yet, may tell of stops beside which it is (ours).
    """
    if tram not in centre.trams:
        return centre
    known = centre.trams[tram]
    if not machine.counts(centre.now_ms, known, report):
        return note_begun(centre, tram, known, report)
    left_ms = (
        centre.left_ms | {(tram, machine.stop_left(report)): report.made_ms}
        if machine.tells_a_departure(known, report)
        else centre.left_ms
    )
    ahead = {(other, tram) for other, farther in centre.trams.items() if machine.was_beyond(farther, report)}
    told = machine.mark(report.stop, True)
    return replace(
        centre,
        trams=centre.trams | {tram: machine.reported(known, report)},
        left_ms=left_ms,
        shown=centre.shown | ahead,
        cleared=larger(centre.cleared, told) if report.left and machine.clears(known) else centre.cleared,
    )


# ---- in what order trams run


def contradicts(centre: Centre, tram: Tram, other: Tram) -> bool:
    """Tell whether two trams have been shown in either order: somebody tells what is not so (G2, G6)."""
    return (tram, other) in centre.shown and (other, tram) in centre.shown


# ---- the order for a tram


def is_out_of_the_way(centre: Centre, tram: Tram, own: Known, other: Tram, known: Known) -> bool:
    """Tell whether a tram has left the next stop, or is shown to run behind this one (002, 3.1.2; G2, G5).

    Not if the two have been shown in either order: then what one of them tells of where it is may not be so.
    """
    return not contradicts(centre, tram, other) and (machine.has_passed(own, known) or (tram, other) in centre.shown)


def is_clear(centre: Centre, tram: Tram, own: Known) -> bool:
    """Tell whether no tram may be before the next stop, or at it: not knowing counts as present (G5)."""
    return machine.is_cleared(own, centre.cleared) and all(
        other == tram or is_out_of_the_way(centre, tram, own, other, known) for other, known in centre.trams.items()
    )


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
