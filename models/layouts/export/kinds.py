"""The same junction in the words of another format: which leg is which port, and which position which."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass
from itertools import permutations

from models.layouts.track import Kind


@dataclass(frozen=True)
class Fit:
    """A kind of another format that joins the same ends.

    ``name``: that kind.  ``port``, ``position``: its word for each of ours.
    """

    name: str
    port: Mapping[str, str]
    position: Mapping[str, str]


def fit(kind: Kind, kinds: Mapping[str, Kind]) -> Fit | None:
    """The kind of another format that is this one; none if none is.

    A point that a route claims and does not pass lies in the position that comes first by name, so a fit
    that keeps the order of the positions goes before one that does not.
    """
    for name, target in kinds.items():
        if target == kind:
            return Fit(name, {port: port for port in kind.ports}, {at: at for at in kind.positions})
    found = [each for name, target in kinds.items() for each in _fits(name, kind, target)]
    return min(found, key=_reorders, default=None)


def _reorders(found: Fit) -> bool:
    return sorted(found.position) != sorted(found.position, key=lambda position: found.position[position])


def _fits(name: str, kind: Kind, target: Kind) -> Iterator[Fit]:
    if len(kind.ports) != len(target.ports) or len(kind.positions) != len(target.positions):
        return
    joining = {_joined(ways): position for position, ways in target.positions.items()}
    for ports in permutations(target.ports):
        port = dict(zip(kind.ports, ports, strict=True))
        found = {
            position: joining.get(_joined((port[one], port[other]) for one, other in ways))
            for position, ways in kind.positions.items()
        }
        known = {position: other for position, other in found.items() if other is not None}
        if len(set(known.values())) == len(kind.positions):
            yield Fit(name, port, known)


def _joined(ways: Iterable[tuple[str, str]]) -> frozenset[frozenset[str]]:
    return frozenset(frozenset(way) for way in ways)
