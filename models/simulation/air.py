"""The radio: bytes arrive a little later, much later, twice, damaged, or never; and a stranger may send some (T11).

That a message was sent is a step of the world, and so is what its delivery changes; here is only what becomes of the
bytes between two antennas.  A bearer keeps their order, but for those that it holds up.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable
from random import Random
from typing import NamedTuple

from kernel.link import Party
from models.simulation.agenda import Agenda
from models.simulation.faults import Chosen, happens
from models.simulation.posted import Posted

LEAST_MS, MOST_MS = 100, 400
"""From one end to the other, processing included (ours)."""


class Packet(NamedTuple):
    """Bytes on their way to ``receiver`` as if from ``sender``; ``origin`` is what they truly stem from, if anything.

    ``trick``: what a stranger did to bring them there, if one did.  ``damaged``: bits were flipped on the way.
    """

    sender: Party
    receiver: Party
    raw: bytes
    origin: Posted | None
    trick: str = ""
    damaged: bool = False


Arrives = Callable[[Packet], object]


class Air:
    """Telegrams under way; ``sent`` and ``lost`` are counted, and in ``seen`` the faults."""

    def __init__(self, agenda: Agenda, random: Random, chosen: Chosen) -> None:
        self.agenda = agenda
        self.random = random
        self.chosen = chosen
        self.seen: Counter[str] = Counter()
        self.sent = 0
        self.lost = 0
        self._silent_until_ms: dict[Party, int] = {}
        self._last_ms: dict[tuple[Party, Party], int] = {}

    def silence(self, party: Party, ms: int) -> None:
        """A machine is out of coverage for so long."""
        self._silent_until_ms[party] = max(self._silent_until_ms.get(party, 0), self.agenda.now_ms + ms)

    def carry(self, packet: Packet, arrives: Arrives) -> None:
        """Send a machine's telegram; ``arrives`` is done with it if and when it comes."""
        self.sent += 1
        if self._is_silent(packet.sender) or self._is_silent(packet.receiver) or self.happens("radio_loss"):
            self.lost += 1
            return
        on_the_way = self._flipped(packet) if self.happens("radio_corruption") else packet
        self.agenda.after(self._under_way_ms(packet), lambda: arrives(on_the_way))
        if self.happens("radio_repetition"):
            self.agenda.after(self._lasts_ms("radio_repetition"), lambda: arrives(packet))

    def bring(self, packet: Packet, arrives: Arrives) -> None:
        """Let a stranger's packet arrive."""
        self.agenda.after(self._usual_ms(), lambda: arrives(packet))

    def happens(self, fault: str) -> bool:
        """Draw whether a fault comes now; count it."""
        return happens(fault, self.chosen, self.random, self.seen)

    def _is_silent(self, party: Party) -> bool:
        return self.agenda.now_ms < self._silent_until_ms.get(party, 0)

    def _flipped(self, packet: Packet) -> Packet:
        """Some bits are turned round: so few that they are mended, or so many that they are not."""
        setting = self.chosen["radio_corruption"]
        bits = 8 * len(packet.raw)
        many = min(bits, round(self.random.uniform(setting.least, setting.most)))
        mask = sum(1 << bit for bit in self.random.sample(range(bits), many))
        raw = (int.from_bytes(packet.raw, "big") ^ mask).to_bytes(len(packet.raw), "big")
        return packet._replace(raw=raw, damaged=True)

    def _under_way_ms(self, packet: Packet) -> int:
        """What is held up alone comes after others; all the rest comes in its order."""
        if self.happens("radio_delay"):
            return self._usual_ms() + self._lasts_ms("radio_delay")
        way = packet.sender, packet.receiver
        self._last_ms[way] = max(self._last_ms.get(way, 0), self.agenda.now_ms + self._usual_ms())
        return self._last_ms[way] - self.agenda.now_ms

    def _usual_ms(self) -> int:
        return self.random.randint(LEAST_MS, MOST_MS)

    def _lasts_ms(self, fault: str) -> int:
        return round(self.random.uniform(self.chosen[fault].least, self.chosen[fault].most) * 1_000)
