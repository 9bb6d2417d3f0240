"""What each proof rests on: ``python -m proofs.cores [--only PATTERN] [--json FILE]``.

Every hypothesis, guard and update of an obligation gets a name, and Z3 is asked for an unsat core.  A hypothesis is
named as in the proof scripts, a guard by its function and text, an update by the field that it defines.  A core is
asked again of itself and not thinned further: what is in none is not needed, what is in one may not be.
"""

from __future__ import annotations

import argparse
import ast
import re
import time
from collections.abc import Iterator, Mapping, Sequence
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path
from typing import Any, TypedDict
from unittest.mock import patch

import z3

from models.commands import progress
from models.exit_codes import HOLDS, UNDECIDED
from models.processes import spread
from proofs import scripts
from proofs.lift import expressions, statements
from proofs.lift.frames import Frame
from proofs.records import about, write_json
from proofs.run import bench
from proofs.search import NARROW, core
from proofs.theories import ROWS, is_transition, theory_of
from proofs.ways import Way
from proofs.workbench import Part

HYPOTHESIS, GUARD, UPDATE = "hypothesis", "guard", "update"
Named = Mapping[str, Sequence[Any]]


class Core(TypedDict):
    """What the proof of one obligation rests on; ``open``: so many of its parts gave no core within the budget."""

    transition: str
    invariant: str
    hypotheses: list[str]
    guards: list[str]
    updates: list[str]
    parts: int
    open: int


@dataclass(frozen=True)
class Row:
    """What one transition gives: its cores, and every guard and update there is, in a core or not."""

    transition: str
    cores: list[Core]
    guards: list[str]
    updates: list[str]
    unnamed: int


class Notes:
    """The conditions that were lifted, by term: the innermost text that it comes from, and where that stands."""

    def __init__(self) -> None:
        self.named: dict[int, str] = {}
        self.kept: list[Any] = []

    def note(self, term: Any, frame: Frame, node: ast.expr) -> None:
        """Keep the first text of a term, and of what it denies."""
        text = f"{frame.function.__module__}.{frame.function.__name__}: {ast.unparse(node)}"
        while isinstance(term, z3.ExprRef) and term.get_id() not in self.named:
            self.named[term.get_id()] = text
            self.kept.append(term)
            if z3.is_not(term):
                term = term.arg(0)

    def of(self, term: Any) -> str | None:
        """The text of a term, or of what it denies."""
        known = self.named.get(term.get_id())
        if known is None and z3.is_not(term):
            known = self.named.get(term.arg(0).get_id())
        return known


@contextmanager
def noting(notes: Notes) -> Iterator[None]:
    """While transitions are lifted, note every condition."""
    lift = expressions.condition

    def condition(frame: Frame, node: ast.expr, env: Any) -> Any:
        term = lift(frame, node, env)
        notes.note(term, frame, node)
        return term

    with patch.object(expressions, "condition", condition), patch.object(statements, "condition", condition):
        yield


def pieces(term: Any, notes: Notes, above: str | None = None) -> list[tuple[str | None, Any]]:
    """What must hold for a condition, one by one, each with its text: through ``and``, and the denial of ``or``.

    ``above``: the text of what it is a piece of, for one that has none of its own.
    """
    text = notes.of(term) or above
    if z3.is_and(term):
        return [piece for child in term.children() for piece in pieces(child, notes, text)]
    if z3.is_not(term) and z3.is_or(term.arg(0)):
        return [piece for child in term.arg(0).children() for piece in pieces(denied(child), notes, text)]
    return [(text, term)]


def denied(term: Any) -> Any:
    """The denial of a term, and not of a denial."""
    return term.arg(0) if z3.is_not(term) else z3.Not(term)


def guards_of(way: Way, notes: Notes, row: str) -> tuple[Named, int]:
    """The guards of one way by name, and how many have no text."""
    found: dict[str, list[Any]] = {}
    unnamed = 0
    for text, piece in pieces(way.condition, notes):
        unnamed += text is None
        found.setdefault(text or f"{row}: what is left of its condition", []).append(piece)
    return found, unnamed


def updates_of(way: Way) -> Named:
    """The updates of one way by the field that each defines; none where new values stand in place of fields."""
    found: dict[str, list[Any]] = {}
    for formula in way.definitions:
        found.setdefault(field_of(formula), []).append(formula)
    return found


def field_of(formula: Any) -> str:
    """The field of the state after that a definition speaks of."""
    named = re.search(r"\bpost[\w.]*?\.([\w.]+)", formula.sexpr())
    return named[1].split("!")[0] if named else "the state"


def core_of(row: str, column: str, notes: Notes) -> Core:
    """The core of one obligation: of all its parts together, and of each way by itself."""
    theory, name = theory_of(row)
    lifted = bench(theory.name)
    found: dict[str, dict[str, None]] = {HYPOTHESIS: {}, GUARD: {}, UPDATE: {}}
    chosen = lifted.chosen(name, scripts.hypotheses(row, column))
    apart = [(way, goal) for ways, goal in lifted.questions(name, column, chosen) for way in ways or (None,)]
    laid_out = lifted.asked(chosen, [([way.condition, *way.definitions] if way else [], goal) for way, goal in apart])
    missing = 0
    for part, (way, _) in zip(laid_out, apart, strict=True):
        guards, updates = (guards_of(way, notes, row)[0], updates_of(way)) if way else ({}, {})
        names = named_core(part, guards, updates)
        missing += names is None
        for each in names or ():
            kind, _, text = each.partition(" ")
            found[kind][text] = None
    hypotheses = [each for each in found[HYPOTHESIS] if each not in lifted.always()]
    told = {HYPOTHESIS: sorted(hypotheses), GUARD: sorted(found[GUARD]), UPDATE: sorted(found[UPDATE])}
    return {
        "transition": row,
        "invariant": column,
        "hypotheses": told[HYPOTHESIS],
        "guards": told[GUARD],
        "updates": told[UPDATE],
        "parts": len(laid_out),
        "open": missing,
    }


def named_core(part: Part, guards: Named, updates: Named) -> list[str] | None:
    """A core of one part, asked again of itself; None where Z3 does not refute it with everything named."""
    named = {f"{HYPOTHESIS} {name}": formulas for name, formulas in part.hypotheses.items()}
    named |= {f"{GUARD} {name}": formulas for name, formulas in guards.items()}
    named |= {f"{UPDATE} {name}": formulas for name, formulas in updates.items()}
    whole = Part(named, [], part.goal)
    names = core(whole, None, NARROW)
    return names if names is None else core(whole, names, NARROW) or names


def row_of_cores(task: tuple[str, tuple[str, ...]]) -> Row:
    """The cores of one transition."""
    row, chosen = task
    theory, name = theory_of(row)
    notes = Notes()
    with noting(notes):
        ways = bench(theory.name).ways(name)
    named = [guards_of(way, notes, row) for way in ways]
    guards = sorted({guard for found, _ in named for guard in found})
    updates = sorted({update for way in ways for update in updates_of(way)})
    return Row(row, [core_of(row, column, notes) for column in chosen], guards, updates, sum(n for _, n in named))


def found(only: str, jobs: int) -> list[Row]:
    """The cores of every obligation that a transition keeps an invariant, whose row and column match."""
    todo = []
    for row in filter(is_transition, ROWS):
        chosen = tuple(each for each in theory_of(row)[0].invariants if re.search(only, f"{row} {each}"))
        todo += [(row, chosen)] * bool(chosen)
    rows: list[Row] = []
    with progress("cores") as step:
        for each in spread(row_of_cores, todo, jobs):
            rows.append(each)
            step(len(rows), len(todo), each.transition)
    return rows


def main() -> int:
    """Find the cores, write them, and tell how many there are; 3 if a part gave none."""
    parser = argparse.ArgumentParser(prog="python -m proofs.cores", description=__doc__)
    parser.add_argument("--only", default="", metavar="PATTERN", help="a regular expression on row and column")
    parser.add_argument("--jobs", type=int, default=2, metavar="N", help="processes")
    parser.add_argument("--json", type=Path, metavar="FILE", help="write the record")
    given = parser.parse_args()
    began = time.perf_counter()
    rows = found(given.only, given.jobs)
    cores = [each for row in rows for each in row.cores]
    missing = sum(each["open"] for each in cores)
    if given.json:
        record = {
            "obligations": cores,
            "guards": {row.transition: row.guards for row in rows},
            "updates": {row.transition: row.updates for row in rows},
            "unnamed": sum(row.unnamed for row in rows),
            "minimal": False,
            "seconds": round(time.perf_counter() - began, 1),
            **about(),
        }
        write_json(given.json, record)
    parts = sum(each["parts"] for each in cores)
    guards = {guard for row in rows for guard in row.guards}
    used = {guard for each in cores for guard in each["guards"]}
    print(
        f"{len(cores)} obligations, {parts} parts, {missing} without a core; {len(used)} of {len(guards)} guards are in"
        f" some core; {sum(row.unnamed for row in rows)} pieces of conditions have no text"
    )
    return UNDECIDED if missing or not cores else HOLDS


if __name__ == "__main__":
    raise SystemExit(main())
