"""What the tests of the sensor models share: one line, a few runs, and how to take arrays apart."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import fields, is_dataclass
from functools import cache
from typing import Any

import numpy as np

from models.sensors.faults import quiet
from models.sensors.traces import Setup, Traces, traces
from models.sensors.track import Track, line

CYCLES = 3_000


@cache
def track() -> Track:
    """One line."""
    return line(1)


@cache
def some() -> Traces:
    """Some runs with everything within its declared range."""
    return traces(Setup(track(), CYCLES), 7, range(40))


@cache
def perfect() -> Traces:
    """Runs of perfect sensors."""
    return traces(Setup(track(), CYCLES, present=quiet() | {"traction_m_s2": 0.9, "dwell_s": 20.0}), 7, range(3))


def arrays(record: Any) -> Iterator[tuple[str, np.ndarray[Any, Any]]]:
    """Every array of a record, by name."""
    for field in fields(record):
        value = getattr(record, field.name)
        if is_dataclass(value):
            yield from ((f"{field.name}.{name}", array) for name, array in arrays(value))
        elif isinstance(value, np.ndarray):
            yield field.name, value


def of_run(made: Traces, run: int) -> dict[str, Any]:
    """Everything about one run, as bytes."""
    row = made.runs.index(run)
    found = {
        name: array[row].tobytes() for part in (made.truth, made.sensors, made.reads) for name, array in arrays(part)
    }
    return found | {name: value[row] for name, value in made.values.items()}
