"""Which faults come, when, and to whom: drawn before a simulation begins, each by a chance of its own.

So a fault that is left out moves none of the others.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from random import Random

from kernel.names import Point, Train
from models.simulation.faults import FAULTS, Chosen, Fault, Setting

HOUR_S = 3_600.0


@dataclass(frozen=True)
class Occurrence:
    """A fault that comes ``at_ms`` to ``who``, or to the line (empty), and lasts ``lasts_ms``.

    Who it comes to is a train, a point or a road.
    """

    at_ms: int
    fault: str
    who: str
    lasts_ms: int


def occurrences(
    chosen: Chosen,
    seed: int,
    hours: float,
    trains: Sequence[Train],
    points: Sequence[Point],
    roads: Sequence[str] = (),
) -> list[Occurrence]:
    """Draw what comes within some hours, in the order of its time."""
    whose: Mapping[str, Sequence[str]] = {"train hour": trains, "point hour": points, "crossing hour": roads}
    found = [
        each
        for fault in FAULTS
        if fault.name in chosen and not fault.is_share
        for each in _of_one(
            fault, chosen[fault.name], Random(f"{seed} {fault.name}"), hours, whose.get(fault.per, ("",))
        )
    ]
    return sorted(found, key=lambda each: (each.at_ms, each.fault, each.who))


def _of_one(fault: Fault, setting: Setting, random: Random, hours: float, whose: Sequence[str]) -> Iterator[Occurrence]:
    """One fault: each train's, point's, road's or the line's own times, and those that were asked for."""
    for who in whose:
        at_s = random.expovariate(setting.rate) * HOUR_S if setting.rate else hours * HOUR_S
        while at_s < hours * HOUR_S:
            yield _one(fault, setting, random, at_s, who)
            at_s += random.expovariate(setting.rate) * HOUR_S
    for at_s in setting.at_s if whose else ():
        yield _one(fault, setting, random, at_s, random.choice(whose))


def _one(fault: Fault, setting: Setting, random: Random, at_s: float, who: str) -> Occurrence:
    return Occurrence(round(at_s * 1_000), fault.name, who, round(random.uniform(setting.least, setting.most) * 1_000))
