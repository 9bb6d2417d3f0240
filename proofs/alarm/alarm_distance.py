"""What is claimed of the distance: no train is nearer than reckoned, and one that departs has passed (A1, A3)."""

from __future__ import annotations

from kernel.alarm import distance
from kernel.alarm.distance import Direction
from models.alarm.alarm_distance import (
    Line,
    Lookout,
    gap_um,
    is_report,
    no_train_is_longer_than_written,
    no_train_turns_sooner,
    receive,
    restart,
    run_on,
    take_train_fix,
    take_worker_fix,
)
from models.measures import UM_A_MM, apart
from proofs.theory import Theory, by_name

# ---- the start


def nothing_was_told(site: Line, system: Lookout) -> bool:
    """At the start nothing is known of train and worker, wherever they are (A8): no report is within its ranges (A1).

    Those are 1000 km from the origin and an hour, as `is_report` states them.
    """
    return (
        not is_report(system.train.place_mm, system.train.age_ms)
        and not is_report(system.worker.place_mm, system.worker.age_ms)
        and not is_report(system.told.place_mm, system.told.age_ms)
        and not is_report(system.unit.place_mm, system.unit.age_ms)
        and not is_report(system.unit.place_mm, 0)
    )


# ---- safety


def no_train_is_nearer_than_reckoned(site: Line, system: Lookout) -> bool:
    """Where both have a fix no part of the train is nearer to the worker than reckoned; else it may be at him (A1)."""
    reckoned_um = distance.nearest_um(site.bounds, system.train, system.worker)
    if not both_have_a_fix(system):
        return reckoned_um <= 0
    return reckoned_um <= gap_um(site, system.antenna_um, system.worker_um)


def a_departing_train_has_passed_and_goes_away(site: Line, system: Lookout) -> bool:
    """What departs is past by 100 m (004, 3.3) from end to end, and ran last away from the worker (A3)."""
    if not distance.is_departing(site.bounds, system.train, system.worker):
        return True
    away = Direction.DOWN if system.antenna_um > system.worker_um else Direction.UP
    return gap_um(site, system.antenna_um, system.worker_um) >= UM_A_MM * 100_000 and system.heading == away


def a_place_is_no_older_than_the_unit_says(site: Line, system: Lookout) -> bool:
    """What the unit sends is within its error and its age's way of where the train is, though its receiver hangs (A1).

    A stamp is believed of a place that is new alone; for how long a place may count is the handset's to say.
    """
    unit = system.unit
    return not is_report(unit.place_mm, unit.age_ms) or (
        apart(system.antenna_um, UM_A_MM * unit.place_mm)
        <= UM_A_MM * site.bounds.train_error_mm + site.bounds.train_mm_s * unit.age_ms
    )


# ---- what it rests on


def both_have_a_fix(system: Lookout) -> bool:
    """Tell whether something is known of both."""
    train, worker = system.train, system.worker
    return is_report(train.place_mm, train.age_ms) and is_report(worker.place_mm, worker.age_ms)


def the_train_is_within_reach_of_its_fix(site: Line, system: Lookout) -> bool:
    """The antenna has got no farther from where it was told than error and age allow (A1)."""
    return not is_report(system.train.place_mm, system.train.age_ms) or (
        apart(system.antenna_um, UM_A_MM * system.train.place_mm) <= distance.train_off_um(site.bounds, system.train)
    )


def the_worker_is_within_reach_of_his_fix(site: Line, system: Lookout) -> bool:
    """Nor has the worker (A1)."""
    return not is_report(system.worker.place_mm, system.worker.age_ms) or (
        apart(system.worker_um, UM_A_MM * system.worker.place_mm) <= distance.worker_off_um(site.bounds, system.worker)
    )


def what_is_held_was_told(site: Line, system: Lookout) -> bool:
    """The handset holds the report that was told last, as old as it is, or nothing (A1)."""
    return not is_report(system.train.place_mm, system.train.age_ms) or system.train == system.told


def the_unit_holds_what_was_received(site: Line, system: Lookout) -> bool:
    """The unit holds the place that its receiver told last, or has started and holds none that can be (A1)."""
    return system.unit.place_mm == system.received_mm or not is_report(system.unit.place_mm, 0)


def a_told_direction_still_holds(site: Line, system: Lookout) -> bool:
    """While it counts, the direction told is not against that of the train (A3)."""
    return no_train_turns_sooner(site, system.told, system.heading)


INITIAL = (nothing_was_told,)
SAFETY = (
    no_train_is_nearer_than_reckoned,
    a_departing_train_has_passed_and_goes_away,
    a_place_is_no_older_than_the_unit_says,
)
INVARIANTS = (
    *SAFETY,
    the_train_is_within_reach_of_its_fix,
    the_worker_is_within_reach_of_his_fix,
    what_is_held_was_told,
    the_unit_holds_what_was_received,
    a_told_direction_still_holds,
)
PREMISES = (no_train_is_longer_than_written,)
STEPS = (run_on, receive, restart, take_train_fix, take_worker_fix)

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
