"""Starting up is a restart: everything lost, trains wherever they stand (T8)."""

from __future__ import annotations

from collections.abc import Mapping

from kernel.centre import Centre
from kernel.names import Block, Car, Epoch, Point, Position, Serial, TerminalLife, Train, UnitLife
from kernel.restarts import restart_centre, restart_terminal, restart_unit
from kernel.terminal import Terminal
from kernel.unit import NO_ORDERS, Unit
from models.world.state import Radio, Site, System, Track

FIRST_EPOCH = Epoch(1)


def silent_radio() -> Radio:
    """Nothing has ever been sent."""
    return Radio(
        orders=frozenset(),
        relayed_orders=frozenset(),
        enquiries=frozenset(),
        relayed_enquiries=frozenset(),
        confirmed=frozenset(),
        confirmations=frozenset(),
        offers=frozenset(),
        echoes=frozenset(),
        permits=frozenset(),
        recalls=frozenset(),
        returns=frozenset(),
        tail_reports=frozenset(),
        stops=frozenset(),
        challenges=frozenset(),
        standings={},
        standing_runs=frozenset(),
        terminal_lives=frozenset(),
        statements={},
        confirmed_statements=frozenset(),
    )


def start(site: Site, at: Mapping[Car, frozenset[Block]], lies: Mapping[Point, Position]) -> System:
    """Give the state in which every machine has just started, with cars and points as they are."""
    unit = Unit(
        life=UnitLife(0),
        answered=None,
        standing_in=frozenset(),
        orders=NO_ORDERS,
        loop_open=False,
        leading=None,
        head_tag=None,
        tail_read=None,
        occupied=frozenset(),
    )
    terminal = Terminal(life=TerminalLife(0), holds=None, wanted=None, unlocked=False)
    centre = Centre(
        epoch=Epoch(0),
        newest=Serial(0),
        accounted={},
        runs={},
        claimed={},
        locked={},
        lost_blocks=site.layout.blocks,
        lost_points=site.layout.points,
        terminal_life={},
        supervised=frozenset(),
        statements={},
    )
    return System(
        centre=restart_centre(site.layout, centre, FIRST_EPOCH),
        units={Train(train): restart_unit(unit, UnitLife(1)) for train in site.layout.fleet},
        terminals={Point(point): restart_terminal(terminal, TerminalLife(1)) for point in site.layout.points},
        radio=silent_radio(),
        track=Track(
            at=dict(at),
            under={},
            run_into=frozenset(),
            entered=frozenset(),
            gone=frozenset(),
            behind=frozenset(),
            rolling=frozenset(),
            slipping=frozenset(),
            leavable=frozenset(),
            facing={},
            passed=frozenset(),
            unread=frozenset(),
            astray=frozenset(),
            lies=dict(lies),
            parted=frozenset(),
        ),
    )
