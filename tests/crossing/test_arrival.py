"""The moment to warn at its edges, against a train that is run out, and in drawn worlds (X1, X2, X3)."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from random import Random

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from kernel.crossing import arrival as machine
from kernel.crossing.arrival import UM_A_MM, ArrivalBounds, Followed, Ranging
from proofs.crossing.witnesses.arrival import WITNESSES
from proofs.crossing.witnesses.contact import BOUNDS, NOTHING, Train, contacted

HUGE = 2**62
SITES = st.builds(
    ArrivalBounds,
    line_um=st.integers(1, 20_000),
    gain_um=st.integers(1, 3_000),
    cycle_ms=st.just(100),
    warning_cycles=st.integers(0, 60),
    silence_cycles=st.integers(1, 20),
    way_spread_mm=st.integers(0, 100),
    speed_spread_mm_s=st.integers(0, 100),
)


@pytest.mark.parametrize("witness", WITNESSES)
def test_witness(witness: Callable[[], None]) -> None:
    assert witness.__doc__
    witness()


@given(SITES, st.integers(0, 20_000), st.integers(0, 20_000), st.integers(-1_000, 10**6), st.integers(1, 60))
def test_it_cannot_arrive_exactly_if_the_worst_train_does_not(
    bounds: ArrivalBounds, ceiling_um: int, short_um: int, way_um: int, cycles: int
) -> None:
    """Neither too early nor too late: to the cycle and to the micrometre (X2)."""
    ceiling_um = min(ceiling_um, bounds.line_um)
    short_um = min(short_um, ceiling_um)
    pace_um, left_um = ceiling_um - short_um, way_um
    for _ in range(cycles):
        pace_um = min(pace_um + bounds.gain_um, ceiling_um)
        left_um -= pace_um
    known = Followed(way_um, short_um, ceiling_um, 0, 0, 0, False)
    told = machine.cannot_arrive(bounds, known, cycles)
    assert not told or left_um > 0
    if left_um > bounds.gain_um:
        assert told


@settings(max_examples=40, deadline=None)
@given(st.integers(0, 2**32))
def test_no_train_arrives_too_early_in_drawn_worlds(seed: int) -> None:
    """Stopping, reversing and speeding up, under a radio that loses, delays and repeats; invariants in each step."""
    chance = Random(seed)
    train = Train(contacted(chance.randrange(1_300_000, 1_800_000), chance.randrange(30_001)))
    aim_um, loss = BOUNDS.line_um, chance.choice((0.0, 0.1, 0.9))
    for _ in range(1_500):
        if chance.random() < 0.02:
            aim_um = chance.choice((BOUNDS.line_um, BOUNDS.line_um, 1_000_000, 0, -500_000))
        if chance.random() < 0.7:
            train.range()
        ranging = train.ranging()
        late = replace(ranging, age_cycles=ranging.age_cycles + chance.choice((0, 0, 1, 30)))
        train.decide(NOTHING if chance.random() < loss else late)
        train.run(max(min(aim_um, train.faster()), train.system.pace_um - 15_000))
        if train.system.way_um <= 0:
            break
    train.step("arrive")
    assert train.system.arrived == (train.system.way_um <= 0)
    assert not train.system.arrived or train.system.warned_cycles > BOUNDS.warning_cycles


@pytest.mark.parametrize("way_mm", [-HUGE, HUGE])
@pytest.mark.parametrize("age_cycles", [-HUGE, HUGE])
def test_what_is_no_ranging_is_as_good_as_silence(way_mm: int, age_cycles: int) -> None:
    held = contacted().followed
    for ranging in (Ranging(True, way_mm, 0, 0), Ranging(True, 0, HUGE, 0), Ranging(True, 0, 0, age_cycles)):
        assert machine.follow(BOUNDS, held, ranging) == machine.follow(BOUNDS, held, NOTHING)


def test_a_train_at_or_beyond_the_crossing_is_warned_of() -> None:
    for way_mm in (0, -1, -1_000_000):
        assert machine.follow(BOUNDS, contacted().followed, Ranging(True, way_mm, 0, 0)).warns


def test_a_stuck_ranging_is_shortened_ever_more() -> None:
    """The same one again with its true age: the way shrinks with it, until it is lost."""
    train = Train(contacted(3_000_000, 0))
    told, ways = train.ranging(), []
    for age_cycles in range(22):
        train.decide(Ranging(True, told.way_mm, told.speed_mm_s, age_cycles))
        ways.append(train.system.followed.way_um)
        train.run(0)
    assert ways[:21] == [3_000_000 * UM_A_MM - age * BOUNDS.line_um for age in range(21)]
    assert train.warns()
