"""What is promised of a train from its sensors to its brake: one that may run comes to its end (T4, T12).

Nothing else than a cause that has a name stops it before.  The causes are said here anew, by what is written and
what the computer knows, and not by asking its machines whether they want the brake.  That each of them is one, and
no false alarm, is claimed beside this: `no_fix_contradicts`, `a_sound_brake_is_not_accused`,
`no_tag_still_ahead_is_called_missing`, `the_speed_is_what_the_computer_says`,
`the_front_is_where_the_computer_says`, and of split detection `no_false_alarm`.
"""

from __future__ import annotations

from kernel.onboard import computer
from kernel.onboard.odometry import Loss
from models.onboard.slowing import slows_mm_s2
from models.onboard.train import run_a_cycle
from models.onboard.train_nature import (
    Train,
    Whole,
    a_brake_that_has_responded_keeps_its_bound,
    a_cycle_begins_when_the_one_before_was_sensed,
    motors_that_are_cut_off_give_nothing,
    the_head_is_no_faster_than_at_the_ends_of_a_cycle,
    the_train_gains_no_more,
)
from models.onboard.units import LONGEST_MS, NM_A_MM, NO_SPEED_MM_S, UM_A_MM, larger, smaller
from proofs.promise import Link, Promise

FARTHEST_MM = 10**9
"""Places are within 1000 km of the kilometrage's origin, and what is farther ahead counts as so far."""
NO_CEILING_MM_S = 2 * 10**9
"""Who has promised nothing keeps to this; what is faster is none either."""


def a_train_that_may_run_comes_to_its_end(site: Train, system: Whole, end_mm: int) -> bool:
    """A train that was given an end runs on until its brake stops it for that, and for nothing without a name (T12).

    It may be on before since the orders do not let it proceed, since it has split, rolled back too far, lost its
    position or passed a tag unread, since motors or brake have broken a bound, or nobody has inspected them since its
    computer began, or since it may be too fast for the track that it is on, for what is listed ahead, or for what it
    has promised.
    """
    return system.computer.brake.applied and (is_near(site, system, end_mm) or has_a_cause(site, system))


def its_end_is_another_or_it_rolls_back(site: Train, system: Whole, end_mm: int) -> bool:
    """Its orders give it another end or none, its driver puts the brake on, or it rolls back."""
    brake = system.computer.brake
    return brake.end_mm != end_mm or brake.withheld or system.front_nm < system.from_nm


def has_a_cause(site: Train, system: Whole) -> bool:
    """Something else than its end demands the brake, and has a name."""
    known = system.computer.known
    return (
        known.motion.loss != Loss.NONE
        or not system.watched.inspected
        or not system.watched.kept
        or known.movement.reversed
        or known.wholeness.split
        or known.window.passed
        or not system.proceeds
        or may_be_too_fast_where_it_is(site, system)
        or may_be_too_fast_for_what_is_listed(site, system)
        or may_get_faster_than_its_ceiling(site, system)
    )


def may_be_too_fast_where_it_is(site: Train, system: Whole) -> bool:
    """By the widest that place and speed are known, for line, curve or turnout under any part of the train (T12)."""
    known, speeds = system.computer.known, site.limits.train.speeds
    limit, fast_mm_s = known.limit, known.motion.speed_most_mm_s
    rear_mm = known.motion.front_least_mm - site.limits.train.length_mm
    return (
        not 0 <= fast_mm_s <= speeds.line_mm_s
        or ((limit.in_curve or rear_mm <= limit.curve_until_mm) and fast_mm_s > speeds.curve_mm_s)
        or ((limit.at_turnout or rear_mm <= limit.turnout_until_mm) and fast_mm_s > speeds.turnout_mm_s)
    )


def may_be_too_fast_for_what_is_listed(site: Train, system: Whole) -> bool:
    """A listed curve or turnout that allows less than the line does is nearer than the way to be slow there (T12)."""
    ahead, speeds = system.computer.known.ahead, site.limits.train.speeds
    return (
        speeds.curve_mm_s < speeds.line_mm_s and not slows_before(site, system, ahead.curve_mm, speeds.curve_mm_s)
    ) or (
        speeds.turnout_mm_s < speeds.line_mm_s and not slows_before(site, system, ahead.turnout_mm, speeds.turnout_mm_s)
    )


def may_get_faster_than_its_ceiling(site: Train, system: Whole) -> bool:
    """It has promised a ceiling that it is nearer to than what it may gain before a brake responds (X2, T12)."""
    brake, known = site.limits.train.brake, system.computer.known
    driven_cycles, falling_cycles = brake.cut_cycles + 1, brake.response_cycles - brake.cut_cycles
    gained_um_s = LONGEST_MS * (driven_cycles * brake.gains_mm_s2 + falling_cycles * brake.falls_mm_s2)
    fast_mm_s, ceiling_mm_s = known.motion.speed_most_mm_s, known.ceiling.most_mm_s
    return not (
        0 <= fast_mm_s <= smaller(ceiling_mm_s, NO_SPEED_MM_S)
        and UM_A_MM * fast_mm_s <= UM_A_MM * smaller(ceiling_mm_s, NO_CEILING_MM_S) - gained_um_s
    )


def is_near(site: Train, system: Whole, end_mm: int) -> bool:
    """By as far and as fast as the train may be, its end is nearer than the way that it is reckoned to stop in."""
    return end_mm < system.computer.known.motion.front_most_mm or not slows_before(site, system, end_mm, 0)


def slows_before(site: Train, system: Whole, place_mm: int, to_mm_s: int) -> bool:
    """Reckoned for the worst, it runs at no more than a speed from a place on, if its brake is commanded a cycle on.

    Until that responds, and in the cycle in which it takes hold, it gains what motors may give.
    """
    brake, motion = site.limits.train.brake, system.computer.known.motion
    front_mm, fast_mm_s = motion.front_most_mm, motion.speed_most_mm_s
    if not 0 <= fast_mm_s <= NO_SPEED_MM_S or not -FARTHEST_MM <= front_mm <= FARTHEST_MM:
        return False
    cycles = brake.response_cycles + 1
    worst_um_s = UM_A_MM * fast_mm_s + cycles * LONGEST_MS * brake.gains_mm_s2
    slow_um_s = UM_A_MM * larger(0, smaller(to_mm_s, NO_SPEED_MM_S))
    if worst_um_s < slow_um_s:
        return True
    if place_mm < front_mm:
        return False
    reach_nm = NM_A_MM * front_mm + cycles * LONGEST_MS * worst_um_s
    left_nm = NM_A_MM * smaller(place_mm, front_mm + FARTHEST_MM) - reach_nm - LONGEST_MS * worst_um_s
    if left_nm < 0:
        return False
    return worst_um_s * worst_um_s - slow_um_s * slow_um_s <= 2 * slows_mm_s2(brake) * left_nm


def it_is_held_and_has_an_end(site: Train, system: Whole, end_mm: int) -> bool:
    """The brake is on, an end of authority is taken, and nothing demands the brake."""
    brake = system.computer.brake
    return brake.applied and not brake.withheld and brake.end_mm == end_mm


def it_stands_and_the_driver_acknowledges(
    site: Train, system: Whole, may_proceed: bool, acknowledged: bool, to_nm: int, speed_um_s: int
) -> bool:
    """The train certainly stands, and its orders let it proceed; its driver acknowledges, and it does not roll back."""
    motion, standstill_mm_s = system.computer.known.motion, site.limits.train.brake.standstill_mm_s
    return (
        may_proceed
        and acknowledged
        and to_nm >= system.front_nm
        and -standstill_mm_s <= motion.speed_least_mm_s
        and motion.speed_most_mm_s <= standstill_mm_s
        and nature_lets_it_run(site, system, may_proceed, acknowledged, to_nm, speed_um_s)
    )


def it_runs_free(site: Train, system: Whole, end_mm: int) -> bool:
    """Its brake is off."""
    brake = system.computer.brake
    return not brake.applied and not brake.withheld and brake.end_mm == end_mm


def the_driver_runs_on(
    site: Train, system: Whole, may_proceed: bool, acknowledged: bool, to_nm: int, speed_um_s: int
) -> bool:
    """Its orders let the train proceed, and its driver runs on, however slowly."""
    return (
        may_proceed
        and to_nm > system.front_nm
        and nature_lets_it_run(site, system, may_proceed, acknowledged, to_nm, speed_um_s)
    )


def nature_lets_it_run(
    site: Train, system: Whole, may_proceed: bool, acknowledged: bool, to_nm: int, speed_um_s: int
) -> bool:
    """The cycle is one that motors, brake and clock allow."""
    applied = computer.decide(site.limits, system.computer, may_proceed, acknowledged).brake.applied
    return (
        a_cycle_begins_when_the_one_before_was_sensed(system)
        and the_head_is_no_faster_than_at_the_ends_of_a_cycle(system, to_nm, speed_um_s)
        and the_train_gains_no_more(site, system, speed_um_s)
        and a_brake_that_has_responded_keeps_its_bound(site, system, applied, speed_um_s)
        and motors_that_are_cut_off_give_nothing(site, system, applied, speed_um_s)
    )


def the_way_to_its_end_nm(site: Train, system: Whole, end_mm: int) -> int:
    """How far its front is from there, in nm."""
    return NM_A_MM * end_mm - system.front_nm


PROMISES = (
    Promise(
        (
            Link(it_is_held_and_has_an_end, run_a_cycle, it_stands_and_the_driver_acknowledges),
            Link(it_runs_free, run_a_cycle, the_driver_runs_on, the_way_to_its_end_nm),
        ),
        a_train_that_may_run_comes_to_its_end,
        its_end_is_another_or_it_rolls_back,
    ),
)
"""From the standstill to the end."""
