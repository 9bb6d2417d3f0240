"""What a pair of reads is worth: a word that the world and the invariants share."""

from __future__ import annotations

from kernel.names import Read, Tag, Train
from kernel.unit import Unit
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


def awaited_by_others(system: System, train: Train) -> frozenset[tuple[Train, Tag]]:
    """What heads have passed unread, less what this train's has: its unit awaits none of that any more."""
    return frozenset((other, tag) for other, tag in system.track.unread if other != train)


def awaited_but(system: System, train: Train, tag: Tag) -> frozenset[tuple[Train, Tag]]:
    """What heads have passed unread, less a tag that this train's reads after all, having rolled back over it."""
    return frozenset((other, missed) for other, missed in system.track.unread if other != train or missed != tag)


def awaited_in(system: System, train: Train, unit: Unit) -> frozenset[tuple[Train, Tag]]:
    """What heads have passed unread and units await yet, with a unit in its next state: no other life awaits it."""
    if unit.life == system.units[train].life:
        return system.track.unread
    return awaited_by_others(system, train)
