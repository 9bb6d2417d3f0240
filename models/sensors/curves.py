"""How curves are registered on board, and the yaw rate averaged that is held against them (P2, P3).

The unit averages yaw rates over 1.5 s (paper 001, table 2) and takes the average for the cycle in its middle, so
that it puts no place off; features are matched 0.7 s late, and a fix counts for that cycle.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from kernel.onboard.feature import Band, Feature, TurnAxis
from models.sensors import track as tracks
from models.sensors.faults import CYCLE_S
from models.sensors.track import Places

AVERAGED = 15
MIDDLE = AVERAGED // 2
"""The moving average of 1.5 s in cycles (paper 001, table 2), and how far back its middle is."""
TOLD_APART = 3.0
"""A curve has so many times the curvature that noise shows at the least speed, or it is not registered."""


@dataclass(frozen=True)
class Registering:
    """How curves are registered; each value with its reason (P3).

    ``speed_least_m_s``: 45 km/h; a gentle transition needs more.
    ``noise_rad_s``: what is allowed for in the averaged yaw rate: 4 deviations of the worst declared sway over 15
    samples, 4 × 4 × 0.15, the worst bias, 0.4, and drift, 0.3 mrad/s.
    ``sensor_m``: what the sensors may put a curve's end off by: no more than the odometer after a kilometre (ours).
    From it comes the speed that the feature needs: there, noise shows what the transition gains in so many m.
    ``band_share``: what is allowed for in the registered curvature: survey, gyro scale, wheel scale.
    ``straight_m``: seen before and after.  ``margin_m``: between the parts, for half the averaging at 130 km/h.
    ``length_m``: tolerance of the curve's length: twice the sensor's, and a cycle's way, about.
    ``cycle_m``: a cycle's way at 130 km/h (paper, table 2).
    """

    speed_least_m_s: float = 12.5
    noise_rad_s: float = 0.0031
    sensor_m: float = 8.0
    band_share: float = 0.05
    straight_m: float = 50.0
    margin_m: float = 28.0
    length_m: float = 17.0
    cycle_m: float = 3.61

    def speed_needed_m_s(self, curve: tracks.Feature) -> float:
        """The least speed at which the curve's end is found to within the sensor's error."""
        gains_per_m2 = abs(curve.curvature_per_m) / (curve.full_m - curve.begin_m)
        return max(self.speed_least_m_s, self.noise_rad_s / (gains_per_m2 * self.sensor_m))


def smeared_m(straight_m: float, speed_m_s: float) -> float:
    """How far behind a transition's end the averaged curvature falls to what counts as straight (P3).

    ``straight_m``: how far before the end the true one does.  The average is over a way of 2 h, h at either side;
    where that reaches beyond the end, the average of a ramp that ends is s (h - x)² / 4 h at x behind it.
    """
    half_m = AVERAGED * CYCLE_S / 2 * speed_m_s
    return -straight_m if half_m <= straight_m else half_m - 2 * (half_m * straight_m) ** 0.5


def registered(plan: Registering, curve: tracks.Feature, most_m_s: float = tracks.LINE_SPEED_M_S) -> Feature | None:
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


def band(least_per_m: float, most_per_m: float, sign: int) -> Band:
    """A band in 1/10**6 m; for a curve to the right it is mirrored."""
    ends = sorted((round(sign * 1e6 * least_per_m), round(sign * 1e6 * most_per_m)))
    return Band(ends[0], ends[1])


def averaged(values: Places, valid: np.ndarray[tuple[int, ...], np.dtype[np.bool_]]) -> tuple[Places, Places]:
    """The mean over 15 cycles for the one in the middle, and whether all 15 were valid (paper, table 2)."""
    sums = np.cumsum(np.pad(values.astype(np.int64), ((0, 0), (AVERAGED, 0))), axis=1)
    total = sums[:, AVERAGED:] - sums[:, :-AVERAGED]
    good = np.cumsum(np.pad(valid.astype(np.int64), ((0, 0), (AVERAGED, 0))), axis=1)
    mean, whole = np.zeros_like(total), np.zeros_like(total)
    mean[:, :-MIDDLE] = (np.rint(total / AVERAGED)).astype(np.int64)[:, MIDDLE:]
    whole[:, :-MIDDLE] = (good[:, AVERAGED:] - good[:, :-AVERAGED])[:, MIDDLE:] == AVERAGED
    return mean, whole
