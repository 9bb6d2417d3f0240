"""Processes of other machines that work on batches, behind a Dask scheduler.

They must have the same sources and versions, and find layouts under the same paths; each tells if it does
not.  A batch that takes too long ends its process, whose nanny starts another; the scheduler gives the batch
to others, as often as its option ``allowed-failures`` says.
"""

from __future__ import annotations

import queue
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from typing import Any

from fuzz.campaign.outcome import DIED, DONE, FAILED, HUNG, Outcome
from fuzz.campaign.pool import TRIES
from fuzz.campaign.problems import CampaignError
from fuzz.campaign.worker import Answer, Work, answered_in_time
from fuzz.targets.target import Batch
from models.scheduler import REACHED_WITHIN_S, SchedulerError, connected, lost, reaching, words_of

COUNTED_EVERY_S = 2.0
BATCHES_A_THREAD = 2
"""So many under way, so that a process need not wait for the next one to be sent."""


class Scheduled:
    """The processes of a scheduler; ``say`` gets a line for what goes wrong there."""

    def __init__(self, work: Work, address: str, batch_seconds: float, say: Callable[[str], object]) -> None:
        self._work, self._address, self._batch_seconds, self._say = work, address, batch_seconds, say
        self._under_way: dict[Any, tuple[Batch, float]] = {}
        self._ended: queue.SimpleQueue[Any] = queue.SimpleQueue()
        self._failed: dict[Batch, int] = {}
        self._threads, self._counted = 0, 0.0
        self._alone_said = False
        with told_of_campaigns():
            self._client: Any = connected(address)

    def wanted(self) -> int:
        """Two for each thread of the scheduler's workers, counted now and then."""
        now = time.monotonic()
        if now - self._counted > COUNTED_EVERY_S:
            with self._reaching():
                self._threads, self._counted = sum(self._client.nthreads().values()), now
            if not self._threads and not self._alone_said:
                self._alone_said = True
                self._say(f"{self._address} has no workers yet; dask worker {self._address} starts some")
        return max(1, BATCHES_A_THREAD * self._threads)

    def submit(self, batch: Batch) -> None:
        """Hand a batch to the scheduler."""
        with self._reaching():
            future = self._client.submit(answered_in_time, self._work, batch, self._batch_seconds, pure=False)
        self._under_way[future.key] = (batch, time.monotonic())
        future.add_done_callback(self._ended.put)

    def wait(self, seconds: float) -> list[Outcome]:
        """Wait so long at most for batches to end.

        Raises:
            CampaignError: the scheduler is gone, or a worker found other files or versions than the campaign has.
        """
        found: list[Outcome] = []
        try:
            future = self._ended.get(timeout=seconds)
            while True:
                found += self._hear(future)
                future = self._ended.get_nowait()
        except queue.Empty:
            pass
        if self._client.status != "running":
            with told_of_campaigns():
                raise lost(self._address)
        return found

    def close(self) -> None:
        """Drop what is under way, and leave the scheduler to others."""
        self._under_way.clear()
        self._client.close(timeout=REACHED_WITHIN_S)

    @contextmanager
    def _reaching(self) -> Iterator[None]:
        with told_of_campaigns(), reaching(self._address):
            yield

    def _hear(self, future: Any) -> list[Outcome]:
        from distributed import KilledWorker

        if future.key not in self._under_way:
            return []
        with self._reaching():
            error = future.exception()
            answer: Answer = future.result() if error is None else Answer("failed", words=words_of(error))
        batch, since = self._under_way.pop(future.key)
        if isinstance(error, KilledWorker):
            how = HUNG if time.monotonic() - since > self._batch_seconds else DIED
            return [self._over(batch, how, "its processes ended, one after the other")]
        if answer.kind == "differs":
            line = f"a worker of {self._address} has something else than the campaign began with: {answer.words}"
            raise CampaignError(f"{line}; give it the same, and start again (finished work is kept)")
        if answer.kind == "done":
            return [Outcome(batch, answer.result, DONE)]
        self._failed[batch] = self._failed.get(batch, 0) + 1
        if self._failed[batch] >= TRIES[FAILED]:
            return [self._over(batch, FAILED, answer.words)]
        self._say(f"batch {batch.number} of {batch.target} failed: {answer.words}; it is tried again")
        self.submit(batch)
        return []

    def _over(self, batch: Batch, how: str, words: str) -> Outcome:
        line = f"batch {batch.number} of {batch.target} {how}: {words}; it is left out"
        self._say(line)
        return Outcome(batch, None, how, line)


@contextmanager
def told_of_campaigns() -> Iterator[None]:
    """What ends a scheduler's work ends a campaign, in the same words."""
    try:
        yield
    except SchedulerError as error:
        raise CampaignError(str(error), error.code) from error
