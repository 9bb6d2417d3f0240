"""Paper 001, tachometer and inertial sensors: fixes, train length, its errors, and splits (P1-P6, P8)."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import replace

import numpy as np

from kernel.onboard import split as split_machine
from kernel.onboard.split import Acceleration, Readings
from models.reproduce import lengths, splits
from models.reproduce.fixes import SURVEYS, Fixes, Line, changed, first, fixes, journeys, ridden
from models.reproduce.lengths import Measured, budget
from models.reproduce.passing import LINE_M, REASONS, Ridden
from models.reproduce.tables import Picture, Reproduction, Row, Sensitivity, share, wilson
from models.rides.onboard import UNSEEN_CYCLES
from models.sensors.curves import Registering
from models.sensors.faults import CYCLE_S, SPLIT_LIMITS

TITLE = "position and integrity by tachometer and inertial sensors"
PAPER_FEATURES, PAPER_FIXES = 741, 699
PAPER_SHORT_M, PAPER_LONG_M, TRUE_M = 109.0, 129.0, 120.0
PAPER_ERRORS_M = (3.61, 3.61, 0.78, 5.0)
PAPER_SUM_M = 13.0
RUNS_A_LINE = 4
SPLIT_CYCLES = 6_000
"""Trains are watched for splits for ten minutes each."""
FEWER = 150
"""Sensitivities are worked out over the first so many features."""
SPLIT_RUNS = 30
FASTEST_KM_H = 130.0

Progress = Callable[[int, int, str], None]


def reproduce(seed: int, runs: int, progress: Progress) -> Reproduction:
    """Set the paper's figures beside ours, over so many runs on made-up lines, each from end to end (P8)."""
    count = max(1, min(RUNS_A_LINE, runs))
    lines = journeys(seed, max(1, runs // count), count, progress)
    plan = Registering()
    rides = []
    for number, line in enumerate(lines):
        progress(number, len(lines), f"fixes on line {number + 1}")
        rides.append(ridden(plan, line))
    found = first(rides, PAPER_FEATURES)
    everywhere = fixes(plan, lines, PAPER_FEATURES, everywhere=True)
    measured = lengths.lengths(lengths.PLAN, rides, PAPER_FEATURES, seed)
    some = min(SPLIT_RUNS, runs)
    split = _Splits(seed, some, progress)
    progress(1, 1, "sensitivities")
    return Reproduction(
        paper="001",
        title=TITLE,
        seed=seed,
        rows=(*fix_rows(found, everywhere), *length_rows(measured), *error_rows(), *split.rows()),
        sensitivities=(
            *fix_sensitivities(lines, rides, plan, seed),
            *error_sensitivities(),
            *split.sensitivities(),
        ),
        pictures=(*fix_pictures(found, everywhere), *length_pictures(measured), split.picture()),
        parameters=parameters(plan),
        counts={
            "runs": len(rides) * count,
            "lines": len(rides),
            "cycles": sum(int(each.runs.ends.sum()) for each in rides),
            "features": len(found.outcomes),
            "lengths": len(measured),
            "trains watched for splits": some,
        },
    )


# ---- fixes


def fix_rows(found: Fixes, everywhere: Fixes) -> tuple[Row, ...]:
    """Table 1.

    Which curves are set as features the paper does not say: ours are those that every survey run found.
    Beside them, every curve that somebody may pass fast enough.
    """
    ours, theirs = found.interval(), wilson(PAPER_FIXES, PAPER_FEATURES)
    overlap = ours[0] <= theirs[1] and theirs[0] <= ours[1]
    errors = [each.error_m for each in found.outcomes if each.fixed] or [float("nan")]
    outside = sum(each.fixed and not each.contains for each in (*found.outcomes, *everywhere.outcomes))
    paper = share(PAPER_FIXES, PAPER_FEATURES)
    return (
        Row(f"fixes, curves registered that {SURVEYS} survey runs found", "table 1",
            f"{paper}, 95 %: {100 * theirs[0]:.1f} to {100 * theirs[1]:.1f} %", interval(found),
            overlap, "the 95 % intervals overlap"),
        Row("fixes, every curve registered", "table 1", paper, interval(everywhere), None, "none: for comparison"),
        Row("why no fix, where surveyed", "4.3.1", "too slow; curvature out of band for moments; and others",
            causes(found), None, "by the machine's last stage, or what made it begin late"),
        Row("why no fix, every curve", "4.3.1", "too slow; curvature out of band for moments; and others",
            causes(everywhere), None, "by the machine's last stage, or what made it begin late"),
        Row("the fix contains the train's front", "4.3.1", "not given",
            f"all but {outside} of {found.fixed + everywhere.fixed}", outside == 0, "every one"),
        Row("error of a fix", "figure 9", "not given in numbers", f"{min(errors):+.1f} to {max(errors):+.1f} m", None,
            "ours"),
    )  # fmt: skip


def interval(found: Fixes) -> str:
    """The share of fixes with its 95 % interval, as text."""
    least, most = found.interval()
    return f"{rate(found)}, 95 %: {100 * least:.1f} to {100 * most:.1f} %"


def causes(found: Fixes) -> str:
    """How often each reason, as text."""
    return ", ".join(f"{found.failed(reason)} {reason}" for reason in REASONS)


def fix_sensitivities(
    lines: Sequence[Line], rides: Sequence[Ridden], plan: Registering, seed: int
) -> tuple[Sensitivity, ...]:
    """The share of fixes and the range of lengths with each decisive parameter changed."""
    made = []
    named = {
        "speed_least_m_s": ("least speed", f"{3.6 * plan.speed_least_m_s:.0f} km/h"),
        "noise_rad_s": ("yaw rate allowed for as noise", f"{1000 * plan.noise_rad_s:.1f} mrad/s"),
        "band_share": ("curvature allowed for", f"{100 * plan.band_share:.0f} %"),
        "straight_m": ("straight before and after", f"{plan.straight_m:.0f} m"),
        "sensor_m": ("error of the curve's end", f"{plan.sensor_m:.0f} m"),
        "length_m": ("tolerance of the curve's length", f"{plan.length_m:.0f} m"),
    }
    base = rate(fixes(plan, lines, FEWER))
    for name, (called, value) in named.items():
        less, more = (rate(fixes(changed(plan, name, by), lines, FEWER)) for by in (0.8, 1.2))
        made.append(Sensitivity("features with a fix", called, value, less, base, more))
    less, more = (rate(fixes(plan, lines, FEWER, by)) for by in (0.8, 1.2))
    made.append(Sensitivity("features with a fix", "all errors of the gyros", "as declared", less, base, more))
    spread = [reach(lengths.lengths(lengths.PLAN, rides, FEWER, seed, by)) for by in (0.8, 1.0, 1.2)]
    made.append(Sensitivity("raw train length", "all errors of the gyros", "as declared", *spread))
    less, more = (
        reach(lengths.lengths(changed(lengths.PLAN, "noise_rad_s", by), rides, FEWER, seed)) for by in (0.8, 1.2)
    )
    made.append(Sensitivity("raw train length", "yaw rate allowed for as noise", named["noise_rad_s"][1], less,
                            spread[1], more))  # fmt: skip
    return tuple(made)


def rate(found: Fixes) -> str:
    """The share of fixes, as text."""
    return share(found.fixed, len(found.outcomes))


def reach(found: Sequence[Measured]) -> str:
    """From the shortest to the longest, as text."""
    raw = [each.raw_m for each in found]
    return f"{min(raw):.1f} to {max(raw):.1f} m" if raw else "none"


def fix_pictures(found: Fixes, everywhere: Fixes) -> tuple[Picture, ...]:
    """The error of each fix, and at which speeds features were found and missed."""
    good = [each for each in found.outcomes if each.fixed]
    half = max((each.half_m for each in good), default=0.0)
    shares = {
        name: [
            1000 * each.speed_m_s / each.awaited.feature.speed_least_mm_s
            for each in everywhere.outcomes
            if each.why == why
        ]
        for name, why in (("fix", ""), *((f"no fix: {why}", why) for why in REASONS))
    }
    return (
        Picture(
            "001_fix_errors",
            f"Error of {len(good)} fixes by curves (place of the front, kernel less truth)",
            "speed, km/h",
            "error, m",
            points={"fix": ([3.6 * each.speed_m_s for each in good], [each.error_m for each in good])},
            levels={"widest range given": [-half, half]},
        ),
        Picture(
            "001_fixes_by_speed",
            f"{len(everywhere.outcomes)} features, every curve registered: speed where detection ended",
            "speed over the speed that the feature needs",
            "features",
            bars={name: values for name, values in shares.items() if values},
            edges=[edge / 20 for edge in range(61)],
            places={"needed": 1.0},
        ),
    )


# ---- length


def length_rows(found: Sequence[Measured]) -> tuple[Row, ...]:
    """Figure 10."""
    raw = [each.raw_m for each in found]
    used = [each.used_m for each in found]
    return (
        Row("train length measured, true 120 m", "figure 10", f"{PAPER_SHORT_M:.0f} to {PAPER_LONG_M:.0f} m",
            f"{reach(found)}, {len(found)} times",
            bool(raw) and min(raw) >= TRUE_M - PAPER_SUM_M and max(raw) <= TRUE_M + PAPER_SUM_M,
            f"within 120 ± {PAPER_SUM_M:.0f} m, as the paper's errors add up"),
        Row("train length used by the kernel", "ours", "not given",
            f"{min(used):.1f} to {max(used):.1f} m" if used else "none",
            min(used) >= TRUE_M if used else None, "never less than 120 m"),
        Row("trains measured again and found of another length", "ours", "not given",
            f"{sum(each.contradicts for each in found)} of {sum(each.again for each in found)}",
            not any(each.contradicts for each in found) if any(each.again for each in found) else None,
            "none: vehicles neither come nor go"),
    )  # fmt: skip


def length_pictures(found: Sequence[Measured]) -> tuple[Picture, ...]:
    """Figure 10, and the errors of table 2 at every speed with those measured."""
    speeds = list(range(20, 161, 5))
    budgets = [budget(speed) for speed in speeds]
    at = [3.6 * each.speed_m_s for each in found]
    return (
        Picture(
            "001_train_length",
            f"Train length measured at {len(found)} curves; true 120 m",
            "speed, km/h",
            "length, m",
            points={
                "raw, formula (3)": (at, [each.raw_m for each in found]),
                "used by the kernel": (at, [each.used_m for each in found]),
            },
            levels={"true": [TRUE_M], "paper, 109 and 129 m": [PAPER_SHORT_M, PAPER_LONG_M]},
        ),
        Picture(
            "001_error_budget",
            "Errors of the length by speed (paper's table 2 is at 130 km/h)",
            "speed, km/h",
            "error, m",
            lines={
                "total": (speeds, [each.total_m for each in budgets]),
                "sensor": (speeds, [each.sensor_m for each in budgets]),
                "sampling; start skew alike": (speeds, [each.sampling_m for each in budgets]),
                "averaging": (speeds, [each.averaging_m for each in budgets]),
            },
            points={
                "measured, raw less true": (at, [abs(each.raw_m - TRUE_M) for each in found]),
                "paper, 130 km/h": ([130.0] * 4, [PAPER_SUM_M, 5.0, 3.61, 0.78]),
            },
        ),
    )


def error_rows() -> tuple[Row, ...]:
    """Table 2."""
    ours = budget(FASTEST_KM_H)
    names = ("sampling, 100 ms", "start skew", "averaging, 1.5 s", "sensor")
    values = (ours.sampling_m, ours.skew_m, ours.averaging_m, ours.sensor_m)
    terms = (
        Row(f"length error at 130 km/h: {name}", "table 2", f"±{paper:g} m", f"±{value:.3f} m",
            abs(value - paper) < 0.01, "to a centimetre")
        for name, value, paper in zip(names, values, PAPER_ERRORS_M, strict=True)
    )  # fmt: skip
    return (
        *terms,
        Row("length error at 130 km/h: total", "table 2", f"±{PAPER_SUM_M:.0f} m", f"±{ours.total_m:.3f} m",
            abs(ours.total_m - PAPER_SUM_M) < 0.5, "to half a metre; added linearly"),
        Row("length error at 45, 90, 160 km/h: total", "ours", "not given",
            ", ".join(f"±{budget(speed).total_m:.1f}" for speed in (45, 90, 160)) + " m", None, "ours"),
    )  # fmt: skip


def error_sensitivities() -> tuple[Sensitivity, ...]:
    """The total of table 2 with each term changed: they add up linearly."""
    base = budget(FASTEST_KM_H)
    terms = {
        "speed (sampling and skew)": ("130 km/h", base.sampling_m + base.skew_m),
        "averaging (ours: 2.5 km/h/s over 1.5 s)": (f"{base.averaging_m:.2f} m", base.averaging_m),
        "sensor": (f"{base.sensor_m:.0f} m", base.sensor_m),
    }
    return tuple(
        Sensitivity("length error at 130 km/h: total", name, value, f"±{base.total_m - 0.2 * term:.2f} m",
                    f"±{base.total_m:.2f} m", f"±{base.total_m + 0.2 * term:.2f} m")
        for name, (value, term) in terms.items()
    )  # fmt: skip


# ---- splits


class _Splits:
    """Split detection: the runs, made once, and what they say."""

    def __init__(self, seed: int, runs: int, progress: Progress) -> None:
        self.whole = splits.journeys(seed, runs, SPLIT_CYCLES)
        self.alarms, self.hours = splits.false_alarms(SPLIT_LIMITS, self.whole, progress)
        self.times = splits.tilted(SPLIT_LIMITS, self.whole, splits.TILT_M_S2)
        slow = splits.journeys(seed, runs, round(splits.AT_S / CYCLE_S) + 250, splits.SLOW_LINK_S)
        self.slow = splits.tilted(replace(SPLIT_LIMITS, age_ms=2_500), slow, splits.TILT_M_S2)
        self.parted = splits.parted(SPLIT_LIMITS, seed, runs, 3_000)

    def rows(self) -> tuple[Row, ...]:
        """Figure 12."""
        parted = self.parted
        missed = sum(np.isnan(self.times))
        averaging_s = step_s()
        return (
            Row("split flagged after, averaging alone", "4.3.3", "0.75 s", f"{averaging_s:.1f} s",
                abs(averaging_s - 0.75) <= CYCLE_S, "to a cycle; a step of twice the threshold"),
            Row("split flagged after, tail tilted", "figure 12", "about 2 s", f"{between(self.times)}, {missed} missed",
                bool(missed == 0 and np.max(self.times) <= 2.5), "in every run, in 2.5 s at most"),
            Row("the same, radio and processing 1.25 s", "figure 12", "about 2 s", between(self.slow), None,
                "calibrated: what the paper's 2 s leave"),
            Row("split flagged, tail truly braking", "ours", "not tried",
                f"{len(parted.times_s)} of {parted.running}, {between(parted.times_s)}; {parted.due - parted.late} of "
                f"the {parted.due} that must be", parted.late == 0 if parted.due else None,
                f"within {UNSEEN_CYCLES * CYCLE_S:.1f} s of a difference beyond threshold and errors"),
            Row("alarms of whole trains", "4.3.3", "none", f"{self.alarms} in {self.hours:.1f} h", self.alarms == 0,
                "none"),
        )  # fmt: skip

    def sensitivities(self) -> tuple[Sensitivity, ...]:
        """Time to the flag, and false alarms, with threshold and tilt changed."""
        base, made = between(self.times), []
        less, more = (
            between(splits.tilted(splits.with_threshold(by), self.whole, splits.TILT_M_S2)) for by in (0.8, 1.2)
        )
        threshold = f"{SPLIT_LIMITS.threshold_mm_s2} mm/s²"
        made.append(Sensitivity("split flagged after", "threshold", threshold, less, base, more))
        less, more = (between(splits.tilted(SPLIT_LIMITS, self.whole, by * splits.TILT_M_S2)) for by in (0.8, 1.2))
        made.append(Sensitivity("split flagged after", "tilt", f"{splits.TILT_M_S2:.2f} m/s²", less, base, more))
        fewer, same, most = (
            f"{splits.false_alarms(splits.with_threshold(by), self.whole, _silent)[0]} in {self.hours:.1f} h"
            for by in (0.8, 1.0, 1.2)
        )
        made.append(Sensitivity("alarms of whole trains", "threshold", threshold, fewer, same, most))
        return tuple(made)

    def picture(self) -> Picture:
        """Figure 12: one run."""
        shown = splits.example(SPLIT_LIMITS, self.whole, 0, splits.TILT_M_S2)
        time, limit = shown.pop("time"), SPLIT_LIMITS.threshold_mm_s2 / 1000
        names = {"head": "head", "tail": "tail", "difference": "difference", "mean": "its mean, 15 telegrams"}
        return Picture(
            "001_split",
            "Tail's unit tilted at 0 s: accelerations as the head has them, and the flag",
            "time, s",
            "acceleration along the track, gravity included, m/s²",
            lines={names[name]: (time, values) for name, values in shown.items()},
            levels={"threshold": [-limit, limit]},
            places={"flag": self.times[0]} if not np.isnan(self.times[0]) else {},
        )


def _silent(done: int, total: int, name: str) -> None:
    """Tell nobody."""


def step_s() -> float:
    """How long the kernel takes over a step of twice the threshold, without noise and with telegrams at once (P5)."""
    state = split_machine.made_up(SPLIT_LIMITS)
    tail = Acceleration(-2 * SPLIT_LIMITS.threshold_mm_s2, True)
    for cycle in range(100):
        state = split_machine.note_cycle(SPLIT_LIMITS, state, Readings(Acceleration(0, True), True, tail, tail, 0))
        if state.split:
            return (cycle + 1) * CYCLE_S
    return float("inf")


def between(times: Sequence[float]) -> str:
    """Least, median and most, as text."""
    known = [time for time in times if not np.isnan(time)]
    if not known:
        return "never"
    return f"{min(known):.1f} to {max(known):.1f} s, median {np.median(known):.1f} s"


def parameters(plan: Registering) -> dict[str, str]:
    """What decides, and why."""
    return {
        "lines": f"{LINE_M / 1000:.0f} km, radius 300 to 2,000 m, stops every 2 to 5 km, gradients to 35 per mille"
        " (ours, typical); a train runs from end to end, and each feature set is counted in each run (paper, 4.3.1)",
        "place on board": "the odometer's from the start, put right by the fixes that were made alone (paper, 2.2.3);"
        " in a survey, known 1 km before each curve (ours)",
        "sensors": "within the ranges of models/sensors/faults.py; no sensor fails, 3 of 10 runs have a slip or slide",
        "averaging": "1.5 s (paper, table 2), taken for the cycle in its middle (ours)",
        "least speed": f"{3.6 * plan.speed_least_m_s:.0f} km/h; more for a gentle transition: where noise puts its end"
        f" off by {plan.sensor_m:.0f} m (ours: as the odometer after 1 km);"
        f" for lengths {lengths.PLAN.sensor_m:.1f} m, two of which are table 2's 5 m",
        "noise allowed for": f"{1000 * plan.noise_rad_s:.1f} mrad/s: 4 deviations of the worst declared sway, averaged,"
        " and bias and drift",
        "registered curves": "three times the curvature of noise, long enough for three parts, and found by each of"
        f" {SURVEYS} survey runs, which are not counted; gradient changes are left out (ours: 1.5 s smear short ones)",
        "table 2": "the paper's terms; averaging is 2.5 km/h/s · (1.5 s)² / 2 (ours, the paper derives nothing)",
        "split threshold": f"{SPLIT_LIMITS.threshold_mm_s2} mm/s² (ours: sensors, change of gradient, coupler lag)",
        "tilt": f"{splits.TILT_M_S2:.2f} m/s² (ours: the paper does not say how far the unit was tilted)",
        "radio": "1 to 3 cycles, up to 10 % lost, sent up to 3 times (ours); 1.25 s where it says calibrated",
    }
