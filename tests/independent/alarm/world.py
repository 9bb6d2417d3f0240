"""Half an hour on a line, second by second: trains, a dispatcher, the server, a network that loses, a worker.

Nothing here is of the project's models or proofs: only the kernel's own functions are called.  The dispatcher does his
duty as docs/assumptions.md says it, unless a world is told to break one.
"""

from __future__ import annotations

from dataclasses import dataclass
from random import Random

from kernel.alarm import tone, train_list
from kernel.alarm.distance import AlarmBounds, Direction, TrainFix, WorkerFix
from kernel.alarm.tone import Display, Freshness, Register, Tone, Train
from kernel.alarm.train_list import Entry, Server, Summary

LINE_M, FASTEST_M_S, LENGTH_M, SECONDS = 20_000, 25, 100, 1_500
FRESH_S, QUIET_S, STRETCH_M = 8, 6, 4_000
BOUNDS = AlarmBounds(1_000 * FASTEST_M_S, 0, 1_000 * LENGTH_M, 1_000, 1_000, 30_000)
REGISTER = Register(
    BOUNDS,
    Freshness(fix_ms=10_000, display_ms=12_000, server_ms=1_000 * FRESH_S, worker_ms=5_000),
    display_error_mm=100_000,
    tolerance_mm=100_000,
    sections={},
    stabled=frozenset(),
    openings={},
)
DUTIES = ("enters first", "confirms when all are entered", "reports who has left", "cuts off the server before")


@dataclass
class Running:
    """A train: its number, where its antenna is, which way it runs and how fast, and whether it is on the line yet.

    ``told_s``: when either source told the server of it last.
    """

    number: Train
    at_m: float
    way: int
    speed_m_s: float
    entered_s: int
    is_there: bool = False
    next_number: Train | None = None
    next_entered_s: int = 0
    told_s: int = 0


@dataclass
class Sent:
    """Something on its way to the handset; it was made at ``made_s`` and arrives at ``at_s``."""

    at_s: int
    made_s: int
    what: Entry | Summary | tuple[Train, float, int, float]


class Line:
    """The world; every chance is drawn from one seed."""

    def __init__(self, seed: int, broken: str = "") -> None:
        """Begin with an empty line; ``broken``: a duty that the dispatcher neglects."""
        self.chance, self.broken, self.second = Random(seed), broken, 0
        self.trains: list[Running] = []
        self.gone: dict[Train, int] = {}
        self.numbers = 0
        self.server: Server | None = train_list.confirm(train_list.started(0), 0)
        self.run_on: list[Server] = []
        self.comes_up_s, self.confirms_s, self.confirmation_ms = 0, 0, -1
        self.air: list[Sent] = []
        self.worker_m = self.chance.uniform(2_000, LINE_M - 2_000)
        self.handset = tone.switched_on()
        self.heard: list[tuple[Tone, float, bool]] = []
        self.restarts = self.renumbered = 0

    # ---- people

    def new_number(self) -> Train:
        """Give a number that no train has had."""
        self.numbers += 1
        return Train(f"{self.numbers}")

    def enter(self, number: Train) -> int:
        """Enter a number, if the server shows it; give when, or a time that never comes."""
        if self.server is None:
            return 10**9
        self.server = train_list.enter(self.server, number)
        return self.second

    def may(self, entered_s: int) -> bool:
        """Tell whether a train may run under a number that was entered then."""
        return self.broken == "enters first" or self.second > entered_s + FRESH_S

    def dispatch(self) -> None:
        """Let trains on, change their numbers, and confirm the list."""
        for train in self.trains:
            if not train.is_there and train.entered_s > self.second and self.server is not None:
                train.entered_s = self.enter(train.number)
            train.is_there = train.is_there or self.may(train.entered_s)
            if train.next_number is not None and self.may(train.next_entered_s):
                self.gone[train.number] = self.second
                train.number, train.next_number = train.next_number, None
                self.renumbered += 1
            elif train.is_there and train.next_number is None and self.chance.random() < 0.001:
                train.next_number = self.new_number()
                train.next_entered_s = self.enter(train.next_number)
        if self.chance.random() < 0.006 and len(self.trains) < 4:
            way, number = self.chance.choice((-1, 1)), self.new_number()
            entered_s = -(10**9) if self.broken == "enters first" else self.enter(number)
            speed = self.chance.uniform(8, FASTEST_M_S)
            self.trains.append(Running(number, 0.0 if way > 0 else LINE_M, way, speed, entered_s))
        if self.server is not None and self.second == self.confirms_s:
            if self.broken != "confirms when all are entered":
                for train in self.trains:
                    self.enter(train.number)
                    if train.next_number is not None:
                        train.next_entered_s = min(train.next_entered_s, self.enter(train.next_number))
            self.confirmation_ms = self.server.life_ms
        if self.server is not None and self.confirmation_ms >= 0 and self.chance.random() < 0.3:
            self.server = train_list.confirm(self.server, self.confirmation_ms)

    # ---- trains and the server

    def run(self) -> None:
        """A second passes on the track; who has come to the end has left, and its unit is off."""
        for train in self.trains:
            if train.is_there:
                train.at_m += train.way * train.speed_m_s * (self.chance.random() < 0.97)
        for train in [each for each in self.trains if not 0 <= each.at_m <= LINE_M]:
            self.trains.remove(train)
            for number in (train.number, train.next_number):
                if number is not None:
                    self.gone[number] = self.second

    def serve(self) -> None:
        """The server hears of trains, takes off who is accounted for, sends, and restarts at any moment."""
        for other in self.run_on:
            self.send(train_list.summary(other))
        if self.server is None:
            if self.second < self.comes_up_s:
                return
            self.server = train_list.started(1_000 * self.second)
            self.confirms_s = self.second + self.chance.choice((1, 2, self.chance.randrange(1, 60)))
        self.server = train_list.older_server(self.server, 1_000)
        for train in self.trains:
            if self.chance.random() < 0.3 or self.second >= train.told_s + QUIET_S - 1:
                self.server, train.told_s = train_list.enter(self.server, train.number), self.second
        wrong = self.broken == "reports who has left"
        reported = {train.number for train in self.trains if wrong or self.chance.random() < 0.002} | set(self.gone)
        for number in [each for each in self.server.trains if each in reported]:
            if self.server.trains[number].left_ms > 3_600_000:
                self.server = train_list.note_left(self.server, number)
        for number in list(self.server.trains):
            self.server = train_list.strike_off(self.server, number)
        self.send(train_list.summary(self.server))
        for written in range(1, self.server.count + 1):
            if self.chance.random() < 0.5:
                self.send(self.server.entries[written])
        if self.chance.random() < 0.004:
            self.run_on += [self.server] if self.broken == "cuts off the server before" else []
            self.server, self.comes_up_s = None, self.second + self.chance.randrange(30)
            self.restarts += 1

    # ---- the network, and the handset

    def send(self, what: Entry | Summary | tuple[Train, float, int, float]) -> None:
        """Send something: it is lost, late, or comes twice, as it happens."""
        for _ in range(self.chance.choice((0, 1, 1, 1, 2))):
            late_s = self.chance.choice((0, 0, 0, 1, 2, self.chance.randrange(20)))
            self.air.append(Sent(self.second + late_s, self.second, what))

    def receive(self) -> None:
        """The handset takes what has come, in any order, and its own place."""
        come = [each for each in self.air if each.at_s <= self.second]
        self.air = [each for each in self.air if each.at_s > self.second]
        self.chance.shuffle(come)
        self.handset = tone.older(self.handset, 1_000)
        if self.chance.random() < 0.001 and self.broken != "cuts off the server before":
            self.handset = tone.switched_on()
        for each in come:
            age_ms = 1_000 * (self.second - each.made_s)
            if isinstance(each.what, Entry):
                self.handset = train_list.note_entry(self.handset, each.what)
            elif isinstance(each.what, Summary):
                said = Summary(each.what.life_ms, each.what.count, each.what.is_whole, age_ms)
                self.handset = train_list.note_summary(self.handset, said, servers_well=True)
            else:
                self.told(*each.what, age_ms)
        worker_mm = round(1_000 * self.worker_m)
        self.handset = tone.note_worker(tone.note_battery(self.handset, is_well=True), WorkerFix(worker_mm, 0))

    def told(self, number: Train, at_m: float, way: int, speed_m_s: float, age_ms: int) -> None:
        """Both sources tell of a train."""
        place_mm = round(1_000 * at_m)
        from_mm = place_mm // (1_000 * STRETCH_M) * 1_000 * STRETCH_M
        direction = Direction.DOWN if way > 0 else Direction.UP
        fix = TrainFix(place_mm, age_ms, direction, is_running=speed_m_s > 0)
        display = Display(from_mm, from_mm + 1_000 * STRETCH_M, age_ms)
        self.handset = tone.note_fix(BOUNDS, self.handset, number, fix)
        self.handset = tone.note_display(self.handset, number, display)

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
        self.serve()
        for train in self.trains:
            self.send((train.number, train.at_m, train.way, train.speed_m_s))
        self.receive()
        knows_all = all(train.number in self.handset.trains for train in self.trains if train.is_there)
        self.heard.append((tone.tone(REGISTER, self.handset), self.nearest_m(), knows_all))

    def breaches(self) -> int:
        """Let the time pass, and count the seconds in which a mild tone was wrong."""
        for _ in range(SECONDS):
            self.step()
        limits = {Tone.NORMAL: 3_000, Tone.CAUTION: 1_500}
        return sum(sounds in limits and (near <= limits[sounds] or not knows) for sounds, near, knows in self.heard)
