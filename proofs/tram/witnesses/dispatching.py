"""Trams that are held, recover, bunch, turn off and turn back, with a radio that loses and repeats (G4 to G6)."""

from __future__ import annotations

from dataclasses import replace

from kernel.tram import display as on_board
from kernel.tram.centre import Tram
from kernel.tram.dispatching import Hand, Order, Report, is_beyond_its_destination, mark
from models.tram.dispatching import Body, Given, place
from proofs.tram.witnesses import holds, too_soon, ways
from proofs.tram.witnesses import on_board as orders_shown
from proofs.tram.witnesses.line import (
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

# ---- recovery


def a_tram_recovers_to_the_next_stop() -> None:
    """The tram ahead left long ago and is past the next stop: one section faster, then no more (3.2.2; G5)."""
    day = two_stops_apart()
    order = day.order(SECOND)
    assert (order.stop, order.holds, order.recovers) == (1, False, True)
    assert day.system.given == Given(holds=False, recovers=True, own_unknown=False, way_unknown=False)
    assert day.known(SECOND).recovery_to == 2
    assert day.deliver(SECOND, order) == RECOVERS
    assert day.body(SECOND).taken_at == 1
    day.depart(SECOND)
    day.wait(60_000)
    assert day.body(SECOND).display.recovers
    day.arrive(SECOND)
    assert not day.body(SECOND).display.recovers


def none_recovers_sooner() -> None:
    """One ms less since the tram ahead left: not yet; by hand it is (3.2.2; G5)."""
    day = two_stops_apart(since_ms=239_999)
    assert day.says(SECOND) == NEITHER
    assert day.says(SECOND, Hand.RECOVER) == RECOVERS


def none_recovers_towards_a_tram_at_the_next_stop() -> None:
    """It stands there, and left long ago; nor by hand: the way is not known clear (G5)."""
    day = two_stops_apart(ahead_stops=1)
    assert place(day.body(FIRST)) == mark(2, True)
    assert day.says(SECOND) == RECOVERS
    day = Day()
    day.come(FIRST, 1, 1)
    day.depart(FIRST)
    day.wait(10)
    day.arrive(FIRST)
    day.come(SECOND, 2, 1)
    day.wait(300_000)
    day.tell(SECOND)
    assert day.says(SECOND) == NEITHER
    assert day.says(SECOND, Hand.RECOVER) == NEITHER
    assert day.system.given.way_unknown
    day.depart(FIRST, tells=False)
    day.wait(1)
    assert day.says(SECOND, Hand.RECOVER) == NEITHER
    assert not day.system.given.way_unknown


def a_lost_departure_counts_as_present() -> None:
    """The tram ahead is gone far, and the radio has lost all of it: it counts as where it was told last (G6)."""
    day = two_stops_apart(ahead_stops=0)
    for _ in range(4):
        day.step("arrive", tram=FIRST, noticed=True, told_stop=day.body(FIRST).stop + 1, stands=True)
        day.step("depart", tram=FIRST)
    day.see(FIRST, stands=False)
    assert day.says(SECOND, Hand.LIFT) == NEITHER
    day.wait(60_000)
    day.tell(SECOND)
    assert day.says(SECOND, Hand.RECOVER) == NEITHER
    day.tell(FIRST)
    assert day.says(SECOND) == RECOVERS


def turning_off(leaves_at: int) -> Day:
    """Two trams at one stop for minutes; the first one is set to leave so far on."""
    day = Day()
    day.run_to(FIRST, 1, 1, leaves_at)
    day.wait(300_000)
    day.run_to(SECOND, 2, 1)
    day.wait(60_000)
    day.tell(SECOND)
    return day


def one_that_turns_off_is_off_once_it_says_so() -> None:
    """It is set to leave where the other stands; that may be wrong, so it counts until it tells from elsewhere (G5)."""
    for leaves_at in (1, 2):
        day = turning_off(leaves_at)
        assert day.says(SECOND, Hand.RECOVER) == NEITHER
        assert day.system.given.way_unknown
        day.leave(FIRST)
        assert day.says(SECOND, Hand.RECOVER) == NEITHER
        given = day.system.given
        assert not given.way_unknown
        day.off(FIRST)
        assert day.says(SECOND) == RECOVERS


def one_that_runs_beyond_its_destination_is_in_the_way() -> None:
    """It was set to leave at the stop where the other stands, and runs straight on: a wrong setting (002, 4.2; G5)."""
    day = turning_off(1)
    day.depart(FIRST)
    assert is_beyond_its_destination(day.known(FIRST))
    day.wait(240_000)
    day.tell(SECOND)
    assert day.says(SECOND) == NEITHER
    assert day.says(SECOND, Hand.RECOVER) == NEITHER
    assert day.system.given.way_unknown
    day.arrive(FIRST)
    assert day.says(SECOND, Hand.RECOVER) == NEITHER
    day.depart(FIRST)
    assert day.says(SECOND, Hand.RECOVER) == RECOVERS
    day.arrive(FIRST)
    assert not is_beyond_its_destination(replace(day.known(FIRST), leaves_at=3))
    assert day.says(FIRST, Hand.RECOVER) == NEITHER


def a_deaf_tram_is_taken_off_by_a_person() -> None:
    """Its radio tells nothing from elsewhere; a person takes it off, once it is, and then it may be taken up (G5)."""
    day = turning_off(1)
    before = day.system
    assert day.step("take_off", tram=FIRST) == before
    day.leave(FIRST)
    assert not day.confirm(FIRST, 0)
    day.step("take_off", tram=FIRST)
    assert FIRST not in day.system.centre.trams
    assert day.system.centre.elsewhere_ms[FIRST] == day.system.now_ms
    assert day.says(SECOND) == RECOVERS
    assert day.confirm(FIRST, 0)
    before = day.system
    assert day.step("take_off", tram=FIRST) == before
    day.wait(60_001)
    day.step("take_off", tram=FIRST)
    assert FIRST not in day.system.centre.trams
    before = day.system
    assert day.step("take_off", tram=FIRST) == before


def a_tram_gets_no_order_where_it_leaves() -> None:
    """Beyond its last stop of this way nobody here knows what is ahead (4.2; G5)."""
    for leaves_at, says in ((1, NEITHER), (2, RECOVERS)):
        day = Day()
        day.run_to(FIRST, 1, 1, leaves_at)
        assert day.says(FIRST) == says
        assert day.says(FIRST, Hand.HOLD) == (NEITHER if leaves_at == 1 else HELD)


def a_destination_that_is_told_farther_counts() -> None:
    """A driver shows another destination: of two the farther one counts; a hold goes by it (G4, G5)."""
    day = Day()
    day.come(FIRST, 1, 1, 1)
    day.come(SECOND, 2, 1)
    assert day.says(SECOND, Hand.RECOVER) == NEITHER
    now_ms = day.system.centre.now_ms
    for shown, counts in ((9, 9), (3, 9)):
        told = Report(1, False, True, shown, now_ms)
        day.step("tell", tram=FIRST, report=told)
        day.step("hear_report", tram=FIRST, told=told)
        assert day.known(FIRST).leaves_at == counts
    assert day.says(SECOND, Hand.RECOVER) == HELD
    day.wait(61_000)
    day.tell(SECOND)
    assert day.says(SECOND, Hand.RECOVER) == NEITHER


def none_is_taken_up_before_one_that_recovers() -> None:
    """A tram from the depot waits until the other has told that it arrived; farther on it may come (G5)."""
    day = two_stops_apart()
    assert day.says(SECOND) == RECOVERS
    day.off(THIRD)
    for stop in (1, 2, -1):
        assert not day.confirm(THIRD, stop)
    day.depart(SECOND)
    for stop in (1, 2):
        assert not day.confirm(THIRD, stop)
    for stop in (0, 3):
        day = two_stops_apart()
        day.arrive(FIRST)
        assert day.says(SECOND) == RECOVERS
        day.off(THIRD)
        assert day.confirm(THIRD, stop)
        if stop == 0:
            day.begin(THIRD, 3)
    day = two_stops_apart()
    assert day.says(SECOND) == RECOVERS
    day.depart(SECOND)
    day.wait(1)
    day.arrive(SECOND)
    day.off(THIRD)
    assert day.confirm(THIRD, 2)


def who_is_on_the_way_is_not_taken_up_anew() -> None:
    """Nor who may be: it has to tell from elsewhere first, and after it was last heard on the way (G5)."""
    day = two_stops_apart()
    assert not day.confirm(SECOND, 0)
    assert not day.confirm(THIRD, 0)
    day.arrive(FIRST)
    now_ms = day.system.now_ms
    day.leave(FIRST)
    day.step("tell_elsewhere", tram=FIRST)
    before = day.system
    assert day.step("hear_elsewhere", tram=FIRST, is_away=True, made_ms=now_ms) == before
    assert day.step("hear_elsewhere", tram=FIRST, is_away=True, made_ms=now_ms + 1) == before
    assert not day.confirm(FIRST, 0)
    day.wait(1)
    day.off(FIRST)
    assert not any(FIRST in pair for pair in day.system.centre.shown)
    late = now_ms + 1
    assert day.confirm(FIRST, 0)
    before = day.system
    day.wait(1)
    day.step("tell_elsewhere", tram=FIRST)
    before = day.system
    assert day.step("hear_elsewhere", tram=FIRST, is_away=True, made_ms=late + 1) == before
    day.begin(FIRST, 3)
    before = day.system
    assert day.step("tell_elsewhere", tram=FIRST) == before
    assert day.step("hear_elsewhere", tram=FIRST, is_away=True, made_ms=late + 1) == before


def after_a_start_nobody_recovers_until_the_way_is_known() -> None:
    """The centre starts anew with trams on the way: whoever is taken up first might run into them (G5, G6)."""
    day = two_stops_apart()
    recovery = day.order(SECOND)
    now_ms = day.system.now_ms
    before = day.system
    assert day.step("restart_centre", now_ms=now_ms + 1) == before
    day.step("restart_centre", now_ms=now_ms)
    centre = day.system.centre
    assert (centre.now_ms, centre.opens_ms, centre.cleared) == (now_ms, now_ms + LIMITS.coming_ms, -1)
    assert not any((centre.trams, centre.left_ms, centre.shown, centre.elsewhere_ms))
    assert day.deliver(SECOND, recovery) == RECOVERS
    assert day.says(SECOND, Hand.HOLD) == NEITHER
    day.off_in_vain(THIRD)
    day.wait(LIMITS.coming_ms)
    day.off_in_vain(THIRD)
    day.wait(1)
    day.off(THIRD)
    assert not day.confirm(THIRD, 1)
    assert not day.confirm(SECOND, 0)
    assert day.confirm(THIRD, 0)
    day.begin(THIRD, 3)
    assert day.system.centre.cleared == -1
    assert day.says(THIRD, Hand.RECOVER) == NEITHER
    for _ in range(2):
        day.depart(SECOND, tells=False)
        day.arrive(SECOND, tells=False)
    day.depart(THIRD)
    day.arrive(THIRD)
    assert day.says(THIRD, Hand.RECOVER) == NEITHER
    assert day.system.given.way_unknown is False
    assert day.system.centre.cleared == mark(0, True)
    fourth = Tram("17")
    day.run_to(fourth, 4, 1)
    day.depart(THIRD)
    assert day.system.centre.cleared == mark(1, True)
    day.arrive(THIRD)
    assert day.system.centre.cleared == mark(1, True)
    day.depart(THIRD)
    assert day.system.centre.cleared == mark(2, True)
    day.wait(240_000)
    for tram in (fourth, SECOND):
        day.step("hear_report", tram=tram, told=day.report(tram))
    assert SECOND not in day.system.centre.trams
    assert day.says(fourth) == RECOVERS
    day.off(EARLY)
    assert not day.confirm(EARLY, 1)
    day.depart(fourth)
    day.wait(1)
    day.arrive(fourth)
    assert day.confirm(EARLY, 0)


def who_was_confirmed_before_a_start_still_comes() -> None:
    """It comes by the confirmation that it has, unknown, before anything counts; afterwards it may not (G5, G6)."""
    for waits_ms, comes in ((60_000, True), (60_001, False)):
        day = Day()
        day.off(FIRST)
        assert day.confirm(FIRST, 1)
        day.step("restart_centre", now_ms=day.system.now_ms)
        day.wait(waits_ms)
        body = Body(1, 1, False, display=on_board.begun(0), taken_at=1)
        day.step("come", tram=FIRST, body=body, now_ms=day.system.now_ms, begun_ms=day.system.now_ms)
        assert (FIRST in day.system.bodies) == comes


# ---- what is not known


def stale_means_no_command() -> None:
    """11 s are new enough, 1 ms more is not; by hand neither (G3, G6)."""
    day = two_stops_apart()
    day.wait(11_000)
    assert day.says(SECOND) == RECOVERS
    day.wait(1)
    for hand in Hand:
        assert day.says(SECOND, hand) == NEITHER
        assert day.system.given.own_unknown
    day.see(SECOND, stands=False)
    day.tell(SECOND)
    assert day.says(SECOND) == NEITHER
    assert day.system.given.own_unknown


def a_stranger_gets_no_command() -> None:
    """The centre does not know it, and notes nothing (G6)."""
    day = Day()
    day.step("hear_report", tram=FIRST, told=Report(1, False, True, 9, 2_000_000))
    assert FIRST not in day.system.centre.trams
    before = day.system.centre
    assert day.order(FIRST, Hand.RECOVER) == Order(0, False, False, day.system.now_ms)
    assert day.system.given == Given(holds=False, recovers=False, own_unknown=True, way_unknown=False)
    assert day.system.centre == before


def what_contradicts_is_not_taken() -> None:
    """Of the run before, older than the last, of the future, or backwards (G3, G6)."""
    day = Day()
    day.run_to(FIRST, 1, 1, 3)
    day.wait(10)
    old = day.report(FIRST)
    day.leave(FIRST)
    day.wait(1)
    day.off(FIRST)
    day.come(FIRST, 1, 0, 3, tells=False)
    before = day.system
    assert day.step("hear_report", tram=FIRST, told=old) == before
    day = two_stops_apart()
    day.wait(1)
    older = day.report(FIRST)
    day.wait(1)
    newer = day.report(FIRST)
    day.step("hear_report", tram=FIRST, told=newer)
    assert day.known(FIRST).told_ms == newer.made_ms
    before = day.system
    assert day.step("hear_report", tram=FIRST, told=older) == before
    day.wait(1)
    behind = Report(4, False, False, TERMINUS, day.system.now_ms)
    day.step("tell", tram=FIRST, report=behind)
    before = day.system
    assert day.step("hear_report", tram=FIRST, told=behind) == before
    day.step("hear_report", tram=FIRST, told=day.report(FIRST))
    assert day.known(FIRST).told_ms == day.system.now_ms


def a_tram_that_comes_back_is_not_where_it_was() -> None:
    """A report of its last run comes late, after it was taken up for the next (G6)."""
    day = Day()
    day.come(FIRST, 1, 1, 3)
    day.depart(FIRST)
    day.wait(1)
    day.arrive(FIRST)
    day.wait(1)
    late = day.report(FIRST)
    day.leave(FIRST)
    day.wait(1)
    day.come(FIRST, 5, 0, 9)
    day.step("hear_report", tram=FIRST, told=late)
    assert day.known(FIRST).stop == 0
    assert day.body(FIRST).stop == 0


def when_it_stands_is_told_once() -> None:
    """When a tram arrived is when it first told of that stop since it was confirmed, standing or not (G4)."""
    day = Day()
    day.come(FIRST, 1, 1)
    first_ms = day.known(FIRST).since_ms + 1
    day.see(FIRST, stands=False)
    day.tell(FIRST)
    day.wait(10)
    day.see(FIRST)
    day.tell(FIRST)
    day.wait(10)
    day.tell(FIRST)
    assert day.known(FIRST).arrived_ms == first_ms
    day.depart(FIRST)
    day.wait(10)
    day.arrive(FIRST)
    assert day.known(FIRST).arrived_ms == first_ms + 32


WITNESSES = (
    *orders_shown.WITNESSES,
    *holds.WITNESSES,
    *ways.WITNESSES,
    *too_soon.WITNESSES,
    a_tram_recovers_to_the_next_stop,
    none_recovers_sooner,
    none_recovers_towards_a_tram_at_the_next_stop,
    a_lost_departure_counts_as_present,
    one_that_turns_off_is_off_once_it_says_so,
    one_that_runs_beyond_its_destination_is_in_the_way,
    a_deaf_tram_is_taken_off_by_a_person,
    a_tram_gets_no_order_where_it_leaves,
    a_destination_that_is_told_farther_counts,
    none_is_taken_up_before_one_that_recovers,
    who_is_on_the_way_is_not_taken_up_anew,
    after_a_start_nobody_recovers_until_the_way_is_known,
    who_was_confirmed_before_a_start_still_comes,
    stale_means_no_command,
    a_stranger_gets_no_command,
    what_contradicts_is_not_taken,
    a_tram_that_comes_back_is_not_where_it_was,
    when_it_stands_is_told_once,
)
