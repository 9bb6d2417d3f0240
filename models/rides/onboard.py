"""The compiled machines that rides go through, and their parameters."""

from __future__ import annotations

from kernel.onboard import (
    antenna_spacing,
    brake_demand,
    brake_watch,
    braking,
    ceiling,
    computer,
    feature,
    odometry,
    restriction_ahead,
    reverse_movement,
    speed_limit,
    split,
    tag_reader,
    tag_window,
    train_length,
)
from kernel.onboard.brake_demand import TrainLimits
from kernel.onboard.limits import Limits
from kernel.onboard.odometry import Loss
from kernel.onboard.tag_fix import TagLimits
from models.compiled import compile_machines, compiled, packed
from models.rides.plan import LENGTH_MM, PLAN, TAG_ERROR_MM

MADE = compile_machines(
    (
        antenna_spacing,
        brake_demand,
        brake_watch,
        braking,
        ceiling,
        computer,
        feature,
        odometry,
        restriction_ahead,
        reverse_movement,
        speed_limit,
        split,
        tag_reader,
        tag_window,
        train_length,
    )
)
"""Each function is compiled when it is first called."""

ON_BOARD = Limits(
    sensors=PLAN.sensors,
    train=TrainLimits(PLAN.brake, PLAN.speeds, PLAN.length.line_maximum_mm),
    reverse=PLAN.reverse,
    split=PLAN.split,
    window=PLAN.window,
    tags=TagLimits(antenna_mm=0, error_mm=TAG_ERROR_MM),
    spacing=PLAN.spacing,
    antennas_mm=LENGTH_MM,
    length=PLAN.length,
    reader=PLAN.reader,
)
"""What is written of the rides' train; its antennas are at its very ends."""
LIMITS = packed(ON_BOARD)
SENSORS = packed(PLAN.sensors)
SPLIT_LIMITS = packed(PLAN.split)
BRAKE = packed(PLAN.brake)
SPACING_LIMITS = packed(PLAN.spacing)
LENGTH_BOUNDS = packed(PLAN.length)

LOCATED = packed(Loss.NONE)
CONTRADICTED = packed(Loss.CONTRADICTED)
FIXED = packed(feature.Progress.FIXED)
AXIS_YAW = packed(feature.TurnAxis.YAW)

SPLIT_ERROR_MM_S2 = 260
"""What the errors of head and tail may hide of a difference: bias, drift, mounting and scale, 2 × 79, noise 50."""
UNSEEN_CYCLES = PLAN.split.age_ms // 100 + PLAN.split.gap_ms // 100 + split.SAMPLES
"""The declared bound: 1.5 s of samples, an old telegram, and a gap that is still tolerated."""
TAIL_MOST_MM_S2 = 79 + 4 * 30 + 1
"""The most that a tail sensor may be off: bias, drift, mounting, scale, and noise of four deviations."""


# ---- the declared bounds of a rolling wheel, as `models.onboard.odometry` states them


@compiled
def speed_bound_mm_s(tachometer_mm_s: int) -> float:
    """How far the speed of a rolling wheel may be from the train's, by the declared bounds (P1)."""
    return float(abs(tachometer_mm_s) * SENSORS.scale_ppm / 1_000_000 + SENSORS.tachometer_mm_s)


@compiled
def way_bound_mm(since_mm: int) -> float:
    """How far the pulses of a rolling wheel may be from the way that the train ran, by the declared bounds (P1)."""
    return float(abs(since_mm) * SENSORS.scale_ppm / 1_000_000 + SENSORS.pulse_mm)
