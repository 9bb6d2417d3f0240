"""Traffic by the compiled driver: it follows from its numbers, replays in CPython, and breaks nothing it should not."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from fuzz.compiled.native import REFUSED, native
from fuzz.traffic import places, tables
from fuzz.traffic.faults import FAULTS, families
from fuzz.traffic.runs import CHANGED, NO_REASON, OUTCOMES, STAGES, Traffic, describe, run_batch
from kernel.refusal import Refusal
from models.layouts.loading import load
from models.simulator.play import WORLD, site_of, two_cars_each
from models.world.start import start

ROOT = Path(__file__).resolve().parents[3]
UNREACHABLE = {Refusal.UNKNOWN_TRAIN, Refusal.UNKNOWN_BLOCK}
"""Every train that has a number is in the register, and every block that has one is of the line."""
WITHOUT_FOULING = {Refusal.FOULING_BLOCK_HELD, Refusal.FOULING_BLOCK_LOST}
"""No two blocks of the passing station foul each other."""


@pytest.fixture(scope="module")
def traffic() -> Traffic:
    imported = load(ROOT / "layouts" / "passing_station.toml")
    cars = two_cars_each(sorted(imported.layout.fleet))
    return Traffic(native(site_of(imported.layout, imported.ground, imported.records, cars)))


def test_a_trace_follows_from_its_numbers(traffic: Traffic) -> None:
    first, events = traffic.run(5, 1, 2), list(traffic.events())
    state = traffic.memory.copy()
    assert traffic.run(5, 1, 3) != first
    assert traffic.run(5, 1, 2) == first
    assert list(traffic.events()) == events
    low, high = traffic.native.memory.bounds()
    assert np.array_equal(traffic.memory[low:high], state[low:high])


def test_a_batch_follows_from_its_numbers(traffic: Traffic) -> None:
    assert run_batch(traffic, 3, 1, 20) == run_batch(traffic, 3, 1, 20)


def test_what_the_driver_did_replays_in_cpython_to_the_same_state(traffic: Traffic) -> None:
    steps = 0
    for number in range(6):
        outcome = traffic.run(11, 0, number, beyond=False)
        trace = traffic.trace(11, 0, number, outcome)
        site = traffic.native.memory.site
        system = start(site, trace.at, trace.lies)
        for at, event in enumerate(trace.events):
            after = WORLD[event.step](site, system, **event.event)
            assert after != system, f"event {at}, {event}, changes nothing"
            system = after
        assert traffic.native.memory.unpack(traffic.memory) == system
        assert traffic.native.memory.hash(traffic.memory) == traffic.memory[traffic.desk.words[places.STATE_HASH]]
        steps += len(trace.events)
    assert steps > 2_000


def test_no_invariant_is_false_within_the_assumptions(traffic: Traffic) -> None:
    batch = run_batch(traffic, 1, 0, 150, beyond=False)
    assert batch.failures == ()
    assert batch.beyond == ()
    assert batch.accepted > 100_000


def test_a_fault_beyond_the_assumptions_is_named_by_the_assumption(traffic: Traffic) -> None:
    only = [1.0 if fault.beyond else 0.0 for fault in FAULTS]
    batch = run_batch(traffic, 1, 0, 400, only)
    assert batch.failures == ()
    assert len(batch.beyond) > 10
    for trace in batch.beyond:
        breaks = {name for fault in FAULTS if fault.name in trace.faults for name in fault.breaks}
        assert set(trace.broken_assumptions) & breaks
        assert any(event.beyond for event in trace.events)


def test_every_transition_changes_something_and_every_refusal_that_can_be_is_met(traffic: Traffic) -> None:
    covered = run_batch(traffic, 2, 0, 400).covered
    changed = {found // OUTCOMES // len(STAGES) for found in covered if found % OUTCOMES == CHANGED}
    refusals = {REFUSED[found % OUTCOMES] for found in covered if found % OUTCOMES < NO_REASON}
    assert changed == set(range(tables.KINDS))
    assert refusals == set(REFUSED) - UNREACHABLE - WITHOUT_FOULING


def test_without_faults_trains_finish_their_journeys(traffic: Traffic) -> None:
    batch = run_batch(traffic, 1, 0, 40, [0.0] * len(FAULTS))
    assert batch.failures == ()
    assert batch.journeys * 3_000 >= 20 * batch.accepted
    assert batch.counts["ended: timetable ended"] > 5


def test_weights_say_how_many_traces_have_a_fault(traffic: Traffic) -> None:
    at = families().index("unit restart")
    often, never = ([scale if each == at else 1.0 for each in range(len(FAULTS))] for scale in (100.0, 0.0))
    assert run_batch(traffic, 1, 0, 64, often).counts["traces with unit restart"] > 32
    counts = run_batch(traffic, 1, 0, 64, never).counts
    assert counts["traces with unit restart"] == counts["drawn: unit restart"] == 0


def test_standing_still_is_counted_by_its_cause(traffic: Traffic) -> None:
    loss = [20.0 if fault.name == "radio loss" else 0.0 for fault in FAULTS]
    calm = run_batch(traffic, 1, 0, 30, [0.0] * len(FAULTS)).counts
    lossy = run_batch(traffic, 1, 0, 30, loss).counts
    assert calm["standstill seconds: radio loss"] == 0 < calm["standstill seconds: timetable"]
    assert lossy["standstill seconds: radio loss"] > 0


def test_oracles_change_nothing_in_what_is_drawn(traffic: Traffic) -> None:
    bare = Traffic(traffic.native, oracles=False, why=False)
    with_oracles, without = (run_batch(each, 4, 0, 20, beyond=False) for each in (traffic, bare))
    assert (with_oracles.steps, with_oracles.accepted) == (without.steps, without.accepted)
    assert with_oracles.sketch == without.sketch


def test_a_tuple_is_told_in_words() -> None:
    found = (tables.REQUEST * len(STAGES) + 5) * OUTCOMES + REFUSED.index(Refusal.BLOCK_LOST)
    assert describe(found) == f"request, no run at the centre: {Refusal.BLOCK_LOST.value}"
