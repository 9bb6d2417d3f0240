"""Which routes conflict, and by what: a block, a fouling block, or a point wanted otherwise (T9)."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from functools import cached_property

from kernel.layout import Layout
from kernel.names import Block, Point, Route


@dataclass(frozen=True)
class Why:
    """What two routes conflict by; all that is said of either holds of both."""

    blocks: tuple[Block, ...]
    fouling: tuple[tuple[Block, Block], ...]
    points: tuple[Point, ...]

    @cached_property
    def signs(self) -> str:
        """``B`` for a block, ``F`` for fouling, ``P`` for a point."""
        return "B" * bool(self.blocks) + "F" * bool(self.fouling) + "P" * bool(self.points)

    @property
    def words(self) -> str:
        """The same in words."""
        said = [f"block {block}" for block in self.blocks]
        said += [f"block {one} fouls {other}" for one, other in self.fouling]
        return "; ".join([*said, *(f"point {point}" for point in self.points)])


class Conflicts:
    """The conflicts of a layout: as the centre would refuse one route while another train holds the other."""

    def __init__(self, layout: Layout) -> None:
        self.layout = layout
        self._over: Mapping[Block, list[Route]] = defaultdict(list)
        self._at: Mapping[Point, list[Route]] = defaultdict(list)
        for route in sorted(layout.routes):
            for block in layout.claims[route]:
                self._over[block].append(route)
            for point in layout.needs[route]:
                self._at[point].append(route)

    def of(self, route: Route) -> list[Route]:
        """The routes that conflict with one, by name."""
        layout, needs = self.layout, self.layout.needs[route]
        claimed = layout.claims[route]
        blocks = claimed.union(*(layout.fouls.get(block, frozenset()) for block in claimed))
        found = {other for block in blocks for other in self._over[block]}
        found |= {other for point in needs for other in self._at[point] if layout.needs[other][point] != needs[point]}
        return sorted(found - {route})

    def why(self, route: Route, other: Route) -> Why:
        """What two routes conflict by."""
        layout = self.layout
        ours, theirs = layout.claims[route], layout.claims[other]
        fouling = ((block, beside) for block in ours for beside in layout.fouls.get(block, frozenset()) & theirs)
        points = (p for p, at in layout.needs[route].items() if layout.needs[other].get(p, at) != at)
        return Why(tuple(sorted(ours & theirs)), tuple(sorted(fouling)), tuple(sorted(points)))

    def pairs(self) -> Iterator[tuple[Route, Route]]:
        """Every pair once, by name."""
        for route in sorted(self.layout.routes):
            yield from ((route, other) for other in self.of(route) if route < other)
