"""A train that keeps, or does not keep, to the bounds of its brake, and who watches it (T12).

Speeds in µm/s, as in ``models.onboard.braking``.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

from kernel.onboard import brake_watch
from kernel.onboard.brake_watch import BrakeWatch
from kernel.onboard.braking import BrakeBounds
from models.onboard.units import LONGEST_MS, SHORTEST_MS, UM_A_MM, larger, smaller


@dataclass(frozen=True)
class Vehicle:
    """What does not change: the bounds that are watched (T12)."""

    bounds: BrakeBounds


@dataclass(frozen=True)
class Watched:
    """One moment of a train that is watched.

    ``speed_um_s``: how fast it is, below 0 backward.
    ``cycles``: how long its brake has been commanded, at most its response.
    ``inspected``: history: staff has inspected motors and brake since the unit began.
    ``kept``: history: the train has kept to the bounds since then, or since the unit began.
    ``allowed_mm_s``: history: from speeds that were measured the bounds allow no more than this, rounded up.
    ``too_fast``: history: since it was inspected it was once certainly faster than the bounds allow.
    ``watch``: what the watching machine knows.
    """

    speed_um_s: int
    cycles: int
    inspected: bool
    kept: bool
    allowed_mm_s: int
    too_fast: bool
    watch: BrakeWatch


# ---- premises


def motors_do_not_slow(site: Vehicle) -> bool:
    """What the train gains at most until the brake responds is not below zero (T12)."""
    return site.bounds.gains_mm_s2 >= 0


# ---- assumptions


def the_range_contains_the_speed(
    site: Vehicle, system: Watched, known: bool, speed_least_mm_s: int, speed_most_mm_s: int, speed_um_s: int
) -> bool:
    """The odometry's theorem, `speed_range_contains_speed`; it says nothing while no range is claimed (P1)."""
    return not known or UM_A_MM * speed_least_mm_s <= speed_um_s <= UM_A_MM * speed_most_mm_s


# ---- transitions


def keeps(site: Vehicle, system: Watched, applied: bool, speed_um_s: int) -> bool:
    """Whether motors and brake kept their bounds in this cycle: `the_train_gains_no_more`, `the_brake_keeps…` (T12)."""
    if applied and system.cycles >= site.bounds.response_cycles:
        return speed_um_s <= larger(0, system.speed_um_s - SHORTEST_MS * site.bounds.slows_mm_s2)
    return speed_um_s - larger(0, system.speed_um_s) <= LONGEST_MS * site.bounds.gains_mm_s2


def allowed_after_mm_s(site: Vehicle, system: Watched, applied: bool) -> int:
    """How fast a train may be a cycle on that was as fast as allowed, in whole mm/s to its favour (T12)."""
    if applied and system.cycles >= site.bounds.response_cycles:
        return larger(0, system.allowed_mm_s - SHORTEST_MS * site.bounds.slows_mm_s2 // UM_A_MM)
    return system.allowed_mm_s - -LONGEST_MS * site.bounds.gains_mm_s2 // UM_A_MM


def run_a_cycle(
    site: Vehicle,
    system: Watched,
    applied: bool,
    known: bool,
    speed_least_mm_s: int,
    speed_most_mm_s: int,
    speed_um_s: int,
) -> Watched:
    """The train runs on for a cycle, at any speed, keeping to the bounds or not (T12)."""
    if not the_range_contains_the_speed(site, system, known, speed_least_mm_s, speed_most_mm_s, speed_um_s):
        return system
    allowed_mm_s = allowed_after_mm_s(site, system, applied)
    return Watched(
        speed_um_s=speed_um_s,
        cycles=smaller(system.cycles + 1, site.bounds.response_cycles) if applied else 0,
        inspected=system.inspected,
        kept=system.kept and keeps(site, system, applied, speed_um_s),
        allowed_mm_s=larger(0, smaller(allowed_mm_s, speed_most_mm_s)) if known else allowed_mm_s,
        too_fast=system.too_fast or (known and speed_least_mm_s > allowed_mm_s),
        watch=brake_watch.note_cycle(site.bounds, system.watch, applied, known, speed_least_mm_s, speed_most_mm_s),
    )


def release(site: Vehicle, system: Watched) -> Watched:
    """The brake is released when a cycle begins, even if it is put on again before that ends (T12)."""
    return replace(system, cycles=0, watch=brake_watch.released(system.watch))


def restart(site: Vehicle, system: Watched) -> Watched:
    """The unit begins, or begins again, with a train at rest; nobody has inspected motors and brake since (T8, T12)."""
    return replace(
        system,
        cycles=0,
        inspected=False,
        kept=system.speed_um_s <= 0,
        allowed_mm_s=0,
        watch=brake_watch.restarted(),
    )


def inspect(site: Vehicle, system: Watched, speed_least_mm_s: int, speed_most_mm_s: int) -> Watched:
    """Staff inspects motors and brake of a train whose speed is known, and says that they are sound (T12)."""
    if not the_range_contains_the_speed(site, system, True, speed_least_mm_s, speed_most_mm_s, system.speed_um_s):
        return system
    return replace(
        system,
        inspected=True,
        kept=True,
        allowed_mm_s=larger(0, speed_most_mm_s),
        too_fast=False,
        watch=brake_watch.inspected(system.watch, speed_most_mm_s),
    )
