"""The radio: a telegram arrives a little later, much later, twice, or never (T11).

That a telegram was sent is a step of the world, and so is its arrival; here is only when.
"""

from __future__ import annotations

from collections import Counter
from random import Random

from kernel.names import Train
from models.simulation.agenda import Act, Agenda
from models.simulation.faults import Chosen, happens

LEAST_MS, MOST_MS = 100, 400
"""From one end to the other, processing included (ours)."""


class Air:
    """Telegrams under way; ``sent`` and ``lost`` are counted, and in ``seen`` the faults."""

    def __init__(self, agenda: Agenda, random: Random, chosen: Chosen) -> None:
        self.agenda = agenda
        self.random = random
        self.chosen = chosen
        self.seen: Counter[str] = Counter()
        self.sent = 0
        self.lost = 0
        self._silent_until_ms: dict[Train, int] = {}

    def silence(self, train: Train, ms: int) -> None:
        """A train is out of coverage for so long."""
        self._silent_until_ms[train] = max(self._silent_until_ms.get(train, 0), self.agenda.now_ms + ms)

    def carry(self, train: Train, arrives: Act) -> None:
        """Send a telegram to or from a train; ``arrives`` is done if and when it comes."""
        self.sent += 1
        if self.agenda.now_ms < self._silent_until_ms.get(train, 0) or self._happens("radio_loss"):
            self.lost += 1
            return
        self.agenda.after(self._under_way_ms(), arrives)
        if self._happens("radio_repetition"):
            self.agenda.after(self._lasts_ms("radio_repetition"), arrives)

    def _under_way_ms(self) -> int:
        usual = self.random.randint(LEAST_MS, MOST_MS)
        return usual + self._lasts_ms("radio_delay") if self._happens("radio_delay") else usual

    def _happens(self, fault: str) -> bool:
        return happens(fault, self.chosen, self.random, self.seen)

    def _lasts_ms(self, fault: str) -> int:
        return round(self.random.uniform(self.chosen[fault].least, self.chosen[fault].most) * 1_000)
