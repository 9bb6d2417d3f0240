"""Slots of a radio channel: witnesses, drawn worlds of the theory, and a channel of its own in milliseconds (X1).

Nothing of models or proofs is in that channel but the kernel's public functions: its radios range when an order reaches
them, and hold on to answers; rangings that overlap are seen by their times.  What else might give out the slots, with
one thing wrong, was written down before it was tried, and each breaks what is judged there.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field, replace
from random import Random
from typing import Any

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from kernel.crossing import ranging_schedule as machine
from kernel.crossing.crossing import Train
from kernel.crossing.ranging_schedule import NONE, ChannelSettings, CrossingName, Pair, Schedule, Turn, are_in_time
from kernel.restarts import restart_ranging_schedule
from models.crossing.sites import CHANNEL, TRIALS, refusal
from proofs.crossing.witnesses.ranging_schedule import BOUNDS, EAST, ONE, ONE_EAST, SITE, THREE, TWO, WITNESSES, Played

SETTINGS = ChannelSettings(tick_ms=10, slot_ms=100, most_pairs=6)
RANGING_MS, LATEST_MS = 30, 60
"""So long a ranging takes, and so late it begins after its order at the most: over within 90 ms."""
CYCLE_MS = 250
ROUND_MS = SETTINGS.most_pairs * (SETTINGS.slot_ms + SETTINGS.tick_ms)
PAIRS = tuple(Pair(Train(str(number)), CrossingName(name)) for number in range(5) for name in ("west", "east"))


@pytest.mark.parametrize("witness", WITNESSES)
def test_witness(witness: Callable[[], None]) -> None:
    assert witness.__doc__
    witness()


@settings(max_examples=60, deadline=None)
@given(st.integers(0, 2**32))
def test_drawn_worlds_keep_every_invariant(seed: int) -> None:
    """Whatever comes, goes, is lost or late, and whoever restarts; every invariant is looked at in each step."""
    chance = Random(seed)
    channel = Played()
    pairs = (ONE, TWO, THREE, ONE_EAST, Pair(Train("2"), EAST))
    for _ in range(300):
        event = chance.randrange(16)
        newest = channel.system.schedule.number
        number = chance.choice((newest, newest, newest - 1, chance.randrange(newest + 2)))
        if event == 0:
            channel.step("register", pair=chance.choice(pairs))
        elif event == 1 and chance.random() < 0.3:
            channel.step("leave", gone=chance.choice(pairs))
        elif event == 2 and chance.random() < 0.05:
            channel.step("restart", number=newest + chance.randrange(3))
        elif event < 5:
            channel.step("begin_ranging", number=number)
        elif event < 7:
            channel.step("hear_answer", pair=chance.choice(pairs), number=number)
        elif event < 9:
            for pair in channel.ordered():
                channel.step("send_order", pair=pair)
        else:
            for under_way in channel.system.under_way:
                sent = channel.system.sent[under_way]
                if chance.random() < 0.3 or sent.since_ms + 10 >= SITE.over_ms:
                    channel.step("end_ranging", number=under_way)
            channel.tick()
    assert len(channel.system.under_way) <= 1


# ---- a channel of its own


@dataclass
class Air:
    """A channel in milliseconds, one ground unit, and radios that obey the orders that reach them.

    ``rangings``: from when to when, by number, and of whom.  ``answers``: under way, with the number.
    ``since_ms``: since when a pair waits.  ``broken``: what was broken.
    """

    chance: Random
    next_tick: Callable[[ChannelSettings, Schedule], Schedule] = machine.next_tick
    counts: Callable[[Schedule, Pair, int], bool] = machine.counts
    register: Callable[[ChannelSettings, Schedule, Pair], Schedule] = machine.register
    leave: Callable[[Schedule, Pair], Schedule] = machine.leave
    restart: Callable[[ChannelSettings, int], Schedule] = restart_ranging_schedule
    schedule: Schedule = field(default_factory=lambda: Schedule({}, 0, 0, SETTINGS.slot_ms))
    now_ms: int = 0
    rangings: list[tuple[int, int, Pair]] = field(default_factory=list)
    answers: list[tuple[int, int, int, Pair]] = field(default_factory=list)
    since_ms: dict[Pair, int] = field(default_factory=dict)
    broken: set[str] = field(default_factory=set)
    slots: int = 0
    told: int = 0

    def run(self, ticks: int) -> set[str]:
        """Run on; give what was broken."""
        for _ in range(ticks):
            self.now_ms += SETTINGS.tick_ms
            self.schedule = self.next_tick(SETTINGS, self.schedule)
            for pair in PAIRS:
                if machine.is_ordered(SETTINGS, self.schedule, pair):
                    self.slots += 1
                    self.since_ms[pair] = self.now_ms
                    self.order(pair, self.schedule.number)
            if self.now_ms % CYCLE_MS == 0:
                self.schedule = machine.next_cycle(self.schedule)
            self.hear()
            if any(self.now_ms - since_ms > ROUND_MS for since_ms in self.since_ms.values()):
                self.broken.add("starved")
            self.come_and_go()
        return self.broken

    def order(self, pair: Pair, number: int) -> None:
        """An order reaches both radios or not; what they measure is answered at once, late, again, or never."""
        if self.chance.random() < 0.15:
            return
        begin_ms = self.now_ms + self.chance.randrange(LATEST_MS)
        if any(begin_ms < end_ms and other_ms < begin_ms + RANGING_MS for other_ms, end_ms, _ in self.rangings[-3:]):
            self.broken.add("two at once")
        self.rangings.append((begin_ms, begin_ms + RANGING_MS, pair))
        for _ in range(self.chance.choice((0, 1, 1, 1, 2))):
            delay_ms = self.chance.choice((0, 0, 0, 40, 130, 700, 5_000))
            self.answers.append((begin_ms + RANGING_MS + delay_ms, number, begin_ms, pair))

    def hear(self) -> None:
        """Offer what has come to every pair; it may count for the one that was ranged, at its true age."""
        come = [answer for answer in self.answers if answer[0] <= self.now_ms]
        self.answers = [answer for answer in self.answers if answer[0] > self.now_ms]
        for _, number, taken_ms, ranged in come:
            for pair in PAIRS:
                if self.counts(self.schedule, pair, number):
                    self.told += 1
                    age_cycles = self.schedule.turns[pair].age_cycles
                    if pair != ranged:
                        self.broken.add("another's")
                    if age_cycles < self.now_ms // CYCLE_MS - taken_ms // CYCLE_MS:
                        self.broken.add("too young")

    def come_and_go(self) -> None:
        """Trains ask for a place, again and again, and leave; the ground unit restarts, and who was there asks anew."""
        if self.chance.random() < 0.05:
            self.ask(self.chance.choice(PAIRS))
        if self.chance.random() < 0.01:
            pair = self.chance.choice(PAIRS)
            self.schedule = self.leave(self.schedule, pair)
            self.since_ms.pop(pair, None)
        if self.chance.random() < 0.005:
            self.schedule = self.restart(SETTINGS, self.schedule.number)
            again, self.since_ms = list(self.since_ms), {}
            for pair in again:
                self.ask(pair)
        if len(self.schedule.turns) > SETTINGS.most_pairs:
            self.broken.add("too many")

    def ask(self, pair: Pair) -> None:
        """A pair asks for a place; from when it has one it waits."""
        self.schedule = self.register(SETTINGS, self.schedule, pair)
        if pair in self.schedule.turns:
            self.since_ms.setdefault(pair, self.now_ms)


@pytest.mark.parametrize("seed", range(12))
def test_no_two_range_at_once_and_nobody_waits_longer_than_a_round(seed: int) -> None:
    air = Air(Random(seed))
    assert air.run(2_000) == set()
    assert air.slots > 80
    assert air.told > 50


def restarted_at_once(settings: ChannelSettings, number: int) -> Schedule:
    """The channel counts as free after a start."""
    return replace(restart_ranging_schedule(settings, number), taken_ms=0)


def numbered_anew(settings: ChannelSettings, _number: int) -> Schedule:
    """A spare unit does not know the last number."""
    return restart_ranging_schedule(settings, 0)


def counts_while_it_is_ones_slot(schedule: Schedule, pair: Pair, _number: int) -> bool:
    """Whatever is heard is of whoever had the newest slot."""
    return pair in schedule.turns and schedule.turns[pair].number == schedule.number


def given_another_place(settings: ChannelSettings, schedule: Schedule, pair: Pair) -> Schedule:
    """Who registers twice loses its place for the last one."""
    if schedule.pairs >= settings.most_pairs:
        return schedule
    turns = {**schedule.turns, pair: Turn(schedule.pairs, NONE, 0)}  # type: ignore[dict-item]
    return replace(schedule, turns=turns, pairs=schedule.pairs + 1)


def left_with_a_gap(schedule: Schedule, gone: Pair) -> Schedule:
    """Nobody closes up behind who leaves."""
    if gone not in schedule.turns:
        return schedule
    turns = {pair: turn for pair, turn in schedule.turns.items() if pair != gone}
    return replace(schedule, turns=turns, pairs=schedule.pairs - 1)


def freed_by_leaving(schedule: Schedule, gone: Pair) -> Schedule:
    """The slot ends with who leaves in it."""
    return replace(machine.leave(schedule, gone), taken_ms=0)


def registered_without_end(settings: ChannelSettings, schedule: Schedule, pair: Pair) -> Schedule:
    """Everybody finds a place."""
    return machine.register(replace(settings, most_pairs=len(PAIRS)), schedule, pair)


def answered_before_the_next(settings: ChannelSettings, schedule: Schedule) -> Schedule:
    """A slot begins sooner than the last one ends."""
    return machine.next_tick(replace(settings, tick_ms=2 * settings.tick_ms), schedule)


@pytest.mark.parametrize(
    ("wrong", "what"),
    [
        ({"restart": restarted_at_once}, "two at once"),
        ({"restart": numbered_anew}, "another's"),
        ({"counts": counts_while_it_is_ones_slot}, "another's"),
        ({"register": given_another_place}, "starved"),
        ({"leave": left_with_a_gap}, "two at once"),
        ({"leave": freed_by_leaving}, "two at once"),
        ({"register": registered_without_end}, "starved"),
        ({"next_tick": answered_before_the_next}, "two at once"),
    ],
    ids=lambda value: next(iter(value.values())).__name__ if isinstance(value, dict) else "",
)
def test_what_is_wrong_with_others_is_seen(wrong: dict[str, Any], what: str) -> None:
    assert what in {each for seed in range(6) for each in Air(Random(seed), **wrong).run(2_000)}


# ---- where it is used


def test_the_simulated_crossings_have_time_for_all_their_pairs() -> None:
    for trial in TRIALS:
        for kind in (trial.express, trial.local):
            assert are_in_time(CHANNEL, trial.bounds(kind))
            assert not are_in_time(replace(CHANNEL, most_pairs=CHANNEL.most_pairs + 1), trial.bounds(kind))


@pytest.mark.parametrize(
    ("channel", "words"),
    [
        (ChannelSettings(10, 105, 3), ""),
        (
            ChannelSettings(10, 106, 3),
            (
                "3 pairs in slots of 106 ms: rangings up to 604 ms old, but they count for 600 ms: write fewer pairs or"
                " shorter slots"
            ),
        ),
        (
            ChannelSettings(1, 1, 225),
            (
                "225 pairs in slots of 1 ms: rangings up to 601 ms old, but they count for 600 ms: write fewer pairs or"
                " shorter slots"
            ),
        ),
        (ChannelSettings(0, 105, 3), "tick 0 ms, slot 105 ms: both must be longer than 0 ms"),
        (ChannelSettings(10, 0, 3), "tick 10 ms, slot 0 ms: both must be longer than 0 ms"),
    ],
)
def test_settings_that_leave_no_time_are_refused_in_one_line(channel: ChannelSettings, words: str) -> None:
    assert refusal(channel, replace(BOUNDS, cycle_ms=150)) == words
