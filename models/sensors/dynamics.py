"""How trains truly run: many at once, each with its driver; and the tail, should it come off (P1, P5).

The driver accelerates, coasts near the allowed speed, brakes for curves and stops, and stays at stops.
Speed is linear and acceleration constant within a cycle, so the way is the trapezoid, exactly.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from models.compiled import compiled
from models.sensors.draws import Singles
from models.sensors.faults import CYCLE_S, GRAVITY_M_S2, Floats
from models.sensors.track import GRID_M, Track

Bools = npt.NDArray[np.bool_]

JERK_M_S3 = 0.8
"""Ours, typical of traction and brake control for comfort: 0.6 to 1.0."""
COAST_M_S = 1.5
"""Ours: within so much of the allowed speed a driver neither accelerates nor brakes."""
ADHESION = 0.16
"""Ours: adhesion that traction control and slide protection leave, on wet rails at least 0.1."""
START_M = 50.0
"""Where the head stands at the beginning, beyond the train's own length (added)."""
STANDS_M_S = 0.6
"""Below this, where no more is allowed, the driver brakes to a standstill and stays.

A train that came to stand a little short, where so little is allowed that it would not start again, stays as well.
"""
AWAY_M = 4.0
"""Ours: having stayed at a stop, the driver looks only beyond it."""
ROLLS_M_S2 = 0.3
"""Ours: gravity on an ascent of 30 per mille."""
LOOK_S = 0.8
"""Ours: how far ahead a driver looks, since the brake takes that long to build up."""


@dataclass(frozen=True)
class Motion:
    """The truth; all of shape (runs, cycles), at the end of each cycle.

    ``head_m``: where the head is.  ``gap_m``: by how much the tail is behind its place.
    ``acceleration_m_s2``: over the cycle that ends.
    """

    head_m: Floats
    speed_m_s: Singles
    acceleration_m_s2: Singles
    tail_gap_m: Singles
    tail_speed_m_s: Singles
    tail_acceleration_m_s2: Singles


def run(track: Track, values: Mapping[str, Floats], cycles: int, length_m: float) -> Motion:
    """Let trains run from a standstill near the line's beginning for some cycles (P1)."""
    share, dwell_cycles = values["driver_share"], values["dwell_s"] / CYCLE_S
    traction = np.minimum(values["traction_m_s2"], ADHESION * GRAVITY_M_S2)
    braking = -np.minimum(values["braking_m_s2"], ADHESION * GRAVITY_M_S2)
    speed_m_s = np.empty((len(share), cycles), np.float32)
    drive(track.allowed_m_s.astype(np.float64), share, traction, braking, dwell_cycles, length_m + START_M, speed_m_s)
    for row in np.flatnonzero(values["rolls_back_at_s"] < cycles * CYCLE_S):
        roll_back(speed_m_s[row], int(values["rolls_back_at_s"][row] / CYCLE_S), values["rolls_back_m"][row])
    return moved(speed_m_s, values, length_m + START_M)


@compiled
def drive(
    limits_m_s: Floats,
    shares: Floats,
    tractions_m_s2: Floats,
    brakings_m_s2: Floats,
    dwells_cycles: Floats,
    start_m: float,
    speeds_m_s: Singles,
) -> None:
    """Write each run's speed at the end of each cycle: one train after the other, each by its driver (P1)."""
    last, most_change = len(limits_m_s) - 1, JERK_M_S3 * CYCLE_S
    for row in range(len(shares)):
        head_m, regarded_m, speed, gain, stays = start_m, start_m, 0.0, 0.0, 0
        for cycle in range(speeds_m_s.shape[1]):
            looks_m = max(head_m + speed * LOOK_S, regarded_m)
            allowed = limits_m_s[int(min(looks_m * (1 / GRID_M), last))] * shares[row]
            held = (speed < STANDS_M_S and allowed < STANDS_M_S) or (speed == 0.0 and allowed < COAST_M_S)
            waits = held or stays > 0
            stays += waits
            if waits or speed > allowed:
                wanted = brakings_m_s2[row]
            else:
                wanted = tractions_m_s2[row] if speed - allowed <= -COAST_M_S else 0.0
            gain += min(max(wanted - gain, -most_change), most_change)
            after = max(gain * CYCLE_S + speed, 0.0)
            gain = (after - speed) / CYCLE_S
            head_m += (speed + after) * (0.5 * CYCLE_S)
            speed = after
            if stays > dwells_cycles[row]:
                stays, regarded_m = 0, head_m + AWAY_M
            speeds_m_s[row, cycle] = speed


def back_m_s(way_m: float) -> Floats:
    """How fast a train runs in each cycle in which it rolls back so far: ever faster, then ever slower, below 0."""
    half = max(1, round(float(np.sqrt(way_m / ROLLS_M_S2)) / CYCLE_S))
    count = np.arange(1, 2 * half + 1)
    return (np.abs(count - half) - half) * (way_m / (half * half * CYCLE_S))


def roll_back(speed_m_s: Singles, first: int, way_m: float) -> None:
    """Let one run roll back before its first start from a cycle on, and do later what it does, in place (T5)."""
    starts = np.flatnonzero((speed_m_s[first:-1] == 0) & (speed_m_s[first + 1 :] > 0))
    if len(starts):
        at = first + int(starts[0]) + 1
        speed_m_s[at:] = np.concatenate([back_m_s(way_m), speed_m_s[at:]])[: len(speed_m_s) - at]


def moved(speed: Singles, values: Mapping[str, Floats], start_m: float) -> Motion:
    """The whole motion from the head's speeds; the tail's is the same, a lag later, until it comes off (P5)."""
    gain = speed.copy()
    np.subtract(speed[:, 1:], speed[:, :-1], out=gain[:, 1:])
    gain *= np.float32(1 / CYCLE_S)
    head_m = speed.astype(np.float64)
    head_m[:, 1:] += speed[:, :-1]
    head_m *= CYCLE_S / 2
    np.cumsum(head_m, axis=1, out=head_m)
    head_m += start_m
    tail_gain = later(gain, values["lag_s"])
    tail_speed, gap = speed, np.zeros_like(speed)
    at = values["split_at_s"]
    parted = np.flatnonzero(at < head_m.shape[1] * CYCLE_S)
    if len(parted):
        tail_speed = speed.copy()
        for row in parted:
            part(int(row), at[row], values["split_slows_m_s2"][row], speed, tail_speed, tail_gain, gap)
    return Motion(head_m, speed, gain, gap, tail_speed, tail_gain)


def later(values: Singles, lag_s: Floats) -> Singles:
    """Shift each run by its lag, in whole cycles; before it, nothing."""
    lags = np.rint(lag_s / CYCLE_S).astype(np.int64)
    if not lags.any():
        return values.copy()
    shifted = np.zeros_like(values)
    cycles = values.shape[1]
    for lag in np.unique(lags):
        rows = np.flatnonzero(lags == lag)
        shifted[rows, min(lag, cycles) :] = values[rows, : max(0, cycles - lag)]
    return shifted


def part(row: int, at_s: float, slows: float, speed: Singles, tail_speed: Singles, gain: Singles, gap: Singles) -> None:
    """Let the tail of one run come off and slow down evenly to a standstill, written into the arrays (P5)."""
    first = max(1, int(at_s / CYCLE_S))
    since_s = np.arange(1, speed.shape[1] - first + 1) * CYCLE_S
    before = speed[row, first - 1]
    tail_speed[row, first:] = np.maximum(before - slows * since_s, 0).astype(np.float32)
    gain[row, first:] = np.diff(tail_speed[row, first - 1 :]) / np.float32(CYCLE_S)
    behind = speed[row].astype(np.float64) - tail_speed[row]
    gap[row, 1:] = np.cumsum((behind[1:] + behind[:-1]) / 2 * CYCLE_S)


def slope_m_s2(gradient: Singles) -> Singles:
    """Gravity along the track, g sin θ, from the gradient as a tangent; uphill above 0 (P1)."""
    return np.asarray(np.float32(GRAVITY_M_S2) * gradient / np.sqrt(1 + gradient * gradient))
