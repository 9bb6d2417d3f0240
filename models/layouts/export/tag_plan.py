"""The plan of tags: what is to be written in every tag of a layout, and where it lies (T1, T2)."""

from __future__ import annotations

import struct
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from hashlib import sha256

from kernel.names import Block, Tag
from kernel.tags import Pages, Rejection, TagRecord, encode, kind_of
from models.layouts.export.unsayable import Unsayable
from models.layouts.numbers import fields_of
from models.layouts.results import Imported
from models.layouts.track import Mark

PLANNED_BITS = 63
LAID = struct.Struct(">QII")
"""One tag in a file of records: its UID, its two pages; most significant byte first, 16 bytes (T1)."""


@dataclass(frozen=True)
class PlannedTag:
    """One tag: the boundary it lies at, the side of which block, and its record with its two pages.

    ``track``, ``at_mm``: the place of the boundary; none and -1 where the file has no track.  A tag lies beside its
    boundary, on the side of its block, by so much as the train's overhang and the reader's window ask for (T2).
    """

    tag: Tag
    boundary: str
    block: Block
    record: TagRecord
    pages: Pages
    track: str | None
    at_mm: int

    @property
    def crc(self) -> int:
        """The CRC in the second page."""
        return self.pages.second & 0xFFFF

    @property
    def kind(self) -> str:
        """The kind in a word."""
        return kind_of(self.record.kind).name.lower().replace("_", " ")


def planned_uid(name: str) -> int:
    """The UID that stands for a tag until one is laid: drawn from its name, never one that is made.

    UIDs by ISO/IEC 15693 begin with E0, that is with their highest bit set; planned ones do not.
    """
    return int.from_bytes(sha256(name.encode()).digest()[:8], "big") & (1 << PLANNED_BITS) - 1


def tag_plan(imported: Imported) -> list[PlannedTag]:
    """Every tag of a layout, in the order of the boundaries' names.

    Raises:
        Unsayable: a record does not fit its bits, or two tags would have one UID.
    """
    marks = imported.station.marks if imported.station is not None else {}
    found: list[PlannedTag] = []
    owner: dict[int, Tag] = {}
    for tag in sorted(imported.layout.tag_in):
        kind, number, distance_mm = fields_of(imported.records.record[tag])
        record = TagRecord(planned_uid(tag), number, distance_mm, kind)
        pages = encode(record)
        if isinstance(pages, Rejection):
            raise Unsayable(f"tag '{tag}': {pages.value}")
        if owner.setdefault(record.uid, tag) != tag:
            raise Unsayable(f"tags '{owner[record.uid]}' and '{tag}' would have one UID: rename one of the boundaries")
        (boundary, *_) = imported.places.tags[tag]
        mark: Mark | None = marks.get(boundary)
        where = (mark.track, mark.at_mm) if mark is not None else (None, -1)
        found.append(PlannedTag(tag, boundary, imported.layout.tag_in[tag], record, pages, *where))
    return found


def as_bytes(plan: Iterable[PlannedTag]) -> bytes:
    """The plan as records of 16 bytes, in its order."""
    return b"".join(LAID.pack(each.record.uid, *each.pages) for each in plan)


def from_bytes(content: bytes) -> Sequence[tuple[int, Pages]]:
    """UIDs and pages out of records of 16 bytes.

    Raises:
        Unsayable: there is a piece of a record left.
    """
    if len(content) % LAID.size:
        raise Unsayable(f"{len(content)} bytes are no whole number of records of {LAID.size}")
    return [(uid, Pages(first, second)) for uid, first, second in LAID.iter_unpack(content)]
