"""What happens on board: a message that was once sent arrives, an antenna reads, a unit restarts."""

from __future__ import annotations

from dataclasses import replace

from kernel import authority, first_loop, second_loop, standing, tail_evidence
from kernel.names import Block, Cab, Car, Epoch, Read, Run, Tag, TagList, Train, UnitLife
from kernel.restarts import restart_unit as restarted_unit
from kernel.standstill import Standstill, ThroughLine
from kernel.unit import Unit
from models.world.assumptions import (
    a_head_runs_no_farther_than_its_brake_lets_it,
    a_healthy_line_reaches_the_tail,
    a_located_train_stands_where_it_says,
    a_missed_tag_is_overdue_before_the_tail_comes,
    a_pair_passed_in_order_proves_the_exit,
    a_run_is_led_by_its_front,
    a_tag_is_read_where_it_lies,
    a_train_within_its_destination_is_not_beyond,
)
from models.world.evidence import as_written, awaited_but, awaited_by_others, awaited_in, unpassed
from models.world.state import Site, System
from models.world.truth import (
    is_genuine,
    is_last,
    its_front_leads,
    reads_both_first,
    says_it_is_held_between,
    the_head_arrived,
    the_head_went_on,
)


def with_unit(system: System, train: Train, unit: Unit) -> System:
    """Put a unit's next state in its place."""
    return replace(system, units=system.units | {train: unit})


def in_the_life(system: System, train: Train, unit: Unit) -> System:
    """Put a unit's next state in its place, in this life or another.  History: what its head missed before that."""
    return replace(with_unit(system, train, unit), track=replace(system.track, unread=awaited_in(system, train, unit)))


def take_offer(site: Site, system: System, run: Run, tag_list: TagList) -> System:
    """The tags of a route arrive, and the unit keeps some list of them: nothing is assumed of which (T4)."""
    if run not in system.radio.offers or run.train not in system.units:
        return system
    return with_unit(system, run.train, first_loop.take_offer(site.lists, system.units[run.train], run, tag_list))


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


def give_back(site: Site, system: System, run: Run, at: Standstill, held_end_mm: int, start_end_mm: int) -> System:
    """The brake control tells which end of authority it holds, and the list where the run's start block ends (T9)."""
    if run.train not in system.units:
        return system
    if not a_head_runs_no_farther_than_its_brake_lets_it(system, run, at, held_end_mm, start_end_mm):
        return system
    unit = first_loop.give_back(site.lists, system.units[run.train], run, at, held_end_mm, start_end_mm)
    return with_unit(system, run.train, unit)


def take_standing(site: Site, system: System, run: Run) -> System:
    """The centre's word under which run the train stands arrives (T8)."""
    if run not in system.radio.standing_runs or run.train not in system.units:
        return system
    return with_unit(system, run.train, first_loop.take_standing(system.units[run.train], run))


def head_reads(site: Site, system: System, train: Train, cab: Cab, tag: Tag, in_window: bool) -> System:
    """The antenna of a cab reads a tag while that cab leads: right, foreign, repeated, early or late (T5).

    History: where the head is, and whether the tag was to come.
    """
    if train not in system.units or system.track.facing.get(train) != cab:
        return system
    if not a_tag_is_read_where_it_lies(site, system, cab, tag):
        return system
    if not a_run_is_led_by_its_front(site, system, train, cab, tag):
        return system
    unit = system.units[train]
    begun = system.track.begun | frozenset(
        run for run in system.radio.permits if run.train == train and reads_both_first(site, system, train, run, tag)
    )
    to_come = in_window and any(
        order.permitted and not order.given_back and order.expected == tag for _, order in unit.orders.items()
    )
    goes_on = to_come or unit.leading != cab or unit.head_tag == tag or unit.loop_open
    return replace(
        with_unit(system, train, second_loop.note_head_read(site.plan, site.lists, unit, cab, tag, in_window)),
        track=replace(
            system.track,
            begun=begun,
            entered=system.track.entered
            | frozenset(
                (run, site.ground.laid_in[tag])
                for run in begun
                if run in site.formation.front
                and site.formation.front[run] == cab
                and run.route in site.layout.routes
                and tag in site.ground.laid_in
                and site.ground.laid_in[tag] in site.layout.claims[run.route]
                and site.ground.laid_in[tag] != site.layout.start[run.route]
            ),
            last_read=system.track.last_read | {train: tag},
            passed=unpassed(site, system, train, tag),
            unread=awaited_but(system, train, tag) if goes_on else awaited_by_others(system, train),
            astray=system.track.astray if goes_on else system.track.astray | {(train, unit.life)},
        ),
    )


def window_passes(site: Site, system: System, train: Train) -> System:
    """The next tag is overdue (T5)."""
    if train not in system.units:
        return system
    return replace(
        with_unit(system, train, second_loop.note_window_passed(system.units[train])),
        track=replace(
            system.track,
            unread=awaited_by_others(system, train),
            astray=system.track.astray | {(train, system.units[train].life)},
        ),
    )


def tail_reads(site: Site, system: System, run: Run, car: Car, cab: Cab, line: ThroughLine, read: Read) -> System:
    """The antenna of a cab on ``car`` reads something while the train runs as in ``run`` (T2, T6).

    History: what the last antenna has passed, and what the train has gone out of.
    """
    if run.train not in system.units or site.formation.cab.get(car) != cab:
        return system
    if site.formation.train_of.get(car) != run.train or system.track.facing.get(run.train) == cab:
        return system
    if not a_healthy_line_reaches_the_tail(site, system, run, car, cab, line):
        return system
    if not a_missed_tag_is_overdue_before_the_tail_comes(site, system, run.train, read.tag, line):
        return system
    if not a_pair_passed_in_order_proves_the_exit(site, system, run, car, read):
        return system
    before = system.units[run.train]
    elsewhere = (
        line.answers
        and line.is_intact
        and line.fits
        and before.leading is not None
        and (read.tag not in site.plan.tag_in or site.plan.tag_in[read.tag] not in before.occupied)
    )
    unit = tail_evidence.note_tail_read(site.plan, site.lists, before, cab, line, read)
    counts = is_last(site, system, run, car) and is_genuine(site, read)
    behind = system.track.behind | frozenset(
        (other, block)
        for other, order in unit.orders.items()
        for block, evidence in order.left.items()
        if as_written(site, evidence.left, evidence.entered)
    )
    gone = system.track.gone | frozenset(
        (other, block)
        for other in system.radio.permits
        if counts
        and other in site.formation.front
        and system.track.facing.get(run.train) == site.formation.front[other]
        for train, tag in system.track.passed
        if train == run.train and tag in site.ground.laid_leaves and read.tag in site.ground.laid_leaves[tag]
        for block in site.ground.laid_leaves[tag][read.tag]
        if the_head_went_on(site, system, other, block, tag, read.tag)
    )
    return replace(
        with_unit(system, run.train, unit),
        track=replace(
            system.track,
            behind=behind,
            gone=gone,
            passed=system.track.passed | {(run.train, read.tag)} if counts else system.track.passed,
            astray=system.track.astray | {(run.train, before.life)} if elsewhere else system.track.astray,
        ),
    )


def note_stopped(site: Site, system: System, run: Run, at: Standstill, begin_mm: int, end_mm: int) -> System:
    """The odometry has a range of front and speed, and the list says where the run's destination is (T9).

    History: whether the train was held in it, having come there under this run.
    """
    if run.train not in system.units:
        return system
    if not a_train_within_its_destination_is_not_beyond(site, system, run, at, begin_mm, end_mm):
        return system
    unit = authority.note_stopped(site.lists, system.units[run.train], run, at, begin_mm, end_mm)
    stands = (
        says_it_is_held_between(at, begin_mm, end_mm)
        and its_front_leads(site, system, run)
        and the_head_arrived(site, system, run)
    )
    stood = system.track.stood | {run} if stands else system.track.stood
    return replace(with_unit(system, run.train, unit), track=replace(system.track, stood=stood))


def answer(
    site: Site,
    system: System,
    train: Train,
    epoch: Epoch,
    life: UnitLife,
    blocks: frozenset[Block],
    at: Standstill,
    line: ThroughLine,
) -> System:
    """A challenge arrives (T8)."""
    if epoch not in system.radio.challenges or train not in system.units:
        return system
    if not a_located_train_stands_where_it_says(site, system, train, blocks, at, line):
        return system
    return in_the_life(system, train, standing.answer(system.units[train], epoch, life, blocks, at, line))


def restart_unit(site: Site, system: System, train: Train, life: UnitLife) -> System:
    """A unit restarts, at any moment, and has forgotten all but the count of its lives (T8)."""
    if train not in system.units or life <= system.units[train].life:
        return system
    return in_the_life(system, train, restarted_unit(system.units[train], life))
