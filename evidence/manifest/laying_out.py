"""Every obligation laid out anew from the sources: its text's hash, and all that a record says of it but the answer."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass

from models.processes import spread
from proofs import run, scripts
from proofs.theories import ROWS, columns

Cell = tuple[str, str]
AT_ONCE = 20


@dataclass(frozen=True)
class LaidOut:
    """One obligation: the hash of its text, what is assumed in it, where its claim stands; ``parts``: so many."""

    digest: str
    hypotheses: list[str]
    axioms: list[str]
    source: tuple[str, int, int]
    parts: int


def cells() -> list[Cell]:
    """Every obligation there is, by row and column."""
    return [(row, column) for row in ROWS for column in columns(row)]


def laid_out(some: list[Cell]) -> dict[Cell, LaidOut]:
    """Lay a few out."""
    found = {}
    for row, column in some:
        asked, place = run.parts(row, column), run.source(row, column)
        found[row, column] = LaidOut(
            run.digest_of(asked),
            scripts.hypotheses(row, column),
            run.axioms_of(row, column, asked),
            (place["file"], *place["lines"]),
            len(asked),
        )
    return found


def all_laid_out(
    jobs: int, progress: Callable[[int, int, str], object] = lambda done, total, what: None
) -> Mapping[Cell, LaidOut]:
    """Lay all of them out, on so many processes; no solver is asked."""
    todo = []
    for row in ROWS:
        of_row = [(row, column) for column in columns(row)]
        todo += [of_row[start : start + AT_ONCE] for start in range(0, len(of_row), AT_ONCE)]
    found: dict[Cell, LaidOut] = {}
    for done, some in enumerate(spread(laid_out, todo, jobs), 1):
        found |= some
        progress(done, len(todo), todo[done - 1][0][0])
    return found
