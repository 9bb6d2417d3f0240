"""Which sort of thing a value in an axiom is, read off the types of the fields it came from."""

from __future__ import annotations

import ast
import typing
from collections.abc import Mapping
from functools import cache
from typing import Any

from kernel.layout import Layout
from kernel.names import Block, Point, Route, Tag
from models.ground import Ground
from models.layouts.axiom_code import Binder
from models.layouts.results import Imported

Sort = Any
"""A type as written in a field: ``Block``, ``Mapping[Route, Block]`` …, or none where not known."""


@cache
def _fields() -> Mapping[str, Mapping[str, Sort]]:
    return {"layout": typing.get_type_hints(Layout), "ground": typing.get_type_hints(Ground)}


def sort_of(node: ast.expr, variables: Mapping[str, Sort]) -> Sort:
    """The sort of an expression over ``layout``, ``ground`` and loop variables."""
    match node:
        case ast.Name(id=name):
            return variables.get(name)
        case ast.Attribute(value=ast.Name(id=("layout" | "ground") as whole), attr=field):
            return _fields()[whole].get(field)
        case ast.Subscript(value=inner) | ast.Call(func=ast.Attribute(value=inner, attr="get")):
            arguments = typing.get_args(sort_of(inner, variables))
            return arguments[-1] if len(arguments) == 2 else None
        case ast.BinOp(left=left):
            return sort_of(left, variables)
    return None


def member_of(sort: Sort) -> Sort:
    """What a loop over something of this sort runs through."""
    arguments = typing.get_args(sort)
    return arguments[0] if arguments else None


class Sorts:
    """Finds the input file's elements behind the values of one layout."""

    def __init__(self, imported: Imported) -> None:
        places = imported.places
        self.by_sort: Mapping[Sort, Mapping[Any, tuple[str, ...]]] = {
            Block: places.blocks,
            Route: places.routes,
            Point: places.points,
            Tag: places.tags,
        }

    def of_variable(self, name: str, binders: Mapping[str, Binder]) -> Sort:
        """The sort of a loop variable."""
        return self._variables(binders).get(name)

    def of_expression(self, text: str, binders: Mapping[str, Binder]) -> Sort:
        """The sort of an expression."""
        return sort_of(ast.parse(text, mode="eval").body, self._variables(binders))

    def _variables(self, binders: Mapping[str, Binder]) -> dict[str, Sort]:
        variables: dict[str, Sort] = {}
        for name, binder in binders.items():
            sort = sort_of(ast.parse(binder.source, mode="eval").body, variables)
            variables[name] = member_of(sort) if binder.loops else sort
        return variables

    def elements(self, sort: Sort, value: object) -> tuple[str, ...]:
        """The elements of the file that a value stands for; the value itself where none is known."""
        if not isinstance(value, str):
            return ()
        if sort in self.by_sort:
            return self.by_sort[sort].get(value, (value,))
        found = (places[value] for places in self.by_sort.values() if value in places)
        return next(found, ())
