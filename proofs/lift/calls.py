"""Calls: other functions of the subset, built-in ones, methods of maps, construction."""

from __future__ import annotations

import ast
import dataclasses
from collections.abc import Callable
from types import FunctionType
from typing import Any, NewType

from proofs.lift.comparisons import contains
from proofs.lift.comprehensions import lift_setcomp, quantified
from proofs.lift.expressions import CASES, cases_of, construct, evaluate
from proofs.lift.frames import MISSING, Env, Frame
from proofs.lift.kinds import kind_of_type
from proofs.lift.operators import lookup, set_of
from proofs.lift.statements import lift_function, parameters
from proofs.lift.terms import same
from proofs.lift.trees import Leaf, Tree, combine, merge
from proofs.lift.values import (
    EMPTY_SET,
    NOTHING,
    Absent,
    Map,
    Record,
    Set,
    Tuple,
    Value,
    choose,
    flat,
    name_of,
    restrict,
)


@construct(ast.Call)
def lift_call(frame: Frame, node: ast.Call, env: Env) -> Value:
    """A call, its cases joined."""
    return merge(call_cases(frame, node, env))


def call_cases(frame: Frame, node: ast.Call, env: Env) -> Tree:
    """A call, its cases kept apart."""
    if any(isinstance(argument, ast.Starred) for argument in node.args) or any(k.arg is None for k in node.keywords):
        raise frame.outside(node, "* or ** in a call", "name every argument")
    target = frame.global_object(node.func, env)
    special = _SPECIAL.get(target) if target.__hash__ else None
    if special is not None:
        return special(frame, node, env)
    if isinstance(target, FunctionType):
        return lift_function(frame.state, target, _arguments(frame, node, env, target))
    if isinstance(target, type) and dataclasses.is_dataclass(target):
        return _construction(frame, node, env, target)
    if isinstance(target, NewType) or (isinstance(target, type) and issubclass(target, tuple)):
        what = f"{target.__name__}(...) makes an identifier"
        raise frame.outside(node, what, "identifiers are opaque: take it from an argument, a set or a field")
    if target is MISSING and isinstance(node.func, ast.Attribute):
        if node.func.attr == "get":
            return Leaf(lift_get(frame, node, node.func, env))
        raise frame.outside(
            node, f"method {node.func.attr}: {ast.unparse(node)}", "m.get; | - & in; a function of the module"
        )
    raise frame.outside(
        node, f"call of {ast.unparse(node.func)}", "functions of the subset, any, all, frozenset, replace, dataclasses"
    )


CASES[ast.Call] = call_cases


def _arguments(frame: Frame, node: ast.Call, env: Env, function: FunctionType) -> Env:
    """Lift the arguments of a call and give each to its parameter."""
    names, keyword_only, defaults = parameters(frame.state, function)
    given = dict(zip(names, node.args, strict=False)) | {k.arg: k.value for k in node.keywords if k.arg is not None}
    if len(node.args) > len(names) or len(given) != len(node.args) + len(node.keywords):
        raise frame.outside(node, f"arguments of {ast.unparse(node)}", "each parameter once")
    by_place = {each.arg for each in frame.state.definition(function).args.posonlyargs}
    if by_place & {keyword.arg for keyword in node.keywords}:
        raise frame.outside(node, f"arguments of {ast.unparse(node)}", "what stands before / is given by its place")
    bound: Env = {}
    for name in (*names, *keyword_only):
        if name in given:
            tree = cases_of(frame, given.pop(name), env)
            bound[name] = tree.value if isinstance(tree, Leaf) else tree
        elif name in defaults:
            bound[name] = frame.literal(defaults[name], node)
        else:
            raise frame.outside(node, f"no argument for {name} in {ast.unparse(node)}", "give every parameter a value")
    if given:
        raise frame.outside(node, f"{', '.join(given)}: no such parameter of {function.__name__}", "see its signature")
    return bound


# Records ---------------------------------------------------------------------------------------


def _construction(frame: Frame, node: ast.Call, env: Env, cls: Any) -> Tree:
    """``Record(field=value)``, with defaults."""
    kind_of_type(cls)
    fields = {field.name: field for field in dataclasses.fields(cls)}
    given = dict(zip(fields, node.args, strict=False)) | {k.arg: k.value for k in node.keywords if k.arg is not None}
    if len(node.args) > len(fields) or not given.keys() <= fields.keys():
        raise frame.outside(node, f"arguments of {ast.unparse(node)}", f"the fields of {cls.__name__}")
    trees = []
    for name, field in fields.items():
        if name in given:
            trees.append(cases_of(frame, given[name], env))
        elif field.default is not dataclasses.MISSING:
            trees.append(Leaf(frame.literal(field.default, node)))
        else:
            raise frame.outside(node, f"no value for {name} of {cls.__name__}", "give every field a value")
    return combine(trees, lambda values: Record(cls, dict(zip(fields, values, strict=True))))


def _replacement(frame: Frame, node: ast.Call, env: Env) -> Tree:
    """``replace(record, field=value)``; with nothing changed it is the record itself."""
    if len(node.args) != 1:
        raise frame.outside(node, f"arguments of {ast.unparse(node)}", "replace(record, field=value)")
    names = [str(keyword.arg) for keyword in node.keywords]
    trees = [cases_of(frame, node.args[0], env), *(cases_of(frame, keyword.value, env) for keyword in node.keywords)]

    def build(values: tuple[Value, ...]) -> Value:
        record = frame.unwrap(values[0], node.args[0])
        if isinstance(record, Absent):
            return record
        if not isinstance(record, Record) or not set(names) <= set(record.fields):
            raise frame.outside(node, f"replace of {name_of(record)}", "a dataclass, and fields that it has")
        changes = {
            name: value for name, value in zip(names, values[1:], strict=True) if not same(value, record.fields[name])
        }
        return Record(record.cls, {**record.fields, **changes}) if changes else record

    return combine(trees, build)


# Maps and sets -----------------------------------------------------------------------------------


def lift_get(frame: Frame, node: ast.Call, method: ast.Attribute, env: Env) -> Value:
    """``m.get(k)``: None if absent; ``m.get(k, default)``."""
    whole = frame.unwrap(evaluate(frame, method.value, env), method.value)
    if not isinstance(whole, (Map, Absent)) or len(node.args) not in (1, 2) or node.keywords:
        raise frame.outside(
            node, f"{ast.unparse(node)} of a {name_of(whole)}", "m.get(k) or m.get(k, default) of a Mapping"
        )
    key = evaluate(frame, node.args[0], env)
    default = evaluate(frame, node.args[1], env) if len(node.args) == 2 else NOTHING
    present = contains(frame, key, whole, node)
    if present is False:
        return default
    value = lookup(frame, whole, key)
    if isinstance(default, Set) and default.element is None and isinstance(value, Set):
        return restrict(value, flat(key)[0])
    if isinstance(default, Map) and default.key is None and isinstance(value, Map):
        return restrict(value, flat(key)[0])
    return choose(present, value, default)


def _frozenset(frame: Frame, node: ast.Call, env: Env) -> Tree:
    """``frozenset()``, of a display, of a generator, of a set, of the keys of a map."""
    if node.keywords or len(node.args) > 1:
        raise frame.outside(node, f"arguments of {ast.unparse(node)}", "frozenset(e for x in s if c)")
    if not node.args:
        return Leaf(EMPTY_SET)
    if isinstance(node.args[0], ast.GeneratorExp):
        return Leaf(lift_setcomp(frame, node.args[0], env))
    value = frame.unwrap(evaluate(frame, node.args[0], env), node.args[0])
    if isinstance(value, Map):
        return Leaf(Set(value.key, value.has))
    if isinstance(value, Tuple):
        return Leaf(set_of(frame, value.items, node))
    if isinstance(value, (Set, Absent)):
        return Leaf(value)
    raise frame.outside(node, f"frozenset of a {name_of(value)}", "frozenset of a set, a map, a tuple or a generator")


def _quantifier(universal: bool) -> Callable[[Frame, ast.Call, Env], Tree]:
    def lift(frame: Frame, node: ast.Call, env: Env) -> Tree:
        if len(node.args) != 1 or node.keywords or not isinstance(node.args[0], ast.GeneratorExp):
            raise frame.outside(node, f"argument of {ast.unparse(node)}", "any(... for x in s), all(... for x in s)")
        return Leaf(quantified(frame, node.args[0], env, universal))

    return lift


_SPECIAL: dict[Any, Callable[[Frame, ast.Call, Env], Tree]] = {
    any: _quantifier(universal=False),
    all: _quantifier(universal=True),
    frozenset: _frozenset,
    dataclasses.replace: _replacement,
}
