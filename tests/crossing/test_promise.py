"""Promised ceilings: witnesses, and drawn worlds in which either's word is lost, repeated, late, or forgotten (X2)."""

from __future__ import annotations

from collections.abc import Callable
from random import Random

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from proofs.crossing.witnesses.promise import LINE_MM_S, WITNESSES, Train


@pytest.mark.parametrize("witness", WITNESSES)
def test_witness(witness: Callable[[], None]) -> None:
    assert witness.__doc__
    witness()


@settings(max_examples=60, deadline=None)
@given(st.integers(0, 2**32))
def test_no_train_is_faster_than_held_to_be_in_drawn_worlds(seed: int) -> None:
    """All that was ever told and acknowledged may come at any moment; every invariant is looked at in each step."""
    chance = Random(seed)
    train = Train(chance.randrange(LINE_MM_S + 1))
    for _ in range(300):
        held = train.system.held.ceiling_mm_s
        event = chance.randrange(12)
        if event < 2:
            train.step("run", speed_mm_s=chance.choice((0, held, chance.randrange(LINE_MM_S + 1))))
        elif event == 2:
            speed_mm_s = train.system.speed_mm_s
            most_mm_s = speed_mm_s + chance.choice((0, 0, 500))
            train.step("lower", ceiling_mm_s=chance.randrange(speed_mm_s, held + 1), speed_most_mm_s=most_mm_s)
        elif event == 3:
            train.step("ask", asked_mm_s=chance.randrange(LINE_MM_S + 1))
        elif event < 6:
            train.tell()
        elif event < 8 and train.system.told:
            train.hear(chance.choice(sorted(train.system.told, key=lambda told: told.number)))
        elif event == 8:
            train.acknowledge()
        elif event < 11 and train.system.acknowledged:
            train.told_so(chance.choice(sorted(train.system.acknowledged)))
        elif event == 11 and chance.random() < 0.1:
            train.step("restart_crossing")
    assert train.system.speed_mm_s <= train.system.noted.ceiling_mm_s
