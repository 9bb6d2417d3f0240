"""The SMT-LIB text of one solver call: the same for every solver, and the same on every run."""

from __future__ import annotations

import re
from collections.abc import Iterable, Mapping
from functools import cached_property
from typing import TYPE_CHECKING, Any

import z3

if TYPE_CHECKING:
    from proofs.workbench import Part

FRESH = re.compile(r"(?<![\w.!])([A-Za-z_][\w.]*)((?:!\d+)+)")
"""A name that carries a running number: of a bound variable, or of a shared term."""


class Text:
    """A formula as text, with what it needs declared; made once and kept."""

    def __init__(self, formula: Any) -> None:
        """Walk the formula once and note its symbols and sorts."""
        self.formula = formula
        self.functions: dict[str, str] = {}
        self.sorts: dict[str, str] = {}
        seen: set[int] = set()
        todo = [formula]
        while todo:
            term = todo.pop()
            if term.get_id() in seen:
                continue
            seen.add(term.get_id())
            if z3.is_quantifier(term):
                for index in range(term.num_vars()):
                    self._sort(term.var_sort(index))
                todo.append(term.body())
            elif z3.is_app(term):
                self._declare(term.decl())
                todo.extend(term.children())

    def _declare(self, function: Any) -> None:
        for sort in [*(function.domain(i) for i in range(function.arity())), function.range()]:
            self._sort(sort)
        if function.kind() == z3.Z3_OP_UNINTERPRETED:
            domain = " ".join(function.domain(i).sexpr() for i in range(function.arity()))
            self.functions[function.name()] = f"(declare-fun {symbol(function.name())} ({domain}) {function.range()})"

    def _sort(self, sort: Any) -> None:
        if sort.kind() == z3.Z3_UNINTERPRETED_SORT:
            self.sorts[sort.name()] = f"(declare-sort {sort.sexpr()} 0)"
        elif sort.kind() == z3.Z3_DATATYPE_SORT:
            members = " ".join(f"({sort.constructor(i).name()})" for i in range(sort.num_constructors()))
            self.sorts[sort.name()] = f"(declare-datatypes (({sort.sexpr()} 0)) (({members})))"

    @cached_property
    def body(self) -> str:
        """The formula, its running numbers counted from its own beginning."""
        numbers: dict[str, str] = {}

        def renumber(found: re.Match[str]) -> str:
            return numbers.setdefault(found.group(0), f"{found.group(1)}!{len(numbers)}")

        return FRESH.sub(renumber, " ".join(self.formula.sexpr().split()))


_TEXTS: dict[int, Text] = {}


def text_of(formula: Any) -> Text:
    """Give the text of a formula, made at the first call."""
    key = formula.get_id()
    if key not in _TEXTS:
        _TEXTS[key] = Text(formula)
    return _TEXTS[key]


def symbols_of(*formulas: Any) -> frozenset[tuple[str, str]]:
    """Give the symbols that occur in formulas, each with its declaration."""
    return frozenset(symbol for formula in formulas for symbol in text_of(formula).functions.items())


def symbol(name: str) -> str:
    """Quote a name where SMT-LIB wants it."""
    return name if re.fullmatch(r"[\w.!]+", name) else f"|{name}|"


def script(part: Part) -> str:
    """Give the whole text of one solver call; unsatisfiable means proved."""
    named = {
        f"{name}.{number}": text_of(formula)
        for name, formulas in part.hypotheses.items()
        for number, formula in enumerate(formulas, 1)
    }
    given = [text_of(formula) for formula in part.given]
    goal = text_of(part.goal)
    everything = [*named.values(), *given, goal]
    return "\n".join(
        [
            "(set-logic ALL)",
            *_merged(text.sorts for text in everything),
            *_merged(text.functions for text in everything),
            *(f"(assert (! {named[name].body} :named {symbol(name)}))" for name in sorted(named)),
            *(f"(assert {text.body})" for text in given),
            f"(assert (not {goal.body}))",
            "(check-sat)",
            "",
        ]
    )


def _merged(declarations: Iterable[Mapping[str, str]]) -> list[str]:
    """Give each declaration once, sorted by name."""
    merged: dict[str, str] = {}
    for each in declarations:
        merged |= each
    return [merged[name] for name in sorted(merged)]
