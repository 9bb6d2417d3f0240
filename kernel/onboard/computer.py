"""The computer on board: the machines that know where the train is, and the brake, a cycle at a time (P7, T5, T12).

A cycle has two halves.  At its beginning :func:`decide` settles whether the brake is on while the train runs;
at its end :func:`sense` takes what the sensors say of that run.  Between the end of one cycle and the beginning
of the next comes all that is told: tags that were read in it, ends of authority, and where a train at rest is.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

from kernel.onboard import (
    brake_demand,
    brake_watch,
    braking,
    odometry,
    reverse_movement,
    split,
    tag_fix,
    tag_window,
)
from kernel.onboard.brake_demand import Known
from kernel.onboard.braking import Brake
from kernel.onboard.limits import Limits
from kernel.onboard.odometry import Motion, Readings
from kernel.onboard.reverse_movement import LOCATED
from kernel.onboard.speed_limit import UNKNOWN as NO_TRACK_KNOWN
from kernel.onboard.split import Readings as TailReadings
from kernel.onboard.tag_fix import Fix
from kernel.onboard.tag_window import NONE_AWAITED
from kernel.onboard.way import UNKNOWN, Way, between
from kernel.standstill import Standstill, is_braked


@dataclass(frozen=True)
class Computer:
    """What the computer remembers.

    ``known``: what its machines know at the end of the newest cycle.
    ``before``: what the odometry knew a cycle earlier; it claims nothing once the train has been located anew.
    ``way_began``: where the front was when the way to the awaited tag began.
    ``brake``: what the brake control knows.
    """

    known: Known
    before: Motion
    way_began: Way
    brake: Brake


def put_into_service(limits: Limits, least_mm: int, most_mm: int) -> Computer:
    """Begin with a train at rest that has been found whole, its brake on, and its front in a range (P5, P7, T8).

    With lawful limits alone (:func:`kernel.onboard.limits.are_lawful`).
    """
    motion = odometry.located(least_mm, most_mm, 0)
    return Computer(
        known=Known(
            motion=motion,
            watch=brake_watch.watching(0),
            movement=LOCATED,
            limit=NO_TRACK_KNOWN,
            wholeness=split.made_up(limits.split),
            window=NONE_AWAITED,
        ),
        before=odometry.past(motion),
        way_began=UNKNOWN,
        brake=braking.stand_still(most_mm),
    )


def place(computer: Computer) -> Way:
    """Give where the front is (P7)."""
    motion = computer.known.motion
    return Way(odometry.is_located(motion), motion.front_least_mm, motion.front_most_mm)


def standstill(limits: Limits, computer: Computer) -> Standstill:
    """Give what is known of front, speed and brake; of one that is released no cycle counts (P7, T12)."""
    motion, bounds = computer.known.motion, limits.train.brake
    return Standstill(
        known=odometry.is_located(motion),
        front_least_mm=motion.front_least_mm,
        front_most_mm=motion.front_most_mm,
        speed_least_mm_s=motion.speed_least_mm_s,
        speed_most_mm_s=motion.speed_most_mm_s,
        standstill_mm_s=bounds.standstill_mm_s,
        braked_cycles=computer.known.watch.cycles if computer.brake.applied else 0,
        response_cycles=bounds.response_cycles,
    )


# ---- a cycle


def decide(limits: Limits, computer: Computer, may_proceed: bool, acknowledged: bool) -> Computer:
    """Decide on the brake for the cycle that begins (T5, T12).

    ``may_proceed``: an order lets the train proceed.  ``acknowledged``: the driver has acknowledged the brake.
    """
    brake = brake_demand.decide(limits.train, computer.brake, computer.known, may_proceed, acknowledged)
    return replace(computer, brake=brake)


def sense(limits: Limits, computer: Computer, readings: Readings, tail: TailReadings) -> Computer:
    """Take what the sensors of head and tail say at the end of the cycle (P1, P5, P7)."""
    known = computer.known
    motion = odometry.note_cycle(limits.sensors, known.motion, readings)
    located = odometry.is_located(motion)
    now = Way(located, motion.front_least_mm, motion.front_most_mm)
    least_mm_s, most_mm_s = motion.speed_least_mm_s, motion.speed_most_mm_s
    return replace(
        computer,
        known=Known(
            motion=motion,
            watch=brake_watch.note_cycle(
                limits.train.brake, known.watch, computer.brake.applied, located, least_mm_s, most_mm_s
            ),
            movement=reverse_movement.note_cycle(limits.reverse, known.movement, readings),
            limit=known.limit,
            wholeness=split.note_cycle(limits.split, known.wholeness, tail),
            window=tag_window.note_cycle(limits.window, known.window, between(computer.way_began, now)),
        ),
        before=known.motion,
    )


# ---- tags


def place_of_read(computer: Computer) -> Way:
    """Give where the front was when an antenna read something within the newest cycle (P7)."""
    return tag_fix.place_of_read(computer.before, computer.known.motion)


def reads_in_window(limits: Limits, computer: Computer) -> bool:
    """Tell whether a tag read within the newest cycle came where the awaited one may (T5)."""
    way = between(computer.way_began, place_of_read(computer))
    return tag_window.in_window(limits.window, computer.known.window, way)


def fix(limits: Limits, computer: Computer, place_mm: int) -> Fix:
    """Give where the front is by a tag listed at ``place_mm`` that the head read within the newest cycle (P7, T2)."""
    return tag_fix.fix_of(limits.tags, computer.before, computer.known.motion, place_mm)


def take_fix(limits: Limits, computer: Computer, place_mm: int) -> Computer:
    """Narrow the range by such a tag (P7).

    One that was read before the train was located says nothing any more: it has run on since, by who knows how much.
    """
    if not place_of_read(computer).known:
        return computer
    found = fix(limits, computer, place_mm)
    motion = odometry.note_fix(computer.known.motion, found.least_mm, found.most_mm)
    return replace(computer, known=replace(computer.known, motion=motion))


# ---- what is told


def await_tag(computer: Computer, least_mm: int, most_mm: int) -> Computer:
    """Await a tag so far from where the way to it began: between these two distances (T5)."""
    return replace(computer, known=replace(computer.known, window=tag_window.await_tag(least_mm, most_mm)))


def await_none(computer: Computer) -> Computer:
    """Await no tag: no order says which comes next (T5)."""
    return replace(computer, known=replace(computer.known, window=NONE_AWAITED))


def begin_way(computer: Computer, at: Way) -> Computer:
    """Begin the way to the next tag where the front was when the last one was read, or where the train stands (T5)."""
    return replace(computer, way_began=at)


def made_up(limits: Limits, computer: Computer) -> Computer:
    """Take the train for whole: its staff has found it so (P5)."""
    return replace(computer, known=replace(computer.known, wholeness=split.made_up(limits.split)))


def withhold_end(computer: Computer) -> Computer:
    """Brake, until an end of authority is taken (T4, T12)."""
    return replace(computer, brake=braking.withhold_end(computer.brake))


def locate(limits: Limits, computer: Computer, least_mm: int, most_mm: int) -> Computer:
    """Begin anew at rest with the front in a range; not before the brake holds the train there (P7, T8).

    What was found of motors, brake and wholeness stays.  Restrictions lay on the kilometrage of before: until the next
    tag all of them hold.
    """
    if not is_braked(standstill(limits, computer)):
        return computer
    motion, watch = odometry.located(least_mm, most_mm, computer.known.motion.way_mm), computer.known.watch
    return Computer(
        known=replace(
            computer.known,
            motion=motion,
            watch=replace(watch, limit_mm_s=0),
            movement=LOCATED,
            limit=NO_TRACK_KNOWN,
            window=NONE_AWAITED,
        ),
        before=odometry.past(motion),
        way_began=UNKNOWN,
        brake=braking.stand_still(most_mm),
    )
