"""What is claimed at the joint: that a train obeys its authority is a theorem, not an assumption (T4, T12)."""

from __future__ import annotations

from models.onboard.joint import (
    Joint,
    Survey,
    begin,
    blocks_end_one_after_another,
    every_route_has_an_overlap,
    head_runs,
    tail_leaves,
    take_end,
    train_rolls,
    unit_changes,
)
from models.world.assumptions import a_train_obeys_its_authority
from proofs.theory import Theory, by_name

# ---- the start


def no_train_has_begun(site: Survey, system: Joint) -> bool:
    """At the start no head is counted along any run, and no tail has left anything (T4)."""
    return (
        not any(True for run in system.head_mm)
        and not any(True for run in system.end_mm)
        and not any(True for run, block in system.leavable)
        and not any(True for run, block in system.system.track.behind)
    )


# ---- safety


def a_head_that_can_leave_obeys_its_authority(site: Survey, system: Joint) -> bool:
    """A rolling head that can still leave a block does so as the interlocking's proof assumes of it (T4, T12).

    It can leave a block that it has not left yet and that ends short of the end its brake keeps to.
    """
    return all(
        system.head_mm[run] > site.block_ends_mm[run.route][block]
        or site.block_ends_mm[run.route][block] >= system.end_mm[run]
        or run not in system.system.track.rolling
        or run.train not in system.system.units
        or a_train_obeys_its_authority(site.site, system.system, run, block)
        for run in system.head_mm
        if run in system.end_mm
        if run.route in site.block_ends_mm
        for block in site.block_ends_mm[run.route]
    )


def no_head_is_beyond_its_end(site: Survey, system: Joint) -> bool:
    """No head is beyond the end of its authority (T12)."""
    return all(run in system.end_mm and system.head_mm[run] <= system.end_mm[run] for run in system.head_mm)


# ---- what they rest on


def what_lies_before_the_end_could_be_left(site: Survey, system: Joint) -> bool:
    """Every block that ends between head and end might be left when the end was taken (T12)."""
    return all(
        system.head_mm[run] > site.block_ends_mm[run.route][block]
        or site.block_ends_mm[run.route][block] >= system.end_mm[run]
        or (run, block) in system.leavable
        for run in system.head_mm
        if run in system.end_mm
        if run.route in site.block_ends_mm
        for block in site.block_ends_mm[run.route]
    )


def a_block_that_could_be_left_has_a_way_on(site: Survey, system: Joint) -> bool:
    """From a block that might be left the way goes on, and not into the overlap (T9)."""
    return all(
        run.route in site.site.layout.way
        and block in site.site.layout.way[run.route]
        and site.site.layout.way[run.route][block] not in site.site.layout.overlap[run.route]
        for run, block in system.leavable
    )


def what_is_behind_was_passed(site: Survey, system: Joint) -> bool:
    """The head is past the end of every block that the tail has left (T2)."""
    return all(
        run in system.head_mm
        and run.route in site.block_ends_mm
        and block in site.block_ends_mm[run.route]
        and site.block_ends_mm[run.route][block] < system.head_mm[run]
        for run, block in system.system.track.behind
    )


INITIAL = (no_train_has_begun,)
SAFETY = (a_head_that_can_leave_obeys_its_authority, no_head_is_beyond_its_end)
INVARIANTS = (
    *SAFETY,
    what_lies_before_the_end_could_be_left,
    a_block_that_could_be_left_has_a_way_on,
    what_is_behind_was_passed,
)
PREMISES = (blocks_end_one_after_another, every_route_has_an_overlap)
STEPS = (begin, take_end, head_runs, unit_changes, train_rolls, tail_leaves)

THEORY = Theory(
    "joint",
    Survey,
    Joint,
    by_name(STEPS),
    by_name(INITIAL),
    by_name(INVARIANTS),
    by_name(SAFETY),
    by_name(PREMISES),
    quantified=True,
)
