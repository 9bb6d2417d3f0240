"""Real track, cars, tags and antennas in mm: nothing that happens there is refused by the abstract world."""

from __future__ import annotations

from collections import Counter
from collections.abc import Mapping
from typing import Any

import pytest

from kernel.names import Block, Car, Route, Train
from models.concrete.drive import Drive, NatureRefusedError
from models.concrete.journey import Journeys, place
from models.layouts import load
from models.world.state import System
from proofs.catalogue import INVARIANTS
from tests.layouts.stations import ROOT

STATIONS: Mapping[str, tuple[tuple[str, ...], str]] = {
    "passing_station": (("west line", "east line"), "W to 1"),
    "terminus": (("arrival line", "platform 2"), "arrive 1"),
}
"""For each station where its trains begin, and a route that runs towards the tracks' ends."""
SEEDS = range(6)
ROUTES = 16


def station(name: str, seed: int) -> Drive:
    """Two trains, of three cars and of two, with every invariant watched."""
    imported = load(ROOT / "layouts" / f"{name}.toml")
    starts, eastward = STATIONS[name]
    names = sorted(imported.layout.fleet)[: len(starts)]
    formed = {train: tuple(Car(f"{train}{i}") for i in range(3 - n)) for n, train in enumerate(names)}
    where = {train: Block(block) for train, block in zip(names, starts, strict=True)}
    drive = place(imported, formed, where, Route(eastward), seed)

    def watch(step: str, event: Mapping[str, Any], after: System) -> None:
        broken = [claim for claim, holds in INVARIANTS.items() if not holds(drive.play.site, after)]
        assert not broken, f"{step}({event}) breaks {broken}"

    drive.play.watch = watch
    return drive


def driven(name: str, seed: int, missed: float = 0.0, parting: bool = False) -> Drive:
    """Routes for both trains in turn."""
    drive = station(name, seed)
    drive.missed = missed
    journeys = Journeys(drive)
    for turn in range(ROUTES):
        train = drive.trains[turn % len(drive.trains)]
        drive.seen["runs"] += journeys.go(train)
        if parting and turn == ROUTES // 3:
            journeys.parts(train)
    return drive


@pytest.mark.parametrize("name", STATIONS)
def test_what_cars_do_on_track_is_allowed(name: str) -> None:
    seen: Counter[str] = Counter()
    for seed in SEEDS:
        seen += driven(name, seed).seen
    for what in ("runs", "arrivals", "turns", "stops", "moves", "several things between two samples"):
        assert seen[what] >= len(SEEDS), (what, seen)


def test_what_cars_do_when_tags_are_missed_is_allowed() -> None:
    seen: Counter[str] = Counter()
    for name in STATIONS:
        for seed in SEEDS:
            seen += driven(name, seed, missed=0.1).seen
    for what in ("missed", "brakes", "follows"):
        assert seen[what] >= 1, (what, seen)


@pytest.mark.parametrize("name", STATIONS)
def test_what_a_parted_train_does_is_allowed(name: str) -> None:
    seen: Counter[str] = Counter()
    for seed in SEEDS:
        seen += driven(name, seed, parting=True).seen
    assert seen["parts"] >= 1


def test_slips_are_seen() -> None:
    assert sum(driven("passing_station", seed).seen["slips"] for seed in SEEDS) >= 1


def test_a_world_that_forbids_what_nature_does_is_noticed() -> None:
    drive = station("passing_station", 1)
    drive.play.steps = {**drive.play.steps, "car_leaves": lambda site, system, **event: system}
    with pytest.raises(NatureRefusedError):
        all_go(Journeys(drive))


def all_go(journeys: Journeys) -> None:
    for train in journeys.drive.trains * 3:
        journeys.go(train)


def test_trains_are_where_the_test_says() -> None:
    drive = station("terminus", 0)
    assert {train.name for train in drive.trains} == {Train("1T"), Train("2T")}
