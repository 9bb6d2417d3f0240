"""Lemmas on where trains are and can be led: each stretch of track is one train's."""

from __future__ import annotations

from kernel.names import Stage
from models.world.evidence import as_written
from models.world.state import Site, System
from models.world.truth import read_last_before, stands_as_it_says, stands_within
from proofs.invariants.vocabulary import could_be_taken, genuine, reaches, told


def a_train_rolls_only_under_a_permit(site: Site, system: System) -> bool:
    """Runs that a train rolls, slips or has moved under were permitted; only a rolling train leaves a block (T4)."""
    return (
        all(run in system.radio.permits for run in system.track.rolling)
        and all(run in system.track.rolling for run in system.track.slipping)
        and all(run in system.track.rolling for run, _block in system.track.leavable)
        and all(
            run in system.track.slipping
            or run.route not in site.layout.way
            or site.layout.way[run.route].get(block) not in site.layout.overlap[run.route]
            for run, block in system.track.leavable
        )
        and all(run in system.radio.permits for run in system.track.run_into)
    )


def a_car_came_under_a_run_of_its_train(site: Site, system: System) -> bool:
    """A car came into its block under a run of its train: beyond the start of it, or standing there (T4)."""
    return all(
        run.train == site.formation.train_of.get(car)
        and (
            run.route not in site.layout.routes
            or (
                run in system.track.run_into
                and block in site.layout.claims[run.route]
                and block != site.layout.start[run.route]
            )
        )
        for car in system.track.under
        for block, run in system.track.under[car].items()
    )


def a_reachable_block_is_held(site: Site, system: System) -> bool:
    """Where an accounted train can be led, the centre holds the block for that run (T4)."""
    return all(
        run in system.centre.claimed.get(block, frozenset())
        for run in system.radio.permits
        if run.route in site.layout.routes and run.train in system.centre.accounted
        for block in site.layout.claims[run.route]
        if reaches(site, system, run, block)
    )


def reach_is_exclusive(site: Site, system: System) -> bool:
    """No block can be reached by two trains, and none that can be reached holds a car of another (T9)."""
    return all(
        not reaches(site, system, other, block) or run.train == other.train
        for run in system.radio.permits
        if run.route in site.layout.routes
        for block in site.layout.claims[run.route]
        if reaches(site, system, run, block)
        for other in system.radio.permits
    ) and all(
        block not in system.track.at[car] or run.train == site.formation.train_of.get(car)
        for run in system.radio.permits
        if run.route in site.layout.routes
        for block in site.layout.claims[run.route]
        if reaches(site, system, run, block)
        for car in system.track.at
    )


def reach_is_clear_of_fouling(site: Site, system: System) -> bool:
    """Neither can blocks that foul each other be reached by two trains, or hold another's car (T9)."""
    return all(
        not reaches(site, system, other, beside) or run.train == other.train
        for run in system.radio.permits
        if run.route in site.layout.routes
        for block in site.layout.claims[run.route]
        if reaches(site, system, run, block)
        for beside in site.layout.fouls.get(block, frozenset())
        for other in system.radio.permits
    ) and all(
        beside not in system.track.at[car] or run.train == site.formation.train_of.get(car)
        for run in system.radio.permits
        if run.route in site.layout.routes
        for block in site.layout.claims[run.route]
        if reaches(site, system, run, block)
        for beside in site.layout.fouls.get(block, frozenset())
        for car in system.track.at
    )


def a_held_block_is_closed_to_others(site: Site, system: System) -> bool:
    """What the centre holds for a train, no other that is accounted for can be led into, or is in (T9)."""
    return all(
        not reaches(site, system, other, block) or run.train == other.train
        for block in system.centre.claimed
        for run in system.centre.claimed[block]
        for other in system.radio.permits
        if other.train in system.centre.accounted
    ) and all(
        block not in system.track.at[car] or run.train == site.formation.train_of.get(car)
        for block in system.centre.claimed
        for run in system.centre.claimed[block]
        for car in system.track.at
        if site.formation.train_of.get(car) in system.centre.accounted
    )


def a_held_block_is_clear_of_fouling(site: Site, system: System) -> bool:
    """The same for the blocks that foul it (T9)."""
    return all(
        not reaches(site, system, other, beside) or run.train == other.train
        for block in system.centre.claimed
        for run in system.centre.claimed[block]
        for beside in site.layout.fouls.get(block, frozenset())
        for other in system.radio.permits
        if other.train in system.centre.accounted
    ) and all(
        beside not in system.track.at[car] or run.train == site.formation.train_of.get(car)
        for block in system.centre.claimed
        for run in system.centre.claimed[block]
        for beside in site.layout.fouls.get(block, frozenset())
        for car in system.track.at
        if site.formation.train_of.get(car) in system.centre.accounted
    )


def a_reported_block_is_left_by_all_cars(site: Site, system: System) -> bool:
    """Where the tail has read the genuine pair of a block, no car is that came there under this run (T2, T6)."""
    return (
        all(
            block not in system.track.at.get(car, frozenset())
            or system.track.under.get(car, {}).get(block) != run
            or not genuine(site, block, left, entered)
            for run, block, left, entered in system.radio.tail_reports
            for car in system.track.at
        )
        and all(
            not genuine(site, block, evidence.left, evidence.entered)
            or block not in system.track.at.get(car, frozenset())
            or system.track.under.get(car, {}).get(block) != run
            for train in system.units
            for run, order in system.units[train].orders.items()
            for block, evidence in order.left.items()
            for car in system.track.at
        )
        and all(
            block not in system.track.at.get(car, frozenset()) or system.track.under.get(car, {}).get(block) != run
            for run, block in system.track.behind
            for car in system.track.at
        )
    )


def a_unit_remembers_what_it_left(site: Site, system: System) -> bool:
    """In one life a unit forgets no block its tail has left, and what it has left or reported is behind it (T2, T7)."""
    return (
        all(
            run.train in system.units
            and (
                run.life < system.units[run.train].life
                or (
                    run.life == system.units[run.train].life
                    and run in system.units[run.train].orders
                    and block in system.units[run.train].orders[run].left
                )
            )
            for run, block in system.track.behind
        )
        and all(
            not as_written(site, evidence.left, evidence.entered) or (run, block) in system.track.behind
            for train in system.units
            for run, order in system.units[train].orders.items()
            for block, evidence in order.left.items()
        )
        and all(
            (run, block) in system.track.behind or not genuine(site, block, left, entered)
            for run, block, left, entered in system.radio.tail_reports
        )
    )


def a_head_that_read_a_tag_was_there(site: Site, system: System) -> bool:
    """Where a unit has noted that its head entered a block under a run, it has (T2)."""
    return all(
        run.route not in site.layout.routes or (run, block) in system.track.entered
        for train in system.units
        for run, order in system.units[train].orders.items()
        for block in order.entered
    )


def a_run_not_yet_begun_expects_its_first_tags(site: Site, system: System) -> bool:
    """Until a run has begun its unit expects the tags at the end of its start block, the nearer one first (T5)."""
    return all(
        order.tag_list is None
        or order.begun
        or order.expected is None
        or order.expected == site.lists.first_tag.get(order.tag_list)
        or (
            order.tag_list in site.lists.first_tag
            and order.tag_list in site.lists.tag_after
            and order.expected == site.lists.tag_after[order.tag_list].get(site.lists.first_tag[order.tag_list])
        )
        for train in system.units
        for _run, order in system.units[train].orders.items()
    )


def a_run_that_has_begun_is_led_by_its_front(site: Site, system: System) -> bool:
    """A run of a route begins with the cab leading that leads in it, before a block is entered under it (T2, T5)."""
    return all(
        run.route not in site.layout.routes
        or (not order.begun and not any(True for _ in order.entered))
        or (
            order.begun
            and run in system.track.begun
            and run in site.formation.front
            and order.led_by == site.formation.front[run]
        )
        for train in system.units
        for run, order in system.units[train].orders.items()
    )


def a_unit_knows_what_its_head_read_last(site: Site, system: System) -> bool:
    """While its loop is closed, what a unit holds for the head's last tag was read last (T5)."""
    return all(
        unit.head_tag is None
        or unit.loop_open
        or (train in system.track.last_read and system.track.last_read[train] == unit.head_tag)
        for train, unit in system.units.items()
    )


def what_is_behind_was_entered(site: Site, system: System) -> bool:
    """A tail leaves for a run only a block that the train began in, or that its head has entered under it (T2, T6)."""
    return all(
        run.route not in site.layout.routes
        or block == site.layout.start[run.route]
        or (run, block) in system.track.entered
        for run, block in system.track.behind
    )


def what_is_behind_is_left_once(site: Site, system: System) -> bool:
    """Out of a block that its tail has left for a run no train is let again under that run (T2, T6)."""
    return all(
        (run, block) not in system.track.leavable
        or (run, block) in system.track.gone
        or run not in site.formation.front
        or system.track.facing.get(run.train) != site.formation.front[run]
        for run, block in system.track.behind
    )


def a_unit_knows_which_cab_leads(site: Site, system: System) -> bool:
    """A unit takes no other cab for the head than the one that leads, and has a tail only if one does (T2)."""
    return all(
        (unit.leading is None or system.track.facing.get(train) == unit.leading)
        and (unit.leading is not None or (unit.head_tag is None and unit.tail_read is None))
        for train, unit in system.units.items()
    )


def the_tails_last_read_was_passed_last(site: Site, system: System) -> bool:
    """What a unit with a closed loop holds of the tail is of a tag passed since the ends were changed (T2, T6)."""
    return all(
        unit.tail_read is None
        or unit.loop_open
        or any(
            other == train
            and missed in (unit.tail_read.tag, site.layout.partner.get(unit.tail_read.tag))
            and not read_last_before(site, system, train, missed)
            for other, missed in system.track.unread
        )
        or site.records.record.get(unit.tail_read.tag) != unit.tail_read.record
        or (train, unit.tail_read.tag) in system.track.passed
        for train, unit in system.units.items()
    )


def a_train_astray_has_an_open_loop(site: Site, system: System) -> bool:
    """In the life in which a tag was wrong, missing or late, the unit's second loop is open (T5)."""
    return all(
        train in system.units
        and life <= system.units[train].life
        and (life != system.units[train].life or system.units[train].loop_open)
        for train, life in system.track.astray
    )


def a_train_that_told_has_no_authority(site: Site, system: System) -> bool:
    """While the word of a standing train is in the air, no run was offered to that life and none rolls (T8)."""
    return all(
        (train in system.units and life <= system.units[train].life)
        and all(run.train != train or run.life < life for run in system.radio.offers)
        and all(run.train != train for run in system.track.rolling)
        for train, life, epoch in system.radio.standings
        if told(system, train, life, epoch)
    ) and all(
        (train in system.units and life <= system.units[train].life)
        and all(run.train != train or run.life < life for run in system.radio.offers)
        and all(run.train != train for run in system.track.rolling)
        for train, life, epoch in system.radio.confirmed_statements
        if told(system, train, life, epoch)
    )


def a_train_that_told_stands_there(site: Site, system: System) -> bool:
    """While the word of a standing train is in the air, it is at rest, and where it said, if that is a place (T8)."""
    return all(
        stands_as_it_says(site, system, train, blocks)
        for (train, life, epoch), blocks in system.radio.standings.items()
        if told(system, train, life, epoch)
    )


def one_of_two_persons_is_right(site: Site, system: System) -> bool:
    """Until a train taken over is accounted for, one of the two has named only places that it is at rest in (T8)."""
    return (
        all(
            (train, life, epoch) in system.track.first_erred or stands_within(site, system, train, blocks)
            for (train, life, epoch), blocks in system.radio.statements.items()
            if could_be_taken(system, train, life, epoch)
        )
        and all(
            (train, said.life, system.centre.epoch) in system.radio.statements
            and (
                (train, said.life, system.centre.epoch) in system.track.first_erred
                or not could_be_taken(system, train, said.life, system.centre.epoch)
                or stands_within(site, system, train, said.blocks)
            )
            for train, said in system.centre.statements.items()
        )
        and all(
            (train, life, epoch) in system.track.second_erred or stands_within(site, system, train, blocks)
            for (train, life, epoch), blocks in system.radio.confirmed_statements.items()
            if could_be_taken(system, train, life, epoch)
        )
        and all(key not in system.track.second_erred for key in system.track.first_erred)
        and all(key in system.radio.statements for key in system.track.first_erred)
        and all(key in system.radio.statements for key in system.track.second_erred)
    )


def a_unit_that_answered_stands_there(site: Site, system: System) -> bool:
    """A unit that answered this epoch and was not yet taken at its word rests where it said, offered nothing (T8)."""
    return all(
        unit.answered != system.centre.epoch
        or (train in system.centre.accounted and unit.life <= system.centre.accounted[train])
        or (
            stands_as_it_says(site, system, train, unit.standing_in)
            and all(run.train != train or run.life < unit.life for run in system.radio.offers)
        )
        for train, unit in system.units.items()
    )


def what_an_isolated_unit_shows_was_stated(site: Site, system: System) -> bool:
    """The first person has stated where the train is as soon as he had isolated its unit (T8)."""
    return all(
        unit.isolated_in is None or (train, unit.life, unit.isolated_in) in system.radio.statements
        for train, unit in system.units.items()
    )


def a_unit_taken_over_was_offered_nothing(site: Site, system: System) -> bool:
    """A life that began with a statement in this epoch was offered nothing before the centre accounted for it (T8)."""
    return all(
        epoch != system.centre.epoch
        or (train in system.centre.accounted and life <= system.centre.accounted[train])
        or all(run.train != train or run.life < life for run in system.radio.offers)
        for train, life, epoch in system.radio.statements
    )


def an_unset_run_has_not_been_entered(site: Site, system: System) -> bool:
    """No train rolls or has moved under a run that is not yet set (T4)."""
    return all(
        (grant.stage != Stage.RESERVED and grant.stage != Stage.OFFERED)
        or (run not in system.radio.permits and run not in system.track.run_into)
        for run, grant in system.centre.runs.items()
    )
