"""A train whose wheel rolls, forward and back, and the machine that watches for reverse movement (T5, T12).

Ways in nm, as in ``models.onboard.odometry``.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

from kernel.onboard import reverse_movement
from kernel.onboard.odometry import Readings
from kernel.onboard.reverse_movement import Movement, ReverseLimits
from models.onboard.units import NM_A_MM, NO_PLACE_MM, NO_SPEED_MM_S, magnitude

PART = 20
"""Creep and diameter of a rolling wheel are off by less than a twentieth (ours; no wheel is worse)."""


@dataclass(frozen=True)
class Wheel:
    """What does not change: the limit as written, and the way between pulses (T5)."""

    limits: ReverseLimits
    pulse_mm: int


@dataclass(frozen=True)
class Rolling:
    """One moment of a train.

    ``front_nm``: where its front is.
    ``counts``: the wheel rolls, and the tachometer tells of it.
    ``furthest_nm``, ``furthest_way_mm``: where the front was farthest since then, and what the pulses were.
    ``rolled_back``: history: since it was located the train has rolled back too far on a wheel that counts.
    ``movement``: what the watching machine knows.
    """

    front_nm: int
    counts: bool
    furthest_nm: int
    furthest_way_mm: int
    rolled_back: bool
    movement: Movement


# ---- premises


def bounds_are_not_negative(site: Wheel) -> bool:
    """No bound is below zero (T5)."""
    return site.limits.roll_back_mm >= 0 and site.pulse_mm >= 0


# ---- assumptions


def what_counts_is_read(readings: Readings, counts: bool) -> bool:
    """A tachometer that tells of its wheel calls itself valid, and gives no more than a train can run (P1)."""
    return not counts or (
        readings.tachometer_valid
        and magnitude(readings.tachometer_mm_s) <= NO_SPEED_MM_S
        and magnitude(readings.way_mm) <= NO_PLACE_MM
    )


def a_rolling_wheel_measures(site: Wheel, system: Rolling, readings: Readings, to_nm: int, counts: bool) -> bool:
    """Between two moments of a wheel that rolls and is read, pulses show the way within creep, diameter, a pulse (P1).

    Asked of the moment when the front was farthest.
    """
    since_mm = readings.way_mm - system.furthest_way_mm
    return (
        not counts
        or not system.counts
        or PART * magnitude(to_nm - system.furthest_nm - NM_A_MM * since_mm)
        <= NM_A_MM * (magnitude(since_mm) + PART * site.pulse_mm)
    )


# ---- transitions


def run_a_cycle(site: Wheel, system: Rolling, readings: Readings, to_nm: int, counts: bool) -> Rolling:
    """The train moves for a cycle, either way; its wheel rolls or not, and is read or not (T5)."""
    if not what_counts_is_read(readings, counts):
        return system
    if not a_rolling_wheel_measures(site, system, readings, to_nm, counts):
        return system
    goes_back = counts and system.counts and to_nm <= system.furthest_nm
    furthest_nm = system.furthest_nm if goes_back else to_nm
    return Rolling(
        front_nm=to_nm,
        counts=counts,
        furthest_nm=furthest_nm,
        furthest_way_mm=system.furthest_way_mm if goes_back else readings.way_mm,
        rolled_back=system.rolled_back or (counts and is_too_far_back(site, furthest_nm - to_nm)),
        movement=reverse_movement.note_cycle(site.limits, system.movement, readings),
    )


def is_too_far_back(site: Wheel, back_nm: int) -> bool:
    """Farther than the limit, where the wheel shows as little of it as it may (T5)."""
    return PART * back_nm > NM_A_MM * (site.limits.roll_back_mm * (PART + 1) + PART * site.pulse_mm)


def locate_anew(site: Wheel, system: Rolling) -> Rolling:
    """The train is located at rest, and may run the other way from there (T8)."""
    return replace(system, counts=False, rolled_back=False, movement=reverse_movement.LOCATED)
