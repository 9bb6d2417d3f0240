"""Questions whose answer is known, put to each solver before any answer of it is believed.

A solver that says *unsat* to everything would prove everything.  So each is first asked what is not
so: obligations with a needed hypothesis left out, with nothing left to follow but a contradiction, and
with a guard of the kernel dropped.  It must find the state in which they fail.  They go the way of every
obligation, from the same source by way of the same lifter.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, replace
from functools import cache
from typing import Any

import z3

from kernel.onboard import braking, split
from proofs import scripts
from proofs.mutants.edits import mutants_of
from proofs.records import CanarySeen
from proofs.solvers import BUDGET, ask, version
from proofs.theories import theory_of
from proofs.workbench import Part, Workbench

NOTHING = "a contradiction"
"""Asked for in place of the claim."""


@dataclass(frozen=True)
class Canary:
    """An obligation that does not hold.

    ``without``: a hypothesis that its proof needs, left out.  ``guard``: a function and the name of a mutant of
    it, which takes its place.  With neither, a contradiction is to follow, which it does from nothing that can be.
    ``part``: which of the obligation's parts fails, counted from 0.
    """

    row: str
    column: str
    part: int = 0
    without: str = ""
    guard: tuple[Callable[..., Any], str] | None = None

    @property
    def name(self) -> str:
        """What is asked, in words."""
        if self.guard is not None:
            return f"{self.row} × {self.column}, {self.guard[0].__name__} without: {self.guard[1]}"
        return f"{self.row} × {self.column} without {self.without}" if self.without else f"{self.row} × {NOTHING}"


CANARIES = (
    Canary("braking.run_a_cycle", "head_stays_inside_authority", without="the_brake_slows"),
    Canary("split.run_a_cycle", "split_is_latched", without="split_is_latched"),
    Canary("speed_limit.run_on", "a_train_too_fast_for_any_of_its_track_brakes"),
    Canary("braking.run_a_cycle", "head_stays_inside_authority", guard=(braking.supervise, "or-operand not safe")),
    Canary("split.run_a_cycle", "split_is_latched", guard=(split.is_intact, "and-operand not state.split")),
    Canary("restart_terminal", "no_point_moves_under_a_train", without="no_point_moves_under_a_train"),
    Canary("take_over", "entry_only_after_first_loop"),
)
"""What each solver is asked."""


def seen(asked: Sequence[str]) -> list[CanarySeen]:
    """Put every canary to these solvers."""
    return [one for solver in asked for one in _seen(solver, BUDGET[solver])]


@cache
def _seen(solver: str, budget: int) -> tuple[CanarySeen, ...]:
    """Put every canary to one solver; asked once a process and budget."""
    assert budget == BUDGET[solver]
    return tuple(_asked(solver, canary, part) for canary, part in laid_out())


def _asked(solver: str, canary: Canary, part: Part) -> CanarySeen:
    """Ask.  cvc5 builds no models of quantified formulas, so it may be at a loss there; Z3 may not."""
    answer = ask(solver, part, 0).answer
    at_a_loss = answer == "unknown" and solver == "cvc5" and theory_of(canary.row)[0].quantified
    return {
        "canary": canary.name,
        "solver": solver,
        "solver_version": version(solver),
        "answer": answer,
        "noticed": answer == "sat" or at_a_loss,
    }


@cache
def laid_out() -> tuple[tuple[Canary, Part], ...]:
    """Every canary and its question, lifted apart from everything that is to be proved."""
    return tuple(_parts())


def _parts() -> Iterator[tuple[Canary, Part]]:
    benches: dict[str, Workbench] = {}
    for canary in CANARIES:
        theory, name = theory_of(canary.row)
        if canary.guard is None:
            bench = benches.setdefault(theory.name, Workbench(theory, named=theory.quantified))
        else:
            function, text = canary.guard
            mutant = next(each for each in mutants_of(function) if f"{each.kind} {each.text}" == text)
            bench = Workbench(theory, named=theory.quantified, sources=mutant.sources)
        hypotheses = [each for each in scripts.hypotheses(canary.row, canary.column) if each != canary.without]
        part = bench.parts(name, canary.column, hypotheses)[canary.part]
        yield canary, part if canary.without or canary.guard else replace(part, goal=z3.BoolVal(False))
