"""The error-correcting code of telegrams: exactly what it promises, and no exception ever (T11)."""

from __future__ import annotations

from itertools import combinations
from random import Random

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from kernel.error_correction import Damaged, protect, restore

SIZES = (1, 2, 3, 8, 33)
RANDOM = Random("telegrams")
DRAWN = {size: RANDOM.randbytes(size) for size in (*SIZES, 82)}


def disturbed(coded: bytes, *places: int) -> bytes:
    """Turn round the bits at these places, counted from the last bit."""
    number = int.from_bytes(coded, "big")
    for place in places:
        number ^= 1 << place
    return number.to_bytes(len(coded), "big")


def column(place: int, size: int) -> int:
    """The code word that a bit belongs to."""
    return place % (2 * size)


@given(st.binary(max_size=300))
def test_what_is_not_disturbed_comes_back(data: bytes) -> None:
    coded = protect(data)
    assert len(coded) == 2 * len(data)
    assert coded[: len(data)] == data
    assert restore(coded) == data


@pytest.mark.parametrize("size", [*SIZES, 82])
def test_every_single_bit_is_corrected(size: int) -> None:
    data = DRAWN[size]
    coded = protect(data)
    assert all(restore(disturbed(coded, place)) == data for place in range(16 * size))


@pytest.mark.parametrize("size", [1, 2, 3, 8])
def test_every_two_bits_are_corrected_or_found_out(size: int) -> None:
    data = DRAWN[size]
    coded = protect(data)
    for one, other in combinations(range(16 * size), 2):
        same = column(one, size) == column(other, size)
        assert restore(disturbed(coded, one, other)) == (Damaged.TWO_ERRORS if same else data)


def test_every_pattern_in_one_column_ends_as_promised() -> None:
    """All 256 patterns over one column: one error mended, two found out, and no other promise."""
    size, data = 2, DRAWN[2]
    coded = protect(data)
    for pattern in range(256):
        places = [1 + 2 * size * row for row in range(8) if pattern >> row & 1]
        found = restore(disturbed(coded, *places))
        if len(places) <= 1:
            assert found == data
        elif len(places) % 2 == 0 and found != data:
            assert found is Damaged.TWO_ERRORS or len(places) >= 4
        if len(places) == 2:
            assert found is Damaged.TWO_ERRORS


@pytest.mark.parametrize("size", [1, 2, 3, 8, 33])
def test_every_burst_up_to_an_eighth_is_corrected(size: int) -> None:
    """All lengths, all places; within the burst everything, the ends and every other bit, or drawn bits are wrong."""
    data = DRAWN[size]
    coded = protect(data)
    for length in range(1, 2 * size + 1):
        for start in range(16 * size - length + 1):
            burst = range(start, start + length)
            assert restore(disturbed(coded, *burst)) == data
            assert restore(disturbed(coded, *(p for p in burst if RANDOM.random() < 0.5))) == data


@pytest.mark.parametrize("size", [1, 2, 3, 8])
def test_every_burst_up_to_a_quarter_is_corrected_or_found_out(size: int) -> None:
    data = DRAWN[size]
    coded = protect(data)
    for length in range(2 * size + 1, 4 * size + 1):
        for start in range(16 * size - length + 1):
            burst = range(start, start + length)
            assert restore(disturbed(coded, *burst)) is Damaged.TWO_ERRORS
            some = (p for p in burst if RANDOM.random() < 0.5)
            assert restore(disturbed(coded, *some)) in (data, Damaged.TWO_ERRORS)


@settings(max_examples=300)
@given(st.data())
def test_one_error_in_any_number_of_columns_is_corrected(drawn: st.DataObject) -> None:
    data = drawn.draw(st.binary(min_size=1, max_size=40))
    rows = drawn.draw(st.lists(st.integers(0, 8), min_size=2 * len(data), max_size=2 * len(data)))
    places = [row * 2 * len(data) + place for place, row in enumerate(rows) if row < 8]
    assert restore(disturbed(protect(data), *places)) == data


def test_an_odd_number_of_bytes_is_refused() -> None:
    assert restore(b"\0") is Damaged.ODD_LENGTH
    assert restore(protect(b"abc")[:-1]) is Damaged.ODD_LENGTH


def test_a_hundred_thousand_random_words_never_raise() -> None:
    random = Random("never raise")
    found = [restore(random.randbytes(random.randrange(24))) for _ in range(100_000)]
    assert all(isinstance(one, bytes | Damaged) for one in found)
    assert {Damaged.ODD_LENGTH, Damaged.TWO_ERRORS} <= {one for one in found if isinstance(one, Damaged)}
    assert any(isinstance(one, bytes) and one for one in found)
