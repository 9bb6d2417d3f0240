"""A tag list in telegrams: it is split where a telegram cannot hold all of it, and joined once every part has come.

What is joined is whatever came; that it is the list that was meant is found out where it is compared (T4, T11).
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import Any

from kernel.names import Run, TagList

PART_BYTES = 900
"""So much of a list in one telegram, which holds a payload of 1,024 bytes with the run and the part's number."""


def in_parts(run: Run, tag_list: TagList) -> Iterator[Mapping[str, Any]]:
    """The fields of the telegrams that carry a list."""
    text = tag_list.encode()
    pieces = [text[at : at + PART_BYTES] for at in range(0, len(text), PART_BYTES)] or [b""]
    for number, piece in enumerate(pieces):
        yield {"run": run, "part": number, "parts": len(pieces), "text": piece}


class Joined:
    """What has come of the lists of each run."""

    def __init__(self) -> None:
        self._parts: dict[Run, dict[int, bytes]] = {}

    def take(self, run: Run, part: int, parts: int, text: bytes) -> TagList | None:
        """Keep a part; give the list if that was the last one missing, and forget its parts."""
        kept = self._parts.setdefault(run, {})
        kept[part] = text
        if any(number not in kept for number in range(parts)):
            return None
        del self._parts[run]
        return TagList(b"".join(kept[number] for number in range(parts)).decode(errors="replace"))
