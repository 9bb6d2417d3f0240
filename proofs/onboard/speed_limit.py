"""What is claimed of the speed limit: a train too fast for anything that it is on brakes (T12)."""

from __future__ import annotations

from kernel.onboard import speed_limit
from models.onboard.speed_limit import (
    Passage,
    Profile,
    come_to_listed,
    locate_anew,
    miss_a_tag,
    pass_tag,
    permitted_mm_s,
    run_on,
)
from models.onboard.units import NM_A_MM, UM_A_MM
from proofs.theory import Theory, by_name

# ---- the start


def nothing_is_known_of_the_track(site: Profile, system: Passage) -> bool:
    """At the start no tag has been read, whatever the train stands on, and the brake is on (T8)."""
    return system.limit == speed_limit.UNKNOWN and system.brakes


# ---- safety


def a_train_too_fast_for_any_of_its_track_brakes(site: Profile, system: Passage) -> bool:
    """Faster than line, curve or turnout allows, with any part of the train in it: the brake is demanded (T12)."""
    return system.brakes or keeps_to_its_track(site, system)


def keeps_to_its_track(site: Profile, system: Passage) -> bool:
    """Tell whether the train is no faster than line, curve and turnout allow, with any part of it in them."""
    return system.speed_um_s <= UM_A_MM * permitted_mm_s(site, system)


# ---- what it rests on


def no_restriction_ends_before_the_rear_has_passed(site: Profile, system: Passage) -> bool:
    """Where a curve or a turnout was left is remembered, no nearer than it was, while it does not go on (T12)."""
    return (system.limit.in_curve or system.left_curve_nm <= NM_A_MM * system.limit.curve_until_mm) and (
        system.limit.at_turnout or system.left_turnout_nm <= NM_A_MM * system.limit.turnout_until_mm
    )


def what_the_head_is_on_is_known(site: Profile, system: Passage) -> bool:
    """In a curve, or on a turnout, the limit says so; as well where a list has one and the front may be there (T12)."""
    return (system.limit.in_curve or not (system.in_curve or system.curve_listed)) and (
        system.limit.at_turnout or not (system.at_turnout or system.turnout_listed)
    )


INITIAL = (nothing_is_known_of_the_track,)
SAFETY = (a_train_too_fast_for_any_of_its_track_brakes,)
INVARIANTS = (
    *SAFETY,
    no_restriction_ends_before_the_rear_has_passed,
    what_the_head_is_on_is_known,
)
STEPS = (run_on, pass_tag, miss_a_tag, come_to_listed, locate_anew)

THEORY = Theory(
    "speed_limit",
    Profile,
    Passage,
    by_name(STEPS),
    by_name(INITIAL),
    by_name(INVARIANTS),
    by_name(SAFETY),
)
