"""What tachometer and inertial sensors of a train say of its motion, with their errors (P1, P5).

The tachometer is the rides' own, and errors are drawn from the ranges declared in ``models.sensors.faults``; a wheel
that slips or a sensor that is silent is a fault, and comes from outside.  What is read in a cycle is a function of
what the sensors remember, as CPython and compiled cycles (``models.simulation.cycles``) both run it.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field
from random import Random
from typing import Any, NamedTuple

import numpy as np

from kernel.onboard.arithmetic import CYCLE_MS
from kernel.onboard.odometry import Readings
from kernel.onboard.split import Acceleration
from kernel.onboard.split import Readings as TailReadings
from models.sensors import tachometer
from models.sensors.faults import FAULTS, NOISE_MOST, PLACE
from models.sensors.tachometer import PULSE_M, Pulses

CYCLE_S = CYCLE_MS / 1_000
SLIP_JOLT_MM_S2 = 6_000
"""A wheel runs away by so much, beyond what trusts it; then it comes back, again and again.

A slide that is held at one speed is beyond what the proofs assume of a wheel, and no fault of this simulation.
"""
SLIP_MOST_MM_S, SLIPS_FROM_MM_S = 6_000.0, 10_000.0
TAIL_AGE_MS = 200
NOISES_A_CYCLE = 3
"""The head's inertial sensor draws one, then the tail's left one, then its right one."""
DRAWN_CYCLES = 600
"""The noise of so many cycles is drawn at once."""


class Errors(NamedTuple):
    """How far the sensors of a train are off; ``scale``: creep and diameter, as a share."""

    scale: float
    bias_mm_s2: float
    noise_mm_s2: float


class Kept(NamedTuple):
    """What the sensors of a train remember from cycle to cycle.

    ``pulses``: the tachometer's count and time of them.
    ``off_mm_s``: how much faster the wheel is than the train.  ``slips_cycles``: it slips so long yet.
    """

    pulses: Pulses = Pulses()
    wheel_mm_s: float = 0.0
    off_mm_s: float = 0.0
    slips_cycles: int = 0
    slips_mm_s2: float = 0.0
    tachometer_silent_cycles: int = 0
    inertial_silent_cycles: int = 0


def slipped(kept: Kept, speed_mm_s: float) -> tuple[float, int, float]:
    """How much faster the wheel is than the train, for how long it slips yet, and by how much.

    The wheel runs away to 6 m/s off and comes back, again and again while it slips; then for good.
    """
    off_mm_s, slips_cycles, slips_mm_s2 = kept.off_mm_s, kept.slips_cycles, kept.slips_mm_s2
    if slips_cycles > 0 and speed_mm_s >= SLIP_MOST_MM_S + 1_000:
        slips_cycles -= 1
        off_mm_s += slips_mm_s2 * CYCLE_S
        if off_mm_s == 0.0 or abs(off_mm_s) >= SLIP_MOST_MM_S:
            slips_mm_s2 = -slips_mm_s2
    elif off_mm_s != 0.0:
        slips_cycles = 0
        step = SLIP_JOLT_MM_S2 * CYCLE_S
        off_mm_s = off_mm_s - step if off_mm_s > 0 else off_mm_s + step
        off_mm_s = 0.0 if abs(off_mm_s) < step / 2 else off_mm_s
    return off_mm_s, slips_cycles, slips_mm_s2


def felt_mm_s2(errors: Errors, gained_mm_s2: float, noise: float) -> int:
    """What an inertial sensor says of a train that gains so much, with a noise in deviations."""
    return round(gained_mm_s2 + errors.bias_mm_s2 + errors.noise_mm_s2 * max(-NOISE_MOST, min(NOISE_MOST, noise)))


@dataclass(frozen=True)
class Sensing:
    """What is read at the head, and at the tail: as CPython runs it, or as compiled code does.

    ``turned``: what is remembered after a cycle: from errors, what was, the train's speed, and what slipped.
    ``head``: from errors, what was and is remembered, what the train gained, and a noise.
    ``tail``: its telegram of the same time, from errors, the head's readings, what it gained, and two noises.
    """

    turned: Callable[..., Any]
    head: Callable[..., Any]
    tail: Callable[..., Any]


def sensing(code: Callable[[Any], Any], readings: Any, telegram: Any, acceleration: Any) -> Sensing:
    """Make all three; ``code`` compiles a function, or leaves it; the others make the machines' records."""
    felt, counted, shown_m_s = code(felt_mm_s2), code(tachometer.counted), code(tachometer.shown_m_s)

    @code
    def turned(errors: Any, kept: Any, speed_mm_s: float, slip: Any) -> Any:
        off_mm_s, slips_cycles, slips_mm_s2 = slip
        wheel_mm_s = max(0.0, speed_mm_s * (1 + errors.scale) + off_mm_s)
        return Kept(
            counted(kept.pulses, (kept.wheel_mm_s + wheel_mm_s) / 2_000 * CYCLE_S / PULSE_M),
            wheel_mm_s,
            off_mm_s,
            slips_cycles,
            slips_mm_s2,
            max(0, kept.tachometer_silent_cycles - 1),
            max(0, kept.inertial_silent_cycles - 1),
        )

    @code
    def head(errors: Any, before: Any, now: Any, gained_mm_s2: float, noise: float) -> Any:
        tachometer_mm_s = round(1_000 * shown_m_s(before.pulses, now.pulses))
        way_mm = round(1_000 * PULSE_M * now.pulses.came)
        heard, is_felt = before.tachometer_silent_cycles == 0, before.inertial_silent_cycles == 0
        return readings(CYCLE_MS, heard, tachometer_mm_s, way_mm, is_felt, felt(errors, gained_mm_s2, noise))

    @code
    def tail(errors: Any, read: Any, gained_mm_s2: float, left: float, right: float) -> Any:
        return telegram(
            acceleration(read.inertial_mm_s2, read.inertial_valid),
            True,
            acceleration(felt(errors, gained_mm_s2, left), True),
            acceleration(felt(errors, gained_mm_s2, right), True),
            TAIL_AGE_MS,
        )

    return Sensing(turned, head, tail)


INTERPRETED = sensing(lambda function: function, Readings, TailReadings, Acceleration)


@dataclass
class Sensors:
    """The sensors of one train: their errors, what they remember, and the noise that is drawn ahead for them."""

    random: Random
    errors: Errors
    kept: Kept = field(default_factory=Kept)
    noises: Any = field(default_factory=lambda: np.empty(0))
    used: int = 0

    def slip(self, ms: int, speed_mm_s: float, slowing: bool) -> bool:
        """Let the wheel slip, or slide where the train brakes; not of a slow train, whose wheel would stand.

        One that is off already goes on as it does, for longer: turned round at its farthest it would stay there.
        """
        if speed_mm_s < SLIPS_FROM_MM_S:
            return False
        cycles = max(1, ms // CYCLE_MS)
        if self.kept.off_mm_s:
            self.kept = self.kept._replace(slips_cycles=max(cycles, self.kept.slips_cycles))
        else:
            slips_mm_s2 = -SLIP_JOLT_MM_S2 if slowing else SLIP_JOLT_MM_S2
            self.kept = self.kept._replace(slips_cycles=cycles, slips_mm_s2=float(slips_mm_s2))
        return True

    def silence_tachometer(self, ms: int) -> None:
        """Let the tachometer give nothing for so long."""
        self.kept = self.kept._replace(tachometer_silent_cycles=ms // CYCLE_MS)

    def silence_inertial(self, ms: int) -> None:
        """Let the inertial sensor at the head give nothing for so long."""
        self.kept = self.kept._replace(inertial_silent_cycles=ms // CYCLE_MS)

    def read(self, speed_mm_s: float, gained_mm_s2: float, tail_mm_s2: float) -> tuple[Readings, TailReadings]:
        """Read head and tail at the end of one cycle, in which they gained so much and got to this speed."""
        before, (noise, left, right) = self.kept, self.noise(1)[:NOISES_A_CYCLE]
        now = INTERPRETED.turned(self.errors, before, speed_mm_s, slipped(before, speed_mm_s))
        head = INTERPRETED.head(self.errors, before, now, gained_mm_s2, noise)
        self.ran(1, now)
        return head, INTERPRETED.tail(self.errors, head, tail_mm_s2, left, right)

    def noise(self, cycles: int) -> Any:
        """Give the noise of the next so many cycles, and of more, which may not all be run."""
        if len(self.noises) - self.used < NOISES_A_CYCLE * cycles:
            drawn = [self.random.gauss(0.0, 1.0) for _ in range(NOISES_A_CYCLE * max(cycles, DRAWN_CYCLES))]
            self.noises, self.used = np.concatenate((self.noises[self.used :], drawn)), 0
        return self.noises[self.used :]

    def ran(self, cycles: int, kept: Kept) -> None:
        """So many cycles have been run; what they drew is gone."""
        self.kept = kept
        self.used += NOISES_A_CYCLE * cycles


def _drawn(random: Random, fault: str) -> float:
    described = FAULTS[PLACE[fault]]
    return random.uniform(described.least, described.most)


def sensors(random: Random) -> Sensors:
    """Draw the sensors of a train."""
    return Sensors(
        random,
        Errors(
            scale=(_drawn(random, "creep_ppm") + _drawn(random, "diameter_ppm")) * 1e-6,
            bias_mm_s2=1_000 * _drawn(random, "head_bias_m_s2"),
            noise_mm_s2=1_000 * _drawn(random, "head_noise_m_s2"),
        ),
    )
