"""What the text of an obligation is made of, as a digest that needs no lifting: the same digest, the same text.

A text follows from a step of a theory, from what is said and assumed there, and from the program that lifts them.  Of
the kernel and the models each definition goes into a digest that such a function names, and each that these name, by
the syntax trees of their modules; of modules that are imported on the way, whatever else stands at their top; and
their data.  All of ``proofs/`` goes in as it stands, with Python, Z3 and every package.  A name inside a function
counts as the module's, whether it is or not, so a digest may change where the text does not, never the other way about.
"""

from __future__ import annotations

import ast
import hashlib
import sys
import sysconfig
from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import dataclass, field
from functools import cache, cached_property
from importlib import metadata
from pathlib import Path
from typing import Any

from models.sources import READ, ROOT, sources
from proofs import scripts
from proofs.promise import Promise
from proofs.records import solvers_hashed
from proofs.theories import theory_of
from proofs.theory import EVERY_LOOKUP_IS_DEFINED

ROOMS = ("kernel", "models", "proofs")
"""The packages that a text is made of."""
LIFTER = "proofs.lift"
"""What it names outside of ``proofs/`` is part of every text."""
PLAIN = (ast.FunctionDef, ast.ClassDef, ast.Assign, ast.AnnAssign, ast.AugAssign, ast.Import, ast.ImportFrom)
"""Statements that do nothing but give names a meaning."""

SETS = (ast.AnnAssign, ast.AugAssign)
COMPREHENSIONS = (ast.ListComp, ast.SetComp, ast.DictComp, ast.GeneratorExp)

Name = tuple[str, str]
"""A module, and a name in it; without a name all of the module."""
WHOSE = "import of "
"""Stands before a name where only the import that gives it a meaning is meant, and not all that it then stands for."""


class Unknown(Exception):
    """Something of which the sources do not say what it is made of: its text is laid out each time."""


# ---- modules


@dataclass(frozen=True, eq=False)
class Statement:
    """A statement at the top of a module.

    ``said``: what it gives a meaning to, and a hash of how it is written, decorators with it.
    """

    module: str
    said: str
    node: ast.stmt

    @cached_property
    def refers(self) -> frozenset[Name]:
        """Every name of ours that it names; each chain of attributes as far as modules go."""
        return frozenset(_references(module(self.module), self.node))


@dataclass
class Module:
    """The statements at the top of a module: by each name they give a meaning to, and those that do more.

    ``imports``: modules, and names in them, by the names that they have here.
    """

    name: str
    binding: dict[str, list[Statement]] = field(default_factory=dict)
    acting: list[Statement] = field(default_factory=list)
    imports: dict[str, Name] = field(default_factory=dict)


@cache
def file_of(name: str) -> Path | None:
    """The file of a module of ours, none if there is no such module."""
    place = ROOT.joinpath(*name.split("."))
    if name.partition(".")[0] not in ROOMS:
        return None
    return next((path for path in (place.with_suffix(".py"), place / "__init__.py") if path.is_file()), None)


@cache
def module(name: str) -> Module:
    """Read a module."""
    path = file_of(name)
    if path is None:
        raise Unknown(f"no module {name}")
    source = path.read_text("utf-8")
    found, lines = Module(name), source.splitlines()
    for node in ast.parse(source).body:
        if not (isinstance(node, ast.Expr) and isinstance(node.value, ast.Constant)):
            _read(found, node, lines)
    return found


def _read(into: Module, node: ast.stmt, lines: Sequence[str]) -> None:
    inside = [node] if isinstance(node, ast.FunctionDef) else [*ast.walk(node)]
    names = tuple(dict.fromkeys(name for each in inside for name in _named(each)))
    first = min([node.lineno, *(each.lineno for each in getattr(node, "decorator_list", ()))])
    text = "\n".join(lines[first - 1 : node.end_lineno])
    statement = Statement(into.name, f"{into.name}: {', '.join(names)}: {_digest([text])}", node)
    into.imports.update(found for each in inside for found in _imported(each))
    for name in names:
        into.binding.setdefault(name, []).append(statement)
    if not isinstance(node, PLAIN) or not all(map(_is_name, _targets(node))):
        into.acting.append(statement)


def _targets(node: ast.stmt) -> Iterable[ast.expr]:
    return node.targets if isinstance(node, ast.Assign) else [node.target] if isinstance(node, SETS) else []


def _is_name(target: ast.expr) -> bool:
    """Tell whether an assignment gives names a meaning, and changes nothing that has one."""
    of = (ast.Name, ast.Tuple, ast.List, ast.Starred, ast.expr_context)
    return all(isinstance(each, of) for each in ast.walk(target))


def _named(node: ast.AST) -> Iterator[str]:
    if isinstance(node, ast.FunctionDef | ast.ClassDef | ast.AsyncFunctionDef):
        yield node.name
    elif isinstance(node, ast.Name) and isinstance(node.ctx, ast.Store):
        yield node.id


def _imported(node: ast.AST) -> Iterator[tuple[str, Name]]:
    """What an import gives a name to; of ``import a.b``, all of ``a.b``."""
    if isinstance(node, ast.Import):
        for alias in node.names:
            yield alias.asname or alias.name.partition(".")[0], (alias.name, "")
    elif isinstance(node, ast.ImportFrom):
        for alias in node.names:
            if node.level or alias.name == "*" or node.module is None:
                raise Unknown(f"line {node.lineno}: an import that does not say what of")
            yield alias.asname or alias.name, (node.module, alias.name)


# ---- what a definition names


def _references(here: Module, node: ast.AST, local: frozenset[str] = frozenset()) -> Iterator[Name]:
    """What a piece of a statement names, where these names are a function's own."""
    if isinstance(node, ast.Attribute):
        chain, base = [node.attr], node.value
        while isinstance(base, ast.Attribute):
            chain, base = [base.attr, *chain], base.value
        if isinstance(base, ast.Name) and base.id in here.imports and base.id not in local:
            yield here.name, WHOSE + base.id
            yield from _along(_meant(here.imports[base.id]), chain)
            return
    if isinstance(node, ast.Name) and node.id not in local:
        yield from _by_itself(here, node.id)
    elif isinstance(node, ast.Constant) and isinstance(node.value, str) and node.value.isidentifier():
        yield from _by_itself(here, node.value)
    yield from (_meant(target) for _, target in _imported(node))
    inside = local | _own(node)
    for child in ast.iter_child_nodes(node):
        yield from _references(here, child, inside if child in _within(node) else local)


def _within(node: ast.AST) -> Sequence[ast.AST]:
    """What of a function, or of a list that is made of another, has its own names."""
    if isinstance(node, ast.FunctionDef):
        return node.body
    if isinstance(node, ast.Lambda):
        return [node.body]
    if isinstance(node, COMPREHENSIONS):
        return [each for each in ast.iter_child_nodes(node) if each is not node.generators[0]]
    return []


def _own(node: ast.AST) -> frozenset[str]:
    """The names that a function has for itself; of one with ``global`` in it, none are taken for its own."""
    if not isinstance(node, (ast.FunctionDef, ast.Lambda, *COMPREHENSIONS)):
        return frozenset()
    if any(isinstance(each, ast.Global | ast.Nonlocal) for each in ast.walk(node)):
        return frozenset()
    names = {each.arg for each in ast.walk(node.args) if isinstance(each, ast.arg)} if hasattr(node, "args") else set()
    todo: list[ast.AST] = [*node.generators] if isinstance(node, COMPREHENSIONS) else [*_within(node)]
    while todo:
        each = todo.pop()
        names.update(_named(each))
        if not isinstance(each, (ast.FunctionDef, ast.Lambda, ast.ClassDef, *COMPREHENSIONS)):
            todo += ast.iter_child_nodes(each)
    return frozenset(names)


def _by_itself(here: Module, name: str) -> Iterator[Name]:
    """What a name stands for by itself."""
    if name in here.imports or name in here.binding:
        yield here.name, name


def _meant(target: Name) -> Name:
    """An imported name; a module, where it is one."""
    owner, name = target
    is_module = name and file_of(f"{owner}.{name}") is not None and name not in module(owner).binding
    return (f"{owner}.{name}", "") if is_module else target


def _along(target: Name, chain: Sequence[str]) -> Iterator[Name]:
    """Follow attributes from a module to what is meant; of anything that is no module, all of it."""
    owner, name = target
    if name or not chain or file_of(owner) is None:
        yield target
        return
    here, first = module(owner), chain[0]
    if first in here.imports:
        yield owner, WHOSE + first
        yield from _along(_meant(here.imports[first]), chain[1:])
    elif first in here.binding:
        yield owner, first
    else:
        inner = _meant((owner, first))
        yield from _along(inner, chain[1:]) if not inner[1] else (target,)


def closure(roots: Iterable[Name]) -> frozenset[str]:
    """What is said of every definition that these names name, and of those that they name."""
    found, todo, seen = set[str](), [*roots], set[Name | Statement]()
    while todo:
        owner, name = each = todo.pop()
        if each in seen or file_of(owner) is None:
            continue
        seen.add(each)
        here = module(owner)
        imported = name.removeprefix(WHOSE)
        if imported in here.imports:
            found.add(f"{owner}: {imported} is {'.'.join(here.imports[imported])}")
        if name in here.imports:
            todo.append(_meant(here.imports[name]))
        wanted = here.binding.get(name, ()) if name else [each for of in here.binding.values() for each in of]
        for statement in (*_happening(owner), *wanted):
            if statement not in seen:
                seen.add(statement)
                found.add(statement.said)
                todo += statement.refers
    return frozenset(found)


@cache
def _happening(name: str) -> tuple[Statement, ...]:
    """What happens where a module is imported, and with it its packages and whatever it imports."""
    found, todo, entered = list[Statement](), [name], set[str]()
    while todo:
        one = todo.pop()
        if one not in entered and file_of(one) is not None:
            entered.add(one)
            here = module(one)
            todo += [one.rpartition(".")[0], *(owner for owner, _ in here.imports.values())]
            todo += [f"{owner}.{each}" for owner, each in here.imports.values() if each]
            found += here.acting
    return tuple(found)


# ---- what a text is made of


def key_of(row: str, column: str) -> str | None:
    """The digest of what the text of an obligation is made of; none where somebody cannot say it.

    Raises:
        FileNotFoundError: its row has no script.
    """
    theory, name = theory_of(row)
    names = scripts.hypotheses(row, column)
    said = [theory.site, theory.system, *(theory.read[each] for each in names)]
    if name in theory.steps:
        said.append(theory.steps[name])
    if column in theory.promises:
        said += _of_promise(theory.promises[column])
    elif column != EVERY_LOOKUP_IS_DEFINED:
        said.append(theory.read[column])
    try:
        return _digest([row, column, *names, _of_everything(), *map(_of, said)])
    except Unknown:
        return None


def _of_promise(promise: Promise) -> Iterator[Callable[..., Any]]:
    """What a promise says; of the steps that its links go by only the own one, of its row, is lifted."""
    yield from promise.ends
    for link in promise.links:
        yield from (each for each in (link.holds, link.provided, link.rank) if each is not None)


@cache
def _of(given: Callable[..., Any]) -> str:
    """The digest of a function, or a type, that is found by its name."""
    if getattr(sys.modules[given.__module__], given.__name__, None) is not given:
        raise Unknown(f"{given} is not what its module says")
    return _digest(sorted(closure([(given.__module__, given.__name__)])))


@cache
def whole() -> str:
    """The digest of all sources, with what they run on: where it is the same, so is everything that follows of them."""
    return _digest([*_around(), *map(_as_it_stands, sources(READ))])


@cache
def _of_everything() -> str:
    """What every text is made of beside its theory: the program, data, Python and packages."""
    lifter = [(name, "") for name in _modules(ROOT / LIFTER.replace(".", "/"))]
    named = sorted(each for each in closure(lifter) if not each.startswith("proofs."))
    data = [each for each in sources(ROOMS) if each.suffix == ".toml" or ROOT / "proofs" in each.parents]
    return _digest([*_around(), *named, *(_as_it_stands(each) for each in data if scripts.FOLDER not in each.parents)])


def _around() -> Iterator[str]:
    yield from (sys.version, sysconfig.get_platform(), str(solvers_hashed()))
    yield from sorted(f"{each.name} {each.version}" for each in metadata.distributions())


def _as_it_stands(path: Path) -> str:
    return f"{path.relative_to(ROOT)} {hashlib.sha256(path.read_bytes()).hexdigest()}"


def _modules(folder: Path) -> Iterator[str]:
    for path in sorted(folder.glob("*.py")):
        yield ".".join(path.relative_to(ROOT).with_suffix("").parts).removesuffix(".__init__")


def _digest(said: Iterable[str]) -> str:
    return hashlib.sha256("\0".join(said).encode()).hexdigest()
