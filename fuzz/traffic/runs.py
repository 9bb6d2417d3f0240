"""Runs traffic: batches of traces on a compiled site, what they covered, and the events of a trace as Python values."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any, get_origin, get_type_hints

import numpy as np

from fuzz.compiled.domains import bits_of
from fuzz.compiled.memory import ALL_PARTS, HEADER
from fuzz.compiled.native import ASSUMED, REFUSED, Native
from fuzz.failures.trace import TRAFFIC, Event, LayoutFile, Trace
from fuzz.traffic import places, steps, tables
from fuzz.traffic.desk import MOST_EVENTS, Desk, Ints, cars_of, desk_for
from fuzz.traffic.driver import run_trace
from fuzz.traffic.entries import callbacks
from fuzz.traffic.faults import FAULTS
from fuzz.traffic.senses import LINE_WORDS, STANDSTILL_WORDS
from kernel.names import Block, Car, Point, Position, Read, Run, Train
from kernel.standstill import Standstill, ThroughLine
from models.world.start import start
from proofs.catalogue import INVARIANTS
from proofs.transitions import TRANSITIONS, event_types

WIDTHS: Mapping[Any, int] = {Run: 4, Read: 2, Standstill: STANDSTILL_WORDS, ThroughLine: LINE_WORDS}
"""How many words of an event a record takes."""

STAGES = ("reserved", "offered", "set", "standing", "over", "no run at the centre")
CAUSES = ("timetable", "traffic", "start")
"""Why a train stands still, beside the faults."""
ENDS = (
    "goes on",
    "steps spent",
    "log full",
    "time spent",
    "numbers spent",
    "falsified",
    "timetable ended",
    "nobody arrives",
)
"""Why a trace ended, by its number in ``fuzz.traffic.steps``."""
OUTCOMES = len(REFUSED) + 2
NO_REASON, CHANGED = len(REFUSED), len(REFUSED) + 1


@dataclass(frozen=True)
class Outcome:
    """How one trace went: ``violated`` is the number of an invariant or -1, ``broken`` bits of assumptions."""

    ended: str
    steps: int
    accepted: int
    journeys: int
    seconds: int
    violated: int
    broken: int


@dataclass(frozen=True)
class Batch:
    """What a batch of traces came to.

    ``decisions``: how often a train did what was next.  ``seconds``: simulated.
    ``counts``: accepted steps, journeys, ends of traces, faults by name, standstill seconds by cause.
    ``covered``, ``pairs``: hits by number of a tuple (see :func:`describe`) and of a pair.
    ``sketch``: registers of distinct states.  ``failures``: within the assumptions; ``beyond``: where one was broken.
    """

    traces: int
    steps: int
    accepted: int
    decisions: int
    journeys: int
    seconds: int
    counts: Mapping[str, int]
    covered: Mapping[int, int]
    pairs: Mapping[int, int]
    sketch: bytes
    failures: tuple[Trace, ...]
    beyond: tuple[Trace, ...]


@dataclass
class Traffic:
    """Traffic on one compiled site; ``oracles``: ask the invariants after each step; ``why``: ask for refusals."""

    native: Native
    layout: LayoutFile = field(default_factory=lambda: LayoutFile("", "0" * 64))
    planted: str | None = None
    oracles: bool = True
    why: bool = True
    memory: Ints = field(init=False, repr=False)
    desk: Desk = field(init=False, repr=False)
    _fresh: Ints = field(init=False, repr=False)

    def __post_init__(self) -> None:
        laid = self.native.memory
        self.memory = laid.new()
        at = {car: frozenset[Block]() for car in laid.site.formation.train_of}
        lies = {point: Position(laid.domains.names["Position"][0]) for point in laid.site.layout.points}
        laid.pack(self.memory, start(laid.site, at, lies), ())
        self.memory[[HEADER.index("grown"), HEADER.index("shrunk")]] = ALL_PARTS
        self._fresh = self.memory[: laid.bounds()[1]].copy()
        self.desk = desk_for(laid)
        addresses, words = self.native.addresses, self.desk.words
        words[places.MEMORY], words[places.DESK] = self.memory.ctypes.data, words.ctypes.data
        own = [callback.address for callback in callbacks()]
        words[places.ENTRIES : places.ENTRIES + len(own)] = own
        words[places.STEP], words[places.STEP_BEYOND] = addresses["step"], addresses["step_beyond"]
        words[places.JUDGE] = addresses["judge"] if self.oracles else 0
        words[places.WHY] = addresses["why"] if self.why else 0

    def limit(self, most_accepted: int = MOST_EVENTS, most_seconds: int = 6 * 3600) -> None:
        """End each trace after so many steps that changed something, and so many simulated seconds."""
        assert 0 < most_accepted <= MOST_EVENTS, most_accepted
        self.desk.words[places.MOST_ACCEPTED], self.desk.words[places.MOST_SECONDS] = most_accepted, most_seconds

    def run(self, seed: int, batch: int, trace: int, beyond: bool = True) -> Outcome:
        """Run one trace; ``beyond``: it may have a fault beyond the declared assumptions."""
        self.memory[: len(self._fresh)] = self._fresh
        words = self.desk.words
        run_trace(self.memory, words, seed, batch, trace, beyond)
        return Outcome(
            ended=ENDS[words[places.ENDED]],
            steps=int(words[places.STEPS]),
            accepted=int(words[places.ACCEPTED]),
            journeys=int(words[places.FINISHED]),
            seconds=int(words[places.CLOCK]),
            violated=int(words[places.VIOLATED]),
            broken=int(words[places.BROKEN]),
        )

    def faults(self) -> tuple[str, ...]:
        """The faults that the trace just run had."""
        return tuple(fault.name for number, fault in enumerate(FAULTS) if self.desk.words[places.PRESENT + number] != 0)

    def events(self) -> Iterator[Event]:
        """The events of the trace just run that changed something, in order."""
        for row in self.desk.tables["log"][: self.desk.words[places.ACCEPTED]]:
            kind, by, beyond = (int(word) for word in row[: steps.LOG_HEAD])
            event = self._event(kind, [int(word) for word in row[steps.LOG_HEAD :]])
            yield Event(tables.NAMES[kind], event, TRAFFIC if by < 0 else FAULTS[by].name, bool(beyond))

    def trace(self, seed: int, batch: int, number: int, outcome: Outcome) -> Trace:
        """The trace just run, as it is kept."""
        site, names = self.native.memory.site, self.native.memory.domains.names
        where, lies = self.desk.tables["start_at"], self.desk.tables["start_lies"]
        return Trace(
            layout=self.layout,
            trains={Train(train): tuple(map(Car, cars)) for train, cars in cars_of(site).items()},
            at={
                Car(car): frozenset({Block(names["Block"][where[at]])} if where[at] >= 0 else ())
                for at, car in enumerate(names["Car"])
            },
            lies={
                Point(point): Position(names["Position"][lies[at]]) for at, point in enumerate(names.get("Point", ()))
            },
            events=tuple(self.events()),
            seed=seed,
            batch=batch,
            number=number,
            planted=self.planted,
            faults=self.faults(),
            violated=self.violated(),
            at_step=outcome.accepted if outcome.violated >= 0 else None,
            broken_assumptions=tuple(name for at, name in enumerate(ASSUMED) if outcome.broken >> at & 1),
        )

    def violated(self) -> tuple[str, ...]:
        """Every invariant that is false of the state as it is now."""
        return tuple(name for at, name in enumerate(INVARIANTS) if self.native.call(f"holds_{at}", self.memory) == 0)

    def _event(self, kind: int, words: list[int]) -> dict[str, Any]:
        """An event from the words of its row in the log."""
        block_words = int(self.desk.words[places.BLOCK_WORDS])
        event: dict[str, Any] = {}
        for name, of in event_types(TRANSITIONS[kind]).items():
            width = block_words if get_origin(of) is frozenset else WIDTHS.get(of, 1)
            event[name], words = self._value(of, words[:width]), words[width:]
        return event

    def _value(self, of: Any, words: list[int]) -> Any:
        """A value from its words."""
        names = self.native.memory.domains.names
        if of is Run:
            serial, train, life, route = words
            return Run(serial, names["Train"][train], life, names["Route"][route])  # type: ignore[arg-type]
        if of is Read:
            return Read(names["Tag"][words[0]], names["Record"][words[1]])  # type: ignore[arg-type]
        if get_origin(of) is frozenset:
            return frozenset(
                names["Block"][number] for at, word in enumerate(words) for number in bits_of(word, 64 * at)
            )
        if of in (Standstill, ThroughLine):
            kinds = get_type_hints(of)
            return of(*(self._value(kind, [word]) for kind, word in zip(kinds.values(), words, strict=True)))
        if of is bool:
            return bool(words[0])
        return names[of.__name__][words[0]] if of.__name__ in names else words[0]


def run_batch(
    traffic: Traffic, seed: int, batch: int, traces: int, weights: Sequence[float] = (), beyond: bool = True
) -> Batch:
    """Run so many traces; everything follows from the arguments and the site.

    ``weights`` multiply how many traces have each fault (``faults.families()`` names them); none: as declared.
    """
    desk = traffic.desk
    desk.reset()
    desk.weigh(weights)
    outcomes: list[Outcome] = []
    failures: list[Trace] = []
    beyonds: list[Trace] = []
    for number in range(traces):
        outcome = traffic.run(seed, batch, number, beyond)
        outcomes.append(outcome)
        if outcome.violated >= 0:
            (beyonds if outcome.broken else failures).append(traffic.trace(seed, batch, number, outcome))
    return Batch(
        traces=traces,
        steps=sum(outcome.steps for outcome in outcomes),
        accepted=sum(outcome.accepted for outcome in outcomes),
        decisions=int(desk.words[places.DECISIONS]),
        journeys=sum(outcome.journeys for outcome in outcomes),
        seconds=sum(outcome.seconds for outcome in outcomes),
        counts=_counts(desk, outcomes),
        covered=_nonzero(desk.tables["hits"]),
        pairs=_nonzero(desk.tables["pairs"]),
        sketch=desk.tables["sketch"].astype(np.uint8).tobytes(),
        failures=tuple(failures),
        beyond=tuple(beyonds),
    )


def _nonzero(table: Ints) -> dict[int, int]:
    return {int(at): int(table[at]) for at in np.flatnonzero(table)}


def _counts(desk: Desk, outcomes: Sequence[Outcome]) -> dict[str, int]:
    """What is counted by name; what never happened stands there with 0."""
    words = desk.words
    counts = {"accepted": sum(outcome.accepted for outcome in outcomes)}
    counts["journeys"] = sum(outcome.journeys for outcome in outcomes)
    for end in ENDS[1:]:
        counts[f"ended: {end}"] = sum(outcome.ended == end for outcome in outcomes)
    for at, fault in enumerate(FAULTS):
        counts[f"traces with {fault.name}"] = int(words[places.CARRIED + at])
        counts[f"drawn: {fault.name}"] = int(words[places.DRAWN + at])
    for at, name in enumerate((*(fault.name for fault in FAULTS), *CAUSES)):
        counts[f"standstill seconds: {name}"] = int(words[places.STANDSTILL + at])
    for at, name in enumerate(ASSUMED):
        broken = [outcome for outcome in outcomes if outcome.broken >> at & 1]
        counts[f"broken: {name}"] = len(broken)
        counts[f"broken and violated: {name}"] = sum(outcome.violated >= 0 for outcome in broken)
    return counts


def describe(tuple_id: int) -> str:
    """A coverage tuple in words: transition, how far its run has come, and what came of it."""
    rest, outcome = divmod(tuple_id, OUTCOMES)
    kind, stage = divmod(rest, steps.STAGES)
    what = "changed" if outcome == CHANGED else "nothing" if outcome == NO_REASON else REFUSED[outcome].value
    return f"{tables.NAMES[kind]}, {STAGES[stage]}: {what}"
