"""Watches whether the train rolls back farther than it may at a start (T5, T12).

Ends of authority, lists of tags and restrictions of speed are made for a train that runs forward.  One that
starts on an ascent may roll back a little; one that goes on so brakes.  The pulses of the wheel are counted
either way, and the most that they ever were is where the train was farthest, as far as the wheel rolled.
"""

from __future__ import annotations

from dataclasses import dataclass

from kernel.onboard.arithmetic import larger
from kernel.onboard.odometry import GREATEST_WAY_MM, Readings, tachometer_is_heard


@dataclass(frozen=True)
class ReverseLimits:
    """What is written for the train (T5).

    ``roll_back_mm``: pulses may go back so far; 0 or more.
    """

    roll_back_mm: int


@dataclass(frozen=True)
class Movement:
    """What is known of it (T5).

    ``furthest_mm``: the most that the pulses have been since the train was located.
    ``reversed``: it has rolled back too far; it stays so until the train is located anew.
    """

    furthest_mm: int
    reversed: bool


LOCATED = Movement(furthest_mm=-GREATEST_WAY_MM, reversed=False)
"""When the train has been located at rest: no pulses were read yet (T8)."""


def note_cycle(limits: ReverseLimits, movement: Movement, readings: Readings) -> Movement:
    """Take the readings of one cycle; those of a tachometer that is not heard say nothing (T5)."""
    if not tachometer_is_heard(readings):
        return movement
    return Movement(
        furthest_mm=larger(movement.furthest_mm, readings.way_mm),
        reversed=movement.reversed or readings.way_mm + limits.roll_back_mm < movement.furthest_mm,
    )
