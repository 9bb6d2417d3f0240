"""Each guarantee by which the theory of a joint goes on: true in its place, and any other invariant in its place.

A theory that puts machines together (``train``) or speaks between them (``joint``) discharges what each
assumes by what the others have guaranteed a step before: by invariants that its proof scripts name.  Such a use is
needed if the step breaks the claim without it, and right if no other invariant of the theory does as well.  A
counterexample must show it, one that CPython confirms; a guarantee without which the claim is proved is to be dropped
from the script.
"""

from __future__ import annotations

import time
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
from functools import cache
from typing import Any

import z3

from proofs import scripts, solvers
from proofs.lift import Lifter
from proofs.lookups import lookups
from proofs.mutants.steps import ERRORS, Lifted, identifiers, lifted, sites
from proofs.run import bench, laid_out
from proofs.theories import THEORIES, row_of, theory_of
from proofs.theory import EVERY_LOOKUP_IS_DEFINED
from proofs.transitions import event_types

COMPOSED = ("train", "joint")
"""The theories in which one machine's guarantee is another's assumption."""
SPENDING = 3_000_000
"""What Z3 may spend on one question, in its own units; ``unknown`` refutes nothing."""
ON_SITES = 2
"""So many of the witnesses' sites are tried before any site at all: products of unknowns are hard."""


@dataclass(frozen=True)
class Use:
    """One guarantee that the proof of a cell rests on."""

    row: str
    column: str
    guarantee: str

    @property
    def name(self) -> str:
        """What identifies it."""
        return f"{self.row} {self.column}: {self.guarantee}"

    @property
    def base(self) -> list[str]:
        """What else the proof rests on."""
        return [name for name in scripts.hypotheses(self.row, self.column) if name != self.guarantee]

    @property
    def others(self) -> list[str]:
        """What else might stand in its place."""
        known = {*self.base, self.guarantee}
        return [name for name in theory_of(self.row)[0].invariants if name not in known]


@dataclass
class Outcome:
    """What became of a use.

    ``without``: ``refuted`` if the claim is broken with true in its place, ``proved`` if it is not, or ``open``.
    ``by``: what is false after that step.  ``as_well``: the invariants in whose company the rest proves the claim;
    ``open_with``: those of which neither was found.  ``asked``: how many of them there were.
    """

    without: str = "open"
    by: str = ""
    as_well: list[str] = field(default_factory=list)
    open_with: list[str] = field(default_factory=list)
    asked: int = 0
    seconds: float = 0.0


def uses() -> list[Use]:
    """Give every use, in the order of the matrix; a claim's own past is none."""
    return [
        Use(row_of(theory, step), column, name)
        for theory in map(THEORIES.__getitem__, COMPOSED)
        for step in theory.steps
        for column in theory.invariants
        for name in scripts.hypotheses(row_of(theory, step), column)
        if name != column and name in theory.invariants
    ]


def tried(use: Use) -> Outcome:
    """Put true in the place of a guarantee, then each other invariant."""
    began = time.perf_counter()
    found, left = Outcome(asked=len(use.others)), set(use.others)
    for place in places(use):
        _refute(use, place, found, left, _together(left), defined=True)
    if found.without == "open" and proved(use, use.base):
        found.without, found.as_well, left = "proved", sorted(left), set()
    for place in places(use):
        _refute(use, place, found, left, _alone(left), defined=True)
    found.as_well += [name for name in sorted(left) if proved(use, [*use.base, name], name)]
    left -= {*found.as_well}
    _refute(use, None, found, left, [*_together(left), *_alone(left)], defined=False)
    for place in places(use):
        _refute(use, place, found, left, [*_together(left), *_alone(left)], defined=True, apart=True)
    found.open_with = sorted(left)
    found.seconds = round(time.perf_counter() - began, 2)
    return found


def places(use: Use) -> list[int | None]:
    """Give the sites to look on: some of the witnesses' where sites are numbers, then any."""
    theory = theory_of(use.row)[0]
    return [None] if identifiers(theory.site) else [*range(min(ON_SITES, len(sites(theory.name)))), None]


def proved(use: Use, names: Sequence[str], instead: str = "") -> bool:
    """Tell whether the cell is proved by these hypotheses, by each solver.

    ``instead``: the one that stands in the guarantee's place.  It looks up nothing that is not there, which the row
    `reading` proves of it: else a state of which it only seems to be true would be neither refuted nor proved.
    """
    there = lookups(bench(theory_of(use.row)[0].name), instead) if instead else []
    parts = [
        replace(part, hypotheses={**part.hypotheses, EVERY_LOOKUP_IS_DEFINED: there})
        for part in laid_out(use.row, use.column, list(names))
    ]
    return all(solvers.ask(solver, part, 0).answer == "unsat" for solver in ("z3", "cvc5") for part in parts)


def _refute(
    use: Use,
    place: int | None,
    found: Outcome,
    left: set[str],
    in_turn: Sequence[Sequence[str]],
    *,
    defined: bool,
    apart: bool = False,
) -> None:
    """Look for states in which the claim breaks; strike off ``left`` every invariant that holds in one of them.

    ``in_turn``: what is to hold there beside the rest.  ``defined``: in which the step looks up nothing that is not
    there; else those in which it does.  ``apart``: whatever Z3 was asked before, it finds the same; that takes twice
    as long.
    """
    for names in in_turn:
        if found.without != "open" and not set(names) & left:
            continue
        state = questions(use.row, place).broken(use, [*use.base, *names], defined, apart)
        if state is not None:
            found.without, found.by = "refuted", found.by or ", ".join(state.false)
            left -= {name for name in left if state.holds(name)}


def _together(left: set[str]) -> list[list[str]]:
    """All of them, since what breaks the claim then needs no other question; none."""
    return [sorted(left), []]


def _alone(left: set[str]) -> list[list[str]]:
    return [[name] for name in sorted(left)]


@dataclass(frozen=True)
class Broken:
    """A step in CPython, with what is ``false`` after it, and what held before it."""

    false: tuple[str, ...]
    before: Mapping[str, bool]

    def holds(self, name: str) -> bool:
        """Tell whether an invariant held before the step."""
        return self.before[name]


class Questions:
    """One step of a theory on some site, ready to be asked by any hypotheses."""

    def __init__(self, row: str, place: int | None) -> None:
        self.row, (self.theory, step) = row, theory_of(row)
        self.on: Lifted = lifted(self.theory.name, place)
        self.step, self.kinds = self.theory.steps[step], event_types(self.theory.steps[step])
        lifter = Lifter(self.on.scope, collect=True)
        self.event = {name: self.on.scope.constant(kind, f"event.{name}") for name, kind in self.kinds.items()}
        self.ways = self.on.ways(lifter, self.step, self.event)
        self.defined = z3.And(*(each.claim for each in lifter.obligations))
        self.before = said(self.theory.name, place)
        self._wrong: dict[str, list[Any]] = {}

    def broken(self, use: Use, names: Sequence[str], defined: bool, apart: bool) -> Broken | None:
        """Look for a step that breaks the claim, or is not defined, though all of these hold before it.

        What Z3 finds in the context that all questions share may depend on those asked before: ``apart``, each has a
        context of its own.
        """
        for formula in self.wrong(use.column) if defined else [z3.Not(self.defined)]:
            solver = z3.Solver()
            solver.add(*(self.before[name] for name in names), formula)
            solver.add(*(named.formula for named in self.on.scope.axioms()))
            if apart:
                solver = solver.translate(z3.Context())
            solver.set("rlimit", SPENDING)
            if solver.check() == z3.sat:
                state = self.replayed(use, names, solver.model().translate(z3.main_ctx()))
                if state is not None:
                    return state
        return None

    def wrong(self, column: str) -> list[Any]:
        """Say of each way that the step goes it and breaks the claim; lifted once."""
        if column not in self._wrong:
            denied = self.on.denied(self.ways, self.theory.invariants[column])
            self._wrong[column] = [z3.And(self.defined, condition, denial) for condition, denial in denied]
        return self._wrong[column]

    def replayed(self, use: Use, names: Sequence[str], model: Any) -> Broken | None:
        """Take the step in CPython: give it if the hypotheses hold before it, and the claim does not after."""
        on = self.on
        site, before = on.state(model)
        told = on.scope.objects(model, *((self.event[name], kind) for name, kind in self.kinds.items()))
        event = dict(zip(self.kinds, told, strict=True))
        held = {name: _holds(claim, site, before) for name, claim in self.theory.invariants.items()}
        premises = {name: bool(premise(site)) for name, premise in self.theory.premises.items()}
        if not all({**held, **premises}[name] for name in names):
            return None
        try:
            after = self.step(site, before, **event)
        except ERRORS:
            return Broken((EVERY_LOOKUP_IS_DEFINED,), held)
        false = tuple(name for name, claim in self.theory.invariants.items() if not _holds(claim, site, after))
        return Broken(false, held) if use.column in false else None


def _holds(claim: Any, site: Any, system: Any) -> bool:
    try:
        return bool(claim(site, system))
    except ERRORS:
        return False


@cache
def questions(row: str, place: int | None) -> Questions:
    """Lift one step once a process."""
    return Questions(row, place)


@cache
def said(theory: str, place: int | None) -> Mapping[str, Any]:
    """Give what the premises say of the site, and the invariants of the state before, by name, where they are read."""
    on = lifted(theory, place)
    return {
        **{name: _read(on, premise, on.site) for name, premise in on.theory.premises.items()},
        **{name: _read(on, claim, on.site, on.before) for name, claim in on.theory.invariants.items()},
    }


def _read(on: Lifted, predicate: Any, *values: Any) -> Any:
    """Say that a predicate holds, and looks up nothing that is not there."""
    lifter = Lifter(on.scope, collect=True)
    holds = lifter.formula(predicate, *values)
    return z3.And(holds, *(each.claim for each in lifter.obligations))
