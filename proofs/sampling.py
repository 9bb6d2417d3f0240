"""What `--sample N` tries: always the same, and still nearly the same when a few names come or go.

Each name has a place in the draw of its own, by its digest.  So a change of the kernel that adds a mutant puts at most
that one into the sample, and drives out one at the most of those that were tried before.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from hashlib import sha256
from heapq import nsmallest
from typing import TypeVar

Named = TypeVar("Named")


def sampled(asked: Sequence[Named], count: int | None, name: Callable[[Named], str] = str) -> list[Named]:
    """So many of these, in their order; all of them if there are no more, or no count is given.

    ``name`` gives each its name; two of the same name are in the sample together or not at all, but for the last.
    """
    if count is None or count >= len(asked):
        return list(asked)
    places = [sha256(name(each).encode("utf-8")).digest() for each in asked]
    drawn = set(nsmallest(count, range(len(asked)), key=places.__getitem__))
    return [each for number, each in enumerate(asked) if number in drawn]
