"""What a pair of reads is worth: a word that the world and the invariants share."""

from __future__ import annotations

from kernel.names import Block, Read
from models.world.state import Site


def genuine(site: Site, block: Block, left: Read, entered: Read) -> bool:
    """Both reads carry what is written in the pair of tags at the end of ``block`` (T6)."""
    return (
        site.layout.tag_in.get(left.tag) == block
        and site.layout.partner.get(left.tag) == entered.tag
        and site.records.record.get(left.tag) == left.record
        and site.records.record.get(entered.tag) == entered.record
    )
