"""One ride: a train on its line with its faults, its unit, driver and staff; and what must be while bounds hold.

Oracles, in rails and cars: no head beyond its end of authority, the front within the range and the speed within its
own, no length underestimated, no whole train accused, a false tail found, no tag overdue that was read, and one that
was not is noticed.  The world knows which declared bounds were broken, and names them.
"""

from __future__ import annotations

import math
from bisect import bisect_left
from collections import Counter, deque
from dataclasses import dataclass, field
from random import Random

from tests.independent.physics import bodies, declared, faults
from tests.independent.physics.bodies import STEPS, Wheel, shown
from tests.independent.physics.declared import ANTENNA_MM, CYCLE_MS, JITTER_MS, LAID_MM, READ_MM, TYPES, VEHICLE_MM
from tests.independent.physics.faults import Fault
from tests.independent.physics.onboard import Host

BEYOND_END, FRONT, SPEED = "a head beyond its end", "a front outside its range", "a speed outside its range"
LENGTH, ACCUSED, SPLIT = "a length underestimated", "a whole train's tail accused", "a whole train taken for split"
FALSE_TAIL, OVERDUE, UNNOTICED = "a false tail accepted", "a tag overdue that was not missed", "a missed tag unnoticed"
STAFF_AFTER_S = 4.0
STANDS_LONG_S = 25.0


@dataclass(frozen=True)
class Hazard:
    """What was so and must not be: when, by how much, and which bounds were broken by then."""

    kind: str
    at_s: float
    by: float
    broken: frozenset[str]


@dataclass(frozen=True)
class Style:
    """How the train is driven.

    ``most_mm_s``: as fast; ``every_mm``: it stops so often; ``dwell_s``: for so long.
    ``careless``: of so many ends the driver does not brake; ``turns``: at so many stops it changes ends.
    ``whole_s``: how long the ride is; ``often``: how many rides are like this, beside the others' 1.
    """

    name: str
    most_mm_s: tuple[float, float]
    every_mm: tuple[float, float]
    dwell_s: tuple[float, float]
    careless: float = 0.0
    turns: float = 0.0
    whole_s: float = 150.0
    often: float = 1.0


STYLES = (
    Style("runs", (8_000, 33_000), (600_000, 3_000_000), (10, 40)),
    Style("stops and goes", (2_000, 12_000), (20_000, 150_000), (3, 20)),
    Style("creeps", (100, 600), (3_000, 40_000), (3, 20)),
    Style("careless", (8_000, 33_000), (400_000, 1_500_000), (5, 20), careless=0.6),
    Style("shunts", (1_500, 8_000), (60_000, 400_000), (5, 20), turns=0.6),
    Style("rests", (8_000, 20_000), (30_000, 300_000), (60, 240), whole_s=500.0),
    Style("rests for hours", (8_000, 20_000), (30_000, 300_000), (3_600, 9_000), whole_s=10_000.0, often=0.03),
)


@dataclass
class Outcome:
    """What came of a ride."""

    hazards: list[Hazard] = field(default_factory=list)
    broken: set[str] = field(default_factory=set)
    counts: Counter[str] = field(default_factory=Counter)
    ran_mm: float = 0.0
    widths: list[tuple[float, int, float]] = field(default_factory=list)
    """Since a fix: the way in mm, the stops, and the range's width in mm, a sample each ten seconds."""


def told_ms(lasts_ms: float) -> int:
    """How long the processor's clock says that a cycle lasted: whole ms, rounded away from 100."""
    return CYCLE_MS + math.ceil(lasts_ms - CYCLE_MS) if lasts_ms > CYCLE_MS else math.floor(lasts_ms)


class Ride:
    """The world of one train."""

    def __init__(self, seed: int, beyond: str | None = None, style: Style | None = None) -> None:
        """Draw it."""
        self.rng = rng = Random(seed)
        self.style = style or rng.choices(STYLES, [each.often for each in STYLES])[0]
        self.jitters = seed % 4 == 2
        self.type = rng.choice(TYPES)
        self.faults = faults.drawn(rng, self.style.whole_s, beyond)
        self.has = {fault.kind for fault in self.faults}
        self.body = bodies.drawn(rng, self.type)
        self.wheel = Wheel(rng.uniform(-1, 1) * declared.DIAMETER)
        self.wheel.diameter += sum(f.size for f in self.faults if f.kind == faults.DIAMETER_WRONG)
        self.bias = [rng.uniform(-1, 1) * declared.BIAS_MM_S2 for _ in range(3)]
        self.apart_mm = self.type.length_mm - 2 * ANTENNA_MM + rng.uniform(-1, 1) * declared.PRESET_MM
        self.tags_mm = self._lay_tags()
        self.laid_mm = [place + rng.uniform(-LAID_MM, LAID_MM) for place in self.tags_mm]
        self.read_at: dict[tuple[int, bool], float] = {}
        self.shift_mm = rng.choice((0, -400_000_000, 100_000_000))
        self.now_s = 0.0
        self.out = Outcome()
        self.missed: set[int] = set()
        self.off_mm = 0.0
        self.reads: list[tuple[bool, int]] = []
        self.shown = (0, 0)
        self.pulses_off = 0.0
        self.paced_s = 0.0
        self.head_was: deque[int] = deque([0] * 5, 5)
        self.tail_was: deque[tuple[int, int]] = deque([(0, 0)] * 5, 5)
        least, most = self._said()
        self.host = Host(self.type, least, most)
        self.unjudged: set[str] = set()
        self.length_rests_on: set[str] = set()
        self.stood_s = self.dwelt_s = 0.0
        self.stop_mm, self.most, self.cares = 0.0, 0.0, True
        self.since_fix = [0.0, 0]
        self.accused = self.called_split = False
        self.passed_before = False
        self.await_next()
        self.go_on()

    # ---- the line, along its own kilometrage and along the train's

    def _lay_tags(self) -> list[float]:
        """Pairs of tags, 8 m apart."""
        places, place = [], self.body.place_mm - 6_000_000.0
        while place < self.body.place_mm + 6_000_000.0:
            place += self.rng.uniform(150_000, 800_000)
            places += [float(round(place)), float(round(place + 8_000))]
        return places

    def along(self, line_mm: float) -> float:
        """A place of the line on the kilometrage of the train's front; it runs down the line's, or below zero."""
        return self.body.direction * line_mm + self.shift_mm

    @property
    def front_mm(self) -> float:
        """Where the front is, there."""
        return self.along(self.body.place_mm)

    def _said(self) -> tuple[int, int]:
        """What staff says of where the front is."""
        off, within = self.rng.uniform(-1_500, 1_500), 2_000
        return round(self.front_mm + off - within), round(self.front_mm + off + within)

    def listed(self) -> list[int]:
        """The tags, in the order in which the train comes to them."""
        return sorted(round(self.along(place)) for place in self.tags_mm)

    def await_next(self) -> None:
        """The unit awaits the next tag."""
        self.host.await_next(self.listed())

    def fault(self, kind: str) -> Fault | None:
        """The fault of this kind that is there now."""
        if kind not in self.has:
            return None
        return next((fault for fault in self.faults if fault.kind == kind and fault.on(self.now_s)), None)

    # ---- driver and staff

    def go_on(self) -> None:
        """The next stop, and the end of authority a while behind it."""
        rng = self.rng
        self.stop_mm = self.front_mm + rng.uniform(*self.style.every_mm)
        if rng.random() < 0.3:
            ahead = [place for place in self.listed() if self.front_mm + 20_000 < place < self.stop_mm + 100_000]
            self.stop_mm = ahead[-1] + rng.uniform(-1_000, 6_000) if ahead else self.stop_mm
        self.most = rng.uniform(*self.style.most_mm_s)
        self.cares = rng.random() >= self.style.careless
        margin = rng.choice((20_000, 60_000, 300_000)) if self.cares else 0
        self.host.take_end(round(self.stop_mm + margin))
        self.dwelt_s, self.dwell_s = 0.0, rng.uniform(*self.style.dwell_s)
        self.rolls_back = rng.random() < 0.1

    def wanted(self) -> float:
        """The driver's force."""
        speed, left = self.body.speed, self.stop_mm - self.front_mm
        if self.host.wants_staff or (self.stood_s > 0 and (self.dwelt_s < self.dwell_s or self.host.braked)):
            return -declared.BRAKE_MM_S2 / 2
        if self.rolls_back and -300 < speed <= 0 and 0 < self.dwelt_s < self.dwell_s + 1:
            return 0.0
        if self.cares and left < speed * speed / 1_200 + 1.5 * speed:
            return -declared.BRAKE_MM_S2 if left < 0 else -min(declared.BRAKE_MM_S2, 150 + speed * speed / 2 / left)
        return max(-600.0, min(declared.TRACTION_MM_S2, (self.most - speed) * 0.7 + self.body.gravity()))

    def stand(self) -> None:
        """What is done at rest: the driver waits and is told a new end, staff helps, the train turns."""
        self.stood_s += CYCLE_MS / 1000
        self.dwelt_s += CYCLE_MS / 1000
        host = self.host
        stuck = self.stood_s > STANDS_LONG_S and host.braked and self.dwelt_s > self.dwell_s + STANDS_LONG_S
        if (host.wants_staff and self.stood_s > STAFF_AFTER_S) or stuck:
            self.out.counts["helped by staff"] += 1
            if not self.out.broken and not self.missed and not self.off_mm:
                self.out.counts[f"helped though every bound held: {host.why}"] += 1
            elif self.out.broken:
                self.out.counts[f"noticed with a bound broken: {host.why}"] += 1
            self.locate_anew(helped=True)
        elif abs(self.stop_mm - self.front_mm) < 30_000 or self.stop_mm < self.front_mm:
            if self.dwelt_s >= self.dwell_s:
                self.out.counts["stops"] += 1
                self.since_fix[1] += 1
                if self.rng.random() < self.style.turns and not self.off_mm:
                    self.turn()
                else:
                    self.go_on()
        elif self.dwelt_s >= self.dwell_s and host.braked:
            host.take_end(round(self.stop_mm + 60_000))

    def locate_anew(self, helped: bool) -> None:
        """Staff says where the train is, which it does once the brake holds it; what was broken is mended."""
        host = self.host
        host.withhold()
        if not host.may_be_located():
            return
        if helped:
            self.off_mm = 0.0
            self.faults = [fault for fault in self.faults if fault.kind != faults.PARTED or fault.from_s > self.now_s]
            self.accused = self.called_split = False
        host.locate(*self._said(), whole=helped, inspected=helped and host.computer.known.watch.broken)
        self.unjudged.clear()
        self.missed.clear()
        self.since_fix = [0.0, 0]
        self.await_next()
        self.go_on()

    def turn(self) -> None:
        """Change ends; over a tag as well."""
        host = self.host
        host.withhold()
        if host.may_be_located():
            self.out.counts["changes of ends"] += 1
            tail_mm, front_mm = self.front_mm - self.type.length_mm, self.front_mm
            self.out.counts["changes of ends over a tag"] += any(tail_mm < tag < front_mm for tag in self.listed())
            self.body.turn()
            self.body.was_s.append(0.0)
            self.shift_mm = self.rng.choice((0, -400_000_000, 100_000_000, self.shift_mm))
            self.locate_anew(helped=False)

    # ---- a cycle of nature

    def run(self) -> Outcome:
        """Run it to its end."""
        self.out.counts[f"rides: {self.style.name}"] = 1
        while self.now_s < self.style.whole_s:
            self.cycle()
        return self.out

    def cycle(self) -> None:
        """The unit decides, the train runs, its sensors tell, its antennas read; and it is judged."""
        host, body = self.host, self.body
        host.decide(acknowledged=body.speed == 0)
        self.judge_window()
        jitter = self.fault(faults.JITTER)
        lawful_ms = self.out.counts["cycles"] * 7 % (20 * JITTER_MS + 1) / 10 - JITTER_MS if self.jitters else 0
        lasts_ms = CYCLE_MS + (self.rng.uniform(-1, 1) * jitter.size if jitter else lawful_ms)
        elapsed_ms = told_ms(lasts_ms)
        if abs(elapsed_ms - CYCLE_MS) > JITTER_MS:
            self.breaks(faults.JITTER)
        before, placed = body.speed, body.place_mm
        gravity = body.gravity()
        was_front = self.front_mm
        self.adhere()
        dt = lasts_ms / 1000 / STEPS
        wheel_before, wanted = self.wheel.speed, self.wanted()
        for _ in range(STEPS):
            self.now_s += dt
            body.step(wanted, host.braked, dt)
            self.wheel.step(body, self.now_s, dt)
            if self.front_mm > host.end_mm + 1 and body.speed > 0:
                self.hazard(BEYOND_END, self.front_mm - host.end_mm)
        self.out.ran_mm += abs(body.place_mm - placed)
        self.since_fix[0] += abs(body.place_mm - placed)
        gained = (body.speed - before) / (lasts_ms / 1000)
        self.watch_pace(gained, (self.wheel.speed - wheel_before) / (lasts_ms / 1000))
        self.tell(elapsed_ms, gained, (gravity + body.gravity()) / 2)
        self.read(was_front)
        self.judge()
        if body.speed == 0:
            self.stand()
        else:
            self.stood_s = 0.0

    def adhere(self) -> None:
        """Does the wheel roll in this cycle: it slides under the brake, and spins under the motors."""
        wheel, body = self.wheel, self.body
        wheel.rolls, wheel.swing, wheel.rate = True, 0.0, 6_000.0
        for kind in (faults.HELD, faults.SLOW, faults.SWINGS, faults.LOCKED, faults.SPINS):
            fault = self.fault(kind)
            under = body.force > 200 if kind == faults.SPINS else body.force < -200
            slowest = 300 if kind == faults.LOCKED and fault and fault.size else 3_000
            if fault is None or not under or body.speed < slowest:
                continue
            wheel.rolls = False
            wheel.of_train = 0.0 if kind == faults.LOCKED else fault.size
            wheel.swing = 0.1 if kind == faults.SWINGS else 0.0
            if kind == faults.SLOW:
                wheel.rate = 600.0 + abs(body.gained)
                self.breaks(faults.SLOW)
        if self.fault(faults.STUCK_WHEEL):
            wheel.rolls, wheel.of_train, wheel.swing = False, 0.0, 0.0
            if body.speed != 0:
                self.breaks(faults.STUCK_WHEEL)

    def watch_pace(self, gained: float, wheel_gained: float) -> None:
        """A wheel that slips keeps pace with its train no longer than is declared: was it so?"""
        wheel, body = self.wheel, self.body
        apart = abs(wheel_gained - gained) >= declared.SLIP_RATE_MM_S2 / 2
        fast = abs(body.speed) > declared.LOCKED_MM_S
        paced = wheel.slipping(body) and not apart and (abs(wheel.speed) > 1 or not fast)
        self.paced_s = self.paced_s + CYCLE_MS / 1000 if paced else 0.0
        if self.paced_s >= declared.PACE_S:
            self.breaks("a wheel that slips keeps pace")

    def tell(self, elapsed_ms: int, gained: float, gravity: float) -> None:
        """What the sensors say of it."""
        rng = self.rng
        speed, way = shown(self.wheel, self.now_s)
        valid = self.fault(faults.SILENT) is None
        for kind, sign in ((faults.PULSES_LOST, -1), (faults.PULSES_EXTRA, 1)):
            fault = self.fault(kind)
            if fault is not None and speed:
                self.pulses_off += sign * fault.size * speed * elapsed_ms / 1000
                speed = round(speed * (1 + sign * fault.size))
                self.breaks(kind)
        way += round(self.pulses_off)
        stuck = self.fault(faults.STUCK)
        if stuck and abs(self.shown[0]) > declared.PULSES_BELOW_MM_S:
            speed, way = self.shown
        if self.fault(faults.ZERO):
            self.pulses_off += self.shown[1] - way
            speed, way = 0, self.shown[1]
            self.breaks(faults.ZERO)
        self.shown = (speed, way)
        if self.fault(faults.DIAMETER_WRONG):
            self.breaks(faults.DIAMETER_WRONG)

        def noisy(value: float, bias: float) -> int:
            noise = max(-declared.NOISE_MM_S2, min(declared.NOISE_MM_S2, rng.gauss(0, 28)))
            return round(value + bias + noise)

        head = noisy(gained + gravity, self.bias[0])
        if self.fault(faults.REVERSED):
            head = -head
            self.breaks(faults.REVERSED)
        self.head_was.appendleft(head)
        tail = self.body.tail_gained() + self.body.direction * self.body.hills.at(
            self.body.place_mm - self.body.direction * self.type.length_mm
        )
        self.tail_was.appendleft((noisy(tail, self.bias[1]), noisy(tail, self.bias[2])))
        late = rng.choice((1, 2, 3))
        heard = rng.random() < 0.95
        self.host.sense(
            elapsed_ms,
            (valid, speed, way),
            (self.fault(faults.INERTIAL_SILENT) is None, head),
            (heard, self.head_was[late], *self.tail_was[late], 100 * late),
        )

    def read(self, was_front_mm: float) -> None:
        """Which antenna reads which tag in this cycle; a read is told when the cycle has ended."""
        back = self.apart_mm - self.off_mm
        for is_head, off in ((False, ANTENNA_MM + back), (True, float(ANTENNA_MM))):
            one, other = sorted((was_front_mm - off, self.front_mm - off))
            if self.body.direction > 0:
                low, high = one - self.shift_mm, other - self.shift_mm
            else:
                low, high = self.shift_mm - other, self.shift_mm - one
            near = bisect_left(self.tags_mm, low - 400)
            while near < len(self.tags_mm) and self.tags_mm[near] < high + 400:
                key = (near, is_head)
                at = self.read_at.setdefault(key, self.laid_mm[near] + self.rng.uniform(-READ_MM, READ_MM))
                if low <= at < high:
                    del self.read_at[key]
                    self.reads_tag(near, is_head)
                near += 1

    def reads_tag(self, tag: int, is_head: bool) -> None:
        """An antenna has read a tag: the host is told, unless it was lost."""
        host, first = self.host, tag - tag % 2
        place = round(self.along(self.tags_mm[tag]))
        lost = self.fault(faults.PAIR_LOST) is not None or (self.fault(faults.TAG_LOST) is not None and tag % 2 == 0)
        if is_head and (lost or (first in self.missed and self.fault(faults.PAIR_LOST))):
            self.out.counts["tags lost"] += 1
            if host.awaited is not None and place >= host.awaited:
                self.missed.add(tag)
            return
        if is_head:
            self.out.counts["tags read"] += 1
            taken = host.head_reads(tag + 1, place)
            if taken:
                self.since_fix = [0.0, 0]
            elif host.located and not self.unjudged and host.front_mm[1] - host.front_mm[0] < 900_000:
                self.hazard(OVERDUE, 0.0)
            if host.awaited is not None and place >= host.awaited:
                if place > host.awaited:
                    self.out.counts["tags missed that the next one shows"] += 1
                    self.missed.clear()
                self.await_next()
            return
        parts = next((f for f in self.faults if f.kind == faults.PARTED and not self.off_mm and self.now_s > 20), None)
        host.tail_reads(tag + 1)
        if self.off_mm and host.counts_tail:
            self.hazard(FALSE_TAIL, self.off_mm)
        if parts is not None and self.rng.random() < 0.3 and self.type.length_mm > 4 * VEHICLE_MM:
            self.out.counts["parted"] += 1
            self.off_mm = VEHICLE_MM * int(parts.size)

    # ---- judged

    def breaks(self, bound: str) -> None:
        """A declared bound is broken: what rests on it is not judged until staff has located the train anew."""
        self.out.broken.add(bound)
        self.unjudged.add(bound)
        self.length_rests_on.add(bound)

    def hazard(self, kind: str, by: float) -> None:
        """Something that must not be so is so; once of a kind."""
        if all(found.kind != kind for found in self.out.hazards):
            broken = self.length_rests_on if kind == LENGTH else self.unjudged
            self.out.hazards.append(Hazard(kind, self.now_s, by, frozenset(broken)))

    def judge_window(self) -> None:
        """A tag is called overdue only if it was missed, or the range is too wide to tell."""
        host = self.host
        narrow = host.located and host.front_mm[1] - host.front_mm[0] < 900_000
        if host.overdue and not self.passed_before and narrow and not self.missed:
            self.hazard(OVERDUE, 0.0)
        self.passed_before = host.overdue
        if self.missed and host.located and not host.overdue:
            first = min(self.along(self.tags_mm[tag]) for tag in self.missed)
            width = host.front_mm[1] - host.front_mm[0]
            if self.front_mm - ANTENNA_MM > first + width + 1_500 + self.body.speed * 0.3:
                self.hazard(UNNOTICED, self.front_mm - first)

    def judge(self) -> None:
        """Are the ranges true, is the length enough, and is a whole train left alone?"""
        host = self.host
        if host.located:
            least, most = host.front_mm
            if not least <= self.front_mm <= most:
                self.hazard(FRONT, max(least - self.front_mm, self.front_mm - most))
            slowest, fastest = host.speed_mm_s
            if not slowest - 1e-6 <= self.body.speed <= fastest + 1e-6:
                self.hazard(SPEED, max(slowest - self.body.speed, self.body.speed - fastest))
            if round(self.now_s * 10) % 100 == 0:
                self.out.widths.append((self.since_fix[0], int(self.since_fix[1]), most - least))
        else:
            self.out.counts["cycles without a range"] += 1
            self.out.counts["cycles without a range though every bound held"] += not self.out.broken
        if host.length_mm < self.type.length_mm:
            self.hazard(LENGTH, self.type.length_mm - host.length_mm)
        if host.false_tail and not self.off_mm and not self.accused:
            self.accused = True
            self.hazard(ACCUSED, 0.0)
        if host.has_split and not self.called_split:
            self.called_split = True
            self.hazard(SPLIT, 0.0)
        self.out.counts["cycles"] += 1
        self.out.counts["cycles the wheel is not trusted"] += not host.trusts_wheel
