"""What was really sent, and whether what is delivered is that: judged by a list of its own and by no link's state.

A telegram is known here by where its bytes truly stem from, which no machine can see.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable
from typing import NamedTuple

from kernel.link import Limits, Party
from models.simulation.wording import Fields

ONLY_WHAT_WAS_SENT, SILENCE = "only_what_was_sent_is_delivered", "silence_is_noticed"

Must = Callable[[str, bool, str], object]
"""The name of an oracle, whether it holds, and what to say where it does not."""


class Posted(NamedTuple):
    """A telegram that a machine sent: the how manieth of all, when, and what it meant to say.

    ``receiver_life``: how often the receiver had restarted when it was sent.
    """

    number: int
    sender: Party
    receiver: Party
    receiver_life: int
    at_ms: int
    kind: str
    fields: Fields


class Post:
    """The list of what was posted, as far as it is still to be judged by: restarts, and what each machine has had."""

    def __init__(self, limits: Limits, must: Must) -> None:
        self.limits = limits
        self.must = must
        self._number = 0
        self._lives: Counter[Party] = Counter()
        self._had: dict[tuple[Party, Party], int] = {}
        self._had_at_ms: dict[tuple[Party, Party], int] = {}

    def restarted(self, party: Party) -> None:
        """A machine has restarted: it has heard nobody."""
        self._lives[party] += 1
        self._had_at_ms = {pair: at_ms for pair, at_ms in self._had_at_ms.items() if pair[0] != party}

    def posted(self, sender: Party, receiver: Party, now_ms: int, kind: str, fields: Fields) -> Posted:
        """Put down a telegram that is sent."""
        self._number += 1
        return Posted(self._number, sender, receiver, self._lives[receiver], now_ms, kind, fields)

    def delivered(
        self, me: Party, peer: Party, now_ms: int, origin: Posted | None, said: tuple[str, Fields] | None
    ) -> None:
        """Judge what a link delivers as its peer's; ``said``: as it was read, None where it could not be."""
        wrong = self._wrong(me, peer, now_ms, origin, said)
        self.must(ONLY_WHAT_WAS_SENT, wrong is None, f"{me} believes {said and said[0]} of {peer}: {wrong}")
        if origin is not None:
            self._had[me, peer] = origin.number
        self._had_at_ms[me, peer] = now_ms

    def _wrong(
        self, me: Party, peer: Party, now_ms: int, origin: Posted | None, said: tuple[str, Fields] | None
    ) -> str | None:
        """What is wrong with a delivery, if anything is."""
        if origin is None:
            return "nobody has sent it"
        if (origin.sender, origin.receiver) != (peer, me):
            return f"{origin.sender} sent it to {origin.receiver}"
        if origin.receiver_life != self._lives[me]:
            return "it was sent before a restart of the receiver"
        if origin.number <= self._had.get((me, peer), 0):
            return "it was delivered before, or a later one was"
        most_ms = self.limits.fresh_ms + 2 * self.limits.offset_ms
        if now_ms - origin.at_ms > most_ms:
            return f"it was sent {now_ms - origin.at_ms} ms ago"
        if said != (origin.kind, origin.fields):
            return f"what was sent is {origin.kind} {dict(origin.fields)}"
        return None

    def heard(self, me: Party, peer: Party, now_ms: int, silent: bool) -> None:
        """Judge what a machine says of its link: one that is not silent has delivered something lately."""
        at_ms = self._had_at_ms.get((me, peer))
        so = silent or (at_ms is not None and now_ms - at_ms <= self.limits.silence_ms + 4 * self.limits.offset_ms)
        self.must(SILENCE, so, f"{me} has not noticed that {peer} is silent")
