"""One train and one worker on a line, and the last reports of both (A1, A3).

Places in µm, as in ``kernel.alarm.distance``.  Reports come late, again, out of order, or not at all: an
event brings any report, and beside it where the antenna really was when it was made.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

from kernel.alarm import distance
from kernel.alarm.distance import AlarmBounds, Direction, TrainFix, WorkerFix
from models.measures import UM_A_MM, apart, greater


@dataclass(frozen=True)
class Line:
    """What does not change: the bounds as written, and how far the train reaches from its antenna each way (A1)."""

    bounds: AlarmBounds
    below_mm: int
    above_mm: int


@dataclass(frozen=True)
class Lookout:
    """One moment.

    ``antenna_um``, ``heading``: where the train's antenna is, and which way it runs, or ran last if it stands.
    ``worker_um``: where the worker is.
    ``told``: history: what was told of the train last, as old as it truly is by the age it was told with.
    ``train``, ``worker``: what the handset holds of both.
    ``received_mm``: history: what the receiver on board told last.
    ``unit``: what the unit on board holds of its own train, and sends.
    """

    antenna_um: int
    heading: Direction
    worker_um: int
    told: TrainFix
    train: TrainFix
    worker: WorkerFix
    received_mm: int
    unit: TrainFix


def is_report(place_mm: int, age_ms: int) -> bool:
    """Tell whether a report can be of a line: within 1000 km of its origin, and an hour old at the most (ours; A1)."""
    return -1_000_000_000 <= place_mm <= 1_000_000_000 and 0 <= age_ms <= 3_600_000


def grown_older(told: TrainFix, elapsed_ms: int) -> TrainFix:
    """Give a report after some time; one that can be of no line never was one (A1)."""
    return replace(told, age_ms=told.age_ms + elapsed_ms) if is_report(told.place_mm, told.age_ms) else told


def gap_um(site: Line, antenna_um: int, worker_um: int) -> int:
    """Give how far the train's nearer end is from the worker; below 0 where the train stands over him."""
    below_um = antenna_um - UM_A_MM * site.below_mm
    above_um = antenna_um + UM_A_MM * site.above_mm
    return greater(below_um - worker_um, worker_um - above_um)


# ---- premises


def no_train_is_longer_than_written(site: Line) -> bool:
    """Both ends of the train are no farther from its antenna than the greatest length of the line (A1)."""
    return 0 <= site.below_mm <= site.bounds.length_mm and 0 <= site.above_mm <= site.bounds.length_mm


# ---- assumptions


def the_train_keeps_the_lines_speed(site: Line, from_um: int, to_um: int, elapsed_ms: int) -> bool:
    """No train is faster than the line's greatest speed, of which the written bound has a margin for clocks (A1)."""
    return apart(to_um, from_um) <= site.bounds.train_mm_s * elapsed_ms


def the_train_runs_as_it_heads(system: Lookout, to_um: int, heading: Direction) -> bool:
    """A train gets nowhere but the way that it heads; one that turns takes a step each way (A3)."""
    return (heading != Direction.DOWN or to_um >= system.antenna_um) and (
        heading != Direction.UP or to_um <= system.antenna_um
    )


def the_worker_keeps_a_walking_speed(site: Line, from_um: int, to_um: int, elapsed_ms: int) -> bool:
    """No worker moves along the line faster than is written (A1)."""
    return apart(to_um, from_um) <= site.bounds.worker_mm_s * elapsed_ms


def a_receiver_is_right_or_hangs(site: Line, system: Lookout, place_mm: int) -> bool:
    """The receiver on board tells a place within its error of where the antenna is now, or the same as before (A1)."""
    return place_mm == system.received_mm or (
        apart(system.antenna_um, UM_A_MM * place_mm) <= UM_A_MM * site.bounds.train_error_mm
    )


def a_train_fix_is_within_its_error(site: Line, fix: TrainFix, at_um: int) -> bool:
    """A fix that is one was within the error of where the antenna was; the traffic display watches it (A1, A2)."""
    return apart(at_um, UM_A_MM * fix.place_mm) <= UM_A_MM * site.bounds.train_error_mm


def a_worker_fix_is_within_its_error(site: Line, fix: WorkerFix, at_um: int) -> bool:
    """A fix that is one was within the error of where the handset was (A1)."""
    return apart(at_um, UM_A_MM * fix.place_mm) <= UM_A_MM * site.bounds.worker_error_mm


def no_train_turns_sooner(site: Line, told: TrainFix, heading: Direction) -> bool:
    """A train that was told to run one way does not run the other before it can have stopped and changed ends (A3)."""
    if not is_report(told.place_mm, told.age_ms) or not told.is_running or told.age_ms > site.bounds.turning_ms:
        return True
    return told.direction in (Direction.UNKNOWN, heading)


# ---- transitions


def run_on(site: Line, system: Lookout, elapsed_ms: int, to_um: int, heading: Direction, worker_to_um: int) -> Lookout:
    """Time passes: the train runs, stops or turns, the worker walks, and reports grow old (A1, A3)."""
    told = grown_older(system.told, elapsed_ms)
    if not the_train_keeps_the_lines_speed(site, system.antenna_um, to_um, elapsed_ms):
        return system
    if not the_train_runs_as_it_heads(system, to_um, heading):
        return system
    if not the_worker_keeps_a_walking_speed(site, system.worker_um, worker_to_um, elapsed_ms):
        return system
    if not no_train_turns_sooner(site, told, heading):
        return system
    return Lookout(
        antenna_um=to_um,
        heading=heading,
        worker_um=worker_to_um,
        told=told,
        train=distance.older_train(system.train, elapsed_ms),
        worker=distance.older_worker(system.worker, elapsed_ms),
        received_mm=system.received_mm,
        unit=distance.older_train(system.unit, elapsed_ms),
    )


def receive(site: Line, system: Lookout, place_mm: int, direction: Direction, is_running: bool) -> Lookout:
    """The receiver on board tells a place, stamped with this moment, whether it is of this moment or not (A1)."""
    if not a_receiver_is_right_or_hangs(site, system, place_mm):
        return system
    told = TrainFix(place_mm=place_mm, age_ms=0, direction=direction, is_running=is_running)
    return replace(system, received_mm=place_mm, unit=distance.fix_of_the_unit(system.unit, told))


def restart(site: Line, system: Lookout) -> Lookout:
    """The unit on board starts anew, at any moment; its receiver goes on, right or hung (A1, A8)."""
    return replace(system, unit=distance.NO_TRAIN_FIX)


def take_train_fix(site: Line, system: Lookout, fix: TrainFix, at_um: int) -> Lookout:
    """A report of the train arrives; ``at_um``: where its antenna really was (A1).

    One out of its ranges may say anything.
    """
    counts = is_report(fix.place_mm, fix.age_ms)
    if counts and not (
        a_train_fix_is_within_its_error(site, fix, at_um)
        and the_train_keeps_the_lines_speed(site, at_um, system.antenna_um, fix.age_ms)
    ):
        return system
    if not no_train_turns_sooner(site, fix, system.heading):
        return system
    return replace(system, told=fix, train=fix)


def take_worker_fix(site: Line, system: Lookout, fix: WorkerFix, at_um: int) -> Lookout:
    """The handset takes a fix of its own; ``at_um``: where it really was (A1).  Out of its ranges, any."""
    counts = is_report(fix.place_mm, fix.age_ms)
    if counts and not (
        a_worker_fix_is_within_its_error(site, fix, at_um)
        and the_worker_keeps_a_walking_speed(site, at_um, system.worker_um, fix.age_ms)
    ):
        return system
    return replace(system, worker=fix)
