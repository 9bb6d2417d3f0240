"""Where a tram stands: near a stop, below 5 km/h, its place is fixed, and GPS moves it no more (002, 3.1.2; G2).

What the unit tells is the stop that it reached last, and whether it has left it.  Neither goes back: GPS
errs to both sides, trams run one way.  So no tram that stands seems to run, and none falls behind one that
it is ahead of.  Places are those of map matching, in mm along the line; reckoned in 64 bits to 2**61.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

from kernel.onboard.arithmetic import magnitude

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
    """What the unit tells (G2).

    ``stop``: the stop that it reached last.  ``left``: it has left that one.  ``stands``: it stands there.
    """

    stop: int
    left: bool
    stands: bool


def begun(stop: int) -> Stopping:
    """Give the state in which a run begins, or a unit starts anew: it has come to that stop, or is farther on (G2).

    After a restart that is the first one of the way: the others it finds by its fixes, one after the other (ours).
    """
    return Stopping(stop=stop, left=False, stands=False)


def is_slow(fix: Fix) -> bool:
    """Tell whether the tram is as slow as one that stops (002, 3.1.2; G2)."""
    return fix.speed_mm_s < SLOW_MM_S


def is_within(fix: Fix, stop_mm: int, within_mm: int) -> bool:
    """Tell whether a place is that near a stop (G2)."""
    return magnitude(fix.place_mm - stop_mm) <= within_mm


def note_fix(limits: StopLimits, stopping: Stopping, here_mm: int, next_mm: int, fix: Fix) -> Stopping:
    """Take a fix; ``here_mm``, ``next_mm``: where the stop reached last is, and the next one (G2).

    Without place or speed nothing is known but what was reached, and the tram does not count as standing.
    """
    if not (fix.is_placed and fix.has_speed):
        return replace(stopping, stands=False)
    if not is_slow(fix):
        return passing(limits, stopping, here_mm, next_mm, fix)
    if is_within(fix, here_mm, limits.held_mm if stopping.stands else limits.near_mm) and not stopping.left:
        return replace(stopping, stands=True)
    if is_within(fix, next_mm, limits.near_mm):
        return Stopping(stop=stopping.stop + 1, left=False, stands=True)
    return replace(stopping, stands=False)


def passing(limits: StopLimits, stopping: Stopping, here_mm: int, next_mm: int, fix: Fix) -> Stopping:
    """Take a fix of a tram that runs: behind a stop it has left that one, even if it never stood there (G2, G5)."""
    if fix.place_mm > next_mm + limits.near_mm:
        return Stopping(stop=stopping.stop + 1, left=True, stands=False)
    return replace(stopping, left=stopping.left or fix.place_mm > here_mm + limits.near_mm, stands=False)
