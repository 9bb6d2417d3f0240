"""One ride's truth and readings, as compiled code takes them."""

from __future__ import annotations

from collections.abc import Mapping
from typing import NamedTuple

import numpy as np
import numpy.typing as npt

from models.rides.plan import LENGTH_MM
from models.sensors.curves import Registering, averaged, registered
from models.sensors.dynamics import slope_m_s2
from models.sensors.faults import CYCLE_S, FAULTS
from models.sensors.tachometer import WHEEL_MM
from models.sensors.traces import Traces, Whole
from models.sensors.track import GRID_M, Track, read, spots

Floats = npt.NDArray[np.float64]
Places = npt.NDArray[np.int64]
Bools = npt.NDArray[np.bool_]


REGISTERED = Registering()
"""How curves are registered: as for the paper's fixes."""


class Reading(NamedTuple):
    """One channel over the cycles: numbers, and whether each is valid."""

    numbers: Places
    valid: Bools


class Trace(NamedTuple):
    """One ride; arrays over the cycles, but for tags.

    ``head_m`` to ``slope_m_s2``: the truth; ``slope_m_s2`` is gravity along the track under the head,
    ``tail_slope_m_s2`` under the tail.  ``parted_at``: the cycle in which the tail comes off.
    ``yaw``: averaged over 1.5 s, for the cycle in the middle.  ``features``: a row of numbers for each curve
    that is registered ahead.
    ``tag_cycle``, ``tail_cycle``: in which the head's and the tail's antenna pass each tag, -1 for never.
    """

    head_m: Floats
    speed_m_s: Floats
    gain_m_s2: Floats
    tail_gain_m_s2: Floats
    gap_m: Floats
    slope_m_s2: Floats
    tail_slope_m_s2: Floats
    parted_at: int
    wheel: Reading
    way: Reading
    force: Reading
    left: Reading
    right: Reading
    source: Places
    arrived: Bools
    age_ms: Places
    yaw: Reading
    features: Places
    tags_mm: Places
    tag_cycle: Places
    tag_frames: Places
    tail_cycle: Places


class Ending(NamedTuple):
    """What the approach at the end of a ride is made with.

    ``margin_m``: how far beyond the least that the brake control asks for the end lies at first.
    ``gains_m_s2``, ``slows_m_s2``, ``responds_s``: what motors and brake do in truth, net of the gradient.
    ``gradient``: as a tangent.  ``scale``: the wheel's creep and diameter.  ``bias_m_s2``: the inertial sensor's.
    ``slides_at``, ``jolt_m_s2``, ``slides_m_s``: a slide of the wheel so many cycles after the brake came on.
    """

    margin_m: float
    gains_m_s2: float
    slows_m_s2: float
    responds_s: float
    gradient: float
    scale: float
    bias_m_s2: float
    slides_at: int
    jolt_m_s2: float
    slides_m_s: float


def traces_of(made: Traces, track: Track) -> list[Trace]:
    """Give the rides of some traces, one by one."""
    truth, sensors = made.truth, made.sensors
    tail_m = truth.head_m - LENGTH_MM / 1000 - truth.tail_gap_m
    slope = slope_m_s2(read(track.gradient, spots(track, truth.head_m))).astype(np.float64)
    tail_slope = slope_m_s2(read(track.gradient, spots(track, tail_m))).astype(np.float64)
    tags_mm = np.rint(track.tags_m * 1000).astype(np.int64)
    parted = np.clip(made.values["split_at_s"] / CYCLE_S, 1, 2**31).astype(np.int64)
    speed, gain, tail_gain, gap = (
        each.astype(np.float64)
        for each in (truth.speed_m_s, truth.acceleration_m_s2, truth.tail_acceleration_m_s2, truth.tail_gap_m)
    )
    yaw, whole = averaged(sensors.yaw_urad_s.numbers.astype(np.int64), sensors.yaw_urad_s.valid)
    features = features_of(track)
    return [
        Trace(
            head_m=truth.head_m[row],
            speed_m_s=speed[row],
            gain_m_s2=gain[row],
            tail_gain_m_s2=tail_gain[row],
            gap_m=gap[row],
            slope_m_s2=slope[row],
            tail_slope_m_s2=tail_slope[row],
            parted_at=int(parted[row]),
            wheel=reading(sensors.wheel_mm_s, row),
            way=reading(sensors.wheel_way_mm, row),
            force=reading(sensors.force_mm_s2, row),
            left=reading(sensors.left_mm_s2, row),
            right=reading(sensors.right_mm_s2, row),
            source=sensors.tail_source[row].astype(np.int64),
            arrived=sensors.tail_arrived[row],
            age_ms=sensors.tail_age_ms[row].astype(np.int64),
            yaw=Reading(yaw[row], whole[row] != 0),
            features=features[features[:, 0] > truth.head_m[row, 0] * 1000],
            tags_mm=tags_mm + np.rint(made.reads.off_m[row] * 1000).astype(np.int64),
            tag_cycle=made.reads.cycle[row].astype(np.int64),
            tag_frames=made.reads.frames[row],
            tail_cycle=tail_cycles(tail_m[row], track.tags_m),
        )
        for row in range(len(made.runs))
    ]


def features_of(track: Track) -> Places:
    """The curves of a line that can be registered, in their order: a row of numbers for each (P3)."""
    found = []
    for curve in track.features:
        feature = registered(REGISTERED, curve, float(track.free_m_s[int(curve.end_m / GRID_M)]))
        if feature is not None:
            bands = (feature.straight, feature.first, feature.second, feature.third)
            found.append(
                [
                    feature.begin_mm,
                    feature.end_mm,
                    feature.end_error_mm,
                    *(end for band in bands for end in (band.least, band.most)),
                    feature.second_from_mm,
                    feature.third_from_mm,
                    feature.entry_least_mm,
                    feature.exit_least_mm,
                    feature.exit_most_mm,
                    feature.length_least_mm,
                    feature.length_most_mm,
                    feature.speed_least_mm_s,
                ]
            )
    return np.array(sorted(found), np.int64).reshape(-1, 19)


def reading(whole: Whole, row: int) -> Reading:
    """Give one ride's part of a channel."""
    return Reading(whole.numbers[row].astype(np.int64), whole.valid[row])


def tail_cycles(tail_m: Floats, tags_m: Floats) -> Places:
    """In which cycle the tail's antenna passes each tag; -1 if it never does."""
    found = np.searchsorted(np.maximum.accumulate(tail_m), tags_m).astype(np.int64)
    cycles: Places = np.where(found < len(tail_m), found, -1)
    return cycles


def endings_of(made: Traces) -> list[Ending]:
    """Give what each ride's approach is made with."""
    values = made.values
    return [
        Ending(
            margin_m=float(values["approach_margin_m"][row]),
            gains_m_s2=float(values["approach_gains_m_s2"][row]),
            slows_m_s2=float(values["approach_slows_m_s2"][row]),
            responds_s=float(values["approach_responds_s"][row]),
            gradient=float(values["approach_gradient_permille"][row]) / 1000,
            scale=scale_of(values, row),
            bias_m_s2=float(values["head_bias_m_s2"][row]),
            slides_at=int(values["approach_slides_s"][row] / CYCLE_S),
            jolt_m_s2=float(values["slip_jolt_m_s2"][row]),
            slides_m_s=abs(float(values["slip_speed_m_s"][row])),
        )
        for row in range(len(made.runs))
    ]


def scale_of(values: Mapping[str, Floats], row: int) -> float:
    """By how much a ride's wheel turns less than its diameter as entered says, in the mean of its creep."""
    entered = values["diameter_ppm"][row] * 1e-6 + values["diameter_entered_mm"][row] / WHEEL_MM
    return float(values["creep_ppm"][row] / 2 * 1e-6 + entered)


def faults_of(made: Traces) -> Places:
    """Count, for each ride, the faults it has of those that not every ride has."""
    present = [made.values[fault.name] != fault.absent for fault in FAULTS if fault.chance < 1]
    count: Places = np.sum(present, axis=0).astype(np.int64)
    return count
