"""Lemmas on the centre's books: serials, stages, claims and locks that belong together."""

from __future__ import annotations

from kernel.names import Stage
from models.world.state import Site, System
from proofs.invariants.vocabulary import at_stage


def every_run_is_counted(site: Site, system: System) -> bool:
    """No run is known anywhere that is newer than the newest serial the centre has granted (T10)."""
    newest = system.centre.newest
    return (
        all(run.serial <= newest for run in system.centre.runs)
        and all(run.serial <= newest for run in system.radio.offers)
        and all(run.serial <= newest for run in system.radio.standing_runs)
        and all(run.serial <= newest for run, _point, _life in system.radio.orders)
        and all(run.serial <= newest for run, _point, _life in system.radio.enquiries)
        and all(run.serial <= newest for run, _block in system.track.behind)
        and all(run.serial <= newest for run, _point, _position in system.radio.confirmed)
        and all(
            terminal.holds is None or terminal.holds.serial <= newest for _point, terminal in system.terminals.items()
        )
        and all(run.serial <= newest for car in system.track.under for _block, run in system.track.under[car].items())
    )


def a_holder_is_an_open_run(site: Site, system: System) -> bool:
    """Blocks and points are held only for runs that the centre knows and that are not over (T8)."""
    return all(
        run in system.centre.runs and not at_stage(system, run, Stage.OVER)
        for block in system.centre.claimed
        for run in system.centre.claimed[block]
    ) and all(
        run in system.centre.runs and not at_stage(system, run, Stage.OVER)
        for point in system.centre.locked
        for run in system.centre.locked[point]
    )


def a_run_stands_or_has_a_route(site: Site, system: System) -> bool:
    """A run of a route never stands for a train at rest, and the other way round (T8)."""
    return all(
        (run.route in site.layout.routes or grant.stage == Stage.STANDING or grant.stage == Stage.OVER)
        and (run.route not in site.layout.routes or grant.stage != Stage.STANDING)
        for run, grant in system.centre.runs.items()
    )


def an_open_run_is_of_the_accounted_life(site: Site, system: System) -> bool:
    """A run that is not over was granted to the life in which its train was last accounted for (T8)."""
    return all(
        grant.stage == Stage.OVER or system.centre.accounted.get(run.train) == run.life
        for run, grant in system.centre.runs.items()
    )


def an_open_run_holds_its_blocks(site: Site, system: System) -> bool:
    """Until it is set a run holds every block of its route; a run of a route holds no other (T4)."""
    return (
        all(
            run in system.centre.claimed.get(block, frozenset())
            for run, grant in system.centre.runs.items()
            if grant.stage == Stage.RESERVED or grant.stage == Stage.OFFERED
            for block in site.layout.claims[run.route]
        )
        and all(
            grant.stage != Stage.RESERVED and grant.stage != Stage.OFFERED
            for run, grant in system.centre.runs.items()
            for block in grant.ended
        )
        and all(
            run.route not in site.layout.routes or block in site.layout.claims[run.route]
            for block in system.centre.claimed
            for run in system.centre.claimed[block]
        )
    )


def a_held_block_holds_its_points(site: Site, system: System) -> bool:
    """While a run holds a block it locks, as its route needs, every point released with it, and no other (T7, T10)."""
    return all(
        run in system.centre.locked.get(point, {})
        for block in system.centre.claimed
        for run in system.centre.claimed[block]
        if run.route in site.layout.routes
        for point in site.layout.needs[run.route]
        if site.layout.released_with[run.route][point] == block
    ) and all(
        run.route not in site.layout.routes
        or (
            site.layout.needs[run.route].get(point) == lies
            and run in system.centre.claimed.get(site.layout.released_with[run.route][point], frozenset())
        )
        for point in system.centre.locked
        for run, lies in system.centre.locked[point].items()
    )


def a_standing_run_locks_only_below_itself(site: Site, system: System) -> bool:
    """A run that stands locks points only in blocks it holds; any point there is locked for it or lost (T8, T10)."""
    return all(
        point in site.layout.points
        and (
            run.route in site.layout.routes
            or run in system.centre.claimed.get(site.layout.stands_in[point], frozenset())
        )
        for point in system.centre.locked
        for run in system.centre.locked[point]
    ) and all(
        run.route in site.layout.routes
        or point in system.centre.lost_points
        or run in system.centre.locked.get(point, {})
        for block in system.centre.claimed
        for run in system.centre.claimed[block]
        for point in site.layout.points_in.get(block, frozenset())
    )


def a_train_stands_under_one_run(site: Site, system: System) -> bool:
    """Of two runs that stand for one train, one is over; and so is any older than the one that stands for it (T8)."""
    return all(
        run == other or run.train != other.train or (beside.stage != Stage.STANDING and run.serial < other.serial)
        for run, grant in system.centre.runs.items()
        if grant.stage == Stage.STANDING
        for other, beside in system.centre.runs.items()
        if beside.stage != Stage.OVER
    )


def while_a_train_is_missing_everything_is_lost(site: Site, system: System) -> bool:
    """Until every train of the register is accounted for, every block is lost and only standing runs are open (T8)."""
    return all(
        all(block in system.centre.lost_blocks for block in site.layout.blocks)
        and all(
            grant.stage == Stage.STANDING or grant.stage == Stage.OVER for _run, grant in system.centre.runs.items()
        )
        for train in site.layout.fleet
        if train not in system.centre.accounted
    )


def a_lost_block_is_held_for_nobody_else(site: Site, system: System) -> bool:
    """What is lost is held by nobody but a train that stands there (T8)."""
    return all(
        block not in system.centre.lost_blocks or run.route not in site.layout.routes
        for block in system.centre.claimed
        for run in system.centre.claimed[block]
    )


def a_set_run_has_every_point_proved(site: Site, system: System) -> bool:
    """A run is offered, and set, only with every point of its route proved (T4, T10)."""
    return all(
        point in grant.proved
        for run, grant in system.centre.runs.items()
        if grant.stage == Stage.OFFERED or grant.stage == Stage.SET
        for point in site.layout.needs[run.route]
    )


def everybody_known_is_in_the_register(site: Site, system: System) -> bool:
    """Units are the fleet's, terminals the layout's; accounted trains are of the fleet; cars belong to it (T8)."""
    return (
        all(train in system.units for train in site.layout.fleet)
        and all(point in system.terminals for point in site.layout.points)
        and all(train in site.layout.fleet for train in system.centre.accounted)
        and all(run.train in site.layout.fleet for run in system.centre.runs)
        and all(run.train in site.layout.fleet for run in system.radio.offers)
        and all(
            car in site.formation.train_of and site.formation.train_of[car] in site.layout.fleet
            for car in system.track.at
        )
        and all(block in site.layout.blocks for car in system.track.at for block in system.track.at[car])
    )
