"""Sections that are not to be used (004, 4): where they lie, and how far a train in one is from a worker (A4 to A6)."""

from __future__ import annotations

from dataclasses import dataclass
from enum import Enum
from typing import NewType

from kernel.alarm.distance import UM_A_MM, AlarmBounds, Direction, TrainFix, WorkerFix, worker_off_um
from kernel.onboard.arithmetic import larger

Section = NewType("Section", str)
"""The name of a section that is not to be used (A4, A5, A6)."""


class Reason(Enum):
    """Why a section is registered as not to be used (004, 4)."""

    WITHOUT_GPS = 0
    SHUNTING = 1
    STABLING = 2


@dataclass(frozen=True)
class NoUse:
    """A section that is not to be used, from one kilometrage to a higher one (A4, A5, A6).

    ``zone_mm``: without GPS, so long is the stretch at either end where there is GPS yet: zones A and B (004, 4.1).
    """

    reason: Reason
    from_mm: int
    to_mm: int
    zone_mm: int


def is_within(section: NoUse, place_mm: int) -> bool:
    """Tell whether a place is in a section (A4, A5)."""
    return section.from_mm <= place_mm <= section.to_mm


def runs(fix: TrainFix, way: Direction) -> bool:
    """Tell whether a train ran that way at its last fix; of one that stands it is not known (A3)."""
    return fix.is_running and fix.direction == way


def is_in_zone_b(section: NoUse, fix: TrainFix) -> bool:
    """Tell whether GPS sees a train in the zone by which it leaves a section without GPS (004, 4.1; A4)."""
    return (runs(fix, Direction.DOWN) and fix.place_mm > section.to_mm - section.zone_mm) or (
        runs(fix, Direction.UP) and fix.place_mm < section.from_mm + section.zone_mm
    )


def is_put_forward(section: NoUse, fix: TrainFix) -> bool:
    """Tell whether a train is on its way through a section without GPS: entered, and not seen in zone B (A4)."""
    return section.reason == Reason.WITHOUT_GPS and is_within(section, fix.place_mm) and not is_in_zone_b(section, fix)


def from_stretch_um(bounds: AlarmBounds, from_mm: int, to_mm: int, worker: WorkerFix) -> int:
    """Give how far a stretch is from the worker at the least, less a train's length; below 0 inside (A4, A6)."""
    apart_mm = larger(from_mm - worker.place_mm, worker.place_mm - to_mm)
    return UM_A_MM * apart_mm - UM_A_MM * bounds.length_mm - worker_off_um(bounds, worker)


def from_way_through_um(bounds: AlarmBounds, section: NoUse, fix: TrainFix, worker: WorkerFix) -> int:
    """Give how far a train on its way through is at the least: from its last fix to the outer end of zone B (A4).

    Of one that stood, or whose direction is unknown, either end may be the outer one.
    """
    from_mm = fix.place_mm - bounds.train_error_mm if runs(fix, Direction.DOWN) else section.from_mm
    to_mm = fix.place_mm + bounds.train_error_mm if runs(fix, Direction.UP) else section.to_mm
    return from_stretch_um(bounds, from_mm, to_mm, worker)
