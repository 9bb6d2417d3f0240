"""All sensors of many runs of a train on one line: the truth, and the kernel's integers beside it (P1-P6, T16)."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, fields
from typing import Any, TypeVar

import numpy as np

from kernel.onboard.arithmetic import GREATEST_SPEED_MM_S
from kernel.onboard.odometry import GREATEST_WAY_MM
from kernel.onboard.split import GREATEST_ACCELERATION_MM_S2
from models.sensors import adhesion, clock, imu, tachometer, tag_reader, transmission
from models.sensors.draws import Chosen, Draws, Singles, choose, draw
from models.sensors.dynamics import Bools, Motion, run, slope_m_s2
from models.sensors.edge import narrow, whole
from models.sensors.faults import CYCLE_S, Floats
from models.sensors.tag_reader import STAND, Reader, Reads
from models.sensors.track import Ints, Track, read, spots

Record = TypeVar("Record", Motion, "Sensors", Reads, "Whole")

RUNS_A_STEP = 1_024
"""So many runs are moved together: numpy's overhead is spread over them."""
ROWS_A_STEP = 16
"""So many are measured together: their arrays stay within the processor's caches."""
GREATEST_RATE_URAD_S = 10_000_000
"""What is beyond 10 rad/s is no reading."""


@dataclass(frozen=True)
class Setup:
    """What all runs of a batch share.

    ``cycles``: 6,000 are ten minutes, and about 10 km.
    ``beyond``: names of parameters drawn from beyond their declared range.  ``present``: parameters set outright.
    """

    track: Track
    cycles: int = 6_000
    length_m: float = 120.0
    beyond: tuple[str, ...] = ()
    present: Mapping[str, float] | None = None
    reader: Reader = STAND


@dataclass(frozen=True)
class Whole:
    """Integers for the kernel, each within 32 bits, and whether each is valid, shape (runs, cycles).

    In 32 bits to halve the memory: products of them need 64, as the kernel's do.
    """

    numbers: Ints
    valid: Bools


@dataclass(frozen=True)
class Sensors:
    """What the unit is told, shape (runs, cycles); units by name as in the kernel.

    Yaw and pitch in µrad/s; accelerations in mm/s², gravity included; the wheel's way since power-on in mm.
    """

    wheel_mm_s: Whole
    wheel_way_mm: Whole
    force_mm_s2: Whole
    yaw_urad_s: Whole
    pitch_urad_s: Whole
    left_mm_s2: Whole
    right_mm_s2: Whole
    tail_yaw_urad_s: Whole
    tail_source: Ints
    tail_arrived: Bools
    tail_age_ms: Ints
    clocks_synchronous: Bools


@dataclass(frozen=True)
class Traces:
    """Some runs: which, what is true, what is measured, which tags were read, and what was drawn."""

    runs: tuple[int, ...]
    truth: Motion
    sensors: Sensors
    reads: Reads
    values: Mapping[str, Floats]


def traces(setup: Setup, seed: int, runs: Sequence[int]) -> Traces:
    """Make some runs, by number; each is the same in whatever company (P1).

    Raises:
        KeyError: ``setup`` names a parameter that does not exist.
    """
    assert len(runs) > 0, "no runs"
    parts = list(_parts(setup, seed, runs))
    if len(parts) == 1:
        return parts[0]
    return Traces(
        runs=tuple(runs),
        truth=_joined([part.truth for part in parts]),
        sensors=_joined([part.sensors for part in parts]),
        reads=_joined([part.reads for part in parts]),
        values={name: np.concatenate([part.values[name] for part in parts]) for name in parts[0].values},
    )


def _parts(setup: Setup, seed: int, runs: Sequence[int]) -> Iterator[Traces]:
    for start in range(0, len(runs), RUNS_A_STEP):
        some = runs[start : start + RUNS_A_STEP]
        chosen = choose(seed, some, len(setup.track.tags_m), setup.beyond, setup.present)
        truth = run(setup.track, chosen.values, setup.cycles, setup.length_m)
        reads = tag_reader.read(setup.track, truth, chosen, setup.reader)
        yield Traces(tuple(some), truth, sensed(setup, truth, chosen), reads, chosen.values)


def sensed(setup: Setup, truth: Motion, chosen: Chosen) -> Sensors:
    """Measure some runs, a few rows at a time (P1-P6)."""
    made: Sensors | None = None
    for row in range(0, len(truth.head_m), ROWS_A_STEP):
        rows = slice(row, row + ROWS_A_STEP)
        part = measured(setup, rows_of(truth, rows), draw(chosen, rows, setup.cycles))
        made = made or empty_like(part, len(truth.head_m))
        put(made, part, row)
    assert made is not None, "no runs"
    return made


def measured(setup: Setup, truth: Motion, draws: Draws) -> Sensors:
    """Measure some runs, all at once (P1-P6)."""
    track, values = setup.track, draws.values
    cycles = truth.head_m.shape[1]
    wheel = tachometer.measure(adhesion.wheel_speed_m_s(truth.speed_m_s, truth.acceleration_m_s2, values), values)
    head = _head(track, truth, draws)
    left, right, tail_yaw = _tail(track, truth, draws, setup.length_m)
    link = transmission.transmit(draws, cycles)
    here, there = (clock.stamp(draws, place, cycles) for place in (0, 1))
    speed, speaks = narrow(wheel.speed_m_s, 1000, -GREATEST_SPEED_MM_S, GREATEST_SPEED_MM_S)
    way, counts = whole(wheel.way_m, 1000, -GREATEST_WAY_MM, GREATEST_WAY_MM)
    return Sensors(
        wheel_mm_s=Whole(speed, speaks & wheel.valid),
        wheel_way_mm=Whole(way.astype(np.int32), counts & wheel.valid),
        force_mm_s2=_force(head.force_m_s2),
        yaw_urad_s=_rate(head.yaw_rad_s),
        pitch_urad_s=_rate(head.pitch_rad_s),
        left_mm_s2=_force(left),
        right_mm_s2=_force(right),
        tail_yaw_urad_s=_rate(tail_yaw),
        tail_source=link.source,
        tail_arrived=link.arrived,
        tail_age_ms=_age_ms(link, here, there),
        clocks_synchronous=here.synchronous & there.synchronous,
    )


def _head(track: Track, truth: Motion, draws: Draws) -> imu.Inertial:
    """The head's unit."""
    here = spots(track, truth.head_m)
    slope = slope_m_s2(read(track.gradient, here))
    slope += truth.acceleration_m_s2
    head = imu.Inertial(
        force_m_s2=imu.force(slope, draws, "head"),
        yaw_rad_s=imu.turn(truth.speed_m_s, read(track.curvature_per_m, here), draws, "yaw"),
        pitch_rad_s=imu.turn(truth.speed_m_s, read(track.vertical_per_m, here), draws, "pitch"),
    )
    imu.fail(head, draws.values)
    return head


def _tail(track: Track, truth: Motion, draws: Draws, length_m: float) -> tuple[Singles, Singles, Singles]:
    """The tail's two accelerometers and its yaw rate; at a parting, the shock is in both."""
    place_m = truth.head_m - length_m
    place_m -= truth.tail_gap_m
    here = spots(track, place_m)
    slope = slope_m_s2(read(track.gradient, here))
    slope += truth.tail_acceleration_m_s2
    values = draws.values
    for row in np.flatnonzero(values["split_at_s"] < slope.shape[1] * CYCLE_S):
        slope[row, max(1, int(values["split_at_s"][row] / CYCLE_S))] -= np.float32(values["split_shock_m_s2"][row])
    yaw = imu.turn(truth.tail_speed_m_s, read(track.curvature_per_m, here), draws, "tail_yaw")
    return imu.force(slope, draws, "left"), imu.force(slope, draws, "right"), yaw


def _age_ms(link: transmission.Link, here: clock.Clock, there: clock.Clock) -> Ints:
    """How old the newest telegram looks: the head's time now less the tail's stamp on it; before any, 0."""
    rows = np.arange(len(link.source), dtype=np.int32)[:, None] * np.int32(link.source.shape[1])
    measured = np.maximum(link.source, 0)
    age = (np.arange(link.source.shape[1], dtype=np.int32) - measured) * np.float32(100)
    age += here.ahead_ms
    age -= there.ahead_ms.reshape(-1).take(measured + rows)
    return np.where(link.source >= 0, np.rint(age), 0).astype(np.int32)


def _force(values: Singles) -> Whole:
    return Whole(*narrow(values, 1000, -GREATEST_ACCELERATION_MM_S2, GREATEST_ACCELERATION_MM_S2))


def _rate(values: Singles) -> Whole:
    return Whole(*narrow(values, 1_000_000, -GREATEST_RATE_URAD_S, GREATEST_RATE_URAD_S))


def rows_of(record: Record, rows: slice) -> Record:
    """The same record for some of its rows."""
    return type(record)(**{field.name: getattr(record, field.name)[rows] for field in fields(record)})


def empty_like(record: Sensors, runs: int) -> Sensors:
    """The same arrays for another number of runs, with nothing in them yet."""

    def empty(array: Any) -> Any:
        if isinstance(array, Whole):
            return Whole(empty(array.numbers), empty(array.valid))
        return np.empty((runs, *array.shape[1:]), array.dtype)

    return Sensors(**{field.name: empty(getattr(record, field.name)) for field in fields(record)})


def put(whole_of: Sensors | Whole, part: Sensors | Whole, row: int) -> None:
    """Put some rows in their place."""
    for field in fields(part):
        target, source = getattr(whole_of, field.name), getattr(part, field.name)
        if isinstance(source, Whole):
            put(target, source, row)
        else:
            target[row : row + len(source)] = source


def _joined(records: Sequence[Record]) -> Record:
    """Records one below the other."""
    first = records[0]
    if len(records) == 1:
        return first
    joined: dict[str, Any] = {}
    for field in fields(first):
        parts = [getattr(record, field.name) for record in records]
        joined[field.name] = _joined(parts) if isinstance(parts[0], Whole) else np.concatenate(parts)
    made: Record = type(first)(**joined)
    return made
