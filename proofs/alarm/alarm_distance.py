"""What is claimed of the distance: no train is nearer than reckoned, and one that departs has passed (A1, A3)."""

from __future__ import annotations

from kernel.alarm import distance
from kernel.alarm.distance import PAST_MM, UM_A_MM, Direction
from kernel.onboard.arithmetic import magnitude
from models.alarm.alarm_distance import (
    Line,
    Lookout,
    gap_um,
    no_train_is_longer_than_written,
    no_train_turns_sooner,
    run_on,
    take_train_fix,
    take_worker_fix,
)
from proofs.theory import Theory, by_name

# ---- the start


def nothing_was_told(site: Line, system: Lookout) -> bool:
    """At the start nothing is known of train and worker, wherever they are (A8)."""
    return system.train == distance.NO_TRAIN_FIX and system.worker == distance.NO_WORKER_FIX


# ---- safety


def no_train_is_nearer_than_reckoned(site: Line, system: Lookout) -> bool:
    """Where both have a fix, each part of the train is at least as far from the worker as reckoned (A1)."""
    return not both_have_a_fix(system) or (
        distance.nearest_um(site.bounds, system.train, system.worker)
        <= gap_um(site, system.antenna_um, system.worker_um)
    )


def a_departing_train_has_passed_and_goes_away(site: Line, system: Lookout) -> bool:
    """What departs is past by 100 m from end to end, and ran last away from the worker (A3)."""
    if not distance.is_departing(site.bounds, system.train, system.worker):
        return True
    away = Direction.DOWN if system.antenna_um > system.worker_um else Direction.UP
    return gap_um(site, system.antenna_um, system.worker_um) >= UM_A_MM * PAST_MM and system.heading == away


# ---- what it rests on


def both_have_a_fix(system: Lookout) -> bool:
    """Tell whether something is known of both."""
    return distance.is_fix(system.train.place_mm, system.train.age_ms) and distance.is_fix(
        system.worker.place_mm, system.worker.age_ms
    )


def the_train_is_within_reach_of_its_fix(site: Line, system: Lookout) -> bool:
    """The antenna has got no farther from where it was told than error and age allow (A1)."""
    return not distance.is_fix(system.train.place_mm, system.train.age_ms) or (
        magnitude(system.antenna_um - UM_A_MM * system.train.place_mm)
        <= distance.train_off_um(site.bounds, system.train)
    )


def the_worker_is_within_reach_of_his_fix(site: Line, system: Lookout) -> bool:
    """Nor has the worker (A1)."""
    return not distance.is_fix(system.worker.place_mm, system.worker.age_ms) or (
        magnitude(system.worker_um - UM_A_MM * system.worker.place_mm)
        <= distance.worker_off_um(site.bounds, system.worker)
    )


def a_told_direction_still_holds(site: Line, system: Lookout) -> bool:
    """While it counts, the direction told is not against that of the train (A3)."""
    return no_train_turns_sooner(site, system.train, system.heading)


INITIAL = (nothing_was_told,)
SAFETY = (no_train_is_nearer_than_reckoned, a_departing_train_has_passed_and_goes_away)
INVARIANTS = (
    *SAFETY,
    the_train_is_within_reach_of_its_fix,
    the_worker_is_within_reach_of_his_fix,
    a_told_direction_still_holds,
)
PREMISES = (no_train_is_longer_than_written,)
STEPS = (run_on, take_train_fix, take_worker_fix)

THEORY = Theory(
    "alarm_distance",
    Line,
    Lookout,
    by_name(STEPS),
    by_name(INITIAL),
    by_name(INVARIANTS),
    by_name(SAFETY),
    by_name(PREMISES),
)
