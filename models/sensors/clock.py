"""GPS time stamps: an offset, jitter, and in an outage a quartz that drifts (P4, P5).

In an outage the clock goes on by its quartz, and says that it does (``synchronous`` false).
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from models.sensors.draws import Draws, Singles
from models.sensors.dynamics import Bools
from models.sensors.faults import CYCLE_S, Floats

JITTER_STEPS = 128
"""Jitter is uniform, in so many steps to either side."""


@dataclass(frozen=True)
class Clock:
    """How far a clock is ahead of the true time at the end of each cycle, in ms, shape (runs, cycles)."""

    ahead_ms: Singles
    synchronous: Bools


def stamp(draws: Draws, place: int, cycles: int) -> Clock:
    """Stamp the end of each cycle by the clock of the head (0) or of the tail (1).

    The two have the drawn offset and drift in opposite directions: together the worst.
    """
    values: Mapping[str, Floats] = draws.values
    sign = 1.0 - 2.0 * place
    ahead = draws.jitter[:, place] * (values["clock_jitter_ms"] / JITTER_STEPS).astype(np.float32)[:, None]
    ahead += (sign * values["clock_offset_ms"]).astype(np.float32)[:, None]
    synchronous = np.ones(ahead.shape, np.bool_)
    for row in np.flatnonzero(values["clock_out_at_s"] < cycles * CYCLE_S):
        first = int(values["clock_out_at_s"][row] / CYCLE_S)
        end = min(cycles, first + int(values["clock_out_s"][row] / CYCLE_S))
        out_s = np.arange(1, end - first + 1) * CYCLE_S
        ahead[row, first:end] += (sign * values["clock_drift_ppm"][row] * 1e-3 * out_s).astype(np.float32)
        synchronous[row, first:end] = False
    return Clock(ahead, synchronous)
