"""What is still to happen, in the order of its time; what was put down first comes first."""

from __future__ import annotations

from collections.abc import Callable
from heapq import heappop, heappush

Act = Callable[[], object]


class Agenda:
    """Simulated time in ms, and acts that are due at some time."""

    def __init__(self) -> None:
        self.now_ms = 0
        self._number = 0
        self._acts: list[tuple[int, int, Act]] = []

    def after(self, ms: int, act: Act) -> None:
        """Put an act down for so many ms from now."""
        self._number += 1
        heappush(self._acts, (self.now_ms + ms, self._number, act))

    def go_to(self, now_ms: int) -> None:
        """Let time go on; do everything that is due on the way, each at its time."""
        while self._acts and self._acts[0][0] <= now_ms:
            self.now_ms, _, act = heappop(self._acts)
            act()
        self.now_ms = now_ms
