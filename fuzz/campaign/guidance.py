"""Where to look next: families of events and faults whose batches led to what is rarely seen are drawn more often.

A campaign goes in rounds of a fixed number of batches.  The weights of a round follow from the batches of all
rounds but the one before it, so that processes need not wait for each other at a round's end, and a campaign
that was killed and resumed draws what an unbroken one draws.

Each tuple, and each pair of tuples, gives one credit, shared evenly by the batches that hit it: what only one
batch ever saw is worth a whole one, what every batch sees next to nothing.  A batch's reward is its share of all
credits.  A family's score is the mean reward of the latest batches, weighted by how much the family was drawn in
each.  Its weight is its score over the mean of all scores, sharpened and kept within bounds, so that no
family ever dies out.  Beside that each batch varies every family's weight by a factor drawn from seed, number
and name: without it no batch could tell the families apart.
"""

from __future__ import annotations

from collections.abc import Sequence
from hashlib import blake2b
from math import fsum

import numpy as np

from fuzz.campaign.rows import Ids
from fuzz.campaign.store import Kept

LATEST_BATCHES = 128
"""So many are looked at: what was found long ago says little about where something new is."""
SHARPENED = 2
LEAST, MOST = 1 / 8, 8.0
"""Bounds of a round's weight."""
FACTORS = (0.25, 1.0, 1.0, 4.0)
"""By which a batch varies a weight, each as likely."""
DIGITS = 6
"""Weights are rounded, so that they are the same as text."""


class Guide:
    """What is known of one target's batches so far, and the weights that follow."""

    def __init__(self, families: Sequence[str]) -> None:
        self.families = tuple(families)
        self._seen = [_Seen(), _Seen()]
        self._latest: list[Kept] = []

    def note(self, batches: Sequence[Kept]) -> None:
        """Take batches in, in the order of their numbers; many at once are quicker."""
        numbers = [batch.number for batch in (*self._latest[-1:], *batches)]
        assert numbers == sorted(set(numbers)), "batches out of order"
        for seen, found in zip(
            self._seen, ([each.covered for each in batches], [each.pairs for each in batches]), strict=True
        ):
            seen.note(found)
        self._latest = [*self._latest, *batches][-LATEST_BATCHES:]

    def weights(self) -> tuple[float, ...]:
        """The weights of a round: 1 for all while nothing is known, or nothing tells families apart."""
        rewards = [
            sum(seen.reward(ids) for seen, ids in zip(self._seen, (each.covered, each.pairs), strict=True))
            for each in self._latest
        ]
        scores = [_mean(rewards, [each.weights[place] for each in self._latest]) for place in range(len(self.families))]
        mean = fsum(scores) / len(scores) if scores else 0.0
        if mean <= 0:
            return (1.0,) * len(self.families)
        return tuple(round(min(max((score / mean) ** SHARPENED, LEAST), MOST), DIGITS) for score in scores)

    def of_batch(self, seed: int, number: int, round_weights: Sequence[float]) -> tuple[float, ...]:
        """The weights of one batch: the round's, each varied by a factor of its own."""
        return tuple(
            round(weight * FACTORS[_drawn(seed, number, family)], DIGITS)
            for family, weight in zip(self.families, round_weights, strict=True)
        )


class _Seen:
    """How many batches hit each id."""

    def __init__(self) -> None:
        self._ids: Ids = np.empty(0, np.int64)
        self._batches: Ids = np.empty(0, np.int64)

    def note(self, found: Sequence[Ids]) -> None:
        """Take in the ids of some batches, each id once a batch."""
        every = np.concatenate([self._ids, *found])
        new = len(every) - len(self._ids)
        self._ids, places = np.unique(every, return_inverse=True)
        batches = np.concatenate([self._batches, np.ones(new, np.int64)])
        self._batches = np.bincount(places, batches, len(self._ids)).astype(np.int64)

    def reward(self, ids: Ids) -> float:
        """The credits of a batch that hit these, each of which was noted."""
        return fsum(1.0 / self._batches[np.searchsorted(self._ids, ids)])


def _mean(values: Sequence[float], weights: Sequence[float]) -> float:
    """A weighted mean; 0 without weight."""
    whole = fsum(weights)
    return fsum(value * weight for value, weight in zip(values, weights, strict=True)) / whole if whole else 0.0


def _drawn(seed: int, number: int, family: str) -> int:
    drawn = blake2b(f"{seed} {number} {family}".encode(), digest_size=8).digest()
    return int.from_bytes(drawn, "big") % len(FACTORS)
