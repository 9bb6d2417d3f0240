"""Paper 001, 4.3.1: fixes by curves, the sensor models run through the kernel's odometry and feature matching (P1-P3).

The unit averages yaw rates over 1.5 s (paper, table 2) and takes the average for the cycle in its middle, so that
it puts no place off; features are matched 0.7 s late, and the fix counts for that cycle.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, replace

import numpy as np

from kernel.onboard import feature as machine
from kernel.onboard import odometry
from kernel.onboard.feature import AWAITED, Band, Detection, Feature, Progress, Readings, TurnAxis
from models.reproduce.tables import wilson
from models.sensors import track as tracks
from models.sensors.draws import Singles
from models.sensors.faults import BOUNDS, CYCLE_S, Floats
from models.sensors.traces import Setup, Traces, traces
from models.sensors.track import Places, Track

AVERAGED = 15
MIDDLE = AVERAGED // 2
"""The moving average of 1.5 s in cycles (paper 001, table 2), and how far back its middle is."""
LINES_FOR_A_DEVIATION = 10
TOLD_APART = 3.0
"""A curve has so many times the curvature that noise shows at the least speed, or it is not registered."""
FAILS_SLOW, FAILS_BAND, FAILS_SLIP, FAILS_OTHER = "too slow", "curvature out of band", "wheel not trusted", "other"
REASONS = (FAILS_SLOW, FAILS_BAND, FAILS_SLIP, FAILS_OTHER)


@dataclass(frozen=True)
class Plan:
    """How curves are registered; each value with its reason (P3).

    ``speed_least_m_s``: 45 km/h; a gentle transition needs more.
    ``noise_rad_s``: what is allowed for in the averaged yaw rate: 4 deviations of the worst declared sway over 15
    samples, 4 × 4 × 0.15, the worst bias, 0.4, and drift, 0.3 mrad/s.
    ``sensor_m``: what the sensors may put a curve's end off by: no more than the odometer after a kilometre (ours).
    From it comes the speed that the feature needs: there, noise shows what the transition gains in so many m.
    ``band_share``: what is allowed for in the registered curvature: survey, gyro scale, wheel scale.
    ``straight_m``: seen before and after.  ``margin_m``: between the parts, for half the averaging at 130 km/h.
    ``share``: curves are registered where an average driver, who takes so much of the allowed speed, is fast enough;
    ``traction_m_s2``: also after the nearest stop, at the mean of the declared gains.  What nobody passes
    fast enough is of no use.  ``everywhere``: they are registered all the same.
    ``length_m``: tolerance of the curve's length: twice the sensor's, and a cycle's way, about.
    ``cycle_m``: a cycle's way at 130 km/h (paper, table 2).
    """

    speed_least_m_s: float = 12.5
    noise_rad_s: float = 0.0031
    sensor_m: float = 8.0
    band_share: float = 0.05
    straight_m: float = 50.0
    margin_m: float = 28.0
    share: float = 0.86
    traction_m_s2: float = 0.65
    everywhere: bool = False
    length_m: float = 17.0
    cycle_m: float = 3.61

    def speed_needed_m_s(self, curve: tracks.Feature) -> float:
        """The least speed at which the curve's end is found to within the sensor's error."""
        gains_per_m2 = abs(curve.curvature_per_m) / (curve.full_m - curve.begin_m)
        return max(self.speed_least_m_s, self.noise_rad_s / (gains_per_m2 * self.sensor_m))


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


def smeared_m(straight_m: float, speed_m_s: float) -> float:
    """How far behind a transition's end the averaged curvature falls to what counts as straight (P3).

    ``straight_m``: how far before the end the true one does.  The average is over a way of 2 h, h at either side;
    where that reaches beyond the end, the average of a ramp that ends is s (h - x)² / 4 h at x behind it.
    """
    half_m = AVERAGED * CYCLE_S / 2 * speed_m_s
    return -straight_m if half_m <= straight_m else half_m - 2 * (half_m * straight_m) ** 0.5


def registered(plan: Plan, curve: tracks.Feature, most_m_s: float = tracks.LINE_SPEED_M_S) -> Feature | None:
    """Register a curve as a feature of the line, or leave it out: too like a straight, too fast, or too short (P3).

    ``most_m_s``: the highest speed there.  The average smears a curve's ends, the more the faster; so the middle
    between the least and the highest speed is registered, and half the difference is in the error.
    """
    speed_m_s, full = plan.speed_needed_m_s(curve), abs(curve.curvature_per_m)
    straight = plan.noise_rad_s / speed_m_s
    if curve.vertical or full < TOLD_APART * straight or speed_m_s > most_m_s:
        return None
    straight_m = (curve.full_m - curve.begin_m) * straight / full
    smears = [smeared_m(straight_m, each) for each in (speed_m_s, most_m_s)]
    begin_m, end_m = curve.begin_m - sum(smears) / 2, curve.end_m + sum(smears) / 2
    error_m = plan.sensor_m + plan.cycle_m + abs(smears[1] - smears[0]) / 2
    second_m = curve.full_m - begin_m + plan.margin_m
    third_m = curve.ease_m - begin_m - plan.margin_m
    if third_m - second_m < 30.0:
        return None
    half = straight + plan.band_share * full
    bent, part = (full - half, full + half), (0.0, full + half)
    sign = 1 if curve.curvature_per_m > 0 else -1
    return Feature(
        axis=TurnAxis.YAW,
        begin_mm=round(1000 * (curve.begin_m - plan.straight_m - 90.0)),
        end_mm=round(1000 * end_m),
        end_error_mm=round(1000 * error_m),
        straight=band(-straight, straight, 1),
        first=band(*part, sign),
        second=band(*bent, sign),
        third=band(*part, sign),
        second_from_mm=round(1000 * second_m),
        third_from_mm=round(1000 * third_m),
        entry_least_mm=round(1000 * plan.straight_m),
        exit_least_mm=round(1000 * plan.straight_m),
        exit_most_mm=round(1000 * (plan.straight_m + 4.0)),
        length_least_mm=round(1000 * (end_m - begin_m - plan.length_m)),
        length_most_mm=round(1000 * (end_m - begin_m + plan.length_m)),
        speed_least_mm_s=round(1000 * speed_m_s),
    )


def fast_enough(plan: Plan, track: Track, feature: Feature) -> bool:
    """Tell whether an average train, allowed to stop at each stop, passes the whole feature fast enough (P3)."""
    if plan.everywhere:
        return True
    begin_m, end_m = feature.begin_mm / 1000, feature.end_mm / 1000 + plan.straight_m
    speed_m_s = feature.speed_least_mm_s / 1000
    gains_m = speed_m_s**2 / (2 * plan.traction_m_s2)
    near = (track.stops_m > begin_m - gains_m) & (track.stops_m < end_m)
    grid = slice(max(0, int(begin_m / tracks.GRID_M)), int(end_m / tracks.GRID_M) + 1)
    return not near.any() and bool((plan.share * track.allowed_m_s[grid] >= speed_m_s).all())


def band(least_per_m: float, most_per_m: float, sign: int) -> Band:
    """A band in 1/10**6 m; for a curve to the right it is mirrored."""
    ends = sorted((round(sign * 1e6 * least_per_m), round(sign * 1e6 * most_per_m)))
    return Band(ends[0], ends[1])


# ---- what the unit makes of the readings


def averaged(values: Places, valid: np.ndarray[tuple[int, ...], np.dtype[np.bool_]]) -> tuple[Places, Places]:
    """The mean over 15 cycles for the one in the middle, and whether all 15 were valid (paper, table 2)."""
    sums = np.cumsum(np.pad(values.astype(np.int64), ((0, 0), (AVERAGED, 0))), axis=1)
    total = sums[:, AVERAGED:] - sums[:, :-AVERAGED]
    good = np.cumsum(np.pad(valid.astype(np.int64), ((0, 0), (AVERAGED, 0))), axis=1)
    mean, whole = np.zeros_like(total), np.zeros_like(total)
    mean[:, :-MIDDLE] = (np.rint(total / AVERAGED)).astype(np.int64)[:, MIDDLE:]
    whole[:, :-MIDDLE] = (good[:, AVERAGED:] - good[:, :-AVERAGED])[:, MIDDLE:] == AVERAGED
    return mean, whole


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


def awaited(plan: Plan, watched: Watched) -> Iterator[Awaited]:
    """Every registered curve that a run passes wholly, with the cycles in which it is looked for."""
    head = watched.made.truth.head_m
    for curve in watched.track.features:
        feature = registered(plan, curve, float(watched.track.free_m_s[int(curve.end_m / tracks.GRID_M)]))
        if feature is None or not fast_enough(plan, watched.track, feature):
            continue
        reach = head >= feature.begin_mm / 1000
        done = head >= curve.end_m + plan.straight_m + 10.0
        for run in np.flatnonzero(done.any(axis=1)):
            first, last = int(reach[run].argmax()), int(done[run].argmax()) + 3 * AVERAGED
            if first > 0 and last + AVERAGED < head.shape[1]:
                yield Awaited(watched.track, int(run), feature, first, last, curve)


def looked_for(plan: Plan, watched: Watched, one: Awaited, yaw: Places, whole: Places, shift_mm: int = 0) -> Outcome:
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


def journeys(seed: int, lines: int, runs: int, cycles: int, progress: Callable[[int, int, str], None]) -> list[Watched]:
    """Run trains over some lines, and the odometry with them; only sound sensors, within their declared ranges."""
    made = []
    for number in range(lines):
        progress(number, lines, f"line {number + 1}")
        track = tracks.line(seed * 1_000 + number)
        setup = Setup(track, cycles, length_m=SENSORS_APART_M, present=SOUND)
        made.append(watch(track, traces(setup, seed, range(number * runs, (number + 1) * runs)), SENSORS_APART_M))
    return made


SENSORS_APART_M = 100.0
"""Between the sensors of a train of 120 m: its length less one vehicle's of 20 m (paper, 4.3.2: six cars)."""
SOUND = dict.fromkeys(("tachometer_silent_at_s", "tachometer_stuck_at_s", "inertial_nan_at_s", "split_at_s"), 1e9)
"""No sensor fails in the paper's test runs; slip and slide, spikes, noise and drift are as declared."""


def fixes(plan: Plan, watched: Sequence[Watched], most: int, gyro: float = 1.0) -> Fixes:
    """Look for the first so many features; ``gyro`` scales every error of the gyros."""
    found: list[Outcome] = []
    for each in watched:
        yaw, whole = averaged(yaw_of(each, gyro), each.made.sensors.yaw_urad_s.valid)
        for one in awaited(plan, each):
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


def changed(plan: Plan, name: str, by: float) -> Plan:
    """The plan with one value scaled."""
    return replace(plan, **{name: getattr(plan, name) * by})
