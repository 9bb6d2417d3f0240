"""How trams bunch over days, with departure hold and without it: the intervals between them, stop by stop (G4)."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from kernel.tram.dispatching import DispatchLimits
from models.tram import tally
from models.tram.days import one_day
from models.tram.gps import Floats
from models.tram.line import BRANCH, Whole

WATCHED = BRANCH - 2
"""The stop at which intervals are told in one figure: far on, where all trams still run."""
FAULTLESS = frozenset[str]()


@dataclass(frozen=True)
class Days:
    """Some days: what was counted, and when each run left each stop, in s."""

    rows: Whole
    logs: tuple[Whole, ...]
    stops_mm: Whole

    def sum_of(self, name: str) -> int:
        """What a column sums up to."""
        return int(self.rows[:, tally.COLUMNS.index(name)].sum())

    def intervals_s(self, stop: int) -> list[Floats]:
        """The intervals between departures at a stop, by day."""
        return [np.diff(np.sort(log[log[:, stop] >= 0, stop])).astype(np.float64) for log in self.logs]

    def spread(self, stop: int) -> float:
        """The deviation of the intervals from what they are around that time, over their mean; by day, then the mean.

        What the timetable changes itself, from peak to off-peak, is taken out: each against those of an hour.
        """
        return float(np.mean([deviation(each) for each in self.intervals_s(stop)]))

    def bunched(self, stop: int, below_s: int = 60) -> tuple[int, int]:
        """How many departures follow another within a minute, and of how many."""
        each = np.concatenate(self.intervals_s(stop))
        return int((each < below_s).sum()), int(each.size)

    def rides_s(self) -> float:
        """How long a run takes from the first stop to the watched one, in the mean."""
        took = [
            (log[:, WATCHED] - log[:, 0])[(log[:, WATCHED] >= 0) & (log[:, 0] >= 0)].astype(np.float64)
            for log in self.logs
        ]
        return float(np.mean(np.concatenate(took)))

    def waits_s(self, stop: int) -> float:
        """How long a passenger waits who comes at any moment: half of the mean square of intervals over their mean."""
        each = np.concatenate(self.intervals_s(stop))
        return float(np.mean(each * each) / (2 * np.mean(each)))


def deviation(intervals_s: Floats, around: int = 12) -> float:
    """The deviation of intervals from the mean of so many around each, over the mean of all."""
    mean = np.convolve(intervals_s, np.ones(around) / around, mode="same")
    middle = slice(around, -around)
    return float(np.sqrt(np.mean((intervals_s[middle] - mean[middle]) ** 2)) / np.mean(intervals_s[middle]))


def days(seed: int, count: int, limits: DispatchLimits, present: frozenset[str] | None = FAULTLESS) -> Days:
    """Simulate some days; the same days for all limits."""
    found = [one_day(seed, number, limits, present) for number in range(count)]
    return Days(
        rows=np.stack([row for row, _, _ in found]),
        logs=tuple(log for _, _, log in found),
        stops_mm=found[0][1].stops_mm,
    )
