"""What the machines on board of a train may know of it, by its sensors, in this world."""

from __future__ import annotations

from typing import Protocol

from kernel.maps import Map
from kernel.names import Block, Cab, Route, Train
from kernel.standstill import ThroughLine


class Sight(Protocol):
    """A train as it truly stands or runs; places count along the direction it runs in."""

    name: Train

    @property
    def at_rest(self) -> bool:
        """Whether it stands."""

    @property
    def whole(self) -> bool:
        """Whether all its cars are coupled."""

    @property
    def blocks(self) -> frozenset[Block]:
        """All the blocks it is in, with what it has left behind."""

    @property
    def front_block(self) -> Block:
        """The block that its front is in."""

    @property
    def front_block_end_mm(self) -> int:
        """Where that block ends ahead of the train."""

    @property
    def front_mm(self) -> tuple[int, int]:
        """Where its front is: no less far, and no farther, by the odometry."""

    @property
    def speed_mm_s(self) -> int:
        """How fast it is."""

    @property
    def braked_cycles(self) -> int:
        """For how many cycles its brake has been on."""

    def wait_braked(self) -> None:
        """Stand with the brake on until that holds it."""

    @property
    def head_cab(self) -> Cab:
        """The cab that its driver is in."""

    def ends_mm(self, route: Route) -> tuple[int, Map[Block, int]] | None:
        """Where the start block of a route begins, and where all its blocks end; nothing if it does not lead there."""


def line(whole: bool) -> ThroughLine:
    """What line, split detection and spacing say of the way to the tail."""
    return ThroughLine(answers=whole, is_intact=whole, fits=whole)
