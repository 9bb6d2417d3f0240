"""States to begin with: short traffic with every trouble, in CPython."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import fields, is_dataclass
from itertools import islice
from random import Random
from typing import Any

from fuzz.machines.places import over_points
from kernel.machine.centre import NO_ROUTE
from kernel.names import Run, Serial, UnitLife
from models.layouts import Imported
from models.simulator.journey import Chances
from models.simulator.play import berths, site_of, two_cars_each
from models.simulator.traffic import Traffic, Troubles, traffic_at
from models.world.state import Site, System

CHANCES = Chances(loss=0.1, missed_tag=0.05, cancelled=0.1, withdrawn=0.05, slips=0.2)
TROUBLES = Troubles(0.004, 0.01, 0.01, 0.01, 0.01, 0.2, 0.004)
"""Often, so that short traffic meets them."""
TRAINS = 2
MOST_RUNS = 12
"""A state with more runs in it is not begun with: few runs meet more often."""
ROUNDS = 150
EVERY = 7
"""One state in so many along traffic is taken."""
SPARE_RUNS = 5
"""So many runs of any train, life and route are told apart beside those of a state."""
LIVES, SERIALS = 3, 8


def site_for(imported: Imported) -> Site:
    """The site that all these states are of."""
    fleet = sorted(imported.layout.fleet)[:TRAINS]
    return site_of(imported.layout, imported.ground, imported.records, two_cars_each(fleet))


def states(imported: Imported, count: int) -> list[tuple[System, list[Run]]]:
    """So many states, or a few less, and the runs in each in their slots; the same for the same layout."""
    found: list[tuple[System, list[Run]]] = []
    for seed in range(count):
        if len(found) < count:
            found.extend(islice(_along(_traffic(imported, seed)), seed % EVERY, None, EVERY))
    random, site = Random(len(found)), site_for(imported)
    return [(system, runs + spare_runs(site, runs, random)) for system, runs in found[:count]]


def spare_runs(site: Site, known: list[Run], random: Random) -> list[Run]:
    """Runs that a state does not have; a jolt may bring them in."""
    trains = sorted({train for _, train in site.formation.train_of.items()})
    routes = [NO_ROUTE, *sorted(site.layout.routes)]
    made: set[Run] = set()
    while len(made) < SPARE_RUNS:
        serial, life = Serial(random.randrange(SERIALS)), UnitLife(random.randrange(LIVES))
        made.add(Run(serial, random.choice(trains), life, random.choice(routes)))
        made -= set(known)
    return sorted(made)


def _traffic(imported: Imported, seed: int) -> Traffic:
    """Traffic of two trains; in every other one they begin over points, as after a restart between stations."""
    random = Random(seed)
    fleet = sorted(imported.layout.fleet)[:TRAINS]
    choose = over_points if seed % 2 else berths
    where = dict(zip(fleet, choose(imported.layout, random, len(fleet)), strict=False))
    return traffic_at(site_for(imported), where, random, CHANCES, TROUBLES)


def _along(traffic: Traffic) -> Iterator[tuple[System, list[Run]]]:
    """Every state of a short time of traffic, each one step after the other."""
    met: list[System] = []
    traffic.play.watch = lambda step, event, system: met.append(system)
    for _ in range(ROUNDS):
        traffic.run(1)
    for system in met:
        runs = sorted(set(runs_in(system)))
        if len(runs) > MOST_RUNS:
            return
        yield system, runs


def runs_in(value: Any) -> Iterator[Run]:
    """Every run in a value, some of them often."""
    if isinstance(value, Run):
        yield value
    elif is_dataclass(value):
        for field in fields(value):
            yield from runs_in(getattr(value, field.name))
    elif isinstance(value, tuple | frozenset):
        for each in value:
            yield from runs_in(each)
    elif hasattr(value, "items"):
        for key, each in value.items():
            yield from runs_in(key)
            yield from runs_in(each)
