"""The odometry at its edges, in drawn worlds at the extremes of every bound, and in 64 bits (P1, P7)."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from itertools import product
from random import Random

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from kernel.onboard import odometry as machine
from kernel.onboard.arithmetic import GREATEST_SPEED_MM_S, NM_A_MM
from kernel.onboard.odometry import GREATEST_WAY_MM, Loss, Motion, Readings, SensorBounds
from models.onboard.odometry import Line, Running
from proofs.onboard.odometry import THEORY
from proofs.onboard.witnesses import odometry
from proofs.onboard.witnesses.play import Play
from proofs.onboard.witnesses.rolling_stock import BOUNDS, SITE, Train, rolling
from proofs.onboard.witnesses.sixty_four_bits import GREATEST, LEAST, Checked, Wrapped, with_ints

HUGE = 2**62
NUMBERS = st.integers(-300, 300) | st.integers(-300_000, 300_000) | st.sampled_from((HUGE, -HUGE, GREATEST, LEAST))
READINGS = st.builds(
    Readings,
    st.sampled_from((100, 100, 100, 100, 100, 100, 100, 100, 0, -100, 200)),
    st.booleans(),
    NUMBERS,
    NUMBERS,
    st.booleans(),
    NUMBERS,
)
FIXES = st.tuples(NUMBERS, NUMBERS)


@pytest.mark.parametrize("witness", odometry.WITNESSES)
def test_witness(witness: Callable[[], None]) -> None:
    assert witness.__doc__
    witness()


# ---- drawn worlds


class World:
    """A train on a line, drawn cycle by cycle: motion, gradient, adhesion, sensors at the edges of their bounds."""

    def __init__(self, chance: Random, site: Line) -> None:
        self.chance = chance
        self.bounds, scale_ppm = site.bounds, site.bounds.scale_ppm
        start_mm = chance.randrange(-(10**6), 10**6)
        least_mm, most_mm = start_mm - chance.randrange(3_000), start_mm + chance.randrange(3_000)
        motion = machine.located(least_mm, most_mm, chance.randrange(10**6))
        start_nm = chance.choice((least_mm, most_mm, start_mm)) * NM_A_MM
        running = Running(
            start_nm, 0, False, False, 0, motion.way_mm, 0, start_nm, motion.way_mm, False, False, 0, motion
        )
        self.play = Play(THEORY, site, running)
        self.wheel_nm = motion.way_mm * NM_A_MM
        self.scale_ppm = chance.choice((0, scale_ppm, -scale_ppm * 1_000_000 // (1_000_000 + scale_ppm) + 1))
        self.slowest_um_s = chance.choice((0, 0, -3_000_000))
        self.mm_s2, self.gradient, self.shown, self.off_mm_s = 0, 0, -1, 0
        self.accepted = self.trusted = self.cycles = 0

    @property
    def motion(self) -> Motion:
        return self.play.system.motion

    def change_phase(self) -> None:
        chance, bounds = self.chance, self.bounds
        self.mm_s2 = chance.choice(
            (0, 0, bounds.accelerates_mm_s2, -bounds.brakes_mm_s2, chance.randrange(-bounds.brakes_mm_s2, 1 + 1_000))
        )
        steepest = bounds.gradient_mm_s2
        self.gradient = chance.choice((0, steepest, -steepest, steepest // 4, -steepest // 4))
        self.off_mm_s = chance.choice((-1, 0, 1)) * max(0, bounds.tachometer_mm_s - 1)

    def tachometer(self, speed_um_s: int) -> int:
        """A rolling wheel, as far off as it may be."""
        speed_mm_s = (speed_um_s * (1_000_000 + self.scale_ppm) + 500_000_000) // 1_000_000_000
        return speed_mm_s + self.off_mm_s

    def inertial(self, gained_um_s: int) -> int:
        """Acceleration and gravity, as far off as may be."""
        sign = self.chance.choice((-1, 0, 1))
        edge = gained_um_s + sign * 100 * self.bounds.inertial_mm_s2
        return self.gradient + (-(-edge // 100) if sign < 0 else edge // 100)

    def disturbed(self, readings: Readings) -> Readings:
        """Sensors fall silent or wild, or repeat themselves."""
        wild = self.chance.choice((0, -1, HUGE, -HUGE, 200_001, 100_001, 10**12 + 1))
        return self.chance.choice(
            (
                replace(readings, tachometer_valid=False, tachometer_mm_s=wild, way_mm=wild),
                replace(readings, inertial_valid=False, inertial_mm_s2=wild),
                replace(readings, tachometer_valid=False, inertial_valid=False, inertial_mm_s2=wild),
                replace(readings, tachometer_mm_s=-1),
                replace(readings, way_mm=-1),
                replace(readings, inertial_mm_s2=10**6),
            )
        )

    def cycle(self) -> None:
        chance, before = self.chance, self.play.system
        if chance.random() < 0.03:
            self.change_phase()
        if chance.random() < (0.01 if self.shown < 0 else 0.2):
            self.shown = chance.choice((0, 0, 60_000, before.motion.tachometer_mm_s)) if self.shown < 0 else -1
        speed_um_s = min(55_000_000, max(self.slowest_um_s, before.speed_um_s + 100 * self.mm_s2))
        slow, fast = sorted((before.speed_um_s, speed_um_s))
        rolled_nm = chance.choice((100 * slow, 100 * fast, 50 * (slow + fast)))
        slips = self.shown >= 0
        wheel_nm = self.wheel_nm + (
            100_000 * self.shown if slips else rolled_nm + rolled_nm * self.scale_ppm // 1_000_000
        )
        readings = Readings(
            elapsed_ms=100,
            tachometer_valid=True,
            tachometer_mm_s=self.shown if slips else self.tachometer(speed_um_s),
            way_mm=wheel_nm // NM_A_MM // 10 * 10,
            inertial_valid=True,
            inertial_mm_s2=self.inertial(speed_um_s - before.speed_um_s),
        )
        if chance.random() < 0.01:
            readings = self.disturbed(readings)
        after = self.play.step(
            "run_a_cycle",
            readings=readings,
            to_nm=before.front_nm + rolled_nm,
            speed_um_s=speed_um_s,
            gradient_mm_s2=self.gradient,
            slips=slips,
            sticks=False,
        )
        self.cycles += 1
        self.trusted += after.motion.trusted
        if after is before:
            self.shown = -1
        else:
            self.accepted += 1
            self.wheel_nm = wheel_nm

    def fix(self) -> None:
        at_mm = self.play.system.front_nm // NM_A_MM
        within_mm = self.chance.choice((1, 1_000, 20_000))
        self.play.step("take_fix", least_mm=at_mm - self.chance.randrange(within_mm), most_mm=at_mm + within_mm)


@settings(max_examples=15, deadline=None)
@given(st.integers(0, 2**32))
def test_the_range_contains_the_train_in_drawn_worlds(seed: int) -> None:
    chance = Random(seed)
    bounds = SensorBounds(
        scale_ppm=chance.choice((0, 3_000, 10_000, 30_000)),
        pulse_mm=chance.choice((15, 50)),
        tachometer_mm_s=chance.choice((1, 5, 100)),
        inertial_mm_s2=chance.choice((0, 50, 200)),
        gradient_mm_s2=chance.choice((0, 100, 350)),
        gradient_rate_mm_s2=chance.choice((0, 5, 50)),
        slip_mm_s2=chance.choice((300, 400, 2_000)),
        accelerates_mm_s2=1_200,
        brakes_mm_s2=1_800,
        agreement_cycles=chance.choice((3, 5, 10)),
        pace_mm_s=chance.choice((2_000, 20_000)),
        locked_mm_s=chance.choice((1_000, 5_000)),
    )
    jolt = bounds.slip_mm_s2 + -(-102 * (bounds.inertial_mm_s2 + 2 * bounds.gradient_mm_s2) // 98)
    pace_cycles = bounds.agreement_cycles - 2
    world = World(chance, replace(SITE, bounds=bounds, jolt_mm_s2=jolt, pace_cycles=pace_cycles))
    for cycle in range(600):
        world.cycle()
        if cycle % 150 == 149:
            world.fix()
    assert machine.is_located(world.motion)
    assert world.accepted > 300


@settings(max_examples=20, deadline=None)
@given(st.integers(0, 2**32))
def test_a_false_fix_in_drawn_worlds_puts_the_range_off_by_no_more(seed: int) -> None:
    """Fixes off by anything, seen or not; invariants in each step."""
    chance = Random(seed)
    world = World(chance, SITE)
    for cycle in range(300):
        world.cycle()
        if cycle % 30 == 29:
            at_mm = world.play.system.front_nm // NM_A_MM + chance.randrange(-6_000, 6_001)
            within_mm = chance.choice((1, 1_000, 5_000))
            world.play.step("take_fix", least_mm=at_mm - within_mm, most_mm=at_mm + within_mm)
    running = world.play.system
    least_nm, most_nm = NM_A_MM * running.motion.front_least_mm, NM_A_MM * running.motion.front_most_mm
    if machine.is_located(running.motion):
        assert least_nm - running.false_by_nm <= running.front_nm <= most_nm + running.false_by_nm


@settings(max_examples=10, deadline=None)
@given(st.integers(0, 2**32))
def test_a_train_that_rolls_keeps_a_narrow_range(seed: int) -> None:
    """Without slip or disturbance the wheel stays trusted, and the range is a hundredth of the way."""
    chance = Random(seed)
    train = Train()
    train.stand(11)
    for _ in range(600):
        speed_mm_s = train.system.speed_um_s // 1_000 + chance.choice((-100, 0, 0, 100, 100))
        train.cycle(min(40_000, max(0, speed_mm_s)), gradient=chance.choice((0, 300)))
    assert train.trusted()
    way_mm = train.motion.way_mm - train.motion.anchor_way_mm
    assert train.width_mm() == train.motion.anchor_most_mm - train.motion.anchor_least_mm + 2 * (way_mm // 100 + 31)


# ---- edges


@settings(max_examples=200, deadline=None)
@given(st.lists(READINGS | FIXES, max_size=25))
def test_any_readings_whatever_are_answered(history: list[Readings | tuple[int, int]]) -> None:
    motion = rolling(20_000).motion
    for told in history:
        after = (
            machine.note_cycle(BOUNDS, motion, told)
            if isinstance(told, Readings)
            else machine.note_fix(motion, told[0], max(told))
        )
        if motion.loss != Loss.NONE:
            assert after == motion
        elif after.loss == Loss.NONE:
            assert after.front_least_mm <= after.front_most_mm
            assert after.speed_least_mm_s <= after.speed_most_mm_s
            assert after.speed_most_mm_s >= 0
            assert abs(after.way_mm) <= GREATEST_WAY_MM
            assert abs(after.tachometer_mm_s) <= GREATEST_SPEED_MM_S
            assert abs(after.gradient_mm_s2) <= BOUNDS.gradient_mm_s2
        motion = after


def test_a_stuck_tachometer_is_found_when_the_train_changes_its_speed() -> None:
    """Stuck at a speed while the train brakes: not trusted, and the range contains it by inertia."""
    train = rolling(20_000)
    for speed in range(19_880, 14_000, -120):
        train.cycle(speed, tachometer=20_000, slips=True)
        assert not train.trusted()


def test_a_tachometer_stuck_while_the_speed_changes_below_the_threshold_is_not_found() -> None:
    """What this machine cannot see: the sensor's own diagnosis must, and the world refuses it."""
    motion = rolling(20_000).motion
    for cycle in range(1, 11):
        stuck = Readings(100, True, 20_000, motion.anchor_way_mm + 2_000 * cycle, True, -384)
        motion = machine.note_cycle(BOUNDS, motion, stuck)
    assert motion.trusted


def test_a_stuck_inertial_sensor_takes_trust_away() -> None:
    """A sensor stuck at zero while the wheel brakes: the odometry does with what train and line allow."""
    motion = rolling(20_000).motion
    stuck = Readings(100, True, 19_900, motion.way_mm + 1_995, True, 0)
    after = machine.note_cycle(BOUNDS, motion, stuck)
    assert not after.trusted


def test_the_same_readings_again_are_a_standstill_of_the_pulses() -> None:
    """A late telegram repeated: the way does not grow, the speed is what it was; the world calls it a slip."""
    train = rolling(0)
    before = train.motion
    repeated = Readings(100, True, 0, before.way_mm, True, 0)
    once = machine.note_cycle(BOUNDS, before, repeated)
    assert machine.note_cycle(BOUNDS, once, repeated) == once


@pytest.mark.parametrize("elapsed_ms", [0, -100, 97, 103, 200, HUGE, -HUGE])
def test_an_irregular_cycle_loses_the_range(elapsed_ms: int) -> None:
    motion = machine.located(0, 1_000, 0)
    lost = machine.note_cycle(BOUNDS, motion, Readings(elapsed_ms, True, 0, 0, True, 0))
    assert lost == replace(motion, loss=Loss.CYCLE_IRREGULAR)


# ---- 64 bits

GREATEST_BOUNDS = SensorBounds(
    scale_ppm=1_000_000,
    pulse_mm=10**6,
    tachometer_mm_s=200_000,
    inertial_mm_s2=100_000,
    gradient_mm_s2=100_000,
    gradient_rate_mm_s2=100_000,
    slip_mm_s2=100_000,
    accelerates_mm_s2=100_000,
    brakes_mm_s2=100_000,
    agreement_cycles=10**6,
    pace_mm_s=10**6,
    locked_mm_s=10**6,
)
FAR_MM = 10**12


@pytest.mark.parametrize("trusted", [True, False])
@pytest.mark.parametrize("bounds", [GREATEST_BOUNDS, BOUNDS])
def test_every_number_fits_into_64_bits(bounds: SensorBounds, trusted: bool) -> None:
    """At the corners of the declared ranges, with far wider places and bounds than any line has."""
    checked = with_ints(Checked, bounds)
    edges = (-FAR_MM, FAR_MM)
    for least_mm, speed, way_mm, gradient in product(edges, (0, 400_000), (0, 10**12), (-100_000, 100_000)):
        motion = replace(
            machine.located(least_mm, FAR_MM, 0),
            speed_least_mm_s=speed,
            speed_most_mm_s=speed,
            tachometer_mm_s=min(speed, 200_000),
            gradient_mm_s2=gradient,
            trusted=trusted,
        )
        for shown, inertial, since_mm in product((-200_000, 0, 200_000), (-100_000, 0, 100_000), (way_mm, 10**12)):
            readings = Readings(100, True, shown, since_mm, True, inertial)
            after = machine.note_cycle(checked, with_ints(Checked, motion), with_ints(Checked, readings))
            assert after == machine.note_cycle(bounds, motion, readings)
            machine.note_fix(after, Checked(-FAR_MM), Checked(FAR_MM))
            assert isinstance(after.front_most_mm, Checked)


@settings(max_examples=300, deadline=None)
@given(st.lists(READINGS, max_size=10))
def test_compiled_arithmetic_answers_the_same(history: list[Readings]) -> None:
    """Whatever 64-bit numbers the sensors give: what wraps around is not used."""
    motion = rolling(20_000).motion
    wrapped = with_ints(Wrapped, motion)
    for readings in history:
        motion = machine.note_cycle(BOUNDS, motion, readings)
        wrapped = machine.note_cycle(with_ints(Wrapped, BOUNDS), wrapped, with_ints(Wrapped, readings))
        assert wrapped == motion


def test_a_broken_machine_is_caught(monkeypatch: pytest.MonkeyPatch) -> None:
    """The drawn worlds do find a machine that trusts the wheel in a slip."""

    def always(bounds: SensorBounds, motion: Motion, readings: Readings) -> bool:
        return machine.tachometer_speaks(bounds, motion, readings) and machine.inertial_speaks(bounds, readings)

    def drawn() -> None:
        for seed in range(20):
            world = World(Random(seed), SITE)
            for _ in range(300):
                world.cycle()

    drawn()
    monkeypatch.setattr(machine, "agrees", always)
    with pytest.raises(AssertionError):
        drawn()
