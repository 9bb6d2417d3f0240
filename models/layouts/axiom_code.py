"""An axiom, read as a search for every way in which it fails.

The same source that is proved against is compiled here: ``all(body for … if …)`` becomes a loop,
a conjunction is searched part by part, and each part that does not hold is reported with the loop
variables that make it fail.  A look-up of something absent is a failure of its own.
"""

from __future__ import annotations

import ast
import builtins
import copy
import inspect
import textwrap
from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass
from types import CodeType, ModuleType
from typing import Any

from kernel.layout import Layout
from models.ground import Ground

Axiom = Callable[[Layout, Ground], bool]
Bindings = Mapping[str, Any]


@dataclass(frozen=True)
class Binder:
    """A variable's source: the expression it loops over, or (``loops`` false) is."""

    source: str
    loops: bool


@dataclass(frozen=True)
class Part:
    """One part of an axiom that is not taken further apart, and the loops it stands in.

    A call of a predicate is such a part; the names that it gives to what it looks at are bound with it.
    ``terms``: its look-ups, innermost first, each compiled.  ``binders``: where each variable that
    stands in it has its value from.
    """

    source: str
    terms: tuple[tuple[str, CodeType], ...]
    binders: Mapping[str, Binder]


@dataclass(frozen=True)
class Failure:
    """A part of an axiom that fails; ``missing`` when something it looks up is absent."""

    part: Part
    bindings: Bindings
    missing: bool


@dataclass(frozen=True)
class CompiledAxiom:
    """An axiom with its first sentence, its parts, and the search for its failures."""

    name: str
    sentence: str
    parts: tuple[Part, ...]
    search: Callable[[Layout, Ground, list[int]], Iterator[tuple[int, Bindings, bool]]]

    def failures(self, layout: Layout, ground: Ground) -> tuple[list[Failure], int]:
        """Every failure in a layout, and how many instances were looked at."""
        looked_at = [0]
        found = [
            Failure(self.parts[part], bindings, missing)
            for part, bindings, missing in self.search(layout, ground, looked_at)
        ]
        return found, looked_at[0]


def axioms_of(module: ModuleType) -> list[Axiom]:
    """The axioms of a module in the order they are written: public functions of a layout and its ground."""
    return [
        function
        for name, function in vars(module).items()
        if inspect.isfunction(function)
        and function.__module__ == module.__name__
        and not name.startswith("_")
        and list(inspect.signature(function).parameters) == ["layout", "ground"]
    ]


def compile_axiom(axiom: Axiom) -> CompiledAxiom:
    """Compile an axiom's search; whatever is not of the known form is one part that holds or not."""
    source = textwrap.dedent(inspect.getsource(axiom))
    function = ast.parse(source).body[0]
    assert isinstance(function, ast.FunctionDef)
    body = [statement for statement in function.body if not _is_docstring(statement)]
    namespace = dict(vars(inspect.getmodule(axiom)))
    writer = _Writer(namespace)
    known_form = isinstance(body[-1], ast.Return) and all(_is_simple_assignment(s) for s in body[:-1])
    if known_form:
        assert isinstance(body[-1], ast.Return)
        assert body[-1].value is not None
        for statement in body[:-1]:
            writer.line(ast.unparse(statement))
        writer.search(body[-1].value)
    else:
        writer.search(ast.parse(f"{function.name}(layout, ground)", mode="eval").body)
    exec(compile(writer.text(), f"<search for {function.name}>", "exec"), namespace)
    sentence = (inspect.getdoc(axiom) or function.name.replace("_", " ")).splitlines()[0]
    return CompiledAxiom(function.name, sentence, tuple(writer.parts), namespace["search"])


def _is_docstring(statement: ast.stmt) -> bool:
    return isinstance(statement, ast.Expr) and isinstance(statement.value, ast.Constant)


def _is_simple_assignment(statement: ast.stmt) -> bool:
    if not isinstance(statement, ast.Assign) or len(statement.targets) != 1:
        return False
    return isinstance(statement.targets[0], ast.Name)


@dataclass(frozen=True)
class Within:
    """What a called predicate looks at: the values it names, and its look-ups."""

    steps: Mapping[str, ast.expr]
    terms: tuple[tuple[str, CodeType], ...]


class _Writer:
    """Writes the source of a generator of failures, one construct at a time."""

    def __init__(self, namespace: dict[str, Any]) -> None:
        self.lines: list[str] = []
        self.parts: list[Part] = []
        self.binders: dict[str, Binder] = {}
        self.namespace = namespace
        self.depth = 1
        self.names = 0

    def text(self) -> str:
        """The whole generator; it yields part number, bindings, and whether a look-up failed."""
        head = "def search(layout, ground, looked_at):\n"
        return head + "\n".join(["    if False: yield", *self.lines]) + "\n"

    def line(self, text: str) -> None:
        self.lines += ["    " * self.depth + line for line in text.splitlines()]

    def fresh(self, stem: str) -> str:
        self.names += 1
        return f"_{stem}{self.names}"

    def search(self, node: ast.expr, failed: str | None = None) -> None:
        """Search an expression; ``failed`` counts the failures of the conjunction it is a part of."""
        if isinstance(node, ast.BoolOp) and isinstance(node.op, ast.And):
            counter = failed or self.counter()
            for value in node.values:
                self.search(value, counter)
        elif isinstance(node, ast.BoolOp) and self.opens(node.values[-1]):
            guard = ast.BoolOp(ast.Or(), node.values[:-1]) if len(node.values) > 2 else node.values[0]
            self.unless(guard, node, failed)
        elif isinstance(node, ast.IfExp):
            self.branch(node, failed)
        elif _is_all(node):
            assert isinstance(node, ast.Call)
            assert isinstance(node.args[0], ast.GeneratorExp)
            self.loop(node.args[0], failed)
        elif (helper := _helper(node, self.namespace)) is not None:
            assert isinstance(node, ast.Call)
            self.call(node, helper, failed)
        else:
            self.leaf(node, failed)

    def call(self, call: ast.Call, helper: ast.FunctionDef, failed: str | None) -> None:
        """A call of a predicate of the known form: one part, told with the names and look-ups within it."""
        names = [argument.arg for argument in helper.args.args]
        put: dict[str, ast.expr] = dict(zip(names, call.args, strict=True))
        steps: dict[str, ast.expr] = {}
        looked_up: list[ast.AST] = []
        for statement in helper.body:
            if isinstance(statement, ast.Assign):
                target = statement.targets[0]
                assert isinstance(target, ast.Name)
                local = target.id if target.id not in self.binders else f"{target.id}_{len(self.binders)}"
                steps[local] = _put(statement.value, put)
                put[target.id] = ast.Name(local, ast.Load())
                looked_up.append(steps[local])
            elif isinstance(statement, ast.Return):
                assert statement.value is not None
                looked_up.append(_put(statement.value, put))
        self.leaf(call, failed, Within(steps, _terms(*looked_up)))

    def opens(self, node: ast.expr) -> bool:
        """Whether an expression has parts to be searched."""
        return isinstance(node, ast.BoolOp) or _is_all(node) or _helper(node, self.namespace) is not None

    def counter(self) -> str:
        name = self.fresh("failed")
        self.line(f"{name} = 0")
        return name

    def unless(self, guard: ast.expr, node: ast.BoolOp, failed: str | None) -> None:
        """A disjunction whose last member is a conjunction: that one is searched where no other holds."""
        flag = self.fresh("open")
        self.line(f"{flag} = False")
        self.attempt(f"{flag} = not ({ast.unparse(guard)})", guard, failed)
        self.line(f"if {flag}:")
        self.inside(lambda: self.search(node.values[-1], failed))

    def branch(self, node: ast.IfExp, failed: str | None) -> None:
        """``a if c else b``: search the branch that counts."""
        flag = self.fresh("side")
        self.line(f"{flag} = None")
        self.attempt(f"{flag} = bool({ast.unparse(node.test)})", node.test, failed)
        self.line(f"if {flag} is True:")
        self.inside(lambda: self.search(node.body, failed))
        self.line(f"if {flag} is False:")
        self.inside(lambda: self.search(node.orelse, failed))

    def loop(self, generator: ast.GeneratorExp, failed: str | None) -> None:
        """``all(… for … if …)``: nested loops."""
        outer, binders, conjunction = self.depth, dict(self.binders), failed
        for clause in generator.generators:
            items, source = self.fresh("items"), ast.unparse(clause.iter)
            self.line(f"{items} = ()")
            self.attempt(f"{items} = {source}", clause.iter, conjunction)
            self.line(f"for {ast.unparse(clause.target)} in {items}:")
            self.depth += 1
            for name in ast.walk(clause.target):
                if isinstance(name, ast.Name):
                    self.binders[name.id] = Binder(source, loops=True)
            for condition in clause.ifs:
                flag = self.fresh("meant")
                self.line(f"{flag} = False")
                self.attempt(f"{flag} = {ast.unparse(condition)}", condition, conjunction)
                self.line(f"if not {flag}: continue")
        self.line("looked_at[0] += 1")
        self.search(generator.elt)
        self.depth, self.binders = outer, binders

    def inside(self, write: Callable[[], None]) -> None:
        self.depth += 1
        write()
        self.depth -= 1

    def attempt(self, statement: str, node: ast.expr, failed: str | None, within: Within | None = None) -> None:
        """A statement whose look-ups may find nothing; that is a failure unless a part before failed."""
        self.line(f"try:\n    {statement}\nexcept LookupError:")
        self.inside(lambda: self.report(node, True, failed, within))

    def leaf(self, node: ast.expr, failed: str | None, within: Within | None = None) -> None:
        """A part that is not taken further apart."""
        flag = self.fresh("holds")
        self.line(f"{flag} = True")
        self.attempt(f"{flag} = {ast.unparse(node)}", node, failed, within)
        self.line(f"if not {flag}:")
        self.inside(lambda: self.report(node, False, failed, within))

    def report(self, node: ast.expr, missing: bool, failed: str | None, within: Within | None = None) -> None:
        """Yield a failure with the loop variables that stand; an absent look-up only if it is the first."""
        inside = within or Within({}, _terms(node))
        for name, value in inside.steps.items():
            self.line(f"{name} = None\ntry:\n    {name} = {ast.unparse(value)}\nexcept LookupError:\n    pass")
        named = {name: Binder(ast.unparse(value), loops=False) for name, value in inside.steps.items()}
        binders = self.binders | named
        bound = ", ".join(f"{name!r}: {name}" for name in binders)
        self.parts.append(Part(ast.unparse(node), inside.terms, binders))
        indent = ""
        if missing and failed:
            self.line(f"if not {failed}:")
            indent = "    "
        self.line(f"{indent}yield {len(self.parts) - 1}, {{{bound}}}, {missing}")
        if failed:
            self.line(f"{failed} += 1")


def _helper(node: ast.expr, namespace: Mapping[str, Any]) -> ast.FunctionDef | None:
    """The predicate that a call calls, if it is one of the project's own and of the known form."""
    if not isinstance(node, ast.Call) or not isinstance(node.func, ast.Name) or node.keywords:
        return None
    called = namespace.get(node.func.id)
    if not inspect.isfunction(called) or called.__defaults__ or called.__kwdefaults__:
        return None
    function = ast.parse(textwrap.dedent(inspect.getsource(called))).body[0]
    if not isinstance(function, ast.FunctionDef) or len(function.args.args) != len(node.args):
        return None
    *steps, last = [statement for statement in function.body if not _is_docstring(statement)]
    if not isinstance(last, ast.Return) or last.value is None or not all(map(_is_simple_assignment, steps)):
        return None
    own = {argument.arg for argument in function.args.args}
    named = {n.id for n in ast.walk(last) if isinstance(n, ast.Name)} - own - set(dir(builtins))
    local = {n.id for step in steps for n in ast.walk(step) if isinstance(n, ast.Name) and isinstance(n.ctx, ast.Store)}
    bound = {n.id for n in ast.walk(last) if isinstance(n, ast.Name) and isinstance(n.ctx, ast.Store)}
    return function if named - local - bound <= set(namespace) else None


def _put(node: ast.expr, put: Mapping[str, ast.expr]) -> ast.expr:
    """An expression with names replaced."""

    class Replacing(ast.NodeTransformer):
        def visit_Name(self, name: ast.Name) -> ast.expr:
            return put.get(name.id, name) if isinstance(name.ctx, ast.Load) else name

    replaced = Replacing().visit(copy.deepcopy(node))
    assert isinstance(replaced, ast.expr)
    return replaced


def _is_all(node: ast.expr) -> bool:
    return (
        isinstance(node, ast.Call)
        and isinstance(node.func, ast.Name)
        and node.func.id == "all"
        and len(node.args) == 1
        and isinstance(node.args[0], ast.GeneratorExp)
    )


def _terms(*nodes: ast.AST) -> tuple[tuple[str, CodeType], ...]:
    """The look-ups in expressions, innermost first, outside of inner loops."""
    found: dict[str, CodeType] = {}

    def visit(inner: ast.AST) -> None:
        if isinstance(inner, ast.GeneratorExp | ast.SetComp | ast.ListComp | ast.DictComp | ast.Lambda):
            return
        for child in ast.iter_child_nodes(inner):
            visit(child)
        if isinstance(inner, ast.Subscript):
            text = ast.unparse(inner)
            found.setdefault(text, compile(text, "<term>", "eval"))

    for node in nodes:
        visit(node)
    return tuple(found.items())
