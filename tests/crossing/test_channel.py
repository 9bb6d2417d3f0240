"""One radio channel of several trains and crossings: a world of its own in milliseconds (X1).

Nothing of models or proofs is in it but the kernel's public functions: its radios range when an order reaches them, and
hold on to answers; rangings that overlap are seen by their times.  Orders and answers are lost, late or come twice, the
ground unit restarts, and decisions begin early or late.  What else might give out the slots, with one thing wrong, was
written down before it was tried, and each breaks what is judged here.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field, replace
from random import Random
from typing import Any

import pytest

from kernel.crossing import ranging_schedule as machine
from kernel.crossing.crossing import Train
from kernel.crossing.ranging_schedule import NONE, ChannelSettings, CrossingName, Pair, Schedule, Turn
from kernel.restarts import restart_ranging_schedule

SETTINGS = ChannelSettings(tick_ms=10, slot_ms=100, most_pairs=6)
RANGING_MS, LATEST_MS = 30, 60
"""So long a ranging takes, and so late it begins after its order at the most: over within 90 ms."""
CYCLE_MS, JITTER_TICKS = 250, 2
KEPT_CYCLES = 30
"""In so many cycles the latest answer has come."""
ROUND_MS = SETTINGS.most_pairs * (SETTINGS.slot_ms + SETTINGS.tick_ms)
PAIRS = tuple(Pair(Train(str(number)), CrossingName(name)) for number in range(5) for name in ("west", "east"))


@dataclass
class Air:
    """A channel in milliseconds, one ground unit, and radios that obey the orders that reach them.

    ``rangings``: from when to when, by number, and of whom.  ``answers``: under way, with the number.
    ``since_ms``: since when a pair waits.
    ``decided_ms``: when the crossings began to decide.  ``broken``: what was broken.
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
    decided_ms: list[int] = field(default_factory=list)
    decides_ms: int = CYCLE_MS
    broken: set[str] = field(default_factory=set)
    starts: int = 0
    slots: int = 0
    full: int = 0
    told: int = 0

    def run(self, ticks: int) -> set[str]:
        """Run on; give what was broken."""
        for _ in range(ticks):
            self.now_ms += SETTINGS.tick_ms
            self.schedule = self.next_tick(SETTINGS, self.schedule)
            for pair in PAIRS:
                if machine.is_ordered(SETTINGS, self.schedule, pair):
                    self.take_turn(pair)
                    self.order(pair, self.schedule.number)
            if self.now_ms >= self.decides_ms:
                self.schedule = machine.next_cycle(self.schedule)
                self.decided_ms.append(self.now_ms)
                late_ms = SETTINGS.tick_ms * self.chance.randint(-JITTER_TICKS, JITTER_TICKS)
                self.decides_ms = CYCLE_MS * (len(self.decided_ms) + 1) + late_ms
            self.hear()
            if any(self.now_ms - since_ms > ROUND_MS for since_ms in self.since_ms.values()):
                self.broken.add("starved")
            self.come_and_go()
        return self.broken

    def take_turn(self, pair: Pair) -> None:
        """Note a slot: nobody has it while another pair has waited for longer."""
        self.slots += 1
        waited_ms = self.since_ms.get(pair, self.now_ms)
        if any(since_ms < waited_ms for since_ms in self.since_ms.values()):
            self.broken.add("out of turn")
        self.since_ms[pair] = self.now_ms

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
                    if age_cycles < sum(taken_ms < decided_ms for decided_ms in self.decided_ms[-KEPT_CYCLES:]):
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
            self.starts += 1
            again, self.since_ms = list(self.since_ms), {}
            for pair in again:
                self.ask(pair)
        if len(self.schedule.turns) > SETTINGS.most_pairs:
            self.broken.add("too many")

    def ask(self, pair: Pair) -> None:
        """A pair asks for a place; from when it has one it waits."""
        self.full += pair not in self.schedule.turns and self.schedule.pairs == SETTINGS.most_pairs
        self.schedule = self.register(SETTINGS, self.schedule, pair)
        if pair in self.schedule.turns:
            self.since_ms.setdefault(pair, self.now_ms)


def judge(seed: int) -> Air:
    """No two range at once, each pair has its turn within a round, and what counts is of its pair, at its true age."""
    air = Air(Random(f"channel {seed}"))
    assert air.run(2_000) == set()
    assert air.slots > 80
    assert air.told > 50
    return air


@pytest.mark.parametrize("seed", range(20))
def test_a_channel_at_random(seed: int) -> None:
    judge(seed)


@pytest.mark.slow
def test_a_thousand_channels_at_random() -> None:
    for seed in range(20, 1_020):
        judge(seed)


def test_the_ground_unit_starts_anew_and_pairs_find_no_place() -> None:
    airs = [judge(seed) for seed in range(20)]
    assert sum(air.starts for air in airs) > 100
    assert sum(air.slots for air in airs) > 20 * 120
    assert sum(air.full for air in airs) > 100


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
