"""Terms of logic, folded while they are built.

A truth is a Python ``bool`` once it is decided, else a Z3 term: so constants cost nothing
and concrete states are evaluated without a solver.
"""

from __future__ import annotations

from collections.abc import Sequence
from functools import cache
from typing import Any, TypeAlias

import z3

Term: TypeAlias = Any
"""A Z3 expression, or a Python ``bool``."""
Truth: TypeAlias = Any
"""A Z3 Boolean, or a Python ``bool``."""

_CONSTANTS: dict[int, Term] = {}
"""Every enumeration value by its Z3 id: two different ones are never equal."""


@cache
def enumeration(name: str, values: tuple[str, ...]) -> tuple[Any, tuple[Term, ...]]:
    """Declare a sort of named, distinct values; the same declaration gives the same sort."""
    sort, terms = z3.EnumSort(name, list(values))
    _CONSTANTS.update({term.get_id(): term for term in terms})
    return sort, tuple(terms)


def is_constant(term: Term) -> bool:
    """Whether a term is a known value: an enumeration value, a numeral, a decided truth."""
    return isinstance(term, bool) or term.get_id() in _CONSTANTS or isinstance(term, z3.IntNumRef)


def to_z3(term: Term) -> Any:
    """Return a Z3 expression in every case."""
    return z3.BoolVal(term) if isinstance(term, bool) else term


def same(left: Any, right: Any) -> bool:
    """Whether two values are the same object, or the same term."""
    if left is right:
        return True
    return isinstance(left, z3.ExprRef) and isinstance(right, z3.ExprRef) and bool(left.eq(right))


def and_(*parts: Truth) -> Truth:
    """Conjunction."""
    return _junction(parts, neutral=True, build=z3.And)


def or_(*parts: Truth) -> Truth:
    """Disjunction."""
    return _junction(parts, neutral=False, build=z3.Or)


def _junction(parts: Sequence[Truth], neutral: bool, build: Any) -> Truth:
    """Join the parts, leaving out neutral and repeated ones; one absorbing part decides."""
    left: dict[int, Truth] = {}
    for part in parts:
        if isinstance(part, bool):
            if part is not neutral:
                return not neutral
        else:
            left[part.get_id()] = part
    if not left:
        return neutral
    return next(iter(left.values())) if len(left) == 1 else build(*left.values())


def not_(part: Truth) -> Truth:
    """Negation; a double one cancels."""
    if isinstance(part, bool):
        return not part
    return part.arg(0) if z3.is_not(part) else z3.Not(part)


def implies_(left: Truth, right: Truth) -> Truth:
    """Implication."""
    if left is True or right is True:
        return right
    if left is False:
        return True
    if right is False:
        return not_(left)
    return z3.Implies(left, right)


def ite_(condition: Truth, yes: Term, no: Term) -> Term:
    """``yes if condition else no`` for two terms of one sort."""
    if condition is True or same(yes, no):
        return yes
    if condition is False:
        return no
    if isinstance(yes, bool):
        return or_(condition, no) if yes else and_(not_(condition), no)
    if isinstance(no, bool):
        return or_(not_(condition), yes) if no else and_(condition, yes)
    return z3.If(condition, yes, no)


def equal_terms(left: Term, right: Term) -> Truth:
    """Equality of two terms of one sort."""
    if isinstance(left, bool):
        return right if left else not_(right)
    if isinstance(right, bool):
        return left if right else not_(left)
    if left.eq(right):
        return True
    if is_constant(left) and is_constant(right):
        return False
    return left == right


def folded(term: Term) -> Term:
    """Calculate at once what consists of numerals."""
    if all(isinstance(part, z3.IntNumRef) for part in term.children()):
        term = z3.simplify(term)
    if z3.is_true(term) or z3.is_false(term):
        return bool(z3.is_true(term))
    return term
