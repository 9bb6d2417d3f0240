"""Settings are checked as they are loaded: what a proof assumes of them holds where the check passes (X2, A1, G2)."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import fields, is_dataclass, replace
from itertools import product
from typing import Any

import pytest

from kernel.alarm.extents import End, Extent, Line
from kernel.alarm.least_ways import Equation, Join
from kernel.alarm.limits import GREATEST_SERVER_MS, is_lawful
from kernel.crossing import arrival, crossing
from kernel.tram import stopping
from kernel.tram.limits import are_lawful, are_lawful_at_stops, are_told_apart
from models.alarm import tone_assumptions
from models.alarm.connections import connections
from models.alarm.line import LENGTH_MM, REGISTER
from models.alarm.worksite import Railway
from models.crossing import arrival as ranged
from models.crossing import due
from models.crossing.sites import TRIALS, lawful
from models.tram.given import LIMITS, STOP_LIMITS
from models.tram.gps import BOUND_MM
from models.tram.line import LEAST_APART_MM
from proofs.mutants.edits import Mutant, mutants_of
from proofs.mutated import running

VALUES = (-1, 0, 1)


def spoilt(record: Any, values: tuple[int, ...] = VALUES) -> Iterator[Any]:
    """The record with one of its whole numbers after the other made another."""
    for field in fields(record):
        kept = getattr(record, field.name)
        if is_dataclass(kept):
            yield from (replace(record, **{field.name: each}) for each in spoilt(kept, values))
        elif isinstance(kept, int):
            yield from (replace(record, **{field.name: value}) for value in values)


def test_bounds_of_trains_before_a_crossing_are_lawful_where_the_premises_hold_and_only_there() -> None:
    """And bounds that are not are refused together with whatever settings (X2, X5)."""
    trial = TRIALS[0]
    bounds, settings = trial.bounds(trial.express), trial.settings
    assert lawful()
    assert arrival.are_lawful(bounds)
    verdicts = set()
    for each in (*spoilt(bounds), *(replace(one, gain_um=0) for one in spoilt(bounds))):
        alike = replace(settings, cycle_ms=each.cycle_ms, warning_cycles=each.warning_cycles)
        verdict = arrival.are_lawful(each)
        assert verdict == ranged.bounds_are_above_zero(ranged.Crossing(each))
        assert crossing.have_one_warning_time(each, alike) == verdict
        assert not (verdict and crossing.are_lawful(alike)) or due.bounds_are_above_zero(due.Way(each, alike))
        verdicts.add(verdict)
    assert verdicts == {True, False}


def test_a_crossing_has_one_warning_time_and_one_cycle() -> None:
    """And its bounds are lawful (X2, X5)."""
    trial = TRIALS[0]
    bounds, settings = trial.bounds(trial.express), trial.settings
    assert crossing.have_one_warning_time(bounds, settings)
    for other in (-1, 1):
        warning_cycles, cycle_ms = settings.warning_cycles + other, settings.cycle_ms + other
        assert not crossing.have_one_warning_time(bounds, replace(settings, warning_cycles=warning_cycles))
        assert not crossing.have_one_warning_time(bounds, replace(settings, cycle_ms=cycle_ms))
    assert not crossing.have_one_warning_time(replace(bounds, line_um=0), settings)


def test_a_register_is_lawful_only_where_the_premises_hold() -> None:
    """Nothing in it is below zero; what fits the line is another matter (A1)."""
    whole = {Line("line"): Extent(0, LENGTH_MM, End.BUFFER_STOP, End.BUFFER_STOP)}
    assert is_lawful(REGISTER, {}, whole)
    premises = (
        tone_assumptions.the_alarm_limit_is_within_an_hour,
        tone_assumptions.the_error_is_not_negative,
        tone_assumptions.speed_and_freshness_are_not_negative,
    )
    verdicts = set()
    for each in spoilt(REGISTER, (*VALUES, GREATEST_SERVER_MS, GREATEST_SERVER_MS + 1)):
        verdict = is_lawful(each, {}, whole)
        numbers = [*vars(each.bounds).values(), *vars(each.fresh).values(), each.display_error_mm, each.tolerance_mm]
        assert verdict == (min(numbers) >= 0 and each.fresh.server_ms <= 3_600_000)
        assert not verdict or all(premise(Railway(each)) for premise in premises)
        verdicts.add(verdict)
    assert verdicts == {True, False}
    broken = {Join("break"): Equation(20_000_000, 200_000_000)}
    pieces = {
        Line("before"): Extent(0, 20_000_000, End.BUFFER_STOP, End.JOIN),
        Line("beyond"): Extent(200_000_000, 220_000_000, End.JOIN, End.BUFFER_STOP),
    }
    plain = replace(REGISTER, sections={})
    joined = replace(plain, ways=connections(plain, broken))
    assert not is_lawful(plain, broken, pieces), "it has no way over the break"
    assert is_lawful(joined, broken, pieces)
    assert not is_lawful(joined, broken, pieces | whole), "two lines have one figure"
    assert not is_lawful(replace(joined, sections=REGISTER.sections), broken, pieces), "sections lie on no line"
    stopped = broken | {Join("typed"): Equation(0, 210_000_000)}
    elsewhere = replace(plain, ways=connections(plain, stopped))
    assert not is_lawful(elsewhere, stopped, pieces), "an equation is written where buffer stops are"


def test_limits_of_trams_are_lawful_only_where_none_is_below_zero() -> None:
    """None of them is below 0 (G3 to G5)."""
    assert are_lawful(LIMITS)
    for each in spoilt(LIMITS):
        assert are_lawful(each) == (min(getattr(each, field.name) for field in fields(each)) >= 0)


def test_limits_at_stops_are_lawful_where_what_places_err_fits_them_and_only_there() -> None:
    """Near a stop is no nearer than places err, and a place is held for as much to both sides (G2)."""
    assert are_lawful_at_stops(STOP_LIMITS, BOUND_MM)
    assert not are_lawful_at_stops(STOP_LIMITS, BOUND_MM + 1)
    verdicts = set()
    for near_mm, held_mm, error_mm in product(range(-1, 4), range(-1, 8), range(-1, 4)):
        limits = stopping.StopLimits(near_mm, held_mm)
        verdict = are_lawful_at_stops(limits, error_mm)
        assert verdict == (error_mm >= 0 and near_mm >= error_mm and held_mm >= near_mm + 2 * error_mm)
        verdicts.add(verdict)
    assert verdicts == {True, False}


def test_stops_are_told_apart_where_none_is_told_at_both_and_only_there() -> None:
    """A tram held at a stop is before each place by which one has come to the next (G2)."""
    assert are_told_apart(STOP_LIMITS, BOUND_MM, LEAST_APART_MM)
    verdicts = set()
    for near_mm, held_mm, error_mm, apart_mm in product(range(4), range(4), range(3), range(14)):
        verdict = are_told_apart(stopping.StopLimits(near_mm, held_mm), error_mm, apart_mm)
        farthest_mm, nearest_mm = held_mm + error_mm, apart_mm - near_mm - error_mm
        assert verdict == (farthest_mm < nearest_mm)
        verdicts.add(verdict)
    assert verdicts == {True, False}


CHECKS: dict[Callable[..., Any], Callable[[], None]] = {
    arrival.are_lawful: test_bounds_of_trains_before_a_crossing_are_lawful_where_the_premises_hold_and_only_there,
    crossing.have_one_warning_time: test_a_crossing_has_one_warning_time_and_one_cycle,
    is_lawful: test_a_register_is_lawful_only_where_the_premises_hold,
    are_lawful: test_limits_of_trams_are_lawful_only_where_none_is_below_zero,
    are_lawful_at_stops: test_limits_at_stops_are_lawful_where_what_places_err_fits_them_and_only_there,
    are_told_apart: test_stops_are_told_apart_where_none_is_told_at_both_and_only_there,
}
WITHOUT = [(dropped, test) for check, test in CHECKS.items() for dropped in mutants_of(check)]


@pytest.mark.parametrize(("dropped", "test"), WITHOUT, ids=[dropped.name for dropped, _ in WITHOUT])
def test_a_check_that_is_left_out_or_another_is_noticed(dropped: Mutant, test: Callable[[], None]) -> None:
    with running({dropped.function: dropped.tree}), pytest.raises(AssertionError):
        test()
