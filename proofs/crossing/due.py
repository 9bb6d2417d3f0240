"""What is claimed of the answers to when a train is due: until then it cannot arrive, whatever it does (X2, X4)."""

from __future__ import annotations

from kernel.crossing import arrival
from models.crossing.due import (
    Answered,
    Way,
    acknowledge,
    answer,
    arrive,
    bounds_are_above_zero,
    keep_to,
    restart,
    run_a_cycle,
    take_ceiling,
    take_ranging,
)
from proofs.theory import Theory, by_name


def nothing_is_secured(site: Way, system: Answered) -> bool:
    """At the start there is no answer, and the train is anywhere within the line's speed (X2)."""
    return (
        system.left_cycles == 0
        and system.sooner_cycles == 0
        and system.worst.way_um <= system.way_um
        and system.pace_um <= site.bounds.line_um
        and system.ceiling_um == site.bounds.line_um
        and system.worst.short_um == 0
        and system.worst.ceiling_um == site.bounds.line_um
        and system.followed.age_cycles > site.bounds.silence_cycles
        and 0 <= system.followed.short_um <= site.bounds.line_um
        and system.followed.ceiling_um == site.bounds.line_um
        and system.followed.told_way_mm == system.brought.way_mm
        and system.followed.told_speed_mm_s == system.brought.towards_mm_s >= 0
    )


# ---- safety


def nobody_arrives_before_he_can(site: Way, system: Answered) -> bool:
    """Within the cycles that an answer secures the train is not at the crossing (X2, X4)."""
    return system.sooner_cycles <= 0


# ---- what it rests on


def no_pace_is_beyond_its_ceiling(site: Way, system: Answered) -> bool:
    """What is reckoned with is no faster than its ceiling, does not move away, and has no lower one than the train."""
    return (
        0 <= system.followed.short_um <= system.followed.ceiling_um
        and 0 <= system.worst.short_um <= system.worst.ceiling_um
        and system.pace_um <= system.ceiling_um
        and system.ceiling_um <= system.followed.ceiling_um <= site.bounds.line_um
        and system.ceiling_um <= system.worst.ceiling_um <= site.bounds.line_um
    )


def the_ranging_before_is_kept(site: Way, system: Answered) -> bool:
    """The machine knows what the last one told that counted (X1)."""
    return (
        system.followed.told_way_mm == system.brought.way_mm
        and system.followed.told_speed_mm_s == system.brought.towards_mm_s >= 0
    )


def what_is_followed_bounds_the_train(site: Way, system: Answered) -> bool:
    """While the ranging counts, the train is no nearer and no faster than the crossing holds it to be (X2)."""
    return system.followed.age_cycles > site.bounds.silence_cycles or (
        system.followed.way_um <= system.way_um
        and system.pace_um <= system.followed.ceiling_um - system.followed.short_um
    )


def the_worst_bounds_the_train(site: Way, system: Answered) -> bool:
    """The train is no nearer and no faster than the worst since the answer (X2)."""
    return system.worst.way_um <= system.way_um and system.pace_um <= system.worst.ceiling_um - system.worst.short_um


def even_the_worst_cannot_arrive_too_early(site: Way, system: Answered) -> bool:
    """For what is left, even the worst does not arrive (X2)."""
    return system.left_cycles <= 0 or arrival.cannot_arrive(site.bounds, system.worst, system.left_cycles)


INITIAL = (nothing_is_secured,)
SAFETY = (nobody_arrives_before_he_can,)
INVARIANTS = (
    *SAFETY,
    no_pace_is_beyond_its_ceiling,
    the_ranging_before_is_kept,
    what_is_followed_bounds_the_train,
    the_worst_bounds_the_train,
    even_the_worst_cannot_arrive_too_early,
)
PREMISES = (bounds_are_above_zero,)
STEPS = (take_ranging, keep_to, take_ceiling, acknowledge, answer, run_a_cycle, arrive, restart)

THEORY = Theory(
    "due",
    Way,
    Answered,
    by_name(STEPS),
    by_name(INITIAL),
    by_name(INVARIANTS),
    by_name(SAFETY),
    by_name(PREMISES),
)
