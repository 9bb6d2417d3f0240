"""Answers kept from one daily proof for the next, by the content of what was asked; no evidence of anything.

One SQLite file.  An *answer* is kept by the hash of the text that was asked, by the solver with a hash of all its
files, by seed and budget, and by the sources that ask; only *proved* and *refuted*, and of a process whose solvers
noticed their canaries.  What is to be known of a *text* without laying it out is kept by what it is made of
(:mod:`proofs.contents`).  An entry carries a digest of itself, so that one that was damaged or edited is noticed, named
and asked anew.  Whoever edits it can make the digest anew: so nothing that is kept is ever put into evidence.
"""

from __future__ import annotations

import errno
import hashlib
import json
import sqlite3
import time
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import asdict, dataclass
from datetime import UTC, datetime
from functools import cache
from pathlib import Path
from typing import Any, NamedTuple, NotRequired, TypedDict

from models import sources
from models.layouts.results import BadInput
from proofs import contents
from proofs.records import CanarySeen, Obligation, Verdict, solvers_hashed
from proofs.solvers import BUDGET, version

APPLICATION = 0x6865_696C
"""SQLite's mark of whose file it is."""
SCHEMA = f"""
PRAGMA application_id = {APPLICATION};
CREATE TABLE IF NOT EXISTS kept (key TEXT PRIMARY KEY, content TEXT NOT NULL, digest TEXT NOT NULL) WITHOUT ROWID;
"""
WAITS_S = 20.0
"""For another run that writes into the same file."""
ASKING = (
    "solvers.py",
    "products.py",
    "smtlib.py",
    "run.py",
    "workbench.py",
    "ways.py",
    "reads.py",
    "canaries.py",
    "canaries.toml",
    "kept.py",
)
"""By which a text becomes an answer that is believed: what was wrong with one of them is not kept with its answers."""

Cell = tuple[str, str]
"""An obligation by its row and column."""
Asked = tuple[str, int]
"""A solver, and the seed that it is asked with."""
KEPT = ("proved", "refuted")
"""The verdicts that are kept; *undecided* may be another with more time, or tomorrow."""
WRITES_EVERY_S = 2.0
SETTLED_NS = 2_000_000_000
"""A source that was written so shortly before may be run by bytecode of what it was."""


class Entry(NamedTuple):
    """Something kept: by which key, and what."""

    key: str
    content: Mapping[str, Any]


@dataclass(frozen=True)
class Laid:
    """An obligation laid out: the hash of its text, what holds of the symbols in it; empty if nothing is asked."""

    digest: str
    axioms: list[str]
    is_empty: bool


class Answered(TypedDict):
    """What came of a question; ``kept``: when it was asked, where it is kept from an earlier run."""

    verdict: Verdict
    rlimit_spent: int
    seconds: float
    kept: NotRequired[str]


def sealed(key: str, content: str) -> str:
    """The digest that an entry carries."""
    return hashlib.sha256(f"{key}\0{content}".encode()).hexdigest()


def answer_key(digest: str, solver: str, seed: int) -> str:
    """What an answer is kept by; ``digest``: of the text that was asked."""
    return f"answer {digest} {_asking(solver, BUDGET[solver])} seed {seed}"


def answered(laid: Laid, asked: Iterable[Asked], there: Mapping[str, Any]) -> dict[Asked, Answered]:
    """Give the answers to a text that are there; where nothing is asked there is nothing to keep."""
    if laid.is_empty:
        return {by: {"verdict": "proved", "rlimit_spent": 0, "seconds": 0.0} for by in asked}
    keys = {by: answer_key(laid.digest, *by) for by in asked}
    return {by: there[key] for by, key in keys.items() if key in there}


NO_STORE = frozenset((sqlite3.SQLITE_CORRUPT, sqlite3.SQLITE_NOTADB, sqlite3.SQLITE_CANTOPEN))
"""What SQLite says of a file that is none of its own."""


@cache
def _asking(solver: str, budget: int) -> str:
    package = {"z3": "z3-solver"}.get(solver, solver)
    sources = [Path(__file__).with_name(name).read_bytes() for name in ASKING]
    asking = hashlib.sha256(b"\0".join(sources)).hexdigest()
    return f"{solver} {version(solver)} {solvers_hashed()[package]} budget {budget} by {asking}"


class KeptProofs:
    """The answers in a file.

    ``altered``: keys of entries that are not as they were kept; they count as not kept.

    :raises BadInput: it is no such file, or cannot be opened.
    :raises OSError: it cannot be read or written.
    """

    def __init__(self, path: Path) -> None:
        self.path = path
        self.altered: list[str] = []
        try:
            self._db = sqlite3.connect(path, timeout=WAITS_S, isolation_level=None)
            mine, tables = (
                self._db.execute(question).fetchone()[0]
                for question in ("PRAGMA application_id", "SELECT COUNT(*) FROM sqlite_master")
            )
            if tables and mine != APPLICATION:
                raise self._bad("is a database of something else")
            if not tables:
                self._db.execute("PRAGMA journal_mode = WAL")
                self._db.executescript(SCHEMA)
            self._db.execute("PRAGMA synchronous = NORMAL")
        except sqlite3.Error as error:
            raise self._failed("cannot be used", error) from error

    def _failed(self, what: str, error: sqlite3.Error) -> BadInput | OSError:
        """What SQLite says: of a file that is none of ours it is bad input, else it could not be read or written."""
        said = f"{what} ({error})"
        if getattr(error, "sqlite_errorcode", 0) & 0xFF in NO_STORE:
            return self._bad(said)
        return OSError(errno.EIO, said, str(self.path))

    def _bad(self, what: str) -> BadInput:
        return BadInput(str(self.path), "the file", what, "name another, or delete it: it only saves time")

    def find(self, keys: Sequence[str]) -> dict[str, Mapping[str, Any]]:
        """Find what is kept by these keys, as it was kept."""
        found = {}
        for start in range(0, len(keys), 500):
            some = keys[start : start + 500]
            question = f"SELECT key, content, digest FROM kept WHERE key IN ({', '.join('?' * len(some))})"
            try:
                rows = self._db.execute(question, some).fetchall()
            except sqlite3.Error as error:
                raise self._failed("cannot be read", error) from error
            for key, content, digest in rows:
                if digest == sealed(key, content):
                    found[key] = json.loads(content)
                elif key not in self.altered:
                    self.altered.append(key)
        return found

    def answers(self, laid: Laid, asked: Iterable[Asked]) -> dict[Asked, Answered]:
        """Give the answers to a text that are kept."""
        asked = list(asked)
        return answered(laid, asked, self.find([answer_key(laid.digest, *by) for by in asked]))

    def keep(self, entries: Iterable[Entry]) -> None:
        """Keep these, all of them or none; in the place of what was kept by their keys.

        Raises:
            OSError: they cannot be written.
        """
        texts = [(entry.key, json.dumps(entry.content, sort_keys=True)) for entry in entries]
        self._write(
            "INSERT OR REPLACE INTO kept VALUES (?, ?, ?)", [(key, text, sealed(key, text)) for key, text in texts]
        )

    def forget(self, keys: Iterable[str]) -> None:
        """Take out what is kept by these keys.

        Raises:
            OSError: it cannot be done.
        """
        self._write("DELETE FROM kept WHERE key = ?", [(key,) for key in keys])

    def _write(self, what: str, rows: Sequence[Sequence[str]]) -> None:
        try:
            with self._db:
                self._db.execute("BEGIN IMMEDIATE")
                self._db.executemany(what, rows)
        except sqlite3.Error as error:
            raise OSError(errno.EIO, f"nothing more is kept ({error})", str(self.path)) from error


@cache
def opened(path: Path) -> KeptProofs:
    """The answers in a file, opened once in this process."""
    return KeptProofs(path)


class Keeping:
    """One run that takes what is kept, and keeps what it finds.

    ``said``: what went wrong with the file, a line each; nothing that was computed is lost by it.
    """

    def __init__(self, path: Path, asked: Sequence[Asked]) -> None:
        self._asked, self._store = asked, opened(path)
        self._sources, self._began_ns = sources.stamps(), time.time_ns()
        self._made_of: dict[Cell, str] = {}
        self._waiting: list[Entry] = []
        self._written: list[str] = []
        self._next_s = 0.0
        self._is_lost = False
        self.said: list[str] = []

    def known(self, cells: Sequence[Cell]) -> dict[Cell, tuple[Laid, dict[Asked, Answered]]]:
        """Give those whose text is known and of which every answer is kept; nothing is laid out."""
        self._made_of = self._keys(cells)
        texts = self._store.find(list(self._made_of.values()))
        laid = {cell: Laid(**texts[key]) for cell, key in self._made_of.items() if key in texts}
        keys = [answer_key(of.digest, *by) for of in laid.values() if not of.is_empty for by in self._asked]
        there = self._store.find(keys)
        answers = {cell: answered(of, self._asked, there) for cell, of in laid.items()}
        self._tell_altered(self._store.altered)
        return {cell: (laid[cell], of) for cell, of in answers.items() if len(of) == len(self._asked)}

    def _keys(self, cells: Sequence[Cell]) -> dict[Cell, str]:
        """What is to be known of each text is kept by; of sources that have not changed since, as it was reckoned."""
        every = f"keys {contents.whole()}"
        keys = {tuple(place.split(" ")): key for place, key in self._store.find([every]).get(every, {}).items()}
        lacking = [cell for cell in cells if cell not in keys]
        keys |= {cell: contents.key_of(*cell) for cell in lacking}
        if lacking:
            self._waiting.append(Entry(every, {" ".join(cell): key for cell, key in keys.items()}))
        return {cell: f"text {keys[cell]}" for cell in cells if keys[cell] is not None}

    def once(self, what: str, reckon: Callable[[], list[str]]) -> list[str]:
        """What follows of the sources as a whole, reckoned once for each of them."""
        key = f"{what} {contents.whole()}"
        found = self._store.find([key]).get(key)
        if found is None:
            found = {"found": reckon()}
            self._waiting.append(Entry(key, found))
        return list(found["found"])

    def keep(self, obligations: Iterable[Obligation], seen: Iterable[CanarySeen], altered: Iterable[str]) -> None:
        """Keep what was answered, unless a canary was missed: then nothing of this run stays."""
        self._tell_altered(altered)
        if not all(each["noticed"] for each in seen):
            self._leave(lambda: self._store.forget(self._written))
            self._is_lost = True
        for each in obligations:
            self._waiting += self._entries(each)
        if time.monotonic() >= self._next_s:
            self.write()

    def _entries(self, told: Obligation) -> Iterator[Entry]:
        made_of = self._made_of.get((told["transition"], told["invariant"]))
        is_empty = "note" in told
        if made_of is not None:
            yield Entry(made_of, asdict(Laid(told["smt2_sha256"], told["axioms"], is_empty)))
        if told["verdict"] in KEPT and "kept" not in told and not is_empty:
            answer: Answered = {
                "verdict": told["verdict"],
                "rlimit_spent": told["rlimit_spent"],
                "seconds": told["seconds"],
                "kept": datetime.now(UTC).isoformat(timespec="seconds"),
            }
            yield Entry(answer_key(told["smt2_sha256"], told["solver"], told["seed"]), answer)

    def write(self) -> None:
        """Write what waits, of texts nothing if a source has changed since the run began, or just before.

        They may be of either; and Python knows bytecode by the second in which its source was written.
        """
        youngest_ns = max(at_ns for at_ns, *_ in self._sources.values())
        if sources.stamps() != self._sources or youngest_ns > self._began_ns - SETTLED_NS:
            self._made_of = {}
            self._waiting = [each for each in self._waiting if each.key.startswith("answer ")]
        waiting, self._waiting = self._waiting, []
        self._leave(lambda: self._store.keep(waiting))
        self._written += [each.key for each in waiting]
        self._next_s = time.monotonic() + WRITES_EVERY_S

    def _leave(self, change: Callable[[], None]) -> None:
        """Change the file, unless that has failed before, or this run is not to be believed."""
        try:
            if not self._is_lost:
                change()
        except OSError as error:
            self._is_lost = True
            self.said.append(f"{error.filename}: {error.strerror}")

    def _tell_altered(self, keys: Iterable[str]) -> None:
        for key in keys:
            line = f"{self._store.path}: {key.partition(' seed ')[0][:80]}: is not as it was kept; it is asked anew"
            if line not in self.said:
                self.said.append(line)
