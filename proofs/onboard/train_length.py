"""What is claimed of the train's length (P4, T3, P8)."""

from __future__ import annotations

from kernel.onboard import train_length as machine
from models.onboard import train_length as world
from models.onboard.train_length import Formation, Railway
from models.onboard.units import NM_A_MM, UM_A_MM
from proofs.theory import Theory, by_name

# ---- the start


def nothing_is_measured(site: Railway, system: Formation) -> bool:
    """A unit begins without any pass noted (P4)."""
    return (
        system.state == machine.UNMEASURED
        and not system.head_passed
        and not system.tail_passed
        and not system.both_passed
        and not system.untold
        and not system.differed
    )


def the_line_allows_the_train(site: Railway, system: Formation) -> bool:
    """The train is at most as long as the line allows (P4)."""
    return world.no_train_is_longer_than_the_line_allows(site, system, system.length_nm)


# ---- what is claimed


def length_never_underestimated(site: Railway, system: Formation) -> bool:
    """The train is never longer than the length used (P4, T3).

    But for vehicles coupled untold, until it differs when measured again; or if it is longer than the line allows.
    """
    allowed = world.no_train_is_longer_than_the_line_allows(site, system, system.length_nm)
    return (system.untold and not (system.differed and allowed)) or system.length_nm <= NM_A_MM * machine.length_mm(
        site.bounds, system.state
    )


def a_train_longer_than_the_line_allows_is_shown(site: Railway, system: Formation) -> bool:
    """Measured, and longer by more than the measurement leaves open: it is shown (P4)."""
    return (
        not system.state.measured
        or system.measured_nm <= NM_A_MM * site.bounds.line_maximum_mm + system.open_nm
        or machine.contradicts_the_line(site.bounds, system.state)
    )


def a_train_that_the_line_allows_is_not_shown(site: Railway, system: Formation) -> bool:
    """However large the errors, what is no longer than the line allows does not contradict it (P4; service)."""
    return system.measured_nm > NM_A_MM * site.bounds.line_maximum_mm or not machine.contradicts_the_line(
        site.bounds, system.state
    )


def another_length_is_noticed_when_measured_again(site: Railway, system: Formation) -> bool:
    """Measured again, and beyond what both measurements leave open: it is shown, and at least the line's used (P4)."""
    return not system.differed or (
        machine.contradicts_itself(system.state)
        and machine.length_mm(site.bounds, system.state) >= site.bounds.line_maximum_mm
    )


def the_same_length_contradicts_nothing(site: Railway, system: Formation) -> bool:
    """While nobody has coupled or set out vehicles untold, no measurement contradicts the one before (P4; service)."""
    return system.untold or not machine.contradicts_itself(system.state)


def no_length_is_below_the_last_vehicles(site: Railway, system: Formation) -> bool:
    """What was measured and is used is no shorter than the last vehicle (P4; ours)."""
    return not system.state.measured or machine.length_mm(site.bounds, system.state) >= site.bounds.last_vehicle_mm


def no_length_is_known_worse_than_is_written(site: Railway, system: Formation) -> bool:
    """Nothing is measured from a range wider than is written: most and least are two of them and errors apart (P4)."""
    widest_nm = NM_A_MM * (2 * site.bounds.width_mm + 2 * site.bounds.window_mm)
    errors_nm = 4 * world.SAMPLING_MS * UM_A_MM * world.FASTEST_MM_S + 2 * world.AVERAGING_NM + 2 * world.SENSOR_NM
    return (
        not system.state.measured
        or machine.contradicts_itself(system.state)
        or NM_A_MM * (system.state.most_mm - system.state.least_mm) <= widest_nm + errors_nm + 2 * world.ROUNDING_NM
    )


def a_changed_formation_falls_back(site: Railway, system: Formation) -> bool:
    """Until a tail passes, after a change or restart, the line's greatest length is used (P4)."""
    return system.tail_passed or machine.length_mm(site.bounds, system.state) == site.bounds.line_maximum_mm


def another_points_times_measure_nothing(site: Railway, system: Formation) -> bool:
    """Only a tail's pass of the head's point, later than the head's, measures a length (P4)."""
    return system.both_passed or machine.length_mm(site.bounds, system.state) == site.bounds.line_maximum_mm


def only_what_was_measured_contradicts_the_line(site: Railway, system: Formation) -> bool:
    """A train is shown as longer than the line allows only after both its ends passed one point (P4; ours)."""
    return system.both_passed or not machine.contradicts_the_line(site.bounds, system.state)


def the_length_fits_the_processor(site: Railway, system: Formation) -> bool:
    """No length is beyond places, speeds and measures in range, so that no sum overflows (P4)."""
    return not system.state.measured or (
        -FARTHEST_MM <= system.state.least_mm <= FARTHEST_MM and -FARTHEST_MM <= system.state.most_mm <= FARTHEST_MM
    )


FARTHEST_MM = 20_005_000_000
"""Twice 10,000 km, and 5 km for what is added: far below 2⁶³."""


# ---- what it follows from


def the_line_allows_every_train(site: Railway, system: Formation) -> bool:
    """A train that is not measured is at most as long as the line allows, but for vehicles coupled untold (P4)."""
    return (
        system.untold
        or system.state.measured
        or world.no_train_is_longer_than_the_line_allows(site, system, system.length_nm)
    )


def the_noted_pass_is_the_heads(site: Railway, system: Formation) -> bool:
    """The pass awaiting the tail is the head's last one, of this formation (P4)."""
    noted = system.state.head
    return not system.state.head_passed or (
        system.head_passed
        and noted.kind == system.kind
        and noted.point == system.point
        and noted.time_ms == system.time_ms
        and NM_A_MM * noted.front_least_mm <= system.front_nm <= NM_A_MM * noted.front_most_mm
        and noted.front_most_mm - noted.front_least_mm == system.width_mm
        and noted.speed_most_mm_s == system.told_mm_s
        and 0 <= system.speed_mm_s <= noted.speed_most_mm_s
        and machine.fits(site.bounds, noted)
    )


def a_pass_in_range_is_noted(site: Railway, system: Formation) -> bool:
    """The head's last pass awaits the tail, unless it was out of range, or the front not well enough known (P4)."""
    return (
        system.state.head_passed
        or not system.head_passed
        or not system.was_known
        or system.width_mm > site.bounds.width_mm
        or not world.within(system.front_nm, world.NEAR_NM)
        or system.told_mm_s > world.FASTEST_MM_S
    )


def the_length_was_between_its_bounds(site: Railway, system: Formation) -> bool:
    """When it was measured, the true length was between least and most; they are as far apart as is left open (P4)."""
    return not system.state.measured or (
        (system.untold or system.measured_nm == system.length_nm)
        and NM_A_MM * system.state.least_mm <= system.measured_nm <= NM_A_MM * system.state.most_mm
        and system.measured_nm <= NM_A_MM * system.state.least_mm + system.open_nm
        and (system.state.contradicted or NM_A_MM * (system.state.most_mm - system.state.least_mm) <= system.open_nm)
    )


def what_is_not_measured_is_not_contradicted(site: Railway, system: Formation) -> bool:
    """Only what was measured is contradicted, or has differed (P4)."""
    return system.state.measured or (not machine.contradicts_itself(system.state) and not system.differed)


INITIAL = (nothing_is_measured, the_line_allows_the_train)
PREMISES = (world.bounds_are_not_negative, world.vehicles_are_of_this_world)
SAFETY = (
    length_never_underestimated,
    a_train_longer_than_the_line_allows_is_shown,
    a_train_that_the_line_allows_is_not_shown,
    another_length_is_noticed_when_measured_again,
    the_same_length_contradicts_nothing,
    no_length_is_below_the_last_vehicles,
    no_length_is_known_worse_than_is_written,
    a_changed_formation_falls_back,
    another_points_times_measure_nothing,
    only_what_was_measured_contradicts_the_line,
    the_length_fits_the_processor,
)
INVARIANTS = (
    *SAFETY,
    the_line_allows_every_train,
    the_noted_pass_is_the_heads,
    a_pass_in_range_is_noted,
    the_length_was_between_its_bounds,
    what_is_not_measured_is_not_contradicted,
)

THEORY = Theory(
    "train_length",
    Railway,
    Formation,
    by_name(
        (
            world.head_passes,
            world.tail_passes,
            world.change_formation,
            world.change_formation_untold,
            world.change_kilometrage,
            world.restart,
        )
    ),
    by_name(INITIAL),
    by_name(INVARIANTS),
    by_name(SAFETY),
    by_name(PREMISES),
)
