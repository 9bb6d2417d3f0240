"""Track features: a curve or change of gradient, recognised stage by stage, gives a fix (P2, P3).

The curvature is κ = ω / v (paper 001, 2.2.2).  From the registered begin of detection on, a straight
must come, then the curve, with its curvature in the registered band of each of its three parts and its
length in another, then a straight again (2.2.3, figure 2).  The correction is determined at the curve's
end, and applied after the exit straight.  Whatever does not match, in any cycle, ends the detection
without a fix; a failed one only widens the train's range, by odometry (4.3.1).

Curvatures are in 1/10**6 m, with sign: a left curve is no right curve, a crest no sag.  With ω in µrad/s
and v in mm/s, κ is 1000 ω / v; bands are compared with it after multiplication by v, so nothing is divided.

Ours: the three parts as check points, each met in at least one cycle; no fix below the feature's least
speed, while the wheel slips, after the wheel has turned back, or on a reading out of range.  Ranges of
readings: rates to 1000 rad/s, speeds to 200 m/s, ways to 10**12 mm; bands to 1 / m.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from enum import Enum

from kernel.onboard.arithmetic import GREATEST_SPEED_MM_S
from kernel.onboard.odometry import GREATEST_WAY_MM, SensorBounds, way_error_mm

GREATEST_RATE_URAD_S = 1_000_000_000


class TurnAxis(Enum):
    """About which axis a feature turns the train (P2)."""

    YAW = 0
    """A curve."""
    PITCH = 1
    """A change of gradient: a vertical curve."""


class Progress(Enum):
    """How far the detection has come (P3; paper 001, figure 2)."""

    WAITING = 0
    """For the begin of detection."""
    ENTRY_STRAIGHT = 1
    FIRST_PART = 2
    SECOND_PART = 3
    THIRD_PART = 4
    EXIT_STRAIGHT = 5
    FIXED = 6
    """In this one cycle there is a fix."""
    PASSED = 7
    """The fix was given."""
    FAILED = 8


@dataclass(frozen=True)
class Band:
    """Curvatures from least to most, in 1/10**6 m, with sign (P2)."""

    least: int
    most: int


@dataclass(frozen=True)
class Feature:
    """A feature as registered (P3).

    ``begin_mm``: where detection begins; ``end_mm``: where the curve ends, both on the line's kilometrage.
    ``end_error_mm``: how far the front may be from there in the cycle that finds the end: survey, averaging,
    and a cycle's way.
    ``straight``: what counts as straight.  ``first``, ``second``, ``third``: the bands of the parts.
    ``second_from_mm``, ``third_from_mm``: where the parts begin, from the curve's beginning.
    ``entry_least_mm``, ``exit_least_mm``: how long the straights must be seen; ``exit_most_mm``: the most that
    may have run when the exit straight was long enough: a cycle's way more.
    ``length_least_mm``, ``length_most_mm``: of the curve.
    ``speed_least_mm_s``: below which its curvature is not told; more than 0.
    """

    axis: TurnAxis
    begin_mm: int
    end_mm: int
    end_error_mm: int
    straight: Band
    first: Band
    second: Band
    third: Band
    second_from_mm: int
    third_from_mm: int
    entry_least_mm: int
    exit_least_mm: int
    exit_most_mm: int
    length_least_mm: int
    length_most_mm: int
    speed_least_mm_s: int


@dataclass(frozen=True)
class Readings:
    """What is known at the end of a cycle (P2, P3).

    ``front_least_mm``: the least place of the front, by odometry.
    ``rolling``: the wheel is trusted in this cycle and its readings hold (P1).
    ``speed_mm_s``, ``way_mm``: the tachometer's; the way is counted since power-on.
    ``yaw_urad_s``, ``pitch_urad_s``: angular rates, each with its validity.
    """

    front_least_mm: int
    rolling: bool
    speed_mm_s: int
    way_mm: int
    yaw_valid: bool
    yaw_urad_s: int
    pitch_valid: bool
    pitch_urad_s: int


@dataclass(frozen=True)
class Detection:
    """What is known of the feature awaited (P3).

    ``from_mm``: the tachometer's way where the present straight or curve began; ``way_mm``: in the newest cycle.
    ``fix_least_mm``, ``fix_most_mm``: the front is in there, in the cycle of the fix.
    """

    stage: Progress
    from_mm: int
    way_mm: int
    fix_least_mm: int
    fix_most_mm: int


AWAITED = Detection(Progress.WAITING, 0, 0, 0, 0)
"""A registered feature ahead of the train is awaited: no detection has begun (P3)."""


# ---- one cycle's readings


def rate_urad_s(feature: Feature, readings: Readings) -> int:
    """Give the angular rate about the feature's axis (P2)."""
    return readings.yaw_urad_s if feature.axis == TurnAxis.YAW else readings.pitch_urad_s


def is_usable(feature: Feature, readings: Readings) -> bool:
    """Tell whether a cycle can be matched: begin reached, wheel rolling, fast enough, all in range (P2, P3)."""
    valid = readings.yaw_valid if feature.axis == TurnAxis.YAW else readings.pitch_valid
    return (
        valid
        and readings.rolling
        and feature.begin_mm <= readings.front_least_mm
        and feature.speed_least_mm_s <= readings.speed_mm_s <= GREATEST_SPEED_MM_S
        and 0 <= readings.way_mm <= GREATEST_WAY_MM
        and -GREATEST_RATE_URAD_S <= rate_urad_s(feature, readings) <= GREATEST_RATE_URAD_S
    )


def has_turned_back(state: Detection, readings: Readings) -> bool:
    """Tell whether the wheel's way is less than in the cycle before: what was matched is run over again (P3)."""
    return readings.way_mm < state.way_mm


def is_within(band: Band, feature: Feature, readings: Readings) -> bool:
    """Tell whether the curvature is in a band: least ≤ 1000 ω / v ≤ most (P2)."""
    speed_mm_s = readings.speed_mm_s
    return band.least * speed_mm_s <= 1000 * rate_urad_s(feature, readings) <= band.most * speed_mm_s


def is_straight(feature: Feature, readings: Readings) -> bool:
    """Tell whether the track is straight here (P3)."""
    return is_within(feature.straight, feature, readings)


def part_at(feature: Feature, since_mm: int) -> Progress:
    """Give the part of the curve, some way from its beginning (P3)."""
    if since_mm < feature.second_from_mm:
        return Progress.FIRST_PART
    return Progress.SECOND_PART if since_mm < feature.third_from_mm else Progress.THIRD_PART


def matches(feature: Feature, part: Progress, readings: Readings) -> bool:
    """Tell whether the curvature is in the band of a part (P3)."""
    if part == Progress.FIRST_PART:
        return is_within(feature.first, feature, readings)
    return is_within(feature.second if part == Progress.SECOND_PART else feature.third, feature, readings)


# ---- stage by stage


def failed(state: Detection) -> Detection:
    """End the detection without a fix (P3)."""
    return replace(state, stage=Progress.FAILED)


def wait(feature: Feature, state: Detection, readings: Readings) -> Detection:
    """Begin where detection begins; that must be on a straight, and the curve still ahead (P3).

    A train that could not be matched in time, too slow or with its wheel slipping, would take the next curve for it.
    """
    if not is_straight(feature, readings) or readings.front_least_mm > feature.end_mm:
        return failed(state)
    return replace(state, stage=Progress.ENTRY_STRAIGHT, from_mm=readings.way_mm)


def enter(feature: Feature, state: Detection, readings: Readings) -> Detection:
    """Stay on the entry straight, or find the curve's beginning after enough of it (P3)."""
    if is_straight(feature, readings):
        return state
    if readings.way_mm - state.from_mm < feature.entry_least_mm or not matches(feature, Progress.FIRST_PART, readings):
        return failed(state)
    return replace(state, stage=Progress.FIRST_PART, from_mm=readings.way_mm)


def leaves_out(stage: Progress, part: Progress) -> bool:
    """Tell whether the second part would be left out: each is to be met (P3)."""
    return stage == Progress.FIRST_PART and part == Progress.THIRD_PART


def may_end_here(feature: Feature, readings: Readings) -> bool:
    """Tell whether the curve's end may be here: by the odometry the front is not certainly beyond it (P3, P7)."""
    return readings.front_least_mm <= feature.end_mm + feature.end_error_mm


def turn(feature: Feature, state: Detection, readings: Readings) -> Detection:
    """Stay in the curve, part by part, or find its end in the last, after the registered length (P3)."""
    since_mm = readings.way_mm - state.from_mm
    if is_straight(feature, readings):
        long_enough = feature.length_least_mm <= since_mm <= feature.length_most_mm
        ends = state.stage == Progress.THIRD_PART and long_enough and may_end_here(feature, readings)
        return replace(state, stage=Progress.EXIT_STRAIGHT, from_mm=readings.way_mm) if ends else failed(state)
    part = part_at(feature, since_mm)
    if leaves_out(state.stage, part) or not matches(feature, part, readings):
        return failed(state)
    return replace(state, stage=part)


def leave(bounds: SensorBounds, feature: Feature, state: Detection, readings: Readings) -> Detection:
    """Stay on the exit straight; after enough of it, the curve's end and the way since are the fix (P3)."""
    if not is_straight(feature, readings):
        return failed(state)
    since_mm = readings.way_mm - state.from_mm
    if since_mm < feature.exit_least_mm:
        return state
    if since_mm > feature.exit_most_mm:
        return failed(state)
    error_mm = feature.end_error_mm + way_error_mm(bounds, feature.exit_most_mm)
    return replace(
        state,
        stage=Progress.FIXED,
        fix_least_mm=feature.end_mm + since_mm - error_mm,
        fix_most_mm=feature.end_mm + since_mm + error_mm,
    )


def matched(bounds: SensorBounds, feature: Feature, state: Detection, readings: Readings) -> Detection:
    """Take a cycle that can be matched, by the stage before (P3)."""
    if state.stage == Progress.WAITING:
        return wait(feature, state, readings)
    if state.stage == Progress.ENTRY_STRAIGHT:
        return enter(feature, state, readings)
    if state.stage == Progress.EXIT_STRAIGHT:
        return leave(bounds, feature, state, readings)
    return turn(feature, state, readings)


def note_cycle(bounds: SensorBounds, feature: Feature, state: Detection, readings: Readings) -> Detection:
    """Take the readings of one cycle (P2, P3)."""
    stage = state.stage
    if stage == Progress.FIXED:
        return replace(state, stage=Progress.PASSED)
    if stage == Progress.PASSED or stage == Progress.FAILED:
        return state
    if not is_usable(feature, readings) or has_turned_back(state, readings):
        return state if stage == Progress.WAITING else failed(state)
    return replace(matched(bounds, feature, state, readings), way_mm=readings.way_mm)


def has_fix(state: Detection) -> bool:
    """Tell whether there is a fix in this cycle; odometry takes it in this cycle or never (P3, P7)."""
    return state.stage == Progress.FIXED


def is_over(state: Detection) -> bool:
    """Tell whether the next feature may be awaited (P3)."""
    return state.stage == Progress.FAILED or state.stage == Progress.PASSED
