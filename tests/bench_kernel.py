"""How long a step of the kernel takes in plain CPython, over a recorded hour of traffic of eight trains."""

from __future__ import annotations

import inspect
import os
from collections.abc import Callable, Iterable, Iterator, Mapping
from contextlib import contextmanager
from dataclasses import dataclass
from functools import partial, wraps
from pathlib import Path
from types import ModuleType
from typing import Any

import pytest

from kernel import (
    authority,
    cancellation,
    first_loop,
    recovery,
    release,
    route_setting,
    second_loop,
    standing,
    supervision,
    tail_evidence,
    terminal,
)
from models.layouts import load
from models.simulator.journey import Chances
from models.simulator.traffic import traffic_on
from tests.bench import Figure, timed

ROOT = Path(__file__).resolve().parents[1]
SHARED = Path(os.environ.get("HEISOKU_LAYOUTS", ROOT.parent / "shared" / "layouts"))
MACHINES = (
    authority,
    cancellation,
    first_loop,
    recovery,
    release,
    route_setting,
    second_loop,
    standing,
    supervision,
    tail_evidence,
    terminal,
)
STATES = frozenset({"Centre", "Unit", "Terminal"})
HOUR = 3600


@dataclass(frozen=True)
class Call:
    """One recorded kernel step; ``accepted``: it changed the state."""

    function: Callable[..., object]
    arguments: tuple[Any, ...]
    accepted: bool


def steps_of(module: ModuleType) -> Mapping[str, Callable[..., object]]:
    """The functions of a machine that give a next state."""
    return {
        name: value
        for name, value in vars(module).items()
        if inspect.isfunction(value) and value.__annotations__.get("return") in STATES
    }


@contextmanager
def recording() -> Iterator[list[Call]]:
    """Every kernel step taken meanwhile, in order; steps inside steps are part of them."""
    calls: list[Call] = []
    inside = [False]

    def recorded(function: Callable[..., object]) -> Callable[..., object]:
        @wraps(function)
        def call(*arguments: Any) -> object:
            if inside[0]:
                return function(*arguments)
            inside[0] = True
            after = function(*arguments)
            inside[0] = False
            calls.append(Call(function, arguments, all(after != before for before in arguments)))
            return after

        return call

    with pytest.MonkeyPatch.context() as patch:
        for module in MACHINES:
            for name, function in steps_of(module).items():
                patch.setattr(module, name, recorded(function))
        yield calls


def hour_on(path: Path, trains: int) -> list[Call]:
    """An hour of traffic, every train on its way; a message in five is lost, one tag in 500 missed."""
    with recording() as calls:
        traffic = traffic_on(load(path), 1, Chances(loss=0.2, missed_tag=0.002), trains=trains)
        traffic.run(HOUR)
    assert traffic.finished > 0, "no train has run a route"
    return calls


def bench_kernel_steps() -> Iterable[Figure]:
    """Record the hour, then replay its steps one by one."""
    path, trains = SHARED / "osrd-small_infra.json", 8
    what = f"kernel step, an hour of {trains} trains on {path.stem}"
    if not path.is_file():
        path, trains = ROOT / "layouts" / "junction.toml", 3
        what = f"kernel step, an hour of {trains} trains on {path.stem} (osrd-small_infra is absent)"
    calls = hour_on(path, trains)
    for call in calls[:1000]:
        call.function(*call.arguments)
    yield timed(what, [partial(call.function, *call.arguments) for call in calls])
    share = 100 * sum(call.accepted for call in calls) / len(calls)
    yield Figure(f"{what}: accepted", share, share, "%", len(calls))
    by: dict[str, list[Call]] = {}
    for call in calls:
        by.setdefault(f"{call.function.__module__.removeprefix('kernel.')}.{call.function.__name__}", []).append(call)
    for name, some in sorted(by.items(), key=lambda item: -len(item[1])):
        yield timed(f"  {name}", [partial(call.function, *call.arguments) for call in some])
