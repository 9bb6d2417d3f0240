"""A question with products that only grow is weaker than the question, and what it proves is so."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

import pytest
import z3

from proofs import products, run, smtlib, solvers
from proofs.workbench import Part

SOLVERS = ("z3", "cvc5")
X, Y, Z = z3.Ints("x y z")


def with_products(term: Any) -> Any:
    """Put multiplication where a term has the function that stands for it."""
    return z3.substitute_funs(term, (products.product(), z3.Var(0, z3.IntSort()) * z3.Var(1, z3.IntSort())))


@pytest.mark.parametrize("solver", SOLVERS)
@pytest.mark.parametrize("name", [products.GROWS, products.IS_NOT_NEGATIVE])
def test_what_is_said_of_products_is_true_of_them(solver: str, name: str) -> None:
    said = with_products(products.is_true_of(products.product())[name])
    bound = [z3.Int(f"factor{number}") for number in range(said.num_vars())]
    goal = z3.substitute_vars(said.body(), *reversed(bound))
    assert "product" not in goal.sexpr()
    assert solvers.ask(solver, Part({}, [], goal), 0).answer == "unsat"


@pytest.mark.parametrize("solver", SOLVERS)
def test_what_would_be_false_of_them_is_noticed(solver: str) -> None:
    """By a factor below zero products fall."""
    assert solvers.ask(solver, Part({}, [], z3.Implies(X <= Y, Z * X <= Z * Y)), 0).answer == "sat"


def asked() -> Iterator[Part]:
    """Give the questions of a few obligations with many products."""
    for row, column in (
        ("alarm_tone.listen_for_one_with_a_fix", "the_normal_tone_means_no_train_within_3000_m"),
        ("alarm_tone.take_fix", "trains_are_within_reach_of_right_fixes"),
        ("alarm_distance.run_on", "the_train_is_within_reach_of_its_fix"),
    ):
        yield from run.parts(row, column)


def test_a_weaker_question_is_the_question_but_for_its_products() -> None:
    """With multiplication in the place of the function it is what it was, to the last term."""
    seen = 0
    for part in asked():
        less = products.weaker(part)
        if less is None:
            continue
        seen += 1
        assert set(less.hypotheses) == {*part.hypotheses, products.GROWS, products.IS_NOT_NEGATIVE}
        assert len(less.given) == len(part.given)
        for name, formulas in {**part.hypotheses, "": [*part.given, part.goal]}.items():
            weak = less.hypotheses[name] if name else [*less.given, less.goal]
            assert all(are_alike(one, other) for one, other in zip(formulas, weak, strict=True))
    assert seen > 10


def are_alike(whole: Any, weak: Any) -> bool:
    """Tell whether two terms are the same, but that the other has the function where the one multiplies."""
    if z3.is_quantifier(whole):
        bound = [whole.var_sort(each) for each in range(whole.num_vars())]
        return (
            z3.is_quantifier(weak)
            and whole.is_forall() == weak.is_forall()
            and bound == [weak.var_sort(each) for each in range(weak.num_vars())]
            and are_alike(whole.body(), weak.body())
        )
    if z3.is_mul(whole):
        return all(are_alike(one, other) for one, other in zip(factors(whole), factors(weak), strict=True))
    if not z3.is_app(whole) or not whole.num_args():
        return bool(whole.eq(weak))
    return bool(whole.decl().eq(weak.decl())) and all(
        are_alike(one, other) for one, other in zip(whole.children(), weak.children(), strict=True)
    )


def factors(term: Any) -> list[Any]:
    """Give what is multiplied in a term, numerals first."""
    if z3.is_mul(term) or (z3.is_app(term) and term.decl().eq(products.product())):
        every = [factor for child in term.children() for factor in factors(child)]
        return sorted(every, key=lambda each: not z3.is_int_value(each))
    return [term]


def test_what_has_no_product_has_no_weaker_question() -> None:
    assert products.weaker(Part({"x_is_positive": [X > 0]}, [3 * X > Y], X > -1)) is None


def test_a_weaker_question_that_has_a_model_says_nothing() -> None:
    """That products are the same either way round is not among what is said of them."""
    part = Part({}, [X > 7], X * Y + 1 > Y * (X + Z))
    less = products.weaker(part)
    assert less is not None
    answer, _ = solvers.ask_cvc5(smtlib.script(less), 0)
    assert answer != "unsat"
    for tries in (solvers.z3_tries, solvers.cvc5_tries):
        answers = [answer for answer, _ in tries(part, 0)]
        assert answers[1] == "unknown", "of the weaker one"
    assert solvers.if_proved("sat", 5) == ("unknown", 5)
    assert solvers.if_proved("unsat", 5) == ("unsat", 5)


def test_only_of_the_whole_question_is_a_model_an_answer() -> None:
    part = Part({"z_is_positive": [Z > 0]}, [], X * Y <= Y * X)
    questions = list(solvers.cvc5_questions(part))
    assert [each.is_whole for each in questions] == [each.text == smtlib.script(part) for each in questions]
    assert [each.is_whole for each in questions] == [True, False, False, True]


def test_a_solver_at_a_loss_proves_by_the_weaker_question(monkeypatch: pytest.MonkeyPatch) -> None:
    """Asked for nothing else it would not: the whole question is answered by neither there."""
    part = Part({"grows": [X >= 0, Y <= Z]}, [], X * Y <= X * Z)
    once = solvers.ask_cvc5

    def at_a_loss(text: str, *more: Any) -> tuple[Any, int]:
        return once(text, *more) if products.PRODUCT in text else ("unknown", 1)

    monkeypatch.setattr(solvers, "ask_cvc5", at_a_loss)
    assert solvers.ask("cvc5", part, 0).answer == "unsat"
    assert solvers.ask("cvc5", Part({}, [], X * Y <= X * Z), 0).answer == "unknown"


def test_no_symbol_of_a_theory_is_named_as_the_function_is() -> None:
    names = {name for part in asked() for name, _ in smtlib.symbols_of(*part.given, part.goal)}
    assert names
    assert products.PRODUCT not in names
