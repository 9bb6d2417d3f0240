"""Whole days of a crossing, a tram line or track workers as a target, with faults of their sensors and radios."""

from __future__ import annotations

import json
import time
from collections import Counter
from collections.abc import Mapping
from dataclasses import dataclass
from itertools import combinations

import numpy as np

from fuzz.targets.target import Batch, Result, digest_of_sources
from models.days.system import Numbers, System
from models.days.systems import system_of

DAYS_A_BATCH = 8
SECONDS_AN_HOUR = 3600
FORMAT = "heisoku trace 1"
NO_FAULT, NO_MONITOR = "no fault", "nothing"
PAIR = 1 << 16
"""Ids of tuples are below it; a pair's id is the first tuple's times this and the second's."""


@dataclass(frozen=True)
class Days:
    """Days of a system within the declared ranges: none may break a claim.

    A step is a second of traffic.  A tuple is a fault that a day had and a monitor that fired on it; a pair,
    two of these on one day.
    A day's faults follow from its number, so weights have no say.
    """

    system: str

    @property
    def name(self) -> str:
        """Days of what."""
        return f"days:{self.system}"

    def identity(self) -> Mapping[str, str]:
        """The sources, and how many days a batch has."""
        return {
            "sources": digest_of_sources("kernel", "models", "fuzz/targets/days.py"),
            "days a batch": str(DAYS_A_BATCH),
        }

    def describe(self, tuple_id: int) -> str:
        """Say a tuple in words: the fault and what was noticed."""
        system = system_of(self.system)
        fault, monitor = divmod(tuple_id, len(system.monitors) + 1)
        return f"{(NO_FAULT, *system.faults)[fault]}: {(NO_MONITOR, *system.monitors)[monitor]}"

    def families(self) -> tuple[str, ...]:
        """No families: each fault has its own chance, on every day."""
        return ()

    def run(self, batch: Batch) -> Result:
        """Simulate a batch; a day on which a claim was broken is a failure."""
        assert batch.target == self.name, batch
        began = time.perf_counter()
        system = system_of(self.system)
        first = batch.number * DAYS_A_BATCH
        rows = system.simulate(batch.seed, range(first, first + DAYS_A_BATCH))
        covered, pairs = coverage(system, rows)
        return Result(
            batch=batch,
            traces=len(rows),
            steps=int(SECONDS_AN_HOUR * system.hours) * len(rows),
            counts={name: int(rows[:, at].sum()) for at, name in enumerate(system.columns)},
            covered=covered,
            pairs=pairs,
            sketch=b"",
            failures=tuple(failures(system, batch, rows)),
            seconds=time.perf_counter() - began,
        )


def coverage(system: System, rows: Numbers) -> tuple[dict[int, int], dict[int, int]]:
    """Count tuples and pairs of them, in days."""
    had, fired = (
        rows[:, [system.columns.index(name) for name in names]] > 0 for names in (system.faults, system.monitors)
    )
    covered: Counter[int] = Counter()
    pairs: Counter[int] = Counter()
    for faults, monitors in zip(had, fired, strict=True):
        drawn = [int(place) + 1 for place in np.flatnonzero(faults)] or [0]
        noticed = [int(place) + 1 for place in np.flatnonzero(monitors)] or [0]
        tuples = sorted(fault * (len(system.monitors) + 1) + monitor for fault in drawn for monitor in noticed)
        covered.update(tuples)
        pairs.update(one * PAIR + other for one, other in combinations(tuples, 2))
    return dict(covered), dict(pairs)


def failures(system: System, batch: Batch, rows: Numbers) -> list[str]:
    """Write a trace for each day on which a claim was broken: its seed and number make the day again."""
    found = []
    for row, tally in enumerate(rows):
        broken = {name: int(tally[at]) for at, name in enumerate(system.columns) if name in system.claims and tally[at]}
        if broken:
            trace = {
                "format": FORMAT,
                "target": batch.target,
                "seed": batch.seed,
                "batch": batch.number,
                "day": batch.number * DAYS_A_BATCH + row,
                "planted": None,
                "violated": list(broken),
                "moments": broken,
            }
            found.append(json.dumps(trace))
    return found
