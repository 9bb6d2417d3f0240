"""Work spread over processes that end when whoever started them does."""

from __future__ import annotations

import os
import signal
import threading
from collections.abc import Callable, Iterator, Sequence
from concurrent.futures import ProcessPoolExecutor, as_completed
from contextlib import contextmanager
from multiprocessing import active_children, parent_process
from multiprocessing.context import SpawnContext, SpawnProcess
from multiprocessing.resource_tracker import ensure_running
from typing import Protocol, TypeVar

Work = TypeVar("Work")
Found = TypeVar("Found")


class Elsewhere(Protocol):
    """Processes that are not this machine's to begin and to end."""

    def spread(self, do: Callable[[Work], Found], todo: Sequence[Work]) -> Iterator[Found]:
        """Do each piece of work in one of them; what comes of them, in order."""
        ...

    def as_they_end(self, do: Callable[[Work], Found], todo: Sequence[Work]) -> Iterator[Found]:
        """Do each piece of work in one of them; what comes of them, whichever ends first."""
        ...


Workers = int | Elsewhere
"""Who works: so many processes of this machine, or others."""

_given: list[int] = []


def number() -> int:
    """Tell this process from all that work with it: its number here, or the one given among those of other machines."""
    return _given[0] if _given else os.getpid()


def be_numbered(number: int) -> None:
    """Take a number among the processes of other machines, if this process has none yet."""
    if not _given:
        _given.append(number)


@contextmanager
def uninterrupted() -> Iterator[None]:
    """A process started in here is not ended by the terminal's interruption: whoever started it ends it.

    The process that keeps track of shared memory is begun before: Python begins it with the first process of all, and
    lets interruptions through again then.
    """
    ensure_running()
    before = signal.pthread_sigmask(signal.SIG_BLOCK, {signal.SIGINT})
    try:
        yield
    finally:
        signal.pthread_sigmask(signal.SIG_SETMASK, before)


class Uninterrupted(SpawnProcess):
    """A process that an interruption never reaches: a solver would take it for its own, and answer *unknown*."""

    def start(self) -> None:
        """Begin."""
        with uninterrupted():
            super().start()


class Spawned(SpawnContext):
    """How processes are made: none is forked, none interrupted."""

    Process = Uninterrupted


@contextmanager
def processes(jobs: int, *, one_each: bool = False) -> Iterator[ProcessPoolExecutor]:
    """Give so many processes; what has not begun when they are left is not begun.

    Left by an error, an interruption above all, what is under way is ended at once: it is no answer any more.

    ``one_each``: each piece of work has a process of its own.  None is forked: a forked one would share what the
    solvers hold, and could wait for it for ever.
    """
    most = 1 if one_each else None
    others = {child.pid for child in active_children()}
    pool = ProcessPoolExecutor(jobs, Spawned(), initializer=_end_with_parent, max_tasks_per_child=most)
    try:
        yield pool
    except BaseException:
        for child in active_children():
            if child.pid not in others:
                child.kill()
        raise
    finally:
        pool.shutdown(cancel_futures=True)


def spread(do: Callable[[Work], Found], todo: Sequence[Work], jobs: Workers) -> Iterator[Found]:
    """Do each piece of work in one of so many processes; what comes of them, in order."""
    if not isinstance(jobs, int):
        yield from jobs.spread(do, todo)
        return
    if jobs <= 1 or len(todo) <= 1:
        yield from map(do, todo)
        return
    with processes(jobs) as pool:
        yield from pool.map(do, todo)


def as_they_end(
    do: Callable[[Work], Found], todo: Sequence[Work], jobs: Workers, *, one_each: bool = False
) -> Iterator[Found]:
    """Do each piece of work in one of so many processes; what comes of them, whichever ends first.

    ``one_each``: each has a process of its own, if it is of this machine.
    """
    if not isinstance(jobs, int):
        yield from jobs.as_they_end(do, todo)
        return
    if not one_each and (jobs <= 1 or len(todo) <= 1):
        yield from map(do, todo)
        return
    with processes(jobs, one_each=one_each) as pool:
        for future in as_completed([pool.submit(do, each) for each in todo]):
            yield future.result()


def _end_with_parent() -> None:
    """End this process when its parent has: killed, a parent ends nobody, and its work would go on for hours."""
    parent = parent_process()
    if parent is None:
        return

    def watch() -> None:
        parent.join()
        os._exit(1)

    threading.Thread(target=watch, daemon=True).start()
