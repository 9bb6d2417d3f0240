"""Of every theory beside the interlocking: what is assumed can be true, what is claimed can be false, and it moves.

A proof from assumptions that nothing satisfies would prove anything, and so would one of steps that
are never taken.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import Any

import pytest
import z3

from proofs.lift import Lifter
from proofs.lints_on_board import OTHERS
from proofs.mutants.plays import calls_of, witnesses
from proofs.mutants.steps import ERRORS, Lifted, lifted
from proofs.mutated import running
from proofs.planted.changes import changes, planted
from proofs.theory import Theory

MILLISECONDS = 20_000
"""For a solver that has gone astray; a question takes no second."""

theories = pytest.mark.parametrize("theory", OTHERS.values(), ids=OTHERS)

OF_WHAT_IS_TOLD = {
    ("train", "a_brake_found_wanting_holds_nobody"): "a_weak_brake_holds_whoever_answers",
    ("train", "a_train_that_was_found_split_is_not_whole"): "a_parted_train_is_intact",
}
"""Claims of what the kernel tells by what it remembers, and a planted change by which it tells something else."""

TO_NOBODY = {"alarm_tone": ["take_display_of_another_edition", "take_fix_of_another_edition"]}
"""Steps that a sound kernel takes for nothing: what comes is of another edition of the network."""

MODELS = 100
"""So many models are looked at: of a set of records not every member of a model is written out."""


def model_of(of: Lifted, *formulas: Any, seed: int = 0) -> tuple[Any, Any]:
    """A site on which the premises hold and a state in which these hold, as Python objects; other seeds give others."""
    solver = solver_of(of, *formulas, seed=seed)
    assert solver.check() == z3.sat
    site, system = of.state(solver.model())
    assert [name for name, premise in of.theory.premises.items() if not premise(site)] == []
    return site, system


def solver_of(of: Lifted, *formulas: Any, seed: int = 0) -> z3.Solver:
    """A solver that knows the premises and these."""
    premises = [of.lifter.formula(premise, of.site) for premise in of.theory.premises.values()]
    solver = z3.Solver()
    solver.set("timeout", MILLISECONDS)
    solver.set("random_seed", seed)
    solver.add(*premises, *formulas, *(named.formula for named in of.scope.axioms()))
    return solver


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
    [
        (theory, name)
        for theory in OTHERS.values()
        for name in theory.invariants
        if (theory.name, name) not in OF_WHAT_IS_TOLD
    ],
    ids=lambda value: getattr(value, "name", value),
)
def test_every_claim_on_board_can_be_false(theory: Theory, name: str) -> None:
    """The premises alone do not imply it: it says something of the system."""
    of = lifted(theory.name)
    broken = broken_somewhere(of.lifter.formula(theory.invariants[name], of.site, of.before))
    models = (model_of(of, broken, seed=seed) for seed in range(MODELS))
    assert any(name in false(theory.invariants, site, system) for site, system in models)


@pytest.mark.parametrize(("claim", "change"), OF_WHAT_IS_TOLD.items(), ids=str)
def test_a_claim_of_what_is_told_can_be_false_of_another_kernel_alone(claim: tuple[str, str], change: str) -> None:
    """The kernel gives it from what it remembers, so that no state breaks it; another answer does."""
    of = lifted(claim[0])
    said, other = of.theory.invariants[claim[1]], planted(changes()[change]).sources
    assert solver_of(of, broken_somewhere(of.lifter.formula(said, of.site, of.before))).check() == z3.unsat
    site, system = model_of(of, broken_somewhere(Lifter(of.scope, other).formula(said, of.site, of.before)))
    with running(other):
        assert claim[1] in false(of.theory.invariants, site, system)


@pytest.mark.sampled(2)
@theories
def test_every_transition_changes_the_state_in_a_witness(theory: Theory) -> None:
    assert witnesses(theory.name)
    moved = {call.step for call in calls_of(theory.name) if call.after != call.before}
    assert sorted(moved) == sorted(theory.steps.keys() - TO_NOBODY.get(theory.name, ()))


@pytest.mark.parametrize(("theory", "step"), [(name, step) for name, steps in TO_NOBODY.items() for step in steps])
def test_a_step_that_is_taken_for_nothing_is_tried_in_a_witness(theory: str, step: str) -> None:
    assert [call for call in calls_of(theory) if call.step == step]


@pytest.mark.sampled(2)
@theories
def test_every_step_of_a_witness_is_within_the_premises_and_keeps_what_is_claimed(theory: Theory) -> None:
    for call in calls_of(theory.name):
        assert [name for name, premise in theory.premises.items() if not premise(call.site)] == []
        assert false(theory.invariants, call.site, call.after) == []


@theories
def test_every_witness_says_what_it_shows(theory: Theory) -> None:
    assert [name for name, witness in witnesses(theory.name).items() if not (witness.__doc__ or "").strip()] == []
