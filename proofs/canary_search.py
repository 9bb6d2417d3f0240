"""Find canaries: ``python -m proofs.canary_search``; for each theory a guard of its own kernel whose drop is noticed.

What stands in the file and still serves is kept.  Otherwise the first is taken that is proved as it is, and with the
drop is answered ``sat`` by both solvers; functions of the fewest theories come first, and guards before anything else.
"""

from __future__ import annotations

import json
import sys
from collections.abc import Iterator
from unittest.mock import patch

from models.exit_codes import HOLDS, UNDECIDED
from proofs import canaries, run, scripts, solvers
from proofs.canaries import FILE, Canary, answered
from proofs.lift import Mismatch, OutsideSubset
from proofs.mutants.edits import Mutant
from proofs.mutants.targets import mutants, theories_of
from proofs.theories import THEORIES, row_of
from proofs.theory import Theory
from proofs.workbench import Part, Workbench

SOLVERS = ("z3", "cvc5")
QUICK = {"z3": 200_000, "cvc5": 100_000}
"""What a canary may cost: they are asked in every process."""
KINDS = ("guard", "and-operand", "or-operand", "condition", "filter", "choice", "part", "limit", "update")
"""What is dropped, the best first."""
SHARED = "kernel.onboard.arithmetic"
"""No theory's own."""
HEAD = """# For each theory a guard of its own kernel, or of its world where it has no machine, whose drop every
# solver must notice (proofs/canaries.py).
# Found by `python -m proofs.canary_search`.
"""


def still_serves(canary: Canary) -> bool:
    """Tell whether a canary is noticed by both solvers, and only because of its drop."""
    try:
        broken, whole = canaries.question(canary), run.parts(canary.row, canary.column)[canary.part]
    except canaries.STALE:
        return False
    return serves(broken, whole)


def serves(broken: Part, whole: Part) -> bool:
    """Tell whether both solvers say ``sat`` to the one question and ``unsat`` to the other."""
    return all(answered(solver, broken) == "sat" for solver in SOLVERS) and all(
        solvers.ask(solver, whole, 0).answer == "unsat" for solver in SOLVERS
    )


def candidates(theory: Theory) -> list[Mutant]:
    """Give what may be dropped in the kernel of a theory, the best first."""
    own = [
        each
        for each in mutants().values()
        if each.function.__module__.startswith("kernel.")
        and each.function.__module__ != SHARED
        and each.kind in KINDS
        and theory in theories_of(each.function)
    ]
    return sorted(own, key=lambda each: (len(theories_of(each.function)), KINDS.index(each.kind)))


def found(theory: Theory) -> Canary | None:
    """Give the first canary of a theory that serves."""
    for mutant in candidates(theory):
        for canary, broken in questions(theory, mutant):
            whole = run.parts(canary.row, canary.column)
            if len(whole) > canary.part and serves(broken, whole[canary.part]):
                return canary
    return None


def questions(theory: Theory, mutant: Mutant) -> Iterator[tuple[Canary, Part]]:
    """Give the obligations of a theory with a drop, each part by itself; claims that ask the kernel have it too."""
    broken = Workbench(theory, named=theory.quantified, sources=mutant.sources)
    for step in theory.steps:
        row = row_of(theory, step)
        for column in theory.invariants:
            try:
                parts = broken.parts(step, column, scripts.hypotheses(row, column))
            except (OutsideSubset, Mismatch, AttributeError, TypeError):
                return
            for number, part in enumerate(parts):
                if solvers.ask("z3", part, 0).answer == "sat":
                    yield Canary(row, column, number, dropped=mutant.name), part


def written(chosen: list[Canary]) -> str:
    """Give the file's text."""
    entries = [
        f'[[canary]]\nrow = "{each.row}"\ncolumn = "{each.column}"\npart = {each.part}\n'
        f"dropped = {json.dumps(each.dropped)}\n"
        for each in chosen
    ]
    return "\n".join([HEAD, *entries])


def main() -> int:
    """Find a canary for each theory and write the file; 3 if one has none."""
    kept = [each for each in canaries.guards() if still_serves(each)]
    chosen, missing = list[Canary](), list[str]()
    with patch.dict(solvers.BUDGET, QUICK):
        for theory in THEORIES.values():
            known = [each for each in kept if each.theory == theory.name]
            one = known or [each for each in [found(theory)] if each is not None]
            chosen += one
            missing += [theory.name] * (not one)
            print(f"{theory.name}: {', '.join(each.name for each in one) or 'none'}", file=sys.stderr, flush=True)
    FILE.write_text(written(chosen), "utf-8")
    print(f"{len(chosen)} canaries, {len(kept)} of them kept; none for {', '.join(missing) or 'no theory'}")
    return UNDECIDED if missing else HOLDS


if __name__ == "__main__":
    raise SystemExit(main())
