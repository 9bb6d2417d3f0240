"""Every assumption with its use, as a page: ``python -m proofs.assumptions`` writes ``docs/assumptions.md``.

What is assumed, monitored and owed stands in ``models/world/assumptions.toml``, of the interlocking, and in
``models/onboard/assumptions.toml``, of the theories beside it; where it is used is found here: axioms
and premises in the proof scripts, the rest in the source of the transitions.
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

from models.shipped import shipped
from models.world import assumptions
from proofs import usage
from proofs.catalogue import AXIOMS, INTERLOCKING, PREMISES, STEPS
from proofs.lints import KEPT
from proofs.lints_on_board import OTHERS, world
from proofs.lints_on_board import asking as asking_on_board
from proofs.lints_on_board import assumptions as asked_on_board
from proofs.theory import START, Theory

ROOT = Path(__file__).resolve().parent.parent
DATA = tuple(sorted(ROOT.glob("models/*/assumptions.toml")))
PAGE = shipped("docs/assumptions.md")

WRITTEN = (
    "Written by `python -m proofs.assumptions` from `models/*/assumptions.toml`,"
    " the proof scripts and the source of the world; do not edit. A proof says nothing of a railway on which one of"
    " these is false."
)
KINDS = {
    "world": ("Of nature, brake, sensors and people", "Predicates of `models/world/assumptions.py`."),
    "premise": ("Of a site", "Predicates of `models/world/premises.py`, named in proofs."),
    "axiom": ("Of a layout", "Predicates of `models/axioms.py`; `heisoku check` evaluates them on every station."),
    "built_in": (
        "In how the world is built",
        "No predicates: what the guards of the world's transitions, or the want of a transition, take for granted.",
    ),
    **{
        name: (
            f"Of the theory {name}",
            "Predicates of "
            + ", ".join(f"`{module.__name__.replace('.', '/')}.py`" for module in world(theory))
            + ": of nature, sensors and people, and, last, of the site.",
        )
        for name, theory in OTHERS.items()
    },
}
"""The kinds of assumption, in order; those of a theory beside the interlocking are a kind of their own."""


@dataclass(frozen=True)
class Assumption:
    """One assumption; ``stands_in``: for those that are no predicate, the transitions that it is built into.

    ``beside``: why it is assumed although no claim of the theorem rests on it.
    """

    kind: str
    name: str
    says: str
    monitor: str
    duty: str
    stands_in: tuple[str, ...] = ()
    beside: str = ""


def read() -> list[Assumption]:
    """Read the data, in its order."""
    files: list[Mapping[str, Mapping[str, Any]]] = [tomllib.loads(path.read_text("utf-8")) for path in DATA]
    return [
        Assumption(
            kind,
            name,
            entry["says"],
            entry["monitor"],
            entry["duty"],
            tuple(entry.get("stands_in", ())),
            entry.get("beside", ""),
        )
        for data in files
        for kind, entries in data.items()
        for name, entry in entries.items()
    ]


def beside() -> frozenset[str]:
    """Give the assumptions of the interlocking on which no claim of the theorem rests."""
    return frozenset(each.name for each in read() if each.beside)


def predicates() -> Mapping[str, Mapping[str, Callable[..., Any]]]:
    """Give the predicates that must be described, by kind and name."""
    nature = {
        name: value
        for name, value in vars(assumptions).items()
        if inspect.isfunction(value) and value.__module__ == assumptions.__name__ and not name.startswith("_")
    }
    others = {name: {**asked_on_board(theory), **theory.premises} for name, theory in OTHERS.items()}
    return {"world": nature, "premise": PREMISES, "axiom": AXIOMS, **others}


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


def proofs_naming(name: str, theory: Theory = INTERLOCKING) -> list[usage.Cell]:
    """Give the obligations that name an axiom or premise as a hypothesis; reading a predicate is not one."""
    found = usage.users(usage.book(theory)).get(name, ())
    return [(row, column) for row, column in found if not usage.is_reading(row)]


def used(assumption: Assumption) -> str:
    """Say where an assumption is used."""
    if assumption.kind == "built_in":
        return f"in {_listed(assumption.stands_in)}"
    theory, name = OTHERS.get(assumption.kind, INTERLOCKING), assumption.name
    if assumption.kind == "world" or (assumption.kind in OTHERS and name not in theory.premises):
        steps = asking(name) if assumption.kind == "world" else asking_on_board(theory, name)
        claims = [claim for claim, function in usage.claims(theory).items() if name in called(function)]
        parts = [f"asked by {_listed(steps)}"] * bool(steps) + [f"said in {_listed(claims)}"] * bool(claims)
        parts += [f"no claim of the theorem rests on it; it {assumption.beside}"] * bool(assumption.beside)
        return "; ".join(parts)
    found = proofs_naming(name, theory)
    if not found:
        return f"in no proof; kept because it {KEPT[name]}" if name in KEPT else "in no proof"
    rows = list(dict.fromkeys(row for row, _ in found))
    columns = list(dict.fromkeys(column for _, column in found))
    return f"{len(found)} proofs: of {_listed(columns)}, over {_listed(rows)}"


def _listed(names: Sequence[str]) -> str:
    return ", ".join(f"`{name}`" for name in names)


def _counted(found: Sequence[Assumption]) -> str:
    """Say on how many assumptions the interlocking rests."""
    of = {
        kind: sum(one.kind == kind and not one.beside for one in found)
        for kind in ("world", "premise", "axiom", "built_in")
    }
    idle = sum(one.kind == "axiom" and not proofs_naming(one.name) for one in found)
    stand_beside = sum(bool(one.beside) for one in found)
    return (
        f"The interlocking rests on {sum(of.values()) - idle}: {of['world']} of nature, brake, sensors and people,"
        f" {of['premise']} of a site, {of['axiom'] - idle} of a layout and {of['built_in']} in how its world is built."
        f" {idle} more of a layout are used in no proof, and without {stand_beside} more of nature every claim of the"
        " theorem is proved; each says why it is checked, or assumed, all the same."
    )


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
    lines += ["", _counted(found)]
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
