"""One ride, cycle by cycle: readings into the compiled computer, what it says against the truth.

The computer's part is integer, in its units; the truth is in m and s.  numba compiles all of it.  The train runs on as
its trace does, whatever its brake is: what the brake is worth is tried at the end of the ride.
"""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np

from kernel.onboard import tag_kind
from models.compiled import compiled
from models.rides import onboard, tally
from models.rides.onboard import (
    AXIS_YAW,
    BRAKE,
    CONTRADICTED,
    FIXED,
    LENGTH_BOUNDS,
    LIMITS,
    LOCATED,
    MADE,
    SENSORS,
    SPACING_LIMITS,
    SPLIT_LIMITS,
    speed_bound_mm_s,
    way_bound_mm,
)
from models.rides.plan import LEAST_WAY_M, LENGTH_MM
from models.sensors.curves import MIDDLE

STARTS_WITHIN_MM = 500
"""The train is located at the start to so much either way."""
GOOD_LEVEL_MV = 1_000
FRAMES_FED = 4
"""Frames of one passage after the fourth change nothing any more."""
LATE_CYCLES = MIDDLE
"""The average over 15 cycles is known so many after its middle."""
HALF_MM = 0.5
"""Readings are rounded to whole units."""
FAR_MM = 100_000_000
"""A ride's authority ends so far ahead."""

Computer, put_into_service, decide, sense = (
    MADE.computer.Computer, MADE.computer.put_into_service, MADE.computer.decide, MADE.computer.sense,
)  # fmt: skip
await_tag, await_none = MADE.computer.await_tag, MADE.computer.await_none
reads_in_window, fix_of = MADE.computer.reads_in_window, MADE.computer.fix
read_by_head, read_by_tail = MADE.computer.read_by_head, MADE.computer.read_by_tail
take_end, NO_CEILING = MADE.braking.take_end, MADE.ceiling.NONE
note_fix, rear_least_mm = MADE.computer.note_fix, MADE.odometry.rear_least_mm
way_error_mm, Readings = MADE.odometry.way_error_mm, MADE.odometry.Readings
is_intact, Acceleration, Telegram = MADE.split.is_intact, MADE.split.Acceleration, MADE.split.Readings
note_head_frame, note_tail_frame = MADE.computer.note_head_frame, MADE.computer.note_tail_frame
mend_head, mend_tail, delivers = MADE.computer.mend_head, MADE.computer.mend_tail, MADE.tag_reader.delivers
made_up, inspect_brake = MADE.computer.made_up, MADE.computer.inspect_brake
Known, BrakeWatch = MADE.brake_demand.Known, MADE.brake_watch.BrakeWatch
Frame, NO_FRAME, LEVEL = MADE.tag_reader.Frame, MADE.tag_reader.NO_FRAME, MADE.tag_reader.Level(GOOD_LEVEL_MV, True)
is_healthy, contradicts_itself = MADE.antenna_spacing.is_healthy, MADE.train_length.contradicts_itself
length_mm, contradicts_the_line = MADE.train_length.length_mm, MADE.train_length.contradicts_the_line
note_yaw, is_over, AWAITED = MADE.feature.note_cycle, MADE.feature.is_over, MADE.feature.AWAITED
Feature, Band, Turning = MADE.feature.Feature, MADE.feature.Band, MADE.feature.Readings
PLAIN = tag_kind.PLAIN


class Ends(NamedTuple):
    """Which tags are next for both antennas."""

    next_head: int
    next_tail: int


class Curve(NamedTuple):
    """Which feature is awaited, what is known of it, and how long the wheel has been trusted."""

    feature: int
    detection: Any
    trusted_cycles: int


class Apart(NamedTuple):
    """What is known of wholeness, and since when the parts have visibly differed."""

    was_intact: bool
    streak: int
    first_seen: int


@compiled
def anchor(motion: Any) -> Any:
    """Where counting began: while this stays, the truth that belongs to it does."""
    return motion.anchor_least_mm, motion.anchor_most_mm, motion.anchor_way_mm


@compiled
def hold_assumptions(trace: Any, cycle: int, before: Any, after: Any, readings: Any, anchor_m: float, out: Any) -> None:
    """Hold the assumptions on train and sensors against the truth, as `models.onboard.odometry` states them (P1).

    They are written over readings and declared bounds; the kernel says only when it relies on the wheel.
    """
    gained = (trace.speed_m_s[cycle] - (trace.speed_m_s[cycle - 1] if cycle else 0.0)) * 10_000
    if not -SENSORS.brakes_mm_s2 - HALF_MM <= gained <= SENSORS.accelerates_mm_s2 + HALF_MM:
        out[tally.POWERS_BROKEN] += 1
    slope = trace.slope_m_s2[cycle] * 1000
    off = abs(readings.inertial_mm_s2 - slope - gained)
    beside = SENSORS.gradient_mm_s2 + SENSORS.inertial_mm_s2
    gross = not -SENSORS.brakes_mm_s2 - beside <= readings.inertial_mm_s2 <= SENSORS.accelerates_mm_s2 + beside
    wrong = readings.inertial_valid and not gross and off > SENSORS.inertial_mm_s2
    if wrong or abs(slope) > SENSORS.gradient_mm_s2:
        out[tally.INERTIAL_BROKEN] += 1
    if before.trusted and after.trusted:
        speed_off = abs(readings.tachometer_mm_s - trace.speed_m_s[cycle] * 1000)
        since_mm = readings.way_mm - before.anchor_way_mm
        way_off = abs((trace.head_m[cycle] - anchor_m) * 1000 - since_mm)
        if speed_off > speed_bound_mm_s(readings.tachometer_mm_s) or way_off > way_bound_mm(since_mm):
            out[tally.WHEEL_BROKEN] += 1


@compiled
def frame_of(uid: int, came: int) -> Any:
    """What an antenna hears in a frame time: silence before a tag, then its frames (T16)."""
    return Frame(True, uid, 0, 0, PLAIN) if came >= 0 else NO_FRAME


@compiled
def under_the_head(trace: Any, cycle: int, computer: Any, ends: Any, out: Any) -> Any:
    """The head's antenna passes a tag: if it is delivered, the computer takes it, and awaits the next (T5, T13, T3)."""
    tag, delivered = ends.next_head, False
    for came in range(-LIMITS.reader.gap_frames, min(trace.tag_frames[tag], FRAMES_FED)):
        computer = note_head_frame(LIMITS, computer, frame_of(tag + 1, came), LEVEL)
        if delivers(computer.head):
            computer, delivered = read_under_the_head(trace, cycle, computer, out), True
    out[tally.TAGS_READ] += delivered
    out[tally.TAGS_MISSED] += not delivered
    return computer, Ends(tag + 1, ends.next_tail)


@compiled
def read_under_the_head(trace: Any, cycle: int, computer: Any, out: Any) -> Any:
    """The computer takes the tag that its head has read, and awaits the next one of the line (T5, T13, T3)."""
    tag = computer.head.held.uid - 1
    place_mm = trace.tags_mm[tag]
    if computer.known.window.expected and not reads_in_window(LIMITS, computer, place_mm):
        out[tally.TAG_OUTSIDE_WINDOW] += 1
    was_located, fix = computer.known.motion.loss == LOCATED, fix_of(LIMITS, computer, place_mm)
    computer = read_by_head(LIMITS, computer, place_mm)
    if was_located:
        out[tally.FIX_BROKEN] += not fix.least_mm <= trace.head_m[cycle] * 1000 <= fix.most_mm
        out[tally.CONTRADICTED] += computer.known.motion.loss == CONTRADICTED
    if tag + 1 < len(trace.tags_mm):
        return await_tag(LIMITS, computer, trace.tags_mm[tag + 1], PLAIN)
    return await_none(computer)


@compiled
def under_the_tail(trace: Any, cycle: int, computer: Any, ends: Any, out: Any) -> Any:
    """The tail's antenna passes a tag: is it one antenna distance behind the head; then the length (T13, T3)."""
    tag = ends.next_tail
    for came in range(-LIMITS.reader.gap_frames, min(trace.tag_frames[tag], FRAMES_FED)):
        computer = note_tail_frame(LIMITS, computer, frame_of(tag + 1, came), LEVEL)
        if delivers(computer.tail):
            computer = read_under_the_tail(trace, cycle, computer, out)
    return computer, Ends(ends.next_head, tag + 1)


@compiled
def read_under_the_tail(trace: Any, cycle: int, computer: Any, out: Any) -> Any:
    """The computer takes the tag that its tail has read (T13, T3)."""
    before = computer.length
    computer = read_by_tail(LIMITS, computer)
    spacing, motion, length = computer.spacing, computer.known.motion, computer.length
    out[tally.SPACING_BROKEN] += spacing.broken
    hidden_mm = 4 * SPACING_LIMITS.tolerance_mm + 2 * (motion.front_most_mm - motion.front_least_mm)
    out[tally.FALSE_TAIL_ACCEPTED] += is_healthy(spacing) and trace.gap_m[cycle] * 1000 > hidden_mm
    out[tally.LENGTHS] += length.measured and not before.measured
    if is_healthy(spacing):
        out[tally.LENGTH_CONTRADICTS] += contradicts_the_line(LENGTH_BOUNDS, length) or contradicts_itself(length)
    return computer


@compiled
def at_the_ends(trace: Any, cycle: int, computer: Any, ends: Any, out: Any) -> Any:
    """Everything that the antennas have read in this cycle (T2, T5)."""
    while ends.next_head < len(trace.tags_mm) and trace.tag_cycle[ends.next_head] == cycle:
        computer, ends = under_the_head(trace, cycle, computer, ends, out)
    while ends.next_tail < len(trace.tags_mm) and 0 <= trace.tail_cycle[ends.next_tail] <= cycle:
        computer, ends = under_the_tail(trace, cycle, computer, ends, out)
    return computer, ends


@compiled
def feature_at(row: Any) -> Any:
    """A feature of the line, from its numbers."""
    return Feature(
        AXIS_YAW, row[0], row[1], row[2], Band(row[3], row[4]), Band(row[5], row[6]), Band(row[7], row[8]),
        Band(row[9], row[10]), row[11], row[12], row[13], row[14], row[15], row[16], row[17], row[18],
    )  # fmt: skip


@compiled
def along_the_curve(trace: Any, cycle: int, computer: Any, curve: Any, fronts_mm: Any, trusted: Any, out: Any) -> Any:
    """Match the yaw rate's average, which is some cycles old; a fix is carried on to now by the wheel (P2, P3)."""
    motion = computer.known.motion
    trusted_cycles = curve.trusted_cycles + 1 if motion.trusted else 0
    then = cycle - LATE_CYCLES
    if curve.feature >= len(trace.features) or then < 0:
        return computer, Curve(curve.feature, curve.detection, trusted_cycles)
    readings = Turning(
        fronts_mm[then], trusted[then], trace.wheel.numbers[then], trace.way.numbers[then], trace.yaw.valid[then],
        trace.yaw.numbers[then], False, 0,
    )  # fmt: skip
    detection = note_yaw(SENSORS, feature_at(trace.features[curve.feature]), curve.detection, readings)
    if detection.stage == FIXED and trusted_cycles > LATE_CYCLES and motion.loss == LOCATED:
        since_mm = trace.way.numbers[cycle] - trace.way.numbers[then]
        error_mm = way_error_mm(SENSORS, since_mm)
        least_mm = detection.fix_least_mm + since_mm - error_mm
        most_mm = detection.fix_most_mm + since_mm + error_mm
        computer = note_fix(computer, least_mm, most_mm)
        out[tally.FEATURES_FIXED] += 1
        out[tally.FIX_BROKEN] += not least_mm <= trace.head_m[cycle] * 1000 <= most_mm
        out[tally.CONTRADICTED] += computer.known.motion.loss == CONTRADICTED
    if is_over(detection):
        out[tally.FEATURES_FAILED] += curve.detection.stage != FIXED
        return computer, Curve(curve.feature + 1, AWAITED, trusted_cycles)
    return computer, Curve(curve.feature, detection, trusted_cycles)


@compiled
def from_the_tail(trace: Any, cycle: int) -> Any:
    """What has come from the tail at the end of a cycle, and how old it is (P5, P6)."""
    told = max(trace.source[cycle], 0)
    return Telegram(
        Acceleration(trace.force.numbers[told], trace.force.valid[told]),
        trace.arrived[cycle],
        Acceleration(trace.left.numbers[told], trace.left.valid[told]),
        Acceleration(trace.right.numbers[told], trace.right.valid[told]),
        trace.age_ms[cycle],
    )


@compiled
def is_it_whole(trace: Any, cycle: int, wholeness: Any, apart: Any, out: Any) -> Any:
    """Compare head and tail, each at the time of the tail's measurement (P5, P6)."""
    told = max(trace.source[cycle], 0)
    left_mm_s2, right_mm_s2 = trace.left.numbers[told], trace.right.numbers[told]
    truth_mm_s2 = (trace.tail_gain_m_s2[told] + trace.tail_slope_m_s2[told]) * 1000
    parted, first_seen, streak = cycle >= trace.parted_at, apart.first_seen, 0
    if told + 1 < trace.parted_at:
        off_mm_s2 = max(abs(left_mm_s2 - truth_mm_s2), abs(right_mm_s2 - truth_mm_s2))
        out[tally.TAIL_BROKEN] += trace.arrived[cycle] and off_mm_s2 > onboard.TAIL_MOST_MM_S2
    intact = is_intact(SPLIT_LIMITS, wholeness)
    out[tally.NOT_INTACT] += apart.was_intact and not intact
    if wholeness.split and first_seen < 0:
        first_seen = cycle
        out[tally.SPLIT_FOUND] = 1
        out[tally.FALSE_SPLITS] = not parted
    if parted:
        slope = trace.slope_m_s2[cycle] - trace.tail_slope_m_s2[cycle]
        differs_mm_s2 = abs(trace.gain_m_s2[cycle] - trace.tail_gain_m_s2[cycle] + slope) * 1000
        streak = apart.streak + 1 if differs_mm_s2 > SPLIT_LIMITS.threshold_mm_s2 + onboard.SPLIT_ERROR_MM_S2 else 0
        out[tally.SPLIT_UNSEEN] += streak > onboard.UNSEEN_CYCLES and intact
    return Apart(intact, streak, first_seen)


@compiled
def compare(trace: Any, cycle: int, motion: Any, length: Any, out: Any) -> None:
    """Hold what is claimed against the truth (P1, P4, P7)."""
    if motion.loss != LOCATED:
        return
    front_mm, speed_mm_s = trace.head_m[cycle] * 1000, trace.speed_m_s[cycle] * 1000
    out[tally.FRONT_OUTSIDE] += not motion.front_least_mm <= front_mm <= motion.front_most_mm
    out[tally.SPEED_OUTSIDE] += not motion.speed_least_mm_s - 0.01 <= speed_mm_s <= motion.speed_most_mm_s + 0.01
    if cycle < trace.parted_at:
        used_mm = length_mm(LENGTH_BOUNDS, length)
        out[tally.REAR_OUTSIDE] += rear_least_mm(motion, used_mm) > front_mm - LENGTH_MM
        out[tally.LENGTH_SHORT] += used_mm < LENGTH_MM
    out[tally.WIDEST_MM] = max(out[tally.WIDEST_MM], motion.front_most_mm - motion.front_least_mm)


@compiled
def with_end(computer: Any, end_mm: int) -> Any:
    """The computer of a train at rest, with an end of authority that came without orders (T12)."""
    most_mm = computer.known.motion.front_most_mm
    return Computer(
        computer.known, computer.before, computer.from_mm, computer.spacing, computer.length,
        take_end(BRAKE, computer.brake, most_mm, 0, end_mm), computer.head, computer.tail,
    )  # fmt: skip


@compiled
def with_watch(computer: Any, watch: Any) -> Any:
    """The computer of a train whose brake has been on for so long (T12)."""
    known = computer.known
    return Computer(
        Known(
            known.motion, watch, known.movement, known.limit, known.wholeness, known.window, known.ahead, known.ceiling,
        ),
        computer.before, computer.from_mm, computer.spacing, computer.length, computer.brake,
        computer.head, computer.tail,
    )  # fmt: skip


@compiled
def inspected(computer: Any) -> Any:
    """Staff has found train, brake and antennas sound; it was held for longer than is counted yet (P5, T12, T13)."""
    watch = computer.known.watch
    held = with_watch(computer, BrakeWatch(watch.limit_mm_s, BRAKE.response_cycles, watch.broken))
    told = inspect_brake(LIMITS, made_up(LIMITS, mend_tail(LIMITS, mend_head(LIMITS, held))))
    sound = told.known.watch
    return with_watch(told, BrakeWatch(sound.limit_mm_s, watch.cycles, sound.broken))


@compiled
def ride(trace: Any, out: Any) -> Any:
    """Ride one train to the end of its trace, or 10 km, or the stop after a split; give the last cycle and computer."""
    start_mm = int(trace.head_m[0] * 1000)
    computer = put_into_service(LIMITS, NO_CEILING, start_mm - STARTS_WITHIN_MM, start_mm + STARTS_WITHIN_MM)
    computer = with_end(inspected(computer), start_mm + FAR_MM)
    ends, apart = Ends(0, 0), Apart(False, 0, -1)
    curve, anchor_m, cycle = Curve(0, AWAITED, 0), trace.head_m[0], 0
    fronts_mm, trusted = np.empty(len(trace.head_m), np.int64), np.empty(len(trace.head_m), np.bool_)
    for cycle in range(len(trace.head_m)):
        was_overdue = computer.known.window.passed
        computer = decide(LIMITS, computer, True, True)
        out[tally.TAG_OVERDUE] += computer.known.window.passed and not was_overdue
        readings = Readings(
            100,
            trace.wheel.valid[cycle] and trace.way.valid[cycle],
            trace.wheel.numbers[cycle],
            trace.way.numbers[cycle],
            trace.force.valid[cycle],
            trace.force.numbers[cycle],
        )
        before = computer.known.motion
        computer = sense(LIMITS, computer, readings, from_the_tail(trace, cycle))
        motion = computer.known.motion
        hold_assumptions(trace, cycle, before, motion, readings, anchor_m, out)
        out[tally.UNTRUSTED] += before.trusted and not motion.trusted
        out[tally.SLIP_CYCLES] += not motion.trusted
        fronts_mm[cycle], trusted[cycle] = motion.front_least_mm, motion.trusted
        counted_from = anchor(motion)
        computer, ends = at_the_ends(trace, cycle, computer, ends, out)
        computer, curve = along_the_curve(trace, cycle, computer, curve, fronts_mm, trusted, out)
        motion = computer.known.motion
        if anchor(motion) != counted_from or not (before.trusted and motion.trusted):
            anchor_m = trace.head_m[cycle]
        apart = is_it_whole(trace, cycle, computer.known.wholeness, apart, out)
        compare(trace, cycle, motion, computer.length, out)
        if (trace.head_m[cycle] - trace.head_m[0]) >= LEAST_WAY_M or computer.known.wholeness.split:
            break
    out[tally.CYCLES], out[tally.WAY_MM] = cycle + 1, int((trace.head_m[cycle] - trace.head_m[0]) * 1000)
    out[tally.PARTED] = cycle >= trace.parted_at
    if apart.first_seen >= trace.parted_at:
        out[tally.SEEN_AFTER_CYCLES] = apart.first_seen - trace.parted_at
    return cycle, computer
