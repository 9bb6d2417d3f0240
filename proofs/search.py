"""Finds proof scripts: ``python -m proofs.search [PATTERN]``.

Every hypothesis there is goes in, the unsat core comes out and is thinned until no name can be
dropped.  What it writes is checked by the prover like any script written by hand.
"""

from __future__ import annotations

import re
import sys

import z3

from models.processes import spread
from proofs import scripts
from proofs.products import GROWS, IS_NOT_NEGATIVE, weaker
from proofs.run import bench, laid_out
from proofs.theories import ROWS, columns, theory_of
from proofs.workbench import Part

WIDE, NARROW = 20_000_000, 4_000_000
"""Budgets in rlimit: with every hypothesis, and with few."""


def core(part: Part, names: list[str] | None, rlimit: int, seed: int = 0) -> list[str] | None:
    """Give the hypotheses of an unsat core among ``names``, or None if neither the part nor a weaker one is refuted."""
    found = _core(part, names, rlimit, seed)
    if found is not None or (less := weaker(part)) is None:
        return found
    found = _core(less, None if names is None else [*names, GROWS, IS_NOT_NEGATIVE], rlimit, seed)
    return None if found is None else [name for name in found if name not in (GROWS, IS_NOT_NEGATIVE)]


def _core(part: Part, names: list[str] | None, rlimit: int, seed: int) -> list[str] | None:
    solver = z3.Solver()
    marks: list[z3.BoolRef] = []
    solver.set("rlimit", rlimit)
    solver.set("random_seed", seed)
    for name, formulas in part.hypotheses.items():
        if names is None or name in names:
            mark = z3.Bool(f"use.{name}")
            solver.add(*(z3.Implies(mark, formula) for formula in formulas))
            marks.append(mark)
    solver.add(*part.given)
    solver.add(z3.Not(part.goal))
    if solver.check(*marks) != z3.unsat:
        return None
    return [mark.decl().name()[len("use.") :] for mark in solver.unsat_core()]


def thin(part: Part, names: list[str]) -> list[str]:
    """Drop names one by one while the part is still refuted within the narrow budget."""
    for name in list(names):
        if name in names:
            rest = [other for other in names if other != name]
            smaller = core(part, rest, NARROW // 4)
            if smaller is not None:
                names = [other for other in rest if other in smaller]
    return names


def find(transition: str, invariant: str) -> list[str] | None:
    """Find the hypotheses of one obligation, sorted; None if a part of it stays open."""
    found: set[str] = set()
    orders = set(bench(theory_of(transition)[0].name).always())
    for part in laid_out(transition, invariant, None):
        names = core(part, sorted(orders), NARROW // 4)
        if names is None:
            names = core(part, sorted({*orders, invariant}), NARROW // 4)
        if names is None:
            old = scripts.known(transition).get(invariant)
            names = core(part, [*old, *orders], NARROW) if old is not None else None
        for seed in range(4):
            if names is None:
                names = core(part, None, WIDE, seed)
        if names is None:
            return None
        found |= set(thin(part, names)) - orders
    return sorted(found)


def find_row(task: tuple[str, list[str]]) -> tuple[str, dict[str, list[str] | None]]:
    """Find a part of one transition's script."""
    transition, invariants = task
    return transition, {invariant: find(transition, invariant) for invariant in invariants}


def main(pattern: str = "") -> int:
    """Search every obligation that matches and write the scripts."""
    tasks = [(row, [name for name in columns(row) if re.search(pattern, f"{row} {name}")]) for row in ROWS]
    missing = 0
    for transition, found in spread(find_row, [task for task in tasks if task[1]], 2):
        known = {
            invariant: names
            for invariant, names in scripts.known(transition).items()
            if invariant in columns(transition)
        }
        for invariant, names in found.items():
            if names is None:
                missing += 1
                print(f"open: {transition} {invariant}", flush=True)
            else:
                known[invariant] = names
        scripts.write(transition, known)
        print(f"{transition}: {len(found)} searched", flush=True)
    return 1 if missing else 0


if __name__ == "__main__":
    raise SystemExit(main(*sys.argv[1:]))
