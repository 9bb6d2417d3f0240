"""A system whose days are simulated, and what is counted of each day."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field

import numpy as np
import numpy.typing as npt

Numbers = npt.NDArray[np.int64]
"""A row for each day, a column for each of a system's ``columns``."""


@dataclass(frozen=True)
class System:
    """How days of a system are simulated, and the names of the columns that come of it.

    Each mapping goes from a column's name to what it counts, in words:
    ``claims``: what must not be.  ``assumptions``: those of the proofs, held against the truth: how often broken.
    ``monitors``: what the machines noticed.  ``faults``: those drawn.  ``prices``: what it costs to be on the safe
    side, with units.  ``counts``: the rest.
    ``hours``: of traffic in a day.
    ``one_day``: from a seed and the number of a day to its row; nothing else has a say in it, but third the names of
    faults ``beyond`` what is assumed, which it then has; each goes with the assumption that it breaks.
    """

    name: str
    claims: Mapping[str, str]
    assumptions: Mapping[str, str]
    monitors: Mapping[str, str]
    faults: Mapping[str, str]
    prices: Mapping[str, str]
    counts: Mapping[str, str]
    hours: float
    one_day: Callable[..., Numbers] = field(repr=False)
    beyond: Mapping[str, str] = field(default_factory=dict)

    @property
    def columns(self) -> tuple[str, ...]:
        """Every column's name, in order."""
        return (*self.claims, *self.assumptions, *self.monitors, *self.faults, *self.prices, *self.counts)

    def simulate(self, seed: int, days: range, *beyond: str) -> Numbers:
        """Simulate days: a row for each, a column for each of ``columns``; ``beyond``: faults that each of them has."""
        named = (beyond,) if beyond else ()
        rows = [self.one_day(seed, day, *named) for day in days]
        return np.array(rows, np.int64).reshape(len(days), len(self.columns))
