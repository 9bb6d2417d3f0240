"""A batch as a row of the store, and the texts and bytes in it."""

from __future__ import annotations

import hashlib
import json
import re
import zlib
from collections.abc import Mapping
from typing import NamedTuple

import numpy as np
import numpy.typing as npt

from fuzz.campaign.outcome import Outcome

Ids = npt.NDArray[np.int64]
DIGITS_OF_A_CAUSE = 12


class Failure(NamedTuple):
    """One cause of failure in a batch: the first violated invariant, how often, and the first trace of it."""

    digest: str
    invariant: str
    times: int
    trace: str


class Row(NamedTuple):
    """A batch as it is stored: the columns of ``batches`` in their order."""

    seed: int
    target: str
    number: int
    status: str
    weights: str
    traces: int
    steps: int
    seconds: float
    counts: str
    covered: bytes
    pairs: bytes
    sketch: bytes
    digest: str
    words: str


def row_of(outcome: Outcome) -> tuple[Row, tuple[Failure, ...]]:
    """Give a batch as it is stored, and its failures, one for each cause."""
    batch, result = outcome.batch, outcome.result
    failures = failures_of(result.failures) if result else ()
    weights = json.dumps(batch.weights)
    counts = json.dumps(dict(result.counts) if result else {}, sort_keys=True)
    covered, pairs = packed(result.covered if result else {}), packed(result.pairs if result else {})
    sketch = result.sketch if result else b""
    traces, steps = (result.traces, result.steps) if result else (0, 0)
    told = [batch.seed, batch.target, batch.number, weights, traces, steps, counts, *failures]
    digest = hashlib.sha256(json.dumps(told).encode() + covered + pairs + sketch).hexdigest()
    row = Row(
        seed=batch.seed,
        target=batch.target,
        number=batch.number,
        status=outcome.status,
        weights=weights,
        traces=traces,
        steps=steps,
        seconds=result.seconds if result else 0.0,
        counts=counts,
        covered=zlib.compress(covered),
        pairs=zlib.compress(pairs),
        sketch=zlib.compress(sketch),
        digest=digest,
        words=outcome.words,
    )
    return row, failures


def packed(hits: Mapping[int, int]) -> bytes:
    """Pack hits by id: 64-bit words, id and hits by turns, in the ids' order."""
    return np.array(sorted(hits.items()), np.int64).tobytes()


def unpacked(stored: bytes) -> tuple[Ids, Ids]:
    """Give ids and hits of a stored column, in the ids' order.

    Raises:
        zlib.error: the bytes are not what was stored.
    """
    both = np.frombuffer(zlib.decompress(stored), np.int64).reshape(-1, 2)
    return both[:, 0], both[:, 1]


def failures_of(traces: tuple[str, ...]) -> tuple[Failure, ...]:
    """Put traces together by cause, in the order in which causes were found first."""
    found: dict[str, Failure] = {}
    for trace in traces:
        digest, invariant = cause_of(trace)
        known = found.get(digest)
        found[digest] = known._replace(times=known.times + 1) if known else Failure(digest, invariant, 1, trace)
    return tuple(found.values())


def cause_of(trace: str) -> tuple[str, str]:
    """Give what two traces of one cause have in common, as a digest, and the first invariant that was violated."""
    read = json.loads(trace)
    violated = read["violated"]
    assert violated, "a failure in which nothing is violated"
    cause = [read["target"], violated, read.get("planted"), read.get("cause")]
    text = json.dumps(cause, sort_keys=True)
    return hashlib.sha256(text.encode()).hexdigest()[:DIGITS_OF_A_CAUSE], str(violated[0])


def file_name(invariant: str, digest: str) -> str:
    """Name the file of a trace."""
    return f"{re.sub(r'[^A-Za-z0-9_]', '_', invariant)}-{digest}.json"
