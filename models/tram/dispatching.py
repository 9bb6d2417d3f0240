"""Trams on a way, what the centre knows of them, and what drivers are shown, beside what is really so (G4 to G6).

Any number of trams and stops.  Trams move from stop to stop at will, held or not: what drivers are shown is
an aid.  Reports come late, again, out of order or not at all, and so do orders; a tram loses its place at
any time.  What is not so by nature stands below as an assumption.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

from kernel.maps import Map
from kernel.tram import centre as machine
from kernel.tram import display as on_board
from kernel.tram.centre import Centre, Command, Tram
from kernel.tram.dispatching import DispatchLimits, Hand, Known, Order, Report
from kernel.tram.display import Display


@dataclass(frozen=True)
class Way:
    """What does not change: the limits of the line (G4, G5)."""

    limits: DispatchLimits


@dataclass(frozen=True)
class Body:
    """A tram as it is, on the way or, once ``is_gone``, off it again.

    ``turn``: its place in the order on the track.  ``stop``, ``left``: where it is.
    ``leaves_at``: the stop where it leaves the way.  ``display``: what its driver is shown.
    ``taken_at``: a history: where it stood when it took its last order.
    """

    turn: int
    stop: int
    left: bool
    leaves_at: int
    is_gone: bool
    display: Display
    taken_at: int


@dataclass(frozen=True)
class Run:
    """What was confirmed to who lets trams onto the way, and when: a tram's turn, where it comes, its destination."""

    turn: int
    stop: int
    leaves_at: int
    at_ms: int


@dataclass(frozen=True)
class Given:
    """A history: an order as it was made, and what was not known then.

    ``own_unknown``: where the tram was; ``way_unknown``: whether a tram ahead that shares the way had left the
    next stop.
    """

    holds: bool
    recovers: bool
    own_unknown: bool
    way_unknown: bool


@dataclass(frozen=True)
class Traffic:
    """One moment: GPS time, every tram, what the centre knows, every command ever sent, and the last order.

    ``runs``: for each tram the last run that was confirmed.
    """

    now_ms: int
    bodies: Map[Tram, Body]
    runs: Map[Tram, Run]
    centre: Centre
    sent: frozenset[Command]
    given: Given


def mark(stop: int, left: bool) -> int:
    """Number the places of the way: even at a stop, odd in the section after it; greater is farther on (G2)."""
    return 2 * stop + (1 if left else 0)


def place(body: Body) -> int:
    """Give where a tram is on the way (G2)."""
    return mark(body.stop, body.left)


def is_on_the_way(bodies: Map[Tram, Body], tram: Tram) -> bool:
    """Tell whether a tram is on the way now."""
    return tram in bodies and not bodies[tram].is_gone


def is_unknown(site: Way, system: Traffic, tram: Tram) -> bool:
    """Tell whether the centre does not know, by a report that is new enough, that a tram stands at its stop (G3)."""
    trams, now_ms = system.centre.trams, system.now_ms
    return tram not in trams or not trams[tram].stands or now_ms - trams[tram].told_ms > site.limits.fresh_ms


def is_not_known_to_have_passed(own: Known, turn: int, leaves_at: int, at_mark: int) -> bool:
    """Tell whether a tram ahead, by its turn, shares the way and has not been seen to leave the next stop (G5)."""
    return turn <= own.turn and leaves_at > own.stop and at_mark <= mark(own.stop + 1, False)


# ---- assumptions


def time_runs_forward(elapsed_ms: int) -> bool:
    """GPS time does not go back (G3)."""
    return elapsed_ms >= 0


def clocks_keep_gps_time(system: Traffic, now_ms: int) -> bool:
    """A tram that comes onto the way keeps GPS time (G3)."""
    return now_ms == system.now_ms


def only_what_has_left_is_taken_up_anew(system: Traffic, tram: Tram) -> bool:
    """A tram that is on the way is not taken up for another run (ours)."""
    return not is_on_the_way(system.bodies, tram)


def the_centre_knows_it_before_it_comes(system: Traffic, tram: Tram, body: Body) -> bool:
    """A tram comes onto the way, each time, after its run was confirmed, in that turn and with that destination.

    Where it comes is where was said, or farther on.
    """
    if tram in system.bodies or tram not in system.runs:
        return False
    run = system.runs[tram]
    return (
        body.turn == run.turn
        and body.leaves_at <= run.leaves_at
        and mark(run.stop, False) <= place(body) <= mark(body.leaves_at, False)
        and not body.is_gone
    )


def trams_are_in_their_turn(system: Traffic, tram: Tram, there: Body) -> bool:
    """A tram comes, and runs, behind those ahead of it and before those behind: none overtakes on one track (G2)."""
    return all(
        other == tram
        or body.is_gone
        or (body.turn < there.turn and place(body) >= place(there))
        or (body.turn > there.turn and place(body) <= place(there))
        for other, body in system.bodies.items()
    )


def it_departs_up_to_its_destination(system: Traffic, tram: Tram) -> bool:
    """A tram departs from a stop of the way; none runs on beyond where its destination has it leave (002, 4.2)."""
    return is_on_the_way(system.bodies, tram) and system.bodies[tram].stop < system.bodies[tram].leaves_at


def it_arrives_from_the_section(system: Traffic, tram: Tram) -> bool:
    """A tram arrives at a stop from the section before: it has departed from the stop before that."""
    return is_on_the_way(system.bodies, tram) and system.bodies[tram].left


def it_leaves_the_way_at_a_stop(system: Traffic, tram: Tram) -> bool:
    """A tram leaves the way, to turn off or to turn back, where there is a stop."""
    return tram in system.bodies and not system.bodies[tram].left


def a_known_place_shows_the_stop(display: Display, noticed: bool) -> bool:
    """A unit that knows its place notices the stop that it comes to (G1, G2)."""
    return noticed or not display.is_located


def a_located_tram_knows_its_stop(system: Traffic, tram: Tram, is_located: bool, told_stop: int) -> bool:
    """The stop that a unit takes for the last one is the last one (G1, G2)."""
    return not is_located or told_stop == system.bodies[tram].stop


def it_knows_the_stop_that_it_comes_to(system: Traffic, tram: Tram, noticed: bool, told_stop: int) -> bool:
    """And so is the one that it comes to (G1, G2)."""
    return not noticed or told_stop == system.bodies[tram].stop + 1


def a_report_tells_where_it_was(system: Traffic, tram: Tram, report: Report) -> bool:
    """What a tram has told since its run was confirmed is of this run: it has reached that place (G2, G3)."""
    if tram not in system.runs or report.made_ms <= system.runs[tram].at_ms:
        return True
    return tram in system.bodies and mark(report.stop, report.left) <= place(system.bodies[tram])


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


def take_up(site: Way, system: Traffic, tram: Tram, turn: int, stop: int, leaves_at: int) -> Traffic:
    """Tell the centre of a tram that is to come, or to come again; a run that has ended is forgotten then (ours)."""
    if not only_what_has_left_is_taken_up_anew(system, tram):
        return system
    is_taken = machine.may_come(system.centre, tram, turn, stop, leaves_at)
    run = Run(turn, stop, leaves_at, system.now_ms)
    return replace(
        system,
        bodies={other: body for other, body in system.bodies.items() if other != tram or not is_taken},
        runs=system.runs | {tram: run} if is_taken else system.runs,
        centre=machine.note_coming(system.centre, tram, turn, stop, leaves_at),
    )


def come(site: Way, system: Traffic, tram: Tram, body: Body, now_ms: int) -> Traffic:
    """A tram comes onto the way; its unit begins anew (G6)."""
    if not the_centre_knows_it_before_it_comes(system, tram, body) or not clocks_keep_gps_time(system, now_ms):
        return system
    if not trams_are_in_their_turn(system, tram, body):
        return system
    fresh = replace(body, display=on_board.begun(now_ms))
    return replace(system, bodies=system.bodies | {tram: fresh})


def depart(site: Way, system: Traffic, tram: Tram) -> Traffic:
    """A tram departs, whatever its driver is shown."""
    if not it_departs_up_to_its_destination(system, tram):
        return system
    there = replace(system.bodies[tram], left=True)
    if not trams_are_in_their_turn(system, tram, there):
        return system
    return replace(system, bodies=system.bodies | {tram: there})


def arrive(site: Way, system: Traffic, tram: Tram, noticed: bool, told_stop: int, stands: bool) -> Traffic:
    """A tram comes to the next stop, and stands there or passes; its unit notices, if it knows its place (G2, G5)."""
    if not it_arrives_from_the_section(system, tram):
        return system
    body = system.bodies[tram]
    if not trams_are_in_their_turn(system, tram, replace(body, stop=body.stop + 1, left=False)):
        return system
    if not a_known_place_shows_the_stop(body.display, noticed):
        return system
    if not it_knows_the_stop_that_it_comes_to(system, tram, noticed, told_stop):
        return system
    display = on_board.located(body.display, True, told_stop, stands) if noticed else body.display
    there = replace(body, stop=body.stop + 1, left=False, display=display)
    return replace(system, bodies=system.bodies | {tram: there})


def leave(site: Way, system: Traffic, tram: Tram) -> Traffic:
    """A tram leaves the way behind the stop of its destination."""
    if not it_leaves_the_way_at_a_stop(system, tram):
        return system
    body = system.bodies[tram]
    return replace(system, bodies=system.bodies | {tram: replace(body, left=True, is_gone=True)})


# ---- what is told


def take_place(site: Way, system: Traffic, tram: Tram, is_located: bool, told_stop: int, stands: bool) -> Traffic:
    """A unit finds its place, loses it, or sees the tram stand or move (G1, G2)."""
    if tram not in system.bodies or not a_located_tram_knows_its_stop(system, tram, is_located, told_stop):
        return system
    body = system.bodies[tram]
    display = on_board.located(body.display, is_located, told_stop, stands)
    return replace(system, bodies=system.bodies | {tram: replace(body, display=display)})


def hear_report(site: Way, system: Traffic, tram: Tram, told: Report) -> Traffic:
    """A tram's report comes to the centre (G3)."""
    if not a_report_tells_where_it_was(system, tram, told):
        return system
    return replace(system, centre=machine.note_report(system.centre, tram, told))


def give_order(site: Way, system: Traffic, tram: Tram, hand: Hand, command: Command) -> Traffic:
    """The centre makes an order for a tram and sends it; what was not known then goes into history (G4, G5)."""
    order = machine.order(site.limits, system.centre, tram, hand)
    if not the_frame_carries_the_order(tram, order, command):
        return system
    trams = system.centre.trams
    return replace(
        system,
        centre=machine.note_ordered(system.centre, tram, order),
        sent=system.sent | {command},
        given=Given(
            holds=order.holds,
            recovers=order.recovers,
            own_unknown=is_unknown(site, system, tram),
            way_unknown=tram in trams
            and any(
                other != tram
                and not body.is_gone
                and is_not_known_to_have_passed(trams[tram], body.turn, body.leaves_at, place(body))
                for other, body in system.bodies.items()
            ),
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
