"""T1: the tag record is read back as written, and nothing else is believed."""

from __future__ import annotations

import binascii
from itertools import combinations
from random import Random

import pytest
from hypothesis import given
from hypothesis import strategies as st

from kernel.tags import (
    FORMAT,
    PAGE_BITS,
    UID_BITS,
    WORST,
    Kind,
    Pages,
    Rejection,
    TagRecord,
    crc16,
    decode,
    encode,
    kind_of,
    record_crc,
    traits,
)

WORD_BITS = UID_BITS + 2 * PAGE_BITS
FIELD_BITS = {"uid": 64, "block": 8, "distance_mm": 28, "kind": 4}
SAMPLE = TagRecord(uid=0xE004_0100_1234_5678, block=17, distance_mm=412_345, kind=Kind.TURNOUT.value)

records = st.builds(
    TagRecord,
    uid=st.integers(0, 2**64 - 1),
    block=st.integers(0, 2**8 - 1),
    distance_mm=st.integers(0, 2**28 - 1),
    kind=st.integers(0, 2**4 - 1),
)


def written(record: TagRecord) -> Pages:
    """The pages of a record that is known to fit."""
    pages = encode(record)
    assert isinstance(pages, Pages)
    return pages


def word(uid: int, pages: Pages) -> int:
    """UID and pages as they are covered by the CRC: one word of 128 bits."""
    return uid << 2 * PAGE_BITS | pages.first << PAGE_BITS | pages.second


def read(bits: int) -> TagRecord | Rejection:
    """Decode a word of 128 bits."""
    low = (1 << PAGE_BITS) - 1
    return decode(bits >> 2 * PAGE_BITS, Pages(bits >> PAGE_BITS & low, bits & low))


@given(records)
def test_a_record_is_read_back_as_written(record: TagRecord) -> None:
    assert decode(record.uid, written(record)) == record


@given(records)
def test_each_page_has_four_bytes(record: TagRecord) -> None:
    assert all(0 <= page < 2**32 for page in written(record))


def test_the_fields_stand_where_the_documentation_says() -> None:
    first, second = written(SAMPLE)
    assert first == 412_345 * 16 + 5
    assert second >> 16 == 17 * 256 + 1
    assert FORMAT == 1
    assert second & 0xFFFF == record_crc(SAMPLE.uid, first, second >> 16)


def test_extreme_values_fit_and_one_more_does_not() -> None:
    for field, bits in FIELD_BITS.items():
        for value in (0, 2**bits - 1):
            record = TagRecord(**{**vars(SAMPLE), field: value})
            assert decode(record.uid, written(record)) == record
        for value in (-1, 2**bits):
            refused = encode(TagRecord(**{**vars(SAMPLE), field: value}))
            assert isinstance(refused, Rejection)
            assert refused.name == f"{field.removesuffix('_mm').upper()}_OUT_OF_RANGE"


@given(st.binary(max_size=40))
def test_the_crc_agrees_with_another_implementation(data: bytes) -> None:
    assert crc16(int.from_bytes(data, "big"), 8 * len(data)) == binascii.crc_hqx(data, 0xFFFF)


def test_the_crc_has_the_published_check_value() -> None:
    assert crc16(int.from_bytes(b"123456789", "big"), 72) == 0x29B1


def test_the_record_crc_covers_uid_first_page_and_half_the_second() -> None:
    first, second = written(SAMPLE)
    covered = SAMPLE.uid.to_bytes(8, "big") + first.to_bytes(4, "big") + second.to_bytes(4, "big")[:2]
    assert second & 0xFFFF == binascii.crc_hqx(covered, 0xFFFF)


@pytest.mark.parametrize("flips", [1, 2])
def test_every_one_and_two_bit_error_is_rejected_in_uid_and_pages(flips: int) -> None:
    good = word(SAMPLE.uid, written(SAMPLE))
    believed = [places for places in combinations(range(WORD_BITS), flips) if accepts_with_flips(good, places)]
    assert believed == []


def accepts_with_flips(good: int, places: tuple[int, ...]) -> bool:
    """Whether the word is still believed with these bits inverted."""
    return isinstance(read(good ^ sum(1 << place for place in places)), TagRecord)


@given(records, st.sets(st.integers(0, WORD_BITS - 1), min_size=1, max_size=3))
def test_up_to_three_wrong_bits_are_rejected_in_any_record(record: TagRecord, places: set[int]) -> None:
    assert not accepts_with_flips(word(record.uid, written(record)), tuple(places))


@pytest.mark.parametrize("length", [3, 4, 5, 6, 7, 8])
def test_every_short_burst_is_rejected(length: int) -> None:
    good = word(SAMPLE.uid, written(SAMPLE))
    for inside in range(1 << (length - 2)):
        burst = 1 << (length - 1) | inside << 1 | 1
        for place in range(WORD_BITS - length + 1):
            assert isinstance(read(good ^ burst << place), Rejection), (burst, place)


@given(records, st.integers(1, 2**16 - 1), st.integers(0, WORD_BITS - 16))
def test_any_burst_of_at_most_16_bits_is_rejected(record: TagRecord, burst: int, place: int) -> None:
    assert isinstance(read(word(record.uid, written(record)) ^ burst << place), Rejection)


def test_every_burst_of_at_most_16_bits_has_a_remainder() -> None:
    """All 65,535 of them at once: the CRC is linear, so a burst passes only if its own remainder is nothing.

    Its place does not matter: a shift multiplies by x, and the polynomial has a constant term.
    """
    nothing = crc16(0, 32)
    assert all(crc16(burst << 16, 32) != nothing for burst in range(1, 2**16))


def test_random_pages_are_believed_about_once_in_65536_by_their_crc() -> None:
    """Rate of an accidental CRC over 100,000 random reads: 1.5 expected; 12 or more has odds below one in 10^7."""
    random = Random(20_240_601)
    trials = 100_000
    passed = sum(
        decode(random.getrandbits(64), Pages(random.getrandbits(32), random.getrandbits(32))) is not Rejection.CRC_WRONG
        for _ in range(trials)
    )
    assert passed < 12


def test_exactly_one_crc_in_65536_is_believed() -> None:
    first, second = written(SAMPLE)
    believed = [
        crc for crc in range(2**16) if isinstance(decode(SAMPLE.uid, Pages(first, second >> 16 << 16 | crc)), TagRecord)
    ]
    assert believed == [second & 0xFFFF]


@given(records, st.integers(0, 2**64 - 1))
def test_a_copy_in_another_tag_is_believed_only_by_an_accident_of_its_uid(record: TagRecord, uid: int) -> None:
    """Ours: the CRC binds the UID.  Two UIDs whose difference is a multiple of the polynomial cannot be told apart."""
    accident = crc16(record.uid, 64) == crc16(uid, 64)
    assert isinstance(decode(uid, written(record)), TagRecord) is accident


def test_a_copy_in_a_tag_with_a_near_uid_is_always_rejected() -> None:
    """Tags are bought by the reel: UIDs that differ only in their last 16 bits never collide."""
    pages = written(SAMPLE)
    neighbours = (SAMPLE.uid ^ difference for difference in range(1, 2**16))
    assert all(decode(uid, pages) is Rejection.CRC_WRONG for uid in neighbours)


def test_pages_of_two_tags_do_not_join() -> None:
    """A read that takes page 0 from one tag and page 1 from the next, whichever UID it is filed under."""
    pair = [SAMPLE, TagRecord(uid=SAMPLE.uid + 1, block=18, distance_mm=90_000, kind=Kind.PLAIN.value)]
    for one, other in (pair, pair[::-1]):
        joined = Pages(written(one).first, written(other).second)
        assert decode(one.uid, joined) is Rejection.CRC_WRONG
        assert decode(other.uid, joined) is Rejection.CRC_WRONG


@given(records, st.integers(0, 255).filter(lambda other: other != FORMAT))
def test_another_format_is_not_read_even_with_a_good_crc(record: TagRecord, other: int) -> None:
    first = written(record).first
    half = record.block << 8 | other
    assert decode(record.uid, Pages(first, half << 16 | record_crc(record.uid, first, half))) is (
        Rejection.FORMAT_UNKNOWN
    )


@given(st.integers(0, 2**64 - 1))
def test_blank_and_erased_tags_are_rejected(uid: int) -> None:
    assert isinstance(decode(uid, Pages(0, 0)), Rejection)
    assert isinstance(decode(uid, Pages(2**32 - 1, 2**32 - 1)), Rejection)


def test_a_read_that_cannot_be_one_is_rejected_for_what_it_is() -> None:
    """Even where the bits that do count carry a good CRC."""
    good = written(SAMPLE)
    for wrong in (-1, 2**32, good.first + 2**32):
        assert decode(SAMPLE.uid, good._replace(first=wrong)) is Rejection.PAGE_OUT_OF_RANGE
    for wrong in (-1, 2**32, good.second + 2**32):
        assert decode(SAMPLE.uid, good._replace(second=wrong)) is Rejection.PAGE_OUT_OF_RANGE
    for uid in (-1, 2**64, SAMPLE.uid + 2**64):
        assert decode(uid, good) is Rejection.UID_OUT_OF_RANGE


@given(st.integers(), st.integers(), st.integers())
def test_decode_is_total(uid: int, first: int, second: int) -> None:
    assert isinstance(decode(uid, Pages(first, second)), TagRecord | Rejection)


@given(st.integers(), st.integers(), st.integers(), st.integers())
def test_encode_is_total(uid: int, block: int, distance_mm: int, kind: int) -> None:
    assert isinstance(encode(TagRecord(uid, block, distance_mm, kind)), Pages | Rejection)


@given(st.integers())
def test_a_code_without_meaning_is_the_worst_case(code: int) -> None:
    if code not in range(1, 10):
        assert kind_of(code) is Kind.UNKNOWN
        assert traits(code) == WORST


def test_every_kind_has_its_code_and_none_is_worse_than_unknown() -> None:
    for kind in Kind:
        assert kind_of(kind.value) is kind
        known = traits(kind.value)
        assert all(WORST[:4])
        assert WORST[4:] == (False, False)
        assert (known == WORST) is (kind is Kind.UNKNOWN)


@pytest.mark.parametrize(
    ("trait", "codes"),
    [
        ("on_gradient", {2, 4, 6}),
        ("in_curve", {3, 4}),
        ("at_turnout", {5, 6}),
        ("warning_starts", {8}),
        ("warning_ends", {9}),
        ("presets_length", {7}),
    ],
)
def test_each_trait_belongs_to_its_kinds(trait: str, codes: set[int]) -> None:
    assert {code for code in range(1, 10) if getattr(traits(code), trait)} == codes
