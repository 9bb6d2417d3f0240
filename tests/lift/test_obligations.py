"""Partial operations become obligations that hold exactly where the operation is guarded."""

from __future__ import annotations

import inspect
from collections.abc import Callable
from typing import Any, get_type_hints

import pytest
import z3

from proofs.lift import Lifter, Obligation, UnboundedScope
from tests.lift import harbour, harbour_steps
from tests.lift.harbour import Berth, Harbour, Ship


def after_return(harbour: Harbour, ship: Ship) -> int:
    if ship not in harbour.weight:
        return 0
    return harbour.weight[ship]


def in_range(harbour: Harbour) -> bool:
    return all(harbour.weight[ship] > 0 for ship in harbour.weight)


def in_filter(harbour: Harbour) -> frozenset[Berth]:
    return frozenset(berth for berth in harbour.closed if berth in harbour.slots and harbour.slots[berth].is_open)


def in_conditional(harbour: Harbour, ship: Ship) -> int:
    return harbour.weight[ship] if ship in harbour.weight else 0  # noqa: SIM401


def inner(harbour: Harbour, ship: Ship) -> int:
    return harbour.weight[ship]


def in_called(harbour: Harbour, ship: Ship) -> int:
    return inner(harbour, ship) if ship in harbour.weight else 0


def after_assert(harbour: Harbour, ship: Ship) -> int:
    assert ship in harbour.weight
    return harbour.weight[ship]


def in_range_of_another(harbour: Harbour) -> bool:
    return all(harbour.weight[ship] > 0 for ship in harbour.home)


def in_first_operand(harbour: Harbour, ship: Ship) -> bool:
    return harbour.weight[ship] > 0 and ship in harbour.weight


def in_wrong_branch(harbour: Harbour, ship: Ship) -> int:
    return 0 if ship in harbour.weight else harbour.weight[ship]


def key_is_optional(harbour: Harbour, ship: Ship) -> bool:
    return harbour.slots[harbour.home.get(ship)].is_open  # type: ignore[index]


def divides(harbour: Harbour, amount: int) -> int:
    return harbour.level // amount


GUARDED = [
    after_return,
    in_range,
    in_filter,
    in_conditional,
    in_called,
    harbour.guarded_by_and,
    harbour.guarded_by_or,
    harbour.newer_than_last,
    harbour.marked,
    harbour_steps.narrowed,
    harbour.divided,
    harbour_steps.leave,
]
UNGUARDED = [
    harbour.unguarded_lookup,
    harbour.unguarded_option,
    harbour.unguarded_in_loop,
    harbour.unguarded_in_comprehension,
    harbour.asserted,
    after_assert,
    in_range_of_another,
    in_first_operand,
    in_wrong_branch,
    key_is_optional,
    divides,
]


def obligations_of(function: Callable[..., Any]) -> tuple[list[Obligation], list[Any]]:
    scope = UnboundedScope()
    lifter = Lifter(scope, collect=True)
    hints = get_type_hints(function)
    lifter.call(function, *(scope.fresh(hints[name], name) for name in inspect.signature(function).parameters))
    return lifter.obligations, [axiom.formula for axiom in scope.axioms()]


def is_proved(obligation: Obligation, axioms: list[Any]) -> bool:
    solver = z3.Solver()
    solver.add(*axioms, z3.Not(obligation.claim))
    return bool(solver.check() == z3.unsat)


@pytest.mark.parametrize("function", GUARDED, ids=lambda function: function.__name__)
def test_a_guarded_operation_is_proved(function: Callable[..., Any]) -> None:
    obligations, axioms = obligations_of(function)
    assert obligations
    assert all(is_proved(obligation, axioms) for obligation in obligations)


@pytest.mark.parametrize("function", UNGUARDED, ids=lambda function: function.__name__)
def test_an_unguarded_operation_is_not_proved(function: Callable[..., Any]) -> None:
    obligations, axioms = obligations_of(function)
    assert not all(is_proved(obligation, axioms) for obligation in obligations)


def test_what_an_assert_says_may_be_used_after_it() -> None:
    obligations, axioms = obligations_of(after_assert)
    assert [is_proved(obligation, axioms) for obligation in obligations] == [False, True]


def test_an_obligation_says_where_it_stands() -> None:
    [obligation] = obligations_of(inner)[0]
    assert obligation.file == __file__
    assert obligation.line == inspect.getsourcelines(inner)[1] + 1
    assert obligation.text == "harbour.weight[ship]"


def test_none_are_collected_unless_asked_for() -> None:
    scope = UnboundedScope()
    lifter = Lifter(scope)
    lifter.call(inner, scope.fresh(Harbour, "harbour"), scope.fresh(Ship, "ship"))
    assert lifter.obligations == []
