"""Of every theory beside the interlocking: what is assumed can be true, what is claimed can be false, and it moves.

A proof from assumptions that nothing satisfies would prove anything, and so would one of steps that
are never taken.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import Any

import pytest
import z3

from proofs.lints_on_board import OTHERS
from proofs.mutants.plays import calls_of, witnesses
from proofs.mutants.steps import ERRORS, Lifted, lifted
from proofs.theory import Theory

MILLISECONDS = 20_000
"""For a solver that has gone astray; a question takes no second."""

theories = pytest.mark.parametrize("theory", OTHERS.values(), ids=OTHERS)

MODELS = 100
"""So many models are looked at: of a set of records not every member of a model is written out."""


def model_of(of: Lifted, *formulas: Any, seed: int = 0) -> tuple[Any, Any]:
    """A site on which the premises hold and a state in which these hold, as Python objects; other seeds give others."""
    theory = of.theory
    premises = [of.lifter.formula(premise, of.site) for premise in theory.premises.values()]
    solver = z3.Solver()
    solver.set("timeout", MILLISECONDS)
    solver.set("random_seed", seed)
    solver.add(*premises, *formulas, *(named.formula for named in of.scope.axioms()))
    assert solver.check() == z3.sat
    site, system = of.state(solver.model())
    assert [name for name, premise in theory.premises.items() if not premise(site)] == []
    return site, system


def broken_somewhere(claim: Any) -> Any:
    """That a claim does not hold; where it is of everything, with constants for what breaks it, which a model names."""
    if not (z3.is_quantifier(claim) and claim.is_forall()):
        return z3.Not(claim)
    breaks = [z3.FreshConst(claim.var_sort(place)) for place in range(claim.num_vars())]
    return z3.Not(z3.substitute_vars(claim.body(), *reversed(breaks)))


def false(claims: Mapping[str, Callable[..., bool]], site: Any, system: Any) -> list[str]:
    """The claims that do not hold in CPython."""
    return [name for name, claim in claims.items() if not holds(claim, site, system)]


def holds(claim: Callable[..., bool], site: Any, system: Any) -> bool:
    """Whether a claim is true; one that looks up what is not there is not (where the others hold it never does)."""
    try:
        return bool(claim(site, system))
    except ERRORS:
        return False


@theories
def test_the_theory_can_start(theory: Theory) -> None:
    of = lifted(theory.name)
    formulas = [of.lifter.formula(claim, of.site, of.before) for claim in theory.initial.values()]
    site, system = model_of(of, *formulas)
    assert false({**theory.initial, **theory.invariants}, site, system) == []


@theories
def test_all_that_is_claimed_can_hold_at_once(theory: Theory) -> None:
    of = lifted(theory.name)
    formulas = [of.lifter.formula(claim, of.site, of.before) for claim in theory.invariants.values()]
    site, system = model_of(of, *formulas)
    assert false(theory.invariants, site, system) == []


@pytest.mark.sampled(3)
@pytest.mark.parametrize(
    ("theory", "name"),
    [(theory, name) for theory in OTHERS.values() for name in theory.invariants],
    ids=lambda value: getattr(value, "name", value),
)
def test_every_claim_on_board_can_be_false(theory: Theory, name: str) -> None:
    """The premises alone do not imply it: it says something of the system."""
    of = lifted(theory.name)
    broken = broken_somewhere(of.lifter.formula(theory.invariants[name], of.site, of.before))
    models = (model_of(of, broken, seed=seed) for seed in range(MODELS))
    assert any(name in false(theory.invariants, site, system) for site, system in models)


@pytest.mark.sampled(2)
@theories
def test_every_transition_changes_the_state_in_a_witness(theory: Theory) -> None:
    assert witnesses(theory.name)
    assert sorted({call.step for call in calls_of(theory.name) if call.after != call.before}) == sorted(theory.steps)


@pytest.mark.sampled(2)
@theories
def test_every_step_of_a_witness_is_within_the_premises_and_keeps_what_is_claimed(theory: Theory) -> None:
    for call in calls_of(theory.name):
        assert [name for name, premise in theory.premises.items() if not premise(call.site)] == []
        assert false(theory.invariants, call.site, call.after) == []


@theories
def test_every_witness_says_what_it_shows(theory: Theory) -> None:
    assert [name for name, witness in witnesses(theory.name).items() if not (witness.__doc__ or "").strip()] == []
