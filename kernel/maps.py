"""The map and the set that state is kept in: the host supplies them, the kernel looks up, adds and takes away.

``dict`` and ``frozenset`` are two; persistent ones with the same operations serve a large network.
"""

from __future__ import annotations

from collections.abc import ItemsView, Iterator
from collections.abc import Set as AbstractSet
from typing import Any, Protocol, TypeVar, overload

K = TypeVar("K")
V = TypeVar("V")
D = TypeVar("D")


class Map(Protocol[K, V]):
    """Keys to values; ``|`` gives a new map with entries added or replaced, the old one stays."""

    def __getitem__(self, key: K, /) -> V:
        """Give the value of a key that is present."""
        ...

    def __contains__(self, key: Any, /) -> bool:
        """Tell whether the key is present."""
        ...

    def __iter__(self) -> Iterator[K]:
        """Give the keys."""
        ...

    def __len__(self) -> int:
        """Count the keys."""
        ...

    @overload
    def get(self, key: K, /) -> V | None: ...

    @overload
    def get(self, key: K, default: V, /) -> V: ...

    @overload
    def get(self, key: K, default: D, /) -> V | D: ...

    def items(self) -> ItemsView[K, V]:
        """Give the keys with their values."""
        ...

    def __or__(self, other: dict[K, V], /) -> Map[K, V]:
        """Give a map with the entries of ``other`` added or put in place of those here."""
        ...


class Members(Protocol[K]):
    """Things that are in it or not; ``-`` and ``|`` give a new one, the old one stays."""

    def __contains__(self, member: Any, /) -> bool:
        """Tell whether something is in it."""
        ...

    def __iter__(self) -> Iterator[K]:
        """Give what is in it."""
        ...

    def __len__(self) -> int:
        """Count what is in it."""
        ...

    def __sub__(self, other: AbstractSet[Any], /) -> Members[K]:
        """Give one without what is in ``other``."""
        ...

    def __or__(self, other: frozenset[K], /) -> Members[K]:
        """Give one with what is in ``other`` too."""
        ...
