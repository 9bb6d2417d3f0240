"""Telegrams as bytes: fields, CRC-32, code of authentication, and the error-correcting code round all (T11).

The number and the error-correcting code are the paper's (000, 3.5.3); the rest is ours.  What is inside
the error-correcting code, numbers with the high byte first:

====== ================================================================================
bytes  meaning
====== ================================================================================
1      format, 1
1      0, or 1 for a greeting
16     sender: 1 to 16 visible ASCII characters, then zero bytes
16     receiver, likewise
4      life of the sender
4      life of the receiver as the sender knows it; 0 in a greeting
4      number in the session, from 1
8      time of sending in ms, by the sender's clock
1      kind
2      length of the payload, at most 1024
...    payload
4      CRC-32 of all before
16     first half of HMAC-SHA-256 of all before, by the key of this pair of machines
====== ================================================================================
"""

from __future__ import annotations

import hmac
import zlib
from enum import Enum
from typing import NamedTuple

from kernel.error_correction import Damaged, protect, restore
from kernel.link import LAST_SEQUENCE, Arrived, Code, Content, Life, Link, Party, Telegram, sends

FORMAT = 1
NAME_BYTES = 16
LIFE_BYTES = 4
SEQUENCE_BYTES = 4
TIME_BYTES = 8
LENGTH_BYTES = 2
PAYLOAD_BYTES = 1024
"""The longest payload (ours)."""
CRC_BYTES = 4
MAC_BYTES = 16
KEY_BYTES = 16
"""The shortest key (ours)."""

NAMES_AT = 2
LIVES_AT = NAMES_AT + 2 * NAME_BYTES
SEQUENCE_AT = LIVES_AT + 2 * LIFE_BYTES
TIME_AT = SEQUENCE_AT + SEQUENCE_BYTES
KIND_AT = TIME_AT + TIME_BYTES
LENGTH_AT = KIND_AT + 1
PAYLOAD_AT = LENGTH_AT + LENGTH_BYTES
TAIL_BYTES = CRC_BYTES + MAC_BYTES
SHORTEST = PAYLOAD_AT + TAIL_BYTES
LONGEST = SHORTEST + PAYLOAD_BYTES


class Rejection(Enum):
    """Why a telegram cannot be encoded or read (T11); whether what was read is authentic the link asks."""

    KEY_TOO_SHORT = "key too short"
    TOO_SHORT = "shorter than a telegram without payload"
    TOO_LONG = "longer than a telegram with the longest payload"
    NOT_CORRECTABLE = "more errors than can be corrected"
    CRC_WRONG = "CRC does not match"
    FORMAT_UNKNOWN = "format unknown"
    LENGTH_WRONG = "payload is not as long as it says"
    NAME_OUT_OF_RANGE = "a name is not 1 to 16 visible ASCII characters"
    FIELD_OUT_OF_RANGE = "a number does not fit into its field"


class Said(NamedTuple):
    """What a telegram says: a kind, 0 to 255, and a payload of up to 1024 bytes (T11)."""

    kind: int
    payload: bytes


def content_of(said: Said) -> Content | Rejection:
    """Write kind and payload as the content of a telegram: hexadecimal, the kind in front (T11)."""
    if not 0 <= said.kind <= 255 or len(said.payload) > PAYLOAD_BYTES:
        return Rejection.FIELD_OUT_OF_RANGE
    return Content(bytes([said.kind, *said.payload]).hex())


def said_in(content: Content) -> Said | Rejection:
    """Read kind and payload from a content; only what :func:`content_of` writes is read (T11)."""
    if len(content) % 2 != 0 or len(content) < 2 or any(digit not in "0123456789abcdef" for digit in content):
        return Rejection.FIELD_OUT_OF_RANGE
    read = bytes.fromhex(content)
    if len(read) > 1 + PAYLOAD_BYTES:
        return Rejection.FIELD_OUT_OF_RANGE
    return Said(read[0], read[1:])


def next_telegram(link: Link, sent_at_ms: int, content: Content) -> Telegram | None:
    """Make the next telegram of a link, to be encoded and counted by ``after_sending``; none after the last (T11).

    While the life of the peer is not known it is a greeting, and its content is lost on the peer.
    """
    telegram = Telegram(
        sender=link.me,
        receiver=link.peer,
        greeting=link.peer_life is None,
        sender_life=link.life,
        receiver_life=Life(0) if link.peer_life is None else link.peer_life,
        sequence=link.sent + 1,
        sent_at_ms=sent_at_ms,
        content=content,
    )
    return telegram if sends(link, telegram) else None


def is_name(name: str) -> bool:
    """Tell whether a name is 1 to 16 visible ASCII characters (T11)."""
    return 1 <= len(name) <= NAME_BYTES and name.isascii() and name.isprintable() and " " not in name


def fits(value: int, size: int) -> bool:
    """Tell whether a value is an unsigned number of so many bytes (T11)."""
    return 0 <= value < 1 << 8 * size


def out_of_range(telegram: Telegram) -> Rejection | None:
    """The first fault of a telegram's fields, or None (T11)."""
    if not is_name(telegram.sender) or not is_name(telegram.receiver):
        return Rejection.NAME_OUT_OF_RANGE
    if not fits(telegram.sender_life, LIFE_BYTES) or not fits(telegram.receiver_life, LIFE_BYTES):
        return Rejection.FIELD_OUT_OF_RANGE
    if telegram.greeting and telegram.receiver_life != 0:
        return Rejection.FIELD_OUT_OF_RANGE
    if not 1 <= telegram.sequence <= LAST_SEQUENCE or not fits(telegram.sent_at_ms, TIME_BYTES):
        return Rejection.FIELD_OUT_OF_RANGE
    return None


def code_of(key: bytes, covered: bytes) -> bytes:
    """The code of authentication: the first half of HMAC-SHA-256 (T11)."""
    return hmac.digest(key, covered, "sha256")[:MAC_BYTES]


def sealed(key: bytes, body: bytes) -> bytes:
    """Put CRC, code of authentication and error-correcting code round the fields (T11)."""
    covered = body + zlib.crc32(body).to_bytes(CRC_BYTES, "big")
    return protect(covered + code_of(key, covered))


def encode(key: bytes, telegram: Telegram) -> bytes | Rejection:
    """The bytes to send, or why there are none; the same bytes for every repetition (T11)."""
    if len(key) < KEY_BYTES:
        return Rejection.KEY_TOO_SHORT
    refused = out_of_range(telegram)
    if refused is not None:
        return refused
    said = said_in(telegram.content)
    if isinstance(said, Rejection):
        return said
    body = b"".join(
        (
            bytes([FORMAT, 1 if telegram.greeting else 0]),
            telegram.sender.encode("ascii").ljust(NAME_BYTES, b"\0"),
            telegram.receiver.encode("ascii").ljust(NAME_BYTES, b"\0"),
            telegram.sender_life.to_bytes(LIFE_BYTES, "big"),
            telegram.receiver_life.to_bytes(LIFE_BYTES, "big"),
            telegram.sequence.to_bytes(SEQUENCE_BYTES, "big"),
            telegram.sent_at_ms.to_bytes(TIME_BYTES, "big"),
            bytes([said.kind]),
            len(said.payload).to_bytes(LENGTH_BYTES, "big"),
            said.payload,
        )
    )
    return sealed(key, body)


class Opened(NamedTuple):
    """The fields of what arrived, its code of authentication, and the code that the own key gives for it (T11)."""

    body: bytes
    code: Code
    expected: Code


def opened(key: bytes, raw: bytes) -> Opened | Rejection:
    """Open what arrived, mended if need be, or say why it cannot be read; never raises (T11)."""
    if len(key) < KEY_BYTES:
        return Rejection.KEY_TOO_SHORT
    if len(raw) < 2 * SHORTEST:
        return Rejection.TOO_SHORT
    if len(raw) > 2 * LONGEST:
        return Rejection.TOO_LONG
    restored = restore(raw)
    if isinstance(restored, Damaged):
        return Rejection.NOT_CORRECTABLE
    covered, code = restored[:-MAC_BYTES], restored[-MAC_BYTES:]
    body = covered[:-CRC_BYTES]
    if zlib.crc32(body) != int.from_bytes(covered[-CRC_BYTES:], "big"):
        return Rejection.CRC_WRONG
    return Opened(body, Code(code.hex()), Code(code_of(key, covered).hex()))


def name_in(field: bytes) -> Party | None:
    """The name in its field, or None: nothing may stand behind it (T11)."""
    name = field.rstrip(b"\0").decode("latin-1")
    return Party(name) if is_name(name) else None


def number_in(body: bytes, start: int, size: int) -> int:
    """The unsigned number at a place of the fields (T11)."""
    return int.from_bytes(body[start : start + size], "big")


def decode(key: bytes, raw: bytes) -> Arrived | Rejection:
    """Read what arrived, with both codes, or say why it cannot be read; never raises (T11).

    Anybody may have written it: ``kernel.link.judge`` compares the codes, and says whether to act on it.
    """
    read = opened(key, raw)
    if isinstance(read, Rejection):
        return read
    body = read.body
    if body[0] != FORMAT or body[1] > 1:
        return Rejection.FORMAT_UNKNOWN
    if number_in(body, LENGTH_AT, LENGTH_BYTES) != len(body) - PAYLOAD_AT:
        return Rejection.LENGTH_WRONG
    sender = name_in(body[NAMES_AT : NAMES_AT + NAME_BYTES])
    receiver = name_in(body[NAMES_AT + NAME_BYTES : LIVES_AT])
    if sender is None or receiver is None:
        return Rejection.NAME_OUT_OF_RANGE
    telegram = Telegram(
        sender=sender,
        receiver=receiver,
        greeting=body[1] == 1,
        sender_life=Life(number_in(body, LIVES_AT, LIFE_BYTES)),
        receiver_life=Life(number_in(body, LIVES_AT + LIFE_BYTES, LIFE_BYTES)),
        sequence=number_in(body, SEQUENCE_AT, SEQUENCE_BYTES),
        sent_at_ms=number_in(body, TIME_AT, TIME_BYTES),
        content=Content((body[KIND_AT : KIND_AT + 1] + body[PAYLOAD_AT:]).hex()),
    )
    refused = out_of_range(telegram)
    return Arrived(telegram, read.code, read.expected) if refused is None else refused
