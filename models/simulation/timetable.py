"""The trips of a timetable, and by which routes a train may get to a goal."""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping
from dataclasses import dataclass

import networkx as nx

from kernel.layout import Layout
from kernel.names import Block, Route
from models.concrete.rails import Rails

SLACK = 1.8
"""A trip is timed at so much more than what it takes alone."""
USUAL_MM_S = 20_000
STARTS_S, STAYS_S = (20, 300), (60, 240)


@dataclass(frozen=True)
class Trip:
    """To ``goal``, not before ``begins_s``."""

    goal: Block
    begins_s: int


class Ways:
    """Which routes lead on from a block towards a goal, and how far that is."""

    def __init__(self, layout: Layout, rails: Rails) -> None:
        self.layout = layout
        lengths: dict[Block, int] = {}
        for index, block in enumerate(rails.block):
            lengths[block] = lengths.get(block, 0) + rails.length_mm((index, 0))
        self.length_mm: Mapping[Route, int] = {
            route: sum(lengths[block] for block in layout.covers[route]) for route in layout.routes
        }
        self.graph: nx.DiGraph[Block] = nx.DiGraph()
        self.from_block: dict[Block, list[Route]] = {}
        for route in sorted(layout.routes):
            start, end = layout.start[route], layout.destination[route]
            self.from_block.setdefault(start, []).append(route)
            known = self.graph.get_edge_data(start, end, {"mm": self.length_mm[route]})["mm"]
            self.graph.add_edge(start, end, mm=min(known, self.length_mm[route]))
        self.places = sorted(block for block in set(layout.start.values()) if not layout.points_in[block])
        self._left_mm: dict[Block, Mapping[Block, float]] = {}

    def left_mm(self, block: Block, goal: Block) -> int | None:
        """How far it is from a block to a goal; none if no routes lead there."""
        if goal not in self._left_mm:
            reverse = self.graph.reverse(copy=False)
            self._left_mm[goal] = nx.single_source_dijkstra_path_length(reverse, goal, weight="mm")
        found = self._left_mm[goal].get(block)
        return None if found is None else round(found)

    def towards(self, block: Block, goal: Block) -> list[Route]:
        """The routes from a block that lead nearer to a goal, the shortest way first."""
        here_mm = self.left_mm(block, goal)
        return self.shortest_first(self.from_block.get(block, ()), goal, math.inf if here_mm is None else here_mm)

    def shortest_first(self, routes: Iterable[Route], goal: Block, here_mm: float = math.inf) -> list[Route]:
        """Of some routes those that lead to within less than ``here_mm`` of a goal, the shortest way first."""
        found = []
        for route in routes:
            left_mm = self.left_mm(self.layout.destination[route], goal)
            if left_mm is not None and left_mm < here_mm:
                found.append((left_mm + self.length_mm[route], route))
        return [route for _, route in sorted(found)]
