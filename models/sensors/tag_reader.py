"""The tag reader: how many frames it receives while a tag is within its window (T16, T2).

The antenna reads a tag while it is within a window along the track.  The reader asks, again and again, until
a tag answers; then frame follows frame, each with its time in the air and its processing.  The processing
dominates: by the time in the air alone 14 pages would fit into the 18.5 ms that the tag is there at
100 km/h, where one was received (paper 000, 6.2 and 6.4).
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
import numpy.typing as npt

from models.sensors.draws import Chosen
from models.sensors.dynamics import Bools, Motion
from models.sensors.faults import CYCLE_S, Floats
from models.sensors.track import Ints, Places, Track

WINDOW_MM = 513.0
"""Along the track at the best gap of 300 mm (paper 000, 6.2)."""
PAGE_BITS = 32
BITS_A_S = 25_600
AIR_MS = 1000 * PAGE_BITS / BITS_A_S
"""1.25 ms: a page of 4 bytes at 25.6 kbit/s (paper 000, table 2)."""


@dataclass(frozen=True)
class Reader:
    """A reader with its kind of tag (T16).

    ``window_mm``: along the track.  ``air_ms``: of one page.  ``processing_ms``: of one frame, beside that.
    ``asks_ms``: between two questions while no tag answers.  ``frame_errors``: share of frames with errors.
    """

    window_mm: float
    air_ms: float
    processing_ms: float
    asks_ms: float
    frame_errors: float

    @property
    def frame_ms(self) -> float:
        """From one frame to the next."""
        return self.air_ms + self.processing_ms


NO_BOUNDARY = 2**31
ASKS_MS = 2 * AIR_MS
"""Ours: a question is about as long as the answer."""


def calibrated(fastest_km_h: float, window_mm: float = WINDOW_MM) -> Reader:
    """A reader whose processing time is *calibrated*: one frame is received for certain up to this speed (T16).

    The paper gives the speed and not the time; the question's phase is at its worst.
    """
    there_ms = window_mm / (fastest_km_h / 3.6)
    return Reader(window_mm, AIR_MS, there_ms - ASKS_MS - AIR_MS, ASKS_MS, 0.0)


STAND = calibrated(100.0)
"""ISO 15693 on the rotating stand: one page at 100 km/h (paper 000, 6.2)."""
STAND_ICODE1 = calibrated(160.0)
"""ICODE1, not of that standard: one page at 160 km/h (paper 000, 6.2)."""
ON_TRAIN_WINDOW = 0.92
"""Ours: what metal behind the antenna and steel in concrete sleepers leave of the window; the paper says
"slightly fewer frames" (6.3) and measures no window on the train."""


def on_train(reader: Reader, share: float = ON_TRAIN_WINDOW) -> Reader:
    """The same reader under a train: a window smaller by metal nearby (T16)."""
    return replace(reader, window_mm=reader.window_mm * share)


def frames(reader: Reader, speed_m_s: Floats, phase: Floats, window_share: Floats | float = 1.0) -> Places:
    """How many whole frames fit while a tag is within the window; ``phase`` in [0, 1) is the question's (T16).

    At a standstill any number: 1,000 here.
    """
    there_ms = reader.window_mm * window_share / np.maximum(speed_m_s, 1e-3)
    left_ms = there_ms - phase * reader.asks_ms
    return np.clip(np.floor(left_ms / reader.frame_ms + 1e-9), 0, 1_000).astype(np.int64)


def without_errors(count: Places, errors: Floats | float, uniform: Floats) -> Places:
    """How many of some frames come without an error: binomial, by its distribution turned round (T16).

    Exact for up to 30 frames; of more, 30 are drawn and the rest is taken as good.
    """
    drawn = np.minimum(count, 30)
    share = np.broadcast_to(np.asarray(errors, np.float64), count.shape)
    bad, chance = np.zeros(count.shape, np.int64), (1 - share) ** drawn
    reached = chance.copy()
    for number in range(1, 31):
        bad[(uniform >= reached) & (number <= drawn)] = number
        chance = chance * (drawn - number + 1) / number * share / np.maximum(1 - share, 1e-9)
        reached += np.maximum(chance, 0)
    return count - bad


@dataclass(frozen=True)
class Reads:
    """What the head's antenna read of each tag, shape (runs, tags).

    ``cycle``: in which it was passed, -1 if it never was.  ``frames``: without error.
    ``off_m``: so far beyond the tag's place the one lies, by the list, that answered: of the neighbouring track.
    """

    cycle: Ints
    frames: npt.NDArray[np.int64]
    off_m: Floats


def read(track: Track, motion: Motion, chosen: Chosen, reader: Reader = STAND) -> Reads:
    """Read every tag that the head passes (T2, T16).  The antenna is taken to be at the head."""
    runs, cycles = motion.head_m.shape
    apart = 2 * (track.length_m + 100_000.0)
    flat = (np.maximum.accumulate(motion.head_m, axis=1) + (np.arange(runs) * apart)[:, None]).reshape(-1)
    sought = track.tags_m + (np.arange(runs) * apart)[:, None]
    index = np.searchsorted(flat, sought) - (np.arange(runs) * cycles)[:, None]
    passed = (index > 0) & (index < cycles)
    cycle = np.where(passed, index, -1).astype(np.int32)
    speed = np.take_along_axis(motion.speed_m_s, np.where(passed, index, 0), axis=1).astype(np.float64)
    values, errors = chosen.values, chosen.values["frame_errors"][:, None]
    count = frames(reader, speed, chosen.reads[:, :, 0], values["window_share"][:, None])
    good = np.where(passed, without_errors(count, errors, chosen.reads[:, :, 1]), 0)
    good[next_pair(track, cycle, values["pair_lost_at_s"])] = 0
    off_m = np.where(next_pair(track, cycle, values["crosstalk_at_s"]), values["crosstalk_m"][:, None], 0.0)
    return Reads(cycle, good, off_m)


def next_pair(track: Track, cycle: Ints, at_s: Floats) -> Bools:
    """Which tags are of the first boundary that the head passes after a time, shape (runs, tags)."""
    after = (cycle >= 0) & (cycle * CYCLE_S > at_s[:, None]) & (np.arange(cycle.shape[1]) % 2 == 0)
    boundary = np.where(after, track.boundary_of, NO_BOUNDARY).min(axis=1, initial=NO_BOUNDARY)
    return np.asarray(boundary[:, None] == track.boundary_of)


def passing_s(cycle: Ints) -> Floats:
    """The time at which a tag was passed, to a cycle; not a number where it never was."""
    return np.where(cycle >= 0, (cycle + 1) * CYCLE_S, np.nan)
