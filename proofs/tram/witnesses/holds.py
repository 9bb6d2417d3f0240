"""Trams that are held at a stop, by the one ahead and the one behind (G4)."""

from __future__ import annotations

from kernel.tram.centre import Tram
from kernel.tram.dispatching import Hand, is_beyond_its_destination
from proofs.tram.witnesses.line import (
    CLEARED,
    FIRST,
    HELD,
    NEITHER,
    RECOVERS,
    SECOND,
    THIRD,
    Day,
    two_stops_apart,
)


def a_tram_is_held_close_behind() -> None:
    """The tram ahead left less than two minutes ago; lifted by hand, by time, and after a minute anyway (G4)."""
    for since_ms, says in ((119_999, HELD), (120_000, NEITHER)):
        day = two_stops_apart(since_ms=since_ms)
        assert day.says(SECOND) == says
    day = two_stops_apart(since_ms=30_000)
    order = day.order(SECOND)
    assert day.deliver(SECOND, order) == HELD
    assert day.known(SECOND).recovery_to == 0
    assert day.says(SECOND, Hand.LIFT) == NEITHER
    assert day.says(SECOND, Hand.RECOVER) == HELD
    arrived_ms = day.known(SECOND).arrived_ms
    day.wait(arrived_ms + 59_999 - day.system.centre.now_ms)
    day.tell(SECOND)
    assert day.says(SECOND) == HELD
    day.wait(1)
    assert day.says(SECOND) == NEITHER
    assert day.says(SECOND, Hand.HOLD) == HELD


def a_hold_ends_though_the_place_is_lost_now_and_then() -> None:
    """Under a roof every third report is without GPS; the minute counts from the first report at the stop (G4)."""
    day = two_stops_apart(since_ms=30_000)
    arrived_ms = day.known(SECOND).arrived_ms
    for second in range(7, 57, 7):
        day.wait(arrived_ms + 1_000 * second - day.system.centre.now_ms)
        is_seen = second % 3 > 0
        day.see(SECOND, is_located=is_seen)
        day.tell(SECOND)
        assert day.known(SECOND).arrived_ms == arrived_ms
        assert day.says(SECOND) == (HELD if is_seen else NEITHER)
    day.wait(arrived_ms + 59_999 - day.system.centre.now_ms)
    day.see(SECOND)
    day.tell(SECOND)
    assert day.says(SECOND) == HELD
    day.wait(1)
    assert day.says(SECOND) == NEITHER
    day.depart(SECOND)
    assert day.known(SECOND).arrived_ms == arrived_ms
    day.wait(30_000)
    day.arrive(SECOND)
    assert day.known(SECOND).arrived_ms == day.system.centre.now_ms


def a_hold_beats_a_recovery() -> None:
    """What comes later counts: a recovery, then a hold by hand, then the recovery once more from the air (G4)."""
    day = two_stops_apart()
    recovery = day.order(SECOND)
    assert day.deliver(SECOND, recovery) == RECOVERS
    day.wait(1_000)
    hold = day.order(SECOND, Hand.HOLD)
    assert day.deliver(SECOND, hold) == HELD
    assert day.deliver(SECOND, recovery) == HELD
    day.wait(1_000)
    assert day.deliver(SECOND, day.order(SECOND, Hand.LIFT)) == NEITHER
    day.wait(1_000)
    assert day.deliver(SECOND, day.order(SECOND, Hand.HOLD)) == HELD
    day.depart(SECOND)
    assert not day.body(SECOND).display.holds


def at_one_stop() -> Day:
    """Two trams at one stop, of which the second came at the first stop of the way when the other was on it."""
    day = Day()
    day.run_to(FIRST, 1, 1)
    day.run_to(SECOND, 2, 1)
    day.tell(FIRST)
    return day


def a_tram_before_the_next_stop_holds() -> None:
    """Car 13 of figure 8: car 11 stands before it, or has left for the next stop; there, it holds no more (G4)."""
    day = at_one_stop()
    assert day.says(SECOND) == HELD
    day.wait(11_001)
    day.tell(SECOND)
    assert day.says(SECOND) == NEITHER
    day.tell(FIRST)
    assert day.says(SECOND) == HELD
    assert day.says(FIRST, Hand.RECOVER) == RECOVERS
    day.off(THIRD)
    assert day.confirm(THIRD, 0)
    assert day.says(FIRST, Hand.RECOVER) == RECOVERS
    for since_ms, says in ((239_999, HELD), (240_000, NEITHER)):
        day = Day()
        day.come(FIRST, 1, 1)
        day.depart(FIRST)
        day.wait(since_ms - 1)
        day.come(SECOND, 2, 1)
        assert day.says(SECOND) == says
        day.arrive(FIRST)
        assert day.says(SECOND) == NEITHER
    day = Day()
    day.come(FIRST, 1, 1, 1)
    day.come(SECOND, 2, 1)
    assert day.says(SECOND) == NEITHER
    day.leave(SECOND)
    day.step("take_off", tram=SECOND)
    day.wait(1)
    day.depart(FIRST)
    day.wait(130_000)
    day.come(SECOND, 2, 0)
    day.depart(SECOND)
    day.wait(1)
    day.arrive(SECOND)
    assert is_beyond_its_destination(day.known(FIRST))
    assert day.says(SECOND) == HELD


def one_behind_is_not_seen_ahead() -> None:
    """A tram behind at the same stop does not hold the one before it (G4)."""
    day = at_one_stop()
    assert day.says(FIRST) == RECOVERS
    assert day.says(SECOND) == HELD


def a_tram_is_held_far_before_the_next() -> None:
    """The one behind is ten minutes behind: it left its stop as long ago where that one has not come yet (G4)."""
    for since_ms, says in ((600_000, RECOVERS), (600_001, HELD)):
        day = Day()
        day.come(Tram("17"), 0, CLEARED - 1)
        day.depart(Tram("17"))
        day.come(FIRST, 1, 1)
        day.run(FIRST)
        day.wait(1)
        day.depart(FIRST)
        left_ms = day.system.centre.now_ms
        day.wait(90_000)
        day.come(SECOND, 2, 1)
        day.wait(left_ms + since_ms - 1_000 - day.system.centre.now_ms)
        day.arrive(FIRST)
        day.wait(left_ms + since_ms - day.system.centre.now_ms)
        day.tell(FIRST)
        assert day.says(FIRST) == says
        day.off(THIRD)
        assert day.confirm(THIRD, 2)
        assert day.says(FIRST) == RECOVERS


def a_departure_of_the_run_before_does_not_count() -> None:
    """Neither for how far the next is behind, nor for how near the one before is (G4)."""
    day = Day()
    day.come(FIRST, 1, 1, 3)
    day.run(FIRST)
    day.run(FIRST)
    day.leave(FIRST)
    day.wait(700_000)
    day.run_to(FIRST, 3, 1, 3)
    day.come(SECOND, 4, 0)
    assert (FIRST, 1) in day.system.centre.left_ms
    assert day.says(FIRST) == RECOVERS
    day = Day()
    day.come(SECOND, 0, 1, 2)
    day.depart(SECOND)
    day.wait(1)
    day.arrive(SECOND)
    day.run_to(FIRST, 2, 1)
    assert day.says(FIRST) == HELD
    day.leave(SECOND)
    day.wait(1)
    day.off(SECOND)
    assert day.confirm(SECOND, 0)
    assert (SECOND, 1) in day.system.centre.left_ms
    assert day.says(FIRST) == RECOVERS


def a_lost_departure_is_made_up_for() -> None:
    """The next stop's arrival tells it, later than it was; one that was told stays as it was (G4)."""
    day = Day()
    day.run_to(FIRST, 1, 1)
    day.depart(FIRST, tells=False)
    day.wait(5_000)
    assert (FIRST, 1) not in day.system.centre.left_ms
    day.arrive(FIRST)
    assert day.system.centre.left_ms[FIRST, 1] == day.system.centre.now_ms
    left_ms = day.system.centre.now_ms + 10
    day.wait(10)
    day.depart(FIRST)
    day.wait(5_000)
    day.arrive(FIRST)
    of_first = {stop: at_ms for (tram, stop), at_ms in day.system.centre.left_ms.items() if tram == FIRST and stop}
    assert of_first == {1: left_ms - 10, 2: left_ms}


WITNESSES = (
    a_tram_is_held_close_behind,
    a_hold_ends_though_the_place_is_lost_now_and_then,
    a_hold_beats_a_recovery,
    a_tram_before_the_next_stop_holds,
    one_behind_is_not_seen_ahead,
    a_tram_is_held_far_before_the_next,
    a_departure_of_the_run_before_does_not_count,
    a_lost_departure_is_made_up_for,
)
