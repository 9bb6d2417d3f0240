"""The place of a read and the fix of a tag, at their edges and along drawn cycles (T2, P7)."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

import pytest
from hypothesis import given
from hypothesis import strategies as st

from kernel.onboard import tag_fix as machine
from kernel.onboard.odometry import Motion
from kernel.onboard.tag_fix import TagLimits
from proofs.onboard.witnesses.sixty_four_bits import Checked, with_ints
from proofs.onboard.witnesses.tag_fix import (
    FRONT_MM,
    LIMITS,
    LISTED_MM,
    WITNESSES,
    Reads,
    motion,
    the_greater_speed_of_the_cycle_counts,
)

SPEEDS = st.integers(-2_000, 60_000)


@pytest.mark.parametrize("witness", WITNESSES)
def test_witness(witness: Callable[[], None]) -> None:
    assert witness.__doc__
    witness()


@given(SPEEDS, SPEEDS, st.integers(0, 100), st.integers(-257, 257), st.integers(-43, 43))
def test_wherever_in_the_cycle_the_tag_was_read_its_fix_has_the_front(
    from_mm_s: int, to_mm_s: int, left_ms: int, off_mm: int, laid_mm: int
) -> None:
    """A train that gains or loses speed evenly has run on, from the read to the cycle's end, by their mean."""
    then_um_s = 10 * (from_mm_s * left_ms + to_mm_s * (100 - left_ms))
    ran_um = (then_um_s + 1_000 * to_mm_s) * left_ms // 2_000
    read = Reads().read(from_mm_s, to_mm_s, ran_um, off_um=1_000 * off_mm, laid_um=1_000 * laid_mm)
    assert read.located
    assert read.fix.least_mm <= FRONT_MM + off_mm + laid_mm + ran_um / 1_000 <= read.fix.most_mm


@given(st.integers(0, 10**9), st.integers(-(10**9), 10**9), st.integers(-200_000, 200_000), st.integers(0, 200_000))
def test_every_number_fits_into_64_bits(error_mm: int, place_mm: int, slowest_mm_s: int, fastest_mm_s: int) -> None:
    limits = with_ints(Checked, TagLimits(antenna_mm=2_000, error_mm=error_mm))
    here: Motion = with_ints(Checked, motion(place_mm, place_mm, slowest_mm_s, fastest_mm_s))
    fix = machine.fix_of(limits, here, here, Checked(place_mm))
    assert fix.least_mm <= place_mm + 2_000 <= fix.most_mm
    assert machine.place_of_read(here, here).known


def test_a_broken_machine_is_caught(monkeypatch: pytest.MonkeyPatch) -> None:
    """The invariants do find a fix that takes the end of the cycle for the moment of the read."""

    def stands(before: Motion, after: Motion) -> int:
        return 0

    monkeypatch.setattr(machine, "ran_mm", stands)
    with pytest.raises(AssertionError, match="does not hold"):
        the_greater_speed_of_the_cycle_counts()


def test_a_wider_error_makes_a_wider_fix() -> None:
    here = motion(FRONT_MM, FRONT_MM, 0, 0)
    narrow, wide = (machine.fix_of(each, here, here, LISTED_MM) for each in (LIMITS, replace(LIMITS, error_mm=301)))
    assert (wide.least_mm, wide.most_mm) == (narrow.least_mm - 1, narrow.most_mm + 1)
