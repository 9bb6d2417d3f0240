"""One function, three ways: CPython, lifted from a concrete state, lifted from symbols.

``check_function`` draws arguments and fails unless all ways agree.
"""

from __future__ import annotations

import inspect
import typing
from collections.abc import Callable, Sequence
from typing import Any

import z3
from hypothesis import HealthCheck, Phase, given, settings
from hypothesis import strategies as st

from proofs.lift import FiniteScope, Lifter, Named, Value, concretise, embed
from proofs.lift.components import components
from proofs.lift.kinds import Kind, OptionKind, RecordKind, kind_of_type
from proofs.lift.scopes import Scope
from proofs.lift.terms import Term, equal_terms, to_z3
from proofs.lift.values import Absent, Record
from tests.lift.strategies import Universe, states_of

Code = Callable[..., Any]
PARTIAL = (KeyError, AttributeError, TypeError, AssertionError, ZeroDivisionError)
"""What an operation that is not well defined raises in CPython."""


class QuantifiedScope(FiniteScope):
    """A finite scope that keeps its quantifiers, as the unbounded scope does."""

    open = Scope.open_symbolic


def types_of(function: Code) -> tuple[list[Any], Any]:
    """Return the types of a function's parameters and of its result."""
    hints = typing.get_type_hints(function)
    result = hints.pop("return")
    return list(hints.values()), result


def check_function(function: Code, universe: Universe, examples: int = 25, symbolic: bool = True) -> None:
    """Draw arguments, and compare what CPython and the lifter make of them."""
    types, result = types_of(function)
    names = list(inspect.signature(function).parameters)
    scope = FiniteScope.of_universe(universe)
    symbols = Symbols(function, universe) if symbolic else None

    @settings(
        max_examples=examples,
        deadline=None,
        database=None,
        derandomize=True,
        phases=[Phase.generate],
        suppress_health_check=list(HealthCheck),
    )
    @given(st.tuples(*(states_of(each, universe) for each in types)))
    def compare(arguments: tuple[Any, ...]) -> None:
        lifter = Lifter(scope, collect=True)
        values = [embed(scope, argument, each) for argument, each in zip(arguments, types, strict=True)]
        lifted = lifter.call(function, *values)
        try:
            expected = function(**dict(zip(names, arguments, strict=True)))
        except PARTIAL:
            assert any(can_fail(obligation.claim) for obligation in lifter.obligations), "an error without obligation"
            return
        assert concretise(None, scope, lifted, result) == expected, "from a concrete state"
        if result is bool:
            quantified = QuantifiedScope.of_universe(universe)
            again = [embed(quantified, argument, each) for argument, each in zip(arguments, types, strict=True)]
            assert not can_fail(Lifter(quantified).formula(function, *again) == expected), "with quantifiers"
        if symbols is not None:
            symbols.check(arguments, expected)

    compare()


def can_fail(claim: Any, known: Sequence[Any] = ()) -> bool:
    """Whether a claim can be false where this is known; it must be decided."""
    if z3.is_true(claim):
        return False
    solver = z3.SimpleSolver()
    solver.add(*known, z3.Not(claim))
    answer = solver.check()
    assert answer != z3.unknown
    return bool(answer == z3.sat)


class Symbols:
    """A function lifted once from free symbols, to be tried on many states."""

    def __init__(self, function: Code, universe: Universe) -> None:
        self.types, self.result = types_of(function)
        self.scope = FiniteScope.of_universe(universe)
        self.values = [self.scope.fresh(each, f"argument{index}") for index, each in enumerate(self.types)]
        lifter = Lifter(self.scope)
        self.lifted = lifter.call(function, *self.values)
        self.cases = lifter.cases(function, *self.values)
        self.named = self.lifted
        self.definitions: list[Named] = []
        if isinstance(self.lifted, Record):
            old = self.values[0] if self.types and types_match(self.types[0], self.result) else None
            self.named, self.definitions = self.scope.name(self.lifted, "post", relative_to=old)

    def check(self, arguments: tuple[Any, ...], expected: Any) -> None:
        """Pin the symbols to concrete arguments and read the result off a model."""
        solver = z3.SimpleSolver()
        for value, argument, each in zip(self.values, arguments, self.types, strict=True):
            solver.add(*pinned(self.scope, value, embed(self.scope, argument, each), kind_of_type(each)))
        solver.add(*(axiom.formula for axiom in self.scope.axioms()))
        solver.add(*(definition.formula for definition in self.definitions))
        assert solver.check() == z3.sat
        model = solver.model()
        assert concretise(model, self.scope, self.lifted, self.result) == expected, "from symbols"
        assert concretise(model, self.scope, self.named, self.result) == expected, "named"
        met = [case for case in self.cases if z3.is_true(model.eval(case.condition, model_completion=True))]
        assert len(met) == 1, "exactly one case"
        assert concretise(model, self.scope, met[0].value, self.result) == expected, "by cases"
        for value, argument in zip(self.values, arguments, strict=True):
            assert met[0].value is not value or expected == argument, "a case that hands an argument back"


def types_match(one: Any, other: Any) -> bool:
    """Whether both are the same record type."""
    return isinstance(kind_of_type(one), RecordKind) and kind_of_type(one) == kind_of_type(other)


def pinned(scope: FiniteScope, value: Value, concrete: Value, kind: Kind | OptionKind) -> list[Any]:
    """Say that symbols have the values of a concrete state; what that leaves open stays open."""
    found = []
    for part in components(kind, "pinned"):
        for _, terms in FiniteScope.open(scope, part.keys, [key.name for key in part.keys]):
            wanted: Term | Absent = part.read(concrete, *terms)
            if not isinstance(wanted, Absent):
                found.append(to_z3(equal_terms(part.read(value, *terms), wanted)))
    return found
