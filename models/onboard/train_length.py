"""A train of some length, its ends passing points, and the machine that measures it (P4, T3, P8).

Places and ways are in nm, as in ``models.onboard.odometry``: nothing is divided, so nothing is rounded.  Errors are
the paper's, or as measured of the train and written; none is the machine's.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

from kernel.onboard import train_length as machine
from kernel.onboard.train_length import Length, LengthBounds, Passing, PointKind
from models.onboard.units import NM_A_MM, UM_A_MM

SAMPLING_MS = 100
"""Paper 001, table 2: sampled every 100 ms; at 130 km/h a train runs 3.61 m in that time."""
AVERAGING_NM = 781_250_000
"""2.5 km/h/s · (1.5 s)² / 2, what the speed changes in the average; paper 001, table 2, says 0.78 m."""
SENSOR_NM = 5_000_000_000
"""Paper 001, table 2."""


@dataclass(frozen=True)
class Railway:
    """What does not change: the bounds as written (P4)."""

    bounds: LengthBounds


@dataclass(frozen=True)
class Formation:
    """One moment of a train.

    ``length_nm``: how long it is.
    ``state``: what the machine knows.
    The rest is history of this formation and of this life of its unit.
    ``head_passed``: the head has passed a point: ``kind``, ``point``, noted for ``time_ms``, when the front
    was at ``front_nm`` and the train ran ``speed_mm_s``; odometry claimed (``was_known``) a range ``width_mm`` wide,
    and at most ``told_mm_s``.
    ``tail_passed``: the tail has passed some point.  ``both_passed``: one that the head had passed last.
    ``untold``: since the length in use was measured, vehicles were coupled or set out, and the unit was not told; or
    since it was forgotten the train is longer than the line allows.
    ``measured_nm``: how long the train was when that length was measured, which the errors of that measurement
    leave open by ``open_nm``.
    ``differed``: measured again, it was longer or shorter than that, by more than both measurements leave open.
    """

    length_nm: int
    state: Length
    head_passed: bool
    kind: PointKind
    point: int
    time_ms: int
    front_nm: int
    speed_mm_s: int
    was_known: bool
    width_mm: int
    told_mm_s: int
    tail_passed: bool
    both_passed: bool
    untold: bool
    measured_nm: int
    open_nm: int
    differed: bool


# ---- premises


def bounds_are_not_negative(site: Railway) -> bool:
    """No measure of a vehicle, nor a window, is below zero (P4)."""
    return (
        site.bounds.last_vehicle_mm >= 0
        and site.bounds.front_overhang_mm >= 0
        and site.bounds.rear_overhang_mm >= 0
        and site.bounds.window_mm >= 0
    )


def vehicles_are_of_this_world(site: Railway) -> bool:
    """Each measure and bound is at most a kilometre (P4)."""
    return (
        site.bounds.last_vehicle_mm <= 1_000_000
        and site.bounds.front_overhang_mm <= 1_000_000
        and site.bounds.rear_overhang_mm <= 1_000_000
        and site.bounds.window_mm <= 1_000_000
        and site.bounds.width_mm <= 1_000_000
    )


# ---- assumptions


def no_train_is_longer_than_the_line_allows(site: Railway, system: Formation, length_nm: int) -> bool:
    """The operator lets no longer train onto the line (paper 001, 3.3; P4)."""
    return length_nm <= NM_A_MM * site.bounds.line_maximum_mm


def the_range_contains_the_front(site: Railway, system: Formation, front_nm: int, passing: Passing) -> bool:
    """The front is within the range that odometry claims, if it claims one: `range_contains_train` (P7)."""
    return not passing.known or (NM_A_MM * passing.front_least_mm <= front_nm <= NM_A_MM * passing.front_most_mm)


def the_speed_is_no_more_than_told(site: Railway, system: Formation, speed_mm_s: int, passing: Passing) -> bool:
    """The speed at the pass is at most what odometry claims, if it claims anything (P1)."""
    return not passing.known or 0 <= speed_mm_s <= passing.speed_most_mm_s


def within(value: int, bound: int) -> bool:
    """Tell whether a value is no farther from 0 than a bound."""
    return -bound <= value <= bound


def higher(one: int, other: int) -> int:
    """Give the higher of two speeds."""
    return one if one >= other else other


def sampling_is_off_by_one_cycle_at_most(site: Railway, system: Formation, speed_mm_s: int, sampling_nm: int) -> bool:
    """A pass is noted in the cycle in which it happens (paper 001, table 2; P8)."""
    return within(sampling_nm, SAMPLING_MS * UM_A_MM * higher(system.speed_mm_s, speed_mm_s))


def starts_are_off_by_one_cycle_at_most(
    site: Railway, system: Formation, kind: PointKind, speed_mm_s: int, skew_nm: int
) -> bool:
    """Both ends' cycles follow one another at once; tags are read by one unit (paper 001, table 2; P8, T3)."""
    return within(
        skew_nm, 0 if kind == PointKind.TAG else SAMPLING_MS * UM_A_MM * higher(system.speed_mm_s, speed_mm_s)
    )


def averaging_puts_a_pass_off_within_its_bound(
    site: Railway, system: Formation, kind: PointKind, averaging_nm: int
) -> bool:
    """The moving average delays both ends alike, but for what the speed changes in it (P8; ours).

    The paper's 0.78 m is a·t²/2 of 2.5 km/h/s and 1.5 s; tags are not averaged.
    """
    return within(averaging_nm, 0 if kind == PointKind.TAG else AVERAGING_NM)


def a_sensor_sees_the_point_within_its_bound(site: Railway, system: Formation, kind: PointKind, sensor_nm: int) -> bool:
    """Both sensors see the curve within 5 m of one another, both antennas the tag within the window (P8, T16)."""
    return within(sensor_nm, NM_A_MM * site.bounds.window_mm if kind == PointKind.TAG else SENSOR_NM)


def ends_pass_one_point(system: Formation, passing: Passing) -> bool:
    """Tell whether a pass of the tail is of the point that the head has passed last, and later."""
    return (
        system.head_passed
        and passing.kind == system.kind
        and passing.point == system.point
        and passing.time_ms > system.time_ms
    )


def the_way_between_is_the_sensors_distance(
    site: Railway, system: Formation, front_nm: int, off_nm: int, passing: Passing
) -> bool:
    """From one end's pass of a point to the other's the train runs as far as its sensors are apart (P4, T3).

    They are apart as long as the train is, less the last vehicle's length (paper 001, 3.3, formula 3) or both
    overhangs, which are measured in the depot; ``off_nm`` is the sum of the errors.  Nothing is said of passes
    of two points, nor of a tail's pass before the head's.
    """
    beyond_mm = (
        site.bounds.front_overhang_mm + site.bounds.rear_overhang_mm
        if passing.kind == PointKind.TAG
        else site.bounds.last_vehicle_mm
    )
    return (
        not ends_pass_one_point(system, passing)
        or front_nm - system.front_nm == system.length_nm - NM_A_MM * beyond_mm + off_nm
    )


# ---- how well a length can be known


def can_be_compared(site: Railway, system: Formation, passing: Passing) -> bool:
    """Tell whether both ends have passed one point, with the front known well enough, all in range."""
    return (
        ends_pass_one_point(system, passing)
        and system.was_known
        and passing.known
        and system.width_mm <= site.bounds.width_mm
        and passing.front_most_mm - passing.front_least_mm <= site.bounds.width_mm
        and within(system.front_nm, NEAR_NM)
        and within(NM_A_MM * passing.front_least_mm, NEAR_NM)
        and within(NM_A_MM * passing.front_most_mm, NEAR_NM)
        and system.told_mm_s <= FASTEST_MM_S
        and passing.speed_most_mm_s <= FASTEST_MM_S
    )


NEAR_NM = 9_000_000_000_000_000
"""Places of which the line has any: 9,000 km; the machine's numbers end at 10,000 km."""
FASTEST_MM_S = 200_000
"""200 m/s; no train of the line gets there."""


def left_open_nm(site: Railway, system: Formation, passing: Passing) -> int:
    """Give how far apart two lengths can be that one measurement leaves open: the ranges, E(v) twice, rounding."""
    cycle_nm = SAMPLING_MS * UM_A_MM * higher(system.told_mm_s, passing.speed_most_mm_s)
    curve_nm = 2 * cycle_nm + AVERAGING_NM + SENSOR_NM
    error_nm = cycle_nm + NM_A_MM * site.bounds.window_mm if passing.kind == PointKind.TAG else curve_nm
    ranges_mm = system.width_mm + passing.front_most_mm - passing.front_least_mm
    return NM_A_MM * ranges_mm + 2 * (error_nm + ROUNDING_NM)


ROUNDING_NM = 3_000_000
"""Three terms of E(v), each less than a millimetre too much."""


# ---- what happens


def head_passes(site: Railway, system: Formation, front_nm: int, speed_mm_s: int, passing: Passing) -> Formation:
    """The head passes a point, or believes so: any point, at any time told (P4, T3)."""
    if not the_range_contains_the_front(site, system, front_nm, passing):
        return system
    if not the_speed_is_no_more_than_told(site, system, speed_mm_s, passing):
        return system
    return replace(
        system,
        state=machine.note_head_pass(site.bounds, system.state, passing),
        head_passed=True,
        kind=passing.kind,
        point=passing.point,
        time_ms=passing.time_ms,
        front_nm=front_nm,
        speed_mm_s=speed_mm_s,
        was_known=passing.known,
        width_mm=passing.front_most_mm - passing.front_least_mm,
        told_mm_s=passing.speed_most_mm_s,
    )


def tail_passes(
    site: Railway,
    system: Formation,
    front_nm: int,
    speed_mm_s: int,
    sampling_nm: int,
    skew_nm: int,
    averaging_nm: int,
    sensor_nm: int,
    passing: Passing,
) -> Formation:
    """A telegram that the tail has passed a point arrives: late, again, of any point, or never (P4, T3).

    ``front_nm``: where the front was when the tail noted its pass.
    """
    if not the_range_contains_the_front(site, system, front_nm, passing):
        return system
    if not the_speed_is_no_more_than_told(site, system, speed_mm_s, passing):
        return system
    if not sampling_is_off_by_one_cycle_at_most(site, system, speed_mm_s, sampling_nm):
        return system
    if not starts_are_off_by_one_cycle_at_most(site, system, passing.kind, speed_mm_s, skew_nm):
        return system
    if not averaging_puts_a_pass_off_within_its_bound(site, system, passing.kind, averaging_nm):
        return system
    if not a_sensor_sees_the_point_within_its_bound(site, system, passing.kind, sensor_nm):
        return system
    off_nm = sampling_nm + skew_nm + averaging_nm + sensor_nm
    if not the_way_between_is_the_sensors_distance(site, system, front_nm, off_nm, passing):
        return system
    after = replace(
        system,
        state=machine.note_tail_pass(site.bounds, system.state, passing),
        tail_passed=True,
        both_passed=system.both_passed or ends_pass_one_point(system, passing),
    )
    open_nm = left_open_nm(site, system, passing)
    if system.state.measured:
        far = not within(system.length_nm - system.measured_nm, system.open_nm + open_nm)
        return replace(after, differed=system.differed or (far and can_be_compared(site, system, passing)))
    if not after.state.measured:
        return after
    return replace(after, untold=False, measured_nm=system.length_nm, open_nm=open_nm, differed=False)


def change_formation(site: Railway, system: Formation, length_nm: int) -> Formation:
    """Vehicles are coupled or split, and the unit is told (P4, T3)."""
    if not no_train_is_longer_than_the_line_allows(site, system, length_nm):
        return system
    changed = replace(system, length_nm=length_nm, state=machine.note_formation_changed(system.state))
    return begun(site, changed)


def change_formation_untold(site: Railway, system: Formation, length_nm: int) -> Formation:
    """Vehicles are coupled at the rear or set out there, however many, and nobody tells the unit (P4, T3).

    So it is, too, where another antenna than the train's last speaks for the tail: it ends there for its unit.
    """
    return replace(system, length_nm=length_nm, untold=True)


def change_kilometrage(site: Railway, system: Formation) -> Formation:
    """The train changes ends, or is located anew: what was run since a place of before is not told by it (P4)."""
    return replace(system, state=machine.note_kilometrage_changed(system.state), head_passed=False)


def restart(site: Railway, system: Formation) -> Formation:
    """The unit restarts and has forgotten all (P4, T8)."""
    return replace(begun(site, system), state=machine.UNMEASURED)


def begun(site: Railway, system: Formation) -> Formation:
    """Begin the history anew."""
    return replace(
        system,
        head_passed=False,
        tail_passed=False,
        both_passed=False,
        untold=not no_train_is_longer_than_the_line_allows(site, system, system.length_nm),
        measured_nm=system.length_nm,
        open_nm=0,
        differed=False,
    )
