"""The errors of differential GPS on a tram, along the track and across it, and where there is none (G1, G7).

A fix errs by what changes slowly (satellites, corrections), by multipath that changes within seconds, and now
and then by a reflection in a street canyon.  Across the track the line's own survey errs as well, and only
that part is what map matching corrects (002, 4.1).
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

Floats = npt.NDArray[np.float64]


@dataclass(frozen=True)
class Gps:
    """How GPS errs, in m and s; each deviation is of one axis.

    ``survey_m``: the line as entered lies so far beside the antenna.  *Calibrated* to the paper's mean of about
    10 m: a mean of 10 m with nine in ten within 14 m cannot come of errors that scatter about the line (then nine
    in ten would be within 21 m), so most of it must be an offset.
    ``slow_m``, ``slow_s``: typical of FM-multiplex DGPS: 2 to 3 m, over minutes.
    ``multipath_m``, ``multipath_s``: typical of code receivers in streets.
    ``reflected``, ``reflected_m``: the share of fixes by way of a reflection, and its mean; ours.
    """

    survey_m: float = 9.5
    slow_m: float = 2.0
    slow_s: float = 300.0
    multipath_m: float = 1.5
    multipath_s: float = 5.0
    reflected: float = 0.02
    reflected_m: float = 10.0


PLAN = Gps()
BOUND_MM = 15_000
"""Declared: along the track no fix errs by more; a receiver that knows that its fix is worse gives none."""
REJECTED_MM = 25_000
"""A fix that map matching would have to move farther is none (G1, ours)."""


def wandering(chance: np.random.Generator, deviation: float, lasts_s: float, seconds: int) -> Floats:
    """Give an error that forgets itself over so many seconds, second by second."""
    keeps = float(np.exp(-1.0 / lasts_s))
    drawn = chance.normal(0.0, deviation * np.sqrt(1 - keeps * keeps), seconds)
    out = np.empty(seconds)
    value = chance.normal(0.0, deviation)
    for second in range(seconds):
        value = keeps * value + drawn[second]
        out[second] = value
    return out


def errors_m(chance: np.random.Generator, gps: Gps, seconds: int) -> tuple[Floats, Floats]:
    """Give the errors along the track and across it, in m, of fixes of 1 s."""
    parts = [
        wandering(chance, gps.slow_m, gps.slow_s, seconds)
        + wandering(chance, gps.multipath_m, gps.multipath_s, seconds)
        for _ in range(2)
    ]
    reflected = chance.random(seconds) < gps.reflected
    way = chance.exponential(gps.reflected_m, seconds) * reflected
    turn = chance.uniform(0.0, 2 * np.pi, seconds)
    return parts[0] + way * np.cos(turn), gps.survey_m + parts[1] + way * np.sin(turn)
