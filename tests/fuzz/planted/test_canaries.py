"""Canaries: one of each kind, found by plain traffic and plain walks, and missed where there is nothing to find."""

from __future__ import annotations

import json
from collections.abc import Sequence

import pytest

from fuzz.failures.replaying import replay
from fuzz.failures.trace import Trace, parse
from fuzz.planted import canaries
from fuzz.planted.canaries import KINDS, NOTHING_SHOWN, Canary, Found, found, verdict
from fuzz.planted.draw import described
from fuzz.planted.plain import NO_FAULT, PlainTraffic, PlainWalks
from models.layouts import load
from proofs.mutated import Sources
from tests.layouts.stations import SAMPLES

STATION = next(path for path in SAMPLES if path.stem == "passing_station")
SEED = 1
BATCHES = 40


def test_every_kind_has_faults_to_draw() -> None:
    assert all(names for names in canaries.findable().values())
    drawn = canaries.canaries(SEED)
    assert [canary.kind for canary in drawn] == [kind.name for kind in KINDS]
    assert drawn == canaries.canaries(SEED)
    assert len({canaries.canaries(seed) for seed in range(5)}) > 1


@pytest.mark.parametrize("seed", [SEED, 2])
def test_plain_walks_find_every_canary(seed: int) -> None:
    sought = []
    for canary in canaries.canaries(seed):
        result = found(canary, PlainWalks(canary.fault.theory).run_batch, batches=BATCHES)
        sought.append((canary, result))
        assert result is not None, canary.name
        print(f"{canary.kind}: {canary.name}: {result.batches} walks, {result.seconds:.1f} s")
        assert result.batches <= canaries.SOON
        assert json.loads(result.failure)["violated"]
    assert verdict(sought).startswith(f"all {len(KINDS)} canaries found")


TRAFFIC = (
    "kernel.claims.end_claims: union centre.claimed",
    "kernel.claims.end_claims: union grant.ended",
    "kernel.restarts.restart_centre: update claimed={}",
)


@pytest.mark.parametrize("name", TRAFFIC)
def test_plain_traffic_finds_a_fault_and_its_trace_replays(name: str) -> None:
    canary = Canary("third loop", "", described(name))
    result = found(canary, PlainTraffic(STATION).run_batch, batches=BATCHES)
    assert result is not None
    trace = parse("a failure", result.failure)
    assert isinstance(trace, Trace)
    assert trace.planted == name
    again = replay(trace, load(STATION))
    assert (again.violated, again.at_step) == (trace.violated, len(trace.events))
    assert result.batches <= BATCHES
    assert len(trace.events) <= 1_000


def test_the_sound_kernel_has_no_failures() -> None:
    traffic = PlainTraffic(STATION)
    batches = [traffic.batch(NO_FAULT, number) for number in range(4)]
    assert [batch.failures for batch in batches] == [()] * 4
    assert sum(batch.steps for batch in batches) >= 200


def test_a_canary_that_is_not_found_makes_the_campaign_worth_nothing() -> None:
    """A campaign that runs the sound kernel in place of the canary's finds nothing, and says so."""

    def blind(_: Sources, number: int) -> Sequence[str]:
        return PlainTraffic(STATION, seconds=50).run_batch(NO_FAULT, number)

    drawn = canaries.canaries(SEED)
    assert found(drawn[0], blind, batches=2) is None
    said = verdict([(drawn[0], None), *((canary, Found(canary, 1, 0.5, "{}")) for canary in drawn[1:])])
    assert NOTHING_SHOWN in said
    assert drawn[0].name in said
    assert f"1 of {len(drawn)}" in said
    assert NOTHING_SHOWN in verdict([])


def test_a_canary_lives_no_longer_than_its_time() -> None:
    canary = canaries.canaries(SEED)[0]
    assert found(canary, lambda _, __: (), seconds=0.0) is None
