"""Batches of days kept as they finish: a campaign that is broken off goes on where it stood.

A line of JSON each; the first says whose days they are, and by which code.  A last line that is not whole was
being written when the power went: its days are simulated again.  Each line has a digest, so that one that was altered
is noticed; whoever writes a digest too is not, so that it is told how many days were taken from here.
"""

from __future__ import annotations

import hashlib
import json
import os
import sys
from importlib.metadata import version
from pathlib import Path

import numpy as np

import kernel
import models
from models.days.system import Numbers, System
from models.layouts.results import BadInput


class KeptDays:
    """The days in a file.

    :raises BadInput: it holds other days than those asked for, or those of other code, or cannot be read.
    """

    def __init__(self, path: Path, system: System, seed: int) -> None:
        self._path = path
        self._head = {"system": system.name, "seed": seed, "columns": list(system.columns), "code": code()}
        self._rows: dict[int, list[int]] = {}
        if path.exists():
            self._read()
        else:
            self._append(self._head)

    def _read(self) -> None:
        try:
            text = self._path.read_text("utf-8")
        except (OSError, UnicodeDecodeError) as error:
            raise self._bad("the file", f"cannot be read ({error})", "name another") from error
        whole = text[: text.rfind("\n") + 1]
        for number, line in enumerate(whole.splitlines(), 1):
            try:
                found = json.loads(line)
            except json.JSONDecodeError as error:
                raise self._bad(f"line {number}", f"is not JSON ({error})", "name another file") from error
            if number == 1:
                self._is_ours(found)
                continue
            first, rows = self._rows_of(number, found)
            self._rows |= {first + offset: row for offset, row in enumerate(rows)}
        if not whole:
            raise self._bad("the file", "holds no days", "name another, or one that is not there yet")
        if whole != text:
            os.truncate(self._path, len(whole.encode()))

    def _rows_of(self, number: int, found: object) -> tuple[int, list[list[int]]]:
        if isinstance(found, dict) and found.get("digest") == self._sealed(found.get("first"), found.get("rows")):
            return found["first"], found["rows"]
        raise self._bad(f"line {number}", "is not as it was kept", "name another file: these days are no evidence")

    def _sealed(self, first: object, rows: object) -> str:
        """A digest of whose days these are, and of what came of them."""
        return hashlib.sha256(json.dumps([self._head, first, rows], sort_keys=True).encode()).hexdigest()

    def _is_ours(self, head: object) -> None:
        for key, ours in self._head.items():
            theirs = head.get(key) if isinstance(head, dict) else None
            if theirs != ours:
                says = "other code" if key in ("columns", "code") else f"{key} {theirs}, not {ours}"
                raise self._bad("line 1", f"these days are by {says}", "name another file")

    def _bad(self, place: str, what: str, what_to_do: str) -> BadInput:
        return BadInput(str(self._path), place, what, what_to_do)

    def _append(self, line: object) -> None:
        with self._path.open("a", encoding="utf-8") as kept:
            kept.write(json.dumps(line) + "\n")
            kept.flush()
            os.fsync(kept.fileno())

    def before(self, days: int) -> int:
        """How many of so many days the file held when it was read."""
        return sum(day < days for day in self._rows)

    def rows(self, days: range) -> Numbers | None:
        """The rows of some days, None unless each of them is kept."""
        if any(day not in self._rows for day in days):
            return None
        return np.array([self._rows[day] for day in days], np.int64)

    def keep(self, days: range, rows: Numbers) -> None:
        """Keep the rows of some days; when it returns they are on the disk."""
        told = rows.tolist()
        self._append({"first": days.start, "rows": told, "digest": self._sealed(days.start, told)})


def code() -> str:
    """What the days are simulated by: the hash of every source of the kernel and the models, with what they run on."""
    runs_on = [sys.version, *(f"{name} {version(name)}" for name in ("numpy", "numba", "llvmlite"))]
    digest = hashlib.sha256("\n".join(runs_on).encode())
    for package in (kernel, models):
        root = Path(package.__path__[0])
        for source in sorted(each for kind in ("*.py", "*.toml") for each in root.rglob(kind)):
            digest.update(f"{source.relative_to(root.parent)}\n".encode() + source.read_bytes())
    return digest.hexdigest()
