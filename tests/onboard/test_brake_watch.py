"""The watch on the brake, at its edges and in drawn worlds (T12)."""

from __future__ import annotations

from collections.abc import Callable

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from kernel.onboard import brake_watch as machine
from kernel.onboard.brake_watch import BrakeWatch
from models.onboard.brake_watch import keeps
from proofs.onboard.witnesses.brake_watch import BOUNDS, SITE, WITNESSES, Train, a_weak_brake_is_accused

GREATEST = 2**62
SPEEDS = st.integers(-1_000, 60_000) | st.sampled_from((0, -1, GREATEST, -GREATEST))
CYCLES = st.tuples(st.booleans(), st.integers(-150, 150), st.integers(0, 500))


@pytest.mark.parametrize("witness", WITNESSES)
def test_witness(witness: Callable[[], None]) -> None:
    assert witness.__doc__
    witness()


@given(SPEEDS, SPEEDS, st.booleans())
def test_the_limit_is_the_lower_of_what_is_measured_and_what_is_allowed(least: int, most: int, applied: bool) -> None:
    after = machine.note_cycle(BOUNDS, machine.watching(20_000), applied, True, least, most)
    assert after.limit_mm_s == max(0, min(most, 20_102))
    assert after.broken == (least > 20_102)


@given(SPEEDS, SPEEDS, st.booleans(), st.booleans(), st.integers(0, 3))
def test_an_accusation_stays_whatever_comes(least: int, most: int, applied: bool, known: bool, cycles: int) -> None:
    assert machine.note_cycle(BOUNDS, BrakeWatch(20_000, cycles, True), applied, known, least, most).broken


def test_a_stuck_reading_under_the_brake_is_accused() -> None:
    """A speed that stays where it is cannot be that of a train that brakes."""
    watch = machine.watching(20_000)
    for _ in range(BOUNDS.response_cycles):
        watch = machine.note_cycle(BOUNDS, watch, True, True, 20_000, 20_000)
        assert not watch.broken
    assert machine.note_cycle(BOUNDS, watch, True, True, 20_000, 20_000).broken


@settings(max_examples=100, deadline=None)
@given(st.lists(CYCLES, max_size=60))
def test_a_train_is_accused_only_of_a_bound_that_it_broke(history: list[tuple[bool, int, int]]) -> None:
    train = Train()
    kept = True
    for applied, gained_mm_s, off_mm_s in history:
        um_s = train.system.speed_um_s + 1_000 * gained_mm_s
        kept = kept and keeps(SITE, train.system, applied, um_s)
        train.cycle(um_s, applied=applied, off_mm_s=off_mm_s)
        assert train.system.kept == kept
        assert not (kept and train.is_accused())


@settings(max_examples=50, deadline=None)
@given(st.lists(st.tuples(st.booleans(), st.integers(0, 500)), max_size=60))
def test_a_train_at_its_bounds_is_never_accused(history: list[tuple[bool, int]]) -> None:
    """As fast as motors and brake allow, in every cycle."""
    train = Train()
    for applied, off_mm_s in history:
        responds = applied and train.system.cycles >= BOUNDS.response_cycles
        speed_um_s = train.system.speed_um_s
        um_s = max(0, speed_um_s - 73_500) if responds else speed_um_s + 102_000
        train.cycle(um_s, applied=applied, off_mm_s=off_mm_s)
        assert train.system.kept
        assert not train.is_accused()


def test_a_broken_machine_is_caught(monkeypatch: pytest.MonkeyPatch) -> None:
    """The checks above do find a watch that never expects the brake to respond."""

    def without_brake(bounds: object, watch: BrakeWatch, applied: bool) -> int:
        return watch.limit_mm_s + 102

    monkeypatch.setattr(machine, "next_limit_mm_s", without_brake)
    with pytest.raises(AssertionError):
        a_weak_brake_is_accused()
