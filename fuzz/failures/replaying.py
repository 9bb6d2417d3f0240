"""Replays a trace in plain CPython, through the transitions that are proved, and judges every step of it."""

from __future__ import annotations

import inspect
from collections.abc import Callable, Iterator, Mapping
from contextlib import contextmanager
from dataclasses import dataclass
from functools import cache
from typing import Any

from fuzz.failures.trace import Event, Trace, found, site
from kernel.refusal import Refusal
from models.layouts import BadInput, Imported
from models.simulator.play import MODULES
from models.world import assumptions
from models.world.start import start
from models.world.state import Site, System
from proofs.catalogue import INVARIANTS, STEPS
from proofs.mutated import Sources, running, table_running
from proofs.witnesses.scenario import REASONS, WHY_REFUSED

UNDEFINED = "every_step_is_defined"
"""What is violated where a step or an invariant looks up what is not there; no name of an invariant."""
ERRORS = (KeyError, AttributeError, TypeError, ZeroDivisionError, AssertionError, IndexError)
"""What CPython raises then."""
ASSUMED: Mapping[str, Callable[..., bool]] = {
    name: value
    for name, value in vars(assumptions).items()
    if inspect.isfunction(value) and value.__module__ == assumptions.__name__
}
"""The assumptions about nature, by name."""


@dataclass(frozen=True)
class Outcome:
    """What one event came to.

    ``number``: of the step, from 1.  ``changed``: whether anything did.
    ``refusal``: why not, where the kernel says why.  ``raised``: what CPython raised, if it did.
    ``broken``: the assumptions about nature that were false, of an event beyond them.
    ``after``: the state then.  ``violated``: the invariants that are false then.
    """

    number: int
    event: Event
    changed: bool
    refusal: Refusal | None
    raised: str
    broken: tuple[str, ...]
    after: System
    violated: tuple[str, ...]


@dataclass(frozen=True)
class Replay:
    """A trace, replayed as far as the first step after which something is false."""

    trace: Trace
    site: Site
    start: System
    outcomes: tuple[Outcome, ...]
    violated: tuple[str, ...]
    at_step: int | None

    @property
    def broken(self) -> tuple[str, ...]:
        """The assumptions about nature that were false, in the order in which they were met."""
        return tuple(dict.fromkeys(name for outcome in self.outcomes for name in outcome.broken))

    @property
    def reproduced(self) -> bool:
        """Whether anything is violated."""
        return self.at_step is not None

    @property
    def changed(self) -> int:
        """How many steps changed something."""
        return sum(outcome.changed for outcome in self.outcomes)

    @property
    def as_told(self) -> bool:
        """Whether it came to what the trace says, with nothing left out."""
        return self.violated == self.trace.violated and self.at_step == self.trace.at_step

    def said(self) -> Trace:
        """The trace with what this replay came to, cut after the violating step."""
        return found(self.trace, self.violated, self.at_step, self.broken)


class Bench:
    """A site with its kernel, sound or with a planted fault, on which events are taken."""

    def __init__(self, there: Site, planted: str | None = None) -> None:
        self.site = there
        self.sources: Sources = {} if planted is None else sources_of(planted)
        self.reasons = table_running(REASONS, self.sources) if self.sources else REASONS

    def take(self, system: System, event: Event) -> tuple[System, tuple[str, ...]]:
        """Take one event; the state then, and the assumptions it is beyond.

        Raises:
            One of ``ERRORS``: the step looks up what is not there.
        """
        step, broken = STEPS[event.step], dict[str, None]()
        with running(self.sources):
            if not event.beyond:
                return step(self.site, system, **event.event), ()
            with beyond_nature(broken):
                return step(self.site, system, **event.event), tuple(broken)

    def why(self, system: System, event: Event) -> Refusal | None:
        """Ask the kernel why it refuses an event; none where it does not say."""
        if event.step not in WHY_REFUSED:
            return None
        asked = self.reasons[WHY_REFUSED[event.step]]
        layout, records = self.site.layout, self.site.records
        run = event.event.get("run")
        echoed = None if run is None else system.radio.echoes.get(run)
        known = {**event.event, "layout": layout, "records": records, "centre": system.centre, "tag_list": echoed}
        try:
            answer = asked(**{name: known[name] for name in inspect.signature(asked).parameters if name in known})
        except ERRORS:
            return None
        assert answer is None or isinstance(answer, Refusal)
        return answer

    def violated(self, system: System, names: tuple[str, ...] = tuple(INVARIANTS)) -> tuple[str, ...]:
        """The invariants of these names that are false."""
        return tuple(name for name in names if not holds(name, self.site, system))


def holds(name: str, there: Site, system: System) -> bool:
    """Tell whether an invariant holds; one that looks up what is not there does not."""
    try:
        return INVARIANTS[name](there, system)
    except ERRORS:
        return False


@contextmanager
def beyond_nature(broken: dict[str, None]) -> Iterator[None]:
    """Let the world's steps take every assumption about nature for true, and note those that are false."""

    def taken_for_true(name: str, predicate: Callable[..., bool]) -> Callable[..., bool]:
        def answer(*values: Any) -> bool:
            if not predicate(*values):
                broken[name] = None
            return True

        return answer

    asking = [(vars(module), name) for module in MODULES for name in ASSUMED if vars(module).get(name) is ASSUMED[name]]
    for names, name in asking:
        names[name] = taken_for_true(name, ASSUMED[name])
    try:
        yield
    finally:
        for names, name in asking:
            names[name] = ASSUMED[name]


@cache
def sources_of(planted: str) -> Sources:
    """The functions of a planted fault by its name: a mutant, or one of those with a story.

    Raises:
        BadInput: there is none of that name.
    """
    from fuzz.planted.draw import planted as dropped
    from proofs.planted.protocols import PROTOCOLS
    from proofs.planted.weakenings import WEAKENINGS

    told = {fault.name: fault for fault in (*WEAKENINGS, *(protocol.fault for protocol in PROTOCOLS)) if fault.instead}
    if planted in told:
        return told[planted].sources
    try:
        return dropped(planted)
    except KeyError as unknown:
        what = f"there is no planted fault '{planted}' in this version of the kernel"
        raise BadInput("trace", "planted.name", what, "replay it with the version that found it") from unknown


def start_of(trace: Trace, there: Site) -> System:
    """The state in which everything has just started."""
    return start(there, trace.at, trace.lies)


def replay(
    trace: Trace,
    imported: Imported,
    progress: Callable[[int, int, str], object] = lambda done, total, what: None,
) -> Replay:
    """Replay a trace on its layout, judging the start and every step, to the end or the first violation.

    Raises:
        BadInput: the trace names a planted fault that is not known.
    """
    there = site(trace, imported)
    bench, system = Bench(there, trace.planted), start_of(trace, there)
    first, outcomes = system, list[Outcome]()
    violated = bench.violated(system)
    for number, event in enumerate(trace.events if not violated else (), 1):
        progress(number, len(trace.events), event.step)
        outcome = _outcome(bench, system, number, event)
        outcomes.append(outcome)
        system, violated = outcome.after, outcome.violated
        if violated:
            break
    return Replay(trace, there, first, tuple(outcomes), violated, len(outcomes) if violated else None)


def _outcome(bench: Bench, system: System, number: int, event: Event) -> Outcome:
    try:
        after, broken = bench.take(system, event)
    except ERRORS as error:
        raised = f"{type(error).__name__}: {error}"
        return Outcome(number, event, False, None, raised, (), system, (UNDEFINED,))
    if after is system or after == system:
        return Outcome(number, event, False, bench.why(system, event), "", broken, system, ())
    return Outcome(number, event, True, None, "", broken, after, bench.violated(after))
