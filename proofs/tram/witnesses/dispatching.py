"""Trams that are held, recover, bunch, turn off and turn back, with a radio that loses and repeats (G4 to G6)."""

from __future__ import annotations

from kernel.tram import display as on_board
from kernel.tram.dispatching import Hand, Order, Report, mark
from models.tram.dispatching import Body, Given, place
from proofs.tram.witnesses import on_board as orders_shown
from proofs.tram.witnesses.line import FIRST, HELD, NEITHER, RECOVERS, SECOND, TERMINUS, THIRD, Day, two_stops_apart

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
    assert day.says(SECOND, Hand.LIFT) == NEITHER
    day.wait(60_000)
    day.tell(SECOND)
    assert day.says(SECOND, Hand.RECOVER) == NEITHER
    day.tell(FIRST)
    assert day.says(SECOND) == RECOVERS


def turning_off(leaves_at: int) -> Day:
    """Two trams at one stop for minutes; the first one's destination is so far."""
    day = Day()
    day.come(FIRST, 1, 1, leaves_at)
    day.wait(300_000)
    day.come(SECOND, 2, 1)
    day.wait(60_000)
    day.tell(SECOND)
    return day


def one_that_turns_off_is_not_in_the_way() -> None:
    """Its destination has it leave the way where the other stands; one stop farther, and it matters (4.2; G5)."""
    for leaves_at, says in ((1, RECOVERS), (2, NEITHER)):
        assert turning_off(leaves_at).says(SECOND, Hand.RECOVER) == says
    day = turning_off(2)
    day.says(SECOND)
    assert day.system.given.way_unknown
    day = turning_off(1)
    day.says(SECOND)
    assert not day.system.given.way_unknown
    day = turning_off(2)
    day.step("take_up", tram=THIRD, turn=0, stop=1, leaves_at=TERMINUS)
    day.step("leave", tram=FIRST)
    assert (day.body(FIRST).is_gone, day.body(FIRST).left) == (True, True)
    day.says(SECOND)
    assert not day.system.given.way_unknown


def a_tram_gets_no_order_where_it_leaves() -> None:
    """Beyond its last stop of this way nobody here knows what is ahead (4.2; G5)."""
    for leaves_at, says in ((1, NEITHER), (2, RECOVERS)):
        day = Day()
        day.come(FIRST, 1, 1, leaves_at)
        assert day.says(FIRST) == says
        assert day.says(FIRST, Hand.HOLD) == (NEITHER if leaves_at == 1 else HELD)


def a_destination_that_is_told_farther_counts() -> None:
    """A driver shows another destination: the tram may be in the way then; a nearer one changes nothing (G5)."""
    day = Day()
    day.come(FIRST, 1, 1, 1)
    day.come(SECOND, 2, 1)
    now_ms = day.system.centre.now_ms
    day.step("hear_report", tram=FIRST, told=Report(1, False, True, 9, now_ms))
    assert day.known(FIRST).leaves_at == 9
    day.step("hear_report", tram=FIRST, told=Report(1, False, True, 3, now_ms))
    assert day.known(FIRST).leaves_at == 9
    assert day.says(SECOND, Hand.RECOVER) == HELD
    day.wait(61_000)
    day.tell(SECOND)
    assert day.says(SECOND, Hand.RECOVER) == NEITHER


def a_tram_taken_up_behind_matters_not() -> None:
    """Only those ahead do; where the order does not say, it is ahead (G2)."""
    day = two_stops_apart()
    day.step("take_up", tram=THIRD, turn=3, stop=1, leaves_at=TERMINUS)
    assert day.says(SECOND) == RECOVERS
    day = two_stops_apart()
    day.step("take_up", tram=THIRD, turn=2, stop=1, leaves_at=TERMINUS)
    assert day.says(SECOND) == NEITHER


def none_is_taken_up_before_one_that_recovers() -> None:
    """A tram from the depot waits until the other has been told to arrive; behind it, or farther on, it may (G5)."""
    day = two_stops_apart()
    assert day.says(SECOND) == RECOVERS
    before = day.system
    for stop, leaves_at in ((2, TERMINUS), (1, 2), (2, 2)):
        assert day.step("take_up", tram=THIRD, turn=0, stop=stop, leaves_at=leaves_at) == before
    assert day.step("take_up", tram=THIRD, turn=2, stop=2, leaves_at=TERMINUS) == before
    day.step("take_up", tram=THIRD, turn=0, stop=1, leaves_at=1)
    assert day.known(THIRD).leaves_at == 1
    day.step("take_up", tram=THIRD, turn=0, stop=3, leaves_at=TERMINUS)
    assert day.known(THIRD).stop == 3
    day.step("take_up", tram=THIRD, turn=3, stop=1, leaves_at=TERMINUS)
    assert day.known(THIRD).turn == 3
    day.depart(SECOND)
    before = day.system
    assert day.step("take_up", tram=THIRD, turn=0, stop=2, leaves_at=TERMINUS) == before
    day.wait(1)
    day.arrive(SECOND)
    day.step("take_up", tram=THIRD, turn=0, stop=2, leaves_at=TERMINUS)
    assert day.known(THIRD).turn == 0


def a_refused_tram_keeps_its_last_run() -> None:
    """It is not forgotten where it ended; taken up in earnest, it is, and begins anew (G5)."""
    day = two_stops_apart()
    day.arrive(FIRST)
    day.step("leave", tram=FIRST)
    assert day.body(FIRST).is_gone
    assert day.says(SECOND) == RECOVERS
    day.step("take_up", tram=FIRST, turn=0, stop=2, leaves_at=TERMINUS)
    assert FIRST in day.system.bodies
    day.wait(1)
    day.step("take_up", tram=FIRST, turn=3, stop=0, leaves_at=5)
    assert FIRST not in day.system.bodies
    assert SECOND in day.system.bodies
    day.depart(SECOND)
    day.step("arrive", tram=SECOND, noticed=True, told_stop=2, stands=True)
    day.step("leave", tram=SECOND)
    day.step("take_up", tram=SECOND, turn=2, stop=1, leaves_at=5)
    assert (day.known(SECOND).leaves_at, day.known(SECOND).recovery_to) == (5, 1)
    assert day.known(FIRST).arrived_ms == day.known(FIRST).told_ms == day.system.centre.now_ms


# ---- hold


def a_tram_is_held_close_behind() -> None:
    """The tram ahead left less than two minutes ago; lifted by hand, by time, and after a minute anyway (G4)."""
    for since_ms, says in ((119_999, HELD), (120_000, NEITHER)):
        day = two_stops_apart(since_ms=since_ms)
        assert day.says(SECOND) == says
    day = two_stops_apart(since_ms=30_000)
    order = day.order(SECOND)
    assert day.deliver(SECOND, order) == HELD
    assert day.known(SECOND).recovery_to == 1
    assert day.says(SECOND, Hand.LIFT) == NEITHER
    assert day.says(SECOND, Hand.RECOVER) == HELD
    arrived_ms = day.known(SECOND).arrived_ms
    day.wait(arrived_ms + 59_999 - day.system.centre.now_ms)
    day.tell(SECOND)
    assert day.says(SECOND) == HELD
    day.wait(1)
    assert day.says(SECOND) == NEITHER
    assert day.says(SECOND, Hand.HOLD) == HELD


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


def a_tram_before_the_next_stop_holds() -> None:
    """Car 13 of figure 8: car 11 stands before it, or has left for the next stop; there, it holds no more (G4)."""
    day = Day()
    day.come(FIRST, 1, 1)
    day.come(SECOND, 2, 1)
    assert day.says(SECOND) == HELD
    day.wait(11_001)
    day.tell(SECOND)
    assert day.says(SECOND) == NEITHER
    day.tell(FIRST)
    assert day.says(SECOND) == HELD
    assert day.says(FIRST, Hand.RECOVER) == RECOVERS
    day.step("take_up", tram=THIRD, turn=9, stop=1, leaves_at=TERMINUS)
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
    assert day.says(SECOND) == RECOVERS


def one_behind_is_not_seen_ahead() -> None:
    """A tram behind at the same stop does not hold the one before it (G4)."""
    day = Day()
    day.come(FIRST, 1, 1)
    day.come(SECOND, 2, 1)
    assert day.says(FIRST) == RECOVERS
    assert day.says(SECOND) == HELD


def a_tram_is_held_far_before_the_next() -> None:
    """The one behind is ten minutes behind: it left its stop as long ago where that one has not come yet (G4)."""
    for since_ms, says in ((600_000, RECOVERS), (600_001, HELD)):
        day = Day()
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
        day.step("take_up", tram=THIRD, turn=3, stop=2, leaves_at=TERMINUS)
        assert day.says(FIRST) == RECOVERS


def a_departure_of_the_run_before_does_not_count() -> None:
    """Neither for how far the next is behind, nor for how near the one before is (G4)."""
    day = Day()
    day.come(FIRST, 1, 1, 3)
    day.run(FIRST)
    day.run(FIRST)
    day.step("leave", tram=FIRST)
    day.wait(700_000)
    day.come(FIRST, 3, 1, 3)
    day.come(SECOND, 4, 0)
    assert (FIRST, 1) in day.system.centre.left_ms
    assert day.says(FIRST) == RECOVERS
    day = Day()
    day.come(SECOND, 0, 1, 2)
    day.depart(SECOND)
    day.wait(1)
    day.arrive(SECOND)
    day.step("leave", tram=SECOND)
    day.come(FIRST, 2, 1)
    assert day.says(FIRST) == HELD
    day.step("take_up", tram=SECOND, turn=1, stop=1, leaves_at=1)
    assert day.says(FIRST) == RECOVERS


def a_lost_departure_is_made_up_for() -> None:
    """The next stop's arrival tells it, later than it was; one that was told stays as it was (G4)."""
    day = Day()
    day.come(FIRST, 1, 1)
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
    assert day.system.centre.left_ms == {(FIRST, 1): left_ms - 10, (FIRST, 2): left_ms}


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
    assert day.order(FIRST, Hand.RECOVER) == Order(0, False, False, 1_000_000)
    assert day.system.given == Given(holds=False, recovers=False, own_unknown=True, way_unknown=False)
    assert day.system.centre == before


def what_contradicts_is_not_taken() -> None:
    """Of the run before, older than the last, of the future, or backwards (G3, G6)."""
    day = two_stops_apart()
    since_ms, now_ms = day.known(FIRST).since_ms, day.system.centre.now_ms
    told_ms = day.known(FIRST).told_ms
    before = day.system
    for refused in (
        Report(9, False, True, TERMINUS, since_ms),
        Report(4, True, False, TERMINUS, told_ms - 1),
        Report(4, True, False, TERMINUS, now_ms + 1),
        Report(4, False, True, TERMINUS, now_ms),
    ):
        assert day.step("hear_report", tram=FIRST, told=refused) == before
    day.step("hear_report", tram=FIRST, told=Report(4, True, False, TERMINUS, told_ms))
    assert day.known(FIRST).told_ms == told_ms
    day.step("hear_report", tram=FIRST, told=Report(4, True, False, TERMINUS, now_ms))
    assert day.known(FIRST).told_ms == now_ms


def a_tram_that_comes_back_is_not_where_it_was() -> None:
    """A report of its last run comes late, after it was taken up for the next (G6)."""
    day = Day()
    day.come(FIRST, 1, 1, 3)
    day.depart(FIRST)
    day.wait(1)
    day.arrive(FIRST)
    late = Report(2, False, True, 3, day.system.centre.now_ms)
    day.step("leave", tram=FIRST)
    day.wait(1)
    day.step("take_up", tram=FIRST, turn=5, stop=0, leaves_at=9)
    day.step("hear_report", tram=FIRST, told=late)
    assert day.known(FIRST).stop == 0
    day.step("come", tram=FIRST, body=Body(5, 0, False, 9, False, on_board.begun(0), 0), now_ms=1_000_003)
    assert day.body(FIRST).stop == 0


def when_it_stands_is_told_once() -> None:
    """When a tram arrived is when it was first told to stand at that stop (G4)."""
    day = Day()
    day.come(FIRST, 1, 1)
    day.see(FIRST, stands=False)
    day.tell(FIRST)
    day.wait(10)
    day.see(FIRST)
    day.tell(FIRST)
    first_ms = day.system.centre.now_ms
    day.wait(10)
    day.tell(FIRST)
    assert day.known(FIRST).arrived_ms == first_ms
    day.depart(FIRST, tells=False)
    day.wait(10)
    day.arrive(FIRST)
    assert day.known(FIRST).arrived_ms == first_ms + 20


WITNESSES = (
    *orders_shown.WITNESSES,
    a_tram_recovers_to_the_next_stop,
    none_recovers_sooner,
    none_recovers_towards_a_tram_at_the_next_stop,
    a_lost_departure_counts_as_present,
    one_that_turns_off_is_not_in_the_way,
    a_tram_gets_no_order_where_it_leaves,
    a_destination_that_is_told_farther_counts,
    a_tram_taken_up_behind_matters_not,
    none_is_taken_up_before_one_that_recovers,
    a_refused_tram_keeps_its_last_run,
    a_tram_is_held_close_behind,
    a_hold_beats_a_recovery,
    a_tram_before_the_next_stop_holds,
    one_behind_is_not_seen_ahead,
    a_tram_is_held_far_before_the_next,
    a_departure_of_the_run_before_does_not_count,
    a_lost_departure_is_made_up_for,
    stale_means_no_command,
    a_stranger_gets_no_command,
    what_contradicts_is_not_taken,
    a_tram_that_comes_back_is_not_where_it_was,
    when_it_stands_is_told_once,
)
