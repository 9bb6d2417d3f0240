"""What is claimed of the watch on the brake: it accuses whoever breaks the bounds visibly, and nobody else (T12)."""

from __future__ import annotations

from kernel.onboard import brake_watch as machine
from models.onboard.brake_watch import (
    Vehicle,
    Watched,
    inspect,
    motors_do_not_slow,
    release,
    restart,
    run_a_cycle,
)
from models.onboard.units import UM_A_MM, larger
from proofs.theory import Theory, by_name


def the_watch_begins(site: Vehicle, system: Watched) -> bool:
    """At the start the train is at rest, and motors and brake are yet to be inspected (T8, T12)."""
    return (
        system.cycles == 0
        and system.kept
        and not system.inspected
        and system.speed_um_s <= 0
        and system.watch == machine.restarted()
        and system.allowed_mm_s == system.watch.limit_mm_s
        and not system.too_fast
    )


def broken_means_a_bound_was_broken(site: Vehicle, system: Watched) -> bool:
    """What the watch calls broken was broken: a train found sound that keeps to the bounds is never accused (T12)."""
    return not system.watch.broken or not system.kept or not system.inspected


def no_brake_counts_as_sound_before_it_was_inspected(site: Vehicle, system: Watched) -> bool:
    """Since the unit began: that a bound was broken is not forgotten by switching it off and on (T8, T12)."""
    return system.watch.broken or system.inspected


def a_train_certainly_too_fast_is_accused(site: Vehicle, system: Watched) -> bool:
    """Once faster than motors and brake allow, by the lower end of its range: broken, until inspected (T8, T12)."""
    return not system.too_fast or system.watch.broken


def a_train_that_keeps_is_no_faster_than_the_limit(site: Vehicle, system: Watched) -> bool:
    """While the bounds are kept, the train is no faster than the limit; what is faster is found out (T12)."""
    return not system.kept or larger(0, system.speed_um_s) <= UM_A_MM * system.watch.limit_mm_s


def the_watch_counts_with_the_brake(site: Vehicle, system: Watched) -> bool:
    """The watch counts the brake's response as it is (T12)."""
    return system.watch.cycles == system.cycles


def the_limit_is_what_the_bounds_allow(site: Vehicle, system: Watched) -> bool:
    """The watch allows what the bounds do, and no more (T12)."""
    return system.watch.limit_mm_s == system.allowed_mm_s


INITIAL = (the_watch_begins,)
SAFETY = (
    broken_means_a_bound_was_broken,
    no_brake_counts_as_sound_before_it_was_inspected,
    a_train_certainly_too_fast_is_accused,
)
INVARIANTS = (
    *SAFETY,
    a_train_that_keeps_is_no_faster_than_the_limit,
    the_watch_counts_with_the_brake,
    the_limit_is_what_the_bounds_allow,
)
PREMISES = (motors_do_not_slow,)
STEPS = (run_a_cycle, release, restart, inspect)

THEORY = Theory(
    "brake_watch",
    Vehicle,
    Watched,
    by_name(STEPS),
    by_name(INITIAL),
    by_name(INVARIANTS),
    by_name(SAFETY),
    by_name(PREMISES),
)
