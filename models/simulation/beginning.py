"""Where trains stand at first and where they are to go: of some draws the one in which most can go anywhere."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from random import Random

from kernel.layout import Layout
from kernel.names import Block, Train
from models.concrete.rails import Rails
from models.concrete.train import CAR_MM
from models.layouts.results import BadInput, Imported
from models.simulation.faults import Chosen
from models.simulation.foresight import Foresight, drawn
from models.simulation.roads import Road
from models.simulation.timetable import Trip
from models.simulator.play import berths

CARS = 3
"""So many cars a train has where nobody says it."""
STAND_MM = 60_000
"""So much longer than a train at rest is a block that holds it."""
DRAWS = 3
USUAL_TRAINS = 8


@dataclass(frozen=True)
class Plan:
    """What a simulation is made of; ``trips``: so many a train, however long that takes, up to ``hours``.

    ``roads``: those that cross the line.  ``cars``: how many each train has.
    """

    imported: Imported
    seed: int
    trains: int
    hours: float
    chosen: Chosen
    trips: int | None = None
    roads: tuple[Road, ...] = ()
    cars: int = CARS


Begun = tuple[Mapping[Train, Block], Mapping[Train, list[Trip]]]


def rails_of(imported: Imported) -> Rails:
    """The rails of a layout.

    Raises:
        BadInput: its file has no track, or no routes.
    """
    if imported.station is None:
        raise BadInput(imported.name, "track", "the file has no track for trains to run on", "give RailJSON, railML 3")
    if not imported.layout.routes:
        raise BadInput(imported.name, "routes", "there are none, so no train can move", "give a layout that has some")
    return Rails(imported)


def room(layout: Layout, rails: Rails, random: Random, cars: int) -> list[Block]:
    """Draw blocks in which trains can stand: without points, long enough for so many cars, none beside another."""
    longest: dict[Block, int] = {}
    for index, block in enumerate(rails.block):
        longest[block] = max(longest.get(block, 0), rails.length_mm((index, 0)))
    found = berths(layout, random, len(layout.blocks))
    return [block for block in found if longest[block] > CAR_MM * cars + STAND_MM and not layout.points_in[block]]


def usual_trains(imported: Imported, cars: int = CARS) -> int:
    """How many trains run where nobody says it: half of what has room, eight at most."""
    return max(1, min(USUAL_TRAINS, len(room(imported.layout, rails_of(imported), Random(0), cars)) // 2))


def drawn_room(imported: Imported, rails: Rails, seed: int, cars: int) -> list[list[Block]]:
    """Each draw of where trains may stand at first."""
    return [room(imported.layout, rails, Random(f"{seed} berths {draw}"), cars) for draw in range(DRAWS)]


def begun(plan: Plan, names: Sequence[Train], rails: Rails, foresight: Foresight) -> Begun:
    """Draw where trains stand and where they are to go.

    Raises:
        BadInput: so many trains have no room.
    """
    best: Begun | None = None
    for draw, free in enumerate(drawn_room(plan.imported, rails, plan.seed, plan.cars)):
        where = dict(zip(names, free, strict=False))
        if len(where) < len(names):
            what, do = f"only {len(where)} of {len(names)} trains can stand apart", "ask for fewer"
            if not where:
                what, do = "no block that a route begins in has room for a train at rest", "give a layout that has one"
            raise BadInput(plan.imported.name, "--trains", what, do)
        trips = drawn(foresight, where, Random(f"{plan.seed} timetable {draw}"), plan.hours, plan.trips)
        if best is None or _idle(trips) < _idle(best[1]):
            best = where, trips
    assert best is not None
    return best


def _idle(trips: Mapping[Train, Sequence[Trip]]) -> int:
    """How many trains have nowhere to go."""
    return sum(not each for each in trips.values())
