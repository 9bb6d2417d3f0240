"""Canaries of a campaign: its targets with a known fault in the kernel, which they must find."""

from __future__ import annotations

import time
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Protocol, runtime_checkable

from fuzz.planted.canaries import MOST_SECONDS, NOTHING_SHOWN, Canary, canaries
from fuzz.targets.target import Batch, Target
from models.processes import processes

MANY = 10**9


@runtime_checkable
class Plantable(Protocol):
    """A target that a fault can be planted in."""

    def with_fault(self, theory: str, fault: str) -> Target | None:
        """The target with a fault running; none if it does not run that part of the kernel."""
        ...


@dataclass(frozen=True)
class Sought:
    """What became of a canary: found by which target, in how many batches; ``target`` is empty if by none.

    One of no batches has not been sought yet: it stands in the store from the beginning, so that a campaign that was
    broken off before, whatever ended it, has not found it.
    """

    kind: str
    fault: str
    target: str
    batches: int
    seconds: float


def carriers(targets: Sequence[Target], canary: Canary) -> list[Target]:
    """The targets with a canary's fault in them."""
    carried = (each.with_fault(canary.fault.theory, canary.name) for each in targets if isinstance(each, Plantable))
    return [each for each in carried if each is not None]


def carried(targets: Sequence[Target], seed: int) -> list[tuple[Canary, list[Target]]]:
    """The canaries of a seed that these targets can carry, each with the targets that it runs in."""
    return [(canary, found) for canary in canaries(seed) if (found := carriers(targets, canary))]


def unsought(targets: Sequence[Target], seed: int) -> list[Sought]:
    """What is to be sought, as long as it is not."""
    return [Sought(canary.kind, canary.name, "", 0, 0.0) for canary, _ in carried(targets, seed)]


def seek(targets: Sequence[Target], seed: int, workers: int) -> list[Sought]:
    """Run every canary that a target can carry, each in a process of its own, until it is found or has had its time.

    An interruption is passed on: what was found until then counts for nothing.
    """
    wanted = carried(targets, seed)
    if not wanted:
        return []
    with processes(workers, one_each=True) as pool:
        going = [pool.submit(hunted, canary.kind, canary.name, on, seed) for canary, on in wanted]
        return [each.result() for each in going]


def hunted(
    kind: str, fault: str, targets: Sequence[Target], seed: int, seconds: float = MOST_SECONDS, most: int = MANY
) -> Sought:
    """Run batches with a fault, of one target after the other, each for as long as a canary may live.

    ``seconds``, ``most``: so long, and so many batches, of each target.
    """
    batches, began = 0, time.perf_counter()
    for target in targets:
        number, until = 0, time.perf_counter() + seconds
        while number < most and time.perf_counter() < until:
            failures = target.run(Batch(target.name, number, seed, ())).failures
            number += 1
            batches += 1
            if failures:
                return Sought(kind, fault, target.name, batches, time.perf_counter() - began)
    return Sought(kind, fault, "", batches, time.perf_counter() - began)


def in_words(sought: Sequence[Sought]) -> str:
    """A line: whether all were found, which were not, and what that means."""
    missed = [each for each in sought if not each.target]
    if not sought:
        return "no canary was run: these targets carry none"
    if missed:
        names = "; ".join(f"{each.kind} ({each.fault})" for each in missed)
        return f"{len(missed)} of {len(sought)} canaries not found, {names}: {NOTHING_SHOWN}"
    return f"all {len(sought)} canaries found, the last after {max(each.seconds for each in sought):.0f} s"
