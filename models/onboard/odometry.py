"""A train on its line, the wheel that its tachometer counts, and the odometry that reckons with it (P1, P7).

Ways are in nm and speeds in µm/s, since mm/s² times ms is µm/s, and µm/s times ms is nm: nothing is
divided, so nothing is rounded.  Every real motion lies within one nm of such a one.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

from kernel.onboard import odometry
from kernel.onboard.arithmetic import CYCLE_MS, NM_A_MM, larger, magnitude, smaller
from kernel.onboard.odometry import Motion, Readings, SensorBounds


@dataclass(frozen=True)
class Line:
    """What does not change while a train runs (P1, P4).

    ``bounds``: as written, and as the unit reckons with.
    ``jolt_mm_s2``: by how much the wheel's acceleration differs when it leaves its creep.
    ``length_mm``: the train's true length; ``length_used_mm``: what its unit reckons with.
    """

    bounds: SensorBounds
    jolt_mm_s2: int
    length_mm: int
    length_used_mm: int


@dataclass(frozen=True)
class Running:
    """One moment of a train.

    ``front_nm``, ``speed_um_s``: where its front is, on the line's kilometrage, and how fast.
    ``slipped``: whether the wheel has slipped or slid since the anchor.
    ``anchor_nm``: history: where the front was at the anchor.
    ``motion``: what the unit's odometry knows.
    """

    front_nm: int
    speed_um_s: int
    slipped: bool
    anchor_nm: int
    motion: Motion


# ---- premises


def bounds_are_not_negative(site: Line) -> bool:
    """No bound is below zero; trust takes one cycle of agreement at least (P1)."""
    return (
        site.bounds.scale_ppm >= 0
        and site.bounds.pulse_mm >= 0
        and site.bounds.tachometer_mm_s >= 0
        and site.bounds.gradient_mm_s2 >= 0
        and site.bounds.agreement_cycles >= 1
    )


def a_jolt_stands_out(site: Line) -> bool:
    """Leaving the creep is more than threshold, sensor error and both gradients can hide: T_a is set by it (P1)."""
    return site.jolt_mm_s2 >= site.bounds.slip_mm_s2 + site.bounds.inertial_mm_s2 + 2 * site.bounds.gradient_mm_s2


def the_length_used_is_no_less(site: Line) -> bool:
    """The length that the unit reckons with is at least the true one: `length_never_underestimated` (P4)."""
    return site.length_used_mm >= site.length_mm


# ---- assumptions


def the_way_follows_the_speed(system: Running, to_nm: int, speed_um_s: int) -> bool:
    """Within one cycle the train runs forward, at speeds between those at its ends (P1).

    The jerk of a train is small enough that its acceleration does not change sign twice in 100 ms.
    """
    return (
        speed_um_s >= 0
        and CYCLE_MS * smaller(system.speed_um_s, speed_um_s) <= to_nm - system.front_nm
        and to_nm - system.front_nm <= CYCLE_MS * larger(system.speed_um_s, speed_um_s)
    )


def the_train_stays_within_its_powers(site: Line, system: Running, speed_um_s: int) -> bool:
    """It gains and loses no more speed than motors, brakes and the steepest gradient allow (P1)."""
    return (
        -CYCLE_MS * site.bounds.brakes_mm_s2
        <= speed_um_s - system.speed_um_s
        <= CYCLE_MS * site.bounds.accelerates_mm_s2
    )


def the_inertial_sensor_keeps_its_bound(
    site: Line, system: Running, readings: Readings, speed_um_s: int, gradient_mm_s2: int
) -> bool:
    """A valid reading is acceleration and gravity along the track, within the error; the line is no steeper (P1)."""
    gained_um_s = speed_um_s - system.speed_um_s
    return magnitude(gradient_mm_s2) <= site.bounds.gradient_mm_s2 and (
        not odometry.inertial_speaks(site.bounds, readings)
        or magnitude(CYCLE_MS * (readings.inertial_mm_s2 - gradient_mm_s2) - gained_um_s)
        <= CYCLE_MS * site.bounds.inertial_mm_s2
    )


def a_rolling_wheel_measures(
    site: Line, system: Running, readings: Readings, to_nm: int, speed_um_s: int, slips: bool
) -> bool:
    """A wheel that has not slipped since the anchor shows speed and way within creep, diameter and a pulse (P1).

    Nothing is asked of a wheel that is not trusted: its pulses may have been lost, or be too many.
    """
    speed_error = odometry.speed_error_mm_s(site.bounds, readings.tachometer_mm_s)
    since_mm = readings.way_mm - system.motion.anchor_way_mm
    way_error = odometry.way_error_mm(site.bounds, since_mm)
    return (
        slips
        or system.slipped
        or not system.motion.trusted
        or not odometry.tachometer_speaks(system.motion, readings)
        or (
            magnitude(1000 * readings.tachometer_mm_s - speed_um_s) <= 1000 * speed_error
            and magnitude(to_nm - system.anchor_nm - NM_A_MM * since_mm) <= NM_A_MM * way_error
        )
    )


def leaving_the_creep_takes_a_jolt(
    site: Line, system: Running, readings: Readings, speed_um_s: int, slips: bool
) -> bool:
    """A wheel that begins to slip or slide changes its speed otherwise than the train, by the jolt at least (P1).

    Beyond the creep of a rolling wheel adhesion falls with slip, so that the wheel runs away.
    """
    gained_um_s = speed_um_s - system.speed_um_s
    wheel_um_s = 1000 * (readings.tachometer_mm_s - system.motion.tachometer_mm_s)
    return (
        not slips
        or not system.motion.trusted
        or not odometry.tachometer_speaks(system.motion, readings)
        or magnitude(wheel_um_s - gained_um_s) >= CYCLE_MS * site.jolt_mm_s2
    )


def a_wheel_that_agrees_rolls(system: Running, after: Motion, slips: bool) -> bool:
    """A wheel that has agreed in acceleration long enough, at a speed the train may have, rolls again (P1).

    A sliding wheel is braked harder than the train, or locked: it cannot keep pace with it for long.
    """
    return not slips or system.motion.trusted or not after.trusted


def a_fix_contains_the_front(system: Running, least_mm: int, most_mm: int) -> bool:
    """Tags lie and features are where they are registered, within the error that the fix is given with (P3, T5)."""
    return NM_A_MM * least_mm <= system.front_nm <= NM_A_MM * most_mm


# ---- transitions


def run_a_cycle(
    site: Line, system: Running, readings: Readings, to_nm: int, speed_um_s: int, gradient_mm_s2: int, slips: bool
) -> Running:
    """The train runs on for a cycle, on whatever gradient, with whatever adhesion; the sensors say what they say (P1).

    A sensor may fall silent, stick, or give anything while it is not valid or the wheel slips.
    """
    if not the_way_follows_the_speed(system, to_nm, speed_um_s):
        return system
    if not the_train_stays_within_its_powers(site, system, speed_um_s):
        return system
    if not the_inertial_sensor_keeps_its_bound(site, system, readings, speed_um_s, gradient_mm_s2):
        return system
    if not a_rolling_wheel_measures(site, system, readings, to_nm, speed_um_s, slips):
        return system
    if not leaving_the_creep_takes_a_jolt(site, system, readings, speed_um_s, slips):
        return system
    after = odometry.note_cycle(site.bounds, system.motion, readings)
    if not a_wheel_that_agrees_rolls(system, after, slips):
        return system
    return Running(
        front_nm=to_nm,
        speed_um_s=speed_um_s,
        slipped=slips or (system.slipped and system.motion.trusted),
        anchor_nm=system.anchor_nm if system.motion.trusted and after.trusted else to_nm,
        motion=after,
    )


def take_fix(site: Line, system: Running, least_mm: int, most_mm: int) -> Running:
    """A tag or a feature says where the front is (P3, T2)."""
    if not a_fix_contains_the_front(system, least_mm, most_mm):
        return system
    return replace(system, anchor_nm=system.front_nm, motion=odometry.note_fix(system.motion, least_mm, most_mm))
