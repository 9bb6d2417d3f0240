"""What is assumed of a site beside the layout axioms: where its tags lie; with the duty that makes it true."""

from __future__ import annotations

from models.world.state import Site


def tags_lie_as_planned(site: Site) -> bool:
    """A pair of tags lies where the plan has it: read in order it shows the exit from the block it is planned for.

    The maintainer lays and surveys the tags; the second loop checks distances on every run (T5).
    """
    return all(
        tag in site.ground.laid_in and site.ground.laid_in[tag] == site.layout.tag_in[tag] for tag in site.layout.tag_in
    ) and all(
        tag in site.ground.laid_leaves
        and site.layout.partner[tag] in site.ground.laid_leaves[tag]
        and site.layout.tag_in[tag] in site.ground.laid_leaves[tag][site.layout.partner[tag]]
        for tag in site.layout.partner
    )
