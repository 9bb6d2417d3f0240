"""Makes a failing simulated line short: fewer faults, fewer trains that go anywhere, the same still false.

A fault of single telegrams, tags or orders that is left out gets no chance and is drawn all the same, so that the
others stay as they were until it would have come.  Faults that come at some time are left out, ever fewer at
once, and come sooner.  The budget is in simulated seconds, so that the same line gives the same result.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

from fuzz.simulation.lines import Came, Line, simulated
from models.layouts.results import Imported
from models.simulation.faults import BY_NAME

BUDGET_S = 36_000
"""Simulated seconds that a search may take."""

SHARES = (0.1, 0.25, 0.5, 0.75)
"""Of the time at which a fault comes: so much sooner it is tried."""


@dataclass(frozen=True)
class Shrunk:
    """What is left: the line, and what it came to.  ``runs``: how many were needed."""

    came: Came
    runs: int


def shrink(came: Came, imported: Imported, budget_s: int = BUDGET_S) -> Shrunk:
    """Make a line that failed short; what was false first stays so."""
    search = Search(came, imported, budget_s)
    search.fewer_kinds()
    search.fewer_occurrences()
    search.sooner()
    search.fewer_trains()
    search.sooner()
    search.fewer_occurrences()
    return Shrunk(search.came, search.runs)


class Search:
    """A search; ``came``: what the shortest line so far came to."""

    def __init__(self, came: Came, imported: Imported, budget_s: int) -> None:
        assert came.violated, "nothing is false"
        end_ms = came.sim.now_s * 1_000
        coming = tuple(each for each in came.drawn if each.at_ms <= end_ms)
        self.imported = imported
        self.left_s = budget_s
        self.runs = 0
        self.came = replace(came, line=replace(came.line, occurrences=coming))

    def _try(self, line: Line) -> bool:
        """Take a line for the shortest so far if the same is false first, and no later."""
        if self.left_s <= 0:
            return False
        latest_s = self.came.sim.now_s
        found = simulated(line, self.imported)
        self.runs += 1
        self.left_s -= max(1, found.sim.now_s)
        if found.violated[:1] != self.came.violated[:1] or found.sim.now_s > latest_s:
            return False
        self.came = found
        return True

    def fewer_kinds(self) -> None:
        """Leave out every fault of a kind: all kinds at once, then one after the other."""
        kinds = list(self.came.line.faults)
        if not self._without(*kinds):
            for kind in kinds:
                self._without(kind)

    def _without(self, *kinds: str) -> bool:
        line = self.came.line
        faults = {
            name: replace(each, rate=0.0) if name in kinds else each
            for name, each in line.faults.items()
            if name not in kinds or BY_NAME[name].is_share
        }
        coming = tuple(each for each in line.occurrences or () if each.fault not in kinds)
        return self._try(replace(line, faults=faults, occurrences=coming))

    def fewer_occurrences(self) -> None:
        """Leave out faults that come at some time: halves of them, then quarters, down to single ones."""
        size = max(1, len(self.came.line.occurrences or ()) // 2)
        while self.left_s > 0:
            dropped, at = False, len(self.came.line.occurrences or ())
            while at > 0:
                coming = self.came.line.occurrences or ()
                first = max(0, at - size)
                dropped |= self._try(replace(self.came.line, occurrences=coming[:first] + coming[at:]))
                at = first
            if size == 1 and not dropped:
                return
            size = max(1, size // 2)

    def sooner(self) -> None:
        """Let a fault that comes at some time come sooner."""
        for at in range(len(self.came.line.occurrences or ())):
            for share in SHARES:
                coming = self.came.line.occurrences or ()
                here = replace(coming[at], at_ms=int(coming[at].at_ms * share) // 1_000 * 1_000)
                moved = sorted((*coming[:at], here, *coming[at + 1 :]), key=lambda each: each.at_ms)
                if self._try(replace(self.came.line, occurrences=tuple(moved))):
                    break

    def fewer_trains(self) -> None:
        """Let trains stay where they are: all those that can at once, then one after the other."""
        goes = [train for train in self.came.sim.services if train not in self.came.line.still]
        named = [train for train in goes if train not in self.came.sim.oracles.found[0].text]
        if named and self._try(replace(self.came.line, still=(*self.came.line.still, *named))):
            goes = [train for train in goes if train not in named]
        for train in goes:
            self._try(replace(self.came.line, still=(*self.came.line.still, train)))
