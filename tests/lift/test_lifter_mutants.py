"""A lifter that says something else is noticed: each planted fault makes the differential suite fail."""

from __future__ import annotations

import ast
import copy
import dataclasses
from collections.abc import Callable
from contextlib import AbstractContextManager, ExitStack
from typing import Any
from unittest.mock import patch

import pytest

from proofs.lift import (
    OutsideSubset,
    calls,
    comparisons,
    comprehensions,
    expressions,
    operators,
    scopes,
    statements,
    values,
)
from proofs.lift.frames import Frame, State
from proofs.lift.terms import and_, ite_, not_, or_
from tests.lift import harbour, harbour_steps
from tests.lift.differential import check_function

Mutant = list[AbstractContextManager[Any]]
Rewrite = Callable[[Any], None]


def reading(node_type: type[ast.expr], change: Rewrite) -> Mutant:
    """Lift a construct as if another one stood there."""

    def changed(lift: Callable[..., Any]) -> Callable[..., Any]:
        def mutant(frame: Frame, node: ast.expr, env: Any) -> Any:
            other = copy.copy(node)
            change(other)
            return lift(frame, other, env)

        return mutant

    tables: list[Any] = [table for table in (expressions.EXPRESSIONS, expressions.CASES) if node_type in table]
    return [patch.dict(table, {node_type: changed(table[node_type])}) for table in tables]


def instead(module: Any, name: str, replacement: Any) -> Mutant:
    """Put another function in the place of one of the lifter's."""
    return [patch.object(module, name, replacement)]


def swap_logic(node: ast.BoolOp) -> None:
    node.op = ast.And() if isinstance(node.op, ast.Or) else node.op


def in_for_not_in(node: ast.Compare) -> None:
    node.ops = [ast.In() if isinstance(op, ast.NotIn) else op for op in node.ops]


def none_inverted(node: ast.Compare) -> None:
    node.ops = [ast.Is() if isinstance(op, ast.IsNot) else op for op in node.ops]


def strict_for_weak(node: ast.Compare) -> None:
    node.ops = [ast.Lt() if isinstance(op, ast.LtE) and not _between_sets(node) else op for op in node.ops]


def _between_sets(node: ast.Compare) -> bool:
    return "closed" in ast.unparse(node)


def last_comparison_lost(node: ast.Compare) -> None:
    node.ops, node.comparators = node.ops[:1], node.comparators[:1]


def last_part_lost(node: ast.BoolOp) -> None:
    node.values = node.values[:-1]


def branches_swapped(node: ast.IfExp) -> None:
    node.body, node.orelse = node.orelse, node.body


def operands_swapped(node: ast.BinOp) -> None:
    if isinstance(node.op, (ast.BitOr, ast.Sub)):
        node.left, node.right = node.right, node.left


def union_for_intersection(node: ast.BinOp) -> None:
    node.op = ast.BitOr() if isinstance(node.op, ast.BitAnd) else node.op


def filters_lost(node: Any) -> None:
    node.generators = [ast.comprehension(clause.target, clause.iter, [], clause.is_async) for clause in node.generators]


def default_lost(node: ast.Call) -> None:
    if isinstance(node.func, ast.Attribute) and node.func.attr == "get":
        node.args = node.args[:1]


def last_field_kept(node: ast.Call) -> None:
    if ast.unparse(node.func) == "replace":
        node.keywords = node.keywords[:-1]


def first_index(node: ast.Subscript) -> None:
    if isinstance(node.slice, ast.Constant):
        node.slice = ast.Constant(1)


def keyword_order(frame: Frame, node: ast.Call, env: Any, function: Any) -> Any:
    names = statements.parameters(frame.state, function)[0]
    every = [*node.args, *(keyword.value for keyword in node.keywords)]
    return dict(zip(names, [expressions.evaluate(frame, each, env) for each in every], strict=False)) | {
        "strict": False,
        "flag": statements.parameters(frame.state, function)[2].get("flag"),
    }


def wrong_case(self: State, truth: Any) -> Any:
    return truth if isinstance(truth, bool) or not self.path else True


def items_off(value: Any, method: str) -> Any:
    found = _map_range(value, method)
    if method != "items" or not isinstance(found, comprehensions.Range):
        return found
    return dataclasses.replace(
        found,
        gets=lambda *q: values.Tuple((values.unflat(found.kind, q), value.get(*reversed(q)))),
        has=lambda *q: not_(value.has(*q)),
    )


def never_resumed(frame: Frame, outcome: Any, rest: Any) -> Any:
    first = outcome
    while isinstance(first, statements.Branch):
        first = first.no
    return _resume(frame, first, rest)


def other_union(*parts: Any) -> Any:
    return and_(*parts)


_map_range = comprehensions._map_range
_resume = statements._resume
_quantified = comprehensions.quantified
_narrow = expressions.narrow
_before = scopes.FiniteScope.before

MUTANTS: dict[str, tuple[Callable[..., Any], Callable[[], Mutant]]] = {
    "or lifted as and": (harbour.either, lambda: reading(ast.BoolOp, swap_logic)),
    "last part of and, or lost": (harbour.either, lambda: reading(ast.BoolOp, last_part_lost)),
    "not in lifted as in": (harbour.three_parts, lambda: reading(ast.Compare, in_for_not_in)),
    "is not None lifted as is None": (harbour.some_last, lambda: reading(ast.Compare, none_inverted)),
    "<= lifted as <": (harbour.not_later, lambda: reading(ast.Compare, strict_for_weak)),
    "chain cut after its first part": (harbour.between, lambda: reading(ast.Compare, last_comparison_lost)),
    "branches of a conditional swapped": (harbour.chosen, lambda: reading(ast.IfExp, branches_swapped)),
    "operands of | and - swapped": (harbour.changed_slots, lambda: reading(ast.BinOp, operands_swapped)),
    "& lifted as |": (harbour.common, lambda: reading(ast.BinOp, union_for_intersection)),
    "filter of a set comprehension lost": (
        harbour.kept_berths,
        lambda: (
            reading(ast.SetComp, filters_lost)
            + instead(calls, "lift_setcomp", lambda f, n, e: comprehensions.lift_setcomp(f, _without_filters(n), e))
        ),
    ),
    "filter of a dict comprehension lost": (harbour.raised_everywhere, lambda: reading(ast.DictComp, filters_lost)),
    "filter of any and all lost": (
        harbour.all_stays_marked,
        lambda: instead(
            calls, "quantified", lambda f, n, e, universal: _quantified(f, _without_filters(n), e, universal)
        ),
    ),
    "any lifted as all": (
        harbour.any_closed,
        lambda: instead(calls, "quantified", lambda f, n, e, universal: _quantified(f, n, e, True)),
    ),
    "all lifted as any": (
        harbour.all_heavy,
        lambda: instead(calls, "quantified", lambda f, n, e, universal: _quantified(f, n, e, False)),
    ),
    "all without its range": (
        harbour.all_stays_marked,
        lambda: instead(comprehensions, "implies_", lambda guard, body: body),
    ),
    "default of get lost": (harbour.same_sets, lambda: reading(ast.Call, default_lost)),
    "last field of replace kept": (harbour.changed_slots, lambda: reading(ast.Call, last_field_kept)),
    "t[0] lifted as t[1]": (harbour.first_of_route, lambda: reading(ast.Subscript, first_index)),
    "m.items() of what is not in m": (
        harbour.stays_of_moored,
        lambda: instead(comprehensions, "_map_range", items_off),
    ),
    "keyword arguments by place": (harbour_steps.called, lambda: instead(calls, "_arguments", keyword_order)),
    "early return ignored": (harbour_steps.returned_early, lambda: instead(statements, "_resume", never_resumed)),
    "branches not joined": (
        harbour_steps.fell_through,
        lambda: instead(statements, "_joined", lambda test, one, other: one),
    ),
    "every if taken inside another": (harbour_steps.returned_early, lambda: instead(State, "decided", wrong_case)),
    "narrowing the wrong branch": (
        harbour_steps.port_maybe,
        lambda: (
            instead(expressions, "narrow", lambda test, env, holds: _narrow(test, env, not holds))
            + instead(statements, "narrow", lambda test, env, holds: _narrow(test, env, not holds))
        ),
    ),
    "None equals nothing": (harbour.no_last, lambda: instead(comparisons, "is_none", lambda value: False)),
    "Optional equal if both values are": (
        harbour.same_slot,
        lambda: instead(comparisons, "some", lambda value: values.ABSENT),
    ),
    "set equality by one inclusion": (
        harbour.same_sets,
        lambda: (
            instead(comparisons, "_agree", lambda frame, left, right: True)
            + instead(comparisons, "_included", lambda frame, left, right: True)
        ),
    ),
    "order reversed": (
        harbour.earlier,
        lambda: instead(
            scopes.FiniteScope, "before", lambda self, scalar, left, right: _before(self, scalar, right, left)
        ),
    ),
    "values of absent keys kept": (
        harbour.one_entry_read,
        lambda: (
            instead(values, "restrict", lambda value, present: value)
            + instead(calls, "restrict", lambda value, present: value)
        ),
    ),
    "old entry over the new one": (
        harbour.raised,
        lambda: instead(
            operators, "overlay", lambda present, value, below: below if below is not values.ABSENT else value
        ),
    ),
    "union of sets as intersection": (harbour.with_berth, lambda: instead(operators, "or_", other_union)),
    "member of a display is all of it": (harbour.with_berth, lambda: instead(values, "or_", other_union)),
    "branches of a merge swapped": (
        harbour.chosen,
        lambda: instead(values, "ite_", lambda condition, yes, no: ite_(condition, no, yes)),
    ),
    "guard of a comprehension as alternative": (harbour.berths_of, lambda: instead(comprehensions, "and_", or_)),
    "element of a comprehension not compared": (
        harbour.ships_seen,
        lambda: instead(comprehensions, "_equals", lambda frame, element, env, q: True),
    ),
    "definitions of changed components lost": (
        harbour_steps.enter,
        lambda: instead(scopes, "equal_terms", lambda left, right: True),
    ),
    "changed components shared": (
        harbour_steps.enter,
        lambda: instead(scopes.Scope, "_is_unchanged", lambda self, part, value, old: True),
    ),
}


def _without_filters(node: Any) -> Any:
    other = copy.copy(node)
    filters_lost(other)
    return other


@pytest.mark.parametrize("fault", MUTANTS)
def test_a_fault_in_the_lifter_is_noticed(fault: str) -> None:
    function, mutant = MUTANTS[fault]
    with ExitStack() as stack:
        for change in mutant():
            stack.enter_context(change)
        with pytest.raises((AssertionError, OutsideSubset, AttributeError, TypeError)):
            check_function(function, harbour.UNIVERSE, examples=100)
