"""Plain traffic in CPython with a planted fault: what a campaign of the compiled engine is measured against."""

from __future__ import annotations

import json
from dataclasses import dataclass
from pathlib import Path
from random import Random

from fuzz.failures.replaying import ERRORS
from fuzz.failures.trace import text_of
from fuzz.machines.places import placed
from fuzz.machines.watched import Broken, Place, WatchedPlay
from fuzz.planted.reachable import broken_by
from models.layouts import load
from models.simulator.journey import Chances
from models.simulator.play import berths
from models.simulator.traffic import Troubles, traffic_at
from proofs.mutated import Sources

NO_FAULT: Sources = {}


@dataclass(frozen=True)
class Traces:
    """What one batch came to: traces of failures as JSON texts, and how many steps changed something."""

    failures: tuple[str, ...]
    steps: int


@dataclass(frozen=True)
class PlainTraffic:
    """Traffic on a layout file, with troubles drawn for each batch from its number.

    ``trains``: at most so many.  ``seconds``: simulated, for one batch.
    """

    file: Path
    trains: int = 3
    seconds: int = 400

    def place(self, random: Random) -> Place:
        """Trains of two cars, apart from each other, anywhere that a route begins."""
        imported = load(self.file)
        fleet = sorted(imported.layout.fleet)[: self.trains]
        where = dict(zip(fleet, berths(imported.layout, random, len(fleet)), strict=False))
        return placed(self.file, imported, where)

    def batch(self, sources: Sources, number: int) -> Traces:
        """Run one batch with a fault; the same for the same number."""
        random = Random(number)
        place = self.place(random)
        where = {train: min(place.at[cars[0]]) for train, cars in place.trains.items()}
        moving = traffic_at(place.site, where, random, _chances(random), _troubles(random))
        play = WatchedPlay(place, sources)
        moving.play = play
        failures: tuple[str, ...] = ()
        try:
            moving.run(self.seconds)
        except Broken as broken:
            failures = (text_of(broken.trace),)
        except ERRORS:
            # The simulator itself is at a loss in a state that the fault has led to.
            failures = ()
        return Traces(failures, play.accepted.total())

    def run_batch(self, sources: Sources, number: int) -> tuple[str, ...]:
        """The failures of one batch, as canaries ask for them."""
        return self.batch(sources, number).failures


def _chances(random: Random) -> Chances:
    return Chances(
        loss=random.choice((0.0, 0.2, 0.5)),
        missed_tag=random.choice((0.0, 0.1)),
        withdrawn=random.choice((0.0, 0.1)),
        cancelled=random.choice((0.0, 0.3)),
        slips=random.choice((0.0, 0.5)),
    )


def _troubles(random: Random) -> Troubles:
    """Each trouble is there or is not; all are rare enough for trains to get on."""
    often = {
        "centre_restarts": 0.004,
        "unit_restarts": 0.006,
        "terminal_restarts": 0.02,
        "foreign_tag": 0.004,
        "overdue_tag": 0.004,
        "old_message": 0.5,
        "parts": 0.004,
    }
    return Troubles(**{name: random.choice((0.0, chance)) for name, chance in often.items()})


@dataclass(frozen=True)
class PlainWalks:
    """Walks in CPython of one theory, by its name: what finds canaries where there is no compiled engine."""

    theory: str

    def run_batch(self, sources: Sources, number: int) -> tuple[str, ...]:
        """The failures of one walk, as canaries ask for them."""
        broken = broken_by(self.theory, sources, number)
        if broken is None:
            return ()
        if isinstance(broken, Broken):
            return (text_of(broken.trace),)
        return (json.dumps({"theory": self.theory, "violated": broken.violated, "steps": len(broken.taken)}),)
