"""Words for what is really there, in which assumptions, histories and invariants are said; they assume nothing."""

from __future__ import annotations

from kernel.maps import Map
from kernel.names import Block, Car, Point, Read, Run, Tag, Train
from kernel.standstill import Standstill, ThroughLine
from kernel.terminal import Terminal
from kernel.unit import Unit
from models.world.state import Site, System


def is_genuine(site: Site, read: Read) -> bool:
    """The read carries what is written in the tag that it names: not foreign, copied or corrupted."""
    return site.records.record.get(read.tag) == read.record


def no_block_holds_two_trains(site: Site, at: Map[Car, frozenset[Block]]) -> bool:
    """Cars in one block belong to one train (T4, T9)."""
    return all(
        site.formation.train_of.get(car) == site.formation.train_of.get(other)
        for car in at
        for block in at[car]
        for other in at
        if block in at[other]
    )


def no_fouling_blocks_hold_two_trains(site: Site, at: Map[Car, frozenset[Block]]) -> bool:
    """Cars in blocks that foul each other belong to one train (T9)."""
    return all(
        site.formation.train_of.get(car) == site.formation.train_of.get(other)
        for car in at
        for block in at[car]
        for beside in site.layout.fouls.get(block, frozenset())
        for other in at
        if beside in at[other]
    )


def no_point_under_a_car_is_unlocked(
    site: Site, at: Map[Car, frozenset[Block]], terminals: Map[Point, Terminal]
) -> bool:
    """A point in a block that a car is in is locked (T10)."""
    return all(
        point in terminals and not terminals[point].unlocked
        for car in at
        for block in at[car]
        for point in site.layout.points_in.get(block, frozenset())
    )


def goes_by_the_centres_list(site: Site, unit: Unit) -> bool:
    """What the unit keeps of a route that it is permitted to enter is the list that the centre sends of it (T4)."""
    return all(
        not order.permitted
        or (
            run.route in site.layout.way
            and run.route in site.layout.tag_list
            and order.tag_list == site.layout.tag_list[run.route]
        )
        for run, order in unit.orders.items()
    )


def its_front_leads(site: Site, system: System, run: Run) -> bool:
    """The cab leads that leads in this run: the train has not changed ends since, or twice."""
    return run in site.formation.front and system.track.facing.get(run.train) == site.formation.front[run]


def reads_both_first(site: Site, system: System, train: Train, run: Run, tag: Tag) -> bool:
    """The head of a train has read the first tag of a run's list last, and now the second (T5)."""
    return (
        run.route in site.layout.first_tag
        and run.route in site.layout.tag_after
        and system.track.last_read.get(train) == site.layout.first_tag[run.route]
        and site.layout.tag_after[run.route].get(site.layout.first_tag[run.route]) == tag
    )


def is_last(site: Site, system: System, run: Run, car: Car) -> bool:
    """The car is the last of a whole train that runs as in ``run``."""
    return (
        run in site.formation.last
        and site.formation.last[run] == car
        and its_front_leads(site, system, run)
        and run.train not in system.track.parted
    )


def stands_within(site: Site, system: System, train: Train, blocks: frozenset[Block]) -> bool:
    """No car of ``train`` is outside ``blocks``, and it is at rest."""
    return is_within(site, system, train, blocks) and is_at_rest(system, train)


def stands_as_it_says(site: Site, system: System, train: Train, blocks: frozenset[Block]) -> bool:
    """``train`` is at rest, and outside of ``blocks`` only where they are no place of this line."""
    return is_at_rest(system, train) and (not name_a_place(site, blocks) or is_within(site, system, train, blocks))


def name_a_place(site: Site, blocks: frozenset[Block]) -> bool:
    """Each is a block of this line; none at all is a place off it."""
    return all(block in site.layout.blocks for block in blocks)


def is_within(site: Site, system: System, train: Train, blocks: frozenset[Block]) -> bool:
    """No car of ``train`` is outside ``blocks``."""
    return all(
        block in blocks
        for car in system.track.at
        if site.formation.train_of.get(car) == train
        for block in system.track.at[car]
    )


def is_at_rest(system: System, train: Train) -> bool:
    """``train`` neither rolls nor slips."""
    return all(run.train != train for run in system.track.rolling) and all(
        run.train != train for run in system.track.slipping
    )


def keeps_before(system: System, run: Run, held_end_mm: int, start_end_mm: int) -> bool:
    """Held to an end no farther than a run's start block ends, the train neither rolls in that run nor is in it.

    It is in it with any car that is in a block which it came into under this run.
    """
    return (held_end_mm > start_end_mm or run not in system.track.rolling) and all(
        held_end_mm > start_end_mm or other != run or block not in system.track.at.get(car, frozenset())
        for car in system.track.under
        for block, other in system.track.under[car].items()
    )


def says_it_stands(at: Standstill) -> bool:
    """The odometry claims a range of speed that is a standstill."""
    return at.known and -at.standstill_mm_s <= at.speed_least_mm_s and at.speed_most_mm_s <= at.standstill_mm_s


def says_it_is_held(at: Standstill) -> bool:
    """And its brake has been commanded for as long as that takes to respond."""
    return says_it_stands(at) and at.braked_cycles >= at.response_cycles


def says_it_stays_held(at: Standstill) -> bool:
    """And nothing but an end of authority that is taken releases it."""
    return says_it_is_held(at) and not at.releasable


def says_it_is_held_between(at: Standstill, begin_mm: int, end_mm: int) -> bool:
    """And the odometry claims a range of the front that is between two places."""
    return says_it_is_held(at) and begin_mm <= at.front_least_mm and at.front_most_mm <= end_mm


def the_head_arrived(site: Site, system: System, run: Run) -> bool:
    """The head has been under this run where its way goes on into its overlap alone, or not at all."""
    way = site.layout.way.get(run.route, {})
    return any(
        other == run and (block not in way or way[block] in site.layout.overlap.get(run.route, frozenset()))
        for other, block in system.track.entered
    )


def the_head_went_on(site: Site, system: System, run: Run, block: Block, left: Tag, entered: Tag) -> bool:
    """The cab that leads went on out of ``block`` over the boundary of those tags under this run, or a later one."""
    return any(
        other.serial >= run.serial
        and other in site.formation.front
        and system.track.facing.get(run.train) == site.formation.front[other]
        and other.route in site.layout.way
        and site.layout.way[other.route].get(block) == beyond
        and other.route in site.layout.tag_after
        and site.layout.tag_after[other.route].get(left) == entered
        for other, beyond in system.track.entered
    )


def came_round(site: Site, system: System, car: Car, block: Block, left: Tag, entered: Tag) -> bool:
    """The car came into ``block`` under a run of the leading cab, which has not gone on over the boundary there."""
    if car not in system.track.under or block not in system.track.under[car]:
        return False
    run = system.track.under[car][block]
    return (
        run.route in site.layout.routes
        and its_front_leads(site, system, run)
        and not the_head_went_on(site, system, run, block, left, entered)
    )


def lies_at_a_miss(site: Site, system: System, train: Train, tag: Tag) -> bool:
    """The head of a train has passed this tag unread, or the other of its boundary and read neither; that is awaited.

    Where the head has read the nearer tag of a boundary and missed the farther, its tail comes to the nearer before.
    """
    return any(
        other == train
        and (
            missed == tag
            or (tag in site.ground.laid_leaves.get(missed, {}) and not read_last_before(site, system, train, missed))
        )
        for other, missed in system.track.unread
    )


def read_last_before(site: Site, system: System, train: Train, missed: Tag) -> bool:
    """What the head of a train has read last is the other tag of the boundary that this one lies at."""
    return train in system.track.last_read and system.track.last_read[train] == site.layout.partner.get(missed)


def is_overdue_first(is_unread: bool, line: ThroughLine) -> bool:
    """Where a tag that the head has passed unread is not overdue yet, the line does not fit (T2, T5)."""
    return not is_unread or not line.fits


def only_the_last_speaks(line: ThroughLine, is_last: bool) -> bool:
    """Where line, split and spacing all say whole, the antenna that speaks for the tail is the last one (T3, T13)."""
    return not (line.answers and line.is_intact and line.fits) or is_last
