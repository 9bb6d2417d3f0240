"""Trains that couple and part at a station on their way: a number goes or comes, and a train is longer or shorter (A2).

Two trains that meet couple, head to head: one number goes on for both, and nothing runs under the other any more.  Of a
train that parts, the rear runs back under a number of its own, which a person has entered before (A2).
"""

from __future__ import annotations

from typing import Any

from models.alarm.faults import KIND
from models.alarm.line import REGULAR
from models.alarm.moving import COMES_AFTER_S, FAR, LENGTH_M, STATIONS_M
from models.alarm.routes import is_of_the_branch
from models.compiled import compiled

COUPLED, PARTED = KIND["coupled"], KIND["parted"]
STAYS_S = 30
"""Trains stand for so long after they have coupled or parted."""
STOPS_WITHIN_M = 1_000.0
"""A train that is nearer than that to a station does not stop there for the first time."""
TOUCH_M = 0.01


@compiled(forceinline=True)
def first_of(day: Any, kind: int) -> int:
    """Give the first of the two trains; the other one is the next, which runs the other way."""
    return int(min(day.train[kind], REGULAR - 2))


@compiled(forceinline=True)
def stands_at_a_station(trains: Any, train: int, second: int) -> bool:
    """Tell whether a train stands at a station on its way."""
    if not trains.came_s[train] <= second < trains.left_s[train] or trains.speed_m_s[train] > 0:
        return False
    for place in STATIONS_M:
        if trains.place_m[train] == place:
            return bool(0.0 < place < LENGTH_M)
    return False


@compiled(forceinline=True)
def run_alike(day: Any, one: int) -> bool:
    """Tell whether a train and the next are of the same route."""
    return is_of_the_branch(day, one) == is_of_the_branch(day, one + 1)


@compiled(forceinline=True)
def parts(day: Any) -> bool:
    """Tell whether a train is to part on this day."""
    return bool(day.begin_s[PARTED] >= 0 and run_alike(day, first_of(day, PARTED)))


@compiled(forceinline=True)
def ahead_m(trains: Any, train: int) -> float:
    """Give how far a train reaches before its antenna."""
    return float(trains.above_m[train] if trains.heading[train] > 0 else trains.below_m[train])


@compiled(forceinline=True)
def reach_on(trains: Any, train: int, heading: int, more_m: float) -> None:
    """Make a train longer on one side of its antenna, or shorter."""
    if heading > 0:
        trains.above_m[train] += more_m
    else:
        trains.below_m[train] += more_m


@compiled(forceinline=True)
def is_to_meet(day: Any, trains: Any, one: int, other: int, meets_m: float, second: int) -> bool:
    """Tell whether a train is yet to come to the station where another one waits for it."""
    if trains.heading[other] == trains.heading[one] or day.turns[other] or trains.came_s[other] >= FAR:
        return False
    if trains.stop_m[other] >= 0 and trains.stop_m[other] != meets_m:
        return False
    far_m = (trains.place_m[other] - meets_m) * trains.heading[one]
    return bool(second < trains.left_s[other] and (far_m > STOPS_WITHIN_M or trains.stop_m[other] == meets_m))


@compiled(forceinline=True)
def couple(day: Any, trains: Any, second: int) -> None:
    """A train waits at a station for the one that it is to meet, and they couple when that has come (A2)."""
    one = first_of(day, COUPLED)
    other = one + 1
    if not stands_at_a_station(trains, one, second) or trains.will_turn[one] or not run_alike(day, one):
        return
    touch_m = ahead_m(trains, one) + ahead_m(trains, other)
    meets_m = trains.place_m[one] + trains.heading[one] * touch_m
    apart_m = abs(trains.place_m[other] - meets_m)
    is_there = trains.came_s[other] <= second < trains.left_s[other]
    if (
        is_there
        and trains.speed_m_s[other] == 0.0
        and apart_m < TOUCH_M
        and trains.heading[other] != trains.heading[one]
    ):
        goes_on, ends = (one, other) if day.size[COUPLED] > 0 else (other, one)
        reach_on(trains, goes_on, trains.heading[goes_on], trains.below_m[ends] + trains.above_m[ends])
        trains.left_s[ends], trains.waits_until_s[ends] = second, FAR
        trains.waits_until_s[goes_on], trains.will_turn[goes_on] = second + STAYS_S, False
    elif second < day.end_s[COUPLED] and is_to_meet(day, trains, one, other, meets_m, second):
        trains.stop_m[other] = meets_m
        trains.waits_until_s[one] = max(trains.waits_until_s[one], second + STAYS_S)


@compiled(forceinline=True)
def part(day: Any, trains: Any, second: int) -> None:
    """A train stands at a station; its rear is entered under another number, and is a train once it may be (A2)."""
    one = first_of(day, PARTED)
    other = one + 1
    came_s, back = trains.came_s[other], -day.heading[one]
    rear_m = day.below_m[other] + day.above_m[other]
    if came_s >= FAR:
        if not stands_at_a_station(trains, one, second) or trains.heading[one] == back or trains.will_turn[one]:
            return
        if second < day.begin_s[PARTED]:
            return
        behind_m = trains.below_m[one] if back < 0 else trains.above_m[one]
        inside_m = day.above_m[other] if back > 0 else day.below_m[other]
        trains.place_m[other] = trains.place_m[one] + back * (behind_m - inside_m)
        trains.came_s[other], trains.waits_until_s[other] = second + 1 + COMES_AFTER_S, FAR
    if second <= trains.came_s[other] and trains.waits_until_s[other] == FAR:
        trains.waits_until_s[one] = max(trains.waits_until_s[one], trains.came_s[other] + STAYS_S)
    if second == came_s:
        reach_on(trains, one, back, -rear_m)
        trains.waits_until_s[other] = second + STAYS_S


@compiled
def wait_to_part(day: Any, trains: Any) -> None:
    """In the morning what is yet to part is one train, and the other number runs nowhere (A2)."""
    if parts(day):
        one = first_of(day, PARTED)
        reach_on(trains, one, -day.heading[one], day.below_m[one + 1] + day.above_m[one + 1])
        trains.came_s[one + 1] = FAR


@compiled
def couple_and_part(day: Any, trains: Any, second: int) -> None:
    """A second passes for trains that couple or part, after all have moved."""
    if day.begin_s[COUPLED] >= 0 and second >= day.begin_s[COUPLED]:
        couple(day, trains, second)
    if parts(day):
        part(day, trains, second)
