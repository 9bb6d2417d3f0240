"""A world that is played: its state, the steps taken so far, and who looks on."""

from __future__ import annotations

import inspect
from collections import Counter
from collections.abc import Callable, Mapping, Sequence
from dataclasses import replace
from random import Random
from typing import Any

from kernel.layout import Layout, TagRecords
from kernel.names import Block, Car, Point, Position, Train
from models.ground import Ground
from models.layouts.continuation import with_continuations
from models.world import at_a_point, at_the_centre, nature, on_board, radio
from models.world.formations import directions, formation
from models.world.start import site_as_told, start
from models.world.state import Site, System

Step = Callable[..., System]
Watcher = Callable[[str, Mapping[str, Any], System], None]
"""Told the name and event of every step that changed something, and the state after it."""

MODULES = (at_the_centre, on_board, at_a_point, radio, nature)
HELPERS = frozenset({"with_unit", "in_the_life", "with_terminal", "accounted_for", "_stated"})
WORLD: Mapping[str, Step] = {
    name: value
    for module in MODULES
    for name, value in vars(module).items()
    if inspect.isfunction(value) and value.__module__ == module.__name__ and name not in HELPERS
}
"""Every transition of the world by name."""


class Play:
    """The state of a world, moved on step by step; counts what was tried and what changed something.

    ``is_tied``: its steps are the kernel's own, so that they come to what the machines of the kernel make of an input;
    not so where a fault is planted in them.
    """

    def __init__(self, site: Site, system: System, watch: Watcher | None = None, steps: Mapping[str, Step] = WORLD):
        self.site = site
        self.system = system
        self.steps = steps
        self.watch = watch
        self.is_tied = True
        self.tried: Counter[str] = Counter()
        self.accepted: Counter[str] = Counter()

    def take(self, step: str, **event: Any) -> bool:
        """Try a step; tell whether it changed anything."""
        after = self.steps[step](self.site, self.system, **event)
        self.tried[step] += 1
        if after == self.system:
            return False
        self.system = after
        self.accepted[step] += 1
        if self.watch is not None:
            self.watch(step, event, after)
        return True


def site_of(layout: Layout, ground: Ground, records: TagRecords, cars: Mapping[Train, Sequence[Car]]) -> Site:
    """A station with its continuations, and these trains for its fleet."""
    wider, ground_wider = with_continuations(layout, ground)
    along = directions(wider, ground_wider)
    return site_as_told(
        layout=replace(wider, fleet=frozenset(cars)),
        records=records,
        ground=ground_wider,
        formation=formation(cars, lambda route: along.get(route, True)),
    )


def two_cars_each(trains: Sequence[Train]) -> Mapping[Train, Sequence[Car]]:
    """Trains with a car at each end."""
    return {train: (Car(f"{train}a"), Car(f"{train}b")) for train in trains}


def berths(layout: Layout, random: Random, trains: int) -> list[Block]:
    """Blocks for trains to begin in: starts of routes, without points, none beside or too close to another."""
    starts = sorted({layout.start[route] for route in layout.routes})
    random.shuffle(starts)
    starts.sort(key=lambda block: bool(layout.points_in[block]))
    taken: list[Block] = []
    for block in starts:
        if len(taken) < trains and not layout.fouls.get(block, frozenset()) & frozenset(taken):
            taken.append(block)
    return taken


def begin(
    site: Site, cars: Mapping[Train, Sequence[Car]], where: Mapping[Train, Block], watch: Watcher | None = None
) -> Play:
    """Everything has just started, each train in one block, every point in its first position."""
    at = {car: frozenset({where[train]}) for train in where for car in cars[train]}
    positions: dict[Point, Position] = {}
    for route in sorted(site.layout.routes):
        for point, position in site.layout.needs[route].items():
            positions.setdefault(point, position)
    lies = {point: positions.get(point, Position("normal")) for point in site.layout.points}
    return Play(site, start(site, at, lies), watch)
