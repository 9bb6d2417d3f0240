"""Which functions of the project a function calls, and which transitions it takes part in."""

from __future__ import annotations

import ast
from functools import cache
from types import FunctionType, ModuleType
from typing import Any

from proofs.lift.sources import Code, definition_of
from proofs.theories import THEORIES, row_of


@cache
def called_by(function: Code) -> frozenset[Code]:
    """Give the functions of the project that this one calls, and those that they call."""
    return frozenset(found for target in calls(function) for found in (target, *called_by(target)))


def calls(function: Code) -> frozenset[Code]:
    """Give the functions of the project that this one calls itself."""
    found = [_resolved(function, node) for node in ast.walk(definition_of(function))]
    return frozenset(
        target
        for target in found
        if isinstance(target, FunctionType) and target.__module__.split(".")[0] in ("kernel", "models", "proofs")
    )


def _resolved(function: Code, node: ast.AST) -> Any:
    """Give the object that a name, or a name in a module, stands for."""
    if isinstance(node, ast.Name):
        return function.__globals__.get(node.id)
    if isinstance(node, ast.Attribute) and isinstance(node.value, ast.Name):
        owner = function.__globals__.get(node.value.id)
        return getattr(owner, node.attr, None) if isinstance(owner, ModuleType) else None
    return None


@cache
def transitions_of(function: Code) -> tuple[str, ...]:
    """Give the rows of the transitions that a function takes part in, the one it is first."""
    return tuple(
        row_of(theory, name)
        for theory in THEORIES.values()
        for name, step in theory.steps.items()
        if step is function or function in called_by(step)
    )
