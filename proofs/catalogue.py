"""What is assumed and what is claimed, by name and in order."""

from __future__ import annotations

import inspect
from collections.abc import Callable, Mapping
from types import ModuleType

from models import axioms
from models.world import premises
from proofs.invariants import bookkeeping, initial, messages, movement, points, safety
from proofs.transitions import TRANSITIONS, Transition

Predicate = Callable[..., bool]


def _predicates(*modules: ModuleType) -> Mapping[str, Predicate]:
    """Collect the functions that the modules define, in their order."""
    return {
        name: value
        for module in modules
        for name, value in vars(module).items()
        if inspect.isfunction(value) and value.__module__ == module.__name__
    }


AXIOMS: Mapping[str, Predicate] = _predicates(axioms)
"""Layout axioms, of layout and ground."""
PREMISES: Mapping[str, Predicate] = _predicates(premises)
"""Premises on trains and tags, of a site."""
INITIAL: Mapping[str, Predicate] = _predicates(initial)
"""The start, of site and system."""
SAFETY: Mapping[str, Predicate] = _predicates(safety)
"""The claims of the safety case, of site and system."""
INVARIANTS: Mapping[str, Predicate] = _predicates(safety, bookkeeping, messages, movement, points)
"""All that is proved by induction, of site and system."""
STEPS: Mapping[str, Transition] = {transition.__name__: transition for transition in TRANSITIONS}
"""The transitions by name."""
