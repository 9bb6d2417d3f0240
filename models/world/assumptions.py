"""What is assumed of nature, brake, sensors and people: named predicates, each with its reason.

These alone read what is really there.  A transition of the world asks them whether nature
permits an event; what the kernel is then told is only the event.
"""

from __future__ import annotations

from kernel.authority import may_leave
from kernel.names import Antenna, Block, Cab, Car, Epoch, Point, Position, Read, Route, Run, Train, UnitLife
from models.world.state import NO_CARS, Site, System


def a_train_obeys_its_authority(site: Site, system: System, run: Run, block: Block) -> bool:
    """A head leaves a block only under authority, or rolling on from authority it had.

    The brake stops the train inside the authority that the unit last had, so a train that lost
    it while rolling goes on forward: not out of or into a block its tail has left in this run,
    and into the overlap only if it was slipping.
    """
    if run not in system.track.rolling or run.train not in system.units or run.route not in site.layout.way:
        return False
    target = site.layout.way[run.route].get(block)
    if target is None:
        return False
    if may_leave(site.layout, system.units[run.train], run, block):
        return True
    return (
        (run, block) not in system.track.behind
        and (run, target) not in system.track.behind
        and (target not in site.layout.overlap[run.route] or run in system.track.slipping)
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


def a_pair_read_in_order_proves_the_exit(
    site: Site, system: System, run: Run, car: Car, before: Read, read: Read
) -> bool:
    """Both tags of a boundary read in order by one antenna: its car, and all ahead of it, have left the block.

    A tag lies at least rear overhang, read window and error beyond the boundary, and cars keep
    their order.  Reads of two antennas prove nothing together.  Only genuine records are bound by
    this: a foreign, copied or corrupted tag may be read anywhere.
    """
    if site.records.record.get(before.tag) != before.record or site.records.record.get(read.tag) != read.record:
        return True
    if before.tag not in site.ground.laid_leaves or read.tag not in site.ground.laid_leaves[before.tag]:
        return True
    return all(
        block not in system.track.at.get(car, frozenset())
        and all(
            block not in system.track.at.get(other, frozenset())
            for other in site.formation.ahead[run].get(car, NO_CARS)
        )
        for block in site.ground.laid_leaves[before.tag][read.tag]
    )


def a_healthy_line_reaches_the_tail(
    site: Site, system: System, run: Run, antenna: Antenna, cab: Cab, healthy: bool
) -> bool:
    """The tail antenna is that of the cab on the last car; a parted train may have another, but no healthy line.

    The line runs through every coupling, so losing a car breaks it; antenna spacing is checked
    against the measured length as well (T3, T13).
    """
    if antenna != Antenna.TAIL:
        return True
    if run.train in system.track.parted:
        return not healthy
    return run in site.formation.last and site.formation.cab.get(site.formation.last[run]) == cab


def a_head_runs_no_farther_than_its_brake_lets_it(
    system: System, run: Run, held_end_mm: int, start_end_mm: int
) -> bool:
    """While the brake holds an end no farther than the run's start block ends, the train keeps out of what follows.

    It does not roll into it, and no car is in a block that it came into under this run.  The joint proves it.
    """
    return held_end_mm > start_end_mm or (
        run not in system.track.rolling
        and all(
            other != run or block not in system.track.at.get(car, frozenset())
            for car in system.track.under
            for block, other in system.track.under[car].items()
        )
    )


def a_train_within_its_destination_is_not_beyond(
    site: Site, system: System, run: Run, within_destination: bool
) -> bool:
    """Odometer and tags contain the front: a train said to stand in its destination is not in the overlap."""
    return not within_destination or (
        run not in system.track.slipping
        and run.route in site.layout.overlap
        and all(
            block not in system.track.at[car]
            for car in system.track.at
            if site.formation.train_of.get(car) == run.train
            for block in site.layout.overlap[run.route]
        )
    )


def a_located_train_stands_where_it_says(
    site: Site, system: System, train: Train, blocks: frozenset[Block], at_rest: bool, healthy: bool
) -> bool:
    """Tags at both ends of an unbroken train at rest say exactly which blocks it is in."""
    return not at_rest or not healthy or stands_exactly(site, system, train, blocks)


def stands_exactly(site: Site, system: System, train: Train, blocks: frozenset[Block]) -> bool:
    """No car of ``train`` is outside ``blocks``, none of them is empty of it, and it is at rest."""
    return (
        all(
            block in blocks
            for car in system.track.at
            if site.formation.train_of.get(car) == train
            for block in system.track.at[car]
        )
        and all(
            any(block in system.track.at[car] for car in system.track.at if site.formation.train_of.get(car) == train)
            for block in blocks
        )
        and all(run.train != train for run in system.track.rolling)
        and all(run.train != train for run in system.track.slipping)
    )


def two_persons_do_not_err_alike(site: Site, system: System, train: Train, life: UnitLife, epoch: Epoch) -> bool:
    """The second person confirms a statement only if the train stands exactly so."""
    return (train, life, epoch) in system.radio.statements and stands_exactly(
        site, system, train, system.radio.statements[train, life, epoch]
    )


def detection_is_true(system: System, point: Point, detected: Position) -> bool:
    """A terminal's detector contacts show how the point lies."""
    return system.track.lies.get(point) == detected
