"""Two crossings close together: a world of its own, in mm and seconds, with named days (X2 to X5).

Nothing of models or proofs is in it but the kernel's public functions, and the settings of the days.  The start points
of each road lie beyond the other road.  A train passes the first road, stands between both, and goes on over the second
or turns back over the first; one without radio runs over both on the other track, from the other side.  In worlds at
random the power of either road fails at any moment, and decisions are taken a little early or late.
"""

from __future__ import annotations

from dataclasses import dataclass, field, replace
from math import isqrt
from random import Random

import pytest

from kernel.crossing import arrival
from kernel.crossing import crossing as machine
from kernel.crossing.arrival import ArrivalBounds, Followed, Ranging
from kernel.crossing.crossing import Crossing, CrossingTrack, Due, Settings, Signal, Signals, Standing, Train
from kernel.restarts import restart_crossing
from tests.crossing.road import DOWN, SETTINGS, UP, Road

LINE_MM_S, GAIN_MM_S2, BRAKES_MM_S2 = 28_000, 950, 800
LENGTH_MM = 120_000
JITTER_MS = 20
LONGEST_MS = 1_000 + 2 * JITTER_MS
START_MM = LINE_MM_S * LONGEST_MS * (SETTINGS.start_cycles + 1) // 1_000
BOUNDS = ArrivalBounds(LINE_MM_S * LONGEST_MS, GAIN_MM_S2 * LONGEST_MS, 1_000, SETTINGS.warning_cycles, 3, 1, 3_000)
LOOKS_S = 60
"""After a restart a person has come and looks."""
NEVER_MM = 10**9
"""A train that is to stand there runs on."""
BETWEEN = {1: Signal("between, before the second road"), -1: Signal("between, before the first road")}
"""The starting signals between both roads, by the direction of who stands at them."""
STANDS, PASSES = Train("stands between"), Train("passes")
RESTART = restart_crossing


@dataclass
class RoadAt(Road):
    """A crossing at ``at_mm`` of the line; without power in ``dark`` (seconds).

    ``heads``: who came to the road, and for how many ms it had warned and its arms had been down.
    """

    at_mm: int
    signals: Signals
    dark: range = range(0)
    now_ms: int = 0
    warned_from_ms: int = 0
    down_from_ms: int = 0
    followed: Followed | None = None
    heads: list[tuple[Train, int, int]] = field(default_factory=list)
    gone: set[Train] = field(default_factory=set)
    struck: set[Train] = field(default_factory=set)

    def __post_init__(self) -> None:
        for track in (UP, DOWN):
            self.see_empty(track)
            self.crossing = machine.note_heard(self.crossing, track, 0)
        self.decide({})
        assert not self.crossing.warns

    def decide(self, dues: dict[Train, Due]) -> None:
        self.hear_the_terminals()
        super().decide(dues)
        self.warned_from_ms = self.now_ms if self.warned_s <= 1 else self.warned_from_ms
        self.down_from_ms = self.now_ms if self.down_s <= 1 else self.down_from_ms

    def fail(self) -> None:
        """Begin anew, as in each second without power."""
        self.crossing = restart_crossing(SETTINGS, frozenset((UP, DOWN)), self.crossing.number + 1)
        self.followed = None

    def meet(self, train: Train, before_mm: int, now_mm: int) -> None:
        """Note a head that has come to the road, by where it was a second ago."""
        if before_mm < self.at_mm <= now_mm or now_mm <= self.at_mm < before_mm:
            warned_ms = self.now_ms - self.warned_from_ms if self.warned_s else -1
            down_ms = self.now_ms - self.down_from_ms if self.down_s else -1
            self.heads.append((train, warned_ms, down_ms - SETTINGS.cycle_ms * SETTINGS.lowering_cycles))

    def tell_gone(self, train: Train) -> None:
        super().tell_gone(train)
        self.followed = None
        self.gone.add(train)


@dataclass
class Two:
    """Two roads ``apart_mm`` from each other, and the trains.

    ``stands_mm``: so far beyond the first road the train stands, for ``stands_s``; ``turns``: then it turns back.
    ``radio``: it is in contact.  ``passes_s``: when the other one comes, from beyond the second road; never, if -1.
    ``forgets``: whoever is past one road is told gone to both.  ``is_whole``: the train that stands knows that it is.
    ``dark``: for each road the seconds without power.  ``jitter``: what moves its decisions, if anything.
    ``open_under``: seconds in which a road was open with the train across it.
    ``failed_before``: seconds without power with a train on its way to the road.
    """

    apart_mm: int
    stands_mm: int
    stands_s: int
    turns: bool
    radio: bool = True
    passes_s: int = -1
    forgets: bool = False
    is_whole: bool = True
    dark: tuple[range, range] = (range(0), range(0))
    jitter: Random | None = None
    open_under: int = 0
    failed_before: int = 0
    now_s: int = 0
    now_ms: int = 0
    lasts_ms: int = 1_000
    head_mm: int = -2_500_000
    speed_mm_s: int = 20_000
    direction: int = 1
    stood_s: int = 0
    asked: bool = False
    let_go: bool = False
    other_mm: int = 10**8
    roads: tuple[RoadAt, RoadAt] = field(init=False)

    def __post_init__(self) -> None:
        first, second = Signals(frozenset({BETWEEN[-1]})), Signals(frozenset({BETWEEN[1]}))
        self.roads = (RoadAt(0, first, self.dark[0]), RoadAt(self.apart_mm, second, self.dark[1]))

    @property
    def ahead(self) -> RoadAt:
        """The road that the train runs over when it leaves where it stands."""
        return self.roads[0 if self.turns else 1]

    def second(self) -> None:
        for road in self.roads:
            dues = self.follow(road)
            self.strike(road)
            if self.now_s in road.dark:
                road.fail()
                dues = {}
                self.failed_before += 0 < self.way_mm(road) <= START_MM
            elif road.dark and self.now_s > road.dark.stop + LOOKS_S:
                self.look(road)
            road.now_ms = self.now_ms
            road.decide(dues)
            self.open_under += self.is_across(road) and not road.crossing.warns
        self.stand()
        self.now_s += 1
        next_ms = 1_000 * self.now_s + (self.jitter.randint(-JITTER_MS, JITTER_MS) if self.jitter else 0)
        self.lasts_ms, self.now_ms = next_ms - self.now_ms, next_ms
        self.run()
        self.pass_by()

    def look(self, road: RoadAt) -> None:
        """A person accounts for a track from start point to start point; who stands at a signal is not in the way."""
        if not -START_MM - LENGTH_MM < self.way_mm(road) <= START_MM or (self.stands() and not self.is_across(road)):
            road.see_empty(UP)
        if not -START_MM - LENGTH_MM < self.other_mm - road.at_mm <= START_MM:
            road.see_empty(DOWN)

    def is_across(self, road: RoadAt) -> bool:
        return -LENGTH_MM < self.way_mm(road) < 0

    def way_mm(self, road: RoadAt) -> int:
        return (road.at_mm - self.head_mm) * self.direction

    def follow(self, road: RoadAt) -> dict[Train, Due]:
        """Range a train that is in contact and runs towards a road; who stands has promised to, until it is let go."""
        way_mm = self.way_mm(road)
        if not self.radio or not 0 < way_mm < 2_000_000 or STANDS in road.gone or self.stands():
            return {}
        road.crossing = machine.note_contact(road.crossing, STANDS)
        told = Ranging(True, way_mm, self.speed_mm_s, 0)
        known = road.followed or arrival.nothing_known(BOUNDS)
        now = arrival.taken(BOUNDS, known, told) if road.followed is None else arrival.follow(BOUNDS, known, told)
        road.followed = arrival.aged(BOUNDS, now)
        return {STANDS: machine.due(BOUNDS, now, SETTINGS.reopening_cycles)}

    def strike(self, road: RoadAt) -> None:
        """Strike a start point: of the train with radio the terminal knows that it is that one."""
        if STANDS not in road.struck and self.direction == 1 and self.way_mm(road) <= START_MM:
            road.struck.add(STANDS)
            road.crossing = machine.note_struck(road.crossing, STANDS)
        if PASSES not in road.struck and self.other_mm - road.at_mm <= START_MM:
            road.struck.add(PASSES)
            road.crossing = machine.note_struck(road.crossing, PASSES)

    def stands(self) -> bool:
        return self.speed_mm_s == 0 and not self.let_go

    def stand(self) -> None:
        """Promise to stand, to both roads; ask the one ahead, and go when that one says so."""
        if not self.stands():
            return
        self.stood_s += 1
        for road in self.roads:
            road.followed = None
            standing = Standing(BETWEEN[self.direction], self.is_whole)
            road.crossing = machine.note_standing(road.signals, road.crossing, STANDS, standing)
        if self.stood_s < self.stands_s:
            return
        if self.turns and not self.asked:
            self.direction = -1
            self.head_mm -= LENGTH_MM
            self.roads[0].gone.discard(STANDS)
        self.asked = True
        run_cycles = isqrt(2 * max(0, self.way_mm(self.ahead)) // GAIN_MM_S2)
        self.ahead.crossing = machine.note_start(self.ahead.crossing, STANDS, run_cycles)
        self.let_go = machine.may_start(SETTINGS, self.ahead.crossing, STANDS)

    def run(self) -> None:
        """Brake to where it is to stand, or gain what it can up to 20 m/s, for as long as this cycle lasts."""
        before_mm, left_mm = self.head_mm, self.stands_mm - self.head_mm
        if self.let_go:
            faster_mm_s = min(20_000, self.speed_mm_s + GAIN_MM_S2 * self.lasts_ms // 1_000)
        elif self.asked or left_mm <= 1_000:
            faster_mm_s = 0
        else:
            faster_mm_s = min(20_000, max(500, isqrt(2 * BRAKES_MM_S2 * max(0, left_mm - 12_000))))
        way_mm = faster_mm_s * self.lasts_ms // 1_000
        self.head_mm += self.direction * (way_mm if self.let_go else min(left_mm, way_mm))
        self.speed_mm_s = faster_mm_s
        for road in self.roads:
            road.meet(STANDS, before_mm, self.head_mm)
            if self.way_mm(road) <= -LENGTH_MM and self.passed(road) and STANDS not in road.gone:
                for each in self.roads if self.forgets else (road,):
                    each.tell_gone(STANDS)

    def passed(self, road: RoadAt) -> bool:
        return any(train == STANDS for train, _, _ in road.heads)

    def pass_by(self) -> None:
        if self.now_s == self.passes_s + 1:
            self.other_mm = self.apart_mm + START_MM + 100_000
        if not 0 <= self.passes_s < self.now_s:
            return
        before_mm, self.other_mm = self.other_mm, self.other_mm - LINE_MM_S * self.lasts_ms // 1_000
        for road in self.roads:
            road.meet(PASSES, before_mm, self.other_mm)
            if self.other_mm + LENGTH_MM < road.at_mm and PASSES not in road.gone:
                Road.tell_gone(road, PASSES)
                road.gone.add(PASSES)

    def seconds(self, count: int) -> Two:
        for _ in range(count):
            self.second()
        return self


def late(world: Two) -> list[tuple[Train, int, int]]:
    """Heads that came to a road too soon after the warning, or with the arms down for too short a time."""
    return [
        head
        for road in world.roads
        for head in road.heads
        if head[1] < SETTINGS.cycle_ms * SETTINGS.warning_cycles
        or head[2] < SETTINGS.cycle_ms * SETTINGS.least_down_cycles
    ]


def judge(world: Two) -> None:
    """Every head found warning and arms as written; who ran over a road was met there, and nothing latches."""
    world.seconds(1_200)
    assert late(world) == []
    assert world.open_under == 0
    over = [sum(train == STANDS for train, _, _ in road.heads) for road in world.roads]
    assert over == ([2, 0] if world.turns else [1, 1])
    assert [not road.crossing.warns for road in world.roads] == [True, True]


# ---- named days


@pytest.mark.parametrize("radio", [True, False])
def test_a_train_stands_between_the_roads_and_goes_on(radio: bool) -> None:
    """While it stands neither road is closed for it; the second one opens, and closes again when it asks."""
    world = Two(apart_mm=400_000, stands_mm=340_000, stands_s=200, turns=False, radio=radio)
    judge(world)
    assert world.roads[1].open_s > 900


@pytest.mark.parametrize("radio", [True, False])
def test_a_train_turns_back_between_the_roads(radio: bool) -> None:
    """The first road warns anew before it comes; the second one was warned of it, and opens though it never comes."""
    judge(Two(apart_mm=400_000, stands_mm=340_000, stands_s=100, turns=True, radio=radio))


@pytest.mark.parametrize("turns", [True, False])
def test_another_train_passes_over_both_roads_meanwhile(turns: bool) -> None:
    """Its start point before the first road lies beyond the second one (X3)."""
    for passes_s in range(0, 400, 25):
        judge(Two(400_000, 340_000, 100, turns, passes_s=passes_s))


@pytest.mark.parametrize("radio", [True, False])
@pytest.mark.parametrize("stands_mm", [20_000, 60_000, LENGTH_MM - 1])
def test_a_train_that_stands_across_the_first_road_keeps_it_closed(radio: bool, stands_mm: int) -> None:
    """It promises to stand at the signal before the second one, and that one alone opens."""
    world = Two(400_000, stands_mm, stands_s=200, turns=False, radio=radio).seconds(250)
    assert world.stands()
    assert [road.crossing.warns for road in world.roads] == [True, False]
    judge(world)


def test_a_train_that_is_not_whole_keeps_the_road_closed_that_it_stands_before() -> None:
    """What has parted from it may be on its way (X4)."""
    for is_whole in (True, False):
        world = Two(400_000, 340_000, stands_s=300, turns=False, radio=False, is_whole=is_whole).seconds(300)
        assert world.stands()
        assert world.roads[1].crossing.warns is not is_whole


def test_who_is_past_one_road_is_not_past_the_other() -> None:
    """A rear that is told gone to both roads leaves the second one open under a train that runs on."""
    for radio in (True, False):
        assert late(Two(400_000, NEVER_MM, 0, turns=False, radio=radio).seconds(300)) == []
        assert late(Two(400_000, NEVER_MM, 0, turns=False, radio=radio, forgets=True).seconds(300)) != []


# ---- worlds at random


def drawn_dark(chance: Random) -> range:
    """Power fails in half of the worlds, for some seconds."""
    fails_s = chance.choice((-60, chance.randrange(1, 400)))
    return range(fails_s, fails_s + chance.randint(1, 20))


def random_world(number: int) -> Two:
    chance = Random(number)
    apart_mm = chance.randrange(250_000, 900_000)
    stands_mm = chance.randrange(20_000, apart_mm - 20_000)
    return Two(
        apart_mm=apart_mm,
        stands_mm=stands_mm,
        stands_s=chance.randrange(1, 200),
        turns=chance.random() < 0.5 and stands_mm >= LENGTH_MM + 20_000,
        radio=chance.random() < 0.7,
        passes_s=chance.choice((-1, chance.randrange(1, 500))),
        dark=(drawn_dark(chance), drawn_dark(chance)),
        jitter=chance,
    )


@pytest.mark.parametrize("number", range(20))
def test_worlds_at_random(number: int) -> None:
    judge(random_world(number))


@pytest.mark.slow
def test_a_thousand_worlds_at_random() -> None:
    for number in range(20, 1_020):
        judge(random_world(number))


def failed(number: int) -> Two:
    return random_world(number).seconds(600)


def test_power_fails_with_trains_before_the_roads() -> None:
    assert sum(failed(number).failed_before > 0 for number in range(20)) > 3


def starts_open(settings: Settings, tracks: frozenset[CrossingTrack], number: int) -> Crossing:
    """Nobody has to see a track empty after a restart."""
    return replace(RESTART(settings, tracks, number), unaccounted=dict.fromkeys(tracks, False))


def test_a_road_that_starts_open_is_seen(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("tests.crossing.test_close_roads.restart_crossing", starts_open)
    assert any(late(world) or world.open_under for world in (failed(number) for number in range(20)))
