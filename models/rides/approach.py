"""The end of a ride: a driver who does not brake, an end of authority, and the brake control (T12).

The train runs on from where its ride ended, as its brake lets it; its sensors err as they did before.
"""

from __future__ import annotations

from typing import Any, NamedTuple

from models.compiled import compiled
from models.rides import tally
from models.rides.onboard import (
    BRAKE,
    LOCATED,
    MADE,
    REVERSE_LIMITS,
    SENSORS,
    SPLIT_LIMITS,
    TRAIN_LIMITS,
    speed_bound_mm_s,
)
from models.sensors.faults import CYCLE_S, GRAVITY_M_S2
from models.sensors.tachometer import PULSE_M

GREATEST_SPEED_M_S = 36.0
"""The driver accelerates up to 130 km/h, the paper's greatest speed (001, table 2)."""
LONGEST_CYCLES = 3_000
FARTHEST_MM = 10_000_000
SLIDES_FOR_CYCLES = 10
PULSE_MM = round(PULSE_M * 1000)

note_readings, Readings = MADE.odometry.note_cycle, MADE.odometry.Readings
stops_before, Brake = MADE.braking.stops_before, MADE.braking.Brake
decide, Known = MADE.brake_demand.decide, MADE.brake_demand.Known
note_movement, NOT_MOVED = MADE.reverse_movement.note_cycle, MADE.reverse_movement.LOCATED
UNKNOWN, NONE_AWAITED, made_up = MADE.speed_limit.UNKNOWN, MADE.tag_window.NONE_AWAITED, MADE.split.made_up
NONE_LISTED = MADE.restriction_ahead.NONE_LISTED
watching, note_watch = MADE.brake_watch.watching, MADE.brake_watch.note_cycle


class Rolling(NamedTuple):
    """The train in truth: its head, speed, wheel, the way the wheel has turned, and how the wheel differs."""

    head_m: float
    speed_m_s: float
    wheel_m_s: float
    turned_m: float
    difference_m_s: float


@compiled
def nearest_end_mm(motion: Any) -> int:
    """The nearest end at which the brake control still lets the train run on."""
    near, far = motion.front_most_mm, motion.front_most_mm + FARTHEST_MM
    while far - near > 1:
        middle = (near + far) // 2
        if stops_before(BRAKE, motion.front_most_mm, motion.speed_most_mm_s, middle):
            far = middle
        else:
            near = middle
    return int(far)


@compiled
def rolled(rolling: Any, ending: Any, braked_cycles: int) -> Any:
    """One cycle on; ``braked_cycles``: since the brake was commanded, 0 if it is not."""
    if braked_cycles > ending.responds_s / CYCLE_S:
        after = max(0.0, rolling.speed_m_s - ending.slows_m_s2 * CYCLE_S)
    else:
        after = max(rolling.speed_m_s, min(rolling.speed_m_s + ending.gains_m_s2 * CYCLE_S, GREATEST_SPEED_M_S))
    difference = rolling.difference_m_s
    if braked_cycles and ending.slides_at <= braked_cycles < ending.slides_at + SLIDES_FOR_CYCLES:
        difference = max(difference - ending.jolt_m_s2 * CYCLE_S, -ending.slides_m_s)
    elif braked_cycles:
        difference = min(difference + ending.jolt_m_s2 * CYCLE_S, 0.0)
    wheel = max(0.0, after * (1 + ending.scale) + difference)
    return Rolling(
        rolling.head_m + (rolling.speed_m_s + after) / 2 * CYCLE_S,
        after,
        wheel,
        rolling.turned_m + (rolling.wheel_m_s + wheel) / 2 * CYCLE_S,
        difference,
    )


@compiled
def read(before: Any, after: Any, ending: Any, way_before_mm: int) -> Any:
    """What the sensors say at the end of a cycle: speed by the pulses' times, so the mean; without pulses none."""
    way_mm = int(after.turned_m / PULSE_M) * PULSE_MM
    mean_mm_s = round((before.wheel_m_s + after.wheel_m_s) * 500) if way_mm > way_before_mm else 0
    force = (after.speed_m_s - before.speed_m_s) / CYCLE_S + GRAVITY_M_S2 * ending.gradient + ending.bias_m_s2
    return Readings(100, True, mean_mm_s, way_mm, True, round(force * 1000))


@compiled
def broken_bounds(ending: Any, out: Any) -> None:
    """Which of the proofs' assumptions this approach does not keep to."""
    out[tally.BRAKE_BROKEN] += (
        ending.gains_m_s2 * 1000 > BRAKE.gains_mm_s2
        or ending.slows_m_s2 * 1000 < BRAKE.slows_mm_s2
        or ending.responds_s / CYCLE_S > BRAKE.response_cycles
    )
    out[tally.POWERS_BROKEN] += (
        ending.gains_m_s2 * 1000 > SENSORS.accelerates_mm_s2 or ending.slows_m_s2 * 1000 > SENSORS.brakes_mm_s2
    )
    slope_mm_s2 = abs(GRAVITY_M_S2 * ending.gradient) * 1000
    off_mm_s2 = abs(ending.bias_m_s2) * 1000 + 0.5
    out[tally.INERTIAL_BROKEN] += slope_mm_s2 > SENSORS.gradient_mm_s2 or off_mm_s2 > SENSORS.inertial_mm_s2
    out[tally.WHEEL_BROKEN] += abs(ending.scale) * 1e6 > SENSORS.scale_ppm


@compiled
def approach(motion: Any, head_m: float, speed_m_s: float, ending: Any, out: Any) -> None:
    """Let a train approach the end of its authority until it stands."""
    wheel = speed_m_s * (1 + ending.scale)
    rolling = Rolling(head_m, speed_m_s, wheel, motion.way_mm / 1000 + 0.001, 0.0)
    brake = Brake(False, nearest_end_mm(motion) + int(ending.margin_m * 1000), False)
    watch, movement, braked_cycles = watching(motion.speed_most_mm_s), NOT_MOVED, 0
    whole = made_up(SPLIT_LIMITS)
    out[tally.APPROACHES] = 1
    broken_bounds(ending, out)
    for _ in range(LONGEST_CYCLES):
        known = Known(motion, watch, movement, UNKNOWN, whole, NONE_AWAITED, NONE_LISTED)
        brake = decide(TRAIN_LIMITS, brake, known, True, False)
        braked_cycles = braked_cycles + 1 if brake.applied else 0
        before, rolling = rolling, rolled(rolling, ending, braked_cycles)
        readings = read(before, rolling, ending, motion.way_mm)
        trusted, motion = motion.trusted, note_readings(SENSORS, motion, readings)
        movement = note_movement(REVERSE_LIMITS, movement, readings)
        located = motion.loss == LOCATED
        watch = note_watch(BRAKE, watch, brake.applied, located, motion.speed_least_mm_s, motion.speed_most_mm_s)
        front_mm, speed_mm_s = rolling.head_m * 1000, rolling.speed_m_s * 1000
        out[tally.FRONT_OUTSIDE] += not motion.front_least_mm <= front_mm <= motion.front_most_mm
        out[tally.SPEED_OUTSIDE] += not motion.speed_least_mm_s - 0.01 <= speed_mm_s <= motion.speed_most_mm_s + 0.01
        wheel_off_mm_s = abs(motion.tachometer_mm_s - speed_mm_s)
        if trusted and motion.trusted and wheel_off_mm_s > speed_bound_mm_s(motion.tachometer_mm_s):
            out[tally.WHEEL_BROKEN] += 1
        out[tally.AUTHORITY_PASSED] += front_mm > brake.end_mm
        if brake.applied and rolling.speed_m_s == 0.0:
            break
    out[tally.BRAKE_ACCUSED] = watch.broken
    out[tally.SHORT_OF_END_MM] = int(brake.end_mm - rolling.head_m * 1000)
