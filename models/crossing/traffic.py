"""A day's trains and faults, drawn from the seed and the day's number alone (X1 to X6)."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
import numpy.typing as npt

from models.crossing.faults import DRAWN_APART, FAULTS, KIND
from models.crossing.sites import CAR_UM, HOURS, PEAK, Trial

Ints = npt.NDArray[np.int64]
Floats = npt.NDArray[np.float64]
Records = npt.NDArray[np.void]
TRACKS = 2
HOUR_S = 3_600
CLOSE_ROADS = KIND["close_roads"]
SECONDS = len(HOURS) * HOUR_S
NEVER = -1
POOL = 1 << 16
"""Numbers of a day's noise; each train begins elsewhere in it."""
TRACTION_M_S2 = (0.55, 0.88)
"""2.0 to 3.2 km/h/s from a standstill (practice)."""
CONTACT_M = (1_600.0, 2_200.0)
"""Where contact is made, before the crossing: the reach of the outermost trackside radio (ours)."""
PROMISE = 0.7
"""The share of trains with radio that promise a ceiling, on days with faults (ours)."""
ASKS, ASKS_M = 0.2, (200.0, 1_600.0)
"""So many of them ask to go faster, as after a late departure; so far before the road (ours)."""
PERSON_S = (240, 900)
"""Until somebody has come, looked and released (ours)."""


TRAIN = np.dtype(
    [
        *((name, np.int64) for name in ("track", "local", "at_s", "radio", "contact_um")),
        *((name, np.int64) for name in ("trick", "trick_um", "trick_s", "person_s", "promises", "asks_um")),
        ("dwell_s", np.int64, (2,)),
        *((name, np.float64) for name in ("share", "traction_m_s2")),
    ]
)
"""What is drawn of a train.

``local``: it is the second kind.  ``at_s``: when it is due at the line's beginning.  ``dwell_s``: at both stations.
``share``: of its limit.  ``traction_m_s2``: from a standstill.  ``contact_um``: where contact is made, if it has radio.
``trick``: a fault of this train's, by its number; ``trick_um``, ``trick_s``: where, and how long.
``promises``: it promises a ceiling; ``asks_um``: it asks to go faster so far before the road, if it is not -1.
``person_s``: how long somebody takes to come and look.
"""
WINDOW = np.dtype([("begin_s", np.int64), ("end_s", np.int64), ("track_of", np.int64), ("size", np.float64)])
"""When a fault is there, on which track, and how large it is; it does not happen if it begins at -1."""


class Day(NamedTuple):
    """What is drawn of a day: trains in order of track and time, faults in theirs, noise.

    ``on``: which faults are there in the second that is simulated.  ``arms_cycles``: how long arms take to come down.
    """

    trains: Records
    faults: Records
    on: npt.NDArray[np.bool_]
    normal: Floats
    uniform: Floats
    arms_cycles: int


def generator(seed: int, *of: int) -> np.random.Generator:
    """The generator of one day, or of a part of it, the same whatever other days are made."""
    return np.random.Generator(np.random.SFC64(np.random.SeedSequence(seed, spawn_key=of)))


def drawn(
    seed: int, day: int, trial: Trial, beyond: tuple[str, ...] = (), quiet: bool = False, promise: float = PROMISE
) -> Day:
    """Draw a day; ``beyond``: faults beyond what is assumed, by name; ``quiet``: no faults at all, and all have radio.

    ``promise``: the share of trains with radio that promise a ceiling; on quiet days none of them asks to go faster.

    Raises:
        KeyError: ``beyond`` names no fault.
    """
    source = generator(seed, day)
    windows = faults(source, generator(seed, day, 1), beyond, quiet)
    track, at_s = timetable(source, trial)
    count = len(at_s)
    trains = np.zeros(count, TRAIN)
    trains["track"], trains["at_s"] = track, at_s
    peak = np.isin(HOURS[0] + at_s // HOUR_S, PEAK)
    least, most = (np.where(peak, trial.share[2 + end], trial.share[end]) for end in (0, 1))
    shortest, longest = (np.where(peak, trial.dwell_s[2 + end], trial.dwell_s[end])[:, None] for end in (0, 1))
    no_radio, late = windows[KIND["no_radio"]], windows[KIND["late_contact"]]
    contact_m = source.uniform(*CONTACT_M, count)
    is_late = (at_s >= late["begin_s"]) & (at_s < late["end_s"])
    trains["contact_um"] = np.round(1e6 * np.where(is_late, late["size"], contact_m))
    trains["local"] = source.random(count) >= trial.express_share
    trains["radio"] = source.random(count) >= no_radio["size"]
    trains["dwell_s"] = np.round(shortest + source.random((count, 2)) * (longest - shortest))
    trains["share"] = least + source.random(count) * (most - least)
    trains["traction_m_s2"] = source.uniform(*TRACTION_M_S2, count)
    trains["person_s"] = source.integers(*PERSON_S, count)
    trick(source, trains, windows)
    accompany(trains, windows)
    promised(generator(seed, day, 2), trains, promise, quiet)
    come_back(generator(seed, day, 3), trial, trains, windows)
    arms_cycles = int(source.integers(8, 11))
    return Day(
        trains, windows, np.zeros(len(FAULTS), np.bool_), source.standard_normal(POOL), source.random(POOL), arms_cycles
    )


def come_back(source: np.random.Generator, trial: Trial, trains: Records, windows: Records) -> None:
    """Let a train stop beyond the road and come back; where another road lies close by, none does."""
    for name, chance in zip(COME_BACK, source.random(len(COME_BACK)), strict=True):
        window = windows[KIND[name]]
        if windows[CLOSE_ROADS]["begin_s"] != NEVER:
            window["begin_s"] = window["end_s"] = NEVER
        able = np.flatnonzero((trains["at_s"] >= window["begin_s"]) & (trains["trick"] == NEVER))
        if window["begin_s"] == NEVER or not len(able):
            continue
        chosen = able[int(chance * min(len(able), 10))]
        cars = (trial.local if trains["local"][chosen] else trial.express).cars
        trains["trick"][chosen] = KIND[name]
        trains["trick_um"][chosen] = -round(1e6 * window["size"]) - cars * CAR_UM
        trains["trick_s"][chosen] = window["end_s"] - window["begin_s"]


def promised(source: np.random.Generator, trains: Records, promise: float, quiet: bool) -> None:
    """Draw which trains promise a ceiling, and which of them ask to go faster, and where."""
    count = len(trains)
    trains["promises"] = (source.random(count) < promise) & (trains["radio"] == 1)
    asks = source.random(count) < (0.0 if quiet else ASKS)
    trains["asks_um"] = np.where(asks, np.round(1e6 * source.uniform(*ASKS_M, count)), NEVER)


def accompany(trains: Records, windows: Records) -> None:
    """Let trains without radio run beside trains with radio on the other track, or close behind them on one."""
    beside, behind = windows[KIND["beside"]], windows[KIND["close_behind"]]
    theirs, others = (np.flatnonzero(is_in(trains, beside) & (trains["track"] == track)) for track in range(TRACKS))
    pairs = min(len(theirs), len(others))
    alike(trains, theirs[:pairs], others[:pairs])
    row = np.flatnonzero(is_in(trains, behind) & (trains["track"] == behind["track_of"]))
    pairs = len(row) // 2
    alike(trains, row[0 : 2 * pairs : 2], row[1 : 2 * pairs : 2])
    for track in range(TRACKS):
        on_it = trains["track"] == track
        trains["at_s"][on_it] = np.maximum.accumulate(trains["at_s"][on_it])


def is_in(trains: Records, window: np.void) -> npt.NDArray[np.bool_]:
    """Tell which trains come in a fault's time."""
    within: npt.NDArray[np.bool_] = (trains["at_s"] >= window["begin_s"]) & (trains["at_s"] < window["end_s"])
    return within


def alike(trains: Records, heard: Ints, unheard: Ints) -> None:
    """Let trains without radio come with others that have one, as fast as those."""
    for name in ("at_s", "local", "share", "traction_m_s2"):
        trains[name][unheard] = trains[name][heard]
    trains["radio"][heard], trains["radio"][unheard] = 1, 0


def timetable(source: np.random.Generator, trial: Trial) -> tuple[Ints, Ints]:
    """Give each train's track and time: evenly in the hour, and off by up to half a minute."""
    tracks, times = [], []
    for track in range(TRACKS):
        phase_s = source.uniform(0.0, 180.0)
        for number, trains in enumerate(trial.trains):
            every_s = HOUR_S / trains
            ideal = number * HOUR_S + (np.arange(trains) * every_s + phase_s) % HOUR_S
            times.append(np.sort(ideal + source.uniform(-30.0, 30.0, trains)))
            tracks.append(np.full(trains, track))
    at_s = np.clip(np.round(np.concatenate(times)), 0, SECONDS - 1).astype(np.int64)
    track_of = np.concatenate(tracks).astype(np.int64)
    order = np.lexsort((at_s, track_of))
    return track_of[order], at_s[order]


def faults(source: np.random.Generator, apart: np.random.Generator, beyond: tuple[str, ...], quiet: bool) -> Records:
    """Give each fault's window; those of power have chances of their own."""
    for name in beyond:
        KIND[name]
    chances = np.concatenate([source.random((len(FAULTS) - len(DRAWN_APART), 5)), apart.random((len(DRAWN_APART), 5))])
    windows = np.zeros(len(FAULTS), WINDOW)
    for window, fault, (happens, long, when, large, where) in zip(windows, FAULTS, chances, strict=True):
        window["begin_s"] = window["end_s"] = NEVER
        if fault.name not in beyond and (quiet or happens >= fault.chance):
            continue
        lasts_s = round(fault.least_s + long * (fault.most_s - fault.least_s))
        window["begin_s"] = round(when * (SECONDS - lasts_s))
        window["end_s"] = window["begin_s"] + lasts_s
        window["size"] = fault.least + large * (fault.most - fault.least)
        window["track_of"] = int(where * TRACKS)
    return windows


COME_BACK = ("turns_beyond", "unasked")
TRICKS = ("stops_short", "turns_back", "sprints", "strong")
"""Faults of one train each."""


def there_m(name: str, track: int, size_m: float, apart_m: float) -> float:
    """Give how far before the first road a train does what it does; ``apart_m``: so far apart two roads are, or 0.

    The second road lies beyond the first for trains on the first track, and before it for those on the other one.  Who
    turns back does so before the road that it comes to first: between two roads a starting signal would stand.
    """
    if name == "turns_back" and track == 1:
        return size_m + apart_m
    return size_m


def trick(source: np.random.Generator, trains: Records, windows: Records) -> None:
    """Give single trains their own fault: one of the first ten after its beginning."""
    trains["trick"], trains["trick_um"] = NEVER, NEVER
    for name, chance in zip(TRICKS, source.random(len(TRICKS)), strict=True):
        window = windows[KIND[name]]
        able = np.flatnonzero((trains["at_s"] >= window["begin_s"]) & (trains["trick"] == NEVER))
        if window["begin_s"] == NEVER or not len(able):
            continue
        chosen = able[int(chance * min(len(able), 10))]
        trains["trick"][chosen] = KIND[name]
        place_m = there_m(
            name, int(trains["track"][chosen]), float(window["size"]), float(windows[CLOSE_ROADS]["size"])
        )
        trains["trick_um"][chosen] = round(1e6 * place_m)
        trains["trick_s"][chosen] = window["end_s"] - window["begin_s"]
