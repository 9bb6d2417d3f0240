"""The invariants of the proofs, asked of a simulated line while it runs."""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Iterator, Mapping
from dataclasses import fields, is_dataclass
from functools import cache
from operator import attrgetter, is_
from typing import Any, get_type_hints

from fuzz.failures.replaying import holds
from models.simulation.beginning import Plan
from models.simulation.history import History
from models.simulation.kilometres import Kilometres
from models.simulation.outcome import Outcome, outcome
from models.simulation.simulation import Simulation
from models.world.state import System
from proofs.catalogue import INVARIANTS, SAFETY
from proofs.lift.sources import definition_of
from proofs.lints_apart import paths_in
from proofs.reach import called_by

EVERY_S = 10
"""So often all of them are asked; in between, in every second that changes something, the claims of the safety case."""
CLAIMS = tuple(name for name in INVARIANTS if name in SAFETY)
PARTS = frozenset(part.name for part in fields(System))


class Judge:
    """Looks on, second by second; ``asked`` counts how often each invariant was; ``every_s``: so often all are.

    What an invariant says follows from the parts of the state that it reads: while each of them is the same as when
    it held, its answer stands and is not worked out again.
    """

    def __init__(self, every_s: int = EVERY_S) -> None:
        self.every_s = every_s
        self.asked: Counter[str] = Counter(dict.fromkeys(INVARIANTS, 0))
        self._read: dict[str, tuple[object, ...]] = {}

    def look(self, now: Simulation) -> None:
        """Ask what is to be asked now; the simulation ends where something is false."""
        system = now.play.system
        for name in INVARIANTS if now.now_s % self.every_s == 0 else CLAIMS:
            self.asked[name] += 1
            read, before = parts_of(name)(system), self._read.get(name)
            if before is not None and all(map(is_, before, read)):
                continue
            self._read[name] = read
            if not holds(name, now.play.site, system):
                now.oracles.violated(name, "the invariant is false of the simulated state")


def judged(plan: Plan, look: Callable[[Simulation], object] = lambda now: None) -> Outcome:
    """Run a simulation to its end with a judge beside it; ``look`` is told of each second.

    Raises:
        BadInput: so many trains have no room.
    """
    sim, judge = Simulation(plan), Judge()
    history = History(Kilometres(sim.rails))

    def each_second(now: Simulation) -> None:
        history.look(now)
        judge.look(now)
        look(now)

    sim.run(each_second)
    return outcome(sim, history, judge.asked)


@cache
def reads() -> Mapping[str, tuple[tuple[str, ...], ...]]:
    """For each invariant the parts of a state that it reads, itself and by the functions that it calls."""
    found = {}
    for name, invariant in INVARIANTS.items():
        trees = [definition_of(each) for each in (invariant, *called_by(invariant))]
        paths = {path for tree in trees for path in paths_in(tree, PARTS)}
        found[name] = tuple(sorted({tuple(path.split(".")[1:3]) for path in paths}))
    return found


@cache
def parts_of(name: str) -> Callable[[System], tuple[object, ...]]:
    """What gives the parts of a state that an invariant reads, as far as what lies on their paths is of fields."""
    paths = sorted({".".join(_of_fields(path)) for path in reads()[name]})
    if len(paths) > 1:
        return attrgetter(*paths)
    return lambda system: tuple(attrgetter(path)(system) for path in paths)


def _of_fields(path: tuple[str, ...]) -> Iterator[str]:
    """Give what of a path is of fields."""
    part: Any = System
    for name in path:
        hints = get_type_hints(part) if is_dataclass(part) else {}
        if name not in hints:
            return
        yield name
        part = hints[name]
