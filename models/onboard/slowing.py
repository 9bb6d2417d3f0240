"""A train on its way to curves and turnouts that a list has ahead, under the brake control (T12).

History of the last decision that the brake may be off, whatever ends of authority were taken since: by what it
was reckoned then, and from where on the train would be slow enough.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

from kernel.onboard import braking, restriction_ahead
from kernel.onboard.braking import BrakeBounds
from kernel.onboard.restriction_ahead import NONE_LISTED, Ahead
from kernel.onboard.speed_limit import SpeedTable
from models.onboard.units import LONGEST_MS, NM_A_MM, NO_SPEED_MM_S, SHORTEST_MS, UM_A_MM, larger, smaller

NOWHERE_NM = 2_000_000_000 * NM_A_MM
"""Beyond every place: kilometrages are no longer than 1,000 km (ours)."""


@dataclass(frozen=True)
class Reckoned:
    """A place that the brake control reckoned with when it last let the brake off.

    ``kept_nm``: truly the place is no nearer than here.
    ``left_nm``: the way that was left for the brake up to it by that decision.
    ``slow_um_s``: how fast the train might be there.
    """

    kept_nm: int
    left_nm: int
    slow_um_s: int


@dataclass(frozen=True)
class Slowing:
    """One moment.

    ``from_um_s``: how fast the train was when the newest cycle began.
    ``response_cycles``, ``worst_um_s``, ``reach_nm``: as of :class:`models.onboard.braking.Approach`, but for nothing
    else than that decision.
    ``slows_mm_s2``: how the brake slows it over its way, as was reckoned then.
    ``curve_nm``, ``turnout_nm``: truly the front enters none that is listed before here.
    ``ahead``: what the unit knows of them.
    ``curve``, ``turnout``, ``end``: the nearest of each that was listed then, and the end of authority.
    """

    from_um_s: int
    response_cycles: int
    worst_um_s: int
    reach_nm: int
    slows_mm_s2: int
    curve_nm: int
    turnout_nm: int
    ahead: Ahead
    curve: Reckoned
    turnout: Reckoned
    end: Reckoned


# ---- what becomes of it


def at_rest(bounds: BrakeBounds, head_nm: int, end_mm: int) -> Slowing:
    """A train that stands, held by its brake, with nothing listed ahead."""
    end = Reckoned(kept_nm=NM_A_MM * end_mm, left_nm=NM_A_MM * end_mm - head_nm, slow_um_s=0)
    return Slowing(
        from_um_s=0,
        response_cycles=0,
        worst_um_s=0,
        reach_nm=head_nm,
        slows_mm_s2=slows_mm_s2(bounds),
        curve_nm=NOWHERE_NM,
        turnout_nm=NOWHERE_NM,
        ahead=NONE_LISTED,
        curve=end,
        turnout=end,
        end=end,
    )


def listed(slowing: Slowing, in_curve: bool, at_turnout: bool, kind: int, from_mm: int, begins_nm: int) -> Slowing:
    """A tag is listed ahead, from which a curve, a turnout, both or neither lies."""
    return replace(
        slowing,
        curve_nm=smaller(slowing.curve_nm, begins_nm) if in_curve else slowing.curve_nm,
        turnout_nm=smaller(slowing.turnout_nm, begins_nm) if at_turnout else slowing.turnout_nm,
        ahead=restriction_ahead.note_listed(slowing.ahead, kind, from_mm),
    )


def unlisted(slowing: Slowing) -> Slowing:
    """Nothing is listed any more, until something is."""
    return replace(slowing, curve_nm=NOWHERE_NM, turnout_nm=NOWHERE_NM, ahead=NONE_LISTED)


def let_run(
    bounds: BrakeBounds,
    table: SpeedTable,
    slowing: Slowing,
    front_most_mm: int,
    speed_most_mm_s: int,
    end_mm: int,
    from_um_s: int,
) -> Slowing:
    """The control has let the brake off: note by which reckoning (T12)."""
    curve_mm, turnout_mm = slowing.ahead.curve_mm, slowing.ahead.turnout_mm
    return replace(
        slowing,
        from_um_s=from_um_s,
        response_cycles=bounds.response_cycles,
        worst_um_s=braking.worst_um_s(bounds, speed_most_mm_s),
        reach_nm=braking.reach_nm(bounds, front_most_mm, speed_most_mm_s),
        slows_mm_s2=slows_mm_s2(bounds),
        curve=Reckoned(
            slowing.curve_nm,
            braking.left_nm(bounds, front_most_mm, speed_most_mm_s, curve_mm),
            allowed_um_s(table.curve_mm_s),
        ),
        turnout=Reckoned(
            slowing.turnout_nm,
            braking.left_nm(bounds, front_most_mm, speed_most_mm_s, turnout_mm),
            allowed_um_s(table.turnout_mm_s),
        ),
        end=Reckoned(NM_A_MM * end_mm, braking.left_nm(bounds, front_most_mm, speed_most_mm_s, end_mm), 0),
    )


def held(slowing: Slowing, from_um_s: int) -> Slowing:
    """The brake is on for a cycle (T12)."""
    if slowing.response_cycles > 0:
        return replace(slowing, from_um_s=from_um_s, response_cycles=slowing.response_cycles - 1)
    slowed_um_s = larger(0, slowing.worst_um_s - LONGEST_MS * slowing.slows_mm_s2)
    curve, turnout, end, ran_nm = slowing.curve, slowing.turnout, slowing.end, LONGEST_MS * slowed_um_s
    return replace(
        slowing,
        from_um_s=from_um_s,
        worst_um_s=slowed_um_s,
        reach_nm=slowing.reach_nm + LONGEST_MS * slowing.worst_um_s,
        curve=replace(curve, left_nm=curve.left_nm - ran_nm),
        turnout=replace(turnout, left_nm=turnout.left_nm - ran_nm),
        end=replace(end, left_nm=end.left_nm - ran_nm),
    )


def allowed_um_s(restricted_mm_s: int) -> int:
    """How fast a train may be where no more is allowed; a speed is between 0 and 200 m/s (ours)."""
    return UM_A_MM * larger(0, smaller(restricted_mm_s, NO_SPEED_MM_S))


def slows_mm_s2(bounds: BrakeBounds) -> int:
    """How a brake slows the train in long cycles that does so by what is guaranteed in short ones (T12)."""
    return bounds.slows_mm_s2 * SHORTEST_MS // LONGEST_MS
