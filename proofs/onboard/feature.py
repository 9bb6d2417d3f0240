"""What is claimed of the detection of a feature (P2, P3)."""

from __future__ import annotations

from kernel.onboard import feature as machine
from kernel.onboard.feature import Progress
from models.onboard import feature as world
from models.onboard.feature import UM_A_MM, Looking, Registered
from proofs.theory import Theory, by_name

# ---- the start


def the_feature_is_awaited(site: Registered, system: Looking) -> bool:
    """No detection has begun, and no history is known (P3)."""
    return system.state == machine.AWAITED and system.runs == world.NO_RUNS and system.fixes == 0


# ---- what is claimed


def no_fix_on_partial_match(site: Registered, system: Looking) -> bool:
    """A fix is given only where straight, curve in each part, and straight have matched without a break (P3)."""
    return not machine.has_fix(system.state) or world.all_stages_match(site, system.runs)


def a_fix_follows_every_stage_in_order(site: Registered, system: Looking) -> bool:
    """Before a fix the machine was in each stage, one after the other (P3)."""
    order = system.order
    return not machine.has_fix(system.state) or (
        order.entry < order.first < order.second < order.third < order.leaving < system.cycle
    )


def a_fix_contains_the_front(site: Registered, system: Looking) -> bool:
    """In the cycle of a fix the front is in its range (P3, P7)."""
    return not machine.has_fix(system.state) or (
        UM_A_MM * system.state.fix_least_mm <= system.front_um <= UM_A_MM * system.state.fix_most_mm
    )


def a_feature_gives_one_fix(site: Registered, system: Looking) -> bool:
    """Until it is awaited anew there is one fix at most; odometry gets none twice (P3, P7)."""
    return system.fixes <= 1


def ways_fit_the_processor(site: Registered, system: Looking) -> bool:
    """Every way that is kept was a reading in range, up to a million kilometres (P3)."""
    return 0 <= system.state.from_mm <= 1_000_000_000_000 and 0 <= system.state.way_mm <= 1_000_000_000_000


# ---- what it follows from


def is_in_curve(stage: Progress) -> bool:
    """Tell whether the machine believes to be in the curve."""
    return stage == Progress.FIRST_PART or stage == Progress.SECOND_PART or stage == Progress.THIRD_PART


def an_entry_straight_was_seen(site: Registered, system: Looking) -> bool:
    """On the entry straight, history shows one at least as long (P3)."""
    return system.state.stage != Progress.ENTRY_STRAIGHT or (
        system.runs.usable and system.runs.straight and system.runs.from_mm <= system.state.from_mm
    )


def a_curve_was_seen(site: Registered, system: Looking) -> bool:
    """In the curve, history shows it from the same place on, in band, after an entry straight (P3)."""
    return not is_in_curve(system.state.stage) or (
        system.runs.usable
        and not system.runs.straight
        and system.runs.from_mm == system.state.from_mm
        and system.runs.before_mm >= site.feature.entry_least_mm
        and system.runs.in_band
    )


def its_parts_were_met(site: Registered, system: Looking) -> bool:
    """In the second or third part of the curve, history has met it and those before (P3)."""
    stage = system.state.stage
    return not is_in_curve(stage) or (
        (stage == Progress.FIRST_PART or system.runs.met_second)
        and (stage != Progress.THIRD_PART or system.runs.met_third)
    )


def an_exit_straight_was_seen(site: Registered, system: Looking) -> bool:
    """On the exit straight, history shows it from the same place on, after curve and entry straight (P3)."""
    return system.state.stage != Progress.EXIT_STRAIGHT or (
        system.runs.usable
        and system.runs.straight
        and system.runs.from_mm == system.state.from_mm
        and system.runs.first_mm >= site.feature.entry_least_mm
        and world.curve_matches(site, system.runs)
        and site.feature.length_least_mm <= system.runs.before_mm <= site.feature.length_most_mm
        and system.runs.from_least_mm <= site.feature.end_mm + site.feature.end_error_mm
    )


def stages_come_in_order(site: Registered, system: Looking) -> bool:
    """The machine was in the stages before the present one, one after the other (P3)."""
    stage = system.state.stage
    order = system.order
    curving = is_in_curve(stage)
    leaving = stage == Progress.EXIT_STRAIGHT
    return (
        (stage != Progress.ENTRY_STRAIGHT or order.entry == system.cycle)
        and (not (curving or leaving) or order.entry < order.first <= system.cycle)
        and (not (leaving or stage == Progress.THIRD_PART) or order.second < order.third <= system.cycle)
        and (
            not (leaving or stage == Progress.THIRD_PART or stage == Progress.SECOND_PART) or order.first < order.second
        )
        and (stage != Progress.SECOND_PART or order.second == system.cycle)
        and (not leaving or order.third < order.leaving == system.cycle)
    )


def the_newest_way_is_kept(site: Registered, system: Looking) -> bool:
    """While something is matched, the machine keeps the way of the newest cycle (P3)."""
    stage = system.state.stage
    matching = is_in_curve(stage) or stage == Progress.ENTRY_STRAIGHT or stage == Progress.EXIT_STRAIGHT
    return not matching or (system.runs.usable and system.runs.way_mm == system.state.way_mm)


def the_way_has_grown(site: Registered, system: Looking) -> bool:
    """The wheel's way is no less than where the present run began (P3)."""
    return not system.runs.usable or system.runs.from_mm <= system.runs.way_mm


def after_a_fix_it_is_over(site: Registered, system: Looking) -> bool:
    """There was no fix yet, or there is one in this cycle, or the detection is over (P3)."""
    return system.fixes == 0 or machine.has_fix(system.state) or machine.is_over(system.state)


INITIAL = (the_feature_is_awaited,)
PREMISES = (world.parts_follow_one_another,)
SAFETY = (
    no_fix_on_partial_match,
    a_fix_follows_every_stage_in_order,
    a_fix_contains_the_front,
    a_feature_gives_one_fix,
    ways_fit_the_processor,
)
INVARIANTS = (
    *SAFETY,
    an_entry_straight_was_seen,
    a_curve_was_seen,
    its_parts_were_met,
    an_exit_straight_was_seen,
    stages_come_in_order,
    the_newest_way_is_kept,
    the_way_has_grown,
    after_a_fix_it_is_over,
)

THEORY = Theory(
    "feature",
    Registered,
    Looking,
    by_name((world.run_a_cycle, world.await_feature)),
    by_name(INITIAL),
    by_name(INVARIANTS),
    by_name(SAFETY),
    by_name(PREMISES),
)
