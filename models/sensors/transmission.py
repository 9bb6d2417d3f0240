"""Telegrams from the tail to the head: delayed, lost and repeated (P5, P6).

One telegram a cycle.  What is not acknowledged is sent again a cycle later, twice at most; then it is
lost.  In an outage nothing comes through.  The head keeps the newest; an older one that comes later is no news.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from models.sensors.draws import Draws
from models.sensors.dynamics import Bools
from models.sensors.faults import CYCLE_S
from models.sensors.track import Ints

SENDINGS = 3
"""Ours: sent, and repeated twice."""


@dataclass(frozen=True)
class Link:
    """What the head has of the tail, shape (runs, cycles).

    ``source``: the cycle in which the newest telegram here was measured, -1 before any.
    ``arrived``: it came in this cycle.
    """

    source: Ints
    arrived: Bools


def transmit(draws: Draws, cycles: int) -> Link:
    """Send a telegram in each cycle from the tail to the head (P5).

    Of the 16 random bits a telegram, below p means the first sending is lost, below p² the second too, and so on.
    """
    values, runs = draws.values, len(draws.sendings)
    loss = values["loss"]
    delay = np.maximum(1, np.rint(values["delay_s"] / CYCLE_S)).astype(np.int32)
    arrival = np.broadcast_to(delay[:, None] + np.arange(cycles, dtype=np.int32), (runs, cycles)).copy()
    for power in range(1, SENDINGS):
        arrival += draws.sendings < (65_536 * loss**power).astype(np.uint16)[:, None]
    lost = draws.sendings < (65_536 * loss**SENDINGS).astype(np.uint16)[:, None]
    for row in np.flatnonzero(values["radio_out_at_s"] < cycles * CYCLE_S):
        first = int(values["radio_out_at_s"][row] / CYCLE_S)
        end = first + int(values["radio_out_s"][row] / CYCLE_S)
        lost[row] |= (first <= arrival[row]) & (arrival[row] < end)
    arrival[lost | (arrival >= cycles)] = cycles
    newest = np.full((runs, cycles + 1), -1, np.int32)
    arrival += (np.arange(runs, dtype=np.int32) * (cycles + 1))[:, None]
    newest.reshape(-1)[arrival] = np.arange(cycles, dtype=np.int32)
    source = np.maximum.accumulate(newest[:, :-1], axis=1)
    arrived = np.empty(source.shape, np.bool_)
    arrived[:, 0] = source[:, 0] >= 0
    np.greater(source[:, 1:], source[:, :-1], out=arrived[:, 1:])
    return Link(source, arrived)
