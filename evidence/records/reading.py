"""Reads the records that commands left in a folder; what is missing is told as missing."""

from __future__ import annotations

import hashlib
import re
from collections.abc import Mapping, Set
from dataclasses import dataclass, field
from functools import cached_property
from pathlib import Path
from typing import Any

from lxml import etree

from evidence.records.strict import NotStrict, content_of, parsed, tree

ABOUT = "heisoku.about"
"""The name of the property of a JUnit file that says how it was made."""
HEADING = f"# {ABOUT} "
"""What stands before the same in the first line of CrossHair's."""
TOLD = re.compile(r"(?P<place>.+?:\d+): (?P<kind>info|warning|error): (?P<says>.*)")
"""A line of CrossHair's."""
CONFIRMED, NOT_CONFIRMED = "Confirmed over all paths.", "Not confirmed."
Cell = tuple[str, str]
"""An obligation by its row and column."""


@dataclass(frozen=True)
class Answer:
    """One test, or one contract: its name, and whether it passed, failed or was skipped."""

    name: str
    came_to: str


@dataclass(frozen=True)
class Kept:
    """One record.

    ``data``: what stands in it, of a JSON record; ``answers``: of one that lists tests or contracts, and
    ``said`` how it was made.  ``problem``: why it cannot be used, or nothing; ``unfit``: something
    stands there under its name that no command wrote.
    """

    name: str
    data: Mapping[str, Any] = field(default_factory=dict)
    answers: tuple[Answer, ...] = ()
    said: Mapping[str, Any] = field(default_factory=dict)
    problem: str = ""
    sha256: str = ""
    unfit: bool = False

    @cached_property
    def cells(self) -> Mapping[Cell, Mapping[str, Set[str]]]:
        """What each solver said of each obligation, by row and column; of a record of proofs."""
        found: dict[Cell, dict[str, set[str]]] = {}
        for each in self.data["obligations"]:
            by_solver = found.setdefault((each["transition"], each["invariant"]), {})
            by_solver.setdefault(each["solver"], set()).add(each["verdict"])
        return found

    @cached_property
    def from_earlier(self) -> Set[Cell]:
        """The obligations with an answer for which nobody was asked in the run that the record is of."""
        return {(each["transition"], each["invariant"]) for each in self.data["obligations"] if "kept" in each}

    @property
    def commit(self) -> str | None:
        """The commit that it says it is of."""
        told = self.about.get("commit")
        return told if isinstance(told, str) else None

    @property
    def about(self) -> Mapping[str, Any]:
        """What it says of how it was made; a campaign says it of each of its starts, of which the last counts."""
        if self.said:
            return self.said
        starts = self.data.get("starts")
        last = starts[-1] if isinstance(starts, list) and starts else self.data
        return last if isinstance(last, Mapping) else {}

    @property
    def versions(self) -> Mapping[str, str]:
        """The versions that it says it was made with."""
        told = self.about.get("versions")
        return {str(name): str(value) for name, value in told.items()} if isinstance(told, Mapping) else {}


Records = Mapping[str, Kept]
"""Records by the names of their files."""


def read(folder: Path, names: frozenset[str]) -> Records:
    """Read these records of a folder."""
    return {name: _kept(folder / name) for name in sorted(names)}


def _kept(path: Path) -> Kept:
    try:
        content = content_of(path)
    except NotStrict as error:
        return Kept(path.name, problem=str(error), unfit=True)
    except FileNotFoundError:
        return Kept(path.name, problem="there is no such record")
    except OSError as error:
        return Kept(path.name, problem=f"it cannot be read: {error.strerror}")
    digest = hashlib.sha256(content).hexdigest()
    try:
        if path.suffix == ".json":
            data = parsed(content)
            if not isinstance(data, dict):
                return Kept(path.name, problem="it is no record: no object at its top", sha256=digest, unfit=True)
            return Kept(path.name, data=data, sha256=digest)
        if path.suffix == ".xml":
            answers, said = _tests(content), _properties(content)
        else:
            answers, said = _contracts(content.decode()), heading(content.decode())
    except (ValueError, etree.XMLSyntaxError) as error:
        line = str(error).splitlines()[0] if str(error) else type(error).__name__
        return Kept(path.name, problem=f"it cannot be read: {line}", sha256=digest, unfit=True)
    return Kept(path.name, answers=tuple(answers), said=said, sha256=digest)


def _tests(content: bytes) -> list[Answer]:
    """Every test of a JUnit file."""
    return [
        Answer(f"{case.get('classname', '')}::{case.get('name', '')}", _came_to(case))
        for case in _named(tree(content), "testcase")
    ]


def _properties(content: bytes) -> Mapping[str, Any]:
    """What a JUnit file says of how it was made, in a property of its suite."""
    for each in _named(tree(content), "property"):
        if each.get("name") == ABOUT:
            return _object(each.get("value", ""))
    return {}


def heading(text: str) -> Mapping[str, Any]:
    """The same of CrossHair's lines, in the first of them."""
    first = text.split("\n", 1)[0]
    return _object(first.removeprefix(HEADING)) if first.startswith(HEADING) else {}


def _object(text: str) -> Mapping[str, Any]:
    found = parsed(text)
    return found if isinstance(found, dict) else {}


def _came_to(case: etree._Element) -> str:
    if _named(case, "failure") or _named(case, "error"):
        return "failed"
    return "skipped" if _named(case, "skipped") else "passed"


def _named(within: etree._Element, name: str) -> list[etree._Element]:
    """All elements of a name, in whatever namespace."""
    return [each for each in within.iter(etree.Element) if etree.QName(each).localname == name]


def _contracts(text: str) -> list[Answer]:
    """Every condition that CrossHair tells of: one line each; a line of another form shows nothing, by its text."""
    found = []
    for number, line in enumerate(text.splitlines()):
        if not line.strip() or (number == 0 and line.startswith(HEADING)):
            continue
        told = TOLD.fullmatch(line)
        if told is None or (told["kind"] == "info" and told["says"] not in (CONFIRMED, NOT_CONFIRMED)):
            found.append(Answer(line, "skipped"))
        elif told["kind"] == "error":
            found.append(Answer(told["place"], "failed"))
        else:
            found.append(Answer(told["place"], "passed" if told["says"] == CONFIRMED else "skipped"))
    return found
