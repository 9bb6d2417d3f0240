"""What goes wrong with wheels, sensors and tags: by name, when, and how much; and which bound it breaks, if any."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from random import Random


@dataclass(frozen=True)
class Fault:
    """From ``from_s`` until ``until_s``; ``size``: in the unit that the fault's kind says."""

    kind: str
    from_s: float
    until_s: float
    size: float = 0.0

    def on(self, now_s: float) -> bool:
        """Whether it is there."""
        return self.from_s <= now_s < self.until_s


Drawing = Callable[[Random, float], Fault]


def _within(kind: str, lasts_s: tuple[float, float], size: tuple[float, float] = (0.0, 0.0)) -> Drawing:
    def draw(rng: Random, whole_s: float) -> Fault:
        begins = rng.uniform(15.0, max(16.0, 0.8 * whole_s))
        return Fault(kind, begins, begins + rng.uniform(*lasts_s), rng.uniform(*size))

    return draw


def _always(kind: str, size: tuple[float, float] = (0.0, 0.0)) -> Drawing:
    return lambda rng, whole_s: Fault(kind, 0.0, float("inf"), rng.uniform(*size) * rng.choice((-1.0, 1.0)))


HELD, SWINGS, LOCKED, SPINS, SLOW = "slide held", "slide swings", "wheel locked", "wheel spins", "slow slide"
SILENT, STUCK, ZERO = "tachometer silent", "tachometer stuck", "tachometer at zero"
PULSES_LOST, PULSES_EXTRA, DIAMETER_WRONG = "pulses lost", "pulses too many", "wheel diameter entered wrong"
INERTIAL_SILENT, REVERSED, JITTER = "inertial sensor silent", "inertial sensor mounted in reverse", "cycle jitter"
STUCK_WHEEL = "wheel stuck by its brake"
PAIR_LOST, TAG_LOST, PARTED = "pair of tags lost", "tag lost", "parted, another antenna poses as the tail"

WITHIN: dict[str, Drawing] = {
    SWINGS: _within(SWINGS, (1.0, 12.0), (0.7, 0.9)),
    SPINS: _within(SPINS, (1.0, 8.0), (1.15, 1.6)),
    LOCKED: _within(LOCKED, (0.5, 6.0)),
    HELD: _within(HELD, (0.5, 1.6), (0.75, 0.9)),
    SILENT: _within(SILENT, (0.1, 20.0)),
    STUCK: _within(STUCK, (0.1, 8.0)),
    INERTIAL_SILENT: _within(INERTIAL_SILENT, (0.1, 20.0)),
    JITTER: _within(JITTER, (5.0, 600.0), (0.1, 0.49)),
    PAIR_LOST: _within(PAIR_LOST, (5.0, 60.0)),
    TAG_LOST: _within(TAG_LOST, (5.0, 60.0)),
    PARTED: _within(PARTED, (1e9, 1e9), (1.0, 2.99)),
}
"""Within the bounds as declared: at least as long as no other fault takes a wheel beyond them.  Size: share of the
train's speed, ms that a cycle is longer or shorter, or vehicles that came off."""

BEYOND: dict[str, Drawing] = {
    HELD: _within(HELD, (5.0, 40.0), (0.75, 0.9)),
    LOCKED: _within(LOCKED, (10.0, 60.0), (1.0, 1.0)),
    STUCK_WHEEL: _within(STUCK_WHEEL, (5.0, 120.0)),
    SLOW: _within(SLOW, (5.0, 40.0), (0.75, 0.9)),
    ZERO: _within(ZERO, (5.0, 120.0)),
    PULSES_LOST: _within(PULSES_LOST, (5.0, 60.0), (0.02, 0.5)),
    PULSES_EXTRA: _within(PULSES_EXTRA, (5.0, 60.0), (0.02, 0.5)),
    DIAMETER_WRONG: _always(DIAMETER_WRONG, (0.01, 0.1)),
    REVERSED: _always(REVERSED),
    JITTER: _within(JITTER, (5.0, 60.0), (3.0, 20.0)),
}
"""Beyond.  Size: share, or ms; of a locked wheel: that it stays locked below 3 m/s."""


def drawn(rng: Random, whole_s: float, beyond: str | None) -> list[Fault]:
    """Up to three faults within the bounds, and one beyond, if that is asked for."""
    kinds = rng.sample(sorted(WITHIN), rng.choice((0, 0, 1, 1, 2, 3)))
    faults = [WITHIN[kind](rng, whole_s) for kind in kinds]
    return [*faults, BEYOND[beyond](rng, whole_s)] if beyond else faults
