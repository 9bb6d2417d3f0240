"""A finite scope without functions of logic: one constant for every choice of arguments.

What is left are truth values and enumerations, which a SAT solver takes as they are.
"""

from __future__ import annotations

from itertools import product
from typing import Any

import z3

from proofs.lift import FiniteScope
from proofs.lift.components import Function, Keys
from proofs.lift.kinds import Scalar
from proofs.lift.terms import Term, address, equal_terms, is_constant, ite_

Marks = tuple[Any, ...]


class GridScope(FiniteScope):
    """Each function of logic is a table of constants; looking it up at a term is a choice among them."""

    def declare(self, path: str, keys: Keys, result: Scalar) -> Function:
        """Return the table of this name and these sorts."""
        place = (path, keys, result)
        if keys and place not in self._functions:
            choices = [tuple(self.values(key) or ()) for key in keys]
            self._functions[place] = Table(path, choices, self.sort(result)).look_up
        return super().declare(path, keys, result)


class Table:
    """A function of logic, written out."""

    def __init__(self, path: str, choices: list[tuple[Term, ...]], result: Any) -> None:
        self._choices = choices
        self._cells = {
            tuple(map(_mark, terms)): z3.Const(f"{path}[{', '.join(map(str, terms))}]", result)
            for terms in product(*choices)
        }
        self._known: dict[Marks, tuple[tuple[Term, ...], Term]] = {}

    def look_up(self, *terms: Term) -> Term:
        """The value at these terms; what was asked before is remembered, and kept alive with its terms."""
        marks = tuple(map(_mark, terms))
        if marks in self._cells:
            return self._cells[marks]
        if marks not in self._known:
            self._known[marks] = (terms, self._choice((), terms))
        return self._known[marks][1]

    def _choice(self, met: Marks, terms: tuple[Term, ...]) -> Term:
        """Choose among the cells by the terms that are not known values."""
        if not terms:
            return self._cells[met]
        first, rest = terms[0], terms[1:]
        if is_constant(first):
            return self._choice((*met, _mark(first)), rest)
        found: Term = None
        for value in reversed(self._choices[len(met)]):
            here = self._choice((*met, _mark(value)), rest)
            found = here if found is None else ite_(equal_terms(first, value), here, found)
        return found


def _mark(term: Term) -> Any:
    return term if isinstance(term, bool) else address(term)
