"""Where the authority ends, for drawn orders, lists and ranges, and the joint in drawn worlds (T4, T9, T12)."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import replace
from random import Random

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from kernel.authority import may_leave
from kernel.maps import Map
from kernel.names import Block, Run
from kernel.onboard import authority_end as machine
from kernel.onboard.braking import Brake
from kernel.onboard.odometry import Loss
from kernel.unit import Order
from proofs.onboard.witnesses.joint import WITNESSES
from proofs.onboard.witnesses.station import (
    A_PAIR,
    BEGINS_MM,
    BOUNDS,
    ENDS_MM,
    ONWARD,
    ONWARD_MM,
    PERMITTED,
    RUN,
    Station,
    located,
    motion_of,
    permitted,
    surveyed,
    two_runs,
    under_way,
)
from proofs.witnesses.stations import EAST, ONE, OUTLET, T1, THROAT, WEST

SITE = surveyed().site
BLOCKS = tuple(ENDS_MM)
HUGE = 2**62
ORDERS = st.builds(
    replace,
    st.just(PERMITTED),
    permitted=st.sampled_from((True, True, True, False)),
    recalled=st.sampled_from((False, False, False, True)),
    given_back=st.sampled_from((False, False, False, True)),
    begun=st.booleans(),
    stopped=st.booleans(),
    left=st.sets(st.sampled_from(BLOCKS), max_size=2).map(lambda blocks: dict.fromkeys(blocks, A_PAIR)),
)
PLACES = st.integers(0, 900_000) | st.sampled_from((*ENDS_MM.values(), -HUGE, HUGE, 0, -1))
LISTS = st.permutations(BLOCKS).map(lambda blocks: {block: ENDS_MM[block] for block in blocks}) | st.dictionaries(
    st.sampled_from(BLOCKS), PLACES
)
TRACK = ((WEST, 440_000), (THROAT, 550_000), (ONE, 750_000), (OUTLET, 860_000), (EAST, 1_000_000))
"""The blocks of the track ahead of the train in the west, and where each ends."""


def kept(orders: Mapping[Run, Order]) -> Map[Run, Order]:
    """Orders, each with the centre's list of its route."""
    return {run: Station().listed_by_the_centre(run, order) for run, order in orders.items()}


def ends(order: Order, ends_mm: Mapping[Block, int], least_mm: int, most_mm: int, begins_mm: int = 0) -> frozenset[int]:
    unit = replace(Station().unit(), orders=kept({RUN: order}))
    return machine.ends_mm(SITE.lists, unit, {RUN: begins_mm}, {RUN: dict(ends_mm)}, least_mm, most_mm)


def leavable(station: Station) -> set[Block]:
    """Give the blocks that the orders which the unit has now let the head leave."""
    unit = station.unit()
    return {block for run in unit.orders for block, _ in TRACK if may_leave(SITE.lists, unit, run, block)}


@pytest.mark.parametrize("witness", WITNESSES)
def test_witness(witness: Callable[[], None]) -> None:
    assert witness.__doc__
    witness()


@settings(deadline=None)
@given(ORDERS, LISTS, PLACES, PLACES, PLACES)
def test_there_is_one_end_and_it_is_the_nearest_that_may_not_be_passed(
    order: Order, ends_mm: dict[Block, int], least_mm: int, most_mm: int, begins_mm: int
) -> None:
    unit = replace(Station().unit(), orders=kept({RUN: order}))
    closed = [
        end_mm
        for block, end_mm in ends_mm.items()
        if end_mm >= least_mm and not may_leave(SITE.lists, unit, RUN, block)
    ]
    known = begins_mm <= least_mm and closed and min(most_mm, *closed) <= max(ends_mm.values())
    assert ends(order, ends_mm, least_mm, most_mm, begins_mm) == (frozenset({min(closed)}) if known else frozenset())


@settings(deadline=None)
@given(ORDERS, ORDERS, st.integers(BEGINS_MM, 1_000_000), st.integers(0, 20_000))
def test_two_runs_end_where_one_of_them_does_and_never_beyond_a_block_of_neither(
    order: Order, onward: Order, least_mm: int, range_mm: int
) -> None:
    """Walked along the track block by block: the first that neither run lets the head leave, if it is listed."""
    unit = replace(Station().unit(), orders=kept({RUN: order, ONWARD: onward}))
    listed: dict[Run, Map[Block, int]] = {RUN: ENDS_MM, ONWARD: ONWARD_MM}
    walked = next(
        end_mm
        for block, end_mm in TRACK
        if end_mm >= least_mm
        and not any(block in listed[run] and may_leave(SITE.lists, unit, run, block) for run in listed)
    )
    found = machine.ends_mm(SITE.lists, unit, {RUN: BEGINS_MM, ONWARD: 550_000}, listed, least_mm, least_mm + range_mm)
    straddles = least_mm < 550_000 and min(least_mm + range_mm, walked) > 750_000
    assert found == (frozenset() if straddles else {walked})


@settings(deadline=None)
@given(ORDERS, LISTS, st.tuples(PLACES, PLACES, st.integers(0, 100_000)), st.booleans(), st.booleans(), st.booleans())
def test_whatever_the_unit_knows_there_is_one_brake(
    order: Order, ends_mm: dict[Block, int], place: tuple[int, int, int], known: bool, applied: bool, no_list: bool
) -> None:
    """Never none and never two: the joint proves only what each of them does."""
    unit = replace(Station().unit(), orders=kept({RUN: order}))
    listed: dict[Run, Map[Block, int]] = {} if no_list else {RUN: ends_mm}
    brake = Brake(applied=applied, end_mm=ENDS_MM[ONE])
    motion = motion_of(*place, loss=Loss.NONE if known else Loss.CYCLE_IRREGULAR)
    assert len(machine.obey(SITE.lists, unit, {RUN: BEGINS_MM}, listed, BOUNDS, brake, motion)) == 1


@settings(deadline=None)
@given(ORDERS, st.integers(0, ENDS_MM[ONE]))
def test_the_end_is_never_in_the_overlap(order: Order, front_mm: int) -> None:
    """From anywhere on the route: that the overlap is kept free gives no authority (T9)."""
    assert max(ends(order, ENDS_MM, front_mm, front_mm)) <= ENDS_MM[ONE]


@settings(deadline=None)
@given(ORDERS, st.integers(0, ENDS_MM[ONE]))
def test_less_permission_is_never_farther(order: Order, front_mm: int) -> None:
    assert ends(order, ENDS_MM, front_mm, front_mm) <= frozenset(ENDS_MM.values())
    least = max(ends(replace(PERMITTED, permitted=False), ENDS_MM, front_mm, front_mm))
    most = max(ends(PERMITTED, ENDS_MM, front_mm, front_mm))
    assert least <= max(ends(order, ENDS_MM, front_mm, front_mm)) <= most


def test_without_a_list_there_is_no_end() -> None:
    """Zero blocks, all of them behind, a list that begins ahead of the train, or one for an order unknown."""
    assert not ends(PERMITTED, {}, 0, 0)
    assert not ends(PERMITTED, ENDS_MM, ENDS_MM[ONE] + 1, ENDS_MM[ONE] + 1)
    assert not ends(PERMITTED, ENDS_MM, -1, 1)
    assert not ends(PERMITTED, ENDS_MM, HUGE, HUGE)
    assert ends(PERMITTED, ENDS_MM, -HUGE, HUGE, -HUGE) == {ENDS_MM[ONE]}
    unit = replace(Station().unit(), orders={})
    assert machine.ends_mm(SITE.lists, unit, {RUN: 0}, {RUN: ENDS_MM}, 0, 0) == {ENDS_MM[WEST]}
    assert not machine.ends_mm(SITE.lists, unit, {}, {RUN: ENDS_MM}, 0, 0)
    assert not machine.ends_mm(SITE.lists, unit, {RUN: 0}, {}, 0, 0)


def test_a_block_that_lies_ahead_twice_may_be_left_where_the_order_says() -> None:
    """On a loop: a lap later the same block is not the order's (T4)."""
    unit = replace(Station().unit(), orders=kept({RUN: PERMITTED}))
    first, later = {**ENDS_MM, ONE: 1_300_000}, {WEST: 1_440_000, THROAT: 1_550_000}
    listed: dict[Run, Map[Block, int]] = {RUN: first, ONWARD: later}
    assert machine.ends_mm(SITE.lists, unit, {RUN: 0, ONWARD: 750_000}, listed, 1_400_000, 1_401_000) == {1_440_000}


@settings(max_examples=60, deadline=None)
@given(st.integers(0, 2**32), st.lists(ORDERS, min_size=3, max_size=3))
def test_invariants_hold_in_drawn_worlds(seed: int, orders: list[Order]) -> None:
    """Orders come and go, ends are taken or not, the head runs, the tail leaves: a train obeys its authority.

    Besides what is claimed after every step: no head leaves a block that no order let it leave when an end was taken.
    """
    chance = Random(seed)
    station = chance.choice((permitted, under_way, two_runs))()
    let_leave = leavable(station)
    if ONWARD not in station.system.block_ends_mm:
        station.listed(ONWARD, 550_000, ONWARD_MM)
    for _ in range(40):
        head_mm, brake = station.system.head_mm[T1], station.system.brake[T1]
        what = chance.choice(("told", "asks", "asks", "runs", "runs", "passes", "locate"))
        if what == "told":
            runs: dict[Run, Order] = {run: chance.choice(orders) for run in (RUN, ONWARD) if chance.random() < 0.8}
            station.told(runs)
        elif what == "asks":
            station.asks(chance.choice((0, 100, 15_000)), chance.choice((0, 1_000, 50_000)))
            let_leave |= leavable(station)
        elif what == "runs":
            to_mm = chance.choice((brake.end_mm, brake.end_mm + 1, (head_mm + brake.end_mm) // 2, head_mm - 1))
            station.step("head_runs", train=T1, to_mm=min(to_mm, station.system.block_end_mm[T1]))
        elif what == "passes":
            place = next(at for at, (block, _) in enumerate(TRACK) if block == station.system.block[T1])
            if place + 1 < len(TRACK):
                block, end_mm = TRACK[place + 1]
                to_mm = min(end_mm, max(brake.end_mm, TRACK[place][1] + 1))
                station.step("head_passes", train=T1, to_mm=to_mm, block=block, block_end_mm=end_mm)
                assert station.system.block[T1] == TRACK[place][0] or TRACK[place][0] in let_leave
        elif chance.random() < 0.1:
            block, end_mm = station.system.block[T1], station.system.block_end_mm[T1]
            event = {"train": T1, "head_mm": head_mm, "block": block, "block_end_mm": end_mm}
            station.step("locate", **event, front_most_mm=head_mm + 1_000)


def test_a_broken_machine_is_caught(monkeypatch: pytest.MonkeyPatch) -> None:
    """The drawn worlds do find an end that lies beyond blocks that may not be left."""

    def farthest(*told: object) -> frozenset[int]:
        return frozenset({ENDS_MM[ONE]})

    def drawn() -> None:
        station = located()
        station.listed(RUN, BEGINS_MM, ENDS_MM)
        station.told({RUN: replace(PERMITTED, permitted=False)})
        around = {"front_least_mm": 399_000, "front_most_mm": 401_000}
        station.step("ask_for_the_end", train=T1, **around, brake=Brake(applied=False, end_mm=ENDS_MM[ONE]))

    drawn()
    monkeypatch.setattr(machine, "ends_mm", farthest)
    with pytest.raises(AssertionError):
        drawn()
