"""Every theory beside the interlocking as a Hypothesis state machine; :mod:`fuzz.machines.beside` says what it does."""

from __future__ import annotations

from collections import Counter
from functools import cache
from random import Random
from typing import Any, ClassVar

from hypothesis import strategies as st
from hypothesis.stateful import RuleBasedStateMachine, initialize, rule, run_state_machine_as_test

from fuzz.machines.beside import STEPS, Beside, BrokenClaim, shortened
from fuzz.machines.settled import repeatable
from fuzz.planted.draw import planted
from proofs.mutated import Sources

SEEDS = st.integers(0, 2**32)
"""Of what is changed: a number that Hypothesis draws, so that each change is one draw and not dozens."""


class OfTheory(RuleBasedStateMachine):
    """A machine of one theory.

    ``theory``: its name.  ``sources``: a planted fault that runs.  ``counted``: over all runs of this class,
    the rules executed (``rules``) and the steps that changed something (``changed``).
    """

    theory: ClassVar[str]
    sources: ClassVar[Sources] = {}
    counted: ClassVar[Counter[str]] = Counter()

    def __init_subclass__(cls, **named: Any) -> None:
        """Each class counts for itself."""
        super().__init_subclass__(**named)
        cls.counted = Counter()

    def __init__(self) -> None:
        super().__init__()
        self.run = Beside(self.theory, self.sources, 0)

    @initialize(first=st.integers(0, 2**16), jolts=st.lists(SEEDS, max_size=3))
    def starts(self, first: int, jolts: list[int]) -> None:
        """Where some witness was, or near."""
        self.run = Beside(self.theory, self.sources, first)
        for seed in jolts:
            self.run.jolt(Random(seed))

    @rule(seed=SEEDS)
    def goes_on(self, seed: int) -> None:
        """As the witness did, or nearly."""
        self.counted["rules"] += 1
        self.run.goes_on(Random(seed))

    @rule(which=st.integers(0, 2**16), seed=SEEDS)
    def is_told(self, which: int, seed: int) -> None:
        """What some witness was told, or nearly."""
        self.counted["rules"] += 1
        self.run.is_told(which, Random(seed))

    def teardown(self) -> None:
        """Count what was done."""
        self.counted["changed"] += self.run.changed


@cache
def machine_of(theory: str) -> type[OfTheory]:
    """The state machine of a theory, by the theory's name."""
    return type(f"Of_{theory}", (OfTheory,), {"theory": theory})


def with_fault(machine: type[OfTheory], fault: str) -> type[OfTheory]:
    """The same machine with a planted fault running, by the mutant's name; ``KeyError`` if there is none."""
    return type(f"{machine.__name__}_with_a_fault", (machine,), {"sources": planted(fault)})


def hunted(machine: type[OfTheory], examples: int = 200, steps: int = STEPS) -> BrokenClaim | None:
    """Run a machine; give what breaks a claim, shrunk, or none if nothing does."""
    try:
        run_state_machine_as_test(machine, settings=repeatable(examples, steps))
    except BrokenClaim as broken:
        return shortened(broken)
    return None
