"""Telegrams as bytes: read back as written; what is damaged is mended or refused; nothing forged is read (T11)."""

from __future__ import annotations

import hashlib
import hmac
import zlib
from dataclasses import replace
from random import Random

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from kernel.error_correction import protect, restore
from kernel.link import (
    LAST_SEQUENCE,
    Content,
    Life,
    Outcome,
    Party,
    Telegram,
    after_sending,
    begin,
    is_authentic,
    meet,
    sends,
)
from kernel.telegram import (
    LONGEST,
    NAME_BYTES,
    PAYLOAD_BYTES,
    SHORTEST,
    Rejection,
    Said,
    content_of,
    decode,
    encode,
    next_telegram,
    said_in,
)

KEY, OTHER_KEY = b"centre and unit 7", b"centre and unit 8"
SAMPLE = Telegram(
    sender=Party("unit-7"),
    receiver=Party("centre"),
    greeting=False,
    sender_life=Life(3),
    receiver_life=Life(12),
    sequence=41,
    sent_at_ms=1_767_225_600_123,
    content=Content("05" + b"tail left B2".hex()),
)
NAMES = st.text(st.characters(min_codepoint=33, max_codepoint=126), min_size=1, max_size=NAME_BYTES).map(Party)
LIVES = st.integers(0, 2**32 - 1).map(Life)
CONTENTS = st.binary(min_size=1, max_size=60).map(lambda said: Content(said.hex()))
TELEGRAMS = st.builds(
    Telegram,
    sender=NAMES,
    receiver=NAMES,
    greeting=st.just(False),
    sender_life=LIVES,
    receiver_life=LIVES,
    sequence=st.integers(1, LAST_SEQUENCE),
    sent_at_ms=st.integers(0, 2**64 - 1),
    content=CONTENTS,
) | st.builds(
    Telegram,
    sender=NAMES,
    receiver=NAMES,
    greeting=st.just(True),
    sender_life=LIVES,
    receiver_life=st.just(Life(0)),
    sequence=st.integers(1, LAST_SEQUENCE),
    sent_at_ms=st.integers(0, 2**64 - 1),
    content=CONTENTS,
)


def written(telegram: Telegram, key: bytes = KEY) -> bytes:
    """The bytes of a telegram that is known to fit."""
    raw = encode(key, telegram)
    assert isinstance(raw, bytes)
    return raw


NOT_AUTHENTIC = Outcome.NOT_AUTHENTIC
FIELD_WRONG = (
    Rejection.FORMAT_UNKNOWN,
    Rejection.LENGTH_WRONG,
    Rejection.NAME_OUT_OF_RANGE,
    Rejection.FIELD_OUT_OF_RANGE,
)
"""Why a telegram whose CRC is right cannot be read, whoever made it."""


def read(raw: bytes, key: bytes = KEY) -> Telegram | Rejection | Outcome:
    """The telegram in some bytes, if it can be read and is authentic; or why not."""
    arrived = decode(key, raw)
    if isinstance(arrived, Rejection):
        return arrived
    return arrived.telegram if is_authentic(arrived) else NOT_AUTHENTIC


def body_of(telegram: Telegram) -> bytearray:
    """The fields of a telegram alone."""
    restored = restore(written(telegram))
    assert isinstance(restored, bytes)
    return bytearray(restored[:-20])


def sealed(body: bytes, key: bytes = KEY) -> bytes:
    """Seal fields as one who has the key would, by the documentation and not by the kernel."""
    covered = body + zlib.crc32(body).to_bytes(4, "big")
    return protect(covered + hmac.new(key, covered, hashlib.sha256).digest()[:16])


@given(TELEGRAMS)
def test_a_telegram_is_read_back_as_written(telegram: Telegram) -> None:
    assert read(written(telegram)) == telegram


def test_the_fields_stand_where_the_documentation_says() -> None:
    body = bytes(body_of(SAMPLE))
    assert body == b"".join(
        (
            b"\x01\x00",
            b"unit-7".ljust(16, b"\0"),
            b"centre".ljust(16, b"\0"),
            bytes([0, 0, 0, 3, 0, 0, 0, 12, 0, 0, 0, 41]),
            (1_767_225_600_123).to_bytes(8, "big"),
            b"\x05\x00\x0c",
            b"tail left B2",
        )
    )
    assert sealed(body) == written(SAMPLE)
    assert len(body) + 20 == SHORTEST + 12


@pytest.mark.parametrize(
    ("change", "why"),
    [
        ({"sender": Party("")}, Rejection.NAME_OUT_OF_RANGE),
        ({"sender": Party("a name too long.")}, Rejection.NAME_OUT_OF_RANGE),
        ({"receiver": Party("seventeen-letters")}, Rejection.NAME_OUT_OF_RANGE),
        ({"receiver": Party("駅")}, Rejection.NAME_OUT_OF_RANGE),
        ({"receiver": Party("\ud800")}, Rejection.NAME_OUT_OF_RANGE),
        ({"sender_life": Life(-1)}, Rejection.FIELD_OUT_OF_RANGE),
        ({"sender_life": Life(2**32)}, Rejection.FIELD_OUT_OF_RANGE),
        ({"receiver_life": Life(2**32)}, Rejection.FIELD_OUT_OF_RANGE),
        ({"greeting": True}, Rejection.FIELD_OUT_OF_RANGE),
        ({"sequence": 0}, Rejection.FIELD_OUT_OF_RANGE),
        ({"sequence": LAST_SEQUENCE + 1}, Rejection.FIELD_OUT_OF_RANGE),
        ({"sent_at_ms": -1}, Rejection.FIELD_OUT_OF_RANGE),
        ({"sent_at_ms": 2**64}, Rejection.FIELD_OUT_OF_RANGE),
        ({"content": Content("")}, Rejection.FIELD_OUT_OF_RANGE),
        ({"content": Content("0")}, Rejection.FIELD_OUT_OF_RANGE),
        ({"content": Content("0A")}, Rejection.FIELD_OUT_OF_RANGE),
        ({"content": Content("00 1")}, Rejection.FIELD_OUT_OF_RANGE),
        ({"content": Content("00" * (PAYLOAD_BYTES + 2))}, Rejection.FIELD_OUT_OF_RANGE),
    ],
)
def test_what_does_not_fit_is_not_written(change: dict[str, object], why: Rejection) -> None:
    assert encode(KEY, Telegram(**{**SAMPLE._asdict(), **change})) is why


@pytest.mark.parametrize(
    "change",
    [
        {"sender": Party("!" * 16), "receiver": Party("~")},
        {"sender_life": Life(0), "receiver_life": Life(2**32 - 1)},
        {"greeting": True, "receiver_life": Life(0)},
        {"sequence": 1},
        {"sequence": LAST_SEQUENCE},
        {"sent_at_ms": 0},
        {"sent_at_ms": 2**64 - 1},
        {"content": Content("00")},
        {"content": Content("ff" * (PAYLOAD_BYTES + 1))},
    ],
)
def test_extreme_values_fit(change: dict[str, object]) -> None:
    telegram = Telegram(**{**SAMPLE._asdict(), **change})
    assert read(written(telegram)) == telegram


def test_kind_and_payload_are_read_back() -> None:
    for said in (Said(0, b""), Said(255, b"\0\xff"), Said(7, bytes(PAYLOAD_BYTES))):
        content = content_of(said)
        assert not isinstance(content, Rejection)
        assert said_in(content) == said
    for said in (Said(-1, b""), Said(256, b""), Said(0, bytes(PAYLOAD_BYTES + 1))):
        assert content_of(said) is Rejection.FIELD_OUT_OF_RANGE


def test_a_short_key_is_refused() -> None:
    assert encode(b"fifteen letters", SAMPLE) is Rejection.KEY_TOO_SHORT
    assert decode(b"fifteen letters", written(SAMPLE)) is Rejection.KEY_TOO_SHORT


def test_lengths_are_limited_before_anything_is_reckoned() -> None:
    assert decode(KEY, b"") is Rejection.TOO_SHORT
    assert decode(KEY, bytes(2 * SHORTEST - 1)) is Rejection.TOO_SHORT
    assert decode(KEY, bytes(2 * LONGEST + 1)) is Rejection.TOO_LONG
    assert decode(KEY, written(SAMPLE) + b"\0") is Rejection.NOT_CORRECTABLE


@settings(max_examples=300)
@given(TELEGRAMS, st.data())
def test_one_wrong_byte_or_bit_is_mended(telegram: Telegram, drawn: st.DataObject) -> None:
    raw = bytearray(written(telegram))
    place = drawn.draw(st.integers(0, len(raw) - 1))
    raw[place] ^= drawn.draw(st.integers(1, 255))
    assert read(bytes(raw)) == telegram


@settings(max_examples=500)
@given(TELEGRAMS, st.data())
def test_whatever_is_changed_the_telegram_is_as_sent_or_refused(telegram: Telegram, drawn: st.DataObject) -> None:
    raw = bytearray(written(telegram))
    for _ in range(drawn.draw(st.integers(1, 12))):
        raw[drawn.draw(st.integers(0, len(raw) - 1))] ^= drawn.draw(st.integers(1, 255))
    cut = drawn.draw(st.sampled_from((0, 0, 0, 1, 2, 50)))
    found = read(bytes(raw[: len(raw) - cut]))
    assert found == telegram or found in (
        Rejection.TOO_SHORT,
        Rejection.NOT_CORRECTABLE,
        Rejection.CRC_WRONG,
        NOT_AUTHENTIC,
    )


def test_a_change_that_the_code_takes_for_another_word_meets_the_crc() -> None:
    body = body_of(SAMPLE)
    restored = restore(written(SAMPLE))
    assert isinstance(restored, bytes)
    body[40] ^= 1
    assert decode(KEY, protect(bytes(body) + restored[-20:])) is Rejection.CRC_WRONG


def test_a_forged_telegram_with_a_right_crc_meets_the_code_of_authentication() -> None:
    """Every single byte of the fields changed, and the CRC put right by one who has no key.

    Where no key would make it a telegram it is not read at all.
    """
    restored = restore(written(SAMPLE))
    assert isinstance(restored, bytes)
    for place in range(len(restored) - 20):
        body = body_of(SAMPLE)
        body[place] ^= 0x15
        forged = bytes(body) + zlib.crc32(body).to_bytes(4, "big") + restored[-16:]
        found = read(protect(forged))
        assert found is NOT_AUTHENTIC or (found in FIELD_WRONG and found is read(sealed(bytes(body))))


@given(TELEGRAMS, st.binary(min_size=16, max_size=16))
def test_no_guessed_code_is_accepted(telegram: Telegram, guess: bytes) -> None:
    restored = restore(written(telegram))
    assert isinstance(restored, bytes)
    if guess != restored[-16:]:
        assert read(protect(restored[:-16] + guess)) is NOT_AUTHENTIC
    assert read(written(telegram), OTHER_KEY) is NOT_AUTHENTIC


@pytest.mark.parametrize(
    ("place", "bytes_there", "why"),
    [
        (0, b"\x02", Rejection.FORMAT_UNKNOWN),
        (1, b"\x02", Rejection.FORMAT_UNKNOWN),
        (1, b"\x01", Rejection.FIELD_OUT_OF_RANGE),
        (2, bytes(16), Rejection.NAME_OUT_OF_RANGE),
        (2, b"unit\x007", Rejection.NAME_OUT_OF_RANGE),
        (18, b"\x80", Rejection.NAME_OUT_OF_RANGE),
        (42, bytes(4), Rejection.FIELD_OUT_OF_RANGE),
        (55, b"\x00\x0b", Rejection.LENGTH_WRONG),
        (55, b"\xff\xff", Rejection.LENGTH_WRONG),
    ],
)
def test_a_sealed_telegram_with_a_wrong_field_is_refused(place: int, bytes_there: bytes, why: Rejection) -> None:
    """Not even who has the key gets a telegram read that could not have been written."""
    body = body_of(SAMPLE)
    body[place : place + len(bytes_there)] = bytes_there
    assert decode(KEY, sealed(bytes(body))) is why


@given(st.binary(min_size=SHORTEST - 20, max_size=SHORTEST + 8))
def test_sealed_nonsense_never_raises_and_what_is_read_would_be_written_so(body: bytes) -> None:
    found = read(sealed(body))
    assert isinstance(found, Rejection) or (isinstance(found, Telegram) and written(found) == sealed(body))


def test_a_hundred_thousand_random_words_are_refused() -> None:
    random = Random("nothing is believed")
    sizes = (4, 2 * SHORTEST, 2 * SHORTEST + 2, 200, 301)
    found = {decode(KEY, random.randbytes(random.choice(sizes))) for _ in range(100_000)}
    assert found <= {Rejection.TOO_SHORT, Rejection.NOT_CORRECTABLE, Rejection.CRC_WRONG}
    assert len(found) >= 2


def test_a_link_makes_only_telegrams_that_it_sends() -> None:
    link = begin(Party("centre"), Party("unit-7"), Life(1), 0)
    hello = next_telegram(link, 5, Content("00"))
    assert hello is not None
    assert hello.greeting
    assert read(written(hello)) == hello
    link = meet(after_sending(link), Life(9))
    order = next_telegram(link, 6, Content("01"))
    assert order is not None
    assert sends(link, order)
    assert (order.greeting, order.receiver_life, order.sequence) == (False, 9, 1)
    assert next_telegram(replace(link, sent=LAST_SEQUENCE), 7, Content("01")) is None
