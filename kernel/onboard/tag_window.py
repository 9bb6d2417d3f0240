"""The window for the next tag: it comes within the permitted running distance, or the loop opens (T5).

The plan says how far it is to the next tag (the record of the last one, or the route's list), the
odometry between which bounds the way is that was run since (paper 000, 3.4.2).  A tag is early only if
it certainly is, and late only if it certainly is: the odometry's error widens the window, and no tag
in its place opens the loop.  Ours: up to a written width; what is known worse is not known.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from enum import Enum

from kernel.onboard.way import Way, is_known, is_within_width

GREATEST_DISTANCE_MM = 2**28 - 1
"""The longest distance that a tag's record can hold (T1)."""


class Verdict(Enum):
    """Where in its window a tag would be that is read now; all but ``IN_WINDOW`` open the loop (T5)."""

    IN_WINDOW = 0
    EARLY = 1
    LATE = 2
    UNKNOWN = 3
    """No tag is awaited, or the plan is not known, or the way is not known well enough."""


@dataclass(frozen=True)
class WindowLimits:
    """The written limits, 0 or more (T5, T16).

    ``tolerance_mm``: how far from the plan the ways between two reads may be: the error of laying tags,
    and the read window of the antenna (513 mm: half of it at either tag).
    ``width_mm``: how wide the odometry's range of the way may be for a tag to be held against it.
    ``tail_width_mm``: how wide the range of the front may be for what the tail reads to count: the next tag, had the
    head missed it, would be overdue by then (T2).
    """

    tolerance_mm: int
    width_mm: int
    tail_width_mm: int


@dataclass(frozen=True)
class Window:
    """What is known of the next tag (T5).

    ``expected``: there is one.  ``least_mm``, ``most_mm``: how far it is, by the plan, from the last.
    ``passed``: latched; it is overdue.
    """

    expected: bool
    least_mm: int
    most_mm: int
    passed: bool


NONE_AWAITED = Window(expected=False, least_mm=0, most_mm=0, passed=False)
"""At the start, and after the last tag of a list (T5)."""


def await_tag(least_mm: int, most_mm: int) -> Window:
    """Begin at the tag just read: so far is it to the next, twice the same distance (T5).

    Where a train begins to run anywhere in a block, the next tag is somewhere between: from here to
    the block's end (ours).
    """
    return Window(expected=True, least_mm=least_mm, most_mm=most_mm, passed=False)


def has_a_plan(window: Window) -> bool:
    """Tell whether a tag is awaited, at a distance that a record can hold (T1, T5)."""
    return window.expected and 0 <= window.least_mm <= window.most_mm <= GREATEST_DISTANCE_MM


def judge(limits: WindowLimits, window: Window, way: Way) -> Verdict:
    """Tell whether the next tag may come here; ``way``: run since the last (T5)."""
    if not has_a_plan(window) or not is_known(way) or not is_within_width(way, limits.width_mm):
        return Verdict.UNKNOWN
    if way.most_mm < window.least_mm - limits.tolerance_mm:
        return Verdict.EARLY
    if way.least_mm > window.most_mm + limits.tolerance_mm:
        return Verdict.LATE
    return Verdict.IN_WINDOW


def in_window(limits: WindowLimits, window: Window, way: Way) -> bool:
    """Tell whether a tag that is read now comes in its window (T5)."""
    return judge(limits, window, way) == Verdict.IN_WINDOW


def note_cycle(limits: WindowLimits, window: Window, way: Way) -> Window:
    """Note how far the train has come without the next tag (T5).

    Where the way is not known well enough any more, the tag is taken for overdue.
    """
    verdict = judge(limits, window, way)
    overdue = window.expected and (verdict == Verdict.LATE or verdict == Verdict.UNKNOWN)
    return replace(window, passed=window.passed or overdue)
