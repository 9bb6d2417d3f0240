"""What tachometer and inertial sensors of a train say of its motion, with their errors (P1, P5).

The errors are drawn from the ranges declared in ``models.sensors.faults``; a wheel that slips or a sensor that is
silent is a fault, and comes from outside.
"""

from __future__ import annotations

from dataclasses import dataclass
from random import Random

from kernel.onboard.arithmetic import CYCLE_MS
from kernel.onboard.odometry import Readings
from kernel.onboard.split import Acceleration
from kernel.onboard.split import Readings as TailReadings
from models.rides.plan import PLAN
from models.sensors.faults import FAULTS, NOISE_MOST, PLACE

CYCLE_S = CYCLE_MS / 1_000
PULSE_MM = PLAN.sensors.pulse_mm
SLIP_JOLT_MM_S2 = 6_000
"""A wheel runs away by so much, beyond what trusts it; then it comes back, again and again.

A slide that is held at one speed is beyond what the proofs assume of a wheel, and no fault of this simulation.
"""
SLIP_MOST_MM_S, SLIPS_FROM_MM_S = 6_000.0, 10_000.0
TAIL_AGE_MS = 200


def _drawn(random: Random, fault: str) -> float:
    described = FAULTS[PLACE[fault]]
    return random.uniform(described.least, described.most)


@dataclass
class Sensors:
    """The sensors of one train.

    ``scale``: creep and diameter, as a share.  ``turned_mm``: the way that the wheel has turned.
    ``off_mm_s``: how much faster the wheel is than the train.  ``slips_cycles``: it slips so long yet.
    """

    random: Random
    scale: float
    bias_mm_s2: float
    noise_mm_s2: float
    turned_mm: float = 0.0
    way_mm: int = 0
    wheel_mm_s: float = 0.0
    off_mm_s: float = 0.0
    slips_cycles: int = 0
    slips_mm_s2: float = 0.0
    tachometer_silent_cycles: int = 0
    inertial_silent_cycles: int = 0

    def slip(self, ms: int, speed_mm_s: float, slowing: bool) -> bool:
        """Let the wheel slip, or slide where the train brakes; not of a slow train, whose wheel would stand.

        Nor one that slips already: it would be held where it is, which is no slip that jolts.
        """
        if speed_mm_s < SLIPS_FROM_MM_S or self.off_mm_s != 0.0:
            return False
        self.slips_cycles = max(1, ms // CYCLE_MS)
        self.slips_mm_s2 = -SLIP_JOLT_MM_S2 if slowing else SLIP_JOLT_MM_S2
        return True

    def read(self, speed_mm_s: float, gained_mm_s2: float) -> Readings:
        """What the sensors say at the end of a cycle, in which the train gained so much and got to this speed."""
        self._wheel(speed_mm_s)
        before, self.wheel_mm_s = self.wheel_mm_s, max(0.0, speed_mm_s * (1 + self.scale) + self.off_mm_s)
        mean_mm_s = (before + self.wheel_mm_s) / 2
        self.turned_mm += mean_mm_s * CYCLE_S
        way_mm = int(self.turned_mm / PULSE_MM) * PULSE_MM
        turns, self.way_mm = way_mm > self.way_mm, way_mm
        heard, felt = self.tachometer_silent_cycles == 0, self.inertial_silent_cycles == 0
        self.tachometer_silent_cycles -= not heard
        self.inertial_silent_cycles -= not felt
        tachometer_mm_s = round(mean_mm_s) if turns else 0
        return Readings(CYCLE_MS, heard, tachometer_mm_s, way_mm, felt, self._felt(gained_mm_s2))

    def tail(self, head: Readings, gained_mm_s2: float) -> TailReadings:
        """The tail's telegram of the same time; its two sensors err on their own."""
        left, right = self._felt(gained_mm_s2), self._felt(gained_mm_s2)
        return TailReadings(
            Acceleration(head.inertial_mm_s2, head.inertial_valid),
            True,
            Acceleration(left, True),
            Acceleration(right, True),
            TAIL_AGE_MS,
        )

    def _wheel(self, speed_mm_s: float) -> None:
        """The wheel runs away to 6 m/s off and comes back, again and again while it slips; then for good."""
        if self.slips_cycles > 0 and speed_mm_s >= SLIP_MOST_MM_S + 1_000:
            self.slips_cycles -= 1
            self.off_mm_s += self.slips_mm_s2 * CYCLE_S
            if self.off_mm_s == 0.0 or abs(self.off_mm_s) >= SLIP_MOST_MM_S:
                self.slips_mm_s2 = -self.slips_mm_s2
        elif self.off_mm_s != 0.0:
            self.slips_cycles = 0
            step = SLIP_JOLT_MM_S2 * CYCLE_S
            self.off_mm_s = self.off_mm_s - step if self.off_mm_s > 0 else self.off_mm_s + step
            self.off_mm_s = 0.0 if abs(self.off_mm_s) < step / 2 else self.off_mm_s

    def _felt(self, gained_mm_s2: float) -> int:
        noise = self.random.gauss(0.0, 1.0)
        return round(gained_mm_s2 + self.bias_mm_s2 + self.noise_mm_s2 * max(-NOISE_MOST, min(NOISE_MOST, noise)))


def sensors(random: Random) -> Sensors:
    """Draw the sensors of a train."""
    return Sensors(
        random=random,
        scale=(_drawn(random, "creep_ppm") + _drawn(random, "diameter_ppm")) * 1e-6,
        bias_mm_s2=1_000 * _drawn(random, "head_bias_m_s2"),
        noise_mm_s2=1_000 * _drawn(random, "head_noise_m_s2"),
    )
