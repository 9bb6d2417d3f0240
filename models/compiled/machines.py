"""Rewrite the kernel's functions and hand them to numba.

What is rewritten, and nothing else:

- a frozen dataclass is a named tuple (``records.py``), its construction gives every field in order;
- ``replace(record, field=...)`` is a function made for these fields, resolved by the record's type;
- a member of an enumeration is its number, and so is a name: whoever calls gives numbers in place of texts;
- a map is a typed list of pairs, a set one of items (``maps.py``): ``in``, ``[key]``, ``| {key: value}``, and ``{}``
  for a field of a record;
- ``any``, ``all`` and ``{key: ...}`` over ``some_map.items()`` are loops in functions made for them (``loops.py``);
- docstrings, asserts (they are proved) and annotations are left out.

``//`` and ``%`` round down as in Python, and a divisor of 0 raises. Integers have 64 bits, see
:data:`models.compiled.records.LEAST`. Each function is compiled when it is first called with new types.
What was compiled is kept for the next process (``kept.py``).
"""

from __future__ import annotations

import ast
import dataclasses
import inspect
import sys
import types
import typing
from collections.abc import Callable, Iterable, Iterator
from enum import Enum
from functools import cache
from pathlib import Path
from types import SimpleNamespace
from typing import Any

from numba.extending import overload

from models.compiled import loops, maps
from models.compiled.kept import compiled
from models.compiled.records import (
    LEAST,
    MOST,
    compiled_type,
    hints_of,
    is_enumeration,
    is_map,
    is_name,
    is_record,
    is_set,
    number_of,
    packed,
    tuple_class,
)
from models.subset import unfit_class, unfit_name

Code = Callable[..., Any]

KNOWN = (
    *(ast.Return, ast.Assign, ast.If, ast.Expr, ast.Assert),
    *(ast.IfExp, ast.BoolOp, ast.UnaryOp, ast.BinOp, ast.Compare, ast.Call, ast.keyword, ast.Attribute),
    *(ast.Subscript, ast.Tuple, ast.Name, ast.Constant, ast.Load, ast.Store, ast.And, ast.Or, ast.Not, ast.USub),
    *(ast.Add, ast.Sub, ast.Mult, ast.FloorDiv, ast.Mod),
    *(ast.Eq, ast.NotEq, ast.Lt, ast.LtE, ast.Gt, ast.GtE, ast.In, ast.NotIn, ast.DictComp),
)
"""The constructs that mean the same to numba as to CPython, for the types of the machines on board."""


class NotCompilable(Exception):
    """A construct that the rewriting does not know, with its file and line."""

    def __init__(self, path: str, line: int, what: str) -> None:
        super().__init__(f"{path}:{line}: {what}")


def compile_machines(modules: Iterable[types.ModuleType], **options: Any) -> SimpleNamespace:
    """Compile some modules of the kernel, and whatever they call.

    The result has an attribute for each module, by its last name, with the module's functions, its records as
    named tuples, and its constants packed: ``compile_machines([odometry]).odometry``.  ``options`` are numba's.

    Raises:
        NotCompilable: a function, or a type, is not of the kind that can be rewritten.
    """
    program = _Program(options)
    return SimpleNamespace(
        **{each.__name__.rpartition(".")[2]: SimpleNamespace(**program.names(each)) for each in modules}
    )


class _Program:
    """Every function rewritten so far, and one table of global names for each module."""

    def __init__(self, options: dict[str, Any]) -> None:
        self._names: dict[str, dict[str, Any]] = {}
        self._options = options

    def names(self, module: types.ModuleType) -> dict[str, Any]:
        """Return what the global names of a module stand for."""
        if module.__name__ in self._names:
            return self._names[module.__name__]
        names = self._names[module.__name__] = {"__name__": __name__}
        for name, value in vars(module).items():
            if _is_machines(value):
                if value.__module__ != module.__name__:
                    names[name] = self.names(sys.modules[value.__module__])[value.__name__]
            elif is_record(value):
                names[name] = tuple_class(value)
            elif _is_constant(value) and not name.startswith("__") and not _is_beyond(value):
                names[name] = packed(value)
        for tree in _parsed(module).body:
            if isinstance(tree, ast.FunctionDef):
                names[tree.name] = compiled(Rewriting(module, tree, self.names).function(names), **self._options)
            elif isinstance(tree, ast.ClassDef):
                _check_class(module, tree)
            elif not isinstance(tree, ast.Import | ast.ImportFrom | ast.Assign | ast.AnnAssign | ast.Expr):
                raise _refused(module, tree, f"{type(tree).__name__} outside a function cannot be compiled")
        return names


class Rewriting(ast.NodeTransformer):
    """Rewrites one function."""

    def __init__(
        self, module: types.ModuleType, tree: ast.FunctionDef, names_of: Callable[[types.ModuleType], dict[str, Any]]
    ) -> None:
        self._module, self._tree, self._names_of = module, tree, names_of
        self._at: ast.AST = tree
        self._made: dict[str, Any] = {}
        self._locals = loops.locals_of(tree)
        unfit = unfit_name(tree)
        if unfit is not None:
            raise self._refused(unfit.node, f"{unfit.what}: {unfit.hint}")
        hidden = self._locals & (vars(module).keys() | {"any", "all"})
        if hidden:
            raise self._refused(tree, f"{min(hidden)} is a name of the module, or any or all, and a local: rename it")

    def function(self, names: dict[str, Any]) -> Code:
        """Return the function as numba is to have it, with these global names."""
        tree = self._tree
        hints = typing.get_type_hints(getattr(self._module, tree.name))
        if tree.decorator_list or tree.args.vararg or tree.args.kwarg or tree.args.kwonlyargs or tree.args.posonlyargs:
            raise self._refused(tree, "a decorator, or a parameter that is not a plain one")
        for annotation in hints.values():
            _check_type(self._module, tree, annotation)
        arguments = ast.arguments(
            posonlyargs=[], args=[ast.arg(each.arg) for each in tree.args.args], kwonlyargs=[], kw_defaults=[],
            defaults=[self.visit(default) for default in tree.args.defaults],
        )  # fmt: skip
        body = [new for old in tree.body for new in self._statement(old)]
        rewritten = ast.FunctionDef(name=tree.name, args=arguments, body=body, decorator_list=[])
        whole = ast.fix_missing_locations(ast.Module([ast.copy_location(rewritten, tree)], []))
        names |= self._made
        made: dict[str, Any] = {}
        exec(compile(whole, _path(self._module), "exec"), names, made)
        return typing.cast(Code, made[tree.name])

    def _statement(self, node: ast.stmt) -> Iterator[ast.stmt]:
        if isinstance(node, ast.Assert) or (isinstance(node, ast.Expr) and isinstance(node.value, ast.Constant)):
            return
        if isinstance(node, ast.If):
            body, other = ([new for old in part for new in self._statement(old)] for part in (node.body, node.orelse))
            yield ast.copy_location(ast.If(self.visit(node.test), body or [ast.Pass()], other), node)
        else:
            yield self.visit(node)

    def visit(self, node: ast.AST) -> Any:
        """Refuse what is not known; rewrite the rest."""
        self._at = node if hasattr(node, "lineno") else self._at
        if isinstance(node, ast.AnnAssign) and node.value is not None:
            return self.visit(ast.copy_location(ast.Assign([node.target], node.value), node))
        if not isinstance(node, KNOWN):
            raise self._refused(node, f"{type(node).__name__} cannot be compiled")
        return super().visit(node)

    def visit_Constant(self, node: ast.Constant) -> ast.Constant:
        """Only whole numbers of 64 bits and truth values."""
        if type(node.value) not in (int, bool) or _is_beyond(node.value):
            raise self._refused(node, f"the constant {node.value!r} cannot be compiled")
        return node

    def visit_Return(self, node: ast.Return) -> ast.Return:
        """Something is returned on every way."""
        if node.value is None:
            raise self._refused(node, "nothing is returned")
        return ast.copy_location(ast.Return(self.visit(node.value)), node)

    def visit_Attribute(self, node: ast.Attribute) -> ast.expr:
        """Put the number for the member of an enumeration."""
        owner = vars(self._module).get(node.value.id) if isinstance(node.value, ast.Name) else None
        if is_enumeration(owner):
            return ast.copy_location(ast.Constant(number_of(getattr(owner, node.attr))), node)
        return typing.cast(ast.expr, self.generic_visit(node))

    def visit_Name(self, node: ast.Name) -> ast.Name:
        """An enumeration is there only for its members, a constant only if it has 64 bits."""
        value = vars(self._module).get(node.id)
        if is_enumeration(value) or _is_beyond(value):
            raise self._refused(node, f"{node.id} is an enumeration without a member, or beyond 64 bits")
        return node

    def visit_Compare(self, node: ast.Compare) -> ast.expr:
        """Look for a key in a map as for an item in a set or a tuple."""
        looked_for = [op for op in node.ops if isinstance(op, ast.In | ast.NotIn)]
        if not looked_for:
            return typing.cast(ast.expr, self.generic_visit(node))
        if len(node.ops) > 1:
            raise self._refused(node, "a chain with in cannot be compiled")
        found: ast.expr = self._helped(node, maps.contains, self.visit(node.comparators[0]), self.visit(node.left))
        if isinstance(looked_for[0], ast.NotIn):
            found = ast.UnaryOp(ast.Not(), found)
        return ast.copy_location(found, node)

    def visit_Subscript(self, node: ast.Subscript) -> ast.expr:
        """Take an item of a tuple by a number that is written there, else a value of a map by its key."""
        if isinstance(node.slice, ast.Constant | ast.UnaryOp):
            return typing.cast(ast.expr, self.generic_visit(node))
        return self._helped(node, maps.value_at, self.visit(node.value), self.visit(node.slice))

    def visit_BinOp(self, node: ast.BinOp) -> ast.expr:
        """Put one entry into a map."""
        if not isinstance(node.op, ast.BitOr):
            return typing.cast(ast.expr, self.generic_visit(node))
        if not isinstance(node.right, ast.Dict) or len(node.right.keys) != 1 or node.right.keys[0] is None:
            raise self._refused(node, "BitOr cannot be compiled but with one entry on its right")
        key, value = self.visit(node.right.keys[0]), self.visit(node.right.values[0])
        return self._helped(node, maps.with_entry, self.visit(node.left), key, value)

    def visit_DictComp(self, node: ast.DictComp) -> ast.expr:
        """Make a map of the entries of another, with the same keys."""
        target = node.generators[0].target
        keys = target.elts if isinstance(target, ast.Tuple) else [target]
        if ast.dump(node.key) != ast.dump(ast.Name(getattr(keys[0], "id", ""), ast.Load())):
            raise self._refused(node, "a map with other keys cannot be compiled")
        return self._looped(node, node.generators, "map", node.value)

    def _looped(self, node: ast.expr, generators: list[ast.comprehension], kind: str, each: ast.expr) -> ast.expr:
        problem = loops.problem_of(generators)
        if problem:
            raise self._refused(node, problem)
        (only,) = generators
        names = tuple(typing.cast(ast.Name, name).id for name in typing.cast(ast.Tuple, only.target).elts)
        source = typing.cast(ast.Attribute, typing.cast(ast.Call, only.iter).func).value
        conditions = [self.visit(test) for test in only.ifs]
        loop = loops.Loop(kind, names, conditions, self.visit(each))
        free = loop.free(self._locals)
        name = f"__{kind}_{self._tree.name}_{node.lineno}_{node.col_offset}"
        whole = ast.fix_missing_locations(ast.Module([ast.copy_location(loop.function(name, free), node)], []))
        made: dict[str, Any] = {}
        exec(compile(whole, _path(self._module), "exec"), self._names_of(self._module), made)
        self._made |= {name: compiled(made[name]), loops.LIST: loops.TypedList}
        given = [self.visit(source), *(ast.Name(each, ast.Load()) for each in free)]
        return ast.copy_location(ast.Call(ast.Name(name, ast.Load()), given, []), node)

    def _helped(self, node: ast.expr, helper: Code, *arguments: ast.expr) -> ast.expr:
        name = f"__{helper.__name__}"
        self._made[name] = helper
        return ast.copy_location(ast.Call(ast.Name(name, ast.Load()), list(arguments), []), node)

    def _called(self, node: ast.Call) -> tuple[Any, ast.expr]:
        """What is called, and by which name of this module: one of another module gets a name of its own."""
        if isinstance(node.func, ast.Name):
            return vars(self._module).get(node.func.id), node.func
        if isinstance(node.func, ast.Attribute) and isinstance(node.func.value, ast.Name):
            other = vars(self._module).get(node.func.value.id)
            if isinstance(other, types.ModuleType) and _is_machines(vars(other).get(node.func.attr)):
                name = f"__{node.func.value.id}_{node.func.attr}"
                self._made[name] = self._names_of(other)[node.func.attr]
                return vars(other)[node.func.attr], ast.Name(name, ast.Load())
        return None, node.func

    def visit_Call(self, node: ast.Call) -> ast.expr:
        """Construct with every field in order; replace by a function made for it; call what is a function."""
        built_in = isinstance(node.func, ast.Name) and node.func.id in {"any", "all"} - vars(self._module).keys()
        if built_in and isinstance(node.func, ast.Name) and len(node.args) == 1:
            if not isinstance(node.args[0], ast.GeneratorExp):
                raise self._refused(node, f"{node.func.id} of what is written nowhere cannot be compiled")
            return self._looped(node, node.args[0].generators, node.func.id, node.args[0].elt)
        called, function = self._called(node)
        given = {keyword.arg: self._given(called, keyword) for keyword in node.keywords}
        if None in given:
            raise self._refused(node, "a call with ** cannot be compiled")
        arguments = [self.visit(argument) for argument in node.args]
        if called is dataclasses.replace:
            name = "__replace_" + "_and_".join(map(str, given))
            self._made[name] = replacement(tuple(map(str, given)))
            new = ast.Call(ast.Name(name, ast.Load()), [*arguments, *given.values()], [])
        elif is_record(called):
            new = ast.Call(function, self._fields(node, called, arguments, given), [])
        elif _is_machines(called):
            new = ast.Call(function, arguments, [ast.keyword(name, value) for name, value in given.items()])
        else:
            raise self._refused(node, f"{ast.unparse(node.func)} is no function of a machine")
        return ast.copy_location(new, node)

    def _given(self, called: Any, given: ast.keyword) -> ast.expr:
        hint = hints_of(called).get(str(given.arg)) if is_record(called) else None
        if not isinstance(given.value, ast.Dict) or given.value.keys or not is_map(hint):
            return typing.cast(ast.expr, self.visit(given.value))
        name = f"__empty_{called.__name__}_{given.arg}"
        self._made[name] = maps.empty_of(compiled_type(hint))
        return ast.copy_location(ast.Call(ast.Name(name, ast.Load()), [], []), given.value)

    def _fields(self, node: ast.Call, cls: Any, arguments: list[Any], given: dict[Any, Any]) -> list[ast.expr]:
        hints = hints_of(cls)
        by_name = dict(zip(hints, arguments, strict=False)) | given
        for field in dataclasses.fields(cls):
            if field.name not in by_name:
                name = f"__default_{cls.__name__}_{field.name}"
                self._made[name] = packed(field.default)
                by_name[field.name] = ast.Name(name, ast.Load())
        return [by_name[name] for name in hints]

    def _refused(self, node: ast.AST, what: str) -> NotCompilable:
        return _refused(self._module, node if hasattr(node, "lineno") else self._at, what)


@cache
def replacement(fields: tuple[str, ...]) -> Code:
    """Return what stands in compiled code for ``replace`` with these fields, whatever the record's type."""
    head = f"def replaced(_old, {', '.join(fields)}): return "
    stub = _made(head + "_old")

    def typed(old: Any) -> Code:
        values = (name if name in fields else f"_old.{name}" for name in old.instance_class._fields)
        return _made(head + f"_cls({', '.join(values)})", _cls=old.instance_class)

    overload(stub)(_made(head + "_typed(_old)", _typed=typed))
    return stub


def _made(source: str, **names: Any) -> Code:
    made: dict[str, Any] = {}
    exec(source, {"__name__": __name__, **names}, made)
    (function,) = made.values()
    return typing.cast(Code, function)


def _check_class(module: types.ModuleType, tree: ast.ClassDef) -> None:
    cls = getattr(module, tree.name)
    unfit = unfit_class(cls)
    if unfit is not None:
        raise _refused(module, tree, f"{unfit.what}: {unfit.hint}")
    if is_enumeration(cls):
        return
    if not is_record(cls):
        raise _refused(module, tree, f"{tree.name} is neither an enumeration nor a frozen dataclass")
    for node in tree.body:
        if isinstance(node, ast.AnnAssign) and isinstance(node.target, ast.Name):
            _check_type(module, node, hints_of(cls).get(node.target.id))
        elif not isinstance(node, ast.Expr):
            raise _refused(module, node, f"{tree.name} has something that is not a field")


def _check_type(module: types.ModuleType, node: ast.AST, annotation: Any) -> None:
    if typing.get_origin(annotation) is tuple or is_map(annotation) or is_set(annotation):
        for item in typing.get_args(annotation):
            _check_type(module, node, item)
    elif (
        annotation not in (int, bool)
        and not is_name(annotation)
        and not is_enumeration(annotation)
        and not is_record(annotation)
    ):
        raise _refused(module, node, f"a value of type {annotation} cannot be compiled")


def _refused(module: types.ModuleType, node: Any, what: str) -> NotCompilable:
    return NotCompilable(_path(module), node.lineno, what)


def _is_constant(value: object) -> bool:
    if isinstance(value, tuple):
        return all(_is_constant(item) for item in value)
    return isinstance(value, int | Enum) or is_record(type(value))


def _is_beyond(value: object) -> bool:
    return isinstance(value, int) and not LEAST <= value <= MOST


def _is_machines(function: Any) -> bool:
    return inspect.isfunction(function) and function.__module__.partition(".")[0] not in sys.stdlib_module_names


def _path(module: types.ModuleType) -> str:
    return str(inspect.getsourcefile(module))


def _parsed(module: types.ModuleType) -> ast.Module:
    return ast.parse(Path(_path(module)).read_text("utf-8"))
