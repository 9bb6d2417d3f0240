"""What must be true of the sources of every theory beside the interlocking; ``tests/proofs/test_lints_on_board.py``.

No truth by fiat: what a transition writes into its machine comes from the event, from the machine's
own state and from the parameters that it is built with.  What is really there may be asked in two
places: in a named assumption, to refuse a step that nature does not take, and in what becomes of
the truth itself.  Nor does a step refuse an event without saying by a name why nature does not bring it.
"""

from __future__ import annotations

import ast
import dataclasses
import importlib
import inspect
import pkgutil
from collections.abc import Collection, Iterable, Iterator, Mapping
from dataclasses import dataclass, field
from functools import cache
from pathlib import Path
from types import ModuleType
from typing import Any, get_args, get_type_hints

import kernel.onboard
from proofs.catalogue import INTERLOCKING
from proofs.lift.sources import definition_of
from proofs.lints import SEES_THROUGH
from proofs.reach import called_by
from proofs.theories import THEORIES
from proofs.theory import Theory

OTHERS: Mapping[str, Theory] = {name: theory for name, theory in THEORIES.items() if theory is not INTERLOCKING}
"""The theories beside the interlocking."""

TOLD: Mapping[str, Mapping[str, str]] = {
    "joint": {
        "head_mm": "lists come for trains that are located; which these are is no more than their names",
    },
    "alarm_tone": {
        "bodies": "which trains there are on the line; of a train nothing but what is told of it",
        "told": "a history of what the handset itself was told, and nothing else",
    },
    "train": {"awaited_mm": "where a list has the tag that the orders told of, and nothing of where it lies"},
    "crossing": {"tracks": "which tracks lead over the road is how the crossing is set up; it says nothing of trains"},
    "arrival": {"brought": "a history of what the radio brought: what the crossing was told, and nothing else"},
    "promise": {"line_mm_s": "the greatest speed of the line is written for trains and crossings alike"},
    "stopping": {"error_mm": "what places err at most is written, for map matching and for stops alike"},
    "link": {"ends": "which links there are is how machines are set up; of an end only its link is told"},
}
"""Fields by theory that a machine may be told although they are no machine's; why.

Of a site a field with all that is in it; of a state only which keys there are.
"""

HELD: Mapping[str, frozenset[str]] = {"joint": frozenset({"begins_mm", "block_ends_mm"})}
"""Fields of a state that a machine holds though they are plain numbers: the lists that a unit was given."""

NOTED: Mapping[str, Mapping[str, str]] = {
    "train": {
        "awaited_mm": "the place of a tag that the orders told of, as it was told to the computer",
        "proceeds": "what is promised while the orders let it proceed is promised by what the computer was told",
    },
    "antenna_spacing": {
        "head_newest": "a tag is numbered by where it lies; that it was read is what the machine is told"
    },
    "braking": {
        "demanded": "what is claimed of a demand is claimed of the one that the control was given",
        "wanted_mm": "the end that the unit wants is what the control is told",
    },
    "brake_demand": {
        "may_proceed": "what is claimed of an order is claimed of what the unit was told",
        "acknowledged": "what is claimed of a release is claimed of what the driver did",
    },
    "stopping": {
        "here": "the stop with which a unit begins is what it is told; that the tram has come to it is assumed"
    },
    "crossing": {
        "newest": "the number with which the crossing starts is what its memory tells it",
        "asked": "and so is the one by which it asks a person to look",
    },
    "alarm_tone": {"newest_ms": "the clock that the server reads at its start is what it is told"},
    "alarm_distance": {"received_mm": "a receiver that hangs tells again what it told; that is what the unit was told"},
}
"""Fields of history, by theory, in which an event that the machine is told is noted as it is; why."""


# ---- the parts of a theory


def modules_of(functions: Iterable[Any]) -> list[ModuleType]:
    """Give the modules that functions stand in, each once."""
    return list(dict.fromkeys(module for each in functions if (module := inspect.getmodule(each)) is not None))


def world(theory: Theory) -> list[ModuleType]:
    """Give the modules of a theory's world: of its steps, its premises and its state."""
    return modules_of([*theory.steps.values(), *theory.premises.values(), theory.system])


def own(module: ModuleType) -> dict[str, Any]:
    """Give the functions that a module defines and lets others see."""
    return {
        name: value
        for name, value in vars(module).items()
        if inspect.isfunction(value) and value.__module__ == module.__name__ and not name.startswith("_")
    }


@cache
def assumptions(theory: Theory) -> dict[str, Any]:
    """Give what is assumed of nature: the predicates of a theory's world that a step is refused by."""
    defined = {name: value for module in world(theory) for name, value in own(module).items()}
    steps = {function for each in theory.steps.values() for function in (each, *called_by(each))}
    asked = {
        node.func.id
        for function in steps
        if function in defined.values()
        for statement in ast.walk(definition_of(function))
        if isinstance(statement, ast.If) and _refuses(statement)
        for node in ast.walk(statement.test)
        if isinstance(node, ast.Call) and isinstance(node.func, ast.Name)
    }
    return {name: value for name, value in defined.items() if name in asked}


def asking(theory: Theory, name: str) -> list[str]:
    """Give the transitions of a theory that an assumption can refuse."""
    wanted = assumptions(theory).get(name)
    return [step for step, function in theory.steps.items() if wanted in called_by(function)]


def _refuses(statement: ast.If) -> bool:
    return not statement.orelse and [ast.unparse(line) for line in statement.body] == ["return system"]


def records_of(kind: Any) -> set[type]:
    """Give the records of the world that a type is made of."""
    if dataclasses.is_dataclass(kind) and isinstance(kind, type):
        if kind.__module__.split(".")[0] == "kernel":
            return set()
        return {kind}.union(*(records_of(each) for each in get_type_hints(kind).values()))
    return set().union(*(records_of(each) for each in get_args(kind)))


def machine_fields(record: type) -> frozenset[str]:
    """Give the names of the fields that are a machine's: those that hold a record of the kernel, or some by name."""
    return frozenset(
        name
        for each in records_of(record)
        for name, kind in get_type_hints(each).items()
        if _is_of_kernel(kind) or (len(get_args(kind)) == 2 and _is_of_kernel(get_args(kind)[1]))
    )


def _is_of_kernel(kind: Any) -> bool:
    return dataclasses.is_dataclass(kind) and getattr(kind, "__module__", "").split(".")[0] == "kernel"


# ---- no truth by fiat


@dataclass(frozen=True)
class Open:
    """What a machine may be told.

    ``machine``: the fields that are a machine's, or parameters of one.  ``told``: fields that are not
    and that it may be told.  ``noted``: fields of history that may note an event.  ``asked``: the names
    of assumptions.  ``result``: the name of the type that transitions give.
    """

    machine: frozenset[str]
    told: frozenset[str]
    noted: frozenset[str]
    asked: frozenset[str]
    result: str


def open_to(theory: Theory) -> Open:
    """Give what the machines of a theory may be told."""
    told = frozenset(TOLD.get(theory.name, {}))
    parameters = told & frozenset(get_type_hints(theory.site))
    return Open(
        machine_fields(theory.system) | machine_fields(theory.site) | parameters | HELD.get(theory.name, frozenset()),
        told - parameters,
        frozenset(NOTED.get(theory.name, {})),
        frozenset(assumptions(theory)),
        theory.system.__name__,
    )


def told_the_truth(source: str, may: Open) -> list[str]:
    """Find where a transition tells a machine what is really there, or decides by it without a name."""
    found: list[str] = []
    for node in ast.parse(source).body:
        if isinstance(node, ast.FunctionDef) and isinstance(node.returns, ast.Name) and node.returns.id == may.result:
            found += _Reader(node, may).offences()
    return found


@dataclass
class _Reader:
    """Reads one transition from its first statement to its last.

    ``carriers``: the names that hold truth, and which.  ``made_of``: the parameters that a name is made of.
    """

    function: ast.FunctionDef
    may: Open
    carriers: dict[str, str] = field(default_factory=dict)
    made_of: dict[str, frozenset[str]] = field(default_factory=dict)
    told: set[str] = field(default_factory=set)
    written: dict[str, int] = field(default_factory=dict)

    def offences(self) -> Iterator[str]:
        """Give all that is wrong with it."""
        parameters = [argument.arg for argument in self.function.args.args[2:]]
        self.made_of = {name: frozenset({name}) for name in parameters}
        yield from self.read(self.function.body)
        for name, line in self.written.items():
            if name in self.told:
                yield f"line {line}: {self.function.name} writes {name} as true and tells it to a machine"

    def read(self, body: Iterable[ast.stmt]) -> Iterator[str]:
        """Give the offences of some statements."""
        for statement in body:
            if isinstance(statement, ast.If):
                yield from self._written(statement.test)
                yield from self._decided(statement)
                yield from self.read(statement.body)
                yield from self.read(statement.orelse)
                continue
            yield from self._written(statement)
            if isinstance(statement, ast.Assign | ast.AnnAssign) and statement.value is not None:
                self._carry(statement, statement.value)

    def seen(self, node: ast.AST) -> str:
        """Give the first thing in an expression that no machine may be told, or nothing."""
        path, below = [], node
        while isinstance(below, ast.Attribute | ast.Subscript):
            path.append(below.attr if isinstance(below, ast.Attribute) else "[]")
            below = below.value
        if isinstance(below, ast.Name):
            if self.may.machine & set(path):
                return ""
            if below.id in ("site", "system"):
                return "" if path and path[0] in self.may.told else ".".join([below.id, *path[-1:]])
            return self.carriers.get(below.id, "")
        return next((found for child in ast.iter_child_nodes(node) if (found := self.seen(child))), "")

    def _parameters(self, node: ast.AST) -> frozenset[str]:
        names = [each.id for each in ast.walk(node) if isinstance(each, ast.Name)]
        return frozenset().union(*(self.made_of.get(name, frozenset()) for name in names))

    def _carry(self, statement: ast.Assign | ast.AnnAssign, value: ast.expr) -> None:
        held, parameters = self.seen(value), self._parameters(value)
        for target in statement.targets if isinstance(statement, ast.Assign) else [statement.target]:
            for node in ast.walk(target):
                if isinstance(node, ast.Name):
                    self.carriers.pop(node.id, None)
                    if held:
                        self.carriers[node.id] = held
                    self.made_of[node.id] = parameters

    def _written(self, node: ast.AST) -> Iterator[str]:
        """Give what is written into a machine that it may not be told."""
        for call in ast.walk(node):
            if isinstance(call, ast.Name) and call.id in SEES_THROUGH:
                yield f"line {call.lineno}: {self.function.name} uses {call.id}"
            if not isinstance(call, ast.Call) or not isinstance(call.func, ast.Name):
                continue
            for keyword in call.keywords:
                if keyword.arg in self.may.machine:
                    self.told |= self._parameters(keyword.value)
                    if self.seen(keyword.value):
                        yield (
                            f"line {call.lineno}: {self.function.name} writes {self.seen(keyword.value)}"
                            f" into {keyword.arg}"
                        )
                elif call.func.id in ("replace", self.may.result) and keyword.arg not in self.may.noted:
                    self.written |= dict.fromkeys(_named(keyword.value), call.lineno)

    def _decided(self, statement: ast.If) -> Iterator[str]:
        """Give what a branch hangs on that it may not hang on."""
        rest = _WithoutCalls(self.may.asked)
        test = rest.visit(ast.parse(ast.unparse(statement.test), mode="eval").body)
        if rest.met and not _refuses(statement):
            yield f"line {statement.lineno}: {self.function.name} does more on an assumption than refuse"
        if _refuses(statement):
            for part in _operands(statement.test):
                names = {node.id for node in ast.walk(part) if isinstance(node, ast.Name)}
                if names & set(self.made_of) and not names & {"site", "system", *self.may.asked}:
                    told = ast.unparse(part)
                    yield f"line {statement.lineno}: {self.function.name} refuses events by `{told}` without a name"
        if self.seen(test) and not (rest.met and _refuses(statement)):
            yield f"line {statement.lineno}: {self.function.name} decides by {self.seen(test)}"


def _operands(test: ast.expr) -> list[ast.expr]:
    """Give what a step is refused by, each of it alone."""
    if isinstance(test, ast.BoolOp) and isinstance(test.op, ast.Or):
        return [part for value in test.values for part in _operands(value)]
    return [test]


def _named(value: ast.expr) -> list[str]:
    """Give the names that a value is, by itself or by choice."""
    if isinstance(value, ast.IfExp):
        return [*_named(value.body), *_named(value.orelse)]
    return [value.id] if isinstance(value, ast.Name) else []


class _WithoutCalls(ast.NodeTransformer):
    """Puts a truth in place of calls of the functions named."""

    def __init__(self, names: Collection[str]) -> None:
        self.names = names
        self.met = False

    def visit_Call(self, node: ast.Call) -> ast.AST:
        if isinstance(node.func, ast.Name) and node.func.id in self.names:
            self.met = True
            return ast.Constant(True)
        return node


# ---- what is written is listed


def unlisted(theory: Theory) -> list[str]:
    """Find public functions of a theory's world and claims that it neither lists nor uses."""
    listed = {*theory.steps.values(), *theory.read.values()}
    reached = {function for each in listed for function in (each, *called_by(each))}
    rooms = dict.fromkeys([*world(theory), *modules_of([*theory.initial.values(), *theory.invariants.values()])])
    return [
        f"{module.__name__}.{name}: written, and not listed"
        for module in rooms
        for name, value in own(module).items()
        if next(iter(inspect.signature(value).parameters), "") in ("site", "system") and value not in reached
    ]


def unregistered(folder: Path) -> list[str]:
    """Find files of theories that no list of theories has."""
    return [
        f"{path.name}: no theory of this name is registered"
        for path in sorted(folder.glob("*.py"))
        if path.stem not in {"__init__", *THEORIES} and "THEORY = " in path.read_text("utf-8")
    ]


# ---- one computer decides on board

NO_MACHINES = frozenset({"computer", "way"})
"""Modules on board that nobody runs the computer's machines by: the computer itself, and ranges of places."""

BESIDE_THE_COMPUTER: Mapping[str, tuple[frozenset[str], str]] = {
    "models/reproduce": (
        frozenset({"feature", "odometry", "split", "tag_reader", "train_length"}),
        "a paper's figure is of one machine, put to what the paper put to it",
    ),
    "models/rides": (
        frozenset({"braking", "feature"}),
        "features are in no computer yet, and ends come without orders",
    ),
    "tests/independent/physics/onboard.py": (frozenset({"braking"}), "ends come without orders"),
    "tests/independent/physics/planted_faults.py": (
        frozenset({"odometry"}),
        "a fault is planted in one machine",
    ),
    "tests/independent/world": (
        frozenset({"braking"}),
        "a world of blocks has no millimetres: of a cab it knows its brake alone",
    ),
}
"""Files and folders that run machines on board beside the computer, which, and why; a lint fails on one too many."""

HOSTS = ("models/rides", "models/simulation", "models/simulator", "models/concrete", "models/reproduce",
         "models/sensors", "fuzz", "evidence", "tests/independent", "heisoku.py")  # fmt: skip
"""Where whoever feeds machines on board may stand."""


@cache
def steps_on_board() -> Mapping[str, frozenset[str]]:
    """Give, for each machine on board, the functions that take a state of it and give the next one."""
    names = [found.name for found in pkgutil.iter_modules(kernel.onboard.__path__) if found.name not in NO_MACHINES]
    found = {name: _steps_of(importlib.import_module(f"kernel.onboard.{name}")) for name in names}
    return {name: steps for name, steps in found.items() if steps}


def _steps_of(machine: ModuleType) -> frozenset[str]:
    """Give the functions of a machine that a state of it goes into and comes out of."""
    found = set()
    for name, function in own(machine).items():
        hints = get_type_hints(function)
        given = hints.pop("return")
        if dataclasses.is_dataclass(given) and given in hints.values():
            found.add(name)
    return frozenset(found)


def run_beside_the_computer(source: str) -> list[str]:
    """Find where a host runs a machine on board by itself: by its module, by name, or compiled."""
    steps = steps_on_board()
    named, imported = dict[str, str](), dict[str, str]()
    tree = ast.parse(source)
    for node in ast.walk(tree):
        if isinstance(node, ast.ImportFrom) and node.module is not None:
            parent, _, machine = node.module.rpartition(".")
            for each in node.names:
                if node.module == "kernel.onboard" and each.name in steps:
                    named[each.asname or each.name] = each.name
                elif parent == "kernel.onboard" and each.name in steps.get(machine, ()):
                    imported[each.asname or each.name] = f"{machine}.{each.name}"
    found = []
    for node in ast.walk(tree):
        if isinstance(node, ast.Attribute):
            of = node.value
            machine = (
                of.attr if isinstance(of, ast.Attribute) else named.get(of.id, "") if isinstance(of, ast.Name) else ""
            )
            if node.attr in steps.get(machine, ()):
                found.append(f"line {node.lineno}: {machine}.{node.attr}")
        elif isinstance(node, ast.Name) and node.id in imported:
            found.append(f"line {node.lineno}: {imported[node.id]}")
    return found


def hosts_beside_the_computer(root: Path) -> dict[str, list[str]]:
    """Give the files that run machines on board beside the computer, and where."""
    files = [
        path for each in HOSTS for path in ([root / each] if each.endswith(".py") else (root / each).rglob("*.py"))
    ]
    return {
        str(path.relative_to(root)): offences
        for path in sorted(files)
        if (offences := run_beside_the_computer(path.read_text("utf-8")))
    }


def beside_without_a_reason(root: Path) -> list[str]:
    """Find where a host runs a machine that the list does not say, and what the list says that no host does."""
    run = {path: {each.partition(": ")[2].partition(".")[0] for each in offences}
           for path, offences in hosts_beside_the_computer(root).items()}  # fmt: skip
    of = {path: next((each for each in BESIDE_THE_COMPUTER if f"{path}/".startswith(f"{each}/")), "") for path in run}
    return [
        *(f"{path} runs {each}" for path, machines in run.items() for each in sorted(machines)
          if not of[path] or each not in BESIDE_THE_COMPUTER[of[path]][0]),
        *(f"{place} no longer runs {each}" for place, (machines, _) in BESIDE_THE_COMPUTER.items()
          for each in sorted(machines - {one for path in run if of[path] == place for one in run[path]})),
    ]  # fmt: skip
