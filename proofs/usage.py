"""Which proof uses what: read off the proof scripts, never written by hand."""

from __future__ import annotations

from collections.abc import Callable, Collection, Iterator, Mapping, Sequence

from proofs import scripts
from proofs.catalogue import INTERLOCKING
from proofs.theories import columns, row_of, theory_of
from proofs.theory import EVERY_LOOKUP_IS_DEFINED, READING, Theory

Cell = tuple[str, str]
"""An obligation by its row and column."""

Book = Mapping[Cell, Sequence[str]]
"""The names of the hypotheses of every obligation."""


def cells(theory: Theory = INTERLOCKING) -> Iterator[Cell]:
    """Give every obligation of a theory's matrix, in order."""
    for row in theory.rows:
        for column in columns(row_of(theory, row)):
            yield row_of(theory, row), column


def book(theory: Theory = INTERLOCKING) -> Book:
    """Give the hypotheses of every obligation of a theory, as the scripts have them."""
    return {(row, column): scripts.hypotheses(row, column) for row, column in cells(theory)}


def is_reading(row: str) -> bool:
    """Tell whether a row is the reading of predicates, which is no proof from them."""
    return theory_of(row)[1] == READING


def users(found: Book) -> Mapping[str, list[Cell]]:
    """Give, for each name, the obligations of other columns that name it as a hypothesis."""
    using: dict[str, list[Cell]] = {}
    for (row, column), names in found.items():
        for name in names:
            if name != column:
                using.setdefault(name, []).append((row, column))
    return using


def needed(found: Book, claimed: Collection[str] = INTERLOCKING.claimed) -> frozenset[str]:
    """Give every name that a claim of the safety case, or a lookup in a transition, rests on at last.

    A lemma that only serves a lemma that serves nothing is not needed; nor is one that is only
    read to make sense of itself.
    """
    below: dict[str, set[str]] = {}
    for (row, column), names in found.items():
        if not is_reading(row):
            below.setdefault(column, set()).update(names)
    reached: set[str] = set()
    todo = [*claimed, EVERY_LOOKUP_IS_DEFINED]
    while todo:
        name = todo.pop()
        if name not in reached:
            reached.add(name)
            todo.extend(below.get(name, ()))
    return frozenset(reached)


def claims(theory: Theory = INTERLOCKING) -> Mapping[str, Callable[..., bool]]:
    """Give every claim about a state: invariants, what holds at the start, and what is promised."""
    return {**theory.initial, **theory.invariants, **{name: each.goal for name, each in theory.promises.items()}}
