"""Jolted states: the sound kernel breaks nothing in them, planted faults do, and what the engine says is checked."""

from __future__ import annotations

import ctypes
import json
from collections.abc import Callable
from dataclasses import replace
from functools import cache
from itertools import count

import numpy as np
import pytest

from fuzz.failures.events import decoded
from fuzz.failures.replaying import UNDEFINED
from fuzz.jolted.confirming import AGREES, NAMES, asked, confirmed, unpacked
from fuzz.jolted.leaves import leaves_of
from fuzz.jolted.searching import SEEDS, Found, Search
from fuzz.jolted.seeds import runs_in, site_for, states
from fuzz.jolted.telling import differing
from fuzz.machines.places import TINY
from fuzz.targets.jolted import Jolted, search_on
from fuzz.targets.target import Batch, Result
from models.layouts import load
from models.world.start import start
from proofs.mutated import Sources
from proofs.transitions import TRANSITIONS
from tests.layouts.stations import ROOT

ROUNDS = 1_500
"""Some six hundred thousand events."""
OLD_LIFE = "kernel.standing.answer: or-operand life <= unit.life"
UNREACHED = {
    OLD_LIFE: "answer",
    "kernel.recovery.asks_how_it_lies: and-operand grant.stage == Stage.STANDING": "send_enquiry",
    "kernel.tail_evidence.reports_left: guard if evidence is None or evidence.left != left"
    " or evidence.entered != entered: False": "send_tail_report",
}
"""Faults that traffic does not come upon, and the step that shows each."""


@cache
def result(fault: str | None = None, number: int = 0) -> Result:
    target = Jolted(TINY, fault, ROUNDS)
    assert target.name == "jolted:tiny.toml"
    return target.run(Batch(target.name, number, 4, ()))


@cache
def found() -> Found:
    return search()[0].run(4, 0, ROUNDS)


def search(fault: str | None = None) -> tuple[Search, Sources]:
    return search_on(TINY, fault)


def test_the_sound_kernel_breaks_nothing() -> None:
    came = result()
    assert came.failures == ()
    assert came.steps > 500_000
    assert came.counts["events that changed something"] > 10_000
    assert came.counts["jolts let stand"] > 5_000
    assert came.counts["events taken in CPython too"] > 200
    assert came.counts["states undefined in CPython"] == 0


def test_nearly_every_transition_is_accepted_somewhere() -> None:
    accepted = {Jolted(TINY).describe(each) for each in result().covered}
    missing = {step.__name__ for step in TRANSITIONS if f"{step.__name__}: accepted" not in accepted}
    assert len(missing) <= 3, missing
    assert sum(said.startswith("release_block: ") for said in accepted) >= 4


def test_sampled_states_are_jolted_and_fulfil_every_invariant_in_cpython() -> None:
    native, seeds = search()[0].native, {repr(system) for system, _ in states(load(TINY), 400)}
    sampled = found().finds[::10]
    befores = [unpacked(native, find)[1] for find in sampled]
    assert all(asked(native.memory.site, system) == ((), ()) for system in befores)
    assert sum(repr(system) not in seeds for system in befores) > 0.8 * len(befores)


def test_a_jolted_state_is_packed_as_if_it_came_from_cpython() -> None:
    """What is under an absent key is zero, whatever was there before."""
    memory = search()[0].native.memory
    low, high = memory.bounds()
    rows = memory.arrays["radio_tail_reports"]
    for find in found().finds[::10]:
        words, system, _ = unpacked(search()[0].native, find)
        packed = memory.new()
        memory.pack(packed, system, memory.runs_in(words))
        for each in (packed, words):  # a list may stand in any order
            table = each[rows.base : rows.base + rows.size].reshape(rows.shape)
            table[:] = table[np.lexsort(table.T)]
        assert (packed[low:high] == words[low:high]).all()


def test_every_word_of_a_state_is_in_a_leaf() -> None:
    memory = search()[0].native.memory
    known = {array.name for leaf in leaves_of(memory) for array in (leaf.array, leaf.other) if array is not None}
    low, high = memory.bounds()
    parts = {name for name, array in memory.arrays.items() if low <= array.base < high}
    assert parts - known == {"radio_tail_reports", "radio_tail_reports_count"}


@pytest.mark.slow
@pytest.mark.parametrize("fault", UNREACHED)
def test_a_fault_that_traffic_does_not_reach_is_found(fault: str) -> None:
    failures = [json.loads(text) for text in result(fault).failures]
    assert UNREACHED[fault] in {failure["step"] for failure in failures}
    assert all(failure["planted"] == {"name": fault} for failure in failures)
    assert not any(AGREES in failure["violated"] for failure in failures)
    shown = next(failure for failure in failures if failure["step"] == UNREACHED[fault])
    assert set(shown["violated"]) <= {*NAMES, UNDEFINED}
    assert decoded(shown["step"], shown["event"])
    assert shown["state"]


@pytest.mark.slow
def test_a_look_up_of_what_is_not_there_is_found_by_comparison() -> None:
    """The engine reads zero there and breaks nothing; CPython raises."""
    fault = "kernel.terminal.relabel: and-operand terminal.holds is not None"
    batches = (result(fault, number) for number in range(8))
    assert any(json.loads(text)["violated"] == [UNDEFINED] for came in batches for text in came.failures)


def test_a_batch_is_the_same_again() -> None:
    again = Jolted(TINY, None, ROUNDS).run(Batch("jolted:tiny.toml", 0, 4, ()))
    assert replace(again, seconds=0.0) == replace(result(), seconds=0.0)
    assert result(None, 1).covered != result().covered


@pytest.mark.slow
def test_what_is_found_does_not_depend_on_what_was_searched_before() -> None:
    fault = OLD_LIFE
    first = result(fault).failures
    search(fault)[0].run(4, 7, 200)
    target = Jolted(TINY, fault, ROUNDS)
    assert target.run(Batch(target.name, 0, 4, ())).failures == first


def said_with(judge: Callable[[], int]) -> list[tuple[str, ...]]:
    """What CPython says of the finds of a search that somebody else judges."""
    native = search()[0].native
    called = ctypes.CFUNCTYPE(ctypes.c_int64, ctypes.c_void_p)(lambda words: judge())
    address = ctypes.cast(called, ctypes.c_void_p).value
    assert address is not None
    spoilt = replace(native, addresses={**native.addresses, "judge": address})
    return [confirmed(native, {}, find).violated for find in Search(spoilt, load(TINY)).run(4, 0, 40).finds]


def test_a_judge_that_is_always_content_is_noticed() -> None:
    said = said_with(lambda: -1)
    assert said.count((AGREES,)) > len(said) / 2


def test_a_judge_that_finds_what_is_not_so_is_noticed() -> None:
    asked_before = count()
    seeds = len(states(load(TINY), SEEDS))
    said = said_with(lambda: -1 if next(asked_before) < seeds else 3)
    assert (AGREES,) in said


@pytest.mark.slow
def test_a_step_that_does_something_else_is_noticed() -> None:
    """Found with a fault planted in the engine and none in CPython: the two are not of one mind."""
    native = search(OLD_LIFE)[0].native
    finds = search(OLD_LIFE)[0].run(4, 0, ROUNDS).finds
    said = [confirmed(native, {}, find, False) for find in finds if find.judged is not None]
    assert said
    assert {each.violated for each in said} == {(AGREES,)}
    assert all(each.why for each in said)


def test_a_state_is_told_by_what_differs_from_the_start() -> None:
    site = site_for(load(TINY))
    met = states(load(TINY), 60)
    at, lies = dict(met[0][0].track.at.items()), dict(met[0][0].track.lies.items())
    assert differing(site, start(site, at, lies)) == {}
    told = differing(site, met[40][0])
    assert any(path.startswith("centre.runs[") for path in told)


def test_seeds_have_every_run_in_a_slot() -> None:
    for system, runs in states(load(TINY), 60):
        assert set(runs_in(system)) <= set(runs)
        assert len(set(runs)) == len(runs)


@pytest.mark.slow
def test_the_sound_kernel_breaks_nothing_at_a_junction() -> None:
    target = Jolted(ROOT / "layouts" / "junction.toml", None, ROUNDS)
    came = target.run(Batch(target.name, 0, 4, ()))
    assert came.failures == ()
    assert came.steps > 500_000
    assert came.counts["events that changed something"] > 5_000
