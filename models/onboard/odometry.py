"""A train on its line, the wheel that its tachometer counts, and the odometry that reckons with it (P1, P7).

Ways are in nm and speeds in µm/s, since mm/s² times ms is µm/s, and µm/s times ms is nm: nothing is
divided, so nothing is rounded.  Every real motion lies within one nm of such a one.

What nature does is said of motion, wheel and raw readings, by declared bounds; whether the unit trusts the
wheel, or takes a reading at all, is its own affair.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

from kernel.onboard import odometry
from kernel.onboard.odometry import Motion, Readings, SensorBounds
from models.onboard.units import (
    LONGEST_MS,
    MS_A_CYCLE,
    NM_A_MM,
    NO_SPEED_MM_S,
    PPM,
    SHORTEST_MS,
    larger,
    magnitude,
    smaller,
)


@dataclass(frozen=True)
class Line:
    """What does not change while a train runs (P1, P4).

    ``bounds``: as written, and as the unit reckons with.
    ``jolt_mm_s2``: by how much the wheel's acceleration differs when it leaves its creep.
    ``pace_cycles``: a wheel that slips does not keep pace with its train for so many cycles.
    ``length_mm``: the train's true length; ``length_used_mm``: what its unit reckons with.
    """

    bounds: SensorBounds
    jolt_mm_s2: int
    pace_cycles: int
    length_mm: int
    length_used_mm: int


@dataclass(frozen=True)
class Running:
    """One moment of a train.

    ``front_nm``, ``speed_um_s``: where its front is, on the line's kilometrage, and how fast; below 0: backward.
    ``slips``: the wheel slips or slides.  ``told``: the tachometer gave a number that was not stuck or gross.
    ``shown_mm_s``, ``shown_way_mm``: what it showed last, valid or not.
    ``paced_cycles``: for how many cycles on end the wheel has kept pace with the train.
    ``anchor_nm``, ``anchor_way_mm``: history: where the front was, and what the pulses were, at the anchor.
    ``counted``: history: the wheel rolled and the tachometer told of it, at the anchor and ever since.
    ``contradicted``: history: since it was located a fix came that lay outside the range.
    ``false_by_nm``: history: of the other fixes since, each missed the front by no more.
    ``motion``: what the unit's odometry knows.
    """

    front_nm: int
    speed_um_s: int
    slips: bool
    told: bool
    shown_mm_s: int
    shown_way_mm: int
    paced_cycles: int
    anchor_nm: int
    anchor_way_mm: int
    counted: bool
    contradicted: bool
    false_by_nm: int
    motion: Motion


# ---- premises


def bounds_are_not_negative(site: Line) -> bool:
    """No bound is below zero (P1)."""
    return (
        site.bounds.scale_ppm >= 0
        and site.bounds.pulse_mm >= 0
        and site.bounds.tachometer_mm_s >= 0
        and site.bounds.gradient_mm_s2 >= 0
    )


def a_jolt_stands_out(site: Line) -> bool:
    """Leaving the creep is more than threshold, sensor error and both gradients can hide: T_a is set by it (P1).

    Even in the shortest cycle, where what it is held against may have lasted for the longest.
    """
    hidden_mm_s2 = site.bounds.inertial_mm_s2 + 2 * site.bounds.gradient_mm_s2
    return (
        site.bounds.slip_mm_s2 >= 0
        and site.bounds.inertial_mm_s2 >= 0
        and SHORTEST_MS * (site.jolt_mm_s2 - site.bounds.slip_mm_s2) >= LONGEST_MS * hidden_mm_s2
    )


def agreement_takes_longer_than_a_chance_pace(site: Line) -> bool:
    """Trust takes two cycles more, the first of which may compare with what was read before a silence (P1)."""
    return site.pace_cycles >= 1 and site.bounds.agreement_cycles >= site.pace_cycles + 2


def the_length_used_is_no_less(site: Line) -> bool:
    """The length that the unit reckons with is at least the true one: `length_never_underestimated` (P4)."""
    return site.length_used_mm >= site.length_mm


# ---- assumptions


def is_lawful(readings: Readings) -> bool:
    """The cycle lasted as long as is declared, for all that the processor's clock tells of it in whole ms (P1)."""
    return SHORTEST_MS <= readings.elapsed_ms <= LONGEST_MS


def least_in_a_lawful_cycle(rate: int) -> int:
    """What a rate comes to in a lawful cycle at the least: how long it lasted to the µs nobody tells (P1)."""
    return smaller(SHORTEST_MS * rate, LONGEST_MS * rate)


def most_in_a_lawful_cycle(rate: int) -> int:
    """What it comes to at the most (P1)."""
    return larger(SHORTEST_MS * rate, LONGEST_MS * rate)


def the_way_follows_the_speed(system: Running, readings: Readings, to_nm: int, speed_um_s: int) -> bool:
    """Within a lawful cycle the train runs at speeds between those at its ends; in another one anywhere (P1).

    The jerk of a train is small enough that its acceleration does not change sign twice in 100 ms.
    """
    return not is_lawful(readings) or (
        least_in_a_lawful_cycle(smaller(system.speed_um_s, speed_um_s)) <= to_nm - system.front_nm
        and to_nm - system.front_nm <= most_in_a_lawful_cycle(larger(system.speed_um_s, speed_um_s))
    )


def the_train_stays_within_its_powers(site: Line, system: Running, readings: Readings, speed_um_s: int) -> bool:
    """In a cycle it gains and loses no more speed than motors, brakes and the steepest gradient allow (P1).

    Rolling back it may be slowed by its brakes, which then act forward.
    """
    gained_um_s = speed_um_s - system.speed_um_s
    forward = site.bounds.accelerates_mm_s2
    most_mm_s2 = larger(forward, site.bounds.brakes_mm_s2) if system.speed_um_s < 0 else forward
    return not is_lawful(readings) or (
        least_in_a_lawful_cycle(-site.bounds.brakes_mm_s2) <= gained_um_s <= most_in_a_lawful_cycle(most_mm_s2)
    )


def the_inertial_sensor_keeps_its_bound(
    site: Line, system: Running, readings: Readings, speed_um_s: int, gradient_mm_s2: int
) -> bool:
    """A valid reading is acceleration and gravity along the track, within the error; the line is no steeper (P1).

    A gross one is neither: one that no motion of the train on its line could give.
    """
    gained_um_s = speed_um_s - system.speed_um_s
    beside_mm_s2 = site.bounds.gradient_mm_s2 + site.bounds.inertial_mm_s2
    felt_mm_s2 = readings.inertial_mm_s2 - gradient_mm_s2
    return magnitude(gradient_mm_s2) <= site.bounds.gradient_mm_s2 and (
        not is_lawful(readings)
        or not readings.inertial_valid
        or readings.inertial_mm_s2 > site.bounds.accelerates_mm_s2 + beside_mm_s2
        or readings.inertial_mm_s2 < -site.bounds.brakes_mm_s2 - beside_mm_s2
        or (
            least_in_a_lawful_cycle(felt_mm_s2 - site.bounds.inertial_mm_s2) <= gained_um_s
            and gained_um_s <= most_in_a_lawful_cycle(felt_mm_s2 + site.bounds.inertial_mm_s2)
        )
    )


def a_tachometer_sticks_at_a_speed(site: Line, system: Running, readings: Readings, sticks: bool) -> bool:
    """One that fails and calls itself valid repeats speed and pulses of the cycle before (P1).

    None fails at rest, or so slow that a cycle may pass without a pulse.
    """
    return not sticks or (
        MS_A_CYCLE * magnitude(readings.tachometer_mm_s) > 1000 * site.bounds.pulse_mm
        and readings.tachometer_mm_s == system.shown_mm_s
        and readings.way_mm == system.shown_way_mm
    )


def a_rolling_wheel_measures(
    site: Line, system: Running, readings: Readings, to_nm: int, speed_um_s: int, measures: bool
) -> bool:
    """Of a wheel that rolls, valid readings show speed and way within creep, diameter and a pulse (P1).

    The way between any two moments, if the wheel has rolled and been read all the time; asked of the
    one since the anchor.
    """
    since_mm = readings.way_mm - system.anchor_way_mm
    return not measures or (
        PPM * magnitude(1000 * readings.tachometer_mm_s - speed_um_s)
        <= 1000 * (site.bounds.scale_ppm * magnitude(readings.tachometer_mm_s) + PPM * site.bounds.tachometer_mm_s)
        and (
            not system.counted
            or PPM * magnitude(to_nm - system.anchor_nm - NM_A_MM * since_mm)
            <= NM_A_MM * (site.bounds.scale_ppm * magnitude(since_mm) + PPM * site.bounds.pulse_mm)
        )
    )


def leaving_the_creep_takes_a_jolt(
    site: Line, system: Running, readings: Readings, speed_um_s: int, slips: bool, told: bool
) -> bool:
    """A wheel that begins to slip or slide changes its speed otherwise than the train, by the jolt at least (P1).

    Beyond the creep of a rolling wheel adhesion falls with slip, so that the wheel runs away.
    """
    gained_um_s = speed_um_s - system.speed_um_s
    wheel_um_s = 1000 * (readings.tachometer_mm_s - system.shown_mm_s)
    return (
        not slips
        or system.slips
        or not (told and system.told)
        or magnitude(wheel_um_s - gained_um_s) >= least_in_a_lawful_cycle(site.jolt_mm_s2)
    )


def a_wheel_that_keeps_pace_rolls(site: Line, paced_cycles: int, slips: bool) -> bool:
    """A wheel that has kept pace with its train for the written number of cycles on end does not slip (P1).

    A sliding wheel is braked harder than the train, or locked; a spinning one is driven harder.
    """
    return not slips or paced_cycles < site.pace_cycles


def the_train_stands_where_it_is_said_to(system: Running, least_mm: int, most_mm: int) -> bool:
    """Who locates a train anew sees it stand, and its front within what he says (P7, T8)."""
    return system.speed_um_s == 0 and NM_A_MM * least_mm <= system.front_nm <= NM_A_MM * most_mm


# ---- what nature does of itself


def lies_outside(system: Running, least_mm: int, most_mm: int) -> bool:
    """A fix and the range that the unit shows have no place in common (P7)."""
    return most_mm < system.motion.front_least_mm or system.motion.front_most_mm < least_mm


def missed_by_nm(system: Running, least_mm: int, most_mm: int) -> int:
    """Give how far the front is from what a fix says, with the error that it is given with; 0 or less if true (T5)."""
    return larger(NM_A_MM * least_mm - system.front_nm, system.front_nm - NM_A_MM * most_mm)


def is_told(system: Running, readings: Readings, sticks: bool) -> bool:
    """The tachometer gives a number that is not invalid, stuck or gross (P1)."""
    return (
        readings.tachometer_valid
        and not sticks
        and magnitude(readings.tachometer_mm_s) <= NO_SPEED_MM_S
        and 1000 * magnitude(readings.way_mm - system.shown_way_mm) <= MS_A_CYCLE * NO_SPEED_MM_S
    )


def paced_cycles_after(site: Line, system: Running, readings: Readings, speed_um_s: int, told: bool) -> int:
    """For how many cycles on end the wheel has now kept pace: nearly as fast, and gaining as much (P1).

    One that stands keeps pace with a slow train alone: a locked wheel may stand for long under a fast one.
    """
    gained_um_s = speed_um_s - system.speed_um_s
    wheel_um_s = 1000 * (readings.tachometer_mm_s - system.shown_mm_s)
    keeps_pace = (
        told
        and system.told
        and magnitude(wheel_um_s - gained_um_s) < least_in_a_lawful_cycle(site.jolt_mm_s2)
        and magnitude(1000 * readings.tachometer_mm_s - speed_um_s) <= 1000 * site.bounds.pace_mm_s
        and (readings.tachometer_mm_s != 0 or magnitude(speed_um_s) <= 1000 * site.bounds.locked_mm_s)
    )
    return system.paced_cycles + 1 if keeps_pace else 0


# ---- transitions


def run_a_cycle(
    site: Line,
    system: Running,
    readings: Readings,
    to_nm: int,
    speed_um_s: int,
    gradient_mm_s2: int,
    slips: bool,
    sticks: bool,
) -> Running:
    """The train runs on or rolls back for a cycle, on whatever gradient, with whatever adhesion (P1).

    The sensors say what they say: one may fall silent, stick, or give anything while it is not valid or the
    wheel slips.
    """
    told = is_told(system, readings, sticks)
    paced_cycles = paced_cycles_after(site, system, readings, speed_um_s, told)
    if not the_way_follows_the_speed(system, readings, to_nm, speed_um_s):
        return system
    if not the_train_stays_within_its_powers(site, system, readings, speed_um_s):
        return system
    if not the_inertial_sensor_keeps_its_bound(site, system, readings, speed_um_s, gradient_mm_s2):
        return system
    if not a_tachometer_sticks_at_a_speed(site, system, readings, sticks):
        return system
    if not a_rolling_wheel_measures(site, system, readings, to_nm, speed_um_s, told and not slips):
        return system
    if not leaving_the_creep_takes_a_jolt(site, system, readings, speed_um_s, slips, told):
        return system
    if not a_wheel_that_keeps_pace_rolls(site, paced_cycles, slips):
        return system
    after = odometry.note_cycle(site.bounds, system.motion, readings)
    stays = system.motion.trusted and after.trusted
    return Running(
        front_nm=to_nm,
        speed_um_s=speed_um_s,
        slips=slips,
        told=told,
        shown_mm_s=readings.tachometer_mm_s,
        shown_way_mm=readings.way_mm,
        paced_cycles=paced_cycles,
        anchor_nm=system.anchor_nm if stays else to_nm,
        anchor_way_mm=system.anchor_way_mm if stays else readings.way_mm,
        counted=told and not slips and (system.counted or not stays),
        contradicted=system.contradicted,
        false_by_nm=system.false_by_nm,
        motion=after,
    )


def take_fix(site: Line, system: Running, least_mm: int, most_mm: int) -> Running:
    """A tag or a feature says where the front is, or says it falsely, by as much as it likes (P3, T2)."""
    lies_apart = lies_outside(system, least_mm, most_mm)
    missed_nm = 0 if lies_apart else missed_by_nm(system, least_mm, most_mm)
    return replace(
        system,
        anchor_nm=system.front_nm,
        anchor_way_mm=system.shown_way_mm,
        contradicted=system.contradicted or lies_apart,
        false_by_nm=larger(system.false_by_nm, missed_nm),
        motion=odometry.note_fix(system.motion, least_mm, most_mm),
    )


def locate_anew(site: Line, system: Running, least_mm: int, most_mm: int, way_mm: int) -> Running:
    """At rest the unit is told where the front is, and begins anew; so it does at power-on (P7, T8)."""
    if not the_train_stands_where_it_is_said_to(system, least_mm, most_mm):
        return system
    return replace(
        system,
        anchor_nm=system.front_nm,
        counted=False,
        contradicted=False,
        false_by_nm=0,
        motion=odometry.located(least_mm, most_mm, way_mm),
    )
