"""A crossing that starts, and whose power fails with trains before it (X3, X5)."""

from __future__ import annotations

from dataclasses import replace

from kernel.crossing import crossing as machine
from kernel.crossing.crossing import CrossingTrack, Due
from proofs.crossing.witnesses.crossing_day import DOWN, ONE, SITE, THREE, TWO, UP, Day

FAR, NOW = Due.FAR, Due.NOW
SIDING = CrossingTrack("siding")


def a_start_keeps_the_road_closed() -> None:
    """Terminals are heard, and nobody comes; a person must have seen each track (X3)."""
    day = Day(opened=False)
    assert (day.warns(), day.system.restarted, day.system.warned_cycles) == (True, True, 0)
    longest = SITE.settings.silence_cycles
    assert dict(day.system.crossing.silent_cycles.items()) == {UP: longest + 1, DOWN: longest + 1}, "silent, just so"
    for _ in range(100):
        day.cycle()
    assert (day.warns(), day.system.down_cycles, day.system.warned_cycles) == (True, 90, 100)
    day.account(UP)
    day.cycle()
    assert day.warns()
    day.account(DOWN)
    assert day.warns()
    day.cycle()
    assert (day.warns(), day.system.restarted, day.system.unseen) == (False, False, False)
    assert day.system.warned_cycles == 0
    silent = replace(day.system.crossing, warned_cycles=SITE.settings.bell_cycles)
    assert not machine.arms_are_to_be_down(SITE.settings, silent), "no arm falls without its bell"


def a_start_is_closed_until_terminals_are_heard() -> None:
    """Whoever accounts for tracks does not hear terminals for the crossing (X3, T14)."""
    day = Day(opened=False)
    day.account(UP, DOWN)
    for _ in range(3):
        day.cycle(heard=(UP,))
        assert day.warns()
    day.cycle()
    assert not day.warns()


def who_was_forgotten_finds_the_arms_down() -> None:
    """It had struck; power fails, terminals are heard again, and it arrives after the time that it always had (X3)."""
    day = Day()
    day.come_without_radio(ONE)
    for _ in range(20):
        day.cycle()
    down_cycles = day.system.down_cycles
    day.restart()
    assert (dict(day.system.crossing.asks.items()), set(day.system.told)) == ({}, set())
    body = day.system.bodies[ONE]
    assert (body.forgotten, body.was_struck, body.has_asked) == (True, False, True)
    assert day.system.unheard_cycles == {UP: 1, DOWN: 1}
    day.cycle()
    assert day.system.down_cycles == down_cycles + 1
    before = day.system
    assert day.step("account", track=UP, number=day.look(UP)) == before
    day.account(DOWN)
    assert day.until_it_can_arrive(ONE) == 23
    arrived = day.arrive(ONE)
    assert (arrived.warned_cycles, arrived.down_cycles) == (44, 29)
    day.step("leave", gone=ONE)
    day.account(UP)
    day.cycle()
    assert not day.warns()


def who_passed_its_start_point_without_power_finds_the_arms_down() -> None:
    """Power is away for a minute: the crossing restarts in each cycle, and arms fall without the bell (X3, X5)."""
    day = Day()
    day.come(ONE, contact=False)
    day.restart()
    assert (day.warns(), day.system.lowered_cycles, day.system.down_cycles) == (True, 0, 0)
    day.strike(ONE)
    for cycles in range(1, 60):
        day.cycle(heard=())
        assert day.system.lowered_cycles == cycles
        assert day.system.are_down == (cycles >= 10)
        day.restart()
    arrived = day.arrive(ONE)
    assert (arrived.warned_cycles, arrived.down_cycles) == (59, 49)


def a_spare_goes_on_above_every_number_that_was_given_out() -> None:
    """With a lower one, or the same, a word from before the start would count; it is not put in (X3, X4)."""
    day = Day()
    before = day.system
    assert day.restart(0) == before
    assert day.restart(-1) == before
    number = before.crossing.number + 1_000
    assert day.restart(1_000).crossing.number == number
    assert day.system.asked == {UP: number, DOWN: number}
    new = Day(opened=False)
    assert new.step("put_into_service", number=new.system.newest) == new.system


def what_was_seen_before_a_restart_counts_no_more() -> None:
    """Power fails twice, the second time with a train in the approach that nobody has seen (X3)."""
    day = Day(opened=False)
    day.account(UP, DOWN)
    day.come(ONE, contact=False)
    day.strike(ONE)
    day.restart()
    assert day.system.accounted == frozenset()
    for _ in range(10):
        day.cycle()
        assert day.warns()


def who_is_in_contact_is_told_of_anew() -> None:
    """And asks for the warning as ever; that a person has seen the other track ends nothing (X2, X4)."""
    day = Day()
    day.come(ONE)
    day.come(TWO, DOWN)
    day.strike(ONE)
    day.cycle((ONE, NOW), (TWO, NOW))
    day.restart()
    assert (day.system.bodies[ONE].has_asked, day.system.bodies[TWO].has_asked) == (True, False)
    day.step("make_contact", train=ONE)
    day.step("make_contact", train=TWO)
    day.account(DOWN)
    day.cycle((ONE, FAR), (TWO, FAR))
    assert day.warns()
    day.pass_by(ONE)
    day.account(UP)
    day.cycle((TWO, FAR))
    assert not day.warns()
    day.come(THREE)
    day.strike(TWO)
    day.cycle((TWO, NOW), (THREE, FAR))
    assert (day.warns(), day.system.restarted) == (True, False)
    day.until_it_can_arrive(TWO, (TWO, NOW), (THREE, FAR))
    assert day.arrive(TWO).warned_cycles == 61


def a_strike_is_told_after_the_restart_too() -> None:
    """Of a train that struck while a person looked at the track, and had seen it empty (X3)."""
    day = Day(opened=False)
    day.cycle()
    day.come(ONE, contact=False)
    day.strike(ONE)
    before = day.system
    assert day.step("hear_terminal", track=UP, age_cycles=0) == before
    day.step("hear_strike", train=ONE)
    day.account(UP, DOWN)
    day.cycle()
    assert day.warns()
    day.until_it_can_arrive(ONE)
    assert day.arrive(ONE).warned_cycles == 45
    day.pass_by(ONE)
    day.cycle()
    assert not day.warns()


def a_track_that_settings_leave_out_warns() -> None:
    """Once its terminal is heard; a restart forgets it, until it is heard again (X3)."""
    day = Day()
    day.step("hear_terminal", track=SIDING, age_cycles=0)
    assert day.system.crossing.unaccounted == {UP: False, DOWN: False, SIDING: True}
    day.step("hear_terminal", track=UP, age_cycles=0)
    day.cycle()
    assert (day.warns(), day.system.unseen) == (True, True)
    day.restart()
    assert (set(day.system.unheard_cycles), day.system.unseen) == (set(SITE.tracks), True)
    day.account(UP, DOWN)
    day.step("hear_terminal", track=SIDING, age_cycles=0)
    day.cycle()
    assert (day.warns(), day.system.unseen) == (True, True)
    day.account(SIDING)
    day.cycle()
    assert (day.warns(), day.system.unseen) == (False, False)


def who_had_not_asked_has_not_asked_at_the_restart() -> None:
    """It has been forgotten before the crossing was told of it; from its next decision on it has asked (X3, X4)."""
    day = Day()
    day.come(ONE, contact=False)
    day.strike(ONE)
    before = day.system
    restarted = day.restart()
    assert (before.unseen, restarted.unseen) == (False, True)
    body = restarted.bodies[ONE]
    assert (body.has_asked, body.forgotten, body.forgotten_at) == (False, True, day.system.crossing.number)
    day.cycle()
    assert day.system.bodies[ONE].has_asked


def a_restart_in_a_warning_is_over_with_it() -> None:
    """The next one begins with lamps and bells alone (X5)."""
    day = Day(opened=False)
    day.account(UP, DOWN)
    day.cycle()
    day.come(ONE)
    for cycles in range(1, 8):
        day.cycle((ONE, NOW))
        assert day.system.lowered_cycles == max(0, cycles - 5)
    day.step("decide", dues={ONE: NOW})
    day.restart()
    assert (day.system.decided, day.system.lowered_cycles, day.system.warned_cycles) == (False, 2, 7)
    day.cycle()
    assert (day.system.lowered_cycles, day.system.warned_cycles) == (3, 8)


def several_strikes_that_a_terminal_has_missed_are_seen_out_together() -> None:
    """Two trains strike while it has no power; who sees one of them leave opens nothing (X3, T14)."""
    day = Day()
    for train in (ONE, TWO):
        day.come(train, contact=False)
        day.strike(train)
    day.come_without_radio(THREE, DOWN)
    for _ in range(4):
        day.cycle(heard=(DOWN,))
    before = day.system
    assert day.step("hear_terminal", track=UP, age_cycles=0) == before
    day.step("hear_what_may_be_missed", track=UP)
    assert day.system.crossing.unaccounted == {UP: True, DOWN: False}
    assert day.system.accounted == frozenset({DOWN})
    assert [day.system.bodies[train].forgotten for train in (ONE, TWO, THREE)] == [True, True, False]
    assert {day.system.bodies[train].forgotten_at for train in (ONE, TWO)} == {day.system.newest}
    day.cycle()
    assert [day.system.bodies[train].has_asked for train in (ONE, TWO)] == [True, True]
    day.pass_by(THREE)
    day.pass_by(ONE)
    day.step("release", gone=ONE, number=day.number(ONE))
    before = day.system
    assert day.step("account", track=UP, number=day.look(UP)) == before
    day.cycle()
    assert (day.warns(), day.system.unseen) == (True, True)
    assert day.until_it_can_arrive(TWO) == 38
    assert day.arrive(TWO).warned_cycles == 44
    day.pass_by(TWO)
    day.account(UP)
    day.cycle()
    assert (day.warns(), day.system.unseen) == (False, False)


def who_is_known_is_not_missed() -> None:
    """A terminal that starts takes nothing from trains that were told of, or have not struck yet (X3)."""
    day = Day()
    day.come(ONE)
    day.strike(ONE)
    day.come(TWO, contact=False)
    day.step("hear_what_may_be_missed", track=UP)
    assert [day.system.bodies[train].forgotten for train in (ONE, TWO)] == [False, False]
    day.step("hear_what_may_be_missed", track=DOWN)
    assert day.system.accounted == frozenset()
    day.cycle((ONE, FAR))
    assert (day.warns(), day.system.bodies[ONE].has_asked) == (True, False)


def a_word_from_before_a_restart_opens_nothing() -> None:
    """It was said of an empty track; power fails again, with a train in the approach, and it comes once more (X3)."""
    day = Day(opened=False)
    old = {track: day.look(track) for track in (UP, DOWN)}
    day.account(UP, DOWN)
    day.cycle()
    assert not day.warns()
    day.come(ONE, contact=False)
    day.strike(ONE)
    number = day.system.crossing.number
    day.restart()
    assert day.system.crossing.number == number + 1
    assert (day.look(UP), day.look(DOWN), day.look(SIDING)) == (number + 1, number + 1, 0)
    before = day.system
    for track in (UP, DOWN):
        assert day.step("account", track=track, number=old[track]) == before
    assert day.step("account", track=SIDING, number=0) == before
    day.cycle()
    assert day.warns()
    day.account(DOWN)
    day.step("hear_what_may_be_missed", track=DOWN)
    before = day.system
    assert day.step("account", track=DOWN, number=number + 1) == before
    day.account(DOWN)


WITNESSES = (
    a_start_keeps_the_road_closed,
    a_start_is_closed_until_terminals_are_heard,
    who_was_forgotten_finds_the_arms_down,
    who_passed_its_start_point_without_power_finds_the_arms_down,
    a_spare_goes_on_above_every_number_that_was_given_out,
    what_was_seen_before_a_restart_counts_no_more,
    who_is_in_contact_is_told_of_anew,
    a_strike_is_told_after_the_restart_too,
    a_track_that_settings_leave_out_warns,
    a_restart_in_a_warning_is_over_with_it,
    who_had_not_asked_has_not_asked_at_the_restart,
    several_strikes_that_a_terminal_has_missed_are_seen_out_together,
    who_is_known_is_not_missed,
    a_word_from_before_a_restart_opens_nothing,
)
