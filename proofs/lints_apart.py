"""What nature is assumed to do and what the kernel decides, kept apart; ``tests/proofs/test_lints_apart.py``.

A weaker kernel must never get a kinder world or an easier claim.  So what is assumed calls no function of the kernel
and reads no constant of it; a claim states its own numbers; a machine is handed readings, and no judgement on what is
really there.  What still offends stands by name in ``lints_apart.toml``, which may only become shorter.

Not seen: a judgement inside a record that an event carries (a validity that a sensor gives looks the same), and one
that the compiled traffic of ``fuzz/traffic`` writes into an event; both end when no transition takes one any more.
"""

from __future__ import annotations

import ast
import importlib
import pkgutil
import tomllib
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import cache
from pathlib import Path
from types import FunctionType, ModuleType
from typing import Any, get_args, get_origin

import kernel
from models.world import assumptions as of_nature
from proofs.catalogue import INTERLOCKING
from proofs.lift.sources import Code, definition_of
from proofs.lints import PHYSICAL
from proofs.lints_on_board import assumptions, machine_fields, own
from proofs.mutants.constants import Binding, assigned, read_by, reckoned_from
from proofs.reach import called_by
from proofs.theories import THEORIES
from proofs.theory import Theory
from proofs.transitions import event_types

ROOT = Path(__file__).resolve().parent.parent
FILE = Path(__file__).with_suffix(".toml")

UNITS: Mapping[str, str] = {
    "kernel.onboard.arithmetic.CYCLE_MS": "the cycle time: by it the world has the same moments as the unit",
    "kernel.onboard.arithmetic.NM_A_MM": "a unit of length",
    "kernel.alarm.distance.UM_A_MM": "a unit of length",
    "kernel.crossing.arrival.UM_A_MM": "a unit of length",
    "kernel.onboard.odometry.MILLION": "a part per million",
}
"""Constants of the kernel that anything may read, and why."""

WORDS: Mapping[str, str] = {
    "kernel.onboard.arithmetic.smaller": "the smaller of two",
    "kernel.onboard.arithmetic.larger": "the larger of two",
    "kernel.onboard.arithmetic.magnitude": "a number without its sign",
}
"""Functions of the kernel that are mere words of arithmetic and decide nothing; what they say."""

READINGS: Mapping[str, str] = {
    "obey_order.is_detected": "whether a contact of the point's detector is made",
    "lock.is_detected": "the same",
    "send_confirmation.is_detected": "the same",
    "head_reads.in_window": "what the unit's own window of expectation says; any is allowed for",
    "braking.run_a_cycle.acknowledged": "a button that the driver presses",
    "braking.run_a_cycle.demanded": "what other machines of the unit demand; any is allowed for",
    "train.run_a_cycle.may_proceed": "what the unit's own orders say; any is allowed for",
    "train.run_a_cycle.acknowledged": "a button that the driver presses",
    "brake_watch.run_a_cycle.applied": "what the unit itself tells its brake; any is allowed for",
    "alarm_tone.hear_summary.servers_well": "what the servers say of themselves",
    "alarm_tone.look_at_the_battery.battery_well": "what the gauge of the battery says",
    "alarm_network.load.ways": "what whoever wrote the register worked out; any is allowed for",
    "dispatching.arrive.stands": "what the tram's own machine found, as `stopping` proves it",
    "display.take_place.is_located": "whether the receiver gives a place",
    "display.take_place.stands": "what the tram's own machine found, as `stopping` proves it",
    "dispatching.hear_elsewhere.is_away": "whether the tram tells its depot, or a stop of another way that it has left",
    "dispatching.take_place.is_located": "whether the receiver gives a place",
    "dispatching.take_place.stands": "what the tram's own machine found, as `stopping` proves it",
    "crossing.decide.dues": "what the crossing's own reckoning says of each train, as `due` proves it",
    "brake_watch.run_a_cycle.known": "whether the unit's odometry claims a range",
    "brake_demand.decide.may_proceed": "what the unit's own orders say; any is allowed for",
    "brake_demand.decide.acknowledged": "a button that the driver presses",
    "speed_limit.run_on.known": "whether the unit's odometry claims a range",
    "speed_limit.pass_tag.known": "whether the unit's odometry claims a range",
    "speed_limit.miss_a_tag.known": "whether the unit's odometry claims a range",
    "speed_limit.come_to_listed.curve": "whether a list has a curve where the front may be by the unit's odometry",
    "speed_limit.come_to_listed.turnout": "whether a list has a turnout where it may be",
}
"""Truths and sets that an event may bring a machine, by row and name: what says them, beside the truth itself."""

DECISIONS: Mapping[str, str] = {
    "interlocking.send_": "a machine sends what it decides to say: the message is the decision",
    "crossing.put_into_service": "the crossing refuses settings that are not lawful: that is its decision",
    "crossing.let_go": "the crossing lets no train start too soon: that is its decision",
    "arrival.turn_back": "the ground unit lets a train go that has turned back: that is its decision",
    "ranging_schedule.send_order": "the ground unit sends what it orders: that is its decision",
    "ranging_schedule.hear_answer": "the ground unit tells a crossing of what counts alone: that is its decision",
    "interlocking.correct_statement": "the first person reads off what the unit shows: what it shows is its decision",
    "interlocking.relay_order": "a unit relays what it decides to relay",
    "interlocking.start_rolling": "the brake takes the end that the unit works out, as the joint proves",
}
"""Steps refused by the kernel because they are the machine's own deed, by their names' beginnings; why."""

TOLD: Mapping[str, Mapping[str, str]] = {
    "joint": {
        "begins_mm": "where the lists of the train's runs begin: what its unit was given",
        "block_ends_mm": "where the blocks of those lists end: what its unit was given",
    },
    "promise": {"line_mm_s": "the greatest speed of the line is written for trains and crossings alike"},
    "stopping": {"error_mm": "what places err at most is written, for map matching and for stops alike"},
}
"""Fields of a state or a site, by theory, that are what a machine was told, though in no record of the kernel; why."""

SIMULATIONS = ("models/simulation", "models/simulator", "models/rides", "fuzz/traffic")
"""Folders in which machines run beside what is really there."""


def is_of_kernel(function: Any) -> bool:
    """Tell whether this is a function of the kernel."""
    return isinstance(function, FunctionType) and function.__module__.split(".")[0] == "kernel"


def named(function: Code) -> str:
    """Name a function by module."""
    return f"{function.__module__}.{function.__name__}"


# ---- what is assumed


def assumed(theory: Theory) -> dict[str, Code]:
    """Give every predicate of a theory that is assumed: of nature, premises, axioms."""
    nature = own(of_nature) if theory is INTERLOCKING else assumptions(theory)
    return {**nature, **theory.premises, **theory.axioms}


def claimed(theory: Theory) -> dict[str, Code]:
    """Give every predicate of a theory that is claimed: always, at the start, at last."""
    return {**theory.initial, **theory.invariants, **{name: each.goal for name, each in theory.promises.items()}}


def own_words(predicate: Code) -> list[Code]:
    """Give a predicate and the functions outside the kernel that it is made of."""
    return [each for each in (predicate, *sorted(called_by(predicate), key=named)) if not is_of_kernel(each)]


def kernel_calls(function: Code) -> list[str]:
    """Give the functions of the kernel that a function calls itself, but for words of arithmetic."""
    found = [each for node in ast.walk(definition_of(function)) if is_of_kernel(each := resolved(function, node))]
    return sorted({named(each) for each in found} - set(WORDS))


def resolved(function: Code, node: ast.AST) -> Any:
    """Give what a name in a function stands for, or a name in a module."""
    if isinstance(node, ast.Name):
        return function.__globals__.get(node.id)
    if isinstance(node, ast.Attribute) and isinstance(node.value, ast.Name):
        owner = function.__globals__.get(node.value.id)
        return getattr(owner, node.attr, None) if isinstance(owner, ModuleType) else None
    return None


@cache
def kernel_constants() -> Mapping[str, Mapping[str, int]]:
    """Give the integer constants of each module of the kernel."""
    modules = [each.name for each in pkgutil.walk_packages(kernel.__path__, "kernel.") if not each.ispkg]
    return {
        name: {
            known: value
            for known, value in vars(importlib.import_module(name)).items()
            if type(value) is int and known in assigned(importlib.import_module(name))
        }
        for name in modules
    }


@cache
def numbers() -> Mapping[Binding, frozenset[str]]:
    """Give, for each name in a module, the constants of the kernel that it is, or is reckoned from."""
    found: dict[Binding, set[str]] = {}
    for module, constants in kernel_constants().items():
        for name in constants:
            for place in reckoned_from(module, name):
                found.setdefault(place, set()).add(f"{module}.{name}")
    return {place: frozenset(names) for place, names in found.items()}


def kernel_numbers(function: Code) -> list[str]:
    """Give the constants of the kernel that a function reads itself, but for units."""
    read = frozenset[str]().union(*(numbers().get(place, ()) for place in read_by(function)))
    return sorted(read - set(UNITS))


def imported_in(tree: ast.AST) -> dict[str, str]:
    """Give what a source imports by name: from where."""
    return {
        alias.asname or alias.name: node.module or ""
        for node in ast.walk(tree)
        if isinstance(node, ast.ImportFrom)
        for alias in node.names
    }


def kernel_in_assumptions(theory: Theory) -> list[str]:
    """Find what is assumed by way of the kernel: each by its name, and the function or constant that it rests on."""
    return [line for name, predicate in assumed(theory).items() for line in rests_on_kernel(theory, name, predicate)]


def rests_on_kernel(theory: Theory, name: str, predicate: Code) -> list[str]:
    """Find what one predicate takes from the kernel."""
    words = own_words(predicate)
    calls = sorted({each for word in words for each in kernel_calls(word)})
    numbers = sorted({each for word in words for each in kernel_numbers(word)})
    return [
        *(f"{theory.name}: {name} calls {each}" for each in calls),
        *(f"{theory.name}: {name} reads {each}" for each in numbers),
    ]


def noted_in_assumptions(theory: Theory) -> list[str]:
    """Find what is assumed of nature by what a machine has noted: a brake that nobody built."""
    machine = machine_fields(theory.system)
    return [
        f"{theory.name}: {name} rests on {path}"
        for name, predicate in assumed(theory).items()
        for path in sorted({each for word in own_words(predicate) for each in paths_in(definition_of(word), machine)})
    ]


def paths_in(tree: ast.AST, fields: frozenset[str]) -> set[str]:
    """Give the ways from a state into these fields, each as far as it is read."""
    inside = {id(node.value) for node in ast.walk(tree) if isinstance(node, ast.Attribute | ast.Subscript)}
    found = set()
    for node in ast.walk(tree):
        path: list[str] = []
        below = node
        while isinstance(below, ast.Attribute | ast.Subscript):
            path = [below.attr, *path] if isinstance(below, ast.Attribute) else path
            below = below.value
        outermost = id(node) not in inside
        if outermost and isinstance(below, ast.Name) and below.id == "system" and fields & set(path):
            found.add(".".join([below.id, *path]))
    return found


def kernel_in_guards(theory: Theory) -> list[str]:
    """Find steps of nature, which write into no machine, that are refused by a function of the kernel."""
    machine = machine_fields(theory.system)
    return [
        f"{theory.name}: {name} is refused by {called}"
        for name, step in theory.steps.items()
        if not writes(definition_of(step), machine) and not f"{theory.name}.{name}".startswith(tuple(DECISIONS))
        for called in sorted({each for test in refusals(step) for each in calls_in(step, test)})
    ]


def writes(tree: ast.FunctionDef, fields: frozenset[str]) -> bool:
    """Tell whether a step writes one of these fields; ``with_unit`` and its like do."""
    return any(
        isinstance(node, ast.Call)
        and (
            any(keyword.arg in fields for keyword in node.keywords)
            or (isinstance(node.func, ast.Name) and node.func.id.startswith("with_"))
        )
        for node in ast.walk(tree)
    )


def refusals(step: Code) -> list[ast.expr]:
    """Give the conditions on which a step leaves the state as it is."""
    return [
        node.test
        for node in ast.walk(definition_of(step))
        if isinstance(node, ast.If) and [ast.unparse(line) for line in node.body] == ["return system"]
    ]


def calls_in(step: Code, test: ast.expr) -> Iterator[str]:
    """Give the functions of the kernel that a condition calls."""
    for node in ast.walk(test):
        if isinstance(node, ast.Call) and is_of_kernel(each := resolved(step, node.func)) and named(each) not in WORDS:
            yield named(each)


# ---- what is claimed


def kernel_numbers_in_claims(theory: Theory) -> list[str]:
    """Find claims that take a number from the kernel instead of stating it with its origin."""
    return [
        f"{theory.name}: {name} reads {number}"
        for name, claim in claimed(theory).items()
        for number in sorted({each for word in own_words(claim) for each in kernel_numbers(word)})
    ]


# ---- what a machine is told


def judgements(theory: Theory) -> list[str]:
    """Find truths, and sets, that an event hands to a function of the kernel and no reading is named for."""
    return [
        f"{row}.{name}"
        for step, function in theory.steps.items()
        for name, kind in event_types(function).items()
        if (kind is bool or get_origin(kind) is frozenset or _is_map(kind)) and is_handed_on(function, name)
        if (row := step if theory is INTERLOCKING else f"{theory.name}.{step}") and f"{row}.{name}" not in READINGS
    ]


def _is_map(kind: Any) -> bool:
    return get_origin(kind) is not None and len(get_args(kind)) == 2


def is_handed_on(step: Code, name: str) -> bool:
    """Tell whether a step hands what it is given under a name to a function of the kernel, by itself or in a record."""
    return any(
        any(
            isinstance(each, ast.Name) and each.id == name
            for argument in arguments(node)
            for each in ast.walk(argument)
        )
        for node in ast.walk(definition_of(step))
        if isinstance(node, ast.Call) and is_of_kernel(resolved(step, node.func))
    )


def arguments(call: ast.Call) -> list[ast.expr]:
    """Give what a call hands over."""
    return [*call.args, *(keyword.value for keyword in call.keywords)]


@dataclass(frozen=True)
class Kept:
    """What an expression may speak of: a step's machines and what they were told; all else of the state is the truth.

    ``roots``: what state and site are called.
    """

    fields: frozenset[str]
    roots: tuple[str, ...] = ("system", "site")

    def truth_in(self, node: ast.AST, carried: Mapping[str, str]) -> str:
        """Give the first thing in an expression that is really there, or nothing."""
        path, below = [], node
        while isinstance(below, ast.Attribute | ast.Subscript):
            path += [below.attr] if isinstance(below, ast.Attribute) else []
            below = below.value
        if isinstance(below, ast.Name):
            if self.fields & set(path):
                return ""
            if below.id in self.roots:
                return ".".join([below.id, *reversed(path)]) if path else ""
            return carried.get(below.id, "")
        return next((found for child in ast.iter_child_nodes(node) if (found := self.truth_in(child, carried))), "")


def truth_into_kernel(theory: Theory) -> list[str]:
    """Find steps that hand what is really there, or history, to a function of the kernel."""
    told = {"radio", *TOLD.get(theory.name, ())}
    kept = Kept(machine_fields(theory.system) | frozenset(event_types_of_site(theory)) | told)
    found: list[str] = []
    for name, step in theory.steps.items():
        carried: dict[str, str] = {}
        for node in statements(definition_of(step)):
            for call in [each for each in ast.walk(node) if isinstance(each, ast.Call)]:
                if is_of_kernel(resolved(step, call.func)) and named(resolved(step, call.func)) not in WORDS:
                    truths = [truth for each in arguments(call) if (truth := kept.truth_in(each, carried))]
                    found += [f"{theory.name}: {name} hands {truth} to {ast.unparse(call.func)}" for truth in truths]
            if isinstance(node, ast.Assign) and isinstance(node.targets[0], ast.Name):
                carried[node.targets[0].id] = kept.truth_in(node.value, carried)
    return sorted(set(found))


def event_types_of_site(theory: Theory) -> list[str]:
    """Give the fields of a site that are parameters of a machine: what a record of the kernel stands in."""
    return [*machine_fields(theory.site), "layout", "records"]


def statements(tree: ast.AST) -> Iterator[ast.AST]:
    """Give every statement in order, and of a compound one its condition alone."""
    for node in getattr(tree, "body", []):
        if isinstance(node, ast.If):
            yield node.test
            yield from statements(node)
            yield from statements(ast.Module(node.orelse, []))
        else:
            yield node


# ---- what a simulation tells


def told_by_simulation(source: str, judged: frozenset[str]) -> list[str]:
    """Find where a simulation hands a machine what is really there, or a judgement on it.

    ``judged``: the judgements that steps take, ``answer.at_rest``.
    """
    tree = ast.parse(source)
    known = imported_in(tree)
    kernels = {name for name, home in known.items() if home.split(".")[0] == "kernel" and name.islower()}
    found: list[str] = []
    for function in [node for node in ast.walk(tree) if isinstance(node, ast.FunctionDef)]:
        carried = carriers(function)
        for call in [node for node in ast.walk(function) if isinstance(node, ast.Call)]:
            if root_of(call.func) in kernels:
                physical = [each for argument in arguments(call) for each in physical_in(argument, carried)]
                found += [f"{function.name} hands {each} to {ast.unparse(call.func)}" for each in physical]
            if ast.unparse(call.func) == "Place" and "answer.blocks" in judged and isinstance(call.args[0], ast.Call):
                found.append(f"{function.name} tells answer blocks")
            if isinstance(call.func, ast.Attribute) and call.func.attr == "take" and call.args:
                step = ast.unparse(call.args[0]).strip("'")
                told = [keyword.arg for keyword in call.keywords if f"{step}.{keyword.arg}" in judged]
                found += [f"{function.name} tells {step} {each}" for each in told]
    return sorted(set(found))


def root_of(called: ast.expr) -> str:
    """Give the name of a function that is called, or of the module that it is called in."""
    below = called.value if isinstance(called, ast.Attribute) else called
    return below.id if isinstance(below, ast.Name) else ""


def physical_in(node: ast.AST, carried: Mapping[str, str]) -> list[str]:
    """Give what is physical in an expression: fields of system or site, and names that such were given."""
    return [
        *(
            each.attr
            for each in ast.walk(node)
            if isinstance(each, ast.Attribute)
            and each.attr in PHYSICAL
            and ast.unparse(each.value).split(".")[-1] in ("system", "site", "after", "before")
        ),
        *(carried[each.id] for each in ast.walk(node) if isinstance(each, ast.Name) and each.id in carried),
    ]


def carriers(function: ast.FunctionDef) -> dict[str, str]:
    """Give the names of a function that something physical was assigned to, and what."""
    return {
        target.id: physical_in(node.value, {})[0]
        for node in ast.walk(function)
        if isinstance(node, ast.Assign) and physical_in(node.value, {})
        for target in node.targets
        if isinstance(target, ast.Name)
    }


def all_judgements() -> frozenset[str]:
    """Give the judgements that transitions of the interlocking take, by step."""
    return frozenset(judgements(INTERLOCKING))


def simulations() -> list[str]:
    """Find what simulations tell machines that these could not know."""
    judged = all_judgements()
    return [
        f"{path.relative_to(ROOT)}: {line}"
        for folder in SIMULATIONS
        for path in sorted((ROOT / folder).rglob("*.py"))
        for line in told_by_simulation(path.read_text("utf-8"), judged)
    ]


# ---- all of them

Lines = Mapping[str, Sequence[str]]
"""Offences by lint."""


@cache
def offences() -> Lines:
    """Give what each lint finds in the whole tree."""
    of_theories = {
        "assumptions": kernel_in_assumptions,
        "guards": kernel_in_guards,
        "noted": noted_in_assumptions,
        "claims": kernel_numbers_in_claims,
        "judgements": judgements,
        "truth": truth_into_kernel,
    }
    found = {
        name: tuple(line for theory in THEORIES.values() for line in lint(theory)) for name, lint in of_theories.items()
    }
    return {**found, "simulations": tuple(simulations())}


def listed(file: Path = FILE) -> Lines:
    """Give what offends and is known."""
    return tomllib.loads(file.read_text("utf-8"))


def unlisted(found: Lines, known: Lines) -> list[str]:
    """Give what offends and is not listed."""
    return [f"{lint}: {line}" for lint in found for line in found[lint] if line not in known.get(lint, ())]


def mended(found: Lines, known: Lines) -> list[str]:
    """Give what is listed and no longer offends: it is to be struck from the list."""
    return unlisted(known, found)
