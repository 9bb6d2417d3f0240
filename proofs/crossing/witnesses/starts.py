"""Trains that begin their runs, or turn back, between a start point and the road (X3 to X5)."""

from __future__ import annotations

from dataclasses import replace

from kernel.crossing import crossing as machine
from kernel.crossing.crossing import Due, Standing, Train
from models.crossing import level
from proofs.crossing.witnesses.crossing_day import BEYOND, DOWN, ONE, STATION, TWO, UP, Day

NOW = Due.NOW
RUN_CYCLES = 9
"""From a signal just beyond the road: 75 m at 2 m/s²."""


def asked(day: Day, train: Train, run_cycles: int = RUN_CYCLES) -> None:
    """A train asks to start."""
    day.step("ask_to_start", train=train, run_cycles=run_cycles)
    assert day.system.starting[train] == run_cycles
    assert day.system.crossing.asks[train] is True
    assert day.system.crossing.starts[train] == run_cycles


def is_let_go(day: Day, train: Train) -> bool:
    """Whether a train that stands is let go now."""
    before = day.system
    day.step("let_go", train=train)
    assert machine.may_start(day.site.settings, before.crossing, train) == (day.system != before)
    if day.system != before:
        body = day.system.bodies[train]
        assert (body.inside, body.left_cycles) == (True, max(before.bodies[train].left_cycles, before.starting[train]))
    return day.system != before


def who_turns_back_just_beyond_the_road_waits_until_it_was_warned_of() -> None:
    """Its rear was past, and the road open; it stands in contact, asks, and starts in time for the warning (X3, X5)."""
    day = Day()
    day.come(ONE)
    day.strike(ONE)
    day.until_it_can_arrive(ONE, (ONE, NOW))
    day.arrive(ONE)
    day.pass_by(ONE)
    day.cycle()
    assert not day.warns()
    day.come(ONE, DOWN)
    assert not is_let_go(day, ONE)
    asked(day, ONE)
    cycles = 0
    while not is_let_go(day, ONE):
        day.cycle((ONE, NOW))
        cycles += 1
    assert cycles == 40 + 5 + 1 - RUN_CYCLES
    assert day.system.last.warned_cycles == 44
    assert day.until_it_can_arrive(ONE, (ONE, NOW)) == RUN_CYCLES
    arrived = day.arrive(ONE)
    assert (arrived.warned_cycles, arrived.down_cycles) == (46, 31)
    day.pass_by(ONE)
    assert not day.system.starting
    assert not day.system.crossing.starts
    day.cycle()
    assert not day.warns()


def who_stands_and_promises_keeps_no_road_closed() -> None:
    """In contact it might come at once; with its promise it does not, and what was rung for it ends (X4)."""
    day = Day()
    day.come(ONE)
    day.strike(ONE)
    day.cycle((ONE, NOW))
    day.step("come_to_stand", train=ONE, signal=STATION)
    assert (day.system.bodies[ONE].inside, day.system.bodies[ONE].has_asked) == (False, True)
    for _ in range(100):
        day.cycle((ONE, NOW))
        assert day.warns()
    day.step("promise_to_stand", train=ONE, standing=Standing(STATION, True))
    assert (set(day.system.told), dict(day.system.crossing.asks.items())) == (set(), {})
    day.cycle()
    assert not day.warns()
    day.step("make_contact", train=ONE)
    day.cycle((ONE, NOW))
    assert day.warns()
    day.step("promise_to_stand", train=ONE, standing=Standing(STATION, True))
    day.cycle()
    assert not day.warns()
    day.come(TWO)
    day.cycle((TWO, NOW))
    day.step("promise_to_stand", train=ONE, standing=Standing(STATION, True))
    day.cycle((TWO, NOW))
    assert day.warns()


def a_promise_counts_no_more_once_the_train_has_asked() -> None:
    """It comes late, after the train was let go; a person withdraws a start that is given up (X4)."""
    day = Day()
    day.come(ONE, contact=False)
    asked(day, ONE)
    day.step("promise_to_stand", train=ONE, standing=Standing(STATION, True))
    assert day.system.crossing.asks[ONE] is True
    while not is_let_go(day, ONE):
        day.cycle()
    day.step("promise_to_stand", train=ONE, standing=Standing(STATION, True))
    assert (set(day.system.told), day.system.starting) == ({ONE}, {ONE: RUN_CYCLES})
    before = day.system
    assert day.step("come_to_stand", train=ONE, signal=STATION) == before
    for _ in range(RUN_CYCLES + 50):
        day.cycle()
        assert day.warns()
    day.step("leave", gone=ONE)
    day.step("release", gone=ONE, number=day.number(ONE))
    assert not day.system.starting
    assert not day.system.crossing.starts
    day.cycle()
    assert not day.warns()


def a_restart_forgets_who_asked_to_start() -> None:
    """It asks anew, and of the bell's time nobody knows whether it has been rung; who was let go is inside (X3, X5)."""
    day = Day()
    day.come(ONE, contact=False)
    day.come(TWO, DOWN, contact=False)
    for train in (ONE, TWO):
        asked(day, train)
    while not is_let_go(day, ONE):
        day.cycle()
    assert (day.system.warned_cycles, day.system.crossing.warned_cycles) == (37, 37)
    day.restart()
    assert not day.system.starting
    assert not day.system.crossing.starts
    assert (day.system.bodies[ONE].forgotten, day.system.bodies[TWO].forgotten) == (True, False)
    assert not is_let_go(day, TWO)
    before = day.system
    assert day.step("account", track=UP, number=day.look(UP)) == before
    day.account(DOWN)
    asked(day, TWO)
    assert (day.system.warned_cycles, day.system.crossing.warned_cycles) == (37, 5)
    cycles = 0
    while not is_let_go(day, TWO):
        day.cycle()
        cycles += 1
    assert cycles == 40 + 1 - RUN_CYCLES
    day.until_it_can_arrive(TWO)
    assert day.arrive(TWO).warned_cycles == 37 + 32 + RUN_CYCLES


def a_signal_far_enough_lets_go_at_once() -> None:
    """The warning time and the bell's away, and a cycle more: the next decision warns in time (X5)."""
    day = Day()
    day.come(ONE)
    asked(day, ONE, 45)
    assert not is_let_go(day, TWO)
    assert not is_let_go(day, ONE)
    asked(day, ONE, 46)
    assert is_let_go(day, ONE)
    day.step("decide", dues={ONE: NOW})
    day.step("run_a_cycle", are_down=False)
    assert day.until_it_can_arrive(ONE, (ONE, NOW)) == 45
    assert day.arrive(ONE).warned_cycles == 46
    there = day.system
    assert day.step("let_go", train=ONE) == there


def a_train_that_comes_and_goes_asks_for_itself_alone() -> None:
    """Others that have asked still do when one is gone; a promise of a train that is inside is none (X4)."""
    day = Day()
    day.come(ONE, contact=False)
    day.come(TWO, DOWN, contact=False)
    asked(day, ONE)
    asked(day, TWO)
    day.cycle()
    assert day.system.bodies[ONE].has_asked
    day.step("leave", gone=TWO)
    day.step("tell_gone", gone=TWO, number=day.number(TWO), is_whole=False)
    assert day.system.starting == {ONE: RUN_CYCLES, TWO: RUN_CYCLES}
    day.step("tell_gone", gone=TWO, number=day.number(TWO), is_whole=True)
    assert (day.system.starting, day.system.crossing.starts) == ({ONE: RUN_CYCLES}, {ONE: RUN_CYCLES})
    day = Day()
    day.come(ONE)
    day.strike(ONE)
    inside = day.system
    assert day.step("promise_to_stand", train=ONE, standing=Standing(STATION, True)) == inside
    assert day.step("come_to_stand", train=TWO, signal=STATION) == inside


def who_stands_across_the_road_keeps_it_closed() -> None:
    """Its head stands at the next road's signal, and its promise is of that one alone (X4)."""
    day = Day()
    day.come_without_radio(ONE)
    day.until_it_can_arrive(ONE)
    day.arrive(ONE)
    there = day.system
    for signal in (BEYOND, STATION):
        assert day.step("come_to_stand", train=ONE, signal=signal) == there
    assert day.step("promise_to_stand", train=ONE, standing=Standing(STATION, True)) == there
    assert day.step("promise_to_stand", train=ONE, standing=Standing(BEYOND, True)) == there
    for _ in range(100):
        day.cycle()
        assert day.warns()
    day.pass_by(ONE)
    day.cycle()
    assert not day.warns()


def who_has_the_road_before_its_signal_keeps_it_closed() -> None:
    """It stops short of the road, and may draw up to the signal beyond it (X4)."""
    day = Day()
    day.come(ONE)
    day.strike(ONE)
    day.cycle((ONE, NOW))
    stands = day.step("come_to_stand", train=ONE, signal=BEYOND)
    assert stands.bodies[ONE].inside
    assert day.step("promise_to_stand", train=ONE, standing=Standing(BEYOND, True)) == stands
    day.cycle((ONE, NOW))
    assert day.warns()
    day.step("come_to_stand", train=ONE, signal=STATION)
    stands = day.system
    assert day.step("promise_to_stand", train=ONE, standing=Standing(BEYOND, True)) == stands
    day.cycle((ONE, NOW))
    assert day.warns()


def who_has_parted_keeps_the_road_closed() -> None:
    """Its front stands at the signal before the road, and knows that it is not whole (X4)."""
    day = Day()
    day.come_without_radio(ONE)
    day.cycle()
    before = day.system
    assert day.step("part", train=TWO) == before
    parted = day.step("part", train=ONE)
    assert not parted.bodies[ONE].is_whole
    assert day.step("come_to_stand", train=ONE, signal=STATION) == parted
    assert day.step("promise_to_stand", train=ONE, standing=Standing(STATION, False)) == parted
    assert day.step("promise_to_stand", train=ONE, standing=Standing(STATION, True)) == parted
    day.cycle()
    assert day.warns()
    day.come(TWO, DOWN)
    day.step("promise_to_stand", train=TWO, standing=Standing(STATION, False))
    assert TWO in day.system.crossing.asks
    day.step("promise_to_stand", train=TWO, standing=Standing(STATION, True))
    assert TWO not in day.system.crossing.asks


def what_one_train_does_changes_no_other() -> None:
    """It arrives, parts, stands and promises for itself alone (X3, X4)."""
    day = Day()
    for train, track in ((ONE, UP), (TWO, DOWN)):
        day.come_without_radio(train, track)
    day.cycle()
    day.step("come_to_stand", train=TWO, signal=STATION)
    assert set(day.system.bodies) == {ONE, TWO}
    day.step("promise_to_stand", train=TWO, standing=Standing(STATION, True))
    assert [(day.system.bodies[each].was_struck, day.system.bodies[each].has_asked) for each in (ONE, TWO)] == [
        (True, True),
        (False, False),
    ]
    day.until_it_can_arrive(ONE)
    day.arrive(ONE)
    day.step("part", train=ONE)
    assert [(body.is_on_road, body.is_whole) for _train, body in day.system.bodies.items()] == [
        (True, False),
        (False, True),
    ]
    day.step("part", train=TWO)
    assert [body.is_whole for _train, body in day.system.bodies.items()] == [False, False]


def who_asks_to_start_is_told_of_as_one_that_has_struck() -> None:
    """Another that asks after it takes nothing from that (X3)."""
    day = Day()
    for train in (ONE, TWO):
        day.come(train)
    asked(day, ONE)
    assert [body.was_struck for _train, body in day.system.bodies.items()] == [True, False]
    asked(day, TWO)
    assert [body.was_struck for _train, body in day.system.bodies.items()] == [True, True]


def who_was_forgotten_and_stands_is_looked_at_no_more() -> None:
    """A person who finds it standing at the signal accounts for its track (X3)."""
    day = Day()
    day.come(ONE, contact=False)
    day.strike(ONE)
    day.restart()
    before = day.system
    assert day.step("account", track=UP, number=day.look(UP)) == before
    stands = day.step("come_to_stand", train=ONE, signal=STATION)
    assert (stands.bodies[ONE].forgotten, stands.bodies[ONE].inside) == (False, False)
    day.account(UP, DOWN)
    day.cycle()
    assert not day.warns()


def who_was_forgotten_and_has_parted_is_looked_for_still() -> None:
    """Its front part stands at the signal; the rest may be anywhere (X3, X4)."""
    day = Day()
    day.come(ONE, contact=False)
    day.strike(ONE)
    day.step("part", train=ONE)
    day.restart()
    day.cycle()
    before = day.system
    assert (before.bodies[ONE].forgotten, before.bodies[ONE].has_asked) == (True, True)
    assert day.step("come_to_stand", train=ONE, signal=STATION) == before


def what_may_be_told_of_standing() -> None:
    """At another road's signal, or not whole, anything; after an ask, an old promise (X4)."""
    day = Day()
    day.come(ONE)
    day.strike(ONE)
    site, system = day.site, day.system
    there = Standing(STATION, True)
    assert not level.only_who_stands_promises_to_stand(site, system, ONE, there)
    assert level.only_who_stands_promises_to_stand(site, system, TWO, there)
    assert level.only_who_stands_promises_to_stand(site, system, ONE, Standing(BEYOND, True))
    assert level.only_who_stands_promises_to_stand(site, system, ONE, Standing(STATION, False))
    assert level.only_who_stands_promises_to_stand(site, replace(system, starting={ONE: RUN_CYCLES}), ONE, there)


WITNESSES = (
    who_turns_back_just_beyond_the_road_waits_until_it_was_warned_of,
    who_stands_and_promises_keeps_no_road_closed,
    a_promise_counts_no_more_once_the_train_has_asked,
    a_restart_forgets_who_asked_to_start,
    a_signal_far_enough_lets_go_at_once,
    a_train_that_comes_and_goes_asks_for_itself_alone,
    who_stands_across_the_road_keeps_it_closed,
    who_has_the_road_before_its_signal_keeps_it_closed,
    who_has_parted_keeps_the_road_closed,
    what_one_train_does_changes_no_other,
    who_asks_to_start_is_told_of_as_one_that_has_struck,
    who_was_forgotten_and_has_parted_is_looked_for_still,
    who_was_forgotten_and_stands_is_looked_at_no_more,
    what_may_be_told_of_standing,
)
