"""Every error and fault of a sensor as a parameter with a declared range, as data (P1, P5, P8, T16).

A range says how bad a sound sensor may be: the kernel's bounds below are sums of such ends, and what is
proved holds within them.  A campaign draws a parameter within its range, or, told so by name, between
the range's end and ``beyond``, to see that the oracles notice.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from kernel.onboard.odometry import SensorBounds
from kernel.onboard.split import SplitLimits

Floats = npt.NDArray[np.float64]

GRAVITY_M_S2 = 9.80665
"""Standard gravity."""
CYCLE_S = 0.1
"""Sampled every 100 ms (paper 001, table 2)."""


@dataclass(frozen=True)
class Fault:
    """One parameter of a sensor, in the unit that its name ends with.

    ``least`` to ``most``: the declared range.  ``beyond``: how far a campaign may go to break it.
    ``bound``: the kernel's bound, or machine, that reckons with the declared range.
    ``source``: where the range comes from.
    ``chance``: the share of runs that have it at all; the others have ``absent``.
    """

    name: str
    unit: str
    least: float
    most: float
    beyond: float
    bound: str
    source: str
    chance: float = 1.0
    absent: float = 0.0


def _fault(
    name: str,
    unit: str,
    ends: tuple[float, float, float],
    bound: str,
    source: str,
    chance: float = 1.0,
    absent: float = 0.0,
) -> Fault:
    least, most, beyond = ends
    return Fault(name, unit, least, most, beyond, bound, source, chance, absent)


NEVER = 1e9
"""A time, in s, that no run reaches."""
_OURS_TYPICAL = "ours, typical of"

FAULTS: tuple[Fault, ...] = (
    # ---- the driver and the train
    _fault("driver_share", "1", (0.75, 0.97, 1.0), "none: any driving is allowed",
           "ours: drivers stay some way below the allowed speed"),
    _fault("traction_m_s2", "m/s2", (0.4, 0.9, 1.0), "odometry.accelerates_mm_s2",
           f"{_OURS_TYPICAL} suburban trains, 2.0 to 3.3 km/h/s"),
    _fault("braking_m_s2", "m/s2", (0.5, 1.0, 1.3), "odometry.brakes_mm_s2",
           f"{_OURS_TYPICAL} service brakes, 1.8 to 3.6 km/h/s"),
    _fault("dwell_s", "s", (20.0, 60.0, 600.0), "none: any stay is allowed", f"{_OURS_TYPICAL} stops"),
    _fault("lag_s", "s", (0.0, 0.3, 3.0), "split.threshold_mm_s2",
           "ours: couplers pass a change on within about 0.1 s a 100 m; brake pipes are slower"),
    # ---- wheel and tachometer
    _fault("creep_ppm", "ppm", (0.0, 5_000.0, 20_000.0), "odometry.scale_ppm",
           "physical: rolling contact transmits its force by creep of some tenths of a per cent"),
    _fault("diameter_ppm", "ppm", (-2_500.0, 2_500.0, 20_000.0), "odometry.scale_ppm",
           "ours: 2 mm of a wheel of 860 mm between two settings of the diameter"),
    _fault("slip_at_s", "s", (5.0, 400.0, 400.0), "odometry: a jolt of slip_mm_s2 and more",
           "ours: anywhere in the run", 0.3, NEVER),
    _fault("slip_jolt_m_s2", "m/s2", (5.0, 15.0, 0.2), "odometry.slip_mm_s2 + inertial_mm_s2 + 2 gradient_mm_s2",
           "physical: beyond the peak adhesion falls, and the axle's surplus torque runs it away"),
    _fault("slip_lasts_s", "s", (0.5, 8.0, 60.0), "none: any duration is allowed",
           f"{_OURS_TYPICAL} re-adhesion control and wheel slide protection"),
    _fault("slip_speed_m_s", "m/s", (-8.0, 8.0, 30.0), "none: any difference is allowed",
           "ours: below 0 it slides, above it slips"),
    _fault("tachometer_silent_at_s", "s", (5.0, 400.0, 400.0), "odometry: not valid, the inertial sensor carries on",
           "ours: a cable or a sensor lost, and found by its own diagnosis", 0.05, NEVER),
    _fault("tachometer_silent_s", "s", (0.1, 20.0, 400.0), "none: any duration is allowed", "ours"),
    _fault("tachometer_stuck_at_s", "s", (5.0, 400.0, 400.0), "odometry: a speed without pulses is no reading",
           "ours: the last value is repeated, and called valid", 0.02, NEVER),
    _fault("tachometer_stuck_s", "s", (0.1, 5.0, 60.0), "as above", "ours"),
    # ---- inertial sensors: of the head, of the tail's left, of its right
    *(
        each
        for place in ("head", "left", "right")
        for each in (
            _fault(f"{place}_bias_m_s2", "m/s2", (-0.02, 0.02, 0.5), "odometry.inertial_mm_s2",
                   f"{_OURS_TYPICAL} MEMS accelerometers, 2 mg over temperature"),
            _fault(f"{place}_walk_m_s2", "m/s2", (0.0, 0.0003, 0.01), "odometry.inertial_mm_s2",
                   f"{_OURS_TYPICAL} MEMS bias instability, each second, bounded below"),
            _fault(f"{place}_noise_m_s2", "m/s2", (0.005, 0.03, 0.3), "odometry.inertial_mm_s2, cut at 4 deviations",
                   "ours: a vehicle's vibration after the sensor's own filter; the chip's noise is a tenth"),
            _fault(f"{place}_mounting_rad", "rad", (-0.0035, 0.0035, 0.05), "odometry.inertial_mm_s2",
                   "ours: fitted to 0.2 degrees"),
            _fault(f"{place}_scale_ppm", "ppm", (-3_000.0, 3_000.0, 50_000.0), "odometry.inertial_mm_s2",
                   f"{_OURS_TYPICAL} MEMS accelerometers"),
        )
    ),
    _fault("gyro_bias_rad_s", "rad/s", (-0.0004, 0.0004, 0.02), "the feature's curvature band",
           f"{_OURS_TYPICAL} MEMS gyros zeroed at each standstill, 80 degrees/h"),
    _fault("gyro_walk_rad_s", "rad/s", (0.0, 0.00001, 0.001), "the feature's curvature band",
           f"{_OURS_TYPICAL} MEMS gyros, each second"),
    _fault("gyro_noise_rad_s", "rad/s", (0.001, 0.004, 0.02), "the feature's curvature band, cut at 4 deviations",
           "physical: 1.5 to 6 mm of sway at bogies 14 m apart, at 1 Hz; the chip's noise is a tenth"),
    _fault("gyro_scale_ppm", "ppm", (-5_000.0, 5_000.0, 50_000.0), "the feature's curvature band",
           f"{_OURS_TYPICAL} MEMS gyros"),
    _fault("spike_at_s", "s", (5.0, 400.0, 400.0), "split.shock_mm_s2, odometry.slip_mm_s2",
           "ours: one sample", 0.1, NEVER),
    _fault("spike_m_s2", "m/s2", (-0.1, 0.1, 200.0), "split.shock_mm_s2",
           "ours: a joint or a crossing struck hard; beyond it, one that looks like a shock"),
    _fault("inertial_stuck_at_s", "s", (400.0, 400.0, 5.0), "none: a stuck sensor called valid is beyond",
           "ours: never, within the declared range", 0.0, NEVER),
    _fault("inertial_nan_at_s", "s", (5.0, 400.0, 400.0), "edge: no number is no reading", "ours", 0.05, NEVER),
    _fault("inertial_nan_s", "s", (0.1, 5.0, 400.0), "none: any duration is allowed", "ours"),
    # ---- split
    _fault("split_at_s", "s", (5.0, 400.0, 400.0), "split", "ours: anywhere in the run", 0.1, NEVER),
    _fault("split_slows_m_s2", "m/s2", (0.6, 1.3, 0.0), "split.threshold_mm_s2",
           "physical: a parted brake pipe or loop brakes the tail; beyond it, a tail that only coasts"),
    _fault("split_shock_m_s2", "m/s2", (0.0, 10.0, 50.0), "split.shock_mm_s2", "ours: a coupler breaks under load"),
    # ---- tags and their reader
    _fault("window_share", "1", (0.85, 1.0, 0.3), "tag_reader", "paper 000, 6.4: slightly fewer frames on a train"),
    _fault("frame_errors", "1", (0.0, 0.05, 0.9), "tag_reader",
           "ours: CRC failures in noise; the paper counts no frame as lost on the stand"),
    # ---- clocks and transmission
    _fault("clock_offset_ms", "ms", (-5.0, 5.0, 500.0), "split.age_ms",
           f"{_OURS_TYPICAL} GPS time over a serial line, without the pulse each second"),
    _fault("clock_jitter_ms", "ms", (0.0, 2.0, 50.0), "split.age_ms", "ours: the processor's interrupt latency"),
    _fault("clock_drift_ppm", "ppm", (-20.0, 20.0, 200.0), "split.age_ms", f"{_OURS_TYPICAL} quartz, in an outage"),
    _fault("clock_out_at_s", "s", (5.0, 400.0, 400.0), "split.age_ms", "ours: a tunnel", 0.3, NEVER),
    _fault("clock_out_s", "s", (1.0, 200.0, 400.0), "split.age_ms", "ours: a tunnel of 4 km at 72 km/h"),
    _fault("delay_s", "s", (0.1, 0.3, 2.0), "split.age_ms", "ours: one to three cycles of radio and processing"),
    _fault("loss", "1", (0.0, 0.1, 0.9), "split.gap_ms", "ours: each sending, independently"),
    _fault("radio_out_at_s", "s", (5.0, 400.0, 400.0), "split.gap_ms, split.lost_ms", "ours: shadowing", 0.1, NEVER),
    _fault("radio_out_s", "s", (0.1, 3.0, 60.0), "split.lost_ms", "ours"),
    # ---- an approach to an end of authority, the driver not braking
    _fault("approach_margin_m", "m", (0.0, 500.0, 5_000.0), "none: any end is allowed", "ours"),
    _fault("approach_gains_m_s2", "m/s2", (0.0, 1.4, 4.0), "braking.gains_mm_s2",
           "physical: motors of 1.05 m/s2 and a descent of 35 per mille, 0.35"),
    _fault("approach_slows_m_s2", "m/s2", (0.62, 1.3, 0.1), "braking.slows_mm_s2",
           f"{_OURS_TYPICAL} emergency brakes of 1.1 m/s2 less a descent of 35 per mille, on wet rails"),
    _fault("approach_responds_s", "s", (0.3, 1.4, 8.0), "braking.response_cycles",
           f"{_OURS_TYPICAL} electropneumatic brakes"),
    _fault("approach_gradient_permille", "permille", (-35.0, 35.0, 150.0), "odometry.gradient_mm_s2",
           "the technical standard's limit for ordinary railways' electric trains"),
    _fault("approach_slides_s", "s", (0.0, 6.0, 60.0), "none: at any moment", "ours: under the brake", 0.3, NEVER),
    # ---- drawn from numbers of their own, so that the rides on record stay what they are otherwise
    _fault("rolls_back_at_s", "s", (5.0, 400.0, 400.0), "reverse_movement: at the next start",
           "ours: a brake released on an ascent before the motors pull", 0.1, NEVER),
    _fault("rolls_back_m", "m", (0.1, 1.8, 20.0), "reverse_movement.roll_back_mm, 2,000, less creep and a pulse",
           "ours: what a driver catches at once; beyond it, one that rolls on or drives back"),
    _fault("pair_lost_at_s", "s", (5.0, 400.0, 400.0), "tag_window: both tags of the next boundary are overdue",
           "ours: covered by ballast or snow, or torn off by what hung down", 0.05, NEVER),
    _fault("pulses_lost_at_s", "s", (400.0, 400.0, 5.0), "odometry.scale_ppm: lost pulses are beyond it",
           "ours: never, within the declared range; a worn toothed wheel, a gap too wide", 0.0, NEVER),
    _fault("pulses_lost_s", "s", (5.0, 60.0, 400.0), "none: any duration is allowed", "ours"),
    _fault("pulses_lost_share", "1", (0.02, 0.5, 1.0), "as above", "ours: one tooth of 60 is 0.017"),
    _fault("pulses_extra_at_s", "s", (400.0, 400.0, 5.0), "odometry.scale_ppm: extra pulses are beyond it",
           "ours: never, within the declared range; interference of the motors' current", 0.0, NEVER),
    _fault("pulses_extra_s", "s", (5.0, 60.0, 400.0), "none: any duration is allowed", "ours"),
    _fault("pulses_extra_share", "1", (0.02, 0.5, 1.0), "as above", "ours"),
    _fault("diameter_entered_mm", "mm", (0.0, 0.0, 80.0), "odometry.scale_ppm: a wrong entry is beyond it",
           "practice: a worn wheel of 780 mm entered as a new one of 860, or the other way"),
    _fault("slow_slide_at_s", "s", (400.0, 400.0, 5.0), "odometry: a wheel that slips leaves with a jolt",
           "ours: never, within the declared range; slide protection that holds a slip", 0.0, NEVER),
    _fault("slow_slide_m_s2", "m/s2", (0.1, 0.8, 0.8), "odometry.slip_mm_s2 + inertial_mm_s2",
           "ours: so much faster than its train the wheel slows down at first"),
    _fault("slow_slide_share", "1", (0.05, 0.3, 0.9), "as above", f"{_OURS_TYPICAL} held slip, 10 to 25 per cent"),
    _fault("slow_slide_s", "s", (5.0, 40.0, 400.0), "none: any duration is allowed", "ours"),
    _fault("crosstalk_at_s", "s", (400.0, 400.0, 5.0), "the survey (P3): an antenna reads its own track's tags alone",
           "ours: never, within the declared range; tracks lie 3.4 m and more apart, an antenna reads within 0.3 m",
           0.0, NEVER),
    _fault("crosstalk_m", "m", (-60.0, 60.0, 200.0), "as above",
           "ours: so far off the neighbouring track's tags lie by the kilometrage of their own track"),
    *(
        _fault(f"{place}_reversed", "1", (0.0, 0.0, 1.0), "odometry.inertial_mm_s2, split.threshold_mm_s2",
               "practice: fitted with its front to the back; any value but 0 is this")
        for place in ("head", "left", "right")
    ),
)  # fmt: skip
"""What a campaign draws, in this order."""

FIRST_OF_THEIR_OWN = next(place for place, fault in enumerate(FAULTS) if fault.name == "rolls_back_at_s")
"""From here on parameters are drawn from numbers of their own."""

PLACE = {fault.name: place for place, fault in enumerate(FAULTS)}

WALK_MOST_M_S2 = 0.02
"""A drift walks no farther than this within its declared range (ours: the accelerometer's bias stability)."""
NOISE_MOST = 4.0
"""Noise is cut at so many deviations: sensors filter and clip, and a bound must be a bound."""

BOUNDS = SensorBounds(
    scale_ppm=8_000,
    pulse_mm=46,
    tachometer_mm_s=600,
    inertial_mm_s2=360,
    gradient_mm_s2=350,
    gradient_rate_mm_s2=5,
    slip_mm_s2=1_000,
    accelerates_mm_s2=1_500,
    brakes_mm_s2=1_700,
    agreement_cycles=20,
    pace_mm_s=40_000,
    locked_mm_s=3_000,
)
"""The odometry's bounds for these ranges.

Scale: creep and diameter, 5,000 + 2,500, and their product.  Pulse: 60 a turn of a wheel of 860 mm.
Speed: the first pulse after a standstill comes late (450 mm/s), or the mean over a cycle (65 mm/s at 1.3 m/s²).
Inertial: bias 20, drift 20, noise 4 × 30, mounting 34, scale 5, the lag of a cycle.  Gradient: 35 per mille.
Slip: leaves noise, half a cycle's lag and quantisation apart.
Pace: what the range of speeds has grown to by inertia in half a minute.  Locked: in 2 s of agreement at rest, and
1 s before them, either way; a wheel may well stay locked under a faster train.
"""

SPLIT_LIMITS = SplitLimits(
    threshold_mm_s2=510,
    shock_mm_s2=3_000,
    disagreement_mm_s2=500,
    age_ms=600,
    gap_ms=1_000,
    lost_ms=10_000,
)
"""The split machine's limits for these ranges.

Threshold: bias, drift, mounting and scale of both ends, 2 × 79; the mean of their noise over 15 samples,
3 deviations, 50; one change of gradient between head and tail, 12 per mille, 118; the tail's lag of 0.3 s
while the head goes from traction to coasting, 0.9 × 0.3 / 1.5 m/s², 180: 506 in all.  The head's acceleration is
that of the time at which the tail measured, by GPS time.
Shock: above the declared spike of 2 m/s² and what a train does itself.
"""


def drawn(
    uniforms: Floats, beyond: Iterable[str] = (), present: Mapping[str, float] | None = None
) -> dict[str, Floats]:
    """Turn uniform numbers, shape (runs, parameters, 2), into the value of every parameter for every run.

    ``beyond`` names those drawn from beyond their declared range, in every run: of a fault that comes at a time
    (``slip_at_s``) it then comes in every run (``slip_jolt_m_s2``).  ``present`` sets some outright.

    Raises:
        KeyError: a name is no parameter's.
    """
    values = {}
    outside, fixed = frozenset(beyond), present or {}
    for unknown in sorted((outside | set(fixed)) - set(PLACE)):
        raise KeyError(unknown)
    for place, fault in enumerate(FAULTS):
        share, happens = uniforms[:, place, 0], uniforms[:, place, 1]
        if fault.name in fixed:
            values[fault.name] = np.full(len(uniforms), float(fixed[fault.name]))
        elif fault.name in outside:
            values[fault.name] = _beyond(fault, share)
        else:
            value = fault.least + share * (fault.most - fault.least)
            comes = any(name.startswith(fault.name.removesuffix("at_s")) for name in outside)
            chance = 1.0 if comes and fault.name.endswith("_at_s") else fault.chance
            values[fault.name] = np.where(happens < chance, value, fault.absent)
    return values


def _beyond(fault: Fault, share: Floats) -> Floats:
    """From the end of the range that lies towards ``beyond`` on; of a range around 0, or of 0 alone, on both sides."""
    if fault.least < 0 < fault.beyond or fault.least == fault.most == 0:
        side = np.where(share < 0.5, -1.0, 1.0)
        return side * (fault.most + (2 * share % 1) * (fault.beyond - fault.most))
    end = fault.most if fault.beyond >= fault.most else fault.least
    return end + share * (fault.beyond - end)


def quiet() -> dict[str, float]:
    """Every error at its smallest and no fault at all: what a perfect train and perfect sensors show."""
    return {
        fault.name: fault.absent if fault.chance < 1 else min(max(0.0, fault.least), fault.most) for fault in FAULTS
    }


def names(faults: Sequence[Fault] = FAULTS) -> tuple[str, ...]:
    """The names of all parameters, in the order in which they are drawn."""
    return tuple(fault.name for fault in faults)
