"""Trams of both directions, and of two lines that share some stops; and reports of who is ahead (G2, G4 to G6)."""

from __future__ import annotations

from dataclasses import fields, replace

from kernel.tram import centre as dispatcher
from kernel.tram import display as on_board
from kernel.tram.centre import Centre, Tram
from kernel.tram.dispatching import DispatchLimits, Hand, Known, Report
from models.tram import dispatching as world
from models.tram.dispatching import Body, Run, Way
from proofs.tram.witnesses import holds
from proofs.tram.witnesses.line import FIRST, NEITHER, RECOVERS, SECOND, SITE, TERMINUS, THIRD, Day, two_stops_apart


def what_was_told_of_the_other_way_ends_no_run_on_this_one() -> None:
    """A tram turns and comes back; what it told on the other way comes late and again, and it stays known (G5, G6)."""
    day = Day()
    told_ms = day.system.centre.now_ms
    day.step("tell_elsewhere", tram=FIRST)
    day.wait(1)
    day.come(FIRST, 1, 1)
    day.depart(FIRST)
    for _ in range(2):
        before = day.system
        assert day.step("hear_elsewhere", tram=FIRST, is_away=True, made_ms=told_ms) == before
    day.run_to(SECOND, 2, 1, tells=False)
    day.wait(240_000)
    day.tell(SECOND)
    assert day.says(SECOND) == NEITHER
    day.arrive(FIRST)
    day.wait(1)
    day.depart(FIRST)
    day.tell(SECOND)
    assert day.says(SECOND) == RECOVERS
    day.leave(FIRST)
    day.wait(1)
    day.off(FIRST)


def a_tram_of_the_other_line_joins_where_nobody_may_run_faster_to() -> None:
    """At the junction it waits for one that recovers to there; once it is to come none behind it recovers (G5)."""
    day = two_stops_apart()
    assert day.says(SECOND) == RECOVERS
    day.off(THIRD)
    assert not day.confirm(THIRD, 2)
    day.depart(SECOND)
    assert not day.confirm(THIRD, 2)
    day = two_stops_apart()
    day.off(THIRD)
    assert day.confirm(THIRD, 2)
    assert day.says(SECOND) == NEITHER
    day.leave(FIRST)
    day.off(FIRST)
    day.begin(THIRD, 1)
    assert day.says(SECOND) == NEITHER
    day.depart(THIRD)
    assert day.says(SECOND) == RECOVERS


def a_tram_that_tells_another_way_at_a_platform_of_this_one_stays_known() -> None:
    """It turns there, or its driver has chosen a wrong way; until it has left nobody recovers to that stop (G5)."""
    day = two_stops_apart()
    assert day.says(SECOND) == RECOVERS
    day.wait(1)
    before = day.system
    for tram in (FIRST, SECOND):
        assert day.step("hear_elsewhere", tram=tram, is_away=False, made_ms=before.now_ms) == before
        assert tram in day.system.bodies
        assert day.step("hear_elsewhere", tram=tram, is_away=True, made_ms=before.now_ms) == before
    day.leave(FIRST)
    assert day.step("hear_elsewhere", tram=FIRST, is_away=False, made_ms=before.now_ms) == day.system
    day.wait(1)
    day.off(FIRST)


def what_one_tram_tells_or_does_takes_nothing_from_another() -> None:
    """Reports stay under way, from this way and from elsewhere; a unit starts anew by itself alone (G3, G6)."""
    day = two_stops_apart()
    before = day.system
    day.wait(1)
    day.report(FIRST)
    day.report(SECOND)
    day.step("tell_elsewhere", tram=THIRD)
    assert len(day.system.told - before.told) == 2
    assert before.told < day.system.told
    assert before.told_elsewhere < day.system.told_elsewhere
    other = day.body(SECOND)
    day.step("restart_unit", tram=FIRST, now_ms=day.system.centre.now_ms)
    assert set(day.system.bodies) == {FIRST, SECOND}
    assert day.body(SECOND) == other


def who_is_on_the_way_does_not_come_anew() -> None:
    """It came before its confirmation was given anew (G3)."""
    day = two_stops_apart()
    body, system = day.body(FIRST), day.system
    anew = replace(system, runs={FIRST: Run(body.stop, system.now_ms)})
    here = replace(body, left=False)
    assert not world.a_tram_comes_where_and_when_it_was_confirmed(SITE, anew, FIRST, here)
    assert world.a_tram_comes_where_and_when_it_was_confirmed(SITE, replace(anew, bodies={}), FIRST, here)


def a_departure_may_be_seen_by_nobody() -> None:
    """A tram that stood at its stop is at the next one; only one that is on the way comes to any (G2)."""
    day = two_stops_apart()
    stands, event = day.body(SECOND), {"noticed": True, "stands": True}
    assert not stands.left
    day.step("arrive", tram=SECOND, told_stop=stands.stop + 1, **event)
    assert (day.body(SECOND).stop, day.body(SECOND).left) == (stands.stop + 1, False)
    system = day.system
    assert day.step("arrive", tram=THIRD, told_stop=1, **event) == system


def limits_below_zero_are_refused() -> None:
    """A centre starts with none of its times below zero, or not at all (G3 to G5)."""
    for limit in fields(DispatchLimits):
        for least_ms, starts in ((0, True), (-1, False)):
            day = two_stops_apart()
            day.site = Way(replace(SITE.limits, **{limit.name: least_ms}))
            day.step("restart_centre", now_ms=day.system.now_ms)
            assert (not day.system.centre.trams) == starts


def trams_that_reports_have_shown_in_either_order_do_not_recover() -> None:
    """Somebody tells what is not so: which of them is ahead nobody knows (G2, G6)."""
    known = Known(9, 0, 3, False, True, 900, 900, 0, 0)
    centre = Centre(1_000, 0, 19, {FIRST: known, SECOND: known}, {}, frozenset({(FIRST, SECOND)}), {})
    for shown, clear in (
        ({(FIRST, SECOND)}, True),
        ({(SECOND, FIRST)}, False),
        ({(FIRST, SECOND), (SECOND, FIRST)}, False),
        (frozenset[tuple[Tram, Tram]](), False),
    ):
        told = replace(centre, shown=frozenset(shown))
        assert dispatcher.is_clear(told, FIRST, known) == clear
        assert dispatcher.contradicts(told, FIRST, SECOND) == (len(shown) == 2)
    far = replace(known, stop=known.stop + 2)
    for shown, clear in (({(SECOND, FIRST)}, True), ({(FIRST, SECOND), (SECOND, FIRST)}, False)):
        told = replace(centre, trams={FIRST: known, SECOND: far}, shown=frozenset(shown))
        assert dispatcher.is_clear(told, FIRST, known) == clear


def who_comes_behind_matters_not() -> None:
    """At the first stop, or at one before that of the other; at its own stop, or just beyond, it may come before it."""
    for stop, says in ((0, RECOVERS), (1, NEITHER)):
        day = two_stops_apart()
        day.off(THIRD)
        assert day.confirm(THIRD, stop)
        assert day.says(SECOND) == says
    day = two_stops_apart()
    day.depart(SECOND)
    day.off(THIRD)
    assert day.confirm(THIRD, 1)
    day.wait(1)
    day.arrive(SECOND)
    assert day.says(SECOND, Hand.RECOVER) == NEITHER
    day.wait(1)
    day.begin(THIRD, 3)
    assert day.says(SECOND, Hand.RECOVER) == RECOVERS


def reports_show_who_is_ahead() -> None:
    """Two trams at one stop: which is ahead follows from where the other stood before, and from nothing else (G2)."""
    day = Day()
    day.come(FIRST, 1, 1)
    day.come(SECOND, 2, 1)
    assert day.says(FIRST, Hand.RECOVER) == NEITHER
    day = holds.at_one_stop()
    assert (FIRST, SECOND) in day.system.centre.shown
    assert day.says(FIRST, Hand.RECOVER) == RECOVERS
    day = Day()
    day.come(FIRST, 1, 0)
    day.depart(FIRST)
    day.off(SECOND)
    day.off(THIRD)
    assert day.confirm(SECOND, 0)
    assert day.confirm(THIRD, 0)
    day.begin(THIRD, 2)
    day.begin(SECOND, 3)
    assert {(FIRST, SECOND), (FIRST, THIRD)} == day.system.centre.shown
    for tram in (SECOND, THIRD):
        assert day.says(tram, Hand.RECOVER) != RECOVERS
    day.arrive(FIRST)
    day.depart(FIRST)
    for tram in (SECOND, THIRD):
        assert day.says(tram, Hand.LIFT) == NEITHER
        assert day.system.given.way_unknown == (tram == SECOND)
    day.wait(61_000)
    for tram in (SECOND, THIRD):
        day.tell(tram)
        assert day.says(tram, Hand.RECOVER) == NEITHER
    day.depart(THIRD)
    day.wait(1)
    day.tell(SECOND)
    assert (THIRD, SECOND) not in day.system.centre.shown
    day.arrive(THIRD)
    day.wait(61_000)
    day.tell(THIRD)
    day.wait(1)
    day.tell(SECOND)
    assert (THIRD, SECOND) in day.system.centre.shown
    assert (SECOND, THIRD) not in day.system.centre.shown
    assert day.says(THIRD, Hand.RECOVER) == NEITHER
    day.arrive(FIRST)
    day.depart(FIRST)
    assert day.says(THIRD, Hand.RECOVER) == RECOVERS
    assert day.says(SECOND, Hand.RECOVER) == NEITHER


def who_queues_beyond_a_stop_is_ahead_of_nobody() -> None:
    """At a signal beyond it GPS has the one behind leave, and the one in front still stand there (G2, ours)."""
    day = Day()
    day.come(FIRST, 1, 0)
    day.come(SECOND, 2, 0)
    day.step("depart", tram=FIRST)
    day.depart(SECOND)
    day.wait(1)
    told = Report(0, False, True, TERMINUS, day.system.now_ms)
    day.step("tell", tram=FIRST, report=told)
    day.step("hear_report", tram=FIRST, told=told)
    assert (day.known(FIRST).told_ms, day.known(FIRST).stands) == (told.made_ms, True)
    assert (SECOND, FIRST) not in day.system.centre.shown


def points_beyond_a_stop_let_one_come_before_who_has_left_it() -> None:
    """A tram has left the stop, and waits before the points by which another comes: neither is shown ahead (G2)."""
    day = Day()
    day.run_to(FIRST, 1, 2)
    day.depart(FIRST)
    day.off(SECOND)
    assert day.confirm(SECOND, 2)
    assert not day.system.centre.shown
    now_ms = day.system.now_ms
    body = Body(0, 2, True, on_board.begun(0), 0)
    day.step("come", tram=SECOND, body=body, now_ms=now_ms, begun_ms=now_ms)
    assert day.body(SECOND).rank < day.body(FIRST).rank


WITNESSES = (
    who_comes_behind_matters_not,
    reports_show_who_is_ahead,
    who_queues_beyond_a_stop_is_ahead_of_nobody,
    points_beyond_a_stop_let_one_come_before_who_has_left_it,
    trams_that_reports_have_shown_in_either_order_do_not_recover,
    what_was_told_of_the_other_way_ends_no_run_on_this_one,
    a_tram_of_the_other_line_joins_where_nobody_may_run_faster_to,
    a_tram_that_tells_another_way_at_a_platform_of_this_one_stays_known,
    what_one_tram_tells_or_does_takes_nothing_from_another,
    who_is_on_the_way_does_not_come_anew,
    a_departure_may_be_seen_by_nobody,
    limits_below_zero_are_refused,
)
