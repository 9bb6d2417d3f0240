"""What a predicate says, as logic: read from its syntax tree, never written by hand.

A predicate of site and system is printed without these two: ``system.track.at`` is ``track.at``.  What stands before
an arrow is what Python excludes first, ``not a or b`` is ``a → b``; a long line is broken as lists of ∧ or ∨.
"""

from __future__ import annotations

import ast
import inspect
from collections.abc import Callable, Mapping, Sequence
from dataclasses import replace
from types import ModuleType
from typing import Any

from evidence.report.terms import (
    FALSE,
    TRUE,
    Applied,
    Atom,
    Chosen,
    Entry,
    Field,
    Let,
    Listed,
    Negated,
    Product,
    Quantified,
    Related,
    Sum,
    Term,
    conjoined,
    disjoined,
    implied,
    lines,
    negated,
)
from proofs.lift.sources import definition_of, file_of

SITED = ("site", "system")
"""What a predicate is told, and what is said of it goes without its name."""
COLUMNS = 62
EMPTY = Atom("∅")
SIGNS: Mapping[type[ast.cmpop], str] = {
    ast.Eq: "=",
    ast.NotEq: "≠",
    ast.Lt: "<",
    ast.LtE: "≤",
    ast.Gt: ">",
    ast.GtE: "≥",
    ast.In: "∈",
    ast.NotIn: "∉",
    ast.Is: "=",
    ast.IsNot: "≠",
}
OPERATIONS: Mapping[type[ast.operator], str] = {ast.Add: "+", ast.Sub: "−", ast.Mult: "·", ast.FloorDiv: "÷"}
PLAIN: Mapping[Any, str] = {True: "true", False: "false", None: "none"}

Predicate = Callable[..., Any]


class Unread(ValueError):
    """A piece of Python that has no notation here; with its file and line."""


def notation(function: Predicate, tree: ast.FunctionDef | None = None) -> list[str]:
    """What a predicate says, on lines of about ``COLUMNS``; ``tree`` stands in place of its own.

    Raises:
        Unread: it is written with something that has no notation; the construct, file and line are named.
    """
    return lines(term_of(function, tree), COLUMNS)


def term_of(function: Predicate, tree: ast.FunctionDef | None = None) -> Term:
    """What a predicate says; ``tree`` stands in place of its own."""
    reader = _Reader(function, tree or definition_of(function))
    return reader.body(reader.tree.body)


def called(function: Predicate) -> list[Predicate]:
    """The functions of the project that a function calls, in their order."""
    found = []
    for node in ast.walk(definition_of(function)):
        if isinstance(node, ast.Call):
            target = _resolved(function, node.func)
            if inspect.isfunction(target) and target is not replace:
                found.append(target)
    return list(dict.fromkeys(found))


def words(functions: Sequence[Predicate]) -> list[Predicate]:
    """All functions that these call, by themselves or by way of others: the words that they are said in."""
    found: dict[Predicate, None] = {}
    todo = list(functions)
    while todo:
        for each in called(todo.pop(0)):
            if each not in found:
                found[each] = None
                todo.append(each)
    return list(found)


def heading(function: Predicate) -> str:
    """How a word is written: its name with what it is told."""
    told = [name for name in inspect.signature(function).parameters if name not in SITED]
    return f"{function.__name__}({', '.join(told)})" if told else function.__name__


def _resolved(function: Predicate, node: ast.expr) -> Any:
    """What a dotted name means where a function stands; None if it is no name of its module."""
    if isinstance(node, ast.Name):
        return function.__globals__.get(node.id)
    if isinstance(node, ast.Attribute):
        base = _resolved(function, node.value)
        return getattr(base, node.attr, None) if isinstance(base, ModuleType) else None
    return None


class _Reader:
    """Reads one function."""

    def __init__(self, function: Predicate, tree: ast.FunctionDef) -> None:
        self.function, self.tree = function, tree
        names = [node.id for node in ast.walk(tree) if isinstance(node, ast.Name) and isinstance(node.ctx, ast.Store)]
        self.bound = {*names, *inspect.signature(function).parameters}
        of = {name: self._fields_of(tree, name) for name in SITED}
        self.in_both = of["site"] & of["system"]

    @staticmethod
    def _fields_of(tree: ast.AST, owner: str) -> set[str]:
        """The fields of site or of system that a function names."""
        return {
            node.attr
            for node in ast.walk(tree)
            if isinstance(node, ast.Attribute) and isinstance(node.value, ast.Name) and node.value.id == owner
        }

    # ---- statements

    def body(self, statements: Sequence[ast.stmt]) -> Term:
        """What a body returns: branches that return early come first."""
        first, rest = statements[0], statements[1:]
        match first:
            case ast.Expr(value=ast.Constant(value=str())):
                return self.body(rest)
            case ast.Return(value=ast.expr() as value):
                return self.term(value)
            case ast.Assign(targets=[target], value=value):
                name, said = self.target(target), self.term(value)
                return self.body(rest) if said == Atom(name) else Let(name, said, self.body(rest))
            case ast.If(test=test, body=inside, orelse=[]) if isinstance(inside[-1], ast.Return):
                return self.parted(self.term(test), self.body(inside), self.body(rest))
        raise self.unread(first)

    @staticmethod
    def parted(condition: Term, inside: Term, rest: Term) -> Term:
        """What a branch that returns comes to."""
        if inside == FALSE:
            return conjoined([negated(condition), rest])
        if inside == TRUE:
            return implied(negated(condition), rest)
        return Chosen(condition, inside, rest)

    def target(self, node: ast.expr) -> str:
        """What a name, or several, are bound as."""
        if isinstance(node, ast.Name):
            return node.id
        if isinstance(node, ast.Tuple):
            return f"({', '.join(self.target(each) for each in node.elts)})"
        raise self.unread(node)

    # ---- expressions

    def term(self, node: ast.expr) -> Term:
        """What an expression says."""
        match node:
            case ast.BoolOp(op=op, values=values):
                return (conjoined if isinstance(op, ast.And) else disjoined)([self.term(each) for each in values])
            case ast.UnaryOp(op=ast.Not(), operand=operand):
                return Negated(self.term(operand))
            case ast.Compare(left=left, ops=ops, comparators=right):
                return self.related([left, *right], ops)
            case ast.IfExp(test=test, body=inside, orelse=other):
                return Chosen(self.term(test), self.term(inside), self.term(other))
            case ast.Call():
                return self.call(node)
        return self.value(node)

    def value(self, node: ast.expr) -> Term:
        """What an expression stands for that is neither true nor false by its form."""
        match node:
            case ast.UnaryOp(op=ast.USub(), operand=operand):
                return Sum((("−", self.term(operand)),))
            case ast.BinOp(left=left, op=op, right=right) if type(op) in OPERATIONS:
                return self.computed(self.term(left), OPERATIONS[type(op)], self.term(right))
            case ast.Constant(value=value) if value is None or isinstance(value, bool | int | str):
                return Atom(self.constant(value))
            case ast.Tuple(elts=elts):
                return Listed("(", tuple(self.term(each) for each in elts), ")")
            case ast.Dict(keys=[]):
                return EMPTY
            case ast.Name(id=name):
                return Atom(name)
            case ast.Attribute():
                return self.field(node)
            case ast.Subscript(value=base, slice=key):
                return self.entry(base, key)
        raise self.unread(node)

    @staticmethod
    def constant(value: object) -> str:
        """A constant of the text."""
        if value is None or isinstance(value, bool):
            return PLAIN[value]
        return f"“{value}”" if isinstance(value, str) else f"{value:_}".replace("_", "\N{NARROW NO-BREAK SPACE}")

    def related(self, operands: Sequence[ast.expr], ops: Sequence[ast.cmpop]) -> Term:
        """A comparison, or a chain of them; what it is in may be written as a tuple."""
        said = [self.term(each) for each in operands]
        for place, op in enumerate(ops, 1):
            listed = said[place]
            if isinstance(op, ast.In | ast.NotIn) and isinstance(listed, Listed):
                said[place] = Listed("{", listed.parts, "}")
        return Related(tuple(said), tuple(SIGNS[type(op)] for op in ops))

    @staticmethod
    def computed(left: Term, sign: str, right: Term) -> Term:
        """Arithmetic; sums are kept flat."""
        if sign in "+−":
            first = left.parts if isinstance(left, Sum) else (("+", left),)
            return Sum((*first, (sign, right)))
        return Product(left, sign, right)

    def field(self, node: ast.Attribute) -> Term:
        """A field; of a module only its name, of site and system only the field."""
        if isinstance(_resolved(self.function, node.value), ModuleType):
            return Atom(node.attr)
        if isinstance(node.value, ast.Name) and node.value.id in SITED:
            plain = node.attr not in self.in_both and (node.attr not in self.bound or self.is_only_renamed(node.attr))
            plain = plain or node.attr in SITED
            return Atom(node.attr if plain else f"{node.value.id}.{node.attr}")
        base = self.term(node.value)
        return Atom(f"{base.text}.{node.attr}") if isinstance(base, Atom) else Field(base, node.attr)

    def is_only_renamed(self, name: str) -> bool:
        """Whether a name is bound once only, to the field of that name: ``order = system.order``."""
        bound = [node for node in ast.walk(self.tree) if isinstance(node, ast.Name) and node.id == name]
        stored = [node for node in bound if isinstance(node.ctx, ast.Store)]
        same = [
            node
            for node in ast.walk(self.tree)
            if isinstance(node, ast.Assign)
            and node.targets == stored
            and isinstance(node.value, ast.Attribute)
            and node.value.attr == name
            and isinstance(node.value.value, ast.Name)
            and node.value.value.id in SITED
        ]
        return len(stored) == 1 and len(same) == 1 and name not in inspect.signature(self.function).parameters

    def entry(self, base: ast.expr, key: ast.expr) -> Term:
        """The entry of a map at a key; of a map of maps at both."""
        owner, at = self.term(base), self.term(key)
        return Entry(owner.owner, (*owner.keys, at)) if isinstance(owner, Entry) else Entry(owner, (at,))

    def call(self, node: ast.Call) -> Term:
        """A quantifier, a lookup, or a word."""
        match node:
            case ast.Call(func=ast.Name(id="all" | "any" as name), args=[ast.GeneratorExp() as each], keywords=[]):
                return self.quantified("∀" if name == "all" else "∃", each)
            case ast.Call(func=ast.Name(id="frozenset"), args=[], keywords=[]):
                return EMPTY
            case ast.Call(func=ast.Attribute(value=base, attr="get"), args=[key], keywords=[]):
                return self.entry(base, key)
            case ast.Call(func=ast.Attribute(value=base, attr="get"), args=[key, default], keywords=[]):
                found, other = self.entry(base, key), self.term(default)
                known = Related((self.term(key), self.term(base)), ("∈",))
                return found if other == EMPTY else Chosen(known, found, other)
            case ast.Call(func=ast.Name(id="replace"), args=[base], keywords=[_, *_]):
                return Applied(f"{self.term(base).flat()} with ", self.fields(node))
            case ast.Call(args=[], keywords=[_, *_]) if inspect.isclass(made := _resolved(self.function, node.func)):
                return Applied(made.__name__, self.fields(node))
            case ast.Call(keywords=[]) if inspect.isfunction(target := _resolved(self.function, node.func)):
                told = [each for each in node.args if not (isinstance(each, ast.Name) and each.id in SITED)]
                said = tuple(self.term(each) for each in told)
                return Applied(target.__name__, said) if said else Atom(target.__name__)
        raise self.unread(node)

    def fields(self, node: ast.Call) -> tuple[Term, ...]:
        """The fields that a record is given by name."""
        return tuple(Related((Atom(each.arg or ""), self.term(each.value)), ("=",)) for each in node.keywords)

    def quantified(self, sign: str, each: ast.GeneratorExp) -> Term:
        """A quantifier over one range or several; what they ask beside stands before the arrow, or before ∧."""
        ranges, asked = [], []
        for loop in each.generators:
            match loop.iter:
                case ast.Call(func=ast.Attribute(value=owner, attr="items"), args=[], keywords=[]):
                    if not isinstance(loop.target, ast.Tuple) or len(loop.target.elts) != 2:
                        raise self.unread(loop.target)
                    key, value = (self.target(one) for one in loop.target.elts)
                    ranges.append((f"{key} ↦ {value}", self.term(owner)))
                case over:
                    ranges.append((self.target(loop.target), self.term(over)))
            asked += [self.term(one) for one in loop.ifs]
        said = self.term(each.elt)
        if asked:
            said = implied(conjoined(asked), said) if sign == "∀" else conjoined([*asked, said])
        return Quantified(sign, tuple(ranges), said)

    def unread(self, node: ast.AST) -> Unread:
        """The error of a construct without notation."""
        place = f"{file_of(self.function)}:{getattr(node, 'lineno', self.tree.lineno)}"
        return Unread(f"{place}: {self.function.__name__}: no notation for {type(node).__name__}")
