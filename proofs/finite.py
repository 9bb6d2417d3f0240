"""Every transition and invariant in a small world, ready to be asked for a counterexample.

A few blocks, routes, trains and runs, every quantifier written out: where a step breaks an
invariant at all, a few of each mostly suffice to show it.  No answer here is a proof.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import Any

import z3

from kernel.names import (
    Block,
    Cab,
    Car,
    Epoch,
    Point,
    Position,
    Read,
    Record,
    Route,
    Run,
    Serial,
    Tag,
    TagList,
    TerminalLife,
    Train,
    UnitLife,
)
from models.world.state import Site, System
from proofs.catalogue import AXIOMS, INVARIANTS, PREMISES, STEPS
from proofs.grid import GridScope
from proofs.lift import Lifter, Value
from proofs.lift.kinds import Scalar, fields_of, kind_of_type
from proofs.lift.terms import same
from proofs.mutated import Sources
from proofs.transitions import event_types

Sizes = Mapping[Any, int]


def _sizes(blocks: int, routes: int, points: int, cars: int, tags: int, runs: int, lives: int) -> Sizes:
    return {
        Block: blocks,
        Route: routes,
        Point: points,
        Position: 2,
        Train: 2,
        Car: cars,
        Cab: cars,
        Tag: tags,
        TagList: routes,
        Record: 2,
        Read: tags - tags // 4,
        Run: runs,
        Serial: runs,
        UnitLife: lives,
        TerminalLife: 2,
        Epoch: 2,
    }


SMALL: Sizes = _sizes(blocks=3, routes=2, points=1, cars=2, tags=2, runs=3, lives=2)
"""Two trains of one car, a run each and one that stands: enough for most, and quick."""
LARGER: Sizes = _sizes(blocks=4, routes=3, points=2, cars=3, tags=4, runs=4, lives=3)
"""A train of two cars, a route with a part, a third life."""

SOLVE = z3.Cond(z3.Probe("is-propositional"), z3.Tactic("sat"), z3.Tactic("smt"))
TACTICS = ("simplify", "elim-term-ite", "dt2bv", "simplify", "solve-eqs", "bit-blast", SOLVE)
"""Enumerations become bits, and the question goes to the SAT solver; with an integer left in it, to Z3's own."""


@dataclass(frozen=True)
class Question:
    """One way that a transition changes the state: what is given, and what each invariant says afterwards."""

    transition: str
    event: Mapping[str, tuple[Any, Value]]
    given: Sequence[Any]
    claims: Mapping[str, Any]
    undefined: Any
    after: Value

    @property
    def violation(self) -> Any:
        """Some invariant is false after the step, or the step looks something up that is not there."""
        return z3.Or(self.undefined, *(z3.Not(claim) for claim in self.claims.values()))


class World:
    """A finite scope with its site and the state before, lifted once; axioms left out on request."""

    def __init__(self, sizes: Sizes = LARGER, without: frozenset[str] = frozenset()) -> None:
        self.scope = GridScope(sizes)
        self.lifter = Lifter(self.scope)
        self.site = self.scope.fresh(Site, "site")
        self.before = self.scope.fresh(System, "pre")
        self.without = without
        self._after: dict[tuple[str, ...], Mapping[str, Any]] = {}

    @cached_property
    def assumed(self) -> Mapping[str, Any]:
        """Layout axioms, premises and normal forms, as formulas."""
        layout, ground = self.site.fields["layout"], self.site.fields["ground"]
        found = {name: self.lifter.formula(axiom, layout, ground) for name, axiom in AXIOMS.items()}
        found |= {name: self.lifter.formula(premise, self.site) for name, premise in PREMISES.items()}
        return {name: formula for name, formula in found.items() if name not in self.without}

    @cached_property
    def invariants(self) -> Mapping[str, Any]:
        """Every invariant of the state before."""
        return {name: self.lifter.formula(claim, self.site, self.before) for name, claim in INVARIANTS.items()}

    @cached_property
    def cells(self) -> Mapping[str, Any]:
        """The constants that the invariants speak of, by name."""
        return constants(self.invariants.values())

    @property
    def preconditions(self) -> list[Any]:
        """All that is taken for granted of the site and the state before."""
        forms = [named.formula for named in self.scope.axioms()]
        return [*self.assumed.values(), *self.invariants.values(), *forms]

    def questions(self, transition: str, sources: Sources | None = None) -> list[Question]:
        """Every way of a transition to break an invariant; ``sources`` puts mutants in place of functions."""
        lifter = Lifter(self.scope, sources, collect=True)
        kinds = event_types(STEPS[transition])
        event = {name: (kind, self.scope.constant(kind, f"event.{name}")) for name, kind in kinds.items()}
        cases = lifter.cases(STEPS[transition], self.site, self.before, *(value for _, value in event.values()))
        undefined = z3.Or(*(z3.Not(obligation.claim) for obligation in lifter.obligations))
        pinned = self.pinned(event)
        found = []
        for condition, after in cases:
            if after is self.before or same(after, self.before):
                continue
            state, definitions = self.scope.name(after, "post", relative_to=self.before)
            given = [condition, *(named.formula for named in definitions), *pinned]
            claims = self.claims_after(definitions)
            found.append(Question(transition, event, given, claims, z3.BoolVal(False), state))
        if not z3.is_false(z3.simplify(undefined)):
            found.append(Question(transition, event, pinned, {}, undefined, self.before))
        return found

    def claims_after(self, definitions: Sequence[Any]) -> Mapping[str, Any]:
        """The invariants of the state after, those that the step can touch: cells before replaced by cells after."""
        changed = tuple(named.name for named in definitions)
        if changed not in self._after:
            cells = constants(named.formula for named in definitions)
            pairs = [
                (self.cells[f"pre{name.removeprefix('post')}"], cell)
                for name, cell in cells.items()
                if name.startswith("post.") and f"pre{name.removeprefix('post')}" in self.cells
            ]
            after = {name: z3.substitute(formula, *pairs) for name, formula in self.invariants.items()}
            self._after[changed] = {
                name: formula for name, formula in after.items() if not formula.eq(self.invariants[name])
            }
        return self._after[changed]

    def pinned(self, event: Mapping[str, tuple[Any, Value]]) -> list[Any]:
        """Name the identifiers of an event in the order they come: any other naming is the same counterexample."""
        met: dict[Scalar, int] = {}
        found: list[Any] = []

        def pin(term: Any, scalar: Any) -> None:
            if not isinstance(scalar, Scalar) or not scalar.is_identifier or scalar.is_ordered:
                return
            values = self.scope.values(scalar) or ()
            count = met.get(scalar, 0)
            met[scalar] = count + 1
            found.append(z3.Or(*(term == value for value in values[: count + 1])))
            if count == 0 and scalar.is_named_tuple:
                for name, field in fields_of(scalar.source).items():
                    pin(self.scope.field(scalar, name, values[0]), field)

        for kind, value in event.values():
            pin(value, kind_of_type(kind))
        return found

    def solver(self, milliseconds: int) -> Any:
        """A solver that knows the preconditions."""
        solver = z3.Then(*TACTICS).solver()
        solver.set("timeout", milliseconds)
        solver.add(*self.preconditions)
        return solver


def constants(formulas: Any) -> dict[str, Any]:
    """The free constants of formulas, by name."""
    seen: set[int] = set()
    found: dict[str, Any] = {}
    open_ = list(formulas)
    while open_:
        term = open_.pop()
        if term.get_id() in seen:
            continue
        seen.add(term.get_id())
        if z3.is_const(term) and term.decl().kind() == z3.Z3_OP_UNINTERPRETED:
            found[term.decl().name()] = term
        open_.extend(term.children())
    return found
