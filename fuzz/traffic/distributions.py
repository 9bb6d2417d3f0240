"""Named distributions, from which a trace draws how often a fault comes; by quantiles, so that machines agree."""

from __future__ import annotations

from dataclasses import dataclass
from decimal import Decimal
from typing import Literal

QUANTILES = 64
"""A drawn rate is one of so many, equally likely."""
WHOLE = 1 << 32
"""Chances are counted in parts of this."""


@dataclass(frozen=True)
class Distribution:
    """A chance, drawn between ``low`` and ``high``, both included; ``log-uniform``: each decade is as likely."""

    name: Literal["fixed", "uniform", "log-uniform"]
    low: float
    high: float

    def __post_init__(self) -> None:
        assert 0 <= self.low <= self.high <= 1, self
        assert self.low > 0 or self.name != "log-uniform", self

    def quantile(self, share: Decimal) -> Decimal:
        """The chance that so large a share of all draws lies below."""
        low, high = Decimal(str(self.low)), Decimal(str(self.high))
        if self.name == "log-uniform":
            return (low.ln() + (high.ln() - low.ln()) * share).exp()
        return low + (high - low) * share

    def chances(self) -> tuple[int, ...]:
        """The quantiles in parts of ``WHOLE``, never 0; decimal arithmetic gives the same ones everywhere."""
        shares = (Decimal(at) / (QUANTILES - 1) for at in range(QUANTILES))
        return tuple(max(1, int(self.quantile(share) * WHOLE)) for share in shares)

    def __str__(self) -> str:
        """Name and bounds, as a campaign records them."""
        return f"{self.name}({self.low:g}, {self.high:g})"


def fixed(chance: float) -> Distribution:
    """Always the same."""
    return Distribution("fixed", chance, chance)


def uniform(low: float, high: float) -> Distribution:
    """Every value between the bounds is as likely."""
    return Distribution("uniform", low, high)


def log_uniform(low: float, high: float) -> Distribution:
    """Every decade between the bounds is as likely."""
    return Distribution("log-uniform", low, high)
