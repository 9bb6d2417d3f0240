"""The wheel against the rail: creep in proportion to the force, and slip or slide beyond it (P1).

A rolling wheel creeps by some tenths of a per cent as it transmits force.  Beyond the adhesion's peak it
runs away: its acceleration jumps, from one cycle to the next, by the jolt.  Re-adhesion control or slide
protection catches it, lets it run away again, and so on until adhesion is back: its speed swings about.
"""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np

from models.sensors.draws import Singles
from models.sensors.dynamics import ADHESION
from models.sensors.faults import CYCLE_S, GRAVITY_M_S2, Floats

SLIDES_FROM_M_S = 3.0
"""Ours: slide protection is cut out, and brakes are weak, near a standstill; a slide begins above this."""
FULL_M_S2 = ADHESION * GRAVITY_M_S2
"""The acceleration at which the creep is at its largest: all axles driven and braked alike (ours)."""


def wheel_speed_m_s(speed: Singles, gain: Singles, values: Mapping[str, Floats]) -> Singles:
    """The speed of the measured wheel's rim, shape (runs, cycles) (P1)."""
    creep = (values["creep_ppm"] * 1e-6 / FULL_M_S2).astype(np.float32)[:, None]
    wheel = gain * creep
    wheel += 1
    wheel *= speed
    at = values["slip_at_s"]
    for row in np.flatnonzero(at < speed.shape[1] * CYCLE_S):
        first, lasts = int(at[row] / CYCLE_S), max(2, int(values["slip_lasts_s"][row] / CYCLE_S))
        if values["slip_speed_m_s"][row] < 0:
            fast = np.flatnonzero(speed[row, first:] > SLIDES_FROM_M_S)
            if not len(fast):
                continue
            first += int(fast[0])
        end = min(first + lasts, speed.shape[1])
        wheel[row, first:end] += difference_m_s(
            end - first, lasts, values["slip_jolt_m_s2"][row], values["slip_speed_m_s"][row]
        )
    np.maximum(wheel, 0, out=wheel)
    return wheel


def difference_m_s(cycles: int, lasts: int, jolt: float, most: float) -> Floats:
    """How much faster or slower the wheel is in each cycle of a slip: away by the jolt and back, again and again.

    It goes as far as ``most``, at least two cycles of the jolt, and is back after ``lasts`` cycles: valves and
    wheels swing at 2.5 Hz at the most (ours).
    """
    count = np.arange(1, cycles + 1)
    swing = max(2, round(abs(most) / (jolt * CYCLE_S)))
    away = swing - np.abs((count % (2 * swing)) - swing)
    return np.asarray(np.copysign(np.minimum(away, lasts - count) * (jolt * CYCLE_S), most))
