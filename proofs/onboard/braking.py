"""What is claimed of the brake control: the head stays inside the authority, for every motion (T12)."""

from __future__ import annotations

from kernel.onboard import braking
from models.onboard.braking import (
    Approach,
    Vehicle,
    run_a_cycle,
    slows_mm_s2,
    take_end,
    the_brake_slows,
    withhold_end,
)
from models.onboard.units import LONGEST_MS, NM_A_MM, larger
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


# ---- what they rest on


def a_withheld_end_keeps_the_brake_applied(site: Vehicle, system: Approach) -> bool:
    """While no end is wanted, or a nearer one than is held, no acknowledgement releases the brake (T9, T12)."""
    return (not system.brake.withheld or system.brake.applied) and (
        system.brake.withheld or (system.wanted and system.brake.end_mm <= system.wanted_mm)
    )


def the_worst_speed_is_not_negative(site: Vehicle, system: Approach) -> bool:
    """The worst that is reckoned with is a train that runs forward (T12)."""
    return system.worst_um_s >= 0


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
    return system.worst_um_s * system.worst_um_s <= 2 * slows_mm_s2(site) * system.left_nm


INITIAL = (the_train_stands_inside_its_authority,)
SAFETY = (
    head_stays_inside_authority,
    a_demanded_brake_is_applied,
    no_brake_is_released_before_the_train_stands,
    no_end_is_held_beyond_the_one_wanted,
)
INVARIANTS = (
    *SAFETY,
    a_withheld_end_keeps_the_brake_applied,
    the_worst_speed_is_not_negative,
    the_response_ends,
    it_gets_no_faster_before_the_response,
    it_gets_no_farther_before_the_response,
    the_way_left_lies_before_the_end,
    the_way_left_is_enough,
)
PREMISES = (the_brake_slows,)
STEPS = (run_a_cycle, take_end, withhold_end)

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
