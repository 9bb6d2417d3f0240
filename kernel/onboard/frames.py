"""From the pages that came over the air to a frame of the tag reader (T1)."""

from __future__ import annotations

from kernel.onboard.tag_reader import NO_FRAME, Frame
from kernel.tags import UID_BITS, Pages, TagRecord, decode


def frame(uid: int, pages: Pages) -> Frame:
    """Give what a tag's pages say, or that they say nothing (T1).

    The reader reckons in 64 bits with a sign, and a tag's number has 64 without: the numbers from
    2**63 on go below zero.  No two numbers become one.
    """
    record = decode(uid, pages)
    if not isinstance(record, TagRecord):
        return NO_FRAME
    return Frame(
        valid=True,
        uid=uid - (1 << UID_BITS) if uid >> (UID_BITS - 1) else uid,
        block=record.block,
        distance_mm=record.distance_mm,
        kind=record.kind,
    )
