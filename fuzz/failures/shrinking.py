"""Makes a failing trace short: fewer trains, fewer steps, smaller numbers, the same invariant still false.

Delta debugging: halves of the steps are left out, then quarters, down to single ones, as long as the
invariant is false after the last step.  While it searches, only that invariant is asked, and only
then; what is found is replayed whole and judged by all of them.  The same trace gives the same result:
nothing is drawn, and the budget is in replays and not in seconds.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Any

from fuzz.failures.replaying import ERRORS, UNDEFINED, Bench, Replay, replay, start_of
from fuzz.failures.trace import Event, Trace, site
from kernel.names import Point, Run, Serial, Train
from models.layouts import Imported
from models.world.state import System

BUDGET = 2_000
"""Replays, of what is left of the trace, that a search may take."""


@dataclass(frozen=True)
class Shrunk:
    """What is left of a trace.

    ``trace``: with what its replay came to.  ``replay``: that replay; where it reproduces nothing, the
    trace is the one given.  ``before``: how many events there were.  ``replays``: how many were needed.
    """

    trace: Trace
    replay: Replay
    before: int
    replays: int


def shrink(trace: Trace, imported: Imported, budget: int = BUDGET) -> Shrunk:
    """Make a trace short; the first invariant that its replay finds false stays so.

    ``imported``: its layout.  ``budget``: replays; where they run out, what has been reached by then is given.

    Raises:
        BadInput: the trace names a planted fault that is not known.
    """
    whole = replay(trace, imported)
    if not whole.reproduced:
        return Shrunk(trace, whole, len(trace.events), 1)
    search = Search(whole, imported, budget, strict=False)
    least = search.least()
    if not search.same(least):
        # Something else is false earlier once steps are left out: no step before the last may break anything.
        search = Search(whole, imported, search.left, strict=True, taken=search.taken)
        least = search.least()
    return Shrunk(least.said(), least, len(trace.events), search.taken + 1)


class Search:
    """A search for a shorter trace.

    ``events``: those of the shortest trace so far, with the state before each in ``states`` and that
    after the last at its end.  ``taken``: replays so far.
    ``strict``: every invariant must hold before the last step.
    """

    def __init__(self, whole: Replay, imported: Imported, budget: int, strict: bool, taken: int = 0) -> None:
        self.imported = imported
        self.claim = whole.violated[0]
        self.strict = strict
        self.left = budget
        self.taken = taken
        self.whole = whole
        self.trace = whole.said()
        self.bench = Bench(whole.site, self.trace.planted)
        self.events: tuple[Event, ...] = ()
        self.states: list[System] = []
        self._settle([outcome.event for outcome in whole.outcomes if outcome.changed or outcome.violated])

    def least(self) -> Replay:
        """Search until nothing more can be left out, or the budget is spent; the replay of what is left."""
        found = self.whole
        while self.events:
            before = (len(self.events), len(self.trace.trains))
            self._fewer_trains()
            self._fewer_kinds()
            self._fewer_subjects()
            self._fewer_events()
            self._within_nature()
            self._smaller_numbers()
            found = replay(replace(self.trace, events=self.events), self.imported)
            self._spend()
            if not self.same(found) or self.left <= 0:
                break
            self._settle([outcome.event for outcome in found.outcomes if outcome.changed or outcome.violated])
            if (len(self.events), len(self.trace.trains)) == before:
                break
        return found

    def same(self, found: Replay) -> bool:
        """Tell whether a replay comes to the same violation, and to none before it."""
        return self.claim in found.violated

    # ---- what is left out

    def _fewer_events(self) -> None:
        """Leave out ever shorter pieces, from the end to the beginning; the last event stays."""
        size = max(1, (len(self.events) - 1) // 2)
        while self.left > 0:
            dropped = sum(self._without(piece, piece + size) for piece in self._pieces(size))
            if size == 1 and not dropped:
                return
            size = max(1, size // 2)

    def _pieces(self, size: int) -> Iterator[int]:
        """Where pieces begin, the last one first; what is left out behind a piece does not move it."""
        last = len(self.events) - 1
        return reversed(range(0, last, size))

    def _without(self, first: int, end: int) -> int:
        """Leave out some events if the rest still fails; how many."""
        end = min(end, len(self.events) - 1)
        rest = self.events[end:]
        if first >= end or self.left <= 0:
            return 0
        states = self._failing(self.bench, self.states[first], rest)
        if states is None:
            return 0
        self.events = (*self.events[:first], *rest)
        self.states = self.states[:first] + states
        return end - first

    def _fewer_trains(self) -> None:
        """Leave out trains, one after the other, with everything that they do."""
        for train in sorted(self.trace.trains):
            rest = {other: cars for other, cars in self.trace.trains.items() if other != train}
            gone = self.trace.trains[train]
            fewer = replace(
                self.trace, trains=rest, at={car: there for car, there in self.trace.at.items() if car not in gone}
            )
            if rest and not speaks_of(self.events[-1], train, gone):
                self._try(fewer, [event for event in self.events if not speaks_of(event, train, gone)])

    def _fewer_kinds(self) -> None:
        """Leave out everything that one fault did, and every step of one kind: much of a long trace at once."""
        for by in dict.fromkeys(event.by for event in self.events[:-1]):
            self._all_but(event for event in self.events[:-1] if event.by != by)
        for step in dict.fromkeys(event.step for event in self.events[:-1]):
            self._all_but(event for event in self.events[:-1] if event.step != step)

    def _fewer_subjects(self) -> None:
        """Leave out whole runs, and points, with every event that names them: no single one of these could go."""
        for subject in dict.fromkeys(subject for event in self.events[:-1] for subject in subjects_of(event)):
            self._all_but(event for event in self.events[:-1] if subject not in subjects_of(event))

    def _all_but(self, rest: Iterable[Event]) -> None:
        """Leave out all events but these and the last."""
        kept = [*rest, self.events[-1]]
        if len(kept) < len(self.events):
            self._try(self.trace, kept)

    def _within_nature(self) -> None:
        """An event that need not be beyond an assumption is not."""
        for at, event in enumerate(self.events):
            if event.beyond:
                self._try(self.trace, [*self.events[:at], replace(event, beyond=False), *self.events[at + 1 :]])

    def _smaller_numbers(self) -> None:
        """Number the runs 1, 2, 3 …, in their order."""
        serials = sorted({run.serial for event in self.events for run in runs_of(event)})
        number = {serial: Serial(place) for place, serial in enumerate(serials, 1)}
        if any(serial != place for serial, place in number.items()):
            self._try(self.trace, [renumbered(event, number) for event in self.events])

    # ---- trying

    def _try(self, trace: Trace, events: Sequence[Event]) -> None:
        """Take these events, and trains, for the shortest so far if they still fail."""
        if self.left <= 0:
            return
        there = site(trace, self.imported)
        bench = Bench(there, trace.planted)
        states = self._failing(bench, start_of(trace, there), events)
        if states is not None:
            self.trace, self.bench, self.events, self.states = trace, bench, tuple(events), states

    def _failing(self, bench: Bench, system: System, events: Sequence[Event]) -> list[System] | None:
        """The states before each of the events and after the last, if the claim is false there; none if not."""
        self._spend()
        states = [system]
        for event in events:
            if self.strict and bench.violated(system):
                return None
            try:
                system, _ = bench.take(system, event)
            except ERRORS:
                undefined = self.claim == UNDEFINED and len(states) == len(events)
                return [*states, system] if undefined else None
            states.append(system)
        return states if self.claim != UNDEFINED and bench.violated(system, (self.claim,)) else None

    def _spend(self) -> None:
        self.left -= 1
        self.taken += 1

    def _settle(self, events: Sequence[Event]) -> None:
        """Begin from these events: they fail."""
        system = start_of(self.trace, self.bench.site)
        self.events, self.states = tuple(events), [system]
        for event in events:
            try:
                system, _ = self.bench.take(system, event)
            except ERRORS:
                self.states.append(system)
                return
            self.states.append(system)


# ---- events that speak of trains and runs


def runs_of(event: Event) -> list[Run]:
    """The runs that an event names."""
    return [value for value in event.event.values() if isinstance(value, Run)]


def subjects_of(event: Event) -> list[Run | Point]:
    """The runs and the point that an event names."""
    point = event.event.get("point")
    return [*runs_of(event), *([] if point is None else [point])]


def speaks_of(event: Event, train: Train, cars: Sequence[str]) -> bool:
    """Tell whether an event is of a train: names it, a run of it, or a car of it."""
    told: Mapping[str, Any] = event.event
    return (
        told.get("train") == train
        or any(run.train == train for run in runs_of(event))
        or any(told.get(name) in cars for name in ("car", "other"))
    )


def renumbered(event: Event, number: Mapping[Serial, Serial]) -> Event:
    """Give an event with the serials of its runs changed."""
    changed = {
        name: value._replace(serial=number[value.serial]) if isinstance(value, Run) else value
        for name, value in event.event.items()
    }
    return replace(event, event=changed)
