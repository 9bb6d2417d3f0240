"""Tells failures of one cause from failures of another, so that a campaign keeps each once.

Two traces are held to have one cause if, once shrunk, these agree:

- the first invariant that is false, in the order of the catalogue;
- the transition after which it is false;
- the last ``KINDS`` kinds of steps before it that are relevant, in whatever order: a step is relevant
  if it is of a train, point or block that the violating step is of;
- the assumptions about nature that were broken;
- the planted fault, if one ran.

Names of trains, points and blocks, numbers, and who did a step are left out: the same thing goes
wrong at another point with another train.  The key is a guess, as every such key is: two causes may
share one, and the first trace of it stands for both.
"""

from __future__ import annotations

import hashlib
import json
from collections.abc import Iterable
from dataclasses import dataclass
from typing import Any

from fuzz.failures.trace import Event, Trace
from kernel.names import Car, Run, Train

KINDS = 4
"""So many kinds of steps before the violating one are looked at."""
DIGITS = 12


@dataclass(frozen=True)
class Cause:
    """What failures of one cause have in common; see the module."""

    violated: str
    step: str
    before: tuple[str, ...]
    broken_assumptions: tuple[str, ...]
    planted: str | None

    @property
    def digest(self) -> str:
        """Twelve hexadecimal digits: the same for the same cause, in every version that has the same names."""
        told = [self.violated, self.step, list(self.before), list(self.broken_assumptions), self.planted]
        return hashlib.sha256(json.dumps(told).encode()).hexdigest()[:DIGITS]

    @property
    def name(self) -> str:
        """What a file of such a trace is called, without its ending."""
        return f"{self.violated}-{self.digest}"


def cause_of(trace: Trace) -> Cause:
    """The cause of a failure, from its shrunk trace.

    Raises:
        ValueError: nothing is violated in it.
    """
    if not trace.violated:
        raise ValueError("a trace in which nothing is violated has no cause")
    events = trace.events[: trace.at_step]
    return Cause(
        violated=trace.violated[0],
        step=events[-1].step if events else "start",
        before=_before(trace, events),
        broken_assumptions=tuple(sorted(trace.broken_assumptions)),
        planted=trace.planted,
    )


def _before(trace: Trace, events: tuple[Event, ...]) -> tuple[str, ...]:
    """The last kinds of relevant steps, sorted."""
    if not events:
        return ()
    of_car = {car: train for train, cars in trace.trains.items() for car in cars}
    last = events[-1]
    wanted, kinds = set(subjects(last, of_car)), dict[str, None]()
    for event in reversed(events[:-1]):
        if len(kinds) < KINDS and event.step != last.step and wanted & set(subjects(event, of_car)):
            kinds[event.step] = None
    return tuple(sorted(kinds))


def subjects(event: Event, of_car: dict[Car, Train]) -> Iterable[tuple[str, Any]]:
    """The trains, points and blocks that an event is of."""
    for name, value in event.event.items():
        if isinstance(value, Run):
            yield "train", value.train
        elif name == "train":
            yield "train", value
        elif name in ("car", "other"):
            yield "train", of_car.get(value)
        elif name == "point":
            yield "point", value
        elif name in ("block", "target"):
            yield "block", value
        elif name == "blocks":
            yield from (("block", block) for block in value)
