"""The radio link as a target: runs in which machines talk and all seven threats strike (T11)."""

from __future__ import annotations

import json
import time
from collections import Counter
from collections.abc import Mapping
from contextlib import nullcontext
from dataclasses import dataclass, replace
from random import Random

from fuzz.campaign.sketch import registers
from fuzz.channel.play import LIMITS, STEPS, Channel, Run, described
from fuzz.channel.threats import MOST, PRESENT, THREATS, drawn
from fuzz.planted.draw import planted
from fuzz.targets.target import Batch, Result, digest_of_sources
from proofs.mutated import running
from proofs.onboard.link import THEORY as LINK

RUNS_A_BATCH = 40
FORMAT = "heisoku trace 1"


@dataclass(frozen=True)
class LinkRuns:
    """Runs of the channel; ``fault``: the name of a planted fault that runs in them."""

    fault: str | None = None
    name: str = "link"

    def identity(self) -> Mapping[str, str]:
        """The sources, the link's times, and how runs are drawn."""
        return {
            "sources": digest_of_sources("kernel", "models/link.py", "proofs/onboard/link.py", "fuzz/channel"),
            "limits": repr(LIMITS),
            "threats": f"{', '.join(THREATS)}; each present in {PRESENT} of runs, at up to {MOST} of its chances",
            "runs a batch": f"{RUNS_A_BATCH} of {STEPS} steps",
        }

    def describe(self, tuple_id: int) -> str:
        """Say a tuple in words."""
        return described(tuple_id)

    def families(self) -> tuple[str, ...]:
        """The threats."""
        return tuple(THREATS)

    def with_fault(self, theory: str, fault: str) -> LinkRuns | None:
        """The same runs with a fault planted in the link."""
        return replace(self, fault=fault) if theory == LINK.name else None

    def run(self, batch: Batch) -> Result:
        """Play a batch of runs; one in which a claim is false is a failure."""
        assert batch.target == self.name, batch
        began = time.perf_counter()
        with running(planted(self.fault)) if self.fault else nullcontext():
            runs = [played(batch, number) for number in range(RUNS_A_BATCH)]
        counts: Counter[str] = Counter()
        covered: Counter[int] = Counter()
        pairs: Counter[int] = Counter()
        for run in runs:
            counts.update(run.struck)
            counts["steps that changed something"] += run.changed
            covered.update(run.covered)
            pairs.update(run.pairs)
        return Result(
            batch=batch,
            traces=len(runs),
            steps=sum(run.steps for run in runs),
            counts=counts,
            covered=covered,
            pairs=pairs,
            sketch=registers(state for run in runs for state in run.states),
            failures=tuple(
                json.dumps(trace_of(batch, number, run, self.fault)) for number, run in enumerate(runs) if run.violated
            ),
            seconds=time.perf_counter() - began,
        )


def played(batch: Batch, number: int) -> Run:
    """One run of a batch; everything in it follows from the seed and the numbers."""
    random = Random(f"{batch.seed} {batch.number} {number}")
    weights = dict(zip(THREATS, batch.weights, strict=True)) if batch.weights else {}
    return Channel(random, drawn(random, weights)).played()


def trace_of(batch: Batch, number: int, run: Run, fault: str | None) -> dict[str, object]:
    """What makes a run again, what was false, and after how many steps."""
    return {
        "format": FORMAT,
        "target": "link",
        "seed": batch.seed,
        "batch": batch.number,
        "run": number,
        "weights": list(batch.weights),
        "planted": None if fault is None else {"name": fault},
        "violated": list(run.violated),
        "at_step": len(run.events),
        "events": [
            f"{step}({', '.join(f'{name}={value}' for name, value in event.items())})" for step, event in run.events
        ],
    }
