"""Terminals of start points: silent, without power, their words late, told by tags whose strike it was (X3, T14)."""

from __future__ import annotations

from dataclasses import dataclass, field
from random import Random

from kernel.crossing import crossing as machine
from kernel.crossing import start_point
from kernel.crossing.crossing import Crossing, CrossingTrack, Train
from kernel.crossing.start_point import StartPoint, StartPointSettings
from kernel.names import Tag
from kernel.restarts import restart_start_point
from tests.crossing.road import SETTINGS

NOBODY = Train("")
TAG_MM = 20_000
"""From its tag to a detector: less than any train is long."""
TOLD_S = 2


@dataclass(frozen=True)
class Word:
    """What a terminal says, and when it is heard: who has struck, and whether it may have missed some."""

    heard_s: int
    spoke_s: int
    strikes: tuple[tuple[int, Train], ...]
    owes: bool
    life: int


@dataclass
class Terminal:
    """Of a track's start point; nothing is heard of it in ``silent``, and it has no power in ``dark`` (seconds).

    ``reads``: what trains tell of the tag, and when that is heard.  ``strikes``: those not told yet, numbered.
    """

    track: CrossingTrack
    silent: range
    dark: range
    point: StartPoint = field(default_factory=lambda: start_point.note_owed(restart_start_point(NOBODY)))
    reads: list[tuple[int, Train]] = field(default_factory=list)
    strikes: list[tuple[int, Train]] = field(default_factory=list)
    words: list[Word] = field(default_factory=list)
    known: set[int] = field(default_factory=set)
    count: int = 0
    life: int = 0

    @property
    def settings(self) -> StartPointSettings:
        return StartPointSettings(Tag(self.track), TOLD_S, 58, 60)

    def read(self, chance: Random, train: Train, now_s: int) -> None:
        """A train tells of the tag: at once, late, again, or not at all."""
        if chance.random() < 0.8:
            late_s = chance.randint(0, TOLD_S)
            self.reads += [(now_s + late_s, train), (now_s + TOLD_S, train)]

    def strike(self, now_s: int) -> Train:
        """Give by which name a strike is told, or nobody's if it is missed."""
        if now_s in self.dark:
            return NOBODY
        self.count += 1
        name = start_point.striker(self.point, Train(f"strike {self.count} on {self.track}"))
        self.point = start_point.note_strike(self.point)
        self.strikes.append((self.count, name))
        return name

    def second(self, chance: Random, now_s: int) -> None:
        """Hear what trains tell, and say all that there is to say."""
        self.point = start_point.aged(self.point)
        if now_s in self.dark:
            self.point, self.strikes, self.reads = restart_start_point(NOBODY), [], []
            self.life += 1
            return
        for _, train in [read for read in self.reads if read[0] <= now_s]:
            self.point = start_point.note_read(self.settings, self.point, train, Tag(self.track))
        self.reads = [read for read in self.reads if read[0] > now_s]
        if now_s not in self.silent:
            late_s = chance.choice((0, 0, 0, 1, SETTINGS.silence_cycles))
            self.words.append(Word(now_s + late_s, now_s, tuple(self.strikes), self.point.owes, self.life))

    def hear(self, crossing: Crossing, now_s: int) -> Crossing:
        """What comes now is heard by the crossing, and it says so; each strike is told once."""
        come = [word for word in self.words if word.heard_s <= now_s]
        self.words = [word for word in self.words if word.heard_s > now_s]
        for word in come:
            if word.owes:
                crossing = machine.note_missed(crossing, self.track)
                self.point = start_point.note_owed(self.point) if word.life == self.life else self.point
            for number, name in word.strikes:
                if number not in self.known:
                    crossing = machine.note_struck(crossing, name)
            self.known |= {number for number, _ in word.strikes}
            self.strikes = [strike for strike in self.strikes if strike[0] not in self.known]
            crossing = machine.note_heard(crossing, self.track, now_s - word.spoke_s)
        return crossing

    def lose(self, now_s: int) -> None:
        """The crossing has no power as words come."""
        self.words = [word for word in self.words if word.heard_s > now_s]
