"""Trains that turn back just beyond the road: a world of its own, in mm and seconds, with named days (X3 to X5).

Nothing of models or proofs is in it but the kernel's public functions.  Messages come up to three seconds late or not
at all, power fails at any moment, and trains without radio run on the other track.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field
from math import isqrt
from random import Random

import pytest

from kernel.crossing import arrival
from kernel.crossing import crossing as machine
from kernel.crossing.arrival import ArrivalBounds, Followed, Ranging
from kernel.crossing.crossing import Crossing, Due, Settings, Signal, Signals, Standing, Train
from tests.crossing.road import DOWN, SETTINGS, UP, Road, restarted

LINE_MM_S, GAIN_MM_S2 = 28_000, 950
LENGTH_MM = 120_000
START_MM = LINE_MM_S * (SETTINGS.start_cycles + 1)
LATEST_S = 3
BOUNDS = ArrivalBounds(LINE_MM_S * 1_000, GAIN_MM_S2 * 1_000, 1_000, SETTINGS.warning_cycles, 3, 1, 3_000)
BESIDE = Signal("beside the road, before it")
SIGNALS = Signals(frozenset({BESIDE}))
TURNS, PASSES = Train("turns"), Train("passes")
MayStart = Callable[[Settings, Crossing, Train], bool]


@dataclass
class World(Road):
    """A crossing, a train that stands ``signal_mm`` before it and wants to start at ``asks_s``, and one that passes.

    ``lost``: the share of messages lost.  ``warned_s``, ``down_s``: by what road users see.
    ``least_warned_s``, ``least_down_s``: the least of them when a head came to the road.
    """

    signal_mm: int
    asks_s: int
    chance: Random
    radio: bool = True
    lost: float = 0.0
    may_start: MayStart = machine.may_start
    passes_s: int = -1
    fails_s: int = -1
    now_s: int = 0
    air: list[tuple[int, str]] = field(default_factory=list)
    way_mm: int = 0
    speed_mm_s: int = 0
    started_s: int = -1
    let_go: bool = False
    met: bool = False
    gone: bool = False
    followed: Followed | None = None
    other_mm: int = 10**7
    struck: bool = False
    least_warned_s: int = 10**6
    least_down_s: int = 10**6

    def __post_init__(self) -> None:
        self.way_mm = self.signal_mm
        self.restart()
        self.look()
        self.decide({})
        assert not self.crossing.warns

    @property
    def run_cycles(self) -> int:
        """As is written for the signal: from a standstill, gaining all that a train can, none is there sooner."""
        return isqrt(2 * self.signal_mm // GAIN_MM_S2)

    def restart(self) -> None:
        self.crossing = restarted()
        self.followed = None

    def look(self) -> None:
        """A person accounts for what he sees empty; who stands at a signal at danger is not in the way."""
        if not self.let_go or self.gone:
            self.see_empty(UP)
        if not -LENGTH_MM < self.other_mm <= START_MM:
            self.see_empty(DOWN)
        self.hear_the_terminals()

    def say(self, what: str) -> None:
        if self.chance.random() >= self.lost:
            self.air.append((self.now_s + self.chance.randrange(LATEST_S + 1), what))

    def second(self) -> None:
        self.talk()
        dues = self.follow()
        self.hear_the_other()
        self.hear_the_terminals()
        if 0 <= self.fails_s <= self.now_s < self.fails_s + 5:
            self.restart()
        if self.fails_s >= 0 and self.now_s >= self.fails_s + 60:
            self.look()
        self.decide(dues)
        self.run()
        self.now_s += 1

    def talk(self) -> None:
        """A train that stands promises to; one that wants to start asks, again and again, until it is let go."""
        if self.started_s < 0:
            self.say("ask" if self.now_s >= self.asks_s else "promise")
        arrived = [what for due_s, what in self.air if due_s <= self.now_s]
        self.air = [(due_s, what) for due_s, what in self.air if due_s > self.now_s]
        for what in arrived:
            if what == "promise":
                self.crossing = machine.note_standing(SIGNALS, self.crossing, TURNS, Standing(BESIDE, True))
            elif what == "ask" and not self.let_go:
                self.crossing = machine.note_start(self.crossing, TURNS, self.run_cycles)
            elif what == "go" and self.started_s < 0:
                self.started_s = self.now_s
        if self.now_s >= self.asks_s and not self.let_go and self.may_start(SETTINGS, self.crossing, TURNS):
            self.let_go = True
            self.air.append((self.now_s + self.chance.randrange(LATEST_S + 1), "go"))

    def follow(self) -> dict[Train, Due]:
        """Range a train that runs towards the road; of one that stands the promise is heard, or the ranging counts."""
        if not self.radio or self.gone or self.started_s < 0 or self.way_mm <= 0:
            return {}
        self.crossing = machine.note_contact(self.crossing, TURNS)
        known = self.followed or arrival.nothing_known(BOUNDS)
        told = Ranging(True, self.way_mm, self.speed_mm_s, 0)
        now = arrival.taken(BOUNDS, known, told) if self.followed is None else arrival.follow(BOUNDS, known, told)
        self.followed = arrival.aged(BOUNDS, now)
        return {TURNS: machine.due(BOUNDS, now, SETTINGS.reopening_cycles)}

    def hear_the_other(self) -> None:
        if self.now_s == self.passes_s:
            self.other_mm = START_MM + LINE_MM_S
        if self.other_mm <= START_MM and not self.struck:
            self.struck = True
            self.crossing = machine.note_struck(self.crossing, PASSES)

    def arrives(self) -> None:
        self.least_warned_s = min(self.least_warned_s, self.warned_s - 1)
        self.least_down_s = min(self.least_down_s, self.down_s - 1 - SETTINGS.lowering_cycles)

    def run(self) -> None:
        if self.started_s >= 0:
            faster_mm_s = min(LINE_MM_S, self.speed_mm_s + GAIN_MM_S2)
            self.way_mm -= (self.speed_mm_s + faster_mm_s) // 2
            self.speed_mm_s = faster_mm_s
            if self.way_mm <= 0 and not self.met:
                self.met = True
                self.arrives()
            if self.way_mm + LENGTH_MM < 0 and not self.gone:
                self.gone = True
                self.tell_gone(TURNS)
        if self.now_s >= self.passes_s >= 0:
            before_mm, self.other_mm = self.other_mm, self.other_mm - LINE_MM_S
            if self.other_mm <= 0 < before_mm:
                self.arrives()
            if self.other_mm + LENGTH_MM <= 0 < before_mm + LENGTH_MM:
                self.tell_gone(PASSES)

    def seconds(self, count: int) -> World:
        for _ in range(count):
            self.second()
        return self


def judge(world: World) -> None:
    """It came, every head found warning and arms as written, and nothing latches."""
    assert world.met
    assert world.gone
    assert world.least_warned_s >= SETTINGS.warning_cycles
    assert world.least_down_s >= SETTINGS.least_down_cycles
    world.look()
    world.seconds(2)
    assert not world.crossing.warns
    assert not world.crossing.starts


# ---- named days


@pytest.mark.parametrize("signal_m", [60, 80, 300, 900])
def test_a_train_turns_back_just_beyond_the_road(signal_m: int) -> None:
    """It stands there for ten minutes with the road open, asks, and comes with the whole warning."""
    world = World(1_000 * signal_m, 600, Random(1)).seconds(600)
    assert world.open_s == 601
    judge(world.seconds(300))


def now(_settings: Settings, crossing: Crossing, train: Train) -> bool:
    """Let a train go as soon as it asks."""
    return train in crossing.starts


@pytest.mark.parametrize("signal_m", [60, 80, 300])
def test_a_train_that_is_let_go_at_once_comes_with_half_of_the_warning_or_less(signal_m: int) -> None:
    """The day as it was: rangings and start points see it too late."""
    world = World(1_000 * signal_m, 60, Random(1), may_start=now).seconds(300)
    assert world.met
    assert world.least_warned_s < SETTINGS.warning_cycles
    assert signal_m > 80 or world.least_warned_s <= 17


def test_power_fails_when_it_has_been_let_go() -> None:
    """A person sees it under way, and accounts for its track when it is past."""
    world = World(80_000, 60, Random(2), fails_s=95)
    judge(world.seconds(400))
    assert world.let_go


def test_another_train_passes_while_it_waits() -> None:
    """The warning for that one counts for it too: it has been as long."""
    alone = World(80_000, 60, Random(3)).seconds(300)
    beside = World(80_000, 60, Random(3), passes_s=40).seconds(300)
    judge(alone)
    judge(beside)
    assert beside.started_s < alone.started_s


def test_a_promise_that_is_not_heard_keeps_nothing_open_and_nothing_closed() -> None:
    """Silence revokes nothing that was promised; asking is heard at last."""
    world = World(80_000, 300, Random(4), lost=0.9).seconds(300)
    assert world.open_s == 301
    judge(world.seconds(500))


# ---- worlds at random


def random_world(number: int) -> World:
    chance = Random(number)
    return World(
        signal_mm=chance.randrange(40_000, 1_000_000),
        asks_s=chance.randrange(1, 200),
        chance=chance,
        radio=chance.random() < 0.7,
        lost=chance.choice((0.0, 0.1, 0.6)),
        passes_s=chance.choice((-1, chance.randrange(1, 300))),
        fails_s=chance.choice((-1, chance.randrange(1, 300))),
    )


@pytest.mark.parametrize("number", range(20))
def test_worlds_at_random(number: int) -> None:
    judge(random_world(number).seconds(1_200))


@pytest.mark.slow
def test_a_thousand_worlds_at_random() -> None:
    for number in range(20, 1_020):
        judge(random_world(number).seconds(1_200))
