"""A finite scope without functions of logic: one constant for every choice of arguments.

What is left are truth values and enumerations, which a SAT solver takes as they are.
"""

from __future__ import annotations

from collections.abc import Callable
from itertools import product
from typing import Any

import z3

from proofs.lift import FiniteScope
from proofs.lift.components import Function
from proofs.lift.terms import Term, and_, equal_terms, is_constant, ite_, same, to_z3


class GridScope(FiniteScope):
    """Each function of logic is a table of constants; looking it up at a term is a choice among them."""

    def _declared(self, path: str, keys: list[Any], result: Any) -> Function:
        if not keys:
            constant = z3.Const(path, result)
            return lambda: constant
        choices = [self.values(self._scalars[str(key)]) or () for key in keys]
        table = {tuple(_mark(term) for term in terms): z3.Const(_cell(path, terms), result)
                 for terms in product(*choices)}
        return _lookup(table, choices)


def _cell(path: str, terms: tuple[Term, ...]) -> str:
    return f"{path}[{', '.join(str(term) for term in terms)}]"


def _mark(term: Term) -> Any:
    return term if isinstance(term, bool) else term.get_id()


def _lookup(table: dict[tuple[Any, ...], Any], choices: list[Any]) -> Callable[..., Term]:
    """Give the function that looks a table up, and remembers what it was asked."""
    known: dict[tuple[Any, ...], Term] = {}
    kept: list[Any] = []

    def at(marks: tuple[Any, ...], terms: tuple[Term, ...]) -> Term:
        if not terms:
            return table[marks]
        first, rest = terms[0], terms[1:]
        values = choices[len(marks)]
        if isinstance(first, bool) or is_constant(first):
            return at((*marks, _mark(first)), rest)
        found: Term = None
        for value in reversed(values):
            here = at((*marks, _mark(value)), rest)
            found = here if found is None else ite_(equal_terms(first, value), here, found)
        return found

    def look_up(*terms: Term) -> Term:
        key = tuple(_mark(term) for term in terms)
        if key not in known:
            known[key] = at((), terms)
            kept.append(terms)
        return known[key]

    return look_up
