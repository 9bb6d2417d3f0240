"""The source text of a function, with its true line numbers."""

from __future__ import annotations

import ast
import inspect
import textwrap
from collections.abc import Callable
from functools import cache
from types import FunctionType
from typing import Any

from models.subset import unfit_name
from proofs.lift.errors import OutsideSubset

Code = Callable[..., Any]


def file_of(function: Code) -> str:
    """Return the file that a function stands in."""
    return function.__code__.co_filename


@cache
def definition_of(function: Code) -> ast.FunctionDef:
    """Return the syntax tree of a function."""
    file, line = file_of(function), function.__code__.co_firstlineno
    if hasattr(function, "__wrapped__"):
        raise OutsideSubset(file, line, f"{function.__name__} is wrapped by a decorator", "decorate without wrapping")
    try:
        text, first = inspect.getsourcelines(function)
        tree = ast.parse(textwrap.dedent("".join(text))).body[0]
    except (OSError, SyntaxError, TypeError) as error:
        raise OutsideSubset(
            file, line, f"no source of {function.__name__}: {error}", "define it by def in a file"
        ) from None
    ast.increment_lineno(tree, first - 1)
    if not isinstance(tree, ast.FunctionDef) or tree.name != function.__name__:
        raise OutsideSubset(file, line, f"{function.__name__} is no plain function", "define it by def, without yield")
    check_names(tree, function)
    return tree


def check_names(tree: ast.FunctionDef, function: Code) -> None:
    """Refuse a function, or a mutant that stands for it, in which a name means something else than it seems to."""
    unfit = unfit_name(tree, function if isinstance(function, FunctionType) else None)
    if unfit is not None:
        raise OutsideSubset(
            file_of(function), getattr(unfit.node, "lineno", tree.lineno), f"{unfit.what}: {tree.name}", unfit.hint
        )
