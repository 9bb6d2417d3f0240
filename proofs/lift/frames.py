"""Where the lifter is: the function, the assumptions on the way, the obligations met."""

from __future__ import annotations

import ast
import builtins
import inspect
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from dataclasses import dataclass, field
from enum import Enum, EnumType
from types import FunctionType, MappingProxyType, ModuleType
from typing import Any, NamedTuple

import z3

from proofs.lift.errors import OutsideSubset
from proofs.lift.kinds import check_class, fields_of
from proofs.lift.scopes import Scope
from proofs.lift.sources import Code, check_names, definition_of, file_of
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
    flat,
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
    checked: set[Code] = field(default_factory=set)

    def definition(self, function: Code) -> ast.FunctionDef:
        """Return the syntax tree of a function, or of the mutant that stands for it, its names checked."""
        mutant = self.sources.get(function)
        if mutant is None:
            return definition_of(function)
        if function not in self.checked:
            check_names(mutant, function)
            self.checked.add(function)
        return mutant

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
        return self.state.definition(self.function)

    def outside(self, node: ast.AST, what: str, hint: str) -> OutsideSubset:
        """Return the error that says that a construct is outside the subset."""
        line = getattr(node, "lineno", 0) or self.definition.lineno
        return OutsideSubset(file_of(self.function), line, what, hint)

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

    def key(self, value: Value, node: ast.AST) -> Value:
        """Return a value that is to be an element or a key: nothing in it may be ``None`` here."""
        value = self.unwrap(value, node)
        if isinstance(value, Absent):
            return value
        defined = flat(value)[0]
        self.require(defined, node)
        return ABSENT if defined is False else value

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
            return attribute_of(self.global_object(node.value, env), node.attr)
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
        if type(value) is frozenset:
            items = tuple(self._constant_key(item, node) for item in sorted(value, key=repr))
            return listed_set(self.scope.kind_of(items[0]), items) if items else EMPTY_SET
        if is_plain_map(value):
            entries = tuple((self._constant_key(k, node), self.literal(v, node)) for k, v in value.items())
            return listed_map(self.scope.kind_of(entries[0][0]), entries) if entries else EMPTY_MAP
        cls: Any = type(value)
        if hasattr(cls, "__dataclass_fields__"):
            check_class(cls)
            return Record(cls, {name: self.literal(getattr(value, name), node) for name in fields_of(cls)})
        raise self.outside(
            node,
            f"constant {value!r} of type {type(value).__name__} is outside the subset",
            "constants are bool, int, None, enum members, and frozen collections and records of them",
        )

    def _constant_key(self, value: Any, node: ast.AST) -> Value:
        """Lift an element or a key of a constant, in which nothing is ``None``."""
        key = self.literal(value, node)
        if flat(key)[0] is not True:
            raise self.outside(node, f"a constant set or map with the key {value!r}", "keys without None")
        return key


def attribute_of(owner: Any, name: str) -> Any:
    """Return what a module or a class has by a name without running code; MISSING if nothing."""
    if isinstance(owner, ModuleType):
        return vars(owner).get(name, MISSING)
    if isinstance(owner, EnumType):
        return owner.__members__.get(name, MISSING)
    if isinstance(owner, type) and type(owner) is type:
        found = inspect.getattr_static(owner, name, MISSING)
        if isinstance(found, staticmethod):
            return found.__func__
        return found if isinstance(found, FunctionType) or not hasattr(type(found), "__get__") else MISSING
    return MISSING


def is_plain_map(value: Any) -> bool:
    """Whether a constant is a dict, or a view of one: other maps find, unite and compare by rules of their own."""
    if isinstance(value, MappingProxyType):
        value = value.copy()
    return type(value) is dict
