"""Which proof uses what: read off the proof scripts, never written by hand."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence

from proofs import scripts
from proofs.catalogue import INITIAL, INTERLOCKING, INVARIANTS, SAFETY
from proofs.theories import columns
from proofs.theory import EVERY_LOOKUP_IS_DEFINED, READING

Cell = tuple[str, str]
"""An obligation by its row and column."""

Book = Mapping[Cell, Sequence[str]]
"""The names of the hypotheses of every obligation."""


def cells() -> Iterator[Cell]:
    """Give every obligation of the interlocking's matrix, in order."""
    for row in INTERLOCKING.rows:
        for column in columns(row):
            yield row, column


def book() -> Book:
    """Give the hypotheses of every obligation, as the scripts have them."""
    return {(row, column): scripts.hypotheses(row, column) for row, column in cells()}


def users(found: Book) -> Mapping[str, list[Cell]]:
    """Give, for each name, the obligations of other columns that name it as a hypothesis."""
    using: dict[str, list[Cell]] = {}
    for (row, column), names in found.items():
        for name in names:
            if name != column:
                using.setdefault(name, []).append((row, column))
    return using


def needed(found: Book) -> frozenset[str]:
    """Give every name that a claim of the safety case, or a lookup in a transition, rests on at last.

    A lemma that only serves a lemma that serves nothing is not needed; nor is one that is only
    read to make sense of itself.
    """
    below: dict[str, set[str]] = {}
    for (row, column), names in found.items():
        if row != READING:
            below.setdefault(column, set()).update(names)
    reached: set[str] = set()
    todo = [*SAFETY, EVERY_LOOKUP_IS_DEFINED]
    while todo:
        name = todo.pop()
        if name not in reached:
            reached.add(name)
            todo.extend(below.get(name, ()))
    return frozenset(reached)


def claims() -> Mapping[str, Callable[..., bool]]:
    """Give every claim about a state: invariants and what holds at the start."""
    return {**INITIAL, **INVARIANTS}
