"""Jolted states as a target: in any state in which every invariant holds, no event makes one false."""

from __future__ import annotations

import json
import time
from collections import Counter
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, replace
from functools import lru_cache
from pathlib import Path
from typing import Any

from fuzz.compiled.memory import lay_out
from fuzz.compiled.native import REFUSED, compiled
from fuzz.failures.events import encoded
from fuzz.failures.trace import FORMAT, layout_file
from fuzz.jolted import seeds
from fuzz.jolted.confirming import Confirmed, confirmed
from fuzz.jolted.searching import Find, Found, Search
from fuzz.jolted.telling import differing
from fuzz.jolted.words import CHANGED_SOMETHING, OUTCOMES, REFUSED_FROM
from fuzz.planted.draw import planted
from fuzz.targets.target import Batch, Result, digest_of_sources
from models.layouts import load
from proofs.catalogue import INTERLOCKING
from proofs.mutated import Sources
from proofs.transitions import TRANSITIONS

ROUNDS_A_BATCH = 12_000
"""Some five million events, a few seconds."""
KEPT = 2
"""Of failures that violate the same in the same step, a batch keeps so many."""
THOROUGH = 40
"""Of so many samples the invariants of one are asked in CPython too."""
LAYOUTS = "../layouts"
"""Where a campaign keeps its layouts, from where it keeps its failures."""


@dataclass(frozen=True)
class Jolted:
    """Events in jolted states on the layout at ``path``.

    ``fault``: the name of a planted fault that runs.  ``rounds``: of jolts and events in a batch.
    """

    path: Path
    fault: str | None = None
    rounds: int = ROUNDS_A_BATCH

    @property
    def name(self) -> str:
        """The target's name: one for each layout."""
        return f"jolted:{self.path.name}"

    def identity(self) -> Mapping[str, str]:
        """The layout's bytes, the sources, and how much is in a batch."""
        return {
            "layout": layout_file(self.path, self.path.parent).sha256,
            "sources": digest_of_sources(
                *("kernel", "models/world", "models/simulator", "models/ground.py", "proofs/invariants"),
                *("fuzz/compiled", "fuzz/jolted", "fuzz/targets/jolted.py", "fuzz/machines/places.py"),
                *("fuzz/machines/plausible.py", "fuzz/traffic/words.py", "fuzz/traffic/entries.py"),
            ),
            "trains": str(seeds.TRAINS),
            "rounds a batch": str(self.rounds),
        }

    def describe(self, tuple_id: int) -> str:
        """Say a tuple in words: the transition, and what came of it."""
        kind, outcome = divmod(tuple_id, OUTCOMES)
        step = TRANSITIONS[kind].__name__
        if outcome >= REFUSED_FROM:
            return f"{step}: {REFUSED[outcome - REFUSED_FROM].value}"
        return f"{step}: {'accepted' if outcome == CHANGED_SOMETHING else 'nothing changed'}"

    def families(self) -> tuple[str, ...]:
        """There are none: nothing is drawn that could be drawn more often."""
        return ()

    def with_fault(self, theory: str, fault: str) -> Jolted | None:
        """The same with a fault planted in the centre, a unit or a terminal."""
        return replace(self, fault=fault) if theory == INTERLOCKING.name else None

    def run(self, batch: Batch) -> Result:
        """Try a batch of events; one that makes an invariant false is a failure, as CPython confirms."""
        assert batch.target == self.name, batch
        began = time.perf_counter()
        searching, sources = search_on(self.path, self.fault)
        found = searching.run(batch.seed, batch.number, self.rounds)
        told = [
            (find, confirmed(searching.native, sources, find, at % THOROUGH == 0))
            for at, find in enumerate(found.finds)
        ]
        return Result(
            batch=batch,
            traces=found.rounds,
            steps=found.events,
            counts=counts_of(found, told),
            covered={int(at): int(found.hits.flat[at]) for at in found.hits.ravel().nonzero()[0]},
            pairs={},
            sketch=b"",
            failures=tuple(json.dumps(each, ensure_ascii=False) for each in self.failures(batch, told)),
            seconds=time.perf_counter() - began,
        )

    def failures(self, batch: Batch, told: list[tuple[Find, Confirmed]]) -> Iterator[dict[str, Any]]:
        """What CPython finds violated too, and where the engine is not of its mind: a few of each sort."""
        kept: Counter[tuple[int, tuple[str, ...]]] = Counter()
        site = search_on(self.path, self.fault)[0].native.memory.site
        for find, said in told:
            sort = (find.kind, said.violated)
            kept[sort] += 1
            if not said.violated or kept[sort] > KEPT:
                continue
            step = TRANSITIONS[find.kind].__name__
            yield {
                "format": FORMAT,
                "target": "jolted",
                "layout": {
                    "file": f"{LAYOUTS}/{self.path.name}",
                    "sha256": layout_file(self.path, self.path.parent).sha256,
                },
                "seed": batch.seed,
                "batch": batch.number,
                "planted": None if self.fault is None else {"name": self.fault},
                "violated": list(said.violated),
                "step": step,
                "event": encoded(step, said.event),
                "state": differing(site, said.before),
                **({"why": said.why} if said.why else {}),
            }


def counts_of(found: Found, told: list[tuple[Find, Confirmed]]) -> dict[str, int]:
    """What was done, by name."""
    return {
        "jolts": found.jolts,
        "jolts let stand": found.landed,
        "events that changed something": found.changed,
        "events that made an invariant false": int(found.seen.sum()),
        "events taken in CPython too": len(told),
        "states undefined in CPython": sum(said.undefined for _, said in told),
    }


@lru_cache(maxsize=6)
def search_on(path: Path, fault: str | None = None) -> tuple[Search, Sources]:
    """Compile the search on a layout, once in each process, and what is planted in it."""
    imported = load(path)
    sources = planted(fault) if fault else {}
    return Search(compiled(lay_out(seeds.site_for(imported)), sources), imported), sources
