"""The tachometer: pulses of a wheel, counted as a way, and their period as a speed (P1).

The unit reckons with the wheel's nominal diameter; the true one differs.  Speed is pulses over the time
between the last pulse of the cycle before and the last of this one, by a timer: so it is the mean over
about one cycle, half a cycle old.  A cycle without a pulse reads 0 (ours).
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from models.sensors.draws import Singles
from models.sensors.dynamics import Bools
from models.sensors.faults import CYCLE_S, Floats

PULSE_M = 0.045
"""Ours, typical: 60 pulses a turn of a wheel of 860 mm."""
TIMER_S = 1e-5
"""Ours, typical of a counter at 100 kHz."""


@dataclass(frozen=True)
class Tachometer:
    """What the tachometer says, shape (runs, cycles): way since power-on and speed, both by the nominal wheel."""

    way_m: Floats
    speed_m_s: Singles
    valid: Bools


def measure(wheel_m_s: Singles, values: Mapping[str, Floats]) -> Tachometer:
    """Count the pulses of wheels that turn with these rim speeds, shape (runs, cycles) (P1)."""
    pulses_a_m = 1 / (PULSE_M * (1 + values["diameter_ppm"] * 1e-6))
    turned = np.empty(wheel_m_s.shape)
    turned[:, :1] = wheel_m_s[:, :1] * 0.5
    np.add(wheel_m_s[:, 1:], wheel_m_s[:, :-1], out=turned[:, 1:])
    np.cumsum(turned[:, 1:] * 0.5, axis=1, out=turned[:, 1:])
    turned[:, 1:] += turned[:, :1]
    turned *= (pulses_a_m * CYCLE_S)[:, None]
    count = np.floor(turned)
    since = _since_last_pulse(turned, count)
    speed = _speed(count, since)
    count *= PULSE_M
    valid = np.ones(wheel_m_s.shape, np.bool_)
    reading = Tachometer(count, speed, valid)
    _fail(reading, values)
    return reading


def _since_last_pulse(turned: Floats, count: Floats) -> Singles:
    """How long before the end of each cycle the last pulse came, in timer ticks, a cycle at most.

    The wheel is taken to turn evenly within a cycle.
    """
    since = (turned - count).astype(np.float32)
    rate = np.empty(turned.shape, np.float32)
    rate[:, :1] = turned[:, :1]
    np.subtract(turned[:, 1:], turned[:, :-1], out=rate[:, 1:], casting="same_kind")
    rate *= np.float32(TIMER_S / CYCLE_S)
    np.maximum(rate, np.float32(1e-9), out=rate)
    since /= rate
    np.floor(since, out=since)
    return np.minimum(since, np.float32(round(CYCLE_S / TIMER_S)), out=since)


def _speed(count: Floats, since: Singles) -> Singles:
    """Pulses of a cycle over the time from the last one before it to the last one in it."""
    cycle_ticks = np.float32(round(CYCLE_S / TIMER_S))
    came = np.empty(count.shape, np.float32)
    came[:, :1] = count[:, :1]
    np.subtract(count[:, 1:], count[:, :-1], out=came[:, 1:], casting="same_kind")
    ticks = cycle_ticks - since
    ticks[:, 1:] += since[:, :-1]
    np.maximum(ticks, np.float32(1), out=ticks)
    came *= np.float32(PULSE_M / TIMER_S)
    came /= ticks
    return came


def _fail(reading: Tachometer, values: Mapping[str, Floats]) -> None:
    """Silence, which its diagnosis finds, and repetition of the last value, which it does not; that while it turns."""
    cycles = reading.way_m.shape[1]
    for at, lasts, silent in (
        (values["tachometer_silent_at_s"], values["tachometer_silent_s"], True),
        (values["tachometer_stuck_at_s"], values["tachometer_stuck_s"], False),
    ):
        for row in np.flatnonzero(at < cycles * CYCLE_S):
            first = max(1, int(at[row] / CYCLE_S))
            if not silent:
                turning = np.flatnonzero(reading.speed_m_s[row, first - 1 :] > 0)
                if not len(turning):
                    continue
                first += int(turning[0])
            end = first + max(1, int(lasts[row] / CYCLE_S))
            reading.way_m[row, end:] -= reading.way_m[row, min(end, cycles) - 1] - reading.way_m[row, first - 1]
            reading.way_m[row, first:end] = reading.way_m[row, first - 1]
            reading.speed_m_s[row, first:end] = 0 if silent else reading.speed_m_s[row, first - 1]
            reading.valid[row, first:end] = not silent
