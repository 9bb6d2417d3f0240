"""What is claimed of the odometry: its range contains the train, always (P1, P7)."""

from __future__ import annotations

from kernel.onboard import odometry
from kernel.onboard.odometry import Loss
from models.onboard.odometry import (
    Line,
    Running,
    a_jolt_stands_out,
    agreement_takes_longer_than_a_chance_pace,
    bounds_are_not_negative,
    locate_anew,
    run_a_cycle,
    take_fix,
    the_length_used_is_no_less,
)
from models.onboard.units import NM_A_MM, PPM, magnitude
from proofs.theory import Theory, by_name

# ---- the start


def the_train_stands_where_it_is_located(site: Line, system: Running) -> bool:
    """At the start the train is at rest, and its front within what was told (P7, T8)."""
    least_mm, most_mm, way_mm = (
        system.motion.front_least_mm,
        system.motion.front_most_mm,
        system.motion.way_mm,
    )
    return (
        system.motion == odometry.located(least_mm, most_mm, way_mm)
        and NM_A_MM * least_mm <= system.front_nm <= NM_A_MM * most_mm
        and system.anchor_nm == system.front_nm
        and system.speed_um_s == 0
        and not system.counted
        and not system.contradicted
        and system.false_by_nm == 0
        and system.paced_cycles >= 0
    )


# ---- safety


def range_contains_train(site: Line, system: Running) -> bool:
    """While a range is claimed, the whole train is in it: its front, and its rear by the length used (P7).

    Where a fix was false and the unit could not know it, the range is off by no more than that fix was.
    """
    return system.motion.loss != Loss.NONE or (
        NM_A_MM * odometry.rear_least_mm(system.motion, site.length_used_mm) - system.false_by_nm
        <= system.front_nm - NM_A_MM * site.length_mm
        and system.front_nm <= NM_A_MM * system.motion.front_most_mm + system.false_by_nm
    )


def speed_range_contains_speed(site: Line, system: Running) -> bool:
    """While a range is claimed, the train's speed is in the range of speeds; the brake reckons with it (P1, T12)."""
    return system.motion.loss != Loss.NONE or (
        1000 * system.motion.speed_least_mm_s <= system.speed_um_s <= 1000 * system.motion.speed_most_mm_s
    )


def a_contradicted_range_is_claimed_no_more(site: Line, system: Running) -> bool:
    """Since a fix lay wholly outside the range none is claimed, until the train is located anew at rest (P7)."""
    return not system.contradicted or system.motion.loss != Loss.NONE


def a_trusted_wheels_range_grows_with_way_alone(site: Line, system: Running) -> bool:
    """Since the wheel was trusted, or a fix came, it has widened by twice creep, diameter and a pulse, and a mm (P1).

    However long that is ago: at rest it stays as it is.
    """
    now, since_mm = system.motion, system.motion.way_mm - system.motion.anchor_way_mm
    widened_mm = now.front_most_mm - now.front_least_mm - (now.anchor_most_mm - now.anchor_least_mm)
    return (
        now.loss != Loss.NONE
        or not now.trusted
        or PPM * widened_mm <= 2 * (site.bounds.scale_ppm * magnitude(since_mm) + PPM * (site.bounds.pulse_mm + 1))
    )


# ---- what they rest on


def range_contains_front(site: Line, system: Running) -> bool:
    """The front is in the range, but for what a fix was false by (P7)."""
    return system.motion.loss != Loss.NONE or (
        NM_A_MM * system.motion.front_least_mm - system.false_by_nm <= system.front_nm
        and system.front_nm <= NM_A_MM * system.motion.front_most_mm + system.false_by_nm
    )


def anchor_contained_front(site: Line, system: Running) -> bool:
    """At the anchor the front was in the anchor's range, but for what a fix was false by (P1)."""
    return system.motion.loss != Loss.NONE or (
        NM_A_MM * system.motion.anchor_least_mm - system.false_by_nm <= system.anchor_nm
        and system.anchor_nm <= NM_A_MM * system.motion.anchor_most_mm + system.false_by_nm
    )


def a_trusted_wheel_has_not_slipped(site: Line, system: Running) -> bool:
    """A wheel that is trusted has rolled and been read since the anchor (P1)."""
    return (
        system.motion.loss != Loss.NONE
        or not system.motion.trusted
        or (system.counted and system.told and not system.slips)
    )


def a_trusted_wheel_is_known_as_it_was_shown(site: Line, system: Running) -> bool:
    """Of a wheel that is trusted the last reading is remembered, and the pulses at the anchor (P1)."""
    return (
        system.motion.loss != Loss.NONE
        or not system.motion.trusted
        or (
            system.motion.tachometer_mm_s == system.shown_mm_s
            and system.motion.way_mm == system.shown_way_mm
            and system.motion.anchor_way_mm == system.anchor_way_mm
        )
    )


def what_agrees_is_known_as_it_was_shown(site: Line, system: Running) -> bool:
    """After a cycle that agreed the last reading is remembered; after two it was neither stuck nor gross (P1)."""
    return (
        system.motion.loss != Loss.NONE
        or system.motion.trusted
        or (
            (
                system.motion.agreed_cycles < 1
                or (system.motion.tachometer_mm_s == system.shown_mm_s and system.motion.way_mm == system.shown_way_mm)
            )
            and (system.motion.agreed_cycles < 2 or system.told)
        )
    )


def a_wheel_that_agrees_keeps_pace(site: Line, system: Running) -> bool:
    """While the wheel agrees it keeps pace with the train, but for the first two cycles (P1)."""
    return system.paced_cycles >= 0 and (
        system.motion.loss != Loss.NONE
        or system.motion.trusted
        or system.motion.agreed_cycles <= system.paced_cycles + 2
    )


def the_gradient_estimate_is_no_steeper_than_the_line(site: Line, system: Running) -> bool:
    """The estimate stays within the steepest gradient, so that it hides no jolt (P1)."""
    return magnitude(system.motion.gradient_mm_s2) <= site.bounds.gradient_mm_s2


INITIAL = (the_train_stands_where_it_is_located,)
SAFETY = (
    range_contains_train,
    speed_range_contains_speed,
    a_contradicted_range_is_claimed_no_more,
    a_trusted_wheels_range_grows_with_way_alone,
)
INVARIANTS = (
    *SAFETY,
    range_contains_front,
    anchor_contained_front,
    a_trusted_wheel_has_not_slipped,
    a_trusted_wheel_is_known_as_it_was_shown,
    what_agrees_is_known_as_it_was_shown,
    a_wheel_that_agrees_keeps_pace,
    the_gradient_estimate_is_no_steeper_than_the_line,
)
PREMISES = (
    bounds_are_not_negative,
    a_jolt_stands_out,
    agreement_takes_longer_than_a_chance_pace,
    the_length_used_is_no_less,
)
STEPS = (run_a_cycle, take_fix, locate_anew)

THEORY = Theory(
    "odometry",
    Line,
    Running,
    by_name(STEPS),
    by_name(INITIAL),
    by_name(INVARIANTS),
    by_name(SAFETY),
    by_name(PREMISES),
)
