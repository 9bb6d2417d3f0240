"""Functions written as text: a file for each, arguments drawn by their types, CPython against the lifter."""

from __future__ import annotations

import importlib.util
import sys
from collections.abc import Iterator
from itertools import count
from pathlib import Path
from random import Random
from types import ModuleType
from typing import Any

import z3

from proofs.lift import FiniteScope, Lifter, Mismatch, Obligation, Value, concretise, embed
from proofs.lift.comparisons import equal
from proofs.lift.frames import Frame, State
from proofs.lift.kinds import (
    BOOL,
    INT,
    Kind,
    MapKind,
    OptionKind,
    RecordKind,
    Scalar,
    SetKind,
    TupleKind,
    fields_of,
    kind_of_type,
)
from proofs.lift.terms import to_z3
from proofs.lift.values import Record, equal_scalars, is_term
from tests.lift.differential import PARTIAL, Code, can_fail, pinned, types_of
from tests.lift.strategies import Universe

_numbers = count()


def module_of(text: str, folder: Path) -> ModuleType:
    """Write a text to a file and import it under a name that no other module has."""
    name = f"written_{next(_numbers)}"
    file = folder / f"{name}.py"
    file.write_text(text, "utf-8")
    spec = importlib.util.spec_from_file_location(name, file)
    assert spec is not None
    assert spec.loader is not None
    module = importlib.util.module_from_spec(spec)
    sys.modules[name] = module  # dataclasses look their annotations up there
    try:
        spec.loader.exec_module(module)
    except BaseException:
        del sys.modules[name]
        raise
    return module


class Draw:
    """Draws values of a kind: small, so that two of them are often equal."""

    def __init__(self, random: Random, universe: Universe, largest: int = 3) -> None:
        self.random, self.universe, self.largest = random, universe, largest

    def of_type(self, type_: Any) -> Any:
        """Draw a value of a type."""
        return self.of(kind_of_type(type_))

    def of(self, kind: Kind) -> Any:
        """Draw a value of a kind."""
        match kind:
            case Scalar():
                return self._scalar(kind)
            case OptionKind(inner):
                return None if self.random.random() < 0.35 else self.of(inner)
            case TupleKind(items):
                return tuple(self.of(item) for item in items)
            case RecordKind(cls):
                return cls(**{name: self.of(field) for name, field in fields_of(cls).items()})
            case SetKind(element):
                return frozenset(self.of(element) for _ in range(self.random.randint(0, self.largest)))
            case MapKind(key, value):
                return {self.of(key): self.of(value) for _ in range(self.random.randint(0, self.largest))}

    def _scalar(self, scalar: Scalar) -> Any:
        if scalar == BOOL:
            return self.random.random() < 0.5
        if scalar == INT:
            return self.random.randint(-7, 7) if self.random.random() < 0.3 else self.random.randint(-2, 3)
        return self.random.choice(list(scalar.source) if scalar.is_enum else list(self.universe[scalar.source]))


class Compared:
    """A function in CPython, lifted from concrete arguments, and lifted once from symbols; records also by name.

    Where CPython raises, an obligation must fail; where every obligation holds, the values must be equal.
    """

    def __init__(self, function: Code, scope: FiniteScope) -> None:
        self.function, self.scope = function, scope
        self.types, self.result = types_of(function)
        self.symbols = [self.scope.fresh(each, f"argument{index}") for index, each in enumerate(self.types)]
        lifter = Lifter(self.scope, collect=True)
        self.lifted, self.obligations = lifter.call(function, *self.symbols), list(lifter.obligations)
        self.named, self.definitions = self._named()
        self.axioms = [axiom.formula for axiom in self.scope.axioms()]
        self.failing = 0

    def _named(self) -> tuple[Value | None, list[Any]]:
        """Give what changed of a record symbols of its own, as the proofs do."""
        if not isinstance(self.lifted, Record):
            return None, []
        alike = [symbol for symbol, each in zip(self.symbols, self.types, strict=True) if each is self.result]
        named, definitions = self.scope.name(self.lifted, "post", relative_to=alike[0] if alike else None)
        return named, [definition.formula for definition in definitions]

    def check(self, arguments: tuple[Any, ...]) -> None:
        """Compare all ways for these arguments.

        Raises:
            Disagreement: CPython and the lifter differ.
        """
        try:
            expected, error = self.function(*arguments), None
        except PARTIAL as raised:
            expected, error = None, raised
        for lifted, obligations, known in self._ways(arguments):
            if any(can_fail(each.claim, known) for each in obligations):
                self.failing += 1
            elif error is not None:
                raise Disagreement(f"{arguments}: {error!r}, and no obligation fails of {lifted}")
            elif can_fail(to_z3(self._equal(lifted, expected)), known):
                raise Disagreement(f"{arguments}: {expected} in CPython, lifted {self._shown(lifted)}")

    def _ways(self, arguments: tuple[Any, ...]) -> Iterator[tuple[Value, list[Obligation], list[Any]]]:
        lifter = Lifter(self.scope, collect=True)
        values = [embed(self.scope, one, each) for one, each in zip(arguments, self.types, strict=True)]
        yield lifter.call(self.function, *values), lifter.obligations, []
        pins = [
            pin
            for symbol, value, each in zip(self.symbols, values, self.types, strict=True)
            for pin in pinned(self.scope, symbol, value, kind_of_type(each))
        ]
        known = [*self.axioms, *pins]
        assert can_fail(z3.BoolVal(False), known), "no state has these arguments: two symbols share a name"
        yield self.lifted, self.obligations, known
        if self.named is not None:
            yield self.named, self.obligations, [*known, *self.definitions]

    def _equal(self, lifted: Value, expected: Any) -> Any:
        kind = kind_of_type(self.result)
        if isinstance(kind, Scalar) and is_term(lifted):
            return equal_scalars(lifted, self.scope.literal(kind, expected))
        frame = Frame(State(self.scope, {}, False), self.function)
        return equal(frame, lifted, embed(self.scope, expected, self.result))

    def _shown(self, lifted: Value) -> Any:
        try:
            return concretise(None, self.scope, lifted, self.result)
        except (Mismatch, AttributeError, ValueError):
            return lifted


class Disagreement(AssertionError):
    """CPython and the lifter differ."""
