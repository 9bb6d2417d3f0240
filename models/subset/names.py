"""Whether every name of a function means what it seems to where it stands.

Python decides by the whole function which names are local to it: one that some path sets is local on every path,
and read before it is set it is an error, though a constant of the module has the same name.
"""

from __future__ import annotations

import ast
from collections.abc import Iterator, Sequence
from types import FunctionType
from typing import NamedTuple


class UnfitName(NamedTuple):
    """Where a name stands, why it cannot be read, and what to write instead."""

    node: ast.AST
    what: str
    hint: str


def unfit_name(tree: ast.FunctionDef, function: FunctionType | None = None) -> UnfitName | None:
    """Say which name of a function does not mean what it seems to; None if all do.

    ``function`` is what the text was made into, if it was: it tells the variables of a function around it.
    """
    around = function.__code__.co_freevars if function is not None else ()
    if around:
        what = f"{', '.join(around)}: a variable of the function around {tree.name}"
        return UnfitName(tree, what, "a parameter, or a constant of the module")
    if getattr(tree, "type_params", None):
        return UnfitName(tree, f"{tree.name} has type parameters of its own", "a type of the module")
    return next(_Names(tree).problems(), None)


Known = frozenset[str] | None
"""The names that are set whenever a place is reached; None if it is never reached."""


class _Names:
    """The names of one function, followed along its paths."""

    def __init__(self, tree: ast.FunctionDef) -> None:
        self.tree = tree
        every = tree.args
        parameters = [*every.posonlyargs, *every.args, *every.kwonlyargs, every.vararg, every.kwarg]
        self.parameters = frozenset(each.arg for each in parameters if each is not None)
        self.local = self.parameters | frozenset(_set_in(tree.body))

    def problems(self) -> Iterator[UnfitName]:
        """Go through every name that is read."""
        found: list[UnfitName] = []
        for node in ast.walk(self.tree):
            if isinstance(node, ast.Name) and node.id.startswith("__"):
                hint = "a name that does not begin with two underscores"
                yield UnfitName(node, f"{node.id} may mean another name within a class, or how Python runs", hint)
        self._after(self.tree.body, self.parameters, found)
        yield from found

    def _after(self, statements: Sequence[ast.stmt], known: Known, found: list[UnfitName]) -> Known:
        """Return what is set after some statements."""
        for node in statements:
            if known is None:
                return None
            if isinstance(node, ast.If):
                found += self._read(node.test, known, self.local)
                known |= frozenset(_set_in([node.test]))
                yes, no = self._after(node.body, known, found), self._after(node.orelse, known, found)
                known = no if yes is None else yes if no is None else yes & no
            else:
                if _is_followed(node):
                    found += self._read(node, known, self.local)
                known = None if isinstance(node, ast.Return) else known | frozenset(_set_in([node]))
        return known

    def _read(self, node: ast.AST, known: frozenset[str], local: frozenset[str]) -> Iterator[UnfitName]:
        """Go through what a node reads, where these names are set, of those that are local."""
        if isinstance(node, ast.Name):
            if isinstance(node.ctx, ast.Load) and node.id in local and node.id not in known:
                hint = "set it on every path that leads here, or give it a name that the module has not"
                yield UnfitName(node, f"{node.id} is not set on every path", hint)
        elif isinstance(node, ast.ListComp | ast.SetComp | ast.DictComp | ast.GeneratorExp):
            yield from self._comprehension(node, known, local)
        elif isinstance(node, ast.AnnAssign):
            if node.value is None:
                yield UnfitName(node, f"{ast.unparse(node)} sets nothing", "one target and one value")
            else:
                yield from self._read(node.value, known, local)
        else:
            for child in ast.iter_child_nodes(node):
                yield from self._read(child, known, local)

    def _comprehension(
        self,
        node: ast.ListComp | ast.SetComp | ast.DictComp | ast.GeneratorExp,
        known: frozenset[str],
        local: frozenset[str],
    ) -> Iterator[UnfitName]:
        """Its variables are its own, set one ``for`` after the other; its first range is of the outside."""
        yield from self._read(node.generators[0].iter, known, local)
        own = frozenset(_set_in([each.target for each in node.generators]))
        local, known = local | own, known - own
        for index, each in enumerate(node.generators):
            if index:
                yield from self._read(each.iter, known, local)
            known |= frozenset(_set_in([each.target]))
            for test in each.ifs:
                yield from self._read(test, known, local)
        given = [node.key, node.value] if isinstance(node, ast.DictComp) else [node.elt]
        for part in given:
            yield from self._read(part, known, local)


def _is_followed(node: ast.stmt) -> bool:
    """Whether a statement is one of the subset; every reader refuses the others, and says so better."""
    simple = isinstance(node, ast.Return | ast.Assign | ast.AnnAssign | ast.Assert | ast.Expr)
    return simple and not any(isinstance(each, ast.NamedExpr) for each in ast.walk(node))


def _set_in(nodes: Sequence[ast.AST]) -> Iterator[str]:
    """The names that some nodes set, those of comprehensions within left out."""
    for node in nodes:
        if isinstance(node, ast.Name):
            if not isinstance(node.ctx, ast.Load):
                yield node.id
        elif isinstance(node, ast.FunctionDef | ast.AsyncFunctionDef | ast.ClassDef):
            yield node.name
        elif isinstance(node, ast.ListComp | ast.SetComp | ast.DictComp | ast.GeneratorExp):
            walrus = [each.target for each in ast.walk(node) if isinstance(each, ast.NamedExpr)]
            yield from _set_in(walrus)
        elif not isinstance(node, ast.Lambda):
            yield from _set_in(list(ast.iter_child_nodes(node)))
