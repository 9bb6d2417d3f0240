"""The same seed makes the same runs, in whatever company; and the arrays say what a loop over samples says."""

from __future__ import annotations

import numpy as np
import pytest

from models.sensors import traces as module
from models.sensors.draws import Singles
from models.sensors.faults import Floats
from models.sensors.traces import Setup, traces
from models.sensors.track import Ints, line
from tests.bench_sensors import looped
from tests.sensors.shared import CYCLES, arrays, of_run, some, track


def test_a_run_is_the_same_alone_and_in_any_company() -> None:
    setup = Setup(track(), CYCLES)
    for runs in ([5], [39, 5], range(3, 8)):
        assert of_run(traces(setup, 7, runs), 5) == of_run(some(), 5)


def test_a_run_is_the_same_however_many_are_moved_and_measured_at_once(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(module, "RUNS_A_STEP", 7)
    monkeypatch.setattr(module, "ROWS_A_STEP", 3)
    made = traces(Setup(track(), CYCLES), 7, range(40))
    assert made.runs == some().runs
    for run in range(40):
        assert of_run(made, run) == of_run(some(), run)


def test_another_seed_and_another_run_are_different() -> None:
    setup = Setup(track(), CYCLES)
    assert of_run(traces(setup, 8, [5]), 5) != of_run(some(), 5)
    five, six = of_run(some(), 5), of_run(some(), 6)
    assert five["force_mm_s2.numbers"] != six["force_mm_s2.numbers"]


def test_a_line_is_the_same_by_its_seed() -> None:
    assert [array.tobytes() for _, array in arrays(line(3))] == [array.tobytes() for _, array in arrays(line(3))]
    assert line(3).gradient.tobytes() != line(4).gradient.tobytes()


EVERY_FAULT = {
    "slip_at_s": 40.0,
    "slip_lasts_s": 6.0,
    "tachometer_silent_at_s": 55.0,
    "tachometer_silent_s": 4.0,
    "tachometer_stuck_at_s": 70.0,
    "tachometer_stuck_s": 3.0,
    "spike_at_s": 30.0,
    "inertial_nan_at_s": 80.0,
    "inertial_nan_s": 5.0,
    "inertial_stuck_at_s": 110.0,
    "split_at_s": 95.0,
    "clock_out_at_s": 20.0,
    "clock_out_s": 60.0,
    "radio_out_at_s": 50.0,
    "radio_out_s": 2.0,
}
OF_WHEEL_AND_MOUNTING = {
    "traction_m_s2": 0.9,
    "rolls_back_at_s": 5.0,
    "rolls_back_m": 12.0,
    "dwell_s": 20.0,
    "pair_lost_at_s": 30.0,
    "pulses_lost_at_s": 20.0,
    "pulses_lost_s": 8.0,
    "pulses_lost_share": 0.3,
    "pulses_extra_at_s": 60.0,
    "pulses_extra_s": 9.0,
    "pulses_extra_share": 0.2,
    "diameter_entered_mm": -40.0,
    "slow_slide_at_s": 70.0,
    "slow_slide_share": 0.2,
    "head_reversed": 1.0,
    "left_reversed": -1.0,
}


@pytest.mark.parametrize(
    ("run", "present"),
    [
        (0, {}),
        (3, {}),
        (11, {}),
        (4, EVERY_FAULT),
        (5, EVERY_FAULT),
        (6, OF_WHEEL_AND_MOUNTING),
        (7, OF_WHEEL_AND_MOUNTING),
    ],
)
def test_the_loop_over_samples_says_the_same(run: int, present: dict[str, float]) -> None:
    """To the rounding of 32 bits: a unit or two, of the wheel's speed 1 in 5,000; where it is valid."""
    setup = Setup(track(), CYCLES, present=present)
    made, (loop, frames) = traces(setup, 1, [run]), looped(setup, 1, run)
    truth, sensors = made.truth, made.sensors
    floats: dict[str, tuple[Floats | Singles | Ints, float]] = {
        "head_m": (truth.head_m, 1e-3),
        "speed_m_s": (truth.speed_m_s, 1e-4),
        "gain_m_s2": (truth.acceleration_m_s2, 1e-3),
        "source": (sensors.tail_source, 0),
        "age_ms": (sensors.tail_age_ms, 1),
    }
    for name, (array, most) in floats.items():
        single = np.array([getattr(sample, name) for sample in loop], np.float64)
        assert np.abs(array[0] - single).max() <= most, name
    wholes = {
        "wheel_mm_s": (sensors.wheel_mm_s, 8),
        "way_mm": (sensors.wheel_way_mm, 45),
        "force_mm_s2": (sensors.force_mm_s2, 2),
        "yaw_urad_s": (sensors.yaw_urad_s, 3),
        "pitch_urad_s": (sensors.pitch_urad_s, 3),
        "left_mm_s2": (sensors.left_mm_s2, 2),
        "right_mm_s2": (sensors.right_mm_s2, 2),
        "tail_yaw_urad_s": (sensors.tail_yaw_urad_s, 3),
    }
    for name, (readings, off) in wholes.items():
        told = [getattr(sample, name) for sample in loop]
        assert readings.valid[0].tolist() == [each is not None for each in told], name
        single = np.array([each or 0 for each in told], np.float64)
        assert np.abs(readings.numbers[0] - single)[readings.valid[0]].max() <= off, name
    passed = made.reads.cycle[0] >= 0
    assert list(zip(made.reads.cycle[0][passed].tolist(), made.reads.frames[0][passed].tolist(), strict=True)) == frames
    assert truth.head_m[0, -1] > 1_000


def test_no_runs_are_refused() -> None:
    with pytest.raises(AssertionError, match="no runs"):
        traces(Setup(track(), 100), 1, [])


@pytest.mark.parametrize(
    "setup", [Setup(track(), 50, beyond=("nonsense",)), Setup(track(), 50, present={"nonsense": 1})]
)
def test_a_parameter_that_does_not_exist_is_refused(setup: Setup) -> None:
    with pytest.raises(KeyError, match="nonsense"):
        traces(setup, 1, [1])
