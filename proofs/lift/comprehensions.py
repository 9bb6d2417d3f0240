"""Comprehensions and generators: the loops of the subset.

``each`` goes through the cases of the ``for`` and ``if`` clauses.  In an unbounded scope a
clause has one case, with bound constants; in a finite scope one for every choice of values.
"""

from __future__ import annotations

import ast
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from enum import Enum

from proofs.lift.expressions import condition, conjunction, construct, evaluate
from proofs.lift.frames import Env, Frame
from proofs.lift.kinds import Kind, TupleKind, scalars_of
from proofs.lift.terms import Term, Truth, and_, implies_, or_
from proofs.lift.values import (
    ABSENT,
    EMPTY_MAP,
    EMPTY_SET,
    Absent,
    Map,
    Set,
    Tuple,
    Value,
    equal_keys,
    flat,
    name_of,
    overlay,
    unflat,
)

Terms = tuple[Term, ...]
Given = Mapping[str, Terms]
"""Loop variables whose value is already determined by the element or key asked for."""


@dataclass(frozen=True)
class Case:
    """One case of the clauses: its binders, the condition for it to occur, the variables in it."""

    binders: list[Term]
    guard: Truth
    env: Env


@dataclass(frozen=True)
class Range:
    """What a ``for`` goes through: keys of a kind that satisfy ``has``, and what the loop gets of each."""

    kind: Kind
    has: Callable[..., Truth]
    gets: Callable[..., Value]
    names_key: bool
    """Whether the target, or its first part (``items``), is the key itself."""
    is_items: bool = False


class Way(Enum):
    """How the cases of clauses are gone through."""

    BY_SCOPE = "one after the other in a finite scope"
    BOUND = "with bound constants in any scope"
    UNORDERED = "with bound constants also for a set whose elements are listed"


def each(
    frame: Frame, clauses: Sequence[ast.comprehension], env: Env, given: Given, way: Way = Way.BY_SCOPE
) -> Iterator[Case]:
    """Go through the cases of several clauses."""
    if not clauses:
        yield Case([], True, env)
        return
    for case in _cases(frame, clauses[0], env, given, way):
        with frame.state.assuming(case.guard):
            for inner in each(frame, clauses[1:], case.env, given, way):
                yield Case(case.binders + inner.binders, and_(case.guard, inner.guard), inner.env)


def _cases(frame: Frame, clause: ast.comprehension, env: Env, given: Given, way: Way) -> Iterator[Case]:
    """Go through the cases of one clause."""
    for binders, member, element in _elements(frame, clause, env, given, way):
        if member is False:
            continue
        inner = {**env, **bind(frame, clause.target, element)}
        with frame.state.assuming(member):
            guard, inner = conjunction(frame, clause.ifs, inner)
        if guard is not False:
            yield Case(binders, and_(member, guard), inner)


def _elements(
    frame: Frame, clause: ast.comprehension, env: Env, given: Given, way: Way
) -> Iterator[tuple[list[Term], Truth, Value]]:
    source = _range(frame, clause.iter, env, way)
    if not isinstance(source, Range):
        for value in source:
            yield [], _agrees(clause.target, value, given), value
        return
    places = _places(frame, clause.target, source)
    fixed = [given[name][index] if name in given else None for name, index in places]
    scalars = scalars_of(source.kind)
    free = [index for index, term in enumerate(fixed) if term is None]
    kinds = tuple(scalars[index] for index in free)
    names = [places[index][0] or scalars[index].name.lower() for index in free]
    with frame.at(clause.iter):
        opened = (frame.scope.open if way is Way.BY_SCOPE else frame.scope.open_symbolic)(kinds, names)
        for binders, terms in opened:
            key = list(fixed)
            for index, term in zip(free, terms, strict=True):
                key[index] = term
            member = source.has(*key)
            yield binders, member, source.gets(*key) if member is not False else ABSENT


def _range(frame: Frame, node: ast.expr, env: Env, way: Way) -> Range | Sequence[Value]:
    """Lift what a ``for`` goes through: a set, a map, its items or values, or listed values."""
    method = ""
    if isinstance(node, ast.Call) and isinstance(node.func, ast.Attribute) and node.func.attr in _VIEWS:
        if node.args or node.keywords:
            raise frame.outside(node, f"arguments of {ast.unparse(node)}", f"m.{node.func.attr}()")
        method, node = node.func.attr, node.func.value
    value = frame.unwrap(evaluate(frame, node, env), node)
    if isinstance(value, Absent):
        return ()
    if isinstance(value, Map):
        return _map_range(value, method)
    if isinstance(value, Set) and not method:
        if value.listed is not None and way is not Way.UNORDERED:
            return value.listed
        kind = value.element
        return Range(kind, value.member, lambda *q: unflat(kind, q), names_key=True) if kind else ()
    if isinstance(value, Tuple) and not method:
        return value.items
    raise frame.outside(
        node, f"loop over {ast.unparse(node)} ({name_of(value)})", "loop over a set, a map, m.items(), a tuple"
    )


_VIEWS = ("items", "keys", "values")


def _map_range(value: Map, method: str) -> Range | Sequence[Value]:
    kind = value.key
    if kind is None:
        return ()
    if method == "items":
        return Range(kind, value.has, lambda *q: Tuple((unflat(kind, q), value.get(*q))), names_key=True, is_items=True)
    if method == "values":
        return Range(kind, value.has, value.get, names_key=False)
    return Range(kind, value.has, lambda *q: unflat(kind, q), names_key=True)


def _places(frame: Frame, target: ast.expr, source: Range) -> list[tuple[str, int]]:
    """Say for each scalar of the key which loop variable it is a part of; "" if of none."""
    unnamed = [("", 0)] * len(scalars_of(source.kind))
    if not source.names_key:
        return unnamed
    if source.is_items:
        if not isinstance(target, ast.Tuple) or len(target.elts) != 2:
            return unnamed
        target = target.elts[0]
    return _names(target, source.kind)


def _names(target: ast.expr, kind: Kind) -> list[tuple[str, int]]:
    if isinstance(target, ast.Tuple) and isinstance(kind, TupleKind) and len(target.elts) == len(kind.items):
        return [place for part, item in zip(target.elts, kind.items, strict=True) for place in _names(part, item)]
    name = target.id if isinstance(target, ast.Name) else ""
    return [(name, index if name else 0) for index in range(len(scalars_of(kind)))]


def _agrees(target: ast.expr, value: Value, given: Given) -> Truth:
    """A listed value is the one that is asked for."""
    if isinstance(target, ast.Name) and target.id in given:
        defined, terms = flat(value)
        return and_(defined, equal_keys(terms, given[target.id]))
    if isinstance(target, ast.Tuple) and isinstance(value, Tuple):
        return and_(*(_agrees(part, item, given) for part, item in zip(target.elts, value.items, strict=False)))
    return True


def bind(frame: Frame, target: ast.expr, value: Value) -> Env:
    """Return the variables that a target sets."""
    if isinstance(target, ast.Name):
        return {target.id: value}
    if isinstance(target, ast.Tuple) and isinstance(value, Absent):
        return {name: ABSENT for part in target.elts for name in bind(frame, part, ABSENT)}
    if isinstance(target, ast.Tuple) and isinstance(value, Tuple) and len(target.elts) == len(value.items):
        bound: Env = {}
        for part, item in zip(target.elts, value.items, strict=True):
            bound |= bind(frame, part, item)
        return bound
    raise frame.outside(
        target, f"{ast.unparse(target)} does not match a {name_of(value)}", "a name, or a tuple of names for a tuple"
    )


# any, all --------------------------------------------------------------------------------------


def quantified(frame: Frame, node: ast.GeneratorExp, env: Env, universal: bool) -> Truth:
    """``all(... for ...)`` and ``any(... for ...)``."""
    _check_clauses(frame, node, node.generators)
    parts: list[Truth] = []
    for case in each(frame, node.generators, env, {}):
        body = condition(frame, node.elt, case.env)
        if universal:
            parts.append(frame.scope.forall(case.binders, implies_(case.guard, body)))
        else:
            parts.append(frame.scope.exists(case.binders, and_(case.guard, body)))
    return and_(*parts) if universal else or_(*parts)


# Comprehensions ----------------------------------------------------------------------------------


@construct(ast.SetComp)
def lift_setcomp(frame: Frame, node: ast.SetComp | ast.GeneratorExp, env: Env) -> Set:
    """``{e for x in s if c}``, ``frozenset(e for x in s if c)``: something is in it if some case gives it."""
    kind = _probe(frame, node, node.elt, node.elt, env)
    if kind is None:
        return EMPTY_SET
    path = frame.state.path

    def member(*q: Term) -> Truth:
        with frame.state.deferred(path), frame.at(node):
            return _occurs(frame, node.elt, node.generators, env, kind, q)

    return Set(kind, member)


@construct(ast.DictComp)
def lift_dictcomp(frame: Frame, node: ast.DictComp, env: Env) -> Map:
    """``{k: e for k in s if c}``: the key names every loop variable, so there is one value for it."""
    kind = _probe(frame, node, node.key, node.value, env)
    if kind is None:
        return EMPTY_MAP
    path = frame.state.path

    def has(*q: Term) -> Truth:
        with frame.state.deferred(path), frame.at(node):
            return _occurs(frame, node.key, node.generators, env, kind, q)

    def get(*q: Term) -> Value:
        found: Value = ABSENT
        with frame.state.deferred(path), frame.at(node):
            for case in each(frame, node.generators, env, _given(node.key, kind, q)):
                here = and_(case.guard, _equals(frame, node.key, case.env, q))
                if here is not False:
                    found = overlay(here, evaluate(frame, node.value, case.env), found)
        return found

    return Map(kind, has, get)


def _occurs(
    frame: Frame, element: ast.expr, clauses: Sequence[ast.comprehension], env: Env, kind: Kind, q: Terms
) -> Truth:
    """Some case of the clauses gives the element asked for."""
    found = [
        frame.scope.exists(case.binders, and_(case.guard, _equals(frame, element, case.env, q)))
        for case in each(frame, clauses, env, _given(element, kind, q))
    ]
    return or_(*found)


def _equals(frame: Frame, element: ast.expr, env: Env, q: Terms) -> Truth:
    defined, terms = flat(evaluate(frame, element, env))
    return and_(defined, equal_keys(terms, q)) if defined is not False else False


def _given(element: ast.expr, kind: Kind, q: Terms) -> dict[str, Terms]:
    """Read off the element asked for what the loop variables are that it names."""
    if isinstance(element, ast.Name):
        return {element.id: q}
    if not isinstance(element, ast.Tuple) or not isinstance(kind, TupleKind):
        return {}
    found: dict[str, Terms] = {}
    start = 0
    for part, item in zip(element.elts, kind.items, strict=True):
        width = len(scalars_of(item))
        found = _given(part, item, q[start : start + width]) | found
        start += width
    return found


def _probe(
    frame: Frame, node: ast.SetComp | ast.GeneratorExp | ast.DictComp, key: ast.expr, value: ast.expr, env: Env
) -> Kind | None:
    """Go through the comprehension once: collect its obligations, find its kind, refuse what is unclear."""
    _check_clauses(frame, node, node.generators)
    kind: Kind | None = None
    for case in each(frame, node.generators, env, {}, Way.BOUND):
        found = frame.key(evaluate(frame, key, case.env), key)
        evaluate(frame, value, case.env)
        if not isinstance(found, Absent):
            kind = frame.scope.kind_of(found)
    if kind is not None and isinstance(node, ast.DictComp):
        _check_key(frame, node, kind, env)
    return kind


def _check_key(frame: Frame, node: ast.DictComp, kind: Kind, env: Env) -> None:
    """Refuse a dict comprehension whose key leaves a loop variable open: which value counts would hang on order."""
    scalars = scalars_of(kind)
    with frame.state.deferred(frame.state.path):
        for _, terms in frame.scope.open_symbolic(scalars, [scalar.name.lower() for scalar in scalars]):
            for case in each(frame, node.generators, env, _given(node.key, kind, terms), Way.UNORDERED):
                if case.binders:
                    raise frame.outside(
                        node,
                        f"the key {ast.unparse(node.key)} does not name every loop variable",
                        "let the key be the loop variable, or the tuple of them: {k: e for k in s}",
                    )


def _check_clauses(frame: Frame, node: ast.expr, clauses: Sequence[ast.comprehension]) -> None:
    names = [part.id for clause in clauses for part in ast.walk(clause.target) if isinstance(part, ast.Name)]
    if len(names) != len(set(names)):
        raise frame.outside(node, "a loop variable is used twice", "give every loop variable a name of its own")
    if any(clause.is_async for clause in clauses):
        raise frame.outside(node, "async for", "plain for")
