"""Simulated lines as a target: centre, computers on board, sensors, radio and points together, in millimetres.

What must be true of the simulated truth is asked by the oracles of ``models.simulation``, at every cycle, telegram
and step that may have made it false; the invariants of the proofs are asked as ``heisoku simulate`` asks them.
"""

from __future__ import annotations

import gc
import json
import time
from collections import Counter
from collections.abc import Mapping
from dataclasses import dataclass
from functools import lru_cache
from pathlib import Path
from random import Random
from typing import Any

from fuzz.failures.trace import LayoutFile, layout_file
from fuzz.simulation.lines import Came, Line, as_json, simulated
from fuzz.simulation.shrinking import shrink
from fuzz.targets.target import Batch, Result, digest_of_sources
from models.layouts import load
from models.layouts.results import Imported
from models.simulation.beginning import CARS, drawn_room, rails_of
from models.simulation.diary import Diary
from models.simulation.faults import FAULTS, Chosen, Setting
from models.simulation.phases import HAS_PARTED
from models.simulation.simulation import Simulation
from models.simulation.waiting import deadlocked
from models.simulator.play import WORLD
from models.world.state import System

FORMAT = "heisoku trace 1"
TRAINS, HOURS = 20, 1.0
"""So many trains where they have room, and so long a day."""
SECONDS_AN_HOUR = 3_600
LAYOUTS = "../layouts"
"""Where a campaign keeps its layouts, from where it keeps its traces."""
DRAWN = tuple(fault for fault in FAULTS if fault.per != "crossing hour")
"""Those that can come on a line without roads."""
NAMES = tuple(fault.name for fault in DRAWN)
TIMED = tuple(fault.name for fault in DRAWN if not fault.is_share)
"""Those that come at some time, and not with every so many telegrams, tags or orders."""
COMES, TIMES = 0.75, (0.5, 4.0)
"""A fault's chance to be among those of a line, and how many times as often as usual it comes there."""
NO_FAULT = "no fault"
STEPS = tuple(sorted(WORLD))
PLACES = {step: at for at, step in enumerate(STEPS)}
PAIR = 1 << 16
"""Ids of tuples are below it; a pair's id is the first tuple's times this and the second's."""


@dataclass(frozen=True)
class Lines:
    """Lines on the layout at ``path``, an hour each, within the declared faults: nothing may be broken.

    ``fault``: the name of a planted fault that runs.  ``shrinks``: failures are made short before they are given.
    A step is a second of a train.  A tuple is a transition of the world, and the fault
    that came last before it, of those that come at some time.
    """

    path: Path
    trains: int = TRAINS
    hours: float = HOURS
    fault: str | None = None
    shrinks: bool = True

    @property
    def name(self) -> str:
        """The target's name: one for each layout."""
        return f"lines:{self.path.name}"

    def identity(self) -> Mapping[str, str]:
        """The layout's bytes, the sources, how long and how many, and the faults."""
        return {
            "layout": layout_file(self.path, self.path.parent).sha256,
            "sources": digest_of_sources("kernel", "models", "proofs/invariants", "fuzz/simulation", "fuzz/targets"),
            "faults": "; ".join(f"{each.name} {each.rate} a {each.per}" for each in DRAWN),
            "trains": str(self.trains),
            "hours": str(self.hours),
        }

    def describe(self, tuple_id: int) -> str:
        """Say a tuple in words."""
        fault, step = divmod(tuple_id, len(STEPS))
        return f"{(NO_FAULT, *TIMED)[fault]}: {STEPS[step]}"

    def families(self) -> tuple[str, ...]:
        """The faults."""
        return NAMES

    def line(self, batch: Batch) -> Line:
        """The line of a batch."""
        random = Random(f"{batch.seed} {batch.number} {self.name}")
        weights = dict(zip(NAMES, batch.weights, strict=True)) if batch.weights else {}
        seed = random.randrange(2**31)
        return Line(
            seed=seed,
            trains=min(self.trains, have_room(self.path, seed)),
            hours=self.hours,
            faults=chosen(random, weights),
            planted=self.fault,
        )

    def run(self, batch: Batch) -> Result:
        """Simulate one line; if anything is broken it is a failure."""
        assert batch.target == self.name, batch
        began = time.perf_counter()
        seen = Seen()
        came = simulated(self.line(batch), imported(self.path), watch=seen.step, ready=seen.begin)
        sim = came.sim
        return Result(
            batch=batch,
            traces=1,
            steps=sim.now_s * len(sim.vehicles),
            counts=counts(came),
            covered=seen.covered,
            pairs=seen.pairs,
            sketch=b"",
            failures=(self.text(batch, came),) if came.violated else (),
            seconds=time.perf_counter() - began,
        )

    def text(self, batch: Batch, came: Came) -> str:
        """A failure, short where that is wanted, and so that it can be run again."""
        if self.shrinks:
            came = shrink(came, imported(self.path)).came
        layout = LayoutFile(f"{LAYOUTS}/{self.path.name}", layout_file(self.path, self.path.parent).sha256)
        trace = {
            "format": FORMAT,
            "target": "lines",
            "layout": vars(layout),
            "batch": batch.number,
            **as_json(came.line),
            "violated": list(came.violated),
            "at_s": came.sim.now_s,
        }
        return json.dumps(trace, ensure_ascii=False)


class Seen:
    """What a line came through: each step with the fault that came last before it."""

    def __init__(self) -> None:
        self.covered: Counter[int] = Counter()
        self.pairs: Counter[int] = Counter()
        self._diary: Diary | None = None
        self._before = 0

    def begin(self, sim: Simulation) -> None:
        """Look into its diary from now on."""
        self._diary = sim.diary

    def step(self, step: str, event: Mapping[str, Any], system: System) -> None:
        """A step of the world was taken."""
        del event, system
        fault = self._diary.last_fault if self._diary is not None else ""
        here = (TIMED.index(fault) + 1 if fault else 0) * len(STEPS) + PLACES[step]
        self.covered[here] += 1
        self.pairs[self._before * PAIR + here] += 1
        self._before = here


def chosen(random: Random, weights: Mapping[str, float]) -> Chosen:
    """Draw which faults come on a line, and how often."""
    found: dict[str, Setting] = {}
    for fault in DRAWN:
        comes, times = random.random() < COMES, random.uniform(*TIMES) * weights.get(fault.name, 1.0)
        if comes and times > 0:
            rate = fault.rate * times
            found[fault.name] = Setting(min(1.0, rate) if fault.is_share else rate, fault.least, fault.most)
    return found


def counts(came: Came) -> dict[str, int]:
    """What is summed over lines: faults, telegrams by what became of them, and what was asked."""
    sim = came.sim
    faults = sim.diary.faults + sim.line.seen + sim.air.seen + sim.motors.seen
    asked = {f"asked: {name}": count for name, count in sim.oracles.checked.items()}
    return {
        "simulated seconds": sim.now_s,
        "train seconds": sim.now_s * len(sim.vehicles),
        "m run": round(sum(each.way_mm for each in sim.vehicles.values()) / 1_000),
        "trips": sum(each.done for each in sim.services.values()),
        "trips of the timetable": sum(len(each.trips) for each in sim.services.values()),
        "lines with trains in deadlock at the end": bool(deadlocked(sim.waits, sim.gone)),
        "trains that have parted": sum(each.phase in HAS_PARTED for each in sim.services.values()),
        "telegrams": sim.air.sent,
        "invariants asked": came.judge.asked.total(),
        **{f"fault: {name}": faults[name] for name in came.line.faults},
        **asked,
    }


@lru_cache(maxsize=4)
def imported(path: Path) -> Imported:
    """Read a layout, once in each process; what lasts so long is not looked through for garbage again and again.

    Raises:
        BadInput: it is no layout.
    """
    found = load(path)
    gc.collect()
    gc.freeze()
    return found


def have_room(path: Path, seed: int) -> int:
    """How many trains have room on a layout by a seed, each in a block of its own.

    Raises:
        BadInput: it has no track, or no routes.
    """
    here = imported(path)
    return min(map(len, drawn_room(here, rails_of(here), seed, CARS)))


def runs_on(path: Path) -> bool:
    """Whether lines can be simulated on a layout: it has track, and room for a train.

    Raises:
        BadInput: it is no layout.
    """
    here = imported(path)
    return here.station is not None and bool(here.layout.routes) and have_room(path, 0) > 0
