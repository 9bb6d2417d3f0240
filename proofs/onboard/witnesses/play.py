"""Plays a concrete run of a theory in CPython; every invariant is looked at after every step."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any, Generic, TypeVar

from proofs.promise import Predicate
from proofs.theory import Theory

Site = TypeVar("Site")
System = TypeVar("System")


LONGEST_STEPS = 100_000
"""No witness takes more: one that waits for what does not come any more, with a fault planted, has failed."""


class Play(Generic[Site, System]):
    """A run so far: its site, and its state now."""

    def __init__(self, theory: Theory, site: Site, system: System) -> None:
        """Begin where the theory begins; its premises must hold."""
        self.theory = theory
        self.site = site
        self.system = system
        self.steps = 0
        self._hold(theory.premises, site)
        self._hold(theory.initial, site, system)
        self._hold(theory.invariants, site, system)

    def step(self, name: str, **event: Any) -> System:
        """Let one thing happen, and give the state after."""
        self.steps += 1
        assert self.steps <= LONGEST_STEPS, f"{self.theory.name}: nothing comes of it in {LONGEST_STEPS} steps"
        self.system = self.theory.steps[name](self.site, self.system, **event)
        self._hold(self.theory.invariants, self.site, self.system)
        return self.system

    def _hold(self, claims: Mapping[str, Predicate], *told: Any) -> None:
        for name, claim in claims.items():
            assert claim(*told), f"{self.theory.name}: {name} does not hold: {told[-1]}"
