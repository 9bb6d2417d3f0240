"""What a pair of reads is worth: a word that the world and the invariants share."""

from __future__ import annotations

from kernel.names import Block, Car, Read, Run, Tag, Train
from models.world.state import Site, System


def as_written(site: Site, left: Read, entered: Read) -> bool:
    """Both reads carry what is written in the tags that they name: no foreign, copied or corrupted record (T6)."""
    return site.records.record.get(left.tag) == left.record and site.records.record.get(entered.tag) == entered.record


def unpassed(site: Site, system: System, train: Train, tag: Tag) -> frozenset[tuple[Train, Tag]]:
    """What the last antennas have passed, less the boundary at ``tag``, which this train's head passes anew."""
    return frozenset(
        (other, passed)
        for other, passed in system.track.passed
        if other != train or (passed != tag and site.layout.partner.get(passed) != tag)
    )


def the_head_went_on(site: Site, system: System, run: Run, block: Block) -> bool:
    """The head, led as now, has been in what follows ``block`` on the way of this run or of a later one."""
    return any(
        other.train == run.train
        and other.serial >= run.serial
        and other in site.formation.front
        and system.track.facing.get(run.train) == site.formation.front[other]
        and other.route in site.layout.way
        and site.layout.way[other.route].get(block) == beyond
        for other, beyond in system.track.entered
    )


def came_round(site: Site, system: System, car: Car, block: Block) -> bool:
    """The car came into ``block`` under a run of a route under which, or a later one, the head has not gone on."""
    if car not in system.track.under or block not in system.track.under[car]:
        return False
    run = system.track.under[car][block]
    return run.route in site.layout.routes and not the_head_went_on(site, system, run, block)
