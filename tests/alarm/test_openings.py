"""No mild tone with a train near by any way, in networks that branch, loop, break and end (A1, A3).

A worker stands anywhere on the register; a train stands or runs anywhere, told some seconds ago where it was then, in
the figures of that place, and has run on since.  Both fixes err along the track, also over a joint.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from random import Random
from typing import NamedTuple

import pytest

from kernel.alarm import tone as machine
from kernel.alarm.distance import NO_TRAIN_FIX, AlarmBounds, Direction, TrainFix, WorkerFix
from kernel.alarm.least_ways import has_least_ways
from kernel.alarm.network import Opening
from kernel.alarm.tone import Display, Freshness, Handset, Known, Listing, Register, Tone, Train
from tests.alarm.networks import KM, Network, Spot, joins, openings, ways

SPEED_MM_S, ERROR_MM, LENGTH_MM, WORKER_ERROR_MM = 30_000, 20_000, 80_000, 15_000
REGISTER = Register(
    AlarmBounds(SPEED_MM_S, 2_000, LENGTH_MM, ERROR_MM, WORKER_ERROR_MM, 30_000),
    Freshness(fix_ms=10_000, display_ms=12_000, server_ms=8_000, worker_ms=5_000),
    display_error_mm=10_000,
    tolerance_mm=50_000,
    sections={},
    stabled=frozenset(),
    ways={},
    openings={},
    edition=1,
)
READ = Listing(life_ms=0, taken=0, count=0, is_whole=True, named={})
"""A list that is whole, and has been read."""
LIMITS_MM = {Tone.NORMAL: 3 * KM, Tone.CAUTION: 3 * KM // 2}


class Scene(NamedTuple):
    """A world, its register, what the handset knows, and how far the train is by any tracks; has it departed?"""

    network: Network
    register: Register
    handset: Handset
    apart_mm: int
    has_departed: bool


def off(chance: Random, network: Network, spot: Spot, error_mm: int) -> Spot:
    """Give a place that is told in the place of another, no farther along the track than the error."""
    return network.gone_on(chance, spot._replace(ahead=chance.choice((1, -1))), chance.randrange(error_mm + 1))


def known(chance: Random, network: Network, was: Spot, age_ms: int, runs: bool) -> Known:
    """What both sources say of a train that is on the register: place, and direction by the figures of that line."""
    told = off(chance, network, was, ERROR_MM)
    if not network.edges[told.edge].is_listed:
        told = was
    ahead = was.ahead if told.edge == was.edge else told.ahead
    grows = network.edges[told.edge].grows * ahead
    figure_mm = network.edges[told.edge].figure_mm(told.at_mm)
    direction = (Direction.DOWN if grows > 0 else Direction.UP) if runs else Direction.UNKNOWN
    fix = TrainFix(figure_mm, age_ms, direction, is_running=runs)
    shown_mm = network.edges[was.edge].figure_mm(was.at_mm)
    way_mm = chance.randrange(KM)
    shown = Display(shown_mm - way_mm, shown_mm + way_mm, age_ms)
    if told.edge != was.edge:
        shown = replace(shown, other_from_mm=figure_mm - way_mm, other_to_mm=figure_mm + way_mm)
    return Known(fix, shown, jumped=False, newest=NO_TRAIN_FIX)


def scene(seed: int, listed: float) -> Scene:
    """Draw a network, a worker and a train.

    The train was told some seconds ago, where it was then; it has run since, by the line's speed, to where it is now.
    """
    chance = Random(seed)
    network = Network(chance, listed)
    worker = network.spot(chance, is_line=chance.random() < 0.7)
    if not network.edges[worker.edge].is_listed:
        worker = network.spot(chance, is_line=True)
    was, runs = network.spot(chance), chance.random() < 0.7
    age_ms = chance.choice((0, chance.randrange(10_001), 10_000))
    ran_mm = chance.randrange(SPEED_MM_S * age_ms // 1_000 + 1)
    is_turned = not runs and chance.random() < 0.5
    now = network.gone_on(chance, was._replace(ahead=-was.ahead) if is_turned else was, ran_mm)
    told_worker = off(chance, network, worker, WORKER_ERROR_MM)
    if not network.edges[told_worker.edge].is_listed:
        told_worker = worker
    trains = {}
    if network.edges[was.edge].is_listed:
        trains = {Train("1"): known(chance, network, was, age_ms, runs)}
    elif chance.random() < 0.5:
        trains = {Train("1"): known(chance, network, network.spot(chance, is_line=True), age_ms, runs)}
    figure_mm = network.edges[told_worker.edge].figure_mm(told_worker.at_mm)
    handset = Handset(WorkerFix(figure_mm, 0), 0, servers_well=True, battery_well=True, listing=READ, trains=trains)
    register = replace(REGISTER, ways=ways(network), openings=openings(network))
    gap_mm = network.apart_mm(worker, now) - chance.randrange(LENGTH_MM + 1)
    return Scene(network, register, handset, gap_mm, runs and has_departed(network, worker, now, gap_mm))


def has_departed(network: Network, worker: Spot, train: Spot, gap_mm: int) -> bool:
    """Tell whether a train on the worker's own line is past him by 100 m, and runs away from him."""
    here, there = network.edges[worker.edge], network.edges[train.edge]
    if gap_mm < 100_000 or not (worker.edge == train.edge or (here.is_line and there.is_line)):
        return False
    ahead = (there.figure_mm(train.at_mm) - here.figure_mm(worker.at_mm)) * there.grows * train.ahead
    return ahead > 0 and abs(there.figure_mm(train.at_mm) - here.figure_mm(worker.at_mm)) <= gap_mm + LENGTH_MM


def scenes(seeds: range, listed: float = 0.7) -> Iterator[Scene]:
    """Draw worlds."""
    return (scene(seed, listed) for seed in seeds)


def is_broken(told: Scene, register: Register) -> bool:
    """Tell whether the tone is milder than where the train is."""
    heard = machine.tone(register, told.handset)
    return heard in LIMITS_MM and told.apart_mm <= LIMITS_MM[heard] and not told.has_departed


def breaches(seeds: range) -> int:
    """Count worlds in which a tone is milder than where the train is; each other tone must have been heard."""
    drawn = list(scenes(seeds))
    assert {Tone.ALARM, Tone.CAUTION, Tone.NORMAL} <= {machine.tone(each.register, each.handset) for each in drawn}
    return sum(is_broken(each, each.register) for each in drawn)


def test_no_tone_is_mild_with_a_train_near_by_any_way() -> None:
    assert breaches(range(300)) == 0


def test_a_surveyors_register_is_lawful_and_one_with_less_is_not() -> None:
    """A connection that is missing or too long is found, unless others are as short (A1)."""
    found = 0
    for each in (each for each in scenes(range(90)) if each.network.are_apart):
        places = joins(each.network)
        assert has_least_ways(each.register, places)
        for way, connection in each.register.ways.items():
            longer = replace(connection, between_mm=connection.between_mm + 1_000_000)
            if connection.between_mm == 0:
                found += not has_least_ways(replace(each.register, ways=each.register.ways | {way: longer}), places)
    assert found > 20


@pytest.mark.parametrize("without", ["ways", "openings"])
def test_without_ways_or_openings_on_the_register_it_is(without: str) -> None:
    """Else the test above would show nothing."""
    broken = 0
    for each in scenes(range(400)):
        less = {"ways": replace(each.register, ways={}), "openings": replace(each.register, openings={})}
        broken += is_broken(each, less[without])
    assert broken > 10


def test_a_worker_near_a_joint_hears_how_far_trains_are() -> None:
    """Where lines' figures are apart: with openings in the place of the joints he hears the fault tone alone (A3)."""
    normal = before = 0
    for each in (each for each in scenes(range(400), listed=1.0) if each.network.are_apart):
        places_mm = {connection.to_mm for _way, connection in each.register.ways.items()}
        at_joints = {Opening(f"{place_mm}"): place_mm for place_mm in places_mm}
        without = replace(each.register, ways={}, openings=at_joints)
        if machine.tone(without, each.handset) == Tone.FAULT and each.apart_mm > 4 * KM:
            before += 1
            normal += machine.tone(each.register, each.handset) == Tone.NORMAL
    assert before > 40
    assert normal > 0.9 * before


@pytest.mark.slow
def test_no_tone_is_mild_in_many_networks() -> None:
    assert breaches(range(1_000, 21_000)) == 0
