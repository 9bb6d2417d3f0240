"""The detection of a feature, at its edges and in drawn worlds (P2, P3)."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from kernel.onboard import feature as machine
from kernel.onboard.feature import Progress, Readings
from proofs.onboard.feature import THEORY
from proofs.onboard.witnesses.feature import BENT, BOUNDS, CURVE, EASED, SITE, STRAIGHT, WITNESSES, Train
from proofs.onboard.witnesses.play import Play

WILD = st.integers(-(2**62), 2**62)
WIDE = st.integers(-10, 10) | WILD
PLACES = st.integers(0, 400_000) | WILD
READINGS = st.builds(
    Readings, PLACES, st.booleans(), st.just(20_000) | WIDE, PLACES, st.booleans(), WIDE, st.booleans(), WIDE
)


@pytest.mark.parametrize("witness", WITNESSES)
def test_witness(witness: Callable[[], None]) -> None:
    assert witness.__doc__
    witness()


@given(st.integers(-5_000_000, 5_000_000), st.integers(1, 50_000))
def test_a_band_is_that_of_the_exact_curvature(rate_urad_s: int, speed_mm_s: int) -> None:
    """Multiplied out it is the same as κ = ω / v rounded either way."""
    readings = replace(Train().readings(0), yaw_urad_s=rate_urad_s, speed_mm_s=speed_mm_s)
    down, up = rate_urad_s * 1_000 // speed_mm_s, -(-rate_urad_s * 1_000 // speed_mm_s)
    band = CURVE.second
    assert machine.is_within(band, CURVE, readings) == (band.least <= down and up <= band.most)


@given(st.lists(READINGS, max_size=30))
def test_any_readings_whatever_are_answered(history: list[Readings]) -> None:
    state = machine.AWAITED
    for readings in history:
        after = machine.note_cycle(BOUNDS, CURVE, state, readings)
        assert not machine.has_fix(after)
        assert after.stage != Progress.WAITING or state.stage == Progress.WAITING
        assert 0 <= after.from_mm <= 10**12
        state = after


@pytest.mark.parametrize("rate", [0, 40_000])
def test_a_stuck_sensor_gives_no_fix(rate: int) -> None:
    """A yaw rate that never changes is a straight or a curve without end."""
    train = Train()
    for _ in range(200):
        train.cycle(STRAIGHT, yaw_urad_s=rate)
        assert not machine.has_fix(train.system.state)


def test_a_wheel_that_stands_still_gives_no_fix() -> None:
    train = Train()
    train.run(STRAIGHT, 10_000)
    for curvature in (STRAIGHT, BENT, STRAIGHT):
        for _ in range(60):
            train.cycle(curvature, 0)
            assert not machine.has_fix(train.system.state)


@settings(max_examples=80, deadline=None)
@given(st.data())
def test_invariants_hold_in_drawn_worlds(data: st.DataObject) -> None:
    """Straights and curves of drawn lengths, with some cycles spoilt; now and then they match."""
    lengths = (
        data.draw(st.sampled_from((18_000, 50_000))),
        *(data.draw(st.integers(way - 1, way + 1)) * 2_000 for way in (10, 30, 10, 11)),
    )
    train = Train(at_mm=250_000 - sum(lengths[:4]))
    spoilt = data.draw(st.integers(0, 200))
    number = 0
    for curvature, way_mm in zip((STRAIGHT, EASED, BENT, EASED, STRAIGHT), lengths, strict=True):
        for _ in range(way_mm // 2_000):
            number += 1
            shown = curvature if number != spoilt else data.draw(st.integers(-3_000, 3_000))
            train.cycle(shown, rolling=number != spoilt or data.draw(st.booleans()))
            if data.draw(st.integers(0, 300)) == 0:
                train.step("await_feature")
    assert train.system.cycle == number


@settings(max_examples=200, deadline=None)
@given(st.lists(st.tuples(READINGS, st.integers(0, 10**12)), max_size=20))
def test_invariants_hold_in_wild_worlds(history: list[tuple[Readings, int]]) -> None:
    play = Play(THEORY, SITE, Train().system)
    for readings, front_um in history:
        before = play.system
        after = play.step("run_a_cycle", front_um=front_um, readings=readings)
        assert after == before or (after.front_um, after.cycle) == (front_um, before.cycle + 1)
