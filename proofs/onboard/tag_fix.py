"""What is claimed of a read: the front was where the unit says, and a tag puts it where it is (T2, P7)."""

from __future__ import annotations

from models.onboard.tag_fix import Antenna, Passing, read_a_tag, the_error_covers_laying_and_read_window
from models.onboard.units import NM_A_MM
from proofs.theory import Theory, by_name


def nothing_was_read(site: Antenna, system: Passing) -> bool:
    """At the start nothing was read, and the unit says nothing of it."""
    return not system.located and not system.place.known


def the_front_was_where_the_read_is_put(site: Antenna, system: Passing) -> bool:
    """When the antenna read, the front was in the place that the unit gives for it (P7)."""
    return not system.place.known or (
        NM_A_MM * system.place.least_mm <= system.read_at_nm <= NM_A_MM * system.place.most_mm
    )


def a_place_is_given_while_the_ranges_are_claimed(site: Antenna, system: Passing) -> bool:
    """While the odometry claims its ranges at both ends of the cycle, and only then, there is such a place (P7)."""
    return system.place.known == system.located


def a_fix_of_a_tag_contains_the_front(site: Antenna, system: Passing) -> bool:
    """Where a tag lies where it is listed, its fix contains the front at the end of the cycle (T2, P7)."""
    return not system.located or (NM_A_MM * system.fix.least_mm <= system.front_nm <= NM_A_MM * system.fix.most_mm)


INITIAL = (nothing_was_read,)
SAFETY = (
    the_front_was_where_the_read_is_put,
    a_place_is_given_while_the_ranges_are_claimed,
    a_fix_of_a_tag_contains_the_front,
)
PREMISES = (the_error_covers_laying_and_read_window,)
STEPS = (read_a_tag,)

THEORY = Theory(
    "tag_fix",
    Antenna,
    Passing,
    by_name(STEPS),
    by_name(INITIAL),
    by_name(SAFETY),
    by_name(SAFETY),
    by_name(PREMISES),
)
