"""Unbounded and finite scopes, the two-vocabulary form, cases, conjuncts and concrete objects."""

from __future__ import annotations

import ast
import inspect
from dataclasses import replace
from typing import Any

import pytest
import z3
from hypothesis import given, settings

from proofs.lift import FiniteScope, Lifter, Mismatch, UnboundedScope, concretise, conjuncts, embed
from proofs.lift.scopes import Scope
from tests.lift import harbour, harbour_steps
from tests.lift.harbour import UNIVERSE, Berth, Harbour, Port, Ship, Tide, Visit
from tests.lift.strategies import states_of

SIZES = {Berth: 2, Ship: 2, Tide: 3, Visit: 3}


def proved(scope: Scope, claim: Any) -> bool:
    solver = z3.Solver()
    solver.add(*(axiom.formula for axiom in scope.axioms()), z3.Not(claim))
    return bool(solver.check() == z3.unsat)


@settings(max_examples=50, deadline=None, database=None)
@given(states_of(Port, UNIVERSE))
def test_embedding_loses_nothing(port: Port) -> None:
    scope = FiniteScope.of_universe(UNIVERSE)
    assert concretise(None, scope, embed(scope, port, Port), Port) == port


def test_fresh_symbols_have_readable_names() -> None:
    scope = UnboundedScope()
    pre = scope.fresh(Port, "pre")
    berth = scope.constant(Berth, "berth")
    assert str(berth) == "berth"
    assert str(pre.fields["harbour"].fields["closed"].member(berth)) == "pre.harbour.closed(berth)"
    assert str(pre.fields["harbour"].fields["last"].is_none) == "pre.harbour.last.is_none"


def test_numbered_identifiers_are_totally_ordered() -> None:
    scope = UnboundedScope()
    one, other, third = (scope.constant(Tide, name) for name in ("one", "other", "third"))
    lifter = Lifter(scope)
    less = lifter.formula(harbour.earlier, one, other)
    assert proved(scope, z3.Implies(less, z3.Not(lifter.formula(harbour.earlier, other, one))))
    assert proved(scope, z3.Or(less, lifter.formula(harbour.not_later, other, one)))
    both = z3.And(less, lifter.formula(harbour.earlier, other, third))
    assert proved(scope, z3.Implies(both, lifter.formula(harbour.earlier, one, third)))
    assert not proved(scope, less)


def test_what_is_absent_is_empty() -> None:
    scope = UnboundedScope()
    pre, visit, berth = scope.fresh(Harbour, "pre"), scope.constant(Visit, "visit"), scope.constant(Berth, "berth")
    moored = pre.fields["moored"]
    assert proved(scope, z3.Implies(moored.get(visit).member(berth), moored.has(visit)))
    marks = pre.fields["marks"]
    assert proved(scope, z3.Implies(marks.get(visit).has(berth), marks.has(visit)))


def test_a_finite_named_tuple_is_its_fields() -> None:
    scope = FiniteScope(SIZES)
    one, other = scope.constant(Visit, "one"), scope.constant(Visit, "other")
    kind = scope.scalar_of(one)
    alike = z3.And(*(scope.field(kind, name, one) == scope.field(kind, name, other) for name in Visit._fields))
    assert proved(scope, z3.Implies(alike, one == other))


def test_a_finite_counterexample_is_a_python_object() -> None:
    scope = FiniteScope(SIZES)
    lifter = Lifter(scope)
    pre, visit, berth = scope.fresh(Harbour, "pre"), scope.constant(Visit, "visit"), scope.constant(Berth, "berth")
    post = lifter.call(harbour_steps.enter, pre, visit, berth)
    solver = z3.Solver()
    solver.add(*(axiom.formula for axiom in scope.axioms()))
    solver.add(z3.Not(lifter.formula(harbour.has_stay, post, visit, berth)), pre.fields["closed"].member(berth))
    assert solver.check() == z3.sat
    model = solver.model()
    before: Harbour = concretise(model, scope, pre, Harbour)
    entered = (concretise(model, scope, visit, Visit), concretise(model, scope, berth, Berth))
    assert entered[1] in ("Berth0", "Berth1")
    assert isinstance(entered[0], Visit)
    assert entered[0].ship in ("Ship0", "Ship1")
    assert harbour_steps.enter(before, *entered) == concretise(model, scope, post, Harbour)


def test_a_case_that_hands_an_argument_back_is_that_argument() -> None:
    scope = UnboundedScope()
    pre, visit, berth = scope.fresh(Port, "pre"), scope.constant(Visit, "visit"), scope.constant(Berth, "berth")
    cases = Lifter(scope).cases(harbour_steps.port_enter, pre, visit, berth)
    assert [case.value is pre for case in cases] == [True, True, True, False]
    assert proved(scope, z3.Or(*(case.condition for case in cases)))
    for index, case in enumerate(cases):
        assert all(proved(scope, z3.Not(z3.And(case.condition, other.condition))) for other in cases[:index])


def test_a_variable_keeps_its_cases_apart() -> None:
    scope = UnboundedScope()
    pre, berth = scope.fresh(Port, "pre"), scope.constant(Berth, "berth")
    cases = Lifter(scope).cases(harbour_steps.port_attempt, pre, berth)
    assert len(cases) == 2
    assert [case.value.fields["port"] is pre for case in cases] == [True, False]


def test_only_changed_components_are_named() -> None:
    scope = UnboundedScope()
    pre, visit, berth = scope.fresh(Harbour, "pre"), scope.constant(Visit, "visit"), scope.constant(Berth, "berth")
    case = Lifter(scope).cases(harbour_steps.enter, pre, visit, berth)[-1]
    post, definitions = scope.name(case.value, "post", relative_to=pre)
    names = {definition.name for definition in definitions}
    assert names == {"post.last.is_none", "post.last", "post.closed", "post.moored.has", "post.moored"}
    assert post.fields["slots"] is pre.fields["slots"]
    assert str(post.fields["closed"].member(berth)) == "post.closed(berth)"


def test_only_changed_fields_of_the_records_in_a_map_are_named() -> None:
    scope = UnboundedScope()
    pre, ship = scope.fresh(Harbour, "pre"), scope.constant(Ship, "ship")
    post, definitions = scope.name(Lifter(scope).call(reslotted, pre, ship), "post", relative_to=pre)
    assert {definition.name for definition in definitions} == {
        "post.slots.holder.is_none",
        "post.slots.holder",
        "post.slots.seen",
    }
    assert post.fields["moored"] is pre.fields["moored"]


def reslotted(state: Harbour, ship: Ship) -> Harbour:
    return replace(state, slots=harbour.changed_slots(state, ship))


def test_named_and_unnamed_forms_are_equal() -> None:
    scope = FiniteScope(SIZES)
    pre, visit, berth = scope.fresh(Harbour, "pre"), scope.constant(Visit, "visit"), scope.constant(Berth, "berth")
    lifter = Lifter(scope)
    value = lifter.call(harbour_steps.enter, pre, visit, berth)
    post, definitions = scope.name(value, "post", relative_to=pre)
    defined = z3.And(*(definition.formula for definition in definitions))
    plain, named = (lifter.formula(harbour.each_has_one, each) for each in (value, post))
    assert proved(scope, z3.Implies(defined, plain == named))


def nested(state: Harbour) -> bool:
    return all(
        state.quiet and all(berth in state.closed and berth in state.slots for berth in state.moored[visit])
        for visit in state.moored
    )


def test_conjuncts_say_the_same_in_parts() -> None:
    scope = UnboundedScope()
    formula = Lifter(scope).formula(nested, scope.fresh(Harbour, "pre"))
    parts = conjuncts(formula)
    assert len(parts) == 3
    assert proved(scope, z3.And(*parts) == formula)


def test_a_mutant_stands_for_a_function() -> None:
    tree = ast.parse(inspect.getsource(harbour.either)).body[0]
    assert isinstance(tree, ast.FunctionDef)
    for node in ast.walk(tree):
        if isinstance(node, ast.BoolOp):
            node.op = ast.And()
    scope = UnboundedScope()
    pre, berth = scope.fresh(Harbour, "pre"), scope.constant(Berth, "berth")
    mutant = Lifter(scope, sources={harbour.either: tree}).formula(harbour.either, pre, berth)
    assert mutant.eq(Lifter(scope).formula(harbour.both, pre, berth))


def test_a_finite_scope_names_the_size_it_lacks() -> None:
    with pytest.raises(Mismatch, match="Visit"):
        FiniteScope({Berth: 2}).fresh(Harbour, "pre")


def test_a_value_outside_the_universe_is_refused() -> None:
    with pytest.raises(Mismatch, match="b9"):
        embed(FiniteScope.of_universe(UNIVERSE), Berth("b9"), Berth)
