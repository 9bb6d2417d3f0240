"""Every assumption with its use, as a page: ``python -m proofs.assumptions`` writes ``docs/assumptions.md``.

What is assumed, monitored and owed stands in ``models/world/assumptions.toml``; where it is used is
found here: axioms and premises in the proof scripts, the rest in the source of the transitions.
"""

from __future__ import annotations

import ast
import inspect
import tomllib
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from functools import cache
from pathlib import Path
from typing import Any

from models.world import assumptions
from proofs import usage
from proofs.catalogue import AXIOMS, PREMISES, STEPS
from proofs.lints import KEPT
from proofs.theory import READING, START

ROOT = Path(__file__).resolve().parent.parent
DATA = ROOT / "models" / "world" / "assumptions.toml"
PAGE = ROOT / "docs" / "assumptions.md"

WRITTEN = (
    "Written by `python -m proofs.assumptions` from `models/world/assumptions.toml`, the proof scripts and the"
    " source of the world; do not edit. A proof says nothing of a railway on which one of these is false."
)
KINDS = {
    "world": ("Of nature, brake, sensors and people", "Predicates of `models/world/assumptions.py`."),
    "premise": ("Of a site", "Predicates of `models/world/premises.py`, named in proofs."),
    "axiom": ("Of a layout", "Predicates of `models/axioms.py`; `heisoku check` evaluates them on every station."),
    "built_in": (
        "In how the world is built",
        "No predicates: what the guards of the world's transitions, or the want of a transition, take for granted.",
    ),
}


@dataclass(frozen=True)
class Assumption:
    """One assumption; ``stands_in``: for those that are no predicate, the transitions that rest on it."""

    kind: str
    name: str
    says: str
    monitor: str
    duty: str
    stands_in: tuple[str, ...] = ()


def read() -> list[Assumption]:
    """Read the data, in its order."""
    data: Mapping[str, Mapping[str, Any]] = tomllib.loads(DATA.read_text("utf-8"))
    return [
        Assumption(kind, name, entry["says"], entry["monitor"], entry["duty"], tuple(entry.get("stands_in", ())))
        for kind, entries in data.items()
        for name, entry in entries.items()
    ]


def predicates() -> Mapping[str, Mapping[str, Callable[..., Any]]]:
    """Give the predicates that must be described, by kind and name."""
    world = {
        name: value
        for name, value in vars(assumptions).items()
        if inspect.isfunction(value) and value.__module__ == assumptions.__name__ and not name.startswith("_")
    }
    return {"world": world, "premise": PREMISES, "axiom": AXIOMS}


@cache
def called(function: Callable[..., Any]) -> frozenset[str]:
    """Give the names that a function calls."""
    tree = ast.parse(inspect.getsource(function))
    return frozenset(
        node.func.id for node in ast.walk(tree) if isinstance(node, ast.Call) and isinstance(node.func, ast.Name)
    )


def asking(name: str) -> list[str]:
    """Give the transitions that ask an assumption of nature, by themselves or by way of another."""
    world = predicates()["world"]
    wanted, grown = {name}, True
    while grown:
        more = {other for other, function in world.items() if called(function) & wanted} - wanted
        wanted |= more
        grown = bool(more)
    return [step for step, function in STEPS.items() if called(function) & wanted]


def proofs_naming(name: str) -> list[usage.Cell]:
    """Give the obligations that name an axiom or premise as a hypothesis; reading a predicate is not one."""
    return [(row, column) for row, column in usage.users(usage.book()).get(name, ()) if row != READING]


def used(assumption: Assumption) -> str:
    """Say where an assumption is used."""
    if assumption.kind == "built_in":
        return f"in {_listed(assumption.stands_in)}"
    if assumption.kind == "world":
        steps = asking(assumption.name)
        claims = [name for name, claim in usage.claims().items() if assumption.name in called(claim)]
        parts = [f"asked by {_listed(steps)}"] * bool(steps) + [f"said in {_listed(claims)}"] * bool(claims)
        return "; ".join(parts)
    found = proofs_naming(assumption.name)
    if not found:
        return f"in no proof; kept because it {KEPT[assumption.name]}"
    rows = list(dict.fromkeys(row for row, _ in found))
    columns = list(dict.fromkeys(column for _, column in found))
    return f"{len(found)} proofs: of {_listed(columns)}, over {_listed(rows)}"


def _listed(names: Sequence[str]) -> str:
    return ", ".join(f"`{name}`" for name in names)


def page() -> str:
    """Give the whole page."""
    lines = [
        "# Assumptions",
        "",
        WRITTEN,
        "",
        f"*Monitor* is what would notice a breach at run time. In *used*, `{START}` is the start.",
    ]
    found = read()
    for kind, (title, about) in KINDS.items():
        mine = [assumption for assumption in found if assumption.kind == kind]
        lines += ["", f"## {title}", "", about]
        for one in mine:
            lines += [
                "",
                f"### {one.name}",
                "",
                one.says,
                "",
                f"- used: {used(one)}",
                f"- monitor: {one.monitor}",
                f"- duty: {one.duty}",
            ]
    return "\n".join([*lines, ""])


def main() -> None:
    """Write the page in its place."""
    PAGE.write_text(page(), encoding="utf-8")


if __name__ == "__main__":
    main()
