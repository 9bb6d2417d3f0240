"""What is assumed of nature, brake, sensors and people: named predicates, each with its reason.

These alone read what is really there.  A transition of the world asks them whether nature
permits an event; what the kernel is then told is only the event.
"""

from __future__ import annotations

from kernel.centre import NO_BLOCKS
from kernel.names import Block, Cab, Car, Epoch, Point, Position, Read, Route, Run, Tag, Train, UnitLife
from kernel.standstill import Standstill, ThroughLine
from models.world.state import Site, System
from models.world.truth import (
    came_round,
    is_genuine,
    is_last,
    is_overdue_first,
    its_front_leads,
    keeps_before,
    lies_at_a_miss,
    only_the_last_speaks,
    reads_both_first,
    says_it_is_held,
    says_it_is_held_between,
    says_it_stays_held,
    stands_as_it_says,
    stands_within,
)


def a_train_obeys_its_authority(site: Site, system: System, run: Run, block: Block) -> bool:
    """A head gets out of a block only where its brake lets it, along the way of a run.

    The brake holds the end of authority that it was last given; a train that rolls may run up to
    that end even if the unit has meanwhile lost its authority.
    """
    return (
        run.route in site.layout.way and block in site.layout.way[run.route] and (run, block) in system.track.leavable
    )


def a_train_runs_forward_along_its_run(site: Site, system: System, run: Run, block: Block, target: Block) -> bool:
    """A train runs with the cab ahead that its driver has chosen, along a run into each block and out of it once."""
    return (
        run in site.formation.front
        and system.track.facing.get(run.train) == site.formation.front[run]
        and (run, block) not in system.track.gone
        and (run, target) not in system.track.entered
    )


def rails_lead(site: Site, system: System, route: Route, block: Block, target: Block) -> bool:
    """A car running in the direction of a route gets from one block to the next only as its points lie."""
    return (
        route in site.ground.leads
        and block in site.ground.leads[route]
        and target in site.ground.leads[route][block]
        and all(
            system.track.lies.get(point) == site.ground.leads[route][block][target][point]
            for point in site.ground.leads[route][block][target]
        )
    )


def a_tag_is_read_where_it_lies(site: Site, system: System, cab: Cab, tag: Tag) -> bool:
    """The antenna of a cab reads a tag of the line only with its car in the block that the tag lies in."""
    return tag not in site.ground.laid_in or (
        cab in site.formation.carried_by
        and site.ground.laid_in[tag] in system.track.at.get(site.formation.carried_by[cab], NO_BLOCKS)
    )


def a_run_is_led_by_its_front(site: Site, system: System, train: Train, cab: Cab, tag: Tag) -> bool:
    """Whoever reads both tags at the end of a run's start block, one right after the other, leads as that run does."""
    return all(
        run.train != train
        or not reads_both_first(site, system, train, run, tag)
        or (run in site.formation.front and site.formation.front[run] == cab)
        for run in system.radio.permits
    )


def a_pair_passed_in_order_proves_the_exit(site: Site, system: System, run: Run, car: Car, read: Read) -> bool:
    """Where the last car's antenna has passed one tag of a boundary and then the other, no car is in the block before.

    A tag lies at least rear overhang, read window and error beyond the boundary, and cars keep
    their order.  It holds while the train runs in one direction, and while its head does not pass
    the same boundary in between, as on a loop.  On a loop the head may have come round into that
    block, and other cars after it: they came under a run that it leads and under which it has not yet
    gone on over that boundary.  Only genuine records are bound by it.
    """
    if not is_last(site, system, run, car) or not is_genuine(site, read):
        return True
    return all(
        block not in system.track.at[other]
        or site.formation.train_of.get(other) != run.train
        or came_round(site, system, other, block, tag, read.tag)
        for train, tag in system.track.passed
        if train == run.train and tag in site.ground.laid_leaves and read.tag in site.ground.laid_leaves[tag]
        for block in site.ground.laid_leaves[tag][read.tag]
        for other in system.track.at
    )


def a_missed_tag_is_overdue_before_the_tail_comes(
    site: Site, system: System, train: Train, tag: Tag, line: ThroughLine
) -> bool:
    """A tag that the head has missed is overdue by running distance before what the tail reads there counts.

    There is the missed tag itself, and the other of its boundary unless the head read that just before.
    """
    return is_overdue_first(lies_at_a_miss(site, system, train, tag), line)


def a_healthy_line_reaches_the_tail(
    site: Site, system: System, run: Run, car: Car, cab: Cab, line: ThroughLine
) -> bool:
    """Of the cabs that do not lead, only the one on the last car reads while line, split and spacing all say whole.

    The line runs through every coupling, so losing a car breaks it; accelerations of both ends and the spacing of
    the antennas are watched as well (T3, T13, P5).
    """
    return system.track.facing.get(run.train) == cab or only_the_last_speaks(line, is_last(site, system, run, car))


def a_head_runs_no_farther_than_its_brake_lets_it(
    system: System, run: Run, at: Standstill, held_end_mm: int, start_end_mm: int
) -> bool:
    """A train that stands short of the end that its brake holds, and that holds it there, keeps out of what follows.

    Nothing is assumed of one that moves, or whose front may be past that end: it may brake worse than its bounds.  The
    joint proves what is said of the end.
    """
    return (
        not says_it_is_held(at)
        or at.front_most_mm > start_end_mm
        or keeps_before(system, run, held_end_mm, start_end_mm)
    )


def a_train_within_its_destination_is_not_beyond(
    site: Site, system: System, run: Run, at: Standstill, begin_mm: int, end_mm: int
) -> bool:
    """The range contains the front: a train that is held with it between these two places is there, and not beyond.

    So of a train that has not changed ends since it ran there; of another it is said of its other end.
    """
    return not (says_it_is_held_between(at, begin_mm, end_mm) and its_front_leads(site, system, run)) or (
        run not in system.track.slipping
        and run.route in site.layout.destination
        and any(
            site.formation.train_of.get(car) == run.train and site.layout.destination[run.route] in system.track.at[car]
            for car in system.track.at
        )
        and run.route in site.layout.overlap
        and all(
            block not in system.track.at[car]
            for car in system.track.at
            if site.formation.train_of.get(car) == run.train
            for block in site.layout.overlap[run.route]
        )
    )


def a_located_train_stands_where_it_says(
    site: Site, system: System, train: Train, blocks: frozenset[Block], at: Standstill, line: ThroughLine
) -> bool:
    """An unbroken train that its brake holds is at rest, with no car outside the blocks that the tags at both ends say.

    Nothing is assumed of one whose brake an acknowledgement releases, nor of where it is if it names a block that the
    line does not have.
    """
    return (
        not says_it_stays_held(at)
        or not (line.answers and line.is_intact)
        or stands_as_it_says(site, system, train, blocks)
    )


def two_persons_do_not_both_err(
    site: Site,
    system: System,
    train: Train,
    blocks: frozenset[Block],
    key: tuple[Train, UnitLife, Epoch],
    others: frozenset[tuple[Train, UnitLife, Epoch]],
) -> bool:
    """Where one of the two persons has erred, the other names no place but one that the train is at rest in.

    ``others``: when the other one has erred.
    """
    return key not in others or stands_within(site, system, train, blocks)


def detection_is_true(system: System, point: Point, detected: Position) -> bool:
    """A terminal's detector contacts show how the point lies."""
    return system.track.lies.get(point) == detected
