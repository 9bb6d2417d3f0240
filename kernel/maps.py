"""The map that state is kept in: the host supplies it, the kernel only looks up and adds.

``dict`` is one; a persistent map with the same operations serves a large network.
"""

from __future__ import annotations

from collections.abc import ItemsView, Iterator
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
