"""Traces for the tests, made by traffic on the sample layouts, with and without a planted fault."""

from __future__ import annotations

from collections.abc import Mapping
from contextlib import suppress
from dataclasses import replace
from functools import cache
from pathlib import Path
from typing import Any

from fuzz.failures.replaying import sources_of
from fuzz.failures.shrinking import shrink
from fuzz.failures.trace import Trace, layout_file, recorded
from models.layouts import Imported, load
from models.simulator.journey import Chances
from models.simulator.play import WORLD, two_cars_each
from models.simulator.traffic import Traffic, Troubles, traffic_on
from models.world.state import System
from proofs.catalogue import INVARIANTS
from proofs.mutated import table_running
from tests.layouts.stations import SAMPLES

LAYOUTS: Mapping[str, Path] = {path.stem: path for path in SAMPLES}
CHANCES = Chances(loss=0.2, missed_tag=0.03, withdrawn=0.03, cancelled=0.1, slips=0.3)
TROUBLES = Troubles(unit_restarts=0.002, terminal_restarts=0.01, overdue_tag=0.001, old_message=0.2, parts=0.002)


class Found(Exception):
    """An invariant is false."""


@cache
def imported(place: str) -> Imported:
    return load(LAYOUTS[place])


def traffic(place: str, seed: int, planted: str | None = None, seconds: int = 600, trains: int = 3) -> Trace:
    """Traffic as recorded; with a fault planted it ends at the first invariant that is false."""
    taken: list[tuple[str, Mapping[str, Any]]] = []
    moving: Traffic

    def watch(step: str, event: Mapping[str, Any], after: System) -> None:
        taken.append((step, dict(event)))
        if planted is not None and any(not claim(moving.play.site, after) for claim in INVARIANTS.values()):
            raise Found

    moving = traffic_on(imported(place), seed, CHANCES, TROUBLES, trains, watch)
    if planted is not None:
        moving.play.steps = table_running(WORLD, sources_of(planted))
        moving.play.is_tied = False
    track = moving.play.system.track
    fleet = two_cars_each(sorted(moving.play.site.layout.fleet))
    at, lies = {car: track.at[car] for cars in fleet.values() for car in cars}, dict(track.lies.items())
    with suppress(Found):
        moving.run(seconds)
    here = layout_file(LAYOUTS[place], LAYOUTS[place].parent)
    return replace(recorded(here, fleet, at, lies, taken), seed=seed, planted=planted)


PLANTED: Mapping[str, tuple[str, int]] = {
    "a terminal that obeys an older run": ("passing_station", 18),
    "a centre that frees the start block on head evidence": ("passing_station", 3),
    "the whole route is released on the evidence of one block": ("junction", 0),
    "a terminal keeps its life over a restart": ("junction", 6),
    "a tag list is taken in any life": ("junction", 0),
}
"""Planted faults, each with a layout and a seed of traffic that finds it, whichever way its trains are made up."""


@cache
def found(planted: str) -> Trace:
    """Traffic that comes to a violation, as long as it is."""
    place, seed = PLANTED[planted]
    return traffic(place, seed, planted)


@cache
def failing() -> Trace:
    """A short trace that fails, on the passing station."""
    return shrink(found("a terminal that obeys an older run"), imported("passing_station")).trace
