"""What a simulated day is given: line, faults and limits, as compiled code takes them (G2 to G6)."""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np

from kernel.tram.dispatching import DispatchLimits
from kernel.tram.stopping import StopLimits
from models.compiled import packed
from models.tram import faults, line
from models.tram.faults import FAULTS
from models.tram.gps import BOUND_MM, Floats
from models.tram.line import Whole

LIMITS = DispatchLimits(
    ahead_hold_ms=120_000,
    behind_hold_ms=600_000,
    longest_hold_ms=90_000,
    recovery_ms=240_000,
    fresh_ms=11_000,
    order_ms=18_000,
    coming_ms=180_000,
)
"""Ours: half of the peak's interval, and all of it; an order counts for 11 s and one missed cycle; 3 min to come."""
UNCONTROLLED = DispatchLimits(
    ahead_hold_ms=0,
    behind_hold_ms=10**9,
    longest_hold_ms=0,
    recovery_ms=10**9,
    fresh_ms=0,
    order_ms=0,
    coming_ms=180_000,
)
"""As if there were no centre."""
STOP_LIMITS = StopLimits(near_mm=line.AT_STOP_MM, held_mm=line.AT_STOP_MM + 2 * BOUND_MM)
SPEED_ERROR_MM_S = 100
"""Declared: ours, typical of tachometers at walking pace."""

NO_PLANT, NOT_ADDRESSED, NEVER_PRESENT, NEVER_STALE, NEVER_LOST, GPS_BEYOND = range(6)
"""Faults that tests plant: an order is taken by any tram; every way is clear; no report is too old; a unit goes on
where it has no place; GPS errs beyond its bound, and says that it does not."""


class Given(NamedTuple):
    """A day as drawn: see :class:`models.tram.line.Day` and :class:`models.tram.faults.Where`."""

    stops_mm: Whole
    boards_a_second: Floats
    signal_s: Whole
    begins_s: Whole
    leaves_at: Whole
    is_peak: Whole
    limits: Any
    where: Any
    canyon_mm: int
    outage_s: int
    station_deaf: float
    tram_deaf_s: int
    slower_ms: int
    repeats: float
    speed_lost_s: int
    broken_s: int
    is_heedless: bool
    from_depot: int
    wrong_destination: int
    by_hand: float
    restarts: int
    late_runs: float
    plant: int


def given(
    chance: np.random.Generator,
    limits: DispatchLimits = LIMITS,
    present: frozenset[str] | None = None,
    plant: int = NO_PLANT,
) -> tuple[Given, dict[str, float]]:
    """Draw a day and its faults; what is drawn does not depend on the limits."""
    day = line.draw(chance)
    drawn = faults.draw(chance, present)
    assert list(drawn) == list(FAULTS)
    where = faults.place(chance, int(day.stops_mm[-1]))
    return Given(
        stops_mm=day.stops_mm,
        boards_a_second=day.boards_a_second,
        signal_s=day.signal_s,
        begins_s=day.begins_s,
        leaves_at=day.leaves_at,
        is_peak=np.array([line.is_peak(hour * 3_600) for hour in range(30)], np.int64),
        limits=packed(limits),
        where=where,
        canyon_mm=round(1_000 * drawn["canyon"]),
        outage_s=round(drawn["gps_outage"]),
        station_deaf=drawn["station_deaf"],
        tram_deaf_s=round(3_600 * drawn["tram_deaf"]),
        slower_ms=round(1_000 * drawn["centre_slow"]),
        repeats=drawn["repeats"],
        speed_lost_s=round(drawn["speed_lost"]),
        broken_s=round(drawn["breakdown"]),
        is_heedless=drawn["heedless"] > 0,
        from_depot=round(drawn["from_depot"]),
        wrong_destination=round(drawn["wrong_destination"]),
        by_hand=drawn["by_hand"],
        restarts=round(drawn["centre_restart"]),
        late_runs=drawn["late_at_terminus"],
        plant=plant,
    ), drawn
