"""The written limits of a train's machines: do they fit one another, and what was measured and surveyed (P1, P5, T12)?

They are checked before a computer goes into service: what each machine is proved to do rests on it.
"""

from __future__ import annotations

from dataclasses import dataclass

from kernel.onboard import braking
from kernel.onboard.antenna_spacing import SpacingLimits
from kernel.onboard.arithmetic import LONGEST_CYCLE_MS, SHORTEST_CYCLE_MS
from kernel.onboard.brake_demand import TrainLimits
from kernel.onboard.braking import BrakeBounds
from kernel.onboard.odometry import SensorBounds
from kernel.onboard.reverse_movement import ReverseLimits
from kernel.onboard.split import SplitLimits
from kernel.onboard.tag_fix import TagLimits
from kernel.onboard.tag_reader import ReaderLimits
from kernel.onboard.tag_window import WindowLimits
from kernel.onboard.train_length import GREATEST_MEASURE_MM, LengthBounds


@dataclass(frozen=True)
class Limits:
    """What is written of the train, its sensors and its line, for each machine.

    ``antennas_mm``: from the head's antenna to the tail's, as preset (T3).
    ``length``: how the train's length is measured; the length of ``train`` is the greatest that it may have.
    ``reader``: of each of the two antennas (T13, T16).
    """

    sensors: SensorBounds
    train: TrainLimits
    reverse: ReverseLimits
    split: SplitLimits
    window: WindowLimits
    tags: TagLimits
    spacing: SpacingLimits
    antennas_mm: int
    length: LengthBounds
    reader: ReaderLimits


@dataclass(frozen=True)
class Surveyed:
    """What was measured of this type of train when it was admitted, and surveyed of its line; each is 0 or more.

    ``jolt_mm_s2``: the least by which the wheel's acceleration differs from the train's when it leaves its creep (P1).
    ``pace_cycles``: a wheel that slips does not keep pace with its train for so many cycles (P1).
    ``laid_within_mm``, ``read_within_mm``: so far from its place a tag is laid, and from the tag it is read (T2).
    ``preset_within_mm``: so near to their true distance that of the antennas is preset (T3).
    ``vehicle_mm``: the shortest vehicle; no less comes off a train, or couples to it (T3).
    ``whole_mm_s2``: so far head and tail of a whole train are measured apart in the mean of 1.5 s, at the most: by
    their sensors, couplers, the tail's lag, and the longest train over the sharpest change of gradient (P5).
    ``pair_mm``: so far at the least a train rolls back from where its tail reads one tag of a boundary to where it
    reads the other, less what it rolls in a cycle (T2).
    """

    jolt_mm_s2: int
    pace_cycles: int
    laid_within_mm: int
    read_within_mm: int
    preset_within_mm: int
    vehicle_mm: int
    whole_mm_s2: int
    pair_mm: int


def are_sensors_lawful(bounds: SensorBounds, surveyed: Surveyed) -> bool:
    """Tell whether a slip stands out from threshold, sensor error and gradients, and trust takes long enough (P1)."""
    return (
        bounds.scale_ppm >= 0
        and bounds.pulse_mm >= 0
        and bounds.tachometer_mm_s >= 0
        and bounds.gradient_mm_s2 >= 0
        and bounds.slip_mm_s2 >= 0
        and bounds.inertial_mm_s2 >= 0
        and SHORTEST_CYCLE_MS * (surveyed.jolt_mm_s2 - bounds.slip_mm_s2)
        >= LONGEST_CYCLE_MS * (bounds.inertial_mm_s2 + 2 * bounds.gradient_mm_s2)
        and surveyed.pace_cycles >= 1
        and bounds.agreement_cycles >= surveyed.pace_cycles + 2
    )


def is_brake_lawful(bounds: BrakeBounds) -> bool:
    """Tell whether the brake slows the train, a cycle after its command at the soonest, and motors do not (T12).

    So it does in cycles of any length: one that slows by less than 2 mm/s² is none.  Motors are cut off before it
    responds, and add to what a descent gives.
    """
    return (
        braking.slows_mm_s2(bounds) > 0
        and 0 <= bounds.falls_mm_s2 <= bounds.gains_mm_s2
        and 0 <= bounds.cut_cycles <= bounds.response_cycles
        and bounds.response_cycles >= 1
    )


def is_one_train_written(sensors: SensorBounds, brake: BrakeBounds) -> bool:
    """Tell whether odometry and brake control are told of one train and line: neither of less than the other (P1, T12).

    What motors and gradients may give until the brake responds is no less than the train can do, on the steepest
    gradient; that gradient is no steeper than the descent written; and the least that its brake slows the train is no
    more than the most.
    """
    return (
        sensors.accelerates_mm_s2 <= brake.gains_mm_s2
        and sensors.gradient_mm_s2 <= brake.falls_mm_s2
        and brake.slows_mm_s2 <= sensors.brakes_mm_s2
    )


def is_reverse_lawful(reverse: ReverseLimits, pulse_mm: int, surveyed: Surveyed) -> bool:
    """Tell whether it is noticed that a train rolls back, before its tail reads a boundary's tags in reverse (T2).

    By a wheel that shows a twentieth and a pulse too little of it.
    """
    return reverse.roll_back_mm >= 0 and 21 * reverse.roll_back_mm + 20 * pulse_mm < 20 * surveyed.pair_mm


def are_tags_lawful(tags: TagLimits, window: WindowLimits, surveyed: Surveyed) -> bool:
    """Tell whether what is allowed a tag covers how it is laid and read, and twice that from tag to tag (T2, T5)."""
    return (
        surveyed.laid_within_mm >= 0
        and surveyed.read_within_mm >= 0
        and tags.error_mm >= surveyed.laid_within_mm + surveyed.read_within_mm
        and window.tolerance_mm >= 2 * (surveyed.laid_within_mm + surveyed.read_within_mm)
        and window.width_mm >= 0
    )


def widest_mm(tolerance_mm: int, line_mm_s: int, antennas_mm: int, surveyed: Surveyed) -> int:
    """Give how wide the range may be for the tail's reads to count: a tag that the head missed is overdue (T2, T5).

    Of what lies between the antennas the window's tolerance is taken off, the errors of tags and presetting, and what a
    train runs in the longest cycle at twice the speed of its line.
    """
    cycle_mm = 2 * LONGEST_CYCLE_MS * line_mm_s // 1000
    errors_mm = surveyed.laid_within_mm + surveyed.read_within_mm + surveyed.preset_within_mm
    return antennas_mm - tolerance_mm - errors_mm - cycle_mm - 1


def is_window_lawful(window: WindowLimits, line_mm_s: int, antennas_mm: int, surveyed: Surveyed) -> bool:
    """Tell whether a tag that the head has missed is overdue before the tail's read of it counts (T2, T5)."""
    return window.tail_width_mm <= widest_mm(window.tolerance_mm, line_mm_s, antennas_mm, surveyed)


def is_spacing_lawful(spacing: SpacingLimits, surveyed: Surveyed) -> bool:
    """Tell whether what is allowed the antennas covers presetting them and both their read windows (T3, T13).

    A vehicle that is missing is more than tolerance, read windows, width of the range and the error of presetting can
    hide together: what is known no better is not compared, and what is compared finds another antenna in the tail's
    place.
    """
    windows_mm = 2 * surveyed.read_within_mm
    return (
        surveyed.preset_within_mm >= 0
        and spacing.tolerance_mm >= surveyed.preset_within_mm + windows_mm
        and spacing.tolerance_mm + windows_mm + spacing.width_mm + surveyed.preset_within_mm < surveyed.vehicle_mm
    )


def is_length_lawful(limits: Limits, surveyed: Surveyed) -> bool:
    """Tell whether one length is written everywhere, no less than antennas and overhangs are, and may be measured (P4).

    A train that was found whole is no longer than that, however its antennas' distance was preset.  After a change of
    ends the other antenna is the head's: it lies as far behind the front.
    """
    bounds = limits.length
    return (
        bounds.line_maximum_mm == limits.train.length_mm
        and bounds.front_overhang_mm == limits.tags.antenna_mm
        and bounds.rear_overhang_mm == bounds.front_overhang_mm
        and limits.antennas_mm + surveyed.preset_within_mm + bounds.front_overhang_mm + bounds.rear_overhang_mm
        <= bounds.line_maximum_mm
        and 2 * surveyed.read_within_mm <= bounds.window_mm <= GREATEST_MEASURE_MM
        and 0 <= bounds.front_overhang_mm <= GREATEST_MEASURE_MM
        and 0 <= bounds.rear_overhang_mm <= GREATEST_MEASURE_MM
        and 0 <= bounds.last_vehicle_mm <= GREATEST_MEASURE_MM
        and bounds.width_mm <= GREATEST_MEASURE_MM
    )


def is_split_lawful(limits: SplitLimits, surveyed: Surveyed) -> bool:
    """Tell whether no limit of split detection is below zero, and the threshold leaves whole trains alone (P5)."""
    return (
        limits.threshold_mm_s2 >= surveyed.whole_mm_s2
        and surveyed.whole_mm_s2 >= 0
        and limits.shock_mm_s2 >= 0
        and limits.disagreement_mm_s2 >= 0
        and limits.gap_ms >= 0
        and limits.lost_ms >= 0
    )


def is_found_at_rest(sensors: SensorBounds, brake: BrakeBounds) -> bool:
    """Tell whether a train that stands, its sensors sound, is found standing: else it is never let go (P1, T8).

    On the steepest gradient, with the inertial sensor at its worst, the wheel still agrees; and by the time that it is
    trusted, its speed is not known so badly that a wheel which stands might be locked.
    """
    felt_mm_s2 = sensors.gradient_mm_s2 + sensors.inertial_mm_s2
    gained_mm_s = sensors.agreement_cycles * (2 * LONGEST_CYCLE_MS * felt_mm_s2 // 1000 + 2)
    return (
        sensors.accelerates_mm_s2 >= 0
        and sensors.brakes_mm_s2 >= 0
        and LONGEST_CYCLE_MS * felt_mm_s2 < SHORTEST_CYCLE_MS * sensors.slip_mm_s2
        and gained_mm_s <= sensors.locked_mm_s
        and gained_mm_s + sensors.tachometer_mm_s + 1 <= sensors.pace_mm_s
        and sensors.tachometer_mm_s + 1 <= brake.standstill_mm_s
    )


def is_reader_lawful(reader: ReaderLimits) -> bool:
    """Tell whether a gap between tags lasts a frame time or more (T16)."""
    return reader.gap_frames >= 1


def are_lawful(limits: Limits, surveyed: Surveyed) -> bool:
    """Tell whether a train may run by these limits; if not, its computer is not put into service (P1, P5, T2, T12)."""
    return (
        are_sensors_lawful(limits.sensors, surveyed)
        and is_brake_lawful(limits.train.brake)
        and is_found_at_rest(limits.sensors, limits.train.brake)
        and are_tags_lawful(limits.tags, limits.window, surveyed)
        and is_window_lawful(limits.window, limits.train.speeds.line_mm_s, limits.antennas_mm, surveyed)
        and is_spacing_lawful(limits.spacing, surveyed)
        and is_split_lawful(limits.split, surveyed)
        and is_length_lawful(limits, surveyed)
        and is_reader_lawful(limits.reader)
        and is_one_train_written(limits.sensors, limits.train.brake)
        and is_reverse_lawful(limits.reverse, limits.sensors.pulse_mm, surveyed)
    )
