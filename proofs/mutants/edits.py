"""Every single drop in a function: a guard, an operand, a condition, an update.

A mutant is named by its function and by the text that it drops, so that its name stays as long
as that text does.
"""

from __future__ import annotations

import ast
import copy
import importlib
import inspect
from collections.abc import Iterator, Mapping, Sequence
from contextlib import AbstractContextManager, nullcontext
from dataclasses import dataclass
from functools import cache
from types import ModuleType
from typing import Any

from proofs.lift.sources import Code, definition_of
from proofs.mutated import Sources

Place = tuple[tuple[str, int | None], ...]
"""The way from a function's tree down to a node: field by field, with the index in a list."""


@dataclass(frozen=True)
class Edit:
    """One drop: where, what kind, the text that goes, and what stands there instead (None: nothing does)."""

    place: Place
    kind: str
    text: str
    instead: ast.AST | None


@dataclass(frozen=True)
class Mutant:
    """A function with one drop."""

    function: Code
    kind: str
    text: str
    tree: ast.FunctionDef

    @property
    def home(self) -> str:
        """The function, by module and name."""
        return f"{self.function.__module__}.{self.function.__name__}"

    @property
    def name(self) -> str:
        """What identifies the mutant from one commit to the next."""
        return f"{self.home}: {self.kind} {self.text}"

    @property
    def sources(self) -> Sources:
        """The mutant, for the lifter and for CPython."""
        return {self.function: self.tree}

    @property
    def functions(self) -> tuple[Code, ...]:
        """The functions that are otherwise than they were."""
        return (self.function,)

    def touches(self, function: Code) -> bool:
        """Tell whether a function is another with it."""
        return function is self.function

    @property
    def is_of_a_module(self) -> bool:
        """Whether it is not in a function alone."""
        return False

    def planted(self) -> AbstractContextManager[None]:
        """What is to be so while the mutant is tried, beside its sources."""
        return nullcontext()


def functions_of(*modules: ModuleType) -> list[Code]:
    """The functions that modules define, in their order."""
    return [
        value
        for module in modules
        for value in vars(module).values()
        if inspect.isfunction(value) and value.__module__ == module.__name__
    ]


def mutants_of(function: Code) -> list[Mutant]:
    """Every mutant of a function; two edits to the same text are one, a repeated name gets a number."""
    own = definition_of(function)
    known = {normal(own)}
    found: list[Mutant] = []
    names: dict[str, int] = {}
    numbers = constants(own) if function.__module__.startswith("kernel.") else ()
    for edit in [*edits(own), *numbers]:
        tree = edited(own, edit)
        text = normal(tree)
        if text in known:
            continue
        known.add(text)
        key = f"{edit.kind} {edit.text}"
        names[key] = names.get(key, 0) + 1
        name = edit.text if names[key] == 1 else f"{edit.text} ({names[key]})"
        found.append(Mutant(function, edit.kind, name, tree))
    return found


@cache
def by_name(function: Code) -> Mapping[str, Mutant]:
    """Every mutant of a function by its name."""
    return {each.name: each for each in mutants_of(function)}


def named(name: str) -> Mutant:
    """The mutant of a function that has this name; ``KeyError`` if there is none any more."""
    module, _, function = name.partition(": ")[0].rpartition(".")
    try:
        code = getattr(importlib.import_module(module), function)
    except (ImportError, AttributeError, ValueError):
        raise KeyError(name) from None
    if not inspect.isfunction(code):
        raise KeyError(name)
    return by_name(code)[name]


def edited(tree: ast.FunctionDef, edit: Edit) -> ast.FunctionDef:
    """The tree with one edit; what does not lie on the way to it is shared."""
    changed = copy.copy(tree)
    node: Any = changed
    for field, index in edit.place[:-1]:
        below = copy.copy(getattr(node, field) if index is None else getattr(node, field)[index])
        _put(node, field, index, below)
        node = below
    field, index = edit.place[-1]
    _put(node, field, index, copy.deepcopy(edit.instead))
    return ast.fix_missing_locations(changed)


def _put(node: Any, field: str, index: int | None, below: Any) -> None:
    """Put something below a node; nothing takes an item out of a list."""
    if index is None:
        setattr(node, field, below)
    else:
        items = list(getattr(node, field))
        items[index : index + 1] = [] if below is None else [below]
        setattr(node, field, items)


def normal(tree: ast.FunctionDef) -> str:
    """The text of a function, an update of a field to its own value left out."""
    return ast.unparse(_WithoutIdleUpdates().visit(ast.parse(ast.unparse(tree))))


class _WithoutIdleUpdates(ast.NodeTransformer):
    def visit_Call(self, node: ast.Call) -> ast.AST:
        self.generic_visit(node)
        if isinstance(node.func, ast.Name) and node.func.id == "replace":
            record = ast.unparse(node.args[0])
            node.keywords = [word for word in node.keywords if ast.unparse(word.value) != f"{record}.{word.arg}"]
            return node if node.keywords else node.args[0]
        return node


def edits(tree: ast.FunctionDef) -> Iterator[Edit]:
    """Every edit of a function, from its first line to its last."""
    before = {
        ast.unparse(argument.annotation): argument.arg for argument in tree.args.args if argument.annotation is not None
    }
    for place, node in places(tree):
        for find in (*FINDERS, *RECKONING):
            yield from find(place, node)
        yield from made_anew(place, node, before)


def places(node: ast.AST, place: Place = ()) -> Iterator[tuple[Place, ast.AST]]:
    """Every node below a function's head, with the way to it."""
    yield place, node
    for field, value in ast.iter_fields(node):
        if field in ("args", "returns", "decorator_list") and not place:
            continue
        below: Sequence[Any] = value if isinstance(value, list) else [value]
        for index, child in enumerate(below):
            if isinstance(child, ast.AST):
                yield from places(child, (*place, (field, index if isinstance(value, list) else None)))


def guards(place: Place, node: ast.AST) -> Iterator[Edit]:
    """``if …: return …`` dropped."""
    if isinstance(node, ast.If) and isinstance(node.body[-1], ast.Return) and not node.orelse:
        outcome = ast.unparse(node.body[-1]).removeprefix("return ")
        yield Edit(place, "guard", f"if {ast.unparse(node.test)}: {outcome}", None)


def operands(place: Place, node: ast.AST) -> Iterator[Edit]:
    """One operand of ``and`` or ``or`` dropped."""
    if isinstance(node, ast.BoolOp):
        word = "and" if isinstance(node.op, ast.And) else "or"
        for operand in node.values:
            rest = [other for other in node.values if other is not operand]
            instead = rest[0] if len(rest) == 1 else ast.BoolOp(node.op, rest)
            yield Edit(place, f"{word}-operand", ast.unparse(operand), instead)


def conditions(place: Place, node: ast.AST) -> Iterator[Edit]:
    """A condition that a function returns, or that chooses, dropped: as if it always held."""
    if isinstance(node, ast.Return) and node.value is not None and _is_condition(node.value):
        yield Edit((*place, ("value", None)), "condition", ast.unparse(node.value), ast.Constant(True))
    if isinstance(node, ast.IfExp):
        yield Edit(place, "choice", f"{ast.unparse(node.test)} (always)", node.body)
        yield Edit(place, "choice", f"{ast.unparse(node.test)} (never)", node.orelse)


def filters(place: Place, node: ast.AST) -> Iterator[Edit]:
    """The ``if`` of a comprehension dropped."""
    if isinstance(node, ast.comprehension):
        for index, test in enumerate(node.ifs):
            yield Edit((*place, ("ifs", index)), "filter", ast.unparse(test), None)


def updates(place: Place, node: ast.AST) -> Iterator[Edit]:
    """One keyword of ``replace`` dropped; in a construction, a truth turned round or the old value kept."""
    if not isinstance(node, ast.Call) or not isinstance(node.func, ast.Name):
        return
    for index, keyword in enumerate(node.keywords):
        at = (*place, ("keywords", index))
        text = ast.unparse(keyword)
        if node.func.id == "replace":
            yield Edit(at, "update", text, None)
        elif isinstance(keyword.value, ast.Constant) and isinstance(keyword.value.value, bool):
            yield Edit((*at, ("value", None)), "update", text, ast.Constant(not keyword.value.value))
        elif node.func.id in KEEPING and keyword.arg is not None:
            kept = _field(KEEPING[node.func.id], keyword.arg)
            yield Edit((*at, ("value", None)), "update", text, kept)


def made_anew(place: Place, node: ast.AST, before: Mapping[str, str]) -> Iterator[Edit]:
    """One field of a state made anew by a function of such a state keeps its old value."""
    if isinstance(node, ast.Call) and isinstance(node.func, ast.Name) and node.func.id in before:
        for index, keyword in enumerate(node.keywords):
            if keyword.arg is not None:
                kept = _field(before[node.func.id], keyword.arg)
                yield Edit((*place, ("keywords", index), ("value", None)), "update", ast.unparse(keyword), kept)


def unions(place: Place, node: ast.AST) -> Iterator[Edit]:
    """One operand of a union of sets or maps dropped, or what a difference takes away."""
    if isinstance(node, ast.BinOp) and isinstance(node.op, (ast.BitOr, ast.Sub)):
        kind = "union" if isinstance(node.op, ast.BitOr) else "difference"
        yield Edit(place, kind, ast.unparse(node.right), node.left)
        if kind == "union":
            yield Edit(place, kind, ast.unparse(node.left), node.right)


def parts_of_chains(place: Place, node: ast.AST) -> Iterator[Edit]:
    """The first or the last part of ``a <= b <= c`` dropped."""
    if isinstance(node, ast.Compare) and len(node.ops) > 1:
        first = ast.Compare(node.left, node.ops[:1], node.comparators[:1])
        last = ast.Compare(node.comparators[-2], node.ops[-1:], node.comparators[-1:])
        yield Edit(
            place, "part", ast.unparse(first), ast.Compare(node.comparators[0], node.ops[1:], node.comparators[1:])
        )
        yield Edit(place, "part", ast.unparse(last), ast.Compare(node.left, node.ops[:-1], node.comparators[:-1]))


def limits(place: Place, node: ast.AST) -> Iterator[Edit]:
    """A limit, the other sign, or the rounding up of a quotient dropped."""
    if not isinstance(node, ast.Call) or not isinstance(node.func, ast.Name) or node.keywords:
        return
    text, word = ast.unparse(node), node.func.id
    match word, node.args:
        case (("smaller" | "larger"), [one, other]):
            yield Edit(place, "limit", f"{text} ({ast.unparse(one)})", one)
            yield Edit(place, "limit", f"{text} ({ast.unparse(other)})", other)
        case "limited", [value, least, most]:
            above = ast.IfExp(ast.Compare(value, [ast.Gt()], [least]), value, least)
            below = ast.IfExp(ast.Compare(value, [ast.Lt()], [most]), value, most)
            yield Edit(place, "limit", f"{text} (no most)", above)
            yield Edit(place, "limit", f"{text} (no least)", below)
        case "magnitude", [value]:
            yield Edit(place, "sign", text, value)
        case "divided_up", [value, by]:
            yield Edit(place, "rounding", text, ast.BinOp(value, ast.FloorDiv(), by))


def terms(place: Place, node: ast.AST) -> Iterator[Edit]:
    """One term of a sum dropped."""
    if isinstance(node, ast.BinOp) and isinstance(node.op, ast.Add):
        yield Edit(place, "term", ast.unparse(node.right), node.left)
        yield Edit(place, "term", ast.unparse(node.left), node.right)


def constants(tree: ast.FunctionDef) -> Iterator[Edit]:
    """Every integer constant of a function with another value: one more or less, ten times, a tenth, 0, its sign."""
    for place, node in places(tree):
        if not isinstance(node, (ast.expr, ast.keyword, ast.Return)):
            continue
        for field, value in ast.iter_fields(node):
            below = value if isinstance(value, list) else [value]
            for index, child in enumerate(below):
                if isinstance(child, ast.Constant) and type(child.value) is int:
                    at = (*place, (field, index if isinstance(value, list) else None))
                    for other in others(child.value):
                        text = f"{ast.unparse(node)}: {child.value} is {other}"
                        yield Edit(at, "constant", text, ast.parse(str(other), mode="eval").body)


def others(value: int) -> list[int]:
    """Give what stands in a constant's place, each once: one more, one less, ten times, a tenth, 0, the other sign."""
    found = (value + 1, value - 1, 10 * value, value // 10, 0, -value)
    return [each for each in dict.fromkeys(found) if each != value]


KEEPING = {"Centre": "centre", "Unit": "unit", "Terminal": "terminal"}
"""States that are made anew by a restart, and what the state before is called there."""

FINDERS = (guards, operands, conditions, filters, updates, unions)
RECKONING = (parts_of_chains, limits, terms)
"""What is dropped besides where integers are reckoned with."""


def _field(record: str, field: str) -> ast.expr:
    return ast.parse(f"{record}.{field}", mode="eval").body


def _is_condition(node: ast.expr) -> bool:
    if isinstance(node, (ast.BoolOp, ast.Compare)) or (isinstance(node, ast.UnaryOp) and isinstance(node.op, ast.Not)):
        return True
    return isinstance(node, ast.Call) and isinstance(node.func, ast.Name) and node.func.id in ("any", "all")
