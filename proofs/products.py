"""Questions in which products mean less: of two unknowns multiplied, only that the product grows with the second.

Solvers lose their way among products under quantifiers, where nothing is needed of most of them but that equal factors
make equal products.  So a question can be weakened: each product of two unknowns becomes a value of a function of which
nothing is said but two things that are true of multiplication.  What multiplication is is one such function; so if the
weaker question has no model, neither has the question, and what follows from the weaker hypotheses follows from those.
Nothing else that is answered of a weaker question is an answer.
"""

from __future__ import annotations

from typing import Any

import z3

from proofs.workbench import Part

PRODUCT = "product"
"""The function that stands for multiplication; no symbol of a theory is called so."""
GROWS = "a product by what is not negative grows with the other factor"
IS_NOT_NEGATIVE = "a product of what is not negative is not"


def product() -> Any:
    """Declare the function."""
    return z3.Function(PRODUCT, z3.IntSort(), z3.IntSort(), z3.IntSort())


def is_true_of(times: Any) -> dict[str, Any]:
    """What is said of the function, by name: of multiplication it is true."""
    by, one, other = z3.Ints("by one other")
    grows = z3.Implies(z3.And(by >= 0, one <= other), times(by, one) <= times(by, other))
    is_not_negative = z3.Implies(z3.And(by >= 0, one >= 0), times(by, one) >= 0)
    return {GROWS: z3.ForAll([by, one, other], grows), IS_NOT_NEGATIVE: z3.ForAll([by, one], is_not_negative)}


def weaker(part: Part) -> Part | None:
    """Give the weaker question; none where no two unknowns are multiplied."""
    weakened = _Weakened()
    hypotheses = {name: [weakened.of(each) for each in formulas] for name, formulas in part.hypotheses.items()}
    given, goal = [weakened.of(each) for each in part.given], weakened.of(part.goal)
    if not weakened.products:
        return None
    said = {name: [formula] for name, formula in is_true_of(product()).items()}
    return Part({**hypotheses, **said}, given, goal)


class _Weakened:
    """Formulas with products replaced; each term once."""

    def __init__(self) -> None:
        """Begin with no term."""
        self.products = 0
        self._made: dict[int, tuple[Any, Any]] = {}

    def of(self, term: Any) -> Any:
        """Give a term with its products replaced."""
        key = term.get_id()
        if key not in self._made:
            self._made[key] = term, self._quantified(term) if z3.is_quantifier(term) else self._applied(term)
        return self._made[key][1]

    def _quantified(self, term: Any) -> Any:
        bound = [z3.FreshConst(term.var_sort(each), term.var_name(each)) for each in range(term.num_vars())]
        body = self.of(z3.substitute_vars(term.body(), *reversed(bound)))
        return z3.ForAll(bound, body) if term.is_forall() else z3.Exists(bound, body)

    def _applied(self, term: Any) -> Any:
        inner = [self.of(each) for each in term.children()]
        if z3.is_mul(term):
            return self._product(inner)
        if all(one.eq(other) for one, other in zip(inner, term.children(), strict=True)):
            return term
        if z3.is_and(term) or z3.is_or(term):
            return z3.And(*inner) if z3.is_and(term) else z3.Or(*inner)
        return z3.Sum(*inner) if z3.is_add(term) else term.decl()(*inner)

    def _product(self, factors: list[Any]) -> Any:
        numerals = [each for each in factors if z3.is_int_value(each)]
        unknown = [each for each in factors if not z3.is_int_value(each)]
        self.products += len(unknown) > 1
        made = unknown.pop() if unknown else numerals.pop()
        for each in reversed(unknown):
            made = product()(each, made)
        for each in numerals:
            made = each * made
        return made
