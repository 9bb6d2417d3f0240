"""What threatens telegrams: the seven threats of EN 50159, and what machines and clocks do meanwhile (T11)."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from random import Random

THREATS: Mapping[str, str] = {
    "deletion": "a telegram does not arrive at this chance",
    "repetition": "one that has arrived arrives again",
    "resequencing": "an older one arrives instead of the newest",
    "delay": "time passes between sending and arriving, up to minutes",
    "corruption": "its content, sender, number or time arrives changed, and its code of authentication is wrong",
    "insertion": "a telegram that nobody sent, with a code that is wrong",
    "masquerade": "one that was sent between two machines arrives at another, with its right code",
    "receiver's clock": "its reading, within its bound of the true time, goes back and forth",
    "sender's clock": "a telegram is stamped by a clock that is wrong by up to seconds, which nobody can know",
    "restart": "a machine restarts and has forgotten all but its life",
    "stale session": "one of a life that is over arrives",
}
"""What a run of the channel may have, each at a rate of its own."""
PRESENT = 0.6
"""How likely a threat is present in a run; together with its rate, drawn evenly up to the most."""
MOST = 0.5


@dataclass(frozen=True)
class Rates:
    """How likely each threat is at each chance it has in a run; 0 for one that is absent."""

    of: Mapping[str, float]

    def strikes(self, threat: str, random: Random) -> bool:
        """Whether a threat comes now."""
        return random.random() < self.of[threat]


def drawn(random: Random, weights: Mapping[str, float]) -> Rates:
    """Draw which threats a run has; ``weights``: how much more or less often each is present."""
    return Rates(
        {
            threat: random.uniform(0, MOST) if random.random() < PRESENT * weights.get(threat, 1.0) else 0.0
            for threat in THREATS
        }
    )
