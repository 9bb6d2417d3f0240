"""Comparisons: equality, order, ``is None``, membership."""

from __future__ import annotations

import ast

from proofs.lift.expressions import construct, evaluate
from proofs.lift.frames import Env, Frame
from proofs.lift.kinds import INT, Kind, scalars_of
from proofs.lift.terms import Term, Truth, and_, folded, implies_, not_, or_
from proofs.lift.values import (
    Absent,
    Map,
    Mismatch,
    Nothing,
    Option,
    Record,
    Set,
    Tuple,
    Value,
    equal_scalars,
    flat,
    is_none,
    is_term,
    items_of,
    name_of,
    some,
)


@construct(ast.Compare)
def lift_compare(frame: Frame, node: ast.Compare, env: Env) -> Truth:
    """A comparison, or a chain of them."""
    parts: list[Truth] = []
    left_node, left = node.left, evaluate(frame, node.left, env)
    for op, right_node in zip(node.ops, node.comparators, strict=True):
        with frame.state.assuming(*parts):
            right = evaluate(frame, right_node, env)
            parts.append(_compare(frame, node, op, (left_node, left), (right_node, right)))
        left_node, left = right_node, right
    return and_(*parts)


Operand = tuple[ast.expr, Value]


def _compare(frame: Frame, node: ast.Compare, op: ast.cmpop, left: Operand, right: Operand) -> Truth:
    match op:
        case ast.Eq():
            return equal(frame, left[1], right[1])
        case ast.NotEq():
            return not_(equal(frame, left[1], right[1]))
        case ast.Is() | ast.IsNot():
            here = _is(frame, node, left[1], right[1])
            return here if isinstance(op, ast.Is) else not_(here)
        case ast.In() | ast.NotIn():
            here = contains(frame, left[1], frame.unwrap(right[1], right[0]), node)
            return here if isinstance(op, ast.In) else not_(here)
        case _:
            return _order(frame, node, op, frame.unwrap(left[1], left[0]), frame.unwrap(right[1], right[0]))


def _is(frame: Frame, node: ast.Compare, left: Value, right: Value) -> Truth:
    """``is None``, and ``is`` between enum members."""
    if isinstance(right, Nothing):
        return is_none(left)
    if is_term(right) and frame.scope.scalar_of(right).is_enum:
        return equal(frame, left, right)
    raise frame.outside(node, f"`is` in {ast.unparse(node)}", "`is` with None or an enum member only; else write ==")


def _order(frame: Frame, node: ast.Compare, op: ast.cmpop, left: Value, right: Value) -> Truth:
    """``<`` and the like: of ints, of numbered identifiers, and inclusion of sets."""
    if isinstance(left, Absent) or isinstance(right, Absent):
        return False
    if isinstance(left, Set) and isinstance(right, Set) and isinstance(op, (ast.LtE, ast.GtE)):
        return _included(frame, left, right) if isinstance(op, ast.LtE) else _included(frame, right, left)
    if is_term(left) and is_term(right):
        scalar = frame.scope.scalar_of(left)
        if scalar == frame.scope.scalar_of(right) and (scalar == INT or scalar.is_ordered):
            if isinstance(op, (ast.Gt, ast.LtE)):
                left, right = right, left
            less = folded(left < right) if scalar == INT else frame.scope.before(scalar, left, right)
            return less if isinstance(op, (ast.Lt, ast.Gt)) else not_(less)
    raise frame.outside(
        node,
        f"order of {name_of(left)} and {name_of(right)} in {ast.unparse(node)}",
        "only int and NewType(..., int) are ordered; <= also between sets",
    )


def equal(frame: Frame, left: Value, right: Value) -> Truth:
    """``==`` of two values."""
    if isinstance(left, Absent) or isinstance(right, Absent):
        return False
    if isinstance(left, (Nothing, Option)) or isinstance(right, (Nothing, Option)):
        no_left, no_right = is_none(left), is_none(right)
        both = and_(not_(no_left), not_(no_right))
        if both is False:
            return and_(no_left, no_right)
        return or_(and_(no_left, no_right), and_(both, equal(frame, some(left), some(right))))
    match left, right:
        case (Tuple(), Tuple()) | (Record(), Record()):
            ones, others = list(items_of(left)), list(items_of(right))
            if isinstance(left, Record) and left.cls is not right.cls:
                raise Mismatch(f"a {name_of(left)} is compared with a {name_of(right)}")
            if len(ones) != len(others):
                return False
            return and_(*(equal(frame, one, other) for one, other in zip(ones, others, strict=True)))
        case Set(), Set():
            return and_(_included(frame, left, right), _included(frame, right, left))
        case Map(), Map():
            return and_(_agree(frame, left, right), _agree(frame, right, left))
    if is_term(left) and is_term(right):
        return equal_scalars(left, right)
    raise Mismatch(f"a {name_of(left)} is compared with a {name_of(right)}")


def _included(frame: Frame, left: Set, right: Set) -> Truth:
    if left.element is None:
        return True
    scalars = scalars_of(left.element)
    return frame.scope.for_every(scalars, lambda *q: implies_(left.member(*q), right.member(*q)))


def _agree(frame: Frame, left: Map, right: Map) -> Truth:
    """Every key of the left map is in the right one, with an equal value."""
    if left.key is None:
        return True

    def alike(*q: Term) -> Truth:
        present = left.has(*q)
        if present is False or right.has(*q) is False:
            return not_(present)
        return implies_(present, and_(right.has(*q), equal(frame, left.get(*q), right.get(*q))))

    return frame.scope.for_every(scalars_of(left.key), alike)


def contains(frame: Frame, item: Value, whole: Value, node: ast.AST) -> Truth:
    """``item in whole``."""
    if isinstance(whole, Absent):
        return False
    if isinstance(whole, Tuple):
        return or_(*(equal(frame, item, one) for one in whole.items))
    if isinstance(whole, (Set, Map)):
        kind = whole.element if isinstance(whole, Set) else whole.key
        defined, terms = flat(item)
        if kind is None or defined is False:
            return False
        check_key(frame, kind, terms)
        return and_(defined, whole.member(*terms) if isinstance(whole, Set) else whole.has(*terms))
    raise frame.outside(node, f"`in` a {name_of(whole)}: {ast.unparse(node)}", "`in` a set, a map or a tuple")


def check_key(frame: Frame, kind: Kind, terms: tuple[Term, ...]) -> None:
    """Say so if a key is of other sorts than the set or the map has."""
    wanted, given = scalars_of(kind), tuple(frame.scope.scalar_of(term) for term in terms)
    if wanted != given:
        names = [", ".join(scalar.name for scalar in scalars) for scalars in (given, wanted)]
        raise Mismatch(f"a key of {names[0]} where {names[1]} is expected")
