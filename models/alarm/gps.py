"""What GPS and the traffic display tell of a train, and a handset of its worker, with errors and faults (A1, A2)."""

from __future__ import annotations

from typing import Any

import numpy as np

from models.alarm.faults import KIND
from models.alarm.figures import figure_mm
from models.alarm.line import STABLED, STATION_MM, STATIONS_MM, TUNNELS_MM
from models.alarm.moving import end_m, noise
from models.alarm.routes import is_of_the_branch
from models.alarm.windows import is_of
from models.compiled import compiled

OUT, JUMP, DRIFT, BACKWARDS, FROZEN, CREEPS, PARALLEL = (
    KIND[name] for name in ("gps_out", "gps_jump", "gps_drift", "backwards", "gps_frozen", "gps_creeps", "gps_parallel")
)
KEEPS, TRAIN_M, TRAIN_MOST_M, WORKER_M, WORKER_MOST_M = 0.95, 6.0, 19.9, 5.0, 14.9
"""An error that follows its last value; one deviation and the most for train and worker, rounding to mm aside."""
VALID_M_S = 5 / 3.6
"""Below 5 km/h a receiver tells no direction (engineering practice)."""


@compiled(forceinline=True)
def in_tunnel(place_m: float) -> bool:
    """Tell whether there is no sky."""
    for from_mm, to_mm in TUNNELS_MM:  # noqa: SIM110
        if from_mm < 1_000 * place_m < to_mm:
            return True
    return False


@compiled(forceinline=True)
def wanders(error_m: float, key: int, second: int, who: int, deviation_m: float, most_m: float) -> float:
    """Give the next error of a receiver."""
    bits, drawn = noise(key, second, 3_000 + who), 0.0
    for part in range(4):
        drawn += ((bits >> (15 * part)) & 0x7FFF) / 16_384.0 - 1.0
    spread = deviation_m * np.sqrt((1.0 - KEEPS**2) * 3.0 / 4.0)
    return float(min(most_m, max(-most_m, KEEPS * error_m + spread * drawn)))


@compiled(forceinline=True)
def sees(day: Any, train: int, place_m: float, second: int) -> bool:
    """Tell whether a train's GPS gives a fix: engine on, sky above, no fault (A4, A6)."""
    return train != STABLED and not in_tunnel(place_m) and not is_of(day, OUT, train, second)


@compiled(forceinline=True)
def told_mm(day: Any, train: int, place_m: float, error_m: float, second: int) -> int:
    """Give the figure of where GPS puts a train."""
    off_m = error_m
    for kind in (JUMP, DRIFT):
        if is_of(day, kind, train, second):
            off_m += day.size[kind]
    if is_of(day, CREEPS, train, second):
        off_m += day.size[CREEPS] * (second - day.begin_s[CREEPS]) / (day.end_s[CREEPS] - day.begin_s[CREEPS])
    if is_of(day, PARALLEL, train, second):
        off_m += day.size[PARALLEL] * (place_m - stretch_mm(day, train, place_m)[0] / 1_000) / 100
    return int(figure_mm(day, int(np.floor(1_000 * (place_m + off_m) + 0.5)), is_of_the_branch(day, train)))


@compiled(forceinline=True)
def is_frozen(day: Any, train: int, second: int) -> bool:
    """Tell whether GPS tells once more what it told a second ago, as if it were new: place, direction, running."""
    return is_of(day, FROZEN, train, second) and is_of(day, FROZEN, train, second - 1)


@compiled(forceinline=True)
def stretch_mm(day: Any, train: int, place_m: float) -> Any:
    """Give the stretch that the display shows: a station, or all between two."""
    place_mm = 1_000 * place_m
    before = -STATION_MM
    for station in STATIONS_MM:
        if place_mm < station - STATION_MM:
            return before, station - STATION_MM
        if place_mm <= station + STATION_MM:
            return station - STATION_MM, station + STATION_MM
        before = station + STATION_MM
    last = int(1_000 * end_m(day, is_of_the_branch(day, train))) - STATION_MM
    if last <= before:
        return before, before
    return (before, last) if place_mm < last else (last, last + 2 * STATION_MM)
