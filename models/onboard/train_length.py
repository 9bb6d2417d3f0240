"""A train of some length, its ends passing points, and the machine that measures it (P4, T3, P8).

Places and ways are in µm, since mm/s times ms is µm: nothing is divided, so nothing is rounded.  Errors are
the paper's, or as measured of the train and written; none is the machine's.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

from kernel.onboard import train_length as machine
from kernel.onboard.train_length import Length, LengthBounds, Passing, PointKind

UM_A_MM = 1_000
SAMPLING_MS = 100
"""Paper 001, table 2: sampled every 100 ms; at 130 km/h a train runs 3.61 m in that time."""
AVERAGING_UM = 781_250
"""2.5 km/h/s · (1.5 s)² / 2, what the speed changes in the average; paper 001, table 2, says 0.78 m."""
SENSOR_UM = 5_000_000
"""Paper 001, table 2."""


@dataclass(frozen=True)
class Railway:
    """What does not change: the bounds as written (P4)."""

    bounds: LengthBounds


@dataclass(frozen=True)
class Formation:
    """One moment of a train.

    ``length_um``: how long it is.
    ``state``: what the machine knows.
    The rest is history of this formation and of this life of its unit.
    ``head_passed``: the head has passed a point: ``kind``, ``point``, noted for ``time_ms``, when the front
    was at ``front_um`` and the train ran ``speed_mm_s``; odometry claimed (``was_known``) a range ``width_mm`` wide,
    and at most ``told_mm_s``.
    ``tail_passed``: the tail has passed some point.  ``both_passed``: one that the head had passed last.
    ``untold``: since the length in use was measured, vehicles were coupled or set out, and the unit was not told.
    ``measured_um``: how long the train was when that length was measured, which the errors of that measurement
    leave open by ``open_um``.
    ``differed``: measured again, it was longer or shorter than that, by more than both measurements leave open.
    """

    length_um: int
    state: Length
    head_passed: bool
    kind: PointKind
    point: int
    time_ms: int
    front_um: int
    speed_mm_s: int
    was_known: bool
    width_mm: int
    told_mm_s: int
    tail_passed: bool
    both_passed: bool
    untold: bool
    measured_um: int
    open_um: int
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


def no_train_is_longer_than_the_line_allows(site: Railway, system: Formation, length_um: int) -> bool:
    """The operator lets no longer train onto the line (paper 001, 3.3; P4)."""
    return length_um <= UM_A_MM * site.bounds.line_maximum_mm


def the_range_contains_the_front(site: Railway, system: Formation, front_um: int, passing: Passing) -> bool:
    """The front is within the range that odometry claims, if it claims one: `range_contains_train` (P7)."""
    return not passing.known or (UM_A_MM * passing.front_least_mm <= front_um <= UM_A_MM * passing.front_most_mm)


def the_speed_is_no_more_than_told(site: Railway, system: Formation, speed_mm_s: int, passing: Passing) -> bool:
    """The speed at the pass is at most what odometry claims, if it claims anything (P1)."""
    return not passing.known or 0 <= speed_mm_s <= passing.speed_most_mm_s


def within(value: int, bound: int) -> bool:
    """Tell whether a value is no farther from 0 than a bound."""
    return -bound <= value <= bound


def higher(one: int, other: int) -> int:
    """Give the higher of two speeds."""
    return one if one >= other else other


def sampling_is_off_by_one_cycle_at_most(site: Railway, system: Formation, speed_mm_s: int, sampling_um: int) -> bool:
    """A pass is noted in the cycle in which it happens (paper 001, table 2; P8)."""
    return within(sampling_um, SAMPLING_MS * higher(system.speed_mm_s, speed_mm_s))


def starts_are_off_by_one_cycle_at_most(
    site: Railway, system: Formation, kind: PointKind, speed_mm_s: int, skew_um: int
) -> bool:
    """Both ends' cycles follow one another at once; tags are read by one unit (paper 001, table 2; P8, T3)."""
    return within(skew_um, 0 if kind == PointKind.TAG else SAMPLING_MS * higher(system.speed_mm_s, speed_mm_s))


def averaging_puts_a_pass_off_within_its_bound(
    site: Railway, system: Formation, kind: PointKind, averaging_um: int
) -> bool:
    """The moving average delays both ends alike, but for what the speed changes in it (P8; ours).

    The paper's 0.78 m is a·t²/2 of 2.5 km/h/s and 1.5 s; tags are not averaged.
    """
    return within(averaging_um, 0 if kind == PointKind.TAG else AVERAGING_UM)


def a_sensor_sees_the_point_within_its_bound(site: Railway, system: Formation, kind: PointKind, sensor_um: int) -> bool:
    """Both sensors see the curve within 5 m of one another, both antennas the tag within the window (P8, T16)."""
    return within(sensor_um, UM_A_MM * site.bounds.window_mm if kind == PointKind.TAG else SENSOR_UM)


def ends_pass_one_point(system: Formation, passing: Passing) -> bool:
    """Tell whether a pass of the tail is of the point that the head has passed last, and later."""
    return (
        system.head_passed
        and passing.kind == system.kind
        and passing.point == system.point
        and passing.time_ms > system.time_ms
    )


def the_way_between_is_the_sensors_distance(
    site: Railway, system: Formation, front_um: int, off_um: int, passing: Passing
) -> bool:
    """From one end's pass of a point to the other's the train runs as far as its sensors are apart (P4, T3).

    They are apart as long as the train is, less the last vehicle's length (paper 001, 3.3, formula 3) or both
    overhangs, which are measured in the depot; ``off_um`` is the sum of the errors.  Nothing is said of passes
    of two points, nor of a tail's pass before the head's.
    """
    beyond_mm = (
        site.bounds.front_overhang_mm + site.bounds.rear_overhang_mm
        if passing.kind == PointKind.TAG
        else site.bounds.last_vehicle_mm
    )
    return (
        not ends_pass_one_point(system, passing)
        or front_um - system.front_um == system.length_um - UM_A_MM * beyond_mm + off_um
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
        and within(system.front_um, NEAR_UM)
        and within(UM_A_MM * passing.front_least_mm, NEAR_UM)
        and within(UM_A_MM * passing.front_most_mm, NEAR_UM)
        and system.told_mm_s <= FASTEST_MM_S
        and passing.speed_most_mm_s <= FASTEST_MM_S
    )


NEAR_UM = 9_000_000_000_000
"""Places of which the line has any: 9,000 km; the machine's numbers end at 10,000 km."""
FASTEST_MM_S = 200_000
"""200 m/s; no train of the line gets there."""


def left_open_um(site: Railway, system: Formation, passing: Passing) -> int:
    """Give how far apart two lengths can be that one measurement leaves open: the ranges, E(v) twice, rounding."""
    cycle_um = SAMPLING_MS * higher(system.told_mm_s, passing.speed_most_mm_s)
    curve_um = 2 * cycle_um + AVERAGING_UM + SENSOR_UM
    error_um = cycle_um + UM_A_MM * site.bounds.window_mm if passing.kind == PointKind.TAG else curve_um
    ranges_mm = system.width_mm + passing.front_most_mm - passing.front_least_mm
    return UM_A_MM * ranges_mm + 2 * (error_um + ROUNDING_UM)


ROUNDING_UM = 3_000
"""Three terms of E(v), each less than a millimetre too much."""


# ---- what happens


def head_passes(site: Railway, system: Formation, front_um: int, speed_mm_s: int, passing: Passing) -> Formation:
    """The head passes a point, or believes so: any point, at any time told (P4, T3)."""
    if not the_range_contains_the_front(site, system, front_um, passing):
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
        front_um=front_um,
        speed_mm_s=speed_mm_s,
        was_known=passing.known,
        width_mm=passing.front_most_mm - passing.front_least_mm,
        told_mm_s=passing.speed_most_mm_s,
    )


def tail_passes(
    site: Railway,
    system: Formation,
    front_um: int,
    speed_mm_s: int,
    sampling_um: int,
    skew_um: int,
    averaging_um: int,
    sensor_um: int,
    passing: Passing,
) -> Formation:
    """A telegram that the tail has passed a point arrives: late, again, of any point, or never (P4, T3).

    ``front_um``: where the front was when the tail noted its pass.
    """
    if not the_range_contains_the_front(site, system, front_um, passing):
        return system
    if not the_speed_is_no_more_than_told(site, system, speed_mm_s, passing):
        return system
    if not sampling_is_off_by_one_cycle_at_most(site, system, speed_mm_s, sampling_um):
        return system
    if not starts_are_off_by_one_cycle_at_most(site, system, passing.kind, speed_mm_s, skew_um):
        return system
    if not averaging_puts_a_pass_off_within_its_bound(site, system, passing.kind, averaging_um):
        return system
    if not a_sensor_sees_the_point_within_its_bound(site, system, passing.kind, sensor_um):
        return system
    off_um = sampling_um + skew_um + averaging_um + sensor_um
    if not the_way_between_is_the_sensors_distance(site, system, front_um, off_um, passing):
        return system
    after = replace(
        system,
        state=machine.note_tail_pass(site.bounds, system.state, passing),
        tail_passed=True,
        both_passed=system.both_passed or ends_pass_one_point(system, passing),
    )
    open_um = left_open_um(site, system, passing)
    if system.state.measured:
        far = not within(system.length_um - system.measured_um, system.open_um + open_um)
        return replace(after, differed=system.differed or (far and can_be_compared(site, system, passing)))
    if not after.state.measured:
        return after
    return replace(after, untold=False, measured_um=system.length_um, open_um=open_um, differed=False)


def change_formation(site: Railway, system: Formation, length_um: int) -> Formation:
    """Vehicles are coupled or split, and the unit is told (P4, T3)."""
    if not no_train_is_longer_than_the_line_allows(site, system, length_um):
        return system
    return replace(begun(system), length_um=length_um, state=machine.note_formation_changed(system.state))


def change_formation_untold(site: Railway, system: Formation, length_um: int) -> Formation:
    """Vehicles are coupled at the rear or set out there, and nobody tells the unit: a fault of staff (P4, T3)."""
    if not no_train_is_longer_than_the_line_allows(site, system, length_um):
        return system
    return replace(system, length_um=length_um, untold=True)


def change_kilometrage(site: Railway, system: Formation) -> Formation:
    """The train changes ends, or is located anew: what was run since a place of before is not told by it (P4)."""
    return replace(system, state=machine.note_kilometrage_changed(system.state), head_passed=False)


def restart(site: Railway, system: Formation) -> Formation:
    """The unit restarts and has forgotten all (P4, T8)."""
    return replace(begun(system), state=machine.UNMEASURED)


def begun(system: Formation) -> Formation:
    """Begin the history anew."""
    return replace(
        system,
        head_passed=False,
        tail_passed=False,
        both_passed=False,
        untold=False,
        measured_um=system.length_um,
        open_um=0,
        differed=False,
    )
