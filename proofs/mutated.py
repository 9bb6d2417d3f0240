"""A function with another body: for CPython while a block lasts, for the lifter as a syntax tree.

All who call the function see the other body, since its code object is exchanged in place.
"""

from __future__ import annotations

import __future__

import ast
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from types import CodeType
from typing import Any

from proofs.lift.sources import Code, definition_of, file_of

Sources = Mapping[Code, ast.FunctionDef]
"""Functions, and the syntax trees that stand for their own."""


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
        function.__code__ = code_of(function, tree)  # type: ignore[attr-defined]
    try:
        yield
    finally:
        for function, code in before.items():
            function.__code__ = code  # type: ignore[attr-defined]


def body(function: Code, text: str) -> ast.FunctionDef:
    """Give the tree of a function whose text is written down elsewhere, at the place of the function."""
    tree = ast.parse(text).body[0]
    own = definition_of(function)
    if not isinstance(tree, ast.FunctionDef) or ast.unparse(tree.args) != ast.unparse(own.args):
        raise ValueError(f"{function.__name__}: not a function of the same parameters")
    tree.name = own.name
    return ast.increment_lineno(tree, own.lineno - tree.lineno)
