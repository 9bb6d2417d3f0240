"""A function with another body: for CPython while a block lasts, for the lifter as a syntax tree.

All who call the function see the other body, since its code object is exchanged in place.
"""

from __future__ import annotations
import __future__

import ast
from collections.abc import Callable, Iterator, Mapping
from contextlib import contextmanager
from functools import cache, wraps
from types import CodeType
from typing import Any

from proofs.lift.sources import Code, definition_of, file_of

Sources = Mapping[Code, ast.FunctionDef]
"""Functions, and the syntax trees that stand for their own."""


@cache
def code_of(function: Code, tree: ast.FunctionDef) -> CodeType:
    """Compile a body for a function: same names, same file, same lines."""
    module = ast.fix_missing_locations(ast.Module([tree], []))
    flags = __future__.annotations.compiler_flag
    place: dict[str, Any] = {}
    exec(compile(module, file_of(function), "exec", flags, dont_inherit=True), dict(function.__globals__), place)
    code: CodeType = place[tree.name].__code__
    return code


@contextmanager
def running(sources: Sources) -> Iterator[None]:
    """Run these functions with the bodies given, until the block ends."""
    before = {function: function.__code__ for function in sources}
    for function, tree in sources.items():
        definition_of(function)
        function.__code__ = code_of(function, tree)
    try:
        yield
    finally:
        for function, code in before.items():
            function.__code__ = code


def table_running(table: Mapping[str, Callable[..., Any]], sources: Sources) -> dict[str, Callable[..., Any]]:
    """A table of functions, each run with the bodies given while it lasts."""

    def replaced(function: Callable[..., Any]) -> Callable[..., Any]:
        @wraps(function)
        def run(*values: Any, **named: Any) -> Any:
            with running(sources):
                return function(*values, **named)

        return run

    return {name: replaced(function) for name, function in table.items()}
