"""Trains as they run, second by second, in m and s; the truth that a handset is held against (A1, A3)."""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np

from models.alarm.faults import KIND
from models.alarm.line import LENGTH_MM, REGULAR, SHUNTER, STATIONS_MM, TRAINS, YARD_MM
from models.compiled import compiled

STATIONS_M = tuple(place / 1_000 for place in STATIONS_MM)
LENGTH_M = LENGTH_MM / 1_000
GAINS_M_S2, BRAKES_M_S2 = 0.6, 0.7
"""Railcars on such lines, service brake (engineering practice)."""
SHUNTS_M = (YARD_MM[0] / 1_000 + 50, YARD_MM[1] / 1_000 - 50)
STABLED_M = 35_200.0
FAR = 10**9
CLOSE_M = 0.001


class Trains(NamedTuple):
    """Every train at one moment; it is on the line from ``came_s`` until ``left_s``."""

    place_m: Any
    speed_m_s: Any
    heading: Any
    waits_until_s: Any
    came_s: Any
    left_s: Any
    stop_m: Any
    will_turn: Any
    switched_on: Any
    """The numbers of those whose units are on, as many as its last item says: the others need no time."""


COMES_AFTER_S = 20
"""On the line so long after it is switched on; the list names it before, by more than a list stays fresh (A2)."""
NAMED_AFTER_S = 2
ON_AFTER_S = 16
"""Its unit is on for so long after it has left: the list has dropped it by then."""


@compiled
def at_the_beginning(day: Any) -> Any:
    """Give every train where it will begin."""
    place = np.zeros(TRAINS)
    for train in range(REGULAR):
        place[train] = 0.0 if day.heading[train] > 0 else LENGTH_M
    place[SHUNTER], place[SHUNTER + 1] = SHUNTS_M[0] + 50.0, STABLED_M
    return Trains(
        place, np.zeros(TRAINS), day.heading.copy(), day.departs_s.copy(), day.on_s + COMES_AFTER_S,
        day.off_s.copy(), day.stop_m.copy(), np.zeros(TRAINS, np.bool_), np.zeros(TRAINS + 1, np.int64),
    )  # fmt: skip


@compiled(forceinline=True)
def noise(key: int, one: int, other: int) -> int:
    """Draw 62 bits that follow from three numbers alone."""
    mixed = np.uint64(key) ^ (np.uint64(one) * np.uint64(0x9E3779B97F4A7C15))
    mixed ^= np.uint64(other) * np.uint64(0xC2B2AE3D27D4EB4F)
    mixed = (mixed ^ (mixed >> np.uint64(30))) * np.uint64(0xBF58476D1CE4E5B9)
    mixed = (mixed ^ (mixed >> np.uint64(27))) * np.uint64(0x94D049BB133111EB)
    return int(np.int64((mixed ^ (mixed >> np.uint64(31))) >> np.uint64(2)))


@compiled
def switch_on(trains: Any, second: int) -> None:
    """Note whose units are on."""
    count = 0
    for train in range(TRAINS):
        if trains.came_s[train] - COMES_AFTER_S <= second < trains.left_s[train] + ON_AFTER_S:
            trains.switched_on[count] = train
            count += 1
    trains.switched_on[TRAINS] = count


@compiled(forceinline=True)
def next_station(place_m: float, heading: int) -> float:
    """Give the next station ahead, or where it is the last."""
    if heading > 0:
        for station in STATIONS_M:
            if station > place_m + CLOSE_M:
                return station
    else:
        for number in range(len(STATIONS_M) - 1, -1, -1):
            if STATIONS_M[number] < place_m - CLOSE_M:
                return STATIONS_M[number]
    return place_m


@compiled(forceinline=True)
def target(trains: Any, train: int) -> float:
    """Give where a train will stop next."""
    heading = trains.heading[train]
    if train == SHUNTER:
        return SHUNTS_M[1] if heading > 0 else SHUNTS_M[0]
    station, stop = next_station(trains.place_m[train], heading), trains.stop_m[train]
    ahead = stop >= 0 and (stop - trains.place_m[train]) * heading > 0 and (station - stop) * heading > 0
    return stop if ahead else station


@compiled
def arrive(day: Any, trains: Any, train: int, second: int) -> None:
    """A train has stopped: it stays some time, and may turn, or its journey ends."""
    place = trains.place_m[train]
    drawn = noise(day.key, second, train)
    if train == SHUNTER:
        trains.will_turn[train] = True
        trains.waits_until_s[train] = second + 40 + drawn % 60
    elif place == trains.stop_m[train]:
        trains.waits_until_s[train] = second + int(day.stop_s[train])
        trains.stop_m[train] = -1.0
        trains.will_turn[train] = day.turns[train]
    elif place in (0.0, LENGTH_M):
        trains.left_s[train] = second + 60
        trains.waits_until_s[train] = FAR
    else:
        trains.waits_until_s[train] = second + day.dwell_s[train] + drawn % 15


@compiled
def move(day: Any, trains: Any, second: int) -> None:
    """A second passes for every train."""
    for index in range(trains.switched_on[TRAINS]):
        train = trains.switched_on[index]
        if (
            train > SHUNTER
            or not trains.came_s[train] <= second < trains.left_s[train]
            or (second < trains.waits_until_s[train])
        ):
            continue
        if trains.will_turn[train]:
            trains.heading[train] = -trains.heading[train]
            trains.will_turn[train] = False
        to_m = target(trains, train)
        left_m = abs(to_m - trains.place_m[train])
        speed = min(trains.speed_m_s[train] + GAINS_M_S2, day.speed_m_s[train], np.sqrt(2 * BRAKES_M_S2 * left_m))
        if left_m <= max(speed, 2.0):
            trains.place_m[train], trains.speed_m_s[train] = to_m, 0.0
            arrive(day, trains, train, second)
        else:
            trains.place_m[train] += trains.heading[train] * speed
            trains.speed_m_s[train] = speed


@compiled(forceinline=True)
def gap_m(day: Any, trains: Any, train: int, worker_m: float) -> float:
    """Give how far a train's nearer end is from the worker; below 0 where it stands over him."""
    place = trains.place_m[train]
    return float(max(place - day.below_m[train] - worker_m, worker_m - place - day.above_m[train]))


@compiled(forceinline=True)
def has_departed(trains: Any, train: int, gap: float, worker_m: float) -> bool:
    """Tell whether a train is past the worker by 100 m, from end to end, and ran last away from him (A3)."""
    return gap >= 100.0 and (trains.heading[train] > 0) == (trains.place_m[train] > worker_m)


JOINED = KIND["joined"]
STRANGE_M, STRANGE_M_S = 6_000.0, 20.0
"""A train of the line that joins runs to and fro as far and as fast as that, up to the joint and away from it."""


@compiled(forceinline=True)
def joint_m(day: Any) -> float:
    """Give where a line joins whose trains no list has; below 0 where none does."""
    return float(abs(day.size[JOINED])) if day.begin_s[JOINED] >= 0 else -1.0


@compiled(forceinline=True)
def stranger_m(day: Any, worker_m: float, second: int) -> float:
    """Give how far a train of the line that joins is from the worker, along the track."""
    way = (STRANGE_M_S * second) % (2.0 * STRANGE_M)
    return float(abs(worker_m - joint_m(day)) + min(way, 2.0 * STRANGE_M - way))
