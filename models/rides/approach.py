"""The end of a ride: a driver who does not brake, an end of authority, and the computer's brake (T12).

The train runs on from where its ride ended, as its brake lets it; its sensors err as they did before.
"""

from __future__ import annotations

from typing import Any, NamedTuple

from models.compiled import compiled
from models.rides import tally
from models.rides.onboard import (
    BRAKE,
    LIMITS,
    MADE,
    SENSORS,
    SPLIT_LIMITS,
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

Computer, decide, sense = MADE.computer.Computer, MADE.computer.decide, MADE.computer.sense
stops_before, Brake, Known = MADE.braking.stops_before, MADE.braking.Brake, MADE.brake_demand.Known
NO_CEILING = MADE.ceiling.NONE
NOT_MOVED, UNKNOWN = MADE.reverse_movement.LOCATED, MADE.speed_limit.UNKNOWN
NONE_AWAITED, NONE_LISTED = MADE.tag_window.NONE_AWAITED, MADE.restriction_ahead.NONE_LISTED
made_up, watching, Readings = MADE.split.made_up, MADE.brake_watch.watching, MADE.odometry.Readings
Acceleration, Telegram = MADE.split.Acceleration, MADE.split.Readings


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
def whole(readings: Any) -> Any:
    """The tail tells what the head measures: this train does not part."""
    force = Acceleration(readings.inertial_mm_s2, readings.inertial_valid)
    return Telegram(force, True, force, force, 0)


@compiled
def let_run(computer: Any, end_mm: int) -> Any:
    """The ride's computer, where nothing but the end of authority wants the brake (T12)."""
    motion = computer.known.motion
    known = Known(
        motion, watching(motion.speed_most_mm_s), NOT_MOVED, UNKNOWN, made_up(SPLIT_LIMITS), NONE_AWAITED, NONE_LISTED,
        NO_CEILING,
    )  # fmt: skip
    brake = Brake(False, end_mm, False)
    return Computer(
        known, computer.before, computer.from_mm, computer.spacing, computer.length, brake, computer.head, computer.tail
    )  # fmt: skip


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
def approach(computer: Any, head_m: float, speed_m_s: float, ending: Any, out: Any) -> None:
    """Let a train approach the end of its authority until it stands."""
    wheel, motion = speed_m_s * (1 + ending.scale), computer.known.motion
    rolling = Rolling(head_m, speed_m_s, wheel, motion.way_mm / 1000 + 0.001, 0.0)
    end_mm, braked_cycles = nearest_end_mm(motion) + int(ending.margin_m * 1000), 0
    computer = let_run(computer, end_mm)
    out[tally.APPROACHES] = 1
    broken_bounds(ending, out)
    for _ in range(LONGEST_CYCLES):
        computer = decide(LIMITS, computer, True, False)
        brakes, before, known = computer.brake.applied, rolling, computer.known.motion
        braked_cycles = braked_cycles + 1 if brakes else 0
        rolling = rolled(rolling, ending, braked_cycles)
        readings = read(before, rolling, ending, known.way_mm)
        computer = sense(LIMITS, computer, readings, whole(readings))
        motion, front_mm, speed_mm_s = computer.known.motion, rolling.head_m * 1000, rolling.speed_m_s * 1000
        out[tally.FRONT_OUTSIDE] += not motion.front_least_mm <= front_mm <= motion.front_most_mm
        out[tally.SPEED_OUTSIDE] += not motion.speed_least_mm_s - 0.01 <= speed_mm_s <= motion.speed_most_mm_s + 0.01
        wheel_off_mm_s = abs(motion.tachometer_mm_s - speed_mm_s)
        if known.trusted and motion.trusted and wheel_off_mm_s > speed_bound_mm_s(motion.tachometer_mm_s):
            out[tally.WHEEL_BROKEN] += 1
        out[tally.AUTHORITY_PASSED] += front_mm > end_mm
        if brakes and rolling.speed_m_s == 0.0:
            break
    out[tally.BRAKE_ACCUSED] = computer.known.watch.broken
    out[tally.SHORT_OF_END_MM] = int(end_mm - rolling.head_m * 1000)
