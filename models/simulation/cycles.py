"""Cycles of 100 ms of one train: its computer decides on the brake, it moves, its sensors read, its computer notes.

One source: CPython runs it, and numba compiles it (``models.simulation.compiled``) with the kernel's machines as
``models.compiled`` has them.  It stops wherever something else is to happen: what lies on the way is reached, a tag
is overdue, the orders are to be read anew, the train stands, or something that must be true is not.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any, NamedTuple, Protocol

from kernel.onboard import computer as computing
from kernel.onboard import odometry, speed_limit
from kernel.onboard.braking import Brake
from kernel.onboard.computer import Computer
from kernel.onboard.limits import Limits
from kernel.onboard.odometry import Motion
from models.simulation import driver, oracles_on_board, sensors
from models.simulation.sensors import CYCLE_S, NOISES_A_CYCLE


class Moving(NamedTuple):
    """How a train moves.

    ``pending_mm``: run since what lies on its way was looked at last.  ``way_mm``: run in all.
    """

    speed_mm_s: float = 0.0
    gained_mm_s2: float = 0.0
    pending_mm: float = 0.0
    way_mm: float = 0.0


class Given(NamedTuple):
    """What stays as it is for some cycles.

    ``front_mm``: where the front was when its way was looked at last; ``next_mm``: so far after it something lies.
    ``target_mm``: where the driver wants to stop.  ``holds``: he stops the train, or keeps it where it is.
    ``runs``: the train has a run that it may run under.  ``listed``: lists say where its orders end.
    ``parted``: some of its cars have been left behind.  ``restarted``: its unit has just begun a new life.
    """

    front_mm: int
    next_mm: float
    target_mm: float
    holds: bool
    runs: bool
    listed: bool
    parted: bool
    restarted: bool


class Ran(NamedTuple):
    """What some cycles have come to.

    ``cycles``: how many there were; in all but the last nothing else was to happen.
    ``located``: in how many of all but the last the train was located.
    """

    cycles: int
    located: int
    moving: Moving
    kept: sensors.Kept


class Held(Protocol):
    """The computer of one train, held where its cycles run; what is asked each second can be had without the rest."""

    computer: Computer

    @property
    def motion(self) -> Motion:
        """What the odometry knows."""

    @property
    def brake(self) -> Brake:
        """What the brake control knows."""

    @property
    def broken(self) -> bool:
        """Whether motors or brake were found out of their bounds."""

    @property
    def passed(self) -> bool:
        """Whether the awaited tag is overdue."""

    def run(
        self, moving: Moving, kept: sensors.Kept, errors: sensors.Errors, given: Given, noises: Any, most: int
    ) -> Ran:
        """Run cycles, so many at most; of noises in a row the first is used first."""


Cycling = Callable[[Limits, Computer], Held]
"""What takes a computer up, to run its cycles."""


@dataclass(frozen=True)
class Machines:
    """What cycles are made of: the machines of the kernel, as CPython or as compiled code has them."""

    decide: Callable[..., Any]
    sense: Callable[..., Any]
    is_located: Callable[..., Any]
    limit_mm_s: Callable[..., Any]
    sensing: sensors.Sensing


def driven_of(limit_mm_s: Callable[..., Any], code: Callable[[Any], Any]) -> Any:
    """Make what moves the train for a cycle: at its end the speed is the driver's, or the emergency brake's."""
    shown, asked, gained = code(driver.shown_mm_s), code(driver.asked_mm_s2), code(driver.gained_mm_s2)

    @code
    def least_shown(train: Any, known: Any, end_mm: int) -> Any:
        bounds, speeds, motion = train.brake, train.speeds, known.motion
        permitted = limit_mm_s(speeds, known.limit, motion.front_least_mm - train.length_mm)
        least = min(float(permitted), shown(bounds, motion, end_mm, 0))
        if speeds.curve_mm_s < speeds.line_mm_s:
            least = min(least, shown(bounds, motion, known.ahead.curve_mm, speeds.curve_mm_s))
        if speeds.turnout_mm_s < speeds.line_mm_s:
            least = min(least, shown(bounds, motion, known.ahead.turnout_mm, speeds.turnout_mm_s))
        return least

    @code
    def driven(train: Any, known: Any, brake: Any, moving: Any, given: Any) -> Any:
        if brake.applied:
            gains = gained(moving.gained_mm_s2, 0.0, True)
        else:
            to_stop_mm = 0.0 if given.holds else given.target_mm - (given.front_mm + moving.pending_mm)
            wanted = asked(moving.speed_mm_s, to_stop_mm, least_shown(train, known, brake.end_mm))
            gains = gained(moving.gained_mm_s2, wanted, False)
        speed_mm_s = max(0.0, moving.speed_mm_s + gains * CYCLE_S)
        if speed_mm_s == 0.0:
            gains = 0.0
        moved_mm = (moving.speed_mm_s + speed_mm_s) / 2 * CYCLE_S
        return Moving(speed_mm_s, gains, moving.pending_mm + moved_mm, moving.way_mm + moved_mm)

    return driven


def goes_on_of(is_located: Callable[..., Any], code: Callable[[Any], Any]) -> Any:
    """Make what tells whether only another cycle comes after one: what is claimed is true, and nothing is due."""
    in_range, inside = code(oracles_on_board.in_range), code(oracles_on_board.inside)

    @code
    def claims_hold(computer: Any, moving: Any, given: Any) -> bool:
        motion, front_mm = computer.known.motion, given.front_mm + moving.pending_mm
        return (
            (not is_located(motion) or in_range(motion, front_mm, moving.speed_mm_s))
            and inside(computer.brake.end_mm, given.listed, front_mm)
            and not computer.known.watch.broken
        )

    @code
    def goes_on(computer: Any, moving: Any, given: Any) -> bool:
        return (
            moving.speed_mm_s > 0.0
            and moving.pending_mm < given.next_mm
            and not (computer.known.window.passed and not given.restarted)
            and not (computer.brake.withheld and given.listed)
            and claims_hold(computer, moving, given)
        )

    return goes_on


def cycles_of(machines: Machines, code: Callable[[Any], Any]) -> Callable[..., Any]:
    """Make the function that runs cycles; ``code`` compiles a function, or leaves it as it is.

    It takes the limits, the computer, :class:`Moving`, the sensors' ``Kept`` and ``Errors``, :class:`Given`, the
    noise of the sensors, and how many cycles at most; it gives the fields of :class:`Ran`, and the computer.
    """
    decide, sense, is_located = machines.decide, machines.sense, machines.is_located
    turned, head, tail = machines.sensing.turned, machines.sensing.head, machines.sensing.tail
    slipped = code(sensors.slipped)
    driven, goes_on = driven_of(machines.limit_mm_s, code), goes_on_of(is_located, code)

    @code
    def cycles(
        limits: Any, computer: Any, moving: Any, kept: Any, errors: Any, given: Any, noises: Any, most: int
    ) -> Any:
        done, located = 0, 0
        while True:
            computer = decide(limits, computer, given.runs and not computer.brake.withheld, False)
            before, remembered = moving, kept
            moving = driven(limits.train, computer.known, computer.brake, before, given)
            gained_mm_s2 = (moving.speed_mm_s - before.speed_mm_s) / CYCLE_S
            stays = given.parted and before.speed_mm_s != 0.0
            tail_mm_s2 = -before.speed_mm_s / CYCLE_S if stays else gained_mm_s2
            at = NOISES_A_CYCLE * done
            kept = turned(errors, remembered, moving.speed_mm_s, slipped(remembered, moving.speed_mm_s))
            read = head(errors, remembered, kept, gained_mm_s2, noises[at])
            telegram = tail(errors, read, tail_mm_s2, noises[at + 1], noises[at + 2])
            computer = sense(limits, computer, read, telegram)
            done += 1
            if done == most or not goes_on(computer, moving, given):
                return done, located, moving, kept, computer
            located += is_located(computer.known.motion)

    made: Callable[..., Any] = cycles
    return made


def as_it_is(function: Any) -> Any:
    """Leave a function to CPython."""
    return function


_MACHINES = Machines(
    computing.decide, computing.sense, odometry.is_located, speed_limit.limit_mm_s, sensors.INTERPRETED
)
_CYCLES = cycles_of(_MACHINES, as_it_is)


@dataclass
class Interpreted:
    """Cycles of one train as CPython runs them: :class:`Held`."""

    limits: Limits
    computer: Computer

    @property
    def motion(self) -> Motion:
        """What the odometry knows."""
        return self.computer.known.motion

    @property
    def brake(self) -> Brake:
        """What the brake control knows."""
        return self.computer.brake

    @property
    def broken(self) -> bool:
        """Whether motors or brake were found out of their bounds."""
        return self.computer.known.watch.broken

    @property
    def passed(self) -> bool:
        """Whether the awaited tag is overdue."""
        return self.computer.known.window.passed

    def run(
        self, moving: Moving, kept: sensors.Kept, errors: sensors.Errors, given: Given, noises: Any, most: int
    ) -> Ran:
        """Run cycles, so many at most."""
        drawn = noises[: NOISES_A_CYCLE * most].tolist()
        *ran, self.computer = _CYCLES(self.limits, self.computer, moving, kept, errors, given, drawn, most)
        return Ran(*ran)
