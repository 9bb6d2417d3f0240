"""Limits that are lawful are what the proofs ask of them (P1, P5, T2, T12)."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import fields, is_dataclass, replace
from typing import Any

import pytest
from hypothesis import given
from hypothesis import strategies as st

from kernel.onboard import computer
from kernel.onboard import reverse_movement as reverse
from kernel.onboard.antenna_spacing import SpacingLimits
from kernel.onboard.brake_demand import TrainLimits
from kernel.onboard.braking import BrakeBounds
from kernel.onboard.ceiling import NONE
from kernel.onboard.limits import (
    Limits,
    Surveyed,
    are_lawful,
    are_sensors_lawful,
    are_tags_lawful,
    is_brake_lawful,
    is_found_at_rest,
    is_length_lawful,
    is_one_train_written,
    is_reader_lawful,
    is_reverse_lawful,
    is_spacing_lawful,
    is_split_lawful,
    is_window_lawful,
)
from kernel.onboard.odometry import Readings, SensorBounds
from kernel.onboard.reverse_movement import ReverseLimits
from kernel.onboard.speed_limit import SpeedTable
from kernel.onboard.split import Acceleration, SplitLimits
from kernel.onboard.split import Readings as TailReadings
from kernel.onboard.tag_fix import TagLimits
from kernel.onboard.tag_reader import ReaderLimits
from kernel.onboard.tag_window import WindowLimits
from kernel.onboard.train_length import LengthBounds
from kernel.standstill import is_held
from models.layouts.measures import ANTENNA_MM
from models.onboard import antenna_spacing, reverse_movement, split, tag_window
from models.onboard.train_antennas import a_gap_between_tags_has_a_length
from models.onboard.train_nature import (
    Train,
    one_length_is_written_and_it_covers_the_antennas,
    the_antennas_lie_farther_apart_than_the_window_is_long,
    the_brakes_bounds_fit,
    the_lengths_bounds_fit,
    the_odometrys_bounds_fit,
    the_tags_bounds_fit,
)
from models.onboard.units import NM_A_MM
from models.rides.plan import PLAN, SURVEYED, TAG_ERROR_MM

LAWFUL = Limits(
    sensors=PLAN.sensors,
    train=TrainLimits(PLAN.brake, PLAN.speeds, 130_086),
    reverse=PLAN.reverse,
    split=PLAN.split,
    window=PLAN.window,
    tags=TagLimits(ANTENNA_MM, TAG_ERROR_MM),
    spacing=PLAN.spacing,
    antennas_mm=130_000 - 2 * ANTENNA_MM,
    length=replace(PLAN.length, line_maximum_mm=130_086, front_overhang_mm=ANTENNA_MM, rear_overhang_mm=ANTENNA_MM),
    reader=PLAN.reader,
)
SMALL = st.integers(-2, 40)
SPEEDS = st.builds(SpeedTable, SMALL, SMALL, SMALL)
LIMITS = st.builds(
    Limits,
    sensors=st.builds(SensorBounds, *[SMALL] * len(fields(SensorBounds))),
    train=st.builds(TrainLimits, st.builds(BrakeBounds, SMALL, SMALL, SMALL, SMALL), SPEEDS, SMALL),
    reverse=st.builds(ReverseLimits, SMALL),
    split=st.builds(SplitLimits, *[SMALL] * len(fields(SplitLimits))),
    window=st.builds(WindowLimits, SMALL, SMALL, SMALL),
    tags=st.builds(TagLimits, SMALL, SMALL),
    spacing=st.builds(SpacingLimits, SMALL, SMALL),
    antennas_mm=SMALL,
    length=st.builds(LengthBounds, *[SMALL] * len(fields(LengthBounds))),
    reader=st.builds(ReaderLimits, *[SMALL] * len(fields(ReaderLimits))),
)
SURVEYS = st.builds(Surveyed, st.integers(-2, 200), SMALL, SMALL, SMALL, SMALL, st.integers(-2, 200), SMALL, SMALL)


def leaves_whole_trains_alone(limits: SplitLimits, differs_mm_s2: int) -> bool:
    """Tell whether a mean difference of so much, either way, is about over the threshold in no world of splits."""
    site = split.Coupled(limits, 0, 0, 0)
    exact = replace(site, limits=replace(limits, disagreement_mm_s2=0))
    n = differs_mm_s2
    mean = (n, n, n, n, n, n, n, n, n, n, n, n, n, n, n)
    return differs_mm_s2 >= 0 and not split.is_about_over(exact, mean)


def premises(limits: Limits, surveyed: Surveyed) -> dict[str, bool]:
    """What the proofs ask of limits, where nature is just as bad as what was surveyed."""
    laid_mm, read_mm = surveyed.laid_within_mm, surveyed.read_within_mm
    length_mm = limits.train.length_mm
    site = Train(
        limits, surveyed.jolt_mm_s2, surveyed.pace_cycles, length_mm, laid_mm, read_mm, 0, surveyed.preset_within_mm
    )
    stretch = tag_window.Stretch(limits.window, 2 * laid_mm, 2 * read_mm)
    track = antenna_spacing.Track(limits.spacing, 0, limits.tags.antenna_mm, read_mm, surveyed.preset_within_mm)
    wheel = reverse_movement.Wheel(limits.reverse, limits.sensors.pulse_mm)
    return {
        "odometry": the_odometrys_bounds_fit(site),
        "brake": the_brakes_bounds_fit(site),
        "tags": the_tags_bounds_fit(site),
        "window": tag_window.nothing_is_negative(stretch)
        and tag_window.the_tolerance_covers_laying_and_read_window(stretch),
        "missed": the_antennas_lie_farther_apart_than_the_window_is_long(site),
        "split": split.limits_are_not_negative(split.Coupled(limits.split, 0, 0, 0))
        and leaves_whole_trains_alone(limits.split, surveyed.whole_mm_s2),
        "spacing": antenna_spacing.the_tolerance_covers_preset_and_read_window(track)
        and antenna_spacing.is_off(track, NM_A_MM * (surveyed.vehicle_mm - surveyed.preset_within_mm)),
        "length": the_lengths_bounds_fit(site) and one_length_is_written_and_it_covers_the_antennas(site),
        "reverse": reverse_movement.bounds_are_not_negative(wheel)
        and not reverse_movement_hides(wheel, surveyed.pair_mm),
        "one train": can_be_one_train(limits.sensors, limits.train.brake),
        "reader": a_gap_between_tags_has_a_length(site),
        "rest": is_held_at_last(limits),
    }


def reverse_movement_hides(wheel: reverse_movement.Wheel, pair_mm: int) -> bool:
    """Tell whether a train whose tail has rolled from one tag of a boundary to the other may count as located still.

    By any number of pulses that a wheel which rolls may show of it.
    """
    hides = not reverse_movement.is_too_far_back(wheel, NM_A_MM * pair_mm)
    shown_mm = range(-pair_mm, 1)
    if pair_mm >= 0 and reverse_movement.bounds_are_not_negative(wheel):
        assert hides == any(may_show(wheel, pair_mm, each) and is_missed(wheel, each) for each in shown_mm)
    return hides


def may_show(wheel: reverse_movement.Wheel, back_mm: int, shown_mm: int) -> bool:
    """Tell whether a wheel that rolls and is read may show so much of the way back."""
    seen = reverse_movement.Rolling(0, True, 0, 0, False, reverse.LOCATED)
    readings = Readings(100, True, 0, shown_mm, True, 0)
    return reverse_movement.a_rolling_wheel_measures(wheel, seen, readings, -NM_A_MM * back_mm, True)


def is_missed(wheel: reverse_movement.Wheel, shown_mm: int) -> bool:
    """Tell whether the watch takes so many pulses for no reverse movement."""
    movement = reverse.LOCATED
    for way_mm in (0, shown_mm):
        movement = reverse.note_cycle(wheel.limits, movement, Readings(100, True, 0, way_mm, True, 0))
    return not movement.reversed


def can_be_one_train(sensors: SensorBounds, brake: BrakeBounds) -> bool:
    """Tell whether there is a train at the bounds of the odometry that the brake control covers."""
    worst_mm_s2, steepest_mm_s2 = sensors.accelerates_mm_s2, sensors.gradient_mm_s2
    slows = range(brake.slows_mm_s2, sensors.brakes_mm_s2 + 1)
    return worst_mm_s2 <= brake.gains_mm_s2 and steepest_mm_s2 <= brake.falls_mm_s2 and len(slows) > 0


def is_held_at_last(limits: Limits) -> bool:
    """Tell whether its computer finds a train at rest, on either steepest gradient with its sensor at its worst."""
    felt_mm_s2 = limits.sensors.gradient_mm_s2 + limits.sensors.inertial_mm_s2
    return all(is_held_by(limits, inertial_mm_s2) for inertial_mm_s2 in (-felt_mm_s2, felt_mm_s2))


def is_held_by(limits: Limits, inertial_mm_s2: int) -> bool:
    """Tell whether it does with such a reading in each cycle."""
    at_once = replace(limits.train.brake, response_cycles=1, cut_cycles=0)
    limits = replace(limits, train=replace(limits.train, brake=at_once))
    state, at_rest = computer.put_into_service(limits, NONE, 0, 0), Acceleration(0, True)
    tail = TailReadings(head=at_rest, arrived=True, left=at_rest, right=at_rest, age_ms=0)
    for _ in range(min(limits.sensors.agreement_cycles, 1_000) + 2):
        state = computer.decide(limits, state, may_proceed=False, acknowledged=False)
        state = computer.sense(limits, state, Readings(100, True, 0, 0, True, inertial_mm_s2), tail)
    return is_held(computer.at_rest(limits, state))


def parts(limits: Limits, surveyed: Surveyed) -> dict[str, bool]:
    """What the kernel says of them."""
    return {
        "odometry": are_sensors_lawful(limits.sensors, surveyed),
        "brake": is_brake_lawful(limits.train.brake),
        "tags and window": are_tags_lawful(limits.tags, limits.window, surveyed),
        "missed": is_window_lawful(limits.window, limits.train.speeds.line_mm_s, limits.antennas_mm, surveyed),
        "split": is_split_lawful(limits.split, surveyed),
        "spacing": is_spacing_lawful(limits.spacing, surveyed),
        "length": is_length_lawful(limits, surveyed),
        "reverse": is_reverse_lawful(limits.reverse, limits.sensors.pulse_mm, surveyed),
        "one train": is_one_train_written(limits.sensors, limits.train.brake),
        "reader": is_reader_lawful(limits.reader),
        "rest": is_found_at_rest(limits.sensors, limits.train.brake),
    }


@given(LIMITS, SURVEYS)
def test_limits_are_lawful_where_every_premise_holds_of_them_and_only_there(limits: Limits, surveyed: Surveyed) -> None:
    said, asked = parts(limits, surveyed), premises(limits, surveyed)
    assert said["odometry"] == asked["odometry"]
    assert said["brake"] == asked["brake"]
    assert said["tags and window"] == (asked["tags"] and asked["window"])
    assert said["split"] == asked["split"]
    assert said["spacing"] == asked["spacing"]
    assert said["reader"] == asked["reader"]
    assert not said["rest"] or not are_lawful(limits, surveyed) or asked["rest"]
    assert said["length"] == asked["length"] or surveyed.read_within_mm < 0
    assert are_lawful(limits, surveyed) == all(said.values())
    assert not are_lawful(limits, surveyed) or all(asked.values())


def spoilt(limits: Any, value: int) -> Iterator[tuple[str, Any]]:
    """The limits with one number after the other made another."""
    for field in fields(limits):
        kept = getattr(limits, field.name)
        if is_dataclass(kept):
            for name, each in spoilt(kept, value):
                yield f"{field.name}.{name}", replace(limits, **{field.name: each})
        else:
            yield field.name, replace(limits, **{field.name: value})


@pytest.mark.parametrize("value", [-1, 0, 10**6])
def test_one_number_after_the_other_of_the_plan_is_lawful_where_the_premises_hold(value: int) -> None:
    verdicts = set()
    for name, limits in spoilt(LAWFUL, value):
        wanted = all(premises(limits, SURVEYED).values())
        assert are_lawful(limits, SURVEYED) == wanted, name
        verdicts.add(wanted)
    assert verdicts == {True, False}


def test_the_plan_is_lawful_and_just_so() -> None:
    assert are_lawful(LAWFUL, SURVEYED)
    worst: tuple[dict[str, int], ...] = (
        {"jolt_mm_s2": 2_103},
        {"pace_cycles": 19},
        {"laid_within_mm": 44},
        {"preset_within_mm": 87},
        {"vehicle_mm": 19_194},
        {"whole_mm_s2": 511},
        {"pair_mm": 2_146},
    )
    for worse in worst:
        survey = replace(SURVEYED, **worse)
        assert not are_lawful(LAWFUL, survey)


def test_a_plan_by_which_no_train_is_ever_found_at_rest_is_not_lawful() -> None:
    for just, worse in (
        ({"agreement_cycles": 20}, {"agreement_cycles": 21}),
        ({"locked_mm_s": 2_920}, {"locked_mm_s": 2_919}),
        ({"pace_mm_s": 3_521}, {"pace_mm_s": 3_520}),
        ({"slip_mm_s2": 739, "brakes_mm_s2": 600}, {"slip_mm_s2": 738}),
    ):
        held, never = (replace(LAWFUL, sensors=replace(LAWFUL.sensors, **each)) for each in (just, worse))
        assert are_lawful(held, SURVEYED), just
        assert is_held_at_last(held), just
        assert not are_lawful(never, SURVEYED), worse
    slow, slower = (
        replace(LAWFUL, train=replace(LAWFUL.train, brake=replace(LAWFUL.train.brake, standstill_mm_s=each)))
        for each in (601, 600)
    )
    assert are_lawful(slow, SURVEYED)
    assert not are_lawful(slower, SURVEYED)
    assert not is_held_at_last(slower)
