"""Constants of the kernel's modules with other values: integers, and what stands in a record or a tuple.

A constant is changed as an edit of its line would change it: for the kernel's functions and for whoever
else imports it.  A claim or an assumption that reads it becomes another with it, and then says nothing of it; only
what states its own number can notice.
"""

from __future__ import annotations

import ast
import dataclasses
import inspect
import sys
from collections import Counter
from collections.abc import Iterator, Mapping, Sequence
from contextlib import contextmanager
from dataclasses import dataclass
from functools import cache
from types import ModuleType
from typing import Any

from proofs.lift.sources import Code, definition_of
from proofs.mutants.edits import Mutant, others

ROOMS = ("kernel", "models", "proofs")
"""Whose modules may read a constant."""

Binding = tuple[str, str]
"""A module by name, and the name that a constant has in it."""


@dataclass(frozen=True)
class Constant(Mutant):
    """A constant of a module with another value; ``function`` is the first that reads it.

    ``readers``: every function of kernel and worlds that does.
    """

    module: str
    constant: str
    value: Any
    readers: tuple[Code, ...]

    @property
    def home(self) -> str:
        """The constant, by module and name."""
        return f"{self.module}.{self.constant}"

    @property
    def functions(self) -> tuple[Code, ...]:
        """The functions that the constant is read by."""
        return self.readers

    @property
    def sources(self) -> Mapping[Code, ast.FunctionDef]:
        """No function has another body."""
        return {}

    def touches(self, function: Code) -> bool:
        """Tell whether a function, a predicate too, reads the constant."""
        return reads(function, self.module, self.constant)

    @property
    def is_of_a_module(self) -> bool:
        """It is read when functions are lifted, so nothing lifted before can be used."""
        return True

    @contextmanager
    def planted(self) -> Iterator[None]:
        """Let the constant have its other value until the block ends, wherever it is read."""
        with everywhere(self.module, self.constant, self.value):
            yield


@contextmanager
def everywhere(module: str, name: str, value: Any) -> Iterator[None]:
    """Let a constant have another value until the block ends, in every module that reads it."""
    before: list[tuple[ModuleType, str, Any]] = []
    try:
        _plant(module, name, value, before)
        yield
    finally:
        for owner, known, kept in reversed(before):
            setattr(owner, known, kept)


def _plant(module: str, name: str, value: Any, before: list[tuple[ModuleType, str, Any]]) -> None:
    """Set a constant in every module that has it, and what modules reckon from it."""
    for home, known in bindings(module, name):
        owner = sys.modules[home]
        before.append((owner, known, getattr(owner, known)))
        setattr(owner, known, value)
        for derived, reckoned in assigned(owner).items():
            if derived != known and any(isinstance(each, ast.Name) and each.id == known for each in ast.walk(reckoned)):
                anew = eval(compile(ast.Expression(reckoned), home, "eval"), vars(owner))
                if anew != getattr(owner, derived):
                    _plant(home, derived, anew, before)


@cache
def _tree(module: ModuleType) -> ast.Module:
    return ast.parse(inspect.getsource(module))


@cache
def assigned(module: ModuleType) -> Mapping[str, ast.expr]:
    """Give what a module assigns at its top to names written as constants are."""
    found: dict[str, ast.expr] = {}
    for node in _tree(module).body:
        if isinstance(node, ast.Assign | ast.AnnAssign) and node.value is not None:
            for target in node.targets if isinstance(node, ast.Assign) else [node.target]:
                if isinstance(target, ast.Name) and target.id.lstrip("_").isupper():
                    found[target.id] = node.value
    return found


@cache
def bindings(module: str, name: str) -> tuple[Binding, ...]:
    """Give the modules loaded that have a constant, its own first, and what they call it."""
    found: dict[Binding, None] = {(module, name): None}
    todo = [(module, name)]
    while todo:
        home, known = todo.pop()
        for here in imported().get((home, known), ()):
            if here not in found and hasattr(sys.modules[here[0]], here[1]):
                found[here] = None
                todo.append(here)
    return tuple(found)


@cache
def imported() -> Mapping[Binding, list[Binding]]:
    """Give, for each name of a module, the modules that import it from there, and what they call it."""
    found: dict[Binding, list[Binding]] = {}
    for module in rooms():
        for node in ast.walk(_tree(module)):
            if isinstance(node, ast.ImportFrom):
                for alias in node.names:
                    here = (module.__name__, alias.asname or alias.name)
                    found.setdefault((node.module or "", alias.name), []).append(here)
    return found


def rooms() -> list[ModuleType]:
    """Give the modules of this project that are loaded."""
    return [
        module
        for name, module in sorted(sys.modules.items())
        if name.split(".")[0] in ROOMS and getattr(module, "__file__", None)
    ]


def constants_of(module: ModuleType, readable: Sequence[Code]) -> list[Mutant]:
    """Give every constant of a module with each of its other values, if a function reads it."""
    found: list[Mutant] = []
    for name, written in assigned(module).items():
        readers = tuple(each for each in readable if reads(each, module.__name__, name))
        for text, value in values(module, name, written) if readers else ():
            tree = definition_of(readers[0])
            found.append(Constant(readers[0], "value", text, tree, module.__name__, name, value, readers))
    return found


def values(module: ModuleType, name: str, written: ast.expr) -> Iterator[tuple[str, Any]]:
    """Give the other values of a constant: of an integer as it is, of a record by each number and truth in it."""
    value = getattr(module, name)
    if type(value) is int:
        for other in others(value):
            yield f"{value} is {other}", other
    if not dataclasses.is_dataclass(value) and not isinstance(value, tuple):
        return
    times: Counter[str] = Counter()
    for node in [each for each in ast.walk(written) if isinstance(each, ast.Constant)]:
        kept = node.value
        for other in (not kept,) if isinstance(kept, bool) else others(kept) if isinstance(kept, int) else ():
            text = f"{ast.unparse(written)}: {kept!r} is {other!r}"
            times[text] += 1
            node.value = other
            anew = eval(compile(ast.Expression(written), module.__name__, "eval"), vars(module))
            node.value = kept
            yield text if times[text] == 1 else f"{text} ({times[text]})", anew


def reads(function: Code, module: str, name: str) -> bool:
    """Tell whether a function reads a constant, or one that is reckoned from it."""
    return not reckoned_from(module, name).isdisjoint(read_by(function))


@cache
def read_by(function: Code) -> frozenset[Binding]:
    """Give every name that a function reads, as its module's or as another's."""
    found: set[Binding] = set()
    for node in ast.walk(definition_of(function)):
        if isinstance(node, ast.Name):
            found.add((function.__module__, node.id))
        elif isinstance(node, ast.Attribute) and isinstance(node.value, ast.Name):
            owner = function.__globals__.get(node.value.id)
            if isinstance(owner, ModuleType):
                found.add((owner.__name__, node.attr))
    return frozenset(found)


@cache
def reckoned_from(module: str, name: str) -> frozenset[Binding]:
    """Give every binding of a constant, and of what is reckoned from it."""
    found: set[Binding] = set()
    todo = [(module, name)]
    while todo:
        place = todo.pop()
        if place in found:
            continue
        for home, known in bindings(*place):
            found.add((home, known))
            todo += [
                (home, derived)
                for derived, value in assigned(sys.modules[home]).items()
                if (home, derived) not in found
                and any(isinstance(each, ast.Name) and each.id == known for each in ast.walk(value))
            ]
    return frozenset(found)
