"""What is claimed at the joint: that a train obeys its authority is a theorem, not an assumption (T4, T9, T12)."""

from __future__ import annotations

from models.onboard.joint import (
    Joint,
    Survey,
    a_centres_list_says_what_its_layout_does,
    a_list_follows_the_way,
    a_list_tells_the_track,
    ask_for_the_end,
    cars_move,
    come_to_rest,
    every_route_has_an_overlap,
    give_back,
    head_passes,
    head_runs,
    locate,
    no_car_is_ahead_of_the_head,
    obey_the_orders,
    take_list,
    the_unit_goes_by_the_centres_list,
    unit_changes,
)
from models.world.assumptions import a_train_obeys_its_authority
from models.world.truth import keeps_before
from proofs.theory import Theory, by_name

# ---- the start


def no_train_is_located(site: Survey, system: Joint) -> bool:
    """At the start no train knows where it is: it has no order, no end, no list, and no run rolls (T4)."""
    return (
        all(not any(True for _ in unit.orders) for _, unit in system.system.units.items())
        and not any(True for train in system.head_mm)
        and not any(True for train in system.block)
        and not any(True for train in system.block_end_mm)
        and not any(True for train in system.brake)
        and not any(True for run in system.begins_mm)
        and not any(True for run in system.block_ends_mm)
        and not any(True for run in system.asked)
        and not any(True for train in system.does_as_assumed)
        and not any(True for train in system.brakes_at_a_stop)
        and not any(True for train in system.is_told_without_an_end)
        and not any(True for run, block in system.system.track.leavable)
        and not any(True for run in system.system.track.rolling)
    )


# ---- safety


def a_head_that_can_leave_obeys_its_authority(site: Survey, system: Joint) -> bool:
    """A head that the brake lets out of its block leaves it as the interlocking's proof assumes of it (T4, T12)."""
    return all(
        train in system.standing
        or system.block_end_mm[train] >= system.brake[train].end_mm
        or any(
            run.train == train
            and run in system.block_ends_mm
            and a_train_obeys_its_authority(site.site, system.system, run, system.block[train])
            for run in system.asked
        )
        for train in system.brake
    )


def a_train_keeps_out_of_what_its_brake_holds_it_from(site: Survey, system: Joint) -> bool:
    """While a brake holds an end before a run's blocks its train neither is in them nor rolls there (T9, T12)."""
    return all(
        run.train in system.brake
        and keeps_before(
            system.system,
            run,
            system.brake[run.train].end_mm,
            system.block_ends_mm[run][site.site.layout.start[run.route]],
        )
        for run in system.block_ends_mm
    )


def no_head_is_beyond_its_end(site: Survey, system: Joint) -> bool:
    """No head is beyond the end of its authority (T12)."""
    return all(
        train in system.brake and system.head_mm[train] <= system.brake[train].end_mm for train in system.head_mm
    )


def a_brake_control_does_what_is_assumed_of_it(site: Survey, system: Joint) -> bool:
    """The kernel's brake function takes the end that is wanted, or keeps the brake applied (T4, T12)."""
    return all(does for _train, does in system.does_as_assumed.items())


def a_train_that_no_run_lets_move_is_braked(site: Survey, system: Joint) -> bool:
    """With an open loop, or no run that it may move under, the brake is applied wherever its authority ends (T5)."""
    return all(brakes for _train, brakes in system.brakes_at_a_stop.items())


def a_brake_is_told_without_an_end(site: Survey, system: Joint) -> bool:
    """Where the train has no end of authority the brake is told something, and so is not left as it was (T12)."""
    return all(is_told for _train, is_told in system.is_told_without_an_end.items())


def a_train_that_stands_rolls_under_no_run(site: Survey, system: Joint) -> bool:
    """Brought to rest by a withheld brake, it is at rest to the interlocking, until that takes an end (T8, T12)."""
    return all(run.train not in system.standing for run in system.system.track.rolling)


# ---- what they rest on


def a_located_train_has_a_place(site: Survey, system: Joint) -> bool:
    """Head, block and brake are known together, and the head is not past the end of its block (P7)."""
    return all(
        train in system.head_mm
        and train in system.block
        and train in system.block_end_mm
        and system.head_mm[train] <= system.block_end_mm[train]
        and (train in system.standing or train in system.system.units)
        for train in system.brake
    )


def every_list_follows_its_way(site: Survey, system: Joint) -> bool:
    """Lists are of located trains, and as surveyed (T1)."""
    return all(
        run.train in system.brake
        and run in system.begins_mm
        and a_list_follows_the_way(site, run, system.block_ends_mm[run])
        for run in system.block_ends_mm
    ) and all(run in system.block_ends_mm for run in system.asked)


def every_list_tells_the_track(site: Survey, system: Joint) -> bool:
    """A head within a list is in the block that the list has there (T1)."""
    return all(
        run in system.begins_mm
        and run.train in system.block
        and a_list_tells_the_track(
            system.begins_mm[run],
            system.block_ends_mm[run],
            system.head_mm[run.train],
            system.block[run.train],
            system.block_end_mm[run.train],
        )
        for run in system.block_ends_mm
    )


def what_lies_before_the_end_could_be_left(site: Survey, system: Joint) -> bool:
    """Of what is listed each block that ends between head and end might be left, by a run that rolls (T12)."""
    return all(
        run not in system.block_ends_mm
        or run.train not in system.brake
        or system.head_mm[run.train] > system.block_ends_mm[run][block]
        or system.block_ends_mm[run][block] >= system.brake[run.train].end_mm
        or any(
            other.train == run.train
            and other in system.block_ends_mm
            and other in system.system.track.rolling
            and (other, block) in system.system.track.leavable
            and system.block_ends_mm[other].get(block) == system.block_ends_mm[run][block]
            for other in system.asked
        )
        for run in system.asked
        for block in system.block_ends_mm[run]
    )


def the_heads_block_is_listed(site: Survey, system: Joint) -> bool:
    """A head that the brake lets out of its block is in a block of a list that the brake was asked by (T12)."""
    return all(
        train in system.standing
        or system.block_end_mm[train] >= system.brake[train].end_mm
        or any(
            run.train == train
            and run in system.block_ends_mm
            and system.block_ends_mm[run].get(system.block[train]) == system.block_end_mm[train]
            for run in system.asked
        )
        for train in system.brake
    )


def a_block_that_could_be_left_has_a_way_on(site: Survey, system: Joint) -> bool:
    """From a block that might be left the way goes on, and not into the overlap (T9)."""
    return all(
        run.route in site.site.layout.way
        and block in site.site.layout.way[run.route]
        and site.site.layout.way[run.route][block] not in site.site.layout.overlap[run.route]
        for run, block in system.system.track.leavable
    )


def every_unit_goes_by_the_centres_list(site: Survey, system: Joint) -> bool:
    """Whatever has become of the units, what they keep of a route that they may enter is the centre's list (T4)."""
    return all(the_unit_goes_by_the_centres_list(site, unit) for _, unit in system.system.units.items())


def a_rolling_run_starts_before_the_end(site: Survey, system: Joint) -> bool:
    """A run that is listed rolls only while the brake holds an end beyond its start block; none else rolls (T12)."""
    return all(
        run in system.block_ends_mm
        and run.train in system.brake
        and system.block_ends_mm[run][site.site.layout.start[run.route]] < system.brake[run.train].end_mm
        for run in system.system.track.rolling
    )


def no_car_came_under_a_run_ahead(site: Survey, system: Joint) -> bool:
    """No car is beyond the start block of a run, come there under it, but with the head beyond it (T2)."""
    return all(
        run.train in system.head_mm
        and no_car_is_ahead_of_the_head(
            site,
            system.head_mm[run.train],
            run,
            system.block_ends_mm[run],
            system.system.track.at,
            system.system.track.under,
        )
        for run in system.block_ends_mm
    )


INITIAL = (no_train_is_located,)
SAFETY = (
    a_head_that_can_leave_obeys_its_authority,
    a_train_keeps_out_of_what_its_brake_holds_it_from,
    no_head_is_beyond_its_end,
    a_brake_control_does_what_is_assumed_of_it,
    a_train_that_no_run_lets_move_is_braked,
    a_brake_is_told_without_an_end,
    a_train_that_stands_rolls_under_no_run,
)
INVARIANTS = (
    *SAFETY,
    a_located_train_has_a_place,
    every_list_follows_its_way,
    every_list_tells_the_track,
    what_lies_before_the_end_could_be_left,
    the_heads_block_is_listed,
    a_block_that_could_be_left_has_a_way_on,
    every_unit_goes_by_the_centres_list,
    a_rolling_run_starts_before_the_end,
    no_car_came_under_a_run_ahead,
)
PREMISES = (every_route_has_an_overlap, a_centres_list_says_what_its_layout_does)
STEPS = (
    locate,
    come_to_rest,
    take_list,
    give_back,
    ask_for_the_end,
    obey_the_orders,
    head_runs,
    head_passes,
    cars_move,
    unit_changes,
)

THEORY = Theory(
    "joint",
    Survey,
    Joint,
    by_name(STEPS),
    by_name(INITIAL),
    by_name(INVARIANTS),
    by_name(SAFETY),
    by_name(PREMISES),
    quantified=True,
)
