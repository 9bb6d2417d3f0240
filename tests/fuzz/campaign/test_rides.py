"""Rides as a target: what a batch comes to is what the rides come to, and a broken claim is a failure."""

from __future__ import annotations

import json

import numpy as np
import pytest

from fuzz.campaign.rows import cause_of
from fuzz.targets import rides
from fuzz.targets.rides import FAULTS_DRAWN, NOTICED, PAIR, RIDES_A_BATCH, Rides
from fuzz.targets.target import Batch
from models.rides import campaign
from models.rides.tally import COLUMNS, VIOLATIONS, Numbers, outcome

BATCH = Batch("rides", 3, 5, ())


def ridden() -> Numbers:
    return campaign.ridden(campaign.Batch(5, 3, RIDES_A_BATCH))


@pytest.mark.slow
def test_a_batch_comes_to_what_its_rides_come_to() -> None:
    result, rows = Rides().run(BATCH), ridden()
    found = outcome(rows)
    assert (result.batch, result.traces, result.steps) == (BATCH, RIDES_A_BATCH, found.sums["cycles"])
    assert result.counts["tags_read"] == found.sums["tags_read"] > 0
    assert result.counts["untrusted"] == found.monitors["untrusted"] > 0
    assert result.failures == ()
    again = Rides().run(BATCH)
    assert (again.covered, again.pairs, again.counts) == (result.covered, result.pairs, result.counts)
    slips = sum(hits for id_, hits in result.covered.items() if Rides().describe(id_) == "slip_at_s: untrusted")
    assert 0 < slips <= found.monitors["untrusted"]


def test_tuples_are_faults_drawn_and_what_was_noticed() -> None:
    rows = np.zeros((RIDES_A_BATCH, len(COLUMNS)), np.int64)
    covered, pairs = rides.coverage(BATCH, rows)
    words = {Rides().describe(id_) for id_ in covered}
    assert "no fault: nothing" in words
    assert all(each.endswith(": nothing") for each in words)
    assert len(words) > 3
    assert all(one in covered and other in covered for one, other in (divmod(id_, PAIR) for id_ in pairs))
    rows[:, COLUMNS.index("split_found")] = 1
    noticed, _ = rides.coverage(BATCH, rows)
    assert {Rides().describe(id_) for id_ in noticed} == {each.replace("nothing", "split_found") for each in words}
    assert len(FAULTS_DRAWN) * len(NOTICED) < PAIR


def test_a_broken_claim_is_a_failure_that_says_which_ride_it_was() -> None:
    rows = np.zeros((RIDES_A_BATCH, len(COLUMNS)), np.int64)
    rows[7, COLUMNS.index("speed_outside")] = 12
    rows[9, COLUMNS.index("speed_outside")] = 1
    found = [json.loads(text) for text in rides.failures(BATCH, rows)]
    assert [each["row"] for each in found] == [7, 9]
    assert found[0]["ride"] == 3 * campaign.RUNS_A_BATCH + 7
    assert (found[0]["seed"], found[0]["violated"], found[0]["cycles"]) == (5, ["speed_outside"], {"speed_outside": 12})
    assert set(found[0]["violated"]) <= set(VIOLATIONS)
    digests = {cause_of(text) for text in rides.failures(BATCH, rows)}
    assert len(digests) == 1, "one cause"


@pytest.mark.slow
def test_the_ride_of_a_failure_can_be_ridden_again_alone() -> None:
    row = 11
    alone = campaign.ridden(campaign.Batch(5, 3, row + 1))[row]
    assert np.array_equal(alone, ridden()[row])


def test_the_identity_tells_sources_plan_and_faults() -> None:
    identity = Rides().identity()
    assert set(identity) == {"sources", "plan", "faults", "rides a batch"}
    assert len(identity["sources"]) == 64
    assert "slip_at_s 5.0 to 400.0 s, chance 0.3" in identity["faults"]
