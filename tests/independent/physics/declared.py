"""What is written for the trains of this world: the kernel's limits, and the sums behind them.

The sums are made here anew, from what the trains and sensors of this world can do; nothing is taken from the models.
"""

from __future__ import annotations

from dataclasses import dataclass

from kernel.onboard.antenna_spacing import SpacingLimits
from kernel.onboard.brake_demand import TrainLimits
from kernel.onboard.braking import BrakeBounds
from kernel.onboard.limits import Limits, Surveyed
from kernel.onboard.odometry import SensorBounds
from kernel.onboard.reverse_movement import ReverseLimits
from kernel.onboard.speed_limit import SpeedTable
from kernel.onboard.split import SplitLimits
from kernel.onboard.tag_fix import TagLimits
from kernel.onboard.tag_reader import ReaderLimits
from kernel.onboard.tag_window import WindowLimits
from kernel.onboard.train_length import LengthBounds

CYCLE_MS = 100
JITTER_MS = 2
"""So much longer or shorter a cycle is at the most."""
PULSE_MM = 45.03
"""60 pulses a turn of a wheel of 860 mm."""
CREEP = 0.005
"""A rolling wheel turns by so much more or less than the train runs, at full traction or braking."""
DIAMETER = 0.0025
"""So far the diameter that is entered may be from the wheel's."""
GRADIENT_MM_S2 = 343.0
"""35 per mille."""
GRADIENT_CHANGE_MM_S2 = 118.0
"""12 per mille, once within the length of a train."""
TRACTION_MM_S2 = 1_050.0
BRAKE_MM_S2 = 1_300.0
"""Both on the level; with the gradient 1,393 and 1,643."""
EMERGENCY_MM_S2 = (945.0, 1_300.0)
"""Net of the gradient 602 at the least."""
BRAKE_LAGS_S = (0.2, 1.0)
"""From the command until the brake begins to take hold; it needs 0.4 s to come on in full."""
BIAS_MM_S2, NOISE_MM_S2 = 75.0, 110.0
"""An inertial sensor's bias, drift and mounting, and its noise, cut there."""
LAID_MM, READ_MM = 43, 257
"""So far from its place a tag is laid, and from the tag it is read."""
PRESET_MM = 80
ANTENNA_MM = 2_000
"""Both antennas are so far from the ends of the train."""
VEHICLE_MM = 20_000
"""What comes off a train is a vehicle at the least."""
PAIR_MM = 7_000
"""A boundary's two tags are 8 m apart; less both windows, and what a train rolls back in a cycle."""
SLIP_RATE_MM_S2 = 4_200.0
"""A wheel leaves its creep by this at the least: a cycle that it does so in the middle of still shows half."""
PACE_S = 1.8
"""For so long a wheel that slips may keep pace with its train."""
LOCKED_MM_S = 3_000.0
"""A wheel stands only so long under a train that is no slower."""
PULSES_BELOW_MM_S = 460.0
"""A tachometer does not stick below this speed."""

SENSORS = SensorBounds(
    scale_ppm=8_000,
    pulse_mm=46,
    tachometer_mm_s=600,
    inertial_mm_s2=360,
    gradient_mm_s2=350,
    gradient_rate_mm_s2=5,
    slip_mm_s2=950,
    accelerates_mm_s2=1_500,
    brakes_mm_s2=1_700,
    agreement_cycles=20,
    pace_mm_s=40_000,
    locked_mm_s=3_000,
)
BRAKE = BrakeBounds(
    gains_mm_s2=1_500, slows_mm_s2=600, response_cycles=15, standstill_mm_s=700, cut_cycles=5, falls_mm_s2=350
)
MULTIPLE_UNIT = SplitLimits(
    threshold_mm_s2=750, shock_mm_s2=3_000, disagreement_mm_s2=500, age_ms=600, gap_ms=1_000, lost_ms=10_000
)
"""Bias and noise of both ends 2 × 75 + 20, two gradients 118, couplers 100, a lag of 0.2 s 0.2 × 2.4 / 1.5 s: 708."""
BRAKED_BY_PIPE = SplitLimits(
    threshold_mm_s2=2_000, shock_mm_s2=3_000, disagreement_mm_s2=500, age_ms=600, gap_ms=1_000, lost_ms=10_000
)
"""The same with a lag of 1 s: 1.0 × 2.4 / 1.5 s, 1,600: 1,988."""


@dataclass(frozen=True)
class Type:
    """A type of train: its length, how late its tail does what its head does, and its limits.

    ``whole_mm_s2``: so far head and tail of a whole one are measured apart in the mean of 1.5 s.
    """

    length_mm: int
    tail_lag_s: float
    split: SplitLimits
    whole_mm_s2: int

    @property
    def surveyed(self) -> Surveyed:
        """What was measured and surveyed of it."""
        return Surveyed(
            jolt_mm_s2=2_060,
            pace_cycles=18,
            laid_within_mm=LAID_MM,
            read_within_mm=READ_MM,
            preset_within_mm=PRESET_MM,
            vehicle_mm=VEHICLE_MM,
            whole_mm_s2=self.whole_mm_s2,
            pair_mm=PAIR_MM,
        )

    @property
    def limits(self) -> Limits:
        """All that is written of it."""
        return Limits(
            sensors=SENSORS,
            train=TrainLimits(BRAKE, SpeedTable(50_000, 50_000, 50_000), self.length.line_maximum_mm),
            reverse=ReverseLimits(roll_back_mm=2_000),
            split=self.split,
            window=WindowLimits(tolerance_mm=2 * (LAID_MM + READ_MM), width_mm=1_000_000, tail_width_mm=25_000),
            tags=TagLimits(antenna_mm=ANTENNA_MM, error_mm=LAID_MM + READ_MM),
            spacing=SpacingLimits(tolerance_mm=PRESET_MM + 2 * READ_MM, width_mm=18_500),
            antennas_mm=self.length_mm - 2 * ANTENNA_MM,
            length=self.length,
            reader=ReaderLimits(least_mv=900, most_mv=1_100, gap_frames=6),
        )

    @property
    def length(self) -> LengthBounds:
        """What is written of how its length is measured."""
        return LengthBounds(
            line_maximum_mm=self.length_mm + PRESET_MM,
            last_vehicle_mm=VEHICLE_MM,
            front_overhang_mm=ANTENNA_MM,
            rear_overhang_mm=ANTENNA_MM,
            window_mm=2 * READ_MM,
            width_mm=20_000,
        )


TYPES = (
    Type(60_000, 0.05, MULTIPLE_UNIT, 708),
    Type(120_000, 0.2, MULTIPLE_UNIT, 708),
    Type(360_000, 1.0, BRAKED_BY_PIPE, 1_988),
)
