"""How near a train may be to a track worker, by reports that are some time old (A1, A3).

A report says where the GPS antenna of the train was some time ago.  Since then the train may have run
as fast as the line allows, either way; its antenna may be at either end of it; and GPS errs, for the train
and for the worker.  All of that is taken off the distance, so what is left is the least that it can be.
The paper measures from fix to fix (004, 3.3); the deductions are ours.

A train departs only where it is surely past, all of it, by 100 m, and runs on away from the worker by a
direction that it cannot have changed yet.  Stopped, or of unknown direction, it approaches (ours).

Ways are in µm, since mm/s times ms is µm: nothing is divided.  Ranges of reports: places within 1000 km
of the kilometrage's origin, ages to an hour; what is beyond is no fix, and the train may be at the worker.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from enum import Enum

from kernel.onboard.arithmetic import magnitude

UM_A_MM = 1_000
GREATEST_PLACE_MM = 10**9
GREATEST_AGE_MS = 3_600_000
PAST_MM = 100_000
"""So far past the worker a train no longer counts (004, 3.3; A3)."""


class Direction(Enum):
    """Which way a train runs (A3)."""

    DOWN = 0
    """下り: the kilometrage grows."""
    UP = 1
    """上り: the kilometrage falls."""
    UNKNOWN = 2


@dataclass(frozen=True)
class AlarmBounds:
    """What is written for a line and its handsets, none below zero (A1, A3; ours).

    ``train_mm_s``: no train of the line is faster, to 200 m/s.  ``worker_mm_s``: no worker is.
    ``length_mm``: no train is longer.
    ``train_error_mm``, ``worker_error_mm``: GPS and the conversion to kilometrage err by no more, to 1000 km.
    ``turning_ms``: from running one way to running the other no train takes less.
    """

    train_mm_s: int
    worker_mm_s: int
    length_mm: int
    train_error_mm: int
    worker_error_mm: int
    turning_ms: int


@dataclass(frozen=True)
class TrainFix:
    """A train's report, as old as it is now (A1).

    ``place_mm``: where its antenna was.  ``age_ms``: how long ago, all delays since the fix counted.
    ``is_running``: its speed was valid, and that of a train that runs; else the direction says nothing.
    """

    place_mm: int
    age_ms: int
    direction: Direction
    is_running: bool


@dataclass(frozen=True)
class WorkerFix:
    """The worker's own place, as old as it is now (A1)."""

    place_mm: int
    age_ms: int


NO_TRAIN_FIX = TrainFix(
    place_mm=GREATEST_PLACE_MM + 1, age_ms=GREATEST_AGE_MS + 1, direction=Direction.UNKNOWN, is_running=False
)
NO_WORKER_FIX = WorkerFix(place_mm=0, age_ms=GREATEST_AGE_MS + 1)
"""Before the first fix, and after a start: nothing is known (A8).  No place that can be is that of a train."""


def is_fix(place_mm: int, age_ms: int) -> bool:
    """Tell whether a report is within the ranges; what is not says nothing (A1; ours)."""
    return -GREATEST_PLACE_MM <= place_mm <= GREATEST_PLACE_MM and 0 <= age_ms <= GREATEST_AGE_MS


def older_ms(age_ms: int, elapsed_ms: int) -> int:
    """Give an age after some time; beyond the greatest where the clock goes back or leaps (A1; ours)."""
    if not 0 <= age_ms <= GREATEST_AGE_MS or not 0 <= elapsed_ms <= GREATEST_AGE_MS:
        return GREATEST_AGE_MS + 1
    return age_ms + elapsed_ms


def older_train(fix: TrainFix, elapsed_ms: int) -> TrainFix:
    """Give a train's report after some time (A1)."""
    return replace(fix, age_ms=older_ms(fix.age_ms, elapsed_ms))


def older_worker(fix: WorkerFix, elapsed_ms: int) -> WorkerFix:
    """Give the worker's place after some time (A1)."""
    return replace(fix, age_ms=older_ms(fix.age_ms, elapsed_ms))


def fix_of_the_unit(held: TrainFix, told: TrainFix) -> TrainFix:
    """Give the fix that the unit on board holds and sends, after its receiver has told one with a new stamp (A1; ours).

    A place told again, to the mm, is no new fix: the receiver hangs, and so may the speed and direction that it tells.
    It is as old as when it was told first, and goes on until it is too old to count.  ``held``: as old as it is now.
    The first place after a start is none until another is told: nobody knows since when the receiver has told it.
    """
    if not is_fix(held.place_mm, 0):
        return replace(told, age_ms=NO_TRAIN_FIX.age_ms)
    return replace(told, age_ms=held.age_ms) if told.place_mm == held.place_mm else told


def train_off_um(bounds: AlarmBounds, fix: TrainFix) -> int:
    """Give how far the antenna may be from where it was told: error, and age times greatest speed (A1)."""
    return UM_A_MM * bounds.train_error_mm + bounds.train_mm_s * fix.age_ms


def worker_off_um(bounds: AlarmBounds, fix: WorkerFix) -> int:
    """Give how far the worker may be from where the handset says: error, and age times greatest speed (A1)."""
    return UM_A_MM * bounds.worker_error_mm + bounds.worker_mm_s * fix.age_ms


def nearest_um(bounds: AlarmBounds, train: TrainFix, worker: WorkerFix) -> int:
    """Give the least distance that any part of the train may have to the worker now (A1, A3).

    0 or less: it may be at the worker.  So it is where either has no fix.
    """
    if not is_fix(train.place_mm, train.age_ms) or not is_fix(worker.place_mm, worker.age_ms):
        return 0
    apart_um = UM_A_MM * magnitude(train.place_mm - worker.place_mm)
    return apart_um - UM_A_MM * bounds.length_mm - train_off_um(bounds, train) - worker_off_um(bounds, worker)


def is_departing(bounds: AlarmBounds, train: TrainFix, worker: WorkerFix) -> bool:
    """Tell whether a train is surely past the worker by 100 m, its rear too, and runs on away (A3)."""
    if not train.is_running or train.age_ms > bounds.turning_ms:
        return False
    if nearest_um(bounds, train, worker) < UM_A_MM * PAST_MM:
        return False
    return train.direction == (Direction.DOWN if train.place_mm > worker.place_mm else Direction.UP)
