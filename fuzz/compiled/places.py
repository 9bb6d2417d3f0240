"""Where every part of a value lies in the memory: one array of words for each, dense, by the numbers of its keys.

A set is a row of bits, a map the bits of its keys and an array for each part of its values.  What is absent is
zero throughout.  Maps inside maps of a site are tries: the outer one's value is the number of a node, 0 is empty.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import Any, TypeAlias

from fuzz.compiled.domains import REPORTS, Domains
from kernel.names import Run
from proofs.lift.kinds import (
    Kind,
    MapKind,
    OptionKind,
    RecordKind,
    Scalar,
    SetKind,
    fields_of,
    scalars_of,
)


@dataclass(frozen=True)
class Array:
    """Words in a row: ``base`` is where they begin, ``part`` the number of the state's part they belong to, or -1."""

    name: str
    base: int
    shape: tuple[int, ...]
    part: int

    @property
    def size(self) -> int:
        """How many words."""
        return math.prod(self.shape)


@dataclass(frozen=True)
class Words:
    """A scalar: one array, or one for each field of a NamedTuple; ``none``: the first word where there is none."""

    kind: Scalar
    arrays: tuple[Array, ...]
    none: int | None


@dataclass(frozen=True)
class Fields:
    """A record."""

    cls: type
    places: Mapping[str, Place]


@dataclass(frozen=True)
class Bits:
    """A set: the bits of its elements; ``order`` gives for each axis, the bits' own last, the element's part."""

    scalars: tuple[Scalar, ...]
    order: tuple[int, ...]
    array: Array


@dataclass(frozen=True)
class Rows:
    """A set whose elements are too many for bits: a list of them, and how many there are."""

    scalars: tuple[Scalar, ...]
    array: Array
    count: Array


@dataclass(frozen=True)
class Table:
    """A map: the bits of its keys, and the place of a value; ``node``: where the value is the number of a node."""

    keys: Bits
    value: Place
    node: Array | None


Place: TypeAlias = Words | Fields | Bits | Rows | Table


class Planner:
    """Hands out words for places, one array after the other; ``parts``: the parts of a state, longer names later."""

    def __init__(self, domains: Domains, base: int, parts: Sequence[str] = ()) -> None:
        self.domains = domains
        self.next = base
        self.arrays: dict[str, Array] = {}
        self.parts = parts

    def array(self, name: str, shape: tuple[int, ...]) -> Array:
        """The next words."""
        part = max((at for at, each in enumerate(self.parts) if f"{name}_".startswith(f"{each}_")), default=-1)
        made = Array(name, self.next, shape or (1,), part)
        assert name not in self.arrays, name
        self.arrays[name] = made
        self.next += made.size
        return made

    def size(self, scalar: Scalar) -> int:
        """How many entries an axis for such keys has: one to spare, for None."""
        return self.domains.size(scalar) + 1

    def place(self, kind: Kind, name: str, axes: tuple[int, ...] = (), data: list[Any] | None = None) -> Place:
        """Lay out a kind below these axes; ``data``, all its values, makes tries of maps in maps."""
        match kind:
            case Scalar():
                return self._words(kind, name, axes, optional=False)
            case OptionKind(Scalar() as inner):
                return self._words(inner, name, axes, optional=True)
            case RecordKind(cls):
                below = {
                    field: self.place(part, f"{name}_{field}", axes, _parts(data, field))
                    for field, part in fields_of(cls).items()
                }
                return Fields(cls, below)
            case SetKind(element):
                return self._set(scalars_of(element), name, axes)
            case MapKind(key, inner):
                return self._map(scalars_of(key), inner, name, axes, data)
            case _:
                raise TypeError(f"{name}: no place for {kind}")

    def _words(self, kind: Scalar, name: str, axes: tuple[int, ...], optional: bool) -> Words:
        parts = spread(kind)
        none = self.domains.size(parts[0][1]) if optional else None
        return Words(kind, tuple(self.array(name + suffix, axes) for suffix, _ in parts), none)

    def _set(self, scalars: tuple[Scalar, ...], name: str, axes: tuple[int, ...]) -> Bits | Rows:
        if any(len(spread(scalar)) > 1 for scalar in scalars):
            width = sum(len(spread(scalar)) for scalar in scalars)
            return Rows(scalars, self.array(name, (*axes, REPORTS, width)), self.array(f"{name}_count", axes))
        return self._bits(scalars, name, axes)

    def _bits(self, scalars: tuple[Scalar, ...], name: str, axes: tuple[int, ...]) -> Bits:
        innermost = next((at for at, each in enumerate(scalars) if each.source is Run), len(scalars) - 1)
        order = (*(at for at in range(len(scalars)) if at != innermost), innermost)
        outer = tuple(self.size(scalars[at]) for at in order[:-1])
        words = -(-self.size(scalars[innermost]) // 64) if scalars[innermost].source is not Run else 1
        return Bits(scalars, order, self.array(name, (*axes, *outer, words)))

    def _map(
        self, scalars: tuple[Scalar, ...], inner: Kind, name: str, axes: tuple[int, ...], data: list[Any] | None
    ) -> Table:
        keys = self._bits(scalars, name if f"{name}" not in self.arrays else f"{name}_keys", axes)
        below = (*axes, *(self.size(scalar) for scalar in scalars))
        values = None if data is None else [value for each in data for value in each.values()]
        value_name = name if isinstance(inner, RecordKind) else f"{name}_value"
        if values is None or not isinstance(inner, MapKind):
            return Table(keys, self.place(inner, value_name, below, values), None)
        node = self.array(value_name, below)
        return Table(keys, self.place(inner, value_name, (len(values) + 1,), values), node)


def spread(scalar: Scalar) -> tuple[tuple[str, Scalar], ...]:
    """The words of a scalar, by the suffix of their names: a NamedTuple has one for each field, a run is a slot."""
    if scalar.is_named_tuple and scalar.source is not Run:
        parts = fields_of(scalar.source)
        return tuple((f"_{name}", part) for name, part in parts.items() if isinstance(part, Scalar))
    return (("", scalar),)


def _parts(data: list[Any] | None, field: str) -> list[Any] | None:
    return None if data is None else [getattr(each, field) for each in data]


def arrays_of(place: Place) -> Iterator[Array]:
    """Every array of a place."""
    match place:
        case Words(_, arrays, _):
            yield from arrays
        case Fields(_, places):
            for each in places.values():
                yield from arrays_of(each)
        case Bits(_, _, array):
            yield array
        case Rows(_, array, count):
            yield from (array, count)
        case Table(keys, value, node):
            yield keys.array
            if node is not None:
                yield node
            yield from arrays_of(value)


def lists_of(place: Place) -> Iterator[Rows]:
    """Every list of a place."""
    match place:
        case Rows():
            yield place
        case Fields(_, places):
            for each in places.values():
                yield from lists_of(each)
        case Table(_, value, _):
            yield from lists_of(value)
