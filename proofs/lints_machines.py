"""Centre, unit and terminal change by proved steps alone, and hosts tell only the machines; the tests are beside.

The functions of `kernel.machine` choose which step an input is.  Nothing is proved of the choice, and nothing need be:
every step keeps every invariant, whichever comes when.  What must hold is that what they call is a step of the world
that the proof knows, with nothing put in place of what it is told, and that nobody else calls a step.
"""

from __future__ import annotations

import ast
import inspect
from collections.abc import Callable, Iterable, Iterator, Mapping
from dataclasses import dataclass
from functools import cache
from pathlib import Path
from types import FunctionType, ModuleType
from typing import Any

from kernel import claims, recovery
from kernel.centre import Centre
from kernel.machine import centre, point_terminal, unit
from kernel.machine.messages import Tick
from kernel.terminal import Terminal
from kernel.unit import Unit
from models.simulator.machines import AT_A_POINT, AT_THE_CENTRE, OF_ITSELF, ON_BOARD, PASSED_ON, SENT_BY
from models.world import at_a_point, at_the_centre, nature, on_board, radio
from proofs.catalogue import INTERLOCKING
from proofs.lift.sources import Code, definition_of
from proofs.reach import calls

ROOT = Path(__file__).resolve().parent.parent
STATES = {kind.__name__: kind for kind in (Centre, Unit, Terminal)}
MACHINES: Mapping[str, str] = {
    centre.__name__: "Centre",
    unit.__name__: "Unit",
    point_terminal.__name__: "Terminal",
}
"""The machines by their modules' names, and the state of each."""

ROOM: Mapping[str, str] = {
    **dict.fromkeys(("site.layout", "layout"), "layout"),
    **dict.fromkeys(("site.records", "records"), "records"),
    **dict.fromkeys(("site.lists", "lists"), "lists"),
    **dict.fromkeys(("system.centre", "centre"), "centre"),
    **dict.fromkeys(("system.units[run.train]", "system.units[train]", "unit"), "unit"),
    **dict.fromkeys(("system.terminals[point]", "terminal"), "terminal"),
    "wanted": "position",
    "terminal_life": "life",
    "contacts.position": "detected",
    "contacts.is_made": "is_detected",
    "place.blocks": "blocks",
    "place.at": "at",
    "place.line": "line",
    "next_life(unit)": "life",
    "UnitLife(written + 1)": "life",
    "TerminalLife(written.life + 1)": "life",
    "Epoch(written.epoch + 1)": "epoch",
    "before": "before",
}
"""What a step is handed, as world and machines write it, and the name of the parameter that it stands for."""

NUMBERED: Mapping[str, str] = {"run": "next_run(centre, train, life, NO_ROUTE)"}
"""Names that a machine binds itself, and to what; all others come with the input."""

ON_BOARD_ALONE = frozenset(
    {
        "kernel.authority.note_stopped",
        "kernel.change_of_ends.change_ends",
        "kernel.first_loop.give_back",
        "kernel.second_loop.note_head_read",
        "kernel.second_loop.note_window_passed",
        "kernel.tail_evidence.note_tail_read",
    }
)
"""Steps of a unit that antennas, brake control and driver bring about, not what it is told by telegram."""

MAY_CALL: Mapping[str, str] = {
    "kernel/": "the kernel itself",
    "models/world/": "the world that the proof knows",
    "models/onboard/joint.py": "the world of the joint, where giving a run back is proved with its list",
    "proofs/": "what is said of the steps, and what becomes of the proof if they are others",
    "tests/bench_kernel.py": "how long each step takes",
    "tests/kernel/": "single steps, tried one by one",
    "tests/proofs/": "steps that the prover is tried on",
}
"""Who may call a step, by the beginning of the path; why."""


JUDGE = "tests/independent/world/"
PIECE_BY_PIECE = frozenset(
    {
        "kernel.recovery.recover_block",
        "kernel.recovery.recover_point",
        "kernel.release.retire",
        "kernel.route_setting.open_first_loop",
    }
)
"""What the centre does of itself at a tick, which the independent world has it do piece by piece, at any moment."""


def named(function: Code) -> str:
    """Name a function by module."""
    return f"{function.__module__}.{function.__name__}"


def is_step(function: Any) -> bool:
    """Tell whether a function of the kernel gives the next state of centre, unit or terminal."""
    return (
        isinstance(function, FunctionType)
        and function.__module__.startswith("kernel.")
        and not function.__module__.startswith("kernel.machine.")
        and function.__annotations__.get("return") in STATES
    )


@cache
def proved() -> frozenset[Code]:
    """Give the steps of the kernel that the transitions of the interlocking call themselves."""
    return frozenset(called for step in INTERLOCKING.steps.values() for called in steps_in(step))


def _calls_of_world(step: Code) -> Iterator[Code]:
    rooms = {module.__name__ for module in (at_a_point, at_the_centre, nature, on_board, radio)}
    for called in calls(step):
        yield called
        if called.__module__ in rooms:
            yield from _calls_of_world(called)


# ---- what the machines call


@dataclass(frozen=True)
class Call:
    """A call of a step: the step, and by parameter what it is handed."""

    step: str
    handed: tuple[tuple[str, str], ...]


def step_calls(function: Code, within: ast.AST | None = None) -> list[Call]:
    """Give the calls of steps that a function makes itself, in all of it or in a part."""
    found = []
    for node in ast.walk(definition_of(function) if within is None else within):
        if isinstance(node, ast.Call) and is_step(target := _resolved(function, node.func)):
            bound = inspect.signature(target).bind(*node.args, **{str(each.arg): each.value for each in node.keywords})
            handed = tuple((name, ast.unparse(value)) for name, value in bound.arguments.items())
            found.append(Call(named(target), handed))
    return found


def _resolved(function: Code, node: ast.expr) -> Any:
    if isinstance(node, ast.Name):
        return function.__globals__.get(node.id)
    if isinstance(node, ast.Attribute) and isinstance(node.value, ast.Name):
        return getattr(function.__globals__.get(node.value.id), node.attr, None)
    return None


def functions_of(module: ModuleType) -> list[Code]:
    """Give the functions of a machine that give its next state."""
    return [
        each
        for each in vars(module).values()
        if inspect.isfunction(each)
        and each.__module__ == module.__name__
        and each.__annotations__.get("return") == MACHINES[module.__name__]
    ]


def handed_otherwise(function: Code) -> list[str]:
    """Find steps that are handed something else than what is called as their parameter."""
    return [
        f"{function.__name__}: {call.step} is handed {text} as {name}"
        for call in step_calls(function)
        for name, text in call.handed
        if ROOM.get(text, text) != name and text != "before"
    ]


def unproved(module: ModuleType) -> list[str]:
    """Find functions that a machine calls for its next state and that no transition of the world is."""
    known = {named(each) for each in proved()}
    return [call.step for each in functions_of(module) for call in step_calls(each) if call.step not in known]


def never_taken(modules: Iterable[ModuleType]) -> list[str]:
    """Find proved steps that no input of a machine is."""
    taken = {call.step for module in modules for each in functions_of(module) for call in step_calls(each)}
    return sorted({named(each) for each in proved()} - taken - ON_BOARD_ALONE)


def does_more_than_choose(function: Code, own: frozenset[str]) -> list[str]:
    """Find where a function of a machine makes a state of its own, binds a name otherwise, or decides by itself.

    It may return what it was given, a step, or another of the machine's functions; and take steps in a row.
    ``own``: the names of these.
    """
    tree, state = definition_of(function), function.__annotations__["return"].lower()
    found = list[Any]()
    for node in ast.walk(tree):
        if isinstance(node, ast.Return):
            found += [] if _is_choice(function, node.value, state, own) else [node]
        elif isinstance(node, ast.Assign):
            (target,) = node.targets
            name, text = ast.unparse(target), ast.unparse(node.value)
            lawful = NUMBERED.get(name) == text or (
                name == state and _is_choice(function, node.value, state, frozenset())
            )
            found += [] if lawful or name in ("now", "before") else [node]
        elif isinstance(node, ast.match_case):
            found += _renamed(function, node)
    return [f"{function.__name__}, line {node.lineno}: {ast.unparse(node)}" for node in found]


def _is_choice(function: Code, value: ast.expr | None, state: str, own: frozenset[str]) -> bool:
    if isinstance(value, ast.Name):
        return value.id == state
    if not isinstance(value, ast.Call):
        return False
    target = _resolved(function, value.func)
    return is_step(target) or getattr(target, "__name__", "") in own


def _renamed(function: Code, case: ast.match_case) -> list[Any]:
    """Find patterns that call a field of an input otherwise than the input does."""
    found = []
    for pattern in ast.walk(case.pattern):
        if isinstance(pattern, ast.MatchClass):
            fields = _resolved(function, pattern.cls).__match_args__
            names = [each.name if isinstance(each, ast.MatchAs) else None for each in pattern.patterns]
            wrong = [name for name, known in zip(names, fields, strict=False) if name and ROOM.get(name, name) != known]
            found += [pattern] if wrong else []
    return found


def rows_of(module: ModuleType) -> Mapping[type, frozenset[str]]:
    """Give the transitions of the world that each input of a machine may be, as those who play a world have it."""
    if module.__name__ == centre.__name__:
        return {told: frozenset(rows) for told, rows in AT_THE_CENTRE.items()} | {
            Tick: frozenset(row for row, _ in OF_ITSELF.values())
        }
    return {
        told: frozenset({row}) for told, row in (ON_BOARD if module.__name__ == unit.__name__ else AT_A_POINT).items()
    }


def paired_otherwise(module: ModuleType) -> list[str]:
    """Find inputs that are other steps than the transitions are that the proof has such a message arrive in."""
    found, listed = dict[type, set[str]](), rows_of(module)
    for function in functions_of(module):
        for case in [each for each in ast.walk(definition_of(function)) if isinstance(each, ast.match_case)]:
            kinds = [
                _resolved(function, each.cls) for each in ast.walk(case.pattern) if isinstance(each, ast.MatchClass)
            ]
            steps = {call.step for call in step_calls(function, case)}
            for kind in kinds:
                found.setdefault(kind, set()).update(steps)
    found.get(Tick, set()).update(
        call.step for each in functions_of(module) if each.__name__ == "tick" for call in step_calls(each)
    )
    return [
        f"{module.__name__}: {kind.__name__} is {sorted(steps)}, and the world takes it as {sorted(rows)}"
        for kind, steps in found.items()
        for rows in [{named(each) for row in listed.get(kind, ()) for each in steps_in(INTERLOCKING.steps[row])}]
        if rows != steps
    ] + [f"{module.__name__}: no case for {kind.__name__}" for kind in listed if kind not in found]


@cache
def every_step() -> frozenset[Code]:
    """Give every function of the kernel that gives a state of centre, unit or terminal, by itself or within a step."""
    modules = {inspect.getmodule(step) for step in proved()} | {claims, recovery}
    return frozenset(each for module in modules for each in vars(module).values() if is_step(each))


def steps_in(row: Code) -> frozenset[Code]:
    """Give the steps that a transition of the world calls."""
    return frozenset(each for each in _calls_of_world(row) if is_step(each))


# ---- who calls steps


def callers(source: str, path: str) -> list[str]:
    """Find calls, or other uses, of steps in a source text outside the rooms that may use them."""
    if any(path.startswith(each) for each in MAY_CALL):
        return []
    steps = {named(each) for each in every_step()}
    if path.startswith(JUDGE):
        steps -= ON_BOARD_ALONE | PIECE_BY_PIECE
    known: dict[str, str] = {}
    found = []
    for node in ast.walk(ast.parse(source)):
        if isinstance(node, ast.ImportFrom) and (node.module or "").split(".")[0] == "kernel":
            for alias in node.names:
                full = f"{node.module}.{alias.name}"
                known[alias.asname or alias.name] = full
                found += [(node.lineno, full)] if full in steps else []
    for node in ast.walk(ast.parse(source)):
        if isinstance(node, ast.Attribute) and isinstance(node.value, ast.Name):
            full = f"{known.get(node.value.id, '')}.{node.attr}"
            found += [(node.lineno, full)] if full in steps else []
    return [f"{path}:{line}: {full}" for line, full in sorted(found)]


def in_files(lint: Callable[[str, str], list[str]], *rooms: str) -> list[str]:
    """Give what a lint finds in the files of some rooms, and of the top level."""
    files = [path for room in rooms for path in sorted((ROOT / room).rglob("*.py"))]
    return [
        line
        for path in [*files, *ROOT.glob("*.py")]
        for line in lint(path.read_text("utf-8"), str(path.relative_to(ROOT)))
    ]


PLAYED_BY = "models/simulator/machines.py"
"""Where the transitions of centre, units and terminals are taken for the machines; whoever plays a world is told so."""
BY_MACHINES = frozenset(
    {
        *(row for rows in AT_THE_CENTRE.values() for row in rows),
        *(row for row, _ in OF_ITSELF.values()),
        *ON_BOARD.values(),
        *AT_A_POINT.values(),
        *SENT_BY.values(),
        *PASSED_ON.values(),
        *("restart_centre", "restart_unit", "restart_terminal"),
    }
)
"""The transitions that are taken there."""


def rows_taken(source: str, path: str) -> list[str]:
    """Find where a source text that plays a world takes a transition of centre, unit or terminal by its name."""
    if path == PLAYED_BY:
        return []
    return [
        f"{path}:{node.lineno}: {text.value}"
        for node in ast.walk(ast.parse(source))
        if isinstance(node, ast.Call) and isinstance(node.func, ast.Attribute) and node.func.attr == "take"
        for argument in node.args[:1]
        for text in ast.walk(argument)
        if isinstance(text, ast.Constant) and text.value in BY_MACHINES
    ]


def offences_of(module: ModuleType) -> list[str]:
    """Give all that is wrong with a machine."""
    functions = functions_of(module)
    own = frozenset(each.__name__ for each in functions)
    return [
        *(line for each in functions for line in handed_otherwise(each)),
        *(line for each in functions for line in does_more_than_choose(each, own)),
        *paired_otherwise(module),
        *(f"no transition of the world is {step}" for step in unproved(module)),
    ]


def offences() -> list[str]:
    """Give all that is wrong with the machines and with those who tell them."""
    modules = (centre, unit, point_terminal)
    return [
        *(line for module in modules for line in offences_of(module)),
        *(f"no input of a machine is {step}" for step in never_taken(modules)),
        *in_files(callers, "models", "fuzz", "evidence", "tests"),
        *in_files(rows_taken, "models"),
    ]
