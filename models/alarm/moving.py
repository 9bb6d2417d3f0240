"""Trains as they run, second by second, in m and s; the truth that a handset is held against (A1, A3)."""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np

from models.alarm.faults import KIND
from models.alarm.line import BOUNDS, LENGTH_MM, REGULAR, SHUNTER, STATIONS_MM, TRAINS, YARD_MM
from models.alarm.routes import NOWHERE_M, from_line_m, is_apart, is_of_the_branch, junction_m
from models.alarm.windows import is_of
from models.compiled import compiled

STATIONS_M = tuple(place / 1_000 for place in STATIONS_MM)
LENGTH_M = LENGTH_MM / 1_000
GAINS_M_S2, BRAKES_M_S2 = 0.6, 0.7
"""Railcars on such lines, service brake (engineering practice)."""
SHUNTS_M = (YARD_MM[0] / 1_000 + 50, YARD_MM[1] / 1_000 - 50)
STABLED_M = 35_200.0
FAR = 10**9
WATCHED_M = 3_600.0
"""So far beyond the line's end the next line is on the register: 3,000 m, a train's length, and what it runs while what
is told of it is fresh, and a worker's way."""
CLOSE_M = 0.001
AT_ONCE, ADJOINED, JOINED = (KIND[name] for name in ("turns_at_once", "adjoined", "joined"))
TURNING_S = BOUNDS.turning_ms // 1_000
"""A train that turns at once stands for so long, and no longer."""


class Trains(NamedTuple):
    """Every train at one moment; it is on the line from ``came_s`` until ``left_s``.

    ``below_m``, ``above_m``: how far it reaches from its antenna, which is at ``place_m``.
    """

    place_m: Any
    below_m: Any
    above_m: Any
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


@compiled(forceinline=True)
def end_m(day: Any, on_branch: bool) -> float:
    """Give where the register ends at the upper end of a route: with the line, or with a part of the next one."""
    return LENGTH_M + WATCHED_M if day.begin_s[ADJOINED] >= 0 and not on_branch else LENGTH_M


@compiled
def at_the_beginning(day: Any) -> Any:
    """Give every train where it will begin."""
    place = np.zeros(TRAINS)
    for train in range(REGULAR):
        place[train] = 0.0 if day.heading[train] > 0 else end_m(day, is_of_the_branch(day, train))
    place[SHUNTER], place[SHUNTER + 1] = SHUNTS_M[0] + 50.0, STABLED_M
    return Trains(
        place, day.below_m.copy(), day.above_m.copy(), np.zeros(TRAINS), day.heading.copy(), day.departs_s.copy(),
        day.on_s + COMES_AFTER_S, day.off_s.copy(), day.stop_m.copy(), np.zeros(TRAINS, np.bool_),
        np.zeros(TRAINS + 1, np.int64),
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
def next_station(place_m: float, heading: int, end: float) -> float:
    """Give the next station ahead, or where the register ends."""
    if heading > 0:
        for station in STATIONS_M:
            if station > place_m + CLOSE_M:
                return station
        return end
    for number in range(len(STATIONS_M) - 1, -1, -1):
        if STATIONS_M[number] < place_m - CLOSE_M:
            return STATIONS_M[number]
    return place_m


@compiled(forceinline=True)
def target(day: Any, trains: Any, train: int) -> float:
    """Give where a train will stop next."""
    heading = trains.heading[train]
    if train == SHUNTER:
        return SHUNTS_M[1] if heading > 0 else SHUNTS_M[0]
    end = end_m(day, is_of_the_branch(day, train))
    station, stop = next_station(trains.place_m[train], heading, end), trains.stop_m[train]
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
    elif is_of(day, AT_ONCE, train, second):
        trains.waits_until_s[train] = second + TURNING_S
        trains.will_turn[train] = True
    elif place in (0.0, end_m(day, is_of_the_branch(day, train))):
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
        to_m = target(day, trains, train)
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
    """Give how far a train's nearest part is from the worker, along the track; below 0 where it stands over him."""
    from_m = trains.place_m[train] - trains.below_m[train]
    to_m = trains.place_m[train] + trains.above_m[train]
    if is_apart(day, train, worker_m):
        joint = junction_m(day)
        return float(worker_m - joint + max(from_m - joint, joint - to_m, 0.0))
    return float(max(from_m - worker_m, worker_m - to_m))


@compiled(forceinline=True)
def has_departed(day: Any, trains: Any, train: int, gap: float, worker_m: float) -> bool:
    """Tell whether a train is past the worker by 100 m, from end to end, and ran last away from him (A3).

    Wherever a train of the other route is beyond the junction, he has to reckon with it.
    """
    if is_apart(day, train, worker_m) and trains.place_m[train] + trains.above_m[train] > junction_m(day):
        return False
    return gap >= 100.0 and (trains.heading[train] > 0) == (trains.place_m[train] > worker_m)


STRANGE_M, STRANGE_M_S = 6_000.0, 20.0
"""A train beyond the register runs to and fro as far and as fast as that, up to where it ends and away from there."""


@compiled(forceinline=True)
def joint_m(day: Any) -> float:
    """Give where a line joins whose trains no list has; below 0 where none does."""
    return float(abs(day.size[JOINED])) if day.begin_s[JOINED] >= 0 else -1.0


@compiled(forceinline=True)
def stranger_m(day: Any, worker_m: float, second: int) -> float:
    """Give how far a train is from the worker that no list has, beyond where the register ends, if it does."""
    way = (STRANGE_M_S * second) % (2.0 * STRANGE_M)
    to_m = from_line_m(day, worker_m, joint_m(day)) if joint_m(day) >= 0 else NOWHERE_M
    if day.begin_s[ADJOINED] >= 0:
        to_m = min(to_m, from_line_m(day, worker_m, end_m(day, False)))
    return float(to_m + min(way, 2.0 * STRANGE_M - way))
