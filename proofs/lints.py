"""What must be true of the sources themselves, found by reading them; ``tests/proofs/test_lints.py`` runs all.

Each lint takes source text, or data read from it, and gives its offences: none, if all is well.
"""

from __future__ import annotations

import ast
import re
from collections.abc import Collection, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass

from proofs.catalogue import INTERLOCKING
from proofs.usage import Book, Cell, needed

PHYSICAL = frozenset({"track", "ground", "formation"})
"""The fields of system and site that say what is really there."""
WORLD_NAMES = frozenset({"Track", "Ground", "Formation", "Site", "System", "Radio"})
SEES_THROUGH = frozenset({"getattr", "vars", "asdict", "astuple", "fields", "__dict__"})
"""Ways to read a field without naming it."""


@dataclass(frozen=True)
class Leave:
    """What one function of the world may touch of what is really there, and why.

    ``reads``, ``writes``: fields, ``track.at``; a bare ``track`` is the record that is copied.
    ``asks``: fields that may stand in a condition.
    """

    reads: frozenset[str]
    writes: frozenset[str]
    why: str
    asks: frozenset[str] = frozenset()


LEAVES: Mapping[str, Mapping[str, Leave]] = {
    "models/world/at_the_centre.py": {
        "accounted_for": Leave(
            frozenset({"track", "track.under", "track.at", "formation.train_of"}),
            frozenset({"under"}),
            "writes the history `under` on: cars of a train accounted for stand under its new run",
        ),
    },
    "models/world/on_board.py": {
        "head_reads": Leave(
            frozenset(
                {
                    "track",
                    "track.astray",
                    "track.begun",
                    "track.entered",
                    "track.facing",
                    "track.last_read",
                    "track.unread",
                    "formation.front",
                    "ground.laid_in",
                }
            ),
            frozenset({"begun", "entered", "last_read", "passed", "unread", "astray"}),
            "writes the history on: where a head has been, what it read, and whether that was to come; which cab"
            " the driver has chosen says which antenna is at the head",
            frozenset({"track.facing"}),
        ),
        "in_the_life": Leave(
            frozenset({"track"}),
            frozenset({"unread"}),
            "writes the history on: of what its head has missed no other life awaits anything",
        ),
        "window_passes": Leave(
            frozenset({"track", "track.astray"}),
            frozenset({"unread", "astray"}),
            "writes the history on: that a tag was missed, and that it is overdue now",
        ),
        "note_stopped": Leave(
            frozenset({"track", "track.stood"}),
            frozenset({"stood"}),
            "writes the history on: that the train has stood in its destination",
        ),
        "tail_reads": Leave(
            frozenset(
                {
                    "track",
                    "track.astray",
                    "track.behind",
                    "track.facing",
                    "track.gone",
                    "track.passed",
                    "formation.cab",
                    "formation.front",
                    "formation.train_of",
                    "ground.laid_leaves",
                }
            ),
            frozenset({"behind", "gone", "passed", "astray"}),
            "writes the history on: what the last antenna has passed and gone out of, and what the unit noted; which"
            " car carries which cab's antenna, and which cab leads, is how the train is wired and driven, not where"
            " it is",
            frozenset({"formation.cab", "formation.train_of", "track.facing"}),
        ),
    },
    "models/world/at_a_point.py": {
        "drift": Leave(
            frozenset({"track", "track.lies"}),
            frozenset({"lies"}),
            "is nature: an unlocked point moves; what the terminal is told of it goes through `detection_is_true`",
        ),
    },
    "models/world/radio.py": {},
    "models/world/evidence.py": {
        "awaited_but": Leave(
            frozenset({"track.unread"}),
            frozenset(),
            "gives the history `unread` for a step to write on; no machine is handed it",
        ),
        "awaited_by_others": Leave(
            frozenset({"track.unread"}),
            frozenset(),
            "gives the history `unread` for a step to write on; no machine is handed it",
        ),
        "awaited_in": Leave(
            frozenset({"track.unread"}),
            frozenset(),
            "gives the history `unread` for a step to write on; no machine is handed it",
        ),
        "unpassed": Leave(
            frozenset({"track.passed"}),
            frozenset(),
            "gives the history `passed` for a head's step to write on; no machine is handed it",
        ),
    },
}
"""The files in which machines are told things, and the functions there that touch what is really there."""

ASKED: Mapping[str, frozenset[str]] = {
    "models/world/at_the_centre.py": frozenset(),
    "models/world/on_board.py": frozenset(
        {
            "a_head_runs_no_farther_than_its_brake_lets_it",
            "a_healthy_line_reaches_the_tail",
            "says_it_is_held_between",
            "a_located_train_stands_where_it_says",
            "a_missed_tag_is_overdue_before_the_tail_comes",
            "a_pair_passed_in_order_proves_the_exit",
            "a_run_is_led_by_its_front",
            "a_tag_is_read_where_it_lies",
            "a_train_within_its_destination_is_not_beyond",
            "is_genuine",
            "is_last",
            "the_head_arrived",
            "its_front_leads",
            "the_head_went_on",
            "reads_both_first",
        }
    ),
    "models/world/at_a_point.py": frozenset({"detection_is_true"}),
    "models/world/radio.py": frozenset({"detection_is_true"}),
    "models/world/evidence.py": frozenset(),
}
"""Which assumptions, and words of the truth, each of these files may ask: on its own sensors; the centre has none."""

ASKED_OF = frozenset({"models.world.assumptions", "models.world.premises", "models.world.truth"})
"""Where assumptions and words of the truth stand."""

MAY_SEE: Mapping[str, str] = {
    "models/world/assumptions.py": "the named assumptions: nature, brake, sensors, people",
    "models/world/nature.py": "what trains and people do",
    "models/world/premises.py": "premises on trains and tags",
    "models/world/start.py": "puts the first state together",
    "models/world/state.py": "declares it",
    "models/world/truth.py": "words in which assumptions, histories and invariants are said",
    "models/world/formations.py": "puts formations together",
}
"""The other files of the world, which may see what is really there, and what they are."""


# ---- no truth by fiat


def chains(tree: ast.AST) -> Iterator[tuple[int, str]]:
    """Give line and path of everything physical that is read: ``track.at``, or ``track`` where all of it is."""
    inside: set[int] = set()
    for node in ast.walk(tree):
        if isinstance(node, ast.Attribute):
            names = [node.attr]
            below = node.value
            while isinstance(below, ast.Attribute):
                inside.add(id(below))
                names.append(below.attr)
                below = below.value
            if id(node) in inside:
                continue
            names.reverse()
            for place, name in enumerate(names):
                if name in PHYSICAL:
                    yield node.lineno, ".".join(names[place : place + 2])
                    break
        elif isinstance(node, ast.keyword) and node.arg in PHYSICAL:
            yield node.value.lineno, f"{node.arg}="


def truth_by_fiat(source: str, leaves: Mapping[str, Leave], asked: Collection[str]) -> list[str]:
    """Find reads and writes of what is really there, outside the leave that each function was given."""
    tree = ast.parse(source)
    found = [f"line {line}: module reads {path}" for line, path in chains(_without_functions(tree))]
    found += [
        f"line {node.lineno}: asks {alias.name}"
        for node in ast.walk(tree)
        if isinstance(node, ast.ImportFrom) and node.module in ASKED_OF
        for alias in node.names
        if alias.name not in asked
    ]
    functions = [node for node in tree.body if isinstance(node, ast.FunctionDef)]
    writers = {function.name for function in functions if leaves.get(function.name)}
    for function in functions:
        found += list(_beyond_leave(function, leaves.get(function.name), writers))
    present = {function.name for function in functions}
    return found + [f"{name} has leave and is not there" for name in leaves if name not in present]


def _without_functions(tree: ast.Module) -> ast.Module:
    return ast.Module([node for node in tree.body if not isinstance(node, ast.FunctionDef)], [])


def _beyond_leave(function: ast.FunctionDef, leave: Leave | None, writers: Collection[str]) -> Iterator[str]:
    reads, writes = (leave.reads, leave.writes) if leave else (frozenset[str](), frozenset[str]())
    for line, path in chains(function):
        if not path.endswith("=") and path not in reads:
            yield f"line {line}: {function.name} reads {path}"
    for node in ast.walk(function):
        if isinstance(node, ast.Name) and node.id in SEES_THROUGH:
            yield f"line {node.lineno}: {function.name} uses {node.id}"
        if isinstance(node, ast.Name) and node.id == "Track" and function.returns is not node:
            yield f"line {node.lineno}: {function.name} makes a Track"
        if isinstance(node, ast.Call):
            for keyword in node.keywords:
                if keyword.arg in PHYSICAL and not _written_by_leave(keyword.value, writes, writers):
                    yield f"line {keyword.value.lineno}: {function.name} writes {keyword.arg}"
            if _copies(node) and not _written_by_leave(node, writes, writers):
                yield f"line {node.lineno}: {function.name} writes more than it may"
    for line, path in _decided_by(function):
        if leave is None or path not in leave.asks:
            yield f"line {line}: {function.name} decides by {path}"


def _decided_by(function: ast.FunctionDef) -> Iterator[tuple[int, str]]:
    """Give what is physical in the tests of a function, by itself or under a name that it was given."""
    carriers: dict[str, str] = {}
    for node in ast.walk(function):
        if isinstance(node, ast.Assign | ast.AnnAssign) and node.value is not None:
            held = [path for _, path in chains(node.value) if not path.endswith("=")]
            for target in node.targets if isinstance(node, ast.Assign) else [node.target]:
                if isinstance(target, ast.Name) and held:
                    carriers[target.id] = held[0]
    for node in ast.walk(function):
        if isinstance(node, ast.If | ast.IfExp | ast.Assert | ast.While):
            yield from ((line, path) for line, path in chains(node.test) if not path.endswith("="))
            for inner in ast.walk(node.test):
                if isinstance(inner, ast.Name) and inner.id in carriers:
                    yield inner.lineno, carriers[inner.id]


def _copies(value: ast.Call) -> bool:
    """Tell whether this makes a changed copy of something physical."""
    first = value.args[0] if value.args else None
    return (
        isinstance(value.func, ast.Name)
        and value.func.id == "replace"
        and isinstance(first, ast.Attribute)
        and first.attr in PHYSICAL
    )


def _written_by_leave(value: ast.AST, writes: Collection[str], writers: Collection[str]) -> bool:
    """Tell whether a new track is the old one but for the fields that may be written, or a writer's."""
    if not isinstance(value, ast.Call) or not isinstance(value.func, ast.Name):
        return False
    if value.func.id in writers:
        return True
    return (
        _copies(value)
        and len(value.args) == 1
        and bool(value.keywords)
        and all(keyword.arg in writes for keyword in value.keywords)
    )


def knows_the_world(source: str) -> list[str]:
    """Find what a kernel file must not know: the models, and the names and fields of what is really there."""
    found = []
    for node in ast.walk(ast.parse(source)):
        if isinstance(node, ast.ImportFrom | ast.Import):
            names = [node.module or ""] if isinstance(node, ast.ImportFrom) else [alias.name for alias in node.names]
            rooms = [name for name in names if name.split(".")[0] in ("models", "proofs")]
            found += [f"line {node.lineno}: imports {name}" for name in rooms]
        elif isinstance(node, ast.Name) and node.id in WORLD_NAMES:
            found.append(f"line {node.lineno}: names {node.id}")
        elif isinstance(node, ast.Attribute) and node.attr in PHYSICAL:
            found.append(f"line {node.lineno}: reads .{node.attr}")
    return found


# ---- what is proved, and what for


def idle_invariants(found: Book, invariants: Iterable[str], claimed: Collection[str]) -> list[str]:
    """Find invariants that no obligation proves, or that no claim of the safety case rests on."""
    columns = {column for _, column in found}
    reached = needed(found, claimed)
    offences = []
    for name in invariants:
        if name not in columns:
            offences.append(f"{name}: no obligation proves it")
        elif name not in claimed and name not in reached:
            offences.append(f"{name}: no claim of the safety case rests on it")
    return offences


def idle_axioms(
    found: Book, assumed: Iterable[str], kept: Mapping[str, str], claimed: Collection[str] = INTERLOCKING.claimed
) -> list[str]:
    """Find axioms and premises that no proof needs and that are not kept for a reason; and reasons that are stale."""
    reached = needed(found, claimed)
    names = list(assumed)
    return [
        *(f"{name}: no proof uses it" for name in names if name not in reached and name not in kept),
        *(f"{name}: kept although a proof uses it" for name in kept if name in reached),
        *(f"{name}: kept, and there is no such axiom" for name in kept if name not in names),
    ]


KEPT: Mapping[str, str] = {
    "a_destination_is_covered": "says what a route is: were the destination elsewhere, a train sent there would not"
    " stop within what is secured for it",
    "neighbours_are_mutual": "gives `no_open_flank` its strength: that claim ranges over neighbours, so track that"
    " leads to a block must make a neighbour of it",
    "a_part_ends_on_its_route": "is for service: a part that ended elsewhere would never be reported and so never"
    " released",
}
"""Axioms and premises that no proof uses, and why they are asked of a site nevertheless."""


def script_faults(
    files: Mapping[str, Mapping[str, Sequence[str]]],
    columns: Mapping[str, Collection[str]],
    available: Mapping[Cell, Collection[str]],
) -> list[str]:
    """Find scripts of no row, entries of no column, unknown hypotheses, and names given twice.

    ``files``: for each file's row what stands in it; a row of ``theory/step.toml`` is ``theory.step``.
    """
    offences = []
    for row, entries in files.items():
        if row not in columns:
            offences.append(f"{row}.toml: there is no such transition")
            continue
        for column, names in entries.items():
            if column not in columns[row]:
                offences.append(f"{row}.toml: there is no invariant {column}")
                continue
            offences += [
                f"{row}.toml: {column}: no hypothesis {name}" for name in names if name not in available[row, column]
            ]
            if len(set(names)) != len(names):
                offences.append(f"{row}.toml: {column}: a hypothesis stands there twice")
    return offences


def left_out(sources: Iterable[str], listed: Collection[str], returns: str) -> list[str]:
    """Find public functions of site and system (or layout and ground) with this result that no list has."""
    return [
        f"{node.name}: written, and not listed"
        for source in sources
        for node in ast.parse(source).body
        if isinstance(node, ast.FunctionDef)
        and not node.name.startswith("_")
        and isinstance(node.returns, ast.Name)
        and node.returns.id == returns
        and [argument.arg for argument in node.args.args][:2] in (["site", "system"], ["layout", "ground"], ["site"])
        and node.name not in listed
    ]


# ---- requirements

REQUIREMENT = re.compile(r"\b([TPXGA]\d{1,2})\b")


def requirements_in(text: str | None) -> frozenset[str]:
    """Give the requirement labels that a text names."""
    return frozenset(REQUIREMENT.findall(text or ""))


def known_requirements(page: str) -> frozenset[str]:
    """Give the labels that the page of requirements explains: those that begin a row of a table."""
    return frozenset(re.findall(r"^\| ([TPXGA]\d{1,2}) \|", page, re.MULTILINE))


def unlabelled(source: str, known: Collection[str]) -> list[str]:
    """Find public functions whose docstring names no requirement, or one that does not exist."""
    offences = []
    for node in ast.parse(source).body:
        if isinstance(node, ast.FunctionDef) and not node.name.startswith("_"):
            labels = requirements_in(ast.get_docstring(node))
            if not labels:
                offences.append(f"line {node.lineno}: {node.name} names no requirement")
            offences += [f"line {node.lineno}: {node.name} names {label}" for label in sorted(labels - set(known))]
    return offences
