"""Cycles of a train as machine code: the same source as CPython's, with the kernel's machines compiled.

The computer is handed over as a record, and comes back as one, so that whatever else asks or tells it anything runs
in CPython, as ever.
"""

from __future__ import annotations

from functools import cache
from typing import Any

import numpy as np

from kernel.onboard import computer as computing
from kernel.onboard import odometry, split
from kernel.onboard.computer import Computer
from kernel.onboard.limits import Limits
from models.compiled import compile_machines, compiled, packed, unpacking
from models.simulation.cycles import Given, Machines, Moving, Ran, cycles_of
from models.simulation.sensors import Errors, Kept, sensing


@cache
def made() -> Any:
    """The compiled function; it is compiled when it is first called, and kept for the next process."""
    kernel = compile_machines((computing, odometry, split))
    read = sensing(compiled, kernel.odometry.Readings, kernel.split.Readings, kernel.split.Acceleration)
    machines = Machines(kernel.computer.decide, kernel.computer.sense, kernel.odometry.is_located, read)
    return cycles_of(machines, compiled)


@cache
def _limits(limits: Limits) -> Any:
    return packed(limits)


_record_of = unpacking(Computer)


class Compiled:
    """Cycles of one train; the computer as it came back is kept beside what it was unpacked to."""

    def __init__(self) -> None:
        self._cycles = made()
        self._record: Computer | None = None
        self._packed: Any = None

    def __call__(
        self,
        limits: Limits,
        computer: Computer,
        moving: Moving,
        kept: Kept,
        errors: Errors,
        given: Given,
        noises: list[float],
        most: int,
    ) -> Ran:
        """Run cycles, as :data:`models.simulation.cycles.INTERPRETED` does."""
        if computer is not self._record:
            self._packed = packed(computer)
        noise = np.array(noises)
        cycles, located, after, moving, kept = self._cycles(
            _limits(limits), self._packed, moving, kept, errors, given, noise, most
        )
        self._packed, self._record = after, _record_of(after)
        return Ran(cycles, located, self._record, moving, kept)
