"""Lemmas on points: each one frozen for whoever counts on it, without a snapshot of all."""

from __future__ import annotations

from kernel.names import Stage
from models.world.state import Site, System
from proofs.invariants.vocabulary import at_stage, frozen, frozen_at, reaches


def a_locked_point_lies_as_wanted(site: Site, system: System) -> bool:
    """A terminal that holds its point for a route locks it only in the position of that route (T10)."""
    return all(
        (
            terminal.holds is None
            or terminal.wanted is None
            or terminal.unlocked
            or system.track.lies.get(point) == terminal.wanted
        )
        and (
            terminal.holds is None
            or (
                terminal.holds.route in site.layout.routes
                and point in site.layout.needs[terminal.holds.route]
                and terminal.wanted == site.layout.needs[terminal.holds.route][point]
            )
            or (terminal.holds.route not in site.layout.routes and terminal.wanted is None)
        )
        and (terminal.wanted is None or terminal.holds is not None)
        for point, terminal in system.terminals.items()
    )


def locks_agree(site: Site, system: System) -> bool:
    """All runs that lock a point want it alike, and so does every order for it not older than they are (T9, T10)."""
    return all(
        lies == wanted
        for point in system.centre.locked
        for _run, lies in system.centre.locked[point].items()
        for _other, wanted in system.centre.locked[point].items()
    ) and all(
        other != point or run.serial < holder.serial or site.layout.needs[run.route].get(point) == lies
        for point in system.centre.locked
        for holder, lies in system.centre.locked[point].items()
        for run, other, _life in system.radio.orders
    )


def no_newer_order_for_a_lost_point_below(site: Site, system: System) -> bool:
    """For a lost point under a train that stands, no lock and no order in the air is newer than its run (T10)."""
    return all(
        all(run.serial < holder.serial for run in system.centre.locked.get(point, {}))
        for block in system.centre.claimed
        for holder in system.centre.claimed[block]
        if holder.route not in site.layout.routes
        for point in site.layout.points_in.get(block, frozenset())
        if point in system.centre.lost_points
    ) and all(
        other != point or run.serial < holder.serial
        for block in system.centre.claimed
        for holder in system.centre.claimed[block]
        if holder.route not in site.layout.routes
        for point in site.layout.points_in.get(block, frozenset())
        if point in system.centre.lost_points
        for run, other, _life in system.radio.orders
    )


def a_lock_on_a_lost_point_below_is_proved(site: Site, system: System) -> bool:
    """A lost point that a train is held over is locked for nobody for whom it has yet to be laid (T9, T10)."""
    return all(
        run in system.centre.runs and point in system.centre.runs[run].proved
        for block in system.centre.claimed
        for holder in system.centre.claimed[block]
        if holder.route not in site.layout.routes
        for point in site.layout.points_in.get(block, frozenset())
        if point in system.centre.lost_points
        for run in system.centre.locked.get(point, {})
    )


def a_proved_point_stays(site: Site, system: System) -> bool:
    """A point locked for a run and proved for it, or adopted by it, is frozen as that run wants it (T10)."""
    return all(
        frozen_at(site, system, point, lies)
        for point in system.centre.locked
        for run, lies in system.centre.locked[point].items()
        if run.route not in site.layout.routes
        or (run in system.centre.runs and point in system.centre.runs[run].proved)
    )


def a_confirmed_point_stays(site: Site, system: System) -> bool:
    """A confirmation in the air is true while the run locks the point, or stands over it with the point lost (T10)."""
    return all(
        frozen_at(site, system, point, position) and system.centre.locked.get(point, {}).get(run, position) == position
        for run, point, position in system.radio.confirmed
        if run in system.centre.locked.get(point, {})
        or (
            point in system.centre.lost_points
            and at_stage(system, run, Stage.STANDING)
            and point in site.layout.stands_in
            and run in system.centre.claimed.get(site.layout.stands_in[point], frozenset())
        )
    )


def a_reachable_point_is_frozen(site: Site, system: System) -> bool:
    """Where a train can be led, every point released with that block is frozen as the route needs it (T10)."""
    return all(
        frozen_at(site, system, point, site.layout.needs[run.route][point])
        for run in system.radio.permits
        if run.route in site.layout.routes
        for point in site.layout.needs[run.route]
        if reaches(site, system, run, site.layout.released_with[run.route][point])
    )


def a_point_under_a_train_is_frozen(site: Site, system: System) -> bool:
    """A point in a block that a car is in is frozen, and every lock on it agrees with how it lies (T10)."""
    return all(
        frozen(site, system, point)
        and all(lies == system.track.lies.get(point) for _run, lies in system.centre.locked.get(point, {}).items())
        for car in system.track.at
        for block in system.track.at[car]
        for point in site.layout.points_in.get(block, frozenset())
    )
