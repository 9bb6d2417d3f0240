"""Paper 001, 4.3.1: fixes by curves, from the sensor models by the kernel's odometry and feature matching (P1-P3)."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, replace

import numpy as np

from kernel.onboard import feature as machine
from kernel.onboard import odometry
from kernel.onboard.feature import AWAITED, Detection, Feature, Progress, Readings
from models.reproduce.tables import wilson
from models.sensors import track as tracks
from models.sensors.curves import AVERAGED, Registering, averaged, registered
from models.sensors.draws import Singles
from models.sensors.faults import BOUNDS, Floats
from models.sensors.traces import Setup, Traces, traces
from models.sensors.track import Places, Track

FAILS_SLOW, FAILS_BAND, FAILS_SLIP, FAILS_OTHER = "too slow", "curvature out of band", "wheel not trusted", "other"
LINES_FOR_A_DEVIATION = 10
REASONS = (FAILS_SLOW, FAILS_BAND, FAILS_SLIP, FAILS_OTHER)


@dataclass(frozen=True)
class Awaited:
    """One feature as passed by one run: as registered, and from which cycle to which it is looked for."""

    track: Track
    run: int
    feature: Feature
    first: int
    last: int
    curve: tracks.Feature


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


SURVEYS = 4
"""Runs over a line before its features are registered: the paper shows four over one place (figure 9)."""
FIRST_SURVEY = 1_000_000
"""Survey runs have numbers of their own, so that no run that is counted chose its features."""


@dataclass(frozen=True)
class Watched:
    """Some runs on one line with what odometry said in each cycle, without fixes: lists, by run and cycle."""

    track: Track
    made: Traces
    front_least_mm: list[list[int]]
    rolling: list[list[bool]]
    speed_mm_s: list[list[int]]
    way_mm: list[list[int]]
    located: bool


def watch(track: Track, made: Traces, length_m: float) -> Watched:
    """Run the kernel's odometry over some runs (P1, P7)."""
    sensors, (runs, cycles) = made.sensors, made.truth.head_m.shape
    least, rolling, located = [], [], True
    columns = [
        each.tolist()
        for each in (
            *(sensors.wheel_mm_s.valid & sensors.wheel_way_mm.valid, sensors.wheel_mm_s.numbers),
            *(sensors.wheel_way_mm.numbers, sensors.force_mm_s2.valid, sensors.force_mm_s2.numbers),
        )
    ]
    start_mm = round(1000 * (length_m + 50.0))
    for run in range(runs):
        motion = odometry.located(start_mm - 1_000, start_mm + 1_000, 0)
        fronts, trusted = [], []
        for wheel, speed, way, inertial, force in zip(*(column[run] for column in columns), strict=True):
            motion = odometry.note_cycle(BOUNDS, motion, odometry.Readings(100, wheel, speed, way, inertial, force))
            fronts.append(motion.front_least_mm)
            trusted.append(motion.trusted)
        located = located and odometry.is_located(motion)
        least.append(fronts)
        rolling.append(trusted)
    assert cycles == len(least[0])
    return Watched(track, made, least, rolling, columns[1], columns[2], located)


def awaited(plan: Registering, watched: Watched, curves: Sequence[tracks.Feature]) -> Iterator[Awaited]:
    """Every one of these curves that can be registered and that a run passes wholly, with the cycles to look in."""
    head = watched.made.truth.head_m
    for curve in curves:
        feature = registered(plan, curve, float(watched.track.free_m_s[int(curve.end_m / tracks.GRID_M)]))
        if feature is None:
            continue
        reach = head >= feature.begin_mm / 1000
        done = head >= curve.end_m + plan.straight_m + 10.0
        for run in np.flatnonzero(done.any(axis=1)):
            first, last = int(reach[run].argmax()), int(done[run].argmax()) + 3 * AVERAGED
            if first > 0 and last + AVERAGED < head.shape[1]:
                yield Awaited(watched.track, int(run), feature, first, last, curve)


@dataclass(frozen=True)
class Line:
    """A line: its survey runs, and the runs that are counted."""

    survey: Watched
    counted: Watched


def surveyed(plan: Registering, survey: Watched, gyro: float = 1.0) -> list[tracks.Feature]:
    """The curves that are set as features: every survey run passed them, and got its fix there (P3).

    The paper says that features are set beforehand in the unit's data (2.2) and not by what rule.  Ours is what a
    railway can do: run over the line a few times, and set no feature that failed even once.
    """
    yaw, whole = averaged(yaw_of(survey, gyro), survey.made.sensors.yaw_urad_s.valid)
    fixed: dict[tracks.Feature, int] = dict.fromkeys(survey.track.features, 0)
    for one in awaited(plan, survey, survey.track.features):
        fixed[one.curve] += looked_for(plan, survey, one, yaw, whole).fixed
    return [curve for curve in survey.track.features if fixed[curve] == SURVEYS]


def looked_for(
    plan: Registering, watched: Watched, one: Awaited, yaw: Places, whole: Places, shift_mm: int = 0
) -> Outcome:
    """Let the kernel look for one feature in one run (P3).

    ``shift_mm`` is how far the sensor is behind the front: 0 at the head.  For the fix it is the head.
    """
    state, found, run, feature = AWAITED, -1, one.run, one.feature
    previous, why, speed = state, "", 0
    for cycle in range(one.first, min(one.last, len(watched.way_mm[run]))):
        speed = watched.speed_mm_s[run][cycle]
        readings = Readings(
            front_least_mm=watched_front(watched, run, cycle, one) - shift_mm,
            rolling=watched.rolling[run][cycle],
            speed_mm_s=speed,
            way_mm=watched.way_mm[run][cycle],
            yaw_valid=bool(whole[run, cycle]),
            yaw_urad_s=int(yaw[run, cycle]),
            pitch_valid=False,
            pitch_urad_s=0,
        )
        state = machine.note_cycle(BOUNDS, feature, previous, readings)
        if state.stage == Progress.EXIT_STRAIGHT and previous.stage != Progress.EXIT_STRAIGHT:
            found = cycle
        if state.stage == Progress.FAILED:
            why = reason(feature, previous, readings)
        if machine.is_over(state) or machine.has_fix(state):
            break
        previous = state
    fixed = machine.has_fix(state)
    true_m = float(watched.made.truth.head_m[run, cycle]) - shift_mm / 1000
    error_m = (state.fix_least_mm + state.fix_most_mm) / 2000 - true_m if fixed else float("nan")
    half_m = (state.fix_most_mm - state.fix_least_mm) / 2000 if fixed else float("nan")
    contains = fixed and state.fix_least_mm <= 1000 * true_m <= state.fix_most_mm
    why = "" if fixed else why or (FAILS_SLOW if speed < feature.speed_least_mm_s else FAILS_OTHER)
    return Outcome(one, fixed, why, speed / 1000, error_m, half_m, found if fixed else -1, contains)


def watched_front(watched: Watched, run: int, cycle: int, one: Awaited) -> int:
    """The least place of the front, by the odometry from the fix or tag before: here, of what it lost since.

    The odometry has run since the beginning of the run without a fix; the unit takes fixes on its way.  So the
    way since 1 km before the feature counts: as if the last fix were there (ours).
    """
    begin = max(0, int(np.searchsorted(watched.made.truth.head_m[run], one.feature.begin_mm / 1000 - 1_000.0)) - 1)
    lost = round(1000 * float(watched.made.truth.head_m[run, begin])) - watched.front_least_mm[run][begin]
    return watched.front_least_mm[run][cycle] + lost


def reason(feature: Feature, before: Detection, readings: Readings) -> str:
    """Why the machine gave up in this cycle (P2, P3)."""
    if readings.speed_mm_s < feature.speed_least_mm_s:
        return FAILS_SLOW
    if not readings.rolling:
        return FAILS_SLIP
    if not machine.is_usable(feature, readings):
        return FAILS_OTHER
    if before.stage in (Progress.FIRST_PART, Progress.SECOND_PART, Progress.THIRD_PART):
        return FAILS_BAND
    return FAILS_BAND if not machine.is_straight(feature, readings) else FAILS_OTHER


# ---- all of it


@dataclass(frozen=True)
class Fixes:
    """All outcomes; and the runs they came from."""

    outcomes: tuple[Outcome, ...]

    @property
    def fixed(self) -> int:
        """How many gave a fix."""
        return sum(each.fixed for each in self.outcomes)

    def interval(self) -> tuple[float, float]:
        """The 95 % interval of the share of fixes: by lines, whose curves every train passes alike, if there are many.

        The deviation of a ratio of sums over lines; of fewer than ten lines, as if all outcomes were independent.
        """
        lines = {id(each.awaited.track): [0, 0] for each in self.outcomes}
        for each in self.outcomes:
            lines[id(each.awaited.track)][0] += each.fixed
            lines[id(each.awaited.track)][1] += 1
        if len(lines) < LINES_FOR_A_DEVIATION:
            return wilson(self.fixed, len(self.outcomes))
        of, count = len(self.outcomes), len(lines)
        share = self.fixed / of
        spread = sum((fixed - share * here) ** 2 for fixed, here in lines.values()) * count / (count - 1)
        off = 1.96 * spread**0.5 / of
        return max(0.0, share - off), min(1.0, share + off)

    def failed(self, why: str) -> int:
        """How many failed for one reason."""
        return sum(each.why == why for each in self.outcomes)


def journeys(seed: int, lines: int, runs: int, cycles: int, progress: Callable[[int, int, str], None]) -> list[Line]:
    """Run trains over some lines, and the odometry with them; only sound sensors, within their declared ranges."""
    made = []
    for number in range(lines):
        progress(number, lines, f"line {number + 1}")
        track = tracks.line(seed * 1_000 + number)
        setup = Setup(track, cycles, length_m=SENSORS_APART_M, present=SOUND)
        surveys = FIRST_SURVEY + number * SURVEYS
        numbers = range(surveys, surveys + SURVEYS), range(number * runs, (number + 1) * runs)
        made.append(Line(*(watch(track, traces(setup, seed, each), SENSORS_APART_M) for each in numbers)))
    return made


SENSORS_APART_M = 100.0
"""Between the sensors of a train of 120 m: its length less one vehicle's of 20 m (paper, 4.3.2: six cars)."""
SOUND = dict.fromkeys(("tachometer_silent_at_s", "tachometer_stuck_at_s", "inertial_nan_at_s", "split_at_s"), 1e9)
"""No sensor fails in the paper's test runs; slip and slide, spikes, noise and drift are as declared."""


def fixes(plan: Registering, lines: Sequence[Line], most: int, gyro: float = 1.0, everywhere: bool = False) -> Fixes:
    """Look for the first so many features; ``gyro`` scales every error of the gyros.

    ``everywhere``: every curve that can be registered is, whatever the survey found.
    """
    found: list[Outcome] = []
    for line in lines:
        if len(found) >= most:
            break
        each = line.counted
        curves = each.track.features if everywhere else surveyed(plan, line.survey, gyro)
        yaw, whole = averaged(yaw_of(each, gyro), each.made.sensors.yaw_urad_s.valid)
        for one in awaited(plan, each, curves):
            if len(found) < most:
                found.append(looked_for(plan, each, one, yaw, whole))
    return Fixes(tuple(found))


def yaw_of(watched: Watched, gyro: float) -> Places:
    """The head's yaw rate with the gyro's errors scaled."""
    measured = watched.made.sensors.yaw_urad_s.numbers.astype(np.int64)
    if gyro == 1.0:
        return measured
    true = true_yaw(watched, 0.0)
    return np.asarray(np.rint(true + gyro * (measured - true)).astype(np.int64))


def true_yaw(watched: Watched, behind_m: float) -> Floats:
    """The true yaw rate, in µrad/s, of a vehicle so far behind the head."""
    truth = watched.made.truth
    curvature: Singles = tracks.read(
        watched.track.curvature_per_m, tracks.spots(watched.track, truth.head_m - behind_m)
    )
    return np.asarray(1e6 * truth.speed_m_s.astype(np.float64) * curvature)


def changed(plan: Registering, name: str, by: float) -> Registering:
    """The plan with one value scaled."""
    return replace(plan, **{name: getattr(plan, name) * by})
