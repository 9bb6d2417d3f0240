"""A train of some length on a line with curves and turnouts, and what its unit knows of them (T12).

Where the head last left a curve, and a turnout, is all the history there is: what it left before
lies behind that, so the rear has passed it no later.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

from kernel.onboard import speed_limit
from kernel.onboard.speed_limit import SpeedLimit, SpeedTable


@dataclass(frozen=True)
class Profile:
    """What does not change: the line's speeds, and the train's true length (T12, P4)."""

    table: SpeedTable
    length_mm: int


@dataclass(frozen=True)
class Passage:
    """One moment of a train on that line.

    ``front_mm``, ``speed_mm_s``: where its front is, and how fast.
    ``in_curve``, ``at_turnout``: what the track at its front is.
    ``left_curve_mm``, ``left_turnout_mm``: history: where the front last left a curve, a turnout.
    ``limit``: what the unit knows; ``brakes``: whether it demands the emergency brake.
    """

    front_mm: int
    speed_mm_s: int
    in_curve: bool
    at_turnout: bool
    left_curve_mm: int
    left_turnout_mm: int
    limit: SpeedLimit
    brakes: bool


# ---- assumptions


def the_train_runs_forward(system: Passage, to_mm: int) -> bool:
    """The front does not go back; by how much it may before the train brakes, `reverse_movement` says (T5)."""
    return system.front_mm <= to_mm


def the_range_contains_the_train(
    site: Profile,
    front_mm: int,
    speed_mm_s: int,
    known: bool,
    rear_least_mm: int,
    front_most_mm: int,
    speed_most_mm_s: int,
) -> bool:
    """The odometry's theorems, `range_contains_train` and `speed_range…`, while it claims a range (P1, P7)."""
    return not known or (
        rear_least_mm <= front_mm - site.length_mm and front_mm <= front_most_mm and speed_mm_s <= speed_most_mm_s
    )


def a_kind_hides_no_restriction(in_curve: bool, at_turnout: bool, told_curve: bool, told_turnout: bool) -> bool:
    """Whoever writes a tag writes what lies there; what cannot be read is told as the worst case (T1, T12)."""
    return (told_curve or not in_curve) and (told_turnout or not at_turnout)


# ---- transitions


def run_on(
    site: Profile,
    system: Passage,
    to_mm: int,
    speed_mm_s: int,
    known: bool,
    rear_least_mm: int,
    front_most_mm: int,
    speed_most_mm_s: int,
) -> Passage:
    """The train runs on within the stretch of its last tag, at any speed; the unit looks at its own (T12)."""
    if not the_train_runs_forward(system, to_mm):
        return system
    if not the_range_contains_the_train(site, to_mm, speed_mm_s, known, rear_least_mm, front_most_mm, speed_most_mm_s):
        return system
    return replace(
        system,
        front_mm=to_mm,
        speed_mm_s=speed_mm_s,
        brakes=speed_limit.is_overspeed(site.table, system.limit, known, rear_least_mm, speed_most_mm_s),
    )


def pass_tag(
    site: Profile,
    system: Passage,
    in_curve: bool,
    at_turnout: bool,
    told_curve: bool,
    told_turnout: bool,
    known: bool,
    rear_least_mm: int,
    front_most_mm: int,
    speed_most_mm_s: int,
) -> Passage:
    """The front passes a tag, and the track becomes another; a tag that is missed opens the second loop (T5, T12)."""
    if not a_kind_hides_no_restriction(in_curve, at_turnout, told_curve, told_turnout):
        return system
    here_mm = system.front_mm
    if not the_range_contains_the_train(
        site, here_mm, system.speed_mm_s, known, rear_least_mm, front_most_mm, speed_most_mm_s
    ):
        return system
    limit = speed_limit.note_tag(system.limit, told_curve, told_turnout, known, front_most_mm)
    return replace(
        system,
        in_curve=in_curve,
        at_turnout=at_turnout,
        left_curve_mm=here_mm if system.in_curve else system.left_curve_mm,
        left_turnout_mm=here_mm if system.at_turnout else system.left_turnout_mm,
        limit=limit,
        brakes=speed_limit.is_overspeed(site.table, limit, known, rear_least_mm, speed_most_mm_s),
    )


def locate_anew(site: Profile, system: Passage) -> Passage:
    """The unit begins anew with nothing known of the track; so it does at power-on (T8)."""
    return replace(system, limit=speed_limit.UNKNOWN, brakes=True)
