"""The edge to integers: whatever a float is, something defined comes out, and nothing is raised."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from models.sensors.edge import LEAST, MOST, narrow, whole, whole_one

STRANGE = [float("nan"), float("inf"), float("-inf"), 1e300, -1e300, 2.0**63, -(2.0**63), 0.0, -0.0, 5e-324, 0.5, 1.5]


@given(st.floats(allow_nan=True, allow_infinity=True), st.sampled_from([1.0, 1000.0, 1e6]))
def test_a_valid_number_is_the_rounded_one_and_anything_else_is_not_valid(value: float, per_unit: float) -> None:
    number, valid = whole_one(value, per_unit, -100_000, 100_000)
    assert -100_000 <= number <= 100_000
    scaled = value * per_unit
    assert valid == (abs(scaled) < 100_000.5 and abs(round(scaled)) <= 100_000 if np.isfinite(scaled) else False)
    if valid:
        assert number == round(scaled)


@given(st.floats(allow_nan=True, allow_infinity=True))
def test_without_a_range_64_bits_saturate(value: float) -> None:
    number, valid = whole_one(value, 1000.0)
    assert LEAST <= number <= MOST
    if np.isnan(value):
        assert (number, valid) == (0, False)
    elif value > 1e16:
        assert (number, valid) == (MOST, False)
    elif value < -1e16:
        assert number == LEAST


def test_strange_values_are_told_apart_one_by_one() -> None:
    numbers, valid = whole(np.array(STRANGE), 1.0, -10, 10)
    assert valid.tolist() == [False] * 7 + [True] * 5
    assert numbers.tolist() == [0, 10, -10, 10, -10, 10, -10, 0, 0, 0, 0, 2]


@pytest.mark.parametrize("per_unit", [1.0, 1000.0])
def test_32_bits_say_the_same(per_unit: float) -> None:
    random = np.random.default_rng(1)
    with np.errstate(over="ignore"):
        values = np.concatenate([random.uniform(-120, 120, 5_000), STRANGE]).astype(np.float32)
    numbers, valid = narrow(values, per_unit, -100_000, 100_000)
    wide, also = whole(values, per_unit, -100_000, 100_000)
    assert np.array_equal(valid, also)
    assert np.abs(numbers - wide).max() <= 1
    assert np.array_equal(numbers[np.isnan(values)], [0])
    assert numbers.dtype == np.int32


def test_a_range_too_wide_for_32_bits_is_refused() -> None:
    with pytest.raises(AssertionError, match="float32"):
        narrow(np.zeros(1, np.float32), 1.0, 0, 2**30)
