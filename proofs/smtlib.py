"""The SMT-LIB text of one solver call: the same for every solver, and the same on every run."""

from __future__ import annotations

import re
from collections.abc import Iterable, Mapping
from dataclasses import dataclass
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
                    self.sorts |= _declared(term.var_sort(index))
                todo.append(term.body())
            elif z3.is_app(term):
                needed = _needed(term.decl())
                self.functions |= needed.functions
                self.sorts |= needed.sorts
                todo.extend(term.children())

    @cached_property
    def body(self) -> str:
        """The formula, its running numbers counted from its own beginning."""
        numbers: dict[str, str] = {}

        def renumber(found: re.Match[str]) -> str:
            return numbers.setdefault(found.group(0), f"{found.group(1)}!{len(numbers)}")

        return FRESH.sub(renumber, " ".join(self.formula.sexpr().split()))


_TEXTS: dict[int, Text] = {}


@dataclass(frozen=True)
class Needed:
    """What a function needs declared; the function is kept, so that its number stays its own."""

    function: Any
    functions: Mapping[str, str]
    sorts: Mapping[str, str]


_NEEDED: dict[int, Needed] = {}


def _needed(function: Any) -> Needed:
    """Give what a function needs declared, read once: the same few stand in every formula."""
    key = function.get_id()
    if key not in _NEEDED:
        domain = [function.domain(i) for i in range(function.arity())]
        sorts: dict[str, str] = {}
        for sort in [*domain, function.range()]:
            sorts |= _declared(sort)
        functions = {}
        if function.kind() == z3.Z3_OP_UNINTERPRETED:
            takes = " ".join(sort.sexpr() for sort in domain)
            functions[function.name()] = f"(declare-fun {symbol(function.name())} ({takes}) {function.range()})"
        _NEEDED[key] = Needed(function, functions, sorts)
    return _NEEDED[key]


def _declared(sort: Any) -> dict[str, str]:
    """Give the declaration of a sort, if it needs one."""
    if sort.kind() == z3.Z3_UNINTERPRETED_SORT:
        return {sort.name(): f"(declare-sort {sort.sexpr()} 0)"}
    if sort.kind() == z3.Z3_DATATYPE_SORT:
        members = " ".join(f"({sort.constructor(i).name()})" for i in range(sort.num_constructors()))
        return {sort.name(): f"(declare-datatypes (({sort.sexpr()} 0)) (({members})))"}
    return {}


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
