"""What a pair of reads is worth: a word that the world and the invariants share."""

from __future__ import annotations

from kernel.names import Read, Tag, Train
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
