"""Each requirement with what carries it: kernel lines, transitions, invariants, obligations and witnesses."""

from __future__ import annotations

import inspect
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from functools import cache
from typing import Any

from evidence.case import Case
from evidence.records.reading import Kept
from evidence.records.showing import Came, cells_of
from evidence.report.places import Place, place_of
from evidence.report.saying import Said, said
from evidence.report.words import first_sentence, rows_of
from models.shipped import shipped
from proofs import pages, scripts
from proofs.lints import requirements_in
from proofs.mutants.plays import witnesses
from proofs.theories import THEORIES, row_of
from proofs.witnesses.registry import WITNESSES

PROOFS = "prove.json"
"""What names a figure that stands in the record of proofs and in no piece of evidence of the case."""
GROUPS = {
    "T": "train control by tags (paper 000)",
    "P": "position and integrity on board (paper 001)",
    "X": "crossings with constant warning time (paper 003)",
    "G": "tram traffic management by GPS (paper 002)",
    "A": "train approach alarm for track workers (paper 004)",
}


@dataclass(frozen=True)
class Proved:
    """An invariant, and what the record says of its column.

    ``evidence``: the id of the proof where the case names it, else of the record; ``cells``: how many
    obligations, ``closed``: how many of them each solver proved; ``margin``: the greatest share of a budget that one
    of them took; ``seeds``: how many seeds it was asked at; ``rests``: the hypotheses of all of them.
    """

    name: str
    theory: str
    evidence: str
    said: Said
    cells: int
    closed: int
    margin: float
    seeds: int
    rests: tuple[str, ...]
    safety: bool

    @property
    def place(self) -> Place:
        """Where it stands."""
        return self.said.place

    @property
    def came(self) -> Came:
        """Whether it holds by the record."""
        return "holds" if self.cells and self.closed == self.cells else "not shown"


@dataclass(frozen=True)
class Played:
    """A witness: its name, its theory and what it shows."""

    name: str
    theory: str
    says: str


@dataclass(frozen=True)
class Requirement:
    """One requirement, where it is from, and what carries it, by names."""

    label: str
    text: str
    origin: str
    group: str
    claims: tuple[str, ...]
    hazards: tuple[str, ...]
    functions: tuple[Place, ...]
    transitions: tuple[Place, ...]
    invariants: tuple[str, ...]
    witnesses: tuple[Played, ...]


@cache
def kernel_place(name: str) -> Place:
    """Where a public function of the kernel stands, named as the traceability page names it."""
    module, _, function = f"kernel.{name}".rpartition(".")
    found = __import__(module, fromlist=[function])
    return place_of(name, getattr(found, function))


def proofs_of(record: Kept | None, evidence: Mapping[str, object]) -> Mapping[str, Proved]:
    """Every invariant of every theory, by ``theory.name``."""
    answers: dict[tuple[str, str], list[Mapping[str, Any]]] = {}
    for each in record.data.get("obligations", ()) if record else ():
        answers.setdefault((each["transition"], each["invariant"]), []).append(each)
    found = {}
    for theory in THEORIES.values():
        for name, claim in theory.invariants.items():
            cells = cells_of(theory, name)
            mine = [answers.get(cell, []) for cell in cells]
            told = [each for cell in mine for each in cell]
            full = f"{theory.name}.{name}"
            found[full] = Proved(
                full,
                theory.name,
                f"prove:{full}" if f"prove:{full}" in evidence else PROOFS,
                said(claim),
                len(cells),
                sum(_closed(cell) for cell in mine),
                max((each["rlimit_spent"] / each["rlimit"] for each in told), default=0.0),
                len({each["seed"] for each in told}),
                tuple(dict.fromkeys(rest for cell in cells for rest in scripts.hypotheses(*cell))),
                name in theory.safety,
            )
    return found


def _closed(answers: Sequence[Mapping[str, Any]]) -> bool:
    """Whether both solvers proved it, at every seed."""
    solvers = {each["solver"] for each in answers}
    return {"z3", "cvc5"} <= solvers and all(each["verdict"] == "proved" for each in answers)


def all_witnesses() -> list[Played]:
    """Every witness of every theory."""
    found = []
    for theory in THEORIES:
        known: Mapping[str, Callable[..., Any]] = WITNESSES if theory == "interlocking" else witnesses(theory)
        found += [Played(name, theory, first_sentence(inspect.getdoc(one) or "")) for name, one in known.items()]
    return found


def requirements(case: Case) -> list[Requirement]:
    """Every requirement of ``docs/requirements.md``, in its order."""
    steps = {row_of(theory, name): step for theory in THEORIES.values() for name, step in theory.steps.items()}
    traced, played = pages.trace(), all_witnesses()
    found = []
    for label, text, origin in rows_of(shipped("docs/requirements.md").read_text("utf-8"), 3):
        named = traced.get(label, {})
        found.append(
            Requirement(
                label,
                text,
                origin,
                label[0],
                tuple(each.number for each in case.claims if label in each.requirements),
                tuple(each.number for each in case.hazards if label in each.requirements),
                tuple(kernel_place(name) for name in named.get("kernel functions", ())),
                tuple(place_of(name, steps[name]) for name in named.get("transitions", ())),
                tuple(name if "." in name else f"interlocking.{name}" for name in named.get("invariants", ())),
                tuple(each for each in played if label in requirements_in(each.says)),
            )
        )
    return found
