"""Curves and turnouts that a list has ahead: the train is slow enough when it enters them (T12, T1).

The list of tags that comes with an authority says of each tag what lies from it on.  The nearest that begins a curve
and the nearest that begins a turnout are remembered: all further ones are as fast, so whoever keeps to the nearest
keeps to them.  If the train could not be slow enough there any more, the brake comes on now.

What lies beyond the list is beyond the end of authority, and that stops the train before.
"""

from __future__ import annotations

from dataclasses import dataclass

from kernel.onboard.arithmetic import smaller
from kernel.onboard.braking import BrakeBounds, slows_before
from kernel.onboard.speed_limit import SpeedTable
from kernel.onboard.tag_kind import is_curve, is_turnout
from kernel.onboard.way import Way


@dataclass(frozen=True)
class Ahead:
    """The nearest listed restrictions (T12).

    ``curve_mm``, ``turnout_mm``: the front enters none before here.
    """

    curve_mm: int
    turnout_mm: int


NONE_LISTED = Ahead(curve_mm=2_000_000_000, turnout_mm=2_000_000_000)
"""No list has one: beyond every place, and what is farther ahead than 1000 km is reckoned with as so far."""


def note_listed(ahead: Ahead, kind: int, from_mm: int) -> Ahead:
    """Take a tag that is listed ahead; ``from_mm``: the front is nowhere before here when it is read (T1, T12)."""
    return Ahead(
        curve_mm=smaller(ahead.curve_mm, from_mm) if is_curve(kind) else ahead.curve_mm,
        turnout_mm=smaller(ahead.turnout_mm, from_mm) if is_turnout(kind) else ahead.turnout_mm,
    )


def may_be_entered(from_mm: int, front: Way) -> bool:
    """Tell whether the front may be in a restriction that begins nowhere before ``from_mm``; lost, anywhere (T12)."""
    return not front.known or front.most_mm >= from_mm


def is_kept(
    bounds: BrakeBounds, line_mm_s: int, restricted_mm_s: int, from_mm: int, front_most_mm: int, speed_most_mm_s: int
) -> bool:
    """Tell whether a train that brakes a cycle from now enters a restriction no faster than that allows (T12).

    What may be run through as fast as the line restricts nothing.
    """
    return restricted_mm_s >= line_mm_s or slows_before(
        bounds, front_most_mm, speed_most_mm_s, from_mm, restricted_mm_s
    )


def is_too_fast(bounds: BrakeBounds, table: SpeedTable, ahead: Ahead, front_most_mm: int, speed_most_mm_s: int) -> bool:
    """Tell whether the train may be too fast for what lies ahead, so that the emergency brake is demanded (T12).

    ``front_most_mm``, ``speed_most_mm_s``: as far and as fast as it may be (P1, P7).
    """
    return not (
        is_kept(bounds, table.line_mm_s, table.curve_mm_s, ahead.curve_mm, front_most_mm, speed_most_mm_s)
        and is_kept(bounds, table.line_mm_s, table.turnout_mm_s, ahead.turnout_mm, front_most_mm, speed_most_mm_s)
    )
