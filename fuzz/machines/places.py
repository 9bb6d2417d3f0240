"""Where the state machines play: a tiny station, and any layout file, with trains of two cars apart from each other."""

from __future__ import annotations

from collections.abc import Mapping
from functools import cache
from pathlib import Path
from random import Random

from fuzz.machines.watched import Place
from kernel.layout import Layout
from kernel.names import Block, Train
from models.layouts import Imported, load
from models.simulator.play import begin, berths, site_of, two_cars_each

TINY = Path(__file__).with_name("tiny.toml")
"""A line, two platforms and a siding."""


OVER_POINTS = 4
"""Of five seeds this one has trains stand over points, as after a restart between stations."""


@cache
def place_on(file: Path, trains: int = 2, seed: int = 0) -> Place:
    """A layout file with so many trains of its fleet, where chance has them; everything has just started."""
    imported = load(file)
    fleet = sorted(imported.layout.fleet)[:trains]
    choose = over_points if seed % 5 == OVER_POINTS else berths
    where = dict(zip(fleet, choose(imported.layout, Random(seed), len(fleet)), strict=False))
    return placed(file, imported, where)


def placed(file: Path, imported: Imported, where: Mapping[Train, Block]) -> Place:
    """A layout file with trains of two cars in these blocks; everything has just started."""
    cars = two_cars_each(sorted(where))
    site = site_of(imported.layout, imported.ground, imported.records, cars)
    track = begin(site, cars, where).system.track
    trains = {train: tuple(each) for train, each in cars.items()}
    return Place(file, site, trains, dict(track.at.items()), dict(track.lies.items()))


def over_points(layout: Layout, random: Random, trains: int) -> list[Block]:
    """Blocks for trains to begin in, one with points first, none too close to another."""
    blocks = sorted(layout.blocks)
    random.shuffle(blocks)
    blocks.sort(key=lambda block: not layout.points_in.get(block))
    taken: list[Block] = []
    for block in (blocks[0], *reversed(blocks[1:])):
        if len(taken) < trains and not layout.fouls.get(block, frozenset()) & frozenset(taken):
            taken.append(block)
    return taken
