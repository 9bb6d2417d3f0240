"""Answers to when a train is due, against a train that does its worst (X2, X4)."""

from __future__ import annotations

from collections.abc import Callable
from random import Random

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from kernel.crossing import arrival
from kernel.crossing.crossing import Due, due
from proofs.crossing.witnesses.contact import BOUNDS
from proofs.crossing.witnesses.due import SITE, WITNESSES, Train


@pytest.mark.parametrize("witness", WITNESSES)
def test_witness(witness: Callable[[], None]) -> None:
    assert witness.__doc__
    witness()


@given(st.integers(0, 3_000_000), st.integers(0, 30_000))
def test_answers_are_in_order_of_way_and_speed(way_mm: int, speed_mm_s: int) -> None:
    """Nearer or faster is never farther (X2, X4)."""
    told = due(BOUNDS, Train(way_mm, speed_mm_s).followed(), SITE.settings.reopening_cycles)
    nearer = due(BOUNDS, Train(max(0, way_mm - 10_000), speed_mm_s).followed(), SITE.settings.reopening_cycles)
    faster = due(BOUNDS, Train(way_mm, min(30_000, speed_mm_s + 1_000)).followed(), SITE.settings.reopening_cycles)
    assert max(told.value, 0) <= min(nearer.value, faster.value)


@given(st.integers(0, 3_000_000), st.integers(0, 30_000))
def test_now_is_what_the_reckoning_says(way_mm: int, speed_mm_s: int) -> None:
    followed = Train(way_mm, speed_mm_s).followed()
    assert (due(BOUNDS, followed, 200) == Due.NOW) == arrival.must_warn(BOUNDS, followed)
    assert due(BOUNDS, followed, 0) != Due.NEAR


@settings(max_examples=30, deadline=None)
@given(st.integers(0, 2**32))
def test_in_drawn_runs_nobody_arrives_sooner_than_secured(seed: int) -> None:
    """Stopping, turning back and starting anew; every invariant is looked at after each step."""
    chance = Random(seed)
    train = Train(chance.randrange(500_000, 2_000_000), chance.randrange(30_001))
    aim_um = BOUNDS.line_um
    for _ in range(1_200):
        if chance.random() < 0.01:
            aim_um = chance.choice((BOUNDS.line_um, 1_000_000, 0, -500_000))
        if chance.random() < 0.5:
            train.answer()
        train.run(max(min(aim_um, train.faster()), train.system.pace_um - 15_000))
        if train.system.way_um <= 0:
            break
    arrived = train.system.way_um <= 0
    assert train.step("arrive").sooner_cycles <= 0
    assert not arrived or train.system.left_cycles <= 0
