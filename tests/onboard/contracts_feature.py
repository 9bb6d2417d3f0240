"""Contracts on feature detection for CrossHair (`make crosshair`): leading asserts assume, later ones claim."""

from __future__ import annotations

from kernel.onboard.feature import (
    Band,
    Detection,
    Feature,
    Progress,
    Readings,
    TurnAxis,
    has_fix,
    note_cycle,
)
from kernel.onboard.odometry import SensorBounds

BOUNDS = SensorBounds(10_000, 50, 100, 100, 350, 10, 500, 1_500, 2_000, 10, 10_000, 5_000)
CURVE = Feature(
    axis=TurnAxis.YAW,
    begin_mm=100_000,
    end_mm=250_000,
    end_error_mm=5_000,
    straight=Band(-200, 200),
    first=Band(201, 2_500),
    second=Band(1_500, 2_500),
    third=Band(201, 2_500),
    second_from_mm=30_000,
    third_from_mm=70_000,
    entry_least_mm=20_000,
    exit_least_mm=20_000,
    exit_most_mm=22_000,
    length_least_mm=95_000,
    length_most_mm=105_000,
    speed_least_mm_s=5_000,
)


def told(way_mm: int, rate_urad_s: int, speed_mm_s: int = 20_000, rolling: bool = True) -> Readings:
    """Readings of a cycle after the begin of detection."""
    return Readings(200_000, rolling, speed_mm_s, way_mm, True, rate_urad_s, False, 0)


def no_fix_but_from_the_exit_straight(way_mm: int, rate_urad_s: int) -> None:
    """In the third part of the curve, whatever is read, there is none yet (P3)."""
    assert 0 <= way_mm <= 10**12
    state = note_cycle(BOUNDS, CURVE, Detection(Progress.THIRD_PART, 1_000, 0, 0, 0), told(way_mm, rate_urad_s))
    assert not has_fix(state)


def a_fix_is_as_far_on_as_the_way_since(way_mm: int) -> None:
    """The range has the curve's end and the way in its middle, and both errors beside (P3)."""
    assert 20_000 <= way_mm <= 22_000
    state = note_cycle(BOUNDS, CURVE, Detection(Progress.EXIT_STRAIGHT, 0, 0, 0, 0), told(way_mm, 0))
    assert has_fix(state)
    assert state.fix_least_mm + state.fix_most_mm == 2 * (250_000 + way_mm)
    assert state.fix_most_mm - state.fix_least_mm == 2 * (5_000 + 220 + 1 + 50)


def no_fix_below_the_least_speed(way_mm: int, speed_mm_s: int) -> None:
    """Nor on a speed that no train has (P2)."""
    assert speed_mm_s < 5_000 or speed_mm_s > 200_000
    state = Detection(Progress.EXIT_STRAIGHT, 0, 0, 0, 0)
    assert note_cycle(BOUNDS, CURVE, state, told(way_mm, 0, speed_mm_s)).stage == Progress.FAILED


def no_fix_while_slipping(way_mm: int, rate_urad_s: int) -> None:
    """A wheel that is not trusted counts no way (P2)."""
    assert isinstance(way_mm, int)
    state = Detection(Progress.EXIT_STRAIGHT, 0, 0, 0, 0)
    assert note_cycle(BOUNDS, CURVE, state, told(way_mm, rate_urad_s, 20_000, False)).stage == Progress.FAILED


def the_other_way_round_is_another_curve(rate_urad_s: int) -> None:
    """A curve to the other side does not begin this one (P2)."""
    assert rate_urad_s < -4_000
    state = Detection(Progress.ENTRY_STRAIGHT, 0, 0, 0, 0)
    assert note_cycle(BOUNDS, CURVE, state, told(50_000, rate_urad_s)).stage == Progress.FAILED


def a_failed_detection_is_over(way_mm: int, rate_urad_s: int, rolling: bool) -> None:
    """Until the next feature is awaited (P3)."""
    assert isinstance(way_mm, int)
    state = Detection(Progress.FAILED, 0, 0, 0, 0)
    assert note_cycle(BOUNDS, CURVE, state, told(way_mm, rate_urad_s, 20_000, rolling)) == state
