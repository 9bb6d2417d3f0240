"""Evaluate the source text of a function to a value: the same text that CPython runs and the prover lifts.

A name bound twice, a statement, an expression mean here what ``proofs/lift/SUBSET.md`` says.  What is needed
(a key that is there, a value that is not None) has been proved; here it is not asked again.
"""

from __future__ import annotations

import ast
import dataclasses
import inspect
from collections.abc import Callable, Mapping, Sequence
from enum import Enum
from types import ModuleType
from typing import Any, TypeAlias

from fuzz.compiled.contents import TableMap, content
from fuzz.compiled.domains import Domains
from fuzz.compiled.emitter import Emitter
from fuzz.compiled.loops import key_names, target_names
from fuzz.compiled.memory import OF_A_RUN, Memory
from fuzz.compiled.sets import (
    ByRun,
    Comprehension,
    Entries,
    Literal,
    MapComprehension,
    Meet,
    Minus,
    Union,
    Updated,
    contains,
)
from fuzz.compiled.values import (
    NO,
    YES,
    Exists,
    Items,
    Map,
    Maybe,
    Nothing,
    Num,
    Record,
    Set,
    Test,
    Truth,
    Value,
    Word,
    both,
    choose,
    constant,
    either,
    equal,
    flat,
    is_none,
    negation,
    some,
    subset,
    truth_of,
    with_fields,
)
from kernel.names import Run
from models.world.state import Formation, Site
from proofs.lift.kinds import Scalar, check_class, fields_of
from proofs.lift.sources import Code, check_names, definition_of, file_of
from proofs.mutated import Sources

Env: TypeAlias = dict[str, Any]
"""Names to values; names of modules, functions and types to themselves."""
ORDER = {ast.Lt: "<", ast.LtE: "<=", ast.Gt: ">", ast.GtE: ">="}


class NotCompilable(Exception):
    """A construct that has no meaning here, with its file and line."""


class Reader:
    """Evaluates functions on one memory's values.

    ``sources``: other bodies for some functions.  ``instead``: asked for each call; gives what stands for it.
    """

    def __init__(
        self,
        memory: Memory,
        sources: Sources | None = None,
        instead: Callable[[Code, Truth], Truth] | None = None,
        asked: frozenset[Code] = frozenset(),
    ) -> None:
        self.memory, self.sources = memory, sources or {}
        self.instead, self.asked = instead, asked

    @property
    def domains(self) -> Domains:
        """The numbers of identifiers."""
        return self.memory.domains

    def site(self) -> Record:
        """The site, as it stands in the memory."""
        fixed = self.memory.fixed

        def formation(name: str) -> Value:
            table = content(fixed[f"formation_{name}"], ())
            assert isinstance(table, Map)
            return ByRun(table, self._route_and_train) if name in OF_A_RUN else table

        def get(name: str) -> Value:
            return Record(Formation, formation) if name == "formation" else content(fixed[name], ())

        return Record(Site, get)

    def _route_and_train(self, run: Value) -> Value:
        return Items((self.field(run, "route"), self.field(run, "train")))

    def system(self) -> Value:
        """The state, as it stands in the memory."""
        return content(self.memory.state, ())

    # ---- functions and statements

    def definition(self, function: Code) -> ast.FunctionDef:
        """The syntax tree of a function, or of the mutant that stands for it, its names and parameters checked."""
        tree = self.sources.get(function)
        if tree is None:
            tree = definition_of(function)
        else:
            check_names(tree, function)
        every = tree.args
        if every.posonlyargs or every.kwonlyargs or every.vararg or every.kwarg:
            raise _Text(self, function).refused(tree, "a parameter that is not a plain one")
        return tree

    def call(self, function: Code, arguments: Mapping[str, Any]) -> Any:
        """The value that a function gives."""
        tree = self.definition(function)
        names = [each.arg for each in tree.args.args]
        given = function.__defaults__ or ()
        defaults = dict(zip(names[len(names) - len(given) :], given, strict=True))
        env: Env = {name: arguments[name] if name in arguments else self.lifted(defaults[name]) for name in names}
        value = _Text(self, function).body(tree.body, env)
        if self.instead is not None and function in self.asked:
            return self.instead(function, truth_of(value))
        return value

    def field(self, value: Value, name: str) -> Value:
        """A field of a record or a NamedTuple."""
        value = some(value)
        if isinstance(value, Record):
            return value.get(name)
        assert isinstance(value, Word), f"no field {name} of {value}"
        kinds = fields_of(value.kind.source)
        kind = kinds[name]
        assert isinstance(kind, Scalar)
        if value.kind.source is not Run:
            return Word(kind, (value.words[list(kinds).index(name)],))
        array = self.memory.runs[name]
        (slot,) = value.words
        key = ("load", array.name, slot.key)
        return Word(kind, (dataclasses.replace(slot, key=key, emit=lambda e: e.load(array, [slot.emit(e)])),))

    def lifted(self, value: Any) -> Any:
        """A constant of a module as a value."""
        if value is None:
            return Nothing()
        if isinstance(value, bool):
            return YES if value else NO
        if isinstance(value, Enum):
            check_class(type(value))
            kind = Scalar(type(value))
            return Word(kind, (constant(self.domains.number(kind, value)),))
        if isinstance(value, int):
            return Word(Scalar(int), (constant(value),))
        if isinstance(value, frozenset):
            return Literal([self.lifted(each) for each in sorted(value, key=repr)])
        if isinstance(value, dict):
            return Entries([(self.lifted(key), self.lifted(each)) for key, each in value.items()])
        return value


class _Text:
    """The text of one function."""

    def __init__(self, reader: Reader, function: Code) -> None:
        self.reader, self.function = reader, function

    def refused(self, node: ast.AST, what: str) -> NotCompilable:
        """A construct that is not known."""
        return NotCompilable(f"{file_of(self.function)}:{getattr(node, 'lineno', 0)}: {what} cannot be compiled")

    def body(self, statements: Sequence[ast.stmt], env: Env) -> Any:
        """The value returned: paths that fall through go on with what follows."""
        for at, node in enumerate(statements):
            rest = statements[at + 1 :]
            match node:
                case ast.Expr(ast.Constant()) | ast.Assert():
                    continue
                case ast.Return(value) if value is not None:
                    return self.value(value, env)
                case ast.Assign([target], value) | ast.AnnAssign(target, _, value) if value is not None:
                    found = self.value(value, env)
                    if isinstance(found, Record) and found.choice is not None:
                        return self.in_each_case(found, target, rest, env)
                    env = {**env, **self.bound(target, found)}
                case ast.If(test, then, other):
                    condition = truth_of(self.value(test, env))
                    one, two = self.body([*then, *rest], env), self.body([*other, *rest], env)
                    return choose(condition, one, two)
                case _:
                    raise self.refused(node, type(node).__name__)
        raise self.refused(statements[-1], "a path without return")

    def in_each_case(self, found: Any, target: ast.expr, rest: Sequence[ast.stmt], env: Env) -> Any:
        """Go on separately with each record that it may be: what follows is then about one, not about either."""
        if not isinstance(found, Record) or found.choice is None:
            return self.body(rest, {**env, **self.bound(target, found)})
        condition, one, other = found.choice
        return choose(condition, self.in_each_case(one, target, rest, env), self.in_each_case(other, target, rest, env))

    def bound(self, target: ast.expr, value: Any) -> Env:
        """The names that a target binds."""
        match target:
            case ast.Name(name):
                return {name: value}
            case ast.Tuple(parts):
                value = some(value)
                assert isinstance(value, Items), ast.unparse(target)
                made: Env = {}
                for part, item in zip(parts, value.items, strict=True):
                    made |= self.bound(part, item)
                return made
        raise self.refused(target, ast.unparse(target))

    # ---- expressions

    def value(self, node: ast.expr, env: Env) -> Any:
        """The value of an expression."""
        handler = getattr(self, f"_{type(node).__name__.lower()}", None)
        if handler is None:
            raise self.refused(node, type(node).__name__)
        return handler(node, env)

    def _constant(self, node: ast.Constant, env: Env) -> Any:
        return self.reader.lifted(node.value)

    def _name(self, node: ast.Name, env: Env) -> Any:
        if node.id in env:
            return env[node.id]
        names = self.function.__globals__
        if node.id in names:
            return self.reader.lifted(names[node.id])
        if node.id in ("any", "all", "frozenset"):
            return node.id
        raise self.refused(node, f"the name {node.id}, which the module has not,")

    def _attribute(self, node: ast.Attribute, env: Env) -> Any:
        owner = self.value(node.value, env)
        if isinstance(owner, ModuleType):
            return self.reader.lifted(getattr(owner, node.attr))
        if isinstance(owner, type) and issubclass(owner, Enum):
            return self.reader.lifted(owner[node.attr])
        return self.reader.field(owner, node.attr)

    def _tuple(self, node: ast.Tuple, env: Env) -> Items:
        return Items(tuple(self.value(each, env) for each in node.elts))

    def _set(self, node: ast.Set, env: Env) -> Literal:
        return Literal([self.value(each, env) for each in node.elts])

    def _dict(self, node: ast.Dict, env: Env) -> Map:
        made: Map = Entries([])
        entries: list[tuple[Value, Value]] = []
        for place, (key, value) in enumerate(zip(node.keys, node.values, strict=True)):
            if key is None and place > 0:
                raise self.refused(node, "** that is not first in a display")
            if key is None:
                made = self.value(value, env)
            else:
                entries.append((self.value(key, env), self.value(value, env)))
        return Entries(entries) if isinstance(made, Entries) else Updated(made, Entries(entries))

    def _boolop(self, node: ast.BoolOp, env: Env) -> Truth:
        parts = [truth_of(self.value(each, env)) for each in node.values]
        if isinstance(node.op, ast.And):
            return both(*parts)
        return negation(both(*(negation(part) for part in parts)))

    def _unaryop(self, node: ast.UnaryOp, env: Env) -> Truth | Word:
        if isinstance(node.op, ast.USub):
            (number,) = flat(some(self.value(node.operand, env)))
            return Word(Scalar(int), (Num(("minus", number.key), lambda e: e.build.neg(number.emit(e))),))
        if not isinstance(node.op, ast.Not):
            raise self.refused(node, ast.unparse(node))
        return negation(truth_of(self.value(node.operand, env)))

    def _binop(self, node: ast.BinOp, env: Env) -> Set | Map:
        one, other = (some(self.value(each, env)) for each in (node.left, node.right))
        if isinstance(one, Map) and isinstance(other, Map) and isinstance(node.op, ast.BitOr):
            return other if isinstance(one, Entries) and not one.entries else Updated(one, other)
        made = {ast.BitOr: Union, ast.Sub: Minus, ast.BitAnd: Meet}.get(type(node.op))
        if made is None or not isinstance(one, Set) or not isinstance(other, Set):
            raise self.refused(node, ast.unparse(node))
        return made(one, other)

    def _ifexp(self, node: ast.IfExp, env: Env) -> Any:
        condition = truth_of(self.value(node.test, env))
        return choose(condition, self.value(node.body, env), self.value(node.orelse, env))

    def _compare(self, node: ast.Compare, env: Env) -> Truth:
        values = [self.value(each, env) for each in (node.left, *node.comparators)]
        pairs = zip(values, node.ops, values[1:], strict=False)
        return both(*(self._compared(node, one, op, other) for one, op, other in pairs))

    def _compared(self, node: ast.Compare, one: Any, op: ast.cmpop, other: Any) -> Truth:
        match op:
            case ast.Eq() | ast.Is():
                return equal(one, other)
            case ast.NotEq() | ast.IsNot():
                return negation(equal(one, other))
            case ast.In():
                return self._in(node, one, other)
            case ast.NotIn():
                return negation(self._in(node, one, other))
        if isinstance(one, Set) and isinstance(op, ast.LtE):
            return subset(one, other)
        (a,), (b,) = flat(some(one)), flat(some(other))
        sign = ORDER[type(op)]
        return Test(lambda e: e.build.icmp_signed(sign, a.emit(e), b.emit(e)))

    def _in(self, node: ast.AST, element: Value, collection: Any) -> Truth:
        collection = some(collection)
        if isinstance(collection, Items):
            return contains(Literal(collection.items), element)
        if isinstance(collection, Map):
            collection = collection.keys()
        if not isinstance(collection, Set):
            raise self.refused(node, "`in` of no set")
        return contains(collection, element)

    def _subscript(self, node: ast.Subscript, env: Env) -> Value:
        table = some(self.value(node.value, env))
        if not isinstance(table, Map):
            raise self.refused(node, ast.unparse(node))
        return table.get(some(self.value(node.slice, env)))

    # ---- calls

    def _call(self, node: ast.Call, env: Env) -> Any:
        if isinstance(node.func, ast.Attribute):
            owner = self.value(node.func.value, env)
            if not isinstance(owner, ModuleType):
                return self._method(node, some(owner), env)
        called = self.value(node.func, env)
        if called in ("any", "all"):
            return self._quantified(node, called == "all", env)
        if called == "frozenset":
            return self.value(node.args[0], env) if node.args else Literal([])
        arguments = [self.value(each, env) for each in node.args]
        given = {str(each.arg): self.value(each.value, env) for each in node.keywords}
        if called is dataclasses.replace:
            record = some(arguments[0])
            if not isinstance(record, Record):
                raise self.refused(node, "replace of no record")
            return with_fields(record, given)
        if dataclasses.is_dataclass(called) and isinstance(called, type):
            check_class(called)
            named = dict(zip(fields_of(called), arguments, strict=False)) | given
            return Record(called, lambda name: named[name])
        if not inspect.isfunction(called):
            raise self.refused(node, ast.unparse(node.func))
        names = [each.arg for each in self.reader.definition(called).args.args]
        by_name = dict(zip(names, arguments, strict=False)) | given
        if len(by_name) != len(arguments) + len(given) or not by_name.keys() <= set(names):
            raise self.refused(node, f"arguments of {ast.unparse(node)}")
        return self.reader.call(called, by_name)

    def _method(self, node: ast.Call, owner: Any, env: Env) -> Any:
        assert isinstance(node.func, ast.Attribute)
        name, arguments = node.func.attr, [self.value(each, env) for each in node.args]
        if isinstance(owner, Map) and name == "get":
            key = arguments[0]
            if isinstance(owner, TableMap) and len(arguments) == 2 and _is_empty(arguments[1]) and is_none(key) is NO:
                return owner.get(key)  # what is absent is empty
            there = contains(owner.keys(), key)
            if len(arguments) == 1:
                return Maybe(either(negation(there), is_none(owner.get(some(key)))), some(owner.get(some(key))))
            return choose(there, owner.get(some(key)), arguments[1])
        if isinstance(owner, Map) and name == "keys":
            return owner.keys()
        raise self.refused(node, f".{name}()")

    def _quantified(self, node: ast.Call, every: bool, env: Env) -> Truth:
        (given,) = node.args
        if not isinstance(given, ast.GeneratorExp):
            raise self.refused(node, "any or all of no generator")

        def loops(e: Emitter, found: Any) -> None:
            def turn(inner: Env) -> None:
                wanted = truth_of(self.value(given.elt, inner))
                other = e.block()
                (negation(wanted) if every else wanted).jump(e, found, other)
                e.enter(other)

            self.turns(e, given.generators, env, turn)

        return negation(Exists(loops)) if every else Exists(loops)

    # ---- comprehensions

    def turns(self, e: Emitter, generators: Sequence[ast.comprehension], env: Env, body: Callable[[Env], None]) -> None:
        """Run through the turns of some loops."""
        if not generators:
            body(env)
            return
        first, *rest = generators
        collection, pairs = self._looped(first.iter, env)

        def turn(element: Value) -> None:
            item = Items((element, collection.get(element))) if pairs and isinstance(collection, Map) else element
            inner = {**env, **self.bound(first.target, item)}
            condition = both(*(truth_of(self.value(each, inner)) for each in first.ifs))
            if condition is YES:
                self.turns(e, rest, inner, body)
            else:
                condition.when(e, lambda: self.turns(e, rest, inner, body))

        (collection.keys() if isinstance(collection, Map) else collection).each(e, turn)

    def _looped(self, node: ast.expr, env: Env) -> tuple[Set | Map, bool]:
        """What a loop runs over, and whether it gives keys with their values."""
        if isinstance(node, ast.Call) and isinstance(node.func, ast.Attribute) and node.func.attr == "items":
            return some(self.value(node.func.value, env)), True  # type: ignore[return-value]
        found = some(self.value(node, env))
        if isinstance(found, Items):
            return Literal(found.items), False
        if not isinstance(found, Set | Map):
            raise self.refused(node, f"a loop over {ast.unparse(node)}")
        return found, False

    def _generatorexp(self, node: ast.GeneratorExp, env: Env) -> Comprehension:
        return self._comprehension(node.elt, node.generators, env)

    def _setcomp(self, node: ast.SetComp, env: Env) -> Comprehension:
        return self._comprehension(node.elt, node.generators, env)

    def _comprehension(self, given: ast.expr, generators: Sequence[ast.comprehension], env: Env) -> Comprehension:
        def loops(e: Emitter, body: Callable[[Value], None]) -> None:
            self.turns(e, generators, env, lambda inner: body(self.value(given, inner)))

        parts = given.elts if isinstance(given, ast.Tuple) else [given]
        named = {part.id for part in parts if isinstance(part, ast.Name)}
        keys = {name for each in generators for name in key_names(each)}
        if len(named) < len(parts) or not keys <= named or named & (target_names(generators) - keys):
            return Comprehension(loops, None)
        return Comprehension(loops, lambda element: self._direct(given, generators, env, element)[0])

    def _direct(
        self, given: ast.expr, generators: Sequence[ast.comprehension], env: Env, element: Value
    ) -> tuple[Truth, Env]:
        """Whether the turn that an element names is there; and the names of that turn."""
        inner: Env = {**env, **self.bound(given, element)}
        parts = given.elts if isinstance(given, ast.Tuple) else [given]
        outer = {part.id for part in parts if isinstance(part, ast.Name)} - target_names(generators)
        condition = both(*(equal(inner[name], self._name(ast.Name(name), env)) for name in sorted(outer)))
        for each in generators:
            collection, pairs = self._looped(each.iter, inner)
            target = each.target
            if pairs:
                assert isinstance(target, ast.Tuple)
                key = self._target_value(target.elts[0], inner)
                condition = both(condition, self._in(each.iter, key, collection))
                assert isinstance(collection, Map)
                inner |= self.bound(target.elts[1], collection.get(key))
            else:
                condition = both(condition, self._in(each.iter, self._target_value(target, inner), collection))
            condition = both(condition, *(truth_of(self.value(test, inner)) for test in each.ifs))
        return condition, inner

    def _target_value(self, target: ast.expr, env: Env) -> Value:
        value: Value = self.value(target, env)
        return value

    def _dictcomp(self, node: ast.DictComp, env: Env) -> MapComprehension:
        keys = self._comprehension(node.key, node.generators, env)

        def value(key: Value) -> Value:
            found: Value = self.value(node.value, self._direct(node.key, node.generators, env, key)[1])
            return found

        if keys.direct is None:
            raise self.refused(node, "a key that does not name every loop")
        return MapComprehension(keys, value)


def _is_empty(value: Any) -> bool:
    return (isinstance(value, Literal) and not value.elements) or (isinstance(value, Entries) and not value.entries)
