"""How fast the train may run, by the kinds of the tags that it has passed; unknown is the worst case (T12).

A kind speaks of the track from its tag to the next one that is read.  The restriction counts for the
whole train: it ends when the rear has passed the tag where it ended, and the rear is where the
odometry's range puts it at the least.  One end is remembered for curves and one for turnouts, the last
of each; an earlier end lies behind it, and is passed before.

A tag that is not where a list has it says nothing, and what was known of the track counts no more: nobody
knows which one it is.  That a tag is missed is the second loop's to notice (T5); what a list has from it on counts
from where the front may be there, read or not.  What lies ahead of the next tag is not known here, but by lists
(``kernel.onboard.restriction_ahead``); where no list had it the brake slows the train from the tag on.  Nothing is
calculated, so that every number of 64 bits is answered.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

from kernel.onboard.arithmetic import smaller
from kernel.onboard.tag_kind import is_curve, is_turnout


@dataclass(frozen=True)
class SpeedTable:
    """The speeds of the line (T12).

    ``line_mm_s``: where nothing restricts; ``curve_mm_s``: in the line's sharpest curve;
    ``turnout_mm_s``: over its sharpest turnout.
    """

    line_mm_s: int
    curve_mm_s: int
    turnout_mm_s: int


@dataclass(frozen=True)
class SpeedLimit:
    """What the train knows of the track that it is on (T12).

    ``in_curve``, ``at_turnout``: the last tag's kind, of the track that the head is on.
    ``curve_until_mm``, ``turnout_until_mm``: the last that ended did so no farther than here.
    """

    in_curve: bool
    at_turnout: bool
    curve_until_mm: int
    turnout_until_mm: int


UNKNOWN = SpeedLimit(in_curve=True, at_turnout=True, curve_until_mm=0, turnout_until_mm=0)
"""Before the first tag everything restricts (T8, T12); where it ends is set by that tag."""


def note_tag(limit: SpeedLimit, kind: int, known: bool, read_most_mm: int) -> SpeedLimit:
    """Take a tag that the head has read: what it was on ends here, and what the kind says begins (T1, T12).

    ``known``: a range is claimed; without one it is not known where anything ends, nor where it begins (T8).
    ``read_most_mm``: the front was no farther than this when it was read (P7).
    """
    return SpeedLimit(
        in_curve=not known or is_curve(kind),
        at_turnout=not known or is_turnout(kind),
        curve_until_mm=read_most_mm if known and limit.in_curve else limit.curve_until_mm,
        turnout_until_mm=read_most_mm if known and limit.at_turnout else limit.turnout_until_mm,
    )


def note_unlisted_tag(limit: SpeedLimit) -> SpeedLimit:
    """Take a tag that is none of a list's there: from it on anything may lie, until the next one (T5, T12)."""
    return replace(limit, in_curve=True, at_turnout=True)


def note_entered(limit: SpeedLimit, curve: bool, turnout: bool) -> SpeedLimit:
    """Take the head to be in a listed curve, on a listed turnout, where it may be: the tag may be missed (T5, T12)."""
    return replace(limit, in_curve=limit.in_curve or curve, at_turnout=limit.at_turnout or turnout)


def permitted_mm_s(table: SpeedTable, in_curve: bool, at_turnout: bool) -> int:
    """Give the smallest speed that applies (T12)."""
    curve_mm_s = smaller(table.line_mm_s, table.curve_mm_s) if in_curve else table.line_mm_s
    return smaller(curve_mm_s, table.turnout_mm_s) if at_turnout else curve_mm_s


def limit_mm_s(table: SpeedTable, limit: SpeedLimit, rear_least_mm: int) -> int:
    """Give how fast the train may run, from its head to its rear (T12).

    ``rear_least_mm``: the rear is no less far than this (P7).
    """
    return permitted_mm_s(
        table,
        limit.in_curve or rear_least_mm <= limit.curve_until_mm,
        limit.at_turnout or rear_least_mm <= limit.turnout_until_mm,
    )


def is_overspeed(table: SpeedTable, limit: SpeedLimit, known: bool, rear_least_mm: int, speed_most_mm_s: int) -> bool:
    """Tell whether the train may be too fast, so that the emergency brake is demanded (T12).

    ``known``: a range is claimed; a train without one may be anywhere, at any speed (T8).
    ``speed_most_mm_s``: the upper end of the odometry's range (P1); a negative one is no speed.
    """
    return not known or not 0 <= speed_most_mm_s <= limit_mm_s(table, limit, rear_least_mm)
