"""What is claimed of the watch on the brake: it accuses no train that keeps to the bounds (T12)."""

from __future__ import annotations

from kernel.onboard import brake_watch as machine
from models.onboard.brake_watch import Vehicle, Watched, run_a_cycle
from proofs.theory import Theory, by_name


def the_watch_begins(site: Vehicle, system: Watched) -> bool:
    """At the start the brake has not been commanded, and the train is no faster than was told (T12)."""
    return (
        system.cycles == 0
        and system.kept
        and system.watch == machine.watching(system.watch.limit_mm_s)
        and system.speed_um_s <= 1000 * system.watch.limit_mm_s
    )


def broken_means_a_bound_was_broken(site: Vehicle, system: Watched) -> bool:
    """What the watch calls broken was broken: a train that keeps to the bounds is never accused (T12)."""
    return not system.watch.broken or not system.kept


def a_train_that_keeps_is_no_faster_than_the_limit(site: Vehicle, system: Watched) -> bool:
    """While the bounds are kept, the train is no faster than the limit; what is faster is found out (T12)."""
    return not system.kept or system.speed_um_s <= 1000 * system.watch.limit_mm_s


def the_watch_counts_with_the_brake(site: Vehicle, system: Watched) -> bool:
    """The watch counts the brake's response as it is (T12)."""
    return system.watch.cycles == system.cycles


INITIAL = (the_watch_begins,)
SAFETY = (broken_means_a_bound_was_broken,)
INVARIANTS = (*SAFETY, a_train_that_keeps_is_no_faster_than_the_limit, the_watch_counts_with_the_brake)
STEPS = (run_a_cycle,)

THEORY = Theory(
    "brake_watch",
    Vehicle,
    Watched,
    by_name(STEPS),
    by_name(INITIAL),
    by_name(INVARIANTS),
    by_name(SAFETY),
)
