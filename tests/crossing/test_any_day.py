"""Days at a road with everything at once, in mm and ms: a world of its own; no models and no proofs in it (X1 to X5).

Trains follow one another on two tracks, with radio and without; they stop short, and the last of a track runs to and
fro, out over its start point and in again.  Power fails, twice and for any time, with trains anywhere.  Decisions are
taken a little early or late.  Rangings are late, wrong within their bounds, or do not come, for minutes of one train.
People release what has left, and account for tracks that they see empty.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field, replace
from random import Random

import pytest

from kernel.crossing import arrival
from kernel.crossing import crossing as machine
from kernel.crossing.arrival import ArrivalBounds, Followed, Ranging
from kernel.crossing.crossing import Crossing, CrossingTrack, Due, Settings, Train
from kernel.maps import Map
from kernel.restarts import restart_crossing
from tests.crossing.road import DOWN, SETTINGS, UP, restarted

LINE_MM_S, GAIN_MM_S2, BRAKES_MM_S2, LENGTH_MM, APART_MM = 28_000, 950, 800, 120_000, 400_000
JITTER_MS = 20
"""A decision is taken so much early or late, and the next one by itself: a cycle lasts 40 ms more or less at most."""
LONGEST_MS = 1_000 + 2 * JITTER_MS
START_MM = LINE_MM_S * LONGEST_MS * (SETTINGS.start_cycles + 1) // 1_000
OFF_MM, OFF_MM_S, LATEST_S = 5_000, 400, 2
BOUNDS = ArrivalBounds(
    LINE_MM_S * LONGEST_MS,
    GAIN_MM_S2 * LONGEST_MS,
    SETTINGS.cycle_ms,
    SETTINGS.warning_cycles,
    3,
    4 * OFF_MM,
    4 * OFF_MM_S + GAIN_MM_S2 + BRAKES_MM_S2,
)
NOTHING_KNOWN = Followed(0, 0, BOUNDS.line_um, 10**6, 0, 0, False)
LOOKS_S, RUNS_OUT_S, WHOLE_S = 60, 25, 1_500
Decide = Callable[[Settings, Crossing, Map[Train, Due]], Crossing]
HasTurnedBack = Callable[[ArrivalBounds, Followed, Ranging, int], bool]


@dataclass
class Body:
    """A train: of its head ``way_mm`` to the road, and what the ground unit and people have of it.

    ``stops_mm``: where it stands for ``stands_s``.  ``to_and_fro_s``: until then it runs in and out, if it does so.
    ``unheard``: the seconds in which its radio is out, if it has one.
    ``out_s``: for how long it has been out of the approach, though the crossing knows it.
    """

    name: Train
    track: CrossingTrack
    way_mm: int
    has_radio: bool
    stops_mm: int
    stands_s: int
    to_and_fro_s: int
    unheard: range
    speed_mm_s: int = 15_000
    aims_mm_s: int = 15_000
    inside: bool = False
    met: bool = False
    out_s: int = 0
    followed: Followed | None = None
    said: tuple[tuple[int, int, int], ...] = ()

    @property
    def is_in_the_approach(self) -> bool:
        return self.inside and self.way_mm > -LENGTH_MM - 15_000


@dataclass
class Found:
    """At each arrival, for how long the warning had lasted and the arms been lowered, in ms; and other counts."""

    warned_ms: list[int] = field(default_factory=list)
    lowered_ms: list[int] = field(default_factory=list)
    opened_on: int = 0
    open_s: int = 0
    let_go: int = 0
    let_go_inside: int = 0
    failed_inside: int = 0


@dataclass
class Day:
    """A road, its trains, and the time at which the last decision was taken.

    ``dark``: the seconds without power.  ``asked``: who has asked for the warning and is not out yet.
    """

    chance: Random
    decide: Decide = machine.decide
    has_turned_back: HasTurnedBack = arrival.has_turned_back
    bodies: list[Body] = field(default_factory=list)
    found: Found = field(default_factory=Found)
    now_s: int = 0
    now_ms: int = 0
    warned_from_ms: int = -1
    lowered_from_ms: int = -1
    asked: set[Train] = field(default_factory=set)
    seen_s: dict[CrossingTrack, int] = field(default_factory=dict)
    crossing: Crossing = field(default_factory=restarted)
    dark: set[int] = field(default_factory=set)

    def __post_init__(self) -> None:
        for track in (UP, DOWN):
            self.crossing = machine.note_empty(self.crossing, track, machine.look_of(self.crossing, track))
            way_mm = START_MM + 300_000
            for place in range(count := self.chance.randint(1, 3)):
                runs_to_and_fro = place == count - 1 and self.chance.random() < 0.6
                to_and_fro_s = self.chance.randint(200, 700) if runs_to_and_fro else 0
                unheard_s = max(0, to_and_fro_s - self.chance.randint(0, 15)) or self.chance.randint(0, 400)
                self.bodies.append(
                    Body(
                        name=Train(f"{track} {place}"),
                        track=track,
                        way_mm=way_mm + self.chance.randint(0, 500_000),
                        has_radio=self.chance.random() < 0.7,
                        stops_mm=self.chance.randint(100_000, START_MM + 200_000),
                        stands_s=self.chance.choice((0, 20, 120)),
                        to_and_fro_s=to_and_fro_s,
                        unheard=range(unheard_s, unheard_s + self.chance.choice((0, 20, 200))),
                    )
                )
                way_mm = self.bodies[-1].way_mm + LENGTH_MM + APART_MM
        first_s = self.chance.randint(20, 500)
        fails = (first_s, first_s + self.chance.randint(30, 400))
        self.dark = {fail_s + second for fail_s in fails for second in range(self.chance.randint(1, 30))}

    # ---- trains

    def drive(self, body: Body, ahead: Body | None, lasts_ms: int) -> None:
        """As fast as its driver means to, but for the train ahead of it.

        Who runs to and fro runs out as its radio fails, if it did not before.
        """
        aims_mm_s = LINE_MM_S
        if self.now_s < body.to_and_fro_s:
            if self.chance.random() < 0.04:
                body.aims_mm_s = self.chance.choice((-6_000, -6_000, 0, 3_000, 6_000))
            aims_mm_s = body.aims_mm_s if body.way_mm < START_MM + 400_000 else 6_000
            if body.way_mm < 700_000 or body.unheard.start - RUNS_OUT_S <= self.now_s:
                aims_mm_s = -6_000
        elif body.stands_s > 0 and body.way_mm > body.stops_mm:
            aims_mm_s = self.stopping_mm_s(body.way_mm - body.stops_mm)
            body.stands_s -= body.speed_mm_s == 0
        if ahead is not None:
            aims_mm_s = min(aims_mm_s, self.stopping_mm_s(body.way_mm - ahead.way_mm - LENGTH_MM - 50_000))
        before_mm_s = body.speed_mm_s
        faster_mm_s = min(before_mm_s + GAIN_MM_S2 * lasts_ms // 1_000, aims_mm_s)
        body.speed_mm_s = max(faster_mm_s, before_mm_s - BRAKES_MM_S2 * lasts_ms // 1_000)
        body.way_mm -= (before_mm_s + body.speed_mm_s) * lasts_ms // 2_000

    def stopping_mm_s(self, way_mm: int) -> int:
        """From so fast a train stops within a way."""
        return int((2 * 700 * max(0, way_mm - 30_000)) ** 0.5)

    def run(self, lasts_ms: int) -> None:
        ahead: dict[CrossingTrack, Body] = {}
        for body in self.bodies:
            was_mm = body.way_mm
            self.drive(body, ahead.get(body.track), lasts_ms)
            ahead[body.track] = body
            if was_mm > 0 >= body.way_mm and not body.met:
                body.met = True
                self.found.warned_ms.append(self.now_ms - self.warned_from_ms if self.crossing.warns else 0)
                self.found.lowered_ms.append(self.now_ms - self.lowered_from_ms if self.lowered_from_ms >= 0 else 0)

    # ---- what the crossing is told

    def strike(self) -> None:
        for body in self.bodies:
            if body.way_mm <= START_MM and not body.inside and not body.met and self.now_s not in self.dark:
                self.crossing = machine.note_struck(self.crossing, body.name)
            body.inside = body.way_mm <= START_MM
        for track in (UP, DOWN):
            self.crossing = machine.note_heard(self.crossing, track, 0)

    def follow(self) -> dict[Train, Due]:
        dues = dict[Train, Due]()
        for body in self.bodies:
            told = self.ranging(body)
            if not body.has_radio or body.met:
                continue
            if body.followed is None:
                if not arrival.begins_contact(BOUNDS, told) or told.way_mm <= 0:
                    continue
                self.crossing = machine.note_contact(self.crossing, body.name)
                now = arrival.taken(BOUNDS, NOTHING_KNOWN, told)
            else:
                now = arrival.follow(BOUNDS, body.followed, told)
                if self.has_turned_back(BOUNDS, now, told, START_MM):
                    self.found.let_go += 1
                    self.found.let_go_inside += body.way_mm <= START_MM
                    self.over(body)
                    continue
            body.followed = arrival.aged(BOUNDS, now)
            dues[body.name] = machine.due(BOUNDS, now, SETTINGS.reopening_cycles)
        return dues

    def ranging(self, body: Body) -> Ranging:
        """Wrong by less than its bounds, which are taken off; late, or nothing."""
        way_mm = body.way_mm + self.chance.randint(-OFF_MM, OFF_MM) - OFF_MM
        speed_mm_s = body.speed_mm_s + self.chance.randint(-OFF_MM_S, OFF_MM_S) + OFF_MM_S
        body.said = ((self.now_s, way_mm, speed_mm_s), *body.said[:LATEST_S])
        taken_s, way_mm, speed_mm_s = self.chance.choice(body.said)
        is_heard = self.chance.random() > 0.05 and self.now_s not in body.unheard
        return Ranging(is_heard, way_mm, speed_mm_s, self.now_s - taken_s)

    def over(self, body: Body) -> None:
        """It is told gone, or released, and not followed any more."""
        number = machine.number_of(self.crossing, body.name)
        self.crossing = machine.note_gone(self.crossing, body.name, number, True)
        body.followed, body.out_s = None, 0
        self.asked.discard(body.name)

    def look(self) -> None:
        """Rears past the road are told at once, and what has left otherwise by a person; so are empty tracks."""
        for body in self.bodies:
            is_out = not body.is_in_the_approach and (body.met or body.speed_mm_s <= 0)
            body.out_s = body.out_s + 1 if self.asks(body.name) and is_out else 0
            if body.out_s > (0 if body.met else LOOKS_S):
                self.over(body)
        for track in (UP, DOWN):
            empty = not any(body.is_in_the_approach for body in self.bodies if body.track == track)
            closed = track in self.crossing.unaccounted and self.crossing.unaccounted[track]
            self.seen_s[track] = self.seen_s.get(track, 0) + 1 if closed and empty else 0
            if self.seen_s[track] > LOOKS_S:
                self.crossing = machine.note_empty(self.crossing, track, machine.look_of(self.crossing, track))
                self.asked = {name for name in self.asked if self.body(name).track != track or self.asks(name)}

    def asks(self, name: Train) -> bool:
        """Whether the crossing has it that this train has asked for the warning."""
        return name in self.crossing.asks and self.crossing.asks[name]

    # ---- a cycle

    def fail(self) -> None:
        """Without power it begins anew in each cycle, and nobody is followed."""
        self.found.failed_inside += any(body.is_in_the_approach for body in self.bodies)
        self.crossing = restart_crossing(SETTINGS, frozenset((UP, DOWN)), self.crossing.number + 1)
        for body in self.bodies:
            body.followed = None
        self.asked = {name for name in self.asked if self.body(name).is_in_the_approach}

    def body(self, name: Train) -> Body:
        return next(body for body in self.bodies if body.name == name)

    def cycle(self) -> None:
        self.strike()
        dues = self.follow()
        self.look()
        if self.now_s in self.dark:
            self.fail()
            dues = {}
        self.crossing = self.decide(SETTINGS, self.crossing, dues)
        if not self.crossing.warns:
            self.warned_from_ms = -1
            self.found.opened_on += any(self.body(name).is_in_the_approach for name in self.asked)
        elif self.warned_from_ms < 0:
            self.warned_from_ms = self.now_ms
        if not machine.arms_are_to_be_down(SETTINGS, self.crossing):
            self.lowered_from_ms = -1
        elif self.lowered_from_ms < 0:
            self.lowered_from_ms = self.now_ms
        self.asked |= {train for train, asks in self.crossing.asks.items() if asks}
        self.found.open_s += not self.crossing.warns
        self.crossing = machine.aged(self.crossing)
        next_ms = 1_000 * (self.now_s + 1) + self.chance.randint(-JITTER_MS, JITTER_MS)
        self.run(next_ms - self.now_ms)
        self.now_s, self.now_ms = self.now_s + 1, next_ms


def played(
    number: int, decide: Decide = machine.decide, has_turned_back: HasTurnedBack = arrival.has_turned_back
) -> Found:
    day = Day(Random(f"any day {number}"), decide, has_turned_back)
    while day.now_s < WHOLE_S and not all(body.way_mm < -2 * LENGTH_MM for body in day.bodies):
        day.cycle()
    return day.found


def judge(number: int) -> Found:
    found = played(number)
    assert found.warned_ms
    assert min(found.warned_ms) >= SETTINGS.cycle_ms * SETTINGS.warning_cycles
    assert min(found.lowered_ms) >= SETTINGS.cycle_ms * (SETTINGS.lowering_cycles + SETTINGS.least_down_cycles)
    assert found.opened_on == found.let_go_inside == 0
    return found


@pytest.mark.parametrize("number", range(20))
def test_any_day(number: int) -> None:
    judge(number)


def test_power_fails_with_trains_inside_and_trains_are_let_go() -> None:
    days = [played(number) for number in range(20)]
    assert sum(day.failed_inside for day in days) > 20
    assert sum(day.let_go for day in days) > 5
    assert sum(day.open_s for day in days) > 20 * 100
    assert sum(len(day.warned_ms) for day in days) > 40


@pytest.mark.slow
def test_a_thousand_days() -> None:
    for number in range(20, 1_020):
        judge(number)


def opens_after_a_failure(settings: Settings, crossing: Crossing, dues: Map[Train, Due]) -> Crossing:
    """A track that nobody has seen empty asks for no warning."""
    decided = machine.decide(settings, crossing, dues)
    if any(asks for _train, asks in decided.asks.items()):
        return decided
    return replace(decided, warns=False, warned_cycles=0)


def test_who_opens_after_a_failure_is_seen() -> None:
    assert any(
        min(found.warned_ms, default=10**6) < 35_000 or found.opened_on
        for found in (played(number, opens_after_a_failure) for number in range(20))
    )


def wherever_it_is(bounds: ArrivalBounds, followed: Followed, ranging: Ranging, _start_mm: int) -> bool:
    """Whoever runs away is let go."""
    return arrival.has_turned_back(bounds, followed, ranging, -10_000_000)


def test_who_is_let_go_inside_is_seen_and_may_come_unwarned() -> None:
    days = [played(number, has_turned_back=wherever_it_is) for number in range(100)]
    assert any(day.let_go_inside for day in days[:20])
    assert any(min(day.warned_ms, default=10**6) < 35_000 for day in days)


def nobody(_bounds: ArrivalBounds, _followed: Followed, _ranging: Ranging, _start_mm: int) -> bool:
    return False


def test_if_nobody_is_let_go_the_road_is_closed_for_longer() -> None:
    """The radio of who runs away fails, and nobody has come to look."""
    kept, open_s = (
        sum(played(number, has_turned_back=turns).open_s for number in range(20))
        for turns in (nobody, arrival.has_turned_back)
    )
    assert kept < open_s
