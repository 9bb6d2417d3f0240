"""Trams that tell of the way while they are not on it: its driver has set it too soon, or has left it so (G2, G5)."""

from __future__ import annotations

from dataclasses import replace

from kernel.tram.centre import Tram
from kernel.tram.dispatching import Hand, Report, mark
from kernel.tram.display import begun
from models.tram.dispatching import Body
from proofs.tram.witnesses.line import (
    CLEARED,
    EARLY,
    FIRST,
    HELD,
    LIMITS,
    NEITHER,
    RECOVERS,
    SECOND,
    TERMINUS,
    THIRD,
    Day,
    two_stops_apart,
)


def with_a_stranger() -> Day:
    """A tram that the centre does not know stands at the second stop; another one is confirmed for the first."""
    day = Day(is_cleared=False)
    day.wait(LIMITS.coming_ms + 1)
    day.run_to(FIRST, 1, 1)
    day.step("restart_centre", now_ms=day.system.now_ms)
    day.wait(LIMITS.coming_ms + 1)
    day.off(SECOND)
    assert day.confirm(SECOND, 0)
    day.wait(10_000)
    return day


def who_is_to_come_clears_no_way_beside_it() -> None:
    """Its driver sets the way at once, on the other one, beside a stop far on; a third comes at the first (G5)."""
    day = with_a_stranger()
    known = day.known(SECOND)
    told = day.tell_beside(SECOND, 3, stands=False)
    assert day.known(SECOND) == replace(known, told_ms=told.made_ms)
    day.off(THIRD)
    assert day.confirm(THIRD, 0)
    day.begin(THIRD, 2)
    assert day.says(THIRD, Hand.RECOVER) == NEITHER
    day.depart(THIRD)
    assert day.system.centre.cleared == mark(0, True)


def a_run_that_is_still_to_come_stays_confirmed() -> None:
    """It tells of the stop where it is to come, beside it, and then from the other way that it is away (G5)."""
    day = Day()
    day.off(FIRST)
    assert day.confirm(FIRST, 0)
    day.wait(1)
    told = day.tell_beside(FIRST, 0, stands=True)
    assert (day.known(FIRST).told_ms, day.known(FIRST).stands) == (told.made_ms, True)
    day.wait(1)
    day.step("tell_elsewhere", tram=FIRST)
    before = day.system
    assert day.step("hear_elsewhere", tram=FIRST, is_away=True, made_ms=before.now_ms) == before
    known = day.known(FIRST)
    told = day.tell_beside(FIRST, 3, stands=True)
    assert day.known(FIRST) == replace(known, told_ms=told.made_ms, stands=False)
    day.begin(FIRST, 1)
    day.depart(FIRST)
    assert (day.known(FIRST).stop, day.known(FIRST).left) == (0, True)


def who_is_to_come_is_ahead_of_nobody() -> None:
    """It stands beside the stop where it is to come; one that is behind that runs on, and is before it then (G2)."""
    day = Day()
    day.run_to(FIRST, 1, 1)
    day.off(SECOND)
    assert day.confirm(SECOND, 2)
    day.wait(1)
    day.tell_beside(SECOND, 2, stands=True)
    day.wait(1)
    day.tell(FIRST)
    assert not day.system.centre.shown
    day.off(THIRD)
    assert day.confirm(THIRD, 0)
    assert day.system.centre.shown == {(FIRST, THIRD)}


def none_recovers_where_it_comes() -> None:
    """Nothing is ahead, and by hand neither: another one may come before it; it may be held, and recover farther on."""
    day = Day()
    day.off(FIRST)
    assert day.confirm(FIRST, 0)
    day.wait(1)
    day.tell_beside(FIRST, 0, stands=True)
    for hand, says in ((Hand.NOTHING, NEITHER), (Hand.RECOVER, NEITHER), (Hand.HOLD, HELD)):
        assert day.says(FIRST, hand) == says
    day.begin(FIRST, 1)
    assert day.says(FIRST, Hand.RECOVER) == NEITHER
    day.depart(FIRST)
    day.arrive(FIRST)
    assert day.says(FIRST) == RECOVERS


def none_recovers_over_a_stop_that_is_not_cleared_yet() -> None:
    """Who cleared the way has left it at the second stop: beyond that one a tram may stand that nobody knows (G5)."""
    day = Day(is_cleared=False)
    day.wait(LIMITS.coming_ms + 1)
    day.run_to(FIRST, 1, 1)
    day.depart(FIRST)
    assert day.system.centre.cleared == mark(1, True)
    day.leave(FIRST)
    day.wait(1)
    day.off(FIRST)
    day.come(SECOND, 2, 0)
    day.depart(SECOND)
    day.arrive(SECOND)
    for hand in (Hand.NOTHING, Hand.RECOVER):
        assert day.says(SECOND, hand) == NEITHER


def who_comes_may_take_what_was_ordered_since_it_was_confirmed() -> None:
    """Its unit began when the way was set; before it was confirmed nothing was made for it that counts (G6)."""
    day = Day()
    day.off(FIRST)
    assert day.confirm(FIRST, 0)
    confirmed_ms = day.system.now_ms
    day.wait(1)
    day.tell_beside(FIRST, 0, stands=True)
    hold = day.order(FIRST, Hand.HOLD)
    day.wait(1)
    now_ms = day.system.now_ms
    event = {"tram": FIRST, "body": Body(1, 0, False, begun(0), 0), "now_ms": now_ms}
    before = day.system
    for begun_ms in (confirmed_ms - 1, now_ms + 1):
        assert day.step("come", begun_ms=begun_ms, **event) == before
    day.step("come", begun_ms=confirmed_ms, **event)
    assert day.body(FIRST).display == replace(begun(now_ms), made_ms=confirmed_ms)
    day.see(FIRST)
    assert day.deliver(FIRST, hold) == HELD


def who_has_left_the_way_clears_no_more_of_it() -> None:
    """It has turned off, the way is still set, and it comes beside a stop farther on (G5)."""
    day = with_a_stranger()
    day.begin(SECOND, 2)
    day.depart(SECOND)
    day.leave(SECOND)
    day.wait(1)
    day.tell_beside(SECOND, 3, stands=True)
    assert day.known(SECOND).stop == 3
    assert day.system.centre.cleared == mark(0, True)
    day.wait(1)
    day.off(SECOND)


def tells_of_the_run_before(day: Day, tram: Tram, stop: int) -> None:
    """A tram whose unit nobody has set anew tells that it has left a stop, and nothing is taken from that."""
    told = Report(stop, True, False, TERMINUS, day.system.now_ms)
    day.step("tell_of_the_run_before", tram=tram, report=told)
    before = day.system
    assert (tram, told) in before.told_beside
    assert day.step("hear_report", tram=tram, told=told) == before


def what_is_told_of_the_run_before_does_not_count() -> None:
    """It turned off and was taken off; its unit stays as it was, and tells so before it comes, and when it has (G2)."""
    day = with_a_stranger()
    for _ in range(2):
        day.wait(1)
        tells_of_the_run_before(day, SECOND, 5)
    day.begin(SECOND, 2, tells=False)
    tells_of_the_run_before(day, SECOND, 5)
    day.tell(SECOND)
    assert SECOND not in day.system.unset
    late = Report(5, True, False, TERMINUS, day.system.now_ms)
    before = day.system
    assert day.step("tell_of_the_run_before", tram=SECOND, report=late) == before
    day.depart(SECOND)
    assert day.system.centre.cleared == mark(0, True)


def what_was_told_of_the_run_before_comes_too_late() -> None:
    """It was told before the first report of this run, and is heard after that (G2, G3)."""
    day = with_a_stranger()
    told = Report(5, True, False, TERMINUS, day.system.now_ms)
    day.step("tell_of_the_run_before", tram=SECOND, report=told)
    day.begin(SECOND, 2)
    before = day.system
    assert day.step("hear_report", tram=SECOND, told=told) == before


def who_is_not_heard_where_it_comes_is_under_way_after_the_next_stop() -> None:
    """Its reports from the first stop are lost; that it left that one counts not, that it left the next one does."""
    day = Day()
    day.come(FIRST, 1, 0, tells=False)
    day.depart(FIRST, tells=False)
    known = day.known(FIRST)
    day.step("hear_report", tram=FIRST, told=day.report(FIRST))
    assert day.known(FIRST) == known
    day.wait(1)
    day.arrive(FIRST, tells=False)
    now_ms = day.system.now_ms
    day.step("hear_report", tram=FIRST, told=day.report(FIRST))
    assert day.known(FIRST) == replace(known, told_ms=now_ms)
    day.wait(1)
    day.depart(FIRST)
    assert (day.known(FIRST).stop, day.known(FIRST).left) == (1, True)
    assert day.system.centre.cleared == mark(CLEARED, True)


def when_it_first_stood_there_is_of_its_stop() -> None:
    """What it told beside another stop, of which nothing was taken, is no time of arrival where it comes (G4)."""
    day = Day()
    day.off(FIRST)
    assert day.confirm(FIRST, 0)
    day.wait(1)
    day.tell_beside(FIRST, 3, stands=True)
    day.wait(10)
    day.begin(FIRST, 1)
    assert day.known(FIRST).arrived_ms == day.known(FIRST).told_ms
    arrived_ms = day.known(FIRST).arrived_ms
    day.wait(10)
    day.tell(FIRST)
    assert day.known(FIRST).arrived_ms == arrived_ms


def who_has_turned_off_may_go_on_to_tell_of_it() -> None:
    """No more than it had left, at the time that it is, and until it is confirmed anew (G2)."""
    day = Day()
    day.come(FIRST, 1, 0)
    day.depart(FIRST)
    day.arrive(FIRST)
    day.depart(FIRST, tells=False)
    day.leave(FIRST)
    assert day.system.gone_at == {FIRST: mark(1, True)} | {EARLY: mark(CLEARED, True)}
    day.wait(1)
    good = Report(1, True, False, TERMINUS, day.system.now_ms)
    before = day.system
    for bad in (replace(good, stop=2), replace(good, left=False), replace(good, made_ms=good.made_ms - 1)):
        assert day.step("tell_after_leaving", tram=FIRST, report=bad) == before
    assert day.step("tell_after_leaving", tram=SECOND, report=good) == before
    assert day.step("leave", tram=FIRST) == before
    day.step("tell_after_leaving", tram=FIRST, report=good)
    day.step("hear_report", tram=FIRST, told=good)
    assert (day.known(FIRST).stop, day.known(FIRST).left) == (1, True)
    day.wait(1)
    day.off(FIRST)
    assert day.confirm(FIRST, 0)
    assert FIRST not in day.system.gone_at
    now_good = replace(good, made_ms=day.system.now_ms)
    before = day.system
    assert day.step("tell_after_leaving", tram=FIRST, report=now_good) == before
    for bad in (replace(now_good, left=False), replace(now_good, made_ms=now_good.made_ms - 1)):
        assert day.step("tell_of_the_run_before", tram=FIRST, report=bad) == before


def who_has_no_radio_is_confirmed_by_a_persons_word() -> None:
    """It tells nothing, and the centre does not know it: a person says that it is off, once all counts again (G5)."""
    day = Day(is_cleared=False)
    before = day.system
    assert day.step("take_off", tram=FIRST) == before
    day.wait(LIMITS.coming_ms)
    before = day.system
    assert day.step("take_off", tram=FIRST) == before
    day.wait(1)
    assert not day.confirm(FIRST, 0)
    day.step("take_off", tram=FIRST)
    assert day.confirm(FIRST, 0)


def what_is_not_told_beside_the_way() -> None:
    """That a stop was left, at another time than now, or of a tram that is on it (G2)."""
    day = two_stops_apart()
    now_ms = day.system.now_ms
    good = day.tell_beside(THIRD, 1, stands=True)
    before = day.system
    for bad in (replace(good, left=True, stands=False), replace(good, made_ms=now_ms - 1)):
        assert day.step("tell_beside", tram=THIRD, report=bad) == before
        assert day.step("hear_report", tram=THIRD, told=bad) == before
    assert day.step("tell_beside", tram=SECOND, report=good) == before
    other = replace(good, stop=2)
    day.step("tell_beside", tram=THIRD, report=other)
    assert day.system.told_beside == before.told_beside | {(THIRD, other)}


WITNESSES = (
    who_is_to_come_clears_no_way_beside_it,
    a_run_that_is_still_to_come_stays_confirmed,
    who_is_to_come_is_ahead_of_nobody,
    none_recovers_where_it_comes,
    none_recovers_over_a_stop_that_is_not_cleared_yet,
    who_comes_may_take_what_was_ordered_since_it_was_confirmed,
    who_has_left_the_way_clears_no_more_of_it,
    what_is_told_of_the_run_before_does_not_count,
    what_was_told_of_the_run_before_comes_too_late,
    who_is_not_heard_where_it_comes_is_under_way_after_the_next_stop,
    when_it_first_stood_there_is_of_its_stop,
    who_has_turned_off_may_go_on_to_tell_of_it,
    who_has_no_radio_is_confirmed_by_a_persons_word,
    what_is_not_told_beside_the_way,
)
