"""One function of a machine, three ways: CPython, compiled, and lifted to logic, on random values of its types.

Nothing here knows a machine: values are drawn by the annotations, so whatever stands in a module is compared.
"""

from __future__ import annotations

import ast
import importlib
import inspect
import pkgutil
import typing
from collections import Counter
from collections.abc import Callable, Iterator
from enum import Enum
from functools import cache
from pathlib import Path
from random import Random
from types import ModuleType, SimpleNamespace
from typing import Any

import kernel.onboard
from models.compiled import packed, unpacked
from models.compiled.records import LEAST, MOST, hints_of, is_enumeration, is_record
from proofs.lift import FiniteScope, Lifter, concretise, embed
from tests.lift.differential import Symbols

Code = Callable[..., Any]
ELSEWHERE = {
    "kernel.onboard.authority_end": "speaks of blocks, by maps",
    "kernel.onboard.frames": "bits and bytes of a telegram, with loops",
}
"""Modules of the on-board unit that are no scalar machines, and why."""
WRITTEN = ("Bounds", "Limits", "Feature")
"""How the names of the records end that are written down for a train or a line, and are no readings."""


def machines() -> list[ModuleType]:
    """Every scalar machine on board."""
    found = [each.name for each in pkgutil.iter_modules(kernel.onboard.__path__, "kernel.onboard.")]
    return [importlib.import_module(name) for name in found if name not in ELSEWHERE]


def functions(module: ModuleType) -> dict[str, Code]:
    """The functions that are written in a module."""
    return {
        name: value
        for name, value in vars(module).items()
        if inspect.isfunction(value) and value.__module__ == module.__name__
    }


@cache
def types_of(function: Code) -> tuple[dict[str, Any], Any]:
    """The types of a function's parameters, by name, and of its result."""
    hints = typing.get_type_hints(function)
    result = hints.pop("return")
    return hints, result


# ---- values by type


class Draw:
    """Draws values of any type that a machine may have.

    An int is near another of the same draw, near a constant of the module, an edge, or of a random size; so
    that what is compared is often equal, or apart by one.
    """

    def __init__(self, random: Random, module: ModuleType) -> None:
        self._random = random
        written = [node.value for node in ast.walk(source_of(module)) if isinstance(node, ast.Constant)]
        constants = {value for value in [*written, *vars(module).values()] if type(value) is int}
        self._constants = sorted({0, 1, *constants})
        self._edges = sorted({LEAST, MOST, *self._constants, *(-value for value in self._constants)})
        self.begin()

    def begin(self) -> None:
        """Forget the ints drawn so far, and choose how large most ints are from now on."""
        self._near: list[int] = []
        self._bits = self._random.choice((2, 4, 8, 12, 16, 20, 30, 62))

    def value(self, type_: Any, whole: Callable[[], int] | None = None) -> Any:
        """Draw a value, with its ints drawn by ``whole``, or of any size."""
        if type_ is bool:
            return self._random.random() < 0.7
        if type_ is int:
            return (whole or self.any)()
        if is_enumeration(type_):
            return self._random.choice(list(type_))
        if is_record(type_):
            return type_(**{name: self.value(hint, whole) for name, hint in hints_of(type_).items()})
        assert typing.get_origin(type_) is tuple, f"no values of type {type_} are known"
        return tuple(self.value(item, whole) for item in typing.get_args(type_))

    def any(self) -> int:
        """Draw an int of any size."""
        kind = self._random.random()
        if kind < 0.3 and self._near:
            found = self._random.choice(self._near) + self._random.randint(-1, 1)
        elif kind < 0.45:
            found = self._random.choice(self._edges) + self._random.randint(-1, 1)
        else:
            found = self._random.getrandbits(self._random.randint(1, self._bits))
            found = -found if self._random.random() < 0.2 else found
        found = max(LEAST, min(MOST, found))
        self._near.append(found)
        return found

    def tame(self) -> int:
        """Draw an int as it is written for a train or a line: 0 or more; often one that the module names."""
        if self._random.random() < 0.5:
            return self._random.choice([value for value in self._constants if value <= 2**13])
        return self._random.getrandbits(self._random.randint(1, 13))

    def read(self) -> int:
        """Draw an int as a sensor gives it: tame, or at the edge of 64 bits, or anything."""
        kind = self._random.random()
        if kind < 0.7:
            return self.tame()
        return self._random.choice((LEAST, LEAST, LEAST + 1, MOST - 1, MOST)) if kind < 0.9 else self.any()


def source_of(module: ModuleType) -> ast.Module:
    """The syntax tree of a module."""
    return ast.parse(Path(str(inspect.getsourcefile(module))).read_text("utf-8"))


# ---- 64 bits


class Watched(int):
    """An int that remembers, for all of them, whether a result did not fit 64 bits."""

    beyond = False


def _watched(name: str) -> Code:
    plain = getattr(int, name)

    def operator(*operands: int) -> Any:
        found = plain(*operands)
        if isinstance(found, int):
            Watched.beyond |= not LEAST <= found <= MOST
            return Watched(found)
        return found

    return operator


for _name in ("add", "sub", "mul", "floordiv", "mod"):
    setattr(Watched, f"__{_name}__", _watched(f"__{_name}__"))
    setattr(Watched, f"__r{_name}__", _watched(f"__r{_name}__"))
Watched.__neg__ = _watched("__neg__")  # type: ignore[method-assign]


def watched(value: Any) -> Any:
    """The same value with every int in it watched."""
    if isinstance(value, Enum | bool):
        return value
    if isinstance(value, int):
        return Watched(value)
    if isinstance(value, tuple):
        return tuple(watched(item) for item in value)
    cls: Any = type(value)
    return cls(**{name: watched(getattr(value, name)) for name in hints_of(cls)})


def leaves_64_bits(function: Code, arguments: tuple[Any, ...]) -> bool:
    """Whether an intermediate value, or the result, does not fit."""
    Watched.beyond = False
    function(*(watched(argument) for argument in arguments))
    return Watched.beyond


# ---- CPython and compiled


class Outcome(Enum):
    """How one comparison came out; a disagreement is an AssertionError."""

    AGREED = "the same value"
    BEYOND = "an intermediate value left 64 bits, and the results differ"
    OUTSIDE = "an assert of the machine speaks against these arguments, or a divisor of 0"


def compare(function: Code, compiled: Code, arguments: tuple[Any, ...]) -> tuple[Outcome, Any, Any]:
    """Call both with the same arguments; also return what each gave."""
    try:
        expected = function(*arguments)
    except AssertionError:
        return Outcome.OUTSIDE, None, None
    except ZeroDivisionError:
        assert _raises(compiled, arguments), f"{function.__name__}{arguments} divides by 0, compiled it does not"
        return Outcome.OUTSIDE, None, None
    try:
        given = compiled(*(packed(argument) for argument in arguments))
        found = unpacked(given, types_of(function)[1])
    except ZeroDivisionError:
        given = found = None
    if found == expected:
        return Outcome.AGREED, expected, given
    assert leaves_64_bits(function, arguments), f"{function.__name__}{arguments}: {expected}, compiled {found}"
    return Outcome.BEYOND, None, None


def _raises(compiled: Code, arguments: tuple[Any, ...]) -> bool:
    try:
        compiled(*(packed(argument) for argument in arguments))
    except ZeroDivisionError:
        return True
    return False


def agree_on_values(module: ModuleType, compiled: SimpleNamespace, name: str, samples: int) -> Counter[Outcome]:
    """Compare one function on independent arguments."""
    function = functions(module)[name]
    draw = Draw(Random(name), module)
    types, _ = types_of(function)
    seen: Counter[Outcome] = Counter()
    for _ in range(samples):
        draw.begin()
        arguments = tuple(draw.value(type_) for type_ in types.values())
        seen[compare(function, getattr(compiled, name), arguments)[0]] += 1
    return seen


def states_of(module: ModuleType) -> list[type]:
    """The records that some function of a module both takes and returns."""
    found = [types_of(function) for function in functions(module).values()]
    return list(dict.fromkeys(result for types, result in found if is_record(result) and result in types.values()))


def ways_to(module: ModuleType, state: type) -> tuple[dict[str, list[Any]], dict[str, list[Any]]]:
    """The functions that give a state without one, and those that make one of one, with their parameters' types."""
    found = {name: types_of(function) for name, function in functions(module).items()}
    ways = {name: list(types.values()) for name, (types, result) in found.items() if result is state}
    begins = {name: types for name, types in ways.items() if state not in types}
    return begins, {name: types for name, types in ways.items() if name not in begins}


def agree_along_runs(module: ModuleType, compiled: SimpleNamespace, state: type, runs: int, steps: int) -> int:
    """Let both go on from the same state, each from its own; return how many steps they went.

    Half of the other records are those of the step before: bounds, and readings that repeat. A run begins
    where a function says that the machine begins, if there is one, or in any state.
    """
    random = Random(state.__name__)
    draw = Draw(random, module)
    begins, goes_on = ways_to(module, state)
    gone = 0
    for _ in range(runs):
        draw.begin()
        held: dict[Any, Any] = {state: draw.value(state)}
        own: Any = packed(held[state])
        for step in range(steps):
            name, types = random.choice(list((begins if begins and step == 0 else goes_on).items()))
            for type_ in types:
                if is_record(type_) and type_ is not state and (type_ not in held or random.random() < 0.5):
                    held[type_] = draw.value(type_)
            arguments = tuple(held[type_] if is_record(type_) else draw.value(type_) for type_ in types)
            outcome, expected, _ = compare(functions(module)[name], getattr(compiled, name), arguments)
            if outcome is not Outcome.AGREED:
                break
            given = [own if type_ is state else packed(each) for type_, each in zip(types, arguments, strict=True)]
            own = getattr(compiled, name)(*given)
            held[state] = expected
            assert own == packed(expected), f"after {gone} steps, {name}: {expected}, compiled {own}"
            gone += 1
    return gone


def strays(module: ModuleType, compiled: SimpleNamespace, state: type, runs: int, steps: int) -> list[str]:
    """The calls at which a machine leaves 64 bits to its harm, whatever its readings are.

    What is written down is drawn tame; so are plain ints, which come from other machines, and the state where
    nothing says how the machine begins. Only functions that no other of the module calls are the machine's edge.
    """
    random = Random(state.__name__)
    draw = Draw(random, module)
    begins, goes_on = ways_to(module, state)
    within = {
        node.func.id
        for node in ast.walk(source_of(module))
        if isinstance(node, ast.Call) and isinstance(node.func, ast.Name)
    }
    edge = {name: types for name, types in goes_on.items() if name not in within}
    found = []
    for _ in range(runs if edge else 0):
        held = {type_: draw.value(type_, draw.tame) for type_ in (each for types in edge.values() for each in types)}
        for step in range(steps):
            draw.begin()
            first = begins and step == 0
            name, types = random.choice(list((begins if first else edge).items()))
            arguments = tuple(
                held[type_]
                if type_ is state or is_written(type_)
                else draw.value(type_, draw.read if is_record(type_) and not first else draw.tame)
                for type_ in types
            )
            outcome, expected, _ = compare(functions(module)[name], getattr(compiled, name), arguments)
            if outcome is not Outcome.AGREED:
                found.append(f"{name}{arguments}")
                break
            held[state] = expected
    return found


def is_written(type_: Any) -> bool:
    """Whether a record's ranges are the operator's duty."""
    return is_record(type_) and type_.__name__.endswith(WRITTEN)


# ---- CPython and lifted


def agree_in_logic(module: ModuleType, name: str, samples: int) -> int:
    """Compare a function with its formulas, of constants and of symbols; return how many values were compared."""
    function = functions(module)[name]
    draw = Draw(Random(name), module)
    types, result = types_of(function)
    scope = FiniteScope.of_universe({})
    symbols = Symbols(function, {})
    compared = 0
    for arguments in _drawn(draw, list(types.values()), samples):
        try:
            expected = function(*arguments)
        except (AssertionError, ZeroDivisionError):
            continue
        values = [embed(scope, argument, type_) for argument, type_ in zip(arguments, types.values(), strict=True)]
        found = concretise(None, scope, Lifter(scope).call(function, *values), result)
        assert found == expected, f"{name}{arguments}: {expected}, lifted {found}"
        symbols.check(arguments, expected)
        compared += 1
    return compared


def _drawn(draw: Draw, types: list[Any], samples: int) -> Iterator[tuple[Any, ...]]:
    for _ in range(samples):
        draw.begin()
        yield tuple(draw.value(type_) for type_ in types)
