"""Every machine on board does the same in CPython, compiled, and lifted; and a wrong compilation is noticed."""

from __future__ import annotations

import ast
from collections.abc import Callable
from functools import cache
from pathlib import Path
from types import ModuleType, SimpleNamespace
from typing import Any
from unittest.mock import patch

import numba
import pytest
from numba.core.errors import TypingError

from kernel.onboard import arithmetic, odometry
from models.compiled import NotCompilable, compile_machines, packed, records, unpacked
from models.compiled import machines as rewriting
from tests.onboard import gauge
from tests.onboard.agree import (
    Outcome,
    agree_along_runs,
    agree_in_logic,
    agree_on_values,
    functions,
    leaves_64_bits,
    machines,
    states_of,
    strays,
)

MODULES = [*machines(), gauge]
FUNCTIONS = {f"{each.__name__}.{name}": (each, name) for each in MODULES for name in functions(each)}
STATES = {f"{each.__name__}.{state.__name__}": (each, state) for each in MODULES for state in states_of(each)}
SAMPLES = 3000


@cache
def compiled(module: ModuleType) -> SimpleNamespace:
    """A module compiled; each by itself, so that one that cannot be does not hide the others."""
    found: SimpleNamespace = getattr(compile_machines([module]), module.__name__.rpartition(".")[2])
    return found


def test_machines_are_found() -> None:
    assert arithmetic in MODULES
    assert len(FUNCTIONS) > 10


@pytest.mark.sampled(5)
@pytest.mark.parametrize("name", FUNCTIONS)
def test_cpython_and_compiled_agree(name: str) -> None:
    module, function = FUNCTIONS[name]
    seen = agree_on_values(module, compiled(module), function, SAMPLES)
    assert seen[Outcome.AGREED] > SAMPLES // 2, f"hardly compared: {seen}"


@pytest.mark.sampled(3)
@pytest.mark.parametrize("name", STATES)
def test_cpython_and_compiled_agree_along_runs(name: str) -> None:
    module, state = STATES[name]
    assert agree_along_runs(module, compiled(module), state, runs=100, steps=40) > 1000


@pytest.mark.sampled(3)
@pytest.mark.parametrize("name", STATES)
def test_no_reading_of_64_bits_makes_a_machine_wrap_round(name: str) -> None:
    module, state = STATES[name]
    if module is not gauge:
        assert strays(module, compiled(module), state, runs=2000, steps=4) == []


@pytest.mark.sampled(5)
@pytest.mark.parametrize("name", FUNCTIONS)
def test_cpython_and_lifted_agree(name: str) -> None:
    module, function = FUNCTIONS[name]
    assert agree_in_logic(module, function, 25) > 5


# ---- a wrong compilation is noticed


def wrongly(change: Callable[[Any], Any]) -> Any:
    """Rewrite a construct as if another one stood there."""
    visit = rewriting.Rewriting.visit
    return patch.object(rewriting.Rewriting, "visit", lambda self, node: change(visit(self, node)))


def expression(source: str) -> ast.expr:
    return ast.parse(source, mode="eval").body


def truncated(node: Any) -> Any:
    if not isinstance(node, ast.BinOp) or not isinstance(node.op, ast.FloorDiv | ast.Mod):
        return node
    one, other = f"({ast.unparse(node.left)})", f"({ast.unparse(node.right)})"
    quotient = f"({one} // {other} if ({one} < 0) == ({other} < 0) else -(-{one} // {other}))"
    return expression(quotient if isinstance(node.op, ast.FloorDiv) else f"{one} - {other} * {quotient}")


def strict(node: Any) -> Any:
    if isinstance(node, ast.Compare):
        node.ops = [ast.Lt() if isinstance(op, ast.LtE) else op for op in node.ops]
    return node


def chain_cut(node: Any) -> Any:
    if isinstance(node, ast.Compare):
        node.ops, node.comparators = node.ops[:1], node.comparators[:1]
    return node


def and_for_or(node: Any) -> Any:
    if isinstance(node, ast.BoolOp):
        node.op = ast.And()
    return node


def sign_lost(node: Any) -> Any:
    return node.operand if isinstance(node, ast.UnaryOp) and isinstance(node.op, ast.USub) else node


def branches_swapped(node: Any) -> Any:
    return ast.IfExp(node.test, node.orelse, node.body) if isinstance(node, ast.IfExp) else node


def as_written(self: Any, node: Any, cls: Any, arguments: list[Any], given: dict[Any, Any]) -> list[ast.expr]:
    return [*arguments, *given.values(), *(ast.Constant(0) for _ in records.hints_of(cls))][
        : len(records.hints_of(cls))
    ]


def without_else(self: Any, node: ast.stmt) -> Any:
    if isinstance(node, ast.If):
        node.orelse = []
    return _statement(self, node)


_statement = rewriting.Rewriting._statement
_replacement = rewriting.replacement
_njit = numba.njit

FAULTS: dict[str, tuple[str, Callable[[], Any]]] = {
    "quotient cut towards 0": ("rounded", lambda: wrongly(truncated)),
    "<= compiled as <": ("is_between", lambda: wrongly(strict)),
    "chain cut after its first part": ("is_between", lambda: wrongly(chain_cut)),
    "or compiled as and": ("gauged", lambda: wrongly(and_for_or)),
    "sign lost": ("rounded", lambda: wrongly(sign_lost)),
    "branches of a conditional swapped": ("started_over", lambda: wrongly(branches_swapped)),
    "else lost": ("gauged", lambda: patch.object(rewriting.Rewriting, "_statement", without_else)),
    "fields in the order written": ("gauged", lambda: patch.object(rewriting.Rewriting, "_fields", as_written)),
    "replaced fields mixed up": (
        "emptied",
        lambda: patch.object(rewriting, "replacement", lambda fields: _replacement(fields[::-1])),
    ),
    "members numbered from the end": (
        "level_at",
        lambda: patch.object(rewriting, "number_of", lambda member: 2 - records.number_of(member)),
    ),
    "a constant mistaken": (
        "started_over",
        lambda: patch.object(rewriting, "packed", lambda value: packed(value) if value != gauge.Level.GOOD else 0),
    ),
    "a divisor of 0 let pass": (
        "shared",
        lambda: patch.object(numba, "njit", _njit(error_model="numpy")),
    ),
}


@pytest.mark.parametrize("fault", FAULTS)
def test_a_wrong_compilation_is_noticed(fault: str) -> None:
    name, change = FAULTS[fault]
    with change():
        wrong = compile_machines([gauge]).gauge
    with pytest.raises((AssertionError, TypingError)):
        agree_on_values(gauge, wrong, name, SAMPLES)


def test_a_wrong_compilation_of_a_real_machine_is_noticed_along_runs() -> None:
    with wrongly(truncated):
        wrong = compile_machines([odometry]).odometry
    with pytest.raises(AssertionError):
        agree_along_runs(odometry, wrong, odometry.Motion, runs=100, steps=40)


def test_a_machine_that_wraps_round_is_noticed() -> None:
    assert strays(gauge, compiled(gauge), gauge.Gauge, runs=2000, steps=4) != []


def test_a_value_beyond_64_bits_is_watched() -> None:
    assert leaves_64_bits(arithmetic.divided_up, (records.LEAST, 1))
    assert not leaves_64_bits(arithmetic.divided_up, (records.LEAST + 1, 1))
    with pytest.raises(OverflowError):
        packed(records.MOST + 1)


# ---- values and refusals


def test_a_state_comes_back_as_it_went() -> None:
    state = gauge.Gauge(gauge.Scale((1, 2, 3), inverted=True), -5, (6, 7), gauge.Level.HIGH, False)
    assert packed(state) == (((1, 2, 3), 7, True), -5, (6, 7), 2, False)
    assert unpacked(packed(state), gauge.Gauge) == state
    with pytest.raises(TypeError, match="cannot be handed"):
        packed("high")
    with pytest.raises(AssertionError):
        unpacked(packed(state.scale), gauge.Gauge)
    with pytest.raises(AssertionError):
        unpacked(1, bool)


REFUSED = {
    "a loop": ("def f(x: int) -> int:\n    while x < 3:\n        x = x + 1\n    return x", 2, "While"),
    "a changed name": ("def f(x: int) -> int:\n    x += 1\n    return x", 2, "AugAssign"),
    "a call of a builtin": ("def f(x: int) -> int:\n    return max(x, 1)", 2, "max"),
    "a method": ("def f(x: int) -> int:\n    return x.bit_length()", 2, "x.bit_length"),
    "a division that leaves the integers": ("def f(x: int, y: int) -> bool:\n    return x / y < 2", 2, "Div"),
    "a text": ('def f(x: int) -> bool:\n    return x == "a"', 2, "'a'"),
    "a large number": ("def f(x: int) -> bool:\n    return x < 9223372036854775808", 2, "9223372036854775808"),
    "a large constant": ("LARGE = 2**63\ndef f(x: int) -> bool:\n    return x < LARGE", 3, "LARGE"),
    "None": ("def f(x: int) -> bool:\n    return x == None", 2, "None"),
    "identity": ("def f(x: bool, y: bool) -> bool:\n    return x is y", 2, "Is"),
    "a result of unknown type": ("def f(x: int) -> set[int]:\n    return g(x)", 1, "set"),
    "a parameter that may be absent": ("def f(x: int | None) -> int:\n    return 1", 1, "None"),
    "more parameters": ("def f(*x: int) -> int:\n    return 1", 1, "parameter"),
    "no result": ("def f(x: int) -> int:\n    return", 2, "nothing"),
    "an enumeration as a value": ("def f(x: int) -> int:\n    return g(Colour)", 2, "Colour"),
    "a class that changes": ("class C:\n    x: int", 1, "C"),
    "a field of unknown type": ("@dataclass(frozen=True)\nclass C:\n    x: int\n    y: float", 4, "float"),
    "a method of a record": (
        "@dataclass(frozen=True)\nclass C:\n    def f(self) -> int:\n        return 1",
        3,
        "field",
    ),
    "a local unset on one path": (
        "LIMIT = 3\ndef f(x: bool) -> int:\n    if x:\n        LIMIT = 4\n    return LIMIT",
        5,
        "not set on every path",
    ),
    "a local by the name of a function": ("def g() -> int:\n    return 1\ndef f(g: int) -> int:\n    return g", 3, "g"),
    "a parameter by the name of any": ("def f(any: int) -> int:\n    return any", 1, "any"),
    "a field left out of comparison": (
        "from dataclasses import field\n@dataclass(frozen=True)\nclass C:\n    x: int = field(compare=False)",
        3,
        "compare=False",
    ),
    "a field given by name only": (
        "@dataclass(frozen=True, kw_only=True)\nclass C:\n    x: int",
        2,
        "by name only",
    ),
    "a record of its own equality": (
        "@dataclass(frozen=True, eq=False)\nclass C:\n    x: int",
        2,
        "eq=False",
    ),
    "members that are numbers": ("from enum import IntEnum\nclass C(IntEnum):\n    A = 1", 2, "numbers"),
    "a member of two names": ("class C(Enum):\n    A = 1\n    B = 1", 1, "C.B"),
    "a loop outside": ("for x in (1, 2):\n    pass", 1, "For"),
}


@pytest.mark.parametrize("what", REFUSED)
def test_what_is_not_known_is_refused_with_file_and_line(what: str, tmp_path: Path) -> None:
    source, line, named = REFUSED[what]
    path = tmp_path / "refused.py"
    head = "from enum import Enum\nfrom dataclasses import dataclass\nclass Colour(Enum):\n    RED = 1\n"
    path.write_text(head + source, "utf-8")
    module = ModuleType("tests.refused")
    module.__file__ = str(path)
    with patch.dict("sys.modules", {"tests.refused": module}):
        exec(compile(path.read_text("utf-8"), str(path), "exec"), vars(module))
        with pytest.raises(NotCompilable) as refusal:
            compile_machines([module])
    assert str(refusal.value).startswith(f"{path}:{line + 4}: ")
    assert named in str(refusal.value)
