"""Where a tram stands: near a stop, below 5 km/h, its place is fixed, and GPS moves it no more (002, 3.1.2; G2).

What the unit tells is the stop that it reached last, and whether it has left it.  Neither goes back: GPS
errs to both sides, trams run one way.  So no tram that stands seems to run, and none falls behind one that
it is ahead of.  A driver may have set another way than his tram is on, or left it set where he turned off: until it
was seen to run over a stop of the way that is set, and since it had no place anew, it tells of none there that it
leaves.  If it is seen before a stop that it has reached there, or back along that way, it begins anew (ours).
Places are those of map matching, in mm along the line; reckoned in 64 bits to 2**61.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

from kernel.onboard.arithmetic import larger, magnitude, smaller
from kernel.tram.dispatching import FIRST_STOP

SLOW_MM_S = 1_389
"""5 km/h (002, 3.1.2: the threshold of the tests), rounded up."""


@dataclass(frozen=True)
class StopLimits:
    """What is written for a line, in mm.

    ``near_mm``: so near its stop a slow tram stands there (ours).
    ``held_mm``: so near it goes on standing while it is slow: ``near_mm`` and twice the error of GPS (ours).
    """

    near_mm: int
    held_mm: int


@dataclass(frozen=True)
class Fix:
    """What the unit measured: the place by map matching and the speed, each of them there or not (G1, G2)."""

    is_placed: bool
    place_mm: int
    has_speed: bool
    speed_mm_s: int


@dataclass(frozen=True)
class Stopping:
    """What the unit tells, and what it has seen of the way that is set (G2).

    ``stop``: the stop that it reached last.  ``left``: it has left that one.  ``stands``: it stands there.
    ``is_followed``: its last fix had a place; ``least_mm``: the least place since a fix had none, or since the start.
    ``most_mm``: the greatest place since it has told that it left that stop; until then the last one (ours).
    ``has_run``: since a fix had no place, too, it was seen at a stop, or before it, and then beyond (ours).
    """

    stop: int
    left: bool
    stands: bool
    is_followed: bool
    least_mm: int
    most_mm: int
    has_run: bool


def begun(stop: int) -> Stopping:
    """Give the state in which a run begins, or a unit starts anew: it has come to that stop, or is farther on (G2).

    After a restart that is the first one of the way: the others it finds by its fixes, one after the other (ours).
    Whoever sets a way, or another one, begins the unit so.
    """
    return Stopping(stop=stop, left=False, stands=False, is_followed=False, least_mm=0, most_mm=0, has_run=False)


def is_slow(fix: Fix) -> bool:
    """Tell whether the tram is as slow as one that stops (002, 3.1.2; G2)."""
    return fix.speed_mm_s < SLOW_MM_S


def is_within(fix: Fix, stop_mm: int, within_mm: int) -> bool:
    """Tell whether a place is that near a stop (G2)."""
    return magnitude(fix.place_mm - stop_mm) <= within_mm


def followed(stopping: Stopping, fix: Fix) -> Stopping:
    """Note how far back the tram has been seen, and how far on since it left its stop (G2, ours).

    Without a place it may come round to another part of a way that it is not on, so that it ran there is forgotten.
    How far on it was stays: farther back it cannot come round on the way that is set.
    """
    if not fix.is_placed:
        return replace(stopping, is_followed=False, has_run=False)
    least_mm = smaller(stopping.least_mm, fix.place_mm) if stopping.is_followed else fix.place_mm
    most_mm = larger(stopping.most_mm, fix.place_mm) if stopping.left else fix.place_mm
    return replace(stopping, is_followed=True, least_mm=least_mm, most_mm=most_mm)


def is_beyond(limits: StopLimits, stop_mm: int, fix: Fix) -> bool:
    """Tell whether a place is behind a stop, and not near it any more (G2)."""
    return fix.place_mm > stop_mm + limits.near_mm


def is_seen_back(limits: StopLimits, stopping: Stopping, stop_mm: int, fix: Fix) -> bool:
    """Tell whether a tram is farther back than it was said to have come: it is on another way than is set (G2, ours).

    It had come near the stop that it reached, and, once it has left that one, to where it was farthest.
    On the right way a place is less than that by two errors at most: the one by which it is told, and the one by
    which the other was.
    """
    come_mm = stopping.most_mm if stopping.left else stop_mm - limits.near_mm
    return fix.is_placed and fix.place_mm < come_mm - (limits.held_mm - limits.near_mm)


def runs_over(limits: StopLimits, stopping: Stopping, stop_mm: int, fix: Fix) -> bool:
    """Tell whether a tram is seen to run over a stop: by more than the error of GPS can make of a tram at rest (G2).

    That is the difference of the two limits.  Who is on another way than is set, beside this one, runs the other way.
    """
    rises_mm = fix.place_mm - stopping.least_mm
    was_beyond = stopping.least_mm > stop_mm + limits.near_mm
    return is_beyond(limits, stop_mm, fix) and not was_beyond and rises_mm > limits.held_mm - limits.near_mm


def note_fix(limits: StopLimits, stopping: Stopping, here_mm: int, next_mm: int, fix: Fix) -> Stopping:
    """Take a fix; ``here_mm``, ``next_mm``: where the stop reached last is, and the next one (G2).

    Without place or speed nothing is known but what was reached, and the tram does not count as standing.
    """
    if is_seen_back(limits, stopping, here_mm, fix):
        return followed(begun(FIRST_STOP), fix)
    seen = followed(stopping, fix)
    if not (fix.is_placed and fix.has_speed):
        return replace(seen, stands=False)
    if not is_slow(fix):
        return passing(limits, seen, here_mm, next_mm, fix)
    if is_within(fix, here_mm, limits.held_mm if seen.stands else limits.near_mm) and not seen.left:
        return replace(seen, stands=True)
    if is_within(fix, next_mm, limits.near_mm):
        return replace(seen, stop=seen.stop + 1, left=False, stands=True)
    return replace(seen, stands=False)


def passing(limits: StopLimits, stopping: Stopping, here_mm: int, next_mm: int, fix: Fix) -> Stopping:
    """Take a fix of a tram that runs: behind a stop it has left that one, even if it never stood there (G2, G5)."""
    if is_beyond(limits, next_mm, fix):
        reached = replace(stopping, stop=stopping.stop + 1, left=False, most_mm=fix.place_mm)
        return leaving(limits, reached, next_mm, fix)
    return leaving(limits, stopping, here_mm, fix)


def leaving(limits: StopLimits, stopping: Stopping, stop_mm: int, fix: Fix) -> Stopping:
    """Note that a tram that runs has left the stop it reached last, if it is seen to run along the way (G2, G5)."""
    has_run = stopping.has_run or runs_over(limits, stopping, stop_mm, fix)
    left = stopping.left or (has_run and is_beyond(limits, stop_mm, fix))
    return replace(stopping, left=left, stands=False, has_run=has_run)
