"""Where the lifter is: the function, the assumptions on the way, the obligations met."""

from __future__ import annotations

import ast
import builtins
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from dataclasses import dataclass, field
from enum import Enum
from typing import Any, NamedTuple

import z3

from proofs.lift.errors import OutsideSubset
from proofs.lift.scopes import Scope
from proofs.lift.sources import Code, definition_of, file_of
from proofs.lift.terms import Truth, and_, implies_, not_, same, to_z3
from proofs.lift.values import (
    ABSENT,
    EMPTY_MAP,
    EMPTY_SET,
    NOTHING,
    Absent,
    Mismatch,
    Nothing,
    Option,
    Record,
    Tuple,
    Value,
    listed_map,
    listed_set,
    name_of,
)

Env = dict[str, Value]
"""The local variables; a value may also be a tree of cases."""


class Missing:
    """No such Python object."""


MISSING = Missing()


class Obligation(NamedTuple):
    """What a partial operation needs where it stands, given the way there."""

    path: Any
    needed: Any
    file: str
    line: int
    text: str

    @property
    def claim(self) -> Any:
        """The formula to be proved; its free constants are arbitrary."""
        return to_z3(implies_(self.path, self.needed))


@dataclass
class State:
    """What one lifter carries from call to call."""

    scope: Scope
    sources: Mapping[Code, ast.FunctionDef]
    collect: bool
    obligations: list[Obligation] = field(default_factory=list)
    path: tuple[Truth, ...] = ()
    calls: tuple[Code, ...] = ()

    @contextmanager
    def assuming(self, *truths: Truth) -> Iterator[None]:
        """Lift under these assumptions."""
        before = self.path
        self.path = (*before, *(truth for truth in truths if truth is not True))
        try:
            yield
        finally:
            self.path = before

    @contextmanager
    def deferred(self, path: tuple[Truth, ...]) -> Iterator[None]:
        """Lift what was met earlier under ``path``, where its obligations were collected once for all."""
        before = self.path, self.collect
        self.path, self.collect = path, False
        try:
            yield
        finally:
            self.path, self.collect = before

    def decided(self, truth: Truth) -> Truth:
        """Return the truth, or True or False if the assumptions contain it or its negation."""
        if isinstance(truth, bool):
            return truth
        negation = not_(truth)
        for assumed in self.path:
            if same(assumed, truth):
                return True
            if same(assumed, negation):
                return False
        return truth


@dataclass(frozen=True)
class Frame:
    """One function being lifted."""

    state: State
    function: Code

    @property
    def scope(self) -> Scope:
        """The scope of the lifter."""
        return self.state.scope

    @property
    def definition(self) -> ast.FunctionDef:
        """The syntax tree of the function, or of the mutant that stands for it."""
        return self.state.sources.get(self.function) or definition_of(self.function)

    def outside(self, node: ast.AST, what: str, hint: str) -> OutsideSubset:
        """Return the error that says that a construct is outside the subset."""
        return OutsideSubset(file_of(self.function), getattr(node, "lineno", self.definition.lineno), what, hint)

    @contextmanager
    def at(self, node: ast.AST) -> Iterator[None]:
        """Say where two values did not go together."""
        try:
            yield
        except Mismatch as mismatch:
            raise self.outside(node, f"{mismatch}: {ast.unparse(node)}", "make both sides the same type") from None

    def require(self, needed: Truth, node: ast.AST) -> None:
        """Collect an obligation."""
        state = self.state
        if not state.collect or needed is True:
            return
        path = to_z3(and_(*state.path))
        line = getattr(node, "lineno", 0)
        state.obligations.append(Obligation(path, to_z3(needed), file_of(self.function), line, ast.unparse(node)))

    def unwrap(self, value: Value, node: ast.AST) -> Value:
        """Return a value that must not be ``None`` here."""
        if isinstance(value, Nothing):
            self.require(False, node)
            return ABSENT
        if isinstance(value, Option):
            self.require(not_(value.is_none), node)
            return value.value
        return value

    def truth(self, value: Value, node: ast.AST) -> Truth:
        """Return a value that must be a bool."""
        if isinstance(value, (bool, z3.BoolRef)):
            return value
        if isinstance(value, Absent):
            return False
        raise self.outside(
            node,
            f"{ast.unparse(node)} is used as a condition but is no bool ({name_of(value)})",
            "write the comparison out: `x is not None`, `any(True for x in s)`, `n != 0`",
        )

    def global_object(self, node: ast.expr, env: Env) -> Any:
        """Return the Python object that a name or a dotted name stands for, MISSING if none."""
        if isinstance(node, ast.Name) and node.id not in env:
            names: Mapping[str, Any] = self.function.__globals__
            return names.get(node.id, getattr(builtins, node.id, MISSING))
        if isinstance(node, ast.Attribute):
            owner = self.global_object(node.value, env)
            if owner is not MISSING and (isinstance(owner, type) or type(owner).__name__ == "module"):
                return getattr(owner, node.attr, MISSING)
        return MISSING

    def literal(self, value: Any, node: ast.AST) -> Value:
        """Lift a Python constant."""
        if value is None:
            return NOTHING
        if isinstance(value, bool):
            return value
        if isinstance(value, Enum):
            return self.scope.member(value)
        if type(value) is int:
            return z3.IntVal(value)
        if type(value) is tuple:
            return Tuple(tuple(self.literal(item, node) for item in value))
        if isinstance(value, frozenset):
            items = tuple(self.literal(item, node) for item in value)
            return listed_set(self.scope.kind_of(items[0]), items) if items else EMPTY_SET
        if isinstance(value, Mapping):
            entries = tuple((self.literal(k, node), self.literal(v, node)) for k, v in value.items())
            return listed_map(self.scope.kind_of(entries[0][0]), entries) if entries else EMPTY_MAP
        if hasattr(type(value), "__dataclass_fields__") and not isinstance(value, type):
            names = type(value).__dataclass_fields__
            return Record(type(value), {name: self.literal(getattr(value, name), node) for name in names})
        raise self.outside(
            node,
            f"constant {value!r} of type {type(value).__name__} is outside the subset",
            "constants are bool, int, None, enum members, and frozen collections and records of them",
        )
