"""A line: curvature, gradient, allowed speed, registered features and tags over distance (P2, P3, T2).

Arrays on a grid of :data:`GRID_M`; between its points everything is linear, as transition curves
(緩和曲線) and vertical curves (縦曲線) are.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from models.sensors.draws import Singles
from models.sensors.faults import Floats

Ints = npt.NDArray[np.int32]
Places = npt.NDArray[np.int64]

GRID_M = 1.0
LEAST_RADIUS_M, MOST_RADIUS_M = 300.0, 2000.0
"""Ours, typical of Japanese main lines: down to 300 m in hills; flatter ones are hardly told from straight."""
MOST_GRADIENT_PERMILLE = 35.0
"""The technical standard's limit for ordinary railways' electric trains; 25 is common."""
VERTICAL_RADIUS_M = (3_000.0, 6_000.0)
"""Ours, typical: 3,000 m at least where trains are fast, 4,000 m in curves."""
TRANSITION_M = (30.0, 80.0)
"""Ours, typical: 400 times a cant of 75 to 105 mm is 30 to 42 m; longer where trains are fast."""
CURVE_M = (120.0, 500.0)
STRAIGHT_M = (150.0, 900.0)
"""Ours: long enough for a train to be straight before and after a curve."""
LINE_SPEED_M_S = 130 / 3.6
"""The speed that table 2 of paper 001 reckons with."""
CURVE_SPEED = 1.1
"""Allowed speed in m/s over the root of the radius in m: cant 105 mm and deficiency 50 mm on 1,067 mm give 1.16."""
STATION_M = (2_000.0, 5_000.0)
"""Ours, typical of suburban to regional lines: from stop to stop."""
BUFFER_M = 300.0
"""The end of the line, where trains stay."""
PAIR_M = 3.0
"""Ours: between the two tags of a boundary (paper 000, 3.1: one each side of it)."""
BRAKING_M_S2 = 0.7
"""What the allowed speed before a stop or a curve is reckoned with: 2.5 km/h/s, a usual service brake."""


@dataclass(frozen=True)
class Feature:
    """A curve or a change of gradient, as it is registered (P3), in m and 1/m along the line.

    ``begin_m``: where the entry transition begins; ``full_m`` to ``ease_m``: at full curvature; ``end_m``: where
    the exit transition ends.  ``vertical``: a change of gradient.
    """

    vertical: bool
    begin_m: float
    full_m: float
    ease_m: float
    end_m: float
    curvature_per_m: float


@dataclass(frozen=True)
class Track:
    """One line, from 0 on; all arrays over the grid but the last three.

    ``allowed_m_s``: allowed speed with braking ahead of curves and stops.  ``free_m_s``: without the stops.
    ``tags_m``: each tag; two at every boundary.  ``boundary_of``: the boundary of each.  ``stops_m``: stopping places.
    """

    curvature_per_m: Singles
    vertical_per_m: Singles
    gradient: Singles
    allowed_m_s: Singles
    free_m_s: Singles
    features: tuple[Feature, ...]
    stops_m: Floats
    tags_m: Floats
    boundary_of: Places

    @property
    def length_m(self) -> float:
        """How far the grid goes."""
        return (len(self.gradient) - 1) * GRID_M


def line(seed: int, length_m: float = 15_000.0) -> Track:
    """Make up a line of at least 10 km: the same seed, the same line.

    Raises:
        ValueError: it is shorter than 10 km.
    """
    if not length_m >= 10_000.0:
        raise ValueError(f"a line of {length_m} m; at least 10 km are needed")
    random = np.random.Generator(np.random.SFC64(np.random.SeedSequence(seed, spawn_key=(2**31,))))
    curves = _curves(random, length_m)
    slopes = _slopes(random, length_m)
    stops = np.cumsum(random.uniform(*STATION_M, int(length_m / STATION_M[0]) + 1)) + 300.0
    return laid(length_m, curves, slopes, stops[stops < length_m - 500.0])


def laid(length_m: float, curves: list[Feature], slopes: list[Feature], stops_m: Floats) -> Track:
    """Lay a line with these features and stopping places: a boundary before and behind each stop (P3, T2)."""
    curvature = _shape(length_m, curves)
    vertical = _shape(length_m, slopes)
    gradient = np.concatenate([[0.0], np.cumsum((vertical[1:] + vertical[:-1]) / 2 * GRID_M)])
    sharpest = np.maximum(np.abs(curvature), 1e-9)
    free = _braked(np.minimum(LINE_SPEED_M_S, CURVE_SPEED / np.sqrt(sharpest)))
    stopping = free.copy()
    stopping[np.minimum((stops_m / GRID_M).astype(np.int64), len(free) - 1)] = 0.0
    stopping[-round(BUFFER_M / GRID_M) :] = 0.0
    boundaries = np.sort(np.concatenate([stops_m - 260.0, stops_m + 40.0]))
    return Track(
        curvature_per_m=curvature.astype(np.float32),
        vertical_per_m=vertical.astype(np.float32),
        gradient=gradient.astype(np.float32),
        allowed_m_s=_braked(stopping).astype(np.float32),
        free_m_s=free.astype(np.float32),
        features=tuple(sorted([*curves, *slopes], key=lambda each: each.begin_m)),
        stops_m=stops_m,
        tags_m=np.sort(np.concatenate([boundaries - PAIR_M / 2, boundaries + PAIR_M / 2])),
        boundary_of=np.repeat(np.arange(len(boundaries)), 2),
    )


@dataclass(frozen=True)
class Spots:
    """Places on the grid: the point before each, and the share of the way to the next."""

    index: Places
    share: Singles


def spots(track: Track, places_m: Floats) -> Spots:
    """Find places on the grid; those beyond its ends are at its ends."""
    scaled = places_m * (1 / GRID_M)
    np.clip(scaled, 0, len(track.gradient) - 1.001, out=scaled)
    index = scaled.astype(np.int64)
    scaled -= index
    return Spots(index, scaled.astype(np.float32))


def read(values: Singles, there: Spots) -> Singles:
    """Read a quantity of the track, linear between the points of the grid."""
    before, after = values.take(there.index), values[1:].take(there.index)
    after -= before
    after *= there.share
    after += before
    return after


def _curves(random: np.random.Generator, length_m: float) -> list[Feature]:
    """Curves to either side, straights between them; every radius alike often."""
    found = []
    here = random.uniform(*STRAIGHT_M)
    while here < length_m - 1_200.0:
        radius_m = random.uniform(LEAST_RADIUS_M, MOST_RADIUS_M) * random.choice([-1.0, 1.0])
        found.append(feature(here, random.uniform(*TRANSITION_M), random.uniform(*CURVE_M), 1 / radius_m))
        here = found[-1].end_m + random.uniform(*STRAIGHT_M)
    return found


def _slopes(random: np.random.Generator, length_m: float) -> list[Feature]:
    """Changes of gradient, each a vertical curve; the gradient stays within the limit and 12 per mille a change."""
    found = []
    here, gradient = random.uniform(*STRAIGHT_M), 0.0
    limit = MOST_GRADIENT_PERMILLE - 1.0
    while here < length_m - 1_200.0:
        change = float(np.clip(gradient + random.uniform(-12.0, 12.0), -limit, limit)) - gradient
        bend = np.sign(change) / random.uniform(*VERTICAL_RADIUS_M)
        whole_m = abs(change / 1000 / bend) if bend else 0.0
        if whole_m > 10.0:
            found.append(feature(here, 2.0, whole_m - 2.0, bend, vertical=True))
            gradient += change
            here = found[-1].end_m
        here += random.uniform(*STRAIGHT_M)
    return found


def feature(
    begin_m: float, transition_m: float, full_m: float, curvature_per_m: float, vertical: bool = False
) -> Feature:
    """A feature that begins at a place, with both transitions alike."""
    full, ease = begin_m + transition_m, begin_m + transition_m + full_m
    return Feature(vertical, begin_m, full, ease, ease + transition_m, curvature_per_m)


def _shape(length_m: float, features: list[Feature]) -> Floats:
    """The curvature over the grid: 0, up, full, down, 0."""
    grid = np.arange(int(length_m / GRID_M) + 1) * GRID_M
    shape = np.zeros(len(grid))
    for each in features:
        places = [each.begin_m, each.full_m, each.ease_m, each.end_m]
        full = each.curvature_per_m
        shape += np.interp(grid, places, [0.0, full, full, 0.0], left=0.0, right=0.0)
    return shape


def _braked(limit_m_s: Floats) -> Floats:
    """The highest speed at each place from which every limit ahead can be braked to."""
    squares = limit_m_s[::-1] ** 2
    climb = 2 * BRAKING_M_S2 * GRID_M * np.arange(len(squares))
    return np.asarray(np.sqrt(np.minimum.accumulate(squares - climb) + climb)[::-1])
