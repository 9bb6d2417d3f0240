"""Trains that leave two roads and come back: a world of its own, in mm and seconds, at random (X4, T14).

Nothing of models or proofs is in it but the kernel's public functions.  A train runs out over the tags of an end point,
stands, changes ends, comes in again, over one road or both, or stops between two tags; its tail misses tags; a coupling
breaks; what it tells comes late and again, to the terminals of both roads.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field, replace
from random import Random

import pytest

from kernel.crossing.end_point import EndPointSettings, TailRead, are_lawful, has_left
from kernel.names import Tag

LENGTH_MM, TAGS_APART_MM = 120_000, 5_000
INNER_MM = {"west": 20_000, "east": 520_000}
"""Roads lie at 0 and at 500 m; trains leave towards greater numbers."""
CHANGES_S = 60
Judge = Callable[[EndPointSettings, TailRead, int], bool]


def settings_of(road: str) -> EndPointSettings:
    return EndPointSettings(Tag(f"{road} inner"), Tag(f"{road} outer"), 20, 3, CHANGES_S)


TAGS = {
    tag: place_mm
    for road, inner_mm in INNER_MM.items()
    for tag, place_mm in ((Tag(f"{road} inner"), inner_mm), (Tag(f"{road} outer"), inner_mm + TAGS_APART_MM))
}


@dataclass
class World:
    """A train from ``near_mm`` on, nearest to the roads, with its tail at that end or at the other one."""

    chance: Random
    judge: Judge = has_left
    misses: float = 0.2
    now_s: int = 0
    near_mm: int = -LENGTH_MM - 100_000
    length_mm: int = LENGTH_MM
    outward: bool = True
    left_mm: int = 10**9
    reads: list[tuple[Tag, int]] = field(default_factory=lambda: [(Tag("start"), -9), (Tag("next"), -8)])
    air: list[tuple[int, TailRead, int]] = field(default_factory=list)
    gone: int = 0
    wrong: int = 0

    @property
    def tail_mm(self) -> int:
        return self.near_mm if self.outward else self.near_mm + self.length_mm

    @property
    def nearest_mm(self) -> int:
        """Where the nearest part of it is, that which was left behind among them."""
        return min(self.near_mm, self.left_mm)

    def run(self, way_mm: int, speed_mm_s: int) -> None:
        """Run forward; whatever tag the tail comes over in a second it reads then, or misses."""
        while way_mm > 0:
            step_mm = min(way_mm, speed_mm_s)
            before_mm = self.tail_mm
            self.near_mm += step_mm if self.outward else -step_mm
            low_mm, high_mm = sorted((before_mm, self.tail_mm))
            passed = [tag for tag, place_mm in TAGS.items() if low_mm <= place_mm < high_mm]
            for tag in passed if self.outward else reversed(passed):
                if self.chance.random() >= self.misses:
                    self.reads.append((tag, self.now_s))
            way_mm -= step_mm
            self.second()

    def second(self) -> None:
        """Tell what the tail has read; let come what is due; and let a second pass."""
        (before, before_s), (last, last_s) = self.reads[-2:]
        read = TailRead(before, last, last_s - before_s, self.left_mm == 10**9)
        for late_s in (0, self.chance.randrange(5), self.chance.randrange(200)):
            self.air.append((self.now_s + late_s, read, last_s))
        due = [(read, last_s) for due_s, read, last_s in self.air if due_s <= self.now_s]
        self.air = [each for each in self.air if each[0] > self.now_s]
        for road, inner_mm in INNER_MM.items():
            if any(self.judge(settings_of(road), read, self.now_s - last_s) for read, last_s in due):
                self.gone += 1
                self.wrong += self.nearest_mm <= inner_mm + TAGS_APART_MM
        self.now_s += 1

    def change_ends(self) -> None:
        for _ in range(CHANGES_S + 1 + self.chance.randrange(60)):
            self.second()
        self.outward = not self.outward

    def part(self) -> None:
        """A coupling breaks: the part that is nearest to the roads stays, if it is not the leading one."""
        if self.outward and self.left_mm == 10**9:
            self.left_mm = self.near_mm
            self.near_mm += 40_000
            self.length_mm -= 40_000


def played(number: int, judge: Judge = has_left, trips: int = 12) -> World:
    """A train that goes out and comes in; from half of its trips it comes back from between the tags, or so."""
    chance = Random(number)
    world = World(chance, judge, misses=chance.choice((0.0, 0.3)))
    parts_at = chance.choice((-1, chance.randrange(trips)))
    for trip in range(trips):
        aims = chance.choice((22_000, 24_000, 40_000, 200_000, 522_000, 560_000))
        if trip == parts_at:
            world.part()
        world.run(aims - world.near_mm, chance.randrange(2_000, 28_000))
        world.change_ends()
        world.run(world.near_mm + world.length_mm + chance.choice((10_000, 60_000)), chance.randrange(2_000, 28_000))
        world.change_ends()
    return world


@pytest.mark.parametrize("number", range(20))
def test_worlds_at_random(number: int) -> None:
    assert played(number).wrong == 0


@pytest.mark.slow
def test_a_thousand_worlds_at_random() -> None:
    assert sum(played(number).wrong for number in range(20, 1_020)) == 0


def test_trains_that_leave_are_told_gone() -> None:
    assert sum(played(number).gone > 0 for number in range(20)) > 15


def any_order(settings: EndPointSettings, read: TailRead, age_cycles: int) -> bool:
    """Take the outer tag alone for enough."""
    return has_left(settings, replace(read, before=settings.inner), age_cycles)


def any_time_between(settings: EndPointSettings, read: TailRead, age_cycles: int) -> bool:
    """Ask nothing of the time between both reads."""
    return has_left(settings, replace(read, apart_cycles=0), age_cycles)


def any_age(settings: EndPointSettings, read: TailRead, _age_cycles: int) -> bool:
    """Take what comes late for new."""
    return has_left(settings, read, 0)


def any_part(settings: EndPointSettings, read: TailRead, age_cycles: int) -> bool:
    """Believe the head of a parted train."""
    return has_left(settings, replace(read, is_whole=True), age_cycles)


def any_road(settings: EndPointSettings, read: TailRead, age_cycles: int) -> bool:
    """Take the tags of the other road for one's own."""
    return any(has_left(settings_of(road), read, age_cycles) for road in INNER_MM)


@pytest.mark.parametrize("careless", [any_order, any_time_between, any_age, any_part, any_road])
def test_a_terminal_without_a_guard_is_seen(careless: Judge) -> None:
    assert any(played(number, careless).wrong for number in range(40))


def test_settings_under_which_a_train_is_back_too_soon_are_refused() -> None:
    good = settings_of("west")
    assert are_lawful(good)
    assert not are_lawful(replace(good, told_cycles=CHANGES_S + 1))
    assert not are_lawful(replace(good, apart_cycles=CHANGES_S + 1))
    assert not are_lawful(replace(good, outer=good.inner))
