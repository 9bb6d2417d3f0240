"""Days as a target: a batch follows from its numbers, and a day on which a claim is broken is told."""

from __future__ import annotations

import json
from dataclasses import replace

import numpy as np
import pytest

from fuzz.targets import days
from fuzz.targets.days import DAYS_A_BATCH, Days
from fuzz.targets.target import Batch
from models.days.system import Numbers, System

CLAIMS, MONITORS, FAULTS = {"late": "warned late"}, {"silent": "a link was silent"}, {"fault_outage": "an outage"}


def one_day(seed: int, number: int) -> Numbers:
    """A day breaks its claim if its number is the seed."""
    return np.array([int(number == seed), number % 2, number % 3], np.int64)


SYSTEM = System("crossing", CLAIMS, {}, MONITORS, FAULTS, {}, {}, 16.0, one_day)


@pytest.fixture(autouse=True)
def one_system(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(days, "system_of", lambda name: SYSTEM)


def test_a_batch_follows_from_its_numbers() -> None:
    target = Days("crossing")
    once, again = (target.run(Batch(target.name, 3, 5, ())) for _ in range(2))
    assert replace(once, seconds=0.0) == replace(again, seconds=0.0)
    assert once.failures == ()
    assert once.steps == DAYS_A_BATCH * 16 * 3600
    assert {target.describe(each) for each in once.covered} == {
        f"{fault}: {monitor}" for fault in ("no fault", "fault_outage") for monitor in ("nothing", "silent")
    }


def test_a_day_with_a_broken_claim_is_a_failure_that_names_it() -> None:
    target = Days("crossing")
    (told,) = target.run(Batch(target.name, 2, 2 * DAYS_A_BATCH + 1, ())).failures
    found = json.loads(told)
    assert (found["day"], found["violated"], found["moments"]) == (2 * DAYS_A_BATCH + 1, ["late"], {"late": 1})
