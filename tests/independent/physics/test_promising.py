"""Trains in small time steps that promise ceilings of speed: none gets faster, and a careless kernel is found."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable
from typing import Any
from unittest.mock import patch

import pytest

from kernel.onboard import ceiling
from tests.independent.physics.promising import ABOVE_CEILING, Promising
from tests.independent.physics.ride import Hazard

SHORT, LONG = 12, 1_000


def ridden(seeds: Iterable[int]) -> tuple[list[tuple[int, Hazard]], Counter[str]]:
    counts, hazards = Counter[str](), list[tuple[int, Hazard]]()
    for seed in seeds:
        out = Promising(seed).run()
        hazards += [(seed, hazard) for hazard in out.hazards if not hazard.broken]
        counts += out.counts
    return hazards, counts


def keeps(*_told: Any) -> bool:
    return True


def test_no_train_is_faster_than_it_has_promised() -> None:
    hazards, counts = ridden(range(SHORT))
    assert hazards == []
    assert counts["cycles within three metres a second of the ceiling"] > 100


def test_a_kernel_that_does_not_brake_for_a_ceiling_is_found() -> None:
    with patch.object(ceiling, "is_kept", keeps):
        hazards, _ = ridden(range(SHORT))
    assert {hazard.kind for _, hazard in hazards} == {ABOVE_CEILING}


@pytest.mark.slow
def test_a_thousand_trains_keep_their_promises() -> None:
    hazards, counts = ridden(range(LONG))
    assert hazards == []
    assert counts["cycles within three metres a second of the ceiling"] > 10_000
