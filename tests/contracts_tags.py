"""Contracts on the tag record for CrossHair (`make crosshair`): leading asserts assume, later ones claim.

CrossHair runs the bytecode itself on symbolic integers, so it is a second opinion that shares
nothing with the tests or the lifter.  It looks for counterexamples within a time; it does not prove.
"""

from __future__ import annotations

from kernel.tags import (
    WORST,
    Kind,
    Pages,
    Rejection,
    TagRecord,
    decode,
    encode,
    field_out_of_range,
    fits,
    kind_of,
    traits,
)


def every_code_has_a_kind(code: int) -> None:
    """A kind is what its code says, or unknown (T12)."""
    assert isinstance(code, int)
    kind = kind_of(code)
    assert kind is Kind.UNKNOWN or kind.value == code


def a_code_without_meaning_is_the_worst_case(code: int) -> None:
    """Every restriction and no permission (T12)."""
    assert code < 1 or code > 9
    assert traits(code) == WORST


def a_permission_needs_its_own_kind(code: int) -> None:
    """A crossing stops warning, and a length is measured, at tags that say so alone (T3, T14)."""
    assert 0 <= code <= 15
    found = traits(code)
    assert found.warning_ends == (code == Kind.CROSSING_WARNING_ENDS.value)
    assert found.presets_length == (code == Kind.SYSTEM_BOUNDARY.value)


def a_field_too_large_is_never_written(uid: int, block: int, distance_mm: int, kind: int) -> None:
    """What does not fit is refused with its reason (T1)."""
    assert field_out_of_range(TagRecord(uid, block, distance_mm, kind)) is not None
    assert isinstance(encode(TagRecord(uid, block, distance_mm, kind)), Rejection)


def a_page_too_large_is_never_read(uid: int, first: int, second: int) -> None:
    """What is no page of 32 bits is refused (T1)."""
    assert not (fits(uid, 64) and fits(first, 32) and fits(second, 32))
    assert isinstance(decode(uid, Pages(first, second)), Rejection)


def a_small_record_is_read_back(block: int, kind: int) -> None:
    """Round trip, with the fields that decide the second page left open (T1)."""
    assert fits(block, 2)
    assert fits(kind, 2)
    record = TagRecord(1, block, 2, kind)
    pages = encode(record)
    assert isinstance(pages, Pages)
    assert decode(1, pages) == record
