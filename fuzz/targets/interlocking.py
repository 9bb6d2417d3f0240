"""Traffic on a layout as a target: the compiled kernel under every fault, its invariants asked after each step."""

from __future__ import annotations

import json
import time
from collections.abc import Mapping
from dataclasses import dataclass, replace
from functools import lru_cache
from pathlib import Path

from fuzz.compiled.memory import lay_out
from fuzz.compiled.native import compiled
from fuzz.failures.causes import cause_of
from fuzz.failures.shrinking import shrink
from fuzz.failures.trace import LayoutFile, Trace, as_json, layout_file
from fuzz.planted.draw import planted
from fuzz.targets.target import Batch, Result, digest_of_sources
from fuzz.traffic import faults, runs
from models.layouts import load
from models.simulator.play import site_of, two_cars_each
from proofs.catalogue import INTERLOCKING

TRACES_A_BATCH = 64
TRAINS = 8
LAYOUTS = "../layouts"
"""Where a campaign keeps its layouts, from where it keeps its traces."""
REPLAYS = 600
"""So many replays in CPython may be spent on making a failure short."""
KEPT = 4
"""Of failures that violate the same, a batch keeps so many; the rest are counted with the first."""


@dataclass(frozen=True)
class Interlocking:
    """Traffic of up to ``trains`` trains on the layout at ``path``.

    ``fault``: the name of a planted fault that runs.  ``shrinks``: failures are made short before they are given.
    """

    path: Path
    trains: int = TRAINS
    fault: str | None = None
    shrinks: bool = True

    @property
    def name(self) -> str:
        """The target's name: one for each layout."""
        return f"interlocking:{self.path.name}"

    def identity(self) -> Mapping[str, str]:
        """The layout's bytes, the sources, and from which ranges the faults are drawn."""
        return {
            "layout": layout_file(self.path, self.path.parent).sha256,
            "sources": digest_of_sources(
                *("kernel", "models/world", "models/ground.py", "proofs/invariants", "fuzz/compiled", "fuzz/traffic"),
            ),
            "faults": "; ".join(str(fault) for fault in faults.FAULTS),
            "trains": str(self.trains),
            "traces a batch": str(TRACES_A_BATCH),
        }

    def describe(self, tuple_id: int) -> str:
        """Say a tuple in words."""
        return runs.describe(tuple_id)

    def families(self) -> tuple[str, ...]:
        """The families of faults."""
        return faults.families()

    def with_fault(self, theory: str, fault: str) -> Interlocking | None:
        """The same traffic with a fault planted in the centre, a unit or a terminal."""
        return replace(self, fault=fault, shrinks=False) if theory == INTERLOCKING.name else None

    def run(self, batch: Batch) -> Result:
        """Run a batch of traces; one in which an invariant is false and no assumption is broken is a failure."""
        assert batch.target == self.name, batch
        began = time.perf_counter()
        traffic = traffic_of(self.path, self.trains, self.fault)
        found = runs.run_batch(traffic, batch.seed, batch.number, TRACES_A_BATCH, batch.weights)
        return Result(
            batch=batch,
            traces=found.traces,
            steps=found.steps,
            counts={**found.counts, "simulated seconds": found.seconds, "decisions": found.decisions},
            covered=found.covered,
            pairs=found.pairs,
            sketch=found.sketch,
            failures=tuple(self.told(found.failures)),
            seconds=time.perf_counter() - began,
        )

    def told(self, failures: tuple[Trace, ...]) -> list[str]:
        """Each failure as a JSON text, short where that was wanted, with the cause by which it is kept once."""
        seen: dict[tuple[str, ...], list[str]] = {}
        texts = []
        for trace in failures:
            kept = seen.setdefault(trace.violated, [])
            if len(kept) < KEPT:
                kept.append(self._text(trace))
                texts.append(kept[-1])
            else:
                texts.append(kept[0])
        return texts

    def _text(self, trace: Trace) -> str:
        if self.shrinks:
            here = replace(trace, layout=layout_file(self.path, self.path.parent))
            trace = replace(shrink(here, load(self.path), REPLAYS).trace, layout=trace.layout)
        told = as_json(trace)
        return json.dumps({**told, "cause": cause_of(trace).digest} if trace.violated else told, ensure_ascii=False)


@lru_cache(maxsize=4)
def traffic_of(path: Path, trains: int = TRAINS, fault: str | None = None) -> runs.Traffic:
    """Compile the traffic on a layout, once in each process."""
    imported = load(path)
    fleet = sorted(imported.layout.fleet)[:trains]
    site = site_of(imported.layout, imported.ground, imported.records, two_cars_each(fleet))
    kept = LayoutFile(f"{LAYOUTS}/{path.name}", layout_file(path, path.parent).sha256)
    native = compiled(lay_out(site), planted(fault) if fault else None)
    return runs.Traffic(native, kept, fault)
