"""How trains truly run: many at once, each with its driver; and the tail, should it come off (P1, P5).

The driver accelerates, coasts near the allowed speed, brakes for curves and stops, and stays at stops.
Speed is linear and acceleration constant within a cycle, so the way is the trapezoid, exactly.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

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
    runs, last, jerk = len(share), len(track.allowed_m_s) - 1, JERK_M_S3 * CYCLE_S
    speeds, limits = np.empty((cycles, runs), np.float32), track.allowed_m_s.astype(np.float64)
    head = np.full(runs, length_m + START_M)
    speed, gain, stays, regarded_m = np.zeros(runs), np.zeros(runs), np.zeros(runs), head.copy()
    for cycle in range(cycles):
        ahead = speed * LOOK_S
        ahead += head
        np.maximum(ahead, regarded_m, out=ahead)
        ahead *= 1 / GRID_M
        np.minimum(ahead, last, out=ahead)
        allowed = limits.take(ahead.astype(np.intp))
        allowed *= share
        waits = speed < STANDS_M_S
        waits &= allowed < STANDS_M_S
        waits |= (speed == 0) & (allowed < COAST_M_S)
        waits |= stays > 0
        stays += waits
        over = np.subtract(speed, allowed, out=allowed)
        wanted = traction * (over <= -COAST_M_S)
        np.copyto(wanted, braking, where=waits | (over > 0))
        wanted -= gain
        np.maximum(wanted, -jerk, out=wanted)
        np.minimum(wanted, jerk, out=wanted)
        gain += wanted
        after = gain * CYCLE_S
        after += speed
        np.maximum(after, 0.0, out=after)
        np.subtract(after, speed, out=gain)
        gain /= CYCLE_S
        speed += after
        speed *= 0.5 * CYCLE_S
        head += speed
        speed = after
        leaves = stays > dwell_cycles
        if leaves.any():
            stays[leaves] = 0
            regarded_m[leaves] = head[leaves] + AWAY_M
        speeds[cycle] = speed
    speed_m_s = np.ascontiguousarray(speeds.T)
    for row in np.flatnonzero(values["rolls_back_at_s"] < cycles * CYCLE_S):
        roll_back(speed_m_s[row], int(values["rolls_back_at_s"][row] / CYCLE_S), values["rolls_back_m"][row])
    return moved(speed_m_s, values, length_m + START_M)


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
