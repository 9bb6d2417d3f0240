"""Rides with faulty sensors as a target: 64 a batch, what the machines on board claim held against the truth."""

from __future__ import annotations

import json
import time
from collections import Counter
from collections.abc import Mapping
from dataclasses import dataclass
from itertools import combinations

import numpy as np

from fuzz.targets.target import Batch, Result, digest_of_sources
from models.rides import campaign
from models.rides.plan import PLAN
from models.rides.tally import COLUMNS, CYCLES, MONITORS, VIOLATIONS, Numbers, outcome
from models.sensors.draws import choose
from models.sensors.faults import FAULTS

RIDES_A_BATCH = 64
FORMAT = "heisoku trace 1"
NO_FAULT, NO_MONITOR = "no fault", "nothing"
DRAWN = tuple(fault for fault in FAULTS if fault.chance < 1)
"""Faults that not every ride has."""
FAULTS_DRAWN = (NO_FAULT, *(fault.name for fault in DRAWN))
NOTICED = (NO_MONITOR, *MONITORS)
PAIR = 1 << 16
"""Ids of tuples are below it; a pair's id is the first tuple's times this and the second's."""


@dataclass(frozen=True)
class Rides:
    """Rides within the declared ranges: none may break a claim.

    A tuple is a fault that the ride had and a monitor that fired in it; a pair, two of these in one ride.
    A ride's faults follow from its number, so weights have no say.
    """

    name: str = "rides"

    def identity(self) -> Mapping[str, str]:
        """The sources of kernel and models, the plan and the faults' ranges, and the size of a batch."""
        return {
            "sources": digest_of_sources("kernel", "models", "fuzz/targets/rides.py"),
            "plan": repr(PLAN),
            "faults": "; ".join(
                f"{each.name} {each.least} to {each.most} {each.unit}, chance {each.chance}" for each in FAULTS
            ),
            "rides a batch": str(RIDES_A_BATCH),
        }

    def describe(self, tuple_id: int) -> str:
        """Say a tuple in words: the fault and what was noticed."""
        fault, monitor = divmod(tuple_id, len(NOTICED))
        return f"{FAULTS_DRAWN[fault]}: {NOTICED[monitor]}"

    def families(self) -> tuple[str, ...]:
        """No families: each fault has its own chance, in every ride."""
        return ()

    def run(self, batch: Batch) -> Result:
        """Ride a batch; a ride whose claim was broken is a failure."""
        assert batch.target == self.name, batch
        began = time.perf_counter()
        rows = campaign.ridden(campaign.Batch(batch.seed, batch.number, RIDES_A_BATCH))
        covered, pairs = coverage(batch, rows)
        found = outcome(rows)
        return Result(
            batch=batch,
            traces=found.rides,
            steps=found.sums[COLUMNS[CYCLES]],
            counts={**found.sums, **found.violations, **found.assumptions, **found.monitors},
            covered=covered,
            pairs=pairs,
            sketch=b"",
            failures=tuple(failures(batch, rows)),
            seconds=time.perf_counter() - began,
        )


def first_ride(batch: Batch) -> int:
    """The number of a batch's first ride in its campaign."""
    return batch.number * campaign.RUNS_A_BATCH


def coverage(batch: Batch, rows: Numbers) -> tuple[dict[int, int], dict[int, int]]:
    """Count tuples and pairs of them, in rides."""
    first = first_ride(batch)
    values = choose(batch.seed, range(first, first + len(rows)), 0).values
    had = np.array([values[fault.name] != fault.absent for fault in DRAWN])
    fired = rows[:, [COLUMNS.index(name) for name in MONITORS]] > 0
    covered: Counter[int] = Counter()
    pairs: Counter[int] = Counter()
    for row in range(len(rows)):
        faults = [int(place) + 1 for place in np.flatnonzero(had[:, row])] or [0]
        noticed = [int(place) + 1 for place in np.flatnonzero(fired[row])] or [0]
        tuples = sorted(fault * len(NOTICED) + monitor for fault in faults for monitor in noticed)
        covered.update(tuples)
        pairs.update(one * PAIR + other for one, other in combinations(tuples, 2))
    return dict(covered), dict(pairs)


def failures(batch: Batch, rows: Numbers) -> list[str]:
    """Write a trace for each ride in which a claim was broken: its line's batch and its row make the ride again."""
    found = []
    for row, tally in enumerate(rows):
        broken = {name: int(tally[COLUMNS.index(name)]) for name in VIOLATIONS if tally[COLUMNS.index(name)]}
        if broken:
            trace = {
                "format": FORMAT,
                "target": "rides",
                "seed": batch.seed,
                "batch": batch.number,
                "row": row,
                "ride": first_ride(batch) + row,
                "rides": len(rows),
                "beyond": [],
                "planted": None,
                "plan": repr(PLAN),
                "violated": list(broken),
                "cycles": broken,
            }
            found.append(json.dumps(trace))
    return found
