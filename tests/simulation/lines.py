"""Short simulations on the sample layouts, for the tests beside this file."""

from __future__ import annotations

from functools import cache
from pathlib import Path

from fuzz.simulation.judging import Judge
from models.layouts import load
from models.layouts.results import Imported
from models.simulation.beginning import Plan
from models.simulation.faults import EVERY_FAULT, FAULTS, Chosen, Setting
from models.simulation.history import History
from models.simulation.kilometres import Kilometres
from models.simulation.outcome import Outcome, outcome
from models.simulation.simulation import Simulation

LAYOUTS = Path(__file__).resolve().parents[2] / "layouts"
SAMPLES = ("passing_station", "terminus", "junction")
HARD: Chosen = {fault.name: Setting(3 * fault.rate, fault.least, fault.most) for fault in FAULTS}
"""Every fault three times as often."""


@cache
def imported(place: str) -> Imported:
    return load(LAYOUTS / f"{place}.toml")


def plan(
    place: str,
    seed: int = 1,
    trains: int = 3,
    hours: float = 0.1,
    chosen: Chosen = EVERY_FAULT,
    trips: int | None = None,
) -> Plan:
    return Plan(imported(place), seed, trains, hours, chosen, trips)


def simulated(given: Plan) -> Outcome:
    """Run it, judged by every invariant of the proofs in each second in which anything happens."""
    sim, judge = Simulation(given), Judge()
    history = History(Kilometres(sim.rails))

    def look(now: Simulation) -> None:
        history.look(now)
        judge.look(now)

    sim.run(look)
    return outcome(sim, history, judge.asked)
