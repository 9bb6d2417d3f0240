"""Drops in the theories beside the interlocking: the search finds what breaks, and only what CPython confirms."""

from __future__ import annotations

import ast
from functools import cache
from typing import Any

import pytest

from kernel.onboard import braking, odometry
from proofs.lift.sources import definition_of
from proofs.lints_on_board import OTHERS
from proofs.mutants import plays, steps
from proofs.mutants.classes import not_implied
from proofs.mutants.edits import Mutant, mutants_of
from proofs.mutants.targets import mutants, transitions_of
from proofs.mutants.trial import tried
from proofs.mutated import running
from proofs.theory import Theory

KILLED = [
    "kernel.onboard.odometry.note_cycle: and-operand agrees(",
    "kernel.onboard.odometry.way_error_mm: sign",
    "kernel.onboard.odometry.roll: term error_mm",
    "kernel.onboard.odometry.glide: limit smaller(motion.speed_least_mm_s",
    "kernel.onboard.odometry.located: update",
    "kernel.onboard.braking.supervise: and-operand stops_before",
    "kernel.onboard.braking.reach_nm: term",
    "kernel.link.judge: guard if not is_authentic",
    "models.onboard.odometry.take_fix: update",
    "models.onboard.braking.run_a_cycle: guard",
    "models.link.arrive: guard",
]
"""The beginnings of names: the first mutant so named is tried."""

LARGE = {"train.read_a_tag"}
"""Rows of so many parts that a search of all of them takes minutes."""

theories = pytest.mark.parametrize("theory", OTHERS.values(), ids=OTHERS)


@cache
def first(beginning: str) -> Mutant:
    return next(mutant for name, mutant in mutants().items() if name.startswith(beginning))


@pytest.mark.parametrize("beginning", KILLED)
def test_a_drop_on_board_is_noticed(beginning: str) -> None:
    verdict = tried(first(beginning))
    assert verdict.outcome == "counterexample", verdict.searched
    assert verdict.finding


@pytest.mark.sampled(6)
@pytest.mark.parametrize(
    "row",
    [
        pytest.param(row, marks=pytest.mark.slow if row in LARGE else ())
        for theory in OTHERS.values()
        for name in theory.steps
        if (row := f"{theory.name}.{name}")
    ],
)
def test_no_step_breaks_a_claim_while_nothing_is_dropped(row: str) -> None:
    found, verdict = steps.lifted(row.partition(".")[0]).search(row, {}, 3_000)
    assert found is None
    assert verdict in ("none", "unknown")


@pytest.mark.sampled(3)
@theories
def test_no_witness_fails_while_nothing_is_dropped(theory: Theory) -> None:
    assert plays.failing(theory.name, {}) == []


@theories
def test_every_step_of_a_theory_has_mutants(theory: Theory) -> None:
    rows = {row for mutant in mutants().values() for row in transitions_of(mutant.function)}
    assert {f"{theory.name}.{name}" for name in theory.steps} <= rows


def test_a_mutant_is_a_function_that_runs() -> None:
    """Each compiles; a body that does not would seem to be killed by everything."""
    for mutant in mutants().values():
        own = mutant.function.__code__
        with running(mutant.sources):
            assert mutant.is_of_a_module or mutant.function.__code__ is not own
        assert mutant.function.__code__ is own


def dropped(function: Any, kind: str) -> list[str]:
    return [mutant.text for mutant in mutants_of(function) if mutant.kind == kind]


def test_limits_terms_signs_and_roundings_are_dropped() -> None:
    assert "smaller(motion.speed_least_mm_s, slowest_mm_s) (slowest_mm_s)" in dropped(odometry.glide, "limit")
    assert any("(no most)" in text for text in dropped(odometry.next_gradient_mm_s2, "limit"))
    assert dropped(odometry.way_error_mm, "sign")
    assert dropped(odometry.glide, "rounding")
    assert "error_mm" in dropped(odometry.roll, "term")
    assert dropped(odometry.tachometer_speaks, "part")
    for mutant in mutants_of(braking.supervise):
        assert ast.unparse(mutant.tree) != ast.unparse(definition_of(braking.supervise))


def rewritten(function: Any, old: str, new: str) -> Mutant:
    """The function with other text in it, as a mutant."""
    text = ast.unparse(definition_of(function))
    assert old in text
    tree = ast.parse(text.replace(old, new, 1)).body[0]
    assert isinstance(tree, ast.FunctionDef)
    return Mutant(function, "rewritten", old, tree)


def test_what_makes_no_difference_is_proved_to_make_none() -> None:
    same = rewritten(odometry.note_fix, "motion.loss != Loss.NONE", "not motion.loss == Loss.NONE")
    assert not_implied(same, []) == ""
    other = rewritten(odometry.note_fix, "motion.loss != Loss.NONE", "motion.loss == Loss.CONTRADICTED")
    assert "odometry.take_fix" in not_implied(other, [])


def test_what_makes_no_difference_under_a_premise_is_proved_from_it() -> None:
    drop = rewritten(odometry.speed_error_mm_s, "bounds.scale_ppm", "(bounds.scale_ppm if bounds.scale_ppm > 0 else 0)")
    assert not_implied(drop, ["bounds_are_not_negative"]) == ""
    assert not_implied(drop, []) != ""


def test_what_is_near_a_witness_can_break_a_claim_too() -> None:
    """The last resort, where the solver does not know: states near those of witnesses."""
    mutant = first("kernel.onboard.split.counts: and-operand magnitude(")
    row = transitions_of(mutant.function)[0]
    assert steps.near_witnesses(row, {}, tries=300) is None
    found = steps.near_witnesses(row, mutant.sources)
    assert found is not None
    assert steps.unmet(OTHERS["split"], found.site, found.before) == []
    assert found.false
