"""Paper 000, IC tags: how many frames are received at which speed, and where 2 of 4 is met (T16).

Frames come from the reader's model, each to the kernel's reader machine, which takes a record when two of
the last four frames agree (4C2, which the paper leaves open).
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

import numpy as np

from kernel.onboard import tag_reader as machine
from kernel.onboard.tag_reader import NO_FRAME, Frame, Level, ReaderLimits
from models.reproduce.tables import Picture, Reproduction, Row, Sensitivity
from models.sensors import tag_reader
from models.sensors.tag_reader import AIR_MS, ASKS_MS, ON_TRAIN_WINDOW, STAND, STAND_ICODE1, Reader, on_train

TITLE = "train control by IC tags"
LIMITS = ReaderLimits(least_mv=800, most_mv=1_200, gap_frames=4)
"""Ours: the antenna's level around 1 V; it is sound throughout here."""
SOUND = Level(mv=1_000, valid=True)
TAG = Frame(valid=True, uid=1, block=1, distance_mm=100_000, kind=1)
ERRORS = 0.05
"""Ours: the end of the declared range of frame errors; the paper counts no lost frame on the stand."""
SURE = 0.999
"""Ours: "met" means that so many passes of a thousand deliver the record, and one that does not is braked for (T5)."""
FASTEST_KM_H = 200

Progress = Callable[[int, int, str], None]


def mean_frames(reader: Reader, speed_km_h: float) -> float:
    """The mean of the frames received over 64 phases of the question (T16)."""
    phase = (np.arange(64) + 0.5) / 64
    return float(tag_reader.frames(reader, np.full(64, speed_km_h / 3.6), phase).mean())


def least_frames(reader: Reader, speed_km_h: float) -> int:
    """The frames received for certain, at the question's worst phase (T16)."""
    return int(tag_reader.frames(reader, np.array([speed_km_h / 3.6]), np.array([1.0]))[0])


def most_speed_km_h(reader: Reader, frames: int) -> float:
    """The highest speed at which so many frames are received for certain: the window over their time (T16)."""
    return 3.6 * reader.window_mm / (frames * reader.frame_ms + reader.asks_ms)


def delivers(frames: list[bool]) -> bool:
    """Tell whether the kernel's reader delivers the record of a tag of which these frames came (T1, T16)."""
    state = machine.mended()
    for good in frames:
        state = machine.note_frame(LIMITS, state, TAG if good else NO_FRAME, SOUND)
        if machine.delivers(state):
            return True
    return False


def delivered(reader: Reader, speed_km_h: float, errors: float, seed: int, passes: int) -> int:
    """How many of some passes of one tag at a speed the kernel's reader delivers (T16)."""
    random = np.random.Generator(np.random.SFC64(np.random.SeedSequence(seed, spawn_key=(round(speed_km_h * 8),))))
    count = tag_reader.frames(reader, np.full(passes, speed_km_h / 3.6), random.random(passes))
    good = random.random((passes, max(1, int(count.max())))) >= errors
    kept = [tuple(row[:some].tolist()) for row, some in zip(good, count.tolist(), strict=True)]
    answers = {each: delivers(list(each)) for each in set(kept)}
    return sum(answers[each] for each in kept)


def exact_share(frames: int, errors: float) -> float:
    """The chance that two of four in a row are good, among so many frames: by the machine, over all patterns (T16)."""
    total = 0.0
    for pattern in range(1 << frames):
        good = [bool(pattern >> place & 1) for place in range(frames)]
        if delivers(good):
            total += (1 - errors) ** sum(good) * errors ** (frames - sum(good))
    return total


def frames_needed(errors: float, sure: float = SURE) -> int:
    """How many frames of one tag make the kernel's reader deliver it so surely (T16); 12 are the most tried."""
    return next((frames for frames in range(2, 13) if exact_share(frames, errors) >= sure), 12)


def tags_needed(reader: Reader, speed_km_h: float) -> int:
    """How many tags in a row give two frames, were their frames counted together (paper 000, 6.5); 0: none do."""
    each = least_frames(reader, speed_km_h)
    return -(-2 // each) if each else 0


def reproduce(seed: int, runs: int, progress: Progress) -> Reproduction:
    """Set the paper's figures beside ours; ``runs`` is how many passes are made at each speed (T16)."""
    train = on_train(STAND)
    speeds = list(range(5, FASTEST_KM_H + 1, 5))
    shares: dict[str, list[float]] = {}
    readers = {"stand": STAND, "on train": train, "stand, ICODE1": STAND_ICODE1}
    for done, (name, reader) in enumerate(readers.items()):
        progress(done, len(readers), name)
        shares[name] = [100 * delivered(reader, speed, ERRORS, seed, runs) / runs for speed in speeds]
    return Reproduction(
        paper="000",
        title=TITLE,
        seed=seed,
        rows=rows(train),
        sensitivities=sensitivities(),
        pictures=pictures(train, shares, speeds),
        parameters=PARAMETERS,
        counts={"passes of a tag": runs * len(speeds) * len(readers), "speeds": len(speeds), "readers": len(readers)},
    )


def rows(train: Reader) -> tuple[Row, ...]:
    """The figures."""
    slow = [5, 15, 25, 35, 45]
    fewer = [1 - mean_frames(train, speed) / mean_frames(STAND, speed) for speed in slow]
    here = STAND.window_mm / (100 / 3.6)
    two, four = most_speed_km_h(STAND, 2), frames_needed(ERRORS)
    return (
        Row("time over a tag at 100 km/h", "6.2", "513 mm at 100 km/h", f"{here:.1f} ms", None, "arithmetic"),
        Row("pages by time in the air alone", "6.4", "several expected", f"{int(here // AIR_MS)} at 100 km/h",
            int(here // AIR_MS) > 1, "more than one"),
        Row("share of the processing in a frame", "6.4", "dominates",
            f"{STAND.processing_ms:.1f} of {STAND.frame_ms:.1f} ms", STAND.processing_ms > STAND.air_ms,
            "more than the air; calibrated on 100 km/h"),
        Row("one page, stand", "6.2", "to 100 km/h", f"to {most_speed_km_h(STAND, 1):.0f} km/h", None, "calibrated"),
        Row("one page, stand, ICODE1", "6.2", "to 160 km/h", f"to {most_speed_km_h(STAND_ICODE1, 1):.0f} km/h", None,
            "calibrated"),
        Row("frames, on train less than stand", "6.3", "slightly fewer, to 45 km/h",
            f"{100 * np.mean(fewer):.0f} % fewer (5 to 45 km/h)", bool(0 < np.mean(fewer) <= 0.2), "0 to 20 % fewer"),
        Row("several frames at high speed", "6.4", "none received",
            f"{mean_frames(STAND, 100):.1f} at 100, {mean_frames(STAND, 130):.1f} at 130 km/h",
            mean_frames(STAND, 100) < 2, "fewer than 2 at 100 km/h"),
        Row("2 frames for certain, stand", "6.5", "open", f"to {two:.0f} km/h", None, "ours"),
        Row("2 frames for certain, on train", "6.5", "open", f"to {most_speed_km_h(train, 2):.0f} km/h", None, "ours"),
        Row("2 frames for certain, stand, ICODE1", "6.5", "open", f"to {most_speed_km_h(STAND_ICODE1, 2):.0f} km/h",
            None, "ours"),
        Row("4 frames for certain, stand", "6.5", "open", f"to {most_speed_km_h(STAND, 4):.0f} km/h", None, "ours"),
        Row(f"2 of 4 in {100 * SURE:.1f} % of passes, on train", "6.5", "open",
            f"{four} frames at {100 * ERRORS:.0f} % errors: to {most_speed_km_h(train, four):.0f} km/h", None, "ours"),
        Row("tags for 2 frames together, on train", "6.5", "several tags, proposed",
            ", ".join(f"{tags_needed(train, speed) or 'none'} at {speed}" for speed in (45, 90, 130)) + " km/h",
            None, "ours; the kernel's reader counts each tag alone"),
        Row("frame time for 2 frames, on train", "6.5", "a faster receiver, proposed",
            ", ".join(f"{frame_ms_for(train, 2, speed):.1f} ms at {speed}" for speed in (100, 130, 160)) + " km/h",
            None, f"ours; it is {STAND.frame_ms:.1f} ms"),
        Row("window for 2 frames", "6.5", "a wider antenna, proposed",
            ", ".join(f"{window_mm_for(STAND, 2, speed):.0f} mm at {speed}" for speed in (100, 130, 160)) + " km/h",
            None, f"ours; it is {tag_reader.WINDOW_MM:.0f} mm"),
    )  # fmt: skip


def frame_ms_for(reader: Reader, frames: int, speed_km_h: float) -> float:
    """The frame time that a reader must have to receive so many at a speed; not below 0 (T16)."""
    return max(0.0, (reader.window_mm / (speed_km_h / 3.6) - reader.asks_ms) / frames)


def window_mm_for(reader: Reader, frames: int, speed_km_h: float) -> float:
    """The window that a reader must have to receive so many at a speed (T16)."""
    return (frames * reader.frame_ms + reader.asks_ms) * speed_km_h / 3.6


def sensitivities() -> tuple[Sensitivity, ...]:
    """Speeds for 2 frames for certain under the train, and for 2 of 4, with each decisive parameter changed."""
    made = []
    base = on_train(STAND)
    changes: tuple[tuple[str, str, Callable[[float], Reader]], ...] = (
        ("window along the track", f"{base.window_mm:.0f} mm", lambda by: replace(base, window_mm=base.window_mm * by)),
        ("processing of a frame (calibrated)", f"{base.processing_ms:.1f} ms",
         lambda by: replace(base, processing_ms=base.processing_ms * by)),
        ("time in the air of a page", f"{base.air_ms:.2f} ms", lambda by: replace(base, air_ms=base.air_ms * by)),
        ("time between questions", f"{base.asks_ms:.1f} ms", lambda by: replace(base, asks_ms=base.asks_ms * by)),
    )  # fmt: skip
    for name, value, changed in changes:
        less, is_, more = (f"{most_speed_km_h(changed(by), 2):.1f} km/h" for by in (0.8, 1.0, 1.2))
        made.append(Sensitivity("2 frames for certain, on train", name, value, less, is_, more))
    less, is_, more = (
        f"{frames_needed(ERRORS * by)} frames, {most_speed_km_h(base, frames_needed(ERRORS * by)):.1f} km/h"
        for by in (0.8, 1.0, 1.2)
    )
    made.append(Sensitivity("2 of 4, on train", "frame errors", f"{100 * ERRORS:.0f} %", less, is_, more))
    return tuple(made)


def pictures(train: Reader, shares: dict[str, list[float]], speeds: list[int]) -> tuple[Picture, ...]:
    """Frames against speed, as the paper's figure 13; and the share of tags delivered by the kernel's reader."""
    fine = [speed / 2 for speed in range(20, 2 * FASTEST_KM_H + 1)]
    to_45 = [speed for speed in fine if speed <= 45]
    return (
        Picture(
            "000_frames",
            "Frames received from one tag, by speed (calibrated on one page at 100 and 160 km/h)",
            "speed, km/h",
            "frames received, mean over the question's phase",
            lines={
                "stand": (fine, [mean_frames(STAND, speed) for speed in fine]),
                "stand, ICODE1": (fine, [mean_frames(STAND_ICODE1, speed) for speed in fine]),
                "on train, to 45 km/h": (to_45, [mean_frames(train, speed) for speed in to_45]),
            },
            levels={"2 frames": [2.0], "1 frame": [1.0]},
            places={"paper: one page, 100 km/h": 100.0, "paper: ICODE1, 160 km/h": 160.0},
        ),
        Picture(
            "000_two_of_four",
            f"Tags delivered by the kernel's reader (2 of 4 frames, {100 * ERRORS:.0f} % frame errors)",
            "speed, km/h",
            "share of passes, %",
            lines={name: (speeds, values) for name, values in shares.items()},
            places={"paper: one page, 100 km/h": 100.0, "paper: ICODE1, 160 km/h": 160.0},
        ),
    )


PARAMETERS = {
    "window": "513 mm along the track at the best gap of 300 mm (paper, 6.2)",
    "air": f"{AIR_MS:.2f} ms: 4 bytes at 25.6 kbit/s (paper, table 2)",
    "processing": f"calibrated: {STAND.processing_ms:.1f} ms, so that one page is received for certain to 100 km/h "
    f"(ICODE1: {STAND_ICODE1.processing_ms:.1f} ms, 160 km/h)",
    "question": f"{ASKS_MS:.1f} ms between questions (ours: about as long as the answer)",
    "window on train": f"{ON_TRAIN_WINDOW} of it (ours: metal and steel nearby; the paper says slightly fewer frames)",
    "frame errors": f"{100 * ERRORS:.0f} % (ours: end of the declared range)",
}
