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
BRAKED_M_S2 = 0.2
"""A train that loses more is braked."""
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
    for row in np.flatnonzero(values["slow_slide_at_s"] < speed.shape[1] * CYCLE_S):
        of_row = {name: float(values[f"slow_slide_{name}"][row]) for name in ("at_s", "m_s2", "share", "s")}
        wheel[row] -= slow_slide_m_s(speed[row], gain[row], **of_row)
    np.copyto(wheel, 0, where=(wheel < 0) & (speed >= 0))
    return wheel


def slow_slide_m_s(speed: Singles, gain: Singles, at_s: float, m_s2: float, share: float, s: float) -> Singles:
    """How much slower the wheel of one run is in each cycle of a slide that begins without a jolt and is held.

    It begins as the train brakes, gets slower than its train by ``m_s2``, is held at a ``share`` below its speed, and
    comes back as it went, ``s`` after it began.
    """
    slower, first = np.zeros_like(speed), int(at_s / CYCLE_S)
    braked = np.flatnonzero((speed[first:] > SLIDES_FROM_M_S) & (gain[first:] < -BRAKED_M_S2))
    if len(braked):
        first += int(braked[0])
        since_s = np.arange(1, len(speed) - first + 1) * CYCLE_S
        away = np.minimum(m_s2 * since_s, m_s2 * np.maximum(s - since_s, 0))
        slower[first:] = np.minimum(away, share * speed[first:])
    return slower


def difference_m_s(cycles: int, lasts: int, jolt: float, most: float) -> Floats:
    """How much faster or slower the wheel is in each cycle of a slip: away by the jolt and back, again and again.

    It goes as far as ``most``, at least two cycles of the jolt, and is back after ``lasts`` cycles: valves and
    wheels swing at 2.5 Hz at the most (ours).
    """
    count = np.arange(1, cycles + 1)
    swing = max(2, round(abs(most) / (jolt * CYCLE_S)))
    away = swing - np.abs((count % (2 * swing)) - swing)
    return np.asarray(np.copysign(np.minimum(away, lasts - count) * (jolt * CYCLE_S), most))
