"""One search: a compiled site, states to begin with, and what came of so many rounds."""

from __future__ import annotations

import hashlib
from dataclasses import dataclass

import numpy as np

from fuzz.compiled.memory import ALL_PARTS, HEADER, Ints
from fuzz.compiled.native import Native
from fuzz.jolted import states as counted
from fuzz.jolted.events import search
from fuzz.jolted.seeds import states
from fuzz.jolted.tables import record_of, tables_of
from fuzz.jolted.words import LOG_WORDS, MOST_FALSE, MOST_FOUND, NOWHERE, RANDOM, WORK
from models.layouts import Imported
from proofs.transitions import TRANSITIONS

POOL = 48
SEEDS, LEAST_SEEDS = 240, 40
SEED_WORDS = 10_000_000
"""Seeds of a large layout are fewer: no more words than these."""
SAMPLES, FEW_SAMPLES = (1, 3), (0, 1)
"""Of each kind of event so many that changed nothing, and so many that did, are taken in CPython too."""
LARGE_WORDS = 40_000
"""A state of more words is large: fewer samples of it are kept."""


@dataclass(frozen=True)
class Find:
    """An event in a state: the words before it, with the event among them, and every run that is named.

    ``kind``: the transition's number.  ``judged``: that of the invariant said to be false then; none of a sample.
    """

    words: Ints
    kind: int
    judged: int | None


@dataclass(frozen=True)
class Found:
    """What a search came to: how much of what, and the events that are kept.

    ``hits``: events by kind and outcome.  ``seen``: events by kind and the invariant that they made false.
    ``finds``: a few of these, and the samples.
    """

    jolts: int
    landed: int
    events: int
    changed: int
    rounds: int
    hits: Ints
    seen: Ints
    finds: tuple[Find, ...]


class Search:
    """Searches on one compiled site; the same for the same seed and number."""

    def __init__(self, native: Native, imported: Imported) -> None:
        self.native = native
        seeds = self._seeds(imported)
        samples = FEW_SAMPLES if native.memory.bounds()[1] > LARGE_WORDS else SAMPLES
        self._most = MOST_FALSE + sum(samples) * len(TRANSITIONS)
        assert self._most <= MOST_FOUND, self._most
        self.tables = tables_of(native.memory, POOL, len(seeds), samples, self._most)
        self._record = record_of(self.tables)
        self.words = np.zeros(self.tables["words"], np.int64)
        self.words[: native.memory.words] = native.memory.image
        self.words[self.tables["log"] : native.memory.words : LOG_WORDS] = NOWHERE
        self._part("seeds", len(seeds))[:] = seeds
        self._work = np.zeros(1, WORK)
        addresses = native.addresses
        own = self.words.ctypes.data
        self._calls = [own, *(addresses[name] for name in ("step", "judge", "why"))]

    def run(self, seed: int, number: int, rounds: int) -> Found:
        """Search for so many rounds."""
        self._work[:] = 0
        work = self._work[0]
        digest = hashlib.sha256(f"jolts {seed} {number}".encode()).digest()
        work["numbers"][RANDOM] = int.from_bytes(digest[:8], "little", signed=True)
        work["calls"][:] = self._calls
        seeds = self._part("seeds", self.tables["seed_count"])
        self._part("pool", POOL)[:] = seeds[np.arange(POOL) * len(seeds) // POOL]
        search(self._record, self._work, self.words, rounds)
        count = int(work["found"][0, 0])
        states_found = self._part("found", self._most)
        finds = tuple(
            Find(states_found[at].copy(), int(kind), int(judged) if judged >= 0 else None)
            for at, (kind, judged) in enumerate(work["found"][1 : count + 1])
        )
        counts = [int(each) for each in work["counts"]]
        return Found(
            jolts=counts[counted.JOLTS],
            landed=counts[counted.LANDED],
            events=counts[counted.EVENTS],
            changed=counts[counted.CHANGED],
            rounds=counts[counted.ROUNDS],
            hits=work["hits"].copy(),
            seen=work["seen"].copy(),
            finds=finds,
        )

    def _part(self, name: str, count: int) -> Ints:
        """The states of one sort, one in each row."""
        begin, end = self.tables[name], self.tables["state_end"]
        return self.words[begin : begin + count * end].reshape(count, end)

    def _seeds(self, imported: Imported) -> Ints:
        """Packed states in which every invariant holds; those of traffic in which one does not are no seeds."""
        memory, packed = self.native.memory, []
        count = min(SEEDS, max(LEAST_SEEDS, SEED_WORDS // memory.bounds()[1]))
        for system, runs in states(imported, count):
            words = memory.new()
            memory.pack(words, system, runs)
            words[[HEADER.index("grown"), HEADER.index("shrunk")]] = ALL_PARTS
            if self.native.call("judge", words) == -1:
                packed.append(words[: memory.bounds()[1]])
        assert packed, "every state of traffic breaks an invariant"
        return np.stack(packed)
