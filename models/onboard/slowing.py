"""A train on its way to curves and turnouts that a list has ahead, under the brake control (T12).

History of the last decision that the brake may be off, whatever ends of authority were taken since: by what it
was reckoned then, and from where on the train would be slow enough.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

from kernel.onboard import braking, restriction_ahead
from kernel.onboard.braking import BrakeBounds
from kernel.onboard.restriction_ahead import NONE_LISTED, Ahead
from models.onboard.units import LONGEST_MS, NM_A_MM, SHORTEST_MS, larger, smaller

NOWHERE_NM = 2_000_000_000 * NM_A_MM
"""Beyond every place: kilometrages are no longer than 1,000 km (ours)."""


@dataclass(frozen=True)
class Nearest:
    """The nearest of one kind of restriction.

    ``listed_nm``: truly the front enters none that was listed before here.
    ``kept_nm``: that, or the end of authority where it was nearer, when the brake was last let off.
    ``left_nm``: the way that was left for the brake by that decision.
    """

    listed_nm: int
    kept_nm: int
    left_nm: int


@dataclass(frozen=True)
class Slowing:
    """One moment.

    ``from_um_s``: how fast the train was when the newest cycle began.
    ``response_cycles``, ``worst_um_s``, ``reach_nm``: as of :class:`models.onboard.braking.Approach`, but for nothing
    else than that decision.
    ``curve``, ``turnout``: the nearest.  ``ahead``: what the unit knows.
    """

    from_um_s: int
    response_cycles: int
    worst_um_s: int
    reach_nm: int
    curve: Nearest
    turnout: Nearest
    ahead: Ahead


# ---- what becomes of it


def at_rest(head_nm: int, end_mm: int) -> Slowing:
    """A train that stands, held by its brake, with nothing listed ahead."""
    none = Nearest(listed_nm=NOWHERE_NM, kept_nm=NM_A_MM * end_mm, left_nm=NM_A_MM * end_mm - head_nm)
    return Slowing(
        from_um_s=0, response_cycles=0, worst_um_s=0, reach_nm=head_nm, curve=none, turnout=none, ahead=NONE_LISTED
    )


def listed(slowing: Slowing, in_curve: bool, at_turnout: bool, kind: int, from_mm: int, read_from_nm: int) -> Slowing:
    """A tag is listed ahead, from which a curve, a turnout, both or neither lies."""
    curve, turnout = slowing.curve, slowing.turnout
    curve_nm, turnout_nm = smaller(curve.listed_nm, read_from_nm), smaller(turnout.listed_nm, read_from_nm)
    return replace(
        slowing,
        curve=replace(curve, listed_nm=curve_nm if in_curve else curve.listed_nm),
        turnout=replace(turnout, listed_nm=turnout_nm if at_turnout else turnout.listed_nm),
        ahead=restriction_ahead.note_listed(slowing.ahead, kind, from_mm),
    )


def unlisted(slowing: Slowing) -> Slowing:
    """Nothing is listed any more, until something is."""
    return replace(
        slowing,
        curve=replace(slowing.curve, listed_nm=NOWHERE_NM),
        turnout=replace(slowing.turnout, listed_nm=NOWHERE_NM),
        ahead=NONE_LISTED,
    )


def let_run(
    bounds: BrakeBounds, slowing: Slowing, front_most_mm: int, speed_most_mm_s: int, end_mm: int, from_um_s: int
) -> Slowing:
    """The control has let the brake off: note by which reckoning (T12)."""
    ahead = slowing.ahead
    return replace(
        slowing,
        from_um_s=from_um_s,
        response_cycles=bounds.response_cycles,
        worst_um_s=braking.worst_um_s(bounds, speed_most_mm_s),
        reach_nm=braking.reach_nm(bounds, front_most_mm, speed_most_mm_s),
        curve=_reckoned(bounds, slowing.curve, front_most_mm, speed_most_mm_s, ahead.curve_mm, end_mm),
        turnout=_reckoned(bounds, slowing.turnout, front_most_mm, speed_most_mm_s, ahead.turnout_mm, end_mm),
    )


def _reckoned(
    bounds: BrakeBounds, nearest: Nearest, front_most_mm: int, speed_most_mm_s: int, from_mm: int, end_mm: int
) -> Nearest:
    is_listed = nearest.listed_nm <= NM_A_MM * end_mm
    to_mm = from_mm if is_listed else end_mm
    return replace(
        nearest,
        kept_nm=nearest.listed_nm if is_listed else NM_A_MM * end_mm,
        left_nm=braking.left_nm(bounds, front_most_mm, speed_most_mm_s, to_mm),
    )


def held(bounds: BrakeBounds, slowing: Slowing, from_um_s: int) -> Slowing:
    """The brake is on for a cycle (T12)."""
    if slowing.response_cycles > 0:
        return replace(slowing, from_um_s=from_um_s, response_cycles=slowing.response_cycles - 1)
    slowed_um_s = larger(0, slowing.worst_um_s - LONGEST_MS * slows_mm_s2(bounds))
    curve, turnout, ran_nm = slowing.curve, slowing.turnout, LONGEST_MS * slowed_um_s
    return replace(
        slowing,
        from_um_s=from_um_s,
        worst_um_s=slowed_um_s,
        reach_nm=slowing.reach_nm + LONGEST_MS * slowing.worst_um_s,
        curve=replace(curve, left_nm=curve.left_nm - ran_nm),
        turnout=replace(turnout, left_nm=turnout.left_nm - ran_nm),
    )


def slows_mm_s2(bounds: BrakeBounds) -> int:
    """How a brake slows the train in long cycles that does so by what is guaranteed in short ones (T12)."""
    return bounds.slows_mm_s2 * SHORTEST_MS // LONGEST_MS
