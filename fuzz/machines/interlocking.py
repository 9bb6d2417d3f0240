"""The interlocking's world as a Hypothesis state machine: every invariant after every step that changes something.

A subclass says where it plays::

    class AtTheTerminus(Interlocking):
        places = (place_on(Path("layouts/terminus.toml")),)

Each rule takes one step of the world, by one of the moves of :mod:`fuzz.machines.moves`.
"""

from __future__ import annotations

from collections import Counter
from pathlib import Path
from typing import Any, ClassVar

from hypothesis import strategies as st
from hypothesis.stateful import RuleBasedStateMachine, initialize, rule, run_state_machine_as_test

from fuzz.failures.shrinking import shrink
from fuzz.failures.trace import Trace, layout_of
from fuzz.machines.moves import EVERY, FOCUS, WEIGHTS, Moves
from fuzz.machines.settled import repeatable
from fuzz.machines.strange import Pick
from fuzz.machines.watched import Broken, Place
from fuzz.planted.draw import planted
from proofs.mutated import Sources

STEPS = 60
"""So many rules in one run of a machine."""
BY_NAME = {move.__name__: move for move in WEIGHTS}
USUAL, *UNUSUAL = BY_NAME
WEIGHTED = tuple(name for name, move in BY_NAME.items() for _ in range(-(-WEIGHTS[move] // 5)))
"""Every move, as often as it weighs; the usual one first, since that is what a drawn one shrinks to."""


class Interlocking(RuleBasedStateMachine):
    """The interlocking at one of some places.

    ``places``: where it may be.  ``sources``: a planted fault that runs.  ``counted``: over all runs of this class, the
    rules executed (``rules``), the steps that changed something (``changed``), and these by their names.
    """

    places: ClassVar[tuple[Place, ...]]
    sources: ClassVar[Sources] = {}
    counted: ClassVar[Counter[str]] = Counter()

    def __init_subclass__(cls, **named: Any) -> None:
        """Each class counts for itself."""
        super().__init_subclass__(**named)
        cls.counted = Counter()

    def __init__(self) -> None:
        super().__init__()
        self.moves = Moves(self.places[0], self.sources)
        self.without: frozenset[str] = frozenset()

    @initialize(
        at=st.integers(0, 99),
        in_service=st.booleans(),
        without=st.frozensets(st.sampled_from(UNUSUAL)),
        focus=st.lists(st.sampled_from(EVERY), unique=True, max_size=FOCUS[1]),
    )
    def starts(self, at: int, in_service: bool, without: frozenset[str], focus: list[str]) -> None:
        """Everything has just started, or is in service; some kinds of trouble are left out, some steps come often."""
        self.without = without
        self.moves = Moves(self.places[at % len(self.places)], self.sources, focus)
        if in_service:
            self.moves.start_service()

    @rule(move=st.sampled_from(WEIGHTED), data=st.data())
    def takes(self, move: str, data: st.DataObject) -> None:
        """One step of the world."""
        self.counted["rules"] += 1
        BY_NAME[USUAL if move in self.without else move](self.moves, _drawing(data))

    def teardown(self) -> None:
        """Count what was done."""
        accepted = self.moves.play.accepted
        self.counted.update(accepted)
        self.counted["changed"] += accepted.total()


def _drawing(data: st.DataObject) -> Pick:
    def pick(many: int) -> int:
        return data.draw(st.integers(0, many - 1)) if many > 1 else 0

    return pick


def with_fault(machine: type[Interlocking], fault: str) -> type[Interlocking]:
    """The same machine with a planted fault running, by the mutant's name; ``KeyError`` if there is none."""
    return type(f"{machine.__name__}WithAFault", (machine,), {"sources": planted(fault)})


def hunted(machine: type[Interlocking], examples: int = 200, steps: int = STEPS) -> Trace | None:
    """Run a machine; give the shrunk trace of what breaks a claim, or none if nothing does."""
    try:
        run_state_machine_as_test(machine, settings=repeatable(examples, steps))
    except Broken as broken:
        # Hypothesis leaves out rules; of the steps that put everything into service it can leave out none.
        return shrink(broken.trace, layout_of(broken.trace, Path())).trace
    return None
