"""Trains that run to the end of their orders in millimetres, and lose the orders on the way (T4, T9, T12)."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import replace
from functools import cache

from kernel.layout import Layout
from kernel.names import Block, Read, Record, Route, Run, Serial, Tag, Train, UnitLife
from kernel.onboard import authority_end as machine
from kernel.unit import Evidence, Order, Unit
from models.onboard.joint import Joint, Survey
from models.world.state import Site
from proofs.onboard.joint import THEORY
from proofs.onboard.witnesses.play import Play
from proofs.witnesses.stations import (
    A1,
    A2,
    B1,
    EAST,
    EAST_TO_ONE,
    ONE,
    OUTLET,
    PASSING_PLACE,
    T1,
    T2,
    THROAT,
    WEST,
    WEST_TO_ONE,
    site_of,
    standing_at,
)

ENDS_MM = {WEST: 440_000, THROAT: 550_000, ONE: 750_000, OUTLET: 860_000}
"""Where the blocks of the route from the west to track one end, and those of its overlap."""
RUN = Run(Serial(1), T1, UnitLife(0), WEST_TO_ONE)
OTHER = Run(Serial(2), T2, UnitLife(0), EAST_TO_ONE)
PERMITTED = Order(
    permitted=True, given_back=False, loop_closed=True, begun=False, stopped=False, expected=None, left={}
)
A_PAIR = Evidence(Read(Tag("B1@throat"), Record("1")), Read(Tag("B1@one"), Record("2")))


def along(layout: Layout, route: Route) -> list[Block]:
    """The blocks of a route in their order."""
    way = layout.way[route]
    blocks = [layout.start[route]]
    while blocks[-1] in way:
        blocks.append(way[blocks[-1]])
    return blocks


@cache
def surveyed() -> Survey:
    """The passing place, each block of each route 100 m long, but on the route from the west to track one."""
    site: Site = site_of(PASSING_PLACE)
    routes: Iterable[Route] = site.layout.way
    ends = {
        route: {block: 100_000 * (place + 1) for place, block in enumerate(along(site.layout, route))}
        for route in routes
    }
    return Survey(site=site, block_ends_mm={**ends, WEST_TO_ONE: ENDS_MM})


class Station(Play[Survey, Joint]):
    """The passing place with a train in the west and one in the east, nothing told to them yet."""

    def __init__(self) -> None:
        """Begin."""
        site = surveyed()
        at = {A1: frozenset({WEST}), A2: frozenset({WEST}), B1: frozenset({EAST})}
        start = Joint(system=standing_at(site.site, at, {}), head_mm={}, end_mm={}, leavable=frozenset())
        super().__init__(THEORY, site, start)

    def unit(self) -> Unit:
        """The unit of the train in the west."""
        return self.system.system.units[T1]

    def told(self, order: Order | None) -> None:
        """The unit has this order for its run, or none."""
        unit = replace(self.unit(), orders={} if order is None else {RUN: order})
        self.step("unit_changes", train=T1, unit=unit)
        assert self.unit() == unit

    def ends(self, front_least_mm: int) -> frozenset[int]:
        """Where the authority ends, by the orders that the unit has now."""
        return machine.ends_mm(self.site.site.layout, self.unit(), RUN, ENDS_MM, front_least_mm)

    def takes(self, front_least_mm: int, end_mm: int) -> None:
        """The brake control takes the end that the orders give."""
        assert self.ends(front_least_mm) == {end_mm}
        self.step("take_end", run=RUN, front_least_mm=front_least_mm, end_mm=end_mm)
        assert self.system.end_mm[RUN] == end_mm

    def refuses(self, step: str, **event: object) -> None:
        """Nothing comes of it."""
        before = self.system
        assert self.step(step, **event) == before

    def runs(self, to_mm: int) -> None:
        """The head runs on to a place."""
        self.step("head_runs", run=RUN, to_mm=to_mm)
        assert self.system.head_mm[RUN] == to_mm

    def rolls(self) -> None:
        """It can no longer stop in the block it is in."""
        self.step("train_rolls", rolling=frozenset({RUN}))
        assert self.system.system.track.rolling == {RUN}


def begun(head_mm: int = 400_000) -> Station:
    """The station, and the head of the train in the west 40 m before the end of its block."""
    station = Station()
    station.step("begin", run=RUN, head_mm=head_mm)
    assert station.system.head_mm[RUN] == station.system.end_mm[RUN] == head_mm
    return station


def under_way(head_mm: int = 400_000) -> Station:
    """That train, permitted, with the end of its authority taken, rolling."""
    station = begun()
    station.told(PERMITTED)
    station.takes(399_000, 750_000)
    station.rolls()
    station.runs(head_mm)
    return station


def a_run_begins_once() -> None:
    """Each train's head is counted along its own run; a run that has begun does not begin anew (T4)."""
    station = begun()
    station.refuses("begin", run=RUN, head_mm=0)
    station.step("begin", run=OTHER, head_mm=1_000)
    assert station.system.head_mm == station.system.end_mm == {RUN: 400_000, OTHER: 1_000}


def without_orders_the_authority_ends_with_the_block() -> None:
    """A train that has been told nothing stays in the block that it stands in (T4)."""
    station = begun()
    assert not station.ends(860_001)
    for end_mm in (399_000, 439_999, 550_000, 750_000, 860_000):
        station.refuses("take_end", run=RUN, front_least_mm=399_000, end_mm=end_mm)
    station.takes(399_000, 440_000)
    assert station.system.leavable == frozenset()
    station.rolls()
    station.runs(440_000)
    station.refuses("head_runs", run=RUN, to_mm=440_001)


def every_part_of_the_permission_is_needed() -> None:
    """Not permitted, given back, second loop open: the authority ends with the block (T4, T5, T9)."""
    for order in (
        replace(PERMITTED, permitted=False),
        replace(PERMITTED, given_back=True),
        replace(PERMITTED, loop_closed=False),
    ):
        station = begun()
        station.told(order)
        station.takes(399_000, 440_000)


def under_orders_the_authority_ends_with_the_destination() -> None:
    """Through the throat into track one, and never into the overlap behind it (T4, T9, T12)."""
    station = begun()
    station.told(PERMITTED)
    for end_mm in (440_000, 550_000, 860_000):
        station.refuses("take_end", run=RUN, front_least_mm=399_000, end_mm=end_mm)
    station.takes(399_000, 750_000)
    assert station.system.leavable == {(RUN, WEST), (RUN, THROAT)}
    station.rolls()
    station.runs(440_000)
    station.runs(700_000)
    station.takes(699_000, 750_000)
    station.runs(750_000)
    station.refuses("head_runs", run=RUN, to_mm=750_001)
    assert station.ends(750_000) == {750_000}
    assert station.ends(750_001) == {860_000}


def a_train_that_told_it_stopped_may_draw_up_to_the_end() -> None:
    """Only the overlap is gone: by its range the front may still be in the throat, and ends where it did (T9)."""
    station = begun()
    station.told(replace(PERMITTED, stopped=True))
    station.takes(399_000, 750_000)


def authority_lost_while_rolling_is_not_taken_back_from_below_the_wheels() -> None:
    """The run is cancelled, or the unit restarts: the train that cannot stop any more runs on to the old end (T9)."""
    station = under_way()
    station.told(None)
    assert station.ends(399_000) == {440_000}
    station.runs(450_000)
    station.refuses("take_end", run=RUN, front_least_mm=430_000, end_mm=440_000)
    station.runs(500_000)
    station.takes(499_000, 550_000)
    assert station.system.leavable == {(RUN, WEST), (RUN, THROAT)}
    station.runs(550_000)
    station.refuses("head_runs", run=RUN, to_mm=550_001)
    station.told(PERMITTED)
    station.takes(549_000, 750_000)
    station.runs(600_000)


def another_trains_end_is_its_own() -> None:
    """An end is taken, and a head runs, for one run; the other keeps its own (T4)."""
    station = under_way()
    station.step("begin", run=OTHER, head_mm=10_000)
    station.step("take_end", run=OTHER, front_least_mm=9_000, end_mm=100_000)
    assert station.system.end_mm == {RUN: 750_000, OTHER: 100_000}
    assert station.system.leavable == {(RUN, WEST), (RUN, THROAT)}
    station.step("head_runs", run=OTHER, to_mm=90_000)
    assert station.system.head_mm == {RUN: 400_000, OTHER: 90_000}
    gone = replace(station.unit(), life=UnitLife(9))
    station.step("unit_changes", train=T2, unit=gone)
    assert station.system.system.units == {T1: station.unit(), T2: gone}


def what_ends_behind_the_train_does_not_count() -> None:
    """Of the blocks that the head may not leave, those whose end is no less than the least front (P7, T12)."""
    station = under_way(500_000)
    station.told(None)
    assert station.ends(440_000) == {440_000}
    assert station.ends(440_001) == {550_000}
    assert station.ends(550_001) == {750_000}
    assert station.ends(860_000) == {860_000}
    assert not station.ends(860_001)


def the_tail_leaves_what_the_head_has_passed() -> None:
    """A genuine pair: the block is behind, and the authority still ends in track one (T2)."""
    station = under_way(600_000)
    for block in (THROAT, WEST):
        station.step("tail_leaves", run=RUN, block=block)
    assert station.system.system.track.behind == {(RUN, WEST), (RUN, THROAT)}
    station.told(replace(PERMITTED, left={WEST: A_PAIR, THROAT: A_PAIR}))
    station.takes(590_000, 750_000)
    station.runs(750_000)
    for run, block in ((RUN, ONE), (RUN, OUTLET), (OTHER, WEST), (RUN, EAST)):
        station.refuses("tail_leaves", run=run, block=block)
    station = under_way(440_000)
    station.refuses("tail_leaves", run=RUN, block=WEST)
    station.runs(440_001)
    station.step("tail_leaves", run=RUN, block=WEST)
    assert station.system.system.track.behind == {(RUN, WEST)}


def a_false_pair_does_not_stop_the_train_on_the_spot() -> None:
    """The unit takes a block ahead for left: the authority ends before it, the train runs on to the end it had (T2)."""
    station = under_way(450_000)
    station.told(replace(PERMITTED, left={THROAT: A_PAIR}))
    assert station.ends(449_000) == {550_000}
    station.runs(560_000)
    assert not station.system.system.track.behind
    station.takes(551_000, 750_000)
    station = under_way(450_000)
    station.told(replace(PERMITTED, left={THROAT: A_PAIR}))
    station.takes(449_000, 550_000)
    station.refuses("head_runs", run=RUN, to_mm=560_000)


def the_end_of_a_train_or_route_unknown_is_not_worked_out() -> None:
    """No unit, no surveyed route, no run that has begun: nothing is taken (T1)."""
    station = begun()
    stranger = Run(Serial(3), Train("T9"), UnitLife(0), WEST_TO_ONE)
    nowhere = Run(Serial(4), T1, UnitLife(0), Route("nowhere"))
    for run in (stranger, nowhere):
        station.step("begin", run=run, head_mm=0)
        station.refuses("take_end", run=run, front_least_mm=0, end_mm=440_000)
        station.refuses("tail_leaves", run=run, block=EAST)
    station.refuses("take_end", run=OTHER, front_least_mm=0, end_mm=100_000)
    station.refuses("head_runs", run=OTHER, to_mm=0)


def what_the_other_proofs_exclude_does_not_happen() -> None:
    """A head that runs back, a front beyond the head, an end behind it (T5, P7, T12)."""
    station = under_way(450_000)
    station.refuses("head_runs", run=RUN, to_mm=449_999)
    station.refuses("take_end", run=RUN, front_least_mm=450_001, end_mm=750_000)
    station.told(None)
    station.refuses("take_end", run=RUN, front_least_mm=440_000, end_mm=440_000)


WITNESSES = (
    a_run_begins_once,
    without_orders_the_authority_ends_with_the_block,
    every_part_of_the_permission_is_needed,
    under_orders_the_authority_ends_with_the_destination,
    a_train_that_told_it_stopped_may_draw_up_to_the_end,
    authority_lost_while_rolling_is_not_taken_back_from_below_the_wheels,
    another_trains_end_is_its_own,
    what_ends_behind_the_train_does_not_count,
    the_tail_leaves_what_the_head_has_passed,
    a_false_pair_does_not_stop_the_train_on_the_spot,
    the_end_of_a_train_or_route_unknown_is_not_worked_out,
    what_the_other_proofs_exclude_does_not_happen,
)
