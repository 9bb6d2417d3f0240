"""The brake: it comes on early enough that the head stops before the end of authority (T12, P7).

The rule is worked out for the worst: the train gains speed as hard as it can for this cycle and for as
long as the brake takes to respond, and only then slows by what the brake guarantees.  If it would
not stop before the end of its authority then, the brake comes on now.  To be slower from a place on is the same
with another speed than 0 at the end.

An inequality instead of a division: u² - v² <= 2 b s, with u and v in µm/s, b in mm/s² and s in nm.  It fits into
64 bits for speeds to 200 m/s, decelerations to 4 m/s² and ends at most 1000 km ahead.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

from kernel.onboard.arithmetic import (
    GREATEST_SPEED_MM_S,
    LONGEST_CYCLE_MS,
    NM_A_MM,
    SHORTEST_CYCLE_MS,
    limited,
    smaller,
)

FARTHEST_MM = 10**9
"""The farthest ahead that an end of authority is reckoned with; what lies beyond counts as so far."""
GREATEST_PLACE_MM = 10**9
"""Places are within 1000 km of the kilometrage's origin; what is beyond is no place."""


@dataclass(frozen=True)
class BrakeBounds:
    """What the brake is held to, on the steepest gradient and the worst adhesion; each above 0 (T12).

    ``gains_mm_s2``: the most that the train gains while the brake is not yet effective.
    ``slows_mm_s2``: the least that the brake slows it by, once effective.
    ``response_cycles``: from the command until then; and from when a cycle that is missed had to begin until the
    brake is effective that the watchdog commands.
    ``standstill_mm_s``: certainly no faster than this, either way, the train counts as standing.
    ``cut_cycles``: from the command until the motors are cut off, no longer than the response.
    ``falls_mm_s2``: the most that the train gains from then on, on the steepest descent; no more than ``gains_mm_s2``.
    """

    gains_mm_s2: int
    slows_mm_s2: int
    response_cycles: int
    standstill_mm_s: int
    cut_cycles: int
    falls_mm_s2: int


@dataclass(frozen=True)
class Brake:
    """What the brake control knows (T12).

    ``applied``: the emergency brake is commanded; it stays so until released at a standstill.
    ``end_mm``: the end of authority, on the line's kilometrage.
    ``withheld``: the unit wants a nearer end, which the train could overrun, or has none to give; the brake
    stays applied until an end is taken, whoever acknowledges (T4, T9).
    """

    applied: bool
    end_mm: int
    withheld: bool = False


def slows_mm_s2(bounds: BrakeBounds) -> int:
    """Give how the brake slows the train over its way at the least (T12).

    Each cycle may be as long as it may for the way that is run in it, and as short for the brake.
    """
    return bounds.slows_mm_s2 * SHORTEST_CYCLE_MS // LONGEST_CYCLE_MS


def worst_um_s(bounds: BrakeBounds, speed_most_mm_s: int) -> int:
    """Give how fast the train may be when a brake commanded a cycle from now responds (T12)."""
    return 1000 * speed_most_mm_s + (bounds.response_cycles + 1) * LONGEST_CYCLE_MS * bounds.gains_mm_s2


def reach_nm(bounds: BrakeBounds, front_most_mm: int, speed_most_mm_s: int) -> int:
    """Give how far the head may be then (T12)."""
    way_nm = (bounds.response_cycles + 1) * LONGEST_CYCLE_MS * worst_um_s(bounds, speed_most_mm_s)
    return NM_A_MM * front_most_mm + way_nm


def left_nm(bounds: BrakeBounds, front_most_mm: int, speed_most_mm_s: int, end_mm: int) -> int:
    """Give the way that is left then for the brake, less the one cycle in which it takes hold (T12)."""
    end_nm = NM_A_MM * smaller(end_mm, front_most_mm + FARTHEST_MM)
    cycle_nm = LONGEST_CYCLE_MS * worst_um_s(bounds, speed_most_mm_s)
    return end_nm - reach_nm(bounds, front_most_mm, speed_most_mm_s) - cycle_nm


def slows_before(bounds: BrakeBounds, front_most_mm: int, speed_most_mm_s: int, place_mm: int, to_mm_s: int) -> bool:
    """Tell whether a train that brakes a cycle from now runs at no more than ``to_mm_s`` from a place on (T12).

    ``front_most_mm``, ``speed_most_mm_s``: as far and as fast as it may be.  Out of range, it does not.
    """
    if not 0 <= speed_most_mm_s <= GREATEST_SPEED_MM_S or not -GREATEST_PLACE_MM <= front_most_mm <= GREATEST_PLACE_MM:
        return False
    fast_um_s, slow_um_s = worst_um_s(bounds, speed_most_mm_s), 1000 * limited(to_mm_s, 0, GREATEST_SPEED_MM_S)
    if fast_um_s < slow_um_s:
        return True
    if place_mm < front_most_mm:
        return False
    way_nm = left_nm(bounds, front_most_mm, speed_most_mm_s, place_mm)
    return way_nm >= 0 and fast_um_s * fast_um_s - slow_um_s * slow_um_s <= 2 * slows_mm_s2(bounds) * way_nm


def stops_before(bounds: BrakeBounds, front_most_mm: int, speed_most_mm_s: int, end_mm: int) -> bool:
    """Tell whether a train that brakes a cycle from now still stops before the end, whatever its brake is (T12)."""
    return end_mm >= front_most_mm and slows_before(bounds, front_most_mm, speed_most_mm_s, end_mm, 0)


def supervise(
    bounds: BrakeBounds,
    brake: Brake,
    front_most_mm: int,
    speed_least_mm_s: int,
    speed_most_mm_s: int,
    demanded: bool,
    acknowledged: bool,
) -> Brake:
    """Decide for the cycle that begins (T12).

    ``speed_least_mm_s``: below 0 if the train may roll back.
    ``demanded``: another machine wants the emergency brake (``kernel.onboard.brake_demand``); while it does, the
    numbers need not be true (T5, P5).
    ``acknowledged``: the driver has acknowledged it; it is released at a standstill, if nothing wants it any more.
    """
    safe = not demanded and not brake.withheld and stops_before(bounds, front_most_mm, speed_most_mm_s, brake.end_mm)
    still = -bounds.standstill_mm_s <= speed_least_mm_s and speed_most_mm_s <= bounds.standstill_mm_s
    stands = acknowledged and still
    return replace(brake, applied=not safe or (brake.applied and not stands))


def take_end(bounds: BrakeBounds, brake: Brake, front_most_mm: int, speed_most_mm_s: int, end_mm: int) -> Brake:
    """Take a new end of authority: farther at any time, nearer if the train can still stop before it (T4, T9, T12).

    A nearer end that it could overrun is not taken: the old one stands, and the brake comes on and stays on
    until the end that is wanted can be held.  So it is asked in each cycle.
    """
    if end_mm >= brake.end_mm or stops_before(bounds, front_most_mm, speed_most_mm_s, end_mm):
        return replace(brake, end_mm=end_mm, withheld=False)
    return replace(brake, applied=True, withheld=True)


def withhold_end(brake: Brake) -> Brake:
    """Brake, since the unit has no end of authority to give; nothing but an end that is taken lifts this (T4, T12)."""
    return replace(brake, applied=True, withheld=True)


def stand_still(front_most_mm: int) -> Brake:
    """Begin where the train stands, held by its brake: with no authority beyond its front (T12).

    A brake that has yet to respond (:class:`kernel.standstill.Standstill`) holds nothing: such a train may still get
    beyond its front.
    ``front_most_mm``: the front is no farther than this.
    """
    return Brake(applied=True, end_mm=front_most_mm, withheld=True)
