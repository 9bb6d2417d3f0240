"""Trams of two lines on both ways of a street, an hour each: what must hold, what came about, and rules left out.

The world is in ``tests/tram/two_ways.py``, street and units in ``tests/tram/street.py``.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Iterable
from dataclasses import replace
from functools import cache
from types import ModuleType
from typing import Any

import pytest

from kernel.tram import centre as dispatcher
from kernel.tram import cycle, dispatching, map_matching, stopping
from kernel.tram import display as on_board
from kernel.tram.centre import Centre, Command, Tram
from kernel.tram.cycle import Answer, CycleLimits, Heard
from kernel.tram.dispatching import DispatchLimits, Known, Report, mark
from kernel.tram.display import Display
from kernel.tram.limits import are_lawful, are_lawful_at_stops, are_told_apart
from kernel.tram.map_matching import Found, MatchLimits
from kernel.tram.stopping import Fix, StopLimits, Stopping
from tests.tram.street import APART_MM, FIX_ERROR_MM, MATCH, NEAR
from tests.tram.two_ways import BEYOND, CYCLE, LIMITS, ORDINARY, World, random_world

FEW, MANY = range(20), range(20, 1_020)
Rule = tuple[ModuleType, str, Callable[..., Any]]


def broken(worlds: Iterable[World]) -> Counter[str]:
    """What was broken in some worlds."""
    return +sum((world.broken for world in worlds), Counter[str]())


@cache
def lived(number: int) -> World:
    """A world, lived once for all tests of this file."""
    return random_world(number)


@pytest.mark.parametrize("number", FEW)
def test_worlds_at_random(number: int) -> None:
    assert not broken([lived(number)])


@pytest.mark.slow
def test_a_thousand_worlds_at_random() -> None:
    lives = ((number, broken([random_world(number)])) for number in MANY)
    assert not {number: wrong for number, wrong in lives if wrong}


def test_limits_are_lawful_and_errors_as_written() -> None:
    assert are_lawful(LIMITS)
    assert are_lawful_at_stops(NEAR, MATCH.most_mm)
    assert are_told_apart(NEAR, MATCH.most_mm, APART_MM)
    assert MATCH.most_mm > FIX_ERROR_MM
    assert cycle.slot_begins_ms(CYCLE, cycle.SLOTS) <= cycle.CYCLE_MS


def test_all_of_it_comes_about() -> None:
    happened: Counter[str] = sum((lived(number).happened for number in range(16)), Counter())
    least = {
        "recoveries": 200,
        "joined": 10,
        "clocks ahead": 200,
        "asked for anew": 200,
        "wrong destinations": 1_000,
        "without a place": 100,
        "units begun": 100,
        "units begun while it recovers": 1,
        "centres begun": 10,
        "numbers of another car": 10,
        "seconds bunched": 1_000,
        "answers of another": 100,
        "answers outside their slot": 500,
        "ways set wrong": 100,
        "ways left as they were": 5,
        "fixes of another way": 1_000,
        "confirmed on the other way": 100,
        "told of a run that has ended": 100,
        "waits at a signal": 100,
    }
    assert {name: count for name, count in least.items() if happened[name] < count} == {}
    assert {day for number in range(8) for day in lived(number).days} == set(ORDINARY)


# ---- rules of the kernel left out


def any_word(centre: Centre, tram: Tram, _is_away: bool, made_ms: int) -> Centre:
    """Whatever is told from elsewhere ends a run, however old it is."""
    return dispatcher.without(centre, tram, made_ms)


NOTE_ELSEWHERE, RESTARTED = dispatcher.note_elsewhere, dispatcher.restarted
LOCATED = on_board.located


def who_stands(centre: Centre, tram: Tram, _is_away: bool, made_ms: int) -> Centre:
    """A tram that stands at a stop of the other way is away, as it tells."""
    return NOTE_ELSEWHERE(centre, tram, True, made_ms)


def whenever_it_is_off(centre: Centre, tram: Tram, _stop: int) -> bool:
    """A tram may come whoever runs faster to there."""
    return tram not in centre.trams and tram in centre.elsewhere_ms


def whoever_asks(_centre: Centre, _tram: Tram, _stop: int) -> bool:
    """A tram may come although it is on the way."""
    return True


def whatever_its_time(_limits: DispatchLimits, tram: Tram, display: Display, command: Command) -> Display:
    """A display takes an order of the future."""
    if command.tram != tram or not display.stands or not display.made_ms < command.made_ms:
        return display
    return replace(display, holds=command.holds, recovers=command.recovers, made_ms=command.made_ms)


def of_any_run(now_ms: int, known: Known, report: Report) -> bool:
    """A report counts that was made before this run was confirmed: of the car that had the number then."""
    is_new = known.told_ms <= report.made_ms or not dispatching.has_begun(known)
    return is_new and report.made_ms <= now_ms and mark(report.stop, report.left) >= mark(known.stop, known.left)


def of_who_has_not_begun(now_ms: int, known: Known, report: Report) -> bool:
    """That a stop was left counts of a tram whose unit nobody has set anew since its last run."""
    return (
        known.told_ms < report.made_ms <= now_ms
        and mark(report.stop, report.left) >= mark(known.stop, known.left)
        and (dispatching.is_under_way(known) or report.left or report.stop == known.comes_at)
    )


def of_who_has_left_the_stop(ahead: Known, report: Report) -> bool:
    """A tram that has left a stop is ahead of one that stands there after that, wherever trams queue beyond it."""
    is_farther = mark(ahead.stop, ahead.left) > mark(report.stop, False)
    return report.stands and is_farther and dispatching.is_under_way(ahead) and ahead.told_ms < report.made_ms


def of_any_stop(now_ms: int, known: Known, report: Report) -> bool:
    """A report of any stop counts of a tram that is to come, as if it were on the way already."""
    return known.told_ms < report.made_ms <= now_ms and mark(report.stop, report.left) >= mark(known.stop, known.left)


def knows_the_way(limits: DispatchLimits, centre: Centre, now_ms: int) -> Centre:
    """A centre that has started anew takes the way for clear of what it does not know."""
    return replace(RESTARTED(limits, centre, now_ms), cleared=10**6)


def never_lost(display: Display, is_located: bool, stop: int, stands: bool) -> Display:
    """What is shown stays when the place is lost, or another stop is reached."""
    return replace(LOCATED(display, is_located, stop, stands), recovers=display.recovers)


def whoever_answers(_limits: CycleLimits, heard: Heard, answer: Answer) -> Heard:
    """An answer of another tram than was asked counts, in its slot or not."""
    return replace(heard, is_known=True, age_ms=answer.age_ms, in_this_cycle=True)


def however_old(heard: Heard) -> bool:
    """What was heard counts until a cycle is missed."""
    return heard.is_known


def nearest(_limits: MatchLimits, found: Found) -> int | None:
    """The nearest place on the line counts, wherever else the tram may be."""
    return None if found.nearest is None else found.nearest.kilometrage_mm


def at_the_platform(_limits: StopLimits, stopping_now: Stopping, here_mm: int, next_mm: int, fix: Fix) -> Stopping:
    """A tram that runs has left a stop as soon as a fix is not before it, however near."""
    if fix.place_mm > next_mm:
        return replace(stopping_now, stop=stopping_now.stop + 1, left=True, stands=False)
    return replace(stopping_now, left=stopping_now.left or fix.place_mm > here_mm, stands=False)


def as_soon_as_it_is_beyond(_limits: StopLimits, _stopping: Stopping, _stop_mm: int, _fix: Fix) -> bool:
    """A tram has left a stop of the way that is set as soon as its place is beyond, wherever it was seen before."""
    return True


def never_astray(_limits: StopLimits, _stopping: Stopping, _stop_mm: int, _fix: Fix) -> bool:
    """A stop that was reached stays reached, although the tram is seen before it."""
    return False


SEEN: list[tuple[Rule, int, tuple[str, ...] | None, str]] = [
    ((dispatcher, "note_elsewhere", any_word), 3, None, "not clear"),
    ((dispatcher, "note_elsewhere", who_stands), 3, None, "not clear"),
    ((dispatcher, "may_come", whoever_asks), 2, None, "not clear"),
    ((dispatcher, "may_come", whenever_it_is_off), 15, ("units",), "not clear"),
    ((dispatcher, "received", whatever_its_time), 0, None, "of the future"),
    ((dispatcher, "restarted", knows_the_way), 1, ("centres",), "not clear"),
    ((dispatching, "counts", of_any_run), 45, ("numbers",), "not clear"),
    ((dispatching, "counts", of_who_has_not_begun), 33, ("kept",), "not clear"),
    ((dispatching, "was_beyond", of_who_has_left_the_stop), 0, ("signals",), "not clear"),
    ((cycle, "note_answer", whoever_answers), 0, ("jitter",), "not clear"),
    ((cycle, "is_fresh", however_old), 0, None, "heard long ago"),
    ((map_matching, "place_mm", nearest), 0, None, "place"),
    ((stopping, "passing", at_the_platform), 0, None, "told too soon"),
    ((stopping, "runs_over", as_soon_as_it_is_beyond), 1, ("units", "ways"), "not clear"),
    ((stopping, "is_seen_back", never_astray), 3, ("units", "ways"), "told too soon"),
    ((on_board, "located", never_lost), 0, (), "not clear"),
]
"""A rule left out, a world that shows it, with which days, and what is broken there."""


@pytest.mark.parametrize(("rule", "number", "days", "wrong"), SEEN, ids=[rule[2].__name__ for rule, *_ in SEEN])
def test_a_rule_that_is_left_out_is_seen(
    monkeypatch: pytest.MonkeyPatch, rule: Rule, number: int, days: tuple[str, ...] | None, wrong: str
) -> None:
    drawn = None if days is None else frozenset(days)
    assert not broken([lived(number) if drawn is None else random_world(number, drawn)])
    monkeypatch.setattr(*rule)
    assert random_world(number, drawn).broken[wrong] > 0


def test_what_is_told_before_a_tram_has_come_must_not_count(monkeypatch: pytest.MonkeyPatch) -> None:
    """Of a tram that is to come any stop counts, beside which its driver has set the way too soon (G2, G5)."""
    days = frozenset({"units", "early"})
    assert not broken([random_world(13, days)])
    monkeypatch.setattr(dispatching, "counts", of_any_stop)
    monkeypatch.setattr(dispatching, "is_under_way", dispatching.has_begun)
    assert random_world(13, days).broken["not clear"] > 0


# ---- assumptions that are broken

MATTERS = {
    "runs_along": (9, "units", "not clear"),
    "taken_off_on_the_way": (0, "numbers", "not clear"),
    "begins_ahead": (0, "units", "told too soon"),
    "fixes_beyond": (0, "units", "place"),
}
"""In which world, and with which days, each of ``BEYOND`` comes about, and what is broken then."""


@pytest.mark.parametrize("beyond", BEYOND)
def test_an_assumption_that_is_broken_matters(beyond: str) -> None:
    """Each is one of docs/assumptions.md, and the kernel cannot see that it is broken.

    ``runs_along``: after a start under way a driver chooses another way, beside which his tram runs in its direction
    (`stopping.nobody_runs_along_a_way_that_he_is_not_on`).  ``taken_off_on_the_way``: the dispatcher takes off a tram
    that is still there (`dispatching.who_is_taken_off_is_off_the_way`).  ``begins_ahead``: somebody sets a stop after a
    start under way, and one too far on (`stopping.it_begins_at_a_stop_that_it_has_come_to`).  ``fixes_beyond``: fixes
    err by twice what is written (`map_matching.a_fix_is_within_its_error`).
    """
    number, day, wrong = MATTERS[beyond]
    assert random_world(number, frozenset({day, beyond})).broken[wrong] > 0
    assert not broken([random_world(number, frozenset({day}))])
