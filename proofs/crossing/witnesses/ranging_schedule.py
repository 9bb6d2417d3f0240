"""Slots of a channel, played: trains come, go and answer late, orders are lost, the ground unit is swapped (X1)."""

from __future__ import annotations

from dataclasses import replace

from kernel.crossing.arrival import ArrivalBounds
from kernel.crossing.crossing import Train
from kernel.crossing.ranging_schedule import (
    NONE,
    ChannelSettings,
    CrossingName,
    Pair,
    Schedule,
    Turn,
    are_in_time,
    counts,
    is_ordered,
)
from models.crossing.ranging_schedule import Channel, Ranging, Told
from proofs.crossing.ranging_schedule import THEORY
from proofs.onboard.witnesses.play import Play

SETTINGS = ChannelSettings(tick_ms=10, slot_ms=100, most_pairs=3)
BOUNDS = ArrivalBounds(
    line_um=3_000_000,
    gain_um=10_000,
    cycle_ms=200,
    warning_cycles=350,
    silence_cycles=4,
    way_spread_mm=1,
    speed_spread_mm_s=1,
)
"""Rangings count for 800 ms; three pairs take 330 ms, an answer 100 ms, a cycle 200 ms."""
SITE = Channel(SETTINGS, BOUNDS, over_ms=90)
WEST, EAST = CrossingName("west"), CrossingName("east")
ONE, TWO, THREE = Pair(Train("1"), WEST), Pair(Train("2"), WEST), Pair(Train("3"), EAST)
ONE_EAST = Pair(Train("1"), EAST)
"""The first train, for the other crossing."""


class Played(Play[Channel, Ranging]):
    """A channel whose ground unit has just started."""

    def __init__(self, site: Channel = SITE) -> None:
        """Begin, in the middle of a cycle."""
        schedule = Schedule({}, 0, 0, site.settings.slot_ms)
        super().__init__(THEORY, site, Ranging(schedule, {}, frozenset(), {}, 50, 0, {}, Told(ONE, 0, ONE, 0)))

    def register(self, *pairs: Pair) -> None:
        """Register pairs; each must find a place."""
        for pair in pairs:
            assert pair in self.step("register", pair=pair).schedule.turns

    def tick(self) -> None:
        """Let a tick pass, and decide when a cycle is over."""
        self.step("tick", passed_ms=self.site.settings.tick_ms)
        if self.system.phase_ms == self.site.bounds.cycle_ms:
            assert self.step("decide").phase_ms == 0

    def decided(self) -> None:
        """Run until the next decision."""
        self.tick()
        while self.system.phase_ms != 0:
            self.tick()

    def ordered(self) -> list[Pair]:
        """Who is ordered now."""
        schedule = self.system.schedule
        return [pair for pair in schedule.turns if is_ordered(self.site.settings, schedule, pair)]

    def next_slot(self) -> Pair | None:
        """Run until a slot begins; give whose it is, and send the order."""
        number = self.system.schedule.number
        while self.system.schedule.number == number:
            self.tick()
        ordered = self.ordered()
        if not ordered:
            return None
        assert self.step("send_order", pair=ordered[0]).sent[number + 1].pair == ordered[0]
        return ordered[0]

    def range(self) -> int:
        """Range by the newest order, and be over in time; give its number."""
        number = self.system.schedule.number
        assert self.step("begin_ranging", number=number).under_way == frozenset({number})
        self.tick()
        assert self.step("end_ranging", number=number).under_way == frozenset()
        return number

    def hear(self, pair: Pair, number: int) -> bool:
        """Hear an answer; tell whether it counted."""
        counted = counts(self.system.schedule, pair, number)
        told = self.step("hear_answer", pair=pair, number=number).told
        assert not counted or (told.pair == told.of == pair and told.age_cycles >= told.since_cycles)
        return counted


def pairs_take_turns() -> None:
    """Two trains before one crossing, and one of them before another as well; each slot 100 ms after the last (X1)."""
    channel = Played()
    channel.register(ONE, TWO, ONE_EAST)
    for _ in range(9):
        assert channel.ordered() == []
        channel.tick()
    assert channel.next_slot() == ONE
    for pair in (TWO, ONE_EAST, ONE, TWO, ONE_EAST):
        for _ in range(9):
            channel.tick()
            assert channel.ordered() == []
        assert channel.next_slot() == pair
        assert channel.system.waits[pair].waited_ms == 0
        assert channel.system.waits[pair].most == 3
    assert max(wait.held_ms for _pair, wait in channel.system.waits.items()) == 300


def an_order_that_is_lost_costs_its_slot_alone() -> None:
    """Nobody ranges, nobody answers: the next pair has its slot at its time, and the lost one the slot after (X1)."""
    channel = Played()
    channel.register(ONE, TWO)
    assert channel.next_slot() == ONE
    assert channel.next_slot() == TWO
    assert channel.hear(TWO, channel.range())
    assert channel.next_slot() == ONE
    assert channel.hear(ONE, channel.range())


def a_restart_in_the_middle_of_a_slot_waits_for_another() -> None:
    """The ranging that was ordered goes on, and nothing is ordered beside it; all contact is made anew (X1)."""
    channel = Played()
    channel.register(ONE, TWO)
    channel.next_slot()
    number = channel.system.schedule.number
    channel.step("begin_ranging", number=number)
    for _ in range(3):
        channel.tick()
    schedule = channel.step("restart", number=number).schedule
    assert (schedule, channel.system.registered) == (Schedule({}, 0, number, 100), 0)
    channel.register(TWO)
    for _ in range(5):
        channel.tick()
        assert channel.ordered() == []
    channel.step("end_ranging", number=number)
    assert not channel.hear(ONE, number)
    assert channel.next_slot() == TWO
    assert channel.system.schedule.number == number + 1
    assert not channel.hear(TWO, number)


def a_spare_goes_on_from_the_last_number() -> None:
    """It may take over with a greater one, not with one that was given; an answer to the old one counts for none."""
    channel = Played()
    channel.register(ONE)
    channel.next_slot()
    number = channel.range()
    before = channel.system
    assert channel.step("restart", number=number - 1) == before
    channel.step("restart", number=number + 41)
    channel.register(ONE)
    assert channel.next_slot() == ONE
    assert channel.system.schedule.number == number + 42
    assert not channel.hear(ONE, number)
    assert channel.hear(ONE, channel.range())


def a_late_answer_is_not_anothers() -> None:
    """It comes into the next slot: it is of the train that was ranged, and as old as that is (X1)."""
    channel = Played()
    channel.register(ONE, TWO)
    channel.next_slot()
    late = channel.range()
    assert channel.next_slot() == TWO
    channel.step("begin_ranging", number=late + 1)
    assert not channel.hear(TWO, late)
    assert channel.hear(ONE, late)
    channel.step("end_ranging", number=late + 1)
    for _ in range(5):
        channel.tick()
    assert channel.system.schedule.turns[ONE].age_cycles == 1
    assert channel.hear(ONE, late)
    assert channel.system.told == Told(ONE, 1, ONE, 1)
    assert channel.next_slot() == ONE
    assert not channel.hear(ONE, late)


def who_registers_twice_has_one_place() -> None:
    """And waits no less, and no longer, than the others (X1)."""
    channel = Played()
    channel.register(ONE, TWO)
    channel.next_slot()
    before = channel.system
    assert channel.step("register", pair=ONE) == before
    assert channel.step("register", pair=TWO) == before
    assert [channel.next_slot() for _ in range(4)] == [TWO, ONE, TWO, ONE]


def who_leaves_holds_up_nobody() -> None:
    """In its slot, or before it; those behind close up, and the channel is free no sooner (X1)."""
    channel = Played()
    channel.register(ONE, TWO, THREE)
    assert channel.next_slot() == ONE
    channel.step("begin_ranging", number=1)
    channel.step("leave", gone=ONE)
    for _ in range(8):
        channel.tick()
        assert channel.ordered() == []
    channel.step("end_ranging", number=1)
    assert not channel.hear(ONE, 1)
    channel.step("leave", gone=TWO)
    assert channel.next_slot() == THREE
    assert channel.system.schedule == Schedule({THREE: Turn(0, 2, 0)}, 1, 2, 100)
    assert channel.next_slot() == THREE
    before = channel.system
    assert channel.step("leave", gone=TWO) == before


def who_comes_back_in_its_own_slot_is_not_ordered_again() -> None:
    """It has a new contact and the last place; what it answers to the old order counts no more (X1)."""
    channel = Played()
    channel.register(ONE, TWO)
    assert channel.next_slot() == ONE
    number = channel.system.schedule.number
    channel.step("leave", gone=ONE)
    channel.register(ONE)
    assert channel.ordered() == []
    assert channel.system.schedule.turns[ONE] == Turn(1, NONE, 0)
    assert not channel.hear(ONE, NONE)
    assert not channel.hear(ONE, channel.range())
    before = channel.system
    assert channel.step("send_order", pair=ONE) == before
    assert (channel.next_slot(), channel.next_slot()) == (TWO, ONE)
    assert not channel.hear(ONE, number)
    assert channel.hear(ONE, channel.range())


def who_finds_no_place_is_not_registered() -> None:
    """Until another leaves; nobody waits longer for it (X1, X3)."""
    channel = Played()
    channel.register(ONE, TWO, THREE)
    before = channel.system
    assert channel.step("register", pair=ONE_EAST) == before
    channel.step("leave", gone=TWO)
    channel.register(ONE_EAST)
    assert [channel.next_slot() for _ in range(4)] == [ONE, THREE, ONE_EAST, ONE]


def settings_that_leave_no_time_are_refused() -> None:
    """To the millisecond; with them nobody is registered, and no slot begins (X1, X5)."""
    exact = ChannelSettings(tick_ms=10, slot_ms=105, most_pairs=3)
    bounds = replace(BOUNDS, cycle_ms=150)
    assert are_in_time(exact, bounds)
    assert are_in_time(ChannelSettings(tick_ms=1, slot_ms=1, most_pairs=224), bounds)
    for settings, held in (
        (replace(exact, slot_ms=106), bounds),
        (replace(exact, most_pairs=4), bounds),
        (replace(exact, tick_ms=11), bounds),
        (exact, replace(bounds, cycle_ms=149)),
        (exact, replace(bounds, silence_cycles=3)),
        (ChannelSettings(1, 1, 225), bounds),
        (replace(exact, tick_ms=0), bounds),
        (replace(exact, slot_ms=0), bounds),
    ):
        assert not are_in_time(settings, held)
        channel = Played(Channel(settings, held, over_ms=0))
        before = channel.system
        assert channel.step("register", pair=ONE) == before
        assert channel.step("tick", passed_ms=settings.tick_ms) == before


def a_ranging_begins_and_ends_in_its_time() -> None:
    """By an order alone, while that is fresh; time does not pass beyond its end (X1)."""
    channel = Played()
    channel.register(ONE)
    before = channel.system
    assert channel.step("begin_ranging", number=1) == before
    channel.next_slot()
    channel.step("begin_ranging", number=1)
    for _ in range(8):
        channel.tick()
    before = channel.system
    assert channel.step("tick", passed_ms=10) == before
    assert channel.step("tick", passed_ms=9) == before
    channel.step("end_ranging", number=1)
    channel.tick()
    before = channel.system
    assert channel.step("begin_ranging", number=1) == before
    assert channel.step("hear_answer", pair=ONE, number=2) == before
    assert channel.step("decide") == before


def what_is_held_and_what_was_taken_grow_older_with_each_decision() -> None:
    """A ranging that was begun; who has not been ranged, by decisions since it registered (X1, X2)."""
    channel = Played()
    channel.register(ONE)
    channel.next_slot()
    number = channel.range()
    for cycles in (1, 2, 3):
        assert channel.system.taken[number] == cycles - 1
        channel.decided()
        assert channel.system.taken[number] == cycles
    channel.register(TWO)
    assert channel.system.waits[TWO].held_cycles == 0
    for cycles in (1, 2):
        channel.decided()
        assert channel.system.waits[TWO].held_cycles == cycles


WITNESSES = (
    what_is_held_and_what_was_taken_grow_older_with_each_decision,
    pairs_take_turns,
    an_order_that_is_lost_costs_its_slot_alone,
    a_restart_in_the_middle_of_a_slot_waits_for_another,
    a_spare_goes_on_from_the_last_number,
    a_late_answer_is_not_anothers,
    who_registers_twice_has_one_place,
    who_leaves_holds_up_nobody,
    who_comes_back_in_its_own_slot_is_not_ordered_again,
    who_finds_no_place_is_not_registered,
    settings_that_leave_no_time_are_refused,
    a_ranging_begins_and_ends_in_its_time,
)
