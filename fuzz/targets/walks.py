"""Walks in plain CPython as a target: every theory that is proved, its steps told what its witnesses were, and else.

A walk of the interlocking begins where everything has just started.  A walk of a machine on board, or of
the radio link, may begin in any state in which all that is claimed holds.  What breaks a claim there, no
proof would have let pass.
"""

from __future__ import annotations

import json
import time
from collections import Counter
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, replace
from itertools import pairwise
from random import Random

from fuzz.failures.causes import cause_of
from fuzz.failures.replaying import ERRORS
from fuzz.failures.trace import Trace, as_json
from fuzz.machines import beside, moves
from fuzz.machines.jolts import jolted_walk, thinned
from fuzz.machines.places import TINY, place_on
from fuzz.machines.watched import Broken
from fuzz.planted.draw import name_of, planted
from fuzz.targets.target import Batch, Result, digest_of_sources
from models.shipped import shipped
from proofs.catalogue import INTERLOCKING
from proofs.mutated import Sources
from proofs.theories import THEORIES

FORMAT = "heisoku trace 1"
WALKS_A_BATCH = 96
COSTLY = {INTERLOCKING.name: 0.08}
"""A walk of the interlocking takes so much longer than one of a machine that it is drawn so much less."""
JOLTED, THINNED, QUESTIONED = 0.2, 0.2, 0.3
"""Shares of the interlocking's walks: jolted into states that no run leads to; on layouts that say less; with every
transition asked of what nobody expects."""
LAYOUTS = (TINY, *sorted(shipped("layouts").glob("*.toml")))
NAMES = tuple(THEORIES)
STEPS = tuple((theory, step) for theory, each in THEORIES.items() for step in each.steps)
PLACES = {each: at for at, each in enumerate(STEPS)}


@dataclass(frozen=True)
class Walks:
    """Walks of all theories, or of ``only`` one; ``fault``: the name of a planted fault that runs."""

    fault: str | None = None
    only: str | None = None
    name: str = "walks"

    def identity(self) -> Mapping[str, str]:
        """The sources, and how many walks a batch has."""
        return {
            "sources": digest_of_sources("kernel", "models", "proofs", "fuzz/machines", "layouts"),
            "walks a batch": str(WALKS_A_BATCH),
        }

    def describe(self, tuple_id: int) -> str:
        """Say a tuple in words."""
        theory, step = STEPS[tuple_id]
        return f"{theory}: {step}"

    def families(self) -> tuple[str, ...]:
        """The theories."""
        return NAMES

    def with_fault(self, theory: str, fault: str) -> Walks:
        """Walks of one theory with a fault planted."""
        return replace(self, fault=fault, only=theory)

    def run(self, batch: Batch) -> Result:
        """Walk; a walk that breaks a claim is a failure."""
        assert batch.target == self.name, batch
        began = time.perf_counter()
        sources = planted(self.fault) if self.fault else {}
        counts: Counter[str] = Counter()
        covered: Counter[int] = Counter()
        pairs: Counter[int] = Counter()
        failures = []
        for number, theory in enumerate(self.drawn(batch)):
            steps, failure = walked(theory, sources, Random(f"{batch.seed} {batch.number} {number}"))
            counts[f"walks of {theory}"] += 1
            ids = [PLACES[theory, step] for step in steps]
            covered.update(ids)
            pairs.update(one * len(STEPS) + other for one, other in pairwise(ids))
            if failure is not None:
                failures.append(json.dumps({**failure, "seed": batch.seed, "batch": batch.number, "walk": number}))
        return Result(
            batch=batch,
            traces=sum(counts.values()),
            steps=covered.total(),
            counts=counts,
            covered=covered,
            pairs=pairs,
            sketch=b"",
            failures=tuple(failures),
            seconds=time.perf_counter() - began,
        )

    def drawn(self, batch: Batch) -> Iterator[str]:
        """The theory of each walk of a batch."""
        names = NAMES if self.only is None else (self.only,)
        count = WALKS_A_BATCH if self.only is None else max(1, round(WALKS_A_BATCH * COSTLY.get(self.only, 1.0)))
        given = dict(zip(NAMES, batch.weights, strict=True)) if batch.weights else {}
        weights = [given.get(name, 1.0) * COSTLY.get(name, 1.0) for name in names]
        yield from Random(f"{batch.seed} {batch.number}").choices(names, weights, k=count)


def walked(theory: str, sources: Sources, random: Random) -> tuple[list[str], dict[str, object] | None]:
    """Walk; the steps that were taken, and the failure if there is one."""
    try:
        if theory != INTERLOCKING.name:
            return [told.step for told in beside.walk(theory, sources, random).taken], None
        kind = random.random()
        place = place_on(random.choice(LAYOUTS), moves.TRAINS[0], random.randrange(moves.STARTS))
        if kind < JOLTED:
            going: moves.Moves = jolted_walk(place, sources, random)
        elif kind < JOLTED + THINNED:
            try:
                going = moves.walk(thinned(place, random), sources, random, moves.MOVES)
            except Broken:
                raise
            except ERRORS:
                return [], None  # who moves trains looked up what such a layout does not say; no step did
        elif kind < JOLTED + THINNED + QUESTIONED:
            going = moves.questioned(place, sources, random)
        else:
            going = moves.numbered(random.randrange(2**31), sources, LAYOUTS)
        return [step for step, _ in going.play.taken], None
    except Broken as broken:
        return [event.step for event in broken.trace.events], told_of(broken.trace)
    except beside.BrokenClaim as broken:
        failure: dict[str, object] = {
            "format": FORMAT,
            "target": "walks",
            "theory": theory,
            "planted": None if not sources else {"name": name_of(sources)},
            "violated": list(broken.violated),
            "at_step": len(broken.taken),
            "cause": [theory, broken.taken[-1].step],
        }
        return [told.step for told in broken.taken], failure


def told_of(trace: Trace) -> dict[str, object]:
    """A failure of the interlocking: its steps, as far as the walk was not jolted between them."""
    return {**as_json(trace), "target": "walks", "theory": INTERLOCKING.name, "cause": cause_of(trace).digest}
