"""After a restart everything is found again at last: trains are accounted for, lost blocks and points found (T8)."""

from __future__ import annotations

from kernel.names import Block, Epoch, Point, Run, Train, UnitLife
from kernel.recovery import train_missing
from kernel.standstill import Standstill, ThroughLine
from models.world import at_the_centre, on_board, radio
from models.world.state import Site, System
from models.world.truth import name_a_place, says_it_stays_held, stands_within
from proofs.promise import Link, Promise
from proofs.promises.vocabulary import lives


def a_train_answers(site: Site, system: System, train: Train, epoch: Epoch) -> bool:
    """A unit answers the challenge of an epoch; or the centre restarts (T8)."""
    unit = system.units.get(train)
    return unit is None or unit.answered == epoch or system.centre.epoch != epoch


def the_centre_asks(site: Site, system: System, train: Train, epoch: Epoch) -> bool:
    """The centre is in this epoch, and challenges every train."""
    return system.centre.epoch == epoch


def the_challenge_is_in_the_air(site: Site, system: System, train: Train, epoch: Epoch) -> bool:
    """The challenge was sent."""
    return epoch in system.radio.challenges


def it_can_answer(
    site: Site,
    system: System,
    train: Train,
    life: UnitLife,
    blocks: frozenset[Block],
    at: Standstill,
    line: ThroughLine,
) -> bool:
    """The train stays held at rest until an end is taken, is whole, knows where it is, and begins a new life."""
    unit = system.units.get(train)
    return (
        says_it_stays_held(at)
        and line.answers
        and line.is_intact
        and unit is not None
        and unit.life < life
        and stands_within(site, system, train, blocks)
    )


def a_train_that_answered_is_accounted_for(
    site: Site, system: System, train: Train, life: UnitLife, epoch: Epoch
) -> bool:
    """The centre knows where a train stands that has answered in this life.

    Or in a later one; or the centre restarts, or the unit before its answer is sent (T8).
    """
    known = system.centre.accounted.get(train)
    return (
        (known is not None and life <= known)
        or system.centre.epoch != epoch
        or ((train, life, epoch) not in system.radio.standings and not lives(system, train, life))
    )


def it_has_answered(site: Site, system: System, train: Train, life: UnitLife, epoch: Epoch) -> bool:
    """The unit has answered in this life, and tells it."""
    unit = system.units.get(train)
    return train in site.layout.fleet and unit is not None and unit.life == life and unit.answered == epoch


def its_answer_is_in_the_air(site: Site, system: System, train: Train, life: UnitLife, epoch: Epoch) -> bool:
    """The answer was sent."""
    return train in site.layout.fleet and (train, life, epoch) in system.radio.standings


def it_can_be_taken(site: Site, system: System, train: Train, life: UnitLife, epoch: Epoch, run: Run) -> bool:
    """The run that will stand for it has a new number, and no route; what it names is a place, and no other train's."""
    return (
        run.train == train
        and run.life == life
        and run.route not in site.layout.routes
        and system.centre.newest < run.serial
        and run.serial < site.layout.last_serial
        and name_a_place(site, system.radio.standings[train, life, epoch])
        and is_free_for(site, system, train, system.radio.standings[train, life, epoch])
    )


def is_free_for(site: Site, system: System, train: Train, blocks: frozenset[Block]) -> bool:
    """No block, and none that fouls one, is held for another train, and no point in one is locked for another."""
    return (
        all(held.train == train for block in blocks for held in system.centre.claimed.get(block, frozenset()))
        and all(
            held.train == train
            for block in blocks
            for beside in site.layout.fouls.get(block, frozenset())
            for held in system.centre.claimed.get(beside, frozenset())
        )
        and all(
            held.train == train
            for block in blocks
            for point in site.layout.points_in.get(block, frozenset())
            for held in system.centre.locked.get(point, {})
        )
    )


def a_lost_block_is_found(site: Site, system: System, block: Block) -> bool:
    """A block is lost no more; or a train is missing, since the centre restarted again (T8)."""
    return block not in system.centre.lost_blocks or train_missing(site.layout, system.centre)


def no_train_is_missing(site: Site, system: System, block: Block) -> bool:
    """Every train of the register has told where it stands."""
    return not train_missing(site.layout, system.centre)


def a_lost_point_is_found(site: Site, system: System, point: Point) -> bool:
    """A point is lost no more; or its block is held, or a train is missing (T8, T10)."""
    return (
        point not in system.centre.lost_points
        or train_missing(site.layout, system.centre)
        or point not in site.layout.stands_in
        or any(True for _ in system.centre.claimed.get(site.layout.stands_in[point], frozenset()))
    )


def nobody_stands_over_it(site: Site, system: System, point: Point) -> bool:
    """Every train has told where it stands, and nobody holds the block of the point."""
    return not a_lost_point_is_found(site, system, point)


PROMISES = (
    Promise(
        (
            Link(the_centre_asks, radio.send_challenge),
            Link(the_challenge_is_in_the_air, on_board.answer, it_can_answer),
        ),
        a_train_answers,
    ),
    Promise(
        (
            Link(it_has_answered, radio.send_standing),
            Link(its_answer_is_in_the_air, at_the_centre.note_standing, it_can_be_taken),
        ),
        a_train_that_answered_is_accounted_for,
    ),
    Promise((Link(no_train_is_missing, at_the_centre.recover_block),), a_lost_block_is_found),
    Promise((Link(nobody_stands_over_it, at_the_centre.recover_point),), a_lost_point_is_found),
)
"""In the order in which a restart comes to them."""
