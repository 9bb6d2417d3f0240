"""Walks over drawn networks come to no place by less than their register's ways (A1)."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import replace
from random import Random

import pytest

from kernel.alarm import tone as machine
from kernel.alarm.distance import UM_A_MM, Direction, TrainFix, WorkerFix
from kernel.alarm.extents import End, Extent, Line
from kernel.alarm.least_ways import Equation, Join, has_least_ways
from kernel.alarm.limits import is_lawful
from kernel.alarm.network import Connection
from kernel.alarm.tone import Display, Handset, Known, Tone, Train
from models.alarm.alarm_network import Tracks, Walk
from models.alarm.along import far_um
from models.alarm.connections import connections
from models.alarm.line import REGISTER
from proofs.alarm.alarm_network import THEORY
from proofs.alarm.witnesses.alarm_network import WITNESSES
from tests.alarm.networks import KM, Network, joins, lines, nearest_lines_mm, openings, ways
from tests.alarm.test_openings import READ


@pytest.mark.parametrize("witness", WITNESSES)
def test_witness(witness: Callable[[], None]) -> None:
    assert witness.__doc__
    witness()


PLAIN = replace(REGISTER, sections={})
APART_MM = 2 * PLAIN.tolerance_mm


def apart(seeds: range, listed: float) -> Iterator[tuple[Random, Network]]:
    """Draw networks of which no two lines have one figure."""
    for seed in seeds:
        chance = Random(seed)
        network = Network(chance, listed)
        if nearest_lines_mm(network) > APART_MM:
            yield chance, network


def walked(chance: Random, network: Network) -> tuple[Tracks, list[Walk]]:
    """Load the register of a network, and walk from join to join, and where track goes on beyond a line's end."""
    register = replace(PLAIN, openings=openings(network))
    site = Tracks(register, joins(network), lines(network))
    none = Walk({}, False, False, 0, 0, 0, False)
    assert not network.are_apart or THEORY.steps["load"](site, none, ways(network)).is_accepted
    walk = THEORY.steps["load"](site, none, connections(register, site.joins))
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
            seen += [THEORY.steps["leave"](site, walk, line=line) for line in site.lines]
            walk = THEORY.steps["cross"](site, walk, join=join, is_turned=is_turned)
        seen.append(walk)
    return site, seen


def test_connections_that_are_worked_out_are_the_least_and_none_too_many() -> None:
    """As short as those of networkx wherever lines' figures are apart, and none can be left out (A1)."""
    for seed in range(60):
        network = Network(Random(seed), 1.0)
        places, by_networkx = joins(network), ways(network)
        register = replace(REGISTER, ways=connections(REGISTER, places))
        assert has_least_ways(register, places)
        for way in register.ways:
            fewer = {other: each for other, each in register.ways.items() if other != way}
            assert not has_least_ways(replace(register, ways=fewer), places)
        for each in by_networkx.values() if network.are_apart else ():
            over_mm = [way_mm(one, each) for _way, one in register.ways.items()]
            least_mm = min(*over_mm, abs(each.from_mm - each.to_mm))
            assert least_mm <= each.between_mm or UM_A_MM * each.between_mm > far_um(REGISTER)


def way_mm(connection: Connection, other: Connection) -> int:
    """Give how far it is over a connection from where another begins to where that one ends."""
    at_its_ends_mm = abs(connection.from_mm - other.from_mm) + abs(connection.to_mm - other.to_mm)
    return connection.between_mm + at_its_ends_mm


def test_no_walk_is_shorter_than_the_registers_ways_nor_leaves_it_unseen() -> None:
    steps = left = 0
    for chance, network in apart(range(200), 0.9):
        site, seen = walked(chance, network)
        assert all(claim(site, walk) for walk in seen for claim in THEORY.invariants.values())
        steps += sum(walk.is_under_way and 0 < walk.walked_um <= far_um(site.register) for walk in seen)
        left += sum(walk.has_left for walk in seen)
    assert steps > 50
    assert left > 50


def test_a_surveyors_register_is_lawful_where_lines_are_apart_and_only_there() -> None:
    """Whoever writes all places with two figures, all openings and all ends is refused for figures alone (A1)."""
    verdicts = []
    for seed in range(200):
        network = Network(Random(seed), 0.7)
        register = replace(PLAIN, openings=openings(network), ways=connections(PLAIN, joins(network)))
        verdict = is_lawful(register, joins(network), lines(network))
        assert verdict == (nearest_lines_mm(network) > APART_MM)
        verdicts.append(verdict)
    assert 50 < sum(verdicts) < 190


def test_a_slip_of_the_surveyor_is_noticed() -> None:
    """An equation or an opening left out where a line ends, a line left out or moved, another end (A1)."""
    noticed = 0
    for chance, network in apart(range(200), 0.7):
        places, extents = joins(network), lines(network)
        register = replace(PLAIN, openings=openings(network), ways=connections(PLAIN, places))
        opened = {place_mm for _opening, place_mm in register.openings.items()}
        ends_mm = {each.from_mm: each.from_end for each in extents.values()}
        ends_mm |= {each.to_mm: each.to_end for each in extents.values()}
        for join, place in places.items():
            fewer = {other: each for other, each in places.items() if other != join}
            kept = {mm for each in fewer.values() for mm in (each.one_mm, each.other_mm)}
            less = replace(register, ways=connections(PLAIN, fewer))
            is_missed = {place.one_mm, place.other_mm} & set(ends_mm) <= kept
            assert is_lawful(less, fewer, extents) == is_missed
            noticed += not is_missed
        for opening, place_mm in register.openings.items():
            rest = {other: mm for other, mm in register.openings.items() if other != opening}
            is_noticed = ends_mm.get(place_mm) == End.OPENING
            assert is_lawful(replace(register, openings=rest), places, extents) != is_noticed
            noticed += is_noticed
        for line, extent in extents.items():
            off_mm = chance.choice((-1, 1)) * chance.randrange(1, 1_000_000)
            moved = replace(extent, from_mm=extent.from_mm + off_mm, to_mm=extent.to_mm + off_mm)
            without = {other: each for other, each in extents.items() if other != line}
            if {extent.from_end, extent.to_end} != {End.BUFFER_STOP}:
                assert not is_lawful(register, places, extents | {line: moved})
                assert not is_lawful(register, places, without)
            for end in set(End) - {extent.from_end}:
                is_both = (extent.from_end, end) == (End.JOIN, End.OPENING) and extent.from_mm in opened
                assert is_lawful(register, places, extents | {line: replace(extent, from_end=end)}) == is_both
    assert noticed > 50


def test_what_is_refused_would_be_heard_as_normal_with_a_train_near() -> None:
    """Two lines begin with 0 where they join; a train runs up to there on the one, and on to the worker (A1, A3)."""
    for begins_mm, expected in ((0, Tone.NORMAL), (200 * KM, Tone.ALARM)):
        begins = End.JOIN if begins_mm else End.BUFFER_STOP
        extents = {
            Line("main"): Extent(0, 40 * KM, begins, End.BUFFER_STOP),
            Line("other"): Extent(begins_mm, begins_mm + 10 * KM, begins, End.BUFFER_STOP),
        }
        places = {Join("junction"): Equation(0, begins_mm)} if begins_mm else {}
        register = replace(PLAIN, ways=connections(PLAIN, places))
        fix = TrainFix(begins_mm + 500_000, 0, Direction.UP, is_running=True)
        train = Known(fix, Display(begins_mm, begins_mm + KM, 0), jumped=False, newest=fix)
        handset = Handset(WorkerFix(1_000_000, 0), 0, True, True, READ, {Train("1D"): train})
        assert machine.tone(register, handset) == expected
        assert is_lawful(register, places, extents) == (expected == Tone.ALARM)
