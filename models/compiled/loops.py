"""What goes through a map, ``any``, ``all`` and a new map of its entries, as a function with a loop.

The function takes the map, and every local name of the one in which it stood that it reads.
"""

from __future__ import annotations

import ast
from collections.abc import Iterable
from dataclasses import dataclass
from typing import Any

from numba.typed import List

TypedList: Any = List
LIST = "__TypedList"
"""By this name a loop finds numba's list."""
MAP, MADE = "__map", "__made"
"""Names within a loop; none of a machine begins so."""


def locals_of(tree: ast.FunctionDef) -> frozenset[str]:
    """Return every name that is a parameter, assigned to, or bound by a loop, in a function."""
    names = (each for each in ast.walk(tree) if isinstance(each, ast.Name) and isinstance(each.ctx, ast.Store))
    return frozenset([*(each.arg for each in tree.args.args), *(each.id for each in names)])


def problem_of(generators: list[ast.comprehension]) -> str | None:
    """Say why these cannot be compiled, if they cannot."""
    if len(generators) != 1 or generators[0].is_async:
        return "more than one for in one expression cannot be compiled"
    target, over = generators[0].target, generators[0].iter
    if not (
        isinstance(over, ast.Call)
        and isinstance(over.func, ast.Attribute)
        and over.func.attr == "items"
        and not over.args
        and not over.keywords
    ):
        return "to go through anything but .items() cannot be compiled"
    if not isinstance(target, ast.Tuple) or len(target.elts) != 2:
        return "an entry is a key and a value"
    if not all(isinstance(each, ast.Name) for each in target.elts):
        return "a key or a value taken apart cannot be compiled"
    return None


@dataclass(frozen=True)
class Loop:
    """One of them, rewritten: ``kind`` is any, all or map; ``names`` are key and value."""

    kind: str
    names: tuple[str, ...]
    conditions: list[ast.expr]
    each: ast.expr

    def free(self, local: frozenset[str]) -> list[str]:
        """Return the names that it reads from around it."""
        read = {
            node.id
            for part in (*self.conditions, self.each)
            for node in ast.walk(part)
            if isinstance(node, ast.Name) and isinstance(node.ctx, ast.Load)
        }
        return sorted((read & local) - set(self.names))

    def function(self, name: str, free: Iterable[str]) -> ast.FunctionDef:
        """Return the function."""
        parameters = [ast.arg(MAP), *(ast.arg(each) for each in free)]
        arguments = ast.arguments(posonlyargs=[], args=parameters, kwonlyargs=[], kw_defaults=[], defaults=[])
        inner = self._body()
        for test in reversed(self.conditions):
            inner = [ast.If(test, inner, [])]
        target = ast.Tuple([ast.Name(each, ast.Store()) for each in self.names], ast.Store())
        loop = ast.For(target, ast.Name(MAP, ast.Load()), inner, [])
        return ast.FunctionDef(name=name, args=arguments, body=self._around(loop), decorator_list=[])

    def _body(self) -> list[ast.stmt]:
        if self.kind == "any":
            return [ast.If(self.each, [ast.Return(ast.Constant(True))], [])]
        if self.kind == "all":
            return [ast.If(ast.UnaryOp(ast.Not(), self.each), [ast.Return(ast.Constant(False))], [])]
        entry = ast.Tuple([ast.Name(self.names[0], ast.Load()), self.each], ast.Load())
        append = ast.Attribute(ast.Name(MADE, ast.Load()), "append", ast.Load())
        return [ast.Expr(ast.Call(append, [entry], []))]

    def _around(self, loop: ast.For) -> list[ast.stmt]:
        if self.kind == "map":
            begin = ast.Assign([ast.Name(MADE, ast.Store())], ast.Call(ast.Name(LIST, ast.Load()), [], []))
            return [begin, loop, ast.Return(ast.Name(MADE, ast.Load()))]
        return [loop, ast.Return(ast.Constant(self.kind == "all"))]
