"""What stands in compiled code for looking up and putting into a map: a typed list of pairs, gone through in order.

Machines' maps are short: the trains near a worker, the sections of a line.  Whether a list is a map or a set is told
by its items: what has the type of the key is an item of a set, what has it as its first part a pair of a map.
"""

from __future__ import annotations

from typing import Any

from numba import types as known_types
from numba.core.errors import TypingError
from numba.extending import overload
from numba.typed import List

from models.compiled.kept import compiled

types: Any = known_types


def contains(container: Any, key: Any) -> bool:
    """Stand for ``key in container`` until it is compiled."""
    raise NotImplementedError


def value_at(container: Any, key: Any) -> Any:
    """Stand for ``container[key]`` until it is compiled."""
    raise NotImplementedError


@compiled
def with_entry(container, key, value):  # type: ignore[no-untyped-def]
    """Give a new map with an entry put in place of the one of this key, or added at the end."""
    made = container.copy()
    for place, pair in enumerate(made):
        if pair[0] == key:
            made[place] = (key, value)
            return made
    made.append((key, value))
    return made


def empty_of(map_type: Any) -> Any:
    """Give the function that makes an empty map of a type."""
    item = map_type.item_type
    return compiled(lambda: List.empty_list(item))


def _is_pair_of(item: Any, key: Any) -> bool:
    return isinstance(item, types.BaseTuple) and len(item) == 2 and next(iter(item)) == key


@overload(contains, strict=False)
def _contains(container: Any, key: Any) -> Any:
    key = types.unliteral(key)
    if isinstance(container, types.BaseTuple):
        return lambda container, key: key in container
    if isinstance(container, types.ListType) and container.item_type == key:

        def in_set(container, key):  # type: ignore[no-untyped-def]
            for each in container:  # noqa: SIM110
                if each == key:
                    return True
            return False

        return in_set
    if isinstance(container, types.ListType) and _is_pair_of(container.item_type, key):

        def in_map(container, key):  # type: ignore[no-untyped-def]
            for pair in container:  # noqa: SIM110
                if pair[0] == key:
                    return True
            return False

        return in_map
    raise TypingError(f"{key} is looked for in {container}, which is no map, set or tuple of such")


@overload(value_at, strict=False)
def _value_at(container: Any, key: Any) -> Any:
    key = types.unliteral(key)
    if isinstance(container, types.UniTuple) and isinstance(key, types.Integer):
        return lambda container, key: container[key]
    if isinstance(container, types.ListType) and _is_pair_of(container.item_type, key):

        def in_map(container, key):  # type: ignore[no-untyped-def]
            for pair in container:
                if pair[0] == key:
                    return pair[1]
            raise KeyError

        return in_map
    raise TypingError(f"{key} is looked up in {container}, which is no map of such")
