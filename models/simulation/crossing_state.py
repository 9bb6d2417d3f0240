"""One crossing of a simulated line: what it knows and does, and what is truly before it."""

from __future__ import annotations

from dataclasses import dataclass, field

from kernel.crossing.arrival import Followed
from kernel.crossing.crossing import Crossing, CrossingTrack
from kernel.link import Party
from kernel.names import Car, Train
from models.simulation.roads import Ways

REACH_MM = 2_200_000
"""So far the crossing's radio reaches."""
LONG_AGO_S = -3_600
"""A crossing that begins closed has been so since long."""


@dataclass
class Told:
    """A ranging that has come since the last decision; ``at_ms``: by the unit's clock."""

    at_ms: int
    way_mm: int
    speed_mm_s: int


@dataclass
class Seen:
    """What is truly so of a train before one road.

    ``ahead_mm``: the shortest way to it.  ``over_mm``: where its path meets it, from the head's coming until its rear
    is proved past.  ``under``: it is on the road.  ``leads``, ``front_mm``: the car that led then, and where it was.
    """

    leads: Car
    front_mm: float
    ahead_mm: float
    over_mm: float | None
    under: bool


@dataclass
class State:
    """One crossing with its arms.

    ``closed_s``: since when it warns; ``down_s``: since when its arms are down.  ``closings``: each closure as
    [from, to].  ``passed``: trains that came over it; ``least_s``: the shortest time that the road was closed before.
    ``quiet_s``: for how long it has been closed for nobody, or has known a train that is gone.
    ``attended_s``: when somebody will have looked for a train that cannot say that it is gone.
    """

    ways: Ways
    party: Party
    crossing: Crossing
    arms_s: int
    lowered: int
    closed_s: int | None
    down_s: int | None
    followed: dict[Train, Followed] = field(default_factory=dict)
    told: dict[Train, Told] = field(default_factory=dict)
    struck: set[Train] = field(default_factory=set)
    strikes: list[Train] = field(default_factory=list)
    seen: dict[Train, Seen] = field(default_factory=dict)
    attended_s: dict[Train, int] = field(default_factory=dict)
    terminal_silent_until_ms: int = 0
    quiet_s: dict[str, int] = field(default_factory=dict)
    closings: list[tuple[int, int]] = field(default_factory=list)
    passed: int = 0
    least_s: int | None = None

    @property
    def name(self) -> str:
        """The road's name."""
        return self.ways.road.name

    @property
    def track(self) -> CrossingTrack:
        """All start points of a road have one terminal."""
        return CrossingTrack(self.name)

    def closures(self, now_s: int) -> list[tuple[int, int]]:
        """Each closure of the road as [from, to]; one that still lasts goes up to now."""
        lasts = [] if self.closed_s is None else [(max(0, self.closed_s), now_s)]
        return [*self.closings, *lasts]

    def closed_in_all_s(self, now_s: int) -> int:
        """How long the road was closed in all."""
        return sum(to_s - from_s for from_s, to_s in self.closures(now_s))
