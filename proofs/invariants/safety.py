"""The claims that the safety case makes of the interlocking (design section 4.T)."""

from __future__ import annotations

from kernel.authority import may_proceed
from kernel.centre import NO_TAGS
from kernel.names import Cause, Stage
from models.world.state import Site, System
from models.world.truth import (
    goes_by_the_centres_list,
    no_block_holds_two_trains,
    no_fouling_blocks_hold_two_trains,
    no_point_under_a_car_is_unlocked,
)
from proofs.invariants.vocabulary import (
    genuine,
    is_apart_from,
    is_overlap_of_the_earlier,
    reaches,
    track_is_open,
)


def no_two_trains_in_a_block(site: Site, system: System) -> bool:
    """Cars in one block belong to one train (T4, T9)."""
    return no_block_holds_two_trains(site, system.track.at)


def no_two_trains_in_fouling_blocks(site: Site, system: System) -> bool:
    """Cars in blocks that foul each other belong to one train (T9)."""
    return no_fouling_blocks_hold_two_trains(site, system.track.at)


def physical_occupancy_is_recorded(site: Site, system: System) -> bool:
    """Where a car is, the centre holds the block: for the run it came under, or as lost (T2, T8)."""
    return all(
        any(
            holder == system.track.under.get(car, {}).get(block)
            for holder in system.centre.claimed.get(block, frozenset())
        )
        if site.formation.train_of.get(car) in system.centre.accounted
        else block in system.centre.lost_blocks
        for car in system.track.at
        for block in system.track.at[car]
    )


def no_conflicting_routes(site: Site, system: System) -> bool:
    """Blocks, and blocks that foul each other, are held for one train (T9)."""
    return all(
        run.train == other.train
        for block in system.centre.claimed
        for run in system.centre.claimed[block]
        for other in system.centre.claimed[block]
    ) and all(
        run.train == other.train
        for block in system.centre.claimed
        for run in system.centre.claimed[block]
        for beside in site.layout.fouls.get(block, frozenset())
        for other in system.centre.claimed.get(beside, frozenset())
    )


def no_run_is_set_a_lap_ahead(site: Site, system: System) -> bool:
    """Where a run starts no earlier one that still holds that block leads out over the same two tags (T5, T9)."""
    return all(
        run.route in site.layout.first_tag
        and site.layout.tag_after.get(other.route, NO_TAGS).get(site.layout.first_tag[run.route])
        != site.layout.tag_after.get(run.route, NO_TAGS).get(site.layout.first_tag[run.route])
        for block in system.centre.claimed
        for run in system.centre.claimed[block]
        if run.route in site.layout.routes and site.layout.start[run.route] == block
        for other in system.centre.claimed[block]
        if other.serial < run.serial
    )


def no_run_is_set_over_its_own_train(site: Site, system: System) -> bool:
    """What a run holds beyond its start no earlier one of its train holds, but for what is that one's overlap (T9)."""
    return all(
        other.route in site.layout.routes and (run.serial < other.serial or block in site.layout.overlap[other.route])
        for block in system.centre.claimed
        for run in system.centre.claimed[block]
        if run.route in site.layout.routes and site.layout.start[run.route] != block
        for other in system.centre.claimed[block]
        if other != run
    )


def no_run_is_set_too_close_to_its_own_train(site: Site, system: System) -> bool:
    """Nor does an earlier run of its train hold a block that fouls one of these, but for its overlap (T9)."""
    return all(
        other.route in site.layout.routes and (run.serial < other.serial or beside in site.layout.overlap[other.route])
        for block in system.centre.claimed
        for run in system.centre.claimed[block]
        if run.route in site.layout.routes and site.layout.start[run.route] != block
        for beside in site.layout.fouls.get(block, frozenset())
        if site.layout.start[run.route] != beside
        for other in system.centre.claimed.get(beside, frozenset())
        if other != run
    )


def no_train_is_led_into_its_own_cars(site: Site, system: System) -> bool:
    """Beyond a run's start only cars that came there under that run are, parted ones too, or that slipped (T2, T9).

    Those that slipped came into a block that is the overlap of the earlier of the two runs.
    """
    return all(
        is_overlap_of_the_earlier(site, run, other, block)
        for run in system.radio.permits
        if run.route in site.layout.routes
        for block in site.layout.claims[run.route]
        if block != site.layout.start[run.route] and reaches(site, system, run, block)
        for other in system.radio.permits
        if other.train == run.train
        and other.route in site.layout.routes
        and block in site.layout.claims[other.route]
        and block != site.layout.start[other.route]
        and reaches(site, system, other, block)
    ) and all(
        run.train != other.train
        or run.route not in site.layout.routes
        or block == site.layout.start[run.route]
        or not reaches(site, system, run, block)
        or is_overlap_of_the_earlier(site, run, other, block)
        for car in system.track.under
        for block, other in system.track.under[car].items()
        if block in system.track.at.get(car, frozenset())
        for run in system.radio.permits
    )


def no_train_is_led_too_close_to_its_own_cars(site: Site, system: System) -> bool:
    """The same of cars in a block that fouls the one that a train is led into, but where either run starts (T2, T9)."""
    return all(
        is_apart_from(site, run, block, other, beside)
        for run in system.radio.permits
        if run.route in site.layout.routes
        for block in site.layout.claims[run.route]
        if block != site.layout.start[run.route] and reaches(site, system, run, block)
        for beside in site.layout.fouls.get(block, frozenset())
        for other in system.radio.permits
        if other.train == run.train
        and other.route in site.layout.routes
        and beside in site.layout.claims[other.route]
        and beside != site.layout.start[other.route]
        and reaches(site, system, other, beside)
    ) and all(
        run.train != other.train
        or run.route not in site.layout.routes
        or block == site.layout.start[run.route]
        or not reaches(site, system, run, block)
        or is_apart_from(site, run, block, other, beside)
        for car in system.track.under
        for beside, other in system.track.under[car].items()
        if beside in system.track.at.get(car, frozenset())
        for block in site.layout.fouls.get(beside, frozenset())
        for run in system.radio.permits
    )


def points_lie_for_the_set_route(site: Site, system: System) -> bool:
    """Where a train can be led, every point released with that block lies as needed and is locked (T9, T10)."""
    return all(
        point in system.terminals
        and not system.terminals[point].unlocked
        and system.track.lies.get(point) == site.layout.needs[run.route][point]
        for run in system.radio.permits
        if run.route in site.layout.routes
        for point in site.layout.needs[run.route]
        if reaches(site, system, run, site.layout.released_with[run.route][point])
    )


def no_point_moves_under_a_train(site: Site, system: System) -> bool:
    """A point in a block that a car is in is locked (T10)."""
    return no_point_under_a_car_is_unlocked(site, system.track.at, system.terminals)


def no_open_flank(site: Site, system: System) -> bool:
    """Into a block that a train can be led into, no track is open from outside but under authority (T9)."""
    return all(
        not track_is_open(site, system, beside, block)
        for run in system.radio.permits
        if run.route in site.layout.routes
        for block in site.layout.claims[run.route]
        if block != site.layout.start[run.route] and reaches(site, system, run, block)
        for beside in site.ground.neighbours.get(block, frozenset())
        if beside not in site.layout.claims[run.route]
        and block not in site.ground.held_by_authority.get(beside, frozenset())
    )


def entry_only_after_first_loop(site: Site, system: System) -> bool:
    """No car has moved under a run whose list was not echoed and whose permit was not sent after that (T4)."""
    return all(run in system.radio.permits and run in system.radio.echoes for run in system.track.run_into)


def a_train_astray_has_no_authority(site: Site, system: System) -> bool:
    """A train whose second loop has opened has no authority in this life: a tag was wrong, missing or late (T5)."""
    return all(
        train not in system.units or life != system.units[train].life or not may_proceed(system.units[train], run)
        for train, life in system.track.astray
        for other in system.units
        for run in system.units[other].orders
        if other == train
    )


def released_only_on_third_loop_evidence(site: Site, system: System) -> bool:
    """A claim ended by tail evidence ended on a report of this run, with the records of this block's tags (T6, T7)."""
    return all(
        any(
            other == run and place == block and genuine(site, block, left, entered)
            for other, place, left, entered in system.radio.tail_reports
        )
        for run, grant in system.centre.runs.items()
        for block, cause in grant.ended.items()
        if cause == Cause.TAIL_EVIDENCE
    )


def every_other_release_has_its_reason(site: Site, system: System) -> bool:
    """Standstill, acknowledgement, an offer never made, or a new word where the train is: each was there (T8, T9)."""
    return all(
        (cause != Cause.STANDSTILL or (run in system.radio.stops and block in site.layout.overlap[run.route]))
        and (cause != Cause.CANCELLED or run in system.radio.returns)
        and (cause != Cause.WITHDRAWN or run not in system.radio.offers)
        and (
            (cause != Cause.RECOVERED and cause != Cause.SUPERVISED)
            or (run.train in system.centre.accounted and run.life < system.centre.accounted[run.train])
        )
        and (cause == Cause.TAIL_EVIDENCE or cause == Cause.STANDSTILL or grant.stage == Stage.OVER)
        for run, grant in system.centre.runs.items()
        for block, cause in grant.ended.items()
    )


def a_unit_may_enter_only_by_the_centres_list(site: Site, system: System) -> bool:
    """Whatever a unit is permitted to enter, it goes there by the list of the centre's own layout (T4)."""
    return all(goes_by_the_centres_list(site, system.units[train]) for train in system.units)


def a_claim_ends_by_one_cause(site: Site, system: System) -> bool:
    """A claimed block of a route is held, or its end has a cause; never both (T8)."""
    return all(
        (run in system.centre.claimed.get(block, frozenset())) != (block in grant.ended)
        for run, grant in system.centre.runs.items()
        if run.route in site.layout.routes
        for block in site.layout.claims[run.route]
    )
