"""The record in an IC tag: what is written in it, and when a read of it is believed (T1).

The paper (000, 3.2) gives the fields and their widths, 56 bits beside the UID.  Ours are their
places in the two pages of 4 bytes, the use of the 8 bits that remain, and what the CRC covers::

    page 0   distance to the next tag of the block, mm (28)   kind (4)
    page 1   block (8)   format (8)   CRC (16)

The CRC covers the UID as well.  A record copied into another tag, and a read that joins page 0
of one tag to page 1 of another, are thereby rejected like a flipped bit.  The polynomial of
CRC-16/CCITT finds every error of up to three bits and every burst of up to 16 bits in a word this
short; anything else passes once in 65,536.  It is no protection against a forger.

Integers only; every function is total: what cannot be is answered, never raised.
"""

from __future__ import annotations

from dataclasses import dataclass
from enum import Enum
from typing import NamedTuple

from kernel.onboard import tag_kind

UID_BITS = 64
BLOCK_BITS = 8
DISTANCE_BITS = 28
KIND_BITS = 4
FORMAT_BITS = 8
CRC_BITS = 16
PAGE_BITS = 32

FORMAT = 0x01
"""What this module writes into the 8 spare bits; a tag with anything else there is not read as a record."""

CRC_POLYNOMIAL = 0x1021
CRC_START = 0xFFFF
"""Not zero, so that a blank tag (all zeros) does not carry a valid CRC."""


class Pages(NamedTuple):
    """The two 4-byte pages of a tag, each as one 32-bit integer, most significant byte first (T1)."""

    first: int
    second: int


@dataclass(frozen=True)
class TagRecord:
    """What one tag says (T1).

    ``uid``: the tag's own number, 64 bits; the only key.
    ``block``: 8 bits; repeats along a line, distinct within a route and among neighbours (ours).
    ``distance_mm``: to the next tag inside the same block; 0 where there are several next tags
    (a turnout block) and the route's list carries the distance instead (ours).
    ``kind``: 4 bits; :func:`traits` says what it means.
    """

    uid: int
    block: int
    distance_mm: int
    kind: int


class Rejection(Enum):
    """Why something is not a tag record; the train treats each as a tag not read (T1, T5)."""

    UID_OUT_OF_RANGE = "the UID does not fit into 64 bits"
    BLOCK_OUT_OF_RANGE = "the block does not fit into 8 bits"
    DISTANCE_OUT_OF_RANGE = "the distance does not fit into 28 bits of millimetres"
    KIND_OUT_OF_RANGE = "the kind does not fit into 4 bits"
    PAGE_OUT_OF_RANGE = "a page does not fit into 32 bits"
    CRC_WRONG = "the CRC does not match the UID and the record"
    FORMAT_UNKNOWN = "the record is of another format"


class Kind(Enum):
    """What lies at a tag (paper 000, 3.2: gradient, curve, turnout and so on); the codes are ours."""

    PLAIN = tag_kind.PLAIN
    GRADIENT = tag_kind.GRADIENT
    CURVE = tag_kind.CURVE
    GRADIENT_AND_CURVE = tag_kind.GRADIENT_AND_CURVE
    TURNOUT = tag_kind.TURNOUT
    TURNOUT_ON_GRADIENT = tag_kind.TURNOUT_ON_GRADIENT
    SYSTEM_BOUNDARY = tag_kind.SYSTEM_BOUNDARY
    CROSSING_WARNING_STARTS = tag_kind.CROSSING_WARNING_STARTS
    CROSSING_WARNING_ENDS = tag_kind.CROSSING_WARNING_ENDS
    UNKNOWN = tag_kind.UNKNOWN
    """Codes 0 and 10 to 15: unassigned, taken for the worst of everything."""


class Traits(NamedTuple):
    """What a train must reckon with at a tag of some kind; each is safe where it is unknown (T12)."""

    on_gradient: bool
    """Brake as on the line's steepest descent."""
    in_curve: bool
    """Run no faster than the line's sharpest curve allows."""
    at_turnout: bool
    """Suppress every throw of the points while in this block (T10)."""
    warning_starts: bool
    """The crossing ahead is to warn (T14)."""
    warning_ends: bool
    """The crossing behind may stop warning (T14)."""
    presets_length: bool
    """The train's length may be measured here (T3)."""


WORST = Traits(
    on_gradient=True,
    in_curve=True,
    at_turnout=True,
    warning_starts=True,
    warning_ends=False,
    presets_length=False,
)
"""Every restriction and no permission."""


def kind_of(code: int) -> Kind:
    """The kind that a 4-bit code stands for; every integer without a meaning is UNKNOWN (T12)."""
    for kind in Kind:
        if kind.value == code:
            return kind
    return Kind.UNKNOWN


def traits(code: int) -> Traits:
    """What a train must reckon with at a tag of this kind; an unknown code is the worst case (T12)."""
    kind = kind_of(code)
    if kind is Kind.UNKNOWN:
        return WORST
    return Traits(
        on_gradient=kind in (Kind.GRADIENT, Kind.GRADIENT_AND_CURVE, Kind.TURNOUT_ON_GRADIENT),
        in_curve=tag_kind.is_curve(code),
        at_turnout=tag_kind.is_turnout(code),
        warning_starts=kind is Kind.CROSSING_WARNING_STARTS,
        warning_ends=kind is Kind.CROSSING_WARNING_ENDS,
        presets_length=kind is Kind.SYSTEM_BOUNDARY,
    )


def fits(value: int, bits: int) -> bool:
    """Whether ``value`` is an unsigned integer of at most ``bits`` bits (T1)."""
    return 0 <= value < 1 << bits


def crc16(value: int, bits: int) -> int:
    """CRC-16/CCITT (polynomial 1021, start FFFF, not reflected) over the ``bits`` bits of ``value`` (T1).

    The most significant bit goes first.  Over the bytes of "123456789" it is 29B1.
    """
    remainder = CRC_START
    for place in reversed(range(bits)):
        carry = (remainder >> (CRC_BITS - 1)) ^ (value >> place & 1)
        remainder = (remainder << 1) & ((1 << CRC_BITS) - 1)
        if carry == 1:
            remainder ^= CRC_POLYNOMIAL
    return remainder


def record_crc(uid: int, first_page: int, block_and_format: int) -> int:
    """The CRC of a tag: over its UID, its first page, and the first half of its second (T1; the UID is ours)."""
    half = PAGE_BITS - CRC_BITS
    covered = ((uid << PAGE_BITS) | first_page) << half | block_and_format
    return crc16(covered, UID_BITS + PAGE_BITS + half)


def field_out_of_range(record: TagRecord) -> Rejection | None:
    """The first field of a record that does not fit into its bits, or None (T1)."""
    if not fits(record.uid, UID_BITS):
        return Rejection.UID_OUT_OF_RANGE
    if not fits(record.block, BLOCK_BITS):
        return Rejection.BLOCK_OUT_OF_RANGE
    if not fits(record.distance_mm, DISTANCE_BITS):
        return Rejection.DISTANCE_OUT_OF_RANGE
    if not fits(record.kind, KIND_BITS):
        return Rejection.KIND_OUT_OF_RANGE
    return None


def encode(record: TagRecord) -> Pages | Rejection:
    """The two pages to write into the tag whose UID the record names, or why they cannot be written (T1)."""
    out_of_range = field_out_of_range(record)
    if out_of_range is not None:
        return out_of_range
    first = record.distance_mm << KIND_BITS | record.kind
    block_and_format = record.block << FORMAT_BITS | FORMAT
    return Pages(first, block_and_format << CRC_BITS | record_crc(record.uid, first, block_and_format))


def decode(uid: int, pages: Pages) -> TagRecord | Rejection:
    """What the tag with this UID says, or why it is not believed (T1)."""
    if not fits(uid, UID_BITS):
        return Rejection.UID_OUT_OF_RANGE
    if not fits(pages.first, PAGE_BITS) or not fits(pages.second, PAGE_BITS):
        return Rejection.PAGE_OUT_OF_RANGE
    block_and_format = pages.second >> CRC_BITS
    if pages.second & ((1 << CRC_BITS) - 1) != record_crc(uid, pages.first, block_and_format):
        return Rejection.CRC_WRONG
    if block_and_format & ((1 << FORMAT_BITS) - 1) != FORMAT:
        return Rejection.FORMAT_UNKNOWN
    return TagRecord(
        uid=uid,
        block=block_and_format >> FORMAT_BITS,
        distance_mm=pages.first >> KIND_BITS,
        kind=pages.first & ((1 << KIND_BITS) - 1),
    )
