"""Shrinking never loses the violation, leaves nothing that could go, and is the same every time."""

from __future__ import annotations

from dataclasses import replace

import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from fuzz.failures.causes import cause_of
from fuzz.failures.replaying import replay
from fuzz.failures.shrinking import Shrunk, renumbered, shrink
from fuzz.failures.trace import Trace, text_of
from kernel.names import Block, Serial
from tests.fuzz.failures.samples import PLANTED, failing, found, imported, traffic
from tests.fuzz.failures.test_replaying import answers, at_the_start


def shrunk(planted: str) -> Shrunk:
    return shrink(found(planted), imported(PLANTED[planted][0]))


@pytest.mark.sampled(3)
@pytest.mark.parametrize("planted", PLANTED)
def test_what_is_left_fails_alike_and_nothing_of_it_can_go(planted: str) -> None:
    place = imported(PLANTED[planted][0])
    first = replay(found(planted), place).violated[0]
    less = shrunk(planted)
    again = replay(less.trace, place)
    assert first in again.violated
    assert again.as_told
    assert again.at_step == len(less.trace.events) < less.before / 2
    assert less.before == len(found(planted).events)
    assert all(outcome.changed for outcome in again.outcomes)
    for at in range(len(less.trace.events) - 1):
        without = (*less.trace.events[:at], *less.trace.events[at + 1 :])
        assert first not in replay(replace(less.trace, events=without), place).violated
    serials = {
        value.serial for event in less.trace.events for value in event.event.values() if hasattr(value, "serial")
    }
    assert serials == set(range(1, len(serials) + 1))


def test_the_same_trace_gives_the_same_text() -> None:
    planted = "a terminal that obeys an older run"
    assert text_of(shrunk(planted).trace) == text_of(shrunk(planted).trace) == text_of(failing())


def test_trains_that_have_no_part_in_it_are_left_out() -> None:
    planted = "a tag list is taken in any life"
    assert len(found(planted).trains) == 3
    less = shrunk(planted).trace
    assert len(less.trains) == 1
    assert set(less.at) == {car for cars in less.trains.values() for car in cars}


@pytest.mark.parametrize("budget", [1, 2, 5, 40])
def test_a_small_budget_gives_what_was_reached(budget: int) -> None:
    planted = "a terminal that obeys an older run"
    less = shrink(found(planted), imported(PLANTED[planted][0]), budget)
    again = replay(less.trace, imported(PLANTED[planted][0]))
    assert again.as_told
    assert again.reproduced
    assert less.replays <= budget + 2
    assert len(less.trace.events) >= len(failing().events)


def test_what_does_not_fail_is_given_back_as_it_is() -> None:
    trace = traffic("terminus", 2, seconds=60)
    less = shrink(trace, imported("terminus"))
    assert less.trace == trace
    assert less.replays == 1
    assert not less.replay.reproduced


def test_a_violation_at_the_start_needs_no_event() -> None:
    trace = found("a terminal that obeys an older run")
    together = replace(trace, at=dict.fromkeys(trace.at, frozenset({Block("track 1")})))
    less = shrink(together, imported("passing_station"))
    assert less.replay.at_step == 0
    assert less.trace.events == ()
    assert cause_of(less.trace).step == "start"


def test_events_are_within_nature_where_they_can_be() -> None:
    trace, train, _ = at_the_start()
    taken = [replace(event, beyond=True) for event in answers(trace, train, frozenset({Block("east section")}), True)]
    less = shrink(replace(trace, planted=None, events=tuple(taken)), imported("passing_station")).trace
    assert [event.step for event in less.events if event.beyond] == ["answer"]
    assert less.broken_assumptions == ("a_located_train_stands_where_it_says",)


@settings(max_examples=15, suppress_health_check=[HealthCheck.too_slow])
@given(st.sampled_from(sorted(PLANTED)), st.integers(0, 2**32))
def test_no_traffic_loses_its_violation(planted: str, seed: int) -> None:
    place = PLANTED[planted][0]
    trace = traffic(place, seed, planted, seconds=200)
    whole = replay(trace, imported(place))
    less = shrink(trace, imported(place), 400)
    again = replay(less.trace, imported(place))
    assert again.reproduced is whole.reproduced
    if whole.reproduced:
        assert whole.violated[0] in again.violated
        assert again.as_told


# ---- causes


def test_a_cause_does_not_depend_on_names_numbers_or_who_did_it() -> None:
    trace = failing()
    others = tuple(replace(event, by="radio repetition") for event in trace.events)
    assert cause_of(replace(trace, events=others, seed=9, batch=9, number=9)) == cause_of(trace)
    number = {Serial(serial): Serial(serial + 10) for serial in range(1, 100)}
    late = tuple(renumbered(event, number) for event in trace.events)
    assert late != trace.events
    assert cause_of(replace(trace, events=late)).digest == cause_of(trace).digest


def test_another_cause_has_another_digest() -> None:
    causes = {cause_of(shrunk(planted).trace).digest for planted in PLANTED}
    assert len(causes) == len(PLANTED)
    trace = failing()
    assert cause_of(replace(trace, planted=None)).digest != cause_of(trace).digest
    assert cause_of(replace(trace, broken_assumptions=("rails_lead",))).digest != cause_of(trace).digest
    assert cause_of(trace).name.startswith(f"{trace.violated[0]}-")


def test_traffic_by_other_seeds_finds_the_same_cause_again() -> None:
    planted, place = "a tag list is taken in any life", "junction"
    found_by = [trace_of(planted, place, seed) for seed in range(6)]
    causes = [cause_of(trace).digest for trace in found_by if trace.violated]
    assert len(causes) >= 3
    assert len(set(causes)) < len(causes)


def trace_of(planted: str, place: str, seed: int) -> Trace:
    return shrink(traffic(place, seed, planted), imported(place)).trace


def test_a_trace_in_which_nothing_is_violated_has_no_cause() -> None:
    with pytest.raises(ValueError, match="nothing is violated"):
        cause_of(replace(failing(), violated=()))
