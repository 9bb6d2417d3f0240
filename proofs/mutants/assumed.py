"""Each assumption below the theorem dropped: some claim of its theory must fall, or it is none of the theorem's.

What refuses a step is put as always true, in the worlds of a composed theory's parts as well; what is said of a site
is left out; what is built into the interlocking's world is left out of each step that it is built into
(:mod:`proofs.mutants.built_in`), and some claim must fall for each.  A counterexample must show the fall, one that
CPython confirms.
"""

from __future__ import annotations

import ast
import copy
import random
import time
from collections.abc import Callable, Iterable, Iterator
from dataclasses import dataclass, replace
from functools import cache
from typing import Any

import z3

from models.world import assumptions as nature
from proofs import assumptions, scripts, solvers, usage
from proofs.catalogue import AXIOMS, INTERLOCKING, PREMISES
from proofs.chain import Chain, chain
from proofs.counterexample import Unfaithful
from proofs.counterexample import search as search_in_a_world
from proofs.finite import World
from proofs.lift import Lifter
from proofs.lift.sources import definition_of
from proofs.lints_on_board import asking
from proofs.lints_on_board import assumptions as asked_on_board
from proofs.mutants.built_in import Drop, drops, fallen_at_the_start
from proofs.mutants.steps import ERRORS, Lifted, Lifting, identifiers, lifted, search, shaken, sites
from proofs.mutants.trial import MILLISECONDS, NOT_LIFTED, world
from proofs.mutated import Sources
from proofs.reach import called_by
from proofs.run import laid_out
from proofs.theories import THEORIES, columns, row_of
from proofs.theory import EVERY_LOOKUP_IS_DEFINED, START, Theory
from proofs.workbench import Workbench

SHAKES = 3_000
"""So many sites near the witnesses' are made to find one of which nothing but the premise is false."""
SHAKEN_SITES = 4
"""So many of those are tried before any site at all."""


@dataclass
class Outcome:
    """What became of an assumption: ``falls``, ``none`` or ``open``; over which row, and what is false after it.

    Of what is built into several steps: over which of them, and what is false after each; or the first of which nothing
    was seen to fall.
    """

    became: str = "open"
    by: str = ""
    finding: str = ""
    seconds: float = 0.0


@cache
def whole() -> Chain:
    """Give the chain, followed once a process."""
    return chain()


def names() -> list[str]:
    """Give every assumption that a proof of the chain rests on, as ``theory.name``, in its order.

    After them those of which it is said that none does.
    """
    resting = [link.assumption for links in whole().links.values() for link in links if link.rested_on]
    return [*resting, *beside_the_theorem()]


@cache
def beside_the_theorem() -> list[str]:
    """Give the assumptions of which it is said that no claim of the theorem rests on them."""
    return [f"{INTERLOCKING.name}.{name}" for name in sorted(assumptions.beside())]


@cache
def in_the_chain(theory: str) -> frozenset[str]:
    """Give the invariants of a theory that the theorem rests on."""
    return usage.needed(usage.book(THEORIES[theory]), frozenset(whole().asked[theory]))


def tried(name: str) -> Outcome:
    """Drop one assumption."""
    began = time.perf_counter()
    theory_name, _, assumption = name.partition(".")
    theory = THEORIES[theory_name]
    if name in beside_the_theorem():
        found = Outcome("none" if proved_without(assumption) else "open", ", ".join(assumptions.asking(assumption)))
    elif theory is INTERLOCKING and assumption in drops():
        found = _all_of([fallen(theory, of_built_in(drop)) for drop in drops()[assumption]])
    else:
        found = fallen(theory, of_interlocking(assumption) if theory is INTERLOCKING else beside(theory, assumption))
    found.seconds = round(time.perf_counter() - began, 2)
    return found


def fallen(theory: Theory, tries: Iterable[Try]) -> Outcome:
    """Say what falls of a theory at the first of these tries at which something of the chain does."""
    verdicts, rows = list[str](), list[str]()
    for row, verdict, false in tries:
        broken = false.split(", ") if false else []
        of_the_chain = [each for each in broken if each in in_the_chain(theory.name) or each not in theory.invariants]
        if of_the_chain:
            return Outcome("falls", row, ", ".join(of_the_chain))
        verdicts.append("beside the chain" if broken else verdict)
        rows.append(row)
    return Outcome("none" if verdicts and set(verdicts) == {"none"} else "open", ", ".join(dict.fromkeys(rows)))


def _all_of(found: list[Outcome]) -> Outcome:
    """What is built into several steps is needed if it is needed in each."""
    for became in ("open", "none"):
        if lacking := [each for each in found if each.became == became]:
            return lacking[0]
    return Outcome("falls", ", ".join(each.by for each in found), "; ".join(each.finding for each in found))


UNCHANGED: Sources = {}
"""No function is otherwise."""
Try = tuple[str, str, str]
"""A row, what the search says, and what is false after the step that it found."""


def true_instead(*functions: Callable[..., Any]) -> Sources:
    """Put *true* in the place of predicates."""
    return {each: _true(definition_of(each)) for each in functions}


def _true(tree: ast.FunctionDef) -> ast.FunctionDef:
    other = copy.copy(tree)
    other.body = [ast.Return(ast.Constant(True))]
    return ast.fix_missing_locations(other)


# ---- beside the interlocking


def beside(theory: Theory, name: str) -> Iterator[Try]:
    """Drop an assumption of a theory beside the interlocking, over every row that may notice."""
    if name in theory.premises:
        without = replace(theory, premises={other: each for other, each in theory.premises.items() if other != name})
        rows = dict.fromkeys(row for row, _ in assumptions.proofs_naming(name, theory))
        for row in (row for row in rows if row != row_of(theory, START)):
            for lift in _on_sites_without(theory, without, name):
                yield from _searched(row, {}, lift)
        return
    function = asked_on_board(theory)[name]
    of_parts = {each for part in theory.parts for each in asked_on_board(THEORIES[part]).values()}
    sources = true_instead(function, *(each for each in called_by(function) if each in of_parts))
    for step in asking(theory, name):
        yield from _searched(row_of(theory, step), sources, lifted)


def _searched(row: str, sources: Sources, lift: Lifting) -> Iterator[Try]:
    try:
        found, verdict = search(row, sources, MILLISECONDS["integers"], lift)
    except (Unfaithful, *ERRORS, *NOT_LIFTED) as error:
        yield row, f"error: {error}", ""
        return
    yield row, verdict, found.finding if found is not None else ""


def _on_sites_without(theory: Theory, without: Theory, name: str) -> Iterator[Lifting]:
    """Lift a theory without a premise: on sites where nothing else is false, then on any."""
    for site in [] if identifiers(theory.site) else _sites_against(theory, name):
        on = Lifted(without, site)
        yield lambda _theory, _place, on=on: on  # type: ignore[misc]
    on = _lifted_without(theory.name, name)
    yield lambda _theory, _place: on


@cache
def _lifted_without(theory: str, name: str) -> Lifted:
    whole = THEORIES[theory]
    return Lifted(replace(whole, premises={other: each for other, each in whole.premises.items() if other != name}))


def _sites_against(theory: Theory, name: str) -> list[Any]:
    """Give sites near the witnesses' of which this premise alone is false."""
    rng, found = random.Random(name), list[Any]()
    for _ in range(SHAKES if sites(theory.name) else 0):
        site = shaken(rng, rng.choice(sites(theory.name)))
        try:
            false = [other for other, premise in theory.premises.items() if not premise(site)]
        except ERRORS:
            continue
        if false == [name]:
            found.append(site)
            if len(found) == SHAKEN_SITES:
                break
    return found


# ---- the interlocking


def of_interlocking(name: str) -> Iterator[Try]:
    """Drop an assumption of the interlocking, in a small world and a larger one."""
    if name in {**AXIOMS, **PREMISES}:
        rows = list(dict.fromkeys(row for row, _ in assumptions.proofs_naming(name)))
        sources, without = UNCHANGED, frozenset({name})
    elif hasattr(nature, name):
        sources, without = true_instead(getattr(nature, name)), frozenset[str]()
        rows = assumptions.asking(name)
    else:
        return
    for size in ("small", "larger"):
        for row in (row for row in rows if row in INTERLOCKING.steps):
            yield _in_a_world(_without(size, without), row, sources, MILLISECONDS[size])


def proved_without(name: str) -> bool:
    """Tell whether every claim of the chain is proved, by each solver, over every step that asks an assumption."""
    sources = true_instead(getattr(nature, name))
    on = Workbench(INTERLOCKING, named=INTERLOCKING.quantified, sources=sources)
    cells = [
        (row, column)
        for row in assumptions.asking(name)
        for column in columns(row)
        if column in in_the_chain(INTERLOCKING.name) or column == EVERY_LOOKUP_IS_DEFINED
    ]
    return all(
        solvers.ask(solver, part, 0).answer == "unsat"
        for row, column in cells
        for part in laid_out(row, column, scripts.hypotheses(row, column), on)
        for solver in ("z3", "cvc5")
    )


def of_built_in(drop: Drop) -> Iterator[Try]:
    """Leave out of one step what is built into it, in a small world and a larger one."""
    for size in ("small", "larger"):
        yield _in_a_world(world(size), drop.step, drop.sources, MILLISECONDS[size])


def _in_a_world(on: World, row: str, sources: Sources, milliseconds: int) -> Try:
    try:
        if row == START:
            return row, *fallen_at_the_start(on, sources, milliseconds)
        answer = search_in_a_world(on, row, sources, milliseconds)
    except (Unfaithful, *ERRORS, *NOT_LIFTED) as error:
        return row, f"error: {error}", ""
    return row, answer.verdict, answer.found.finding if answer.found is not None else ""


@cache
def _without(size: str, names: frozenset[str]) -> World:
    """Give a world of which some axioms and premises are not taken for granted, but what else is said can be read."""
    whole = world(size)
    if not names:
        return whole
    other = copy.copy(whole)
    other.without = names
    assumed = {name: each for name, each in whole.assumed.items() if name not in names}
    other.__dict__["assumed"] = assumed | {"what_is_said_can_be_read": _readable(whole, names)}
    return other


def _readable(on: World, names: frozenset[str]) -> Any:
    """Say that every axiom, premise and invariant but these looks up nothing that is not there.

    CPython has to read them, and an axiom that is left out may be what says that they can be read.
    """
    reader = Lifter(on.scope, collect=True)
    layout, ground = on.site.fields["layout"], on.site.fields["ground"]
    for name, axiom in AXIOMS.items():
        if name not in names:
            reader.formula(axiom, layout, ground)
    for name, premise in PREMISES.items():
        if name not in names:
            reader.formula(premise, on.site)
    for claim in INTERLOCKING.invariants.values():
        reader.formula(claim, on.site, on.before)
    return z3.And(*(each.claim for each in reader.obligations))
