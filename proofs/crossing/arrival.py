"""What is claimed of the rule for warning: no train arrives before the warning time, whatever it does (X2, X3)."""

from __future__ import annotations

from kernel.crossing import arrival
from kernel.onboard.arithmetic import smaller
from models.crossing.arrival import (
    Coming,
    Crossing,
    Taken,
    acknowledge,
    arrive,
    bounds_are_above_zero,
    decide,
    is_of_this_line,
    keep_to,
    run_a_cycle,
    take_ceiling,
    take_ranging,
    towards_mm_s,
    turn_back,
)
from models.measures import UM_A_MM
from proofs.theory import Theory, by_name

# ---- the start


def contact_is_made_in_time(site: Crossing, system: Coming) -> bool:
    """At first contact the train is bounded by a ranging, and before the start point; else that one warns (X1, X3).

    There not even a train at the line's greatest speed arrives within the warning time and the cycle until a decision,
    and what is gained in a cycle to spare.
    """
    return (
        not system.decided
        and not system.arrived
        and not system.followed.warns
        and system.warned_cycles == 0
        and system.followed.age_cycles == 0
        and system.silent_cycles == 0
        and system.followed.way_um <= system.way_um
        and system.pace_um <= site.bounds.line_um - system.followed.short_um
        and system.ceiling_um == site.bounds.line_um
        and 0 <= system.followed.short_um <= site.bounds.line_um
        and system.followed.ceiling_um == site.bounds.line_um
        and system.worst.way_um == system.followed.way_um
        and system.worst.short_um == system.followed.short_um
        and system.worst.ceiling_um == site.bounds.line_um
        and system.left_cycles == site.bounds.warning_cycles + 1
        and system.worst.way_um > (site.bounds.warning_cycles + 1) * site.bounds.line_um + site.bounds.gain_um
        and is_of_this_line(site.bounds, system.told)
        and arrival.begins_contact(site.bounds, system.told)
        and system.told.age_cycles == 0
        and UM_A_MM * system.told.way_mm <= system.way_um
        and system.pace_um <= site.bounds.cycle_ms * system.told.speed_mm_s
        and system.followed.told_way_mm == system.brought.way_mm == system.told.way_mm
        and system.followed.told_speed_mm_s == system.brought.towards_mm_s == towards_mm_s(system.told)
        and not system.contradicted
        and system.ranged == Taken(system.way_um, system.pace_um, 0)
        and not system.let_go.is_any
    )


# ---- safety


def warned_long_enough_before_the_arrival(site: Crossing, system: Coming) -> bool:
    """When the head is at the crossing, the warning had lasted the warning time as that cycle began (X2, X5)."""
    return not system.arrived or system.warned_cycles > site.bounds.warning_cycles


def lost_ranging_warns(site: Crossing, system: Coming) -> bool:
    """A train in contact is warned of once the radio was silent, or hung, for longer than a ranging counts (X3)."""
    return system.followed.warns or system.silent_cycles <= site.bounds.silence_cycles + 1


def a_ranging_that_contradicts_the_one_before_warns(site: Crossing, system: Coming) -> bool:
    """Two that count, one after the other, and cannot both be of this train: it is warned of now, and stays so (X1)."""
    return system.followed.warns or not system.contradicted


def who_is_let_go_is_before_its_start_point(site: Crossing, system: Coming) -> bool:
    """Of a train that is taken for one that has turned back, the head is farther than its start point (X4)."""
    return not system.let_go.is_any or system.let_go.way_um > UM_A_MM * system.let_go.start_mm


# ---- what it rests on


def who_is_not_warned_of_is_bounded(site: Crossing, system: Coming) -> bool:
    """A decision not to warn rests on a ranging that counts (X3)."""
    return not system.decided or system.followed.warns or system.followed.age_cycles <= site.bounds.silence_cycles


def the_ranging_before_is_kept(site: Crossing, system: Coming) -> bool:
    """The machine knows what the last one told that counted and, while it counts, how old it is (X1)."""
    is_kept = (
        system.followed.told_way_mm == system.brought.way_mm == system.told.way_mm
        and system.followed.told_speed_mm_s == system.brought.towards_mm_s == towards_mm_s(system.told)
    )
    if system.told.age_cycles > site.bounds.silence_cycles:
        return is_kept and system.followed.age_cycles > site.bounds.silence_cycles
    return (
        is_kept and is_of_this_line(site.bounds, system.told) and system.followed.age_cycles == system.told.age_cycles
    )


def no_pace_is_beyond_its_ceiling(site: Crossing, system: Coming) -> bool:
    """What is reckoned with is no faster than its ceiling, does not move away, and has no lower one than the train."""
    return (
        0 <= system.followed.short_um <= system.followed.ceiling_um
        and 0 <= system.worst.short_um <= system.worst.ceiling_um
        and system.pace_um <= system.ceiling_um
        and system.ceiling_um <= system.followed.ceiling_um <= site.bounds.line_um
        and system.ceiling_um <= system.worst.ceiling_um <= site.bounds.line_um
    )


def the_ranging_still_bounds_the_train(site: Crossing, system: Coming) -> bool:
    """Since the ranging the train has come no nearer than at the line's speed, and gained no more than it can (X1).

    By what was so when it was taken, and by what was told of the last one that counts.
    """
    ranged, told, bounds = system.ranged, system.told, site.bounds
    return (
        ranged.age_cycles >= 0
        and ranged.way_um - ranged.age_cycles * bounds.line_um <= system.way_um
        and system.pace_um <= ranged.pace_um + ranged.age_cycles * bounds.gain_um
        and UM_A_MM * told.way_mm - told.age_cycles * bounds.line_um <= system.way_um
        and system.pace_um <= bounds.cycle_ms * told.speed_mm_s + told.age_cycles * bounds.gain_um
    )


def no_ranging_counts_as_newer_than_it_is(site: Crossing, system: Coming) -> bool:
    """What the crossing rests on is as old as the radio's silence, or too old to count (X3)."""
    least_cycles = system.silent_cycles - 1 if system.decided else system.silent_cycles
    return (
        system.followed.age_cycles >= 0
        and smaller(least_cycles, site.bounds.silence_cycles + 1) <= system.followed.age_cycles
    )


def what_is_followed_bounds_the_train(site: Crossing, system: Coming) -> bool:
    """While the ranging counts, the train is no nearer and no faster than the crossing holds it to be (X2)."""
    return system.followed.age_cycles > site.bounds.silence_cycles or (
        system.followed.way_um <= system.way_um
        and system.pace_um <= system.followed.ceiling_um - system.followed.short_um
    )


def the_worst_bounds_the_train(site: Crossing, system: Coming) -> bool:
    """The train is no nearer and no faster than the worst since the last decision not to warn (X2)."""
    return system.worst.way_um <= system.way_um and system.pace_um <= system.worst.ceiling_um - system.worst.short_um


def cycles_are_counted_from_none(site: Crossing, system: Coming) -> bool:
    """Silence and warning last no negative time, and what is not warned of counts no cycle (X2, X3)."""
    return (
        system.silent_cycles >= 0 and system.warned_cycles >= 0 and (system.followed.warns or system.warned_cycles == 0)
    )


def what_is_not_warned_of_is_left(site: Crossing, system: Coming) -> bool:
    """The warning and what is left last the warning time, the cycle of arrival and that until a decision (X2)."""
    begun_cycles = 1 if system.decided and not system.followed.warns else 0
    return system.warned_cycles + system.left_cycles == site.bounds.warning_cycles + 1 + begun_cycles


def even_the_worst_cannot_arrive_too_early(site: Crossing, system: Coming) -> bool:
    """For what is left of the warning time, even the worst does not arrive (X2)."""
    return system.left_cycles <= 0 or arrival.cannot_arrive(site.bounds, system.worst, system.left_cycles)


INITIAL = (contact_is_made_in_time,)
SAFETY = (
    warned_long_enough_before_the_arrival,
    lost_ranging_warns,
    a_ranging_that_contradicts_the_one_before_warns,
    who_is_let_go_is_before_its_start_point,
)
INVARIANTS = (
    *SAFETY,
    who_is_not_warned_of_is_bounded,
    the_ranging_before_is_kept,
    no_pace_is_beyond_its_ceiling,
    the_ranging_still_bounds_the_train,
    no_ranging_counts_as_newer_than_it_is,
    what_is_followed_bounds_the_train,
    the_worst_bounds_the_train,
    cycles_are_counted_from_none,
    what_is_not_warned_of_is_left,
    even_the_worst_cannot_arrive_too_early,
)
PREMISES = (bounds_are_above_zero,)
STEPS = (decide, run_a_cycle, arrive, take_ranging, keep_to, take_ceiling, acknowledge, turn_back)

THEORY = Theory(
    "arrival",
    Crossing,
    Coming,
    by_name(STEPS),
    by_name(INITIAL),
    by_name(INVARIANTS),
    by_name(SAFETY),
    by_name(PREMISES),
)
