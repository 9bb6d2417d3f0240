"""What a train of a simulation is doing."""

from __future__ import annotations

from enum import Enum


class Phase(Enum):
    """What a train is doing."""

    LOST = "is to tell where it stands"
    STANDS = "stands"
    WAITS = "waits for its route to be set"
    RUNS = "runs"
    PARTED = "has parted, and waits for staff"
    STATED = "has parted, and stays where two persons have stated it until it is taken off"
    OFF = "has parted, and was taken off the line"


HAS_PARTED = frozenset({Phase.PARTED, Phase.STATED, Phase.OFF})
