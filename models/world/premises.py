"""What is assumed of a site beside the layout axioms: its trains' order, and where its tags lie.

Each is a named premise of the proof, with the duty that makes it true.
"""

from __future__ import annotations

from models.world.state import Site


def the_last_car_is_behind_all_others(site: Site) -> bool:
    """In every run the last car is one of the train, and all its others are ahead of it: cars keep their order."""
    return all(
        car == site.formation.last[run]
        or site.formation.train_of[car] != run.train
        or (
            site.formation.last[run] in site.formation.ahead[run]
            and car in site.formation.ahead[run][site.formation.last[run]]
        )
        for run in site.formation.last
        if run in site.formation.ahead
        for car in site.formation.train_of
    ) and all(site.formation.train_of.get(site.formation.last[run]) == run.train for run in site.formation.last)


def a_cab_is_on_one_car(site: Site) -> bool:
    """No two cars of a train carry the same cab: the unit tells its antennas apart by their wiring (T2)."""
    return all(
        car == other
        or site.formation.cab[car] != site.formation.cab[other]
        or site.formation.train_of.get(car) != site.formation.train_of.get(other)
        for car in site.formation.cab
        for other in site.formation.cab
    )


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
