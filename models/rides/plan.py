"""What every ride of a campaign has in common: bounds that the machines reckon with, and how rides are made."""

from __future__ import annotations

from dataclasses import dataclass

from kernel.onboard.antenna_spacing import SpacingLimits
from kernel.onboard.arithmetic import CYCLE_MS
from kernel.onboard.braking import BrakeBounds
from kernel.onboard.limits import Surveyed
from kernel.onboard.odometry import SensorBounds
from kernel.onboard.reverse_movement import ReverseLimits
from kernel.onboard.speed_limit import SpeedTable
from kernel.onboard.split import SplitLimits
from kernel.onboard.tag_reader import ReaderLimits
from kernel.onboard.tag_window import WindowLimits
from kernel.onboard.train_length import LengthBounds
from models.layouts import measures
from models.sensors.faults import BOUNDS, SPLIT_LIMITS
from models.sensors.tag_reader import AIR_MS, ASKS_MS, WINDOW_MM, Reader

LINE_M = 13_000.0
"""Long enough that a train gets 10 km from where it began."""
LEAST_WAY_M = 10_000.0
"""A ride that gets less far is counted apart."""
CYCLES = 9_000
"""Fifteen minutes: nearly every train has run 10 km by then."""
LENGTH_MM = 120_000
"""The paper's train of six cars (001, 4.3.2)."""
TAG_ERROR_MM = 300
"""How far from the plan a tag may be, and be read: half the window of 513 mm, and 43 mm of laying."""
ROLLS_MM_S = 3_500
"""Faster than this no train rolls back within some metres of an ascent that it can stand on."""
SURVEYED = Surveyed(
    jolt_mm_s2=5_000,
    pace_cycles=BOUNDS.agreement_cycles - 2,
    laid_within_mm=43,
    read_within_mm=TAG_ERROR_MM - 43,
    preset_within_mm=80,
    vehicle_mm=20_000,
    whole_mm_s2=506,
    pair_mm=2 * measures.TAG_MM - measures.WINDOW_MM - ROLLS_MM_S * CYCLE_MS // 1000,
)
"""What the limits below are checked against: the least declared jolt of a slip, the two parts of a tag's error, how
near the antennas' distance is preset, the shortest vehicle, the sum that the split threshold has to cover, and a
boundary's two tags less a window and what a train rolls back in a cycle."""

READER = Reader(WINDOW_MM, AIR_MS, 2.0, ASKS_MS, 0.0)
"""A reader that receives 4 frames at the line's speed, as two of four needs; `heisoku reproduce 000` says why."""


@dataclass(frozen=True)
class Plan:
    """The parameters of the machines on board (P1, P4, P5, T5, T12, T13)."""

    sensors: SensorBounds
    split: SplitLimits
    brake: BrakeBounds
    reader: ReaderLimits
    window: WindowLimits
    spacing: SpacingLimits
    length: LengthBounds
    speeds: SpeedTable
    reverse: ReverseLimits


PLAN = Plan(
    sensors=BOUNDS,
    split=SPLIT_LIMITS,
    brake=BrakeBounds(
        gains_mm_s2=1_500, slows_mm_s2=600, response_cycles=15, standstill_mm_s=700, cut_cycles=5, falls_mm_s2=350
    ),
    reader=ReaderLimits(least_mv=800, most_mv=1_200, gap_frames=8),
    window=WindowLimits(tolerance_mm=2 * TAG_ERROR_MM, width_mm=1_000_000, tail_width_mm=25_000),
    spacing=SpacingLimits(tolerance_mm=2 * TAG_ERROR_MM, width_mm=18_000),
    length=LengthBounds(
        line_maximum_mm=200_000,
        last_vehicle_mm=20_000,
        front_overhang_mm=0,
        rear_overhang_mm=0,
        window_mm=2 * TAG_ERROR_MM,
        width_mm=20_000,
    ),
    speeds=SpeedTable(line_mm_s=50_000, curve_mm_s=50_000, turnout_mm_s=50_000),
    reverse=ReverseLimits(roll_back_mm=2_000),
)
"""Brake: an emergency brake of 0.6 m/s² at the least, net of a gradient of 35 per mille, within 1.5 s (ours).

Speeds: 180 km/h everywhere, since no layout says how fast its curves and turnouts may be run through (ours).
"""
