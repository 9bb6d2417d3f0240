"""What lifting costs against solving, and the two-vocabulary form of a transition against the substituted one."""

from __future__ import annotations

import statistics
from collections.abc import Iterable, Sequence
from dataclasses import dataclass

from proofs import scripts, solvers, usage
from proofs.catalogue import STEPS
from proofs.theory import EVERY_LOOKUP_IS_DEFINED
from proofs.workbench import Part, Workbench
from tests.bench import Figure, percentile

EVERY = 23
"""Every so manieth obligation is taken: a number that meets all rows and all columns."""


@dataclass(frozen=True)
class Measured:
    """Lifting of the whole sample, and solving of each obligation by each solver, in seconds."""

    lifting: float
    solving: dict[str, list[float]]


def sample() -> Sequence[usage.Cell]:
    """Obligations from all over the matrix."""
    cells = [(row, column) for row, column in usage.cells() if row in STEPS and column != EVERY_LOOKUP_IS_DEFINED]
    return cells[::EVERY]


def measure(named: bool) -> Measured:
    """Lift and solve the sample in one of the two forms."""
    bench = Workbench(named=named)
    laid_out: list[list[Part]] = [bench.parts(row, column, scripts.hypotheses(row, column)) for row, column in sample()]
    solving = {}
    for solver in ("z3", "cvc5"):
        spent = []
        for parts in laid_out:
            replies = [solvers.ask(solver, part, 0) for part in parts]
            assert all(reply.answer == "unsat" for reply in replies), "a figure is worth nothing unless all is proved"
            spent.append(sum(reply.seconds for reply in replies))
        solving[solver] = spent
    return Measured(bench.seconds, solving)


def bench_both_forms_and_both_solvers() -> Iterable[Figure]:
    """Time an obligation, and compare: a ratio below 1 means that the named form is the quicker one."""
    forms = {"two vocabularies": measure(named=True), "substituted": measure(named=False)}
    count = len(sample())
    for form, measured in forms.items():
        lifting = measured.lifting
        yield Figure(f"{form}: lifting all {count}", lifting, lifting, "s", 1)
        for solver, spent in measured.solving.items():
            milliseconds = [seconds * 1000 for seconds in spent]
            median, p95 = statistics.median(milliseconds), percentile(milliseconds, 95)
            yield Figure(f"{form}: an obligation, {solver}", median, p95, "ms", count)
            share = lifting / sum(spent)
            yield Figure(f"{form}: lifting / solving, {solver}", share, share, "×", 1)
    named, substituted = forms.values()
    for solver in named.solving:
        each = [one / other for one, other in zip(named.solving[solver], substituted.solving[solver], strict=True)]
        total = sum(named.solving[solver]) / sum(substituted.solving[solver])
        median, p95 = statistics.median(each), percentile(each, 95)
        yield Figure(f"two vocabularies / substituted, {solver}: each", median, p95, "×", count)
        yield Figure(f"two vocabularies / substituted, {solver}: all", total, total, "×", 1)
