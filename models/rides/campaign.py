"""Campaigns of rides: batches on lines of their own, over as many processes as wanted, and what they come to.

A ride is the same whatever campaign it is in: its line goes by its batch, its faults by its number.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np

from models.processes import spread
from models.rides.plan import CYCLES, LENGTH_MM, LINE_M, READER
from models.rides.tally import COLUMNS, FAULTS, Numbers
from models.sensors.traces import Setup, traces
from models.sensors.track import line

RUNS_A_BATCH = 128
"""So many rides share a line, and are made together."""


@dataclass(frozen=True)
class Batch:
    """Some rides by their numbers; ``beyond``: faults drawn from beyond their declared range."""

    seed: int
    number: int
    rides: int
    beyond: tuple[str, ...] = ()


def ridden(batch: Batch) -> Numbers:
    """Make a batch and ride it; a row for each ride, a column for each of ``COLUMNS``."""
    from models.rides.approach import approach
    from models.rides.onboard import LOCATED
    from models.rides.ride import ride
    from models.rides.trace import endings_of, faults_of, traces_of

    track = line(batch.seed * 1_000_003 + batch.number, LINE_M)
    first = batch.number * RUNS_A_BATCH
    setup = Setup(track, cycles=CYCLES, length_m=LENGTH_MM / 1000, beyond=batch.beyond, reader=READER)
    made = traces(setup, batch.seed, range(first, first + batch.rides))
    out = np.zeros((batch.rides, len(COLUMNS)), np.int64)
    out[:, FAULTS] = faults_of(made)
    for trace, ending, row in zip(traces_of(made, track), endings_of(made), out, strict=True):
        cycle, computer = ride(trace, row)
        if cycle < trace.parted_at and computer.known.motion.loss == LOCATED:
            approach(computer, trace.head_m[cycle], trace.speed_m_s[cycle], ending, row)
    return out


def batches(seed: int, rides: int, beyond: str = "") -> list[Batch]:
    """Cut a campaign into batches; ``beyond``: the fault that is drawn from beyond its declared range, if any."""
    return [
        Batch(seed, start // RUNS_A_BATCH, min(RUNS_A_BATCH, rides - start), (beyond,) if beyond else ())
        for start in range(0, rides, RUNS_A_BATCH)
    ]


def ride_all(
    seed: int,
    rides: int,
    jobs: int,
    campaigns: Sequence[str] = ("",),
    progress: Callable[[int, int, str], object] = lambda done, total, what: None,
) -> dict[str, Numbers]:
    """Ride whole campaigns, each with one fault beyond its declared range, or none; a row for each ride, in order."""
    todo = [(fault, batch) for fault in campaigns for batch in batches(seed, rides, fault)]
    found: dict[str, list[Numbers]] = {fault: [] for fault in campaigns}
    done = 0
    for (fault, batch), rows in zip(todo, spread(ridden, [batch for _, batch in todo], jobs), strict=True):
        found[fault].append(rows)
        done += batch.rides
        progress(done, rides * len(campaigns), fault or "rides")
    return {fault: np.concatenate(rows) for fault, rows in found.items()}
