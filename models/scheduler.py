"""Work done by processes of other machines, behind a Dask scheduler.

They must have the same sources and versions; each tells if it does not.  A process that ends is replaced by its nanny;
the scheduler gives its work to others, as often as its option ``allowed-failures`` says.
"""

from __future__ import annotations

import logging
import queue
import secrets
import threading
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass, field
from typing import Any, TypeVar

from models.exit_codes import BAD_INPUT, UNDECIDED
from models.processes import be_numbered
from models.sources import are_as_loaded

Work = TypeVar("Work")
Found = TypeVar("Found")

REACHED_WITHIN_S = 10
BITS_OF_A_NUMBER = 53
"""Of the number of a process among those of other machines: as many as any reader of JSON takes."""


class SchedulerError(Exception):
    """One line: what is wrong with a scheduler or its processes, and what to do; ``code``: how the command ends."""

    def __init__(self, line: str, code: int = BAD_INPUT) -> None:
        super().__init__(line)
        self.code = code


@dataclass(frozen=True)
class _Differs:
    """A process has other sources or versions than whoever asks it, or has loaded others: what it found is not told."""


@dataclass(frozen=True)
class Scheduler:
    """The processes of a scheduler.

    ``same``: gives what its processes and this one must agree on, before anything that they find is believed.
    """

    address: str
    same: Callable[[], str]
    client: Any = field(repr=False, compare=False)

    def spread(self, do: Callable[[Work], Found], todo: Sequence[Work]) -> Iterator[Found]:
        """Do each piece of work in one of the processes; what comes of them, in order.

        Raises:
            SchedulerError: the scheduler is gone, or a process has other sources or failed.
        """
        for future in self._submitted(do, todo):
            yield self._found(future)

    def as_they_end(self, do: Callable[[Work], Found], todo: Sequence[Work]) -> Iterator[Found]:
        """Do each piece of work in one of the processes; what comes of them, whichever ends first.

        Where the scheduler is gone all that was under way ends, too.

        Raises:
            SchedulerError: as above.
        """
        ended: queue.SimpleQueue[Any] = queue.SimpleQueue()
        futures = self._submitted(do, todo)
        for future in futures:
            future.add_done_callback(ended.put)
        for _ in futures:
            yield self._found(ended.get())

    def _submitted(self, do: Callable[[Work], Found], todo: Sequence[Work]) -> list[Any]:
        agreed = self.same()
        with reaching(self.address):
            return [self.client.submit(done_alike, do, each, self.same, agreed, pure=False) for each in todo]

    def _found(self, future: Any) -> Any:
        with reaching(self.address):
            error = future.exception()
        if error is not None:
            raise SchedulerError(f"a worker of {self.address} failed: {words_of(error)}", UNDECIDED)
        with reaching(self.address):
            found = future.result()
        if isinstance(found, _Differs):
            line = f"a worker of {self.address} has other sources or versions than these, or had when it was begun"
            raise SchedulerError(f"{line}; give it the same, start it anew, and start again")
        return found


ONE_AT_A_TIME = threading.Lock()
"""Whatever a process that serves others is asked, it does one thing after the other."""


def done_alike(do: Callable[[Work], Found], piece: Work, same: Callable[[], str], agreed: str) -> Found | _Differs:
    """Do a piece of work in a process that serves others too, one at a time; not where it would be another's work.

    It loads modules while it works, so whether they are those that it speaks of is asked again at the end.
    """
    with ONE_AT_A_TIME:
        be_numbered(secrets.randbits(BITS_OF_A_NUMBER))
        if same() != agreed or not are_as_loaded():
            return _Differs()
        found = do(piece)
        return found if are_as_loaded() else _Differs()


@contextmanager
def scheduled(address: str, same: Callable[[], str]) -> Iterator[Scheduler]:
    """Give the processes of a scheduler; what has not begun when they are left is not begun.

    Raises:
        SchedulerError: Dask is not installed, or there is no scheduler at the address.
    """
    client = connected(address)
    try:
        yield Scheduler(address, same, client)
    finally:
        client.close(timeout=REACHED_WITHIN_S)


def connected(address: str) -> Any:
    """Reach a scheduler.

    Raises:
        SchedulerError: Dask is not installed, or there is no scheduler at the address.
    """
    try:
        import distributed
    except ImportError as error:
        line = "--scheduler needs Dask, which is not installed; pip install heisoku[distributed], or leave it out"
        raise SchedulerError(line) from error
    _quieten()
    try:
        made: Any = distributed.Client
        return made(address, timeout=REACHED_WITHIN_S, set_as_default=False)
    except (OSError, TimeoutError, ValueError) as error:
        line = f"--scheduler {address}: cannot be reached; start one with dask scheduler, or leave it out"
        raise SchedulerError(line) from error


def _quieten() -> None:
    """Keep Dask from writing to the terminal what is said here in one line."""
    names = [name for name in logging.root.manager.loggerDict if name.split(".")[0] == "distributed"]
    for name in ("distributed", *names):
        logging.getLogger(name).setLevel(logging.CRITICAL + 1)


@contextmanager
def reaching(address: str) -> Iterator[None]:
    """Ask something of a scheduler that may be gone.

    Raises:
        SchedulerError: it is.
    """
    from distributed.client import FutureCancelledError

    try:
        yield
    except (OSError, TimeoutError, FutureCancelledError) as error:
        raise lost(address) from error


def lost(address: str) -> SchedulerError:
    """The scheduler is gone: that decides nothing."""
    line = f"the scheduler at {address} is gone; start it and then the same command: what was finished is kept"
    return SchedulerError(line, UNDECIDED)


def words_of(error: BaseException) -> str:
    """An exception in one line."""
    return f"{type(error).__name__}: {error}".splitlines()[0]
