"""Maps and sets that share what they have in common: a step on them costs no more on a large network (T4).

``dict | dict`` copies both; on 50,000 blocks that is all the time a step takes.  These are hash tries: what a step
does not touch, the state after it shares with the state before.
"""

from __future__ import annotations

from collections.abc import ItemsView, Iterable, Iterator, Mapping
from collections.abc import Set as AbstractSet
from dataclasses import replace
from typing import Any, Generic, TypeVar, overload

from rpds import HashTrieMap, HashTrieSet

from kernel.centre import Centre

K = TypeVar("K")
V = TypeVar("V")
D = TypeVar("D")


class HostMap(Generic[K, V]):
    """A :class:`kernel.maps.Map`.

    ``empty_is_absent``: an entry without anything in it is not kept, for maps in which absent means none.
    """

    __slots__ = ("_empty_is_absent", "_trie")

    def __init__(self, entries: Mapping[K, V], *, empty_is_absent: bool = False) -> None:
        kept = {key: value for key, value in entries.items() if value or not empty_is_absent}
        self._trie: HashTrieMap[K, V] = HashTrieMap(kept)
        self._empty_is_absent = empty_is_absent

    def __getitem__(self, key: K, /) -> V:
        return self._trie[key]

    def __contains__(self, key: Any, /) -> bool:
        return key in self._trie

    def __iter__(self) -> Iterator[K]:
        return iter(self._trie)

    def __len__(self) -> int:
        return len(self._trie)

    @overload
    def get(self, key: K, /) -> V | None: ...

    @overload
    def get(self, key: K, default: V, /) -> V: ...

    @overload
    def get(self, key: K, default: D, /) -> V | D: ...

    def get(self, key: K, default: Any = None, /) -> Any:
        """Give the value of a key, or the default."""
        return self._trie.get(key, default)

    def items(self) -> ItemsView[K, V]:
        """Give the keys with their values."""
        return self._trie.items()

    def __or__(self, other: Mapping[K, V], /) -> HostMap[K, V]:
        trie = self._trie
        for key, value in other.items():
            trie = trie.discard(key) if self._empty_is_absent and not value else trie.insert(key, value)
        return self._like(trie)

    def _like(self, trie: HashTrieMap[K, V]) -> HostMap[K, V]:
        made = HostMap.__new__(HostMap)
        made._trie, made._empty_is_absent = trie, self._empty_is_absent
        return made

    def __eq__(self, other: object) -> bool:
        if isinstance(other, HostMap):
            return self._trie == other._trie
        return isinstance(other, Mapping) and dict(self.items()) == other

    __hash__ = None  # type: ignore[assignment]

    def __repr__(self) -> str:
        return f"HostMap({dict(self.items())!r})"


class HostSet(Generic[K]):
    """A :class:`kernel.maps.Members`."""

    __slots__ = ("_trie",)

    def __init__(self, members: Iterable[K]) -> None:
        self._trie: HashTrieSet[K] = HashTrieSet(members)

    def __contains__(self, member: Any, /) -> bool:
        return member in self._trie

    def __iter__(self) -> Iterator[K]:
        return iter(self._trie)

    def __len__(self) -> int:
        return len(self._trie)

    def __sub__(self, other: AbstractSet[Any], /) -> HostSet[K]:
        trie = self._trie
        for member in other:
            trie = trie.discard(member)
        return self._like(trie)

    def __or__(self, other: AbstractSet[K], /) -> HostSet[K]:
        trie = self._trie
        for member in other:
            trie = trie.insert(member)
        return self._like(trie)

    @staticmethod
    def _like(trie: HashTrieSet[K]) -> HostSet[K]:
        made = HostSet.__new__(HostSet)
        made._trie = trie
        return made

    def __eq__(self, other: object) -> bool:
        return isinstance(other, HostSet | AbstractSet) and len(self) == len(other) and all(m in other for m in self)

    __hash__ = None  # type: ignore[assignment]

    def __repr__(self) -> str:
        return f"HostSet({sorted(map(str, self))!r})"


def hosted(centre: Centre) -> Centre:
    """The same state in the host's maps; after a restart, and where a step has made a plain one, it is moved over."""
    plain: dict[str, Any] = {}
    for name in ("accounted", "runs", "claimed", "locked", "terminal_life"):
        held = getattr(centre, name)
        if not isinstance(held, HostMap):
            plain[name] = HostMap(held, empty_is_absent=name in ("claimed", "locked"))
    for name in ("lost_blocks", "lost_points"):
        held = getattr(centre, name)
        if not isinstance(held, HostSet):
            plain[name] = HostSet(held)
    return replace(centre, **plain) if plain else centre
