"""Starting up is a restart: everything lost, trains wherever they stand (T8)."""

from __future__ import annotations

from collections.abc import Mapping

from kernel.centre import Centre
from kernel.layout import Layout, TagRecords
from kernel.names import Block, Car, Epoch, Point, Position, Serial, TerminalLife, Train, UnitLife
from kernel.restarts import restart_centre, restart_terminal, restart_unit
from kernel.tag_list import TagPlan
from kernel.tag_list_text import what_they_say
from kernel.terminal import Terminal
from kernel.unit import NO_ORDERS, Unit
from models.ground import Ground
from models.world.state import Formation, Radio, Site, System, Track

FIRST_EPOCH = Epoch(1)


def site_as_told(layout: Layout, records: TagRecords, ground: Ground, formation: Formation) -> Site:
    """Give the site on which every unit reads tag lists right, and has the centre's plan of the tags."""
    return Site(
        layout=layout,
        lists=what_they_say(tag_list for _, tag_list in layout.tag_list.items()),
        plan=TagPlan(tag_in=layout.tag_in, partner=layout.partner, stands_in=layout.stands_in),
        records=records,
        ground=ground,
        formation=formation,
    )


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
        echoes={},
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
        confirmed_statements={},
    )


def start(site: Site, at: Mapping[Car, frozenset[Block]], lies: Mapping[Point, Position]) -> System:
    """Give the state in which every machine has just started, with cars and points as they are."""
    unit = Unit(
        life=UnitLife(0),
        answered=None,
        standing_in=frozenset(),
        isolated_in=None,
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
            begun=frozenset(),
            entered=frozenset(),
            gone=frozenset(),
            behind=frozenset(),
            rolling=frozenset(),
            slipping=frozenset(),
            stood=frozenset(),
            first_erred=frozenset(),
            second_erred=frozenset(),
            leavable=frozenset(),
            facing={},
            last_read={},
            passed=frozenset(),
            unread=frozenset(),
            astray=frozenset(),
            lies=dict(lies),
            parted=frozenset(),
        ),
    )
