"""What drivers are shown, and what nature does not do: orders that come late or to others (G5, G6)."""

from __future__ import annotations

from dataclasses import replace

from kernel.tram import display as on_board
from kernel.tram.centre import received
from kernel.tram.dispatching import Hand, Order
from models.tram.dispatching import Body, place
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
    assert day.body(SECOND).taken_at == 1


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


def what_nature_does_not_do() -> None:
    """No tram overtakes, comes unknown, out of turn or beyond its destination; the clock goes on (G2, G3)."""
    day = two_stops_apart(ahead_stops=0)
    before = day.system
    assert day.step("pass_time", elapsed_ms=-1) == before
    assert day.step("take_up", tram=SECOND, turn=7, stop=0, leaves_at=9) == before
    assert day.step("depart", tram=FIRST) == before
    assert day.step("arrive", tram=SECOND, noticed=True, told_stop=2, stands=True) == before
    assert day.step("leave", tram=FIRST) == before
    day.depart(SECOND)
    before = day.system
    assert day.step("arrive", tram=SECOND, noticed=True, told_stop=2, stands=True) == before
    day.arrive(FIRST)
    day.arrive(SECOND)
    before = day.system
    assert day.step("depart", tram=SECOND) == before
    now_ms = day.system.centre.now_ms
    day.step("take_up", tram=THIRD, turn=3, stop=1, leaves_at=4)
    good = Body(3, 1, False, 4, False, on_board.begun(0), 0)
    assert good.display.stop == 0
    before = day.system
    for bad in (
        replace(good, turn=4),
        replace(good, leaves_at=5),
        replace(good, stop=0),
        replace(good, stop=3),
        replace(good, stop=5),
        replace(good, is_gone=True),
    ):
        assert day.step("come", tram=THIRD, body=bad, now_ms=now_ms) == before
    assert day.step("come", tram=THIRD, body=good, now_ms=now_ms + 1) == before
    for absent in ("depart", "leave"):
        assert day.step(absent, tram=THIRD) == before
    day.step("come", tram=THIRD, body=good, now_ms=now_ms)
    assert day.body(THIRD).turn == 3
    day.step("leave", tram=FIRST)
    day.depart(SECOND)
    day.arrive(SECOND)
    assert place(day.body(SECOND)) > place(day.body(FIRST))


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
    what_nature_does_not_do,
    only_what_was_sent_arrives_on_board,
)
