"""The watch on reverse movement at its edges, and along drawn ways (T5)."""

from __future__ import annotations

from collections.abc import Callable

import pytest
from hypothesis import given
from hypothesis import strategies as st

from kernel.onboard import reverse_movement as machine
from kernel.onboard.odometry import Readings
from kernel.onboard.reverse_movement import Movement, ReverseLimits
from proofs.onboard.witnesses.reverse_movement import (
    LIMITS,
    WITNESSES,
    Train,
    a_train_that_goes_on_rolling_back_is_found,
)
from proofs.onboard.witnesses.sixty_four_bits import GREATEST, LEAST, Checked, with_ints


@pytest.mark.parametrize("witness", WITNESSES)
def test_witness(witness: Callable[[], None]) -> None:
    assert witness.__doc__
    witness()


@given(st.lists(st.integers(-900, 900), max_size=40))
def test_it_is_found_when_the_way_back_passes_the_limit_and_not_before(steps: list[int]) -> None:
    train = Train()
    train.move(0)
    at_mm = farthest_mm = 0
    found = False
    for step_mm in steps:
        at_mm += step_mm
        farthest_mm = max(farthest_mm, at_mm)
        found = found or farthest_mm - at_mm > LIMITS.roll_back_mm
        assert train.move(at_mm) == found


@given(st.integers(LEAST, GREATEST), st.integers(LEAST, GREATEST), st.booleans())
def test_any_reading_is_answered_within_64_bits(way_mm: int, speed_mm_s: int, valid: bool) -> None:
    limits, movement = with_ints(Checked, ReverseLimits(10**12)), with_ints(Checked, machine.LOCATED)
    readings = with_ints(Checked, Readings(100, valid, speed_mm_s, way_mm, True, 0))
    after = machine.note_cycle(limits, movement, readings)
    assert not after.reversed
    assert -(10**12) <= after.furthest_mm <= 10**12


def test_a_broken_machine_is_caught(monkeypatch: pytest.MonkeyPatch) -> None:
    """The invariants do find a watch whose farthest place goes back with the train."""

    def follows(limits: ReverseLimits, movement: Movement, readings: Readings) -> Movement:
        return Movement(readings.way_mm, readings.way_mm + limits.roll_back_mm < movement.furthest_mm)

    monkeypatch.setattr(machine, "note_cycle", follows)
    with pytest.raises(AssertionError, match="does not hold"):
        a_train_that_goes_on_rolling_back_is_found()
