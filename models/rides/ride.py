"""One ride, cycle by cycle: readings into the compiled machines, what they say against the truth.

The machines' part is integer, in their units; the truth is in m and s.  numba compiles all of it.
"""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np

from models.compiled import compiled
from models.rides import onboard, tally
from models.rides.onboard import (
    AXIS_YAW,
    CONTRADICTED,
    FIXED,
    IN_WINDOW,
    KIND_TAG,
    LENGTH_BOUNDS,
    LOCATED,
    MADE,
    READER_LIMITS,
    SENSORS,
    SPACING_LIMITS,
    SPLIT_LIMITS,
    TAG_LIMITS,
    WINDOW_LIMITS,
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

located, note_readings, note_fix = MADE.odometry.located, MADE.odometry.note_cycle, MADE.odometry.note_fix
rear_least_mm = MADE.odometry.rear_least_mm
way_error_mm, Readings = MADE.odometry.way_error_mm, MADE.odometry.Readings
note_telegram, is_intact, made_up = MADE.split.note_cycle, MADE.split.is_intact, MADE.split.made_up
Acceleration, Telegram = MADE.split.Acceleration, MADE.split.Readings
note_frame, delivers, mended = MADE.tag_reader.note_frame, MADE.tag_reader.delivers, MADE.tag_reader.mended
Frame, NO_FRAME, LEVEL = MADE.tag_reader.Frame, MADE.tag_reader.NO_FRAME, MADE.tag_reader.Level(GOOD_LEVEL_MV, True)
judge, note_window, await_tag = MADE.tag_window.judge, MADE.tag_window.note_cycle, MADE.tag_window.await_tag
NONE_AWAITED = MADE.tag_window.NONE_AWAITED
note_head_read, note_tail_read = MADE.antenna_spacing.note_head_read, MADE.antenna_spacing.note_tail_read
preset, is_healthy = MADE.antenna_spacing.preset, MADE.antenna_spacing.is_healthy
note_head_pass, note_tail_pass = MADE.train_length.note_head_pass, MADE.train_length.note_tail_pass
length_mm, contradicts_the_line = MADE.train_length.length_mm, MADE.train_length.contradicts_the_line
contradicts_itself = MADE.train_length.contradicts_itself
UNMEASURED, Passing = MADE.train_length.UNMEASURED, MADE.train_length.Passing
note_yaw, is_over, AWAITED = MADE.feature.note_cycle, MADE.feature.is_over, MADE.feature.AWAITED
Feature, Band, Turning = MADE.feature.Feature, MADE.feature.Band, MADE.feature.Readings
between, Way = MADE.way.between, MADE.way.Way
place_of_read, fix_of = MADE.tag_fix.place_of_read, MADE.tag_fix.fix_of


class Ends(NamedTuple):
    """What is known of tags and length: window, last tag's place, spacing, length, readers, and which tags are next."""

    window: Any
    last_at: Any
    spacing: Any
    length: Any
    head_reader: Any
    tail_reader: Any
    next_head: int
    next_tail: int


class Curve(NamedTuple):
    """Which feature is awaited, what is known of it, and how long the wheel has been trusted."""

    feature: int
    detection: Any
    trusted_cycles: int


class Apart(NamedTuple):
    """What is known of wholeness, and since when the parts have visibly differed."""

    wholeness: Any
    was_intact: bool
    streak: int
    first_seen: int


@compiled
def place(motion: Any) -> Any:
    """Where the front is, as the machines on board tell one another."""
    return Way(motion.loss == LOCATED, motion.front_least_mm, motion.front_most_mm)


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
def passes(reader: Any, uid: int, frames: int) -> Any:
    """An antenna passes a tag: frames into the reader; is its record delivered (T16)."""
    delivered = False
    for _ in range(READER_LIMITS.gap_frames):
        reader = note_frame(READER_LIMITS, reader, NO_FRAME, LEVEL)
    for _ in range(min(frames, FRAMES_FED)):
        reader = note_frame(READER_LIMITS, reader, Frame(True, uid, 0, 0, 0), LEVEL)
        delivered = delivered or delivers(reader)
    return reader, delivered


@compiled
def passing(motion: Any, tag: int, cycle: int) -> Any:
    """What the length is measured by when an antenna has read a tag (T3)."""
    return Passing(
        KIND_TAG, tag + 1, cycle * 100, motion.loss == LOCATED, motion.front_least_mm, motion.front_most_mm,
        motion.speed_most_mm_s,
    )  # fmt: skip


@compiled
def under_the_head(trace: Any, cycle: int, before: Any, motion: Any, ends: Any, out: Any) -> Any:
    """The head's antenna passes a tag: the second loop's window, a fix, the spacing, the length (T5, T13, T3)."""
    tag = ends.next_head
    reader, delivered = passes(ends.head_reader, tag + 1, trace.tag_frames[tag])
    out[tally.TAGS_READ] += delivered
    out[tally.TAGS_MISSED] += not delivered
    if not delivered:
        return motion, Ends(
            ends.window, ends.last_at, ends.spacing, ends.length, reader, ends.tail_reader, tag + 1, ends.next_tail
        )
    was_located = motion.loss == LOCATED
    read_at = place_of_read(before, motion)
    if ends.window.expected and judge(WINDOW_LIMITS, ends.window, between(ends.last_at, read_at)) != IN_WINDOW:
        out[tally.TAG_OUTSIDE_WINDOW] += 1
    fix = fix_of(TAG_LIMITS, before, motion, trace.tags_mm[tag])
    motion = note_fix(motion, fix.least_mm, fix.most_mm)
    if was_located:
        out[tally.FIX_BROKEN] += not fix.least_mm <= trace.head_m[cycle] * 1000 <= fix.most_mm
        out[tally.CONTRADICTED] += motion.loss == CONTRADICTED
    window = NONE_AWAITED
    if tag + 1 < len(trace.tags_mm):
        away_mm = trace.tags_mm[tag + 1] - trace.tags_mm[tag]
        window = await_tag(away_mm, away_mm)
    length = note_head_pass(LENGTH_BOUNDS, ends.length, passing(motion, tag, cycle))
    read_at = place_of_read(before, motion)
    spacing = note_head_read(ends.spacing, tag + 1, read_at)
    return motion, Ends(window, read_at, spacing, length, reader, ends.tail_reader, tag + 1, ends.next_tail)


@compiled
def under_the_tail(trace: Any, cycle: int, before: Any, motion: Any, ends: Any, out: Any) -> Any:
    """The tail's antenna passes a tag: is it one antenna distance behind the head; then the length (T13, T3)."""
    tag, spacing, length = ends.next_tail, ends.spacing, ends.length
    reader, delivered = passes(ends.tail_reader, tag + 1, trace.tag_frames[tag])
    if delivered:
        spacing = note_tail_read(SPACING_LIMITS, spacing, tag + 1, place_of_read(before, motion))
        out[tally.SPACING_BROKEN] += spacing.broken
        hidden_mm = 4 * SPACING_LIMITS.tolerance_mm + 2 * (motion.front_most_mm - motion.front_least_mm)
        out[tally.FALSE_TAIL_ACCEPTED] += is_healthy(spacing) and trace.gap_m[cycle] * 1000 > hidden_mm
        if is_healthy(spacing):
            length = note_tail_pass(LENGTH_BOUNDS, length, passing(motion, tag, cycle))
            out[tally.LENGTHS] += length.measured and not ends.length.measured
            out[tally.LENGTH_CONTRADICTS] += contradicts_the_line(LENGTH_BOUNDS, length) or contradicts_itself(length)
    return Ends(ends.window, ends.last_at, spacing, length, ends.head_reader, reader, ends.next_head, tag + 1)


@compiled
def at_the_ends(trace: Any, cycle: int, before: Any, motion: Any, ends: Any, out: Any) -> Any:
    """Everything that the antennas have read in this cycle, and whether a tag is overdue (T2, T5)."""
    window = note_window(WINDOW_LIMITS, ends.window, between(ends.last_at, place(motion)))
    if window.passed:
        out[tally.TAG_OVERDUE] += 1
        window = NONE_AWAITED
    ends = Ends(
        window, ends.last_at, ends.spacing, ends.length, ends.head_reader, ends.tail_reader, ends.next_head,
        ends.next_tail,
    )  # fmt: skip
    while ends.next_head < len(trace.tags_mm) and trace.tag_cycle[ends.next_head] == cycle:
        motion, ends = under_the_head(trace, cycle, before, motion, ends, out)
    while ends.next_tail < len(trace.tags_mm) and 0 <= trace.tail_cycle[ends.next_tail] <= cycle:
        ends = under_the_tail(trace, cycle, before, motion, ends, out)
    return motion, ends


@compiled
def feature_at(row: Any) -> Any:
    """A feature of the line, from its numbers."""
    return Feature(
        AXIS_YAW, row[0], row[1], row[2], Band(row[3], row[4]), Band(row[5], row[6]), Band(row[7], row[8]),
        Band(row[9], row[10]), row[11], row[12], row[13], row[14], row[15], row[16], row[17], row[18],
    )  # fmt: skip


@compiled
def along_the_curve(trace: Any, cycle: int, motion: Any, curve: Any, fronts_mm: Any, trusted: Any, out: Any) -> Any:
    """Match the yaw rate's average, which is some cycles old; a fix is carried on to now by the wheel (P2, P3)."""
    trusted_cycles = curve.trusted_cycles + 1 if motion.trusted else 0
    then = cycle - LATE_CYCLES
    if curve.feature >= len(trace.features) or then < 0:
        return motion, Curve(curve.feature, curve.detection, trusted_cycles)
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
        motion = note_fix(motion, least_mm, most_mm)
        out[tally.FEATURES_FIXED] += 1
        out[tally.FIX_BROKEN] += not least_mm <= trace.head_m[cycle] * 1000 <= most_mm
        out[tally.CONTRADICTED] += motion.loss == CONTRADICTED
    if is_over(detection):
        out[tally.FEATURES_FAILED] += curve.detection.stage != FIXED
        return motion, Curve(curve.feature + 1, AWAITED, trusted_cycles)
    return motion, Curve(curve.feature, detection, trusted_cycles)


@compiled
def is_it_whole(trace: Any, cycle: int, apart: Any, out: Any) -> Any:
    """Compare head and tail, each at the time of the tail's measurement (P5, P6)."""
    told = max(trace.source[cycle], 0)
    left_mm_s2, right_mm_s2 = trace.left.numbers[told], trace.right.numbers[told]
    wholeness = note_telegram(
        SPLIT_LIMITS,
        apart.wholeness,
        Telegram(
            Acceleration(trace.force.numbers[told], trace.force.valid[told]),
            trace.arrived[cycle],
            Acceleration(left_mm_s2, trace.left.valid[told]),
            Acceleration(right_mm_s2, trace.right.valid[told]),
            trace.age_ms[cycle],
        ),
    )
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
    return Apart(wholeness, intact, streak, first_seen)


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
def ride(trace: Any, out: Any) -> Any:
    """Ride one train to the end of its trace, or 10 km, or the stop after a split; give the last cycle and motion."""
    start_mm = int(trace.head_m[0] * 1000)
    motion = located(start_mm - STARTS_WITHIN_MM, start_mm + STARTS_WITHIN_MM, 0)
    ends = Ends(NONE_AWAITED, Way(False, 0, 0), preset(LENGTH_MM), UNMEASURED, mended(), mended(), 0, 0)
    apart = Apart(made_up(SPLIT_LIMITS), False, 0, -1)
    curve, anchor_m, cycle = Curve(0, AWAITED, 0), trace.head_m[0], 0
    fronts_mm, trusted = np.empty(len(trace.head_m), np.int64), np.empty(len(trace.head_m), np.bool_)
    for cycle in range(len(trace.head_m)):
        readings = Readings(
            100,
            trace.wheel.valid[cycle] and trace.way.valid[cycle],
            trace.wheel.numbers[cycle],
            trace.way.numbers[cycle],
            trace.force.valid[cycle],
            trace.force.numbers[cycle],
        )
        before = motion
        motion = note_readings(SENSORS, motion, readings)
        hold_assumptions(trace, cycle, before, motion, readings, anchor_m, out)
        out[tally.UNTRUSTED] += before.trusted and not motion.trusted
        out[tally.SLIP_CYCLES] += not motion.trusted
        fronts_mm[cycle], trusted[cycle] = motion.front_least_mm, motion.trusted
        counted_from = anchor(motion)
        motion, ends = at_the_ends(trace, cycle, before, motion, ends, out)
        motion, curve = along_the_curve(trace, cycle, motion, curve, fronts_mm, trusted, out)
        if anchor(motion) != counted_from or not (before.trusted and motion.trusted):
            anchor_m = trace.head_m[cycle]
        apart = is_it_whole(trace, cycle, apart, out)
        compare(trace, cycle, motion, ends.length, out)
        if (trace.head_m[cycle] - trace.head_m[0]) >= LEAST_WAY_M or apart.wholeness.split:
            break
    out[tally.CYCLES], out[tally.WAY_MM] = cycle + 1, int((trace.head_m[cycle] - trace.head_m[0]) * 1000)
    out[tally.PARTED] = cycle >= trace.parted_at
    if apart.first_seen >= trace.parted_at:
        out[tally.SEEN_AFTER_CYCLES] = apart.first_seen - trace.parted_at
    return cycle, motion
