"""What is assumed of a site beside the layout axioms: where its tags lie; with the duty that makes it true."""

from __future__ import annotations

from models.world.state import Site


def tags_lie_as_planned(site: Site) -> bool:
    """A pair of tags lies where the plan has it: read in order it shows the exit from the block it is planned for.

    Centre and units have the same plan.  The maintainer lays and surveys the tags; the second loop checks
    distances on every run (T5).
    """
    return (
        all(
            tag in site.ground.laid_in and site.ground.laid_in[tag] == site.layout.tag_in[tag]
            for tag in site.layout.tag_in
        )
        and all(
            tag in site.ground.laid_leaves
            and site.layout.partner[tag] in site.ground.laid_leaves[tag]
            and site.layout.tag_in[tag] in site.ground.laid_leaves[tag][site.layout.partner[tag]]
            for tag in site.layout.partner
        )
        and (
            all(
                tag in site.layout.tag_in and site.layout.tag_in[tag] == site.plan.tag_in[tag]
                for tag in site.plan.tag_in
            )
            and all(tag in site.plan.tag_in for tag in site.layout.tag_in)
            and all(site.plan.partner.get(tag) == site.layout.partner[tag] for tag in site.layout.partner)
            and all(tag in site.layout.partner for tag in site.plan.partner)
        )
    )


def a_tag_list_says_what_its_layout_does(site: Site) -> bool:
    """What the centre sends for a route says of it what the centre's own layout does; of other lists nothing is said.

    The list is written from the layout, and read again when the layout is checked.
    """
    return all(
        route in site.layout.tag_list
        and site.lists.start.get(site.layout.tag_list[route]) == site.layout.start[route]
        and site.lists.covers.get(site.layout.tag_list[route]) == site.layout.covers[route]
        and site.lists.overlap.get(site.layout.tag_list[route]) == site.layout.overlap[route]
        and site.lists.claims.get(site.layout.tag_list[route]) == site.layout.claims[route]
        and site.lists.way.get(site.layout.tag_list[route]) == site.layout.way[route]
        and site.lists.needs.get(site.layout.tag_list[route]) == site.layout.needs[route]
        and site.lists.released_after.get(site.layout.tag_list[route]) == site.layout.released_after[route]
        and site.lists.first_tag.get(site.layout.tag_list[route]) == site.layout.first_tag.get(route)
        and site.lists.tag_after.get(site.layout.tag_list[route], {}) == site.layout.tag_after.get(route, {})
        for route in site.layout.routes
    )
