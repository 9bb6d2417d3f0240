"""What staff does about a train that has parted: two persons state where its cars are, and it is taken off the line.

Nothing here is a step of its own: cars leave the blocks that they are in, and two persons state anew, of a train that
is in none any more, that nothing is to be held for it (T8).
"""

from __future__ import annotations

from dataclasses import dataclass
from random import Random

from models.simulation.diary import STAFF, Diary
from models.simulation.vehicle import Line, Vehicle
from models.simulator import messages

TAKEN_OFF_S = (1_800, 5_400)
"""So long after its cars have been stated it takes until they are off the rails (ours)."""


@dataclass(frozen=True)
class Parted:
    """The staff of one train that has parted."""

    vehicle: Vehicle
    line: Line
    diary: Diary

    def state(self, random: Random) -> None:
        """Two persons state in which blocks the cars are; the unit is isolated, so no authority reaches it (T8)."""
        messages.state(self.line.play, self.vehicle.on_rails.name, random)

    def take_off(self, random: Random) -> None:
        """Its cars are taken off the rails where they stand; the blocks are free once it has been stated anew."""
        play, rails = self.line.play, self.vehicle.on_rails
        for car in (*rails.cars, *rails.standing):
            for block in sorted(play.system.track.at[car]):
                play.take("car_leaves", car=car, block=block)
        self.line.trains.remove(rails)
        self.diary.note(STAFF, rails.name, "is taken off the line")
        self.state(random)
