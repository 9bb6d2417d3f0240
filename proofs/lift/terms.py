"""Terms of logic, folded while they are built.

A truth is a Python ``bool`` once it is decided, else a Z3 term: so constants cost nothing
and concrete states are evaluated without a solver.
"""

from __future__ import annotations

from collections.abc import Callable, Collection, Sequence
from functools import cache
from typing import Any, TypeAlias

import z3

Term: TypeAlias = Any
"""A Z3 expression, or a Python ``bool``."""
Truth: TypeAlias = Any
"""A Z3 Boolean, or a Python ``bool``."""

_CONSTANTS: dict[int, Term] = {}
"""Every enumeration value by its address: two different ones are never equal."""


def address(term: Any) -> int:
    """Return where Z3 keeps a term or a sort: it keeps equal ones once, so this is what makes one."""
    return int(term.ast.value)


@cache
def enumeration(name: str, values: tuple[str, ...]) -> tuple[Any, tuple[Term, ...]]:
    """Declare a sort of named, distinct values; the same declaration gives the same sort."""
    sort, terms = z3.EnumSort(name, list(values))
    _CONSTANTS.update({address(term): term for term in terms})
    return sort, tuple(terms)


def is_constant(term: Term) -> bool:
    """Whether a term is a known value: an enumeration value, a numeral, a decided truth."""
    return isinstance(term, bool) or address(term) in _CONSTANTS or isinstance(term, z3.IntNumRef)


def to_z3(term: Term) -> Any:
    """Return a Z3 expression in every case."""
    return z3.BoolVal(term) if isinstance(term, bool) else term


def same(left: Any, right: Any) -> bool:
    """Whether two values are the same object, or the same term."""
    if left is right:
        return True
    return isinstance(left, z3.ExprRef) and isinstance(right, z3.ExprRef) and address(left) == address(right)


def and_(*parts: Truth) -> Truth:
    """Conjunction."""
    kept = _kept(parts, neutral=True, operator=z3.Z3_OP_AND)
    return kept if isinstance(kept, bool) else _joined(kept, z3.Z3_mk_and)


def or_(*parts: Truth) -> Truth:
    """Disjunction; ``a or (a and b)`` is ``a``."""
    kept = _kept(parts, neutral=False, operator=z3.Z3_OP_OR)
    if isinstance(kept, bool):
        return kept
    if 1 < len(kept) <= _FEW:
        for key, part in list(kept.items()):
            if _operator(part) == z3.Z3_OP_AND and any(address(child) in kept for child in part.children()):
                del kept[key]
    return _joined(kept, z3.Z3_mk_or)


_FEW = 8
"""Junctions of more parts than this (a quantifier written out) are left as they are."""


def _kept(parts: Sequence[Truth], neutral: bool, operator: int) -> dict[int, Truth] | bool:
    """Return the parts without neutral and repeated ones, those of small inner junctions among them."""
    kept: dict[int, Truth] = {}
    for part in parts:
        if isinstance(part, bool):
            if part is not neutral:
                return not neutral
        elif len(parts) <= _FEW and _operator(part) == operator and part.num_args() <= _FEW:
            kept.update({address(child): child for child in part.children()})
        else:
            kept[address(part)] = part
    return kept or neutral


def _joined(kept: dict[int, Truth], build: Any) -> Truth:
    if len(kept) == 1:
        return next(iter(kept.values()))
    context = next(iter(kept.values())).ctx
    return z3.BoolRef(build(context.ref(), len(kept), _addresses(kept.values())), context)


# Z3's own Python functions check and convert their arguments again and again, which is most of
# the time of lifting.  Where the lifter has made sure of the sorts, it calls Z3 directly.


def _addresses(terms: Collection[Term]) -> Any:
    return (z3.Ast * len(terms))(*[term.ast for term in terms])


def _operator(term: Term) -> int | None:
    """Return the kind of a term's outermost symbol; None if it is a quantifier or a variable."""
    context = term.ctx_ref()
    if z3.Z3_get_ast_kind(context, term.ast) != z3.Z3_APP_AST:
        return None
    return int(z3.Z3_get_decl_kind(context, z3.Z3_get_app_decl(context, term.ast)))


def function_of(path: str, keys: Sequence[Any], result: Any) -> Callable[..., Term]:
    """Declare a function of logic: a constant if it has no keys."""
    constant = z3.Const(path, result)
    if not keys:
        return lambda: constant
    declared, wrap, context = z3.Function(path, *keys, result), type(constant), constant.ctx

    def apply(*terms: Term) -> Term:
        arguments = _addresses([to_z3(term) for term in terms])
        return wrap(z3.Z3_mk_app(context.ref(), declared.ast, len(terms), arguments), context)

    return apply


def not_(part: Truth) -> Truth:
    """Negation; a double one cancels."""
    if isinstance(part, bool):
        return not part
    return part.arg(0) if _operator(part) == z3.Z3_OP_NOT else z3.Not(part)


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
    if address(left) == address(right):
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
