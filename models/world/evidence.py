"""What a pair of reads is worth: a word that the world and the invariants share."""

from __future__ import annotations

from kernel.names import Read
from models.world.state import Site


def as_written(site: Site, left: Read, entered: Read) -> bool:
    """Both reads carry what is written in the tags that they name: no foreign, copied or corrupted record (T6)."""
    return site.records.record.get(left.tag) == left.record and site.records.record.get(entered.tag) == entered.record
