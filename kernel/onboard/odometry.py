"""Odometry: where the front of the train is, as a range, from tachometer and inertial sensor (P1, P7).

While the wheel is trusted the range goes with the tachometer's pulses, counted from an anchor, so
that it widens with the way and never with time.  When the accelerations of inertial sensor and
tachometer differ, the wheel slips or slides: from the cycle before on, speed and way come from the
inertial sensor within the line's steepest gradient, and the anchor goes along (paper 001, 2.1).
Then it widens with time, by the range of speeds, which widens as well; so it does at each start, until
the wheel has agreed for long enough.
A fix narrows the range; one that lies outside it shows that a sensor is worse than its bound, and then
no range is claimed any more.

Speeds and pulses are signed: a train that rolls back is in its range as well.

Ranges of readings: speeds to 200 m/s either way, ways to 10**12 mm and no farther in a cycle than at 200 m/s,
accelerations that the train can have on the steepest gradient; what is beyond is no reading.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from enum import Enum

from kernel.onboard.arithmetic import (
    CYCLE_MS,
    GREATEST_SPEED_MM_S,
    LONGEST_CYCLE_MS,
    SHORTEST_CYCLE_MS,
    divided_up,
    larger,
    least_in_a_cycle,
    limited,
    magnitude,
    most_in_a_cycle,
    smaller,
)

MILLION = 1_000_000
GREATEST_WAY_MM = 10**12
"""Pulses count so far either way since power-on, a million kilometres; times an error it fits into 64 bits (P1)."""
GREATEST_STEP_MM = CYCLE_MS * GREATEST_SPEED_MM_S // 1000
"""So far pulses go in a cycle at most; a counter that jumps gives no reading (P1)."""


@dataclass(frozen=True)
class SensorBounds:
    """The written bounds on sensors, train and line; each is 0 or more (P1, P7).

    ``scale_ppm``: creep of a rolling wheel and the error of its diameter, of the way and of the speed.
    ``pulse_mm``: the way between two pulses.
    ``tachometer_mm_s``: error of the speed reading beside that.
    ``inertial_mm_s2``: bias, drift, noise and mounting of the inertial sensor.
    ``gradient_mm_s2``: gravity along the steepest gradient of the line.
    ``gradient_rate_mm_s2``: how much the gradient estimate may change in one cycle.
    ``slip_mm_s2``: T_a, from which on the accelerations differ.
    ``accelerates_mm_s2``, ``brakes_mm_s2``: what the train can do at most, on the steepest gradient.
    ``agreement_cycles``: how long the accelerations must agree before the wheel is trusted again.
    ``pace_mm_s``: a wheel is trusted again only while it is known to be no farther from the train's speed.
    ``locked_mm_s``: one that shows none only of a train that is no faster, either way: it may be locked.
    """

    scale_ppm: int
    pulse_mm: int
    tachometer_mm_s: int
    inertial_mm_s2: int
    gradient_mm_s2: int
    gradient_rate_mm_s2: int
    slip_mm_s2: int
    accelerates_mm_s2: int
    brakes_mm_s2: int
    agreement_cycles: int
    pace_mm_s: int
    locked_mm_s: int


@dataclass(frozen=True)
class Readings:
    """What the sensors say at the end of a cycle (P1).

    ``elapsed_ms``: since the cycle before, by the processor's clock, rounded away from 100 ms: a cycle of more than
    102 ms is told as 103.
    ``tachometer_valid``, ``inertial_valid``: the sensor's own diagnosis, and that it gave a number at all.
    ``tachometer_mm_s``: speed of the wheel, below 0 if it turns back.
    ``way_mm``: its pulses as a way, counted since power-on, fewer again if it turns back.  A host whose counter is
    narrower goes on by its differences.
    ``inertial_mm_s2``: along the track, gravity included.
    """

    elapsed_ms: int
    tachometer_valid: bool
    tachometer_mm_s: int
    way_mm: int
    inertial_valid: bool
    inertial_mm_s2: int


class Loss(Enum):
    """Why no range is claimed any more; the train brakes, and is located anew at a standstill (P7, T8)."""

    NONE = 0
    CYCLE_IRREGULAR = 1
    """The processor's clock did not go on by a lawful cycle: nobody knows how far the train ran in it."""
    CONTRADICTED = 2
    """A fix lay outside the range: some sensor or tag is worse than its bound."""
    LOCATED_ANEW = 3
    """The train was located anew since: what was known before says nothing of where it is on the new kilometrage."""


@dataclass(frozen=True)
class Motion:
    """What the odometry knows (P1, P7).

    ``front_least_mm``, ``front_most_mm``: the front is in there, on the line's kilometrage.
    ``speed_least_mm_s``, ``speed_most_mm_s``: so is the speed.
    ``anchor_least_mm``, ``anchor_most_mm``, ``anchor_way_mm``: range and pulses where counting began.
    ``tachometer_mm_s``, ``way_mm``: the last readings.
    ``trusted``: the wheel rolls; ``agreed_cycles``: for how long it has agreed, if not.
    ``gradient_mm_s2``: gravity along the track, as estimated.
    """

    front_least_mm: int
    front_most_mm: int
    speed_least_mm_s: int
    speed_most_mm_s: int
    anchor_least_mm: int
    anchor_most_mm: int
    anchor_way_mm: int
    tachometer_mm_s: int
    way_mm: int
    trusted: bool
    agreed_cycles: int
    gradient_mm_s2: int
    loss: Loss


def located(least_mm: int, most_mm: int, way_mm: int) -> Motion:
    """Begin at a standstill, with the front known to be in a range (P7, T8); the wheel has yet to agree."""
    return Motion(
        front_least_mm=least_mm,
        front_most_mm=most_mm,
        speed_least_mm_s=0,
        speed_most_mm_s=0,
        anchor_least_mm=least_mm,
        anchor_most_mm=most_mm,
        anchor_way_mm=way_mm,
        tachometer_mm_s=0,
        way_mm=way_mm,
        trusted=False,
        agreed_cycles=0,
        gradient_mm_s2=0,
        loss=Loss.NONE,
    )


def past(motion: Motion) -> Motion:
    """Give what was known a cycle ago of a train that has been located anew since: nothing is claimed by it (P7)."""
    return replace(motion, loss=Loss.LOCATED_ANEW)


def is_located(motion: Motion) -> bool:
    """Tell whether the range is claimed to contain the front (P7)."""
    return motion.loss == Loss.NONE


# ---- what the sensors can be held to


def speed_error_mm_s(bounds: SensorBounds, tachometer_mm_s: int) -> int:
    """Give how far the speed of a rolling wheel's reading may be from the train's (P1)."""
    return magnitude(tachometer_mm_s) * bounds.scale_ppm // MILLION + 1 + bounds.tachometer_mm_s


def way_error_mm(bounds: SensorBounds, way_mm: int) -> int:
    """Give how far the pulses of a rolling wheel may be from the way that the train ran (P1)."""
    return magnitude(way_mm) * bounds.scale_ppm // MILLION + 1 + bounds.pulse_mm


def tachometer_is_heard(readings: Readings) -> bool:
    """Tell whether the tachometer gives numbers to compare the next ones with: valid and in range (P1)."""
    return (
        readings.tachometer_valid
        and -GREATEST_SPEED_MM_S <= readings.tachometer_mm_s <= GREATEST_SPEED_MM_S
        and -GREATEST_WAY_MM <= readings.way_mm <= GREATEST_WAY_MM
    )


def needs_a_pulse(bounds: SensorBounds, speed_mm_s: int) -> bool:
    """Tell whether a wheel of such a speed turns by more than a pulse in each cycle (P1)."""
    return CYCLE_MS * magnitude(speed_mm_s) > 1000 * bounds.pulse_mm


def tachometer_speaks(bounds: SensorBounds, motion: Motion, readings: Readings) -> bool:
    """Tell whether the tachometer gives a reading: heard, not stuck, and its pulses without a jump (P1).

    A speed of more than a pulse a cycle, without a pulse, is no reading: a tachometer that is stuck repeats both.  A
    slower wheel passes cycles without one, and its speed is known by how long ago the last one came.
    """
    return (
        tachometer_is_heard(readings)
        and (not needs_a_pulse(bounds, readings.tachometer_mm_s) or readings.way_mm != motion.way_mm)
        and motion.way_mm - GREATEST_STEP_MM <= readings.way_mm <= motion.way_mm + GREATEST_STEP_MM
    )


def inertial_speaks(bounds: SensorBounds, readings: Readings) -> bool:
    """Tell whether the inertial sensor gives a reading: valid, and what the train on its line can show at all (P1)."""
    beside_mm_s2 = bounds.gradient_mm_s2 + bounds.inertial_mm_s2
    return (
        readings.inertial_valid
        and -bounds.brakes_mm_s2 - beside_mm_s2 <= readings.inertial_mm_s2 <= bounds.accelerates_mm_s2 + beside_mm_s2
    )


def wheel_mm_s2(motion: Motion, readings: Readings) -> int:
    """Give a_p, the acceleration of the wheel over the last cycle (P1)."""
    return (readings.tachometer_mm_s - motion.tachometer_mm_s) * (1000 // CYCLE_MS)


def agrees(bounds: SensorBounds, motion: Motion, readings: Readings) -> bool:
    """Tell whether the wheel's acceleration is the train's: |a_m - a_p| below T_a, both sensors speaking (P1).

    Asked of the speeds gained in the cycle, however long it lasted within its limits.
    """
    measured_mm_s2 = readings.inertial_mm_s2 - motion.gradient_mm_s2
    gained_um_s = 1000 * (readings.tachometer_mm_s - motion.tachometer_mm_s)
    slip_um_s = least_in_a_cycle(bounds.slip_mm_s2)
    return (
        tachometer_speaks(bounds, motion, readings)
        and inertial_speaks(bounds, readings)
        and most_in_a_cycle(measured_mm_s2) - slip_um_s < gained_um_s
        and gained_um_s < least_in_a_cycle(measured_mm_s2) + slip_um_s
    )


def next_gradient_mm_s2(bounds: SensorBounds, motion: Motion, readings: Readings) -> int:
    """Follow what the inertial sensor shows beyond the wheel, slowly, within the steepest gradient (P1).

    Asked only while the wheel is trusted and agrees: in a slip the estimate stays as it was.
    """
    seen_mm_s2 = readings.inertial_mm_s2 - wheel_mm_s2(motion, readings)
    followed_mm_s2 = limited(
        seen_mm_s2,
        motion.gradient_mm_s2 - bounds.gradient_rate_mm_s2,
        motion.gradient_mm_s2 + bounds.gradient_rate_mm_s2,
    )
    return limited(followed_mm_s2, -bounds.gradient_mm_s2, bounds.gradient_mm_s2)


def least_mm_s2(bounds: SensorBounds, readings: Readings) -> int:
    """Give the least acceleration that the train may have: the brakes', or the inertial sensor's if it speaks (P1)."""
    if not inertial_speaks(bounds, readings):
        return -bounds.brakes_mm_s2
    return larger(-bounds.brakes_mm_s2, readings.inertial_mm_s2 - bounds.gradient_mm_s2 - bounds.inertial_mm_s2)


def most_mm_s2(bounds: SensorBounds, motion: Motion, readings: Readings) -> int:
    """Give the most acceleration that the train may have: the motors', or the inertial sensor's if it speaks (P1).

    The brakes of a train that rolls back act forward.
    """
    back = motion.speed_least_mm_s < 0
    most = larger(bounds.accelerates_mm_s2, bounds.brakes_mm_s2) if back else bounds.accelerates_mm_s2
    if not inertial_speaks(bounds, readings):
        return most
    return smaller(most, readings.inertial_mm_s2 + bounds.gradient_mm_s2 + bounds.inertial_mm_s2)


# ---- one cycle


def roll(bounds: SensorBounds, motion: Motion, readings: Readings) -> Motion:
    """Go on with the wheel: the range is the anchor's and the way since, with their errors (P1, P7)."""
    since_mm = readings.way_mm - motion.anchor_way_mm
    error_mm = way_error_mm(bounds, since_mm)
    speed_error = speed_error_mm_s(bounds, readings.tachometer_mm_s)
    return replace(
        motion,
        front_least_mm=motion.anchor_least_mm + since_mm - error_mm,
        front_most_mm=motion.anchor_most_mm + since_mm + error_mm,
        speed_least_mm_s=readings.tachometer_mm_s - speed_error,
        speed_most_mm_s=larger(0, readings.tachometer_mm_s + speed_error),
        tachometer_mm_s=readings.tachometer_mm_s,
        way_mm=readings.way_mm,
        gradient_mm_s2=next_gradient_mm_s2(bounds, motion, readings),
    )


def glide(bounds: SensorBounds, motion: Motion, readings: Readings) -> Motion:
    """Go on without the wheel, from where the train was before: by inertia within its bounds (P1, P7).

    The anchor goes along.  Once the wheel has agreed long enough, at a speed that the train may
    have, it is trusted again; not where the train may have so many speeds that this says little.
    """
    lost_um_s = least_in_a_cycle(least_mm_s2(bounds, readings))
    gained_um_s = most_in_a_cycle(most_mm_s2(bounds, motion, readings))
    slowest_mm_s = motion.speed_least_mm_s + lost_um_s // 1000
    fastest_mm_s = larger(0, motion.speed_most_mm_s + divided_up(gained_um_s, 1000))
    back_um = least_in_a_cycle(smaller(motion.speed_least_mm_s, slowest_mm_s))
    on_um = most_in_a_cycle(larger(motion.speed_most_mm_s, fastest_mm_s))
    least_mm = motion.front_least_mm + back_um // 1000
    most_mm = motion.front_most_mm + divided_up(on_um, 1000)
    heard = tachometer_is_heard(readings)
    speed_error = speed_error_mm_s(bounds, readings.tachometer_mm_s)
    plausible = (
        slowest_mm_s - speed_error <= readings.tachometer_mm_s <= fastest_mm_s + speed_error
        and fastest_mm_s - slowest_mm_s + speed_error <= bounds.pace_mm_s
        and (
            readings.tachometer_mm_s != 0
            or (-bounds.locked_mm_s <= slowest_mm_s and fastest_mm_s <= bounds.locked_mm_s)
        )
    )
    agreed = motion.agreed_cycles + 1 if agrees(bounds, motion, readings) and plausible else 0
    return replace(
        motion,
        front_least_mm=least_mm,
        front_most_mm=most_mm,
        speed_least_mm_s=slowest_mm_s,
        speed_most_mm_s=fastest_mm_s,
        anchor_least_mm=least_mm,
        anchor_most_mm=most_mm,
        anchor_way_mm=readings.way_mm if heard else motion.way_mm,
        tachometer_mm_s=readings.tachometer_mm_s if heard else motion.tachometer_mm_s,
        way_mm=readings.way_mm if heard else motion.way_mm,
        trusted=agreed >= bounds.agreement_cycles,
        agreed_cycles=agreed,
    )


def note_cycle(bounds: SensorBounds, motion: Motion, readings: Readings) -> Motion:
    """Take the readings of one cycle (P1, P7)."""
    if motion.loss != Loss.NONE:
        return motion
    if not SHORTEST_CYCLE_MS <= readings.elapsed_ms <= LONGEST_CYCLE_MS:
        return replace(motion, loss=Loss.CYCLE_IRREGULAR)
    if motion.trusted and agrees(bounds, motion, readings):
        return roll(bounds, motion, readings)
    return glide(bounds, motion, readings)


def note_fix(motion: Motion, least_mm: int, most_mm: int) -> Motion:
    """Narrow the range by a fix, which says where the front is by a tag or a feature (P3, P7, T2).

    A fix that lies wholly outside the range contradicts a sensor bound: no range is claimed then.
    """
    if motion.loss != Loss.NONE:
        return motion
    if most_mm < motion.front_least_mm or motion.front_most_mm < least_mm:
        return replace(motion, loss=Loss.CONTRADICTED)
    narrowed_least_mm = larger(motion.front_least_mm, least_mm)
    narrowed_most_mm = smaller(motion.front_most_mm, most_mm)
    return replace(
        motion,
        front_least_mm=narrowed_least_mm,
        front_most_mm=narrowed_most_mm,
        anchor_least_mm=narrowed_least_mm,
        anchor_most_mm=narrowed_most_mm,
        anchor_way_mm=motion.way_mm,
    )


# ---- what is reported


def rear_least_mm(motion: Motion, length_mm: int) -> int:
    """Give the rearmost place where the train may still be: its front at the least, less its length (P7)."""
    return motion.front_least_mm - length_mm
