"""The list of faults: names, assumptions, and the distributions that rates are drawn from."""

from __future__ import annotations

from decimal import Decimal

import pytest
from hypothesis import given
from hypothesis import strategies as some

from fuzz.compiled.native import ASSUMED
from fuzz.traffic.distributions import QUANTILES, WHOLE, Distribution, fixed, log_uniform, uniform
from fuzz.traffic.faults import BEYOND, FAULTS, WITHIN, families, number

CHANCES = some.floats(1e-6, 1.0)


def test_each_fault_has_its_own_name() -> None:
    assert len(set(families())) == len(FAULTS)
    assert [number(name) for name in families()] == list(range(len(FAULTS)))


def test_faults_beyond_break_each_assumption_and_those_within_none() -> None:
    assert {name for fault in BEYOND for name in fault.breaks} == set(ASSUMED)
    assert not any(fault.beyond for fault in WITHIN)


@given(low=CHANCES, high=CHANCES, log=some.booleans())
def test_quantiles_rise_from_the_lower_bound_to_the_upper(low: float, high: float, log: bool) -> None:
    low, high = min(low, high), max(low, high)
    drawn = (log_uniform if log else uniform)(low, high).chances()
    assert len(drawn) == QUANTILES
    assert list(drawn) == sorted(drawn)
    assert drawn[0] == pytest.approx(low * WHOLE, abs=1.5)
    assert drawn[-1] == pytest.approx(high * WHOLE, abs=1.5)


def test_half_of_all_draws_of_a_log_uniform_rate_lie_below_the_geometric_mean() -> None:
    assert float(log_uniform(0.0001, 0.01).quantile(Decimal("0.5"))) == pytest.approx(0.001)
    assert float(uniform(0.0, 0.5).quantile(Decimal("0.5"))) == pytest.approx(0.25)
    assert set(fixed(0.25).chances()) == {WHOLE // 4}


def test_a_distribution_says_its_name_and_bounds() -> None:
    assert str(Distribution("log-uniform", 0.001, 0.1)) == "log-uniform(0.001, 0.1)"
