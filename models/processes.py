"""Work spread over processes, its results in order."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from concurrent.futures import ProcessPoolExecutor
from multiprocessing import get_context
from typing import TypeVar

Work = TypeVar("Work")
Found = TypeVar("Found")


def spread(do: Callable[[Work], Found], todo: Sequence[Work], jobs: int) -> Iterator[Found]:
    """Do each piece of work in one of so many processes; what comes of them, in order."""
    if jobs <= 1 or len(todo) <= 1:
        yield from map(do, todo)
        return
    with ProcessPoolExecutor(jobs, mp_context=get_context("spawn")) as pool:
        yield from pool.map(do, todo)
