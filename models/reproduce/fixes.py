"""Paper 001, 4.3.1: how many curves set as features give a fix, by a survey and runs that are counted (P3)."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass, replace

import numpy as np

from models.reproduce.passing import (
    LINE_M,
    Awaited,
    Outcome,
    Ridden,
    Runs,
    awaited,
    looked_for,
    measured_yaw,
    ride,
    runs_on,
)
from models.reproduce.tables import wilson
from models.sensors import track as tracks
from models.sensors.curves import Registering

LINES_FOR_A_DEVIATION = 10
SURVEYS = 4
"""Runs over a line before its features are registered: the paper shows four over one place (figure 9)."""
FIRST_SURVEY = 1_000_000
"""Survey runs have numbers of their own, so that no run that is counted chose its features."""


@dataclass(frozen=True)
class Line:
    """A line: its survey runs, ridden without a fix, and the runs that are counted."""

    survey: Ridden
    counted: Runs


def surveyed(plan: Registering, survey: Ridden, gyro: float = 1.0) -> list[tracks.Feature]:
    """The curves that are set as features: every survey run passed them, and got its fix there (P3).

    The paper says that features are set beforehand in the unit's data (2.2) and not by what rule.  Ours is what a
    railway can do: run over the line a few times, and set no feature that failed even once.
    """
    yaw, whole = measured_yaw(survey.runs, gyro)
    fixed: dict[tracks.Feature, int] = dict.fromkeys(survey.runs.track.features, 0)
    for one in awaited(plan, survey.runs, survey.runs.track.features):
        fixed[one.curve] += looked_for(survey, one, yaw, whole, lost_mm(survey, one)).fixed
    return [curve for curve in survey.runs.track.features if fixed[curve] == SURVEYS]


def lost_mm(survey: Ridden, one: Awaited) -> int:
    """How far a survey's odometry had fallen behind 1 km before the feature.

    A survey is made by who knows the line: where the train was a kilometre before a curve is known (ours).
    """
    head_m = survey.runs.head_m[one.run]
    begin = max(0, int(np.searchsorted(head_m, one.feature.begin_mm / 1000 - 1_000.0)) - 1)
    return round(1000 * float(head_m[begin])) - survey.front_least_mm[one.run][begin]


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


def journeys(seed: int, lines: int, runs: int, progress: Callable[[int, int, str], None]) -> list[Line]:
    """Run trains over some lines from end to end, and the odometry with those of the surveys (P1, P8)."""
    made = []
    for number in range(lines):
        progress(number, lines, f"line {number + 1}")
        track = tracks.line(seed * 1_000 + number, LINE_M)
        surveys = FIRST_SURVEY + number * SURVEYS
        survey = runs_on(track, seed, range(surveys, surveys + SURVEYS))
        counted = runs_on(track, seed, range(number * runs, (number + 1) * runs))
        made.append(Line(ride(survey, (), *measured_yaw(survey)), counted))
    return made


def ridden(plan: Registering, line: Line, gyro: float = 1.0, everywhere: bool = False) -> Ridden:
    """Ride the runs that are counted with a line's features set; ``gyro`` scales every error of the gyros.

    ``everywhere``: every curve that can be registered is, whatever the survey found.
    """
    curves = line.counted.track.features if everywhere else surveyed(plan, line.survey, gyro)
    return ride(line.counted, tuple(awaited(plan, line.counted, curves)), *measured_yaw(line.counted, gyro))


def first(rides: Iterable[Ridden], most: int) -> Fixes:
    """The first so many features; no more is ridden than that takes."""
    found: list[Outcome] = []
    for each in rides:
        found.extend(each.outcomes)
        if len(found) >= most:
            break
    return Fixes(tuple(found[:most]))


def fixes(plan: Registering, lines: Sequence[Line], most: int, gyro: float = 1.0, everywhere: bool = False) -> Fixes:
    """Look for the first so many features."""
    return first((ridden(plan, line, gyro, everywhere) for line in lines), most)


def changed(plan: Registering, name: str, by: float) -> Registering:
    """The plan with one value scaled."""
    return replace(plan, **{name: getattr(plan, name) * by})
