"""The safety case as data: hazards, claims, duties and limits, read from the tables of SAFETY_CASE.md."""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path

from models.shipped import shipped

CASE = shipped("SAFETY_CASE.md")
NAMED = re.compile(r"`([^`]+)`")
NUMBERED = re.compile(r"\b[CHL]\d+\b")
LABEL = re.compile(r"\b[TPXGA]\d+\b")
NOTHING = "–"


class CaseError(ValueError):
    """The safety case does not say what its tables should; with the line."""


@dataclass(frozen=True)
class Hazard:
    """What may happen to people; ``claims``: those that keep it from coming of the kernel."""

    number: str
    text: str
    causes: str
    requirements: tuple[str, ...]
    claims: tuple[str, ...]


@dataclass(frozen=True)
class Claim:
    """What is claimed; it rests on other ``claims``, or on ``evidence``, by ids of the catalogue, or on both.

    ``defeaters``: what would make the claim false though its evidence stands, and what is done about that.
    """

    number: str
    text: str
    requirements: tuple[str, ...]
    claims: tuple[str, ...]
    evidence: tuple[str, ...]
    defeaters: str


@dataclass(frozen=True)
class Duty:
    """Assumptions that one duty keeps true; ``rate``: how often a breach is tolerable, and ``why``."""

    group: str
    assumptions: tuple[str, ...]
    rate: str
    why: str


@dataclass(frozen=True)
class Limit:
    """What is known not to be shown."""

    number: str
    text: str


@dataclass(frozen=True)
class Case:
    """The whole safety case."""

    hazards: tuple[Hazard, ...]
    claims: tuple[Claim, ...]
    duties: tuple[Duty, ...]
    limits: tuple[Limit, ...]


def read_case(path: Path = CASE) -> Case:
    """Read the safety case.

    Raises:
        CaseError: a table is missing, or a row of one has not its columns.
    """
    tables = dict(_tables(path.read_text("utf-8").splitlines()))
    return Case(
        tuple(
            Hazard(number, text, causes, tuple(LABEL.findall(labels)), tuple(NUMBERED.findall(claims)))
            for number, text, causes, labels, claims in _rows(tables, "Hazard log", 5)
        ),
        tuple(
            Claim(
                number,
                text,
                tuple(LABEL.findall(labels)),
                tuple(NUMBERED.findall(rests)),
                tuple(NAMED.findall(rests)),
                defeaters,
            )
            for number, text, labels, rests, defeaters in _rows(tables, "Claims", 5)
        ),
        tuple(
            Duty(group, tuple(NAMED.findall(names)), rate, why)
            for group, names, rate, why in _rows(tables, "Assumptions", 4)
        ),
        tuple(Limit(number, text) for number, text in _rows(tables, "Open points", 2)),
    )


def _rows(tables: Mapping[str, Sequence[tuple[int, list[str]]]], heading: str, columns: int) -> Iterator[list[str]]:
    if heading not in tables:
        raise CaseError(f"there is no table under the heading {heading!r}")
    for line, cells in tables[heading]:
        if len(cells) != columns:
            raise CaseError(f"line {line}: {len(cells)} columns, and the table under {heading!r} has {columns}")
        yield cells


def _tables(lines: Sequence[str]) -> Iterator[tuple[str, list[tuple[int, list[str]]]]]:
    """Give the rows of the table under each heading, without its own heading."""
    heading = ""
    rows: list[tuple[int, list[str]]] = []
    for line, text in enumerate([*lines, "# "], 1):
        if text.startswith("#"):
            if rows:
                yield heading, rows[2:]
            heading, rows = text.lstrip("# ").split(". ", 1)[-1].strip(), []
        elif text.startswith("|"):
            rows.append((line, [cell.strip() for cell in text.strip().strip("|").split("|")]))
