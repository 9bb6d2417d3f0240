"""The earliest possible arrival of a train at a crossing, and the moment to warn for it (X1, X2, X3).

From one ranging to the next the train is held to be the worst that it may be: it gains speed as hard as it
can, up to the ceiling that it has promised, or else the greatest speed of the line.  The earliest arrival counts,
and not the likely one (X2, ours).

Each ranging is held against the one before (ours).  Both cannot be of this train if it would have had to be
faster than the line allows, either way, or to gain more than it can, by more than rangings err: then the
warning begins, whichever of the two was wrong.  Of a train that runs no two are alike to the millimetre: one that
is the one before again is of a radio that hangs, and counts as none, whatever its age is told to be; if it goes on
the ranging is lost.

No division: instead of a time of arrival the rule asks whether the way ends within so many cycles.  Ways are
in µm, and so are paces, which is what speeds are here: the way of one cycle.  mm/s times ms is µm.  All fits
into 64 bits for speeds to 200 m/s, gains to 4 m/s², cycles to a second and warning times to two minutes.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

from kernel.onboard.arithmetic import GREATEST_SPEED_MM_S, larger, limited, magnitude

UM_A_MM = 1_000

FARTHEST_MM = 10**8
"""Rangings are of trains within 100 km; what is beyond is none (X1)."""


@dataclass(frozen=True)
class ArrivalBounds:
    """What trains before one crossing are held to (X2); each above 0.

    ``line_um``: the greatest pace on the line, with what a driver may exceed its speed by.
    ``gain_um``: the most pace that any train gains in a cycle, on the steepest descent, rounded up.
    ``cycle_ms``: from one decision to the next.
    ``warning_cycles``: the crossing's warning time (X5).
    ``silence_cycles``: as long as a ranging counts; then it is lost (X3).
    ``way_spread_mm``, ``speed_spread_mm_s``: of two exact rangings neither way nor speed differs by more through
    errors alone; what is told of a ranging is its bound, so that is the whole width of its error (X1).
    """

    line_um: int
    gain_um: int
    cycle_ms: int
    warning_cycles: int
    silence_cycles: int
    way_spread_mm: int
    speed_spread_mm_s: int


@dataclass(frozen=True)
class Ranging:
    """What came of the radio in this cycle (X1).

    ``valid``: something did.
    ``way_mm``: the nearest that the head was to the crossing by it; ``speed_mm_s``: the fastest towards it.
    ``age_cycles``: how long ago that was.
    """

    valid: bool
    way_mm: int
    speed_mm_s: int
    age_cycles: int


@dataclass(frozen=True)
class Followed:
    """What is known of a train in contact (X2).

    ``way_um``: the nearest that its head may be to the crossing; ``short_um``: by how
    much it is slower than ``ceiling_um``, at least.
    ``ceiling_um``: it runs no faster up to the road: the greatest pace on the line, or what it has promised.
    ``age_cycles``: how old the ranging is that this rests on; beyond ``silence_cycles`` nothing is claimed.
    ``told_way_mm``, ``told_speed_mm_s``: what that ranging told; of one that moves away, that it stands.
    ``warns``: it asks for the warning; it does so until it has passed.
    """

    way_um: int
    short_um: int
    ceiling_um: int
    age_cycles: int
    told_way_mm: int
    told_speed_mm_s: int
    warns: bool


def are_lawful(bounds: ArrivalBounds) -> bool:
    """Tell whether trains may be held to these bounds; if not, the crossing is not put into service (X2).

    They move and gain speed, cycles last, the warning time is not negative, and a ranging may be late.
    """
    return (
        bounds.line_um > 0
        and bounds.gain_um > 0
        and bounds.cycle_ms > 0
        and bounds.warning_cycles >= 0
        and bounds.silence_cycles > 0
    )


def nothing_known(bounds: ArrivalBounds) -> Followed:
    """Give what is known of a train before the first ranging that counts, or after a restart: it may be here (X3)."""
    return Followed(
        way_um=0,
        short_um=0,
        ceiling_um=bounds.line_um,
        age_cycles=bounds.silence_cycles + 1,
        told_way_mm=0,
        told_speed_mm_s=0,
        warns=False,
    )


def cannot_arrive(bounds: ArrivalBounds, followed: Followed, cycles: int) -> bool:
    """Tell whether a train that is no nearer and no faster than this does not arrive within so many cycles (X2).

    Either it gains all the while; or it comes to its ceiling on the way, and what it is short of that
    now shortens the way that it would make at it.  ``short_um`` is not negative.
    """
    short_um = followed.short_um
    nearer_um = cycles * followed.ceiling_um - followed.way_um
    if cycles * bounds.gain_um <= short_um:
        return 2 * nearer_um < 2 * cycles * short_um - cycles * (cycles + 1) * bounds.gain_um
    return 2 * bounds.gain_um * nearer_um < short_um * (short_um - bounds.gain_um)


def held_to(bounds: ArrivalBounds, followed: Followed, ceiling_um: int) -> Followed:
    """Reckon with another ceiling, within the line's speed (X2, ours)."""
    now_um = limited(ceiling_um, 0, bounds.line_um)
    short_um = larger(0, followed.short_um + now_um - followed.ceiling_um)
    return replace(followed, ceiling_um=now_um, short_um=short_um)


def counts(bounds: ArrivalBounds, ranging: Ranging) -> bool:
    """Tell whether a ranging may be reckoned with: there is one, of this line, and not too old (X1, X3)."""
    return (
        ranging.valid
        and -FARTHEST_MM <= ranging.way_mm <= FARTHEST_MM
        and ranging.speed_mm_s <= GREATEST_SPEED_MM_S
        and 0 <= ranging.age_cycles <= bounds.silence_cycles
    )


def begins_contact(bounds: ArrivalBounds, ranging: Ranging) -> bool:
    """Tell whether contact begins by this ranging: it counts, and the train does not run away for certain (X1, ours).

    One that does would be lost out of the radio's reach, and the road closed for nobody.
    """
    return counts(bounds, ranging) and ranging.speed_mm_s >= 0


def taken(bounds: ArrivalBounds, followed: Followed, ranging: Ranging) -> Followed:
    """Take a ranging: shortened by its age at the greatest speed of the line (X2, ours).

    A train that moves away counts as standing.
    """
    if not counts(bounds, ranging):
        return followed
    pace_um = bounds.cycle_ms * larger(0, ranging.speed_mm_s) + ranging.age_cycles * bounds.gain_um
    return replace(
        followed,
        way_um=UM_A_MM * ranging.way_mm - ranging.age_cycles * bounds.line_um,
        short_um=larger(0, followed.ceiling_um - pace_um),
        age_cycles=ranging.age_cycles,
        told_way_mm=ranging.way_mm,
        told_speed_mm_s=larger(0, ranging.speed_mm_s),
    )


def contradicts(bounds: ArrivalBounds, followed: Followed, ranging: Ranging) -> bool:
    """Tell whether a ranging and the one before cannot both be of this train, while both count (X1, ours).

    A repeated or late one may be older than the one before: then it is the other that may have gained.
    """
    if not counts(bounds, ranging) or followed.age_cycles > bounds.silence_cycles:
        return False
    cycles = magnitude(followed.age_cycles - ranging.age_cycles)
    way_um = UM_A_MM * magnitude(ranging.way_mm - followed.told_way_mm)
    faster_mm_s = larger(0, ranging.speed_mm_s) - followed.told_speed_mm_s
    gained_mm_s = faster_mm_s if ranging.age_cycles <= followed.age_cycles else -faster_mm_s
    return (
        way_um > UM_A_MM * bounds.way_spread_mm + cycles * bounds.line_um
        or bounds.cycle_ms * gained_mm_s > bounds.cycle_ms * bounds.speed_spread_mm_s + cycles * bounds.gain_um
    )


def is_told_again(bounds: ArrivalBounds, followed: Followed, ranging: Ranging) -> bool:
    """Tell whether a ranging is the one before once more, of a train that certainly ran: a radio hangs (X1, ours)."""
    return (
        ranging.way_mm == followed.told_way_mm
        and ranging.speed_mm_s == followed.told_speed_mm_s
        and ranging.speed_mm_s > bounds.speed_spread_mm_s
    )


def must_warn(bounds: ArrivalBounds, followed: Followed) -> bool:
    """Tell whether the warning must begin now: its ranging is lost, or the next decision might be too late (X2, X3).

    One cycle until the next decision, and one in which it arrives: the warning time lies between them.
    """
    if followed.warns or followed.age_cycles > bounds.silence_cycles:
        return True
    return not cannot_arrive(bounds, followed, bounds.warning_cycles + 2)


def aged(bounds: ArrivalBounds, followed: Followed) -> Followed:
    """Give the worst that the train may be one cycle later (X2); what is lost stays as it is."""
    if followed.age_cycles > bounds.silence_cycles:
        return followed
    short_um = larger(0, followed.short_um - bounds.gain_um)
    return replace(
        followed,
        way_um=followed.way_um - followed.ceiling_um + short_um,
        short_um=short_um,
        age_cycles=followed.age_cycles + 1,
    )


def follow(bounds: ArrivalBounds, followed: Followed, ranging: Ranging) -> Followed:
    """Decide for the cycle that begins (X1, X2, X3); :func:`aged` is what is known at its end.

    A ranging that contradicts the one before is a fault, and warns now; one that is the same again is none.
    """
    if is_told_again(bounds, followed, ranging):
        return replace(followed, warns=must_warn(bounds, followed))
    now = taken(bounds, followed, ranging)
    return replace(now, warns=contradicts(bounds, followed, ranging) or must_warn(bounds, now))


def has_turned_back(bounds: ArrivalBounds, followed: Followed, ranging: Ranging, start_mm: int) -> bool:
    """Tell whether a train that was just followed by this ranging runs away, and is before its start point (X4, ours).

    If it is whole it is gone then (``crossing.note_gone``), and contact with it is over: whenever it comes again it
    strikes there, or contact is made before.  ``start_mm``: from its start point to the road, rounded up.
    One that was due, lost or contradicted as it was followed is left to whoever proves its rear out.
    """
    return (
        counts(bounds, ranging)
        and ranging.speed_mm_s < 0
        and not followed.warns
        and followed.way_um > UM_A_MM * start_mm
    )
