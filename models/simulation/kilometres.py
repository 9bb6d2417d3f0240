"""Where everything is along the line, in mm from its western end: what a time-distance diagram is drawn by.

Parallel tracks share their kilometrage, as far as their lengths agree: what was measured first stands.
"""

from __future__ import annotations

from collections import deque
from collections.abc import Mapping

from kernel.names import Block
from models.concrete.rails import Rails
from models.concrete.train import OnRails
from models.diagram_plan import Node, Plan, node_at, plan
from models.layouts.track import HIGH, LOW

Ends = tuple[int, int]
"""Of a segment: its low end and its high one."""


class Kilometres:
    """The kilometrage of every segment, by the places of the track diagram."""

    def __init__(self, rails: Rails) -> None:
        self.rails = rails
        self.plan: Plan = plan(rails.segments)
        at = self._measured()
        lowest = min(at.values(), default=0)
        self.ends: Mapping[int, Ends] = {
            index: (
                at[node_at(rails.segments, (index, LOW))] - lowest,
                at[node_at(rails.segments, (index, HIGH))] - lowest,
            )
            for index in range(len(rails.segments.segments))
        }

    def _measured(self) -> dict[Node, int]:
        """Each place, measured along the segments from one that is farthest to the west."""
        joined: dict[Node, list[tuple[Node, int]]] = {}
        for index, (left, right) in sorted(self.plan.line.items()):
            length_mm = self.rails.length_mm((index, LOW))
            if self.plan.at[left][0] < self.plan.at[right][0]:
                joined.setdefault(left, []).append((right, length_mm))
                joined.setdefault(right, []).append((left, -length_mm))
            else:
                joined.setdefault(left, [])
                joined.setdefault(right, [])
        at: dict[Node, int] = {}
        for start in sorted(joined, key=lambda node: (self.plan.at[node], node)):
            if start in at:
                continue
            at[start], todo = 0, deque([start])
            while todo:
                node = todo.popleft()
                for other, mm in joined[node]:
                    if other not in at:
                        at[other] = at[node] + mm
                        todo.append(other)
        return at

    def of(self, train: OnRails, front_mm: float) -> tuple[int, float, int]:
        """Where a train's front is: its segment, the share of it from its low end, and the kilometrage in mm."""
        piece = next((each for each in train.path if each.to_mm > front_mm), train.path[-1])
        index, towards = piece.heading
        share = (front_mm - piece.from_mm) / max(1, piece.to_mm - piece.from_mm)
        share = min(1.0, max(0.0, share if towards == HIGH else 1.0 - share))
        low, high = self.ends[index]
        return index, share, round(low + (high - low) * share)

    def of_place(self, index: int, at_mm: int) -> tuple[float, int]:
        """A place on a segment: its share of it from its low end, and the kilometrage in mm."""
        low, high = self.ends[index]
        share = at_mm / max(1, self.rails.length_mm((index, LOW)))
        return share, round(low + (high - low) * share)

    def of_block(self, block: Block) -> int:
        """The middle of a block."""
        ends = [mm for index, each in self.ends.items() if self.rails.block[index] == block for mm in each]
        return (min(ends) + max(ends)) // 2
