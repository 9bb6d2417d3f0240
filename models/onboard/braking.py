"""A train's head, its motors and its brake, under the brake control (T12).

The head as a point: ``range_contains_train`` of the odometry says that it is no farther than the unit
reckons.  Ways in nm, speeds in µm/s, as in ``models.onboard.odometry``; a speed below 0 is backward.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

from kernel.onboard import braking, restriction_ahead
from kernel.onboard import ceiling as machine
from kernel.onboard.braking import Brake, BrakeBounds
from kernel.onboard.ceiling import Ceiling
from kernel.onboard.speed_limit import SpeedTable
from models.onboard import ceiling as ceilings
from models.onboard import slowing, speed_limit
from models.onboard.ceiling import Keeping
from models.onboard.slowing import Slowing
from models.onboard.units import LONGEST_MS, NM_A_MM, SHORTEST_MS, UM_A_MM, larger, magnitude, smaller


@dataclass(frozen=True)
class Vehicle:
    """What does not change: the bounds that the brake is held to, and the speeds of the line (T12)."""

    bounds: BrakeBounds
    table: SpeedTable


@dataclass(frozen=True)
class Approach:
    """One moment of a train that runs towards the end of its authority.

    ``head_nm``, ``speed_um_s``: where the head is, and how fast.
    ``response_cycles``: how long the brake takes to respond; it counts down once commanded.
    ``worst_um_s``, ``reach_nm``: history: how fast and how far, by the control's last decision that the
    brake may be off, the head may be when the brake responds; then what is left of them.
    ``left_nm``: history: the way that was left for the brake by that decision.
    ``demanded``: history: the brake was demanded when the control last decided.
    ``released_amiss``: history: it has gone off while it was demanded, unacknowledged, or while the train moved.
    ``brake``: what the brake control knows.
    ``wanted``, ``wanted_mm``: the end of authority that the unit wants, if there is one.
    ``slowing``: the train as it comes to restrictions ahead.
    ``ceiling``: it keeps to this.  ``keeping``: the train as it does so.
    """

    head_nm: int
    speed_um_s: int
    response_cycles: int
    worst_um_s: int
    reach_nm: int
    left_nm: int
    demanded: bool
    released_amiss: bool
    brake: Brake
    wanted: bool
    wanted_mm: int
    slowing: Slowing
    ceiling: Ceiling
    keeping: Keeping


# ---- premises


def the_brake_slows(site: Vehicle) -> bool:
    """The brake slows the train in cycles of any length, and its response takes a cycle at least (T12).

    The product follows from its factors; said, it spares the solvers the search for it.
    """
    return (
        slowing.slows_mm_s2(site.bounds) > 0
        and site.bounds.gains_mm_s2 >= 0
        and site.bounds.response_cycles >= 1
        and site.bounds.response_cycles * site.bounds.gains_mm_s2 >= 0
    )


def the_motors_are_cut_off_before_it_does(site: Vehicle) -> bool:
    """Motors are cut off no later than the brake responds, and add to what a descent gives (T12).

    The products follow from their factors, as above.
    """
    bounds = site.bounds
    return (
        0 <= bounds.cut_cycles <= bounds.response_cycles
        and 0 <= bounds.falls_mm_s2 <= bounds.gains_mm_s2
        and bounds.cut_cycles * bounds.gains_mm_s2 >= 0
        and (bounds.response_cycles - bounds.cut_cycles) * bounds.falls_mm_s2 >= 0
    )


# ---- assumptions


def the_range_contains_the_head(
    system: Approach, front_most_mm: int, speed_least_mm_s: int, speed_most_mm_s: int
) -> bool:
    """The head is no farther, and as fast, as the odometry says: `range_contains_train`, `speed_range…` (P7)."""
    return (
        system.head_nm <= NM_A_MM * front_most_mm
        and UM_A_MM * speed_least_mm_s <= system.speed_um_s <= UM_A_MM * speed_most_mm_s
    )


def the_way_follows_the_speed(system: Approach, to_nm: int, speed_um_s: int) -> bool:
    """Within one cycle the head gets no farther than at the greater of the speeds at its ends (P1)."""
    fastest_um_s, ran_nm = larger(system.speed_um_s, speed_um_s), to_nm - system.head_nm
    return ran_nm <= LONGEST_MS * fastest_um_s or ran_nm <= SHORTEST_MS * fastest_um_s


def the_train_gains_no_more(site: Vehicle, system: Approach, speed_um_s: int) -> bool:
    """Until the brake responds the train gains no more speed than motors and descent can give it (T12).

    One that rolls back may besides be stopped by its brakes.
    """
    return speed_um_s - larger(0, system.speed_um_s) <= LONGEST_MS * site.bounds.gains_mm_s2


def motors_that_are_cut_off_give_nothing(site: Vehicle, system: Approach, speed_um_s: int) -> bool:
    """Once its motors are cut off, with the brake, the train gains no more than on the steepest descent (X2, T12).

    Of a train whose bounds say that this takes as long as the brake's response, nothing more is assumed by it.
    """
    return speed_um_s - larger(0, system.speed_um_s) <= LONGEST_MS * site.bounds.falls_mm_s2


def the_brake_keeps_its_bound(site: Vehicle, system: Approach, speed_um_s: int) -> bool:
    """A brake that has responded slows the train by what is guaranteed, until it stands, and holds it then (T12)."""
    return speed_um_s <= larger(0, system.speed_um_s - SHORTEST_MS * site.bounds.slows_mm_s2)


def a_list_hides_no_restriction(in_curve: bool, at_turnout: bool, kind: int) -> bool:
    """The list has of each tag what is written in it: every curve and turnout that lies after it (T1, T12)."""
    return speed_limit.a_kind_hides_no_restriction(in_curve, at_turnout, kind)


def what_a_listed_tag_begins_lies_no_nearer(from_mm: int, begins_nm: int) -> bool:
    """Where the unit reckons that a listed tag begins a restriction, none begins before (T1, T2)."""
    return NM_A_MM * from_mm <= begins_nm


# ---- transitions


def run_a_cycle(
    site: Vehicle,
    system: Approach,
    front_most_mm: int,
    speed_least_mm_s: int,
    speed_most_mm_s: int,
    demanded: bool,
    acknowledged: bool,
    to_nm: int,
    speed_um_s: int,
) -> Approach:
    """The control decides, and the train runs for a cycle as the driver, the line and the brake let it (T12).

    Whoever demands the brake may do so because nothing is known of place and speed.  A restriction ahead and a
    ceiling demand it.
    """
    if not demanded and not the_range_contains_the_head(system, front_most_mm, speed_least_mm_s, speed_most_mm_s):
        return system
    if not the_way_follows_the_speed(system, to_nm, speed_um_s):
        return system
    is_near = restriction_ahead.is_too_fast(
        site.bounds, site.table, system.slowing.ahead, front_most_mm, speed_most_mm_s
    ) or not machine.is_kept(site.bounds, system.ceiling, speed_most_mm_s)
    brake = braking.supervise(
        site.bounds, system.brake, front_most_mm, speed_least_mm_s, speed_most_mm_s, demanded or is_near, acknowledged
    )
    responds = brake.applied and system.response_cycles == 0
    waited_cycles = smaller(system.slowing.response_cycles, ceilings.response_cycles(system.keeping))
    if (responds or (brake.applied and waited_cycles == 0)) and not the_brake_keeps_its_bound(site, system, speed_um_s):
        return system
    is_cut = brake.applied and system.keeping.cut_cycles == 0
    if is_cut and not motors_that_are_cut_off_give_nothing(site, system, speed_um_s):
        return system
    if not the_train_gains_no_more(site, system, speed_um_s):
        return system
    if not brake.applied:
        begun = let_run(site, system, front_most_mm, speed_most_mm_s, brake)
        amiss = system.brake.applied and (demanded or not acknowledged or not stands(site, system))
        return replace(
            begun,
            head_nm=to_nm,
            speed_um_s=speed_um_s,
            demanded=demanded,
            released_amiss=system.released_amiss or amiss,
        )
    slowed_um_s = larger(0, system.worst_um_s - LONGEST_MS * slowing.slows_mm_s2(site.bounds))
    return replace(
        system,
        head_nm=to_nm,
        speed_um_s=speed_um_s,
        response_cycles=system.response_cycles if responds else system.response_cycles - 1,
        worst_um_s=slowed_um_s if responds else system.worst_um_s,
        reach_nm=system.reach_nm + LONGEST_MS * system.worst_um_s if responds else system.reach_nm,
        left_nm=system.left_nm - LONGEST_MS * slowed_um_s if responds else system.left_nm,
        demanded=demanded,
        brake=brake,
        slowing=slowing.held(system.slowing, system.speed_um_s),
        keeping=ceilings.held(system.keeping),
    )


def list_tag(
    site: Vehicle,
    system: Approach,
    in_curve: bool,
    at_turnout: bool,
    kind: int,
    from_mm: int,
    begins_nm: int,
) -> Approach:
    """A tag is listed ahead; what it says begins at ``begins_nm`` (T1, T12)."""
    if not a_list_hides_no_restriction(in_curve, at_turnout, kind):
        return system
    if not what_a_listed_tag_begins_lies_no_nearer(from_mm, begins_nm):
        return system
    return replace(system, slowing=slowing.listed(system.slowing, in_curve, at_turnout, kind, from_mm, begins_nm))


def list_none(site: Vehicle, system: Approach) -> Approach:
    """Nothing is listed ahead any more (T4, T12)."""
    return replace(system, slowing=slowing.unlisted(system.slowing))


def keep_to(
    site: Vehicle,
    system: Approach,
    front_most_mm: int,
    speed_least_mm_s: int,
    speed_most_mm_s: int,
    ceiling: Ceiling,
) -> Approach:
    """The train is to keep to a ceiling of speed, any at all: a higher one, or a lower one that it still can (X2)."""
    if not the_range_contains_the_head(system, front_most_mm, speed_least_mm_s, speed_most_mm_s):
        return system
    taken = machine.take(site.bounds, system.ceiling, ceiling, speed_most_mm_s)
    if taken.most_mm_s >= system.ceiling.most_mm_s:
        return replace(system, ceiling=taken)
    return replace(system, ceiling=taken, keeping=ceilings.begun(site.bounds, speed_most_mm_s))


def be_let_go(site: Vehicle, system: Approach, ceiling: Ceiling) -> Approach:
    """The train is let go faster, whatever is known of its speed (X2)."""
    if ceiling.most_mm_s < system.ceiling.most_mm_s:
        return system
    return replace(system, ceiling=ceiling)


def stands(site: Vehicle, system: Approach) -> bool:
    """The train is at rest, or as slow as counts for that (T12)."""
    return magnitude(system.speed_um_s) <= UM_A_MM * site.bounds.standstill_mm_s


def decided(site: Vehicle, system: Approach, front_most_mm: int, speed_most_mm_s: int, brake: Brake) -> Approach:
    """The control has found that the train would stop before the end: note by which reckoning (T12)."""
    return replace(
        system,
        response_cycles=site.bounds.response_cycles,
        worst_um_s=braking.worst_um_s(site.bounds, speed_most_mm_s),
        reach_nm=braking.reach_nm(site.bounds, front_most_mm, speed_most_mm_s),
        left_nm=braking.left_nm(site.bounds, front_most_mm, speed_most_mm_s, brake.end_mm),
        brake=brake,
    )


def let_run(site: Vehicle, system: Approach, front_most_mm: int, speed_most_mm_s: int, brake: Brake) -> Approach:
    """The control has found besides that it is slow enough for what is ahead, and for its ceiling (X2, T12)."""
    return replace(
        decided(site, system, front_most_mm, speed_most_mm_s, brake),
        slowing=slowing.let_run(
            site.bounds, site.table, system.slowing, front_most_mm, speed_most_mm_s, brake.end_mm, system.speed_um_s
        ),
        keeping=ceilings.begun(site.bounds, speed_most_mm_s),
    )


def take_end(
    site: Vehicle, system: Approach, front_most_mm: int, speed_least_mm_s: int, speed_most_mm_s: int, end_mm: int
) -> Approach:
    """A new end of authority comes, any at all (T4, T9).

    At a nearer end a brake that is on may take its response anew.
    """
    if not the_range_contains_the_head(system, front_most_mm, speed_least_mm_s, speed_most_mm_s):
        return system
    brake = braking.take_end(site.bounds, system.brake, front_most_mm, speed_most_mm_s, end_mm)
    amiss = system.released_amiss or (system.brake.applied and not brake.applied)
    asked = replace(system, wanted=True, wanted_mm=end_mm)
    if brake.end_mm < system.brake.end_mm:
        return replace(decided(site, asked, front_most_mm, speed_most_mm_s, brake), released_amiss=amiss)
    return replace(asked, brake=brake, released_amiss=amiss)


def withhold_end(site: Vehicle, system: Approach) -> Approach:
    """The unit has no end of authority to give (T4, T9)."""
    return replace(system, brake=braking.withhold_end(system.brake), wanted=False)
