"""What is claimed of dispatching: none recovers towards a tram, none is held and recovers, none by guess (G4 to G6).

Neither the timetable's order nor a destination is trusted, and the centre starts anew at any moment.
"""

from __future__ import annotations

from kernel.tram.centre import Tram
from kernel.tram.dispatching import Known, Report
from models.tram import dispatching as world
from models.tram.dispatching import Body, Traffic, Way, mark, may_still_come, place
from proofs.theory import Theory, by_name
from proofs.tram.beside import (
    is_behind,
    is_of_this_run,
    is_under_way,
    of_the_run_before_it_told_before_it_began,
    of_the_run_before_it_told_before_it_began_beside_the_way,
    of_who_is_not_set_nothing_was_heard,
    was_beyond,
    what_is_not_known_is_beyond_where_such_a_tram_turned_off,
    what_was_told_beside_is_older,
    what_was_told_beside_is_older_than_what_counts,
    what_was_told_of_the_run_before_counts_no_more,
    who_has_turned_off_is_off_the_way,
    who_is_not_set_has_told_beside_it_of_no_stop,
    who_is_not_set_has_told_on_the_way_of_no_stop,
    who_is_under_way_has_begun,
    who_told_from_beyond_is_ahead_of_who_told_beside,
    who_was_heard_beyond_is_ahead_of_who_told_beside,
)
from proofs.tram.recoveries import (
    nor_will_one_come_before_one_sent,
    nor_will_one_come_before_one_shown,
    recoveries_are_ordered_one_stop_on,
    recoveries_sent_are_on_record,
    recoveries_sent_have_a_clear_way,
    recoveries_shown_are_on_record,
    who_is_to_come_is_not_ordered_to_recover,
)

# ---- the start


def nothing_is_known_yet(site: Way, system: Traffic) -> bool:
    """At the start the centre knows nothing, and nothing was told or sent; trams may be on the way, none overtaking."""
    return (
        system.centre.now_ms == system.now_ms
        and system.centre.opens_ms == system.now_ms + site.limits.coming_ms
        and system.centre.cleared == -1
        and all(False for _tram in system.runs)
        and all(False for _tram in system.gone_at)
        and all(False for _tram in system.unset)
        and all(False for _tram in system.centre.trams)
        and all(False for _pair in system.centre.left_ms)
        and all(False for _pair in system.centre.shown)
        and all(False for _tram in system.centre.elsewhere_ms)
        and all(False for _told in system.told)
        and all(False for _told in system.told_beside)
        and all(False for _told in system.told_elsewhere)
        and all(False for _command in system.sent)
        and all(
            not body.display.holds
            and not body.display.recovers
            and not body.display.is_located
            and not body.display.stands
            and body.display.now_ms == system.now_ms
            for _tram, body in system.bodies.items()
        )
        and none_overtakes_another(site, system)
        and not system.given.holds
        and not system.given.recovers
    )


# ---- safety


def is_out_of_the_way(body: Body, other: Body) -> bool:
    """Tell whether another tram is behind, or has left the next stop (G5)."""
    return other.rank > body.rank or place(other) > mark(body.stop + 1, False)


def no_recovery_towards_an_occupied_section(site: Way, system: Traffic) -> bool:
    """As long as a driver may recover no other tram is ahead of him up to the next stop, nor at it (G5).

    Whether the centre knows it or not, and whatever order and destination it was to have.
    """
    return all(
        tram == other or not body.display.recovers or is_out_of_the_way(body, ahead)
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


def has_told_that_it_stands(told: frozenset[tuple[Tram, Report]], tram: Tram, known: Known) -> bool:
    """Tell whether a tram has told, when it told last, that it stands where it is known to be (G3)."""
    return any(
        other == tram and report.made_ms == known.told_ms and report.stands and report.stop == known.stop
        for other, report in told
    )


def who_is_known_to_stand_has_told_so(site: Way, system: Traffic) -> bool:
    """With no order by guess: that a tram stands is known by what it told last, and of the stop where it is (G3)."""
    return all(
        not known.stands
        or has_told_that_it_stands(system.told, tram, known)
        or has_told_that_it_stands(system.told_beside, tram, known)
        for tram, known in system.centre.trams.items()
    )


def only_who_stands_is_held(site: Way, system: Traffic) -> bool:
    """No moving tram is shown a hold (G4)."""
    return all(not body.display.holds or body.display.stands for _tram, body in system.bodies.items())


def the_order_shown_is_the_order_on_the_track(site: Way, system: Traffic) -> bool:
    """Of two trams the one that reports have shown ahead is ahead (002, 3.1.2; G2)."""
    return all(
        ahead not in system.bodies
        or behind not in system.bodies
        or system.bodies[ahead].rank < system.bodies[behind].rank
        for ahead, behind in system.centre.shown
    )


def none_is_taken_up_anew_while_on_the_way(site: Way, system: Traffic) -> bool:
    """Who may be confirmed is not on the way, nor about to come (G5, ours)."""
    return all(
        tram in system.centre.trams or (tram not in system.bodies and not may_still_come(site, system, tram))
        for tram in system.centre.elsewhere_ms
    )


# ---- what nature keeps


def none_overtakes_another(site: Way, system: Traffic) -> bool:
    """No two trams have one rank, and a lower one is not behind (G2)."""
    return all(
        tram == other
        or (body.rank < ahead.rank and place(body) >= place(ahead))
        or (body.rank > ahead.rank and place(body) <= place(ahead))
        for tram, body in system.bodies.items()
        for other, ahead in system.bodies.items()
    )


def clocks_agree(site: Way, system: Traffic) -> bool:
    """All keep GPS time (G3)."""
    return system.centre.now_ms == system.now_ms and all(
        body.display.now_ms == system.now_ms for _tram, body in system.bodies.items()
    )


def nothing_is_of_the_future(site: Way, system: Traffic) -> bool:
    """Nothing was sent, told, confirmed or taken up later than now (G3)."""
    return (
        all(command.made_ms <= system.now_ms for command in system.sent)
        and all(report.made_ms <= system.now_ms for _tram, report in system.told)
        and all(report.made_ms <= system.now_ms for _tram, report in system.told_beside)
        and all(made_ms <= system.now_ms for _tram, made_ms in system.told_elsewhere)
        and all(run.at_ms <= system.now_ms for _tram, run in system.runs.items())
        and all(
            system.centre.opens_ms < known.since_ms <= known.told_ms <= system.now_ms
            for _tram, known in system.centre.trams.items()
        )
        and all(system.centre.opens_ms < at_ms <= system.now_ms for _tram, at_ms in system.centre.elsewhere_ms.items())
    )


def a_located_unit_has_its_stop(site: Way, system: Traffic) -> bool:
    """A unit that knows its place knows the stop; one that stands knows its place (G2)."""
    return all(
        (not body.display.is_located or body.display.stop == body.stop)
        and (not body.display.stands or body.display.is_located)
        for _tram, body in system.bodies.items()
    )


# ---- what the centre knows


def trams_are_known_no_farther_on_than_they_are(site: Way, system: Traffic) -> bool:
    """Each known tram on the way has reached the place that is known of it (G2)."""
    return all(
        tram not in system.centre.trams
        or mark(system.centre.trams[tram].stop, system.centre.trams[tram].left) <= place(body)
        for tram, body in system.bodies.items()
    )


def reports_of_this_run_were_true(site: Way, system: Traffic) -> bool:
    """What a tram has told since it was taken up it has reached (G2)."""
    return all(
        tram not in system.centre.trams
        or report.made_ms <= system.centre.trams[tram].since_ms
        or tram not in system.bodies
        or mark(report.stop, report.left) <= place(system.bodies[tram])
        for tram, report in system.told
    )


def who_is_to_come_has_told_nothing(site: Way, system: Traffic) -> bool:
    """Of a run that was confirmed, and has not begun, the centre knows where it is to begin, and no more (G2, G5)."""
    return all(
        tram not in system.centre.trams
        or (
            system.centre.trams[tram].since_ms == run.at_ms
            and system.centre.trams[tram].stop == run.stop
            and not system.centre.trams[tram].left
            and system.centre.trams[tram].comes_at == run.stop
        )
        for tram, run in system.runs.items()
    ) and all(tram not in system.runs or report.made_ms <= system.runs[tram].at_ms for tram, report in system.told)


def no_run_goes_back(site: Way, system: Traffic) -> bool:
    """What is known of a tram is where it was to come, or farther on, and no more before it is under way (G2)."""
    return all(
        known.stop >= known.comes_at >= 0 and (known.stop == known.comes_at or is_under_way(known))
        for _tram, known in system.centre.trams.items()
    )


def what_is_not_known_comes_no_more(site: Way, system: Traffic) -> bool:
    """A confirmation that the centre does not know of lapses before anything counts (G5, ours)."""
    return all(
        tram in system.centre.trams
        or run.at_ms + site.limits.coming_ms <= system.centre.opens_ms
        or not may_still_come(site, system, tram)
        for tram, run in system.runs.items()
    )


def who_comes_is_confirmed_once(site: Way, system: Traffic) -> bool:
    """No tram on the way has a run before it yet (G5)."""
    return all(tram not in system.bodies for tram in system.runs)


def what_told_from_elsewhere_was_off(site: Way, system: Traffic) -> bool:
    """A tram that the centre does not know, and that told from elsewhere since all count, is off the way (G5, ours)."""
    return all(
        made_ms <= system.centre.opens_ms
        or tram in system.centre.trams
        or (tram not in system.bodies and not may_still_come(site, system, tram))
        for tram, made_ms in system.told_elsewhere
    )


def a_run_that_told_and_then_from_elsewhere_has_ended(site: Way, system: Traffic) -> bool:
    """A known tram that has told of the way, and from elsewhere after that, is off it (G5, ours)."""
    return all(
        tram not in system.centre.trams
        or not (system.centre.trams[tram].since_ms < report.made_ms < made_ms)
        or (tram not in system.bodies and tram not in system.runs)
        for tram, made_ms in system.told_elsewhere
        for other, report in system.told
        if other == tram
    )


def a_run_that_was_heard_and_then_from_elsewhere_has_ended(site: Way, system: Traffic) -> bool:
    """And so is one that the centre has known to be under way before that (G5, ours)."""
    return all(
        tram not in system.centre.trams
        or not is_under_way(system.centre.trams[tram])
        or not system.centre.trams[tram].told_ms < made_ms
        or (tram not in system.bodies and tram not in system.runs)
        for tram, made_ms in system.told_elsewhere
    )


# ---- in what order trams run


def who_told_from_beyond_is_ahead(site: Way, system: Traffic) -> bool:
    """Who told that it was beyond a stop, before another told that it stood there, is ahead of that (G2)."""
    return all(
        not report.stands
        or not was_beyond(beyond.stop, beyond.made_ms, report)
        or not (is_of_this_run(system, ahead, beyond.made_ms) and is_of_this_run(system, behind, report.made_ms))
        or is_behind(system, behind, ahead)
        for ahead, beyond in system.told
        for behind, report in system.told
    )


def who_was_heard_beyond_is_ahead(site: Way, system: Traffic) -> bool:
    """And so is one that was heard from beyond before that (G2)."""
    return all(
        not report.stands
        or not is_of_this_run(system, behind, report.made_ms)
        or not is_under_way(known)
        or not was_beyond(known.stop, known.told_ms, report)
        or is_behind(system, behind, ahead)
        for ahead, known in system.centre.trams.items()
        for behind, report in system.told
    )


def who_is_shown_ahead_of_one_to_come_is_beyond_where_it_comes(site: Way, system: Traffic) -> bool:
    """Who is shown ahead has come; where another is to come midway, it is beyond that stop (G2, ours)."""
    return all(
        ahead in system.centre.trams
        and behind in system.centre.trams
        and ahead not in system.runs
        and (
            behind not in system.runs
            or ahead not in system.bodies
            or system.runs[behind].stop == 0
            or system.bodies[ahead].stop > system.runs[behind].stop
        )
        for ahead, behind in system.centre.shown
    )


# ---- what the centre does not know


def what_is_not_known_runs_ahead_of_who_clears(site: Way, system: Traffic) -> bool:
    """Trams that the centre does not know are ahead of each that came at the first stop since it started (G5)."""
    return all(
        known.comes_at != 0
        or tram not in system.bodies
        or other in system.centre.trams
        or stranger.rank < system.bodies[tram].rank
        for tram, known in system.centre.trams.items()
        for other, stranger in system.bodies.items()
    )


def what_is_not_known_is_beyond_what_such_a_tram_told(site: Way, system: Traffic) -> bool:
    """And so they are beyond what such a tram has told (G5)."""
    return all(
        tram not in system.centre.trams
        or system.centre.trams[tram].comes_at != 0
        or report.made_ms <= system.centre.trams[tram].since_ms
        or other in system.centre.trams
        or place(stranger) >= mark(report.stop, report.left)
        for tram, report in system.told
        for other, stranger in system.bodies.items()
    )


def the_way_is_cleared_of_what_is_not_known(site: Way, system: Traffic) -> bool:
    """They are beyond what counts as cleared; before confirmations have lapsed nothing does (G5)."""
    return (system.centre.cleared <= -1 or system.centre.opens_ms < system.now_ms) and all(
        system.centre.cleared <= -1 or tram in system.centre.trams or place(body) >= system.centre.cleared
        for tram, body in system.bodies.items()
    )


INITIAL = (nothing_is_known_yet,)
SAFETY = (
    no_recovery_towards_an_occupied_section,
    none_recovers_from_its_last_stop,
    never_hold_and_recover,
    unknown_means_no_command,
    recovery_ends_at_the_next_stop,
    no_order_outlives_its_time,
    who_is_known_to_stand_has_told_so,
    only_who_stands_is_held,
    the_order_shown_is_the_order_on_the_track,
    none_is_taken_up_anew_while_on_the_way,
)
INVARIANTS = (
    *SAFETY,
    none_overtakes_another,
    clocks_agree,
    nothing_is_of_the_future,
    a_located_unit_has_its_stop,
    trams_are_known_no_farther_on_than_they_are,
    reports_of_this_run_were_true,
    who_is_to_come_has_told_nothing,
    who_has_turned_off_is_off_the_way,
    what_is_not_known_is_beyond_where_such_a_tram_turned_off,
    of_who_is_not_set_nothing_was_heard,
    who_is_not_set_has_told_on_the_way_of_no_stop,
    who_is_not_set_has_told_beside_it_of_no_stop,
    of_the_run_before_it_told_before_it_began,
    of_the_run_before_it_told_before_it_began_beside_the_way,
    what_was_told_of_the_run_before_counts_no_more,
    who_is_under_way_has_begun,
    what_was_told_beside_is_older,
    what_was_told_beside_is_older_than_what_counts,
    no_run_goes_back,
    what_is_not_known_comes_no_more,
    who_comes_is_confirmed_once,
    what_told_from_elsewhere_was_off,
    a_run_that_told_and_then_from_elsewhere_has_ended,
    a_run_that_was_heard_and_then_from_elsewhere_has_ended,
    who_told_from_beyond_is_ahead,
    who_was_heard_beyond_is_ahead,
    who_told_from_beyond_is_ahead_of_who_told_beside,
    who_was_heard_beyond_is_ahead_of_who_told_beside,
    who_is_shown_ahead_of_one_to_come_is_beyond_where_it_comes,
    what_is_not_known_runs_ahead_of_who_clears,
    what_is_not_known_is_beyond_what_such_a_tram_told,
    the_way_is_cleared_of_what_is_not_known,
    recoveries_are_ordered_one_stop_on,
    recoveries_sent_are_on_record,
    recoveries_shown_are_on_record,
    recoveries_sent_have_a_clear_way,
    nor_will_one_come_before_one_sent,
    nor_will_one_come_before_one_shown,
    who_is_to_come_is_not_ordered_to_recover,
)
STEPS = (
    world.pass_time,
    world.take_up,
    world.come,
    world.depart,
    world.arrive,
    world.leave,
    world.take_place,
    world.restart_unit,
    world.tell,
    world.tell_after_leaving,
    world.tell_of_the_run_before,
    world.tell_beside,
    world.tell_elsewhere,
    world.hear_report,
    world.hear_elsewhere,
    world.take_off,
    world.give_order,
    world.hear_order,
    world.restart_centre,
)

THEORY = Theory(
    "dispatching",
    Way,
    Traffic,
    by_name(STEPS),
    by_name(INITIAL),
    by_name(INVARIANTS),
    by_name(SAFETY),
    quantified=True,
)
