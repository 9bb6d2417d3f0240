"""The tachometer: pulses of a wheel, counted as a way, and their period as a speed (P1).

The unit reckons with the wheel's nominal diameter; the true one differs.  Speed is pulses over the time
from the last pulse before this cycle to the last one in it, by a timer: so it is the mean over about one
cycle, half a cycle old; below 0 if the wheel turns back.  In a cycle without a pulse it is what it was, or a
pulse over the time since the last one if that is less; once the timer overflows it is 0 (ours).

Rides measure whole runs at once (:func:`measure`); where a train's motion is not known beforehand there is the same
tachometer a cycle at a time (:func:`counted`).  A test holds the two to each other.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from models.sensors.draws import Singles
from models.sensors.dynamics import Bools
from models.sensors.faults import CYCLE_S, Floats

PULSE_M = 0.045
"""Ours, typical: 60 pulses a turn of a wheel of 860 mm."""
WHEEL_MM = 860.0
"""A new wheel, nominal."""
TIMER_S = 1e-5
"""Ours, typical of a counter at 100 kHz."""
OVERFLOW_TICKS = 65_535
"""Ours: 16 bits, so that a wheel slower than 69 mm/s reads 0."""
CYCLE_TICKS = round(CYCLE_S / TIMER_S)
STICKS_FROM_M_S = 0.5
"""A little more than a pulse a cycle: slower, its own test finds that it repeats itself."""


Cycles = NDArray[np.int32]


@dataclass(frozen=True)
class Tachometer:
    """What the tachometer says, shape (runs, cycles): way since power-on and speed, both by the nominal wheel."""

    way_m: Floats
    speed_m_s: Singles
    valid: Bools


class Pulses(NamedTuple):
    """One tachometer at the end of a cycle.

    ``turned``: pulses since power-on, and the part of the next one; ``came``: those that have come.
    ``since_ticks``: so long before the end of the cycle the last one came.  ``held_m_s``: the speed by the last pulse.
    """

    turned: float = 0.0
    came: int = 0
    since_ticks: int = OVERFLOW_TICKS
    held_m_s: float = 0.0


def counted(before: Pulses, pulses: float) -> Pulses:
    """Take a cycle in which the wheel turns by so many pulses, evenly (P1)."""
    turned = before.turned + pulses
    came = math.floor(turned)
    if came == before.came:
        return Pulses(turned, came, min(before.since_ticks + CYCLE_TICKS, OVERFLOW_TICKS), before.held_m_s)
    past = turned - came if pulses >= 0 else came + 1 - turned
    since_ticks = min(int(past / max(abs(pulses) * TIMER_S / CYCLE_S, 1e-9)), CYCLE_TICKS)
    spent_ticks = max(1, CYCLE_TICKS - since_ticks + before.since_ticks)
    return Pulses(turned, came, since_ticks, (came - before.came) * PULSE_M / TIMER_S / spent_ticks)


def shown_m_s(before: Pulses, now: Pulses) -> float:
    """Give the speed that it shows at the end of a cycle (P1)."""
    if now.came != before.came:
        return now.held_m_s
    if now.since_ticks >= OVERFLOW_TICKS:
        return 0.0
    most_m_s = PULSE_M / TIMER_S / max(1, now.since_ticks)
    return max(-most_m_s, min(now.held_m_s, most_m_s))


def measure(wheel_m_s: Singles, values: Mapping[str, Floats]) -> Tachometer:
    """Count the pulses of wheels that turn with these rim speeds, shape (runs, cycles) (P1)."""
    pulses_a_m = 1 / (PULSE_M * (1 + values["diameter_ppm"] * 1e-6 + values["diameter_entered_mm"] / WHEEL_MM))
    turned = np.empty(wheel_m_s.shape)
    turned[:, :1] = wheel_m_s[:, :1] * 0.5
    np.add(wheel_m_s[:, 1:], wheel_m_s[:, :-1], out=turned[:, 1:])
    turned[:, 1:] *= 0.5
    _miscount(turned, values)
    np.cumsum(turned[:, 1:], axis=1, out=turned[:, 1:])
    turned[:, 1:] += turned[:, :1]
    turned *= (pulses_a_m * CYCLE_S)[:, None]
    count = np.floor(turned)
    came = _came(count)
    speed = _speed(came, _since_last_pulse(turned, count, came))
    count *= PULSE_M
    valid = np.ones(wheel_m_s.shape, np.bool_)
    reading = Tachometer(count, speed, valid)
    _fail(reading, values)
    return reading


def _miscount(turned: Floats, values: Mapping[str, Floats]) -> None:
    """Lose a share of the pulses of some cycles, or count so many too many."""
    cycles = turned.shape[1]
    for name, sign in (("lost", -1), ("extra", 1)):
        for row in np.flatnonzero(values[f"pulses_{name}_at_s"] < cycles * CYCLE_S):
            first = int(values[f"pulses_{name}_at_s"][row] / CYCLE_S)
            end = first + int(values[f"pulses_{name}_s"][row] / CYCLE_S)
            turned[row, first:end] *= 1 + sign * values[f"pulses_{name}_share"][row]


def _came(count: Floats) -> Singles:
    """How many pulses came in each cycle."""
    came = np.empty(count.shape, np.float32)
    came[:, :1] = count[:, :1]
    np.subtract(count[:, 1:], count[:, :-1], out=came[:, 1:], casting="same_kind")
    return came


def _last_pulse(came: Singles) -> Cycles:
    """The cycle in which the last pulse came so far, -1 before the first."""
    cycles = np.arange(came.shape[1], dtype=np.int32)
    found = np.where(came != 0, cycles, np.int32(-1))
    return np.maximum.accumulate(found, axis=1, out=found)


def _since_last_pulse(turned: Floats, count: Floats, came: Singles) -> Singles:
    """How long before the end of each cycle the last pulse came, in timer ticks, till the timer overflows.

    The wheel is taken to turn evenly within a cycle.
    """
    since = (turned - count).astype(np.float32)
    rate = np.empty(turned.shape, np.float32)
    rate[:, :1] = turned[:, :1]
    np.subtract(turned[:, 1:], turned[:, :-1], out=rate[:, 1:], casting="same_kind")
    np.subtract(1, since, out=since, where=rate < 0)
    np.abs(rate, out=rate)
    rate *= np.float32(TIMER_S / CYCLE_S)
    np.maximum(rate, np.float32(1e-9), out=rate)
    since /= rate
    np.floor(since, out=since)
    np.minimum(since, np.float32(CYCLE_TICKS), out=since)
    rows, columns = np.nonzero(came == 0)
    last = _last_pulse(came)[rows, columns]
    waits = since[rows, np.maximum(last, 0)] + np.float32(CYCLE_TICKS) * (columns - last)
    since[rows, columns] = np.where(last < 0, np.float32(OVERFLOW_TICKS), waits)
    return np.minimum(since, np.float32(OVERFLOW_TICKS), out=since)


def _speed(came: Singles, since: Singles) -> Singles:
    """Pulses over the time that they took; without one the last speed, or less by how long none has come."""
    ticks = np.float32(CYCLE_TICKS) - since
    ticks[:, :1] += np.float32(OVERFLOW_TICKS)
    ticks[:, 1:] += since[:, :-1]
    np.maximum(ticks, np.float32(1), out=ticks)
    speed = came * np.float32(PULSE_M / TIMER_S)
    speed /= ticks
    rows, columns = np.nonzero((came == 0) & (since < OVERFLOW_TICKS))
    held = speed[rows, _last_pulse(came)[rows, columns]]
    most = np.float32(PULSE_M / TIMER_S) / since[rows, columns]
    speed[rows, columns] = np.clip(held, -most, most)
    return speed


def _fail(reading: Tachometer, values: Mapping[str, Floats]) -> None:
    """Silence, which its diagnosis finds, and repetition of the last value, which it does not; that of a fast wheel."""
    cycles = reading.way_m.shape[1]
    for at, lasts, silent in (
        (values["tachometer_silent_at_s"], values["tachometer_silent_s"], True),
        (values["tachometer_stuck_at_s"], values["tachometer_stuck_s"], False),
    ):
        for row in np.flatnonzero(at < cycles * CYCLE_S):
            first = max(1, int(at[row] / CYCLE_S))
            if not silent:
                turning = np.flatnonzero(reading.speed_m_s[row, first - 1 :] > STICKS_FROM_M_S)
                if not len(turning):
                    continue
                first += int(turning[0])
            end = first + max(1, int(lasts[row] / CYCLE_S))
            reading.way_m[row, end:] -= reading.way_m[row, min(end, cycles) - 1] - reading.way_m[row, first - 1]
            reading.way_m[row, first:end] = reading.way_m[row, first - 1]
            reading.speed_m_s[row, first:end] = 0 if silent else reading.speed_m_s[row, first - 1]
            reading.valid[row, first:end] = not silent
