"""Asks one solver one question, from nothing, within a budget that does not depend on the machine."""

from __future__ import annotations

import re
import time
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from functools import cache
from importlib import metadata
from typing import Literal

import cvc5
import z3

from proofs import smtlib
from proofs.products import weaker
from proofs.shorter import shorter
from proofs.workbench import Part

Answer = Literal["unsat", "sat", "unknown"]

BUDGET = {"z3": 4_000_000, "cvc5": 400_000}
"""What a solver may spend on one question, each in its own units."""

FIRST = 4
"""Z3 is first asked with this part of its budget, before other questions that prove the same: mostly that is enough."""

SIMPLER = {"ite-simp": "true", "full-saturate-quant": "true"}
"""The options by which cvc5 is asked a weaker question."""

QUANTIFIER = re.compile(r"\((forall|exists) ")


@dataclass(frozen=True)
class Reply:
    """What a solver said and what it spent; ``seconds`` of wall time are told, never decided on."""

    answer: Answer
    spent: int
    seconds: float


@dataclass(frozen=True)
class Question:
    """What cvc5 is asked of a part, and by which options; ``is_whole``: all of it, so that *sat* is an answer too."""

    text: str
    options: Mapping[str, str]
    is_whole: bool


@cache
def version(solver: str) -> str:
    """Give the version of a solver."""
    return metadata.version({"z3": "z3-solver"}.get(solver, solver))


def ask(solver: str, part: Part, seed: int) -> Reply:
    """Ask whether the part's hypotheses and the negation of its goal can hold together."""
    began = time.perf_counter()
    answer, spent = first_answer(z3_tries(part, seed) if solver == "z3" else cvc5_tries(part, seed))
    return Reply(answer, spent, time.perf_counter() - began)


def _counted(solver: z3.Solver) -> int:
    """Tell what z3 has counted so far; it counts on from question to question, and while terms are made."""
    statistics = solver.statistics()
    told = statistics.keys()
    return int(statistics.get_key_value("rlimit count")) if "rlimit count" in told else 0


def first_answer(tries: Iterator[tuple[Answer, int]]) -> tuple[Answer, int]:
    """Give the first answer of several tries, and what the dearest of those made has spent."""
    dearest = 0
    for answer, spent in tries:
        dearest = max(dearest, spent)
        if answer != "unknown":
            return answer, dearest
    return "unknown", dearest


def if_proved(answer: Answer, spent: int) -> tuple[Answer, int]:
    """Give what the answer to a weaker question says of the question: that it is proved, or nothing."""
    return ("unsat" if answer == "unsat" else "unknown"), spent


def z3_tries(part: Part, seed: int) -> Iterator[tuple[Answer, int]]:
    """Ask Z3 with a fresh solver each, by one question after another that prove the same.

    First the question, with part of the budget; at a loss the shorter one; the weaker one, so and by text; then the
    question with all of the budget, in a new context, and by its text.  In the context that all questions
    share, what terms are numbered by depends on what was made before, and so, now and then, does whether an answer is
    found; the order of terms goes with them into another context.  By its text a question is the same in every
    process; there Z3 does not choose options by what it sees in it, which had it look in the wrong place.
    """
    yield _ask_z3_once(_told(part), seed, FIRST)
    if (less := shorter(part)) is not None:
        yield if_proved(*_ask_z3_once(_told(less), seed))
    if (less := weaker(part)) is not None:
        yield if_proved(*_ask_z3_once(_told(less), seed))
        yield if_proved(*_ask_z3_once(_by_text(less), seed))
    solver = _told(part)
    yield _ask_z3_once(solver, seed)
    yield _ask_z3_once(solver.translate(z3.Context()), seed)
    yield _ask_z3_once(_by_text(part), seed)


def _told(part: Part) -> z3.Solver:
    """Give a solver that was told the question by its terms."""
    solver = z3.Solver()
    for name in sorted(part.hypotheses):
        solver.add(*part.hypotheses[name])
    solver.add(*part.given)
    solver.add(z3.Not(part.goal))
    return solver


def _by_text(part: Part) -> z3.Solver:
    """Give a solver, in a context of its own, that was told the question by its text."""
    solver = z3.Solver(ctx=z3.Context())
    solver.set("auto_config", False)
    solver.from_string(smtlib.script(part))
    return solver


def _ask_z3_once(solver: z3.Solver, seed: int, share: int = 1) -> tuple[Answer, int]:
    solver.set("rlimit", max(1, BUDGET["z3"] // share))
    # An interruption is this program's: taken by the solver it would be lost, and come out as an answer.
    solver.set("ctrl_c", False)
    solver.set("random_seed", seed)
    before = _counted(solver)
    verdict = solver.check()
    spent = _counted(solver) - before
    if verdict == z3.unsat:
        return "unsat", spent
    return ("sat", spent) if verdict == z3.sat else ("unknown", spent)


def cvc5_tries(part: Part, seed: int) -> Iterator[tuple[Answer, int]]:
    """Ask cvc5, by one question of a part after another; each has half the budget."""
    for question in cvc5_questions(part):
        told = ask_cvc5(question.text, seed, question.options)
        yield told if question.is_whole else if_proved(*told)


def cvc5_questions(part: Part) -> Iterator[Question]:
    """Give the text; for a solver at a loss the shorter question, the weaker, and the text with other options.

    The weaker question has simpler terms, by which cvc5 begins with fewer cases, and instances enumerated.
    """
    text = smtlib.script(part)
    yield Question(text, {}, is_whole=True)
    if (less := shorter(part)) is not None:
        yield Question(smtlib.script(less), {}, is_whole=False)
    if (less := weaker(part)) is not None:
        yield Question(smtlib.script(less), SIMPLER, is_whole=False)
    yield Question(text, at_a_loss(text), is_whole=True)


def at_a_loss(text: str) -> Mapping[str, str]:
    """The option by which cvc5 tries again: instances of quantifiers enumerated, or other choices of what to split."""
    return {"full-saturate-quant": "true"} if QUANTIFIER.search(text) else {"decision": "internal"}


def commanded(text: str, budget: int, seed: int, options: Mapping[str, str]) -> tuple[cvc5.Solver, Iterator[str]]:
    """A fresh cvc5 with a budget, and what it says to each command of a text, as it is asked for one after another.

    What it would learn of a text before it begins leads it astray among products; no question needs it.
    """
    solver = cvc5.Solver()
    for name, value in {"rlimit": str(budget), "seed": str(seed), "static-learning": "false", **options}.items():
        solver.setOption(name, value)
    return solver, _said(solver, text)


def _said(solver: cvc5.Solver, text: str) -> Iterator[str]:
    parser = cvc5.InputParser(solver)
    parser.setStringInput(cvc5.InputLanguage.SMT_LIB_2_6, text, "obligation")
    symbols = parser.getSymbolManager()
    while not (command := parser.nextCommand()).isNull():
        yield command.invoke(solver, symbols).strip()


def ask_cvc5(text: str, seed: int, options: Mapping[str, str] | None = None) -> tuple[Answer, int]:
    """Ask cvc5 once, by a text."""
    solver, says = commanded(text, max(1, BUDGET["cvc5"] // 2), seed, options or {})
    said = ""
    for each in says:
        said = each or said
    spent = next(value["value"] for name, value in solver.getStatistics() if name == "resource::resourceUnitsUsed")
    if said == "unsat":
        return "unsat", int(spent)
    return ("sat", int(spent)) if said == "sat" else ("unknown", int(spent))
