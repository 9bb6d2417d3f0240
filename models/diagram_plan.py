"""Where everything stands on a track diagram: x by topological distance, y by lanes.

Tracks that continue each other (over joints, and over points from the tip to their first leg) form a
*chain*, drawn as one straight line in one lane; what branches off runs in a lane of its own.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass

import networkx as nx

from kernel.names import Block
from models.layouts.track import HIGH, LOW, Joint, Segments

Node = tuple[str, str]
"""A place on the diagram: its kind (``mark``, ``junction``, ``end``) and name."""


@dataclass(frozen=True)
class Plan:
    """Places in grid units: columns from the left, lanes from the top.

    ``line``: for each segment its two nodes from left to right; ``lane``: the lane of each segment.  A
    segment that closes a ring runs back to the left, in a lane below all others.
    """

    segments: Segments
    at: Mapping[Node, tuple[float, int]]
    line: Mapping[int, tuple[Node, Node]]
    lane: Mapping[int, int]
    columns: float
    lanes: int


def plan(segments: Segments) -> Plan:
    """Place every node and segment of a station."""
    eastward = _orientation(segments)
    line = _lines(segments, eastward)
    column = _columns(line)
    lane_of_track = _lanes(segments, line, column)
    lane = {index: lane_of_track[segment.track] for index, segment in enumerate(segments.segments)}
    at = _places(segments, line, column, lane)
    for index in sorted(line):
        if column[line[index][1]] <= column[line[index][0]]:
            lane[index] = max(lane.values()) + 1
    return Plan(segments, at, line, lane, max(column.values(), default=0), max(lane.values(), default=0) + 1)


def node_at(segments: Segments, heading: tuple[int, int]) -> Node:
    """The place that a heading runs to."""
    end = segments.at[heading]
    if isinstance(end, Joint):
        return "junction", end.junction
    if end.mark is None:
        return "end", f"{segments.segments[heading[0]].track}/{heading[1]}"
    return "mark", end.mark


def _orientation(segments: Segments) -> dict[str, bool]:
    """For each track, whether it is drawn from left (its beginning) to right; neighbours agree."""
    joined: dict[str, list[tuple[str, bool]]] = {track: [] for track in segments.station.tracks}
    for junction in segments.station.junctions.values():
        for ways in junction.kind.positions.values():
            for first, second in ways:
                if first in junction.ports and second in junction.ports:
                    (one, side), (other, far) = junction.ports[first], junction.ports[second]
                    joined[one].append((other, side != far))
                    joined[other].append((one, side != far))
    eastward: dict[str, bool] = {}
    for start in joined:
        todo = [(start, True)]
        while todo:
            track, right = todo.pop()
            if track not in eastward:
                eastward[track] = right
                todo += [(other, right if same else not right) for other, same in joined[track]]
    return eastward


def _lines(segments: Segments, eastward: Mapping[str, bool]) -> dict[int, tuple[Node, Node]]:
    """Each segment's nodes from left to right."""
    line: dict[int, tuple[Node, Node]] = {}
    for index, segment in enumerate(segments.segments):
        low, high = node_at(segments, (index, LOW)), node_at(segments, (index, HIGH))
        line[index] = (low, high) if eastward[segment.track] else (high, low)
    return line


def _columns(line: Mapping[int, tuple[Node, Node]]) -> dict[Node, float]:
    """Columns by longest path from the left, then drawn towards the right where there is room."""
    graph = _without_rings(sorted(set(line.values())))
    order = list(nx.topological_sort(graph))
    earliest: dict[Node, int] = {}
    for node in order:
        earliest[node] = max((earliest[before] + 1 for before in graph.predecessors(node)), default=0)
    last = max(earliest.values(), default=0)
    latest: dict[Node, int] = {}
    for node in reversed(order):
        latest[node] = min((latest[behind] - 1 for behind in graph.successors(node)), default=last)
    placed: dict[Node, float] = {}
    for node in order:
        after = max((placed[before] + 1 for before in graph.predecessors(node)), default=0.0)
        middle = (earliest[node] + latest[node]) / 2 if graph.in_degree(node) else latest[node]
        placed[node] = min(max(after, middle), latest[node])
    return placed


def _without_rings(edges: list[tuple[Node, Node]]) -> nx.DiGraph[Node]:
    """The graph of these edges without those that close a ring, found by a search in depth."""
    behind: dict[Node, list[Node]] = {}
    for left, right in edges:
        behind.setdefault(left, []).append(right)
        behind.setdefault(right, [])
    graph: nx.DiGraph[Node] = nx.DiGraph()
    graph.add_nodes_from(behind)
    state: dict[Node, int] = {}
    begun = {right for _, right in edges}
    for start in sorted(behind, key=lambda node: (node in begun, node)):
        if start in state:
            continue
        state[start] = 1
        todo = [(start, iter(behind[start]))]
        while todo:
            node, others = todo[-1]
            other = next(others, None)
            if other is None:
                state[node] = 2
                todo.pop()
                continue
            if state.get(other) != 1:
                graph.add_edge(node, other)
            if other not in state:
                state[other] = 1
                todo.append((other, iter(behind[other])))
    return graph


def _chains(segments: Segments, folded: set[str]) -> list[list[str]]:
    """Tracks that continue each other, longest chain first; ``folded`` ones, which close a ring, stand alone."""
    graph: nx.Graph[str] = nx.Graph()
    graph.add_nodes_from(segments.station.tracks)
    for junction in segments.station.junctions.values():
        straight = junction.kind.positions[min(junction.kind.positions)]
        taken: set[str] = set()
        pairs = list(straight) + [way for ways in junction.kind.positions.values() for way in ways]
        for first, second in pairs:
            if not {first, second} & taken and {first, second} <= set(junction.ports):
                tracks = {junction.ports[first][0], junction.ports[second][0]}
                if not tracks & folded:
                    graph.add_edge(min(tracks), max(tracks))
                taken |= {first, second}
    found = [sorted(chain) for chain in nx.connected_components(graph)]
    return sorted(found, key=lambda chain: (-len(chain), chain))


def _lanes(segments: Segments, line: Mapping[int, tuple[Node, Node]], column: Mapping[Node, float]) -> dict[str, int]:
    """A lane for each track: near the chain it branches off, where no other chain is in the way."""
    extent: dict[str, tuple[float, float]] = {}
    for index, (left, right) in line.items():
        track = segments.segments[index].track
        low, high = extent.get(track, (column[left], column[right]))
        extent[track] = min(low, column[left]), max(high, column[right])
    back = {segments.segments[i].track for i, (left, right) in line.items() if column[right] <= column[left]}
    chains = _chains(segments, back)
    chain_of = {track: number for number, chain in enumerate(chains) for track in chain}
    spans = [(min(extent[t][0] for t in chain), max(extent[t][1] for t in chain)) for chain in chains]
    near: dict[int, set[int]] = {number: set() for number in range(len(chains))}
    for junction in segments.station.junctions.values():
        met = {chain_of[track] for track, _ in junction.ports.values()}
        for number in met:
            near[number] |= met - {number}
    lane: dict[int, int] = {}
    while len(lane) < len(chains):
        joined = [n for n in near if n not in lane and (near[n] & set(lane) or not lane)]
        ready = joined or sorted(set(near) - set(lane))
        number = max(ready, key=lambda n: (spans[n][1] - spans[n][0], -n))
        wish = [lane[other] for other in near[number] if other in lane]
        middle = round(sum(wish) / len(wish)) if wish else 0
        lane[number] = _free_lane(number, middle, lane, spans)
    lowest = min(lane.values(), default=0)
    return {track: lane[chain_of[track]] - lowest for track in chain_of}


def _free_lane(number: int, middle: int, lane: Mapping[int, int], spans: list[tuple[float, float]]) -> int:
    """The lane nearest to ``middle`` in which nothing stands at the same columns."""
    low, high = spans[number]
    for away in range(len(spans) + 1):
        for candidate in (middle + away, middle - away):
            others = (spans[n] for n, at in lane.items() if at == candidate)
            if all(high <= begin or end <= low for begin, end in others):
                return candidate
    return middle + len(spans) + 1


def _places(
    segments: Segments,
    line: Mapping[int, tuple[Node, Node]],
    column: Mapping[Node, float],
    lane: Mapping[int, int],
) -> dict[Node, tuple[float, int]]:
    """Each node's column and lane; a junction stands where most of its tracks run."""
    lanes: dict[Node, list[int]] = {}
    for index, ends in line.items():
        for node in ends:
            lanes.setdefault(node, []).append(lane[index])
    return {node: (column[node], max(sorted(set(found)), key=found.count)) for node, found in lanes.items()}


def spread(graph: nx.Graph[Block]) -> dict[Block, tuple[float, float]]:
    """Places between -1 and 1 for the nodes of a graph, near what they are joined to and apart from the rest."""
    nodes = sorted(graph.nodes)
    steps = dict(nx.all_pairs_shortest_path_length(graph))
    turn = 2 * math.pi / max(len(nodes), 1)
    order = [n for start in nodes[:1] for n in nx.dfs_preorder_nodes(graph, start)]
    order += [node for node in nodes if node not in set(order)]
    at = {node: (math.cos(turn * i), math.sin(turn * i)) for i, node in enumerate(order)}
    for turn_number in range(300):
        gain = 0.1 * (1 - turn_number / 300)
        for node in nodes:
            x, y = at[node]
            pull_x = pull_y = 0.0
            for other in nodes:
                if other != node:
                    apart = 0.45 * steps[node].get(other, 4)
                    away_x, away_y = at[other][0] - x, at[other][1] - y
                    distance = math.hypot(away_x, away_y) or 0.01
                    push = (distance - apart) / distance / apart**2
                    pull_x, pull_y = pull_x + push * away_x, pull_y + push * away_y
            at[node] = (x + gain * pull_x / 4, y + gain * pull_y / 4)
    low_x, high_x = min(x for x, _ in at.values()), max(x for x, _ in at.values())
    low_y, high_y = min(y for _, y in at.values()), max(y for _, y in at.values())
    wide, tall = high_x - low_x or 1, high_y - low_y or 1
    return {node: (2 * (x - low_x) / wide - 1, 2 * (y - low_y) / tall - 1) for node, (x, y) in at.items()}
