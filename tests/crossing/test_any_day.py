"""Days at a road with everything at once: judged by the truth, with what they hold, and with single rules left out."""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable
from dataclasses import replace
from functools import cache
from typing import Any

import pytest

from kernel.crossing import arrival, start_point
from kernel.crossing import crossing as machine
from kernel.crossing.arrival import ArrivalBounds, Followed, Ranging
from kernel.crossing.crossing import Crossing, CrossingTrack, Due, Settings, Train
from kernel.crossing.start_point import StartPoint, StartPointSettings
from kernel.maps import Map
from kernel.names import Tag
from tests.crossing.any_day import Found, judge, played

DAYS = 20
DECIDE, HAS_TURNED_BACK = machine.decide, arrival.has_turned_back


@cache
def judged(number: int) -> Found:
    return judge(number)


@pytest.mark.parametrize("number", range(DAYS))
def test_any_day(number: int) -> None:
    assert judged(number).warned_ms


def test_power_fails_with_trains_inside_and_trains_are_let_go() -> None:
    days = [judged(number) for number in range(DAYS)]
    assert sum(day.failed_inside for day in days) > 20
    assert sum(day.let_go for day in days) > 5
    assert sum(day.open_s for day in days) > 20 * 100
    assert sum(len(day.warned_ms) for day in days) > 40


@pytest.mark.parametrize(
    ("what", "least"),
    [
        ("stood on the road", 100),
        ("stood near the road", 100),
        ("came back", 10),
        ("silent", 5),
        ("missed", 3),
        ("own", 10),
        ("not told", 10),
        ("gone again", 2),
    ],
)
def test_the_days_have(what: str, least: int) -> None:
    counts = sum((judged(number).counts for number in range(DAYS)), Counter[str]())
    assert counts[what] >= least


@pytest.mark.slow
def test_a_thousand_days() -> None:
    for number in range(DAYS, DAYS + 1_000):
        judge(number)


# ---- single rules left out


def opens_after_a_failure(settings: Settings, crossing: Crossing, dues: Map[Train, Due]) -> Crossing:
    """A track that nobody has seen empty asks for no warning."""
    decided = DECIDE(settings, crossing, dues)
    if any(asks for _train, asks in decided.asks.items()):
        return decided
    return replace(decided, warns=False, warned_cycles=0)


def misses_nothing(crossing: Crossing, _track: CrossingTrack) -> Crossing:
    """A terminal's start is no reason to look."""
    return crossing


def hears_no_silence(_settings: Settings, crossing: Crossing) -> bool:
    """A terminal that says nothing has nothing to say."""
    return any(asks for _train, asks in crossing.asks.items()) or any(
        unaccounted for _track, unaccounted in crossing.unaccounted.items()
    )


def starts_at_once(_settings: Settings, crossing: Crossing, train: Train) -> bool:
    """Who asks to start is let go."""
    return train in crossing.starts


def takes_a_read_after_its_strike(
    settings: StartPointSettings, point: StartPoint, train: Train, _tag: Tag
) -> StartPoint:
    """What is told late waits for the strike of whoever comes next."""
    return replace(point, reader=train, left_cycles=settings.waits_cycles)


def gone_by_any_number(crossing: Crossing, gone: Train, _number: int, _is_whole: bool) -> Crossing:
    """A word of an earlier run counts for this one."""
    return machine.forgotten(crossing, gone)


@pytest.mark.parametrize(
    ("module", "rule", "wrong", "number"),
    [
        (machine, "decide", opens_after_a_failure, 1),
        (machine, "note_missed", misses_nothing, 58),
        (machine, "must_warn", hears_no_silence, 8),
        (machine, "may_start", starts_at_once, 4),
        (start_point, "note_read", takes_a_read_after_its_strike, 67),
        (machine, "note_gone", gone_by_any_number, 16),
    ],
    ids=lambda value: getattr(value, "__name__", "").rpartition(".")[2],
)
def test_a_rule_that_is_left_out_is_seen(
    module: Any, rule: str, wrong: Callable[..., Any], number: int, monkeypatch: pytest.MonkeyPatch
) -> None:
    """On a day on which it matters; with the rule that day is as any other."""
    judge(number)
    monkeypatch.setattr(module, rule, wrong)
    with pytest.raises(AssertionError):
        judge(number)


def wherever_it_is(bounds: ArrivalBounds, followed: Followed, ranging: Ranging, _start_mm: int) -> bool:
    """Whoever runs away is let go."""
    return HAS_TURNED_BACK(bounds, followed, ranging, -10_000_000)


def test_who_is_let_go_inside_is_seen(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(arrival, "has_turned_back", wherever_it_is)
    assert any(played(number).let_go_inside for number in range(DAYS))


def nobody(_bounds: ArrivalBounds, _followed: Followed, _ranging: Ranging, _start_mm: int) -> bool:
    return False


def test_if_nobody_is_let_go_the_road_is_closed_for_longer(monkeypatch: pytest.MonkeyPatch) -> None:
    """The radio of who runs away fails, and nobody has come to look."""
    let_go_s = sum(judged(number).open_s for number in range(DAYS))
    monkeypatch.setattr(arrival, "has_turned_back", nobody)
    assert sum(played(number).open_s for number in range(DAYS)) < let_go_s
