"""Trains that promise ceilings on any day at a road: judged by the truth, with single rules left out (X2).

Beside all else trains of these days promise, ask, and hear acknowledgements that come late, again, or never; the
crossing restarts, and so do computers on board.  Days with one train show what others would hide by their warnings,
and those with one that hurries what an acknowledgement shortly before the road does.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable
from dataclasses import replace
from typing import Any

import pytest

from kernel.crossing import crossing as machine
from kernel.crossing import promise
from kernel.crossing.arrival import ArrivalBounds, Followed
from kernel.crossing.crossing import Due
from kernel.crossing.promise import NONE, Promise
from tests.crossing.any_day import Found, judge, played
from tests.crossing.road import SETTINGS

DAYS = 20


@pytest.mark.parametrize("number", range(DAYS))
def test_a_train_that_promises_and_no_other(number: int) -> None:
    """Nobody else closes the road for it."""
    judge(number, alone=True)


@pytest.mark.parametrize("number", range(DAYS))
def test_a_train_that_asks_to_go_faster_shortly_before_the_road(number: int) -> None:
    """It has come slowly, for as long as the road may stay open, and gains what it can once it is let go."""
    assert judge(number, hurries=True).counts["asked"]


@pytest.mark.slow
def test_a_thousand_trains_that_promise_and_no_other() -> None:
    for number in range(DAYS, DAYS + 1_000):
        judge(number, alone=True)
        judge(number, hurries=True)


@pytest.mark.parametrize("alone", [True, False])
def test_trains_promise_and_are_let_go_faster(alone: bool) -> None:
    counts = sum((judge(number, alone).counts for number in range(DAYS)), Counter[str]())
    assert counts["lowered"] > 100
    assert counts["asked"] > 30
    assert counts["let go faster"] > 15
    assert counts["promised to stand"] > 0
    assert counts["near a promised ceiling"] > 1_000
    assert counts["off below the line's"] > 0


def notes_what_is_old(noted: Promise, told: Promise) -> Promise:
    """Whatever is heard counts, also what was told before something newer."""
    return replace(told, ceiling_mm_s=told.asked_mm_s) if noted.number == NONE else told


def notes_the_first_as_any(noted: Promise, told: Promise) -> Promise:
    """What a train asks for after a restart of the crossing has not been acknowledged before."""
    return told if told.number > noted.number else noted


def takes_any_acknowledgement(held: Promise, _number: int) -> Promise:
    """An acknowledgement of an ask that was given up counts for this one."""
    return replace(held, ceiling_mm_s=held.asked_mm_s)


def lowers_at_any_speed(held: Promise, ceiling_mm_s: int, _speed_most_mm_s: int) -> Promise:
    """A train promises to run slower than it runs."""
    return held if ceiling_mm_s > held.ceiling_mm_s else Promise(held.number + 1, ceiling_mm_s, ceiling_mm_s)


def goes_faster_unheard(line_mm_s: int, held: Promise, asked_mm_s: int) -> Promise:
    """Who asks to go faster does so."""
    if not held.ceiling_mm_s < asked_mm_s <= line_mm_s:
        return held
    return Promise(held.number + 1, asked_mm_s, asked_mm_s)


@pytest.mark.parametrize(
    ("module", "rule", "wrong", "number"),
    [
        (promise, "note", notes_what_is_old, 0),
        (promise, "note", notes_the_first_as_any, 162),
        (promise, "note_acknowledged", takes_any_acknowledgement, 2),
        (promise, "lower", lowers_at_any_speed, 0),
        (promise, "ask", goes_faster_unheard, 0),
    ],
    ids=lambda value: getattr(value, "__name__", "").rpartition(".")[2],
)
def test_a_rule_that_is_left_out_is_seen(
    module: Any, rule: str, wrong: Callable[..., Any], number: int, monkeypatch: pytest.MonkeyPatch
) -> None:
    """By a train to which it matters; with the rule it is as any other."""
    judge(number, alone=True)
    monkeypatch.setattr(module, rule, wrong)
    assert is_broken(played(number, alone=True))


def is_broken(found: Found) -> bool:
    warned_ms = min(found.warned_ms, default=10**6)
    return found.beyond_ceiling > 0 or warned_ms < SETTINGS.cycle_ms * SETTINGS.warning_cycles


def lets_go_whoever_asks(bounds: ArrivalBounds, followed: Followed, asked_um: int, _reopening_cycles: int) -> bool:
    """An ask is acknowledged wherever the train is."""
    return followed.ceiling_um <= asked_um <= bounds.line_um


def lets_go_who_is_far_as_it_runs(
    bounds: ArrivalBounds, followed: Followed, asked_um: int, reopening_cycles: int
) -> bool:
    """An ask is acknowledged to a train that is far by the ceiling that it has, not by what it asks for."""
    is_far = machine.due(bounds, followed, reopening_cycles) == Due.FAR
    return lets_go_whoever_asks(bounds, followed, asked_um, reopening_cycles) and is_far


@pytest.mark.parametrize("wrong", [lets_go_whoever_asks, lets_go_who_is_far_as_it_runs])
def test_who_is_let_go_faster_too_late_is_seen(wrong: Callable[..., bool], monkeypatch: pytest.MonkeyPatch) -> None:
    """Its warning began with the acknowledgement, and it gained all the way from there."""
    monkeypatch.setattr(machine, "may_go_faster", wrong)
    assert any(is_broken(played(number, hurries=True)) for number in range(DAYS))
