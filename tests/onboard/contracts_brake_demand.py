"""Contracts on the demand for the brake for CrossHair (`make crosshair`): leading asserts assume."""

from __future__ import annotations

from dataclasses import replace

from kernel.onboard.brake_demand import decide, is_demanded
from kernel.onboard.braking import Brake
from proofs.onboard.witnesses.brake_demand import SITE, WELL


def a_train_too_fast_is_braked(speed_mm_s: int) -> None:
    """And one that is not is not (T12)."""
    assert isinstance(speed_mm_s, int)
    known = replace(WELL, motion=replace(WELL.motion, speed_most_mm_s=speed_mm_s))
    assert is_demanded(SITE.limits, known, True) == (not 0 <= speed_mm_s <= 36_000)


def what_any_machine_found_is_obeyed(broken: bool, back: bool, split: bool, passed: bool, proceeds: bool) -> None:
    """Whatever the driver acknowledges (T5, T12, P5)."""
    assert isinstance(broken, bool)
    known = replace(
        WELL,
        watch=replace(WELL.watch, broken=broken),
        movement=replace(WELL.movement, reversed=back),
        wholeness=replace(WELL.wholeness, split=split),
        window=replace(WELL.window, passed=passed),
    )
    after = decide(SITE.limits, Brake(applied=False, end_mm=5_000_000), known, proceeds, True)
    assert after.applied == (broken or back or split or passed or not proceeds)
