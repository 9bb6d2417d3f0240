"""Starting up is a restart: everything lost, trains wherever they stand (T8)."""

from __future__ import annotations

from collections.abc import Mapping

from kernel.layout import Layout, TagRecords
from kernel.machine import centre, point_terminal, unit
from kernel.names import Block, Car, Point, Position, Train, UnitLife
from kernel.tag_list import TagPlan
from kernel.tag_list_text import what_they_say
from models.ground import Ground
from models.world.state import Formation, Radio, Site, System, Track


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
    return System(
        centre=centre.start(site.layout, centre.NEVER_STARTED),
        units={Train(train): unit.start(UnitLife(0)) for train in site.layout.fleet},
        terminals={Point(point): point_terminal.start(point_terminal.NEVER_STARTED) for point in site.layout.points},
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
