"""One process that works: it takes batches, and gives what they came to."""

from __future__ import annotations

import faulthandler
import os
import pickle
import signal
from collections.abc import Mapping, Sequence
from functools import cache
from multiprocessing.connection import Connection
from pathlib import Path
from typing import Literal, NamedTuple

from fuzz.campaign.identity import difference, identity_of
from fuzz.campaign.problems import CampaignError
from fuzz.targets.target import Batch, Result, Target
from models.scheduler import ONE_AT_A_TIME
from models.sources import are_as_loaded

SPARE_S = 30.0
"""Beyond a batch's time: by then whoever watches has ended the process, or is gone."""

CHANGED = "sources that have changed since it was begun; start it anew"


class Work(NamedTuple):
    """What a process needs to know before its first batch.

    ``targets``: pickled.  ``identity``: the campaign's, sorted pairs; the process must find the same.
    """

    targets: bytes
    identity: tuple[tuple[str, str], ...]


class Answer(NamedTuple):
    """What a process says: ready, done with a result, failed with words, or that it is another campaign's."""

    kind: Literal["ready", "done", "failed", "differs"]
    result: Result | None = None
    words: str = ""


def work_on(targets: Sequence[Target], identity: Mapping[str, str]) -> Work:
    """Give what processes need to know."""
    return Work(pickle.dumps(tuple(targets)), tuple(sorted(identity.items())))


@cache
def loaded(work: Work) -> Mapping[str, Target] | str:
    """The targets by name, once a process; or what differs from the campaign's identity, in words."""
    targets: tuple[Target, ...] = pickle.loads(work.targets)
    try:
        differs = difference(dict(work.identity), dict(sorted(identity_of(targets).items())))
    except CampaignError as error:
        return str(error)
    return differs or {target.name: target for target in targets}


def answered(work: Work, batch: Batch) -> Answer:
    """Run a batch; whatever a target raises becomes words."""
    try:
        targets = loaded(work)
        if isinstance(targets, str):
            return Answer("differs", words=targets)
        result = targets[batch.target].run(batch)
        assert result.batch == batch, (result.batch, batch)
    except Exception as error:
        return Answer("failed", words=f"{type(error).__name__}: {error}".splitlines()[0])
    return Answer("done", result)


def serve(pipe: Connection, work: Work, batch_seconds: float) -> None:
    """Serve batches until nobody asks any more.

    A batch that takes far too long ends the process even if nobody watches any more.
    """
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    nowhere = os.open(os.devnull, os.O_WRONLY)
    try:
        targets = loaded(work)
        pipe.send(Answer("differs", words=targets) if isinstance(targets, str) else Answer("ready"))
        while True:
            batch = pipe.recv()
            faulthandler.dump_traceback_later(batch_seconds + SPARE_S, exit=True, file=nowhere)
            answer = answered(work, batch)
            faulthandler.cancel_dump_traceback_later()
            pipe.send(answer)
    except (EOFError, OSError):
        return


def answered_in_time(work: Work, batch: Batch, batch_seconds: float) -> Answer:
    """Run a batch in a process that serves others too: one at a time; too long a batch ends the process.

    Such a process may have loaded what has changed since, so that its files say nothing of what it runs.
    """
    with ONE_AT_A_TIME, Path(os.devnull).open("wb") as nowhere:
        faulthandler.dump_traceback_later(batch_seconds, exit=True, file=nowhere)
        try:
            answer = answered(work, batch)
            return answer if are_as_loaded() else Answer("differs", words=CHANGED)
        finally:
            faulthandler.cancel_dump_traceback_later()
