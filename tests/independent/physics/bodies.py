"""A train that moves: its own mass and force, its wheel, its tail, in small time steps; mm, s."""

from __future__ import annotations

import math
from collections import deque
from dataclasses import dataclass, field
from random import Random

from tests.independent.physics.declared import (
    BRAKE_MM_S2,
    CREEP,
    EMERGENCY_MM_S2,
    GRADIENT_CHANGE_MM_S2,
    GRADIENT_MM_S2,
    PULSE_MM,
    TRACTION_MM_S2,
    Type,
)

STEPS = 4
"""So many steps a cycle has."""
SERVICE_JERK_MM_S3 = 800.0
EMERGENCY_JERK_MM_S3 = 3_200.0
SLACK_MM_S2, SLACK_S = 700.0, 0.2
"""A coupler that runs out or in gives the tail a blow by so much, for so long."""


@dataclass
class Hills:
    """Gravity along the track, in stretches of a few hundred metres; above 0 on an ascent."""

    rng: Random
    steep: float
    rolling: bool
    stretches: dict[int, float] = field(default_factory=dict)

    def at(self, place_mm: float) -> float:
        """What it is at a place."""
        stretch = int(place_mm // 400_000)
        known = self.stretches.get(stretch)
        if known is not None:
            return known
        if not self.stretches:
            self.stretches[stretch] = self.rng.choice((-1.0, -0.5, 0.0, 0.5, 1.0)) * self.steep * GRADIENT_MM_S2
        for towards in (1, -1):
            edge = max(self.stretches) if towards > 0 else min(self.stretches)
            while edge * towards < stretch * towards:
                most = self.steep * GRADIENT_MM_S2
                change = self.rng.uniform(-1.0, 1.0) * GRADIENT_CHANGE_MM_S2 if self.rolling else 0.0
                self.stretches[edge + towards] = max(-most, min(most, self.stretches[edge] + change))
                edge += towards
        return self.stretches[stretch]


@dataclass
class Body:
    """The train: a mass with a force that takes time to change, on hills.

    ``place_mm``: of its front along the line, on which it runs ``direction`` 1 or -1.
    """

    type: Type
    hills: Hills
    place_mm: float
    brake_lag_s: float
    emergency_mm_s2: float
    direction: int = 1
    speed: float = 0.0
    force: float = -BRAKE_MM_S2
    gained: float = 0.0
    commanded_s: float = 0.0
    was_s: deque[float] = field(default_factory=deque)
    slack_left_s: float = 0.0
    slack_sign: float = 0.0

    def gravity(self) -> float:
        """What the slope takes from it."""
        return self.direction * self.hills.at(self.place_mm)

    def step(self, wanted: float, emergency: bool, dt: float) -> None:
        """Go on by a step; ``wanted``: the driver's force, of the motors or of the service brake."""
        self.commanded_s = self.commanded_s + dt if emergency else 0.0
        wanted = max(-BRAKE_MM_S2, min(TRACTION_MM_S2, wanted))
        jerk = SERVICE_JERK_MM_S3
        if emergency:
            wanted = min(wanted, 0.0)
            jerk = EMERGENCY_JERK_MM_S3
            if self.commanded_s > self.brake_lag_s:
                wanted = -self.emergency_mm_s2
        self.force += max(-jerk * dt, min(jerk * dt, wanted - self.force))
        before = self.speed
        gravity = self.gravity()
        if self.force < 0 and before == 0:
            held = abs(gravity) <= -self.force
            after = 0.0 if held else -math.copysign(abs(gravity) + self.force, gravity) * dt
        else:
            braked = -math.copysign(self.force, before) if self.force < 0 else self.force
            after = before + (braked - gravity) * dt
            if before != 0 and (after > 0) != (before > 0) and self.force < 0:
                after = 0.0
        self.gained = (after - before) / dt
        self.place_mm += self.direction * (before + after) / 2 * dt
        self.speed = after
        self._tail(dt)

    def _tail(self, dt: float) -> None:
        """The tail does the same a while later, and is struck where a coupler runs out."""
        late = max(1, round(self.type.tail_lag_s / 0.025))
        self.was_s.append(self.gained)
        while len(self.was_s) > late:
            old = self.was_s.popleft()
            if (old > 100) != (self.was_s[0] > 100) and self.slack_left_s <= 0:
                self.slack_left_s, self.slack_sign = SLACK_S, 1.0 if self.was_s[0] > old else -1.0
        self.slack_left_s -= dt

    def tail_gained(self) -> float:
        """How much speed the tail gains."""
        blow = self.slack_sign * SLACK_MM_S2 if self.slack_left_s > 0 else 0.0
        return self.was_s[0] + blow

    def turn(self) -> None:
        """The other end leads now."""
        self.place_mm -= self.direction * self.type.length_mm
        self.direction = -self.direction
        self.was_s.clear()


@dataclass
class Wheel:
    """The wheel that is counted: it rolls with its creep, slips, slides, or stands.

    ``of_train``: while it does not roll, its speed wants to be so much of the train's, swinging by ``swing`` about it.
    """

    diameter: float
    speed: float = 0.0
    rolls: bool = True
    of_train: float = 1.0
    swing: float = 0.0
    rate: float = 6_000.0
    phase: float = 0.0
    turned_mm: float = 0.0
    pulse: int = 0
    pulse_at_s: float = -9.0
    pulse_before_s: float = -99.0

    def step(self, body: Body, now_s: float, dt: float) -> None:
        """Turn on by a step, and count pulses."""
        rolling = body.speed * (1 + CREEP * body.force / 1_300.0)
        if self.rolls and abs(self.speed - rolling) <= self.rate * dt * 1.01 + 20.0:
            after = rolling
        else:
            self.phase += dt * 6.0
            aim = rolling if self.rolls else body.speed * (self.of_train + self.swing * math.sin(self.phase))
            after = self.speed + max(-self.rate * dt, min(self.rate * dt, aim - self.speed))
        self.turned_mm += (self.speed + after) / 2 * dt * (1 + self.diameter)
        self.speed = after
        pulse = math.floor(self.turned_mm / PULSE_MM)
        if pulse != self.pulse:
            many = abs(pulse - self.pulse)
            passed = self.turned_mm - PULSE_MM * (pulse if pulse > self.pulse else pulse + 1)
            ago_s = min(dt, abs(passed) / max(1.0, abs(after)))
            at_s = now_s - ago_s
            gap_s = PULSE_MM / max(1.0, abs(after)) if many > 1 else at_s - self.pulse_at_s
            self.pulse_before_s, self.pulse_at_s = at_s - gap_s, at_s
            self.pulse = pulse

    def slipping(self, body: Body) -> bool:
        """Whether it does not roll, or not yet again."""
        return not self.rolls or abs(self.speed - body.speed) > CREEP * abs(body.speed) + 25.0


def drawn(rng: Random, kind: Type) -> Body:
    """A train of a type, somewhere on a line."""
    body = Body(
        type=kind,
        hills=Hills(rng, rng.choice((0.0, 0.3, 1.0)), rng.random() < 0.6),
        place_mm=rng.uniform(-5e6, 5e6),
        brake_lag_s=0.2 if kind.tail_lag_s <= 0.2 else 1.0,
        emergency_mm_s2=rng.choice((EMERGENCY_MM_S2[0], rng.uniform(*EMERGENCY_MM_S2))),
    )
    body.was_s.append(0.0)
    return body


def shown(wheel: Wheel, now_s: float) -> tuple[int, int]:
    """Speed by the time between two pulses, or since the last one, and the pulses as a way."""
    longest_s = max(wheel.pulse_at_s - wheel.pulse_before_s, now_s - wheel.pulse_at_s, 1e-4)
    speed = 0.0 if now_s - wheel.pulse_at_s > 1.0 else PULSE_MM / longest_s
    return round(math.copysign(speed, wheel.speed)), round(wheel.pulse * PULSE_MM)
