"""The lifter: functions of the subset as formulas and values of logic."""

from __future__ import annotations

import ast
from collections.abc import Mapping
from typing import Any, NamedTuple

import z3

from proofs.lift.frames import Frame, Obligation, State
from proofs.lift.scopes import Scope
from proofs.lift.sources import Code
from proofs.lift.statements import lift_function, parameters
from proofs.lift.terms import and_, implies_, to_z3
from proofs.lift.trees import Tree, leaves, merge
from proofs.lift.values import Value


class Case(NamedTuple):
    """One way that a function comes out: the condition for it, and the result."""

    condition: Any
    value: Value


class Lifter:
    """Lifts functions into the logic of one scope.

    ``sources``: syntax trees that stand for functions' own (mutants).
    ``collect``: whether to collect well-definedness obligations.
    """

    def __init__(
        self, scope: Scope, sources: Mapping[Code, ast.FunctionDef] | None = None, collect: bool = False
    ) -> None:
        self.scope = scope
        self._state = State(scope, sources or {}, collect)

    @property
    def obligations(self) -> list[Obligation]:
        """The well-definedness obligations collected so far, each once."""
        return self._state.obligations

    @property
    def collect(self) -> bool:
        """Whether obligations are collected."""
        return self._state.collect

    @collect.setter
    def collect(self, collect: bool) -> None:
        self._state.collect = collect

    def tree(self, function: Code, *values: Value) -> Tree:
        """Lift a function applied to values, its cases kept apart."""
        names, keyword_only, defaults = parameters(self._state, function)
        frame = Frame(self._state, function)
        env = dict(zip((*names, *keyword_only), values, strict=False))
        env |= {name: frame.literal(value, frame.definition) for name, value in defaults.items() if name not in env}
        if len(values) > len(names) + len(keyword_only) or len(env) < len(names) + len(keyword_only):
            raise TypeError(f"{function.__name__} takes {(*names, *keyword_only)}")
        return lift_function(self._state, function, env)

    def call(self, function: Code, *values: Value) -> Value:
        """Return the value of a function applied to values."""
        return merge(self.tree(function, *values))

    def cases(self, function: Code, *values: Value) -> list[Case]:
        """Return the ways that a function comes out; an argument handed back is the same object."""
        return [Case(to_z3(and_(*tests)), value) for tests, value in self.paths(function, *values)]

    def paths(self, function: Code, *values: Value) -> list[tuple[tuple[Any, ...], Value]]:
        """Return the same, each with what is tested one after the other in the place of its condition."""
        return leaves(self.tree(function, *values))

    def formula(self, predicate: Code, *values: Value) -> Any:
        """Return a predicate applied to values as a Z3 Boolean."""
        definition = Frame(self._state, predicate).definition
        return to_z3(Frame(self._state, predicate).truth(self.call(predicate, *values), definition))


def conjuncts(formula: Any) -> list[Any]:
    """Split a formula into parts that hold together: through ``And``, ``ForAll`` and implication."""
    return [_closed(binders, guard, goal) for binders, guard, goal in _parts(formula)]


def _parts(formula: Any) -> list[tuple[list[Any], list[Any], Any]]:
    if z3.is_and(formula):
        return [part for child in formula.children() for part in _parts(child)]
    if z3.is_implies(formula):
        guard, goal = formula.children()
        return [(binders, [guard, *guards], inner) for binders, guards, inner in _parts(goal)]
    if z3.is_quantifier(formula) and formula.is_forall():
        count = formula.num_vars()
        constants = [z3.FreshConst(formula.var_sort(i), formula.var_name(i).split("!")[0]) for i in range(count)]
        body = z3.substitute_vars(formula.body(), *reversed(constants))
        return [([*constants, *binders], guards, goal) for binders, guards, goal in _parts(body)]
    return [([], [], formula)]


def _closed(binders: list[Any], guards: list[Any], goal: Any) -> Any:
    body = to_z3(implies_(and_(*guards), goal))
    used = _constants(body) if binders else frozenset[int]()
    kept = [binder for binder in binders if binder.get_id() in used]
    return z3.ForAll(kept, body) if kept else body


def _constants(formula: Any) -> frozenset[int]:
    """Return the ids of the constants in a formula."""
    seen: set[int] = set()
    found: set[int] = set()
    open_ = [formula]
    while open_:
        term = open_.pop()
        if term.get_id() in seen:
            continue
        seen.add(term.get_id())
        if z3.is_quantifier(term):
            open_.append(term.body())
        elif z3.is_const(term):
            found.add(term.get_id())
        else:
            open_.extend(term.children())
    return frozenset(found)


__all__ = ["Case", "Lifter", "conjuncts"]
