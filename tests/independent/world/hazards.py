"""What must never be seen, said of rails and cars."""

from __future__ import annotations


class Hazard(Exception):
    """What must never happen: its kind, and the trains and places of it."""

    def __init__(self, kind: str, text: str) -> None:
        super().__init__(f"{kind}: {text}")
        self.kind = kind


COLLISION = "two trains in one place"
POINT = "a car on a moving or wrongly lying point"
FREED = "a block freed around a car"
UNHELD = "a train where nothing is held for it"
TRACK_ENDS = "a train beyond the end of track"
