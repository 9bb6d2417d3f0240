"""Ten minutes on a busy line: trains that turn, stand, shunt, couple and part, and workers with a handset each.

Units hang, start anew and are off; tunnel, yard and siding are registered.  Nothing here is of the project's models or
proofs: only the kernel's own functions are called.  People do their duty as docs/assumptions.md says it, unless a world
is told that one is neglected.  What is right is judged in metres, by where trains and workers are.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator
from dataclasses import dataclass
from math import pi, sin
from random import Random
from typing import NamedTuple, Self

from kernel.alarm import tone
from kernel.alarm.distance import NO_TRAIN_FIX, Direction, TrainFix, WorkerFix
from kernel.alarm.tone import Register, Tone, Train
from tests.independent.alarm.office import NEW_NUMBERS, REPORTS, Air, Office, Told, Word, take
from tests.independent.alarm.vehicles import (
    CUTTING_M,
    DISPLAY_MS,
    FASTEST_M_S,
    FIX_MS,
    LAG_MS,
    LENGTH_M,
    LINE_M,
    SIDING_M,
    STABLED,
    STATIONS_M,
    TUNNEL_M,
    WORKER_MS,
    YARD_M,
    ZONE_M,
    Body,
    Unit,
    has_sky,
    is_in,
    made_up,
    registered,
    shown_at,
)

LASTS_MS, TRAINS, WORKERS, NEVER_MS, TELLS = 600_000, 5, 2, -(10**9), (0.5, 0.5, 0.2)
CHANGES_ENDS, BEFORE_SHUNTING, AFTER_SHUNTING, RIGHT, CUTTING, ONE_TELLS = (
    "changes ends",
    "has been off the display before it shunts",
    "stands before it is shown again",
    "no receiver creeps within what is shown",
    "no receiver is off in a cutting",
    "one unit tells under a number",
)
"""Duties of drivers, signalmen and surveyors."""
MAKES_UP_M = (*(at_m for at_m in STATIONS_M if has_sky(at_m)), *(12_000,) * 5)
ENDS = ("shunts", "is to be shown", "parts", "couples", "runs")
"""What a driver ends, before he decides anew."""


@dataclass
class Ear:
    """What a handset was told: the last fix of each train that can follow on the one before, the last display, when."""

    fixes: dict[Train, tuple[TrainFix, int]]
    shown: dict[Train, int]


class Worker:
    """A worker with a handset, who walks to and fro; ``elapsed_ms``: since the handset's last cycle."""

    def __init__(self, chance: Random, broken: str) -> None:
        """Begin somewhere, more often near what matters; the handset has just started.

        Unless that is ``broken``, it is told no wrong fix that nothing contradicts.
        """
        is_spared = broken not in (RIGHT, CUTTING)
        anywhere_m = (*TUNNEL_M, *YARD_M, *YARD_M, *YARD_M, *SIDING_M, *STATIONS_M)
        near_m = chance.choice(CUTTING_M if broken == CUTTING else anywhere_m)
        self.chance, self.air, self.is_spared = chance, Air(chance, late=0.02), is_spared
        self.at_m = max(50.0, min(LINE_M - 50, near_m + chance.choice((50, 1_000, 4_000)) * chance.uniform(-1, 1)))
        self.way, self.error_m, self.elapsed_ms = 1.9, 0.0, 0
        self.silent_ms = self.out_ms = self.placed_ms = self.starts = 0
        self.start()

    def start(self) -> None:
        """The handset starts, and knows nothing."""
        self.handset, self.ear, self.placed_ms = tone.switched_on(), Ear({}, {}), NEVER_MS
        self.starts += 1

    def walk(self, elapsed_ms: int, now_ms: int) -> None:
        """Go some way, or stand; lose the network, or the sky, for some time."""
        self.elapsed_ms += elapsed_ms
        if self.chance.random() < 0.02 or not 20 < self.at_m + 2 * self.way < LINE_M - 20:
            self.way = -self.way
        self.at_m += self.way * elapsed_ms / 1_000 * (self.chance.random() < 0.5)
        self.error_m = max(-14.9, min(14.9, self.error_m + self.chance.gauss(0, 1)))
        if self.chance.random() < 0.001:
            self.silent_ms = now_ms + 1_000 * self.chance.randrange(30)
        if self.chance.random() < 0.001:
            self.out_ms = now_ms + 1_000 * self.chance.randrange(30)

    def hear(self, now_ms: int, register: Register) -> None:
        """Take what has come, in any order; what no receiver is assumed to tell, as is said below, is lost."""
        self.handset, self.elapsed_ms = tone.older(self.handset, self.elapsed_ms), 0
        if self.chance.random() < 0.004:
            self.start()
        for word, age_ms in self.air.come(now_ms):
            if not isinstance(word, Told) or self.takes(word, now_ms - age_ms):
                self.handset = take(register, self.handset, word, age_ms)
        for number in [each for each in self.ear.fixes if each not in self.handset.trains]:
            del self.ear.fixes[number]
        self.handset = tone.note_battery(self.handset, is_well=True)
        if now_ms >= self.out_ms and has_sky(self.at_m):
            fix = WorkerFix(round(1_000 * (self.at_m + self.error_m)), 0)
            self.handset, self.placed_ms = tone.note_worker(self.handset, fix), now_ms

    def takes(self, told: Told, sent_ms: int) -> bool:
        """Write down what is told of a train on the list, unless it is a wrong fix that nothing contradicts.

        Such a one is off by less than what is shown, and its train can have been both there and where the last fix was.
        """
        number, fix = told.number, told.fix
        if number not in self.handset.trains:
            self.ear.fixes.pop(number, None)
            return True
        if told.display is not None:
            self.ear.shown[number] = sent_ms
        if fix is None or not 0 <= fix.age_ms <= 3_000_000:
            return True
        made_ms = sent_ms - fix.age_ms
        if number in self.ear.fixes:
            before, before_ms = self.ear.fixes[number]
            if abs(fix.place_mm - before.place_mm) > 27 * abs(made_ms - before_ms) + 40_000:
                return True
        if told.off_m == 0 or abs(told.off_m) > 3_000 or not self.is_spared:
            self.ear.fixes[number] = fix, made_ms
            return True
        return False


class Kind(NamedTuple):
    """What differs from world to world.

    ``turning_ms``: the least time that turning takes.  ``hangs``, ``goes_off``, ``tells``: how often in a step a
    receiver begins to hang, or to be off, and a unit tells.
    """

    turning_ms: int
    hangs: float
    goes_off: float
    tells: float


class Busy:
    """The world; every chance is drawn from one seed.  ``heard``: tone, and the rules that it broke."""

    def __init__(self, seed: int, broken: str = "", kind: Kind | None = None, *, with_cutting: bool = False) -> None:
        """Begin with a stabled train; ``broken``: a duty that is neglected; ``kind``: if it is not to be drawn."""
        self.chance, self.broken, self.now_ms, self.display_out_ms = Random(seed), broken, 0, 0
        choice = self.chance.choice
        drawn = Kind(choice((6_000, 30_000)), choice((0.0003, 0.003)), choice((0.0005, 0.005)), choice(TELLS))
        self.kind = drawn if kind is None else kind
        self.register = registered(self.kind.turning_ms, with_cutting)
        self.office = Office(self.chance, broken, restarts_a_s=0.0012, resends=0.3)
        self.trains: list[Body] = []
        self.workers = [Worker(self.chance, broken) for _ in range(WORKERS)]
        stabled = made_up(self.chance, STABLED, 0, SIDING_M[0] + self.chance.uniform(100, 400))
        stabled.doing, stabled.until_ms = "is stabled", 1_000 * self.chance.randrange(60, 900)
        self.trains.append(stabled)
        self.heard: list[tuple[Tone, frozenset[str]]] = []
        self.counts: Counter[str] = Counter()

    # ---- drivers and the dispatcher

    def dispatch(self) -> None:
        """Let trains on, change numbers, part trains, confirm the list, and have drivers decide."""
        for train in self.trains:
            if not train.is_there and self.office.may(self.now_ms, train.number):
                train.is_there = True
            if train.is_there and train.next_number is None and self.chance.random() < 0.0005:
                self.reserve(train, for_part=False)
            if train.next_number is not None and train.doing != "parts" and self.has_let(train):
                self.office.give_up(self.now_ms, train.number)
                train.number, train.next_number = train.next_number, None
                self.counts["renumbered"] += 1
        is_new = self.chance.random() < (
            0.9 if self.broken == NEW_NUMBERS and self.office.just_gone(self.now_ms) else 0.02
        )
        if is_new and len(self.trains) < TRAINS:
            self.make_up()
        for train in list(self.trains):
            if train in self.trains and train.is_there and self.now_ms >= train.until_ms:
                self.decide(train)
        used = [each for train in self.trains for each in (train.number, train.next_number) if each is not None]
        self.office.confirm(self.now_ms, used)

    def reserve(self, train: Body, *, for_part: bool) -> None:
        """Have a number entered that a train, or the part that leaves it, is to take."""
        if train.doing not in ("couples", "is coupled", "parts", "is stabled"):
            train.next_number = self.office.new_number(self.now_ms)
            if for_part:
                train.doing, train.until_ms = "parts", self.now_ms + 1_000

    def has_let(self, train: Body) -> bool:
        """Tell whether the number that a train, or its part, is to take may be used."""
        return train.next_number is not None and self.office.may(self.now_ms, train.next_number)

    def make_up(self) -> None:
        """A train is made up at a station, or behind one that stands; the dispatcher enters it before it is there."""
        track, at_m = self.chance.randrange(2), self.chance.choice(MAKES_UP_M) + self.chance.uniform(-250, 100)
        body = made_up(self.chance, Train(""), track, at_m)
        standing = [each for each in self.trains if each.doing == "stands" and len(each.cars) == 1]
        if standing and self.chance.random() < 0.6:
            other = self.chance.choice(standing)
            body.cars, body.leader, body.track, body.way = body.cars[:1], 0, other.track, self.chance.choice((-1, 1))
            away_m = self.chance.uniform(60, 300)
            body.low_m = other.high_m() + away_m if body.way < 0 else other.low_m - away_m - body.cars[0].length_m
        if body.low_m >= 0 and body.high_m() <= LINE_M and not any(self.is_over(body, each) for each in self.trains):
            body.number = self.office.new_number(self.now_ms)
            self.trains.append(body)
            for other in standing:
                other.until_ms += 12_000 * (other.track == body.track)

    @staticmethod
    def is_over(one: Body, other: Body) -> bool:
        """Tell whether two trains would stand on the same piece of track."""
        return one.track == other.track and one.low_m < other.high_m() and other.low_m < one.high_m()

    def ahead(self, train: Body, within_m: float) -> Body | None:
        """Give a train ahead on its track, if one is that near."""
        others = [each for each in self.trains if each is not train and each.track == train.track and each.is_there]
        return next((each for each in others if -1 <= train.ahead_m(each) <= within_m), None)

    def decide(self, train: Body) -> None:
        """A driver has done what he did, and does something else."""
        wait_ms, ahead = 1_000 * self.chance.randrange(5, 40), self.ahead(train, 320)
        what = self.chance.random()
        if train.doing in ENDS:
            self.end(train)
        elif train.doing == "turns":
            self.turn(train)
        elif len(train.cars) == 2 and what < 0.3 and train.next_number is None and train.doing == "stands":
            self.reserve(train, for_part=True)
        elif ahead is not None and self.may_couple(train, ahead) and what < 0.9:
            train.doing, train.beyond, train.until_ms = "couples", ahead, self.now_ms + 200_000
            ahead.doing, ahead.until_ms = "is coupled", self.now_ms + 10**9
        elif is_in(YARD_M, train.low_m - 20, train.high_m() + 20) and what < 0.75:
            train.doing, train.off_ms, train.until_ms = "shunts", self.now_ms, self.now_ms + DISPLAY_MS + 2 * wait_ms
            self.counts["shunted"] += 1
        elif what > 0.97 and train.next_number is None and train.number != STABLED:
            self.trains.remove(train)
            self.office.give_up(self.now_ms, train.number)
        elif what > 0.6 or ahead is not None or not 0 <= train.low_m + train.way * 200 <= LINE_M:
            self.turn(train)
        else:
            self.start(train, train.way)

    def may_couple(self, train: Body, other: Body) -> bool:
        """Tell whether two trains can become one."""
        together_m = sum(car.length_m for car in train.cars + other.cars)
        are_free = (
            train.next_number is None and other.next_number is None and STABLED not in (train.number, other.number)
        )
        return are_free and train.doing == other.doing == "stands" and together_m <= LENGTH_M

    def turn(self, train: Body) -> None:
        """Change ends, which takes as long as is written, or more; or run back at once, where that is neglected."""
        if self.broken == CHANGES_ENDS or self.now_ms - train.ran_ms >= self.kind.turning_ms:
            self.counts["turned"] += 1
            self.start(train, -train.way)
        else:
            train.doing, train.until_ms = "turns", max(self.now_ms, train.ran_ms + self.kind.turning_ms)

    def start(self, train: Body, way: int) -> None:
        """Run one way for some time."""
        train.doing, train.way, train.speed_m_s = "runs", way, self.chance.uniform(8, FASTEST_M_S)
        train.until_ms = self.now_ms + 1_000 * self.chance.randrange(5, 200)

    def stand(self, train: Body, for_ms: int) -> None:
        """Stop, and stand for some time."""
        train.doing, train.speed_m_s, train.until_ms = "stands", 0.0, self.now_ms + for_ms

    def end(self, train: Body) -> None:
        """End a run, a coupling that failed, shunting, or part."""
        if train.doing == "parts":
            if self.has_let(train):
                self.part(train)
            return
        if train.doing == "shunts" and self.broken != AFTER_SHUNTING:
            train.doing, train.speed_m_s, train.until_ms = "is to be shown", 0.0, self.now_ms + FIX_MS + 1_000
            return
        if train.off_ms >= 0:
            train.off_ms, train.ran_ms = -1, NEVER_MS if train.doing == "is to be shown" else train.ran_ms
        if train.beyond is not None:
            self.stand(train.beyond, 10_000)
            train.beyond = None
        self.stand(train, self.chance.choice((0, 1_000 * self.chance.randrange(60))))

    def part(self, train: Body) -> None:
        """The car that does not lead goes on under the new number; one of both runs away from the other."""
        assert train.next_number is not None
        other = 1 - train.leader
        lows_m = (train.low_m, train.low_m + train.cars[0].length_m)
        part = Body(train.next_number, train.track, lows_m[other], [train.cars[other]], is_there=True)
        train.low_m, train.cars, train.leader, train.next_number = lows_m[1 - other], [train.cars[1 - other]], 0, None
        part.was_m = []
        self.stand(train, 1_000 * self.chance.randrange(40))
        self.stand(part, 1_000 * self.chance.randrange(40))
        if self.chance.random() < 0.7:
            self.start(part, 1 if other else -1)
        self.trains.append(part)
        self.counts["parted"] += 1

    # ---- on the track

    def run(self, elapsed_ms: int) -> None:
        """Time passes on the track."""
        for train in self.trains:
            speed_m_s = self.speed_m_s(train)
            self.counts["stood between stations"] += not speed_m_s and not any(
                abs(train.low_m - at_m) < 400 for at_m in STATIONS_M
            )
            train.moved = speed_m_s > 0
            train.low_m += train.way * speed_m_s * elapsed_ms / 1_000
            train.ran_ms = self.now_ms + elapsed_ms if train.moved else train.ran_ms
        for train in [each for each in self.trains if each.beyond is not None]:
            other = train.beyond
            if other is not None and train.ahead_m(other) < 4:
                self.couple(train, other)

    def speed_m_s(self, train: Body) -> float:
        """Give how fast a train runs now, and have it stop before another one and the line's end."""
        if train.doing == "shunts":
            return self.shunting_m_s(train)
        if train.doing == "couples":
            return 2.5
        if train.doing != "runs":
            return 0.0
        at_end = not 45 <= train.low_m + train.way * 45 <= LINE_M - LENGTH_M - 45
        leaves = train.low_m + train.way * 60 < 0 or train.high_m() + train.way * 60 > LINE_M
        if (at_end and leaves) or self.ahead(train, 150) is not None:
            self.stand(train, 1_000 * self.chance.randrange(5, 40))
            return 0.0
        return train.speed_m_s * (self.chance.random() < 0.98)

    def shunting_m_s(self, train: Body) -> float:
        """Run to and fro in the yard, and turn at any moment, once the display has not shown the train for so long."""
        if self.broken != BEFORE_SHUNTING and self.now_ms <= train.off_ms + DISPLAY_MS:
            return 0.0
        way = -train.way if self.chance.random() < 0.15 else train.way
        for each in (way, -way):
            if is_in(YARD_M, train.low_m + 20 * each, train.high_m() + 20 * each):
                train.way = each
                return 7.0 * (self.ahead(train, 20) is None)
        return 0.0

    def couple(self, train: Body, other: Body) -> None:
        """Two trains become one, under the number of either; the other number is given up, and its unit is off."""
        below, above = (train, other) if train.way > 0 else (other, train)
        stays, goes = self.chance.choice(((train, other), (other, train)))
        stays.leader = stays.leader if stays is below else len(below.cars) + stays.leader
        at_m, place = stays.low_m, stays is below
        stays.cars = below.cars + above.cars
        stays.low_m = at_m if place else at_m - sum(car.length_m for car in below.cars)
        train.beyond = None
        self.trains.remove(goes)
        self.office.give_up(self.now_ms, goes.number)
        self.stand(stays, 1_000 * self.chance.randrange(5, 40))
        self.counts["coupled"] += 1

    # ---- what is told

    def tell(self, elapsed_ms: int) -> list[Told]:
        """Receivers, units and the display tell of trains; give what is sent."""
        words: list[Told] = []
        if self.chance.random() < 0.0015:
            self.display_out_ms = self.now_ms + 1_000 * self.chance.randrange(60)
        for train in [each for each in self.trains if each.is_there]:
            antenna_m = train.antenna_m()
            train.was_m = [each for each in train.was_m if self.now_ms - each[0] <= LAG_MS] + [(self.now_ms, antenna_m)]
            for number, car in enumerate(train.cars):
                unit, at_m = car.unit, train.place_m(number)
                unit.fail(
                    self.now_ms,
                    min(LINE_M - 1, max(1.0, at_m)),
                    self.kind.hangs,
                    self.kind.goes_off,
                    self.broken == RIGHT,
                )
                self.shade(unit, at_m)
                unit.receive(elapsed_ms, self.now_ms, at_m, train.way, train.moved)
                tells = number == train.leader or self.broken == ONE_TELLS
                if (
                    tells
                    and train.doing != "is stabled"
                    and self.now_ms >= unit.silent_ms
                    and self.chance.random() < 0.5
                ):
                    words.append(Told(train.number, unit.held, None, unit.held_off_m))
            is_shown = train.off_ms < 0 and self.now_ms >= self.display_out_ms
            if is_shown and self.chance.random() < 0.4:
                words.append(Told(train.number, None, shown_at(self.chance.choice(train.was_m)[1])))
        return words

    def shade(self, unit: Unit, at_m: float) -> None:
        """In a cutting a receiver takes reflections for the sky, in worlds that have one."""
        if self.broken == CUTTING and CUTTING_M[0] < at_m < CUTTING_M[1]:
            unit.off_m = 350 * sin(pi * (at_m - CUTTING_M[0]) / (CUTTING_M[1] - CUTTING_M[0]))
            unit.off_ms = self.now_ms + 1_000

    # ---- what is heard

    def step(self) -> None:
        """Let some time pass, and listen."""
        elapsed_ms = self.chance.choice((1_000, self.chance.randrange(600, 1_401)))
        self.dispatch()
        self.run(elapsed_ms)
        self.now_ms += elapsed_ms
        words = self.tell(elapsed_ms)
        telling = list(dict.fromkeys(told.number for told in words))
        reported = [train.number for train in self.trains] if self.broken == REPORTS else []
        sent: list[Word] = [*self.office.serve(self.now_ms, telling, reported), *words]
        for worker in self.workers:
            worker.walk(elapsed_ms, self.now_ms)
            for word in sent if self.now_ms >= worker.silent_ms else []:
                worker.air.send(self.now_ms, word)
            if self.chance.random() < 0.85:
                worker.hear(self.now_ms, self.register)
                sounds = tone.tone(self.register, worker.handset)
                self.heard.append((sounds, frozenset(self.broken_rules(worker, sounds))))

    def broken_rules(self, worker: Worker, sounds: Tone) -> Iterator[str]:
        """Give which rules a tone breaks, by where trains and the worker are and by what was told."""
        there = [train for train in self.trains if train.is_there]
        coming = [each for each in there if not each.departs(worker.at_m, self.now_ms, self.kind.turning_ms)]
        near_m = min((train.gap_m(worker.at_m) for train in coming), default=LINE_M)
        if sounds == Tone.NORMAL and near_m <= 3_000:
            yield "3000 m"
        if sounds == Tone.CAUTION and near_m <= 1_500:
            yield "1500 m"
        if sounds != Tone.ALARM and any(self.comes_out(train, worker) for train in there):
            yield "outer end"
        if sounds in (Tone.NORMAL, Tone.CAUTION):
            if not all(self.is_known(train.number, worker) for train in there):
                yield "unknown"
            if self.now_ms - worker.placed_ms > WORKER_MS:
                yield "no place"
            if any(is_in(section, worker.at_m, worker.at_m) for section in (TUNNEL_M, YARD_M, SIDING_M)):
                yield "no use"

    def is_known(self, number: Train, worker: Worker) -> bool:
        """Tell whether a handset has a train on its list, and was told of it lately, by one source at the least."""
        _fix, made_ms = worker.ear.fixes.get(number, (None, NEVER_MS))
        is_told = self.now_ms - made_ms <= FIX_MS or self.now_ms - worker.ear.shown.get(number, NEVER_MS) <= DISPLAY_MS
        return number in worker.handset.trains and is_told

    def comes_out(self, train: Body, worker: Worker) -> bool:
        """Tell whether a train was lost on its way through the tunnel, and the worker is just beyond its outer end."""
        fix, made_ms = worker.ear.fixes.get(train.number, (NO_TRAIN_FIX, NEVER_MS))
        is_lost = FIX_MS < self.now_ms - made_ms <= 3_500_000
        is_shown = self.now_ms - worker.ear.shown.get(train.number, NEVER_MS) <= DISPLAY_MS
        if not is_lost or not is_shown or worker.placed_ms < 0 or train.number not in worker.handset.trains:
            return False
        low_m, high_m, at_m = *TUNNEL_M, fix.place_mm / 1_000
        if fix.is_running and fix.direction == Direction.DOWN:
            return low_m <= at_m <= high_m - ZONE_M and 0 <= worker.at_m - high_m <= 1_450
        if fix.is_running and fix.direction == Direction.UP:
            return low_m + ZONE_M <= at_m <= high_m and 0 <= low_m - worker.at_m <= 1_450
        return False

    def pass_time(self) -> Self:
        """Let all the time pass."""
        while self.now_ms < LASTS_MS:
            self.step()
        units = [car.unit for train in self.trains for car in train.cars]
        self.counts["seconds that a receiver hung under way"] += sum(unit.frozen for unit in units)
        self.counts["seconds that a receiver was off"] += sum(unit.jumped for unit in units)
        self.counts["units started"] += sum(unit.starts for unit in units)
        self.counts["handsets started"] += sum(worker.starts - 1 for worker in self.workers)
        self.counts["servers started"] += self.office.restarts
        return self

    def breaches(self) -> int:
        """Give in how many decisions a tone broke a rule."""
        return sum(bool(rules) for _tone, rules in self.heard)
