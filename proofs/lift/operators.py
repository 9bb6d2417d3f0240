"""Lookups, displays and operators."""

from __future__ import annotations

import ast

import z3

from proofs.lift.comparisons import check_key, contains
from proofs.lift.expressions import CASES, cases_of, construct, evaluate
from proofs.lift.frames import Env, Frame
from proofs.lift.kinds import INT
from proofs.lift.terms import Term, and_, equal_terms, folded, ite_, not_, or_
from proofs.lift.trees import Tree, combine
from proofs.lift.values import (
    ABSENT,
    EMPTY_MAP,
    Absent,
    Map,
    Set,
    Tuple,
    Value,
    flat,
    is_term,
    listed_map,
    listed_set,
    name_of,
    overlay,
)


@construct(ast.Subscript)
def lift_subscript(frame: Frame, node: ast.Subscript, env: Env) -> Value:
    """``m[k]``, which needs ``k in m``; and ``t[0]`` of a tuple."""
    whole = frame.unwrap(evaluate(frame, node.value, env), node.value)
    if isinstance(whole, Tuple) and isinstance(node.slice, ast.Constant) and type(node.slice.value) is int:
        if node.slice.value >= len(whole.items):
            raise frame.outside(node, f"{ast.unparse(node)} of a tuple of {len(whole.items)}", "an item that it has")
        return whole.items[node.slice.value]
    if not isinstance(whole, (Map, Absent)):
        raise frame.outside(node, f"subscript of a {name_of(whole)}", "m[k] of a Mapping, t[0] of a tuple")
    key = evaluate(frame, node.slice, env)
    frame.require(contains(frame, key, whole, node), node)
    return lookup(frame, whole, key)


def lookup(frame: Frame, whole: Map | Absent, key: Value) -> Value:
    """The value at a key, whether or not it is there."""
    defined, terms = flat(key)
    if isinstance(whole, Absent) or whole.key is None or defined is False:
        return ABSENT
    check_key(frame, whole.key, terms)
    return whole.get(*terms)


@construct(ast.Tuple)
def lift_tuple(frame: Frame, node: ast.Tuple, env: Env) -> Value:
    """``(a, b)``."""
    return Tuple(tuple(evaluate(frame, item, env) for item in node.elts))


def _tuple_cases(frame: Frame, node: ast.Tuple, env: Env) -> Tree:
    return combine([cases_of(frame, item, env) for item in node.elts], Tuple)


CASES[ast.Tuple] = _tuple_cases


@construct(ast.Set)
def lift_set(frame: Frame, node: ast.Set, env: Env) -> Value:
    """``{a, b}``."""
    return set_of(frame, tuple(evaluate(frame, item, env) for item in node.elts), node)


def set_of(frame: Frame, values: tuple[Value, ...], node: ast.AST) -> Set:
    """Return the set of some values, none of which may be ``None``."""
    values = tuple(frame.key(value, node) for value in values)
    kept = tuple(value for value in values if not isinstance(value, Absent))
    return listed_set(frame.scope.kind_of(kept[0]), kept) if kept else listed_set(None, ())


@construct(ast.Dict)
def lift_dict(frame: Frame, node: ast.Dict, env: Env) -> Value:
    """``{k: v}``, and ``{**m, k: v}``, which is ``m | {k: v}``."""
    made: Map = EMPTY_MAP
    for key_node, value_node in zip(node.keys, node.values, strict=True):
        value = evaluate(frame, value_node, env)
        if key_node is None:
            part = frame.unwrap(value, value_node)
        else:
            key = frame.key(evaluate(frame, key_node, env), key_node)
            absent = isinstance(key, Absent)
            part = EMPTY_MAP if absent else listed_map(frame.scope.kind_of(key), ((key, value),))
        if isinstance(part, Absent):
            return ABSENT
        if not isinstance(part, Map):
            raise frame.outside(node, f"** of a {name_of(part)}", "{**m, k: v} of a Mapping m")
        made = part if made is EMPTY_MAP else union(made, part)
    return made


def union(left: Map, right: Map) -> Map:
    """``left | right``: of two entries with the same key the right one counts."""
    return Map(
        left.key or right.key,
        lambda *q: or_(left.has(*q), right.has(*q)),
        lambda *q: overlay(right.has(*q), right.get(*q), left.get(*q)),
    )


# Operators -----------------------------------------------------------------------------------


@construct(ast.BinOp)
def lift_binop(frame: Frame, node: ast.BinOp, env: Env) -> Value:
    """``|``, ``&``, ``-`` of sets, ``|`` of maps, arithmetic of ints."""
    left = frame.unwrap(evaluate(frame, node.left, env), node.left)
    right = frame.unwrap(evaluate(frame, node.right, env), node.right)
    match node.op, left, right:
        case ast.BitOr(), Set(), Set():
            return Set(left.element or right.element, lambda *q: or_(left.member(*q), right.member(*q)))
        case ast.BitAnd(), Set(), Set():
            return Set(left.element or right.element, lambda *q: and_(left.member(*q), right.member(*q)))
        case ast.Sub(), Set(), Set():
            return Set(left.element, lambda *q: and_(left.member(*q), not_(right.member(*q))))
        case ast.BitOr(), Map(), Map():
            return union(left, right)
    if isinstance(left, Absent) or isinstance(right, Absent):
        return ABSENT
    return _arithmetic(frame, node, left, right)


def _arithmetic(frame: Frame, node: ast.BinOp, left: Value, right: Value) -> Term:
    """``+``, ``-``, ``*``, and ``//`` and ``%`` rounding down as Python does."""
    for value in (left, right):
        if not is_term(value) or frame.scope.scalar_of(value) != INT:
            raise frame.outside(
                node,
                f"{ast.unparse(node)} calculates with {name_of(value)}",
                "arithmetic of int; | & - of sets; | of maps",
            )
    match node.op:
        case ast.Add():
            return folded(left + right)
        case ast.Sub():
            return folded(left - right)
        case ast.Mult():
            return folded(left * right)
        case ast.FloorDiv() | ast.Mod():
            frame.require(not_(equal_terms(right, z3.IntVal(0))), node)
            quotient = ite_(folded(right > 0), folded(left / right), folded((-left) / (-right)))
            return quotient if isinstance(node.op, ast.FloorDiv) else folded(left - right * quotient)
    raise frame.outside(node, f"operator in {ast.unparse(node)}", "+ - * // % of int; | & - of sets; | of maps")
