"""A toy machine with one of every construct that the machines on board may use."""

from __future__ import annotations

from dataclasses import dataclass, replace
from enum import Enum

from kernel.onboard.arithmetic import CYCLE_MS, divided_up, limited


class Level(Enum):
    """How full a tank is."""

    LOW = "low"
    GOOD = "good"
    HIGH = "high"


@dataclass(frozen=True)
class Scale:
    """How a float's angle becomes a volume."""

    steps: tuple[int, int, int]
    by: int = 7
    inverted: bool = False


@dataclass(frozen=True)
class Gauge:
    """The state: the volume, the last two angles, and what was made of them."""

    scale: Scale
    volume_ml: int
    last: tuple[int, int]
    level: Level = Level.GOOD
    trusted: bool = True


START = Gauge(Scale((1, 10, 100)), 0, (0, 0))
LEVELS = (Level.LOW, Level.HIGH)


def rounded(one: int, other: int) -> tuple[int, int, int]:
    """Round every way that there is, negatives too."""
    if other == 0:
        return 0, 0, one
    return one // other, one % other, divided_up(one, by=other) if other > 0 else -(one // -other)


def is_between(value: int, scale: Scale) -> bool:
    """Whether a value lies between the first and the last step."""
    least, _, most = scale.steps
    return least <= value < most or (scale.inverted and not least <= value)


def gauged(gauge: Gauge, angle: int, valid: bool = True) -> Gauge:
    """Take one reading."""
    if not valid:
        trusted = False
    elif is_between(angle, gauge.scale):
        trusted = gauge.trusted or gauge.level in LEVELS
    else:
        return replace(gauge, trusted=False, last=(gauge.last[1], angle))
    scale = replace(gauge.scale, inverted=not gauge.scale.inverted) if angle == gauge.last[1] else gauge.scale
    change = limited(angle * CYCLE_MS // 3, -50, 50) % gauge.scale.by if gauge.scale.by != 0 else 0
    volume_ml = gauge.volume_ml + change
    assert volume_ml != 3
    return Gauge(
        scale,
        trusted=trusted,
        level=level_at(volume_ml, scale),
        last=(gauge.last[1], angle),
        volume_ml=volume_ml,
    )


def level_at(volume_ml: int, scale: Scale) -> Level:
    """Name the level; an inverted scale is never good."""
    if volume_ml < scale.steps[1]:
        return Level.LOW
    level = Level.HIGH if volume_ml >= scale.steps[2] else Level.GOOD
    if scale.inverted and level == Level.GOOD:
        level = Level.LOW
    return level


def started_over(gauge: Gauge) -> Gauge:
    """Begin again, unless nothing has changed."""
    return START if gauge != START and gauge.scale == START.scale else Gauge(gauge.scale, gauge.last[1], (0, 1))


def emptied(gauge: Gauge) -> Gauge:
    """Leave one millilitre."""
    return replace(gauge, volume_ml=1, level=Level.LOW)


def shared(volume_ml: int, among: int) -> int:
    """Divide by what may be 0."""
    return volume_ml // among


@dataclass(frozen=True)
class Drop:
    """A reading."""

    size_ml: int


def leaked(gauge: Gauge, drop: Drop) -> Gauge:
    """Lose a drop; one that is too large wraps round, which is a fault that a test must notice."""
    return replace(gauge, volume_ml=0) if drop.size_ml * 2 < gauge.volume_ml else gauge


def settled(gauge: Gauge, angle: int) -> tuple[Gauge, bool]:
    """Empty it and take one good reading; tell whether anything changed."""
    after = gauged(angle=angle, gauge=emptied(gauge))
    return after, after != gauge
