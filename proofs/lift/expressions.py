"""Expressions, one function a construct."""

from __future__ import annotations

import ast
from collections.abc import Callable, Sequence
from typing import Any

from proofs.lift.frames import MISSING, Env, Frame
from proofs.lift.kinds import INT
from proofs.lift.terms import Term, Truth, and_, folded, not_, or_
from proofs.lift.trees import Choice, Leaf, Tree, merge, settle
from proofs.lift.values import (
    ABSENT,
    Absent,
    Record,
    Value,
    is_term,
    name_of,
    some,
)

Construct = Callable[[Frame, Any, Env], Value]
EXPRESSIONS: dict[type[ast.expr], Construct] = {}
"""The function that lifts each construct; comprehensions and calls enter theirs."""

CASES: dict[type[ast.expr], Callable[[Frame, Any, Env], Tree]] = {}
"""The functions that lift a construct case by case."""


def construct(node: type[ast.expr]) -> Callable[[Construct], Construct]:
    """Enter a function as the one that lifts this construct."""

    def enter(function: Construct) -> Construct:
        EXPRESSIONS[node] = function
        return function

    return enter


def cases_of(frame: Frame, node: ast.expr, env: Env) -> Tree:
    """Lift an expression, keeping apart the cases of the functions that it calls."""
    lift = CASES.get(type(node))
    if lift is None:
        return Leaf(evaluate(frame, node, env))
    with frame.at(node):
        return settle(lift(frame, node, env))


def evaluate(frame: Frame, node: ast.expr, env: Env) -> Value:
    """Lift an expression."""
    lift = EXPRESSIONS.get(type(node))
    if lift is None:
        raise frame.outside(node, f"{type(node).__name__} is outside the subset: {ast.unparse(node)}", "see SUBSET.md")
    with frame.at(node):
        return lift(frame, node, env)


def condition(frame: Frame, node: ast.expr, env: Env) -> Truth:
    """Lift an expression that must be a bool."""
    return frame.truth(evaluate(frame, node, env), node)


# Names and constants -------------------------------------------------------------------------


@construct(ast.Name)
def lift_name(frame: Frame, node: ast.Name, env: Env) -> Value:
    """A local variable, or a constant of the module."""
    if node.id in env:
        value = env[node.id]
        return merge(value) if isinstance(value, (Leaf, Choice)) else value
    found = frame.global_object(node, env)
    if found is MISSING:
        raise frame.outside(node, f"unknown name {node.id}", "assign it on every path, or define it in the module")
    return frame.literal(found, node)


def _name_cases(frame: Frame, node: ast.Name, env: Env) -> Tree:
    value = env.get(node.id)
    return value if isinstance(value, (Leaf, Choice)) else Leaf(lift_name(frame, node, env))


CASES[ast.Name] = _name_cases


@construct(ast.Constant)
def lift_constant(frame: Frame, node: ast.Constant, env: Env) -> Value:
    """``True``, ``False``, ``None`` or an int."""
    return frame.literal(node.value, node)


@construct(ast.Attribute)
def lift_attribute(frame: Frame, node: ast.Attribute, env: Env) -> Value:
    """A field of a record or a NamedTuple, or an enum member."""
    found = frame.global_object(node, env)
    if found is not MISSING:
        return frame.literal(found, node)
    value = frame.unwrap(evaluate(frame, node.value, env), node.value)
    if isinstance(value, Absent):
        return ABSENT
    if isinstance(value, Record) and node.attr in value.fields:
        return value.fields[node.attr]
    if is_term(value) and frame.scope.scalar_of(value).is_named_tuple:
        return frame.scope.field(frame.scope.scalar_of(value), node.attr, value)
    raise frame.outside(
        node, f"{name_of(value)} has no field {node.attr}", "fields of dataclasses and NamedTuples only, no methods"
    )


# Logic ---------------------------------------------------------------------------------------


@construct(ast.BoolOp)
def lift_boolop(frame: Frame, node: ast.BoolOp, env: Env) -> Truth:
    """``and``, ``or``: what stands to the right is met only if the left did not decide."""
    if isinstance(node.op, ast.And):
        return conjunction(frame, node.values, env)[0]
    return or_(*map(not_, _in_turn(frame, node.values, env, holds=False)[0]))


def conjunction(frame: Frame, tests: Sequence[ast.expr], env: Env) -> tuple[Truth, Env]:
    """Lift tests that must all hold, each under those before it; and the names they narrow."""
    parts, env = _in_turn(frame, tests, env, holds=True)
    return and_(*parts), env


def _in_turn(frame: Frame, tests: Sequence[ast.expr], env: Env, holds: bool) -> tuple[list[Truth], Env]:
    """Lift tests in turn, each where those before it hold (or do not); and the names narrowed then."""
    parts: list[Truth] = []
    for test in tests:
        with frame.state.assuming(*parts):
            part = condition(frame, test, env)
            parts.append(part if holds else not_(part))
        if parts[-1] is False:
            break
        env = narrow(test, env, holds)
    return parts, env


def narrow(test: ast.expr, env: Env, holds: bool) -> Env:
    """Return the variables as they are known once a test has come out: no longer ``None``."""
    match test:
        case ast.Compare(left=ast.Name(id=name), ops=[op], comparators=[ast.Constant(value=None)]):
            if name in env and isinstance(op, ast.IsNot if holds else ast.Is):
                value = env[name]
                return {**env, name: some(merge(value) if isinstance(value, (Leaf, Choice)) else value)}
        case ast.UnaryOp(op=ast.Not(), operand=operand):
            return narrow(operand, env, not holds)
        case ast.BoolOp(op=op, values=values) if isinstance(op, ast.And if holds else ast.Or):
            for value in values:
                env = narrow(value, env, holds)
    return env


@construct(ast.UnaryOp)
def lift_unaryop(frame: Frame, node: ast.UnaryOp, env: Env) -> Value:
    """``not``, and the minus sign."""
    if isinstance(node.op, ast.Not):
        return not_(condition(frame, node.operand, env))
    if isinstance(node.op, ast.USub):
        found = number(frame, node.operand, env)
        return found if found is ABSENT else folded(-found)
    raise frame.outside(node, f"operator in {ast.unparse(node)}", "`not` and `-` only")


@construct(ast.IfExp)
def lift_ifexp(frame: Frame, node: ast.IfExp, env: Env) -> Value:
    """``a if c else b``."""
    return merge(_ifexp_cases(frame, node, env))


def _ifexp_cases(frame: Frame, node: ast.IfExp, env: Env) -> Tree:
    test = frame.state.decided(condition(frame, node.test, env))
    if isinstance(test, bool):
        return cases_of(frame, node.body if test else node.orelse, narrow(node.test, env, test))
    with frame.state.assuming(test):
        yes = cases_of(frame, node.body, narrow(node.test, env, True))
    with frame.state.assuming(not_(test)):
        no = cases_of(frame, node.orelse, narrow(node.test, env, False))
    return Choice(test, yes, no)


CASES[ast.IfExp] = _ifexp_cases


def number(frame: Frame, node: ast.expr, env: Env) -> Term:
    """Lift an expression that must be an int; ABSENT where nothing is there."""
    value = frame.unwrap(evaluate(frame, node, env), node)
    if isinstance(value, Absent):
        return ABSENT
    if is_term(value) and frame.scope.scalar_of(value) == INT:
        return value
    raise frame.outside(node, f"{ast.unparse(node)} is no int", "calculate with int only")
