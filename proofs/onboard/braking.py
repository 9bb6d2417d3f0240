"""What is claimed of the brake control: the head stays inside the authority, for every motion (T12)."""

from __future__ import annotations

from kernel.onboard import braking
from models.onboard import ceiling, slowing
from models.onboard.braking import (
    Approach,
    Vehicle,
    be_let_go,
    keep_to,
    list_none,
    list_tag,
    run_a_cycle,
    take_end,
    the_brake_slows,
    the_motors_are_cut_off_before_it_does,
    withhold_end,
)
from models.onboard.slowing import Reckoned, slows_mm_s2
from models.onboard.units import LONGEST_MS, NM_A_MM, UM_A_MM, larger
from proofs.theory import Theory, by_name

# ---- the start


def the_train_stands_inside_its_authority(site: Vehicle, system: Approach) -> bool:
    """At the start the train stands, and the brake control begins where its front may be at the farthest (T12)."""
    return (
        system.brake == braking.stand_still(system.brake.end_mm)
        and system.head_nm <= NM_A_MM * system.brake.end_mm
        and system.speed_um_s == 0
        and system.response_cycles == 0
        and system.worst_um_s == 0
        and system.reach_nm == system.head_nm
        and system.left_nm == 0
        and not system.demanded
        and not system.released_amiss
        and not system.wanted
        and system.slowing == slowing.at_rest(site.bounds, system.head_nm, system.brake.end_mm)
        and system.ceiling.most_mm_s >= 0
        and system.keeping == ceiling.AT_REST
    )


# ---- safety


def head_stays_inside_authority(site: Vehicle, system: Approach) -> bool:
    """The head does not pass the end of authority (T12)."""
    return system.head_nm <= NM_A_MM * system.brake.end_mm


def a_demanded_brake_is_applied(site: Vehicle, system: Approach) -> bool:
    """Whoever demands the brake gets it in the same cycle, wherever the train is and however fast (T5, T12, P5)."""
    return not system.demanded or system.brake.applied


def no_end_is_held_beyond_the_one_wanted(site: Vehicle, system: Approach) -> bool:
    """The brake is applied, or the end it holds is no farther than the one that the unit wants (T4, T9, T12)."""
    return system.brake.applied or (system.wanted and system.brake.end_mm <= system.wanted_mm)


def no_brake_is_released_before_the_train_stands(site: Vehicle, system: Approach) -> bool:
    """Once applied it goes off only of a train that stands, acknowledged, while nobody demands it (T12)."""
    return not system.released_amiss


def no_train_enters_a_listed_restriction_faster_than_permitted(site: Vehicle, system: Approach) -> bool:
    """Beyond a listed curve or turnout the head is no faster than it allows, nor in the cycle in which it gets there.

    It was listed before the brake was let off last (T12).
    """
    return is_entered_slowly(site, system, system.slowing.curve, site.table.curve_mm_s) and is_entered_slowly(
        site, system, system.slowing.turnout, site.table.turnout_mm_s
    )


def is_entered_slowly(site: Vehicle, system: Approach, nearest: Reckoned, restricted_mm_s: int) -> bool:
    """Tell whether the head is not there, or the train slow; what the line's own speed allows is no restriction."""
    slow_um_s = UM_A_MM * larger(0, restricted_mm_s)
    return (
        restricted_mm_s >= site.table.line_mm_s
        or system.head_nm <= nearest.kept_nm
        or (system.speed_um_s <= slow_um_s and system.slowing.from_um_s <= slow_um_s)
    )


def no_head_passes_the_end_that_it_was_let_run_to(site: Vehicle, system: Approach) -> bool:
    """Whatever ends are taken since: what is listed beyond it is not reached before the brake is let off anew (T12)."""
    return system.head_nm <= system.slowing.end.kept_nm


def no_train_is_faster_than_the_ceiling_that_it_keeps_to(site: Vehicle, system: Approach) -> bool:
    """Whatever becomes of it: also while the brake responds, and whoever demands it (X2, T12)."""
    return system.speed_um_s <= UM_A_MM * system.ceiling.most_mm_s


# ---- what they rest on


def a_withheld_end_keeps_the_brake_applied(site: Vehicle, system: Approach) -> bool:
    """While no end is wanted, or a nearer one than is held, no acknowledgement releases the brake (T9, T12)."""
    return (not system.brake.withheld or system.brake.applied) and (
        system.brake.withheld or (system.wanted and system.brake.end_mm <= system.wanted_mm)
    )


def the_response_ends(site: Vehicle, system: Approach) -> bool:
    """The brake responds in no negative time, and in its full time if it is off (T12)."""
    return system.response_cycles >= 0 and (
        system.brake.applied or system.response_cycles == site.bounds.response_cycles
    )


def it_gets_no_faster_before_the_response(site: Vehicle, system: Approach) -> bool:
    """Until the brake has responded the speed stays below the worst that was reckoned with (T12)."""
    return (
        larger(0, system.speed_um_s) + system.response_cycles * LONGEST_MS * site.bounds.gains_mm_s2
        <= system.worst_um_s
    )


def it_gets_no_farther_before_the_response(site: Vehicle, system: Approach) -> bool:
    """Until the brake has responded the head stays short of the place that was reckoned with (T12)."""
    return system.head_nm + system.response_cycles * LONGEST_MS * system.worst_um_s <= system.reach_nm


def the_way_left_lies_before_the_end(site: Vehicle, system: Approach) -> bool:
    """From that place, the cycle in which the brake takes hold and the way left end before the authority does (T12)."""
    return (
        system.left_nm >= 0
        and system.reach_nm + LONGEST_MS * system.worst_um_s + system.left_nm <= NM_A_MM * system.brake.end_mm
    )


def the_way_left_is_enough(site: Vehicle, system: Approach) -> bool:
    """The guaranteed brake stops the train from the worst speed within the way left: u² <= 2 b s (T12)."""
    return system.worst_um_s * system.worst_um_s <= 2 * slows_mm_s2(site.bounds) * system.left_nm


# ---- what slowing down rests on


def no_listed_restriction_lies_nearer(site: Vehicle, system: Approach) -> bool:
    """Whatever truly restricts the train, and is listed, is known to the unit no farther away than it is (T1, T12)."""
    ahead = system.slowing.ahead
    return (
        NM_A_MM * ahead.curve_mm <= system.slowing.curve_nm and NM_A_MM * ahead.turnout_mm <= system.slowing.turnout_nm
    )


def a_train_that_slows_gets_no_faster(site: Vehicle, system: Approach) -> bool:
    """Until the brake has responded the speed stays below what was reckoned with when it was last off (T12)."""
    slows = system.slowing
    return (
        slows.response_cycles >= 0
        and slows.worst_um_s >= 0
        and (system.brake.applied or slows.response_cycles == site.bounds.response_cycles)
        and larger(0, system.speed_um_s) + slows.response_cycles * LONGEST_MS * site.bounds.gains_mm_s2
        <= slows.worst_um_s
    )


def a_train_that_slows_gets_no_farther(site: Vehicle, system: Approach) -> bool:
    """Until then the head stays short of the place that was reckoned with (T12)."""
    slows = system.slowing
    return system.head_nm + slows.response_cycles * LONGEST_MS * slows.worst_um_s <= slows.reach_nm


def the_way_to_a_restriction_lies_before_it(site: Vehicle, system: Approach) -> bool:
    """From that place, the cycle in which the brake takes hold and the way left end before the restriction (T12)."""
    slows = system.slowing
    to_nm = slows.reach_nm + LONGEST_MS * slows.worst_um_s
    return to_nm + slows.curve.left_nm <= slows.curve.kept_nm and to_nm + slows.turnout.left_nm <= slows.turnout.kept_nm


def the_way_to_a_restriction_is_enough(site: Vehicle, system: Approach) -> bool:
    """The guaranteed brake slows the train within the way left to what is allowed there: u² - v² <= 2 b s (T12)."""
    return is_way_enough(site, system, system.slowing.curve, site.table.curve_mm_s) and is_way_enough(
        site, system, system.slowing.turnout, site.table.turnout_mm_s
    )


def is_way_enough(site: Vehicle, system: Approach, nearest: Reckoned, restricted_mm_s: int) -> bool:
    """Tell so of one (T12)."""
    fast_um_s, slow_um_s = system.slowing.worst_um_s, nearest.slow_um_s
    return (
        restricted_mm_s >= site.table.line_mm_s
        or fast_um_s <= slow_um_s
        or fast_um_s * fast_um_s - slow_um_s * slow_um_s <= 2 * system.slowing.slows_mm_s2 * nearest.left_nm
    )


def it_is_reckoned_with_no_more_than_is_guaranteed(site: Vehicle, system: Approach) -> bool:
    """Neither with more of the brake than it gives, nor with a greater speed than is allowed (T12)."""
    slows = system.slowing
    return (
        0 < slows.slows_mm_s2 <= slows_mm_s2(site.bounds)
        and 0 <= slows.curve.slow_um_s <= slowing.allowed_um_s(site.table.curve_mm_s)
        and 0 <= slows.turnout.slow_um_s <= slowing.allowed_um_s(site.table.turnout_mm_s)
    )


def the_way_to_stop_lies_before_the_end(site: Vehicle, system: Approach) -> bool:
    """From that place, the cycle in which the brake takes hold and the way left end before the end of then (T12)."""
    slows = system.slowing
    return slows.reach_nm + LONGEST_MS * slows.worst_um_s + slows.end.left_nm <= slows.end.kept_nm


def the_way_to_stop_is_enough(site: Vehicle, system: Approach) -> bool:
    """The guaranteed brake stops the train within the way left to the end of then: u² <= 2 b s (T12)."""
    slows = system.slowing
    return slows.end.left_nm >= 0 and slows.worst_um_s * slows.worst_um_s <= 2 * slows.slows_mm_s2 * slows.end.left_nm


# ---- what a ceiling rests on


def the_worst_is_no_faster_than_the_ceiling(site: Vehicle, system: Approach) -> bool:
    """What was reckoned with when the brake was last off, or the ceiling taken, is no faster than that (X2, T12)."""
    return system.keeping.worst_um_s <= UM_A_MM * system.ceiling.most_mm_s


def a_train_that_keeps_to_a_ceiling_gets_no_faster(site: Vehicle, system: Approach) -> bool:
    """Until the brake has responded the speed stays below what was reckoned with, the motors cut off sooner (T12)."""
    keeping, bounds = system.keeping, site.bounds
    gained_um_s = keeping.cut_cycles * LONGEST_MS * bounds.gains_mm_s2
    gained_on_um_s = keeping.falling_cycles * LONGEST_MS * bounds.falls_mm_s2
    return larger(0, system.speed_um_s) + gained_um_s + gained_on_um_s <= keeping.worst_um_s


def motors_are_cut_off_before_the_brake_responds(site: Vehicle, system: Approach) -> bool:
    """Neither takes a negative time, and each its full time while the brake is off (T12)."""
    keeping, bounds = system.keeping, site.bounds
    return (
        keeping.cut_cycles >= 0
        and keeping.falling_cycles >= 0
        and (
            system.brake.applied
            or (
                keeping.cut_cycles == bounds.cut_cycles
                and keeping.falling_cycles == bounds.response_cycles - bounds.cut_cycles
            )
        )
    )


INITIAL = (the_train_stands_inside_its_authority,)
SAFETY = (
    head_stays_inside_authority,
    a_demanded_brake_is_applied,
    no_brake_is_released_before_the_train_stands,
    no_end_is_held_beyond_the_one_wanted,
    no_train_enters_a_listed_restriction_faster_than_permitted,
    no_head_passes_the_end_that_it_was_let_run_to,
    no_train_is_faster_than_the_ceiling_that_it_keeps_to,
)
INVARIANTS = (
    *SAFETY,
    a_withheld_end_keeps_the_brake_applied,
    the_response_ends,
    it_gets_no_faster_before_the_response,
    it_gets_no_farther_before_the_response,
    the_way_left_lies_before_the_end,
    the_way_left_is_enough,
    no_listed_restriction_lies_nearer,
    a_train_that_slows_gets_no_faster,
    a_train_that_slows_gets_no_farther,
    the_way_to_a_restriction_lies_before_it,
    the_way_to_a_restriction_is_enough,
    it_is_reckoned_with_no_more_than_is_guaranteed,
    the_way_to_stop_lies_before_the_end,
    the_way_to_stop_is_enough,
    the_worst_is_no_faster_than_the_ceiling,
    a_train_that_keeps_to_a_ceiling_gets_no_faster,
    motors_are_cut_off_before_the_brake_responds,
)
PREMISES = (the_brake_slows, the_motors_are_cut_off_before_it_does)
STEPS = (run_a_cycle, take_end, withhold_end, list_tag, list_none, keep_to, be_let_go)

THEORY = Theory(
    "braking",
    Vehicle,
    Approach,
    by_name(STEPS),
    by_name(INITIAL),
    by_name(INVARIANTS),
    by_name(SAFETY),
    by_name(PREMISES),
)
