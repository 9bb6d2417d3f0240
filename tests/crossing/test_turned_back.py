"""Trains in contact that run to and fro over their start point, turn anywhere, and lose their radio (X2 to X4).

A world of its own, in mm and seconds: nothing of models or proofs is in it but the kernel's functions.  Rangings are
late, wrong within their bounds, or do not come; a person releases who was warned of and is seen out again.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from random import Random

import pytest

from kernel.crossing import arrival
from kernel.crossing import crossing as machine
from kernel.crossing.arrival import ArrivalBounds, Followed, Ranging
from kernel.crossing.crossing import Due, Train
from tests.crossing.road import DOWN, SETTINGS, UP, Road

LINE_MM_S, GAIN_MM_S2, BRAKES_MM_S2 = 28_000, 950, 800
START_MM = LINE_MM_S * (SETTINGS.start_cycles + 1)
OFF_MM, OFF_MM_S, LATEST_S, SILENCE_S = 5_000, 400, 2, 3
BOUNDS = ArrivalBounds(
    LINE_MM_S * 1_000, GAIN_MM_S2 * 1_000, 1_000, SETTINGS.warning_cycles, SILENCE_S, 4 * OFF_MM, 4 * OFF_MM_S + 1_000
)
TRAIN = Train("to and fro")
TO_AND_FRO_S, LOOKS_S, RUNS_OUT_S = (300, 1_200), 90, 25
HasTurnedBack = Callable[[ArrivalBounds, Followed, Ranging, int], bool]


@dataclass
class World(Road):
    """A line with a road, and a train that runs to and fro before it, and then to the road.

    ``way_mm``: of its head.  ``aims_mm_s``: how fast it means to run;
    to the road from ``runs_in_s`` on.  ``was_let_go``, ``let_go_inside``: how often.
    ``fails_s``, ``is_back_s``: between them its radio is out.  ``seen_s``: since when it is out again though it asks.
    """

    chance: Random
    has_turned_back: HasTurnedBack = arrival.has_turned_back
    way_mm: int = START_MM + 600_000
    speed_mm_s: int = 6_000
    aims_mm_s: int = 6_000
    changes_s: int = 0
    now_s: int = 0
    inside: bool = False
    runs_in_s: int = 0
    fails_s: int = 0
    is_back_s: int = 0
    seen_s: int = 0
    was_let_go: int = 0
    let_go_inside: int = 0
    followed: Followed | None = None
    said: tuple[tuple[int, int, int], ...] = ()

    def __post_init__(self) -> None:
        for track in (UP, DOWN):
            self.see_empty(track)
        self.runs_in_s = self.chance.randint(*TO_AND_FRO_S)
        self.fails_s = self.runs_in_s - self.chance.randint(0, 15)
        self.is_back_s = self.fails_s + self.chance.choice((10, 60, 400, 10_000))

    def drive(self) -> None:
        """Mean to run in or out for some time, not nearer than 700 m nor farther than 1,600 m; and at last to the road.

        As its radio fails it runs out, if it did not before.
        """
        if self.now_s >= self.changes_s:
            self.aims_mm_s = self.chance.choice((-9_000, -4_000, 0, 3_000, 6_000))
            self.changes_s = self.now_s + self.chance.randint(5, 60)
        if self.fails_s - RUNS_OUT_S <= self.now_s < self.runs_in_s:
            self.aims_mm_s = -9_000
        elif self.now_s >= self.runs_in_s:
            self.aims_mm_s = LINE_MM_S
        elif self.way_mm < 700_000 + max(0, self.speed_mm_s) ** 2 // (2 * BRAKES_MM_S2):
            self.aims_mm_s = -9_000
        elif self.way_mm > START_MM + 400_000:
            self.aims_mm_s = 6_000
        before_mm_s = self.speed_mm_s
        faster_mm_s = min(before_mm_s + GAIN_MM_S2, self.aims_mm_s)
        self.speed_mm_s = max(faster_mm_s, before_mm_s - BRAKES_MM_S2)
        self.way_mm -= (before_mm_s + self.speed_mm_s) // 2

    def strike(self) -> None:
        """The start point's terminal tells at once who runs in over it."""
        if self.way_mm <= START_MM and not self.inside:
            self.crossing = machine.note_struck(self.crossing, TRAIN)
        self.inside = self.way_mm <= START_MM

    def ranging(self) -> Ranging:
        """What the radio brings: wrong by less than its bounds, which are taken off; late, or nothing."""
        way_mm = self.way_mm + self.chance.randint(-OFF_MM, OFF_MM) - OFF_MM
        speed_mm_s = self.speed_mm_s + self.chance.randint(-OFF_MM_S, OFF_MM_S) + OFF_MM_S
        self.said = ((self.now_s, way_mm, speed_mm_s), *self.said[:LATEST_S])
        taken_s, way_mm, speed_mm_s = self.chance.choice(self.said)
        is_out = self.fails_s <= self.now_s < self.is_back_s or self.chance.random() < 0.02
        return Ranging(not is_out, way_mm, speed_mm_s, self.now_s - taken_s)

    def follow(self) -> dict[Train, Due]:
        told = self.ranging()
        if self.followed is None:
            if not arrival.begins_contact(BOUNDS, told):
                return {}
            self.crossing = machine.note_contact(self.crossing, TRAIN)
            now = arrival.taken(BOUNDS, Followed(0, 0, BOUNDS.line_um, 10**6, 0, 0, False), told)
        else:
            now = arrival.follow(BOUNDS, self.followed, told)
            if self.has_turned_back(BOUNDS, now, told, START_MM):
                self.was_let_go += 1
                self.let_go_inside += self.way_mm <= START_MM
                self.followed = None
                self.tell_gone(TRAIN)
                return {}
        self.followed = arrival.aged(BOUNDS, now)
        return {TRAIN: machine.due(BOUNDS, now, SETTINGS.reopening_cycles)}

    def look(self) -> None:
        """Somebody who has come sees that who was warned of is out again."""
        asks = TRAIN in self.crossing.asks and self.crossing.asks[TRAIN]
        self.seen_s = self.seen_s + 1 if asks and not self.inside else 0
        if self.seen_s > LOOKS_S and self.speed_mm_s <= 0:
            self.crossing = machine.note_released(self.crossing, TRAIN, machine.number_of(self.crossing, TRAIN))
            self.followed = None

    def second(self) -> None:
        self.strike()
        dues = self.follow()
        self.look()
        self.hear_the_terminals()
        self.decide(dues)
        self.drive()
        self.now_s += 1

    def played(self) -> World:
        while self.way_mm > 0:
            self.second()
        return self


def world(number: int, has_turned_back: HasTurnedBack = arrival.has_turned_back) -> World:
    return World(chance=Random(f"to and fro {number}"), has_turned_back=has_turned_back).played()


def judge(number: int) -> World:
    played = world(number)
    assert played.let_go_inside == 0
    assert played.warned_s > SETTINGS.warning_cycles
    assert played.down_s > SETTINGS.lowering_cycles + SETTINGS.least_down_cycles
    return played


@pytest.mark.parametrize("number", range(20))
def test_worlds_at_random(number: int) -> None:
    judge(number)


def test_trains_are_let_go_and_the_road_opens() -> None:
    played = [world(number) for number in range(20)]
    assert sum(each.was_let_go for each in played) > 20
    assert sum(each.open_s for each in played) > 20 * 150


@pytest.mark.slow
def test_a_thousand_worlds_at_random() -> None:
    for number in range(20, 1_020):
        judge(number)


def wherever_it_is(bounds: ArrivalBounds, followed: Followed, ranging: Ranging, _start_mm: int) -> bool:
    """Whoever runs away is let go."""
    return arrival.has_turned_back(bounds, followed, ranging, -10_000_000)


def test_who_is_let_go_inside_may_come_unwarned() -> None:
    assert any(world(number, wherever_it_is).warned_s <= SETTINGS.warning_cycles for number in range(100))


def nobody(_bounds: ArrivalBounds, _followed: Followed, _ranging: Ranging, _start_mm: int) -> bool:
    return False


def test_if_nobody_is_let_go_the_road_stays_closed_until_a_person_comes() -> None:
    """As his radio fails far away."""
    kept, open_s = (
        sum(world(number, turns).open_s for number in range(20)) for turns in (nobody, arrival.has_turned_back)
    )
    assert kept < open_s
