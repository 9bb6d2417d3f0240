"""Faults of wheel, count, mounting and reads: each comes, at its time and of its size, and does what its name says."""

from __future__ import annotations

from functools import cache

import numpy as np
import pytest

from models.sensors.faults import CYCLE_S, quiet
from models.sensors.tachometer import PULSE_M, WHEEL_MM
from models.sensors.traces import Setup, Traces, traces
from tests.sensors.shared import CYCLES, perfect, track


@cache
def with_fault(*values: tuple[str, float]) -> Traces:
    """The runs of perfect sensors, with these values instead."""
    present = quiet() | {"traction_m_s2": 0.9, "dwell_s": 20.0} | dict(values)
    return traces(Setup(track(), CYCLES, present=present), 7, range(3))


def numbers(made: Traces, channel: str, row: int = 0) -> np.ndarray[tuple[int], np.dtype[np.float64]]:
    found: np.ndarray[tuple[int], np.dtype[np.float64]] = getattr(made.sensors, channel).numbers[row].astype(np.float64)
    return found


@pytest.mark.parametrize("way_m", [0.1, 1.8, 20.0])
def test_a_train_rolls_back_so_far_at_a_start_and_its_wheel_counts_back(way_m: float) -> None:
    made, sound = with_fault(("rolls_back_at_s", 5.0), ("rolls_back_m", way_m)), perfect()
    for row in range(3):
        head, before = made.truth.head_m[row], sound.truth.head_m[row]
        back = np.flatnonzero(np.diff(head) < -1e-6)
        assert back.size
        first, last = int(back[0]), int(back[-1]) + 1
        assert np.array_equal(back, np.arange(first, last)), "it rolls back once"
        assert (made.truth.speed_m_s[row, first], made.truth.speed_m_s[row, last]) == (0, 0)
        assert head[first] - head[last] == pytest.approx(way_m, abs=0.01)
        assert head[-1] == pytest.approx(before[-1 - (last - first)] - way_m, abs=0.01)
        way = numbers(made, "wheel_way_mm", row)
        assert way[first] - way[last] == pytest.approx(1000 * way_m, abs=1000 * PULSE_M + 1)
        shown, true = numbers(made, "wheel_mm_s", row)[first:last], 1000 * made.truth.speed_m_s[row, first:last]
        assert shown.min() < 0 or way_m < 0.2
        assert (shown <= 500).all()
        fast = true < -600
        assert (np.abs(shown - true)[fast] < 100).all()


@pytest.mark.parametrize(("name", "sign"), [("lost", -1), ("extra", 1)])
def test_a_share_of_the_pulses_is_missing_or_too_many(name: str, sign: int) -> None:
    made = with_fault((f"pulses_{name}_at_s", 20.0), (f"pulses_{name}_s", 10.0), (f"pulses_{name}_share", 0.25))
    way, sound = numbers(made, "wheel_way_mm"), numbers(perfect(), "wheel_way_mm")
    assert np.array_equal(way[:200], sound[:200])
    assert way[299] - way[199] == pytest.approx((1 + sign * 0.25) * (sound[299] - sound[199]), abs=100)
    assert way[-1] - way[299] == pytest.approx(sound[-1] - sound[299], abs=100)
    speed, true = numbers(made, "wheel_mm_s"), numbers(perfect(), "wheel_mm_s")
    assert np.abs(speed[210:290] / true[210:290] - (1 + sign * 0.25)).max() < 0.02
    assert made.sensors.wheel_mm_s.valid.all(), "it calls itself valid"


@pytest.mark.parametrize("off_mm", [-80.0, 80.0])
def test_a_wheel_whose_diameter_is_entered_wrong_shows_another_way_and_speed(off_mm: float) -> None:
    made = with_fault(("diameter_entered_mm", off_mm))
    share = 1 / (1 + off_mm / WHEEL_MM)
    for channel in ("wheel_way_mm", "wheel_mm_s"):
        shown, sound = numbers(made, channel), numbers(perfect(), channel)
        fast = numbers(perfect(), "wheel_mm_s") > 5_000
        assert np.abs(shown[fast] / sound[fast] - share).max() < 0.03, channel
    assert np.array_equal(made.truth.head_m, perfect().truth.head_m)


def test_a_slow_slide_leaves_without_a_jolt_is_held_and_comes_back() -> None:
    made = with_fault(
        ("slow_slide_at_s", 5.0), ("slow_slide_m_s2", 0.6), ("slow_slide_share", 0.08), ("slow_slide_s", 12.0)
    )
    shown, sound = numbers(made, "wheel_mm_s"), numbers(perfect(), "wheel_mm_s")
    assert np.array_equal(made.truth.speed_m_s, perfect().truth.speed_m_s)
    slower = sound - shown
    slides = np.flatnonzero(slower > 60)
    assert made.truth.acceleration_m_s2[0, slides[0]] < 0, "it begins under the brake"
    assert 9 < slides.size * CYCLE_S < 13
    assert np.diff(slower).max() < 1000 * (0.6 + 0.2) * CYCLE_S + 5, "no jolt"
    held = slower[slides] / np.maximum(sound[slides], 1)
    assert (np.abs(held - 0.08) < 0.005).sum() > 10
    assert held.max() < 0.085
    assert np.array_equal(slides, np.arange(slides[0], slides[-1] + 1)), "once"


def test_both_tags_of_one_boundary_give_no_frame() -> None:
    made, boundaries = with_fault(("pair_lost_at_s", 60.0)), track().boundary_of
    for row in range(3):
        passed = made.reads.cycle[row] >= 0
        lost = np.flatnonzero(passed & (made.reads.frames[row] == 0))
        assert lost.size == 2
        assert boundaries[lost[0]] == boundaries[lost[1]]
        assert made.reads.cycle[row, lost[0]] > 600
        earlier = passed & (made.reads.cycle[row] > 600) & (boundaries < boundaries[lost[0]])
        first_of_pair = np.arange(len(boundaries)) % 2 == 0
        assert not (earlier & first_of_pair).any(), "it is the next boundary"
    assert (perfect().reads.frames[perfect().reads.cycle >= 0] > 0).all()


def test_by_cross_talk_a_tag_of_another_place_answers_at_one_boundary() -> None:
    made, boundaries = with_fault(("crosstalk_at_s", 60.0), ("crosstalk_m", -35.0)), track().boundary_of
    for row in range(3):
        other = np.flatnonzero(made.reads.off_m[row])
        assert other.size == 2
        assert boundaries[other[0]] == boundaries[other[1]]
        assert made.reads.off_m[row, other].tolist() == [-35.0, -35.0]
        assert made.reads.cycle[row, other[0]] > 600
    assert not perfect().reads.off_m.any()


@pytest.mark.parametrize("reversed_to", [1.0, -0.3])
@pytest.mark.parametrize(
    ("place", "channels"),
    [("head", ("force_mm_s2", "pitch_urad_s")), ("left", ("left_mm_s2",)), ("right", ("right_mm_s2",))],
)
def test_a_sensor_mounted_in_reverse_shows_the_other_way(
    place: str, channels: tuple[str, ...], reversed_to: float
) -> None:
    made, sound = with_fault((f"{place}_reversed", reversed_to)), perfect()
    others = {"force_mm_s2", "pitch_urad_s", "yaw_urad_s", "left_mm_s2", "right_mm_s2"} - set(channels)
    for channel in channels:
        shown, true = numbers(made, channel), numbers(sound, channel)
        smooth = [np.convolve(each, np.ones(60) / 60, "valid") for each in (shown, true)]
        strong = np.abs(smooth[1]) > np.abs(smooth[1]).max() / 2
        assert (np.sign(smooth[0]) == -np.sign(smooth[1]))[strong].all()
        assert np.abs(smooth[0] + smooth[1])[strong].mean() < np.abs(smooth[1])[strong].mean() / 2, "but for noise"
    for channel in others:
        assert np.array_equal(numbers(made, channel), numbers(sound, channel))
