"""A train in the west of the passing place, with its unit, its lists and its brake: what the joint's runs are of."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from functools import cache

from kernel import first_loop
from kernel.layout import Layout
from kernel.maps import Map
from kernel.names import Block, Car, Read, Record, Route, Run, Serial, Tag, UnitLife
from kernel.onboard import authority_end as machine
from kernel.onboard import odometry
from kernel.onboard.braking import Brake, BrakeBounds, supervise
from kernel.onboard.odometry import Loss, Motion
from kernel.unit import Evidence, Order, Unit
from models.onboard.joint import Joint, Survey
from models.simulator.senses import AT_REST
from proofs.onboard.joint import THEORY
from proofs.onboard.witnesses.play import Play
from proofs.witnesses.stations import (
    A1,
    A2,
    B1,
    EAST,
    ONE,
    ONE_TO_EAST,
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

BOUNDS = BrakeBounds(
    gains_mm_s2=1_200, slows_mm_s2=700, response_cycles=15, standstill_mm_s=25, cut_cycles=15, falls_mm_s2=1_200
)
BEGINS_MM = 340_000
"""Where the block in the west begins, in the train's kilometrage."""
ENDS_MM = {WEST: 440_000, THROAT: 550_000, ONE: 750_000}
"""Where the blocks of the route from the west to track one end, but for its overlap."""
ONWARD_MM = {ONE: 750_000, OUTLET: 860_000, EAST: 1_000_000}
"""Where the blocks of the route from track one to the east end, in the same kilometrage."""
RUN = Run(Serial(2), T1, UnitLife(0), WEST_TO_ONE)
ONWARD = Run(Serial(3), T1, UnitLife(0), ONE_TO_EAST)
OTHER = Run(Serial(4), T2, UnitLife(0), Route("east to one"))
PERMITTED = Order(
    tag_list=None,
    permitted=True,
    recalled=False,
    given_back=False,
    begun=False,
    stopped=False,
    expected=None,
    entered=frozenset(),
    led_by=None,
    left={},
)
RECALLED = replace(PERMITTED, recalled=True)
GIVEN_BACK = replace(RECALLED, given_back=True)
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
    """The passing place."""
    return Survey(site=site_of(PASSING_PLACE))


AT: Mapping[Car, frozenset[Block]] = {A1: frozenset({WEST}), A2: frozenset({WEST}), B1: frozenset({EAST})}
"""Where the cars stand."""


class Station(Play[Survey, Joint]):
    """The passing place with a train in the west and one in the east, nothing told to them yet; or another layout."""

    def __init__(self, site: Survey | None = None, at: Mapping[Car, frozenset[Block]] = AT) -> None:
        """Begin; on another layout, if one is given."""
        site = surveyed() if site is None else site
        start = Joint(
            system=standing_at(site.site, at, {}),
            head_mm={},
            block={},
            block_end_mm={},
            brake={},
            standing=frozenset(),
            begins_mm={},
            block_ends_mm={},
            asked=frozenset(),
            does_as_assumed={},
            brakes_at_a_stop={},
            is_told_without_an_end={},
        )
        super().__init__(THEORY, site, start)

    def unit(self) -> Unit:
        """The unit of the train in the west."""
        return self.system.system.units[T1]

    def changes(self, unit: Unit) -> None:
        """The unit becomes this."""
        self.step("unit_changes", train=T1, unit=unit)
        assert self.unit() == unit

    def told(self, orders: Mapping[Run, Order]) -> None:
        """The unit has these orders, each with the centre's list of its route."""
        self.changes(
            replace(self.unit(), orders={run: self.listed_by_the_centre(run, each) for run, each in orders.items()})
        )

    def listed_by_the_centre(self, run: Run, order: Order) -> Order:
        """An order as it is with the centre's list."""
        return replace(order, tag_list=self.site.site.layout.tag_list[run.route])

    def order(self, run: Run) -> Order:
        """What the unit knows of a run, but for its list."""
        return replace(self.unit().orders[run], tag_list=None)

    def loop_opens(self) -> None:
        """The unit's second loop opens."""
        self.changes(replace(self.unit(), loop_open=True))

    def listed(self, run: Run, begins_mm: int, ends_mm: Map[Block, int]) -> None:
        """A run's list comes."""
        self.step("take_list", run=run, begins_mm=begins_mm, block_ends_mm=ends_mm)
        assert self.system.begins_mm[run] == begins_mm
        assert self.system.block_ends_mm[run] == ends_mm

    def ends(self, front_least_mm: int, front_most_mm: int) -> frozenset[int]:
        """Where the authority ends, by the orders that the unit has now."""
        lists = (self.system.begins_mm, self.system.block_ends_mm)
        return machine.ends_mm(self.site.site.lists, self.unit(), *lists, front_least_mm, front_most_mm)

    def asks(self, speed_mm_s: int = 0, error_mm: int = 1_000, known: bool = True) -> Brake:
        """A cycle on board: the brake does what the kernel says."""
        head_mm = self.system.head_mm[T1]
        least_mm, most_mm = head_mm - error_mm, head_mm + error_mm
        motion = motion_of(least_mm, most_mm, speed_mm_s, Loss.NONE if known else Loss.CYCLE_IRREGULAR)
        asked = machine.obey(
            self.site.site.lists,
            self.unit(),
            self.system.begins_mm,
            self.system.block_ends_mm,
            BOUNDS,
            self.system.brake[T1],
            motion,
        )
        assert len(asked) == 1
        (brake,) = asked
        event = {"train": T1, "front_least_mm": least_mm, "front_most_mm": most_mm, "brake": brake}
        self.step("obey_the_orders", train=T1, bounds=BOUNDS, motion=motion)
        assert self.system.does_as_assumed[T1]
        assert self.system.brakes_at_a_stop[T1]
        assert self.system.is_told_without_an_end[T1]
        self.step("ask_for_the_end", **event)
        assert self.system.brake[T1] == brake
        return brake

    def holds(self, end_mm: int, withheld: bool = False) -> None:
        """A cycle on board, after which the brake holds this end."""
        brake = self.asks()
        assert (brake.end_mm, brake.withheld) == (end_mm, withheld)

    def refuses(self, step: str, **event: object) -> None:
        """Nothing comes of it."""
        before = self.system
        assert self.step(step, **event) == before

    def runs(self, to_mm: int) -> None:
        """The head runs on to a place in its block."""
        self.step("head_runs", train=T1, to_mm=to_mm)
        assert self.system.head_mm[T1] == to_mm

    def passes(self, to_mm: int, block: Block, end_mm: int) -> None:
        """The head runs on into another block."""
        self.step("head_passes", train=T1, to_mm=to_mm, block=block, block_end_mm=end_mm)
        assert (self.system.head_mm[T1], self.system.block[T1], self.system.block_end_mm[T1]) == (to_mm, block, end_mm)

    def rolling(self) -> frozenset[Run]:
        """The runs that the train rolls under."""
        return self.system.system.track.rolling

    def gives_back(self, run: Run = RUN) -> bool:
        """The unit gives the run back if it may, by what the brake holds; say whether it then says so."""
        ends_mm, start = self.system.block_ends_mm[run], self.site.site.layout.start[run.route]
        held_mm = self.system.brake[T1].end_mm
        self.changes(first_loop.give_back(self.site.site.lists, self.unit(), run, AT_REST, held_mm, ends_mm[start]))
        return first_loop.acknowledges_back(self.unit(), run)


def motion_of(front_least_mm: int, front_most_mm: int, speed_most_mm_s: int = 0, loss: Loss = Loss.NONE) -> Motion:
    """What the odometry says, or said before it lost its range."""
    at_rest = odometry.located(front_least_mm, front_most_mm, 0)
    return replace(at_rest, speed_most_mm_s=speed_most_mm_s, loss=loss)


def located(head_mm: int = 400_000) -> Station:
    """The station, and the head of the train in the west so far, by its machines a metre farther at most."""
    station = Station()
    station.step(
        "locate", train=T1, head_mm=head_mm, block=WEST, block_end_mm=ENDS_MM[WEST], front_most_mm=head_mm + 1_000
    )
    assert station.system.brake[T1] == Brake(applied=True, end_mm=head_mm + 1_000, withheld=True)
    assert station.system.standing == {T1}
    return station


def permitted(head_mm: int = 400_000) -> Station:
    """That train, with the list of its run, permitted."""
    station = located(head_mm)
    station.listed(RUN, BEGINS_MM, ENDS_MM)
    station.told({RUN: PERMITTED})
    return station


def under_way(head_mm: int = 400_000) -> Station:
    """That train, with the end of its authority taken, rolling."""
    station = permitted(min(head_mm, 439_000))
    station.holds(750_000)
    assert station.system.standing == frozenset()
    assert station.rolling() == {RUN}
    if head_mm > 440_000:
        station.passes(head_mm, THROAT, 550_000)
    return station


def two_runs() -> Station:
    """A train in the west with two runs, through track one and on to the east; its brake holds the end of both."""
    station = permitted()
    station.listed(ONWARD, 550_000, ONWARD_MM)
    station.told({RUN: PERMITTED, ONWARD: PERMITTED})
    station.holds(1_000_000)
    assert station.rolling() == {RUN, ONWARD}
    return station


def released(brake: Brake, front_mm: int) -> Brake:
    """What a driver gets who acknowledges at a standstill."""
    return supervise(BOUNDS, brake, front_mm, 0, 0, demanded=False, acknowledged=True)
