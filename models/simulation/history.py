"""What was where, and when: every few seconds where trains are, and for each block who was in it and who held it."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field

from kernel.names import Block, Train
from models.simulation.kilometres import Kilometres
from models.simulation.phases import Phase
from models.simulation.simulation import Simulation

EVERY_S = 5
LOST = "lost"


@dataclass(frozen=True)
class Sample:
    """Where a train is: ``segment`` and ``share`` of it, ``place_mm`` along the line; how fast; what it is doing."""

    segment: int
    share: float
    place_mm: int
    speed_mm_s: int
    phase: Phase


@dataclass(frozen=True)
class Stay:
    """A block is taken, for a train or as lost, from a second up to another; ``there``: the train is in it."""

    block: Block
    who: str
    there: bool
    from_s: int
    to_s: int


@dataclass
class History:
    """Looks on, second by second."""

    kilometres: Kilometres
    samples: dict[Train, list[Sample]] = field(default_factory=dict)
    stays: list[Stay] = field(default_factory=list)
    _open: dict[tuple[Block, str, bool], int] = field(default_factory=dict)
    _seen: tuple[object, ...] = ()

    def look(self, now: Simulation) -> None:
        """Write down what has changed in the last second."""
        system = now.play.system
        seen = (system.centre.claimed, system.centre.lost_blocks, system.track.at)
        if len(self._seen) != len(seen) or any(one is not other for one, other in zip(seen, self._seen, strict=True)):
            self._seen = seen
            self._note(now.now_s, dict.fromkeys(self._taken(now)))
        if now.now_s % EVERY_S == 0:
            for train, service in now.services.items():
                vehicle = service.vehicle
                segment, share, place_mm = self.kilometres.of(vehicle.on_rails, vehicle.front_mm)
                sample = Sample(segment, share, place_mm, round(vehicle.speed_mm_s), service.phase)
                self.samples.setdefault(train, []).append(sample)

    def _taken(self, now: Simulation) -> Iterator[tuple[Block, str, bool]]:
        """Every block that is taken now, for whom, and whether by the train itself."""
        system, train_of = now.play.system, now.play.site.formation.train_of
        for block, runs in system.centre.claimed.items():
            for train in sorted({run.train for run in runs}):
                yield block, train, False
        for block in sorted(system.centre.lost_blocks):
            yield block, LOST, False
        for car, blocks in system.track.at.items():
            for block in sorted(blocks):
                yield block, train_of[car], True

    def _note(self, now_s: int, taken: Mapping[tuple[Block, str, bool], object]) -> None:
        for key in [key for key in self._open if key not in taken]:
            self.stays.append(Stay(*key, self._open.pop(key), now_s))
        for key in taken:
            self._open.setdefault(key, now_s)

    def close(self, now_s: int) -> None:
        """It is over."""
        self._note(now_s, {})
        self.stays.sort(key=lambda stay: (stay.from_s, stay.block, stay.who, stay.there))
