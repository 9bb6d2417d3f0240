"""What is drawn of a day before it begins: the timetable, the worker's walk, and the faults (A1).

All of it follows from the campaign's seed and the day's number alone.
"""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np

from models.alarm.faults import FAULTS, KIND, OF_A_HANDSET, OF_A_TRAIN, OF_THEIR_OWN
from models.alarm.line import LENGTH_MM, REGULAR, SHUNTER, STABLED, TRAINS

HOURS = 17
SECONDS = HOURS * 3_600
HOUR_S = 3_600
ADJOINED, BRANCHES = KIND["adjoined"], KIND["branches"]
NEAR_M = 2_500.0
"""So far from a junction at the most, if a branch leaves, is the middle of the worker's walk."""
CARS = 3
"""Of a train, at the most."""


class Drawn(NamedTuple):
    """One day.  A row for each train, or each kind of fault; times in s from the start of traffic, ways in m."""

    key: int
    """For all that is drawn second by second."""
    on_s: Any
    """When a train is switched on, where it begins."""
    departs_s: Any
    heading: Any
    """1 down, -1 up."""
    speed_m_s: Any
    dwell_s: Any
    below_m: Any
    above_m: Any
    """How far it reaches from its antenna; at the head when it begins."""
    stop_m: Any
    """Where it stands between stations, or -1."""
    stop_s: Any
    turns: Any
    off_s: Any
    """When it is switched off, if no journey's end says so."""
    begin_s: Any
    end_s: Any
    train: Any
    size: Any
    """The faults' windows; begin is -1 where there is none."""
    worker_m: float
    """The middle of his walk."""
    walk_m: float
    """He goes so far to either side."""
    walk_m_s: float
    on_branch: bool = False
    """The worker's way is along the branch, from where that leaves the line."""
    handset: int = 0
    """Of the day's worker, or 1: of another one."""


def drawn(
    seed: int, day: int, beyond: tuple[str, ...] = (), worker_m: float | None = None, sound: bool = False
) -> Drawn:
    """Draw a day; the faults named ``beyond`` are there for certain; a ``sound`` day has no others."""
    random, own = np.random.default_rng([seed, day]), np.random.default_rng([seed, day, 1])
    late = np.minimum(random.exponential(120.0, REGULAR), 1_200.0)
    departs = scheduled_s() + late
    heading = np.where(np.arange(TRAINS) % 2 == 0, 1, -1)
    windows = _windows(random, own, departs, beyond, sound)
    length = random.uniform(40.0, 60.0, TRAINS) / cars_less(windows)
    ahead = random.uniform(0.0, 3.0, TRAINS)
    shunts, stays = random.uniform(2, 12) * HOUR_S, random.uniform(3, 5) * HOUR_S
    stop_m = np.full(TRAINS, -1.0)
    stop_s = np.zeros(TRAINS)
    turns = np.zeros(TRAINS, np.bool_)
    for kind in (index for index, fault in enumerate(FAULTS) if fault.name in ("stands", "turns")):
        if windows[0][kind] >= 0:
            train = windows[2][kind]
            stop_m[train] = random.uniform(0.05, 0.95) * LENGTH_MM / 1_000
            stop_s[train] = windows[1][kind] - windows[0][kind]
            turns[train] = FAULTS[kind].name == "turns"
    middle = random.uniform(1_500.0, LENGTH_MM / 1_000 - 1_500.0)
    from_end_m = abs(float(windows[3][ADJOINED]))
    is_near_the_end = windows[0][ADJOINED] >= 0 and worker_m is None
    if is_near_the_end:
        middle = LENGTH_MM / 1_000 - from_end_m
    began = Drawn(
        key=int(random.integers(2**62)),
        on_s=np.concatenate([departs - 150.0, [shunts, stays]]).astype(np.int64),
        departs_s=np.concatenate([departs, [shunts, stays]]).astype(np.int64),
        heading=heading,
        speed_m_s=np.concatenate([random.uniform(60.0, 85.0, REGULAR) / 3.6, [20 / 3.6, 0.0]]),
        dwell_s=random.integers(30, 61, TRAINS),
        below_m=np.where(heading > 0, length - ahead, ahead),
        above_m=np.where(heading > 0, ahead, length - ahead),
        stop_m=stop_m,
        stop_s=stop_s,
        turns=turns,
        off_s=_off(shunts + random.uniform(1_200, 3_600), stays + random.uniform(4, 7) * HOUR_S),
        begin_s=windows[0],
        end_s=windows[1],
        train=windows[2],
        size=windows[3],
        worker_m=middle if worker_m is None else worker_m,
        walk_m=random.uniform(0.0, 800.0) if worker_m is None else 0.0,
        walk_m_s=random.uniform(0.3, 1.5),
    )
    if is_near_the_end:
        return began._replace(walk_m=min(began.walk_m, from_end_m))
    return near_the_junction(seed, day, began) if worker_m is None else began


def near_the_junction(seed: int, day: int, began: Drawn) -> Drawn:
    """Put the worker where a branch leaves, or on it, if one does."""
    random = np.random.default_rng([seed, day, 3])
    if began.begin_s[BRANCHES] < 0:
        return began
    from_m = float(random.uniform(-NEAR_M, NEAR_M))
    return began._replace(worker_m=abs(float(began.size[BRANCHES])) + from_m, on_branch=bool(random.random() < 0.5))


def another(seed: int, day: int, began: Drawn) -> Drawn:
    """Give the same day with another worker, elsewhere, and with a handset whose faults are its own."""
    random = np.random.default_rng([seed, day, 2])
    windows = _windows(random, random, began.departs_s, (), sound=False)
    begin_s, end_s, size = began.begin_s.copy(), began.end_s.copy(), began.size.copy()
    for kind in (KIND[name] for name in OF_A_HANDSET):
        begin_s[kind], end_s[kind], size[kind] = windows[0][kind], windows[1][kind], windows[3][kind]
    return began._replace(
        handset=1,
        on_branch=False,
        begin_s=begin_s,
        end_s=end_s,
        size=size,
        worker_m=abs(float(began.size[KIND["two_workers"]])),
        walk_m=random.uniform(0.0, 800.0),
        walk_m_s=random.uniform(0.3, 1.5),
    )


def scheduled_s() -> Any:
    """Give when each regular train is to depart: one an hour each way."""
    numbers = np.arange(REGULAR)
    return numbers // 2 * HOUR_S + np.where(numbers % 2 == 0, 300, 2_100)


def cars_less(windows: tuple[Any, Any, Any, Any]) -> Any:
    """Give by how much each train is shorter: those that couple or part have one car."""
    begin_s, _end_s, train, _size = windows
    less = np.ones(TRAINS)
    for kind in (KIND["coupled"], KIND["parted"]):
        if begin_s[kind] >= 0:
            first = min(train[kind], REGULAR - 2)
            less[first : first + 2] = CARS
    return less


def _off(shunter_s: float, stabled_s: float) -> Any:
    off_s = np.full(TRAINS, 10 * SECONDS)
    off_s[SHUNTER], off_s[STABLED] = shunter_s, stabled_s
    return off_s


JOURNEY_S = 2_700
"""A train is under way for about so long."""


def _windows(
    of_all: np.random.Generator, own: np.random.Generator, departs_s: Any, beyond: tuple[str, ...], sound: bool
) -> tuple[Any, Any, Any, Any]:
    begin, end, train, size = (np.full(len(FAULTS), -1, np.int64) for _ in range(4))
    for kind, fault in enumerate(FAULTS):
        random = own if fault.name in OF_THEIR_OWN else of_all
        happens, at = random.random() < fault.chance and not sound, random.integers(SECONDS)
        long = random.integers(fault.least_s, fault.most_s + 1)
        train[kind] = random.integers(REGULAR)
        if fault.name in OF_A_TRAIN:
            at = int(departs_s[train[kind]]) + random.integers(JOURNEY_S)
        size[kind] = random.integers(int(fault.least), int(fault.most) + 1) * (1 if random.random() < 0.5 else -1)
        if happens or fault.name in beyond:
            begin[kind], end[kind] = at, at + long
    return begin, end, train, size
