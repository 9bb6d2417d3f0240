"""Paper 001, 4.3.2: train length over a train of 120 m, from curves that head and tail both find (P4, P8).

A multiple unit: both ends look for the same curve, each with its own gyro.  The tail's cycles begin anywhere
within the head's, which the paper calls the start skew.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from kernel.onboard import train_length as machine
from kernel.onboard.arithmetic import CYCLE_MS
from kernel.onboard.train_length import (
    AVERAGING_MM,
    SENSOR_MM,
    UNMEASURED,
    Length,
    LengthBounds,
    Passing,
    PointKind,
    cycle_way_mm,
)
from models.reproduce.passing import SENSORS_APART_M, Ridden, Runs, awaited, looked_for, measured_yaw
from models.sensors import track as tracks
from models.sensors.curves import Registering, averaged
from models.sensors.faults import CYCLE_S
from models.sensors.track import Places

TRUE_MM = 120_000
"""Six cars (paper, 4.3.2)."""
PLAN = Registering(sensor_m=SENSOR_MM / 1000 / 2**0.5)
"""Two ends, whose noise is independent, share the sensor's 5 m of table 2: lengths take sharper curves than fixes."""
BOUNDS = LengthBounds(
    line_maximum_mm=200_000,
    last_vehicle_mm=TRUE_MM - round(1000 * SENSORS_APART_M),
    front_overhang_mm=0,
    rear_overhang_mm=0,
    window_mm=0,
    width_mm=0,
)
"""The last vehicle is 20 m long; the line's maximum (ours) is ten cars'."""


@dataclass(frozen=True)
class Measured:
    """One measurement: raw as in the paper's formula (3), the one that the kernel uses, and at which speed.

    ``again``: the train was measured before.  ``contradicts``: that was another length.
    """

    raw_m: float
    used_m: float
    speed_m_s: float
    again: bool
    contradicts: bool


def tail_yaw(runs: Runs, seed: int, gyro: float = 1.0) -> tuple[Places, Places]:
    """The tail's averaged yaw rate, its cycles off by a part of a cycle that is drawn for each run; as the head's."""
    random = np.random.Generator(np.random.SFC64(np.random.SeedSequence(seed, spawn_key=(2**30,))))
    skew_s = CYCLE_S * random.random((len(runs.ends), 1))
    speed = runs.speed_m_s.astype(np.float64)
    tail_m = runs.head_m - SENSORS_APART_M
    plain, skewed = (
        tracks.read(runs.track.curvature_per_m, tracks.spots(runs.track, place_m)) * speed * 1e6
        for place_m in (tail_m, tail_m + skew_s * speed)
    )
    errors = runs.tail_yaw.numbers - plain
    return averaged(np.asarray(np.rint(skewed + gyro * errors).astype(np.int64)), runs.tail_yaw.valid)


def lengths(plan: Registering, rides: Sequence[Ridden], most: int, seed: int, gyro: float = 1.0) -> list[Measured]:
    """Measure the length at the first so many features where both ends find the curve (P4)."""
    found: list[Measured] = []
    apart_mm = round(1000 * SENSORS_APART_M)
    for each in rides:
        runs = each.runs
        known: dict[int, Length] = {}
        head, tail = measured_yaw(runs, gyro), tail_yaw(runs, seed, gyro)
        for point, one in enumerate(awaited(plan, runs, runs.track.features)):
            if len(found) >= most:
                return found
            first = looked_for(each, one, *head)
            second = looked_for(each, one, *tail, shift_mm=apart_mm)
            if first.fixed and second.fixed:
                before = known.get(one.run, UNMEASURED)
                passes = passings(runs, point, one.run, first.found, second.found)
                known[one.run] = noted(before, passes)
                found.append(measured(passes, before.measured, machine.contradicts_itself(known[one.run])))
    return found


def passings(runs: Runs, point: int, run: int, head: int, tail: int) -> list[Passing]:
    """The two passes, from the cycles in which head and tail found the curve's end (P4)."""
    return [
        Passing(
            kind=PointKind.FEATURE,
            point=point,
            time_ms=CYCLE_MS * cycle,
            known=True,
            front_least_mm=int(runs.way_mm[run, cycle]),
            front_most_mm=int(runs.way_mm[run, cycle]),
            speed_most_mm_s=int(runs.speed_mm_s[run, cycle]),
        )
        for cycle in (head, tail)
    ]


def noted(state: Length, passes: Sequence[Passing]) -> Length:
    """Tell the kernel of the head's pass, and of the tail's."""
    head, tail = passes
    return machine.note_tail_pass(BOUNDS, machine.note_head_pass(BOUNDS, state, head), tail)


def measured(passes: Sequence[Passing], again: bool, contradicts: bool) -> Measured:
    """Let the kernel measure by these two passes alone (P4)."""
    head, tail = passes
    raw_mm = tail.front_most_mm - head.front_least_mm + BOUNDS.last_vehicle_mm
    used_mm = machine.length_mm(BOUNDS, noted(UNMEASURED, passes))
    return Measured(raw_mm / 1000, used_mm / 1000, tail.speed_most_mm_s / 1000, again, contradicts)


@dataclass(frozen=True)
class Budget:
    """The errors of table 2 at one speed, in m; added linearly, as the paper does."""

    sampling_m: float
    skew_m: float
    averaging_m: float
    sensor_m: float
    total_m: float


def budget(speed_km_h: float) -> Budget:
    """Table 2 at any speed, by the kernel's arithmetic (P8)."""
    speed_mm_s = round(speed_km_h / 0.0036)
    cycle_m = cycle_way_mm(speed_mm_s) / 1000
    total_m = machine.error_mm(BOUNDS, PointKind.FEATURE, speed_mm_s) / 1000
    return Budget(cycle_m, cycle_m, AVERAGING_MM / 1000, SENSOR_MM / 1000, total_m)
