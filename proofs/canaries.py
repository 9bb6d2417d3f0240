"""Questions whose answer is known, put to each solver in each process before any answer of it is believed.

A solver that says *unsat* to everything would prove everything.  So each is first asked what is not
so: obligations with a needed hypothesis left out, with nothing left to follow but a contradiction, and
in every theory with a guard of its own kernel, or world, dropped.  It must find the state in which they fail: only
``sat`` is that; *unknown* notices nothing.  They go the way of every obligation, from the same source by way of the
same lifter.
"""

from __future__ import annotations

import tomllib
from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import cache
from pathlib import Path

import z3

from models.processes import number
from proofs import scripts, smtlib
from proofs.lift import Mismatch, OutsideSubset
from proofs.mutants.edits import named
from proofs.records import CanarySeen
from proofs.solvers import BUDGET, Answer, ask, commanded, version
from proofs.theories import THEORIES, theory_of
from proofs.workbench import Part, Workbench

FILE = Path(__file__).with_name("canaries.toml")
"""For each theory a guard of its kernel; written by ``python -m proofs.canary_search``."""

STALE = (KeyError, IndexError, OutsideSubset, Mismatch)
"""What is raised where the kernel has changed and a canary no longer fits it: it was not noticed then."""

ANOTHER = "python -m proofs.canary_search finds another"

NOTHING = "a contradiction"
"""Asked for in place of the claim."""


@dataclass(frozen=True)
class Canary:
    """An obligation that does not hold.

    ``without``: a hypothesis that its proof needs, left out.  ``dropped``: the name of a mutant, which takes the place
    of its function.  With neither, a contradiction is to follow, which it does from nothing that can be.
    ``part``: which of the obligation's parts fails, counted from 0.
    """

    row: str
    column: str
    part: int = 0
    without: str = ""
    dropped: str = ""

    @property
    def name(self) -> str:
        """What is asked, in words."""
        if self.dropped:
            return f"{self.row} × {self.column}, with {self.dropped}"
        return f"{self.row} × {self.column} without {self.without}" if self.without else f"{self.row} × {NOTHING}"

    @property
    def theory(self) -> str:
        """The theory it is an obligation of."""
        return theory_of(self.row)[0].name


ELEMENTARY = (
    Canary("braking.run_a_cycle", "head_stays_inside_authority", without="the_brake_slows"),
    Canary("split.run_a_cycle", "split_is_latched", without="split_is_latched"),
    Canary("speed_limit.run_on", "a_train_too_fast_for_any_of_its_track_brakes"),
    Canary("restart_terminal", "no_point_moves_under_a_train", without="no_point_moves_under_a_train"),
    Canary("take_over", "entry_only_after_first_loop"),
)
"""What every process asks, whatever it is to prove: a hypothesis left out, and contradictions."""


def guards(file: Path = FILE) -> tuple[Canary, ...]:
    """Give the canaries that drop a guard, one of each theory at least."""
    return tuple(Canary(**each) for each in tomllib.loads(file.read_text("utf-8")).get("canary", ()))


CANARIES = (*ELEMENTARY, *guards())
"""What each solver is asked."""


def seen(asked: Sequence[str], theory: str | None = None) -> list[CanarySeen]:
    """Put canaries to these solvers in this process: all, or those that proofs in one theory are believed by.

    A theory without a guard of its own to drop has a canary that nobody noticed.
    """
    having = {each.theory for each in CANARIES if each.dropped}
    lacking = [name for name in THEORIES if theory in (None, name) and name not in having]
    none = [
        _told(solver, f"{name}: a guard of its kernel", f"nothing ({ANOTHER})") for solver in asked for name in lacking
    ]
    return none + [_seen(solver, canary, BUDGET[solver]) for solver in asked for canary in of(theory)]


def of(theory: str | None) -> list[Canary]:
    """Give the canaries that an answer in a theory rests on; all of them if none is named."""
    return [each for each in CANARIES if theory is None or each in ELEMENTARY or each.theory == theory]


@cache
def _seen(solver: str, canary: Canary, budget: int) -> CanarySeen:
    """Put one canary to one solver; asked once a process and budget."""
    assert budget == BUDGET[solver]
    try:
        return _told(solver, canary.name, answered(solver, question(canary)))
    except STALE as error:
        return _told(solver, canary.name, f"nothing ({type(error).__name__}: {ANOTHER})")


def _told(solver: str, canary: str, answer: str) -> CanarySeen:
    """Tell what a solver answered; only ``sat`` is noticed."""
    return {
        "canary": canary,
        "solver": solver,
        "solver_version": version(solver),
        "process": number(),
        "answer": answer,
        "noticed": answer == "sat",
    }


def answered(solver: str, part: Part) -> Answer:
    """Ask as for a proof; cvc5 at a loss is asked again for a finite model, which it does not look for by itself."""
    answer = ask(solver, part, 0).answer
    if answer == "unknown" and solver == "cvc5":
        _, says = commanded(smtlib.script(part), BUDGET["cvc5"], 0, {"finite-model-find": "true"})
        said = [each for each in says if each][-1]
        return "sat" if said == "sat" else "unsat" if said == "unsat" else "unknown"
    return answer


@cache
def question(canary: Canary) -> Part:
    """Lay out the question of a canary, lifted apart from everything that is to be proved."""
    theory, name = theory_of(canary.row)
    hypotheses = [each for each in scripts.hypotheses(canary.row, canary.column) if each != canary.without]
    part = _bench(theory.name, canary.dropped).parts(name, canary.column, hypotheses)[canary.part]
    return part if canary.without or canary.dropped else replace(part, goal=z3.BoolVal(False))


@cache
def _bench(theory: str, dropped: str) -> Workbench:
    """Lift a theory, perhaps with a drop in it."""
    sources = named(dropped).sources if dropped else None
    return Workbench(THEORIES[theory], named=THEORIES[theory].quantified, sources=sources)


@cache
def laid_out() -> tuple[tuple[Canary, Part], ...]:
    """Give every canary with its question."""
    return tuple((canary, question(canary)) for canary in CANARIES)
