"""What is mutated, and which transitions each function takes part in."""

from __future__ import annotations

import ast
import importlib
import pkgutil
from collections.abc import Iterator, Mapping
from functools import cache
from types import FunctionType, ModuleType
from typing import Any

import kernel
import models.world
from proofs.catalogue import STEPS
from proofs.lift.sources import Code, definition_of
from proofs.mutants.edits import Mutant, functions_of, mutants_of

NOT_STEPS = frozenset(
    {
        "kernel.maps",
        "kernel.persistence",
        "kernel.tags",
        "models.world.formations",
        "models.world.premises",
        "models.world.start",
    }
)
"""Modules that no transition is made of: what a state is kept in, tables, tag records, premises, the start."""


def modules() -> list[ModuleType]:
    """The modules that transitions are made of."""
    names = [f"{room.__name__}.{found.name}" for room in (kernel, models.world) for found in _inside(room)]
    return [importlib.import_module(name) for name in names if name not in NOT_STEPS]


def _inside(room: ModuleType) -> Iterator[pkgutil.ModuleInfo]:
    return pkgutil.iter_modules(room.__path__)


@cache
def mutants() -> Mapping[str, Mutant]:
    """Every mutant by name."""
    return {mutant.name: mutant for function in functions_of(*modules()) for mutant in mutants_of(function)}


@cache
def called_by(function: Code) -> frozenset[Code]:
    """The functions of the project that this one calls, and those that they call."""
    found: set[Code] = set()
    for node in ast.walk(definition_of(function)):
        target = _resolved(function, node)
        if isinstance(target, FunctionType) and target.__module__.split(".")[0] in ("kernel", "models"):
            found |= {target, *called_by(target)}
    return frozenset(found)


def _resolved(function: Code, node: ast.AST) -> Any:
    """The object that a name, or a name in a module, stands for."""
    if isinstance(node, ast.Name):
        return function.__globals__.get(node.id)
    if isinstance(node, ast.Attribute) and isinstance(node.value, ast.Name):
        owner = function.__globals__.get(node.value.id)
        return getattr(owner, node.attr, None) if isinstance(owner, ModuleType) else None
    return None


@cache
def transitions_of(function: Code) -> tuple[str, ...]:
    """The transitions that a function takes part in, the one it is first."""
    return tuple(name for name, step in STEPS.items() if step is function or function in called_by(step))
