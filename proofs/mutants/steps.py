"""Counterexamples in theories that reckon: a state, a step with a drop in it, an invariant that is false then.

Integers are left to the solver as they are; identifiers, where a theory has any, are a few.
Where products of unknowns are too hard for it, the site is fixed to one of the witnesses', and
then states near the witnesses' are tried one after another.  Whatever is found is replayed in CPython.
"""

from __future__ import annotations

import dataclasses
import random
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import cache, cached_property
from typing import Any

import z3

from proofs.counterexample import Unfaithful
from proofs.grid import GridScope
from proofs.lift import FiniteScope, Lifter, concretise, embed
from proofs.lift.components import Function, Keys
from proofs.lift.kinds import (
    INT,
    Kind,
    MapKind,
    OptionKind,
    RecordKind,
    Scalar,
    SetKind,
    TupleKind,
    fields_of,
    kind_of_type,
)
from proofs.lift.terms import Term, and_, same, to_z3
from proofs.mutants.plays import calls_of
from proofs.mutated import Sources, running
from proofs.reads import Seen
from proofs.theories import THEORIES, theory_of
from proofs.theory import Theory
from proofs.transitions import event_types
from proofs.ways import Way, together

OF_EACH = 2
"""So many of each identifier."""
TRIES = 4_000
"""So many states near a witness's are tried."""
ERRORS = (KeyError, AttributeError, TypeError, ZeroDivisionError, AssertionError, IndexError)
"""What CPython raises where a step is not defined."""


@dataclass(frozen=True)
class Found:
    """One step in CPython: premises and invariants hold before it, and ``false`` do not hold after it."""

    row: str
    site: Any
    before: Any
    event: Mapping[str, Any]
    after: Any
    false: tuple[str, ...]

    @property
    def finding(self) -> str:
        """What went wrong, in short."""
        return ", ".join(self.false)


def identifiers(*types: Any) -> set[Any]:
    """Give the identifier types that values of these types are made of."""
    found: set[Any] = set()
    for each in types:
        _identifiers(kind_of_type(each), found)
    return found


def _identifiers(kind: Kind, found: set[Any]) -> None:
    match kind:
        case Scalar():
            if kind.is_identifier and kind.source not in found:
                found.add(kind.source)
                if kind.is_named_tuple:
                    for field in fields_of(kind.source).values():
                        _identifiers(field, found)
        case OptionKind(inner) | SetKind(inner):
            _identifiers(inner, found)
        case TupleKind(items):
            for item in items:
                _identifiers(item, found)
        case MapKind(key, inner):
            _identifiers(key, found)
            _identifiers(inner, found)
        case RecordKind(cls):
            for field in fields_of(cls).values():
                _identifiers(field, found)


class SmallScope(GridScope):
    """A few of each identifier; integers as they are, also where they are keys.

    ``numerals``: the integers that a model speaks of, while Python objects are made of it.
    """

    numerals: Sequence[int] | None = None

    def values(self, scalar: Scalar) -> Sequence[Term] | None:
        """Return every value of a scalar; of integers those of the model."""
        if scalar == INT and self.numerals is not None:
            return [z3.IntVal(number) for number in self.numerals]
        return super().values(scalar)

    def declare(self, path: str, keys: Keys, result: Scalar) -> Function:
        """Return a table, or a function of logic where keys are integers."""
        if INT in keys:
            return FiniteScope.declare(self, path, keys, result)
        return super().declare(path, keys, result)

    def open(self, kinds: Keys, names: Sequence[str]) -> Iterator[tuple[list[Term], tuple[Term, ...]]]:
        """Go through every choice of values, or through the one case of bound constants where there are integers."""
        return self.open_symbolic(kinds, names) if INT in kinds else super().open(kinds, names)

    def objects(self, model: Any, *values: tuple[Any, Any]) -> list[Any]:
        """Make Python objects of values and their types."""
        self.numerals = numerals(model)
        try:
            return [concretise(model, self, value, kind) for value, kind in values]
        finally:
            self.numerals = None


def numerals(model: Any) -> list[int]:
    """Give the integers that a model speaks of."""
    found: set[int] = set()
    for declared in model.decls():
        meant = model[declared]
        terms = [meant]
        if isinstance(meant, z3.FuncInterp):
            entries = [meant.entry(index) for index in range(meant.num_entries())]
            terms = [entry.arg_value(place) for entry in entries for place in range(entry.num_args())]
        found |= {term.as_long() for term in terms if isinstance(term, z3.IntNumRef)}
    return sorted(found)


class Lifted:
    """A theory lifted once, on any site or on one that is given."""

    def __init__(self, theory: Theory, site: Any = None) -> None:
        events = [kind for step in theory.steps.values() for kind in event_types(step).values()]
        self.theory = theory
        self.scope = SmallScope(dict.fromkeys(identifiers(theory.site, theory.system, *events), OF_EACH))
        self.lifter = Lifter(self.scope)
        self.site = self.scope.fresh(theory.site, "site") if site is None else embed(self.scope, site, theory.site)
        self.before = self.scope.fresh(theory.system, "pre")

    @cached_property
    def given(self) -> Sequence[Any]:
        """What is taken for granted of the site and the state before."""
        premises = [self.lifter.formula(premise, self.site) for premise in self.theory.premises.values()]
        claims = [self.lifter.formula(claim, self.site, self.before) for claim in self.theory.invariants.values()]
        return [*premises, *claims, *(named.formula for named in self.scope.axioms())]

    def solver(self, milliseconds: int, *formulas: Any) -> Any:
        """A solver that knows all that."""
        solver = z3.Solver()
        solver.set("timeout", milliseconds)
        solver.add(*self.given, *(named.formula for named in self.scope.axioms()), *formulas)
        return solver

    def search(self, row: str, sources: Sources, milliseconds: int) -> tuple[Found | None, str]:
        """Look for a step that breaks an invariant or is not defined; say ``found``, ``none`` or ``unknown``."""
        step = self.theory.steps[theory_of(row)[1]]
        lifter = Lifter(self.scope, sources, collect=True)
        event = {name: self.scope.constant(kind, f"event.{name}") for name, kind in event_types(step).items()}
        ways = self.ways(lifter, step, event)
        asked = [wrong for claim in self.theory.invariants.values() for wrong in self.denied(ways, claim)]
        asked += [(z3.Not(obligation.claim), z3.BoolVal(True)) for obligation in lifter.obligations]
        verdict = "none"
        for formulas in asked:
            if z3.is_false(z3.simplify(z3.And(*formulas))):
                continue
            solver = self.solver(milliseconds, *formulas)
            answer = solver.check()
            if answer == z3.sat:
                return self.replayed(row, solver.model(), event, sources), "found"
            if answer == z3.unknown:
                verdict = "unknown"
        return None, verdict

    def ways(self, lifter: Lifter, step: Callable[..., Any], event: Mapping[str, Any]) -> list[Way]:
        """Give the ways in which a step changes the state."""
        paths = lifter.paths(step, self.site, self.before, *event.values())
        return [Way(to_z3(and_(*tests)), [], after, tests) for tests, after in paths if not same(after, self.before)]

    def denied(self, ways: Sequence[Way], claim: Callable[..., bool]) -> Iterator[tuple[Any, Any]]:
        """Give the conditions of ways, and that a claim is false after them; once for ways that make the same of it."""
        seen, alike = Seen(), dict[int, tuple[Any, list[Way]]]()
        for way in ways:
            said = seen.of(way.after, lambda noted: self.lifter.formula(claim, self.site, noted))
            alike.setdefault(said.get_id(), (said, []))[1].append(way)
        for said, those in alike.values():
            yield from ((condition, z3.Not(said)) for condition in together(those))

    def search_claims(self, sources: Sources, milliseconds: int) -> tuple[Found | None, str]:
        """Look for a state, said with a drop, in which something is not as claimed.

        Either all is as claimed but for a claim with the drop; or the start, with the drop, is not as claimed.
        """
        said = Lifter(self.scope, sources)
        start = [said.formula(claim, self.site, self.before) for claim in self.theory.initial.values()]
        premises = [self.lifter.formula(premise, self.site) for premise in self.theory.premises.values()]
        asked = [
            *((self.given, said.formula(claim, self.site, self.before)) for claim in self.theory.invariants.values()),
            *(([*premises, *start], self.lifter.formula(claim, self.site, self.before)) for claim in self.claims),
        ]
        verdict = "none"
        for given, claimed in asked:
            solver = z3.Solver()
            solver.set("timeout", milliseconds)
            solver.add(*given, *(named.formula for named in self.scope.axioms()), z3.Not(claimed))
            answer = solver.check()
            if answer == z3.sat:
                site, system = self.state(solver.model())
                return self.said_otherwise(site, system, sources), "found"
            if answer == z3.unknown:
                verdict = "unknown"
        return None, verdict

    @property
    def claims(self) -> Sequence[Any]:
        """The invariants."""
        return list(self.theory.invariants.values())

    def said_otherwise(self, site: Any, system: Any, sources: Sources) -> Found:
        """Confirm in CPython that what is said of a state with a drop does not go together with what is claimed."""
        false = unmet(self.theory, site, system)
        with running(sources):
            said = unmet(self.theory, site, system)
            starts = all(claim(site, system) for claim in self.theory.initial.values())
        found = [name for name in said if name not in false] if not false else false if starts else []
        if not found or any(name in self.theory.premises for name in [*said, *false]):
            raise Unfaithful(f"{self.theory.name}: CPython sees a state otherwise")
        return Found(self.theory.name, site, system, {}, system, tuple(found))

    def state(self, model: Any) -> list[Any]:
        """Make Python objects of site and state before."""
        return self.scope.objects(model, (self.site, self.theory.site), (self.before, self.theory.system))

    def replayed(self, row: str, model: Any, event: Mapping[str, Any], sources: Sources) -> Found:
        """Make Python objects of a model and take the step in CPython."""
        step = self.theory.steps[theory_of(row)[1]]
        kinds = event_types(step)
        site, before = self.state(model)
        told = self.scope.objects(model, *((event[name], kind) for name, kind in kinds.items()))
        values = dict(zip(kinds, told, strict=True))
        if unmet(self.theory, site, before):
            raise Unfaithful(f"{row}: {', '.join(unmet(self.theory, site, before))} false before the step")
        found = stepped(row, site, before, values, sources)
        if found is None:
            raise Unfaithful(f"{row}: every invariant holds after the step")
        return found


def unmet(theory: Theory, site: Any, system: Any) -> list[str]:
    """The premises and invariants that do not hold, in CPython."""
    return [
        *(name for name, premise in theory.premises.items() if not premise(site)),
        *(name for name, claim in theory.invariants.items() if not claim(site, system)),
    ]


def stepped(row: str, site: Any, before: Any, event: Mapping[str, Any], sources: Sources) -> Found | None:
    """Take one step in CPython, some functions replaced; give it if an invariant is false then or it raises."""
    theory, name = theory_of(row)
    try:
        with running(sources):
            after = theory.steps[name](site, before, **event)
        false = [claim for claim, holds in theory.invariants.items() if not holds(site, after)]
    except ERRORS as error:
        return Found(row, site, before, event, None, (f"{type(error).__name__} {error}",))
    return Found(row, site, before, event, after, tuple(false)) if false else None


@cache
def lifted(theory: str, site: int | None = None) -> Lifted:
    """A theory lifted once a process, on any site or on one of its witnesses'."""
    return lifted_anew(theory, site)


def lifted_anew(theory: str, site: int | None = None) -> Lifted:
    """The same, lifted now: for a mutant that premises and claims may read."""
    return Lifted(THEORIES[theory], None if site is None else sites(theory)[site])


@cache
def sites(theory: str) -> list[Any]:
    """The sites of a theory's witnesses, each once."""
    found: list[Any] = []
    for call in calls_of(theory):
        if call.site not in found:
            found.append(call.site)
    return found


Lifting = Callable[[str, int | None], Lifted]
"""Gives a theory lifted, on any site or on one of its witnesses'."""


def search(row: str, sources: Sources, milliseconds: int, lift: Lifting = lifted) -> tuple[Found | None, str]:
    """Look for a counterexample: on any site, on the witnesses' sites, near the witnesses' states."""
    theory = theory_of(row)[0]
    found, verdict = lift(theory.name, None).search(row, sources, milliseconds)
    if verdict != "unknown":
        return found, verdict
    if not identifiers(theory.site):
        for place in range(min(3, len(sites(theory.name)))):
            found, _ = lift(theory.name, place).search(row, sources, milliseconds)
            if found is not None:
                return found, "found on a witness's site"
    found = near_witnesses(row, sources)
    return found, "found near a witness" if found else "unknown"


# ---- near the witnesses


def near_witnesses(row: str, sources: Sources, tries: int = TRIES, seed: int = 0) -> Found | None:
    """Take the step from states near those of the witnesses, integers changed at random."""
    theory, name = theory_of(row)
    starts = [call for call in calls_of(theory.name) if call.step == name]
    rng = random.Random(seed)
    for _ in range(tries if starts else 0):
        call = rng.choice(starts)
        site, before, event = (shaken(rng, each) for each in (call.site, call.before, dict(call.event)))
        try:
            fits = not unmet(theory, site, before)
        except ERRORS:
            fits = False
        found = stepped(row, site, before, event, sources) if fits else None
        if found is not None:
            return found
    return None


def shaken(rng: random.Random, value: Any) -> Any:
    """Give a value with few of its integers and truths changed."""
    if isinstance(value, bool):
        return value if rng.random() < 0.9 else not value
    if isinstance(value, int):
        return value if rng.random() < 0.8 else value + rng.choice((-1000, -100, -10, -2, -1, 1, 2, 10, 100, 1000))
    if isinstance(value, dict):
        return {key: shaken(rng, each) for key, each in value.items()}
    if isinstance(value, tuple) and not hasattr(value, "_fields"):
        return tuple(shaken(rng, each) for each in value)
    if dataclasses.is_dataclass(value) and not isinstance(value, type):
        parts = {each.name: shaken(rng, getattr(value, each.name)) for each in dataclasses.fields(value)}
        return dataclasses.replace(value, **parts)
    return value
