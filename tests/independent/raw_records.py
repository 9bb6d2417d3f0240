"""What has to be written in the tags, reckoned again over the plain graph: kind of block, number, distance (T1)."""

from __future__ import annotations

from collections.abc import Iterable, Iterator

from models.layouts import Imported
from tests.independent import raw_table
from tests.independent.files import Enumerated, network_of
from tests.independent.raw_graph import Network


def differing_records(imported: Imported, found: Enumerated) -> Iterator[str]:
    """Every tag whose record is not as reckoned, and blocks of one number where one could be taken for the other."""
    network, layout = network_of(found), imported.layout
    numbers: dict[str, set[str]] = {}
    for tag, record in sorted(imported.records.record.items()):
        block = str(layout.tag_in[tag])
        kind, number, mm = record.split(":")
        numbers.setdefault(block, set()).add(number)
        if network is not None and block not in network.blocks:
            yield f"{tag}: lies in no block of the walk"
            continue
        standing = _points_in(found, block)
        if (kind == "turnout") != bool(standing):
            yield f"{tag}: is told to be {kind}, with points {sorted(standing)}"
        ours = 0 if network is None else _onward_mm(network, block, imported.places.tags[tag])
        if ours is not None and abs(ours - int(mm)) > (ours > 0):
            yield f"{tag}: {mm} mm to the next tag, and not {ours}"
    together: list[set[str]] = [set(route.claims) for route in found.routes.values()]
    together += [] if network is None else [{block, *near} for block, near in network.neighbours.items()]
    for group in together:
        yield from _taken_for_another(group, numbers)


def _points_in(found: Enumerated, block: str) -> set[str]:
    if isinstance(found, raw_table.Enumerated):
        return {point for point, standing in found.stands_in.items() if standing == block}
    return set(found.network.points_in.get(block, ()))


def _onward_mm(network: Network, block: str, mark: Iterable[str]) -> int | None:
    """The way from a boundary to the only other one of a block, to the mm; none: it bounds the block twice.

    0: there is none, or several, or several ways lead to one end.
    """
    mouths = [place for name, place in network.mouths(block) if name in set(mark)]
    if len(mouths) != 1:
        return None
    ways = [way for way in network.ways(block) if way.mouth == mouths[0]]
    on = [way for way in ways if way.into is not None]
    return network.way_mm(on[0]) if len(on) == 1 and len({way.out for way in ways}) == len(ways) else 0


def _taken_for_another(group: Iterable[str], numbers: dict[str, set[str]]) -> Iterator[str]:
    whose: dict[str, str] = {}
    for block in sorted(group):
        for number in sorted(numbers.get(block, ())):
            other = whose.setdefault(number, block)
            if other != block:
                yield f"{other} and {block} have number {number}"
