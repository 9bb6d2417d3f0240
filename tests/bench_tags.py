"""How long a tag takes to be written and read, against the 1.25 ms a page is in the air (T16)."""

from __future__ import annotations

from collections.abc import Iterable
from functools import partial
from random import Random

from kernel.tags import Pages, TagRecord, decode, encode
from tests.bench import Figure, timed


def bench_tag_records() -> Iterable[Figure]:
    """Encode and decode 20,000 random records."""
    random = Random(1)
    records = [
        TagRecord(random.getrandbits(64), random.getrandbits(8), random.getrandbits(28), random.getrandbits(4))
        for _ in range(20_000)
    ]
    pages = [encode(record) for record in records]
    good = [(record.uid, two) for record, two in zip(records, pages, strict=True) if isinstance(two, Pages)]
    assert len(good) == len(records)
    yield timed("tag record encoded", [partial(encode, record) for record in records])
    yield timed("tag record decoded", [partial(decode, uid, two) for uid, two in good])
