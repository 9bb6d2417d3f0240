"""What happens on board: a message that was once sent arrives, an antenna reads, a unit restarts."""

from __future__ import annotations

from dataclasses import replace

from kernel import authority, first_loop, second_loop, standing, tail_evidence
from kernel.names import Antenna, Block, Cab, Car, Epoch, Read, Run, Tag, Train, UnitLife
from kernel.restarts import restart_unit as restarted_unit
from kernel.unit import Unit
from models.world.assumptions import (
    a_head_runs_no_farther_than_its_brake_lets_it,
    a_healthy_line_reaches_the_tail,
    a_located_train_stands_where_it_says,
    a_pair_read_in_order_proves_the_exit,
    a_train_within_its_destination_is_not_beyond,
)
from models.world.evidence import as_written
from models.world.state import Site, System


def with_unit(system: System, train: Train, unit: Unit) -> System:
    """Put a unit's next state in its place."""
    return replace(system, units=system.units | {train: unit})


def take_offer(site: Site, system: System, run: Run) -> System:
    """The tags of a route arrive (T4)."""
    if run not in system.radio.offers or run.train not in system.units:
        return system
    return with_unit(system, run.train, first_loop.take_offer(site.layout, system.units[run.train], run))


def take_permit(site: Site, system: System, run: Run) -> System:
    """A route-complete message arrives (T4)."""
    if run not in system.radio.permits or run.train not in system.units:
        return system
    return with_unit(system, run.train, first_loop.take_permit(system.units[run.train], run))


def recall(site: Site, system: System, run: Run) -> System:
    """The centre's recall arrives (T9)."""
    if run not in system.radio.recalls or run.train not in system.units:
        return system
    return with_unit(system, run.train, first_loop.recall(system.units[run.train], run))


def give_back(site: Site, system: System, run: Run, held_end_mm: int, start_end_mm: int) -> System:
    """The brake control tells which end of authority it holds, and the list where the run's start block ends (T9)."""
    if run.train not in system.units:
        return system
    if not a_head_runs_no_farther_than_its_brake_lets_it(system, run, held_end_mm, start_end_mm):
        return system
    unit = first_loop.give_back(site.layout, system.units[run.train], run, held_end_mm, start_end_mm)
    return with_unit(system, run.train, unit)


def take_standing(site: Site, system: System, run: Run) -> System:
    """The centre's word under which run the train stands arrives (T8)."""
    if run not in system.radio.standing_runs or run.train not in system.units:
        return system
    return with_unit(system, run.train, first_loop.take_standing(system.units[run.train], run))


def head_reads(site: Site, system: System, train: Train, cab: Cab, tag: Tag, in_window: bool) -> System:
    """The head antenna reads something, anywhere: right, foreign, repeated, early or late (T5)."""
    if train not in system.units:
        return system
    return with_unit(system, train, second_loop.note_head_read(site.layout, system.units[train], cab, tag, in_window))


def window_passes(site: Site, system: System, train: Train) -> System:
    """The next tag is overdue (T5)."""
    if train not in system.units:
        return system
    return with_unit(system, train, second_loop.note_window_passed(system.units[train]))


def tail_reads(
    site: Site, system: System, run: Run, car: Car, antenna: Antenna, cab: Cab, healthy: bool, read: Read
) -> System:
    """The antenna of a cab on ``car`` reads something while the train runs as in ``run`` (T2, T6)."""
    if run.train not in system.units or run not in site.formation.ahead:
        return system
    if site.formation.cab.get(car) != cab or site.formation.train_of.get(car) != run.train:
        return system
    if not a_healthy_line_reaches_the_tail(site, system, run, antenna, cab, healthy):
        return system
    before = system.units[run.train].tail_read
    if (
        before is not None
        and system.units[run.train].tail_cab == cab
        and not a_pair_read_in_order_proves_the_exit(site, system, run, car, before, read)
    ):
        return system
    unit = tail_evidence.note_tail_read(site.layout, system.units[run.train], antenna, cab, healthy, read)
    behind = system.track.behind | frozenset(
        (other, block)
        for other, order in unit.orders.items()
        for block, evidence in order.left.items()
        if as_written(site, evidence.left, evidence.entered)
    )
    return replace(with_unit(system, run.train, unit), track=replace(system.track, behind=behind))


def note_stopped(site: Site, system: System, run: Run, within_destination: bool) -> System:
    """The odometer says whether the train stands in its destination (T9)."""
    if run.train not in system.units:
        return system
    if not a_train_within_its_destination_is_not_beyond(site, system, run, within_destination):
        return system
    return with_unit(system, run.train, authority.note_stopped(system.units[run.train], run, within_destination))


def answer(
    site: Site,
    system: System,
    train: Train,
    epoch: Epoch,
    life: UnitLife,
    blocks: frozenset[Block],
    at_rest: bool,
    healthy: bool,
) -> System:
    """A challenge arrives (T8)."""
    if epoch not in system.radio.challenges or train not in system.units:
        return system
    if not a_located_train_stands_where_it_says(site, system, train, blocks, at_rest, healthy):
        return system
    return with_unit(system, train, standing.answer(system.units[train], epoch, life, blocks, at_rest, healthy))


def restart_unit(site: Site, system: System, train: Train, life: UnitLife) -> System:
    """A unit restarts, at any moment, and has forgotten all but the count of its lives (T8)."""
    if train not in system.units or life <= system.units[train].life:
        return system
    return with_unit(system, train, restarted_unit(system.units[train], life))
