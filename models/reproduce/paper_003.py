"""Paper 003, constant warning time by radio ranging: warning times of both field trials, hour by hour (X1 to X6).

Two ways of reckoning stand beside the old crossing.  One is the paper's: warn when the train would arrive within the
warning time by its position, speed and acceleration.  The other is the kernel's, by which no train whatever arrives
sooner: it takes every error off, and reckons with the line's speed and the most that any train gains.  The paper's
figures are compared with both, by the same criteria.

The kernel stands here twice: with trains that promise a ceiling of speed, which is so much above what their drivers
keep to, and tell their own range; and with trains that promise nothing, which may speed up to their limit's excess.

The old crossing takes nothing off: its start points lie where a train at the limit needs the warning time.  So the
kernel stands beside a crossing of the same guarantee too, its own under conventional control: start points that lie
where no train arrives too early, whatever a terminal's silence and a driver's excess.

Warning times of less than 35 s are sensitivities: 30 s leave 15 s from barriers down to the arrival, the least (2.1).

One number at each site is *calibrated*: by how much trains are slower than the limit, so that the old crossing's mean
is the paper's.  The paper tells nothing else of the traffic.  All else was written down in ``models/crossing/sites.py``
before.  A run's warning time is from its beginning to the rear's proof, for each train by itself.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
import numpy.typing as npt

from models.crossing.columns import COLUMNS, NUMBER
from models.crossing.sites import (
    CEILING_OVER_M_S,
    CURVED,
    HOURS,
    OWN_SPEED_M_S,
    OWN_WAY_M,
    PEAK,
    SETTINGS,
    STRAIGHT,
    WARNING_S,
    Trial,
)
from models.crossing.traffic import drawn
from models.crossing.watch import watched
from models.reproduce.tables import Picture, Reproduction, Row, Sensitivity

TITLE = "constant warning time by radio ranging"
CLOSE = 0.10
"""A mean agrees within a tenth."""
THIRD = 1 / 3
"""A saving, which is the difference of two means, agrees within a third."""
STEPS = 7
"""Halvings by which the calibrated number is found."""
CALIBRATED_BY = 2
"""Days by which it is found."""
SLOWEST, FASTEST = 0.4, 1.1
SAVES_S = (20.0, 2.0)
"""What trains that promise have to save at each site, against the old crossing: by a trial before this was built."""
CALIBRATED = "calibrated (ceiling and range of promises): "
"""What rows of promises are: their numbers were chosen after trials with others had been seen."""
SHORTER_S = 30
"""The warning time beside 35 s: 15 s to barriers down, and the least of 15 s from then on (2.1, note 2)."""

Progress = Callable[[int, int, str], None]
Floats = npt.NDArray[np.float64]


@dataclass(frozen=True)
class Trials:
    """What the paper says of one trial."""

    trial: Trial
    runs: int
    old_s: float
    new_s: float
    where: str

    @property
    def saved_s(self) -> float:
        """By how much warnings became shorter."""
        return self.old_s - self.new_s


PAPER = (
    Trials(STRAIGHT, 73, 71.3, 59.4, "table 3, figure 7"),
    Trials(CURVED, 191, 50.3, 44.2, "table 4, figure 8"),
)


@dataclass(frozen=True)
class Measured:
    """Warning times of every train of some days, in s, and the hour in which each came.

    ``old``: the old crossing's.  ``struck``: by the kernel's start points alone.
    ``likely``: by the paper's reckoning.  ``sure``: by the kernel's, with trains that promise nothing.
    ``promised``: by the kernel's, with trains that promise a ceiling.
    ``least_s``: the shortest from a warning of the kernel's to an arrival; ``late``: arrivals that the paper's
    reckoning warned of late.
    """

    hour: npt.NDArray[np.int64]
    old: Floats
    struck: Floats
    likely: Floats
    sure: Floats
    promised: Floats
    least_s: int
    late: int

    def hourly(self, values: Floats) -> list[float]:
        """The mean of each hour."""
        return [float(values[self.hour == hour].mean()) for hour in HOURS]

    def saved(self, how: str) -> Floats:
        """What one way of reckoning saves, of each train: against its old crossing."""
        return {
            "likely": self.old - self.likely,
            "sure": self.old - self.sure,
            "promised": self.old - self.promised,
            "alike": self.struck - self.sure,
        }[how]


def slowed(trial: Trial, by: float) -> Trial:
    """Give a trial whose trains run so much of their speeds; none runs above its limit."""
    first, second, third, fourth = (min(1.0, by * each) for each in trial.share)
    return replace(trial, share=(first, second, third, fourth))


def measured(trial: Trial, seed: int, days: int) -> Measured:
    """Let days pass without faults, all trains with radio, as in the trials; each day again with promises."""
    parts: list[Any] = []
    late = 0
    for day in range(days):
        out = np.zeros(len(COLUMNS), np.int64)
        began = drawn(seed, day, trial, quiet=True, promise=0.0)
        run = watched(trial, began, out)
        late += int(out[NUMBER["likely_late"]])
        again = watched(trial, drawn(seed, day, trial, quiet=True, promise=1.0), np.zeros(len(COLUMNS), np.int64))
        ended_s = run["out_s"] + 1
        hour = HOURS[0] + began.trains["at_s"] // 3_600
        warned = [ended_s - run[name] for name in ("old_s", "struck_s", "likely_s", "asked_s")]
        shortest = np.minimum(run["arrived_s"] - run["asked_s"], again["arrived_s"] - again["asked_s"])
        parts.append([hour, *warned, again["out_s"] + 1 - again["asked_s"], shortest])
    hour, *values, shortest = (np.concatenate([part[place] for part in parts]) for place in range(7))
    old, struck, likely, sure, promised = (each.astype(float) for each in values)
    return Measured(hour, old, struck, likely, sure, promised, int(shortest.min()), late)


def old_s(trial: Trial, seed: int, day: int) -> float:
    """Give the mean of the old crossing's warning times on one day."""
    run = watched(trial, drawn(seed, day, trial, quiet=True, promise=0.0), np.zeros(len(COLUMNS), np.int64))
    return float((run["out_s"] + 1 - run["old_s"]).mean())


def calibrated(paper: Trials, seed: int) -> float:
    """Give how much of their speeds trains run, so that the old crossing's mean is the paper's."""
    slow, fast = SLOWEST, FASTEST
    for _ in range(STEPS):
        middle = (slow + fast) / 2
        mean_s = np.mean([old_s(slowed(paper.trial, middle), seed, day) for day in range(CALIBRATED_BY)])
        slow, fast = (middle, fast) if mean_s > paper.old_s else (slow, middle)
    return (slow + fast) / 2


def reproduce(seed: int, runs: int, progress: Progress) -> Reproduction:
    """Set the paper's figures beside ours, over so many days at each site (X6)."""
    rows: list[Row] = []
    changes: list[Sensitivity] = []
    pictures: list[Picture] = []
    by: dict[str, str] = {}
    counts: dict[str, int] = {"days at each site": runs}
    for number, paper in enumerate(PAPER, 1):
        progress(number, 2 * len(PAPER), f"{paper.trial.name}: traffic")
        share = calibrated(paper, seed)
        site = slowed(paper.trial, share)
        found = measured(site, seed + 1, runs)
        rows += [*rows_of(number, paper, found), *shorter(number, site, seed + 1), *costs(number, site, seed + 1)]
        pictures += pictures_of(number, paper, found)
        progress(len(PAPER) + number, 2 * len(PAPER), f"{paper.trial.name}: sensitivities")
        changes += sensitivities(paper, site, seed + 1)
        by[f"speeds, trial {number}"] = f"calibrated: {share:.3f} of those written for the site"
        counts[f"trains of trial {number}"] = len(found.old)
    return Reproduction("003", TITLE, seed, tuple(rows), tuple(changes), tuple(pictures), parameters() | by, counts)


# ---- figures


def spread_s(values: Floats, runs: int) -> float:
    """Give twice the standard error of a mean over so many runs."""
    return float(2 * values.std() / np.sqrt(runs))


def rows_of(number: int, paper: Trials, found: Measured) -> tuple[Row, ...]:
    """One trial: means, savings, and hours."""
    of = f"trial {number}: "
    mean_s = float(found.likely.mean())
    mean = f"{mean_s:.1f} s, ± {spread_s(found.likely, paper.runs):.1f} s over {paper.runs} runs"
    return (
        Row(of + "mean, old crossing", paper.where, f"{paper.old_s} s", f"{found.old.mean():.1f} s", None,
            "calibrated: trains' speeds"),
        Row(of + "mean, the paper's reckoning", paper.where, f"{paper.new_s} s", mean,
            abs(mean_s - paper.new_s) <= CLOSE * paper.new_s, "within a tenth"),
        *savings(of, paper, found, "likely"),
        Row(of + f"mean, {HOW['promised']}", paper.where, f"{paper.new_s} s", f"{found.promised.mean():.1f} s",
            bool(found.promised.mean() <= (1 + CLOSE) * paper.new_s), CALIBRATED + "a tenth longer at most"),
        Row(of + f"least saving, {HOW['promised']}", "ours", f"{SAVES_S[number - 1]:.0f} s at least",
            f"{found.saved('promised').mean():.1f} s", bool(found.saved("promised").mean() >= SAVES_S[number - 1]),
            CALIBRATED + "so much by the trial before this was built"),
        Row(of + f"saving, {HOW['promised']}", paper.where, f"{paper.saved_s:.1f} s",
            f"{found.saved('promised').mean():.1f} s",
            bool(found.saved("promised").mean() >= (1 - THIRD) * paper.saved_s), CALIBRATED + "two thirds at least"),
        *savings(of, paper, found, "promised")[1:],
        Row(of + f"mean, {HOW['sure']}", paper.where, f"{paper.new_s} s", f"{found.sure.mean():.1f} s",
            bool(abs(found.sure.mean() - paper.new_s) <= CLOSE * paper.new_s), "within a tenth"),
        *savings(of, paper, found, "sure"),
        Row(of + "mean, the kernel by start points alone", "not given", "not given", f"{found.struck.mean():.1f} s",
            None, "none: the old crossing with the kernel's guarantee"),
        *savings(of, paper, found, "alike"),
        Row(of + f"arrivals warned of for less than {WARNING_S} s, the paper's reckoning", "not given", "not given",
            f"{found.late} of {len(found.old)}", None, "none: what no bounds cost"),
        Row(of + "least time from warning to arrival, the kernel", "2.1, note 2", f"{WARNING_S} s at least",
            f"{found.least_s} s", found.least_s >= WARNING_S, "every one"),
    )  # fmt: skip


def shorter(number: int, site: Trial, seed: int) -> tuple[Row, ...]:
    """What is saved with a warning time of 30 s against old start points as they are: a sensitivity (ours)."""
    found = measured(replace(site, warning_s=SHORTER_S), seed, 1)
    at = f"trial {number}: at {SHORTER_S} s of warning, old start points as at {WARNING_S} s, "
    return (
        *(
            Row(at + f"saving, {HOW[how]}", "ours", "not given", f"{found.saved(how).mean():.1f} s", None,
                "none: a sensitivity")
            for how in ("likely", "promised", "sure")
        ),
        Row(at + "least time from warning to arrival, the kernel", "2.1, note 2", f"{SHORTER_S} s at least",
            f"{found.least_s} s", found.least_s >= SHORTER_S, "every one"),
    )  # fmt: skip


def costs(number: int, site: Trial, seed: int) -> tuple[Row, ...]:
    """What of the kernel's warning is owed to single margins: each left out by itself (ours)."""
    without = {
        "no excess over the limit": replace(site, excess=1.0),
        "rangings without error": erring(site, 0.0),
        "no gain of speed": replace(site, gain_m_s2=1e-6),
    }
    base = measured(site, seed, 1)
    return tuple(
        Row(f"trial {number}: {name}, {HOW[how]}", "ours", "not given",
            f"{(found.saved(how) - base.saved(how)).mean():+.1f} s saved", None, "none: what the margin costs")
        for name, changed in without.items()
        for found in (measured(changed, seed, 1),)
        for how in ("promised", "sure")
    )  # fmt: skip


HOW = {
    "likely": "the paper's reckoning",
    "promised": "the kernel, all trains promise",
    "sure": "the kernel, no train promises",
    "alike": "the kernel against its start points",
}


def savings(of: str, paper: Trials, found: Measured, how: str) -> tuple[Row, ...]:
    """What is saved by one way of reckoning: in the mean, in each hour, and when most."""
    every = found.saved(how)
    saved = np.array(found.hourly(every))
    by = CALIBRATED if how == "promised" else ""
    mean_s, most = float(every.mean()), HOURS[int(saved.argmax())]
    return (
        Row(of + f"saving, {HOW[how]}", paper.where, f"{paper.saved_s:.1f} s", f"{mean_s:.1f} s",
            abs(mean_s - paper.saved_s) <= THIRD * paper.saved_s, "within a third"),
        Row(of + f"saving by hour, {HOW[how]}", "3.3, 4", "in every hour",
            f"{saved.min():.1f} to {saved.max():.1f} s", bool(saved.min() > 0), by + "above 0 in every hour"),
        Row(of + f"saving is largest, {HOW[how]}", "3.3", "at the rush hours", f"from {most}:00", most in PEAK,
            by + f"in an hour from {PEAK[0]}:00 or {PEAK[1]}:00"),
    )  # fmt: skip


def pictures_of(number: int, paper: Trials, found: Measured) -> tuple[Picture, ...]:
    """Figures 7 and 8: hour by hour."""
    hours = [float(hour) for hour in HOURS]
    named = {
        "old crossing": found.old,
        "the paper's reckoning": found.likely,
        "the kernel by start points": found.struck,
        "the kernel, all promise": found.promised,
        "the kernel, none promises": found.sure,
    }
    return (
        Picture(
            f"003_trial_{number}_hours",
            f"Trial {number}, {paper.trial.name}: mean warning time by hour",
            "hour of the day",
            "warning time, s",
            lines={name: (hours, found.hourly(values)) for name, values in named.items()},
            levels={"paper: old, new": [paper.old_s, paper.new_s], "warning time required": [float(WARNING_S)]},
        ),
        Picture(
            f"003_trial_{number}_runs",
            f"Trial {number}, {paper.trial.name}: warning times of trains",
            "warning time, s",
            "trains, each way of reckoning",
            lines={name: counted(values) for name, values in named.items()},
            places={"paper: old": paper.old_s, "paper: new": paper.new_s},
        ),
    )


def counted(values: Floats) -> tuple[Sequence[float], Sequence[float]]:
    """Give how many warning times lie in each three seconds."""
    counts, edges = np.histogram(values, bins=np.arange(30.0, 180.0, 3.0))
    return [float(edge) + 1.5 for edge in edges[:-1]], [float(count) for count in counts]


# ---- what it depends on


def sensitivities(paper: Trials, site: Trial, seed: int) -> tuple[Sensitivity, ...]:
    """Both savings with each decisive parameter changed; traffic's speeds stay as calibrated."""
    rush, quiet = site.share[2:], site.share[:2]
    changed: dict[str, tuple[str, Callable[[float], Trial]]] = {
        "speeds of trains": (f"{quiet[0]:.2f} to {quiet[1]:.2f}, peak {rush[0]:.2f} to {rush[1]:.2f}",
                             lambda by: slowed(site, by)),
        "the most that a train gains": (f"{site.gain_m_s2} m/s²",
                                        lambda by: replace(site, gain_m_s2=by * site.gain_m_s2)),
        "what a train is taken to gain": (f"{site.likely_m_s2} m/s²",
                                          lambda by: replace(site, likely_m_s2=by * site.likely_m_s2)),
        "errors of ranging": (f"{site.way_error_m:.0f} m, {site.speed_error_m_s:.1f} m/s", lambda by: erring(site, by)),
        "excess over the limit": (f"{100 * (site.excess - 1):.0f} %",
                                  lambda by: replace(site, excess=1 + by * (site.excess - 1))),
    }  # fmt: skip
    made = []
    base = measured(site, seed, 1)
    for name, (value, change) in changed.items():
        less, more = (measured(change(by), seed, 1) for by in (0.8, 1.2))
        for how, called in HOW.items():
            texts = [f"{each.saved(how).mean():.1f} s" for each in (less, base, more)]
            made.append(Sensitivity(f"saving, {paper.trial.name}, {called}", name, value, *texts))
    return tuple(made)


def erring(trial: Trial, by: float) -> Trial:
    """Give a trial whose rangings err so much more."""
    return replace(
        trial,
        way_sigma_m=by * trial.way_sigma_m,
        multipath_m=by * trial.multipath_m,
        speed_sigma_m_s=by * trial.speed_sigma_m_s,
    )


def parameters() -> dict[str, str]:
    """What decides, and why."""
    return {
        "warning time": f"{WARNING_S} s: 15 s to barriers down, 20 s from then on, both standards (2.1, note 2)",
        "old start points": "the warning time at the greatest speed: of the line in trial 1, of each kind in trial 2"
        " (2.1, 3.1); no margin",
        "the kernel's decision": f"each {SETTINGS.cycle_ms} ms; errors, age and two cycles are taken off (ours)",
        "promises": f"a ceiling {CEILING_OVER_M_S} m/s above what the driver keeps to: the speed's range, and what is"
        f" gained until the brake responds that keeps it; own range ±{OWN_WAY_M:.0f} m, ±{OWN_SPEED_M_S} m/s (ours)",
        "excess": f"{100 * (STRAIGHT.excess - 1):.0f} % over the limit is reckoned with by the kernel alone (ours)",
        "lines": "100 km/h, 20 trains an hour and track at the peak (Isesaki line); 85 km/h for expresses and 65 km/h"
        " for locals, 21 (Oimachi line): public, or practice",
        "stations": f"{STRAIGHT.station_m:.0f} m and {CURVED.station_m:.0f} m from the road: beyond all start points,"
        " since with a stop between no mean is as short as the paper's",
        "peak": "speeds fall (3.3); by how much is ours",
        "ranging": f"±{STRAIGHT.way_error_m:.0f} m in the open, ±{CURVED.way_error_m:.0f} m among buildings (ours)",
        "end of a warning": "the tail reads the end tag 15 m beyond the road, and tells a second later, in all three",
    }
