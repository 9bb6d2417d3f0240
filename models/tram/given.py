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
TURNS_S = 240
"""Where trams join at the junction others come from the terminus: they turn in so long if none is drawn; ours."""
PATIENCE_S = 900
"""On such a day so long passengers wait at most: the other way is not served before the first tram has turned; ours."""
SPEED_ERROR_MM_S = 100
"""Declared: ours, typical of tachometers at walking pace."""

NO_PLANT, NOT_ADDRESSED, NEVER_PRESENT, NEVER_STALE, NEVER_LOST, GPS_BEYOND, ANY_WORD_ENDS, JOINS_UNASKED = range(8)
TAKES_THE_FUTURE, TAKES_UP_ANEW, IGNORES_CONTRADICTION, LEAVES_AT_ONCE = range(8, 12)
"""Faults that tests plant: an order is taken by any tram; every way is clear; no report is too old; a unit goes on
where it has no place; GPS errs beyond its bound, and says that it does not; whatever is told of the other way ends a
run, however old it is; a tram joins at the junction without asking whether one behind may run faster to there; a
display takes an order of the future; a tram that is on the way is taken up anew; of two trams that reports have shown
in either order each is taken for the one behind; a unit tells of stops that it has left although it was not seen to run
over one."""


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
    turns_s: int
    away_s: int
    is_back: bool
    patience_s: int
    ahead_ms: int
    asked_anew: int
    number_told_s: int
    wrong_way: int
    plant: int


def other_way(day: Given, chance: np.random.Generator) -> Given:
    """Give the other way of a day: the same line from its other end, with the same faults in the same places.

    Where no tram comes back nothing happens on it.
    """
    along = line.Day(day.stops_mm, day.boards_a_second, day.signal_s, day.begins_s, day.leaves_at)
    back = line.other_way(along, chance)
    where = day.where._replace(
        canyon_mm=int(day.stops_mm[-1]) - day.where.canyon_mm - day.canyon_mm,
        station=line.STOPS - 1 - day.where.station,
        ahead_station=line.STOPS - 1 - day.where.ahead_station,
    )
    return day._replace(
        stops_mm=back.stops_mm,
        boards_a_second=back.boards_a_second,
        signal_s=back.signal_s,
        begins_s=back.begins_s,
        leaves_at=back.leaves_at,
        where=where,
        broken_s=0,
        from_depot=0,
        restarts=0,
        asked_anew=0,
        wrong_way=0,
        is_back=True,
    )


def given(
    chance: np.random.Generator,
    apart: np.random.Generator,
    limits: DispatchLimits = LIMITS,
    present: frozenset[str] | None = None,
    plant: int = NO_PLANT,
    beyond: frozenset[str] = frozenset(),
) -> tuple[Given, dict[str, float]]:
    """Draw a day and its faults; what is drawn does not depend on the limits.

    ``apart``: draws what a day has beside, which changes nothing else of it.  ``beyond``: faults that it has besides.
    """
    day = line.draw(chance)
    own = faults.alone(apart)
    drawn = faults.draw(chance, apart, own, present, beyond)
    assert list(drawn) == list(FAULTS)
    where = faults.place(chance, own, int(day.stops_mm[-1]))
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
        turns_s=round(drawn["both_ways"]) or (TURNS_S if drawn["junction"] > 0 else 0),
        away_s=round(60 * drawn["junction"]),
        is_back=False,
        patience_s=PATIENCE_S if drawn["both_ways"] + drawn["junction"] > 0 else line.CLOSE_S,
        ahead_ms=round(1_000 * drawn["order_from_the_future"]),
        asked_anew=round(drawn["asked_anew"]),
        number_told_s=round(drawn["number_of_another"]),
        wrong_way=round(drawn["wrong_way"]),
        plant=plant,
    ), drawn
