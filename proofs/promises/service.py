"""From the permit to the destination, and to the tail: a head gets on by its tags, its tail after it (T2, T4, T9)."""

from __future__ import annotations

from kernel.names import Block, Cab, Car, Read, Run, Tag, Train
from kernel.standstill import Standstill, ThroughLine
from kernel.unit import Order
from models.world import nature, on_board
from models.world.assumptions import (
    a_healthy_line_reaches_the_tail,
    a_missed_tag_is_overdue_before_the_tail_comes,
    a_pair_passed_in_order_proves_the_exit,
    a_run_is_led_by_its_front,
    a_tag_is_read_where_it_lies,
    a_train_within_its_destination_is_not_beyond,
    rails_lead,
)
from models.world.state import Site, System
from models.world.truth import says_it_is_held_between
from proofs.promise import Link, Promise
from proofs.promises.first_loop import keeps_the_centres_list
from proofs.promises.vocabulary import has_no_authority_left, order_of


def a_permitted_train_is_let_out_of_its_block(site: Site, system: System, run: Run, block: Block) -> bool:
    """The brake of a permitted train lets it out of each block of its way but the last, and in no overlap (T4, T9)."""
    return (run, block) in system.track.leavable


def it_may_not_or_need_not_leave(site: Site, system: System, run: Run, block: Block) -> bool:
    """The run gives no authority any more, or the tail has left that block or the next one.

    It gives none once it is asked back before it is begun, or given back, once the train has told that it stands in
    its destination or a later one has begun, the second loop is open or the unit restarts.
    """
    order = order_of(system, run)
    return (
        has_no_authority_left(system, run)
        or order is None
        or order.stopped
        or block in order.left
        or (run.route in site.layout.way and site.layout.way[run.route].get(block) in order.left)
    )


def its_way_goes_on(site: Site, system: System, run: Run, block: Block) -> bool:
    """The train is permitted, and its way leads on from the block into another one that is not its overlap."""
    order = order_of(system, run)
    return (
        keeps_the_centres_list(site, system, run)
        and order is not None
        and order.permitted
        and run.route in site.layout.routes
        and block in site.layout.way[run.route]
        and site.layout.way[run.route][block] not in site.layout.overlap[run.route]
    )


def a_head_gets_into_the_next_block(
    site: Site, system: System, run: Run, car: Car, block: Block, target: Block
) -> bool:
    """The car that leads gets into the next block of its way (T4)."""
    return target in system.track.at.get(car, frozenset())


def it_rests_or_has_left(site: Site, system: System, run: Run, car: Car, block: Block, target: Block) -> bool:
    """The train comes to rest, and is let out anew; or under this run it was in the next block, or is in this no more.

    A car may leave a block at any moment: nobody reckons with where it is then.
    """
    return (
        (run, block) not in system.track.leavable
        or block not in system.track.at.get(car, frozenset())
        or (run, target) in system.track.entered
        or (run, block) in system.track.gone
    )


def its_brake_lets_it_out(site: Site, system: System, run: Run, car: Car, block: Block, target: Block) -> bool:
    """The car that leads is in the block, and its brake lets it out of that."""
    return (
        run in site.formation.front
        and site.formation.carried_by.get(site.formation.front[run]) == car
        and site.formation.train_of.get(car) == run.train
        and system.track.facing.get(run.train) == site.formation.front[run]
        and run.route in site.layout.way
        and site.layout.way[run.route].get(block) == target
        and (run, block) in system.track.leavable
        and block in system.track.at.get(car, frozenset())
    )


def the_points_lie_for_it(site: Site, system: System, run: Run, block: Block, target: Block) -> bool:
    """Track and points lead along the way."""
    return rails_lead(site, system, run.route, block, target)


def a_head_is_known_beyond_the_boundary(site: Site, system: System, run: Run, left: Tag, entered: Tag) -> bool:
    """The unit knows that its head is in the next block of its way, by both tags of the boundary (T2, T5)."""
    order = order_of(system, run)
    return order is not None and entered in site.layout.tag_in and site.layout.tag_in[entered] in order.entered


def it_runs_under_this_run_no_more(site: Site, system: System, run: Run, left: Tag, entered: Tag) -> bool:
    """The run gives no authority any more, or the driver changes ends; or its tags are read for another run.

    That is: its first tag is the last one of a run that the train is on; or another tag comes after its first one.
    """
    unit, order = system.units.get(run.train), order_of(system, run)
    return (
        has_no_authority_left(system, run)
        or unit is None
        or order is None
        or run not in site.formation.front
        or unit.leading != site.formation.front[run]
        or unit.head_tag == order.expected
        or (order.expected == entered and not order.begun and unit.head_tag != left)
    )


def its_head_comes_to_the_boundary(site: Site, system: System, run: Run, left: Tag, entered: Tag) -> bool:
    """The unit expects the nearer tag of a boundary of its way."""
    order = order_of(system, run)
    return (
        is_a_boundary_of_its_way(site, run, left, entered)
        and is_permitted_to(site, system, run, order)
        and order is not None
        and order.expected == left
        and (order.begun or site.layout.first_tag.get(run.route) == left)
    )


def the_head_reads_the_nearer_tag(
    site: Site, system: System, run: Run, left: Tag, train: Train, cab: Cab, tag: Tag, in_window: bool
) -> bool:
    """The cab that leads reads it in its window, where it lies; no run that the train is on ends with it."""
    unit, order = system.units.get(train), order_of(system, run)
    return (
        tag == left
        and the_head_reads_it(site, system, run, train, cab, tag, in_window)
        and unit is not None
        and order is not None
        and (
            order.led_by is not None
            or all(other.led_by is None or other.expected != left for _run, other in unit.orders.items())
        )
    )


def its_head_is_over_the_boundary(site: Site, system: System, run: Run, left: Tag, entered: Tag) -> bool:
    """The unit has read it, and expects the farther one."""
    unit, order = system.units.get(run.train), order_of(system, run)
    return (
        is_a_boundary_of_its_way(site, run, left, entered)
        and is_permitted_to(site, system, run, order)
        and unit is not None
        and order is not None
        and order.expected == entered
        and (order.begun or (unit.head_tag == left and site.layout.first_tag.get(run.route) == left))
    )


def the_head_reads_the_farther_tag(
    site: Site, system: System, run: Run, entered: Tag, train: Train, cab: Cab, tag: Tag, in_window: bool
) -> bool:
    """The cab that led there reads that in its window, where it lies."""
    order = order_of(system, run)
    return (
        tag == entered
        and the_head_reads_it(site, system, run, train, cab, tag, in_window)
        and order is not None
        and order.led_by == cab
    )


def is_a_boundary_of_its_way(site: Site, run: Run, left: Tag, entered: Tag) -> bool:
    """Those tags come one after the other on the route, the second in a block of it beyond its start."""
    return (
        run.route in site.layout.routes
        and run.route in site.layout.tag_after
        and site.layout.tag_after[run.route].get(left) == entered
        and site.layout.first_tag.get(run.route) != entered
        and entered in site.layout.tag_in
        and site.layout.tag_in[entered] in site.layout.claims[run.route]
        and site.layout.tag_in[entered] != site.layout.start[run.route]
    )


def is_permitted_to(site: Site, system: System, run: Run, order: Order | None) -> bool:
    """The run is permitted, and no other cab has led in it than the one that is its front."""
    return (
        keeps_the_centres_list(site, system, run)
        and order is not None
        and order.permitted
        and run in site.formation.front
        and (order.led_by is None or order.led_by == site.formation.front[run])
    )


def the_head_reads_it(site: Site, system: System, run: Run, train: Train, cab: Cab, tag: Tag, in_window: bool) -> bool:
    """The run's front reads a tag in its window, and nature lets it."""
    return (
        train == run.train
        and in_window
        and run in site.formation.front
        and cab == site.formation.front[run]
        and a_tag_is_read_where_it_lies(site, system, cab, tag)
        and a_run_is_led_by_its_front(site, system, train, cab, tag)
    )


def a_train_in_its_destination_tells_it(site: Site, system: System, run: Run) -> bool:
    """The unit tells that the train stands in the destination of the run (T9)."""
    order = order_of(system, run)
    return order is not None and order.stopped


def it_is_led_by_that_run_no_more(site: Site, system: System, run: Run) -> bool:
    """The run gives no authority any more, or the driver changes ends."""
    unit, order = system.units.get(run.train), order_of(system, run)
    return has_no_authority_left(system, run) or unit is None or order is None or order.led_by != unit.leading


def its_head_has_arrived(site: Site, system: System, run: Run) -> bool:
    """The head has come under this run to where its way goes on into the overlap alone, or not at all."""
    order = order_of(system, run)
    return (
        keeps_the_centres_list(site, system, run)
        and order is not None
        and order.permitted
        and run.route in site.layout.routes
        and any(
            block not in site.layout.way[run.route]
            or site.layout.way[run.route][block] in site.layout.overlap[run.route]
            for block in order.entered
        )
    )


def it_stands_there(site: Site, system: System, run: Run, at: Standstill, begin_mm: int, end_mm: int) -> bool:
    """The train stands within its destination, by the odometry."""
    return says_it_is_held_between(at, begin_mm, end_mm) and a_train_within_its_destination_is_not_beyond(
        site, system, run, at, begin_mm, end_mm
    )


def a_tail_is_known_at_the_boundary(site: Site, system: System, run: Run, left: Read) -> bool:
    """The unit knows that its tail is at the end of a block (T2)."""
    unit = system.units.get(run.train)
    return unit is not None and unit.tail_read == left


def its_tail_is_not_followed_there(site: Site, system: System, run: Run, left: Read) -> bool:
    """The second loop is open, the unit restarts, the driver changes ends, or the train is in that block no more."""
    unit = system.units.get(run.train)
    return (
        unit is None
        or unit.life != run.life
        or unit.loop_open
        or run not in site.formation.front
        or unit.leading != site.formation.front[run]
        or site.layout.tag_in.get(left.tag) not in unit.occupied
    )


def its_tail_comes_to_the_boundary(site: Site, system: System, run: Run, left: Read) -> bool:
    """The train is in the block of that tag."""
    return left.tag in site.layout.tag_in


def the_tail_reads_the_nearer_tag(
    site: Site, system: System, run: Run, left: Read, car: Car, cab: Cab, line: ThroughLine, read: Read
) -> bool:
    """The tail's antenna reads it over a healthy line."""
    return read == left and the_tail_reads_it(site, system, run, car, cab, line, read)


def a_tail_is_known_beyond_the_boundary(site: Site, system: System, run: Run, left: Read, entered: Read) -> bool:
    """The unit knows that its tail has left a block which its head went out of under this run, by both tags (T2, T6).

    What it notes there the tail has read in this order, however late it is told.
    """
    order = order_of(system, run)
    return order is not None and has_noted(site, order, left, entered)


def its_tail_is_not_followed_over(site: Site, system: System, run: Run, left: Read, entered: Read) -> bool:
    """The second loop is open, the unit restarts, the driver changes ends, or the tail's last read is another one.

    That is: it reads another tag, or is not reached meanwhile, or its head passes that boundary again.
    """
    unit, order = system.units.get(run.train), order_of(system, run)
    return unit is None or order is None or unit.loop_open or unit.leading != order.led_by or unit.tail_read != left


def has_noted(site: Site, order: Order, left: Read, entered: Read) -> bool:
    """The unit keeps both reads for the block that the first one is planned in."""
    return (
        left.tag in site.layout.tag_in
        and site.layout.tag_in[left.tag] in order.left
        and order.left[site.layout.tag_in[left.tag]].left == left
        and order.left[site.layout.tag_in[left.tag]].entered == entered
    )


def its_tail_is_over_the_boundary(site: Site, system: System, run: Run, left: Read, entered: Read) -> bool:
    """The tail has read the nearer tag of a boundary that its head went over, and the train is in both blocks."""
    unit, order = system.units.get(run.train), order_of(system, run)
    return (
        unit is not None
        and order is not None
        and keeps_the_centres_list(site, system, run)
        and order.begun
        and site.layout.partner.get(left.tag) == entered.tag
        and left.tag in site.layout.tag_in
        and entered.tag in site.layout.tag_in
        and site.layout.tag_in[entered.tag] in unit.occupied
        and went_over(site, run, order, site.layout.tag_in[left.tag], left.tag, entered.tag)
    )


def went_over(site: Site, run: Run, order: Order, block: Block, left: Tag, entered: Tag) -> bool:
    """By its own tags the head was in the block under this run, and went on over that boundary."""
    return (
        run.route in site.layout.routes
        and (block in order.entered or site.layout.start[run.route] == block)
        and block in site.layout.way[run.route]
        and site.layout.way[run.route][block] in order.entered
        and run.route in site.layout.tag_after
        and site.layout.tag_after[run.route].get(left) == entered
    )


def the_tail_reads_the_farther_tag(
    site: Site, system: System, run: Run, entered: Read, car: Car, cab: Cab, line: ThroughLine, read: Read
) -> bool:
    """The tail's antenna reads that over a healthy line."""
    return read == entered and the_tail_reads_it(site, system, run, car, cab, line, read)


def the_tail_reads_it(site: Site, system: System, run: Run, car: Car, cab: Cab, line: ThroughLine, read: Read) -> bool:
    """An antenna that does not lead reads, over a line that answers, is intact and fits; and nature lets it."""
    return (
        line.answers
        and line.is_intact
        and line.fits
        and site.formation.cab.get(car) == cab
        and site.formation.train_of.get(car) == run.train
        and system.track.facing.get(run.train) != cab
        and a_healthy_line_reaches_the_tail(site, system, run, car, cab, line)
        and a_missed_tag_is_overdue_before_the_tail_comes(site, system, run.train, read.tag, line)
        and a_pair_passed_in_order_proves_the_exit(site, system, run, car, read)
    )


PROMISES = (
    Promise(
        (Link(its_way_goes_on, nature.start_rolling),),
        a_permitted_train_is_let_out_of_its_block,
        it_may_not_or_need_not_leave,
    ),
    Promise(
        (Link(its_brake_lets_it_out, nature.car_moves, the_points_lie_for_it),),
        a_head_gets_into_the_next_block,
        it_rests_or_has_left,
    ),
    Promise(
        (
            Link(its_head_comes_to_the_boundary, on_board.head_reads, the_head_reads_the_nearer_tag),
            Link(its_head_is_over_the_boundary, on_board.head_reads, the_head_reads_the_farther_tag),
        ),
        a_head_is_known_beyond_the_boundary,
        it_runs_under_this_run_no_more,
    ),
    Promise(
        (Link(its_head_has_arrived, on_board.note_stopped, it_stands_there),),
        a_train_in_its_destination_tells_it,
        it_is_led_by_that_run_no_more,
    ),
    Promise(
        (Link(its_tail_comes_to_the_boundary, on_board.tail_reads, the_tail_reads_the_nearer_tag),),
        a_tail_is_known_at_the_boundary,
        its_tail_is_not_followed_there,
    ),
    Promise(
        (Link(its_tail_is_over_the_boundary, on_board.tail_reads, the_tail_reads_the_farther_tag),),
        a_tail_is_known_beyond_the_boundary,
        its_tail_is_not_followed_over,
    ),
)
"""In the order in which a train comes to them."""
