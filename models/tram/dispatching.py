"""Trams on a way, what the centre knows of them, and what drivers are shown, beside what is really so (G4 to G6).

Any number of trams and stops.  Trams move from stop to stop at will, held or not, in whatever order they came,
and as far as they like: what drivers are shown is an aid, and destinations are wrong.  Reports come late, again,
out of order or not at all, and so do orders; a tram loses its place at any time; the centre and the units start
anew at any moment.  What is not so by nature stands below as an assumption.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

from kernel.maps import Map
from kernel.tram import centre as machine
from kernel.tram import display as on_board
from kernel.tram import limits
from kernel.tram.centre import Centre, Command, Tram
from kernel.tram.dispatching import DispatchLimits, Hand, Order, Report
from kernel.tram.display import Display


@dataclass(frozen=True)
class Way:
    """What does not change: the limits of the line (G4, G5)."""

    limits: DispatchLimits


@dataclass(frozen=True)
class Body:
    """A tram on the way as it is.

    ``rank``: its place in the order on the track, the first ahead; nobody is told it.
    ``stop``, ``left``: where it is.  ``display``: what its driver is shown.
    ``taken_at``: a history: where it stood when it took its last order.
    """

    rank: int
    stop: int
    left: bool
    display: Display
    taken_at: int


@dataclass(frozen=True)
class Run:
    """What was confirmed to who lets trams onto the way, and when: where a tram comes."""

    stop: int
    at_ms: int


@dataclass(frozen=True)
class Given:
    """A history: an order as it was made, and what was not known then.

    ``own_unknown``: where the tram was; ``way_unknown``: whether each tram truly ahead had left the next stop.
    """

    holds: bool
    recovers: bool
    own_unknown: bool
    way_unknown: bool


@dataclass(frozen=True)
class Traffic:
    """One moment: GPS time, every tram on the way, what the centre knows, every message ever sent, and the last order.

    ``runs``: for each tram a run that was confirmed, until it comes.
    ``gone_at``: of those that have left the way, where they were when they did.
    ``unset``: trams that were confirmed, and of whose units nothing shows yet that they tell no more of a run before.
    ``told``: what trams have told of the way while they were on it, and of the same run after that.
    ``told_beside``: what they have told of it while they were not, and of a run before.
    ``told_elsewhere``: when they have told from elsewhere that they were away.
    """

    now_ms: int
    bodies: Map[Tram, Body]
    runs: Map[Tram, Run]
    gone_at: Map[Tram, int]
    unset: frozenset[Tram]
    centre: Centre
    told: frozenset[tuple[Tram, Report]]
    told_beside: frozenset[tuple[Tram, Report]]
    told_elsewhere: frozenset[tuple[Tram, int]]
    sent: frozenset[Command]
    given: Given


def mark(stop: int, left: bool) -> int:
    """Number the places of the way: even at a stop, odd in the section after it; greater is farther on (G2)."""
    return 2 * stop + (1 if left else 0)


def place(body: Body) -> int:
    """Give where a tram is on the way (G2)."""
    return mark(body.stop, body.left)


def may_still_come(site: Way, system: Traffic, tram: Tram) -> bool:
    """Tell whether a tram may yet come onto the way by a confirmation that it has."""
    return tram in system.runs and system.now_ms <= system.runs[tram].at_ms + site.limits.coming_ms


def is_unknown(site: Way, system: Traffic, tram: Tram) -> bool:
    """Tell whether the centre does not know, by a report that is new enough, that a tram stands at its stop (G3)."""
    trams, now_ms = system.centre.trams, system.now_ms
    return tram not in trams or not trams[tram].stands or now_ms - trams[tram].told_ms > site.limits.fresh_ms


def is_way_unknown(system: Traffic, tram: Tram) -> bool:
    """Tell whether a tram is truly ahead of this one that has not left the stop after the one reported (G5)."""
    trams, bodies = system.centre.trams, system.bodies
    return (
        tram in trams
        and tram in bodies
        and any(
            body.rank < bodies[tram].rank and place(body) <= mark(trams[tram].stop + 1, False)
            for _other, body in bodies.items()
        )
    )


# ---- assumptions


def time_runs_forward(elapsed_ms: int) -> bool:
    """GPS time does not go back (G3)."""
    return elapsed_ms >= 0


def clocks_keep_gps_time(system: Traffic, now_ms: int) -> bool:
    """A unit, and the centre, start with GPS time (G3)."""
    return now_ms == system.now_ms


def a_tram_comes_where_and_when_it_was_confirmed(site: Way, system: Traffic, tram: Tram, body: Body) -> bool:
    """A tram comes onto the way at the stop for which it was confirmed, or just beyond it, before that lapses."""
    return tram not in system.bodies and may_still_come(site, system, tram) and body.stop == system.runs[tram].stop


def its_unit_began_since_it_was_confirmed(system: Traffic, tram: Tram, begun_ms: int) -> bool:
    """A tram's unit began the run since it was confirmed, or what was made for it before does not count any more."""
    return tram in system.runs and system.runs[tram].at_ms <= begun_ms <= system.now_ms


def who_begins_at_the_first_stop_is_last(system: Traffic, tram: Tram, body: Body) -> bool:
    """The way begins at stop 0: who comes there comes behind all that are on the way."""
    return system.runs[tram].stop != 0 or all(other.rank < body.rank for _other, other in system.bodies.items())


def none_overtakes(bodies: Map[Tram, Body], tram: Tram, there: Body) -> bool:
    """A tram comes, and runs, behind those ahead of it and before those behind: none overtakes on one track (G2)."""
    return all(
        other == tram
        or (body.rank < there.rank and place(body) >= place(there))
        or (body.rank > there.rank and place(body) <= place(there))
        for other, body in bodies.items()
    )


def who_is_taken_off_is_off_the_way(site: Way, system: Traffic, tram: Tram) -> bool:
    """A person takes off only a tram that is not on the way, and has no confirmation to come (ours)."""
    return tram not in system.bodies and not may_still_come(site, system, tram)


def a_known_place_shows_the_stop(display: Display, noticed: bool) -> bool:
    """A unit that knows its place notices the stop that it comes to (G1, G2)."""
    return noticed or not display.is_located


def a_located_tram_knows_its_stop(system: Traffic, tram: Tram, is_located: bool, told_stop: int) -> bool:
    """The stop that a unit takes for the last one is the last one (G1, G2)."""
    return not is_located or told_stop == system.bodies[tram].stop


def it_knows_the_stop_that_it_comes_to(system: Traffic, tram: Tram, noticed: bool, told_stop: int) -> bool:
    """And so is the one that it comes to (G1, G2)."""
    return not noticed or told_stop == system.bodies[tram].stop + 1


def a_report_tells_where_it_is(system: Traffic, tram: Tram, report: Report) -> bool:
    """A tram on the way tells a place that it has reached, at the time that it is (G2).

    Who stands is at that stop, or so little beyond that another one has left it there.
    """
    if tram not in system.bodies or report.made_ms != system.now_ms:
        return False
    body = system.bodies[tram]
    if report.stands:
        return not report.left and report.stop == body.stop
    return mark(report.stop, report.left) <= place(body)


def beside_the_way_no_stop_is_left(system: Traffic, tram: Tram, report: Report) -> bool:
    """A tram that is not on the way, but set to it, tells of no stop of it that it leaves, at the time that it is."""
    return tram not in system.bodies and report.made_ms == system.now_ms and not report.left


def what_it_left_it_had_left(system: Traffic, tram: Tram, report: Report) -> bool:
    """Who has turned off the way may go on to tell that it has left a stop of it, one that it had truly left (G2)."""
    return (
        tram in system.gone_at
        and report.made_ms == system.now_ms
        and report.left
        and mark(report.stop, True) <= system.gone_at[tram]
    )


def of_a_run_before_it_tells_that_it_left(system: Traffic, tram: Tram, report: Report) -> bool:
    """A unit that is not set anew between two runs tells of the one before, and no more once it was seen at a stop."""
    return tram in system.unset and report.made_ms == system.now_ms and report.left


def only_who_is_elsewhere_tells_so(system: Traffic, tram: Tram) -> bool:
    """A tram that is on the way tells nothing of its depot, and of another way no stop that it has left (G3)."""
    return tram not in system.bodies


def only_what_was_told_is_heard(system: Traffic, tram: Tram, told: Report) -> bool:
    """A report that passes the frame's checks was made by that tram (G3)."""
    return (tram, told) in system.told or (tram, told) in system.told_beside


def only_what_was_told_elsewhere_is_heard(system: Traffic, tram: Tram, is_away: bool, made_ms: int) -> bool:
    """And so was what comes from elsewhere of one that is away (G3)."""
    return not is_away or (tram, made_ms) in system.told_elsewhere


def the_frame_carries_the_order(tram: Tram, order: Order, command: Command) -> bool:
    """What goes out is what was ordered, for the tram that it was ordered for (G3)."""
    return (
        command.tram == tram
        and command.stop == order.stop
        and command.holds == order.holds
        and command.recovers == order.recovers
        and command.made_ms == order.made_ms
    )


def only_what_was_sent_arrives(system: Traffic, command: Command) -> bool:
    """The radio makes no commands: a frame that passes its checks was sent (G3)."""
    return command in system.sent


# ---- time and trams


def pass_time(site: Way, system: Traffic, elapsed_ms: int) -> Traffic:
    """Let time pass, at the centre and on board (G3)."""
    if not time_runs_forward(elapsed_ms):
        return system
    return replace(
        system,
        now_ms=system.now_ms + elapsed_ms,
        centre=machine.later(system.centre, elapsed_ms),
        bodies={
            tram: replace(body, display=on_board.older(site.limits, body.display, elapsed_ms))
            for tram, body in system.bodies.items()
        },
    )


def take_up(site: Way, system: Traffic, tram: Tram, stop: int, leaves_at: int) -> Traffic:
    """Ask the centre to confirm a tram that is to come, whoever asks, and wherever it is (ours)."""
    is_confirmed = machine.may_come(system.centre, tram, stop)
    if not is_confirmed:
        return replace(system, centre=machine.note_coming(system.centre, tram, stop, leaves_at))
    return replace(
        system,
        runs=system.runs | {tram: Run(stop, system.now_ms)},
        gone_at={other: at for other, at in system.gone_at.items() if other != tram},
        unset=system.unset | {tram},
        centre=machine.note_coming(system.centre, tram, stop, leaves_at),
    )


def come(site: Way, system: Traffic, tram: Tram, body: Body, now_ms: int, begun_ms: int) -> Traffic:
    """A tram comes onto the way; its unit begins anew, or began when this way was set, too soon (G6).

    It is shown no order yet, but may take one that was made for it since then; what was made before it was confirmed
    has lapsed, since an order counts for seconds, so that a unit which began before that is as one which began then.
    """
    if not clocks_keep_gps_time(system, now_ms) or not its_unit_began_since_it_was_confirmed(system, tram, begun_ms):
        return system
    if not a_tram_comes_where_and_when_it_was_confirmed(site, system, tram, body):
        return system
    if not who_begins_at_the_first_stop_is_last(system, tram, body) or not none_overtakes(system.bodies, tram, body):
        return system
    fresh = replace(body, display=on_board.older(site.limits, on_board.begun(begun_ms), now_ms - begun_ms))
    return replace(
        system,
        bodies=system.bodies | {tram: fresh},
        runs={other: run for other, run in system.runs.items() if other != tram},
    )


def depart(site: Way, system: Traffic, tram: Tram) -> Traffic:
    """A tram departs, whatever its driver is shown, and whatever its destination."""
    if tram not in system.bodies or not none_overtakes(system.bodies, tram, replace(system.bodies[tram], left=True)):
        return system
    return replace(system, bodies=system.bodies | {tram: replace(system.bodies[tram], left=True)})


def arrive(site: Way, system: Traffic, tram: Tram, noticed: bool, told_stop: int, stands: bool) -> Traffic:
    """A tram comes to the next stop, and stands there or passes; its unit notices, if it knows its place (G2, G5).

    From the section before it, or with the same step from the stop before that.
    """
    if tram not in system.bodies or not it_knows_the_stop_that_it_comes_to(system, tram, noticed, told_stop):
        return system
    body = system.bodies[tram]
    if not none_overtakes(system.bodies, tram, replace(body, stop=body.stop + 1, left=False)):
        return system
    if not a_known_place_shows_the_stop(body.display, noticed):
        return system
    display = on_board.located(body.display, True, told_stop, stands) if noticed else body.display
    there = replace(body, stop=body.stop + 1, left=False, display=display)
    return replace(system, bodies=system.bodies | {tram: there})


def leave(site: Way, system: Traffic, tram: Tram) -> Traffic:
    """A tram leaves the way, wherever it is: it turns off, turns back, is towed away."""
    bodies = system.bodies
    return replace(
        system,
        bodies={other: body for other, body in bodies.items() if other != tram},
        gone_at=system.gone_at | {tram: place(bodies[tram])} if tram in bodies else system.gone_at,
    )


# ---- what is told


def still_unset(system: Traffic, tram: Tram, report: Report) -> frozenset[Tram]:
    """Give of whose units nothing shows that they have begun, after one has told something."""
    return system.unset if report.left else frozenset(other for other in system.unset if other != tram)


def take_place(site: Way, system: Traffic, tram: Tram, is_located: bool, told_stop: int, stands: bool) -> Traffic:
    """A unit finds its place, loses it, or sees the tram stand or move (G1, G2)."""
    if tram not in system.bodies or not a_located_tram_knows_its_stop(system, tram, is_located, told_stop):
        return system
    body = system.bodies[tram]
    display = on_board.located(body.display, is_located, told_stop, stands)
    return replace(system, bodies=system.bodies | {tram: replace(body, display=display)})


def restart_unit(site: Way, system: Traffic, tram: Tram, now_ms: int) -> Traffic:
    """A unit on board starts anew (G6)."""
    if tram not in system.bodies or not clocks_keep_gps_time(system, now_ms):
        return system
    body = system.bodies[tram]
    return replace(system, bodies=system.bodies | {tram: replace(body, display=on_board.begun(now_ms))})


def tell(site: Way, system: Traffic, tram: Tram, report: Report) -> Traffic:
    """A tram makes a report, which may come at any time, again and again (G3)."""
    if not a_report_tells_where_it_is(system, tram, report):
        return system
    return replace(system, told=system.told | {(tram, report)}, unset=still_unset(system, tram, report))


def tell_after_leaving(site: Way, system: Traffic, tram: Tram, report: Report) -> Traffic:
    """A tram that has left the way goes on to tell of it, until it is confirmed anew (G2)."""
    if not what_it_left_it_had_left(system, tram, report):
        return system
    return replace(system, told=system.told | {(tram, report)})


def tell_of_the_run_before(site: Way, system: Traffic, tram: Tram, report: Report) -> Traffic:
    """A tram that was confirmed tells of a run before that, on the way or not: nobody has set its unit anew (G2)."""
    if not of_a_run_before_it_tells_that_it_left(system, tram, report):
        return system
    return replace(system, told_beside=system.told_beside | {(tram, report)})


def tell_beside(site: Way, system: Traffic, tram: Tram, report: Report) -> Traffic:
    """A tram that is not on the way tells of it: its driver has set it too soon, or has left it so (G2)."""
    if not beside_the_way_no_stop_is_left(system, tram, report):
        return system
    return replace(system, told_beside=system.told_beside | {(tram, report)}, unset=still_unset(system, tram, report))


def tell_elsewhere(site: Way, system: Traffic, tram: Tram) -> Traffic:
    """A tram tells that it has left a stop of another way, or is in its depot; that too may come at any time (G3)."""
    if not only_who_is_elsewhere_tells_so(system, tram):
        return system
    return replace(system, told_elsewhere=system.told_elsewhere | {(tram, system.now_ms)})


# ---- the centre


def restart_centre(site: Way, system: Traffic, now_ms: int) -> Traffic:
    """The centre starts anew, and knows nothing; what it has sent is still on its way (G6).

    With limits that do not pass their check it is not put into service, the first time or anew.
    """
    if not limits.are_lawful(site.limits):
        return system
    if not clocks_keep_gps_time(system, now_ms):
        return system
    return replace(system, centre=machine.restarted(site.limits, system.centre, now_ms))


def hear_report(site: Way, system: Traffic, tram: Tram, told: Report) -> Traffic:
    """A tram's report comes to the centre (G3)."""
    if not only_what_was_told_is_heard(system, tram, told):
        return system
    return replace(system, centre=machine.note_report(system.centre, tram, told))


def hear_elsewhere(site: Way, system: Traffic, tram: Tram, is_away: bool, made_ms: int) -> Traffic:
    """What a tram told from elsewhere comes to the centre; that it stands at a stop there any tram may tell (G3).

    As one does that stands at a platform of this way, where its driver has chosen another.
    """
    if not only_what_was_told_elsewhere_is_heard(system, tram, is_away, made_ms):
        return system
    return replace(system, centre=machine.note_elsewhere(system.centre, tram, is_away, made_ms))


def take_off(site: Way, system: Traffic, tram: Tram) -> Traffic:
    """A person takes a tram off that has no radio (ours)."""
    if not who_is_taken_off_is_off_the_way(site, system, tram):
        return system
    return replace(system, centre=machine.note_taken_off(system.centre, tram))


def give_order(site: Way, system: Traffic, tram: Tram, hand: Hand, command: Command) -> Traffic:
    """The centre makes an order for a tram and sends it; what was not known then goes into history (G4, G5)."""
    order = machine.order(site.limits, system.centre, tram, hand)
    if not the_frame_carries_the_order(tram, order, command):
        return system
    return replace(
        system,
        centre=machine.note_ordered(system.centre, tram, order),
        sent=system.sent | {command},
        given=Given(
            holds=order.holds,
            recovers=order.recovers,
            own_unknown=is_unknown(site, system, tram),
            way_unknown=is_way_unknown(system, tram),
        ),
    )


def hear_order(site: Way, system: Traffic, tram: Tram, command: Command) -> Traffic:
    """A command comes to a tram, for it or for another one (G3, G6)."""
    if tram not in system.bodies or not only_what_was_sent_arrives(system, command):
        return system
    body = system.bodies[tram]
    display = machine.received(site.limits, tram, body.display, command)
    takes = display != body.display
    return replace(
        system,
        bodies=system.bodies | {tram: replace(body, display=display, taken_at=body.stop if takes else body.taken_at)},
    )
