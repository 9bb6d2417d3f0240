"""Contracts on the train length for CrossHair (`make crosshair`): leading asserts assume, later ones claim."""

from __future__ import annotations

from dataclasses import replace

from kernel.onboard.train_length import (
    AVERAGING_MM,
    SENSOR_MM,
    UNMEASURED,
    LengthBounds,
    Passing,
    PointKind,
    error_mm,
    length_mm,
    note_formation_changed,
    note_head_pass,
    note_tail_pass,
)

BOUNDS = LengthBounds(
    line_maximum_mm=250_000,
    last_vehicle_mm=20_000,
    averaging_mm=AVERAGING_MM,
    sensor_mm=SENSOR_MM,
    front_overhang_mm=3_000,
    rear_overhang_mm=2_000,
    window_mm=513,
)
HEAD = Passing(PointKind.FEATURE, 7, 1_000, 0, 0, 1_000)
NOTED = note_head_pass(UNMEASURED, HEAD)


def the_way_between_is_never_lost(front_mm: int) -> None:
    """Way, last vehicle and E(v) are all in what is used (P4)."""
    assert 0 <= front_mm <= 10**9
    state = note_tail_pass(BOUNDS, NOTED, replace(HEAD, time_ms=2_000, front_least_mm=front_mm, front_most_mm=front_mm))
    assert state.measured
    assert length_mm(BOUNDS, state) == front_mm + 20_000 + 200 + 5_782


def another_point_measures_nothing(point: int) -> None:
    """Only the head's own point does (P4)."""
    assert point != 7
    assert not note_tail_pass(BOUNDS, NOTED, replace(HEAD, point=point, time_ms=2_000)).measured


def no_earlier_pass_measures(time_ms: int) -> None:
    """A telegram from before the head's pass is of another run (P4)."""
    assert time_ms <= 1_000
    assert not note_tail_pass(BOUNDS, NOTED, replace(HEAD, time_ms=time_ms)).measured


def nothing_is_measured_beyond_the_ranges(speed_mm_s: int) -> None:
    """A speed that no train has is no reading (P4)."""
    assert speed_mm_s < 0 or speed_mm_s > 200_000
    assert not note_tail_pass(BOUNDS, NOTED, replace(HEAD, time_ms=2_000, speed_most_mm_s=speed_mm_s)).measured


def the_error_covers_two_cycles(speed_mm_s: int) -> None:
    """E(v) is no less than two cycles' way and the two constants (P8)."""
    assert 0 <= speed_mm_s <= 200_000
    assert 1_000 * error_mm(BOUNDS, PointKind.FEATURE, speed_mm_s) >= 200 * speed_mm_s + 5_782_000


def a_change_falls_back(measured: bool, measured_mm: int) -> None:
    """Whatever was known, a changed formation is as long as the line allows (P4)."""
    assert measured_mm >= 0
    state = replace(NOTED, measured=measured, measured_mm=measured_mm)
    assert length_mm(BOUNDS, note_formation_changed(state)) == 250_000
