"""Python is not logic: every lookup, attribute of an optional and assertion is an obligation of its own.

``m[k]`` is an error where ``k`` is missing; in logic it is some value.  So each such place is
proved to be reached only where the key is there: in the axioms and premises given these, in the
invariants and transitions given the invariants too.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import Any

import z3

from proofs.catalogue import AXIOMS, INITIAL, INVARIANTS, PREMISES, STEPS
from proofs.lift import Lifter
from proofs.transitions import event_types
from proofs.workbench import Part, Workbench

EVERY_LOOKUP_IS_DEFINED = "every_lookup_is_defined"
"""The column of the matrix for transitions."""
READING = "reading"
"""The row of the matrix for axioms, premises and invariants."""

READ: Mapping[str, Callable[..., bool]] = {**AXIOMS, **PREMISES, **INITIAL, **INVARIANTS}
"""Every predicate that is read, by name."""


def lookups(bench: Workbench, name: str) -> list[Any]:
    """Give the claims that make a transition or predicate run without an error, each once."""
    lifter = Lifter(bench.scope, bench.sources, collect=True)
    if name in STEPS:
        event = [bench.scope.constant(kind, f"event.{field}") for field, kind in event_types(STEPS[name]).items()]
        lifter.cases(STEPS[name], bench.site, bench.before, *event)
    elif name in AXIOMS:
        lifter.formula(AXIOMS[name], bench.site.fields["layout"], bench.site.fields["ground"])
    elif name in PREMISES:
        lifter.formula(PREMISES[name], bench.site)
    else:
        lifter.formula(READ[name], bench.site, bench.before)
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
    if name in STEPS or name in INVARIANTS:
        available |= bench.invariants
    chosen = available if hypotheses is None else {each: available[each] for each in hypotheses}
    claims = lookups(bench, name)
    return [Part({**bench.always(), **bench.split(chosen)}, [], claim) for claim in claims]
