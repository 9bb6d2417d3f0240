"""Contracts on the train length for CrossHair (`make crosshair`): leading asserts assume, later ones claim."""

from __future__ import annotations

from dataclasses import replace

from kernel.onboard.train_length import (
    UNMEASURED,
    LengthBounds,
    Passing,
    PointKind,
    contradicts_itself,
    error_mm,
    length_mm,
    note_formation_changed,
    note_head_pass,
    note_kilometrage_changed,
    note_measured_again,
    note_tail_pass,
)

BOUNDS = LengthBounds(
    line_maximum_mm=250_000,
    last_vehicle_mm=20_000,
    front_overhang_mm=3_000,
    rear_overhang_mm=2_000,
    window_mm=513,
    width_mm=20_000,
)
HEAD = Passing(PointKind.FEATURE, 7, 1_000, True, 0, 0, 1_000)
NOTED = note_head_pass(BOUNDS, UNMEASURED, HEAD)
MEASURED = replace(NOTED, measured=True, least_mm=107_000, most_mm=133_000)


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


def a_front_known_badly_measures_nothing(width_mm: int) -> None:
    """Wider than is written (P4)."""
    assert width_mm < 0 or width_mm > 20_000
    assert not note_tail_pass(BOUNDS, NOTED, replace(HEAD, time_ms=2_000, front_most_mm=width_mm)).measured


def another_length_is_contradicted(least_mm: int, most_mm: int) -> None:
    """Where no length is within both, and only there, no less than the line's greatest is used (P4)."""
    assert least_mm <= most_mm
    state = note_measured_again(MEASURED, least_mm, most_mm)
    assert contradicts_itself(state) == (most_mm < 107_000 or least_mm > 133_000)
    assert length_mm(BOUNDS, state) >= (250_000 if contradicts_itself(state) else 133_000)


def no_train_is_shorter_than_its_last_vehicle(front_mm: int) -> None:
    """After a jump of kilometrage that nobody has told (P4)."""
    assert -(10**9) <= front_mm <= 10**9
    state = note_tail_pass(BOUNDS, NOTED, replace(HEAD, time_ms=2_000, front_least_mm=front_mm, front_most_mm=front_mm))
    assert state.measured == (front_mm >= -5_982)
    assert length_mm(BOUNDS, state) >= 20_000


def another_kilometrage_keeps_the_length(time_ms: int) -> None:
    """But what the head has passed before measures nothing any more (P4)."""
    assert isinstance(time_ms, int)
    state = note_tail_pass(BOUNDS, note_kilometrage_changed(MEASURED), replace(HEAD, time_ms=time_ms))
    assert length_mm(BOUNDS, state) == 133_000
    assert not note_tail_pass(BOUNDS, note_kilometrage_changed(NOTED), replace(HEAD, time_ms=time_ms)).measured


def a_change_falls_back(measured: bool, most_mm: int, contradicted: bool) -> None:
    """Whatever was known, a changed formation is as long as the line allows (P4)."""
    assert most_mm >= 0
    state = replace(NOTED, measured=measured, most_mm=most_mm, contradicted=contradicted)
    assert length_mm(BOUNDS, note_formation_changed(state)) == 250_000
