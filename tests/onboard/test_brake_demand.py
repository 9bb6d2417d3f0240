"""Who gets the brake, and that the check of it can fail (T5, T12, P5)."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

import pytest

from kernel.onboard import brake_demand as machine
from kernel.onboard.brake_demand import Known, TrainLimits
from proofs.onboard.witnesses.brake_demand import SITE, WELL, WITNESSES, each_of_them_gets_the_brake


@pytest.mark.parametrize("witness", WITNESSES)
def test_witness(witness: Callable[[], None]) -> None:
    assert witness.__doc__
    witness()


def test_nobody_demands_the_brake_of_a_train_that_is_well() -> None:
    assert not machine.is_demanded(SITE.limits, WELL, True)


def test_a_tail_not_heard_demands_nothing() -> None:
    """Out of coverage nothing behind the train is released, and it runs on (ours)."""
    lost = replace(WELL, wholeness=replace(WELL.wholeness, lost=True, in_a_row=0))
    assert not machine.is_demanded(SITE.limits, lost, True)


def test_a_broken_machine_is_caught(monkeypatch: pytest.MonkeyPatch) -> None:
    """The invariants do find a demand that one machine's word is missing from."""

    def deaf(limits: TrainLimits, known: Known, may_proceed: bool) -> bool:
        return known.watch.broken

    monkeypatch.setattr(machine, "is_demanded", deaf)
    with pytest.raises(AssertionError, match="does not hold"):
        each_of_them_gets_the_brake()
