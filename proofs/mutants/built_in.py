"""What is assumed in how the interlocking's world is built, left out: no predicate refuses a step there.

Each of ``built_in.toml`` says of one step what happens without the assumption, and which text of a step, or of what is
said of the start, is another then.
"""

from __future__ import annotations

import tomllib
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import cache
from pathlib import Path

import z3

from models.world.state import Site, System
from proofs.catalogue import INITIAL, INTERLOCKING
from proofs.counterexample import Unfaithful, unmet
from proofs.finite import World
from proofs.lift import Lifter, concretise
from proofs.mutated import Sources, running
from proofs.planted.changes import planted
from proofs.theory import START

FILE = Path(__file__).with_name("built_in.toml")


@dataclass(frozen=True)
class Drop:
    """An assumption left out of one step, or of the start; ``without``: what happens then.

    ``old`` stands once in ``file``, and ``new`` takes its place.
    """

    name: str
    step: str
    without: str
    file: str
    old: str
    new: str

    @property
    def module(self) -> str:
        """The module that is another."""
        return self.file.removesuffix(".py").replace("/", ".")

    @property
    def sources(self) -> Sources:
        """The functions that are otherwise."""
        return planted(self).sources


@cache
def drops() -> Mapping[str, Sequence[Drop]]:
    """Every assumption that is built in, and how it is left out."""
    entries = tomllib.loads(FILE.read_text(encoding="utf-8"))
    return {name: [Drop(f"{name}, {each['step']}", **each) for each in drops] for name, drops in entries.items()}


def fallen_at_the_start(world: World, sources: Sources, milliseconds: int) -> tuple[str, str]:
    """Look for a start, said with other words, in which an invariant is false: the verdict, and what is false.

    Raises:
        Unfaithful: CPython sees it otherwise.
    """
    solver = z3.Then("simplify", "smt").solver()
    solver.set("timeout", milliseconds)
    said = Lifter(world.scope, sources)
    starts = [said.formula(each, world.site, world.before) for each in INITIAL.values()]
    solver.add(*world.assumed.values(), *(named.formula for named in world.scope.axioms()), *starts)
    solver.add(z3.Not(z3.And(*world.invariants.values())))
    answer = solver.check()
    if answer != z3.sat:
        return ("none" if answer == z3.unsat else "unknown"), ""
    model = solver.model()
    site = concretise(model, world.scope, world.site, Site)
    before = concretise(model, world.scope, world.before, System)
    with running(sources):
        starting = all(each(site, before) for each in INITIAL.values())
    false = unmet(site, before)
    if not starting or not false or not set(false) <= set(INTERLOCKING.invariants):
        raise Unfaithful(f"{START}: CPython sees the start otherwise")
    return "found", ", ".join(false)
