"""Paper 001, 4.3.3: how soon a split is detected, and that none is elsewhere (P5, P6).

A hauled train: two raw sensors at the tail, left and right, whose telegrams come over the radio; the head compares
each with its own acceleration at the time of the tail's measurement, by GPS time.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np
from numpy.lib.stride_tricks import sliding_window_view

from kernel.onboard import split as machine
from kernel.onboard.split import Acceleration, Readings, SplitLimits
from models.rides.onboard import SPLIT_ERROR_MM_S2, UNSEEN_CYCLES
from models.sensors.dynamics import Bools, slope_m_s2
from models.sensors.faults import CYCLE_S, GRAVITY_M_S2, NEVER, SPLIT_LIMITS
from models.sensors.traces import Setup, Traces, traces
from models.sensors.track import Track, line, read, spots

TILT_RATIO = 0.1
"""Ours: the paper tilts the tail's unit by hand and does not say how far; 5.7 degrees show g/10 = 0.98 m/s², which is
what a tail shows that brakes hard, and about twice the threshold."""
AT_S = 200.0
"""Ours: the tilt comes while the train runs."""
SLOW_LINK_S = 1.25
"""Calibrated: the transmission and processing that the paper's 2 s leave, beside 0.75 s of averaging."""
TAIL_M = 100.0
RUNS_M_S = 5.0
"""Ours: a train slower than this counts as standing."""


@dataclass(frozen=True)
class Watch:
    """What the machine said of one run: the cycle of its flag, -1 if none; and how many cycles it watched."""

    flagged: int
    watched: int


def rows(made: Traces, run: int, tilt_m_s2: float, at: int) -> list[Readings]:
    """The readings of one run; from a cycle on, the tail's unit is tilted."""
    sensors = made.sensors
    head, left, right = (
        (each.numbers[run].tolist(), each.valid[run].tolist())
        for each in (sensors.force_mm_s2, sensors.left_mm_s2, sensors.right_mm_s2)
    )
    tilt, found = round(1000 * tilt_m_s2), []
    arrived, sources, ages = (
        each[run].tolist() for each in (sensors.tail_arrived, sensors.tail_source, sensors.tail_age_ms)
    )
    for came, source, age in zip(arrived, sources, ages, strict=True):
        more = tilt if source >= at else 0
        measured = max(source, 0)
        found.append(
            Readings(
                head=Acceleration(head[0][measured], head[1][measured]),
                arrived=came,
                left=Acceleration(left[0][measured] + more, left[1][measured]),
                right=Acceleration(right[0][measured] + more, right[1][measured]),
                age_ms=age,
            )
        )
    return found


def watch(limits: SplitLimits, readings: list[Readings], until_flag: bool = True) -> Watch:
    """Let the kernel watch a run, from the first telegram on (P5)."""
    state, flagged = machine.made_up(limits), -1
    for cycle, each in enumerate(readings):
        state = machine.note_cycle(limits, state, each)
        if state.split:
            flagged = cycle
            if until_flag:
                break
    return Watch(flagged, cycle + 1)


def journeys(seed: int, runs: int, cycles: int, delay_s: float | None = None) -> Traces:
    """Runs of a whole train with sound sensors and a radio as declared; every delay as drawn, or all of one length."""
    present = dict.fromkeys(
        (
            "tachometer_silent_at_s",
            "tachometer_stuck_at_s",
            "inertial_nan_at_s",
            "split_at_s",
            "slip_at_s",
            "rolls_back_at_s",
        ),
        NEVER,
    )
    if delay_s is not None:
        present["delay_s"] = delay_s
    return traces(Setup(line(seed * 1_000), cycles, TAIL_M, present=present), seed, range(runs))


def tilted(limits: SplitLimits, made: Traces, tilt_m_s2: float) -> list[float]:
    """For each run: from the first tilted measurement to the flag, in s; not a number where none came."""
    at, found = int(AT_S / CYCLE_S), []
    for run in range(len(made.runs)):
        seen = watch(limits, rows(made, run, tilt_m_s2, at)[: at + 200])
        found.append((seen.flagged - at) * CYCLE_S if seen.flagged >= at else float("nan"))
    return found


def false_alarms(limits: SplitLimits, made: Traces, progress: Callable[[int, int, str], None]) -> tuple[int, float]:
    """How many whole runs were flagged, and how many hours were watched (P5)."""
    alarms, cycles = 0, 0
    for run in range(len(made.runs)):
        progress(run, len(made.runs), "whole trains")
        seen = watch(limits, rows(made, run, 0.0, 10**9))
        alarms += seen.flagged >= 0
        cycles += seen.watched
    return alarms, cycles * CYCLE_S / 3600


@dataclass(frozen=True)
class Parted:
    """Trains that truly split while they ran: how many, and what the kernel saw of them (P5).

    ``due``: those in which the true difference exceeds threshold and errors for longer than the declared bound;
    ``late``: of these, those with no flag by then.  ``times_s``: from the split to the flag, of all that were flagged.
    """

    running: int
    due: int
    late: int
    times_s: tuple[float, ...]


def parted(limits: SplitLimits, seed: int, runs: int, cycles: int) -> Parted:
    """Let trains truly split, as declared, and the kernel watch them (P5)."""
    present = dict.fromkeys(("tachometer_silent_at_s", "tachometer_stuck_at_s", "inertial_nan_at_s"), NEVER)
    present |= {"split_at_s": AT_S, "split_shock_m_s2": 0.0}
    present |= dict.fromkeys(("slip_at_s", "radio_out_at_s", "rolls_back_at_s"), NEVER)
    track = line(seed * 1_000)
    made = traces(Setup(track, cycles, TAIL_M, present=present), seed, range(10**6, 10**6 + runs))
    at = int(AT_S / CYCLE_S)
    due = due_cycles(limits, made, track, at)
    running, late, times = [run for run in range(runs) if made.truth.speed_m_s[run, at] >= RUNS_M_S], 0, []
    for run in running:
        seen = watch(limits, rows(made, run, 0.0, 10**9)).flagged
        late += due[run] >= 0 and not at <= seen <= due[run]
        if seen >= at:
            times.append((seen - at) * CYCLE_S)
    return Parted(len(running), sum(due[run] >= 0 for run in running), late, tuple(times))


def due_cycles(limits: SplitLimits, made: Traces, track: Track, at: int) -> list[int]:
    """For each run, the cycle by which a split in cycle ``at`` must have been seen; -1 if it need not be (P5).

    As rides judge it: the true difference, gravity included, has exceeded threshold and errors for longer than the
    declared bound.  A head that slows as its tail does shows no difference, and the tail's tags tell.
    """
    truth = made.truth
    head, tail = (
        slope_m_s2(read(track.gradient, spots(track, places)))
        for places in (truth.head_m, truth.head_m - TAIL_M - truth.tail_gap_m)
    )
    differs_m_s2 = np.abs(truth.acceleration_m_s2 + head - truth.tail_acceleration_m_s2 - tail)
    beyond = 1000 * differs_m_s2 > limits.threshold_mm_s2 + SPLIT_ERROR_MM_S2
    beyond[:, :at] = False
    lasted: Bools = np.all(sliding_window_view(beyond, UNSEEN_CYCLES + 1, axis=1), axis=2)
    found: list[int] = np.where(lasted.any(axis=1), lasted.argmax(axis=1) + UNSEEN_CYCLES, -1).tolist()
    return found


def example(limits: SplitLimits, made: Traces, run: int, tilt_m_s2: float) -> dict[str, list[float]]:
    """One run around the tilt, as the paper's figure 12: times, accelerations, difference, and the kernel's mean."""
    at = int(AT_S / CYCLE_S)
    shown: dict[str, list[float]] = {name: [] for name in ("time", "head", "tail", "difference", "mean")}
    state = machine.made_up(limits)
    for cycle, each in enumerate(rows(made, run, tilt_m_s2, at)[: at + 50]):
        state = machine.note_cycle(limits, state, each)
        if cycle >= at - 50:
            head, tail = each.head.mm_s2 / 1000, (each.left.mm_s2 + each.right.mm_s2) / 2000
            mean = machine.total(state.differences_mm_s2) / (2_000 * machine.SAMPLES)
            for name, value in zip(shown, ((cycle - at) * CYCLE_S, head, tail, head - tail, mean), strict=True):
                shown[name].append(value)
    return shown


TILT_M_S2 = GRAVITY_M_S2 * TILT_RATIO


def with_threshold(by: float) -> SplitLimits:
    """The limits with another threshold."""
    return replace(SPLIT_LIMITS, threshold_mm_s2=round(SPLIT_LIMITS.threshold_mm_s2 * by))
