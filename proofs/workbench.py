"""Lifts the start, every transition and every invariant once, and lays out each obligation."""

from __future__ import annotations

import copy
import time
from collections import defaultdict
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass, field
from functools import cached_property
from typing import Any

from proofs.catalogue import INTERLOCKING
from proofs.lift import Lifter, Scope, UnboundedScope, conjuncts
from proofs.lift.terms import and_, to_z3
from proofs.promise import Predicate
from proofs.reads import Seen
from proofs.smtlib import symbols_of
from proofs.theory import START, Theory
from proofs.transitions import event_types
from proofs.ways import Way, together


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
        self._claims: dict[tuple[int, str], tuple[Any, list[Any]]] = {}
        self._seen: defaultdict[str, Seen] = defaultdict(Seen)
        self._told: defaultdict[tuple[Any, ...], Seen] = defaultdict(Seen)
        self._given: dict[tuple[Any, ...], list[Any]] = {}
        self._conditions: dict[tuple[int, ...], tuple[list[Way], list[Any]]] = {}
        self._conjuncts: dict[int, tuple[Any, Sequence[Any]]] = {}
        self.seconds += time.perf_counter() - began

    def replacing(self, sources: Mapping[Callable[..., Any], Any]) -> Workbench:
        """The same, with other functions in its steps; what holds before them is lifted already, of its own."""
        given = {"assumed": self.assumed, "initial": self.initial, "invariants": self.invariants}
        other = copy.copy(self)
        other.__dict__.update(given)
        other.lifter, other.sources = Lifter(self.scope, sources), sources
        other._ways, other._claims, other._seen, other._conditions = {}, {}, defaultdict(Seen), {}
        other._told, other._given = defaultdict(Seen), {}
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
            step = self.theory.steps[transition]
            for tests, after in self.lifter.paths(step, self.site, self.before, *event):
                condition = to_z3(and_(*tests))
                if after is self.before:
                    refusals.append(condition)
                elif self.named:
                    state, definitions = self.scope.name(after, "post", relative_to=self.before)
                    ways.append(Way(condition, [named.formula for named in definitions], state, tests))
                else:
                    ways.append(Way(condition, [], after, tests))
            self._ways[transition] = ways, refusals
            self.seconds += time.perf_counter() - began
        return self._ways[transition]

    def claim(self, state: Any, invariant: str) -> list[Any]:
        """The conjuncts of an invariant in a state."""
        key = (id(state), invariant)
        if key not in self._claims:
            began = time.perf_counter()
            said = self._seen[invariant].of(state, lambda noted: self._said_of(noted, invariant))
            self._claims[key] = state, said
            self.seconds += time.perf_counter() - began
        return self._claims[key][1]

    def told_of(self, function: Callable[..., Any], state: Any, given: Mapping[str, Any]) -> Any:
        """Lift a function of site, state and those of the values that it takes."""
        values = [given[name] for name in event_types(function)]
        key = (function, *(id(value) for value in values))
        self._given[key] = values
        return self._told[key].of(state, lambda noted: self.lifter.call(function, self.site, noted, *values))

    def _said_of(self, state: Any, invariant: str) -> list[Any]:
        return conjuncts(self.lifter.formula(self.theory.invariants[invariant], self.site, state))

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

    def chosen(self, transition: str, hypotheses: list[str] | None) -> Mapping[str, Any]:
        """Give hypotheses by their names; ``None`` means every one there is."""
        available = {**self.assumed, **(self.initial if transition == START else self.invariants)}
        return available if hypotheses is None else {name: available[name] for name in hypotheses}

    def parts(self, transition: str, invariant: str, hypotheses: list[str] | None) -> list[Part]:
        """Lay out one obligation; ``None`` means every hypothesis there is."""
        chosen = self.chosen(transition, hypotheses)
        if transition == START:
            return self.asked(chosen, [([], goal) for goal in self.claim(self.before, invariant)])
        questions = list[tuple[list[Any], Any]]()
        for ways, goal in self.questions(transition, invariant, chosen):
            definitions = [formula for way in ways for formula in way.definitions]
            questions += [([condition, *definitions], goal) for condition in self.conditions(ways)] or [([], goal)]
        return self.asked(chosen, questions)

    def conditions(self, ways: list[Way]) -> list[Any]:
        """Give conditions, one of which holds when one of these ways is taken."""
        key = tuple(id(way) for way in ways)
        if key not in self._conditions:
            began = time.perf_counter()
            self._conditions[key] = ways, together(ways) if ways else []
            self.seconds += time.perf_counter() - began
        return self._conditions[key][1]

    def questions(self, transition: str, invariant: str, chosen: Mapping[str, Any]) -> list[tuple[list[Way], Any]]:
        """Give every conjunct that is to follow, with the ways that it is to follow of.

        What ways leave as a hypothesis says it follows from that, and no way is needed.  What several ways make the
        same of is asked once for all of them, unless the state after has symbols of its own in each.
        """
        supposed = {formula.get_id() for formulas in self.split(chosen).values() for formula in formulas}
        changed, unchanged = dict[tuple[int, ...], tuple[list[Way], Any]](), dict[int, tuple[list[Way], Any]]()
        for number, way in enumerate(self.ways(transition)):
            for goal in self.claim(way.after, invariant):
                if goal.get_id() in supposed:
                    unchanged[goal.get_id()] = [], goal
                else:
                    apart = (number,) * bool(way.definitions)
                    changed.setdefault((goal.get_id(), *apart), ([], goal))[0].append(way)
        return [*changed.values(), *unchanged.values()]
