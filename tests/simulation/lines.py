"""Short simulations on the sample layouts, for the tests beside this file."""

from __future__ import annotations

from collections.abc import Mapping
from functools import cache
from pathlib import Path

from fuzz.simulation.judging import Judge
from models.layouts import load
from models.layouts.results import Imported
from models.simulation.beginning import CARS, Plan, rails_of
from models.simulation.faults import EVERY_FAULT, FAULTS, Chosen, Setting
from models.simulation.history import History
from models.simulation.kilometres import Kilometres
from models.simulation.outcome import Outcome, outcome
from models.simulation.roads import Road
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
    roads: tuple[Road, ...] = (),
    cars: int = CARS,
) -> Plan:
    return Plan(imported(place), seed, trains, hours, chosen, trips, roads, cars)


def road(place: str, name: str, *places: tuple[str, float]) -> Road:
    """A road over tracks of a sample, at so many m of each."""
    segments, found = rails_of(imported(place)).segments.segments, []
    for track, at_m in places:
        at_mm = round(1_000 * at_m)
        index = next(
            index for index, each in enumerate(segments) if each.track == track and each.from_mm < at_mm < each.to_mm
        )
        found.append((index, at_mm - segments[index].from_mm))
    return Road(name, tuple(found))


ROADS: Mapping[str, tuple[Road, ...]] = {
    "passing_station": (
        road("passing_station", "Mill Road", ("west", 2_000)),
        road("passing_station", "Long Lane", ("east", 1_500)),
    ),
    "terminus": (road("terminus", "Quay Street", ("arrival", 700), ("departure", 700)),),
    "junction": (road("junction", "Tower Road", ("down_west", 700), ("up_west", 700)),),
}
"""Roads over the samples' tracks."""


def simulated(given: Plan) -> Outcome:
    """Run it, judged by every invariant of the proofs in each second in which anything happens."""
    sim, judge = Simulation(given), Judge()
    history = History(Kilometres(sim.rails))

    def look(now: Simulation) -> None:
        history.look(now)
        judge.look(now)

    sim.run(look)
    return outcome(sim, history, judge.asked)
