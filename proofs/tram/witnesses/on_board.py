"""What drivers are shown, and what nature does not do: orders that come late or to others (G5, G6)."""

from __future__ import annotations

from dataclasses import replace

from kernel.tram import display as on_board
from kernel.tram.centre import Tram, received
from kernel.tram.dispatching import Hand, Order, Report
from models.tram.dispatching import Body
from proofs.tram.witnesses.line import (
    FIRST,
    HELD,
    LIMITS,
    NEITHER,
    RECOVERS,
    SECOND,
    THIRD,
    command_of,
    two_stops_apart,
)


def orders_pass_only_where_they_are_for() -> None:
    """Not to another tram, not where it moves, not at another stop, not when old, not of the run before (G6)."""
    day = two_stops_apart()
    order = day.order(SECOND)
    assert day.deliver(FIRST, order, to=SECOND) == NEITHER
    day.see(SECOND, stands=False)
    assert day.deliver(SECOND, order) == NEITHER
    day.see(SECOND)
    day.wait(11_000)
    assert day.deliver(SECOND, order) == RECOVERS
    day.wait(1)
    assert not day.body(SECOND).display.recovers
    assert day.deliver(SECOND, replace(order)) == NEITHER
    day = two_stops_apart()
    order = day.order(SECOND)
    day.wait(1)
    day.order(SECOND, Hand.HOLD)
    assert day.deliver(SECOND, order) == RECOVERS
    day = two_stops_apart()
    order = day.order(SECOND)
    day.wait(11_001)
    assert day.deliver(SECOND, order) == NEITHER
    day = two_stops_apart()
    order = day.order(SECOND)
    day.depart(SECOND)
    day.wait(1)
    day.arrive(SECOND)
    assert day.deliver(SECOND, order) == NEITHER
    assert day.body(SECOND).taken_at == 0


def a_hold_lapses_where_nothing_is_heard() -> None:
    """The radio falls silent: after 11 s the driver is on his own; running on, a recovery stays (G3, G6)."""
    day = two_stops_apart(since_ms=30_000)
    assert day.deliver(SECOND, day.order(SECOND)) == HELD
    day.wait(11_000)
    assert day.body(SECOND).display.holds
    day.wait(1)
    assert not day.body(SECOND).display.holds


def where_the_place_is_lost_so_is_the_order() -> None:
    """A street canyon: no recovery runs on over a stop that the unit does not see (G1, G6)."""
    day = two_stops_apart()
    assert day.deliver(SECOND, day.order(SECOND)) == RECOVERS
    day.depart(SECOND)
    assert day.body(SECOND).display.recovers
    day.step("take_place", tram=SECOND, is_located=False, told_stop=99, stands=False)
    assert day.body(SECOND).display.stop == 99
    assert not day.body(SECOND).display.recovers
    before = day.body(SECOND).display
    day.step("arrive", tram=SECOND, noticed=False, told_stop=7, stands=True)
    assert (day.body(SECOND).stop, day.body(SECOND).display) == (2, before)
    day.see(SECOND)
    assert not day.body(SECOND).display.recovers


def who_stands_anew_needs_a_new_order() -> None:
    """It moved up a metre: what it was shown is gone, as at a stop it would lapse (G3)."""
    day = two_stops_apart()
    assert day.deliver(SECOND, day.order(SECOND)) == RECOVERS
    day.see(SECOND)
    assert day.body(SECOND).display.recovers
    day.see(SECOND, stands=False)
    assert day.body(SECOND).display.recovers
    day.see(SECOND, stands=False)
    assert day.body(SECOND).display.recovers
    day.see(SECOND)
    assert not day.body(SECOND).display.recovers


def a_stop_that_is_passed_ends_it_too() -> None:
    """No passengers: the tram runs through, and no faster beyond (3.2.2; G5)."""
    day = two_stops_apart()
    assert day.deliver(SECOND, day.order(SECOND)) == RECOVERS
    day.depart(SECOND)
    day.wait(1)
    day.arrive(SECOND, stands=False)
    assert not day.body(SECOND).display.recovers
    assert not day.body(SECOND).display.stands


# ---- nature


def a_unit_that_starts_anew_shows_nothing() -> None:
    """It has forgotten its recovery, and takes the old one no more; a new one it takes (G5, G6)."""
    day = two_stops_apart()
    order = day.order(SECOND)
    assert day.deliver(SECOND, order) == RECOVERS
    now_ms = day.system.now_ms
    for tram, told_ms in ((SECOND, now_ms + 1), (THIRD, now_ms)):
        before = day.system
        assert day.step("restart_unit", tram=tram, now_ms=told_ms) == before
    day.step("restart_unit", tram=SECOND, now_ms=now_ms)
    assert day.body(SECOND).display == on_board.begun(now_ms)
    day.see(SECOND)
    assert day.deliver(SECOND, order) == NEITHER
    day.wait(1)
    day.tell(SECOND)
    assert day.deliver(SECOND, day.order(SECOND)) == RECOVERS


def what_nature_does_not_do() -> None:
    """No tram overtakes, comes unknown, too late or elsewhere than was said; the clock goes on (G2, G3)."""
    day = two_stops_apart(ahead_stops=0)
    before = day.system
    assert day.step("pass_time", elapsed_ms=-1) == before
    assert day.step("arrive", tram=SECOND, noticed=True, told_stop=2, stands=True) == before
    assert day.step("leave", tram=THIRD) == before
    day.depart(SECOND)
    before = day.system
    assert day.step("arrive", tram=SECOND, noticed=True, told_stop=2, stands=True) == before
    day.arrive(FIRST)
    day.arrive(SECOND)
    before = day.system
    assert day.step("depart", tram=SECOND) == before
    day.off(THIRD)
    assert day.confirm(THIRD, 1)
    now_ms = day.system.centre.now_ms
    good = Body(3, 1, False, on_board.begun(0), 0)
    assert good.display.stop == 0
    before = day.system
    for bad in (replace(good, rank=2), replace(good, rank=0), replace(good, stop=0), replace(good, stop=2)):
        assert day.step("come", tram=THIRD, body=bad, now_ms=now_ms, begun_ms=now_ms) == before
    assert day.step("come", tram=THIRD, body=good, now_ms=now_ms + 1, begun_ms=now_ms) == before
    assert day.step("depart", tram=THIRD) == before
    assert day.step("come", tram=FIRST, body=replace(good, rank=9), now_ms=now_ms, begun_ms=now_ms) == before
    day.step("come", tram=THIRD, body=good, now_ms=now_ms, begun_ms=now_ms)
    assert day.body(THIRD).rank == 3
    before = day.system
    assert day.step("come", tram=THIRD, body=good, now_ms=now_ms, begun_ms=now_ms) == before
    day.leave(FIRST)
    day.depart(SECOND)
    for stop, rank, comes in ((0, 4, True), (0, 1, False)):
        tram = Tram(str(rank))
        day.off(tram)
        assert day.confirm(tram, stop)
        before, now_ms = day.system, day.system.now_ms
        body = replace(good, rank=rank, stop=stop)
        assert (day.step("come", tram=tram, body=body, now_ms=now_ms, begun_ms=now_ms) != before) == comes


def what_trams_do_not_tell() -> None:
    """A place that they have not reached, another time, another stop where they stand; nor the radio for them (G3)."""
    day = two_stops_apart(ahead_stops=0)
    now_ms = day.system.now_ms
    before = day.system
    good = Report(1, False, True, 9, now_ms)
    for bad in (
        replace(good, stop=2),
        replace(good, stop=0),
        replace(good, stop=2, stands=False),
        replace(good, left=True),
        replace(good, left=True, stands=False),
        replace(good, made_ms=now_ms - 1),
    ):
        assert day.step("tell", tram=SECOND, report=bad) == before
        assert day.step("hear_report", tram=SECOND, told=bad) == before
    assert day.step("tell", tram=THIRD, report=good) == before
    day.step("tell", tram=SECOND, report=replace(good, stop=0, left=True, stands=False))
    day.depart(SECOND)
    before = day.system
    assert day.step("tell", tram=SECOND, report=replace(good, left=True)) == before
    assert day.step("tell", tram=SECOND, report=good) == before


def only_what_was_sent_arrives_on_board() -> None:
    """And only to a tram that is there; the wrapper asks whose it is (G3)."""
    day = two_stops_apart()
    made = Order(1, False, True, day.system.centre.now_ms)
    before = day.system
    assert day.step("hear_order", tram=SECOND, command=command_of(SECOND, made)) == before
    assert day.step("hear_order", tram=THIRD, command=command_of(SECOND, made)) == before
    display = day.body(SECOND).display
    assert received(LIMITS, SECOND, display, command_of(SECOND, made)).recovers
    assert received(LIMITS, FIRST, display, command_of(SECOND, made)) == display


WITNESSES = (
    orders_pass_only_where_they_are_for,
    a_hold_lapses_where_nothing_is_heard,
    where_the_place_is_lost_so_is_the_order,
    who_stands_anew_needs_a_new_order,
    a_stop_that_is_passed_ends_it_too,
    a_unit_that_starts_anew_shows_nothing,
    what_nature_does_not_do,
    what_trams_do_not_tell,
    only_what_was_sent_arrives_on_board,
)
