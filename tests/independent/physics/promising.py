"""Trains that promise ceilings of speed, keep to them by their driver or by their brake alone, and are let go again."""

from __future__ import annotations

from random import Random

from tests.independent.physics.ride import Ride

ABOVE_CEILING = "a train is faster than it has promised"
LOWERS = 0.01
"""In so many cycles it promises another ceiling as it runs."""
HEEDS = 0.6
"""So many drivers keep below what their train has promised; the others meet the brake."""


class Promising(Ride):
    """A ride whose train promises; what it promises is drawn beside the ride, which is as without it."""

    def __init__(self, seed: int) -> None:
        """Draw it."""
        self.promises = Random(-1 - seed)
        super().__init__(seed)

    def go_on(self) -> None:
        """It is let go, or not, and promises for the way to the next stop."""
        super().go_on()
        self.host.keep_to(round(self.most * self.promises.uniform(0.3, 1.5)))
        if self.promises.random() < HEEDS:
            self.most = max(300.0, min(self.most, self.host.ceiling.most_mm_s - 1_500.0))

    def cycle(self) -> None:
        """It may promise less than before; and is no faster than it has promised."""
        if self.promises.random() < LOWERS:
            self.host.keep_to(round(self.body.speed + self.promises.uniform(-500, 5_000)))
        super().cycle()

    def judge(self) -> None:
        """As of every train, and by its ceiling."""
        super().judge()
        if self.body.speed > self.host.ceiling.most_mm_s:
            self.hazard(ABOVE_CEILING, self.body.speed - self.host.ceiling.most_mm_s)
        self.out.counts["cycles within three metres a second of the ceiling"] += (
            self.body.speed > self.host.ceiling.most_mm_s - 3_000
        )
