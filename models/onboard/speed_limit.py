"""A train of some length on a line with curves and turnouts, and what its unit knows of them (T12).

Where the head last left a curve, and a turnout, is all the history there is: what it left before
lies behind that, so the rear has passed it no later.  A head that has rolled back to a tag, or beyond it, is on
the track of that one, and has left nothing farther on.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

from kernel.onboard import speed_limit
from kernel.onboard.speed_limit import SpeedLimit, SpeedTable
from models.onboard.units import NM_A_MM, UM_A_MM, smaller


@dataclass(frozen=True)
class Profile:
    """What does not change: the line's speeds, and the train's true length (T12, P4)."""

    table: SpeedTable
    length_mm: int


@dataclass(frozen=True)
class Passage:
    """One moment of a train on that line.

    ``front_nm``, ``speed_um_s``: where its front is, and how fast.
    ``in_curve``, ``at_turnout``: what the track from its last tag on is.
    ``left_curve_nm``, ``left_turnout_nm``: history: where the front last left a curve, a turnout, of those behind it.
    ``curve_listed``, ``turnout_listed``: history: since the last tag that was read the front may have come, by the
    odometry, to where a list has a curve, a turnout.
    ``limit``: what the unit knows; ``brakes``: whether it demands the emergency brake.
    """

    front_nm: int
    speed_um_s: int
    in_curve: bool
    at_turnout: bool
    left_curve_nm: int
    left_turnout_nm: int
    curve_listed: bool
    turnout_listed: bool
    limit: SpeedLimit
    brakes: bool


# ---- assumptions


def the_range_contains_the_train(
    site: Profile,
    front_nm: int,
    speed_um_s: int,
    known: bool,
    rear_least_mm: int,
    front_most_mm: int,
    speed_most_mm_s: int,
) -> bool:
    """The odometry's theorems, `range_contains_train` and `speed_range…`, while it claims a range (P1, P7)."""
    return not known or (
        NM_A_MM * (rear_least_mm + site.length_mm) <= front_nm
        and front_nm <= NM_A_MM * front_most_mm
        and speed_um_s <= UM_A_MM * speed_most_mm_s
    )


def a_kind_hides_no_restriction(in_curve: bool, at_turnout: bool, kind: int) -> bool:
    """Whoever writes a tag writes what lies there: a curve as 3 or 4, a turnout as 5 or 6, both as none (T1, T12).

    The codes that are assigned are 1 to 9 (T1, ours).
    """
    is_assigned = 1 <= kind <= 9
    return (kind == 3 or kind == 4 or not is_assigned or not in_curve) and (
        kind == 5 or kind == 6 or not is_assigned or not at_turnout
    )


def a_list_has_what_a_missed_tag_begins(system: Passage, in_curve: bool, at_turnout: bool) -> bool:
    """What lies from a tag on that is not read goes on, or a list has it where the front may be (T1, T5)."""
    return (not in_curve or system.in_curve or system.curve_listed) and (
        not at_turnout or system.at_turnout or system.turnout_listed
    )


# ---- how fast it may run


def permitted_mm_s(site: Profile, system: Passage) -> int:
    """Give how fast the line, and every curve and turnout that some part of the train is in, lets it run (T12)."""
    rear_nm = system.front_nm - NM_A_MM * site.length_mm
    in_curve = system.in_curve or rear_nm <= system.left_curve_nm
    at_turnout = system.at_turnout or rear_nm <= system.left_turnout_nm
    in_curve_mm_s = smaller(site.table.line_mm_s, site.table.curve_mm_s) if in_curve else site.table.line_mm_s
    return smaller(in_curve_mm_s, site.table.turnout_mm_s) if at_turnout else in_curve_mm_s


# ---- transitions


def run_on(
    site: Profile,
    system: Passage,
    to_nm: int,
    speed_um_s: int,
    known: bool,
    rear_least_mm: int,
    front_most_mm: int,
    speed_most_mm_s: int,
) -> Passage:
    """The train runs on within the stretch of its last tag, at any speed; the unit looks at its own (T12)."""
    if not the_range_contains_the_train(site, to_nm, speed_um_s, known, rear_least_mm, front_most_mm, speed_most_mm_s):
        return system
    return replace(
        system,
        front_nm=to_nm,
        speed_um_s=speed_um_s,
        brakes=speed_limit.is_overspeed(site.table, system.limit, known, rear_least_mm, speed_most_mm_s),
    )


def pass_tag(
    site: Profile,
    system: Passage,
    in_curve: bool,
    at_turnout: bool,
    kind: int,
    known: bool,
    rear_least_mm: int,
    front_most_mm: int,
    speed_most_mm_s: int,
) -> Passage:
    """The front passes a tag, and the track becomes another; a tag that is missed opens the second loop (T5, T12)."""
    if not a_kind_hides_no_restriction(in_curve, at_turnout, kind) or not the_range_contains_the_train(
        site, system.front_nm, system.speed_um_s, known, rear_least_mm, front_most_mm, speed_most_mm_s
    ):
        return system
    limit = speed_limit.note_tag(system.limit, kind, known, front_most_mm)
    read = replace(system, curve_listed=False, turnout_listed=False, limit=limit)
    brakes = speed_limit.is_overspeed(site.table, limit, known, rear_least_mm, speed_most_mm_s)
    return _on_other_track(read, in_curve, at_turnout, brakes)


def miss_a_tag(
    site: Profile,
    system: Passage,
    in_curve: bool,
    at_turnout: bool,
    known: bool,
    rear_least_mm: int,
    front_most_mm: int,
    speed_most_mm_s: int,
) -> Passage:
    """The front passes a tag that is not read, and the track becomes another; the unit knows nothing of it (T5)."""
    if not a_list_has_what_a_missed_tag_begins(system, in_curve, at_turnout) or not the_range_contains_the_train(
        site, system.front_nm, system.speed_um_s, known, rear_least_mm, front_most_mm, speed_most_mm_s
    ):
        return system
    brakes = speed_limit.is_overspeed(site.table, system.limit, known, rear_least_mm, speed_most_mm_s)
    return _on_other_track(system, in_curve, at_turnout, brakes)


def _on_other_track(system: Passage, in_curve: bool, at_turnout: bool, brakes: bool) -> Passage:
    """The track is another from the front on: what was before it ends there, and nothing beyond it was left."""
    here_nm = system.front_nm
    return replace(
        system,
        in_curve=in_curve,
        at_turnout=at_turnout,
        left_curve_nm=here_nm if system.in_curve else smaller(system.left_curve_nm, here_nm),
        left_turnout_nm=here_nm if system.at_turnout else smaller(system.left_turnout_nm, here_nm),
        brakes=brakes,
    )


def come_to_listed(site: Profile, system: Passage, curve: bool, turnout: bool) -> Passage:
    """By the odometry the front may be where a list has a curve or a turnout (T12)."""
    return replace(
        system,
        curve_listed=system.curve_listed or curve,
        turnout_listed=system.turnout_listed or turnout,
        limit=speed_limit.note_entered(system.limit, curve, turnout),
    )


def locate_anew(site: Profile, system: Passage) -> Passage:
    """The unit begins anew with nothing known of the track; so it does at power-on (T8)."""
    return replace(system, curve_listed=False, turnout_listed=False, limit=speed_limit.UNKNOWN, brakes=True)
