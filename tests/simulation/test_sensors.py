"""What a simulated train's sensors say is what the odometry's proof assumes of sensors, cycle for cycle (P1, P7)."""

from __future__ import annotations

from itertools import pairwise
from random import Random

import pytest
from hypothesis import example, given, settings
from hypothesis import strategies as st

from kernel.onboard import odometry
from kernel.onboard.arithmetic import CYCLE_MS
from models.onboard.odometry import Line, Running, run_a_cycle
from models.rides.plan import PLAN
from models.simulation.driver import EMERGENCY_MM_S2, gained_mm_s2
from models.simulation.sensors import SLIP_MOST_MM_S, Sensors, sensors
from proofs.onboard.odometry import INVARIANTS

SILENT = st.sampled_from(("none", "none", "none", "tachometer", "inertial"))
SITE = Line(
    bounds=PLAN.sensors,
    jolt_mm_s2=PLAN.sensors.slip_mm_s2
    + -(-102 * (PLAN.sensors.inertial_mm_s2 + 2 * PLAN.sensors.gradient_mm_s2) // 98),
    pace_cycles=PLAN.sensors.agreement_cycles - 2,
    length_mm=120_000,
    length_used_mm=120_000,
)
"""The least jolt that may tell a slip, and the longest pace that a slipping wheel may keep."""


class Trip:
    """A train in the proof's world whose sensors are the simulated ones; it starts from rest."""

    def __init__(self, seed: int) -> None:
        self.sensors: Sensors = sensors(Random(seed))
        self.gains_mm_s2 = 0.0
        motion = odometry.located(-1_000, 1_000, 0)
        self.system = Running(0, 0, False, False, 0, 0, 0, 0, 0, False, False, 0, motion)

    def cycle(self, asked_mm_s2: float, emergency: bool) -> None:
        """Run on for a cycle; the step must be one of the world's, and every invariant must hold after it."""
        before = self.system
        self.gains_mm_s2 = gained_mm_s2(self.gains_mm_s2, asked_mm_s2, emergency)
        speed_um_s = max(0, before.speed_um_s + round(self.gains_mm_s2 * CYCLE_MS))
        gained_um_s = speed_um_s - before.speed_um_s
        was_off = self.sensors.kept.off_mm_s
        readings, _ = self.sensors.read(speed_um_s / 1000, gained_um_s / CYCLE_MS, 0.0)
        slips = was_off != 0 or self.sensors.kept.off_mm_s != 0
        to_nm = before.front_nm + CYCLE_MS * (before.speed_um_s + speed_um_s) // 2
        self.system = run_a_cycle(SITE, before, readings, to_nm, speed_um_s, 0, slips, False)
        assert self.system is not before, f"no step of the world: {readings} after {before}, at {speed_um_s} um/s"
        assert not [claim.__name__ for claim in INVARIANTS if not claim(SITE, self.system)]


@settings(max_examples=40, deadline=None)
@example(0, [(50, 700.0, 5_000, "none"), (19, 700.0, 1_900, "none")])
@given(
    st.integers(0, 10**6),
    st.lists(
        st.tuples(st.integers(5, 120), st.sampled_from((700.0, 700.0, 0.0, -900.0)), st.integers(0, 8_000), SILENT),
        min_size=2,
        max_size=12,
    ),
)
def test_slips_and_silence_stay_within_what_is_assumed_of_nature(
    seed: int, legs: list[tuple[int, float, int, str]]
) -> None:
    """A train gathers speed, its wheel slips and slides, sensors fall silent: each cycle is a step of the world."""
    trip = Trip(seed)
    for _ in range(200):
        trip.cycle(700.0, False)
    for cycles, asked_mm_s2, slips_ms, silence in legs:
        if slips_ms:
            trip.sensors.slip(slips_ms, trip.system.speed_um_s / 1000, asked_mm_s2 < 0)
        trip.sensors.silence_tachometer(CYCLE_MS * (cycles // 2) if silence == "tachometer" else 0)
        trip.sensors.silence_inertial(CYCLE_MS * (cycles // 2) if silence == "inertial" else 0)
        for _ in range(cycles):
            trip.cycle(asked_mm_s2, False)


@pytest.mark.parametrize("slowing", [False, True])
def test_a_slip_of_the_longest_kind_is_never_taken_for_rolling(slowing: bool) -> None:
    """For eight seconds at 20 m/s the wheel runs away and comes back, and is not trusted before it rolls."""
    trip = Trip(1)
    for _ in range(320):
        trip.cycle(700.0, False)
    assert trip.system.motion.trusted
    assert trip.sensors.slip(8_000, trip.system.speed_um_s / 1000, slowing)
    trusted, most_off_mm_s = 0, 0.0
    for _ in range(79):
        trip.cycle(-EMERGENCY_MM_S2 if slowing else 0.0, False)
        trusted += trip.system.motion.trusted
        most_off_mm_s = max(most_off_mm_s, abs(trip.sensors.kept.off_mm_s))
    assert trusted == 0
    assert most_off_mm_s > 5_000
    for _ in range(60):
        trip.cycle(0.0, False)
    assert trip.system.motion.trusted


@pytest.mark.parametrize("cycles", range(1, 24))
def test_a_wheel_that_begins_to_slip_again_while_it_is_off_stays_nowhere(cycles: int) -> None:
    """Wherever in its way out and back the second slip meets it, it is off by no more than it may be, and moves on."""
    trip = Trip(1)
    for _ in range(320):
        trip.cycle(700.0, False)
    speed_mm_s = trip.system.speed_um_s / 1000
    assert trip.sensors.slip(4_000, speed_mm_s, False)
    offs_mm_s = []
    for cycle in range(60):
        if cycle == cycles:
            assert trip.sensors.slip(5_000, speed_mm_s, False)
        trip.cycle(0.0, False)
        assert not trip.system.motion.trusted
        offs_mm_s.append(trip.sensors.kept.off_mm_s)
    assert max(map(abs, offs_mm_s)) <= SLIP_MOST_MM_S
    twice = [one + other for one, other in pairwise(offs_mm_s[:50])]
    assert all(len({one, two, three}) > 1 for one, two, three in zip(twice, twice[1:], twice[2:], strict=False))
