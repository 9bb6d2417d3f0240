"""Natural, typed, total Python functions as formulas: a small compiler from source to Z3.

The subset is stated in SUBSET.md.
"""

from proofs.lift import calls, comparisons, comprehensions, operators
from proofs.lift.concrete import concretise, embed
from proofs.lift.errors import OutsideSubset
from proofs.lift.frames import Obligation
from proofs.lift.lifter import Case, Lifter, conjuncts
from proofs.lift.scopes import FiniteScope, Named, Scope, UnboundedScope
from proofs.lift.values import Mismatch, Value

CONSTRUCTS = (calls, comparisons, comprehensions, operators)
"""The modules that enter the constructs they lift."""

__all__ = [
    "CONSTRUCTS",
    "Case",
    "FiniteScope",
    "Lifter",
    "Mismatch",
    "Named",
    "Obligation",
    "OutsideSubset",
    "Scope",
    "UnboundedScope",
    "Value",
    "concretise",
    "conjuncts",
    "embed",
]
