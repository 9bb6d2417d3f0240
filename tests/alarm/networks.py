"""Networks drawn, with the register that a surveyor would write of them; ways along the track by networkx (A1, A3).

Nothing of the models and proofs is used here.  A line of 12 km has joints; tracks leave it there, meet, loop, end, and
come back; figures of each run as its length does, one way or the other, mostly apart from all others'.  Some tracks are
on the register; where others leave these, an opening is written.  All ways are in mm.
"""

from __future__ import annotations

from itertools import combinations, pairwise
from operator import itemgetter
from random import Random
from typing import NamedTuple

import networkx as nx

from kernel.alarm.extents import End, Extent, Line
from kernel.alarm.least_ways import Equation, Join
from kernel.alarm.network import Connection, Opening, Way

KM = 1_000_000
LINE_MM = 12 * KM
FAR_MM = 8 * KM
"""Connections are written that far: farther than any way that matters."""


class Edge(NamedTuple):
    """A stretch of track between two nodes: its length, and the figure at its beginning, which grows or falls thence.

    ``is_line``: it is of the worker's line.  ``is_listed``: it is on the register.
    """

    one: int
    other: int
    mm: int
    from_mm: int
    grows: int
    is_line: bool
    is_listed: bool

    def figure_mm(self, at_mm: int) -> int:
        """Give the figure of a place."""
        return self.from_mm + self.grows * at_mm

    def end_mm(self, node: int) -> int:
        """Give the figure at an end."""
        return self.figure_mm(0 if node == self.one else self.mm)


class Spot(NamedTuple):
    """A place: so far from an edge's beginning, and which way is ahead there."""

    edge: int
    at_mm: int
    ahead: int


class Network:
    """Edges between numbered nodes, and how far it is from node to node."""

    def __init__(self, chance: Random, listed: float) -> None:
        """Draw a line and the tracks beyond; ``listed``: the share of tracks that are on the register."""
        joints_mm = sorted(chance.sample(range(10_000, LINE_MM, 10_000), chance.randrange(4)))
        ends_mm = [0, *joints_mm, LINE_MM]
        self.edges = [
            Edge(node, node + 1, to_mm - from_mm, from_mm, 1, True, True)
            for node, (from_mm, to_mm) in enumerate(pairwise(ends_mm))
        ]
        joints, beyond = range(1, len(ends_mm) - 1), range(len(ends_mm), len(ends_mm) + 4)
        self.are_apart = chance.random() < 0.7
        for one in (*joints, *beyond):
            for other in chance.sample([*joints, *beyond], 1 if one in joints else chance.randrange(3)):
                if one == other and one not in joints:
                    continue
                long_mm = chance.randrange(1_000, 6 * KM) if chance.random() < 0.7 else chance.randrange(1_000, 400_000)
                base_mm = (len(self.edges) + 1) * 50 * KM if self.are_apart else chance.randrange(-8 * KM, 20 * KM)
                grows, is_listed = chance.choice((1, -1)), chance.random() < listed
                self.edges.append(Edge(one, other, long_mm, base_mm, grows, False, is_listed))
        graph: nx.MultiGraph[int] = nx.MultiGraph()
        graph.add_nodes_from(range(len(ends_mm) + 4))
        for edge in self.edges:
            graph.add_edge(edge.one, edge.other, mm=edge.mm)
        self.between_mm = {
            node: {other: int(mm) for other, mm in far.items()}
            for node, far in nx.all_pairs_dijkstra_path_length(graph, weight="mm")
        }
        self.nodes = range(len(ends_mm) + 4)

    def at(self, node: int, *, is_listed: bool = True) -> list[Edge]:
        """Give the edges that end at a node."""
        return [edge for edge in self.edges if node in (edge.one, edge.other) and edge.is_listed == is_listed]

    def ends_mm(self, node: int) -> set[int]:
        """Give the figures that a node has on the register."""
        return {
            figure_mm
            for edge in self.at(node)
            for end, figure_mm in ((edge.one, edge.figure_mm(0)), (edge.other, edge.figure_mm(edge.mm)))
            if end == node
        }

    def apart_mm(self, one: Spot, other: Spot) -> int:
        """Give the least way along any tracks from one place to another."""
        here, there = self.edges[one.edge], self.edges[other.edge]
        ways_mm = [abs(one.at_mm - other.at_mm)] if one.edge == other.edge else []
        for node, out_mm in ((here.one, one.at_mm), (here.other, here.mm - one.at_mm)):
            for end, in_mm in ((there.one, other.at_mm), (there.other, there.mm - other.at_mm)):
                if end in self.between_mm[node]:
                    ways_mm.append(out_mm + self.between_mm[node][end] + in_mm)
        return min(ways_mm, default=9 * LINE_MM)

    def gone_on(self, chance: Random, spot: Spot, way_mm: int) -> Spot:
        """Give where one is who goes on so far without turning, over whatever joints; he ends where the track does."""
        while True:
            edge = self.edges[spot.edge]
            left_mm = edge.mm - spot.at_mm if spot.ahead > 0 else spot.at_mm
            if way_mm <= left_mm:
                return spot._replace(at_mm=spot.at_mm + spot.ahead * way_mm)
            way_mm -= left_mm
            node = edge.other if spot.ahead > 0 else edge.one
            onwards = [
                Spot(number, 0 if is_one else each.mm, 1 if is_one else -1)
                for number, each in enumerate(self.edges)
                for is_one, end in ((True, each.one), (False, each.other))
                if end == node and (number, is_one) != (spot.edge, spot.ahead < 0)
            ]
            if not onwards:
                return spot._replace(at_mm=edge.mm if spot.ahead > 0 else 0)
            spot = chance.choice(onwards)

    def spot(self, chance: Random, *, is_line: bool = False) -> Spot:
        """Draw a place, near a joint as often as not."""
        number = chance.choice([number for number, edge in enumerate(self.edges) if edge.is_line or not is_line])
        mm = self.edges[number].mm
        near_mm = min(mm, chance.randrange(1, 1_500_000))
        at_mm = chance.choice((chance.randrange(mm + 1), near_mm, mm - near_mm))
        return Spot(number, at_mm, chance.choice((1, -1)))


# ---- the register


def joins(network: Network) -> dict[Join, Equation]:
    """Write down the places that have two figures."""
    pairs = [
        (one_mm, other_mm)
        for node in network.nodes
        for one_mm in sorted(network.ends_mm(node))
        for other_mm in sorted(network.ends_mm(node))
        if one_mm < other_mm
    ]
    return {Join(f"{number}"): Equation(*pair) for number, pair in enumerate(pairs)}


def lines(network: Network) -> dict[Line, Extent]:
    """Write down the first and the last figure of each line on the register, and what is there."""
    found = {Line("line"): Extent(0, LINE_MM, End.BUFFER_STOP, End.BUFFER_STOP)}
    for number, edge in enumerate(network.edges):
        if edge.is_listed and not edge.is_line:
            ends = [(edge.end_mm(node), what_is_at(network, number, node)) for node in (edge.one, edge.other)]
            if edge.one == edge.other:
                ends = [(edge.figure_mm(0), End.JOIN), (edge.figure_mm(edge.mm), End.JOIN)]
            (from_mm, from_end), (to_mm, to_end) = sorted(ends, key=itemgetter(0))
            found[Line(f"{number}")] = Extent(from_mm, to_mm, from_end, to_end)
    return found


def what_is_at(network: Network, number: int, node: int) -> End:
    """Look what is at an end of a line: first for track that is on the register, then for other track."""
    beside = [each for other, each in enumerate(network.edges) if other != number and node in (each.one, each.other)]
    if any(each.is_listed for each in beside):
        return End.JOIN
    return End.OPENING if beside else End.BUFFER_STOP


def nearest_lines_mm(network: Network) -> int:
    """Give how far the figures of the two lines are from each other that are nearest; below 0 where they overlap."""
    extents = sorted((extent.from_mm, extent.to_mm) for extent in lines(network).values())
    return min(
        (max(here[0], there[0]) - min(here[1], there[1]) for here, there in combinations(extents, 2)), default=LINE_MM
    )


def ways(network: Network) -> dict[Way, Connection]:
    """Work out the connections over tracks that are on the register."""
    graph: nx.MultiGraph[int] = nx.MultiGraph()
    for edge in network.edges:
        if edge.is_listed:
            graph.add_edge(edge.one, edge.other, mm=edge.mm)
    far = dict(nx.all_pairs_dijkstra_path_length(graph, cutoff=FAR_MM, weight="mm"))
    written = sorted(
        {
            (from_mm, to_mm, int(mm))
            for node, reached in far.items()
            if len(network.at(node)) > 1
            for other, mm in reached.items()
            for to_mm in network.ends_mm(node)
            for from_mm in network.ends_mm(other) - {to_mm}
        }
    )
    return {Way(f"{number}"): Connection(*connection) for number, connection in enumerate(written)}


def openings(network: Network) -> dict[Opening, int]:
    """Write down where tracks that are not on the register leave those that are."""
    places_mm = sorted(
        {mm for node in network.nodes if network.at(node, is_listed=False) for mm in network.ends_mm(node)}
    )
    return {Opening(f"{number}"): place_mm for number, place_mm in enumerate(places_mm)}
