"""Statements and functions: a body becomes a tree of cases."""

from __future__ import annotations

import ast
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any, TypeAlias

from proofs.lift.comprehensions import bind
from proofs.lift.expressions import cases_of, condition, narrow
from proofs.lift.frames import Env, Frame, State
from proofs.lift.sources import Code
from proofs.lift.terms import Truth, not_, same
from proofs.lift.trees import Choice, Leaf, Tree, combine, settle
from proofs.lift.values import ABSENT, Tuple, Value


@dataclass(frozen=True)
class Returned:
    """The path has returned."""

    tree: Tree


@dataclass(frozen=True)
class Fall:
    """The path goes on with the next statement."""

    env: Env


@dataclass(frozen=True)
class Branch:
    """The path divides."""

    condition: Truth
    yes: Outcome
    no: Outcome


Outcome: TypeAlias = Returned | Fall | Branch


def lift_function(state: State, function: Code, arguments: Env) -> Tree:
    """Lift the body of a function for these arguments, parameter by parameter."""
    frame = Frame(state, function)
    definition = frame.definition
    if function in state.calls:
        raise frame.outside(definition, f"{function.__name__} calls itself", "a comprehension, or one function a level")
    before, state.calls = state.calls, (*state.calls, function)
    try:
        return _tree(frame, run(frame, definition.body, arguments))
    finally:
        state.calls = before


def parameters(state: State, function: Code) -> tuple[list[str], list[str], Mapping[str, object]]:
    """Return positional parameters, keyword-only ones, and defaults."""
    frame = Frame(state, function)
    arguments = frame.definition.args
    if arguments.vararg or arguments.kwarg:
        raise frame.outside(frame.definition, "* or ** in a signature", "name every parameter")
    names = [argument.arg for argument in (*arguments.posonlyargs, *arguments.args)]
    values = function.__defaults__ or ()
    defaults = dict(zip(names[len(names) - len(values) :], values, strict=True)) | (function.__kwdefaults__ or {})
    for name, value in defaults.items():
        if isinstance(value, (list, dict, set)):
            raise frame.outside(
                frame.definition, f"mutable default of {name}", "a module constant that is frozen, or None"
            )
    return names, [argument.arg for argument in arguments.kwonlyargs], defaults


def _tree(frame: Frame, outcome: Outcome) -> Tree:
    match outcome:
        case Returned(tree):
            return tree
        case Branch(test, yes, no):
            return Choice(test, _tree(frame, yes), _tree(frame, no))
        case _:
            raise frame.outside(frame.definition, "a path ends without return", "return a value on every path")


def run(frame: Frame, statements: Sequence[ast.stmt], env: Env) -> Outcome:
    """Lift statements in turn."""
    if not statements:
        return Fall(env)
    first, rest = statements[0], statements[1:]
    if isinstance(first, ast.Return):
        if first.value is None:
            raise frame.outside(first, "return without a value", "return a value")
        return Returned(cases_of(frame, first.value, env))
    if isinstance(first, ast.If):
        return _resume(frame, lift_if(frame, first, env), rest)
    if isinstance(first, ast.Assert):
        held = condition(frame, first.test, env)
        frame.require(held, first)
        with frame.state.assuming(held):
            return run(frame, rest, narrow(first.test, env, True))
    lift = _SIMPLE.get(type(first))
    if lift is None:
        raise frame.outside(
            first, f"statement {type(first).__name__}: {ast.unparse(first).splitlines()[0]}", _hint(first)
        )
    return run(frame, rest, lift(frame, first, env))


def _hint(statement: ast.stmt) -> str:
    if isinstance(statement, (ast.While, ast.For)):
        return "a comprehension, any(...) or all(...) over a finite set"
    if isinstance(statement, (ast.Try, ast.Raise)):
        return "no exceptions: test before, and return what is to happen"
    if isinstance(statement, ast.AugAssign):
        return "write x = x + e"
    return "docstring, if, return, assignment to names, assert: nothing else"


def _resume(frame: Frame, outcome: Outcome, rest: Sequence[ast.stmt]) -> Outcome:
    """Go on with the next statements wherever the path has not returned."""
    match outcome:
        case Returned():
            return outcome
        case Fall(env):
            return run(frame, rest, env)
        case Branch(test, yes, no):
            with frame.state.assuming(test):
                yes = _resume(frame, yes, rest)
            with frame.state.assuming(not_(test)):
                no = _resume(frame, no, rest)
            return Branch(test, yes, no)


def lift_if(frame: Frame, node: ast.If, env: Env) -> Outcome:
    """``if``: two paths, joined again if both fall through."""
    test = frame.state.decided(condition(frame, node.test, env))
    when_true, when_false = narrow(node.test, env, True), narrow(node.test, env, False)
    if isinstance(test, bool):
        return run(frame, node.body if test else node.orelse, when_true if test else when_false)
    with frame.state.assuming(test):
        yes = run(frame, node.body, when_true)
    with frame.state.assuming(not_(test)):
        no = run(frame, node.orelse, when_false)
    if not isinstance(yes, Fall) or not isinstance(no, Fall):
        return Branch(test, yes, no)
    joined: Env = {}
    with frame.at(node.test):
        for name in (name for name in yes.env if name in no.env):
            one, other = yes.env[name], no.env[name]
            untouched = name in env and one is when_true[name] and other is when_false[name]
            joined[name] = env[name] if untouched else _joined(test, one, other)
    return Fall(joined)


def _joined(test: Truth, one: Value, other: Value) -> Value:
    """Return the variable's value after both branches, its cases kept apart."""
    return one if same(one, other) else _stored(settle(Choice(test, _as_tree(one), _as_tree(other))))


def _stored(tree: Tree) -> Value:
    return tree.value if isinstance(tree, Leaf) else tree


def _as_tree(value: Value) -> Tree:
    return value if isinstance(value, (Leaf, Choice)) else Leaf(value)


# Statements that only set variables ------------------------------------------------------------


def lift_assign(frame: Frame, node: ast.Assign | ast.AnnAssign, env: Env) -> Env:
    """``x = e``, ``x: T = e``, ``a, b = e``."""
    targets = node.targets if isinstance(node, ast.Assign) else [node.target]
    if len(targets) != 1 or node.value is None:
        raise frame.outside(node, ast.unparse(node), "one target and one value")
    return {**env, **_bound(frame, targets[0], cases_of(frame, node.value, env))}


def _bound(frame: Frame, target: ast.expr, tree: Tree) -> Env:
    """Bind a target to a value whose cases stay apart."""
    if isinstance(target, ast.Name):
        return {target.id: _stored(tree)}
    if isinstance(tree, Leaf):
        return bind(frame, target, tree.value)
    if not isinstance(target, ast.Tuple):
        raise frame.outside(target, f"assignment to {ast.unparse(target)}", "assign to names only")
    found: Env = {}
    for index, part in enumerate(target.elts):
        found |= _bound(frame, part, settle(combine([tree], _item(frame, target, index))))
    return found


def _item(frame: Frame, target: ast.Tuple, index: int) -> Callable[[tuple[Value, ...]], Value]:
    def item(values: tuple[Value, ...]) -> Value:
        value = values[0]
        if isinstance(value, Tuple) and len(value.items) == len(target.elts):
            return value.items[index]
        return ABSENT if value is ABSENT else list(bind(frame, target, value).values())[index]

    return item


def lift_docstring(frame: Frame, node: ast.Expr, env: Env) -> Env:
    """A text that stands alone says nothing to the machine."""
    if isinstance(node.value, ast.Constant) and isinstance(node.value.value, str):
        return env
    raise frame.outside(node, f"expression without use: {ast.unparse(node)}", "assign or return it")


_SIMPLE: dict[type[ast.stmt], Callable[[Frame, Any, Env], Env]] = {
    ast.Assign: lift_assign,
    ast.AnnAssign: lift_assign,
    ast.Expr: lift_docstring,
}
