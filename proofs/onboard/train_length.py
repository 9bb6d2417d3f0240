"""What is claimed of the train's length (P4, T3, P8)."""

from __future__ import annotations

from kernel.onboard import train_length as machine
from models.onboard import train_length as world
from models.onboard.train_length import UM_A_MM, Formation, Railway
from proofs.theory import Theory, by_name

# ---- the start


def nothing_is_measured(site: Railway, system: Formation) -> bool:
    """A unit begins without any pass noted (P4)."""
    return (
        system.state == machine.UNMEASURED
        and not system.head_passed
        and not system.tail_passed
        and not system.both_passed
    )


def the_line_allows_the_train(site: Railway, system: Formation) -> bool:
    """The train is at most as long as the line allows (P4)."""
    return world.no_train_is_longer_than_the_line_allows(site, system, system.length_um)


# ---- what is claimed


def length_never_underestimated(site: Railway, system: Formation) -> bool:
    """The train is never longer than the length used (P4, T3)."""
    return system.length_um <= UM_A_MM * machine.length_mm(site.bounds, system.state)


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
    most_mm = 2 * machine.GREATEST_PLACE_MM + 5 * machine.GREATEST_MEASURE_MM
    return not system.state.measured or -most_mm <= system.state.measured_mm <= most_mm


# ---- what it follows from


def the_line_allows_every_train(site: Railway, system: Formation) -> bool:
    """The train of this moment is at most as long as the line allows (P4)."""
    return world.no_train_is_longer_than_the_line_allows(site, system, system.length_um)


def the_noted_pass_is_the_heads(site: Railway, system: Formation) -> bool:
    """The pass awaiting the tail is the head's last one, of this formation (P4)."""
    noted = system.state.head
    return not system.state.head_passed or (
        system.head_passed
        and noted.kind == system.kind
        and noted.point == system.point
        and noted.time_ms == system.time_ms
        and UM_A_MM * noted.front_least_mm <= system.front_um
        and 0 <= system.speed_mm_s <= noted.speed_most_mm_s
        and machine.fits(noted)
    )


INITIAL = (nothing_is_measured, the_line_allows_the_train)
PREMISES = (world.bounds_are_not_negative, world.vehicles_are_of_this_world)
SAFETY = (
    length_never_underestimated,
    a_changed_formation_falls_back,
    another_points_times_measure_nothing,
    only_what_was_measured_contradicts_the_line,
    the_length_fits_the_processor,
)
INVARIANTS = (
    *SAFETY,
    the_line_allows_every_train,
    the_noted_pass_is_the_heads,
)

THEORY = Theory(
    "train_length",
    Railway,
    Formation,
    by_name((world.head_passes, world.tail_passes, world.change_formation, world.restart)),
    by_name(INITIAL),
    by_name(INVARIANTS),
    by_name(SAFETY),
    by_name(PREMISES),
)
