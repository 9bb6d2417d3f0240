"""When a tram at a stop is held, and when it may run faster to the next one (G4, G5).

Data and commands pass only at stops (paper 002, 2.2), so that nothing is ahead follows from arrivals and
departures alone.  Trams do not run backwards: where one was reported it is now, or farther on.  So a
report that is late, or lost, makes a tram count as present for longer, and never for less long.

The way is a row of stops, numbered from 0 as they follow; the section after a stop bears its number.  Neither
the timetable's order nor a destination says that a way is clear: a wrong setting is routine.  Times are those
of GPS, in ms.  Reckoned in 64 bits for stops to 2**61 and times to 2**62.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from enum import Enum

from kernel.onboard.arithmetic import larger


@dataclass(frozen=True)
class DispatchLimits:
    """What is written for a line, in ms, none below 0 (G3, G4, G5).

    ``ahead_hold_ms``: a tram is held if the one ahead left this stop less long ago; 0: never for that.
    ``behind_hold_ms``: it is held if the one behind it is farther behind; at its greatest: never for that.
    ``longest_hold_ms``: no longer than that at one stop by itself (ours).
    ``recovery_ms``: it may recover if the one ahead left this stop as long ago, or longer.
    ``fresh_ms``: so old a report still counts for a command (G3, ours: 11 s).
    ``order_ms``: so old a command still counts for a tram at a stop (G3, ours).
    ``coming_ms``: so long after it was confirmed a tram comes onto the way at the latest (G5, ours).
    """

    ahead_hold_ms: int
    behind_hold_ms: int
    longest_hold_ms: int
    recovery_ms: int
    fresh_ms: int
    order_ms: int
    coming_ms: int


@dataclass(frozen=True)
class Known:
    """What the centre knows of a tram on the way (G2, G4, G5).

    ``leaves_at``: the last stop of this way that it comes to, by the farthest destination that was told.
    ``since_ms``: since when the centre has known of this run; what was told before is of another one.
    ``stop``, ``left``: it has reached that stop, and left it.  ``stands``: it stood there.
    ``arrived_ms``: when it first told of that stop.  ``told_ms``: when it has told last; as ``since_ms`` before that.
    ``recovery_to``: the stop to which it was last ordered to recover; one that it has reached if to none.
    ``comes_at``: the stop for which it was confirmed.
    """

    leaves_at: int
    since_ms: int
    stop: int
    left: bool
    stands: bool
    arrived_ms: int
    told_ms: int
    recovery_to: int
    comes_at: int


@dataclass(frozen=True)
class Report:
    """What a tram tells at a stop, as at ``made_ms`` (table 1; G3)."""

    stop: int
    left: bool
    stands: bool
    leaves_at: int
    made_ms: int


@dataclass(frozen=True)
class View:
    """What a decision for a tram rests on beside itself (G4, G5).

    ``is_clear``: every tram has told that it left the next stop, or is shown to run behind; and so must those
    that the centre does not know.
    ``is_present``: one ahead is known to be before the next stop.
    ``ahead_is_far``: none was told to have left this stop too lately; ``ahead_is_near``: one was, for the hold.
    ``behind_is_far``: there are trams behind, and none of them near.
    """

    is_clear: bool
    is_present: bool
    ahead_is_far: bool
    ahead_is_near: bool
    behind_is_far: bool


FIRST_STOP = 0
"""Where the way begins: who comes here comes behind all that are on it."""
NOTHING_CLEARED = -1
"""Below every mark: after a start trams that the centre does not know may be anywhere."""


class Hand(Enum):
    """What the dispatcher orders by hand (002, 3.2)."""

    NOTHING = 0
    HOLD = 1
    RECOVER = 2
    LIFT = 3
    """解除: neither, whatever the rules say."""


@dataclass(frozen=True)
class Order:
    """A command to a tram at a stop, as at ``made_ms``: neither field set lifts what was (G4, G5)."""

    stop: int
    holds: bool
    recovers: bool
    made_ms: int


# ---- what is known of a tram


def mark(stop: int, left: bool) -> int:
    """Number the places of the way: even at a stop, odd in the section after it; greater is farther on (G2)."""
    return 2 * stop + (1 if left else 0)


def coming(now_ms: int, stop: int, leaves_at: int) -> Known:
    """Give what is known of a tram that is to come onto the way at a stop (G5; ours)."""
    return Known(
        leaves_at=leaves_at,
        since_ms=now_ms,
        stop=stop,
        left=False,
        stands=False,
        arrived_ms=now_ms,
        told_ms=now_ms,
        recovery_to=stop,
        comes_at=stop,
    )


def is_new(now_ms: int, known: Known, report: Report) -> bool:
    """Tell whether a report is of this run by its time, newer than the last one, and not of the future (G3)."""
    return known.told_ms < report.made_ms <= now_ms


def counts(now_ms: int, known: Known, report: Report) -> bool:
    """Tell whether a report is taken (G3, G6).

    It must be new, and trams do not run backwards.  Before the tram is known to be under way it is of the stop where it
    is to come, since its driver may have set this way too soon, beside another stop of it.  That it has left a stop
    counts only from a unit that has told since the tram was confirmed of one that it had not left: else it may be of
    the run before, which the unit was never set anew from (ours).
    What is refused leaves the tram to become unknown.
    """
    begins_there = not report.left and report.stop == known.comes_at
    leaves = report.left and has_begun(known)
    return (
        is_new(now_ms, known, report)
        and mark(report.stop, report.left) >= mark(known.stop, known.left)
        and (is_under_way(known) or begins_there or leaves)
    )


def begins(now_ms: int, known: Known, report: Report) -> bool:
    """Tell whether a unit has begun since its tram was confirmed: of the run before it tells no more (G2, ours)."""
    return is_new(now_ms, known, report) and not report.left and not is_under_way(known)


def begun(known: Known, report: Report) -> Known:
    """Note that a unit has begun; where its tram is that tells nothing, nor that it still stands (G2, ours)."""
    return replace(known, stands=False, told_ms=report.made_ms)


def reported(known: Known, report: Report) -> Known:
    """Give what is known after a report that counts (G2, G5).

    Of two destinations the farther one counts: the tram may still be on the way then.  It has been at a stop since it
    first told of it, whether it is seen to stand in each report or not: under a roof it is not, and held no longer.
    """
    was_there = known.arrived_ms > known.since_ms and known.stop == report.stop
    return replace(
        known,
        leaves_at=larger(known.leaves_at, report.leaves_at),
        stop=report.stop,
        left=report.left,
        stands=report.stands,
        arrived_ms=known.arrived_ms if was_there else report.made_ms,
        told_ms=report.made_ms,
    )


def stop_left(report: Report) -> int:
    """Give the stop that a tram has left last, by its report (G4)."""
    return report.stop if report.left else report.stop - 1


def tells_a_departure(known: Known, report: Report) -> bool:
    """Tell whether it was not known yet that it has left that stop: its departure may have been lost (G4)."""
    return mark(stop_left(report), True) > mark(known.stop, known.left)


# ---- one tram beside another


def has_begun(known: Known) -> bool:
    """Tell whether a tram's unit has told, since the tram was confirmed, of a stop that it had not left (G2, ours)."""
    return known.told_ms > known.since_ms


def is_under_way(known: Known) -> bool:
    """Tell whether a tram has told on this run that it left a stop: then it has come onto the way (G2, ours).

    A unit tells so of none but the way that its tram is on; that it has come to a stop it tells beside it too.
    """
    return mark(known.stop, known.left) > mark(known.comes_at, False)


def clears(known: Known) -> bool:
    """Tell whether all trams that the centre does not know run ahead of this one: it came at the first stop (G5)."""
    return known.comes_at == FIRST_STOP


def was_beyond(ahead: Known, report: Report) -> bool:
    """Tell whether a tram had told of a later stop before another one stood at this one: so it is ahead (G2).

    None overtakes on one track, so it stays ahead (002, 3.1.2).  That it had left this stop is not enough: where trams
    queue at a signal just beyond, GPS has the one behind leave while the one in front still stands there (ours).
    """
    return report.stands and ahead.stop > report.stop and is_under_way(ahead) and ahead.told_ms < report.made_ms


def is_before_who_comes(known: Known, stop: int) -> bool:
    """Tell whether a tram on the way is ahead of one that is confirmed to come at a stop (G2, ours).

    It has told of a later stop: the points where trams come may lie beyond this one.  At the first stop it is enough to
    be under way, since who comes there comes behind all.
    """
    return is_under_way(known) and (stop == FIRST_STOP or known.stop > stop)


def is_ahead(own: Known, other: Known) -> bool:
    """Tell whether a tram is ahead for a hold: reported farther on, or standing at the stop since before (G4)."""
    at_own, at_other = mark(own.stop, own.left), mark(other.stop, other.left)
    return at_other > at_own or (at_other == at_own and other.arrived_ms <= own.arrived_ms)


def shares_the_way(own: Known, other: Known) -> bool:
    """Tell whether another tram, as it says, runs on beyond the stop where this one stands (002, 4.2; G4)."""
    return other.leaves_at > own.stop


def is_beyond_its_destination(known: Known) -> bool:
    """Tell whether a tram has told that it is beyond where its destination has it leave: a wrong setting (G4)."""
    return mark(known.stop, known.left) > mark(known.leaves_at, False)


def has_passed(own: Known, other: Known) -> bool:
    """Tell whether another tram is known to have left the next stop (G5; ours: one that stands there is present)."""
    return mark(other.stop, other.left) > mark(own.stop + 1, False)


def is_cleared(own: Known, cleared: int) -> bool:
    """Tell whether all trams that the centre does not know have left the next stop (G5, ours)."""
    return cleared > mark(own.stop + 1, False)


def is_seen_in_the_way(limits: DispatchLimits, now_ms: int, own: Known, other: Known) -> bool:
    """Tell whether a tram ahead is known to stand at the same stop, or to have left it for the next (002, 4.2; G4).

    Of one that was told to have left as long ago as recovery needs it is not known any more where it is: it
    forbids recovery, and is no reason to hold.
    """
    runs_on = shares_the_way(own, other) or is_beyond_its_destination(other)
    if not (is_ahead(own, other) and runs_on) or other.stop != own.stop:
        return False
    return now_ms - other.told_ms < limits.recovery_ms if other.left else is_fresh(limits, now_ms, other)


def may_recover_over(own: Known, stop: int) -> bool:
    """Tell whether a tram may still run, by its last order, over the stop at which another is to come, or from it (G5).

    The points where that one comes may lie beyond the stop.
    """
    may_recover = mark(own.stop, own.left) < mark(own.recovery_to, False)
    return may_recover and own.stop <= stop <= own.recovery_to


def is_off(known: Known, made_ms: int) -> bool:
    """Tell whether what a tram tells from elsewhere ends its run: it was under way before that (G5, ours)."""
    return is_under_way(known) and made_ms > known.told_ms


def is_known_since(known: Known, left_ms: int) -> bool:
    """Tell whether a departure is of this run (G4)."""
    return left_ms > known.since_ms


# ---- the decision


def is_fresh(limits: DispatchLimits, now_ms: int, known: Known) -> bool:
    """Tell whether a tram's last report still counts for a command, and said that it stood (G3)."""
    return known.stands and now_ms - known.told_ms <= limits.fresh_ms


def is_held_by_itself(limits: DispatchLimits, now_ms: int, own: Known, view: View) -> bool:
    """Tell whether the rules hold a tram: too near the one ahead, too far from the one behind (002, 3.2.1; G4)."""
    return now_ms - own.arrived_ms < limits.longest_hold_ms and (
        view.is_present or view.ahead_is_near or view.behind_is_far
    )


def decided(limits: DispatchLimits, now_ms: int, own: Known, view: View, hand: Hand) -> Order:
    """Give the order for a tram (G4, G5): hold beats recovery; what is not known gives no command.

    Nor is there one where a tram leaves the way: what is ahead of it there nobody here knows.  None recovers from the
    stop where it comes: it may not have come yet, and another one before it (ours).
    """
    nothing = Order(stop=own.stop, holds=False, recovers=False, made_ms=now_ms)
    if not is_fresh(limits, now_ms, own) or hand == Hand.LIFT or own.stop >= own.leaves_at:
        return nothing
    if hand == Hand.HOLD or is_held_by_itself(limits, now_ms, own, view):
        return replace(nothing, holds=True)
    may_recover = is_under_way(own) and view.is_clear
    return replace(nothing, recovers=may_recover and (view.ahead_is_far or hand == Hand.RECOVER))


def ordered(known: Known, order: Order) -> Known:
    """Note to which stop a tram may run faster now (G5)."""
    return replace(known, recovery_to=order.stop + 1 if order.recovers else known.recovery_to)
