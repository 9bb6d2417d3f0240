"""Watches whether the train keeps to what the brake control reckons with (T12, P5).

The brake control is proved under two bounds: how much the train gains until the brake responds, and
how much the brake slows it then.  A train that is certainly faster than these bounds allow has broken
one of them: its motors are not cut, its brake is weak, or the rails are more slippery than was thought.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

from kernel.onboard.arithmetic import LONGEST_CYCLE_MS, SHORTEST_CYCLE_MS, divided_up, larger, smaller
from kernel.onboard.braking import BrakeBounds


@dataclass(frozen=True)
class BrakeWatch:
    """What is watched (T12).

    ``limit_mm_s``: the train is no faster than this while the bounds hold.
    ``cycles``: for how many cycles the brake has been commanded, at most its response.
    ``broken``: a bound was found broken, or may have been before a start; it stays so until the vehicle is inspected.
    """

    limit_mm_s: int
    cycles: int
    broken: bool


def watching(speed_most_mm_s: int) -> BrakeWatch:
    """Begin to watch a train that is no faster than this (T12)."""
    return BrakeWatch(limit_mm_s=speed_most_mm_s, cycles=0, broken=False)


def restarted() -> BrakeWatch:
    """Begin with a train at rest: whether a bound was found broken is forgotten, so one counts as broken (T8, T12)."""
    return replace(watching(0), broken=True)


def inspected(watch: BrakeWatch, speed_most_mm_s: int) -> BrakeWatch:
    """Take motors and brake for sound: they were inspected, with the brake on, and are watched from here on (T12)."""
    return replace(watching(larger(0, speed_most_mm_s)), cycles=watch.cycles)


def released(watch: BrakeWatch) -> BrakeWatch:
    """Begin to count anew: the brake is released, and whoever puts it on again waits for its response (T12)."""
    return replace(watch, cycles=0)


def next_limit_mm_s(bounds: BrakeBounds, watch: BrakeWatch, applied: bool) -> int:
    """Give how fast the train may be a cycle on: slower once the brake has responded, else faster (T12)."""
    if applied and watch.cycles >= bounds.response_cycles:
        return larger(0, watch.limit_mm_s - SHORTEST_CYCLE_MS * bounds.slows_mm_s2 // 1000)
    return watch.limit_mm_s + divided_up(LONGEST_CYCLE_MS * bounds.gains_mm_s2, 1000)


def note_cycle(
    bounds: BrakeBounds, watch: BrakeWatch, applied: bool, known: bool, speed_least_mm_s: int, speed_most_mm_s: int
) -> BrakeWatch:
    """Take one cycle: whether the brake was commanded in it, and the range of speeds after it, if it is known (T12).

    The brakes of a train that rolls back act forward, so the limit is not below 0.
    """
    limit_mm_s = next_limit_mm_s(bounds, watch, applied)
    return BrakeWatch(
        limit_mm_s=larger(0, smaller(limit_mm_s, speed_most_mm_s)) if known else limit_mm_s,
        cycles=smaller(watch.cycles + 1, bounds.response_cycles) if applied else 0,
        broken=watch.broken or (known and speed_least_mm_s > limit_mm_s),
    )
