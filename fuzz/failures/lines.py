"""Simulates a line of a trace again, in plain CPython: seed, faults and trains that go nowhere make the whole of it."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

from fuzz.failures.trace import LineTrace, layout_at
from fuzz.simulation.lines import Came, Line, from_json, simulated
from models.layouts.results import BadInput
from models.simulation.faults import BY_NAME
from models.simulation.history import History
from models.simulation.kilometres import Kilometres
from models.simulation.outcome import Outcome, outcome
from models.simulation.simulation import Simulation


@dataclass(frozen=True)
class Simulated:
    """What a line came to; ``outcome``: as ``heisoku simulate`` tells it."""

    trace: LineTrace
    came: Came
    outcome: Outcome

    @property
    def violated(self) -> tuple[str, ...]:
        """The oracles and invariants that are false."""
        return self.came.violated

    @property
    def as_told(self) -> bool:
        """Whether it came to what the trace says."""
        return (self.came.violated, self.came.sim.now_s) == (self.trace.violated, self.trace.at_s)

    @property
    def verdict(self) -> str:
        """What it came to, on one line."""
        if self.came.violated:
            return f"reproduced: {', '.join(self.came.violated)} violated in second {self.came.sim.now_s:,}"
        return f"not reproduced: nothing is violated in {self.came.sim.now_s:,} s"


def simulate_again(trace: LineTrace, path: Path) -> Simulated:
    """Simulate it; ``path``: the trace's file, from whose folder its layout is named.

    Raises:
        BadInput: the layout is not that of the trace, or the trace names what is not there.
    """
    imported, line = layout_at(trace.layout, path), from_json(trace.told)
    _known(line, path)
    seen = _Seen(line, path)
    came = simulated(line, imported, compiled=False, look=seen.look, ready=seen.begin)
    assert seen.history is not None
    return Simulated(trace, came, outcome(came.sim, seen.history, came.judge.asked))


class _Seen:
    """Keeps the history of a line, once it is there."""

    def __init__(self, line: Line, path: Path) -> None:
        self.line, self.path = line, path
        self.history: History | None = None

    def begin(self, sim: Simulation) -> None:
        self.history = History(Kilometres(sim.rails))
        named = {*sim.services, *sim.play.site.layout.points, ""}
        for each in self.line.occurrences or ():
            if each.who not in named:
                raise _wrong(self.path, "occurrences", f"there is no train and no point '{each.who}'")

    def look(self, sim: Simulation) -> None:
        assert self.history is not None
        self.history.look(sim)


def _known(line: Line, path: Path) -> None:
    """Every fault and train that the trace names is there."""
    names = (*line.faults, *(each.fault for each in line.occurrences or ()))
    unknown = [name for name in names if name not in BY_NAME or BY_NAME[name].per == "crossing hour"]
    if unknown:
        raise _wrong(path, "faults", f"there is no fault '{unknown[0]}' of a line")
    for train in line.still:
        if train not in [f"T{number:02}" for number in range(1, line.trains + 1)]:
            raise _wrong(path, "still", f"there is no train '{train}'")


def _wrong(path: Path, place: str, what: str) -> BadInput:
    return BadInput(str(path), place, what, "replay it with the version that found it")
