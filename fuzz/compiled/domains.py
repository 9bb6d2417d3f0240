"""Numbers for identifiers: how many of each type a site has, and which is which."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field
from enum import Enum
from typing import Any

from kernel.machine.centre import NO_ROUTE
from kernel.names import Run
from models.world.state import Formation, Site
from proofs.lift.kinds import (
    Kind,
    MapKind,
    OptionKind,
    RecordKind,
    Scalar,
    SetKind,
    TupleKind,
    fields_of,
)

FOREIGN = "foreign"
"""A tag, and a record, that no plan knows."""
RUN_SLOTS = 64
"""So many runs are told apart in one trace; a set of them is one word."""
CAPACITIES: Mapping[str, int] = {"Epoch": 16, "UnitLife": 32, "TerminalLife": 8}
"""Numbers stay below these; the driver ends a trace before."""
REPORTS = 512
"""So many tail reports are kept in one trace."""
EXTRA: Mapping[str, tuple[str, ...]] = {
    "Route": (str(NO_ROUTE),),
    "Tag": (FOREIGN,),
    "Record": (FOREIGN,),
    "Position": ("normal",),
}
BITS = 64


class Uncountable(Exception):
    """A type whose values have no numbers here."""


@dataclass(frozen=True)
class Domains:
    """The identifiers of a site by type, in order: each one's number is its place.

    ``None`` has the number behind the last one, so that an index is never out of range.
    """

    names: Mapping[str, tuple[str, ...]]
    numbers: Mapping[str, Mapping[str, int]] = field(repr=False)

    def size(self, scalar: Scalar) -> int:
        """How many values a type has; its None has this number."""
        if scalar.source is bool:
            return 2
        if scalar.is_enum:
            return len(scalar.source)
        if scalar.source is Run:
            return RUN_SLOTS
        if scalar.name in CAPACITIES:
            return CAPACITIES[scalar.name]
        if scalar.is_identifier and not scalar.is_ordered:
            return len(self.names.get(scalar.name, ()))
        raise Uncountable(scalar.name)

    def words(self, scalar: Scalar) -> int:
        """How many words a set of such values takes."""
        return -(-self.size(scalar) // BITS)

    def number(self, scalar: Scalar, value: Any) -> int:
        """The number of an identifier, an enumeration's member, a truth value or a number."""
        if isinstance(value, Enum):
            return list(type(value)).index(value)
        if scalar.name in self.numbers:
            return self.numbers[scalar.name][value]
        return int(value)

    def name(self, scalar: Scalar, number: int) -> Any:
        """What has this number; the other way of :meth:`number`."""
        if scalar.is_enum:
            return list(scalar.source)[number]
        if scalar.name in self.names:
            return self.names[scalar.name][number]
        return bool(number) if scalar.source is bool else number


def domains(site: Site) -> Domains:
    """Number every identifier that a site names, and a foreign tag, a foreign record and the route of none."""
    found: dict[str, set[str]] = {name: set(extra) for name, extra in EXTRA.items()}
    for name in ("layout", "lists", "plan", "records", "ground"):
        value = getattr(site, name)
        _collect(RecordKind(type(value)), value, found)
    for name, values in vars(site.formation).items():
        if name in ("train_of", "cab", "carried_by"):
            _collect(fields_of(Formation)[name], values, found)
    names = {name: tuple(sorted(values)) for name, values in found.items()}
    return Domains(names, {name: {each: at for at, each in enumerate(values)} for name, values in names.items()})


def _collect(kind: Kind, value: Any, found: dict[str, set[str]]) -> None:
    """Note every identifier in a value."""
    match kind:
        case Scalar() if kind.is_identifier and not kind.is_ordered and not kind.is_named_tuple:
            found.setdefault(kind.name, set()).add(value)
        case OptionKind(inner) if value is not None:
            _collect(inner, value, found)
        case TupleKind(items):
            for item, part in zip(items, value, strict=True):
                _collect(item, part, found)
        case SetKind(element):
            for part in value:
                _collect(element, part, found)
        case MapKind(key, inner):
            for one, part in value.items():
                _collect(key, one, found)
                _collect(inner, part, found)
        case RecordKind(cls):
            for name, part in fields_of(cls).items():
                _collect(part, getattr(value, name), found)


def bits_of(word: int, first: int = 0) -> Iterator[int]:
    """The numbers in a word of a set."""
    word &= (1 << BITS) - 1
    while word:
        low = word & -word
        yield first + low.bit_length() - 1
        word ^= low
