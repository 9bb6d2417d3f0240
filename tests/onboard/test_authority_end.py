"""Where the authority ends, for drawn orders, lists and ranges, and the joint in drawn worlds (T4, T9, T12)."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import replace
from random import Random

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from kernel.names import Block, Route, Run, Serial, UnitLife
from kernel.onboard import authority_end as machine
from kernel.unit import Order
from proofs.onboard.witnesses.joint import (
    A_PAIR,
    ENDS_MM,
    OTHER,
    PERMITTED,
    RUN,
    WITNESSES,
    Station,
    along,
    begun,
    surveyed,
    under_way,
)
from proofs.witnesses.stations import ONE, OUTLET, T1, THROAT, WEST, WEST_TO_ONE

LAYOUT = surveyed().site.layout
BLOCKS = tuple(along(LAYOUT, WEST_TO_ONE))
HUGE = 2**62
ORDERS = st.builds(
    replace,
    st.just(PERMITTED),
    permitted=st.sampled_from((True, True, True, False)),
    given_back=st.sampled_from((False, False, False, True)),
    loop_closed=st.sampled_from((True, True, True, False)),
    stopped=st.booleans(),
    left=st.sets(st.sampled_from(BLOCKS), max_size=2).map(lambda blocks: dict.fromkeys(blocks, A_PAIR)),
)
PLACES = st.integers(0, 900_000) | st.sampled_from((*ENDS_MM.values(), -HUGE, HUGE, 0, -1))
LISTS = st.permutations(BLOCKS).map(lambda blocks: {block: ENDS_MM[block] for block in blocks}) | st.dictionaries(
    st.sampled_from(BLOCKS), PLACES
)


def ends(order: Order, ends_mm: Mapping[Block, int], front_mm: int, run: Run = RUN) -> frozenset[int]:
    unit = replace(Station().unit(), orders={RUN: order})
    return machine.ends_mm(LAYOUT, unit, run, ends_mm, front_mm)


@pytest.mark.parametrize("witness", WITNESSES)
def test_witness(witness: Callable[[], None]) -> None:
    assert witness.__doc__
    witness()


@settings(deadline=None)
@given(ORDERS, LISTS, PLACES)
def test_there_is_one_end_and_it_is_the_nearest_that_may_not_be_passed(
    order: Order, ends_mm: dict[Block, int], front_mm: int
) -> None:
    unit = replace(Station().unit(), orders={RUN: order})
    ahead = [
        end_mm
        for block, end_mm in ends_mm.items()
        if end_mm >= front_mm and not machine.may_be_left(LAYOUT, unit, RUN, block)
    ]
    assert machine.ends_mm(LAYOUT, unit, RUN, ends_mm, front_mm) == frozenset(sorted(ahead)[:1])


@settings(deadline=None)
@given(ORDERS, st.integers(0, ENDS_MM[ONE]))
def test_the_end_is_never_in_the_overlap(order: Order, front_mm: int) -> None:
    """From anywhere on the route: that the overlap is kept free gives no authority (T9)."""
    assert max(ends(order, ENDS_MM, front_mm)) <= ENDS_MM[ONE]


@settings(deadline=None)
@given(ORDERS, st.integers(0, ENDS_MM[OUTLET]))
def test_less_permission_is_never_farther(order: Order, front_mm: int) -> None:
    assert ends(order, ENDS_MM, front_mm) <= frozenset(ENDS_MM.values())
    least = max(ends(replace(PERMITTED, permitted=False), ENDS_MM, front_mm))
    assert least <= max(ends(order, ENDS_MM, front_mm)) <= max(ends(PERMITTED, ENDS_MM, front_mm))


def test_without_a_list_there_is_no_end() -> None:
    """Zero blocks, all of them behind, or a route or run that nobody knows."""
    assert not ends(PERMITTED, {}, 0)
    assert not ends(PERMITTED, ENDS_MM, ENDS_MM[OUTLET] + 1)
    assert not ends(PERMITTED, ENDS_MM, HUGE)
    assert ends(PERMITTED, ENDS_MM, -HUGE) == {ENDS_MM[ONE]}
    for run in (Run(Serial(9), T1, UnitLife(0), Route("nowhere")), OTHER):
        assert ends(PERMITTED, ENDS_MM, 0, run) == {ENDS_MM[WEST]}


@settings(max_examples=60, deadline=None)
@given(st.integers(0, 2**32), st.lists(ORDERS, min_size=3, max_size=3))
def test_invariants_hold_in_drawn_worlds(seed: int, orders: list[Order]) -> None:
    """Orders come and go, ends are taken or not, heads run, tails leave: a train obeys its authority."""
    chance = Random(seed)
    station = chance.choice((begun, under_way))()
    station.step("begin", run=OTHER, head_mm=50_000)
    for _ in range(40):
        run = chance.choice((RUN, RUN, RUN, OTHER))
        head_mm = station.system.head_mm[run]
        front_mm = head_mm - chance.choice((0, 1_000, 50_000))
        what = chance.choice(("told", "take_end", "take_end", "head_runs", "head_runs", "rolls", "tail_leaves"))
        if what == "told":
            station.told(chance.choice((*orders, None)))
        elif what == "take_end":
            unit = station.system.system.units[run.train]
            told = machine.ends_mm(LAYOUT, unit, run, station.site.block_ends_mm[run.route], front_mm)
            end_mm = chance.choice((*told, 860_000, 750_000, head_mm))
            station.step("take_end", run=run, front_least_mm=front_mm, end_mm=end_mm)
        elif what == "head_runs":
            beyond = station.system.end_mm[run] + chance.choice((0, 0, 1))
            station.step("head_runs", run=run, to_mm=chance.choice((beyond, (head_mm + beyond) // 2, head_mm - 1)))
        elif what == "rolls":
            station.step("train_rolls", rolling=frozenset(chance.choice(((), (RUN,), (RUN, OTHER)))))
        else:
            station.step("tail_leaves", run=run, block=chance.choice((WEST, THROAT, ONE, OUTLET)))
    assert station.system.head_mm[RUN] <= ENDS_MM[ONE]


def test_a_broken_machine_is_caught(monkeypatch: pytest.MonkeyPatch) -> None:
    """The drawn worlds do find an end that lies beyond blocks that may not be left."""

    def farthest(*told: object) -> frozenset[int]:
        return frozenset(ENDS_MM.values())

    def drawn() -> None:
        station = begun()
        station.told(replace(PERMITTED, permitted=False))
        station.rolls()
        station.step("take_end", run=RUN, front_least_mm=0, end_mm=ENDS_MM[OUTLET])

    drawn()
    monkeypatch.setattr(machine, "ends_mm", farthest)
    with pytest.raises(AssertionError):
        drawn()
