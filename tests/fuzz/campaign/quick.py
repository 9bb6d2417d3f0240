"""A target that takes milliseconds and does as it is told."""

from __future__ import annotations

import hashlib
import json
import os
import random
import time
from collections import Counter
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from fuzz.campaign.sketch import REGISTERS
from fuzz.targets.target import Batch, Result

FAMILIES = ("loss", "delay", "restart")
IDS_OF_A_FAMILY = 40
TRACES = 8


@dataclass(frozen=True)
class Quick:
    """Draws from batch and weights; the more a family is drawn, the more of its tuples are hit.

    ``watched``: its identity is this file's digest.  ``changes``: the batch that changes that file.
    ``hangs``, ``dies``, ``fails``: the batches that do; with ``once``, a folder for marks, only the first time.
    ``breaks``: every so many batches have a failure.
    """

    name: str = "quick"
    seconds: float = 0.0
    watched: Path | None = None
    changes: int | None = None
    hangs: tuple[int, ...] = ()
    dies: tuple[int, ...] = ()
    fails: tuple[int, ...] = ()
    once: Path | None = None
    breaks: int = 0

    def identity(self) -> Mapping[str, str]:
        return {"watched": hashlib.sha256(self.watched.read_bytes()).hexdigest() if self.watched else "nothing"}

    def describe(self, tuple_id: int) -> str:
        return f"{FAMILIES[tuple_id // IDS_OF_A_FAMILY]} {tuple_id % IDS_OF_A_FAMILY}"

    def families(self) -> tuple[str, ...]:
        return FAMILIES

    def run(self, batch: Batch) -> Result:
        began = time.perf_counter()
        self._misbehave(batch)
        time.sleep(self.seconds)
        drawn = random.Random(f"{batch}")
        covered: Counter[int] = Counter()
        for _ in range(TRACES):
            family = drawn.choices(range(len(FAMILIES)), batch.weights)[0]
            covered[family * IDS_OF_A_FAMILY + int(drawn.paretovariate(1)) % IDS_OF_A_FAMILY] += 1
        registers = np.zeros(REGISTERS, np.uint8)
        for _ in range(200):
            registers[drawn.randrange(REGISTERS)] = drawn.randrange(1, 9)
        broken = self.breaks and batch.number % self.breaks == 0
        return Result(
            batch=batch,
            traces=TRACES,
            steps=drawn.randrange(1, 1000),
            counts={"accepted": drawn.randrange(100), "refused": drawn.randrange(100)},
            covered=covered,
            pairs={one * 1000 + other: 1 for one in covered for other in covered if one < other},
            sketch=registers.tobytes(),
            failures=(failure(batch),) if broken else (),
            seconds=time.perf_counter() - began,
        )

    def _misbehave(self, batch: Batch) -> None:
        if batch.number == self.changes and self.watched:
            self.watched.write_text("changed", "utf-8")
        for does, numbers in (("hang", self.hangs), ("die", self.dies), ("fail", self.fails)):
            if batch.number not in numbers or not self._first(f"{does}-{batch.number}"):
                continue
            if does == "hang":
                time.sleep(3600)
            if does == "die":
                os._exit(9)
            raise ValueError(f"batch {batch.number} is no good\nsecond line")

    def _first(self, mark: str) -> bool:
        if self.once is None:
            return True
        path = self.once / mark
        first = not path.exists()
        path.touch()
        return first


def failure(batch: Batch) -> str:
    """A trace, as far as a campaign looks at it; two causes."""
    cause = f"cause {batch.number % 2}"
    return json.dumps({"target": batch.target, "batch": batch.number, "violated": ["no_two/trains"], "cause": cause})
