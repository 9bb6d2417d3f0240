"""What a layout must satisfy for the proof to speak of it.

Each axiom is a plain predicate: run on a station by ``heisoku check``, assumed of every layout
by ``heisoku prove``.  Neither the kernel nor the proof mentions any particular layout.
"""

from __future__ import annotations

from kernel.layout import Layout
from models.ground import Ground, covers_flank, turns_away


def a_route_claims_start_covers_and_overlap(layout: Layout, ground: Ground) -> bool:
    """``claims`` is start, covers and overlap, and no block is two of them (T4, T9)."""
    return all(
        layout.start[route] in layout.claims[route]
        and layout.start[route] not in layout.covers[route]
        and layout.start[route] not in layout.overlap[route]
        and all(block in layout.claims[route] and block not in layout.overlap[route] for block in layout.covers[route])
        and all(block in layout.claims[route] for block in layout.overlap[route])
        and all(
            block == layout.start[route] or block in layout.covers[route] or block in layout.overlap[route]
            for block in layout.claims[route]
        )
        for route in layout.routes
    )


def a_destination_is_covered(layout: Layout, ground: Ground) -> bool:
    """A route's destination is one of the blocks it covers (T4)."""
    return all(layout.destination[route] in layout.covers[route] for route in layout.routes)


def a_way_stays_in_its_route(layout: Layout, ground: Ground) -> bool:
    """The way leads from start and covered blocks into covered ones, beyond the destination into overlap (T4)."""
    return all(
        block in layout.claims[route]
        and layout.way[route][block] in layout.claims[route]
        and (
            layout.way[route][block] in layout.overlap[route]
            if block == layout.destination[route] or block in layout.overlap[route]
            else layout.way[route][block] in layout.covers[route]
        )
        for route in layout.routes
        for block in layout.way[route]
    )


def every_point_in_a_route_is_needed(layout: Layout, ground: Ground) -> bool:
    """Each point that stands in a covered or overlap block is needed, and released with that block (T9, T10)."""
    return all(
        point in layout.needs[route] and layout.released_with[route][point] == block
        for route in layout.routes
        for block in layout.claims[route]
        if block != layout.start[route]
        for point in layout.points_in.get(block, frozenset())
    )


def a_point_stands_in_one_block(layout: Layout, ground: Ground) -> bool:
    """``points_in`` and ``stands_in`` say the same (T10)."""
    return all(
        layout.stands_in[point] in layout.points_in and point in layout.points_in[layout.stands_in[point]]
        for point in layout.points
    ) and all(
        point in layout.points and layout.stands_in[point] == block
        for block in layout.points_in
        for point in layout.points_in[block]
    )


def a_point_is_released_with_a_claimed_block(layout: Layout, ground: Ground) -> bool:
    """A needed point goes with a block of the route; one in the start block goes with the start (T7, T10)."""
    return all(
        layout.released_with[route][point] in layout.claims[route]
        and (
            layout.stands_in[point] not in layout.claims[route]
            or layout.released_with[route][point] == layout.stands_in[point]
        )
        for route in layout.routes
        for point in layout.needs[route]
    )


def track_leads_along_the_way_or_is_turned(layout: Layout, ground: Ground) -> bool:
    """From a block with a way on, track leads along the way, or a held point turns the train from it (T9)."""
    return all(
        target == layout.way[route][block] or turns_away(layout, ground, route, block, target)
        for route in layout.routes
        for block in layout.way[route]
        for target in ground.leads[route][block]
    )


def a_flank_is_closed_or_held(layout: Layout, ground: Ground) -> bool:
    """Into a covered or overlap block no track leads from outside but past a held point, or under authority (T9)."""
    return all(
        block in layout.claims[route]
        or block not in ground.opens
        or target not in ground.opens[block]
        or target in ground.held_by_authority.get(block, frozenset())
        or covers_flank(layout, ground, route, block, target)
        for route in layout.routes
        for target in layout.claims[route]
        if target != layout.start[route]
        for block in ground.neighbours.get(target, frozenset())
    )


def neighbours_are_mutual(layout: Layout, ground: Ground) -> bool:
    """A block's neighbour has it for a neighbour, and what track leads to is a neighbour."""
    return all(
        block in ground.neighbours.get(other, frozenset())
        for block in ground.neighbours
        for other in ground.neighbours[block]
    ) and all(
        target in ground.neighbours.get(block, frozenset()) for block in ground.opens for target in ground.opens[block]
    )


def fouling_is_mutual(layout: Layout, ground: Ground) -> bool:
    """If one block fouls another, the other fouls it; none fouls itself (T9)."""
    return all(
        other != block and block in layout.fouls.get(other, frozenset())
        for block in layout.fouls
        for other in layout.fouls[block]
    )


def a_part_ends_on_its_route(layout: Layout, ground: Ground) -> bool:
    """Every claimed block is released with a block of its route (T7)."""
    return all(
        block in layout.released_after[route] and layout.released_after[route][block] in layout.claims[route]
        for route in layout.routes
        for block in layout.claims[route]
    )


def tags_of_a_boundary_are_partners(layout: Layout, ground: Ground) -> bool:
    """Two tags lie at each boundary, one each side, each the other's partner (T2)."""
    return all(
        layout.partner[tag] in layout.partner
        and layout.partner[layout.partner[tag]] == tag
        and layout.tag_in[layout.partner[tag]] != layout.tag_in[tag]
        for tag in layout.partner
    )


def every_map_has_its_keys(layout: Layout, ground: Ground) -> bool:
    """Every route, point and tag is described in full."""
    return (
        all(
            route in layout.start
            and route in layout.destination
            and route in layout.covers
            and route in layout.overlap
            and route in layout.claims
            and route in layout.way
            and route in layout.needs
            and route in layout.released_with
            and route in layout.released_after
            and route in ground.leads
            for route in layout.routes
        )
        and all(
            point in layout.points and point in layout.released_with[route]
            for route in layout.routes
            for point in layout.needs[route]
        )
        and all(block in layout.blocks for route in layout.routes for block in layout.claims[route])
        and all(block in ground.leads[route] for route in layout.routes for block in layout.way[route])
        and all(point in layout.stands_in for point in layout.points)
        and all(point in layout.points for point in layout.stands_in)
        and all(route in layout.routes for route in layout.needs)
        and all(route in layout.routes for route in layout.way)
        and all(tag in layout.tag_in for tag in layout.partner)
    )
