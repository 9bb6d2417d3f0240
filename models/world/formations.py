"""Which car is last in which run: cars keep their order on rails, and routes have a direction (T2).

A formation answers for every run there may ever be, so its maps are functions and not tables.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from typing import TypeVar

from kernel.layout import Layout
from kernel.maps import Map
from kernel.names import Block, Cab, Car, Route, Run, Train
from models.ground import Ground
from models.world.state import Formation

V = TypeVar("V")

Boundary = tuple[Block, Block]
"""Two neighbouring blocks, in running order."""


class ByRun(Mapping[Run, V]):
    """A function of runs, seen as a map; it lists the runs that were looked up."""

    def __init__(self, trains: frozenset[Train], value: Callable[[Run], V]) -> None:
        self._trains = trains
        self._value = value
        self._seen: dict[Run, V] = {}

    def __getitem__(self, run: Run) -> V:
        """Give the value of a run of a known train."""
        if run not in self:
            raise KeyError(run)
        if run not in self._seen:
            self._seen[run] = self._value(run)
        return self._seen[run]

    def __contains__(self, run: object) -> bool:
        """Tell whether the run is of a known train."""
        return isinstance(run, Run) and run.train in self._trains

    def __iter__(self) -> Iterator[Run]:
        """Give the runs looked up so far."""
        return iter(tuple(self._seen))

    def __len__(self) -> int:
        """Count them."""
        return len(self._seen)

    def __or__(self, other: dict[Run, V]) -> ByRun[V]:
        """Give the same function with some values replaced."""
        return ByRun(self._trains, lambda run: other[run] if run in other else self[run])


def formation(trains: Mapping[Train, Sequence[Car]], along: Callable[[Route], bool]) -> Formation:
    """The formation of trains given with their cars in order; the first leads in routes that run ``along``."""

    def order(run: Run) -> tuple[Car, ...]:
        cars = tuple(trains[run.train])
        return cars if along(run.route) else cars[::-1]

    def ahead(run: Run) -> Map[Car, frozenset[Car]]:
        cars = order(run)
        return {car: frozenset(cars[:place]) for place, car in enumerate(cars)}

    known = frozenset(train for train, cars in trains.items() if cars)
    return Formation(
        train_of={car: train for train, cars in trains.items() for car in cars},
        front=ByRun(known, lambda run: Cab(f"cab of {order(run)[0]}")),
        last=ByRun(known, lambda run: order(run)[-1]),
        ahead=ByRun(known, ahead),
        cab={car: Cab(f"cab of {car}") for cars in trains.values() for car in cars},
    )


def directions(layout: Layout, ground: Ground) -> Mapping[Route, bool]:
    """Whether each route runs along or against one common direction of the whole line.

    What a route runs over in one go comes first; which side of a block its other neighbours lie on
    is only guessed, where nothing else joins them.  Track that meets itself the other way round (a
    balloon loop) has no common direction: there the first answer stands.
    """
    sense = _Senses()
    for route in sorted(layout.routes):
        for block, target in layout.way[route].items():
            onward = layout.way[route].get(target)
            if onward is not None:
                sense.join((block, target), (target, onward))
            for other in sorted(ground.leads[route][block]):
                sense.join((block, other), (block, target))
    for route in sorted(layout.routes):
        for block, target in layout.way[route].items():
            for other in sorted(ground.neighbours.get(block, frozenset()) - frozenset(ground.leads[route][block])):
                sense.join((other, block), (block, target))
    return {
        route: sense.of(next((block, target) for block, target in layout.way[route].items())) for route in layout.routes
    }


class _Senses:
    """Boundaries, joined where they are run over in the same direction."""

    def __init__(self) -> None:
        self.root: dict[Boundary, tuple[Boundary, bool]] = {}

    def find(self, boundary: Boundary) -> tuple[Boundary, bool]:
        """The boundary that stands for this one, and whether both are run over in the same direction."""
        key, same = (min(boundary), max(boundary)), boundary[0] <= boundary[1]
        path = (key[0], key[1])
        while (step := self.root.setdefault(path, (path, True)))[0] != path:
            path, same = step[0], same == step[1]
        return path, same

    def join(self, first: Boundary, second: Boundary) -> None:
        """Say that both are run over in the same direction."""
        (one, one_same), (two, two_same) = self.find(first), self.find(second)
        if one != two:
            self.root[one] = (two, one_same == two_same)

    def of(self, boundary: Boundary) -> bool:
        """Whether it is run over as the one that stands for it."""
        return self.find(boundary)[1]
