"""Cycles of a train as machine code: the same source as CPython's, with the kernel's machines compiled.

The computer stays a record of compiled code from one second to the next.  Where the front is and what the brake
does is asked each second and given with the cycles; all the rest is fetched when somebody asks for it.
"""

from __future__ import annotations

from functools import cache
from typing import Any

from numba.typed import List

from kernel.onboard import computer as computing
from kernel.onboard import odometry, speed_limit, split
from kernel.onboard.braking import Brake
from kernel.onboard.computer import Computer
from kernel.onboard.limits import Limits
from kernel.onboard.odometry import Motion
from models.compiled import compile_machines, compiled, packed, unpacking
from models.simulation.cycles import Given, Machines, Moving, Ran, cycles_of
from models.simulation.sensors import Errors, Kept, sensing

_motion_of, _brake_of, _computer_of = unpacking(Motion), unpacking(Brake), unpacking(Computer)


@cache
def made() -> Any:
    """The compiled function; it is compiled when it is first called, and kept for the next process."""
    kernel = compile_machines((computing, odometry, speed_limit, split))
    read = sensing(compiled, kernel.odometry.Readings, kernel.split.Readings, kernel.split.Acceleration)
    kept, limit_mm_s = kernel.computer, kernel.speed_limit.limit_mm_s
    machines = Machines(kept.decide, kept.sense, kernel.odometry.is_located, limit_mm_s, read)
    cycles = cycles_of(machines, compiled)

    @compiled
    def run(held: Any, moving: Any, kept: Any, errors: Any, given: Any, noises: Any, most: int) -> Any:
        limits, before = held[0]
        done, located, moving, kept, computer = cycles(limits, before, moving, kept, errors, given, noises, most)
        held[0] = (limits, computer)
        known = computer.known
        return (done, located, moving, kept), known.motion, computer.brake, known.watch.broken, known.window.passed

    return run


@compiled
def _begun(limits: Any, computer: Any) -> Any:
    held = List()
    held.append((limits, computer))
    return held


@compiled
def _put(held: Any, computer: Any) -> None:
    held[0] = (held[0][0], computer)


@compiled
def _fetched(held: Any) -> Any:
    return held[0][1]


class Compiled:
    """Cycles of one train as machine code: :class:`models.simulation.cycles.Held`."""

    def __init__(self, limits: Limits, computer: Computer) -> None:
        self._run, self._held = made(), _begun(packed(limits), packed(computer))
        self._is_put = True
        self._take(computer)

    def _take(self, computer: Computer) -> None:
        """Have at hand what a computer knows."""
        self._computer: Computer | None = computer
        known = computer.known
        self.motion, self.brake = known.motion, computer.brake
        self.broken, self.passed = known.watch.broken, known.window.passed

    @property
    def computer(self) -> Computer:
        """All that the computer remembers."""
        if self._computer is None:
            self._computer = _computer_of(_fetched(self._held))
        return self._computer

    @computer.setter
    def computer(self, computer: Computer) -> None:
        if computer != self._computer:
            self._is_put = False
            self._take(computer)

    def run(self, moving: Moving, kept: Kept, errors: Errors, given: Given, noises: Any, most: int) -> Ran:
        """Run cycles, as :class:`models.simulation.cycles.Interpreted` does."""
        if not self._is_put:
            _put(self._held, packed(self._computer))
            self._is_put = True
        ran, motion, brake, self.broken, self.passed = self._run(self._held, moving, kept, errors, given, noises, most)
        self.motion, self.brake, self._computer = _motion_of(motion), _brake_of(brake), None
        return Ran(*ran)
