"""Power fails at a crossing with trains before it: a world of its own, in metres and seconds, with attacks (X3, X5).

Nothing of models or proofs is in it but the kernel's public functions.  Every attack is one way of having the arms up
with a train at the road; each was written down before it was tried.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field
from random import Random

import pytest

from kernel.crossing import crossing as machine
from kernel.crossing.crossing import Crossing, CrossingTrack, Settings, Train
from kernel.restarts import restart_crossing
from tests.crossing.road import SETTINGS

TRACKS = (CrossingTrack("up"), CrossingTrack("down"))
MOST_M_S = 28
START_M = MOST_M_S * (SETTINGS.start_cycles + 1)
LENGTH_M = 160
LATEST_S = 60
"""No word of a person is on its way for longer."""
NOTE_EMPTY = machine.note_empty
Start = Callable[[Settings, frozenset[CrossingTrack], int], Crossing]


@dataclass
class Vehicle:
    """A train; ``way_m``: from its head to the road.  ``stands_s``: it stands in the approach for so long yet."""

    name: Train
    track: CrossingTrack
    way_m: int
    speed_m_s: int
    stands_m: int = -1
    stands_s: int = 0
    struck: bool = False
    met: bool = False

    def inside(self) -> bool:
        return self.way_m <= START_M and self.way_m + LENGTH_M > 0


@dataclass
class World:
    """A crossing of two tracks whose trains have no radio; ``least_s``: the shortest closure before an arrival.

    ``words``: of people who have seen a track empty, on their way: when they come, of which track, and by which number;
    ``late``: what is drawn is how late they come, if they do not come at once.
    """

    start: Start = restart_crossing
    trains: list[Vehicle] = field(default_factory=list)
    powered: bool = True
    late: Random | None = None
    words: list[tuple[int, CrossingTrack, int]] = field(default_factory=list)
    now_s: int = 0
    closed_s: int = 0
    least_s: int = 10**6
    opened: int = 0
    open_unseen: int = 0
    failed_inside: int = 0
    life: int = 0
    seen: set[CrossingTrack] = field(default_factory=set)

    def __post_init__(self) -> None:
        self.fail()

    def fail(self) -> None:
        self.life += 1
        self.crossing = self.start(SETTINGS, frozenset(TRACKS), 1_000 * self.life)
        self.seen = set()

    def look(self, *tracks: CrossingTrack) -> None:
        """A person looks; what is seen empty is said, if there is power: at once, or late and again."""
        for track in tracks:
            if self.powered and all(each.track != track or not each.inside() for each in self.trains):
                number = machine.look_of(self.crossing, track)
                for late_s in (0,) if self.late is None else (self.late.randint(0, 10), self.late.randint(0, LATEST_S)):
                    self.words.append((self.now_s + late_s, track, number))
                self.seen.add(track)
        self.hear()

    def hear(self) -> None:
        """Words that come while there is no power are lost."""
        for _, track, number in [word for word in self.words if self.powered and word[0] <= self.now_s]:
            self.crossing = machine.note_empty(self.crossing, track, number)
        self.words = [word for word in self.words if word[0] > self.now_s]

    def second(self) -> None:
        """Strikes are told if there is power, then it decides, trains run, and arms move."""
        self.now_s += 1
        self.hear()
        for train in self.trains:
            if train.way_m <= START_M and not train.struck:
                train.struck = True
                if self.powered:
                    self.crossing = machine.note_struck(self.crossing, train.name)
        for track in TRACKS:
            self.crossing = machine.note_heard(self.crossing, track, 0)
        if not self.powered:
            self.fail()
        warned = self.crossing.warns
        self.crossing = machine.decide(SETTINGS, self.crossing, {})
        self.opened += warned and not self.crossing.warns
        lowered = machine.arms_are_to_be_down(SETTINGS, self.crossing)
        for train in list(self.trains):
            self.run(train)
        self.closed_s = self.closed_s + 1 if lowered else 0
        self.crossing = machine.aged(self.crossing)

    def run(self, train: Vehicle) -> None:
        if train.stands_s and train.way_m <= train.stands_m:
            train.stands_s -= 1
            return
        train.way_m -= train.speed_m_s
        if train.way_m <= 0 and not train.met:
            train.met = True
            self.least_s = min(self.least_s, self.closed_s - SETTINGS.lowering_cycles)
        if train.way_m + LENGTH_M <= 0:
            self.trains.remove(train)
            number = machine.number_of(self.crossing, train.name)
            self.crossing = machine.note_gone(self.crossing, train.name, number, True)

    def seconds(self, count: int) -> None:
        for _ in range(count):
            self.second()

    def open(self) -> None:
        self.look(*TRACKS)
        self.seconds(2)
        assert not self.crossing.warns

    def judge(self) -> None:
        """Every train that came had the arms down for their time, and the machine opens again when all was seen."""
        self.seconds(1_200)
        assert not self.trains
        assert self.least_s >= SETTINGS.least_down_cycles
        self.look(*TRACKS)
        self.seconds(LATEST_S + 2)
        assert not self.crossing.warns


def coming(track: CrossingTrack = TRACKS[0], stands_m: int = -1, stands_s: int = 0) -> Vehicle:
    return Vehicle(Train("one"), track, START_M + 1, MOST_M_S, stands_m, stands_s)


# ---- attacks


def terminals_are_heard_at_once(world: World) -> None:
    """Power fails for a second while a train that has struck is under way."""
    world.trains.append(coming())
    world.seconds(15)
    world.fail()
    world.seconds(60)


def it_stands_in_silence_for_longer_than_any_train_takes(world: World) -> None:
    """For ten minutes nothing is heard of the approach, and it is not empty."""
    world.trains.append(coming(stands_m=400, stands_s=600))
    world.seconds(25)
    world.fail()
    world.seconds(590)


def the_other_track_was_seen(world: World) -> None:
    """A person looks at once, along both tracks; on one is the train."""
    world.trains.append(coming(TRACKS[1]))
    world.seconds(10)
    world.fail()
    world.look(*TRACKS)
    world.seconds(60)


def it_was_seen_before_power_failed_again(world: World) -> None:
    """What was said in the life before does not count, with a train that has come since."""
    world.fail()
    world.look(*TRACKS)
    world.trains.append(coming())
    world.seconds(10)
    world.fail()
    world.seconds(60)


def it_strikes_while_there_is_no_power(world: World) -> None:
    """An open road loses its power, and the strike with it."""
    world.powered = False
    world.fail()
    world.trains.append(coming())
    world.seconds(25)
    world.powered = True
    world.seconds(60)


ATTACKS = (
    terminals_are_heard_at_once,
    it_stands_in_silence_for_longer_than_any_train_takes,
    the_other_track_was_seen,
    it_was_seen_before_power_failed_again,
    it_strikes_while_there_is_no_power,
)


@pytest.mark.parametrize("attack", ATTACKS)
def test_an_attack_fails(attack: Callable[[World], None]) -> None:
    world = World()
    world.open()
    attack(world)
    world.judge()


def forgetful(_settings: Settings, tracks: frozenset[CrossingTrack], number: int) -> Crossing:
    """What a crossing was that began closed and accounted for nothing."""
    return Crossing(
        {},
        {},
        dict.fromkeys(tracks, 0),
        dict.fromkeys(tracks, False),
        {},
        dict.fromkeys(tracks, number),
        number,
        True,
        0,
    )


@pytest.mark.parametrize("attack", ATTACKS)
def test_each_attack_succeeds_against_a_crossing_that_only_begins_closed(attack: Callable[[World], None]) -> None:
    world = World(forgetful)
    world.open()
    attack(world)
    assert world.least_s < SETTINGS.least_down_cycles or any(each.inside() for each in world.trains)
    assert not world.crossing.warns or world.least_s < SETTINGS.least_down_cycles


def drawn(seed: int) -> World:
    """Power fails at any moment, for seconds or minutes; somebody looks now and then, and his word comes late."""
    chance, world = Random(f"restarts {seed}"), World(late=Random(f"late words {seed}"))
    for number in range(900):
        clear = {track: all(each.track != track or each.met for each in world.trains) for track in TRACKS}
        for track in TRACKS:
            if clear[track] and chance.random() < 0.02:
                stands = {"stands_m": chance.randrange(START_M), "stands_s": chance.choice((0, 0, 40, 300))}
                world.trains.append(
                    Vehicle(Train(str(number)) + track, track, START_M + 60, chance.randint(8, MOST_M_S), **stands)  # type: ignore[arg-type]
                )
        if world.powered and chance.random() < 0.01:
            world.failed_inside += any(train.inside() for train in world.trains)
            world.fail()
            world.powered = chance.random() < 0.5
        elif not world.powered and chance.random() < 0.05:
            world.powered = True
        if chance.random() < 0.1:
            world.look(*TRACKS)
        world.second()
        world.open_unseen += not world.crossing.warns and world.seen != set(TRACKS)
    world.powered = True
    return world


def judge_at_random(seed: int) -> World:
    world = drawn(seed)
    assert world.open_unseen == 0
    world.judge()
    return world


@pytest.mark.parametrize("seed", range(25))
def test_in_drawn_worlds_no_train_finds_the_arms_up(seed: int) -> None:
    judge_at_random(seed)


def test_power_fails_with_trains_inside() -> None:
    assert sum(judge_at_random(seed).failed_inside for seed in range(25)) > 25


def empty_by_any_number(crossing: Crossing, track: CrossingTrack, _number: int) -> Crossing:
    """A word from before the restart counts."""
    return NOTE_EMPTY(crossing, track, machine.look_of(crossing, track))


def test_a_word_from_before_the_restart_is_seen_to_count(monkeypatch: pytest.MonkeyPatch) -> None:
    """A train that came in since it was spoken finds the arms up."""
    monkeypatch.setattr(machine, "note_empty", empty_by_any_number)
    assert any(drawn(seed).least_s < SETTINGS.least_down_cycles for seed in range(20))


@pytest.mark.slow
def test_in_a_thousand_drawn_worlds_no_train_finds_the_arms_up() -> None:
    for seed in range(25, 1_025):
        judge_at_random(seed)


def test_drawn_worlds_open_and_close() -> None:
    """Else the test above would show nothing."""
    world = World()
    world.open()
    world.trains.append(coming())
    world.seconds(120)
    world.open()
    assert world.opened == 2
    assert world.least_s >= SETTINGS.least_down_cycles
