"""Settings are checked as they are loaded: what a proof assumes of them holds where the check passes (X2, A1, G2)."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import fields, is_dataclass, replace
from itertools import product
from typing import Any

from kernel.alarm.limits import GREATEST_SERVER_MS, is_lawful
from kernel.crossing import arrival, crossing
from kernel.tram import stopping
from kernel.tram.limits import are_lawful, are_lawful_at_stops
from models.alarm import tone_assumptions
from models.alarm.line import REGISTER
from models.alarm.worksite import Railway
from models.crossing import arrival as ranged
from models.crossing import due
from models.crossing.sites import TRIALS, lawful
from models.tram.dispatching import Way
from models.tram.given import LIMITS, STOP_LIMITS
from models.tram.gps import BOUND_MM
from models.tram.stopping import Street, near_a_stop_is_no_less_than_the_error, the_place_is_held_for_twice_the_error
from proofs.tram.dispatching import a_confirmation_counts_for_some_time

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


def test_a_register_is_lawful_only_where_the_premises_hold() -> None:
    """Nothing in it is below zero; what fits the line is another matter (A1)."""
    assert is_lawful(REGISTER)
    premises = (
        tone_assumptions.the_alarm_limit_is_within_an_hour,
        tone_assumptions.the_error_is_not_negative,
        tone_assumptions.speed_and_freshness_are_not_negative,
    )
    verdicts = set()
    for each in spoilt(REGISTER, (*VALUES, GREATEST_SERVER_MS, GREATEST_SERVER_MS + 1)):
        verdict = is_lawful(each)
        numbers = [*vars(each.bounds).values(), *vars(each.fresh).values(), each.display_error_mm, each.tolerance_mm]
        assert verdict == (min(numbers) >= 0 and each.fresh.server_ms <= 3_600_000)
        assert not verdict or all(premise(Railway(each)) for premise in premises)
        verdicts.add(verdict)
    assert verdicts == {True, False}


def test_limits_of_trams_are_lawful_only_where_the_premise_holds() -> None:
    """None of them is below 0 (G3 to G5)."""
    assert are_lawful(LIMITS)
    for each in spoilt(LIMITS):
        assert are_lawful(each) == (min(getattr(each, field.name) for field in fields(each)) >= 0)
        assert not are_lawful(each) or a_confirmation_counts_for_some_time(Way(each))


def test_limits_at_stops_are_lawful_where_the_premises_hold_and_only_there() -> None:
    """By what places err (G2)."""
    assert are_lawful_at_stops(STOP_LIMITS, BOUND_MM)
    assert not are_lawful_at_stops(STOP_LIMITS, BOUND_MM + 1)
    verdicts = set()
    for near_mm, held_mm, error_mm in product(range(-1, 4), range(-1, 8), range(-1, 4)):
        limits = stopping.StopLimits(near_mm, held_mm)
        street = Street(limits, error_mm, 0)
        verdict = are_lawful_at_stops(limits, error_mm)
        assert verdict == (
            the_place_is_held_for_twice_the_error(street) and near_a_stop_is_no_less_than_the_error(street)
        )
        verdicts.add(verdict)
    assert verdicts == {True, False}
