"""Trams of two lines on both ways of a street: a world of its own, in seconds, at random (G4 to G6).

Nothing of models or proofs is in it but the kernel's public functions.  Trams run from terminus to terminus, turn,
bunch and queue; those of the other line turn off at a junction and come back there; numbers are used again and
destinations are wrong.  Reports and orders come late, again or never, what is told on one way is word from elsewhere on
the other, and the centre starts anew.  Some orders are written by a clock that is ahead, and now and then the centre is
asked to take up a tram that is on the way.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field, replace
from random import Random
from typing import Any

import pytest

from kernel.tram import centre as dispatcher
from kernel.tram import display as on_board
from kernel.tram.centre import Centre, Command, Tram
from kernel.tram.dispatching import DispatchLimits, Hand, Report, coming, mark
from kernel.tram.display import Display

LAST, JUNCTION = 9, 6
LIMITS = DispatchLimits(60_000, 400_000, 90_000, 100_000, 11_000, 18_000, 120_000)
JOINS = LAST - JUNCTION
EACH_S = 7
NoteElsewhere = Callable[[Centre, Tram, bool, int], Centre]
MayCome = Callable[[Centre, Tram, int], bool]
Received = Callable[[DispatchLimits, Tram, Display, Command], Display]


@dataclass
class Car:
    """A tram: on which way and where, or off both; what its driver is shown; and what it means to do.

    ``at``: its mark.  ``until_s``: until then it stays at it.  ``comes_at``: where it wants to come, from ``due_s`` on.
    """

    name: Tram
    way: int = -1
    at: int = 0
    until_s: int = 0
    leaves_at: int = LAST
    comes_at: int = 0
    onto: int = 0
    due_s: int = 0
    confirmed_s: int = -(10**6)
    display: Display = field(default_factory=lambda: on_board.begun(0))

    @property
    def stands(self) -> bool:
        return self.at % 2 == 0


@dataclass
class World:
    """Two ways, each a centre's view and the trams on it, the first one in front.

    ``apart`` draws clocks that are ahead and whom the centre is asked for anew: the rest is drawn as without.
    """

    chance: Random
    apart: Random
    note_elsewhere: NoteElsewhere = dispatcher.note_elsewhere
    may_come: MayCome = dispatcher.may_come
    received: Received = dispatcher.received
    lost: float = 0.1
    late_s: int = 300
    now_s: int = 1_000
    centres: list[Centre] = field(default_factory=list)
    lines: list[list[Car]] = field(default_factory=lambda: [[], []])
    cars: list[Car] = field(default_factory=list)
    reports: list[tuple[int, int, Tram, Report]] = field(default_factory=list)
    words: list[tuple[int, int, Tram, bool, int]] = field(default_factory=list)
    orders: list[tuple[int, int, Command]] = field(default_factory=list)
    recovered: int = 0
    joined: int = 0
    ahead: int = 0
    asked: int = 0
    wrong: int = 0
    blocked: int = 0

    def __post_init__(self) -> None:
        self.restart()
        count = self.chance.randrange(4, 9)
        self.cars = [Car(Tram(str(number)), due_s=1_000 + 150 * number) for number in range(count)]

    def restart(self) -> None:
        nothing = Centre(0, 0, 0, {}, {}, frozenset(), {})
        self.centres = [dispatcher.restarted(LIMITS, nothing, 1_000 * self.now_s) for _ in range(2)]

    # ---- messages

    def times_s(self) -> list[int]:
        """When a message comes: soon, or never; and some of them once more."""
        soon_s = self.now_s + self.chance.randrange(6)
        again_s = self.now_s + self.chance.randrange(self.late_s)
        first = [soon_s] if self.chance.random() >= self.lost else []
        return first + ([again_s] if self.chance.random() < 0.2 else [])

    def tell(self, car: Car) -> None:
        made_ms = 1_000 * self.now_s
        if car.way < 0:
            for way in range(2):
                self.words += [(due_s, way, car.name, True, made_ms) for due_s in self.times_s()]
            return
        leaves_at = self.chance.choice((car.leaves_at, car.leaves_at, self.chance.randrange(LAST + 1)))
        report = Report(car.at // 2, car.at % 2 == 1, car.stands, leaves_at, made_ms)
        for due_s in self.times_s():
            self.reports.append((due_s, car.way, car.name, report))
            self.words.append((due_s, 1 - car.way, car.name, report.left, made_ms))
            if car.stands and self.chance.random() < 0.1:
                self.words.append((due_s, car.way, car.name, False, made_ms))

    def hear(self) -> None:
        for _, way, name, is_away, made_ms in self.due(self.words):
            self.centres[way] = self.note_elsewhere(self.centres[way], name, is_away, made_ms)
        for _, way, name, report in self.due(self.reports):
            self.centres[way] = dispatcher.note_report(self.centres[way], name, report)
            self.order(way, name)
        for _, way, command in self.due(self.orders):
            for car in self.lines[way]:
                car.display = self.received(LIMITS, car.name, car.display, command)

    def due(self, box: list[Any]) -> list[Any]:
        now = [each for each in box if each[0] <= self.now_s]
        box[:] = [each for each in box if each[0] > self.now_s]
        return now

    def order(self, way: int, name: Tram) -> None:
        hand = self.chance.choice((Hand.NOTHING, Hand.NOTHING, Hand.NOTHING, Hand.RECOVER))
        order = dispatcher.order(LIMITS, self.centres[way], name, hand)
        self.centres[way] = dispatcher.note_ordered(self.centres[way], name, order)
        self.recovered += order.recovers
        ahead_ms = self.apart.choice((1, 9_000, 3_600_000)) if self.apart.random() < 0.1 else 0
        self.ahead += ahead_ms > 0
        command = Command(name, order.stop, order.holds, order.recovers, order.made_ms + ahead_ms)
        self.orders += [(due_s, way, command) for due_s in self.times_s()]

    # ---- trams

    def run(self, way: int) -> None:
        """Let each tram go on to its next place when it is time, if the one in front is there or beyond."""
        line = self.lines[way]
        for car in list(line):
            ahead_at = line[line.index(car) - 1].at if line.index(car) > 0 else 10**6
            if self.now_s < car.until_s or (car.display.holds and self.chance.random() < 0.9):
                continue
            if car.at >= 2 * car.leaves_at:
                self.leave(car)
            elif car.at + 1 <= ahead_at:
                car.at += 1
                shortest_s, longest_s = (10, 60) if car.stands else (30, 40) if car.display.recovers else (60, 110)
                car.until_s = self.now_s + self.chance.randrange(shortest_s, longest_s)
                self.see(car)

    def see(self, car: Car) -> None:
        car.display = on_board.located(car.display, True, car.at // 2, car.stands)

    def leave(self, car: Car) -> None:
        """Turn, or turn off at the junction; now and then another tram goes on in its place."""
        self.lines[car.way].remove(car)
        is_other_line = car.way == 0 and car.leaves_at == JUNCTION
        car.onto, car.comes_at, car.way = 1 - car.way, JOINS if is_other_line else 0, -1
        car.due_s = self.now_s + self.chance.randrange(400 if is_other_line else 200)

    def come(self, car: Car) -> None:
        """Ask to come, when it is time; come when confirmed; ask anew, by a person, when that has lapsed."""
        centre = self.centres[car.onto]
        if self.now_s < car.due_s:
            return
        if self.now_s - car.confirmed_s > LIMITS.coming_ms // 1_000:
            centre = dispatcher.note_taken_off(centre, car.name)
            if self.may_come(centre, car.name, car.comes_at):
                centre = confirmed(centre, car.name, car.comes_at)
                car.confirmed_s = self.now_s
            self.centres[car.onto] = centre
            return
        line = self.lines[car.onto]
        before = [other for other in line if other.at > 2 * car.comes_at] if car.comes_at > 0 else line
        if any(other.at == 2 * car.comes_at for other in line) or self.chance.random() < 0.5:
            return
        line.insert(len(before), car)
        self.joined += car.comes_at > 0
        car.way, car.at, car.until_s, car.confirmed_s = car.onto, 2 * car.comes_at, self.now_s + 20, -(10**6)
        car.leaves_at = JUNCTION if car.way == 0 and self.chance.random() < 0.4 else LAST
        car.display = on_board.begun(1_000 * self.now_s)
        self.see(car)

    def ask_anew(self, way: int) -> None:
        """Ask to take up one that is on the way, by a wrong number."""
        if self.lines[way] and self.apart.random() < 0.01:
            name, stop = self.apart.choice(self.lines[way]).name, self.apart.choice((0, 0, JOINS))
            self.asked += 1
            if self.may_come(self.centres[way], name, stop):
                self.centres[way] = confirmed(self.centres[way], name, stop)

    # ---- a second

    def second(self) -> None:
        for way in range(2):
            self.centres[way] = dispatcher.later(self.centres[way], 1_000)
        self.now_s += 1
        for car in self.cars:
            car.display = on_board.older(LIMITS, car.display, 1_000)
            if (self.now_s + int(car.name)) % EACH_S == 0:
                self.tell(car)
            if car.way < 0:
                self.come(car)
        for way in range(2):
            self.run(way)
            self.ask_anew(way)
        self.hear()
        for line in self.lines:
            for place, car in enumerate(line):
                clear = mark(car.display.stop + 1, False)
                self.wrong += car.display.recovers and any(other.at <= clear for other in line[:place])
                self.blocked += car.display.made_ms > 1_000 * self.now_s

    def seconds(self, count: int, restarts_s: int) -> World:
        for _ in range(count):
            if self.now_s == restarts_s:
                self.restart()
            self.second()
        return self


def confirmed(centre: Centre, name: Tram, stop: int) -> Centre:
    """Take a tram up, whoever has said that it may come."""
    taken_up = dispatcher.note_coming(centre, name, stop, LAST)
    if name in taken_up.trams:
        return taken_up
    return replace(centre, trams=centre.trams | {name: coming(centre.now_ms, stop, LAST)})


def random_world(
    number: int,
    note_elsewhere: NoteElsewhere = dispatcher.note_elsewhere,
    may_come: MayCome = dispatcher.may_come,
    received: Received = dispatcher.received,
) -> World:
    chance = Random(number)
    lost, late_s = chance.choice((0.0, 0.1, 0.4)), chance.choice((10, 100, 600))
    world = World(chance, Random(10**6 + number), note_elsewhere, may_come, received, lost, late_s)
    return world.seconds(3_600, chance.choice((-1, chance.randrange(1_500, 3_500))))


@pytest.mark.parametrize("number", range(20))
def test_worlds_at_random(number: int) -> None:
    world = random_world(number)
    assert (world.wrong, world.blocked) == (0, 0)


@pytest.mark.slow
def test_a_thousand_worlds_at_random() -> None:
    for number in range(20, 1_020):
        world = random_world(number)
        assert (world.wrong, world.blocked) == (0, 0), number


def test_trams_recover_and_join() -> None:
    worlds = [random_world(number) for number in range(8)]
    assert sum(world.recovered for world in worlds) > 200
    assert sum(world.joined for world in worlds) > 20
    assert sum(world.ahead for world in worlds) > 200
    assert sum(world.asked for world in worlds) > 200


def any_word(centre: Centre, tram: Tram, _is_away: bool, made_ms: int) -> Centre:
    """Whatever is told from elsewhere ends a run, however old it is."""
    return dispatcher.without(centre, tram, made_ms)


def who_stands(centre: Centre, tram: Tram, _is_away: bool, made_ms: int) -> Centre:
    """A tram that stands at a stop of the other way is away, as it tells."""
    return dispatcher.note_elsewhere(centre, tram, is_away=True, made_ms=made_ms)


def whenever_it_is_off(centre: Centre, tram: Tram, _stop: int) -> bool:
    """A tram may come whoever runs faster to there."""
    return tram not in centre.trams and tram in centre.elsewhere_ms


def whoever_asks(_centre: Centre, _tram: Tram, _stop: int) -> bool:
    """A tram may come although it is on the way."""
    return True


def whatever_its_time(_limits: DispatchLimits, tram: Tram, display: Display, command: Command) -> Display:
    """A display takes an order of the future."""
    if command.tram != tram or not display.stands or not display.made_ms < command.made_ms:
        return display
    return replace(display, holds=command.holds, recovers=command.recovers, made_ms=command.made_ms)


def test_a_display_that_takes_orders_of_the_future_is_seen() -> None:
    assert any(random_world(number, received=whatever_its_time).blocked for number in range(4))


def test_a_centre_without_a_guard_is_seen() -> None:
    assert any(random_world(number, note_elsewhere=any_word).wrong for number in range(10))
    assert any(random_world(number, note_elsewhere=who_stands).wrong for number in range(20))
    assert any(random_world(number, may_come=whenever_it_is_off).wrong for number in range(20))
    assert any(random_world(number, may_come=whoever_asks).wrong for number in range(20))
