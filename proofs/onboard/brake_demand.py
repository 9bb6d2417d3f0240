"""What is claimed of the demand for the brake: each machine that demands it gets it in the same cycle (T5, T12, P5)."""

from __future__ import annotations

from kernel.onboard.braking import slows_before, stops_before
from kernel.onboard.ceiling import is_kept
from kernel.onboard.odometry import Loss, Motion
from models.onboard.brake_demand import Deciding, Train, decide
from proofs.theory import Theory, by_name


def the_brake_is_applied(site: Train, system: Deciding) -> bool:
    """At the start the brake is on (T8)."""
    return system.brake.applied


def a_lost_position_brakes(site: Train, system: Deciding) -> bool:
    """An irregular cycle, or a fix that contradicts the range: no range is claimed, and the train brakes (P7, T8)."""
    return system.brake.applied or system.known.motion.loss == Loss.NONE


def a_broken_bound_brakes(site: Train, system: Deciding) -> bool:
    """A train that its motors or its brake let get too fast brakes (T12)."""
    return system.brake.applied or not system.known.watch.broken


def reverse_movement_brakes(site: Train, system: Deciding) -> bool:
    """A train that has rolled back too far brakes (T5)."""
    return system.brake.applied or not system.known.movement.reversed


def an_overspeed_brakes(site: Train, system: Deciding) -> bool:
    """A train that may be too fast for anything that it may be on brakes (T12)."""
    motion, limit, speeds = system.known.motion, system.known.limit, site.limits.speeds
    rear_mm = motion.front_least_mm - site.limits.length_mm
    in_curve = limit.in_curve or rear_mm <= limit.curve_until_mm
    at_turnout = limit.at_turnout or rear_mm <= limit.turnout_until_mm
    return system.brake.applied or (
        0 <= motion.speed_most_mm_s <= speeds.line_mm_s
        and (not in_curve or motion.speed_most_mm_s <= speeds.curve_mm_s)
        and (not at_turnout or motion.speed_most_mm_s <= speeds.turnout_mm_s)
    )


def a_restriction_ahead_brakes(site: Train, system: Deciding) -> bool:
    """A train that might be too fast when it enters a listed curve or turnout brakes (T12)."""
    motion, ahead, speeds = system.known.motion, system.known.ahead, site.limits.speeds
    return system.brake.applied or (
        slows_or_need_not(site, motion, ahead.curve_mm, speeds.curve_mm_s)
        and slows_or_need_not(site, motion, ahead.turnout_mm, speeds.turnout_mm_s)
    )


def slows_or_need_not(site: Train, motion: Motion, from_mm: int, restricted_mm_s: int) -> bool:
    """Tell so of one kind, by the farthest and the fastest that the train's range has."""
    return restricted_mm_s >= site.limits.speeds.line_mm_s or slows_before(
        site.limits.brake, motion.front_most_mm, motion.speed_most_mm_s, from_mm, restricted_mm_s
    )


def a_ceiling_brakes(site: Train, system: Deciding) -> bool:
    """A train that might get faster than it has promised before a later brake responds brakes (X2, T12)."""
    known = system.known
    return system.brake.applied or is_kept(site.limits.brake, known.ceiling, known.motion.speed_most_mm_s)


def a_split_brakes(site: Train, system: Deciding) -> bool:
    """A train that has parted brakes (P5)."""
    return system.brake.applied or not system.known.wholeness.split


def an_overdue_tag_brakes(site: Train, system: Deciding) -> bool:
    """A train that has not read the next tag where it should lie brakes (T5)."""
    return system.brake.applied or not system.known.window.passed


def an_order_that_does_not_let_it_proceed_brakes(site: Train, system: Deciding) -> bool:
    """Without an order for its run, or with an open loop, the train brakes (T5)."""
    return system.brake.applied or system.may_proceed


def a_train_that_might_not_stop_before_the_end_brakes(site: Train, system: Deciding) -> bool:
    """By the farthest and the fastest that its range has (P7, T12)."""
    motion = system.known.motion
    return system.brake.applied or stops_before(
        site.limits.brake, motion.front_most_mm, motion.speed_most_mm_s, system.brake.end_mm
    )


def no_brake_is_released_of_a_train_that_might_move(site: Train, system: Deciding) -> bool:
    """By both ends of its range of speeds, and not unless the driver acknowledges (T12)."""
    motion, standstill_mm_s = system.known.motion, site.limits.brake.standstill_mm_s
    return (
        system.brake.applied
        or not system.was_applied
        or (
            system.acknowledged
            and -standstill_mm_s <= motion.speed_least_mm_s
            and motion.speed_most_mm_s <= standstill_mm_s
        )
    )


INITIAL = (the_brake_is_applied,)
SAFETY = (
    a_lost_position_brakes,
    a_broken_bound_brakes,
    reverse_movement_brakes,
    an_overspeed_brakes,
    a_restriction_ahead_brakes,
    a_ceiling_brakes,
    a_split_brakes,
    an_overdue_tag_brakes,
    an_order_that_does_not_let_it_proceed_brakes,
    a_train_that_might_not_stop_before_the_end_brakes,
    no_brake_is_released_of_a_train_that_might_move,
)
STEPS = (decide,)

THEORY = Theory("brake_demand", Train, Deciding, by_name(STEPS), by_name(INITIAL), by_name(SAFETY), by_name(SAFETY))
