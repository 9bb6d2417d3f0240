"""Counterexamples to induction from a finite scope, each replayed in CPython before anyone sees it.

*To induction* means: all invariants hold before the step and one fails after it.  The state before
may be one that no real sequence of events leads to.
"""

from __future__ import annotations

import inspect
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import z3

from models.world.state import Site, System
from proofs.catalogue import AXIOMS, INVARIANTS, PREMISES, STEPS
from proofs.finite import Question, World
from proofs.lift import concretise
from proofs.mutated import Sources, running

ROOT = Path(__file__).resolve().parent.parent
MILLISECONDS = 60_000
UNDEFINED = (KeyError, AttributeError, TypeError)
"""What CPython raises where a step looks up what is not there."""


class Unfaithful(Exception):
    """A counterexample of the solver that CPython does not confirm: an error of ours, never shown as one."""


@dataclass(frozen=True)
class Broken:
    """An invariant that does not hold after a step, and where it stands."""

    invariant: str
    meaning: str
    file: str
    line: int


@dataclass(frozen=True)
class Counterexample:
    """One step in CPython: all invariants hold before it, and ``broken`` do not hold after it.

    ``raised``: what the step raised instead of giving a state.
    """

    transition: str
    event: Mapping[str, Any]
    site: Site
    before: System
    after: System | None
    broken: tuple[Broken, ...]
    raised: str = ""

    @property
    def label(self) -> str:
        """What kind of counterexample this is."""
        return "counterexample to induction (the state before is perhaps unreachable)"

    @property
    def finding(self) -> str:
        """What went wrong, in short."""
        return self.raised or ", ".join(broken.invariant for broken in self.broken)


@dataclass(frozen=True)
class Answer:
    """What a search came to: a counterexample, ``none`` in this scope, or ``unknown`` in the time given."""

    found: Counterexample | None
    verdict: str


def broken(name: str) -> Broken:
    """An invariant by name, with its first line of documentation, file and line."""
    claim = INVARIANTS[name]
    file, line = inspect.getsourcefile(claim) or "", inspect.getsourcelines(claim)[1]
    meaning = (claim.__doc__ or "").strip().splitlines()[0]
    return Broken(name, meaning, str(Path(file).relative_to(ROOT)), line)


def search(world: World, transition: str, sources: Sources | None = None, milliseconds: int = MILLISECONDS) -> Answer:
    """Look for a step of this transition, some functions replaced, that breaks an invariant."""
    verdict = "none"
    for question in world.questions(transition, sources):
        solver = world.solver(milliseconds)
        solver.add(*question.given, question.violation)
        answer = solver.check()
        if answer == z3.sat:
            return Answer(replayed(world, question, solver.model(), sources or {}), "found")
        if answer == z3.unknown:
            verdict = "unknown"
    return Answer(None, verdict)


def replayed(world: World, question: Question, model: Any, sources: Sources) -> Counterexample:
    """Make Python objects of a model and take the step in CPython.

    Raises:
        Unfaithful: CPython sees it otherwise.
    """
    site = concretise(model, world.scope, world.site, Site)
    before = concretise(model, world.scope, world.before, System)
    event = {name: concretise(model, world.scope, value, kind) for name, (kind, value) in question.event.items()}
    false = [name for name in unmet(site, before) if name not in world.without]
    if false:
        raise Unfaithful(f"{question.transition}: {', '.join(false)} false before the step")
    counterexample = stepped(question.transition, site, before, event, sources)
    if not counterexample.broken and not counterexample.raised:
        raise Unfaithful(f"{question.transition}: every invariant holds after the step")
    after, checked = counterexample.after, z3.is_false(question.undefined)
    if checked and after is not None and after != concretise(model, world.scope, question.after, System):
        raise Unfaithful(f"{question.transition}: CPython comes to another state")
    return counterexample


def unmet(site: Site, system: System) -> list[str]:
    """The axioms, premises and invariants that do not hold, in CPython."""
    return [
        *(name for name, axiom in AXIOMS.items() if not axiom(site.layout, site.ground)),
        *(name for name, premise in PREMISES.items() if not premise(site)),
        *(name for name, claim in INVARIANTS.items() if not claim(site, system)),
    ]


def stepped(transition: str, site: Site, before: System, event: Mapping[str, Any], sources: Sources) -> Counterexample:
    """Take one step in CPython, some functions replaced, and say which invariants are false after it."""
    try:
        with running(sources):
            after = STEPS[transition](site, before, **event)
    except UNDEFINED as error:
        raised = f"{type(error).__name__} {error} in {_place(error)}"
        return Counterexample(transition, event, site, before, None, (), raised)
    false = [name for name in INVARIANTS if not holds(name, site, after)]
    return Counterexample(transition, event, site, before, after, tuple(map(broken, false)))


def holds(name: str, site: Site, system: System) -> bool:
    """Whether an invariant holds; it does not where it looks up what is not there."""
    try:
        return bool(INVARIANTS[name](site, system))
    except UNDEFINED:
        return False


def _place(error: Exception) -> str:
    trace = error.__traceback__
    while trace is not None and trace.tb_next is not None:
        trace = trace.tb_next
    return f"{Path(trace.tb_frame.f_code.co_filename).name}:{trace.tb_lineno}" if trace else "?"
