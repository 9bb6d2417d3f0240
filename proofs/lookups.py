"""Python is not logic: every lookup, attribute of an optional and assertion is an obligation of its own.

``m[k]`` is an error where ``k`` is missing; in logic it is some value.  So each such place is
proved to be reached only where the key is there: in the axioms and premises given these, in the
invariants and transitions given the invariants too.
"""

from __future__ import annotations

from typing import Any

import z3

from proofs.lift import Lifter
from proofs.transitions import event_types
from proofs.workbench import Part, Workbench


def lookups(bench: Workbench, name: str) -> list[Any]:
    """Give the claims that make a transition or predicate run without an error, each once."""
    lifter, theory = Lifter(bench.scope, bench.sources, collect=True), bench.theory
    if name in theory.steps:
        lifter.cases(theory.steps[name], bench.site, bench.before, *bench.event(name).values())
    elif name in theory.axioms:
        lifter.formula(theory.axioms[name], *bench.told)
    elif name in theory.premises:
        lifter.formula(theory.premises[name], bench.site)
    elif name in theory.promises:
        for predicate in theory.promises[name].predicates:
            about = [bench.scope.constant(kind, f"about.{field}") for field, kind in event_types(predicate).items()]
            lifter.formula(predicate, bench.site, bench.before, *about)
        for rank in theory.promises[name].ranks:
            about = [bench.scope.constant(kind, f"about.{field}") for field, kind in event_types(rank).items()]
            lifter.call(rank, bench.site, bench.before, *about)
    else:
        lifter.formula(theory.read[name], bench.site, bench.before)
    claims = {claim.get_id(): claim for claim in (closed(obligation.claim) for obligation in lifter.obligations)}
    return list(claims.values())


def closed(claim: Any) -> Any:
    """Say of a claim with arbitrary constants that it holds for all of them."""
    arbitrary: dict[int, Any] = {}
    todo, seen = [claim], set()
    while todo:
        term = todo.pop()
        if term.get_id() not in seen:
            seen.add(term.get_id())
            todo.extend([term.body()] if z3.is_quantifier(term) else term.children())
            if z3.is_const(term) and term.decl().kind() == z3.Z3_OP_UNINTERPRETED and "!" in term.decl().name():
                arbitrary[term.get_id()] = term
    return z3.ForAll(list(arbitrary.values()), claim) if arbitrary else claim


def parts(bench: Workbench, name: str, hypotheses: list[str] | None) -> list[Part]:
    """Lay out the well-definedness of one transition or predicate.

    A predicate of the start is read after those before it, an axiom or premise with all of them.
    """
    available = dict(bench.assumed)
    if name in bench.theory.steps or name in bench.theory.invariants or name in bench.theory.promises:
        available |= bench.invariants
    chosen = available if hypotheses is None else {each: available[each] for each in hypotheses}
    return bench.asked(chosen, [([], claim) for claim in lookups(bench, name)])
