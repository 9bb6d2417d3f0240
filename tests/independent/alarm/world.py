"""Half an hour on a line, second by second: trains, a dispatcher, the server, a network that loses, a worker.

Nothing here is of the project's models or proofs: only the kernel's own functions are called.
"""

from __future__ import annotations

from dataclasses import dataclass
from random import Random

from kernel.alarm import tone
from kernel.alarm.distance import AlarmBounds, Direction, TrainFix, WorkerFix
from kernel.alarm.tone import Display, Freshness, Register, Tone, Train
from tests.independent.alarm.office import (
    CONFIRMS,
    CUTS_OFF,
    ENTERS,
    FRESH_MS,
    REPORTS,
    Air,
    Office,
    Told,
    take,
)

LINE_M, FASTEST_M_S, LENGTH_M, SECONDS = 20_000, 25, 100, 1_500
STRETCH_M = 4_000
BOUNDS = AlarmBounds(1_000 * FASTEST_M_S, 0, 1_000 * LENGTH_M, 1_000, 1_000, 30_000)
REGISTER = Register(
    BOUNDS,
    Freshness(fix_ms=10_000, display_ms=12_000, server_ms=FRESH_MS, worker_ms=5_000),
    display_error_mm=100_000,
    tolerance_mm=100_000,
    sections={},
    stabled=frozenset(),
    ways={},
    openings={},
    edition=1,
)
DUTIES = (ENTERS, CONFIRMS, REPORTS, CUTS_OFF)


@dataclass
class Running:
    """A train: its number, where its antenna is, which way it runs and how fast, and whether it is on the line yet."""

    number: Train
    at_m: float
    way: int
    speed_m_s: float
    is_there: bool = False
    next_number: Train | None = None


class Line:
    """The world; every chance is drawn from one seed."""

    def __init__(self, seed: int, broken: str = "") -> None:
        """Begin with an empty line; ``broken``: a duty that the dispatcher neglects."""
        self.chance, self.broken, self.second = Random(seed), broken, 0
        self.office = Office(self.chance, broken, restarts_a_s=0.004, resends=0.5)
        self.air = Air(self.chance, late=0.17)
        self.trains: list[Running] = []
        self.worker_m = self.chance.uniform(2_000, LINE_M - 2_000)
        self.handset = tone.switched_on()
        self.heard: list[tuple[Tone, float, bool]] = []
        self.renumbered = 0

    def dispatch(self) -> None:
        """Let trains on, change their numbers, and confirm the list."""
        now_ms = 1_000 * self.second
        for train in self.trains:
            train.is_there = train.is_there or self.office.may(now_ms, train.number)
            if train.next_number is not None and self.office.may(now_ms, train.next_number):
                self.office.give_up(now_ms, train.number)
                train.number, train.next_number = train.next_number, None
                self.renumbered += 1
            elif train.is_there and train.next_number is None and self.chance.random() < 0.001:
                train.next_number = self.office.new_number(now_ms)
        if self.chance.random() < 0.006 and len(self.trains) < 4:
            way, speed = self.chance.choice((-1, 1)), self.chance.uniform(8, FASTEST_M_S)
            self.trains.append(Running(self.office.new_number(now_ms), 0.0 if way > 0 else LINE_M, way, speed))
        numbers = [each for train in self.trains for each in (train.number, train.next_number) if each is not None]
        self.office.confirm(now_ms, numbers)

    def run(self) -> None:
        """A second passes on the track; who has come to the end has left, and its unit is off."""
        for train in self.trains:
            if train.is_there:
                train.at_m += train.way * train.speed_m_s * (self.chance.random() < 0.97)
        for train in [each for each in self.trains if not 0 <= each.at_m <= LINE_M]:
            self.trains.remove(train)
            for number in (train.number, train.next_number):
                if number is not None:
                    self.office.give_up(1_000 * self.second, number)

    def receive(self) -> None:
        """The handset takes what has come, in any order, and its own place."""
        self.handset = tone.older(self.handset, 1_000)
        if self.chance.random() < 0.001 and self.broken != CUTS_OFF:
            self.handset = tone.switched_on()
        for word, age_ms in self.air.come(1_000 * self.second):
            self.handset = take(REGISTER, self.handset, word, age_ms)
        worker_mm = round(1_000 * self.worker_m)
        self.handset = tone.note_worker(tone.note_battery(self.handset, is_well=True), WorkerFix(worker_mm, 0))

    def told(self, train: Running) -> Told:
        """Both sources tell of a train."""
        place_mm = round(1_000 * train.at_m)
        from_mm = place_mm // (1_000 * STRETCH_M) * 1_000 * STRETCH_M
        direction = Direction.DOWN if train.way > 0 else Direction.UP
        fix = TrainFix(place_mm, 0, direction, is_running=train.speed_m_s > 0)
        return Told(train.number, fix, Display(from_mm, from_mm + 1_000 * STRETCH_M, 0))

    def nearest_m(self) -> float:
        """Give how near the nearest train is that has not passed the worker by 100 m, with all of it."""
        gaps = [9.0 * LINE_M]
        for train in self.trains:
            gap_m = max(0.0, abs(train.at_m - self.worker_m) - LENGTH_M)
            goes_away = (train.at_m > self.worker_m) == (train.way > 0)
            if train.is_there and not (goes_away and gap_m >= 100):
                gaps.append(abs(train.at_m - self.worker_m))
        return min(gaps)

    def step(self) -> None:
        """Let a second pass, and listen."""
        self.second += 1
        self.dispatch()
        self.run()
        numbers = [train.number for train in self.trains]
        wrong = [each for each in numbers if self.broken == REPORTS or self.chance.random() < 0.002]
        for word in self.office.serve(1_000 * self.second, numbers, wrong):
            self.air.send(1_000 * self.second, word)
        for train in self.trains:
            self.air.send(1_000 * self.second, self.told(train))
        self.receive()
        knows_all = all(train.number in self.handset.trains for train in self.trains if train.is_there)
        self.heard.append((tone.tone(REGISTER, self.handset), self.nearest_m(), knows_all))

    def breaches(self) -> int:
        """Let the time pass, and count the seconds in which a mild tone was wrong."""
        for _ in range(SECONDS):
            self.step()
        limits = {Tone.NORMAL: 3_000, Tone.CAUTION: 1_500}
        return sum(sounds in limits and (near <= limits[sounds] or not knows) for sounds, near, knows in self.heard)
