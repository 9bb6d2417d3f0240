"""In which order blocks stand in a diagram: along the line, so that a train that runs goes steadily up or down."""

from __future__ import annotations

from collections.abc import Collection, Mapping

import networkx as nx

from kernel.names import Block
from models.world.formations import directions
from models.world.state import Site

MOST_ROWS = 32
"""A layout with more blocks is shown with those alone that the trace has to do with."""


def rows(site: Site, touched: Collection[Block]) -> list[Block]:
    """The blocks to show, in order along the line: all of a small layout, else those that are ``touched``."""
    shown = set(site.layout.blocks) if len(site.layout.blocks) <= MOST_ROWS else set(touched)
    place = along(site)
    return sorted(shown | set(touched), key=lambda block: (place.get(block, (len(place), 0)), block))


def along(site: Site) -> Mapping[Block, tuple[int, int]]:
    """How far along the line each block is: the part of the layout it is in, and its rank in that part.

    Blocks follow each other as routes do that run in the common direction of the line; those side by
    side have one rank.  A block that only leads into others stands just before them, not at the line's end.
    """
    line = _line(site)
    ranks: dict[Block, tuple[int, int]] = {}
    parts = sorted(nx.weakly_connected_components(line), key=lambda part: (-len(part), min(part)))
    for number, part in enumerate(parts):
        ranks |= {block: (number, rank) for block, rank in _ranks(line.subgraph(part)).items()}
    return ranks


def _line(site: Site) -> nx.DiGraph[Block]:
    """A step from block to block for each that a route makes, all in the common direction."""
    layout, way = site.layout, directions(site.layout, site.ground)
    line: nx.DiGraph[Block] = nx.DiGraph()
    line.add_nodes_from(sorted(layout.blocks))
    for route in sorted(layout.routes):
        for block, target in sorted(layout.way[route].items()):
            line.add_edge(*((block, target) if way[route] else (target, block)))
    return line


def _ranks(line: nx.DiGraph[Block]) -> dict[Block, int]:
    """Ranks in one part; a ring is gone round once from the first of its blocks by name, and closes behind its last."""
    rings = nx.condensation(line)
    order = list(nx.topological_sort(rings))
    round_it = {ring: _round(line.subgraph(rings.nodes[ring]["members"])) for ring in order}
    rank = dict.fromkeys(order, 0)
    for ring in order:
        for follower in rings.successors(ring):
            rank[follower] = max(rank[follower], rank[ring] + len(round_it[ring]))
    for ring in reversed(order):
        least = min((rank[follower] for follower in rings.successors(ring)), default=None)
        rank[ring] = rank[ring] if least is None else least - len(round_it[ring])
    return {block: rank[ring] + place for ring in order for place, block in enumerate(round_it[ring])}


def _round(ring: nx.DiGraph[Block]) -> list[Block]:
    """The blocks of a ring in the order in which they follow each other; of a line each is one."""
    return list(nx.dfs_preorder_nodes(ring, min(ring), sort_neighbors=sorted))
