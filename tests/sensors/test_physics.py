"""The models obey the physics they are about."""

from __future__ import annotations

from collections.abc import Mapping
from itertools import pairwise

import numpy as np
import pytest

from kernel.onboard.split import GREATEST_ACCELERATION_MM_S2
from models.onboard import odometry as world
from models.sensors import adhesion, dynamics
from models.sensors.dynamics import Bools, slope_m_s2
from models.sensors.faults import BOUNDS, CYCLE_S, FAULTS, NEVER, SPLIT_LIMITS, Floats, quiet
from models.sensors.traces import Setup, traces
from models.sensors.track import LINE_SPEED_M_S, MOST_GRADIENT_PERMILLE, feature, laid, line, read, spots
from tests.sensors.shared import CYCLES, perfect, some, track

SETUP = Setup(track(), CYCLES)
FLAT = laid(12_000.0, [feature(500.0, 50.0, 9_000.0, 1 / 800)], [], np.array([]))
"""One curve all along, and no gradient."""


def test_the_integral_of_speed_is_the_way() -> None:
    truth = some().truth
    speed = truth.speed_m_s.astype(np.float64)
    way = np.cumsum((speed[:, 1:] + speed[:, :-1]) / 2 * CYCLE_S, axis=1)
    assert np.abs(truth.head_m[:, 1:] - truth.head_m[:, :1] - way).max() < 1e-6
    gained = np.cumsum(truth.acceleration_m_s2.astype(np.float64) * CYCLE_S, axis=1)
    assert np.abs(gained - speed).max() < 1e-2


def test_trains_run_forward_within_their_powers_and_stop() -> None:
    truth, rolls_back = some().truth, some().values["rolls_back_at_s"] < NEVER
    assert truth.speed_m_s[~rolls_back].min() == 0
    assert -1 < truth.speed_m_s.min() < 0
    assert LINE_SPEED_M_S >= truth.speed_m_s.max() > 20
    assert 1000 * truth.acceleration_m_s2.max() <= BOUNDS.accelerates_mm_s2
    assert 1000 * truth.acceleration_m_s2.min() >= -BOUNDS.brakes_mm_s2
    stands = (truth.speed_m_s[:, 600:] == 0).any(axis=1)
    assert stands.mean() > 0.5


def test_a_train_stops_at_its_stops() -> None:
    made = traces(Setup(track(), 4_000, present=quiet() | {"traction_m_s2": 0.9, "dwell_s": 30.0}), 1, [0])
    standing = made.truth.head_m[0][(made.truth.speed_m_s[0] == 0) & (made.truth.head_m[0] > 300)]
    reached = [stop for stop in track().stops_m if stop < made.truth.head_m[0, -1]]
    assert len(reached) >= 1
    assert all(np.abs(standing - stop).min() < 40 for stop in reached)


def test_curvature_is_yaw_over_speed() -> None:
    truth, sensors = perfect().truth, perfect().sensors
    fast = truth.speed_m_s > 10
    curvature = sensors.yaw_urad_s.numbers / 1e6 / np.where(fast, truth.speed_m_s, 1)
    true = read(track().curvature_per_m, spots(track(), truth.head_m))
    assert np.abs(curvature - true)[fast].max() < 4 * 0.001 / 10 + 1e-6
    assert np.abs(true[fast]).max() > 1 / 2_000


def test_a_standing_sensor_shows_gravity_along_the_track() -> None:
    made = traces(Setup(track(), CYCLES, present=quiet() | {"dwell_s": 60.0, "traction_m_s2": 0.9}), 1, [0, 1])
    stands = (made.truth.speed_m_s == 0) & (made.truth.acceleration_m_s2 == 0)
    gravity = 1000 * slope_m_s2(read(track().gradient, spots(track(), made.truth.head_m)))
    shown = made.sensors.force_mm_s2.numbers
    assert stands.sum() > 50
    assert np.abs(shown - gravity)[stands].max() <= 4 * 5 + 1
    assert slope_m_s2(np.array([0.035], np.float32))[0] == pytest.approx(0.343, abs=0.001)


def test_the_wheel_counts_the_way_and_shows_the_speed() -> None:
    truth, sensors = perfect().truth, perfect().sensors
    way = 1000 * (truth.head_m - truth.head_m[:, :1])
    assert np.abs(sensors.wheel_way_mm.numbers - way).max() <= 46
    fast = truth.speed_m_s > 1
    late = np.abs(sensors.wheel_mm_s.numbers - 1000 * truth.speed_m_s)
    assert late[fast].max() < 80


def sound(made_for: Mapping[str, Floats]) -> Bools:
    """The runs in which nothing fails that a bound does not cover."""
    ok = np.ones(len(made_for["slip_at_s"]), np.bool_)
    for name in ("slip_at_s", "tachometer_silent_at_s", "tachometer_stuck_at_s", "spike_at_s", "inertial_nan_at_s"):
        ok &= made_for[name] >= NEVER
    return ok


def test_declared_errors_stay_within_the_kernels_bounds() -> None:
    made = some()
    truth, sensors, ok = made.truth, made.sensors, sound(made.values)
    assert ok.sum() >= 10
    speed = sensors.wheel_mm_s.numbers.astype(np.int64)
    most = speed * BOUNDS.scale_ppm // 1_000_000 + 1 + BOUNDS.tachometer_mm_s
    assert (np.abs(speed - 1000 * truth.speed_m_s) <= most)[ok].all()
    way = sensors.wheel_way_mm.numbers.astype(np.int64)
    true = 1000 * (truth.head_m - SETUP.length_m - dynamics.START_M)
    assert (np.abs(way - true) <= way * BOUNDS.scale_ppm // 1_000_000 + 1 + BOUNDS.pulse_mm)[ok].all()
    gravity = slope_m_s2(read(track().gradient, spots(track(), truth.head_m)))
    assert 1000 * np.abs(gravity).max() <= BOUNDS.gradient_mm_s2
    error = sensors.force_mm_s2.numbers - 1000 * (gravity + truth.acceleration_m_s2)
    assert (np.abs(error) <= BOUNDS.inertial_mm_s2)[ok].all()


def test_an_error_beyond_its_range_leaves_the_bound() -> None:
    made = traces(Setup(track(), 600, beyond=("head_bias_m_s2",), present={"inertial_nan_at_s": NEVER}), 1, range(20))
    gravity = slope_m_s2(read(track().gradient, spots(track(), made.truth.head_m)))
    error = made.sensors.force_mm_s2.numbers - 1000 * (gravity + made.truth.acceleration_m_s2)
    assert (np.abs(error).max(axis=1) > BOUNDS.inertial_mm_s2).sum() >= 5


def test_the_bounds_are_those_that_the_world_asks_for() -> None:
    """The premises of the odometry's world hold of them, with the least jolt of a slip."""
    (jolt,) = (fault.least for fault in FAULTS if fault.name == "slip_jolt_m_s2")
    site = world.Line(BOUNDS, round(1000 * jolt), BOUNDS.agreement_cycles - 2, 120_000, 130_000)
    assert world.bounds_are_not_negative(site)
    assert world.a_jolt_stands_out(site)
    assert world.agreement_takes_longer_than_a_chance_pace(site)
    assert SPLIT_LIMITS.shock_mm_s2 < GREATEST_ACCELERATION_MM_S2


def test_a_slip_begins_and_ends_with_a_jolt() -> None:
    swing = adhesion.difference_m_s(60, 60, 3.0, -6.0)
    assert np.abs(np.diff(swing, prepend=0.0)).max() == pytest.approx(0.3)
    assert swing[0] == pytest.approx(-0.3)
    assert swing[-1] == 0
    assert swing.min() == pytest.approx(-6.0, abs=0.31)


def test_a_slipping_wheel_differs_and_the_train_does_not() -> None:
    with_slip = {"slip_at_s": 100.0, "slip_jolt_m_s2": 4.0, "slip_lasts_s": 5.0, "slip_speed_m_s": 6.0}
    base = quiet() | {"traction_m_s2": 0.9}
    one, other = (traces(Setup(FLAT, CYCLES, present=base | more), 1, [0]) for more in ({}, with_slip))
    assert np.array_equal(one.truth.head_m, other.truth.head_m)
    apart = other.sensors.wheel_mm_s.numbers[0].astype(np.int64) - one.sensors.wheel_mm_s.numbers[0]
    assert np.abs(apart[:999]).max() == 0
    assert apart.max() > 3_000
    assert np.abs(apart[1_060:]).max() < 10


def test_a_tail_that_comes_off_slows_down_and_stays_behind() -> None:
    present = quiet() | {"traction_m_s2": 0.9, "split_at_s": 60.0, "split_slows_m_s2": 1.0}
    truth = traces(Setup(FLAT, CYCLES, present=present), 1, [0]).truth
    assert np.array_equal(truth.speed_m_s[0, :600], truth.tail_speed_m_s[0, :600])
    assert truth.tail_acceleration_m_s2[0, 605] == pytest.approx(-1.0, abs=1e-3)
    assert truth.tail_speed_m_s[0, -1] == 0
    assert np.diff(truth.tail_gap_m[0]).min() >= 0
    assert truth.tail_gap_m[0, -1] > 500


@pytest.mark.parametrize("seed", range(5))
def test_a_line_is_within_its_ranges(seed: int) -> None:
    made = line(seed)
    assert made.length_m >= 10_000
    assert np.abs(made.gradient).max() <= MOST_GRADIENT_PERMILLE / 1000
    assert np.abs(made.curvature_per_m).max() <= 1 / 300 + 1e-6
    assert len(made.tags_m) == 4 * len(made.stops_m)
    pairs = made.tags_m.reshape(-1, 2)
    assert (np.diff(pairs, axis=1) == pytest.approx(3.0)) if len(pairs) else True
    assert (np.diff(made.allowed_m_s.astype(np.float64) ** 2) >= -2 * 0.7 - 1e-3).all()
    curves = [each for each in made.features if not each.vertical]
    assert all(one.end_m + 149 < other.begin_m for one, other in pairwise(curves))


def test_a_short_line_is_refused() -> None:
    with pytest.raises(ValueError, match="10 km"):
        line(1, 9_000.0)
