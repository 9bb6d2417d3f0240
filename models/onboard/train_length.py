"""A train of some length, its ends passing points, and the machine that measures it (P4, T3, P8).

Places and ways are in µm, since mm/s times ms is µm: nothing is divided, so nothing is rounded.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

from kernel.onboard import train_length as machine
from kernel.onboard.arithmetic import CYCLE_MS, larger, magnitude
from kernel.onboard.train_length import Length, LengthBounds, Passing, PointKind

UM_A_MM = 1_000


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
    was at ``front_um`` and the train ran ``speed_mm_s``.
    ``tail_passed``: the tail has passed some point.  ``both_passed``: one that the head had passed last.
    """

    length_um: int
    state: Length
    head_passed: bool
    kind: PointKind
    point: int
    time_ms: int
    front_um: int
    speed_mm_s: int
    tail_passed: bool
    both_passed: bool


# ---- premises


def bounds_are_not_negative(site: Railway) -> bool:
    """No measure of a vehicle is below zero (P4)."""
    return site.bounds.last_vehicle_mm >= 0 and site.bounds.front_overhang_mm >= 0 and site.bounds.rear_overhang_mm >= 0


def vehicles_are_of_this_world(site: Railway) -> bool:
    """Each measure and bound is at most a kilometre (P4)."""
    return (
        site.bounds.last_vehicle_mm <= machine.GREATEST_MEASURE_MM
        and site.bounds.averaging_mm <= machine.GREATEST_MEASURE_MM
        and site.bounds.sensor_mm <= machine.GREATEST_MEASURE_MM
        and site.bounds.front_overhang_mm <= machine.GREATEST_MEASURE_MM
        and site.bounds.rear_overhang_mm <= machine.GREATEST_MEASURE_MM
        and site.bounds.window_mm <= machine.GREATEST_MEASURE_MM
    )


# ---- assumptions


def no_train_is_longer_than_the_line_allows(site: Railway, system: Formation, length_um: int) -> bool:
    """The operator lets no longer train onto the line (paper 001, 3.3; P4)."""
    return length_um <= UM_A_MM * site.bounds.line_maximum_mm


def the_range_contains_the_front(site: Railway, system: Formation, front_um: int, passing: Passing) -> bool:
    """The front is within the range that odometry gave: what it claims itself, `range_contains_train` (P7)."""
    return UM_A_MM * passing.front_least_mm <= front_um <= UM_A_MM * passing.front_most_mm


def the_front_was_not_beyond_the_range(site: Railway, system: Formation, front_um: int, passing: Passing) -> bool:
    """The front, when the tail noted its pass, was not beyond the range of then or of a later moment (P4, P7)."""
    return front_um <= UM_A_MM * passing.front_most_mm


def the_speed_is_no_more_than_told(site: Railway, system: Formation, speed_mm_s: int, passing: Passing) -> bool:
    """The speed at the pass is at most what odometry gave (P1)."""
    return 0 <= speed_mm_s <= passing.speed_most_mm_s


def cycle_way_um(system: Formation, speed_mm_s: int) -> int:
    """Give the way of one cycle, at the higher of the speeds at both passes."""
    return CYCLE_MS * larger(system.speed_mm_s, speed_mm_s)


def sampling_is_off_by_one_cycle_at_most(site: Railway, system: Formation, speed_mm_s: int, sampling_um: int) -> bool:
    """A pass is noted in the cycle in which it happens (paper 001, table 2; P8)."""
    return magnitude(sampling_um) <= cycle_way_um(system, speed_mm_s)


def starts_are_off_by_one_cycle_at_most(
    site: Railway, system: Formation, kind: PointKind, speed_mm_s: int, skew_um: int
) -> bool:
    """Both ends' cycles follow one another at once; tags are read by one unit (paper 001, table 2; P8, T3)."""
    return magnitude(skew_um) <= (0 if kind == PointKind.TAG else cycle_way_um(system, speed_mm_s))


def averaging_puts_a_pass_off_within_its_bound(
    site: Railway, system: Formation, kind: PointKind, averaging_um: int
) -> bool:
    """The moving average delays both ends alike, but for what the speed changes in it (P8; ours).

    The paper's 0.78 m is a·t²/2 of 2.5 km/h/s and 1.5 s; tags are not averaged.
    """
    return magnitude(averaging_um) <= (0 if kind == PointKind.TAG else UM_A_MM * site.bounds.averaging_mm)


def a_sensor_sees_the_point_within_its_bound(site: Railway, system: Formation, kind: PointKind, sensor_um: int) -> bool:
    """Both sensors see the curve within 5 m of one another, both antennas the tag within the window (P8, T16)."""
    bound_mm = site.bounds.window_mm if kind == PointKind.TAG else site.bounds.sensor_mm
    return magnitude(sensor_um) <= UM_A_MM * bound_mm


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

    They are apart as long as the train is, less the last vehicle's length or both overhangs, which are
    measured in the depot; ``off_um`` is the sum of the errors.  Nothing is said of passes of two points,
    nor of a tail's pass before the head's.
    """
    apart_um = system.length_um - UM_A_MM * machine.beyond_the_sensors_mm(site.bounds, passing.kind)
    return not ends_pass_one_point(system, passing) or front_um - system.front_um == apart_um + off_um


# ---- what happens


def head_passes(site: Railway, system: Formation, front_um: int, speed_mm_s: int, passing: Passing) -> Formation:
    """The head passes a point, or believes so: any point, at any time told (P4, T3)."""
    if not the_range_contains_the_front(site, system, front_um, passing):
        return system
    if not the_speed_is_no_more_than_told(site, system, speed_mm_s, passing):
        return system
    return replace(
        system,
        state=machine.note_head_pass(system.state, passing),
        head_passed=True,
        kind=passing.kind,
        point=passing.point,
        time_ms=passing.time_ms,
        front_um=front_um,
        speed_mm_s=speed_mm_s,
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
    if not the_front_was_not_beyond_the_range(site, system, front_um, passing):
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
    return replace(
        system,
        state=machine.note_tail_pass(site.bounds, system.state, passing),
        tail_passed=True,
        both_passed=system.both_passed or ends_pass_one_point(system, passing),
    )


def change_formation(site: Railway, system: Formation, length_um: int) -> Formation:
    """Vehicles are coupled or split, and the unit is told (P4, T3)."""
    if not no_train_is_longer_than_the_line_allows(site, system, length_um):
        return system
    return replace(
        system,
        length_um=length_um,
        state=machine.note_formation_changed(system.state),
        head_passed=False,
        tail_passed=False,
        both_passed=False,
    )


def restart(site: Railway, system: Formation) -> Formation:
    """The unit restarts and has forgotten all (P4, T8)."""
    return replace(system, state=machine.UNMEASURED, head_passed=False, tail_passed=False, both_passed=False)
