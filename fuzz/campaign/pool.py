"""Processes of this machine that work on batches; one that hangs or dies is replaced, and its batch tried again."""

from __future__ import annotations

import time
from collections import deque
from collections.abc import Callable
from dataclasses import dataclass
from multiprocessing import connection, get_context
from multiprocessing.connection import Connection
from multiprocessing.process import BaseProcess
from typing import Protocol

from fuzz.campaign.outcome import DIED, DONE, FAILED, HUNG, Outcome
from fuzz.campaign.problems import CampaignError
from fuzz.campaign.worker import Answer, Work, serve
from fuzz.targets.target import Batch
from models.exit_codes import UNDECIDED
from models.processes import uninterrupted

TRIES = {HUNG: 2, FAILED: 2, DIED: 3}
"""How often a batch may end so before that is what it came to; a process may be killed by someone else."""
START_SECONDS = 120.0
"""A process that is not ready by then is taken for dead."""
FAILED_STARTS = 3
"""So many in a row end the campaign."""


class Workers(Protocol):
    """Processes that work on batches, here or elsewhere."""

    def wanted(self) -> int:
        """How many batches should be under way, so that no process waits."""
        ...

    def submit(self, batch: Batch) -> None:
        """Hand a batch in."""
        ...

    def wait(self, seconds: float) -> list[Outcome]:
        """Wait so long at most for batches to end; each is given once.

        Raises:
            CampaignError: the processes cannot go on.
        """
        ...

    def close(self) -> None:
        """End all processes, or give them back, at once; batches under way are dropped."""
        ...


@dataclass(eq=False)
class _Worker:
    """One process.  ``until``: by when it must have spoken, on the monotonic clock."""

    process: BaseProcess
    pipe: Connection
    until: float
    ready: bool = False
    batch: Batch | None = None

    def busy(self) -> bool:
        """Whether it has something to say by and by."""
        return self.batch is not None or not self.ready


class Pool:
    """A pool of processes; ``say`` gets a line for each that is replaced."""

    def __init__(self, work: Work, workers: int, batch_seconds: float, say: Callable[[str], object]) -> None:
        assert workers >= 1, workers
        self._work, self._count, self._batch_seconds, self._say = work, workers, batch_seconds, say
        self._waiting: deque[Batch] = deque()
        self._ends: dict[Batch, list[str]] = {}
        self._failed_starts = 0
        self._workers: list[_Worker] = []
        try:
            for _ in range(workers):
                self._start()
        except BaseException:
            self.close()
            raise

    def wanted(self) -> int:
        """As many as there are processes, and one to go on with."""
        return self._count + 1

    def submit(self, batch: Batch) -> None:
        """Hand a batch in; it begins when a process is free."""
        self._waiting.append(batch)

    def wait(self, seconds: float) -> list[Outcome]:
        """Wait so long at most for batches to end.

        Raises:
            CampaignError: processes do not start, or find other files than the campaign began with.
        """
        self._hand_out()
        now = time.monotonic()
        until = min(
            [worker.until for worker in self._workers if worker.batch or not worker.ready], default=now + seconds
        )
        heard = connection.wait([worker.pipe for worker in self._workers], max(0.0, min(seconds, until - now)))
        found: list[Outcome] = []
        for worker in [each for each in self._workers if each.pipe in heard]:
            found += self._hear(worker)
        for worker in list(self._workers):
            if worker.busy() and time.monotonic() > worker.until and not worker.pipe.poll():
                words = f"no result within {self._batch_seconds:g} s, its process was ended"
                found += self._replace(worker, HUNG, words)
        self._hand_out()
        return found

    def close(self) -> None:
        """End all processes at once."""
        for worker in self._workers:
            worker.process.kill()
        for worker in self._workers:
            worker.process.join()
            worker.pipe.close()
        self._workers.clear()

    def processes(self) -> list[int]:
        """Their ids."""
        return [worker.process.pid for worker in self._workers if worker.process.pid]

    def _start(self) -> None:
        context = get_context("spawn")
        ours, theirs = context.Pipe()
        process = context.Process(target=serve, args=(theirs, self._work, self._batch_seconds), daemon=True)
        with uninterrupted():
            process.start()
        theirs.close()
        self._workers.append(_Worker(process, ours, time.monotonic() + START_SECONDS))

    def _hand_out(self) -> None:
        for worker in self._workers:
            if worker.ready and not worker.batch and self._waiting:
                worker.batch = self._waiting.popleft()
                worker.until = time.monotonic() + self._batch_seconds
                try:
                    worker.pipe.send(worker.batch)
                except OSError:
                    worker.until = 0.0  # it is gone; waiting for it finds that out

    def _hear(self, worker: _Worker) -> list[Outcome]:
        try:
            answer: Answer = worker.pipe.recv()
        except (EOFError, OSError):
            return self._replace(worker, DIED, "its process ended")
        batch, worker.batch = worker.batch, None
        if answer.kind == "differs":
            line = f"a worker found something else than the campaign began with: {answer.words}"
            raise CampaignError(f"{line}; put it back and start again, or begin another (finished work is kept)")
        if answer.kind == "ready":
            worker.ready, self._failed_starts = True, 0
            return []
        assert batch is not None, "an answer to nothing"
        if answer.kind == "failed":
            return self._again(batch, FAILED, answer.words)
        self._ends.pop(batch, None)
        return [Outcome(batch, answer.result, DONE)]

    def _replace(self, worker: _Worker, how: str, words: str) -> list[Outcome]:
        """End a process that hangs or is gone, and start another."""
        self._workers.remove(worker)
        worker.process.kill()
        worker.process.join()
        worker.pipe.close()
        if not worker.ready:
            self._failed_starts += 1
            if self._failed_starts >= FAILED_STARTS:
                line = f"{FAILED_STARTS} workers in a row ended before they were ready (exit code"
                raise CampaignError(f"{line} {worker.process.exitcode}); what was finished is kept", UNDECIDED)
        self._start()
        return self._again(worker.batch, how, words) if worker.batch else []

    def _again(self, batch: Batch, how: str, words: str) -> list[Outcome]:
        """Try a batch again, before any other; or tell that it is over."""
        ends = self._ends.setdefault(batch, [])
        ends.append(how)
        line = f"batch {batch.number} of {batch.target} {how}: {words}"
        if ends.count(how) < TRIES[how]:
            self._say(f"{line}; it is tried again")
            self._waiting.appendleft(batch)
            return []
        del self._ends[batch]
        line = f"{line}, {TRIES[how]} times; it is left out"
        self._say(line)
        return [Outcome(batch, None, how, line)]
