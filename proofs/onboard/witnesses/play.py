"""Plays a concrete run of a theory in CPython; every invariant is looked at after every step."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any, Generic, TypeVar

from proofs.promise import Predicate
from proofs.theory import Theory

Site = TypeVar("Site")
System = TypeVar("System")


class Play(Generic[Site, System]):
    """A run so far: its site, and its state now."""

    def __init__(self, theory: Theory, site: Site, system: System) -> None:
        """Begin where the theory begins; its premises must hold."""
        self.theory = theory
        self.site = site
        self.system = system
        self._hold(theory.premises, site)
        self._hold(theory.initial, site, system)
        self._hold(theory.invariants, site, system)

    def step(self, name: str, **event: Any) -> System:
        """Let one thing happen, and give the state after."""
        self.system = self.theory.steps[name](self.site, self.system, **event)
        self._hold(self.theory.invariants, self.site, self.system)
        return self.system

    def _hold(self, claims: Mapping[str, Predicate], *told: Any) -> None:
        for name, claim in claims.items():
            assert claim(*told), f"{self.theory.name}: {name} does not hold: {told[-1]}"
