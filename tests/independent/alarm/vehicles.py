"""A line of two tracks with a tunnel, a yard and a siding; cars with receivers of their own; trains made up of them.

Places in metres from the line's lower end; only what the kernel is told is in its units.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from itertools import pairwise
from random import Random

from kernel.alarm import distance
from kernel.alarm.distance import NO_TRAIN_FIX, AlarmBounds, Direction, TrainFix
from kernel.alarm.sections import NoUse, Reason, Section
from kernel.alarm.tone import Display, Freshness, Register, Train
from tests.independent.alarm.office import FRESH_MS

LINE_M, FASTEST_M_S, LENGTH_M = 30_000.0, 26.5, 120.0
STATIONS_M = (300, 6_000, 12_000, 18_000, 24_000, 29_700)
EDGES_M = [edge for at_m in STATIONS_M for edge in (at_m - 300, at_m + 300)]
STRETCHES_M = list(pairwise(EDGES_M))
"""What the display shows: a station, or all between two of them."""
TUNNEL_M, ZONE_M = (15_500, 19_500), 500
"""With a zone at either end where there is GPS, and a station within."""
YARD_M, SIDING_M = (11_500, 12_500), (23_650, 24_350)
CUTTING_M = (7_500, 9_000)
"""Where receivers are off by hundreds of metres, in worlds where the surveyor has not seen to it."""
FIX_MS, DISPLAY_MS, WORKER_MS, LAG_MS = 10_000, 12_000, 5_000, 2_600
STABLED = Train("stabled")


def registered(turning_ms: int, with_cutting: bool = False) -> Register:
    """Give the register; ``turning_ms``: the least time that turning takes on this line."""
    sections = {
        Section("tunnel"): NoUse(Reason.WITHOUT_GPS, 1_000 * TUNNEL_M[0], 1_000 * TUNNEL_M[1], 1_000 * ZONE_M),
        Section("yard"): NoUse(Reason.SHUNTING, 1_000 * YARD_M[0], 1_000 * YARD_M[1], 0),
        Section("siding"): NoUse(Reason.STABLING, 1_000 * SIDING_M[0], 1_000 * SIDING_M[1], 0),
    }
    if with_cutting:
        sections[Section("cutting")] = NoUse(Reason.WITHOUT_GPS, 1_000 * (CUTTING_M[0] - 500), 1_000 * 9_500, 500_000)
    return Register(
        AlarmBounds(27_000, 2_000, round(1_000 * LENGTH_M), 20_000, 15_000, turning_ms),
        Freshness(FIX_MS, DISPLAY_MS, FRESH_MS, WORKER_MS),
        display_error_mm=100_000,
        tolerance_mm=150_000,
        sections=sections,
        stabled=frozenset({(STABLED, Section("siding"))}),
        ways={},
        openings={},
        edition=1,
    )


def stretch_at(at_m: float) -> int:
    """Give the number of the stretch in which a place is."""
    return next(number for number, (_from_m, to_m) in enumerate(STRETCHES_M) if at_m <= to_m)


def shown_at(at_m: float) -> Display:
    """Give what the display shows of a train whose antenna is there."""
    from_m, to_m = STRETCHES_M[stretch_at(at_m)]
    return Display(1_000 * from_m, 1_000 * to_m, 0)


def is_in(section_m: tuple[int, int], low_m: float, high_m: float) -> bool:
    """Tell whether a stretch of track is in a section."""
    return section_m[0] <= low_m and high_m <= section_m[1]


def has_sky(at_m: float) -> bool:
    """Tell whether a receiver there sees the sky."""
    return not TUNNEL_M[0] + ZONE_M < at_m < TUNNEL_M[1] - ZONE_M


class Unit:
    """A receiver and the computer that sends its fixes, on a car.

    The receiver is right within 20 m, or hangs, or is off by kilometres, or gives no fix.  ``last``, ``last_off_m``:
    what it told last, and how far that was off; ``held``, ``held_off_m``: what the computer holds.  What is off for
    long lies where no display that is fresh can show the train; what lies nearer is so for a few seconds.
    """

    def __init__(self, chance: Random) -> None:
        """Begin with a computer that has just started."""
        self.chance = chance
        self.held, self.last, self.held_off_m, self.last_off_m = NO_TRAIN_FIX, NO_TRAIN_FIX, 0.0, 0.0
        self.error_m, self.off_m, self.creeps_m_s = chance.uniform(-19.9, 19.9), 0.0, 0.0
        self.hangs_ms = self.off_ms = self.out_ms = self.silent_ms = 0
        self.frozen = self.starts = self.jumped = 0

    def fail(self, now_ms: int, at_m: float, hangs: float, goes_off: float, does_creep: bool) -> None:
        """Begin what receivers, computers and radios do on some days.

        ``hangs``, ``goes_off``: how often a receiver begins to hang, or to be off.
        """
        lasts_ms = 1_000 * self.chance.randrange(5, 120)
        self.hangs_ms = now_ms + lasts_ms if self.chance.random() < hangs else self.hangs_ms
        if self.chance.random() < goes_off and now_ms >= self.off_ms:
            is_near = self.chance.random() < 0.5
            self.off_m = self.chance.choice((-1, 1)) * self.chance.uniform(700, 2_500) if is_near else self.far_m(at_m)
            self.off_ms = now_ms + (1_000 * self.chance.randrange(2, 15) if is_near else lasts_ms // 4)
        what = self.chance.random()
        if what < 0.0002:
            self.out_ms = now_ms + lasts_ms // 2
        elif what < 0.0005:
            self.silent_ms = now_ms + lasts_ms // 2
        elif what < 0.0015 and does_creep:
            self.creeps_m_s = self.chance.choice((-4.0, 4.0))
        elif what < 0.0020 or (now_ms < self.hangs_ms and what < 0.08):
            self.held = NO_TRAIN_FIX
            self.starts += 1

    def far_m(self, at_m: float) -> float:
        """Give how far off a place is that lies three stretches away or more, and not where trains shunt."""
        number, yard = stretch_at(at_m), stretch_at(sum(YARD_M) / 2)
        others = [at for each, at in enumerate(STRETCHES_M) if abs(each - number) > 3 and abs(each - yard) > 1]
        return self.chance.uniform(*self.chance.choice(others)) - at_m

    def receive(self, elapsed_ms: int, now_ms: int, at_m: float, way: int, runs: bool) -> None:
        """The receiver tells a place, or none, and the computer takes it."""
        self.held = distance.older_train(self.held, elapsed_ms)
        self.error_m = max(-19.9, min(19.9, self.error_m + self.chance.gauss(0, 1.5)))
        self.creep(elapsed_ms, now_ms)
        if now_ms < self.hangs_ms and distance.is_fix(self.last.place_mm, 0):
            self.frozen += runs
        elif now_ms < self.out_ms or not has_sky(at_m):
            return
        else:
            direction = Direction.DOWN if way > 0 else Direction.UP
            place_mm = round(1_000 * (at_m + self.error_m + self.off_m))
            self.last = TrainFix(place_mm, 0, direction if self.chance.random() < 0.97 else Direction.UNKNOWN, runs)
            self.last_off_m = self.off_m
            self.jumped += self.off_m != 0.0
        if self.last.place_mm != self.held.place_mm:
            self.held_off_m = self.last_off_m
        self.held = distance.fix_of_the_unit(self.held, self.last)

    def creep(self, elapsed_ms: int, now_ms: int) -> None:
        """Go on being off, or be right again."""
        self.off_m += self.creeps_m_s * elapsed_ms / 1_000
        if abs(self.off_m) > 1_500 and self.creeps_m_s:
            self.off_m = self.creeps_m_s = 0.0
        if now_ms >= self.off_ms and not self.creeps_m_s:
            self.off_m = 0.0


@dataclass
class Car:
    """A car or a set of cars that are never parted: its length, where on it the antenna is, and its unit."""

    length_m: float
    antenna_m: float
    unit: Unit


@dataclass
class Body:
    """A train: its cars from the lower end up, and what its driver does.

    ``leader``: the car whose unit tells under the train's number.  ``way``: which way it runs, or ran last; ``ran_ms``:
    when.  ``until_ms``: when its driver decides anew.  ``off_ms``: since when it is off the display, because it shunts;
    -1: it is on it.  ``was_m``: where its antenna was, and when.
    """

    number: Train
    track: int
    low_m: float
    cars: list[Car]
    leader: int = 0
    way: int = 1
    speed_m_s: float = 0.0
    doing: str = "stands"
    until_ms: int = 0
    ran_ms: int = -(10**9)
    moved: bool = False
    is_there: bool = False
    next_number: Train | None = None
    off_ms: int = -1
    beyond: Body | None = None
    was_m: list[tuple[int, float]] = field(default_factory=list)

    def high_m(self) -> float:
        """Give where its upper end is."""
        return self.low_m + sum(car.length_m for car in self.cars)

    def place_m(self, car: int) -> float:
        """Give where the antenna of a car is."""
        return self.low_m + sum(each.length_m for each in self.cars[:car]) + self.cars[car].antenna_m

    def antenna_m(self) -> float:
        """Give where the antenna is that tells of it."""
        return self.place_m(self.leader)

    def ahead_m(self, other: Body) -> float:
        """Give how far another train on its track is ahead of it; below 0 behind."""
        return other.low_m - self.high_m() if self.way > 0 else self.low_m - other.high_m()

    def gap_m(self, at_m: float) -> float:
        """Give how far its nearer end is from a place; 0 where it stands over it."""
        return max(0.0, self.low_m - at_m, at_m - self.high_m())

    def departs(self, at_m: float, now_ms: int, turning_ms: int) -> bool:
        """Tell whether it is past a place by 100 m, all of it, and has run away from it so lately that it runs on."""
        goes_away = (self.low_m > at_m) == (self.way > 0)
        return goes_away and self.gap_m(at_m) >= 100 and now_ms - self.ran_ms <= turning_ms


def made_up(chance: Random, number: Train, track: int, low_m: float) -> Body:
    """Give a train of one or two cars, its antennas at any end."""
    lengths_m = chance.choice(((60,), (40,), (60, 60), (40, 60)))
    cars = [Car(each, chance.uniform(0, each), Unit(chance)) for each in lengths_m]
    return Body(number, track, low_m, cars, leader=chance.randrange(len(cars)), way=chance.choice((-1, 1)))
