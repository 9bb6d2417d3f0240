"""Who waits for whom: the trains that stand in the way of a route, and those that never get out of it.

A train that waits may have several ways on, and waits for one of them.  Trains are in deadlock if each way of each of
them is barred by one of them, or by a train that will not move any more: the greatest set of which that is true.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Set
from dataclasses import dataclass

import networkx as nx

from kernel.centre import Centre
from kernel.layout import Layout
from kernel.names import Block, Route, Run, Train
from kernel.refusal import Refusal


@dataclass(frozen=True)
class Barred:
    """One way on that is barred: by what the kernel says, and by whom, and where they hold it up.

    ``by``: none where something is lost since a restart.
    """

    route: Route
    refusal: Refusal
    by: frozenset[Train]
    where: tuple[str, ...]


Waits = Mapping[Train, tuple[Barred, ...]]
"""For each train that waits every way on that it has."""


def barred(layout: Layout, centre: Centre, run: Run, refusal: Refusal) -> Barred:
    """Say who holds what a refused run needs."""
    found: dict[str, Set[Train]] = {}
    for block in sorted(layout.claims[run.route]):
        for near in (block, *sorted(layout.fouls.get(block, frozenset()))):
            found[near] = _others(centre, near, run.train)
    for point, wanted in sorted(layout.needs[run.route].items()):
        holders = centre.locked.get(point, {})
        found[point] = {other.train for other, lies in holders.items() if lies != wanted and other.train != run.train}
    held = {place: trains for place, trains in found.items() if trains}
    by = frozenset(train for trains in held.values() for train in trains)
    return Barred(run.route, refusal, by, tuple(held))


def _others(centre: Centre, block: Block, train: Train) -> Set[Train]:
    return {run.train for run in centre.claimed.get(block, frozenset()) if run.train != train}


def deadlocked(waits: Waits, gone: Set[Train]) -> frozenset[Train]:
    """The trains that wait for ever: each way barred by others that do, or by trains that are ``gone``."""
    stuck = frozenset(train for train, ways in waits.items() if ways and all(way.by for way in ways))
    while True:
        still = frozenset(train for train in stuck if all(way.by & (stuck | gone) for way in waits[train]))
        if still == stuck:
            return stuck
        stuck = still


def explained(waits: Waits, gone: Set[Train]) -> list[str]:
    """Say of each deadlock who waits for whom, and where; nothing if there is none."""
    stuck = deadlocked(waits, gone)
    graph: nx.DiGraph[Train] = nx.DiGraph()
    for train in sorted(stuck):
        for way in waits[train]:
            graph.add_edges_from((train, other) for other in sorted(way.by & stuck))
    told = [_circle(waits, ring) for ring in _rings(graph)]
    in_rings = {train for group in nx.strongly_connected_components(graph) if len(group) > 1 for train in group}
    behind = sorted(stuck - in_rings)
    if behind:
        barring = sorted({other for train in behind for way in waits[train] for other in way.by & (stuck | gone)})
        told.append(f"{', '.join(behind)}: behind {', '.join(barring)}, which do not move")
    return told


def _rings(graph: nx.DiGraph[Train]) -> Iterable[list[Train]]:
    """One circle of each group of trains that wait for each other, the shortest through its first train."""
    for group in sorted(sorted(each) for each in nx.strongly_connected_components(graph) if len(each) > 1):
        inner = graph.subgraph(group)
        rings = (nx.shortest_path(inner, after, group[0]) for after in sorted(inner.successors(group[0])))
        yield [group[0], *min(rings, key=lambda ring: (len(ring), ring))[:-1]]


def _circle(waits: Waits, ring: list[Train]) -> str:
    """The trains of a circle, each with the route that it wants, and where the next one stands in its way."""
    told = []
    for train, other in zip(ring, [*ring[1:], ring[0]], strict=True):
        way = next(way for way in waits[train] if other in way.by)
        told.append(f"{train} wants '{way.route}', held up by {other} at {', '.join(way.where[:2])}")
    return "trains facing each other: " + "; ".join(told)
