"""What is claimed of the watch on reverse movement: no train rolls back far without its knowing (T5, T12)."""

from __future__ import annotations

from models.onboard.reverse_movement import Rolling, Wheel, bounds_are_not_negative, locate_anew, run_a_cycle
from proofs.theory import Theory, by_name


def the_train_was_located(site: Wheel, system: Rolling) -> bool:
    """At the start nothing has been read (T8)."""
    return not system.movement.reversed and not system.counts and not system.rolled_back


def a_train_that_rolls_back_too_far_is_found(site: Wheel, system: Rolling) -> bool:
    """Back by more than the limit and the wheel's error, from where it was farthest: reversed, and for good (T5)."""
    return not system.rolled_back or system.movement.reversed


def what_the_wheel_showed_farthest_is_remembered(site: Wheel, system: Rolling) -> bool:
    """The machine remembers no fewer pulses than there were where the front was farthest (T5)."""
    return not system.counts or system.furthest_way_mm <= system.movement.furthest_mm


INITIAL = (the_train_was_located,)
SAFETY = (a_train_that_rolls_back_too_far_is_found,)
INVARIANTS = (*SAFETY, what_the_wheel_showed_farthest_is_remembered)
PREMISES = (bounds_are_not_negative,)
STEPS = (run_a_cycle, locate_anew)

THEORY = Theory(
    "reverse_movement",
    Wheel,
    Rolling,
    by_name(STEPS),
    by_name(INITIAL),
    by_name(INVARIANTS),
    by_name(SAFETY),
    by_name(PREMISES),
)
