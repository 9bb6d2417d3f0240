"""What is claimed of dispatching: none recovers towards a tram, none is held and recovers, none by guess (G4 to G6)."""

from __future__ import annotations

from kernel.tram.centre import Tram
from models.tram import dispatching as world
from models.tram.dispatching import Body, Traffic, Way, mark, place
from proofs.theory import Theory, by_name

# ---- the start


def nothing_runs_yet(site: Way, system: Traffic) -> bool:
    """At the start no tram is on the way, none is known, and nothing was sent."""
    return (
        system.centre.now_ms == system.now_ms
        and all(False for _tram in system.bodies)
        and all(False for _tram in system.runs)
        and all(False for _tram in system.centre.trams)
        and all(False for _command in system.sent)
        and not system.given.holds
        and not system.given.recovers
    )


# ---- safety


def is_out_of_the_way(body: Body, other: Body) -> bool:
    """Tell whether another tram is behind, or has left the next stop (G5)."""
    is_behind = place(other) <= place(body) and (other.turn > body.turn or place(other) <= mark(body.stop, False))
    return is_behind or place(other) > mark(body.stop + 1, False)


def no_recovery_towards_an_occupied_section(site: Way, system: Traffic) -> bool:
    """As long as a driver may recover no other tram is before him up to the next stop, nor at it (G5).

    At his own stop there may be one that turns off there.
    """
    return all(
        tram == other or body.is_gone or ahead.is_gone or not body.display.recovers or is_out_of_the_way(body, ahead)
        for tram, body in system.bodies.items()
        for other, ahead in system.bodies.items()
    )


def none_is_ahead_of_one_that_recovers(site: Way, system: Traffic) -> bool:
    """Nor is there, up to the next stop, one that is ahead of him in order and shares the way (G5)."""
    return all(
        tram == other
        or body.is_gone
        or ahead.is_gone
        or not body.display.recovers
        or ahead.turn > body.turn
        or ahead.leaves_at <= body.stop
        or place(ahead) > mark(body.stop + 1, False)
        for tram, body in system.bodies.items()
        for other, ahead in system.bodies.items()
    )


def none_recovers_from_its_last_stop(site: Way, system: Traffic) -> bool:
    """Nobody recovers beyond the stop where he leaves the way, as far as his destination was told (002, 4.2; G5)."""
    return all(
        not body.display.recovers or body.stop < system.centre.trams[tram].leaves_at
        for tram, body in system.bodies.items()
        if tram in system.centre.trams
    )


def never_hold_and_recover(site: Way, system: Traffic) -> bool:
    """No driver is shown both, and no order says both: hold beats recovery (G4)."""
    return all(not (body.display.holds and body.display.recovers) for _tram, body in system.bodies.items()) and all(
        not (command.holds and command.recovers) for command in system.sent
    )


def unknown_means_no_command(site: Way, system: Traffic) -> bool:
    """No order for a tram of which it is not known where it stands; no recovery where a tram may be ahead (G6)."""
    given = system.given
    return not ((given.holds or given.recovers) and given.own_unknown) and not (given.recovers and given.way_unknown)


def recovery_ends_at_the_next_stop(site: Way, system: Traffic) -> bool:
    """Who may recover has taken that order at the stop that he came to last, and knows where he is (G5)."""
    return all(
        not body.display.recovers or (body.taken_at == body.stop and body.display.is_located)
        for _tram, body in system.bodies.items()
    )


def no_order_outlives_its_time(site: Way, system: Traffic) -> bool:
    """What a standing tram is shown was made no longer ago than written (G3, G6)."""
    return all(
        not (body.display.stands and (body.display.holds or body.display.recovers))
        or system.now_ms - body.display.made_ms <= site.limits.order_ms
        for _tram, body in system.bodies.items()
    )


def only_who_stands_is_held(site: Way, system: Traffic) -> bool:
    """No moving tram is shown a hold (G4)."""
    return all(not body.display.holds or body.display.stands for _tram, body in system.bodies.items())


def the_order_known_is_the_order_on_the_track(site: Way, system: Traffic) -> bool:
    """Of two trams the one that the centre has ahead is not behind the other (002, 3.1.2; G2)."""
    return all(
        tram == other
        or body.is_gone
        or ahead.is_gone
        or system.centre.trams[other].turn >= system.centre.trams[tram].turn
        or place(ahead) >= place(body)
        for tram, body in system.bodies.items()
        if tram in system.centre.trams
        for other, ahead in system.bodies.items()
        if other in system.centre.trams
    )


# ---- what it rests on


def trams_are_known_no_farther_on_than_they_are(site: Way, system: Traffic) -> bool:
    """Each tram is known, in its turn, as having reached a place that it has reached (G2)."""
    return all(
        tram in system.centre.trams
        and system.centre.trams[tram].turn == body.turn
        and system.centre.trams[tram].leaves_at >= body.leaves_at
        and mark(system.centre.trams[tram].stop, system.centre.trams[tram].left) <= place(body)
        for tram, body in system.bodies.items()
    )


def runs_that_were_confirmed_are_those_known(site: Way, system: Traffic) -> bool:
    """The centre knows of each run that was confirmed, since then, and of no other (G2, G5; ours).

    Until the tram has come, it knows it no farther on than where it is to come.
    """
    return all(
        tram in system.centre.trams
        and system.centre.trams[tram].since_ms == run.at_ms
        and system.centre.trams[tram].turn == run.turn
        and system.centre.trams[tram].leaves_at >= run.leaves_at
        and (
            tram in system.bodies
            or mark(system.centre.trams[tram].stop, system.centre.trams[tram].left) <= mark(run.stop, False)
        )
        for tram, run in system.runs.items()
    ) and all(tram in system.runs for tram in system.centre.trams)


def none_is_beyond_its_destination(site: Way, system: Traffic) -> bool:
    """No tram on the way has passed the stop where it leaves (002, 4.2)."""
    return all(body.is_gone or place(body) <= mark(body.leaves_at, False) for _tram, body in system.bodies.items())


def trams_run_in_their_turn(site: Way, system: Traffic) -> bool:
    """No two trams have one turn, and a lower one is not behind (G2)."""
    return all(
        tram == other
        or body.is_gone
        or ahead.is_gone
        or (body.turn < ahead.turn and place(body) >= place(ahead))
        or (body.turn > ahead.turn and place(body) <= place(ahead))
        for tram, body in system.bodies.items()
        for other, ahead in system.bodies.items()
    )


def clocks_agree(site: Way, system: Traffic) -> bool:
    """All keep GPS time (G3)."""
    return system.centre.now_ms == system.now_ms and all(
        body.display.now_ms == system.now_ms for _tram, body in system.bodies.items()
    )


def nothing_is_of_the_future(site: Way, system: Traffic) -> bool:
    """Commands were made by now; and no tram was taken up later than now (G3)."""
    return all(command.made_ms <= system.now_ms for command in system.sent) and all(
        known.since_ms <= system.now_ms for _tram, known in system.centre.trams.items()
    )


def displays_are_of_this_run(site: Way, system: Traffic) -> bool:
    """What is older than the taking up of a tram is not shown, and not taken (G6)."""
    return all(
        tram not in system.centre.trams or body.display.made_ms >= system.centre.trams[tram].since_ms
        for tram, body in system.bodies.items()
    )


def a_located_unit_has_its_stop(site: Way, system: Traffic) -> bool:
    """A unit that knows its place knows the stop; one that stands knows its place (G2)."""
    return all(
        (not body.display.is_located or body.display.stop == body.stop)
        and (not body.display.stands or body.display.is_located)
        for _tram, body in system.bodies.items()
    )


def recoveries_are_ordered_one_stop_on(site: Way, system: Traffic) -> bool:
    """A tram is ordered to recover no farther than to the stop after the one reached (G5)."""
    return all(known.recovery_to <= known.stop + 1 for _tram, known in system.centre.trams.items())


def is_alive(system: Traffic, tram: Tram, stop: int, made_ms: int) -> bool:
    """Tell whether a recovery from a stop may still be taken: it is of this run, and the tram may be there yet."""
    return (
        tram in system.centre.trams
        and made_ms > system.centre.trams[tram].since_ms
        and mark(system.centre.trams[tram].stop, system.centre.trams[tram].left) < mark(stop + 1, False)
    )


def recoveries_sent_are_on_record(site: Way, system: Traffic) -> bool:
    """The centre has it on record as long as one may still be taken; none is from where a tram leaves (G5)."""
    return all(
        not command.recovers
        or not is_alive(system, command.tram, command.stop, command.made_ms)
        or (
            system.centre.trams[command.tram].recovery_to == command.stop + 1
            and system.centre.trams[command.tram].leaves_at > command.stop
        )
        for command in system.sent
        if command.tram in system.centre.trams
    )


def recoveries_shown_are_on_record(site: Way, system: Traffic) -> bool:
    """And as long as one is shown (G5)."""
    return all(
        not body.display.recovers
        or (tram in system.centre.trams and system.centre.trams[tram].recovery_to == body.stop + 1)
        for tram, body in system.bodies.items()
    )


def recoveries_sent_have_a_clear_way(site: Way, system: Traffic) -> bool:
    """As long as one may still be taken, every tram ahead on the way has left the next stop (G5)."""
    return all(
        not command.recovers
        or not is_alive(system, command.tram, command.stop, command.made_ms)
        or other == command.tram
        or ahead.is_gone
        or ahead.turn > system.centre.trams[command.tram].turn
        or ahead.leaves_at <= command.stop
        or place(ahead) > mark(command.stop + 1, False)
        for command in system.sent
        if command.tram in system.centre.trams
        for other, ahead in system.bodies.items()
    )


def nor_will_one_come_before_one_sent(site: Way, system: Traffic) -> bool:
    """Nor is one taken up that could come there (G5)."""
    return all(
        not command.recovers
        or not is_alive(system, command.tram, command.stop, command.made_ms)
        or other == command.tram
        or other in system.bodies
        or known.turn > system.centre.trams[command.tram].turn
        or known.leaves_at <= command.stop
        or mark(known.stop, known.left) > mark(command.stop + 1, False)
        for command in system.sent
        if command.tram in system.centre.trams
        for other, known in system.centre.trams.items()
    )


def nor_will_one_come_before_one_shown(site: Way, system: Traffic) -> bool:
    """Nor before a tram that recovers already (G5)."""
    return all(
        not body.display.recovers
        or body.is_gone
        or other == tram
        or other in system.bodies
        or known.turn > body.turn
        or known.leaves_at <= body.stop
        or mark(known.stop, known.left) > mark(body.stop + 1, False)
        for tram, body in system.bodies.items()
        for other, known in system.centre.trams.items()
    )


INITIAL = (nothing_runs_yet,)
SAFETY = (
    no_recovery_towards_an_occupied_section,
    none_recovers_from_its_last_stop,
    never_hold_and_recover,
    unknown_means_no_command,
    recovery_ends_at_the_next_stop,
    no_order_outlives_its_time,
    only_who_stands_is_held,
    the_order_known_is_the_order_on_the_track,
)
INVARIANTS = (
    *SAFETY,
    none_is_ahead_of_one_that_recovers,
    trams_are_known_no_farther_on_than_they_are,
    runs_that_were_confirmed_are_those_known,
    none_is_beyond_its_destination,
    trams_run_in_their_turn,
    clocks_agree,
    nothing_is_of_the_future,
    displays_are_of_this_run,
    a_located_unit_has_its_stop,
    recoveries_are_ordered_one_stop_on,
    recoveries_sent_are_on_record,
    recoveries_shown_are_on_record,
    recoveries_sent_have_a_clear_way,
    nor_will_one_come_before_one_sent,
    nor_will_one_come_before_one_shown,
)
STEPS = (
    world.pass_time,
    world.take_up,
    world.come,
    world.depart,
    world.arrive,
    world.leave,
    world.take_place,
    world.hear_report,
    world.give_order,
    world.hear_order,
)

THEORY = Theory(
    "dispatching",
    Way,
    Traffic,
    by_name(STEPS),
    by_name(INITIAL),
    by_name(INVARIANTS),
    by_name(SAFETY),
    by_name(()),
    quantified=True,
)
