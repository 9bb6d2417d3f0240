"""What trains and people do: each transition says why nature does no more than that."""

from __future__ import annotations

from dataclasses import replace

from kernel import change_of_ends, standing
from kernel.authority import may_leave, may_proceed
from kernel.names import Block, Cab, Car, Epoch, Run, Tag, Train, UnitLife
from models.world.assumptions import (
    a_train_obeys_its_authority,
    a_train_runs_forward_along_its_run,
    rails_lead,
    two_persons_do_not_both_err,
)
from models.world.evidence import awaited_by_others, awaited_in, unpassed
from models.world.state import Site, System
from models.world.truth import read_last_before, stands_within


def start_rolling(site: Site, system: System, run: Run) -> System:
    """The brake takes the end of authority that the unit works out from its list: the train may run up to it.

    Without authority the unit holds the brake, so no train begins to roll.  That the brake does so is proved at the
    joint (`a_brake_control_does_what_is_assumed_of_it`, `a_train_that_no_run_lets_move_is_braked`).
    """
    if run.train not in system.units or not may_proceed(system.units[run.train], run):
        return system
    tag_list = system.units[run.train].orders[run].tag_list
    if tag_list is None or tag_list not in site.lists.way:
        return system
    return replace(
        system,
        track=replace(
            system.track,
            rolling=system.track.rolling | {run},
            leavable=system.track.leavable
            | frozenset(
                (run, block)
                for block in site.lists.way[tag_list]
                if may_leave(site.lists, system.units[run.train], run, block)
            ),
        ),
    )


def overrun(site: Site, system: System, run: Run) -> System:
    """A train brakes too late and slips along its way, as far as into its overlap, which is laid out for no more (T9).

    It comes to its destination under way: a train that its brake has held there does not, as its run lets it move
    no more.
    """
    if run not in system.track.rolling or run in system.track.stood:
        return system
    if run.route not in site.layout.way or run.route not in site.layout.overlap:
        return system
    return replace(
        system,
        track=replace(
            system.track,
            slipping=system.track.slipping | {run},
            leavable=system.track.leavable
            | frozenset(
                (run, block)
                for block in site.layout.way[run.route]
                if any(
                    block in system.track.at[car] and system.track.under.get(car, {}).get(block) == run
                    for car in system.track.at
                )
            ),
        ),
    )


def come_to_rest(site: Site, system: System, run: Run) -> System:
    """A train comes to rest at any moment: brakes, obstacles and drivers are free to."""
    return replace(
        system,
        track=replace(
            system.track,
            rolling=system.track.rolling - {run},
            slipping=system.track.slipping - {run},
            leavable=frozenset((other, block) for other, block in system.track.leavable if other != run),
        ),
    )


def change_ends(site: Site, system: System, train: Train, cab: Cab) -> System:
    """The driver of a train at rest chooses the direction, or chooses it again after his unit has restarted (T2)."""
    if train not in system.units or any(run.train == train for run in system.track.rolling):
        return system
    told = replace(
        system, units=system.units | {train: change_of_ends.change_ends(site.lists, system.units[train], cab)}
    )
    if system.track.facing.get(train) == cab:
        return told
    return replace(
        told,
        track=replace(
            system.track,
            facing=system.track.facing | {train: cab},
            last_read={other: tag for other, tag in system.track.last_read.items() if other != train},
            passed=frozenset((other, tag) for other, tag in system.track.passed if other != train),
            unread=awaited_by_others(system, train),
        ),
    )


def head_misses(site: Site, system: System, train: Train, tag: Tag) -> System:
    """A head passes a tag and its antenna reads nothing (T5, T16).

    Where it has just read the other tag of the boundary it has come to that already.
    """
    comes_to_it = not read_last_before(site, system, train, tag)
    return replace(
        system,
        track=replace(
            system.track,
            passed=unpassed(site, system, train, tag) if comes_to_it else system.track.passed,
            unread=system.track.unread | {(train, tag)},
        ),
    )


def car_moves(site: Site, system: System, run: Run, car: Car, block: Block, target: Block) -> System:
    """A car reaches from a block it is in into the next, where track and points lead it.

    Cars are pulled or pushed by their own train and go forward in the direction of the run; what
    lets the train out of a block is its unit's authority, never the block it gets into.
    """
    if site.formation.train_of.get(car) != run.train or block not in system.track.at.get(car, frozenset()):
        return system
    if not rails_lead(site, system, run.route, block, target):
        return system
    if not a_train_obeys_its_authority(site, system, run, block):
        return system
    if not a_train_runs_forward_along_its_run(site, system, run, block, target):
        return system
    return replace(
        system,
        track=replace(
            system.track,
            at=system.track.at | {car: system.track.at.get(car, frozenset()) | {target}},
            under=system.track.under | {car: system.track.under.get(car, {}) | {target: run}},
            run_into=system.track.run_into | {run},
        ),
    )


def car_follows(site: Site, system: System, car: Car, other: Car, target: Block) -> System:
    """A car comes into a block that another car of its train is in, by whatever rails lead there.

    It is pulled or pushed, up to the end that the brake holds, and comes under the run of the car it follows.
    """
    train = site.formation.train_of.get(car)
    if train is None or site.formation.train_of.get(other) != train:
        return system
    if target not in system.track.at.get(other, frozenset()):
        return system
    run_ahead = system.track.under.get(other, {}).get(target)
    if run_ahead is None:
        return system
    return replace(
        system,
        track=replace(
            system.track,
            at=system.track.at | {car: system.track.at.get(car, frozenset()) | {target}},
            under=system.track.under | {car: system.track.under.get(car, {}) | {target: run_ahead}},
        ),
    )


def car_leaves(site: Site, system: System, car: Car, block: Block) -> System:
    """A car's last axle leaves a block; whether any antenna reads anything there is another matter."""
    if car not in system.track.at:
        return system
    return replace(
        system,
        track=replace(system.track, at=system.track.at | {car: system.track.at[car] - {block}}),
    )


def part(site: Site, system: System, train: Train) -> System:
    """A coupling breaks and some cars stay behind (T3, P5)."""
    return replace(system, track=replace(system.track, parted=system.track.parted | {train}))


def take_over(
    site: Site, system: System, train: Train, epoch: Epoch, life: UnitLife, blocks: frozenset[Block]
) -> System:
    """The first person isolates a unit at rest, in a new life, and states, rightly or not, where the train is (T8)."""
    if train not in system.units or epoch not in system.radio.challenges:
        return system
    unit = standing.isolate(system.units[train], epoch, life)
    if unit.life == system.units[train].life:
        return system
    isolated = replace(
        system,
        units=system.units | {train: unit},
        track=replace(system.track, unread=awaited_in(system, train, unit)),
    )
    return _stated(isolated, site, train, (train, life, epoch), blocks)


def correct_statement(
    site: Site, system: System, train: Train, epoch: Epoch, life: UnitLife, blocks: frozenset[Block]
) -> System:
    """The first person states a place again, of what the unit shows, maybe after a restart of the centre (T8).

    What he stated before may have been taken down by then.
    """
    if train not in system.units or not standing.shows(system.units[train], epoch, life):
        return system
    if not two_persons_do_not_both_err(site, system, train, blocks, (train, life, epoch), system.track.second_erred):
        return system
    return _stated(system, site, train, (train, life, epoch), blocks)


def _stated(
    system: System, site: Site, train: Train, key: tuple[Train, UnitLife, Epoch], blocks: frozenset[Block]
) -> System:
    """The first person has stated a place.  History: whether he has erred."""
    erred = system.track.first_erred
    return replace(
        system,
        radio=replace(system.radio, statements=system.radio.statements | {key: blocks}),
        track=replace(system.track, first_erred=erred if stands_within(site, system, train, blocks) else erred | {key}),
    )


def confirm_statement(
    site: Site, system: System, train: Train, epoch: Epoch, life: UnitLife, blocks: frozenset[Block]
) -> System:
    """The second person looks for himself and states, rightly or not, where the train is (T8).

    History: whether he has erred.
    """
    if (train, life, epoch) not in system.radio.statements:
        return system
    if not two_persons_do_not_both_err(site, system, train, blocks, (train, life, epoch), system.track.first_erred):
        return system
    confirmed = system.radio.confirmed_statements | {(train, life, epoch): blocks}
    erred = system.track.second_erred
    return replace(
        system,
        radio=replace(system.radio, confirmed_statements=confirmed),
        track=replace(
            system.track,
            second_erred=erred if stands_within(site, system, train, blocks) else erred | {(train, life, epoch)},
        ),
    )
