"""What is outside the subset is refused, with file, line and a hint; nothing is guessed."""

from __future__ import annotations

import inspect
from collections.abc import Callable
from typing import Any, get_type_hints

import pytest

from proofs.lift import FiniteScope, Lifter, OutsideSubset, UnboundedScope
from proofs.lift.kinds import kind_of_type
from proofs.lift.scopes import Scope
from tests.lift import outside
from tests.lift.harbour import UNIVERSE, Harbour


def line_marked(function: Callable[..., Any]) -> int:
    lines, first = inspect.getsourcelines(function)
    return first + next(index for index, line in enumerate(lines) if "# here" in line)


def arguments_of(function: Callable[..., Any], scope: Scope) -> list[Any]:
    hints = get_type_hints(function)
    names = [name for name in inspect.signature(function).parameters if name not in ("found", "berths")]
    return [scope.fresh(hints[name], name) for name in names]


@pytest.mark.parametrize("function", outside.REFUSED, ids=lambda function: function.__name__)
@pytest.mark.parametrize("scope", [UnboundedScope(), FiniteScope.of_universe(UNIVERSE)], ids=["unbounded", "finite"])
def test_refused_with_file_and_line(function: Callable[..., Any], scope: Scope) -> None:
    with pytest.raises(OutsideSubset) as refusal:
        Lifter(scope).call(function, *arguments_of(function, scope))
    assert refusal.value.file == outside.__file__
    assert refusal.value.line == line_marked(function)
    assert refusal.value.hint
    assert f"{outside.__file__}:{refusal.value.line}: " in str(refusal.value)


def test_a_wrapped_function_is_refused() -> None:
    scope = UnboundedScope()
    with pytest.raises(OutsideSubset, match="wrapped by a decorator"):
        Lifter(scope).call(outside.wrapped, scope.fresh(Harbour, "harbour"))


def test_a_lambda_is_refused() -> None:
    with pytest.raises(OutsideSubset, match="no plain function"):
        Lifter(UnboundedScope()).call(lambda: True)


@pytest.mark.parametrize(
    "type_",
    [outside.Thawed, outside.Checked, outside.Floating, outside.Counted, list[int], dict[str, int], str],
)
def test_a_type_outside_the_subset_is_refused(type_: Any) -> None:
    with pytest.raises(OutsideSubset, match="outside the subset"):
        UnboundedScope().fresh(type_, "value")


def test_a_refused_field_names_its_class() -> None:
    with pytest.raises(OutsideSubset) as refusal:
        UnboundedScope().fresh(outside.Floating, "value")
    assert refusal.value.file == outside.__file__
    assert refusal.value.line == inspect.getsourcelines(outside.Floating)[1]


def test_kinds_are_read_once() -> None:
    assert kind_of_type(Harbour) is kind_of_type(Harbour)
