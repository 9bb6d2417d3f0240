"""Trains that run over a line from end to end, and the kernel's odometry and feature matching in each (P1-P3).

Place on board is the odometer's from the beginning of the run, put right by the fixes that were made and by no
others (paper 001, 2.2.3).
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

import numpy as np

from kernel.onboard import feature as machine
from kernel.onboard import odometry
from kernel.onboard.feature import AWAITED, Detection, Feature, Progress, Readings
from models.sensors import track as tracks
from models.sensors.curves import AVERAGED, Registering, averaged, registered
from models.sensors.draws import Singles
from models.sensors.dynamics import START_M, Bools
from models.sensors.faults import BOUNDS, Floats
from models.sensors.traces import Setup, Whole, traces
from models.sensors.track import Ints, Places, Track

FAILS_SLOW, FAILS_BAND, FAILS_SLIP, FAILS_OTHER = "too slow", "curvature out of band", "wheel not trusted", "other"
REASONS = (FAILS_SLOW, FAILS_BAND, FAILS_SLIP, FAILS_OTHER)

LINE_M = 10_000.0
"""Ours, typical: what an average train runs in some ten minutes."""
CYCLES = 12_000
"""So long that the slowest declared train reaches the end of any line: curves of 300 m all along at 46 km/h, 760 s;
four stops of 60 s; five times 32 s for braking and starting; 1,160 s in all."""
BEYOND_M = 100.0
"""A run is watched until its head is so far beyond the last curve, and the average over it is known."""
SENSORS_APART_M = 100.0
"""Between the sensors of a train of 120 m: its length less one vehicle's of 20 m (paper, 4.3.2: six cars)."""
SOUND = dict.fromkeys(
    ("tachometer_silent_at_s", "tachometer_stuck_at_s", "inertial_nan_at_s", "split_at_s", "rolls_back_at_s"), 1e9
)
"""No sensor fails and no train rolls back in the paper's test runs; slip and slide, spikes, noise and drift are as
declared."""


# ---- runs


@dataclass(frozen=True)
class Runs:
    """Some runs on one line, truth and readings, arrays of shape (runs, cycles).

    ``ends``: in each run, the cycle from which on nothing is looked for any more.
    ``yaw_urad_s``, ``tail_yaw_urad_s``: not averaged; all 15 cycles must be valid for an average.
    """

    track: Track
    ends: Places
    head_m: Floats
    speed_m_s: Singles
    wheel_valid: Bools
    speed_mm_s: Ints
    way_mm: Ints
    force: Whole
    yaw: Whole
    tail_yaw: Whole

    def readings(self, run: int) -> Iterator[odometry.Readings]:
        """What odometry is told in each cycle of a run (P1)."""
        columns = (self.wheel_valid, self.speed_mm_s, self.way_mm, self.force.valid, self.force.numbers)
        listed = [column[run, : self.ends[run]].tolist() for column in columns]
        for wheel, speed, way, inertial, force in zip(*listed, strict=True):
            yield odometry.Readings(100, wheel, speed, way, inertial, force)


def runs_on(track: Track, seed: int, numbers: Sequence[int]) -> Runs:
    """Run these trains over the whole line; only sound sensors, within their declared ranges (P8)."""
    made = traces(Setup(track, CYCLES, length_m=SENSORS_APART_M, present=SOUND), seed, numbers)
    truth, sensors = made.truth, made.sensors
    beyond = truth.head_m >= max(each.end_m for each in track.features) + BEYOND_M
    assert beyond.any(axis=1).all(), "a train did not reach the end of its line"
    ends = beyond.argmax(axis=1) + 3 * AVERAGED
    until = slice(int(ends.max()) + AVERAGED)
    force, yaw, tail_yaw = (
        Whole(each.numbers[:, until].copy(), each.valid[:, until].copy())
        for each in (sensors.force_mm_s2, sensors.yaw_urad_s, sensors.tail_yaw_urad_s)
    )
    return Runs(
        track=track,
        ends=ends,
        head_m=truth.head_m[:, until].copy(),
        speed_m_s=truth.speed_m_s[:, until].copy(),
        wheel_valid=sensors.wheel_mm_s.valid[:, until] & sensors.wheel_way_mm.valid[:, until],
        speed_mm_s=sensors.wheel_mm_s.numbers[:, until].copy(),
        way_mm=sensors.wheel_way_mm.numbers[:, until].copy(),
        force=force,
        yaw=yaw,
        tail_yaw=tail_yaw,
    )


# ---- features in them


@dataclass(frozen=True)
class Awaited:
    """One feature as passed by one run: as registered, and from which cycle to which it is looked for."""

    track: Track
    run: int
    feature: Feature
    first: int
    last: int
    curve: tracks.Feature


def awaited(plan: Registering, runs: Runs, curves: Sequence[tracks.Feature]) -> Iterator[Awaited]:
    """Every one of these curves that can be registered, in every run, with the cycles to look in.

    Left out is what lies so near the beginning of the line that trains start within it.
    """
    for curve in curves:
        feature = registered(plan, curve, float(runs.track.free_m_s[int(curve.end_m / tracks.GRID_M)]))
        if feature is None or feature.begin_mm / 1000 <= SENSORS_APART_M + START_M:
            continue
        reach = runs.head_m >= feature.begin_mm / 1000
        done = runs.head_m >= curve.end_m + plan.straight_m + 10.0
        for run in range(len(reach)):
            first, last = int(reach[run].argmax()), int(done[run].argmax()) + 3 * AVERAGED
            yield Awaited(runs.track, run, feature, first, last, curve)


@dataclass(frozen=True)
class Outcome:
    """What became of one feature: the machine's end, why it failed, the fix's error and half width in m."""

    awaited: Awaited
    fixed: bool
    why: str
    speed_m_s: float
    error_m: float
    half_m: float
    found: int
    """The cycle in which the curve's end was found, -1 if none was."""
    contains: bool


def reason(feature: Feature, before: Detection, readings: Readings, late: str) -> str:
    """Why the machine gave up in this cycle, or did not begin in it (P2, P3).

    ``late``: why detection had not begun where it should: it then begins in the curve, or too near to it.
    """
    if readings.speed_mm_s < feature.speed_least_mm_s:
        return FAILS_SLOW
    if not readings.rolling:
        return FAILS_SLIP
    if not machine.is_usable(feature, readings):
        return FAILS_OTHER
    if before.stage == Progress.WAITING:
        return late or FAILS_OTHER
    if before.stage == Progress.ENTRY_STRAIGHT:
        return late if late and readings.way_mm - before.from_mm < feature.entry_least_mm else FAILS_BAND
    if before.stage in (Progress.FIRST_PART, Progress.SECOND_PART, Progress.THIRD_PART):
        return FAILS_BAND
    return FAILS_BAND if not machine.is_straight(feature, readings) else FAILS_OTHER


class Looking:
    """The kernel looks for one feature in one run, cycle by cycle (P3).

    ``shift_mm``: how far the sensor is behind the front, 0 at the head.  For the fix it is the head.
    """

    def __init__(self, runs: Runs, one: Awaited, yaw: Places, whole: Places, shift_mm: int = 0) -> None:
        self.one, self.state, self.found = one, AWAITED, -1
        self._shift_mm, self._cycle, self._late, self._why = shift_mm, one.first, "", ""
        columns = (runs.speed_mm_s, runs.way_mm, whole, yaw, runs.head_m)
        self._speed_mm_s, self._way_mm, self._whole, self._yaw, self._head_m = (
            column[one.run, one.first : one.last].tolist() for column in columns
        )

    @property
    def is_over(self) -> bool:
        """Whether there is a fix in this cycle, or will be none any more."""
        return machine.is_over(self.state) or machine.has_fix(self.state)

    def note(self, cycle: int, front_least_mm: int, rolling: bool) -> None:
        """Take one cycle: the least place of the front and whether the wheel is trusted, by odometry."""
        feature, before, since = self.one.feature, self.state, cycle - self.one.first
        readings = Readings(
            front_least_mm=front_least_mm - self._shift_mm,
            rolling=rolling,
            speed_mm_s=self._speed_mm_s[since],
            way_mm=self._way_mm[since],
            yaw_valid=bool(self._whole[since]),
            yaw_urad_s=self._yaw[since],
            pitch_valid=False,
            pitch_urad_s=0,
        )
        self._cycle, self.state = cycle, machine.note_cycle(BOUNDS, feature, before, readings)
        stage = self.state.stage
        if stage == Progress.WAITING and feature.begin_mm <= readings.front_least_mm:
            self._late = reason(feature, before, readings, "")
        if stage == Progress.EXIT_STRAIGHT and before.stage != Progress.EXIT_STRAIGHT:
            self.found = cycle
        if stage == Progress.FAILED:
            self._why = reason(feature, before, readings, self._late)

    def outcome(self) -> Outcome:
        """What became of it."""
        state, fixed, since = self.state, machine.has_fix(self.state), self._cycle - self.one.first
        speed_mm_s, true_m = self._speed_mm_s[since], self._head_m[since] - self._shift_mm / 1000
        error_m = (state.fix_least_mm + state.fix_most_mm) / 2000 - true_m if fixed else float("nan")
        half_m = (state.fix_most_mm - state.fix_least_mm) / 2000 if fixed else float("nan")
        contains = fixed and state.fix_least_mm <= 1000 * true_m <= state.fix_most_mm
        slow = FAILS_SLOW if speed_mm_s < self.one.feature.speed_least_mm_s else FAILS_OTHER
        why = "" if fixed else self._why or self._late or slow
        return Outcome(self.one, fixed, why, speed_mm_s / 1000, error_m, half_m, self.found if fixed else -1, contains)


# ---- the kernel in them


@dataclass(frozen=True)
class Ridden:
    """Some runs with what odometry said in each cycle, lists by run, and what became of the features awaited."""

    runs: Runs
    front_least_mm: list[list[int]]
    rolling: list[list[bool]]
    outcomes: tuple[Outcome, ...]


def ride(runs: Runs, features: Sequence[Awaited], yaw: Places, whole: Places) -> Ridden:
    """Run the kernel's odometry over some runs, look for these features, and take each fix where it is made (P1-P3).

    The train knows to a metre where it starts (ours).
    """
    fronts: list[list[int]] = []
    rolling: list[list[bool]] = []
    begun: list[Looking] = []
    start_mm = round(1000 * (SENSORS_APART_M + START_M))
    for run in range(len(runs.ends)):
        ahead = sorted((one for one in features if one.run == run), key=lambda one: -one.first)
        motion = odometry.located(start_mm - 1_000, start_mm + 1_000, 0)
        looking: list[Looking] = []
        least, trusted = [], []
        for cycle, readings in enumerate(runs.readings(run)):
            motion = odometry.note_cycle(BOUNDS, motion, readings)
            while ahead and ahead[-1].first <= cycle:
                looking.append(Looking(runs, ahead.pop(), yaw, whole))
                begun.append(looking[-1])
            for each in looking:
                each.note(cycle, motion.front_least_mm, motion.trusted)
                if machine.has_fix(each.state):
                    motion = odometry.note_fix(motion, each.state.fix_least_mm, each.state.fix_most_mm)
            looking = [each for each in looking if not each.is_over and cycle + 1 < each.one.last]
            least.append(motion.front_least_mm)
            trusted.append(motion.trusted)
        fronts.append(least)
        rolling.append(trusted)
    begun.sort(key=lambda each: (each.one.curve.begin_m, each.one.run))
    return Ridden(runs, fronts, rolling, tuple(each.outcome() for each in begun))


def looked_for(
    ridden: Ridden, one: Awaited, yaw: Places, whole: Places, lost_mm: int = 0, shift_mm: int = 0
) -> Outcome:
    """Let the kernel look for one more feature in a run that was ridden, without taking its fix (P3).

    ``lost_mm``: how much farther on the front is known to be than by that ride's odometry.
    """
    looking = Looking(ridden.runs, one, yaw, whole, shift_mm)
    fronts, rolling = ridden.front_least_mm[one.run], ridden.rolling[one.run]
    for cycle in range(one.first, min(one.last, len(fronts))):
        looking.note(cycle, fronts[cycle] + lost_mm, rolling[cycle])
        if looking.is_over:
            break
    return looking.outcome()


# ---- what the gyro says


def measured_yaw(runs: Runs, gyro: float = 1.0) -> tuple[Places, Places]:
    """The head's averaged yaw rate with the gyro's errors scaled, and whether it is whole."""
    measured = runs.yaw.numbers.astype(np.int64)
    if gyro != 1.0:
        true = true_yaw(runs, 0.0)
        measured = np.asarray(np.rint(true + gyro * (measured - true)).astype(np.int64))
    return averaged(measured, runs.yaw.valid)


def true_yaw(runs: Runs, behind_m: float) -> Floats:
    """The true yaw rate, in µrad/s, of a vehicle so far behind the head."""
    curvature: Singles = tracks.read(runs.track.curvature_per_m, tracks.spots(runs.track, runs.head_m - behind_m))
    return np.asarray(1e6 * runs.speed_m_s.astype(np.float64) * curvature)
