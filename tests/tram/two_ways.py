"""Trams of two lines on both ways of a street: a world of its own, in seconds, at random (G1 to G6).

Nothing of models or proofs is in it but the kernel's public functions.  Trams run from terminus to terminus, turn,
bunch and queue; those of the other line turn off at a junction and come back there; destinations are wrong.  Where a
tram is its unit finds by fixes that err on a street that bends, and tells when the station asks.  Reports and orders
come late, again or never, what is told on one way is word from elsewhere on the other, and the centre starts anew.
Some orders are written by a clock that is ahead, and now and then the centre is asked to take up a tram that is on the
way.  What ``ORDINARY`` names is drawn apart, so that a world without it is otherwise the same.
"""

from __future__ import annotations

from collections import Counter
from dataclasses import dataclass, field
from random import Random
from typing import Any

from kernel.tram import centre as dispatcher
from kernel.tram import cycle
from kernel.tram import display as on_board
from kernel.tram.centre import Centre, Command, Tram
from kernel.tram.cycle import Answer, CycleLimits, Heard
from kernel.tram.dispatching import DispatchLimits, Hand, Report, mark
from kernel.tram.map_matching import Point
from tests.tram.street import (
    APART_MM,
    FAST_MM_S,
    FASTEST_MM_S,
    FIX_ERROR_MM,
    MATCH,
    NEAR,
    Table,
    Unit,
    drawn_street,
    fix_at,
    note,
    stop_mm,
    unit_begun,
)

LAST, JUNCTION = 9, 6
LIMITS = DispatchLimits(60_000, 400_000, 90_000, 100_000, 11_000, 18_000, 120_000)
CYCLE = CycleLimits(request_ms=800, slot_ms=800, answer_ms=300)
JOINS = LAST - JUNCTION
EACH_S, FIX_S = 7, 3
SIGNAL_MM = 44_000
FAR_AWAY = Point(-(10**9), -(10**9))
APPROACH_MM = 60_000
"""So far before a stop a tram waits, and from there comes to it: nearer its unit may tell that it stands there."""

ORDINARY = ("units", "centres", "numbers", "bunching", "jitter", "ways", "early", "kept", "signals")
"""Units start anew under way; the centre of each way does, several times; another car runs under the number of one that
was taken off; doors jam, and trams bunch; cycles and answers come early and late, and another tram answers; drivers set
the way in the other direction where a unit starts, until they notice, and leave what is set when they turn, as it was
or as it is to be; a tram is confirmed for the way back while it is on this one, and its driver sets that at once; one
turns off, is taken off by a person and comes back to the same way, and nobody sets its unit anew; at road signals just
beyond a stop trams wait, and queue behind one another."""
BEYOND = ("runs_along", "fixes_beyond", "taken_off_on_the_way", "begins_ahead")
"""Each breaks an assumption: ``test_an_assumption_that_is_broken_matters`` says which, and that it matters."""


@dataclass
class Car:
    """A tram: on which way and where, or off both; its unit; and what it means to do.

    ``at``: its mark, since ``since_s``; ``until_s``: until then it stays at it.  ``place_mm``: along its way; it stands
    ``offset_mm`` beyond its stop.  ``comes_at``: where it wants to come, from ``due_s`` on.  ``asked_s``: when the
    station asks it; ``heard``: what that has, of ``made_s``.  ``noticed_s``: when its driver notices a wrong setting.
    ``is_kept``: its unit still tells of the run before.  ``signal_s``: until then it waits at a signal beyond its stop.
    """

    name: Tram
    way: int = -1
    at: int = 0
    since_s: int = 0
    until_s: int = 0
    place_mm: int = 0
    offset_mm: int = 0
    is_slow: bool = False
    leaves_at: int = LAST
    comes_at: int = 0
    onto: int = 0
    due_s: int = 0
    confirmed_s: int = -(10**6)
    asked_s: int = 0
    made_s: int = 0
    noticed_s: int = 0
    is_kept: bool = False
    signal_s: int = 0
    heard: Heard = field(default_factory=lambda: cycle.nothing_heard(0))
    unit: Unit = field(default_factory=Unit)

    @property
    def stands(self) -> bool:
        return self.at % 2 == 0


@dataclass
class World:
    """Two ways, each a centre's view and the trams on it, the first one in front.

    ``apart`` draws clocks that are ahead, whom the centre is asked for anew, the street and its fixes, and ``days``:
    the rest is drawn as without.  ``settings`` draws what drivers set wrong, ``early`` who is confirmed too soon,
    ``back`` who comes back to the way that he has left, ``signals`` which are red.
    ``restarts``: when the centre of which way starts anew.  ``happened`` and ``broken`` count what came about, and what
    must not.
    """

    chance: Random
    apart: Random
    settings: Random
    early: Random
    back: Random
    signals: Random
    days: frozenset[str] = frozenset()
    lost: float = 0.1
    late_s: int = 300
    now_s: int = 1_000
    restarts: set[tuple[int, int]] = field(default_factory=set)
    centres: list[Centre] = field(default_factory=list)
    lines: list[list[Car]] = field(default_factory=lambda: [[], []])
    cars: list[Car] = field(default_factory=list)
    reports: list[tuple[int, int, Tram, Report]] = field(default_factory=list)
    words: list[tuple[int, int, Tram, bool, int]] = field(default_factory=list)
    orders: list[tuple[int, int, Command]] = field(default_factory=list)
    happened: Counter[str] = field(default_factory=Counter)
    broken: Counter[str] = field(default_factory=Counter)
    tables: tuple[Table, Table] = ((), ())

    def __post_init__(self) -> None:
        self.tables = drawn_street(self.apart)
        self.centres = [Centre(0, 0, 0, {}, {}, frozenset(), {})] * 2
        for way in range(2):
            self.restart(way)
        self.cars = [self.car(number, 1_000 + 150 * number) for number in range(self.chance.randrange(4, 9))]

    def car(self, number: int, due_s: int) -> Car:
        first_s = self.now_s + 1 + (-self.now_s - 1 - number) % EACH_S
        heard = cycle.nothing_heard(number % cycle.SLOTS)
        return Car(Tram(str(number)), due_s=due_s, asked_s=first_s, heard=heard)

    def restart(self, way: int) -> None:
        self.centres[way] = dispatcher.restarted(LIMITS, self.centres[way], 1_000 * self.now_s)

    def comes_about(self, day: str, in_s: int) -> bool:
        """Tell whether something of a day comes about in this second, once in so many."""
        return day in self.days and self.apart.randrange(in_s) == 0

    # ---- messages

    def times_s(self) -> list[int]:
        """When a message comes: soon, or never; and some of them once more."""
        soon_s = self.now_s + self.chance.randrange(6)
        again_s = self.now_s + self.chance.randrange(self.late_s)
        first = [soon_s] if self.chance.random() >= self.lost else []
        return first + ([again_s] if self.chance.random() < 0.2 else [])

    def ask(self, car: Car) -> None:
        """A cycle ends and the next begins: whose answer counts is heard, another tram's is not."""
        jitters = "jitter" in self.days
        car.asked_s += EACH_S + (self.apart.choice((-1, 0, 0, 1, 2)) if jitters else 0)
        car.heard = cycle.note_cycle(car.heard)
        is_away = car.way < 0 and not car.is_kept
        if is_away or car.unit.fixed_s is None:
            if is_away:
                self.tell_elsewhere(car)
            return
        answers = car
        if car.way >= 0 and self.comes_about("jitter", 20):
            answers = self.apart.choice(self.lines[car.way])
        if answers.unit.fixed_s is None:
            return
        late_ms = self.apart.choice((0, 100, 500, 600)) if jitters else 0
        at_ms = cycle.slot_begins_ms(CYCLE, car.heard.slot) + late_ms
        self.happened["answers of another"] += answers is not car
        self.happened["answers outside their slot"] += late_ms == 600
        age_s = self.now_s - answers.unit.fixed_s
        car.heard = cycle.note_answer(CYCLE, car.heard, Answer(True, answers is car, at_ms, 1_000 * age_s))
        if car.heard.in_this_cycle:
            car.made_s = self.now_s - age_s
            self.tell(car, answers)

    def tell_elsewhere(self, car: Car) -> None:
        for way in range(2):
            self.words += [(due_s, way, car.name, True, 1_000 * self.now_s) for due_s in self.times_s()]

    def tell(self, car: Car, answers: Car) -> None:
        leaves_at = self.chance.choice((car.leaves_at, car.leaves_at, self.chance.randrange(LAST + 1)))
        self.happened["wrong destinations"] += leaves_at != car.leaves_at
        found, way, made_ms = answers.unit.stopping, car.unit.chosen, 1_000 * car.made_s
        report = Report(found.stop, found.left, found.stands, leaves_at, made_ms)
        for due_s in self.times_s():
            self.reports.append((due_s, way, car.name, report))
            self.words.append((due_s, 1 - way, car.name, report.left, made_ms))
            if found.stands and self.chance.random() < 0.1:
                self.words.append((due_s, way, car.name, False, made_ms))

    def hear(self) -> None:
        for _, way, name, is_away, made_ms in self.due(self.words):
            self.centres[way] = dispatcher.note_elsewhere(self.centres[way], name, is_away, made_ms)
        for _, way, name, report in self.due(self.reports):
            self.centres[way] = dispatcher.note_report(self.centres[way], name, report)
            self.order(way, name)
        for _, way, command in self.due(self.orders):
            for unit, name in ((car.unit, car.name) for car in self.lines[way] if car.unit.chosen == way):
                unit.display = dispatcher.received(LIMITS, name, unit.display, command)

    def due(self, box: list[Any]) -> list[Any]:
        now = [each for each in box if each[0] <= self.now_s]
        box[:] = [each for each in box if each[0] > self.now_s]
        return now

    def order(self, way: int, name: Tram) -> None:
        hand = self.chance.choice((Hand.NOTHING, Hand.NOTHING, Hand.NOTHING, Hand.RECOVER))
        order = dispatcher.order(LIMITS, self.centres[way], name, hand)
        self.centres[way] = dispatcher.note_ordered(self.centres[way], name, order)
        self.happened["recoveries"] += order.recovers
        ahead_ms = self.apart.choice((1, 9_000, 3_600_000)) if self.apart.random() < 0.1 else 0
        self.happened["clocks ahead"] += ahead_ms > 0
        command = Command(name, order.stop, order.holds, order.recovers, order.made_ms + ahead_ms)
        self.orders += [(due_s, way, command) for due_s in self.times_s()]

    # ---- trams

    def run(self, way: int) -> None:
        """Let each tram go on to its next mark when it is time, if the one in front is there or beyond."""
        line = self.lines[way]
        for car in list(line):
            ahead_at = line[line.index(car) - 1].at if line.index(car) > 0 else 10**6
            holds, recovers = car.unit.display.holds, car.unit.display.recovers
            if self.now_s < car.until_s or (holds and self.chance.random() < 0.9):
                continue
            turns_off = "kept" in self.days and not car.stands and self.back.random() < 0.04
            if turns_off or car.at >= 2 * car.leaves_at:
                self.leave(car, turns_off)
            elif car.at + 1 <= ahead_at:
                car.at, car.since_s = car.at + 1, self.now_s
                shortest_s, longest_s = (10, 60) if car.stands else (30, 40) if recovers else (60, 110)
                car.until_s = self.now_s + self.chance.randrange(shortest_s, longest_s)
                if car.stands:
                    self.stop_behind(car)
                elif "signals" in self.days and self.signals.random() < 0.3:
                    car.signal_s = self.now_s + self.signals.randrange(20, 90)
                    car.until_s += car.signal_s - self.now_s
                    self.happened["waits at a signal"] += 1

    def stop_behind(self, car: Car) -> None:
        """Where a tram stands that has come to a stop: behind those at it."""
        others = [other for other in self.lines[car.way] if other is not car and other.at == car.at]
        car.offset_mm = max(3_000 - 18_000 * len(others), 1_000 - APPROACH_MM)

    def move(self, car: Car, ahead: Car | None) -> None:
        """Move a tram along the street: it comes to a stop, stands, or runs to before the next, behind the one ahead.

        Where it waits in the section it is slow.
        """
        here_mm, so_far_s = stop_mm(car.at // 2), self.now_s - car.since_s
        if car.stands:
            to_mm = here_mm + min(car.offset_mm, FAST_MM_S * so_far_s - APPROACH_MM)
            car.is_slow = to_mm == here_mm + car.offset_mm
        else:
            is_at_signal = self.now_s < car.signal_s
            begins_s, way_mm = max(car.since_s, car.signal_s), APART_MM - APPROACH_MM - car.offset_mm
            share_s = min(self.now_s, car.until_s) - begins_s
            to_mm = here_mm + car.offset_mm + way_mm * share_s // (car.until_s - begins_s)
            if is_at_signal:
                to_mm = here_mm + SIGNAL_MM
            if ahead is not None and ahead.at == car.at:
                to_mm = min(to_mm, ahead.place_mm - 18_000)
            car.is_slow = to_mm <= car.place_mm and (is_at_signal or car.place_mm > here_mm + 100_000)
        car.place_mm = max(car.place_mm, to_mm)

    def fix(self, car: Car) -> None:
        """Take a fix on board, by the table of the way that the driver chose."""
        unit, most_mm = car.unit, (2 if "fixes_beyond" in self.days else 0.999) * FIX_ERROR_MM
        along_mm, across_mm = (self.apart.uniform(-most_mm, most_mm) for _ in range(2))
        point = fix_at(self.tables[car.way], car.place_mm, along_mm, across_mm)
        note(
            unit,
            self.tables[car.way if "runs_along" in self.days else unit.chosen],
            point,
            0 if car.is_slow else FAST_MM_S,
            self.now_s,
        )
        self.happened["fixes"] += 1
        self.happened["without a place"] += unit.place_mm is None
        if unit.chosen != car.way:
            self.happened["fixes of another way"] += 1
            return
        told = mark(unit.stopping.stop, unit.stopping.left)
        car.is_kept = car.is_kept and (unit.stopping.left or told > car.at)
        if car.is_kept:
            self.happened["fixes of who tells of the run before"] += 1
            self.happened["of these, of who had left no stop then"] += not unit.stopping.left
            return
        self.broken["place"] += unit.place_mm is not None and abs(unit.place_mm - car.place_mm) > MATCH.most_mm
        self.broken["told too soon"] += told > car.at or (unit.stopping.stands and told < car.at - 1)

    def leave(self, car: Car, turns_off: bool) -> None:
        """Turn, or turn off: at the junction to the other line, or between two stops, to come back to the same way.

        That it was confirmed early was for the first stop of the other way.
        """
        self.lines[car.way].remove(car)
        is_other_line = car.way == 0 and car.leaves_at == JUNCTION
        away_s = self.chance.randrange(400 if is_other_line else 200)
        car.is_kept = turns_off and car.unit.chosen == car.way
        if turns_off:
            car.onto, car.comes_at, away_s = car.way, 0, 30 + self.back.randrange(100)
        else:
            car.onto, car.comes_at = 1 - car.way, JOINS if is_other_line else 0
        if turns_off or is_other_line:
            car.confirmed_s = -(10**6)
        car.way, car.due_s = -1, self.now_s + away_s

    def fix_away(self, car: Car) -> None:
        """Take a fix on board of a tram that has turned off: it is nowhere near the way that is set."""
        note(car.unit, self.tables[car.unit.chosen], FAR_AWAY, FAST_MM_S, self.now_s)
        self.happened["told of a run that has ended"] += car.unit.stopping.left

    def come(self, car: Car) -> None:
        """Ask to come, when it is time; come when confirmed; ask anew, by a person, when that has lapsed."""
        centre = self.centres[car.onto]
        if self.now_s < car.due_s:
            return
        if self.now_s - car.confirmed_s > LIMITS.coming_ms // 1_000:
            centre = dispatcher.note_taken_off(centre, car.name)
            if dispatcher.may_come(centre, car.name, car.comes_at):
                centre = dispatcher.note_coming(centre, car.name, car.comes_at, LAST)
                car.confirmed_s = self.now_s
            self.centres[car.onto] = centre
            return
        line = self.lines[car.onto]
        before = [other for other in line if other.at > 2 * car.comes_at] if car.comes_at > 0 else line
        if any(other.at == 2 * car.comes_at for other in line) or self.chance.random() < 0.5:
            return
        line.insert(len(before), car)
        self.happened["joined"] += car.comes_at > 0
        car.way, car.at, car.confirmed_s = car.onto, 2 * car.comes_at, -(10**6)
        car.since_s, car.until_s, car.place_mm, car.offset_mm = self.now_s, self.now_s + 20, 0, 3_000
        car.leaves_at = JUNCTION if car.way == 0 and self.chance.random() < 0.4 else LAST
        was_set = car.unit.chosen == car.way and (car.is_kept or bool(self.days & {"ways", "early"}))
        self.happened["ways set too soon"] += was_set
        if was_set or (car.unit.chosen >= 0 and self.is_set_wrong(car, 0.2)):
            self.happened["ways left as they were"] += 1
        else:
            car.unit = unit_begun(car.way, car.comes_at, self.now_s, self.now_s)

    def is_set_wrong(self, car: Car, share: float) -> bool:
        """Tell whether a driver sets the way wrong, and when he notices."""
        if "ways" not in self.days or self.settings.random() >= share:
            return False
        car.noticed_s = self.now_s + self.settings.randrange(10, self.settings.choice((60, 200, 900)))
        return True

    # ---- what comes about now and then

    def ask_anew(self, way: int) -> None:
        """Ask to take up one that is on the way, by a wrong number."""
        if self.lines[way] and self.apart.random() < 0.01:
            name, stop = self.apart.choice(self.lines[way]).name, self.apart.choice((0, 0, JOINS))
            self.happened["asked for anew"] += 1
            self.centres[way] = dispatcher.note_coming(self.centres[way], name, stop, LAST)

    def start_unit(self, car: Car) -> None:
        """A unit starts anew: its driver chooses the way, and nobody sets a stop."""
        is_wrong = self.is_set_wrong(car, 0.4) or "runs_along" in self.days
        chosen = 1 - car.way if is_wrong else car.way
        stop = car.at // 2 + 2 if "begins_ahead" in self.days else 0
        self.happened["units begun"] += 1
        self.happened["ways set wrong"] += is_wrong
        self.happened["units begun while it recovers"] += car.unit.display.recovers
        car.unit = unit_begun(chosen, stop, self.now_s, self.now_s + self.apart.choice((1, 5, 40)))

    def confirm_early(self, car: Car) -> None:
        """A tram is confirmed for the way back while it is on this one, and its driver sets that way too soon."""
        centre = self.centres[1 - car.way]
        if not dispatcher.may_come(centre, car.name, 0):
            return
        self.centres[1 - car.way] = dispatcher.note_coming(centre, car.name, 0, LAST)
        self.happened["confirmed on the other way"] += 1
        car.confirmed_s, car.noticed_s = self.now_s, self.now_s + self.early.choice((60, 200, 900))
        car.unit = unit_begun(1 - car.way, 0, self.now_s, self.now_s)

    def change_car(self, way: int, car: Car) -> None:
        """A tram breaks down, is towed away and taken off; another car goes on under its number, from the terminus."""
        self.centres[way] = dispatcher.note_taken_off(self.centres[way], car.name)
        if "taken_off_on_the_way" in self.days:
            return
        self.lines[way].remove(car)
        other = self.car(int(car.name), self.now_s + self.apart.choice((1, 10, 100)))
        other.onto = way
        self.cars[self.cars.index(car)] = other
        self.happened["numbers of another car"] += 1

    def set_right(self, car: Car) -> None:
        """A driver notices that another way is set: he sets his own, and the unit begins anew."""
        if self.days & {"ways", "early"} and car.unit.chosen != car.way and self.now_s >= car.noticed_s:
            car.unit = unit_begun(car.way, 0, self.now_s, self.now_s)

    def now_and_then(self, way: int) -> None:
        line = self.lines[way]
        if (self.now_s, way) in self.restarts:
            self.happened["centres begun"] += 1
            self.restart(way)
        if line and self.comes_about("units", 80):
            self.start_unit(self.apart.choice(line))
        if line and self.comes_about("numbers", 600):
            self.change_car(way, self.apart.choice(line))
        if line and "early" in self.days and self.early.randrange(60) == 0:
            self.confirm_early(self.early.choice(line))
        if line and self.comes_about("bunching", 300):
            jammed = self.apart.choice(line)
            jammed.until_s += self.apart.randrange(60, 300) if jammed.stands else 0
        together = any(sum(abs(car.at - other.at) <= 2 for other in line) >= 3 for car in line)
        self.happened["seconds bunched"] += together

    def takes_a_fix(self, car: Car) -> bool:
        """Tell whether a unit takes a fix in this second."""
        return (self.now_s + int(car.name)) % FIX_S == 0 and self.now_s >= car.unit.starts_s

    # ---- a second

    def second(self) -> None:
        for way in range(2):
            self.centres[way] = dispatcher.later(self.centres[way], 1_000)
        self.now_s += 1
        for car in self.cars:
            car.unit.display = on_board.older(LIMITS, car.unit.display, 1_000)
            car.heard = cycle.older(car.heard, 1_000)
            if self.now_s >= car.asked_s:
                self.ask(car)
            if car.way < 0:
                if car.is_kept and self.takes_a_fix(car):
                    self.fix_away(car)
                self.come(car)
        for way, line in enumerate(self.lines):
            self.run(way)
            for place, car in enumerate(line):
                self.move(car, line[place - 1] if place > 0 else None)
                self.set_right(car)
                if self.takes_a_fix(car):
                    self.fix(car)
            self.ask_anew(way)
            self.now_and_then(way)
        self.hear()
        self.judge()

    def judge(self) -> None:
        for centre, line in zip(self.centres, self.lines, strict=True):
            places = {car.name: place for place, car in enumerate(line)}
            self.broken["order turned"] += any(
                places[ahead] > places[behind] for ahead, behind in centre.shown if ahead in places and behind in places
            )
            for place, car in enumerate(line):
                display = car.unit.display
                next_mm, most_mm = stop_mm(display.stop + 1), NEAR.near_mm + MATCH.most_mm + FIX_S * FASTEST_MM_S
                clear = mark(display.stop + 1, False)
                self.broken["not clear"] += display.recovers and any(other.at <= clear for other in line[:place])
                self.broken["beyond the stop"] += display.recovers and car.place_mm > next_mm + most_mm
                self.broken["of the future"] += display.made_ms > 1_000 * self.now_s
                old_ms = 1_000 * (self.now_s - car.made_s)
                self.broken["heard long ago"] += cycle.is_fresh(car.heard) and old_ms > cycle.STALE_MS

    def seconds(self, count: int, restarts_s: int) -> World:
        for _ in range(count):
            if self.now_s == restarts_s:
                for way in range(2):
                    self.restart(way)
            self.second()
        return self


def random_world(number: int, days: frozenset[str] | None = None) -> World:
    """Draw a world and live an hour of it; without ``days`` they are drawn too, each of them in most worlds."""
    chance, apart, settings, early, back, signals = (Random(source * 10**6 + number) for source in range(6))
    lost, late_s = chance.choice((0.0, 0.1, 0.4)), chance.choice((10, 100, 600))
    by_day = {"ways": settings, "early": early, "kept": back, "signals": signals}
    drawn = frozenset(day for day in ORDINARY if by_day.get(day, apart).random() < 0.7)
    restarts = {(apart.randrange(1_100, 4_500), way) for way in range(2) for _ in range(apart.randrange(5))}
    world = World(chance, apart, settings, early, back, signals, drawn if days is None else days, lost, late_s)
    world.restarts = restarts if "centres" in world.days else set()
    return world.seconds(3_600, chance.choice((-1, chance.randrange(1_500, 3_500))))
