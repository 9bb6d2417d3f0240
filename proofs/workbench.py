"""Lifts the start, every transition and every invariant once, and lays out each obligation."""

from __future__ import annotations

import copy
import time
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass, field
from functools import cached_property
from typing import Any

from proofs.catalogue import INTERLOCKING
from proofs.lift import Lifter, Scope, UnboundedScope, conjuncts
from proofs.promise import Predicate
from proofs.smtlib import symbols_of
from proofs.theory import START, Theory
from proofs.transitions import event_types


@dataclass(frozen=True)
class Way:
    """One way that a transition changes the state: its condition, what it defines, the state after."""

    condition: Any
    definitions: list[Any]
    after: Any


@dataclass(frozen=True)
class Part:
    """One solver call: named hypotheses by their conjuncts, the way taken, and the conjunct that is to follow."""

    hypotheses: Mapping[str, Sequence[Any]]
    given: list[Any]
    goal: Any


@dataclass
class Workbench:
    """A theory lifted in one scope; ``named`` chooses the two-vocabulary form of transitions.

    ``sources`` replaces the syntax trees of functions (mutants).
    """

    theory: Theory = INTERLOCKING

    scope: Scope = field(default_factory=UnboundedScope)
    named: bool = True
    sources: Mapping[Callable[..., Any], Any] | None = None
    seconds: float = 0.0

    def __post_init__(self) -> None:
        """Declare the site and the state before."""
        began = time.perf_counter()
        self.lifter = Lifter(self.scope, self.sources)
        self.site = self.scope.fresh(self.theory.site, "site")
        self.before = self.scope.fresh(self.theory.system, "pre")
        self._ways: dict[str, tuple[list[Way], list[Any]]] = {}
        self._claims: dict[tuple[int, str], list[Any]] = {}
        self._conjuncts: dict[int, tuple[Any, Sequence[Any]]] = {}
        self.seconds += time.perf_counter() - began

    def replacing(self, sources: Mapping[Callable[..., Any], Any]) -> Workbench:
        """The same, with other functions in its steps; what holds before them is not lifted again."""
        other = copy.copy(self)
        other.lifter, other.sources = Lifter(self.scope, sources), sources
        other._ways, other._claims = {}, {}
        return other

    @cached_property
    def assumed(self) -> Mapping[str, Any]:
        """The layout axioms and premises as formulas."""
        began = time.perf_counter()
        formulas = {name: self.lifter.formula(axiom, *self.told) for name, axiom in self.theory.axioms.items()}
        formulas |= {name: self.lifter.formula(premise, self.site) for name, premise in self.theory.premises.items()}
        self.seconds += time.perf_counter() - began
        return formulas

    @property
    def told(self) -> tuple[Any, Any]:
        """Layout and ground, of which the axioms speak."""
        return self.site.fields["layout"], self.site.fields["ground"]

    def said_before(self, claims: Mapping[str, Predicate]) -> Mapping[str, Any]:
        """Lift what claims say of the state before."""
        return {name: self.lifter.formula(claim, self.site, self.before) for name, claim in claims.items()}

    @cached_property
    def initial(self) -> Mapping[str, Any]:
        """What holds at the start."""
        began = time.perf_counter()
        formulas = self.said_before(self.theory.initial)
        self.seconds += time.perf_counter() - began
        return formulas

    @cached_property
    def invariants(self) -> Mapping[str, Any]:
        """Every invariant of the state before."""
        began = time.perf_counter()
        formulas = self.said_before(self.theory.invariants)
        self.seconds += time.perf_counter() - began
        return formulas

    def event(self, transition: str) -> Mapping[str, Any]:
        """An arbitrary event of a transition, by its fields."""
        kinds = event_types(self.theory.steps[transition])
        return {name: self.scope.constant(kind, f"event.{name}") for name, kind in kinds.items()}

    def ways(self, transition: str) -> list[Way]:
        """Every way that a transition changes the state; refusals leave it as it is and prove themselves."""
        return self._lifted(transition)[0]

    def refusals(self, transition: str) -> list[Any]:
        """The condition of every way that a transition leaves the state as it is."""
        return self._lifted(transition)[1]

    def _lifted(self, transition: str) -> tuple[list[Way], list[Any]]:
        if transition not in self._ways:
            began = time.perf_counter()
            ways, refusals = list[Way](), list[Any]()
            event = self.event(transition).values()
            for condition, after in self.lifter.cases(self.theory.steps[transition], self.site, self.before, *event):
                if after is self.before:
                    refusals.append(condition)
                elif self.named:
                    state, definitions = self.scope.name(after, "post", relative_to=self.before)
                    ways.append(Way(condition, [named.formula for named in definitions], state))
                else:
                    ways.append(Way(condition, [], after))
            self._ways[transition] = ways, refusals
            self.seconds += time.perf_counter() - began
        return self._ways[transition]

    def claim(self, state: Any, invariant: str) -> list[Any]:
        """The conjuncts of an invariant in a state."""
        key = (id(state), invariant)
        if key not in self._claims:
            began = time.perf_counter()
            self._claims[key] = conjuncts(self.lifter.formula(self.theory.invariants[invariant], self.site, state))
            self.seconds += time.perf_counter() - began
        return self._claims[key]

    def always(self) -> Mapping[str, Sequence[Any]]:
        """What always holds of the symbols used so far: identifiers are ordered, a missing key has nothing below it."""
        return {named.name: [named.formula] for named in self.scope.axioms()}

    def split(self, formulas: Mapping[str, Any]) -> dict[str, Sequence[Any]]:
        """Split hypotheses into conjuncts, each of them once."""
        began = time.perf_counter()
        for formula in formulas.values():
            if formula.get_id() not in self._conjuncts:
                self._conjuncts[formula.get_id()] = formula, conjuncts(formula)
        self.seconds += time.perf_counter() - began
        return {name: self._conjuncts[formula.get_id()][1] for name, formula in formulas.items()}

    def asked(self, chosen: Mapping[str, Any], questions: Iterable[tuple[list[Any], Any]]) -> list[Part]:
        """Lay out questions, each of what is given and what is to follow, with the same hypotheses.

        Of what always holds each has what speaks of its own symbols alone: what else was lifted before, and in what
        order, leaves no trace in it.  The rest could be left out: it can be made true whatever its symbols mean there.
        """
        named, questions = self.split(chosen), list(questions)
        always = [(name, formulas, symbols_of(*formulas)) for name, formulas in self.always().items()]
        common = symbols_of(*(formula for formulas in named.values() for formula in formulas))
        parts = []
        for given, goal in questions:
            here = common | symbols_of(*given, goal)
            true = {name: formulas for name, formulas, symbols in always if symbols <= here}
            parts.append(Part({**true, **named}, given, goal))
        return parts

    def parts(self, transition: str, invariant: str, hypotheses: list[str] | None) -> list[Part]:
        """Lay out one obligation; ``None`` means every hypothesis there is.

        What ways leave as a hypothesis says it is asked once for all of them, as nothing of a way is needed for it.
        """
        available = dict(self.assumed)
        available |= self.initial if transition == START else self.invariants
        chosen = available if hypotheses is None else {name: available[name] for name in hypotheses}
        if transition == START:
            return self.asked(chosen, [([], goal) for goal in self.claim(self.before, invariant)])
        supposed = {formula.get_id() for formulas in self.split(chosen).values() for formula in formulas}
        unchanged, questions = dict[int, Any](), list[tuple[list[Any], Any]]()
        for way in self.ways(transition):
            for goal in self.claim(way.after, invariant):
                if goal.get_id() in supposed:
                    unchanged[goal.get_id()] = goal
                else:
                    questions.append(([way.condition, *way.definitions], goal))
        return self.asked(chosen, [*questions, *(([], goal) for goal in unchanged.values())])
