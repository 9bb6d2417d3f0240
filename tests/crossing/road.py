"""A crossing whose decisions are taken each second, and what road users see of it."""

from __future__ import annotations

from dataclasses import dataclass, field

from kernel.crossing import crossing as machine
from kernel.crossing.crossing import Crossing, CrossingTrack, Due, Settings, Train
from kernel.restarts import restart_crossing

SETTINGS = Settings(
    cycle_ms=1_000,
    warning_cycles=35,
    bell_cycles=5,
    lowering_cycles=10,
    least_down_cycles=20,
    lifting_cycles=6,
    reopening_cycles=20,
    silence_cycles=2,
    start_cycles=39,
)
UP, DOWN = CrossingTrack("up"), CrossingTrack("down")


def restarted() -> Crossing:
    return restart_crossing(SETTINGS, frozenset((UP, DOWN)), 1)


@dataclass(kw_only=True)
class Road:
    """For how long it has warned, for how long its arms have been ordered down, and how long it was open in all."""

    crossing: Crossing = field(default_factory=restarted)
    warned_s: int = 0
    down_s: int = 0
    open_s: int = 0

    def see_empty(self, track: CrossingTrack) -> None:
        """A person who was asked says at once that a track is empty."""
        self.crossing = machine.note_empty(self.crossing, track, machine.look_of(self.crossing, track))

    def tell_gone(self, train: Train) -> None:
        number = machine.number_of(self.crossing, train)
        self.crossing = machine.note_gone(self.crossing, train, number, True)

    def hear_the_terminals(self) -> None:
        for track in (UP, DOWN):
            self.crossing = machine.note_heard(self.crossing, track, 0)

    def decide(self, dues: dict[Train, Due]) -> None:
        self.crossing = machine.decide(SETTINGS, self.crossing, dues)
        lowered = machine.arms_are_to_be_down(SETTINGS, self.crossing)
        self.warned_s = self.warned_s + 1 if self.crossing.warns else 0
        self.down_s = self.down_s + 1 if lowered else 0
        self.open_s += not self.crossing.warns
        self.crossing = machine.aged(self.crossing)
