"""A tram line on a day, one way or both: stops, signals, passengers, and the trams that run on it (G2, G4).

Ours where no other source is named.  The line is that of no town: as many stops and as close as those of the
paper's (Kumamoto, 12 km with stops each 400 m), trams each four to six minutes.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

Whole = npt.NDArray[np.int64]

STOPS = 24
"""Of one way; practice: a tram line of 10 km."""
LEAST_APART_MM, MOST_APART_MM = 300_000, 520_000
"""Practice: stops of Japanese tram lines."""
BRANCH = 16
"""The stop where the other line turns off; each third tram is its."""
JOINS = STOPS - 1 - BRANCH
"""The same junction on the other way: the stop where the other line's trams come onto it."""
DEPOT = 8
"""The stop where a tram may come from the depot."""
OPEN_S = 6 * 3_600
CLOSE_S = 22 * 3_600 + 1_800
"""Trams begin their runs from six to half past ten."""
HOURS = (CLOSE_S - OPEN_S) / 3_600
PEAKS_S = ((7 * 3_600, 9 * 3_600), (17 * 3_600, 19 * 3_600))
PEAK_HEADWAY_S, HEADWAY_S = 240, 360
"""Practice: each four minutes at the peaks, else each six."""
LATE_S = 45.0
"""Deviation of how late a tram begins its run; it is never early.  Practice: turning back at a terminus."""
TRAMS = 40
"""Vehicle numbers; one is used again when the tram has been away for a quarter of an hour."""
AWAY_S = 900
TAKEN_UP_S = 60
FIRST_S = OPEN_S - 600
"""So long before it comes a tram is told to the centre, by the timetable; and when the centre starts."""

LENGTH_MM = 18_000
"""Practice: a tram of two cars."""
GAP_MM = 3_000
"""Practice: between trams that queue."""
MOST_MM_S = 11_111
"""40 km/h: the legal limit (002, 3.2.2)."""
RECOVERY_MM_S = 13_889
"""50 km/h while recovering: over 40 km/h, how far the paper does not say."""
GAINS_MM_S2, BRAKES_MM_S2 = 900, 1_100
"""Practice: service rates of a tram."""
AT_STOP_MM = 40_000
"""Two trams serve a stop at once (002, figure 8); the second stands so far before the post at most."""

OPENS_S, BOARDS_S = 8, 2.2
"""Practice: doors, and each passenger who boards and pays."""
BOARDS_A_MINUTE = 0.9
"""At a common stop, off-peak; at the peaks twice as many.  Practice: 60,000 a day on such a line and its return."""
PEAK_BOARDS = 2.0
SKIPPED = 0.08
"""The share of stops at which, off-peak, nobody boards or alights: it is passed.  Practice."""
SIGNAL_S, RED_S = 100, 45
"""Practice: cycle and red of a road signal, one in each section; trams have no priority."""
SIGNAL_AT = 0.6
"""The share of the section at which it stands."""


@dataclass(frozen=True)
class Day:
    """What is drawn once for a day.

    ``stops_mm``: where the stops are.  ``boards_a_second``: at each, off-peak.  ``signal_s``: when each section's
    signal turns red.  ``begins_s``: when each run begins; ``leaves_at``: its last stop on this way.
    """

    stops_mm: Whole
    boards_a_second: npt.NDArray[np.float64]
    signal_s: Whole
    begins_s: Whole
    leaves_at: Whole


NOTHING = np.zeros(0, np.int64)


def other_way(day: Day, chance: np.random.Generator) -> Day:
    """Give the other way of the same line: its stops from the far end on, with signals of their own, and no timetable.

    Who has run along the line comes back when it has turned.
    """
    return Day(
        stops_mm=(day.stops_mm[-1] - day.stops_mm[::-1]).astype(np.int64),
        boards_a_second=day.boards_a_second[::-1].copy(),
        signal_s=chance.integers(0, SIGNAL_S, STOPS),
        begins_s=NOTHING,
        leaves_at=NOTHING,
    )


def is_peak(second: int) -> bool:
    """Tell whether this is the morning's or the evening's peak."""
    return any(begins <= second < ends for begins, ends in PEAKS_S)


def timetable() -> Whole:
    """Give when runs are to begin."""
    times = [OPEN_S]
    while times[-1] < CLOSE_S:
        times.append(times[-1] + (PEAK_HEADWAY_S if is_peak(times[-1]) else HEADWAY_S))
    return np.array(times[:-1], np.int64)


def draw(chance: np.random.Generator) -> Day:
    """Draw a day."""
    apart = chance.integers(LEAST_APART_MM, MOST_APART_MM, STOPS - 1)
    due = timetable()
    late = np.abs(chance.normal(0.0, LATE_S, due.size)).astype(np.int64)
    leaves_at = np.where(np.arange(due.size) % 3 == 2, BRANCH, STOPS - 1)
    return Day(
        stops_mm=np.concatenate(([0], np.cumsum(apart))).astype(np.int64),
        boards_a_second=BOARDS_A_MINUTE / 60 * chance.uniform(0.3, 2.2, STOPS),
        signal_s=chance.integers(0, SIGNAL_S, STOPS),
        begins_s=np.sort(due + late),
        leaves_at=leaves_at.astype(np.int64),
    )
