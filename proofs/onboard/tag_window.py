"""What is claimed of the window for the next tag: no tag elsewhere is taken, and a missing one is noticed (T5)."""

from __future__ import annotations

from kernel.onboard import tag_window as machine
from models.onboard.tag_window import (
    FARTHEST_PLANNED_MM,
    Expecting,
    Stretch,
    expect_a_tag,
    expect_none,
    nothing_is_negative,
    read_a_tag,
    run_a_cycle,
    the_tolerance_covers_laying_and_read_window,
)
from proofs.theory import Theory, by_name

# ---- the start


def no_tag_is_awaited(site: Stretch, system: Expecting) -> bool:
    """At the start no tag is awaited, and none was read (T5)."""
    return (
        system.window == machine.NONE_AWAITED
        and not system.lost
        and not system.missed
        and not system.in_place
        and not system.out_of_place
    )


# ---- safety


def a_tag_out_of_place_by_more_than_tolerance_and_error_is_refused(site: Stretch, system: Expecting) -> bool:
    """A tag is not taken that lies elsewhere than planned, by more than tolerance, width and read window (T5)."""
    return not system.out_of_place or not system.taken


def a_missing_tag_is_noticed_within_a_bounded_way(site: Stretch, system: Expecting) -> bool:
    """At the end of a cycle in which the train is beyond the plan by tolerance and width, the tag is overdue (T5).

    The way to that end of a cycle is the bound: what the train runs in 100 ms comes to it.
    """
    return not system.window.expected or not system.missed or system.window.passed


# ---- service: without it the rest would be claimed of a machine that always refuses


def a_tag_in_its_place_is_never_refused(site: Stretch, system: Expecting) -> bool:
    """A tag that lies as planned is taken, while the odometry knows the way as well as is written (T5)."""
    return not system.in_place or system.taken


def no_tag_still_ahead_is_called_missing(site: Stretch, system: Expecting) -> bool:
    """A tag is overdue only if the train has truly come farther than the tolerance allows, or is lost (T5)."""
    least_mm, most_mm = system.window.least_mm, system.window.most_mm
    return not system.window.passed or system.lost or system.late or not 0 <= least_mm <= most_mm <= FARTHEST_PLANNED_MM


INITIAL = (no_tag_is_awaited,)
SAFETY = (
    a_tag_out_of_place_by_more_than_tolerance_and_error_is_refused,
    a_missing_tag_is_noticed_within_a_bounded_way,
    a_tag_in_its_place_is_never_refused,
    no_tag_still_ahead_is_called_missing,
)
INVARIANTS = SAFETY
PREMISES = (the_tolerance_covers_laying_and_read_window, nothing_is_negative)
STEPS = (run_a_cycle, read_a_tag, expect_a_tag, expect_none)

THEORY = Theory(
    "tag_window",
    Stretch,
    Expecting,
    by_name(STEPS),
    by_name(INITIAL),
    by_name(INVARIANTS),
    by_name(SAFETY),
    by_name(PREMISES),
)
