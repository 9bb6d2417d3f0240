"""What a campaign has finished, in one SQLite file: each batch once, whatever ended the processes before."""

from __future__ import annotations

import json
import sqlite3
import zlib
from collections.abc import Iterable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from dataclasses import astuple, dataclass
from pathlib import Path
from types import TracebackType
from typing import Any

from fuzz.campaign.files import DATABASE, damaged, locked, opened, said
from fuzz.campaign.identity import Identity, difference
from fuzz.campaign.outcome import DONE, Outcome
from fuzz.campaign.problems import CampaignError
from fuzz.campaign.rows import Failure, Ids, Row, file_name, row_of, unpacked
from fuzz.campaign.sketch import estimate, merged
from fuzz.campaign.sought import Sought
from models.streams import write_whole

BATCH = "seed = ? AND target = ? AND number = ?"


@dataclass(frozen=True)
class Totals:
    """What one target came to.

    ``unfinished``: batches that hung, died or failed.  ``states``: about how many were distinct.
    ``causes``: failures with different causes; ``failures``: all of them.  ``seconds``: of all processes.
    """

    batches: int = 0
    unfinished: int = 0
    traces: int = 0
    steps: int = 0
    seconds: float = 0.0
    states: int = 0
    tuples: int = 0
    pairs: int = 0
    causes: int = 0
    failures: int = 0


@dataclass(frozen=True)
class Kept:
    """A batch that is done, as guidance looks at it: ids of tuples and of pairs, in order."""

    number: int
    weights: tuple[float, ...]
    covered: Ids
    pairs: Ids


class Store:
    """The store of a campaign in a folder, for one process at a time.

    Every method raises CampaignError, in one line, if the file cannot be read or written.
    """

    def __init__(self, folder: Path, alone: bool = True) -> None:
        """Open the store of a folder, or begin one; not ``alone``: to read only, while another may be adding to it."""
        self.folder, self.path = folder, folder / DATABASE
        with said(folder):
            folder.mkdir(parents=True, exist_ok=True)
        self._lock = locked(folder) if alone else None
        try:
            self._db = opened(self.path, new=alone)
        except BaseException:
            self._unlock()
            raise

    def __enter__(self) -> Store:
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        self.close()

    def close(self) -> None:
        """Close the file; what was added is in it already."""
        self._db.close()
        self._unlock()

    def _unlock(self) -> None:
        if self._lock:
            self._lock.close()

    @contextmanager
    def _together(self) -> Iterator[sqlite3.Connection]:
        """All of it or nothing."""
        with said(self.path):
            self._db.execute("BEGIN IMMEDIATE")
            try:
                yield self._db
                self._db.execute("COMMIT")
            except BaseException:
                if self._db.in_transaction:
                    self._db.execute("ROLLBACK")
                raise

    def ask(self, question: str, *values: object) -> list[tuple[Any, ...]]:
        """Put a question in SQL, and give all rows."""
        with said(self.path):
            return self._db.execute(question, values).fetchall()

    # ---- what the campaign is

    def identity(self) -> dict[str, str]:
        """What the results in it follow from; nothing but the format in a store that is new."""
        return dict(self.ask("SELECT thing, value FROM identity"))

    def seeds(self) -> list[int]:
        """The seeds that it was started with."""
        return [seed for (seed,) in self.ask("SELECT DISTINCT seed FROM starts ORDER BY seed")]

    def starts(self) -> list[dict[str, object]]:
        """When it was started, with which seed, commit and versions."""
        rows = self.ask("SELECT at, seed, record FROM starts ORDER BY at, seed")
        return [{"at": at, "seed": seed, **json.loads(record)} for at, seed, record in rows]

    def agree(self, identity: Identity) -> None:
        """Take an identity for a new store; hold it against that of one that was begun.

        Raises:
            CampaignError: the store was made from something else; says what.
        """
        known = self.identity()
        if len(known) == 1:
            with self._together() as db:
                db.executemany("INSERT OR REPLACE INTO identity VALUES (?, ?)", identity.items())
            return
        differs = difference(known, identity)
        if differs:
            line = f"{self.folder}: its campaign was run with something else: {differs}"
            raise CampaignError(f"{line}; put that back to go on, or name another folder (its results are kept)")

    def note_start(self, at: str, seed: int, record: Mapping[str, object]) -> None:
        """Note that the campaign was started; a second note of the same start adds nothing."""
        text = json.dumps(record, sort_keys=True)
        with self._together() as db:
            known = db.execute("SELECT 1 FROM starts WHERE (at, seed, record) = (?, ?, ?)", (at, seed, text)).fetchone()
            if not known:
                db.execute("INSERT INTO starts VALUES (?, ?, ?)", (at, seed, text))

    def keep_layouts(self, layouts: Iterable[Path]) -> None:
        """Copy layouts into the folder, where traces look for them.

        Raises:
            CampaignError: one cannot be read, or another one of its name is there.
        """
        for path in layouts:
            try:
                content = path.read_bytes()
            except OSError as error:
                raise CampaignError(f"{path}: cannot be read ({error.strerror}); name a layout file") from error
            copy = self.folder / "layouts" / path.name
            with said(copy):
                if not copy.exists():
                    write_whole(copy, content)
                elif copy.read_bytes() != content:
                    line = f"{path}: {copy} is another layout of that name; rename one, or name another folder"
                    raise CampaignError(line)

    # ---- batches

    def add(self, outcome: Outcome) -> bool:
        """Add a batch with all that it came to; False if it was there already.  Writes traces of new causes."""
        return self.add_row(*row_of(outcome))

    def add_row(self, row: Row, failures: Sequence[Failure]) -> bool:
        """Add a batch as it is stored.  One that is done takes the place of one that is not.

        Raises:
            CampaignError: the same batch came to something else before.
        """
        key = (row.seed, row.target, row.number)
        with self._together() as db:
            known = db.execute(f"SELECT status, digest FROM batches WHERE {BATCH}", key).fetchone()
            if known and known[0] == row.status == DONE and known[1] != row.digest:
                line = f"{self.path}: batch {row.number} of {row.target} with seed {row.seed} came to something else"
                raise CampaignError(f"{line} before: the target is not repeatable; this is a fault to report")
            if known and (known[0] == DONE or row.status != DONE):
                return False
            db.execute(f"DELETE FROM batches WHERE {BATCH}", key)
            db.execute(f"INSERT INTO batches VALUES ({', '.join('?' * len(row))})", row)
            self._add_sums(db, row)
            db.executemany("INSERT INTO failures VALUES (?, ?, ?, ?, ?, ?, ?)", [(*key, *each) for each in failures])
        for failure in failures:
            self._write_trace(failure.digest)
        return True

    def _add_sums(self, db: sqlite3.Connection, row: Row) -> None:
        db.executemany(
            "INSERT INTO counts VALUES (?, ?, ?) ON CONFLICT DO UPDATE SET value = value + excluded.value",
            [(row.target, name, value) for name, value in json.loads(row.counts).items()],
        )
        for table, stored in (("covered", row.covered), ("pairs", row.pairs)):
            ids, hits = unpacked(stored)
            db.executemany(
                f"INSERT INTO {table} VALUES (?, ?, ?, ?) ON CONFLICT DO UPDATE"
                " SET hits = hits + excluded.hits, first = min(first, excluded.first)",
                [(row.target, id_, count, row.number) for id_, count in zip(ids.tolist(), hits.tolist(), strict=True)],
            )
        known = db.execute("SELECT registers FROM sketches WHERE target = ?", (row.target,)).fetchone()
        registers = merged(known[0] if known else b"", zlib.decompress(row.sketch))
        db.execute("INSERT OR REPLACE INTO sketches VALUES (?, ?)", (row.target, registers))

    def rows(self) -> Iterator[tuple[Row, list[Failure]]]:
        """Give every batch with its failures, in the order of seed, target and number."""
        for seed, target, number in self.ask("SELECT seed, target, number FROM batches ORDER BY 1, 2, 3"):
            key = (seed, target, number)
            found = self.ask(f"SELECT * FROM batches WHERE {BATCH}", *key)[0]
            failures = self.ask(f"SELECT digest, invariant, times, trace FROM failures WHERE {BATCH}", *key)
            yield Row(*found), [Failure(*each) for each in failures]

    def numbers(self, seed: int, target: str) -> set[int]:
        """The numbers of a target's batches that are over, done or not."""
        found = self.ask("SELECT number FROM batches WHERE seed = ? AND target = ?", seed, target)
        return {number for (number,) in found}

    def kept(self, seed: int, target: str, numbers: range) -> list[Kept]:
        """Those of some batches that are done, in their order, as guidance looks at them."""
        with said(self.path):
            found = self._db.execute(
                "SELECT number, weights, covered, pairs FROM batches"
                " WHERE seed = ? AND target = ? AND number >= ? AND number < ? AND status = ? ORDER BY number",
                (seed, target, numbers.start, numbers.stop, DONE),
            )
            return [
                Kept(number, tuple(json.loads(weights)), unpacked(covered)[0].copy(), unpacked(pairs)[0].copy())
                for number, weights, covered, pairs in found
            ]

    def note_round(self, seed: int, target: str, number: int, weights: Sequence[float]) -> None:
        """Note the weights that a round begins with.

        Raises:
            CampaignError: it began with others before.
        """
        text = json.dumps(list(weights))
        with self._together() as db:
            db.execute("INSERT OR IGNORE INTO rounds VALUES (?, ?, ?, ?)", (seed, target, number, text))
            known = db.execute(
                "SELECT weights FROM rounds WHERE seed = ? AND target = ? AND round = ?", (seed, target, number)
            ).fetchone()[0]
        if known != text:
            raise CampaignError(damaged(self.path, f"round {number} of {target} had other weights than follow from it"))

    # ---- what it comes to

    def totals(self) -> dict[str, Totals]:
        """What each target came to, in the order of their names, over all seeds."""
        sums = self.ask(
            "SELECT b.target, COUNT(*), SUM(status != 'done'), SUM(traces), SUM(steps), SUM(seconds),"
            " (SELECT registers FROM sketches s WHERE s.target = b.target),"
            " (SELECT COUNT(*) FROM covered c WHERE c.target = b.target),"
            " (SELECT COUNT(*) FROM pairs p WHERE p.target = b.target),"
            " (SELECT COUNT(DISTINCT digest) FROM failures f WHERE f.target = b.target),"
            " (SELECT COALESCE(SUM(times), 0) FROM failures f WHERE f.target = b.target)"
            " FROM batches b GROUP BY b.target ORDER BY b.target"
        )
        found = {}
        for target, *row in sums:
            row[5] = estimate(row[5])
            found[target] = Totals(*row)
        return found

    def counts(self, target: str) -> dict[str, int]:
        """The sums of what a target counts, by name."""
        found = self.ask("SELECT name, value FROM counts WHERE target = ? ORDER BY name", target)
        return dict(found)

    def failures(self) -> list[tuple[str, str, str, int, Path]]:
        """Each cause of failure: target, invariant, digest, how often, and its trace's file."""
        found = self.ask("SELECT target, invariant, digest, SUM(times) FROM failures GROUP BY digest ORDER BY 1, 2, 3")
        return [
            (target, invariant, digest, times, self._trace_file(invariant, digest))
            for target, invariant, digest, times in found
        ]

    def unfinished(self) -> list[str]:
        """What is to be said of each batch that is over and not done."""
        found = self.ask("SELECT words FROM batches WHERE status != ? ORDER BY seed, target, number", DONE)
        return [words for (words,) in found]

    # ---- canaries

    def note_canaries(self, seed: int, sought: Sequence[Sought]) -> None:
        """Note what became of a seed's canaries; a later answer stands in an earlier one's place."""
        with self._together() as db:
            db.executemany(
                "INSERT OR REPLACE INTO canaries VALUES (?, ?, ?, ?, ?, ?)", [(seed, *astuple(each)) for each in sought]
            )

    def canaries(self, seed: int | None = None) -> list[Sought]:
        """What became of every canary, or of one seed's."""
        found = self.ask("SELECT seed, kind, fault, target, batches, seconds FROM canaries ORDER BY seed, kind")
        return [Sought(*each) for of, *each in found if seed in (None, of)]

    # ---- traces as files

    def write_traces(self) -> None:
        """Write the trace of every cause whose file is not as it should be: a process may have ended before it did."""
        for *_, digest, _, _ in self.failures():
            self._write_trace(digest)

    def _write_trace(self, digest: str) -> None:
        """Write a cause's trace, of the lowest batch that found it: the same whatever came in first."""
        invariant, trace = self.ask(
            "SELECT invariant, trace FROM failures WHERE digest = ? ORDER BY number, seed LIMIT 1", digest
        )[0]
        path, content = self._trace_file(invariant, digest), (trace + "\n").encode()
        with said(path):
            if not path.exists() or path.read_bytes() != content:
                write_whole(path, content)

    def _trace_file(self, invariant: str, digest: str) -> Path:
        return self.folder / "traces" / file_name(invariant, digest)
