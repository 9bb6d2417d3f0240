"""What a step changed, and nothing else: the difference of two states in a form that a witness writes down.

A record or map differs by the fields or keys that changed; a set by what came or went.  An absent
key and an empty value are the same: nobody holds a block that is not listed.
"""

from __future__ import annotations

from collections.abc import Hashable, Mapping
from dataclasses import dataclass, fields, is_dataclass
from typing import Any

Changes = Mapping[Any, Any]
"""For each field or key that changed: what changed in it, or its value now."""


@dataclass(frozen=True)
class Came:
    """These members came into a set."""

    members: frozenset[Any]


@dataclass(frozen=True)
class Went:
    """These members went out of a set."""

    members: frozenset[Any]


@dataclass(frozen=True)
class Gone:
    """A key is no more."""


GONE = Gone()


def came(*members: Hashable) -> Came:
    """Say that exactly these came into a set."""
    return Came(frozenset(members))


def went(*members: Hashable) -> Went:
    """Say that exactly these went out of a set."""
    return Went(frozenset(members))


def changes(before: Any, after: Any) -> Changes:
    """Every difference of two states of one kind."""
    if is_dataclass(before):
        pairs = [(field.name, getattr(before, field.name), getattr(after, field.name)) for field in fields(before)]
    else:
        keys = [*before, *(key for key in after if key not in before)]
        pairs = [(key, before.get(key, GONE), after.get(key, GONE)) for key in keys]
    return {name: difference(old, new) for name, old, new in pairs if not same(old, new)}


def difference(old: Any, new: Any) -> Any:
    """How one value became another, which is not the same."""
    if isinstance(old, frozenset) and isinstance(new, frozenset):
        if old < new:
            return Came(new - old)
        if new < old:
            return Went(old - new)
        return new
    mapped = isinstance(old, Mapping) and isinstance(new, Mapping)
    if mapped or (is_dataclass(old) and type(old) is type(new) and old is not GONE):
        return changes(old, new)
    return new


def same(old: Any, new: Any) -> bool:
    """Whether nothing changed, an absent value being an empty one."""
    if old is new or old == new:
        return True
    if isinstance(old, Mapping) and isinstance(new, Mapping):
        return not changes(old, new)
    return is_empty(old) and is_empty(new)


def is_empty(value: Any) -> bool:
    """Whether this is no value, or an empty set or map."""
    return value == GONE or (isinstance(value, frozenset | Mapping) and not value)
