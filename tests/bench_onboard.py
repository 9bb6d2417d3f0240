"""How many cycles of the machines on board run in a second, compiled and in CPython, from the same readings."""

from __future__ import annotations

import os
import time
from collections.abc import Callable, Iterable
from tempfile import TemporaryDirectory
from typing import Any
from unittest.mock import patch

import numba
import numpy as np

from kernel.onboard import odometry, split
from models.compiled import compile_machines, packed, unpacked
from tests.bench import Figure, percentile

CYCLES = 20_000
PASSES = 50
"""How often compiled code goes through the same readings; CPython goes once."""


def bench_odometry() -> Iterable[Figure]:
    """A train that goes and stops, with a wheel that slips now and then."""
    random = np.random.default_rng(1)
    speed = (10_000 * (1 + np.sin(np.arange(CYCLES) / 300))).astype(np.int64)
    slips = random.random(CYCLES) < 0.01
    rows = np.empty((CYCLES, 3), np.int64)
    rows[:, 0] = speed + slips * 3_000
    rows[:, 1] = np.cumsum(speed) // 10
    rows[:, 2] = np.diff(speed, prepend=speed[0]) * 10 + random.integers(-20, 21, CYCLES)
    bounds = odometry.SensorBounds(5_000, 50, 100, 100, 400, 50, 500, 1_500, 4_000, 10, 10_000, 5_000)
    machine = compile_machines([odometry]).odometry
    note_cycle, readings = machine.note_cycle, machine.Readings

    @numba.njit
    def compiled(bounds: Any, motion: Any, rows: Any) -> Any:
        for row in rows:
            motion = note_cycle(bounds, motion, readings(100, True, row[0], row[1], True, row[2]))
        return motion

    def plain(bounds: Any, motion: Any, rows: Any) -> Any:
        for speed_mm_s, way_mm, mm_s2 in rows:
            given = odometry.Readings(100, True, speed_mm_s, way_mm, True, mm_s2)
            motion = odometry.note_cycle(bounds, motion, given)
        return motion

    yield from _compared("odometry", plain, compiled, bounds, odometry.located(0, 1_000, 0), rows)


def bench_split_detection() -> Iterable[Figure]:
    """A whole train, of which one telegram in a hundred is missing."""
    random = np.random.default_rng(2)
    rows = np.empty((CYCLES, 4), np.int64)
    rows[:, :3] = random.integers(-500, 501, (CYCLES, 1)) + random.integers(-40, 41, (CYCLES, 3))
    rows[:, 3] = random.random(CYCLES) >= 0.01
    limits = split.SplitLimits(200, 2_000, 300, 400, 1_000, 5_000)
    machine = compile_machines([split]).split
    note_cycle, readings, acceleration = machine.note_cycle, machine.Readings, machine.Acceleration

    @numba.njit
    def compiled(limits: Any, state: Any, rows: Any) -> Any:
        for row in rows:
            head, left, right = acceleration(row[0], True), acceleration(row[1], True), acceleration(row[2], True)
            state = note_cycle(limits, state, readings(head, row[3] != 0, left, right, 100))
        return state

    def plain(limits: Any, state: Any, rows: Any) -> Any:
        for *three, arrived in rows:
            head, left, right = (split.Acceleration(each, True) for each in three)
            state = split.note_cycle(limits, state, split.Readings(head, arrived != 0, left, right, 100))
        return state

    yield from _compared("split detection", plain, compiled, limits, split.made_up(limits), rows)


def _compared(
    what: str, plain: Callable[..., Any], compiled: Callable[..., Any], parameters: Any, state: Any, rows: Any
) -> Iterable[Figure]:
    """Run both from the same state through the same readings; the states at the end must be equal."""
    listed, taken = rows.tolist(), (packed(parameters), packed(state), rows)
    expected, slow = _taken(plain, (parameters, state, listed))
    with TemporaryDirectory() as empty, patch.dict(os.environ, XDG_CACHE_HOME=empty):
        first, cold = _taken(compiled, taken)
    assert unpacked(first, type(state)) == expected
    assert expected != state
    fast = sorted(CYCLES / _taken(compiled, taken)[1] for _ in range(PASSES))
    yield Figure(f"{what}, cycles in CPython", CYCLES / slow, CYCLES / slow, "cycles/s", CYCLES)
    yield Figure(f"{what}, cycles compiled", fast[PASSES // 2], percentile(fast, 95), "cycles/s", PASSES * CYCLES)
    yield Figure(f"{what}, compiling it", cold * 1000, cold * 1000, "ms", 1)


def _taken(run: Callable[..., Any], arguments: tuple[Any, ...]) -> tuple[Any, float]:
    begin = time.perf_counter()
    result = run(*arguments)
    return result, time.perf_counter() - begin
