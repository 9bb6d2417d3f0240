"""A simulated line from what it follows from, to its end or to the first thing that must be true and is not."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Any

from fuzz.failures.replaying import ERRORS, UNDEFINED, sources_of
from fuzz.simulation.judging import Judge
from kernel.names import Train
from models.layouts.results import Imported
from models.simulation.beginning import CARS, Plan
from models.simulation.compiled import Compiled
from models.simulation.cycles import Cycling, Interpreted
from models.simulation.faults import Setting
from models.simulation.occurrences import Occurrence
from models.simulation.simulation import Simulation
from models.simulator.play import Watcher
from proofs.mutated import running

EVERY_S = 60
"""So often all invariants are asked of a line; the claims among them in every second that changes anything.

Traffic in blocks is where they are asked after each step; what a line adds is the truth in millimetres.
"""


@dataclass(frozen=True)
class Line:
    """What a simulated line follows from, beside its layout.

    ``hours``: at most; timetable and faults are drawn for them.  ``faults``: which come, and how often.
    ``occurrences``: those that come at some time, in place of what would be drawn; None: as drawn.
    ``still``: trains that go nowhere.  ``planted``: the name of a planted fault that runs, if any.
    """

    seed: int
    trains: int
    hours: float
    faults: Mapping[str, Setting]
    cars: int = CARS
    occurrences: tuple[Occurrence, ...] | None = None
    still: tuple[Train, ...] = ()
    planted: str | None = None

    def plan(self, imported: Imported) -> Plan:
        """The plan of the simulation."""
        return Plan(imported, self.seed, self.trains, self.hours, self.faults, cars=self.cars)


@dataclass(frozen=True)
class Came:
    """What a simulated line has come to.

    ``drawn``: the faults that were to come at some time.  ``violated``: what is false, oracles and invariants by name.
    ``text``: what is wrong with the first.
    """

    line: Line
    sim: Simulation
    judge: Judge
    drawn: tuple[Occurrence, ...]
    violated: tuple[str, ...]
    text: str


def simulated(
    line: Line,
    imported: Imported,
    compiled: bool = True,
    watch: Watcher | None = None,
    look: Callable[[Simulation], object] = lambda now: None,
    ready: Callable[[Simulation], object] = lambda now: None,
) -> Came:
    """Run it; ``compiled``: its trains' cycles as machine code, which a planted fault is not in.

    ``look``: is told of each second.  ``ready``: is told of the line before the first.

    Raises:
        BadInput: so many trains have no room, the layout has no track, or there is no such planted fault.
    """
    judge = Judge(EVERY_S)
    cycling: Cycling = Compiled if compiled and line.planted is None else Interpreted

    def each_second(now: Simulation) -> None:
        look(now)
        judge.look(now)

    with running({} if line.planted is None else sources_of(line.planted)):
        sim = Simulation(line.plan(imported), watch, cycling)
        if line.occurrences is not None:
            sim.coming = list(line.occurrences)
        for train in line.still:
            sim.services[train].trips.clear()
        drawn = tuple(sim.coming)
        ready(sim)
        try:
            sim.run(each_second)
        except ERRORS as error:
            sim.oracles.violated(UNDEFINED, f"{type(error).__name__}: {error}")
    found = sim.oracles.found
    return Came(
        line, sim, judge, drawn, tuple(dict.fromkeys(each.oracle for each in found)), found[0].text if found else ""
    )


# ---- as plain data


def as_json(line: Line) -> dict[str, Any]:
    """A line as plain data."""
    return {
        "seed": line.seed,
        "trains": line.trains,
        "cars": line.cars,
        "hours": line.hours,
        "faults": {
            name: {"rate": each.rate, "least": each.least, "most": each.most} for name, each in line.faults.items()
        },
        "occurrences": None if line.occurrences is None else [vars(each) for each in line.occurrences],
        "still": list(line.still),
        "planted": None if line.planted is None else {"name": line.planted},
    }


def from_json(data: Mapping[str, Any]) -> Line:
    """The line of plain data that fits the schema of traces."""
    planted, occurrences = data["planted"], data["occurrences"]
    return Line(
        seed=data["seed"],
        trains=data["trains"],
        cars=data["cars"],
        hours=data["hours"],
        faults={name: Setting(**each) for name, each in data["faults"].items()},
        occurrences=None if occurrences is None else tuple(Occurrence(**each) for each in occurrences),
        still=tuple(map(Train, data["still"])),
        planted=None if planted is None else planted["name"],
    )
