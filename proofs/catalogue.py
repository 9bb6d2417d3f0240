"""What is assumed of the interlocking and what is claimed of it, by name and in order."""

from __future__ import annotations

from collections.abc import Mapping

from models import axioms
from models.world import premises
from models.world.state import Site, System
from proofs.invariants import bookkeeping, initial, messages, movement, points, safety
from proofs.promise import Predicate, Promise, by_goal
from proofs.promises import cancellation, first_loop, recovery, release, service
from proofs.theory import Theory, predicates
from proofs.transitions import TRANSITIONS, Transition

AXIOMS: Mapping[str, Predicate] = predicates(axioms)
"""Layout axioms, of layout and ground."""
PREMISES: Mapping[str, Predicate] = predicates(premises)
"""Premises on trains and tags, of a site."""
INITIAL: Mapping[str, Predicate] = predicates(initial)
"""The start, of site and system."""
SAFETY: Mapping[str, Predicate] = predicates(safety)
"""The claims of the safety case, of site and system."""
INVARIANTS: Mapping[str, Predicate] = predicates(safety, bookkeeping, messages, movement, points)
"""All that is proved by induction, of site and system."""
PROMISES: Mapping[str, Promise] = by_goal(
    promise for subject in (first_loop, service, release, cancellation, recovery) for promise in subject.PROMISES
)
"""What comes about at last, by goal."""
STEPS: Mapping[str, Transition] = {transition.__name__: transition for transition in TRANSITIONS}
"""The transitions by name."""

INTERLOCKING = Theory(
    "interlocking", Site, System, STEPS, INITIAL, INVARIANTS, SAFETY, PREMISES, AXIOMS, PROMISES, quantified=True
)
"""All of it together."""
