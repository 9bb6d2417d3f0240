"""A train that keeps, or does not keep, to the bounds of its brake, and who watches it (T12).

Speeds in µm/s, as in ``models.onboard.braking``.
"""

from __future__ import annotations

from dataclasses import dataclass

from kernel.onboard import brake_watch
from kernel.onboard.arithmetic import CYCLE_MS, larger, smaller
from kernel.onboard.brake_watch import BrakeWatch
from kernel.onboard.braking import BrakeBounds


@dataclass(frozen=True)
class Vehicle:
    """What does not change: the bounds that are watched (T12)."""

    bounds: BrakeBounds


@dataclass(frozen=True)
class Watched:
    """One moment of a train that is watched.

    ``speed_um_s``: how fast it is.  ``cycles``: how long its brake has been commanded, at most its response.
    ``kept``: history: the train has kept to the bounds so far.
    ``watch``: what the watching machine knows.
    """

    speed_um_s: int
    cycles: int
    kept: bool
    watch: BrakeWatch


def the_range_contains_the_speed(
    site: Vehicle, system: Watched, speed_least_mm_s: int, speed_most_mm_s: int, speed_um_s: int
) -> bool:
    """The odometry's theorem, `speed_range_contains_speed` (P1)."""
    return 1000 * speed_least_mm_s <= speed_um_s <= 1000 * speed_most_mm_s


def keeps(site: Vehicle, system: Watched, applied: bool, speed_um_s: int) -> bool:
    """Whether motors and brake kept their bounds in this cycle: `the_train_gains_no_more`, `the_brake_keeps…` (T12)."""
    if applied and system.cycles >= site.bounds.response_cycles:
        return speed_um_s <= larger(0, system.speed_um_s - CYCLE_MS * site.bounds.slows_mm_s2)
    return speed_um_s - system.speed_um_s <= CYCLE_MS * site.bounds.gains_mm_s2


def run_a_cycle(
    site: Vehicle, system: Watched, applied: bool, speed_least_mm_s: int, speed_most_mm_s: int, speed_um_s: int
) -> Watched:
    """The train runs on for a cycle, at any speed, keeping to the bounds or not (T12)."""
    if not the_range_contains_the_speed(site, system, speed_least_mm_s, speed_most_mm_s, speed_um_s):
        return system
    return Watched(
        speed_um_s=speed_um_s,
        cycles=smaller(system.cycles + 1, site.bounds.response_cycles) if applied else 0,
        kept=system.kept and keeps(site, system, applied, speed_um_s),
        watch=brake_watch.note_cycle(site.bounds, system.watch, applied, speed_least_mm_s, speed_most_mm_s),
    )
