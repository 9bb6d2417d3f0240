"""Walks over drawn networks come to no place by less than their register's ways (A1)."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from random import Random

import pytest

from kernel.alarm.distance import UM_A_MM
from kernel.alarm.limits import is_lawful
from kernel.alarm.network import Connection
from models.alarm.alarm_network import Tracks, Walk
from models.alarm.along import far_um
from models.alarm.connections import connections
from models.alarm.line import REGISTER
from proofs.alarm.alarm_network import THEORY
from proofs.alarm.witnesses.alarm_network import WITNESSES
from tests.alarm.networks import Network, joins, ways


@pytest.mark.parametrize("witness", WITNESSES)
def test_witness(witness: Callable[[], None]) -> None:
    assert witness.__doc__
    witness()


def walked(seed: int) -> tuple[Tracks, list[Walk]]:
    """Draw a network, load its register, and walk from join to join."""
    chance = Random(seed)
    network = Network(chance, 1.0)
    site = Tracks(REGISTER, joins(network))
    none = Walk({}, False, False, 0, 0, 0)
    walk = THEORY.steps["load"](site, none, connections(REGISTER, site.joins))
    assert walk.is_accepted
    if network.are_apart:
        walk = THEORY.steps["load"](site, none, ways(network))
        assert walk.is_accepted
    seen = [walk]
    for _ in range(20 if site.joins else 0):
        join, is_turned = chance.choice(sorted(site.joins)), chance.random() < 0.5
        place = site.joins[join]
        at_um = UM_A_MM * (place.other_mm if is_turned else place.one_mm)
        if not walk.is_under_way or chance.random() < 0.1:
            walk = THEORY.steps["begin"](site, walk, join=join, is_turned=is_turned)
        elif abs(at_um - walk.at_um) < far_um(site.register):
            walk = THEORY.steps["walk_on"](site, walk, to_um=at_um)
            walk = THEORY.steps["cross"](site, walk, join=join, is_turned=is_turned)
        seen.append(walk)
    return site, seen


def test_connections_that_are_worked_out_are_the_least_and_none_too_many() -> None:
    """As short as those of networkx wherever lines' figures are apart, and none can be left out (A1)."""
    for seed in range(60):
        network = Network(Random(seed), 1.0)
        places, by_networkx = joins(network), ways(network)
        register = replace(REGISTER, ways=connections(REGISTER, places))
        assert is_lawful(register, places)
        for way in register.ways:
            fewer = {other: each for other, each in register.ways.items() if other != way}
            assert not is_lawful(replace(register, ways=fewer), places)
        for each in by_networkx.values() if network.are_apart else ():
            over_mm = [way_mm(one, each) for _way, one in register.ways.items()]
            least_mm = min(*over_mm, abs(each.from_mm - each.to_mm))
            assert least_mm <= each.between_mm or UM_A_MM * each.between_mm > far_um(REGISTER)


def way_mm(connection: Connection, other: Connection) -> int:
    """Give how far it is over a connection from where another begins to where that one ends."""
    at_its_ends_mm = abs(connection.from_mm - other.from_mm) + abs(connection.to_mm - other.to_mm)
    return connection.between_mm + at_its_ends_mm


def test_no_walk_is_shorter_than_the_registers_ways() -> None:
    steps = 0
    for seed in range(100):
        site, seen = walked(seed)
        assert all(claim(site, walk) for walk in seen for claim in THEORY.invariants.values())
        steps += sum(walk.is_under_way and 0 < walk.walked_um <= far_um(site.register) for walk in seen)
    assert steps > 50
