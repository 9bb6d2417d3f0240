"""A stranger at the radio: hears and keeps what is sent, and sends what is not his to send (T11).

Keys are not his: he can read a telegram and change it, but cannot make its code of authentication.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, field
from random import Random

from kernel.link import Party
from kernel.telegram import KEY_BYTES, LIVES_AT, SEQUENCE_AT, SEQUENCE_BYTES, TAIL_BYTES, number_in, sealed
from models.simulation.air import Air, Packet

KEPT = 8
"""Telegrams of each session that he keeps."""
WRONG_KEY, THROWN_BACK, ELSEWHERE, REPLAYED = (
    "made with another key",
    "thrown back at its sender",
    "taken to another machine",
    "sent again, from the past",
)
Way = tuple[Party, Party]


@dataclass
class Stranger:
    """One who hears everything; ``kept``: by way and session, which he reads off the lives in the bytes."""

    air: Air
    random: Random
    kept: dict[Way, dict[bytes, list[Packet]]] = field(default_factory=dict)

    def hears(self, packet: Packet) -> Iterator[Packet]:
        """Take notice of a telegram, heard where it is sent and whole: its parity is behind it; give what he sends."""
        restored = packet.raw[: len(packet.raw) // 2]
        kept = self.kept.setdefault((packet.sender, packet.receiver), {})
        session = restored[LIVES_AT:SEQUENCE_AT]
        told = kept.setdefault(session, [])
        if len(told) < KEPT:
            told.append(packet)
        if self.air.happens("radio_forgery"):
            yield self._forged(packet, restored)
        if self.air.happens("radio_replay"):
            old = [each for other, each in kept.items() if other != session] or [told]
            yield self.random.choice(self.random.choice(old))._replace(trick=REPLAYED)

    def _forged(self, packet: Packet, restored: bytes) -> Packet:
        """The next in turn by a key of his own; or a true one, thrown back, or where it does not belong."""
        trick = self.random.choice((WRONG_KEY, THROWN_BACK, ELSEWHERE))
        if trick == THROWN_BACK:
            return packet._replace(sender=packet.receiver, receiver=packet.sender, trick=trick)
        elsewhere = [way for way in self.kept if way != (packet.sender, packet.receiver)]
        if trick == ELSEWHERE and elsewhere:
            sender, receiver = self.random.choice(elsewhere)
            return packet._replace(sender=sender, receiver=receiver, trick=trick)
        body = restored[:-TAIL_BYTES]
        number = number_in(body, SEQUENCE_AT, SEQUENCE_BYTES) + 1
        next_one = body[:SEQUENCE_AT] + number.to_bytes(SEQUENCE_BYTES, "big") + body[SEQUENCE_AT + SEQUENCE_BYTES :]
        raw = sealed(self.random.randbytes(KEY_BYTES), next_one)
        return Packet(packet.sender, packet.receiver, raw, None, WRONG_KEY)
