"""The invariants of the proofs, asked of a simulated line while it runs."""

from __future__ import annotations

from collections import Counter

from fuzz.failures.replaying import holds
from models.simulation.simulation import Simulation
from models.world.state import System
from proofs.catalogue import INVARIANTS, SAFETY

EVERY_S = 10
"""So often all of them are asked; in between, in every second that changes something, the claims of the safety case."""
CLAIMS = tuple(name for name in INVARIANTS if name in SAFETY)


class Judge:
    """Looks on, second by second; ``asked`` counts how often each invariant was."""

    def __init__(self) -> None:
        self.asked: Counter[str] = Counter(dict.fromkeys(INVARIANTS, 0))
        self._seen: System | None = None

    def look(self, now: Simulation) -> None:
        """Ask what is to be asked now; the simulation ends where something is false."""
        system = now.play.system
        all_of_them = now.now_s % EVERY_S == 0
        if system is self._seen and not all_of_them:
            return
        self._seen = system
        for name in INVARIANTS if all_of_them else CLAIMS:
            self.asked[name] += 1
            if not holds(name, now.play.site, system):
                now.oracles.violated(name, "the invariant is false of the simulated state")
